// SPDX-License-Identifier: GPL-3.0-or-later
#include "dew_command.h"

#include <fmt/core.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "dew_options.h"
#include "droplet/body/droplet_body.h"
#include "droplet/error.h"
#include "droplet/flow_io/face_properties.h"
#include "droplet/flow_io/flow_table.h"
#include "droplet/mask/mask.h"
#include "files.h"
#include "object_options.h"
#include "option_values.h"
#include "run_command.h"
#include "run_files.h"
#include "surface_files.h"
#include "terminal.h"

namespace cli {
namespace {

RunFiles filesOf(const DewCommandOptions& options)
{
    RunFiles files;
    files.reads("OBJECT", options.object);
    files.reads("--mask", options.mask);
    files.reads("--config", options.run.config);
    files.writes("OUTPUT", options.output);
    files.writes("OUTPUT's material", materialFile(options.output, options.file.file.format));
    files.writes("--droplets", options.droplets);
    return files;
}

droplet::DewDroplets placed(const droplet::FlowTerrain& terrain, const droplet::DewOptions& dew,
                            const std::string& object)
{
    try {
        return droplet::dewDroplets(terrain, dew);
    } catch (const droplet::Error& error) {
        const bool is_of_object = error.code() == droplet::ErrorCode::InvalidInput;
        throw droplet::Error(error.code(),
                             (is_of_object ? object : "--coverage, --smallest, --largest") + ": " + error.what());
    }
}

RunEnd made(const DewCommandOptions& options)
{
    const droplet::FlowObject object = droplet::readFlowObject(options.object, options.reading);
    const droplet::FlowTerrain terrain(
        forOption(options.object, [&] { return droplet::flowSurface(object.vertices, object.triangles); }));
    droplet::DewOptions dew = options.dew;
    std::optional<droplet::Mask> mask;
    if (options.mask) {
        mask = droplet::readMask(*options.mask);
        dew.weight = forOption("--mask", [&] { return droplet::coverageOver(*mask, object, terrain.surface()); });
    }
    const droplet::DewDroplets droplets = placed(terrain, dew, options.object);
    const droplet::DropletBodies bodies(droplet::BodyShape::Capillary, dew.forces);
    const droplet::DewModel model(terrain, droplets.samples, bodies, dew.gravity, options.detail);

    std::vector<droplet::FlowSample> shown;
    for (const std::size_t i : model.shown()) {
        shown.push_back(droplets.samples[i]);
    }
    const std::string lost = fmt::format("{} joined others; {} ran off; {} left out, where the object bends too much",
                                         droplets.joined, droplets.run_off, droplets.samples.size() - shown.size());
    if (shown.empty()) {
        throw droplet::Error(droplet::ErrorCode::InvalidInput,
                             options.object + ": no droplet of this size rests on it: " + lost +
                                 "; give smaller droplets, more --hysteresis, or the object its real size");
    }
    std::vector<OutputFile> files;
    droplet::Surface surface;
    std::uint64_t bytes = 0;
    const droplet::Format format = options.file.file.format;
    if (droplet::isAnimated(format)) {
        files.push_back({options.output, [&](std::ostream& out) { model.write(object, out, options.file); }});
    } else {
        surface = model.surface();
        turnToFile(surface, format, options.reading);
        SurfaceTarget target{options.output, format, {}};
        target.options.material = options.file.material;
        files = surfaceFiles(surface, target, bytes);
    }
    if (options.droplets) {
        files.push_back({*options.droplets, [&](std::ostream& out) {
                             const bool is_json = lowerExtension(*options.droplets) == ".json";
                             droplet::FlowTable table(out,
                                                      is_json ? droplet::TableFormat::Json : droplet::TableFormat::Csv);
                             table.add(1, 0.0, droplet::flowPoints(shown, terrain, bodies, dew.gravity));
                             table.finish();
                         }});
    }
    writeTogether(files, options.run.files);

    double volume = 0.0;
    double covered = 0.0;
    for (const droplet::FlowSample& sample : shown) {
        volume += sample.volume;
        covered += std::numbers::pi * std::pow(droplet::dewRadius(sample.volume, dew.forces.wetting.contact_angle), 2);
    }
    RunEnd end;
    end.summary =
        fmt::format("{} droplet{}, {:.4g} mL, cover {:.3g} of {:.4g} cm2\n{}\n", shown.size(),
                    shown.size() == 1 ? "" : "s", volume / 1e-6, covered / droplets.area, droplets.area / 1e-4, lost) +
        oneLine(options.output) + "\n";
    end.warnings = object.warnings;
    return end;
}

}  // namespace

int runDew(int argc, const char* const* argv)
{
    const auto parsed = parseDew(argc, argv);
    if (const auto* text = std::get_if<std::string>(&parsed)) {
        print(*text);
        return 0;
    }
    const auto& options = std::get<DewCommandOptions>(parsed);
    checkFiles(filesOf(options), options.run.files);
    runAndTell(options.run, [&](ProgressDisplay&) { return made(options); });
    return 0;
}

}  // namespace cli
