// SPDX-License-Identifier: GPL-3.0-or-later
#include "compare_command.h"

#include <fmt/core.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include "command_line.h"
#include "common_options.h"
#include "droplet/compare/compare.h"
#include "droplet/compare/comparison_report.h"
#include "droplet/drawing/picture.h"
#include "droplet/error.h"
#include "droplet/io/output.h"
#include "droplet/io/read_surface.h"
#include "droplet/render/paint.h"
#include "droplet/render/render.h"
#include "droplet/units.h"
#include "files.h"
#include "library_message.h"
#include "option_values.h"
#include "run_files.h"
#include "terminal.h"

namespace cli {
namespace {

constexpr Range kTolerance{droplet::Dimension::Length, 1e-15, 1e3, "over 0m, up to 1000m"};
constexpr Range kAngle{droplet::Dimension::Angle, 1e-9, 3.2, "over 0deg, up to 180deg"};

const CommandText& commandText()
{
    static const CommandText text{"droplet-shape compare", "measure the difference of two surfaces", "[OPTIONS] A B",
                                  "Surfaces are .glb, .gltf, .obj, .ply or .stl. With a tolerance, the topologies\n"
                                  "must agree, too, and the exit code says whether both surfaces do.\n"
                                  "\n"
                                  "Examples:\n"
                                  "  droplet-shape compare reference.glb new.glb --tolerance 0.01mm\n"
                                  "  droplet-shape compare coarse.glb fine.glb --json difference.json\n"
                                  "\n"
                                  "Exit codes:\n"
                                  "  0 done, within every tolerance; 1 a tolerance is exceeded, or internal error;\n"
                                  "  2 usage; 3 a surface is unreadable; 4 output cannot be written"};
    return text;
}

struct Options {
    std::string path_a;
    std::string path_b;
    droplet::Tolerances tolerances;
    std::optional<std::string> json;
    std::optional<std::string> picture;
    std::optional<std::string> config;
    std::optional<std::size_t> threads;
    droplet::OutputOptions files;
    bool quiet = false;
};

void declare(CommandLine& line)
{
    line.addArgument("A", "Surface to compare with");
    line.addArgument("B", "Surface to compare");
    constexpr const char* kAllowed = "Allowed";
    line.add(kAllowed, "--tolerance", "LENGTH", "Largest distance of a point of one surface from the other",
             within(kTolerance));
    line.add(kAllowed, "--volume-tolerance", "SHARE", "Largest difference of the volumes, such as 0.1% of A's",
             within(0.0, 1.0));
    line.add(kAllowed, "--normal-tolerance", "ANGLE", "Largest rms angle between normals", within(kAngle));
    constexpr const char* kRun = "Run";
    line.add(kRun, "--json", "FILE", "Write a report; - is standard output");
    line.add(kRun, "--picture", "FILE",
             "Draw A as PNG, coloured by its distance outside or inside B; - is standard output");
    line.addFlag(kRun, "--no-clobber", "Do not replace existing files");
    declareCommon(line, kRun, "tolerance = \"0.01mm\"");
}

/// Parses a share in per cent. The sign is required: a bare number would be ambiguous.
double share(const Given& given)
{
    const std::string& text = given.text;
    const auto number = text.ends_with('%') ? finiteNumber(text.substr(0, text.size() - 1)) : std::optional<double>();
    if (!number || *number < 0.0 || *number > 100.0) {
        refuse(given, "a share from 0% to 100%, such as 0.1%");
    }
    return *number / 100.0;
}

Options readOptions(const CommandLine& line)
{
    Options options;
    options.path_a = line.argument("A");
    options.path_b = line.argument("B");
    for (const std::string& path : {options.path_a, options.path_b}) {
        if (isStream(path)) {
            refuse("'-': surfaces are read from files, not from standard input");
        }
        forOption("'" + path + "'", [&] { return droplet::readableFormat(path); });
    }
    if (const auto tolerance = line.value("--tolerance")) {
        options.tolerances.distance = quantity(*tolerance, kTolerance);
    }
    if (const auto tolerance = line.value("--volume-tolerance")) {
        options.tolerances.volume = share(*tolerance);
    }
    if (const auto tolerance = line.value("--normal-tolerance")) {
        options.tolerances.normals = quantity(*tolerance, kAngle);
    }
    if (const auto json = line.value("--json")) {
        options.json = json->text;
    }
    if (const auto picture = line.value("--picture")) {
        if (!isStream(picture->text) && std::filesystem::path(picture->text).extension() != ".png") {
            refuse(*picture, "a name that ends in .png, or -");
        }
        options.picture = picture->text;
    }
    options.threads = readThreads(line);
    options.files.no_clobber = line.flag("--no-clobber");
    if (const auto config = line.value("--config")) {
        options.config = config->text;
    }
    options.quiet = line.flag("--quiet");
    return options;
}

// -------------------------------------------------------------------------------------------------- the table

std::string millimetres(double metres)
{
    return fmt::format("{:.4g}", metres / droplet::kMillimetre) + " mm";
}

std::string positionText(droplet::Vec3 p)
{
    return "(" + fmt::format("{:.4g}", p.x / droplet::kMillimetre) + ", " +
           fmt::format("{:.4g}", p.y / droplet::kMillimetre) + ", " +
           fmt::format("{:.4g}", p.z / droplet::kMillimetre) + ") mm";
}

/// Row of the table. Columns have one width, counted in characters, not bytes.
std::string row(const std::vector<std::string>& cells)
{
    std::string line;
    for (const std::string& cell : cells) {
        constexpr std::size_t kColumn = 15;
        const auto characters = static_cast<std::size_t>(
            std::count_if(cell.begin(), cell.end(), [](char c) { return (c & 0xC0) != 0x80; }));
        line += cell + std::string(characters < kColumn ? kColumn - characters : 1, ' ');
    }
    return line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
}

std::string shareOf(double a, double b)
{
    return a != 0.0 ? fmt::format("{:+.3g}", 100.0 * (b - a) / std::abs(a)) + " %" : "";
}

std::string topologyOf(const droplet::Topology& topology)
{
    if (!topology.manifold) {
        return "not manifold";
    }
    return (topology.closed ? "closed" : "open") + std::string(", Euler ") + std::to_string(topology.euler);
}

std::string table(const droplet::Comparison& found)
{
    const droplet::SurfaceMeasures& a = found.a;
    const droplet::SurfaceMeasures& b = found.b;
    const double square = droplet::kMillimetre * droplet::kMillimetre;
    std::string lines = row({"", "A", "B", "B − A"});
    lines += row({"triangles", std::to_string(a.triangles), std::to_string(b.triangles)});
    lines += row({"area", fmt::format("{:.5g}", a.area / square) + " mm²",
                  fmt::format("{:.5g}", b.area / square) + " mm²", shareOf(a.area, b.area)});
    lines += row({"volume", fmt::format("{:.5g}", a.volume / droplet::kMicrolitre) + " µL",
                  fmt::format("{:.5g}", b.volume / droplet::kMicrolitre) + " µL", shareOf(a.volume, b.volume)});
    if (a.contact_angle && b.contact_angle) {
        lines +=
            row({"contact angle", fmt::format("{:.2f}", a.contact_angle->mean / droplet::kDegree) + "°",
                 fmt::format("{:.2f}", b.contact_angle->mean / droplet::kDegree) + "°",
                 fmt::format("{:+.2g}", (b.contact_angle->mean - a.contact_angle->mean) / droplet::kDegree) + "°"});
    }
    lines +=
        row({"topology", topologyOf(a.topology), topologyOf(b.topology), found.same_topology ? "same" : "differs"});
    lines += row({"components", std::to_string(a.topology.components), std::to_string(b.topology.components)});
    lines += "\n" + row({"", "A from B", "B from A", "either"});
    const auto over = [&](const char* name, const auto& value) {
        lines += row({name, value(found.from_a), value(found.from_b), value(found.symmetric)});
    };
    over("distance, from", [](const droplet::SurfaceDistance& d) { return millimetres(d.lower); });
    over("  to", [](const droplet::SurfaceDistance& d) { return millimetres(d.upper); });
    over("  rms", [](const droplet::SurfaceDistance& d) { return millimetres(d.rms); });
    over("  mean", [](const droplet::SurfaceDistance& d) { return millimetres(d.mean); });
    const auto angle = [](double radians) { return fmt::format("{:.3g}", radians / droplet::kDegree) + "°"; };
    lines +=
        row({"normals, rms", angle(found.normals_of_a.rms), angle(found.normals_of_b.rms), angle(found.normals.rms)});
    lines += row({"  largest", angle(found.normals_of_a.largest), angle(found.normals_of_b.largest),
                  angle(found.normals.largest)});
    lines += "farthest at " + positionText(found.symmetric.at) + "\n";
    return lines;
}

/// Moves a surface's lowest point to height 0. Vertices are not welded, so that repeated vertices do not become a rim.
droplet::Surface placedOnGround(droplet::Surface surface)
{
    std::iota(surface.weld.begin(), surface.weld.end(), 0U);
    const auto lowest = std::min_element(surface.vertices.begin(), surface.vertices.end(),
                                         [](const droplet::Vec3& a, const droplet::Vec3& b) { return a.z < b.z; });
    const double ground = lowest->z;
    for (droplet::Vec3& position : surface.vertices) {
        position.z -= ground;
    }
    return surface;
}

/// Compares two files, and writes and prints the result.
/// @return  exit code
int compareFiles(const Options& options)
{
    std::optional<tbb::global_control> limit;
    if (options.threads) {
        limit.emplace(tbb::global_control::max_allowed_parallelism, *options.threads);
    }

    const droplet::ReadSurface a = droplet::readSurface(options.path_a);
    const droplet::ReadSurface b = droplet::readSurface(options.path_b);
    droplet::ComparisonReport report{options.path_a, options.path_b, {}, options.tolerances, {}, a.warnings};
    report.warnings.insert(report.warnings.end(), b.warnings.begin(), b.warnings.end());
    droplet::CompareOptions compare_options;
    compare_options.tolerance = options.tolerances.distance;
    report.comparison = droplet::compare(a.surface, b.surface, compare_options);
    report.exceeded = droplet::exceeded(report.comparison, options.tolerances);

    std::vector<OutputFile> files;
    if (options.json) {
        files.push_back({*options.json, [&](std::ostream& out) { writeComparison(out, report); }});
    }
    droplet::Picture picture;
    if (options.picture) {
        droplet::RenderOptions scene;
        scene.paint = droplet::differencePaint(a.surface, b.surface);
        picture = droplet::render(placedOnGround(a.surface), scene);
        files.push_back({*options.picture, [&](std::ostream& out) { writePng(picture, out); }});
    }
    if (!files.empty()) {
        writeTogether(files, options.files);
    }
    if (!options.quiet) {
        for (const std::string& warning : report.warnings) {
            std::cerr << paint("warning: ", Colour::Yellow) << oneLine(warning) << '\n';
        }
        const auto is_output = [](const std::optional<std::string>& path) { return path && isStream(*path); };
        if (!is_output(options.json) && !is_output(options.picture)) {
            print(table(report.comparison));
        }
    }
    if (!report.exceeded.empty()) {
        std::string differences;
        for (const std::string& one : report.exceeded) {
            differences += (differences.empty() ? "" : "; ") + one;
        }
        std::cerr << paint("droplet-shape: ", Colour::Red)
                  << oneLine(options.path_a + " and " + options.path_b + " differ: " + differences) << std::endl;
        return 1;
    }
    return 0;
}

}  // namespace

int runCompare(int argc, const char* const* argv)
{
    CommandLine line(commandText());
    declare(line);
    line.parse(argc, argv);
    if (const auto text = requestedText(line)) {
        print(*text);
        return 0;
    }
    const Options options = readOptions(line);
    RunFiles run;
    run.reads("A", options.path_a);
    run.reads("B", options.path_b);
    run.reads("--config", options.config);
    run.writes("--json", options.json);
    run.writes("--picture", options.picture);
    checkFiles(run, options.files);
    return inTermsOf(line.terms(), run, [&] { return compareFiles(options); });
}

}  // namespace cli
