// SPDX-License-Identifier: GPL-3.0-or-later
#include "dew_run.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "dew_picture.h"
#include "droplet/error.h"
#include "droplet/flow_io/face_properties.h"
#include "droplet/flow_io/flow_table.h"
#include "droplet/mask/mask.h"
#include "files.h"
#include "object_options.h"
#include "option_values.h"
#include "seconds.h"
#include "stage_clock.h"
#include "surface_files.h"
#include "terminal.h"
#include "this_process.h"

namespace cli {
namespace {

droplet::DewDroplets placed(const droplet::FlowTerrain& terrain, const droplet::DewOptions& dew,
                            const std::string& object, const droplet::Progress& progress)
{
    try {
        return droplet::dewDroplets(terrain, dew, progress);
    } catch (const droplet::Error& error) {
        const bool is_of_object = error.code() == droplet::ErrorCode::InvalidInput;
        throw droplet::Error(error.code(),
                             (is_of_object ? object : "--coverage, --smallest, --largest") + ": " + error.what());
    }
}

/// What is in the way of more droplets, and what to do.
std::string hindranceOf(droplet::DewObstacle obstacle)
{
    switch (obstacle) {
        case droplet::DewObstacle::Slopes:
            return "more would run off slopes; give smaller ones, or more --hysteresis";
        case droplet::DewObstacle::Edges:
            return "more find no place between the object's edges; give smaller ones";
        case droplet::DewObstacle::Droplets:
        case droplet::DewObstacle::None:
            break;
    }
    return "more find no room between the others; give a --smallest that is less";
}

/// Why much less of the surface is covered than asked for, if it is.
std::optional<std::string> warnOfCoverage(const droplet::DewReport& report, const droplet::DewDroplets& droplets)
{
    constexpr double kMuchLess = 0.9;
    const double least = kMuchLess * report.options.coverage * report.area;
    if (report.covered >= least) {
        return std::nullopt;
    }
    const std::string why = droplets.covered >= least
                                ? fmt::format(
                                      "{} droplets are left out where the object bends too much; give smaller "
                                      "ones",
                                      report.left_out)
                                : hindranceOf(droplets.obstacle);
    return fmt::format("--coverage: {:.3g} of the surface is covered instead of {:.3g}: {}",
                       report.covered / report.area, report.options.coverage, why);
}

}  // namespace

std::string lostOf(const droplet::DewReport& report)
{
    return fmt::format(
        "{} joined others; {} ran off; {} too large between edges; {} left out, where the object bends "
        "too much",
        report.joined, report.run_off, report.between_edges, report.left_out);
}

RunFiles filesOf(const DewCommandOptions& options)
{
    RunFiles files;
    files.reads("OBJECT", options.object);
    files.reads("--mask", options.mask);
    files.reads("--config", options.run.config);
    files.writes("OUTPUT", options.output);
    files.writes("OUTPUT's material", materialFile(options.output, options.file.file.format));
    files.writes("--droplets", options.droplets);
    if (options.preview) {
        files.reads("--environment", options.preview->environment);
        for (const std::string& path : previewPaths(*options.preview)) {
            files.writes("--preview", path);
        }
    }
    files.writes("--json", options.json);
    return files;
}

Dew placeDew(const DewCommandOptions& options, const droplet::Progress& progress)
{
    const auto begin = [&](droplet::Stage stage) {
        if (progress) {
            progress(stage, 0.0);
        }
    };
    begin(droplet::Stage::Read);
    droplet::FlowObject object = droplet::readFlowObject(options.object, options.reading);
    droplet::FlowSurface faces =
        forOption(options.object, [&] { return droplet::flowSurface(object.vertices, object.triangles); });
    faceAs(faces, object);
    if (droplet::hasHoles(object)) {
        faces = forOption(options.object, [&] {
            return droplet::withoutHoles(droplet::refined(faces, 2.0 * options.dew.smallest), object);
        });
    }
    droplet::FlowTerrain terrain(std::move(faces));
    droplet::DewOptions dew = options.dew;
    std::optional<droplet::Mask> mask;
    if (options.mask) {
        mask = droplet::readMask(*options.mask, {.accept_any = true});
        dew.weight = forOption("--mask", [&] { return droplet::coverageOver(*mask, object, terrain.surface()); });
    }
    if (options.reading.weights) {
        dew.weight = forOption("--vertex-weights", [&] { return droplet::weightsOver(object, terrain.surface()); });
    }
    droplet::DropletBodies bodies(droplet::BodyShape::Capillary, dew.forces);
    dew.extent = droplet::dewExtents(bodies, dew.gravity, options.detail);
    const droplet::DewDroplets droplets = placed(terrain, dew, options.object, progress);
    begin(droplet::Stage::Loft);
    droplet::DewModel model(terrain, droplets.samples, bodies, dew.gravity, options.detail);

    std::vector<droplet::FlowSample> shown;
    for (const std::size_t i : model.shown()) {
        shown.push_back(droplets.samples[i]);
    }
    droplet::DewReport report;
    report.input = options.object;
    report.surface = terrain.surface().report;
    report.size = sizeOf(object);
    report.output = options.output;
    if (droplet::isAnimated(options.file.file.format)) {
        report.instancing = model.instancingIn(options.file);
    }
    report.preset = options.preset;
    report.options = options.dew;
    report.area = droplets.area;
    report.droplets = shown.size();
    report.joined = droplets.joined;
    report.run_off = droplets.run_off;
    report.between_edges = droplets.between_edges;
    report.left_out = droplets.samples.size() - shown.size();
    report.warnings = object.warnings;
    warnOfDefects(report.surface, oneLine(options.object), report.warnings);
    if (shown.empty()) {
        throw droplet::Error(
            droplet::ErrorCode::InvalidInput,
            options.object + ": no droplet of this size rests on it: " + lostOf(report) +
                "; give smaller droplets, more --hysteresis, or the object its real size by --object-size");
    }
    for (const droplet::FlowSample& sample : shown) {
        const double radius = droplet::dewRadius(sample.volume, dew.forces.wetting.contact_angle);
        report.volume += sample.volume;
        report.covered += std::numbers::pi * radius * radius;
        report.smallest = report.smallest == 0.0 ? radius : std::min(report.smallest, radius);
        report.largest = std::max(report.largest, radius);
    }
    if (const auto warning = warnOfCoverage(report, droplets)) {
        report.warnings.push_back(*warning);
    }
    return {std::move(object), std::move(terrain), std::move(bodies),
            std::move(model),  std::move(shown),   std::move(report)};
}

droplet::Surface surfaceFor(droplet::Format format, const Dew& dew, const droplet::ObjectOptions& reading)
{
    droplet::Surface surface = dew.model.surface();
    turnToFile(surface, format, reading);
    return surface;
}

void writeTable(std::ostream& out, droplet::TableFormat format, const Dew& dew)
{
    droplet::FlowTable table(out, format);
    table.add(1, 0.0, droplet::flowPoints(dew.shown, dew.terrain, dew.bodies, dew.report.options.gravity));
    table.finish();
}

droplet::DewReport makeDew(const DewCommandOptions& options, const droplet::Progress& progress)
{
    const StageClock clock;
    if (options.preview) {
        checkVideo(*options.preview);
    }
    Dew dew = placeDew(options, progress);
    if (progress) {
        progress(droplet::Stage::Write, 0.0);
    }
    const auto finish = [&] {
        dew.report.time_total = clock.total();
        dew.report.peak_memory = peakMemory();
    };
    std::vector<OutputFile> files;
    droplet::Surface surface;
    std::uint64_t bytes = 0;
    const droplet::Format format = options.file.file.format;
    if (droplet::isAnimated(format)) {
        files.push_back({options.output, [&](std::ostream& out) { dew.model.write(dew.object, out, options.file); }});
    } else {
        surface = surfaceFor(format, dew, options.reading);
        SurfaceTarget target{options.output, format, {}};
        target.options.material = options.file.material;
        files = surfaceFiles(surface, target, bytes);
    }
    if (options.droplets) {
        files.push_back({*options.droplets, [&](std::ostream& out) {
                             const bool is_json = lowerExtension(*options.droplets) == ".json";
                             writeTable(out, is_json ? droplet::TableFormat::Json : droplet::TableFormat::Csv, dew);
                         }});
    }
    if (options.preview) {
        const std::vector<OutputFile> pictures = dewPictures(dew, *options.preview, options.file.material);
        files.insert(files.end(), pictures.begin(), pictures.end());
    }
    if (options.json) {
        files.push_back({*options.json, [&](std::ostream& out) {
                             finish();
                             writeDewReport(out, dew.report);
                         }});
    }
    writeTogether(files, options.run.files);
    finish();
    return std::move(dew.report);
}

}  // namespace cli
