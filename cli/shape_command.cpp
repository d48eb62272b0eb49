// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_command.h"

#include <sys/resource.h>
#include <sys/stat.h>
#include <tbb/global_control.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <functional>
#include <iomanip>
#include <iostream>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "droplet/error.h"
#include "droplet/footprint/height_map.h"
#include "droplet/io/evolver.h"
#include "droplet/io/object.h"
#include "droplet/io/report.h"
#include "droplet/shape/base_surface.h"
#include "droplet/surface/onto.h"
#include "droplet/units.h"
#include "progress_display.h"
#include "shape_options.h"
#include "summary.h"

namespace cli {
namespace {

namespace fs = std::filesystem;
using droplet::Droplet;
using droplet::Error;
using droplet::ErrorCode;
using droplet::Stage;

/// Adds up how long each stage takes.
class StageClock {
public:
    void begin(Stage stage)
    {
        close();
        current_ = stage;
    }

    /// Seconds of every stage up to now.
    std::array<double, droplet::kStageCount> times()
    {
        close();
        return times_;
    }

    [[nodiscard]] double total() const { return seconds(start_, Clock::now()); }

private:
    using Clock = std::chrono::steady_clock;

    static double seconds(Clock::time_point from, Clock::time_point to)
    {
        return std::chrono::duration<double>(to - from).count();
    }

    void close()
    {
        const auto now = Clock::now();
        if (current_) {
            times_[static_cast<std::size_t>(*current_)] += seconds(since_, now);
        }
        since_ = now;
    }

