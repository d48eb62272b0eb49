// SPDX-License-Identifier: GPL-3.0-or-later
// Droplets of footprints by the rules of the command, whose words are the options.
#include <tbb/global_control.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <sstream>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "droplet/error.h"
#include "droplet/io/report.h"
#include "droplet/mask/mask.h"
#include "droplet_report.h"
#include "guarded.h"
#include "mask_shape.h"
#include "option_values.h"
#include "run_files.h"
#include "shape_command.h"
#include "shape_options.h"
#include "stage_clock.h"
#include "surface_files.h"
#include "surroundings.h"
#include "this_process.h"

using binding::guarded;
using binding::required;
using droplet::Error;
using droplet::ErrorCode;

struct DropletShape {
    cli::ShapeOptions options;
    cli::MadeShape made;
    std::optional<droplet::ObjectStand> object = {};  ///< that files have, too
    cli::DescribedShape described = {};
    std::string report = {};
    std::vector<float> positions = {};
    std::vector<float> normals = {};
    std::vector<float> uvs = {};
    std::vector<float> contact_angles = {};
    std::vector<std::uint32_t> indices = {};
};

namespace {

struct Words {
    const char* const* list = nullptr;
    std::size_t count = 0;
};

cli::ShapeOptions parsed(const char* input, const Words& words)
{
    std::vector<const char*> all{"droplet-shape"};
    if (words.count > 0) {
        required("options", words.list);
    }
    for (const char* word : std::span(words.list, words.count)) {
        all.push_back(required("options", word));
    }
    all.insert(all.end(), {"--", input, "droplet.glb"});
    auto result = cli::parseShape(static_cast<int>(all.size()), all.data());
    auto* const options = std::get_if<cli::ShapeOptions>(&result);
    if (options == nullptr) {
        throw Error(ErrorCode::InvalidArgument, "options: help and version are texts of the command alone");
    }
    if (options->json || options->evolver || options->html || options->preview || options->maps || options->watch ||
        options->footprint.mask_out) {
        throw Error(
            ErrorCode::InvalidArgument,
            "options: --json, --export-evolver, --html, --preview, --maps, --watch and --mask-out are of the command "
            "alone");
    }
    return std::move(*options);
}

template <typename Vector>
std::vector<float> floats(const std::vector<Vector>& vectors)
{
    std::vector<float> result;
    for (const Vector& v : vectors) {
        result.push_back(static_cast<float>(v.x));
        result.push_back(static_cast<float>(v.y));
        if constexpr (sizeof(Vector) == 3 * sizeof(double)) {
            result.push_back(static_cast<float>(v.z));
        }
    }
    return result;
}

/// Makes droplets, with as many threads as the options say.
template <typename Make>
DropletShape* madeBy(const Words& words, const char* input, const Make& make)
{
    cli::StageClock clock;
    cli::ShapeOptions options = parsed(input, words);
    std::optional<tbb::global_control> limit;
    if (options.run.threads) {
        limit.emplace(tbb::global_control::max_allowed_parallelism, *options.run.threads);
    }
    cli::Surroundings around = cli::readSurroundings(options.settings);
    cli::MadeShape made = make(options, around);
    auto shape = std::make_unique<DropletShape>(DropletShape{std::move(options), std::move(made)});
    if (shape->options.settings.with_object) {
        shape->object = std::move(around.object);
    }
    shape->described = cli::describe(shape->made, shape->options);
    const droplet::Surface& surface = shape->made.droplet.surface;
    droplet::Report& report = shape->described.report;
    report.output = cli::describeOutput(surface, "", droplet::Format::Glb);
    report.time_total = clock.total();
    report.peak_memory = cli::peakMemory();
    std::ostringstream json;
    droplet::writeReport(json, report);
    shape->report = std::move(json).str();
    shape->positions = floats(surface.vertices);
    shape->normals = floats(surface.normals);
    shape->uvs = floats(surface.uvs);
    shape->contact_angles.assign(surface.contact_angle.begin(), surface.contact_angle.end());
    for (const auto& triangle : surface.triangles) {
        shape->indices.insert(shape->indices.end(), triangle.begin(), triangle.end());
    }
    return shape.release();
}

droplet::Mask maskOf(const DropletMask& given)
{
    if (given.width <= 0 || given.height <= 0) {
        throw Error(ErrorCode::InvalidArgument, "mask.width, mask.height: " + std::to_string(given.width) + " x " +
                                                    std::to_string(given.height) + " must be at least 1 x 1");
    }
    droplet::Mask mask;
    mask.width = given.width;
    mask.height = given.height;
    const std::span<const std::uint8_t> levels(
        required("mask.coverage", given.coverage),
        static_cast<std::size_t>(given.width) * static_cast<std::size_t>(given.height));
    mask.coverage.resize(levels.size());
    std::transform(levels.begin(), levels.end(), mask.coverage.begin(),
                   [](std::uint8_t level) { return static_cast<std::uint16_t>(257 * level); });
    return mask;
}

cli::MadeShape madeOf(droplet::Mask mask, const cli::ShapeOptions& options, const cli::Surroundings& around)
{
    if (options.footprint.by_colour) {
        throw Error(ErrorCode::InvalidArgument, "options: --by-colour needs a picture's file; a mask has no colours");
    }
    if (options.footprint.mask.invert) {
        cli::invert(mask);
    }
    cli::DropletSettings settings = cli::completeSettings(mask, around, options);
    cli::MaskShape made = cli::makeOfMask(mask, settings, options, [](droplet::Stage, double) {});
    if (auto warning = cli::maskWarning(mask, "look at it")) {
        settings.warnings.insert(settings.warnings.begin(), std::move(*warning));
    }
    return cli::placed(
        {.droplet = std::move(made.droplet), .settings = std::move(settings), .input = std::move(made.input)}, around);
}

}  // namespace

