// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_command.h"

#include <fmt/core.h>
#include <tbb/global_control.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <iostream>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "droplet/error.h"
#include "droplet/io/evolver.h"
#include "droplet/io/gltf.h"
#include "droplet/io/page.h"
#include "droplet/picture/picture.h"
#include "droplet/surface/onto.h"
#include "droplet/units.h"
#include "droplet_report.h"
#include "files.h"
#include "picture_watch.h"
#include "progress_display.h"
#include "stage_clock.h"
#include "summary.h"
#include "surface_files.h"
#include "surroundings.h"
#include "terminal.h"

namespace cli {
namespace {

using droplet::Droplet;
using droplet::Error;
using droplet::ErrorCode;
using droplet::Stage;

/// Runs a function that may reject the picture's content, and puts the picture's name before the error message.
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

/// Longer side [px] at which an SVG image must be drawn, so that a pixel is at most a quarter of a triangle's edge.
/// Nothing if the image is large enough, or cannot be larger.
///
/// A traced outline differs from the drawn one by 0.02 pixels rms and half a pixel at corners, whatever the pixels'
/// size. So the error is at most an eighth of an edge, even where pixels could be visible.
std::optional<int> finerSide(const droplet::Mask& mask, const droplet::DropletOptions& options)
{
    constexpr double kPixelsPerEdge = 4.0;
    constexpr int kLongest = 8192;  // half a gigabyte while it is drawn
    const double covered = std::accumulate(mask.coverage.begin(), mask.coverage.end(), 0.0) / 65535.0;
    const double equilateral = covered / static_cast<double>(options.mesh.triangles);
    const double edge = options.mesh.edge ? *options.mesh.edge / droplet::pixelSize(mask, options.trace)
                                          : std::sqrt(equilateral * 4.0 / std::sqrt(3.0));
    const int side = std::max(mask.width, mask.height);
    if (!mask.raster_scale || edge >= kPixelsPerEdge || !(edge > 0.0) || side >= kLongest) {
        return std::nullopt;
    }
    return static_cast<int>(std::min<double>(kLongest, std::ceil(side * kPixelsPerEdge / edge)));
}

/// Whether the picture's size is the one that its file states.
bool takesOwnSize(const droplet::Mask& mask, const Surroundings& around, const ShapeOptions& options)
{
    return mask.physical_width && !options.footprint.sized && !around.object;
}

/// Settings completed by the picture's size, which may depend on an object, and by the ground.
DropletSettings completeSettings(const droplet::Mask& mask, const Surroundings& around, const ShapeOptions& options)
{
    DropletSettings settings = options.settings;
    droplet::DropletOptions& droplet = settings.droplet;
    droplet.trace = options.footprint.trace;
    if (around.object && !options.footprint.sized) {
        droplet.trace.width =
            droplet::metresPerUv(*around.object) * std::sqrt(static_cast<double>(mask.width) / mask.height);
    } else if (takesOwnSize(mask, around, options)) {
        droplet.trace.width = *mask.physical_width;
        if (!(droplet.trace.width >= kLength.min && droplet.trace.width <= kLength.max)) {
            throw Error(ErrorCode::InvalidInput,
                        fmt::format("the page states a width of {:.6g}m, which must be {}; give --width instead",
                                    droplet.trace.width, kLength.allowed));
        }
    }
    const double pixel = droplet::pixelSize(mask, droplet.trace);
    droplet.solve.ground = groundOf(settings, around, {pixel * mask.width, pixel * mask.height});
    return settings;
}

/// Warning about a mask that may be wrong.
std::optional<std::string> maskWarning(const droplet::Mask& mask)
{
    constexpr double kMinConfidence = 0.5;
    if (mask.segment_confidence >= kMinConfidence) {
        return std::nullopt;
    }
    return fmt::format(
        "the footprints may be wrong: the picture is hardly a mask ({:.0f} % sure, by --segment {}); look at it with "
        "--mask-out, change it with --segment, --channel or --threshold",
        100.0 * mask.segment_confidence, name(mask.segment));
}

/// Writes the mask as it was traced, with 16 bits.
void writeMask(std::ostream& out, const droplet::Mask& mask, const droplet::TraceOptions& trace)
{
    const droplet::Mask used = droplet::clean(mask, trace.clean, droplet::pixelSize(mask, trace), trace.threshold);
    droplet::writePng(droplet::DeepPicture{used.width, used.height, 1, used.coverage}, out);
}

/// Whether only the page's droplet gets a slider: without --fill-range, if a slider is possible.
bool hasSliderInPageOnly(const ShapeOptions& options)
{
    const droplet::SolveOptions& solve = options.settings.droplet.solve;
    return options.html && !options.settings.droplet.fill_range && !solve.no_penetration && !options.settings.onto;
}

void addPageSlider(droplet::DropletOptions& droplet, const ShapeOptions& options)
{
    if (hasSliderInPageOnly(options)) {
        droplet.fill_range = droplet::FillRange{.may_shrink = true};
    }
}

/// Writes the page with the droplet as a GLB.
void writeHtml(std::ostream& out, const droplet::Surface& surface, const ShapeOptions& options,
               const droplet::Report& report)
{
    droplet::PageContent page;
    if (report.input.type && report.input.type->text) {
        page.title = *report.input.type->text;
    } else {
        page.title = isStream(options.input) ? "droplet" : std::filesystem::path(options.input).stem().string();
    }
    std::ostringstream glb;
    droplet::writeGltf(surface, glb, {true, options.settings.material, report.output.topology.closed});
    page.glb = std::move(glb).str();
    std::ostringstream json;
    droplet::writeReport(json, report);
    page.report = std::move(json).str();
    droplet::writePage(out, page);
}

/// Subject of the preview.
PreviewSubject subjectOf(const Droplet& droplet, const DropletSettings& settings, const Surroundings& around)
{
    PreviewSubject subject{droplet.surface, settings.material, droplet.domain.extent,
                           around.below,    around.light,      around.object};
    const droplet::BaseSurface& below = settings.droplet.solve.ground;
    subject.on_object = around.object.has_value();
    if (!around.object && !below.flat()) {
        subject.stand = droplet::groundMesh(below, droplet.domain.extent);
    }
    return subject;
}

/// Writes the surface and, if given, the mask, the datafile for Surface Evolver, the page, the pictures and the report.
void save(Droplet& droplet, const ShapeOptions& options, const std::optional<PreviewSubject>& subject,
          const std::optional<OutputFile>& mask, StageClock& clock, droplet::Report& report)
{
    std::optional<droplet::Refill> refill = std::exchange(droplet.surface.refill, std::nullopt);
    if (!hasSliderInPageOnly(options)) {
        droplet.surface.refill.swap(refill);
    }
    std::vector<OutputFile> files = surfaceFiles(droplet.surface,
                                                 {options.output,
                                                  options.format,
                                                  {.material = options.settings.material,
                                                   .closed = report.output.topology.closed,
                                                   .unit = options.settings.unit,
                                                   .compression = options.compression}},
                                                 report.output.bytes);
    if (mask) {
        files.push_back(*mask);
    }
    if (options.evolver) {
        files.push_back({*options.evolver, [&](std::ostream& out) {
                             droplet::writeEvolver(out, droplet.meshes, droplet.solution.droplets, droplet.sheets,
                                                   report.physics);
                         }});
    }
    if (options.html) {
        files.push_back({*options.html, [&](std::ostream& out) {
                             if (refill) {
                                 droplet.surface.refill.swap(refill);
                             }
                             writeHtml(out, droplet.surface, options, report);
                         }});
    }
    if (subject) {
        for (OutputFile& file : previewFiles(*options.preview, *subject)) {
            files.push_back(std::move(file));
        }
    }
    if (options.json) {
        files.push_back({*options.json, [&](std::ostream& out) {
                             // The report is the last file, so that it contains the time of the others.
                             report.time = clock.times();
                             report.time_total = clock.total();
                             report.peak_memory = peakMemory();
                             droplet::writeReport(out, report);
                         }});
    }
    writeTogether(files, options.run.files);
    report.time = clock.times();
    report.time_total = clock.total();
    report.peak_memory = peakMemory();
}

/// Reports every stage and measures its time.
struct Stages {
    StageClock clock;
    droplet::Progress progress;