    Clock::time_point start_ = Clock::now();
    Clock::time_point since_ = start_;
    std::optional<Stage> current_;
    std::array<double, droplet::kStageCount> times_{};
};

bool isStream(const std::string& path)
{
    return path == kStandardStream;
}

bool sameFile(const std::string& a, const std::string& b)
{
    std::error_code ignored;
    const auto place = [&](const std::string& path) {
        return fs::weakly_canonical(fs::absolute(path, ignored), ignored);
    };
    return a == b || fs::equivalent(a, b, ignored) || place(a) == place(b);
}

/// `program - out < out` would read what it is about to replace.
bool isStandardInput(const std::string& path)
{
    struct stat input = {};
    struct stat file = {};
    return fstat(STDIN_FILENO, &input) == 0 && stat(path.c_str(), &file) == 0 && S_ISREG(file.st_mode) &&
           input.st_dev == file.st_dev && input.st_ino == file.st_ino;
}

[[noreturn]] void refuseClash(const std::string& written, const std::string& other, const std::string& path)
{
    throw Error(ErrorCode::InvalidArgument,
                written + " and " + other + " are the same, '" + path + "'; they must be different files");
}

/// What is known to fail must fail before any work is done.
void checkPaths(const ShapeOptions& options)
{
    struct File {
        const char* name;
        const std::string& path;
    };
    std::vector<File> outputs{{"OUTPUT", options.output}};
    if (options.json) {
        outputs.push_back({"--json", *options.json});
    }
    if (options.evolver) {
        outputs.push_back({"--export-evolver", *options.evolver});
    }
    std::vector<File> inputs;
    if (options.config) {
        inputs.push_back({"--config", *options.config});
    }
    if (options.ground.path) {
        inputs.push_back({"--surface", *options.ground.path});
    }
    if (options.onto) {
        inputs.push_back({"--onto", *options.onto});
    }
    for (auto output = outputs.begin(); output != outputs.end(); ++output) {
        for (auto other = outputs.begin(); other != output; ++other) {
            if (sameFile(other->path, output->path)) {
                refuseClash(output->name, other->name, other->path);
            }
        }
        if (isStream(output->path)) {
            continue;
        }
        if (isStream(options.input) ? isStandardInput(output->path) : sameFile(options.input, output->path)) {
            refuseClash(output->name, "INPUT", output->path);
        }
        for (const File& input : inputs) {
            if (sameFile(input.path, output->path)) {
                refuseClash(output->name, input.name, output->path);
            }
        }
        droplet::checkWritable(output->path, options.files);
    }
}

std::vector<std::byte> readStandardInput(std::size_t max_pixels)
{
    // 16 bits of red, green, blue and alpha for every pixel, and room for headers: no picture we read takes more.
    const std::size_t longest = max_pixels * 8 + (std::size_t{1} << 20);
    std::vector<std::byte> bytes;
    std::vector<std::byte> chunk(std::size_t{1} << 16);
    for (;;) {
        const ssize_t got = read(STDIN_FILENO, chunk.data(), chunk.size());
        if (got < 0 && errno == EINTR) {
            continue;
        }
        if (got < 0) {
            throw Error(ErrorCode::InvalidInput, std::string("standard input cannot be read: ") + std::strerror(errno));
        }
        if (got == 0) {
            return bytes;
        }
        bytes.insert(bytes.end(), chunk.begin(), chunk.begin() + got);
        if (bytes.size() > longest) {
            throw Error(ErrorCode::InvalidInput,
                        "standard input is longer than any picture of " + std::to_string(max_pixels) + " pixels");
        }
    }
}

/// Runs a function of the library that may find fault with the picture's content, and puts the picture's name before.
template <typename Function>
auto forInput(const ShapeOptions& options, Function function)
{
    try {
        return function();
    } catch (const Error& error) {
        if (error.code() != ErrorCode::InvalidInput) {
            throw;
        }
        throw Error(error.code(), (isStream(options.input) ? "standard input" : options.input) + ": " + error.what());
    }
}

droplet::Mask readInput(const ShapeOptions& options)
{
    if (!isStream(options.input)) {
        return droplet::readMask(options.input, options.mask);
    }
    const auto bytes = readStandardInput(options.mask.max_pixels);
    return forInput(options, [&] { return droplet::decodeMask(bytes, options.mask); });
}

/// What lies beside the picture, read before it: what is known to fail must fail before any work is done.
struct Surroundings {
    std::optional<droplet::HeightMap> map;
    std::optional<droplet::TexturedMesh> object;
};

Surroundings readSurroundings(const ShapeOptions& options)
{
    Surroundings around;
    if (options.ground.path) {
        around.map = droplet::readHeightMap(*options.ground.path);
        if (!around.map->in_floats && !options.ground.depth) {
            throw Error(ErrorCode::InvalidArgument,
                        "--surface-depth is missing: how much higher white is than black in " + *options.ground.path +
                            ", such as 2mm");
        }
    }
    if (options.onto) {
        around.object = droplet::readObject(*options.onto);
    }
    return around;
}

droplet::BaseSurface groundOf(const droplet::GroundReport& ground, const std::optional<droplet::HeightMap>& map,
                              droplet::Vec2 extent)
{
    switch (ground.kind) {
        case droplet::GroundKind::Sphere:
            return droplet::BaseSurface::sphere(ground.radius.value());
        case droplet::GroundKind::Cylinder:
            return droplet::BaseSurface::cylinder(ground.radius.value(), ground.axis.value());
        case droplet::GroundKind::HeightMap:
            return droplet::BaseSurface::heightMap(map.value(), extent, ground.depth);
        case droplet::GroundKind::Flat:
            break;
    }
    return {};
}

/// What of the options depends on the picture and what lies beside it: the picture's size on an object, and the ground.
void complete(droplet::DropletOptions& droplet, const droplet::Mask& mask, const Surroundings& around,
              const ShapeOptions& options)
{
    if (around.object && !options.sized) {
        droplet.trace.width =
            droplet::metresPerUv(*around.object) * std::sqrt(static_cast<double>(mask.width) / mask.height);
    }
    const double pixel = droplet.trace.pixel_size.value_or(droplet.trace.width / mask.width);
    droplet.solve.ground = groundOf(options.ground, around.map, {pixel * mask.width, pixel * mask.height});
    if (around.object) {
        // Level, but not known to be: a flat base of few triangles could not follow the object.
        droplet.solve.ground = droplet::BaseSurface([](droplet::Vec2) { return droplet::GroundPoint{}; });
    }
}

/// An edge is too short for a footprint only when the footprint is known; all memory would be used up to find out.
void refuseTooShortEdge(const droplet::Mask& mask, const ShapeOptions& options)
{
    if (!options.droplet.mesh.edge) {
        return;
    }
    const auto& trace = options.droplet.trace;
    const double pixel = trace.pixel_size.value_or(trace.width / mask.width);
    const double covered = std::accumulate(mask.coverage.begin(), mask.coverage.end(), 0.0) / 65535.0;
    const double edge = *options.droplet.mesh.edge;
    const double equilateral = std::sqrt(3.0) / 4.0 * edge * edge;
    const double triangles = covered * pixel * pixel / equilateral;
    if (triangles > static_cast<double>(kMostTriangles)) {
        std::ostringstream message;
        message << std::setprecision(3) << "--edge: " << edge / droplet::kMillimetre << "mm would take " << triangles
                << " triangles on this footprint, must be at least "
                << edge * std::sqrt(triangles / static_cast<double>(kMostTriangles)) / droplet::kMillimetre << "mm";
        throw Error(ErrorCode::InvalidArgument, message.str());
    }
}

droplet::InputReport describeInput(const droplet::Mask& mask, const droplet::Outline& outline,
                                   const ShapeOptions& options)
{
    droplet::InputReport input;
    input.path = options.input;
    input.width_px = mask.width;
    input.height_px = mask.height;
    input.pixel_size = outline.pixel_size;
    input.channel = mask.channel;
    input.inverted = mask.inverted;
    input.threshold = options.droplet.trace.threshold;
    input.level_dry = mask.level_dry;
    input.level_liquid = mask.level_liquid;
    input.anti_aliased = outline.anti_aliased;
    input.specks_dropped = outline.specks_dropped;
    input.largest_speck_px = outline.largest_speck_px;
    return input;
}

droplet::OutputReport describeOutput(const droplet::Surface& surface, const ShapeOptions& options)
{
    droplet::OutputReport output;
    output.path = options.output;
    output.format = options.format;
    output.triangles = surface.triangles.size();
    output.topology = droplet::topology(surface);
    // Only glTF repeats a place to give it a second normal.
    const bool repeats = options.format == droplet::Format::Glb || options.format == droplet::Format::Gltf;
    for (std::uint32_t i = 0; i < surface.weld.size(); ++i) {
        output.vertices += repeats || surface.weld[i] == i ? 1 : 0;
    }
    return output;
}

droplet::MeshReport describeMeshes(const std::vector<droplet::PlanarMesh>& meshes)
{
    droplet::MeshReport report;
    report.min_angle = std::numeric_limits<double>::infinity();
    for (const droplet::PlanarMesh& mesh : meshes) {
        report.vertices += mesh.vertices.size();
        report.triangles += mesh.triangles.size();
        report.holes += mesh.loopCount() - 1;
        report.min_angle = std::min(report.min_angle, droplet::minAngle(mesh));
    }
    return report;
}

std::optional<droplet::Retention> retentionOf(const droplet::ShapeFigures& figures, const ShapeOptions& options)
{
    if (!options.hysteresis) {
        return std::nullopt;
    }
    return droplet::retention(figures, options.droplet.solve, *options.hysteresis);
}

/// Everything but bytes, times and memory, which are known when the file is written.
droplet::Report describe(const droplet::Mask& mask, const Droplet& droplet, const ShapeOptions& options)
{
    droplet::Report report;
    report.input = describeInput(mask, droplet.outline, options);
    report.output = describeOutput(droplet.surface, options);
    report.physics = options.droplet.solve;
    report.hysteresis = options.hysteresis;
    report.ground = options.ground;
    report.solve = droplet.solution.report;
    report.mesh = describeMeshes(droplet.meshes);
    report.total = droplet.total;
    for (std::size_t i = 0; i < droplet.meshes.size(); ++i) {
        report.droplets.push_back({droplet.figures[i], droplet.meshes[i].loopCount() - 1,
                                   droplet.solution.droplets[i].pressure, retentionOf(droplet.figures[i], options)});
    }
    report.retention = retentionOf(droplet.total, options);
    const bool one_pressure =
        report.droplets.size() == 1 || options.droplet.solve.fill.sharing == droplet::FillSharing::Total;
    if (one_pressure) {
        report.pressure = report.droplets.front().pressure;
    }
    report.warnings = options.warnings;
    report.warnings.insert(report.warnings.end(), droplet.warnings.begin(), droplet.warnings.end());
    return report;
}

/// Puts the droplets where they are on the object.
droplet::ObjectReport lay(Droplet& droplet, const droplet::TexturedMesh& object, const ShapeOptions& options)
{
    droplet::OntoResult result = droplet::layOnto(droplet.surface, object, {droplet.domain.extent});
    droplet.surface = std::move(result.surface);
    droplet.warnings.insert(droplet.warnings.end(), result.report.warnings.begin(), result.report.warnings.end());
    const droplet::OntoReport& onto = result.report;
    return {options.onto.value(),
            onto.laid,
            onto.outside + onto.across + onto.folded,
            onto.flipped_charts,
            onto.overlapping_charts,
            onto.least_scale,
            onto.most_scale};
}

std::uint64_t peakMemory()
{
    struct rusage usage = {};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;  // Linux counts in KiB
}

void writeOutput(const std::string& path, const droplet::OutputOptions& files,
                 const std::function<void(std::ostream&)>& write)
{
    droplet::writeWhole(isStream(path) ? "/dev/stdout" : path, write, files);
}

/// Writes the surface and, if asked for, the datafile for Surface Evolver and the report.
///
/// Several files cannot appear at one instant. So each is written inside the writing of the one before it: after every
/// byte of that has been taken by the file system, before its file is renamed into place. A full disk or an unwritable
/// report thus leaves all older files as they stood; only a rename that fails could part them.
void save(const Droplet& droplet, const ShapeOptions& options, StageClock& clock, droplet::Report& report)
{
    const auto write_report = [&] {
        report.time = clock.times();
        report.time_total = clock.total();
        report.peak_memory = peakMemory();
        if (options.json) {
            writeOutput(*options.json, options.files, [&](std::ostream& out) { droplet::writeReport(out, report); });
        }
    };
    const auto write_evolver = [&] {
        if (!options.evolver) {
            return write_report();
        }
        writeOutput(*options.evolver, options.files, [&](std::ostream& out) {
            droplet::writeEvolver(out, droplet.meshes, droplet.solution.droplets, options.droplet.solve);
            if (out) {
                write_report();
            }
        });
    };
    writeOutput(options.output, options.files, [&](std::ostream& out) {
        report.output.bytes = droplet::writeSurface(droplet.surface, out, options.format,
                                                    {options.material, report.output.topology.closed});
        if (out) {  // else whoever opened it knows the cause
            write_evolver();
        }
    });
}

void tell(const droplet::Report& report, const ShapeOptions& options)
{
    if (options.verbosity == Verbosity::Quiet) {
        return;
    }
    if (options.progress == ProgressMode::Json) {
        for (const std::string& warning : report.warnings) {
            std::cerr << nlohmann::json{{"warning", warning}}.dump(-1, ' ', false,
                                                                   nlohmann::json::error_handler_t::replace)
                      << "\n";
        }
        return;
    }
    std::cerr << summary(report, options.verbosity == Verbosity::Verbose) << warnings(report) << std::flush;
}

void print(const std::string& text)
{
    droplet::writeWhole("/dev/stdout", [&](std::ostream& out) { out << text; });
}

}  // namespace

int runShape(int argc, const char* const* argv)
{
    const auto parsed = parseShape(argc, argv);
    if (const auto* text = std::get_if<std::string>(&parsed)) {
        print(*text);
        return 0;
    }
    auto options = std::get<ShapeOptions>(parsed);
    checkPaths(options);

    std::optional<tbb::global_control> threads;
    if (options.threads) {
        threads.emplace(tbb::global_control::max_allowed_parallelism, *options.threads);
    }
    StageClock clock;
    ProgressDisplay progress(options.verbosity == Verbosity::Quiet && options.progress == ProgressMode::Auto
                                 ? ProgressMode::None
                                 : options.progress);
    const auto begin = [&](Stage stage) {
        clock.begin(stage);
        progress.begin(stage);
    };

    begin(Stage::Read);
    const Surroundings around = readSurroundings(options);
    const droplet::Mask mask = readInput(options);
    complete(options.droplet, mask, around, options);
    refuseTooShortEdge(mask, options);
    Droplet droplet = forInput(options, [&] { return droplet::makeDroplet(mask, options.droplet, begin); });
    std::optional<droplet::ObjectReport> onto;
    if (around.object) {
        onto = lay(droplet, *around.object, options);
    }
    begin(Stage::Write);
    droplet::Report report = describe(mask, droplet, options);
    report.onto = onto;
    save(droplet, options, clock, report);
    progress.finish();
    tell(report, options);
    return 0;
}

}  // namespace cli