DropletCode droplet_shape_of_file(const char* path, const char* const* options, size_t count, DropletShape** made)
{
    return guarded([&] {
        required("made", made);
        *made = madeBy({options, count}, required("path", path),
                       [](const cli::ShapeOptions& parsed_options, const cli::Surroundings& around) {
                           return cli::makeOfPicture(parsed_options, around, cli::readPicture(parsed_options));
                       });
    });
}

DropletCode droplet_shape_of_mask(const DropletMask* mask, const char* const* options, size_t count,
                                  DropletShape** made)
{
    return guarded([&] {
        required("made", made);
        droplet::Mask own = maskOf(*required("mask", mask));
        *made = madeBy({options, count}, "mask",
                       [&](const cli::ShapeOptions& parsed_options, const cli::Surroundings& around) {
                           return madeOf(std::move(own), parsed_options, around);
                       });
    });
}

void droplet_shape_delete(DropletShape* shape)
{
    delete shape;
}

DropletCode droplet_shape_mesh(const DropletShape* shape, DropletMesh* mesh)
{
    return guarded([&] {
        required("shape", shape);
        *required("mesh", mesh) = {shape->positions.size() / 3,
                                   shape->positions.data(),
                                   shape->normals.data(),
                                   shape->uvs.data(),
                                   shape->contact_angles.empty() ? nullptr : shape->contact_angles.data(),
                                   shape->indices.size() / 3,
                                   shape->indices.data()};
    });
}

DropletCode droplet_shape_report(const DropletShape* shape, const char** json)
{
    return guarded([&] { *required("json", json) = required("shape", shape)->report.c_str(); });
}

DropletCode droplet_shape_write(const DropletShape* shape, const char* path)
{
    return guarded([&] {
        required("shape", shape);
        const cli::DropletSettings& settings = shape->made.settings;
        cli::SurfaceTarget target{required("path", path), {}, {}};
        target.format = cli::formatOf(target.path, "path");
        target.options = {.material = settings.material,
                          .closed = shape->described.report.output.topology.closed,
                          .unit = settings.unit,
                          .nodes = settings.nodes,
                          .droplets = shape->described.droplets,
                          .texture = cli::textureOf(shape->made)};
        if (shape->object && droplet::isAnimated(target.format)) {
            target.object = &*shape->object;
        }
        if (target.format == droplet::Format::Glb) {
            target.options.compression = shape->options.compression;
        }
        std::uint64_t bytes = 0;
        cli::writeTogether(cli::surfaceFiles(shape->made.droplet.surface, target, bytes), shape->options.run.files);
    });
}