    void begin(Stage stage)
    {
        clock.begin(stage);
        progress(stage);
    }
};

/// Places a droplet on its object, writes its files, and returns the report.
droplet::Report finish(Droplet droplet, const DropletSettings& settings, const droplet::InputReport& input,
                       const Surroundings& around, const ShapeOptions& options, Stages& stages,
                       const std::optional<OutputFile>& mask = std::nullopt)
{
    std::optional<droplet::ObjectReport> onto;
    if (around.object) {
        onto = placeOnObject(droplet, *around.object, *options.settings.onto);
    }
    stages.begin(Stage::Write);
    droplet::Report report = describe(droplet, settings);
    report.fill_range = options.settings.droplet.fill_range;
    report.input = input;
    report.output = describeOutput(droplet.surface, options.output, options.format);
    report.output.compression = options.compression;
    if (options.compression != droplet::Compression::None) {
        report.output.compression_error = droplet::compressionError(droplet.surface, options.compression);
    }
    report.onto = onto;
    std::optional<PreviewSubject> subject;
    if (options.preview) {
        subject.emplace(subjectOf(droplet, settings, around));
    }
    save(droplet, options, subject, mask, stages.clock, report);
    return report;
}

droplet::Report make(const ShapeOptions& options, const Surroundings& around, std::vector<std::byte> picture,
                     Stages& stages)
{
    droplet::MaskOptions mask_options = options.footprint.mask;
    const auto decode = [&] { return droplet::decodeMask(picture, mask_options); };
    droplet::Mask mask = forInput(options, decode);
    DropletSettings settings = forInput(options, [&] { return completeSettings(mask, around, options); });
    if (const auto side = finerSide(mask, settings.droplet)) {
        mask_options.vector_long_side = *side;
        mask = forInput(options, decode);
        settings = completeSettings(mask, around, options);
    }
    picture = {};
    refuseTooShortEdge(coveredArea(mask, settings.droplet.trace), settings.droplet);
    addPageSlider(settings.droplet, options);
    const auto begin = [&](Stage stage) { stages.begin(stage); };
    Droplet droplet = forInput(options, [&] { return droplet::makeDroplet(mask, settings.droplet, begin); });
    droplet::InputReport input = describeInput(mask, droplet.outline, options.input, options.footprint.trace.threshold);
    input.own_size = takesOwnSize(mask, around, options);
    if (auto warning = maskWarning(mask)) {
        settings.warnings.insert(settings.warnings.begin(), std::move(*warning));
    }
    std::optional<OutputFile> mask_file;
    if (options.footprint.mask_out) {
        mask_file = {*options.footprint.mask_out,
                     [&](std::ostream& out) { writeMask(out, mask, settings.droplet.trace); }};
    }
    return finish(std::move(droplet), settings, input, around, options, stages, mask_file);
}

void printSummary(const droplet::Report& report, const RunOptions& run)
{
    if (run.verbosity != Verbosity::Quiet && run.progress != ProgressMode::Json) {
        std::cerr << summary(report, run.verbosity == Verbosity::Verbose) << std::flush;
    }
    const std::size_t printed = run.verbosity == Verbosity::Quiet ? report.severe_warnings : report.warnings.size();
    for (std::size_t i = 0; i < printed; ++i) {
        printWarning(report.warnings[i], run.progress);
    }
}

/// Calls a function at once and whenever a picture is saved, until a signal ends the program. A picture may be half
/// drawn, so what the function throws is printed.
[[noreturn]] void makeWheneverSaved(const std::string& picture, const std::function<void()>& make)
{
    PictureWatch watch(picture);
    for (;; watch.wait()) {
        try {
            make();
        } catch (const Error& error) {
            printError(error.what());
        }
    }
}

}  // namespace

void refuseTooShortEdge(double area, const droplet::DropletOptions& options)
{
    if (!options.mesh.edge) {
        return;
    }
    const double edge = *options.mesh.edge;
    const double equilateral = std::sqrt(3.0) / 4.0 * edge * edge;
    const double triangles = area / equilateral;
    if (triangles > static_cast<double>(kMaxTriangles)) {
        const double min = edge * std::sqrt(triangles / static_cast<double>(kMaxTriangles));
        throw Error(ErrorCode::InvalidArgument,
                    fmt::format("--edge: {:.3g}mm would take {:.3g} triangles on this footprint, must be at least "
                                "{:.3g}mm",
                                edge / droplet::kMillimetre, triangles, min / droplet::kMillimetre));
    }
}

double coveredArea(const droplet::Mask& mask, const droplet::TraceOptions& options)
{
    const double pixel = droplet::pixelSize(mask, options);
    return std::accumulate(mask.coverage.begin(), mask.coverage.end(), 0.0) / 65535.0 * pixel * pixel;
}

droplet::InputReport describeInput(const droplet::Mask& mask, const droplet::Outline& outline, std::string path,
                                   double threshold)
{
    droplet::InputReport input;
    input.path = std::move(path);
    input.width_px = mask.width;
    input.height_px = mask.height;
    input.drawn = mask.raster_scale.has_value();
    input.pixel_size = outline.pixel_size;
    input.channel = mask.channel;
    input.inverted = mask.inverted;
    input.segment = mask.segment;
    input.segment_confidence = mask.segment_confidence;
    input.threshold = threshold;
    input.level_dry = mask.level_dry;
    input.level_liquid = mask.level_liquid;
    input.anti_aliased = outline.anti_aliased;
    input.specks_dropped = outline.specks_dropped;
    input.largest_speck_px = outline.largest_speck_px;
    return input;
}

double coveredArea(const droplet::Outline& outline)
{
    return std::accumulate(outline.loops.begin(), outline.loops.end(), 0.0,
                           [](double sum, const droplet::Loop& loop) { return sum + droplet::signedArea(loop); });
}

std::optional<std::string> groundPicture(const ShapeOptions& options)
{
    return options.preview ? options.preview->ground : std::nullopt;
}

std::optional<std::string> environmentPicture(const ShapeOptions& options)
{
    return options.preview ? options.preview->environment : std::nullopt;
}

std::vector<std::byte> readPicture(const ShapeOptions& options)
{
    return isStream(options.input) ? readStandardInput(options.footprint.mask.max_pixels)
                                   : droplet::readImageBytes(options.input);
}

droplet::Report makeShape(const ShapeOptions& options, const droplet::Progress& progress)
{
    Stages stages{{}, progress};
    stages.begin(Stage::Read);
    const Surroundings around = readSurroundings(options.settings, groundPicture(options), environmentPicture(options));
    return make(options, around, readPicture(options), stages);
}

droplet::Report makeShape(const ShapeOptions& options, const Surroundings& around, std::vector<std::byte> picture)
{
    Stages stages{{}, [](Stage) {}};
    stages.begin(Stage::Read);
    return make(options, around, std::move(picture), stages);
}

droplet::Report makeShape(const ShapeOptions& options, const Surroundings& around, DrawnFootprint footprint,
                          const droplet::Progress& progress)
{
    Stages stages{{}, progress};
    DropletSettings settings = options.settings;
    settings.droplet.solve.ground = groundOf(settings, around, footprint.outline.extent);
    refuseTooShortEdge(coveredArea(footprint.outline), settings.droplet);
    addPageSlider(settings.droplet, options);
    footprint.input.specks_dropped = footprint.outline.specks_dropped;
    Droplet droplet =
        droplet::makeDroplet(std::move(footprint.outline), settings.droplet, [&](Stage stage) { stages.begin(stage); });
    return finish(std::move(droplet), settings, footprint.input, around, options, stages);
}

void checkShape(const ShapeOptions& options, const std::string& input_name)
{
    std::vector<NamedFile> outputs{{"OUTPUT", options.output}};
    if (const auto material = materialFile(options.output, options.format)) {
        outputs.push_back({"OUTPUT's material", *material});
    }
    if (options.json) {
        outputs.push_back({"--json", *options.json});
    }
    if (options.footprint.mask_out) {
        outputs.push_back({"--mask-out", *options.footprint.mask_out});
    }
    if (options.evolver) {
        outputs.push_back({"--export-evolver", *options.evolver});
    }
    if (options.html) {
        outputs.push_back({"--html", *options.html});
    }
    if (options.preview) {
        for (NamedFile& file : previewPaths(*options.preview)) {
            outputs.push_back(std::move(file));
        }
    }
    std::vector<NamedFile> inputs{{input_name, options.input}};
    if (options.run.config) {
        inputs.push_back({"--config", *options.run.config});
    }
    if (options.settings.ground.path) {
        inputs.push_back({"--surface", *options.settings.ground.path});
    }
    if (options.settings.onto) {
        inputs.push_back({"--onto", *options.settings.onto});
    }
    if (const auto picture = groundPicture(options)) {
        inputs.push_back({"--ground", *picture});
    }
    if (const auto picture = environmentPicture(options)) {
        inputs.push_back({"--environment", *picture});
    }
    checkFiles(inputs, outputs, options.run.files);
}

void printWarning(const std::string& warning, ProgressMode progress)
{
    if (progress == ProgressMode::Json) {
        std::cerr << nlohmann::json{{"warning", warning}}.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)
                  << "\n"
                  << std::flush;
        return;
    }
    std::cerr << paint("warning: ", Colour::Yellow) << oneLine(warning) << "\n" << std::flush;
}

void makeAndReport(const RunOptions& run, const std::function<droplet::Report(const droplet::Progress&)>& make)
{
    std::optional<tbb::global_control> threads;
    if (run.threads) {
        threads.emplace(tbb::global_control::max_allowed_parallelism, *run.threads);
    }
    ProgressDisplay progress(
        run.verbosity == Verbosity::Quiet && run.progress == ProgressMode::Auto ? ProgressMode::None : run.progress);
    const droplet::Report report = make([&](Stage stage) { progress.begin(stage); });
    progress.finish();
    printSummary(report, run);
}

int runShape(int argc, const char* const* argv)
{
    const auto parsed = parseShape(argc, argv);
    if (const auto* text = std::get_if<std::string>(&parsed)) {
        print(*text);
        return 0;
    }
    const auto& options = std::get<ShapeOptions>(parsed);
    checkShape(options, "INPUT");
    const auto make = [&] {
        makeAndReport(options.run, [&](const droplet::Progress& progress) { return makeShape(options, progress); });
    };
    if (options.watch) {
        makeWheneverSaved(options.input, make);
    }
    make();
    return 0;
}

}  // namespace cli
