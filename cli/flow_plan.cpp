// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow_plan.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include "droplet/flow/scatter.h"
#include "droplet/flow_io/face_properties.h"
#include "droplet/flow_io/read_flow_start.h"
#include "droplet/flow_io/read_object_motion.h"
#include "droplet/image/height_map.h"
#include "droplet/mask/mask.h"
#include "object_options.h"
#include "option_values.h"

namespace cli {
namespace {

constexpr double kDefaultDuration = 5.0;  // [s]

/// Tells of droplets that lie on one another.
void warnOfCover(const std::vector<droplet::FlowStart>& scattered, const FlowPlan& plan, double area,
                 std::vector<std::string>& warnings)
{
    double covered = 0.0;
    for (const droplet::FlowStart& start : scattered) {
        const double radius = droplet::capOf(start.volume, plan.parameters.forces.wetting.contact_angle).contact_radius;
        covered += std::numbers::pi * radius * radius;
    }
    if (plan.parameters.merges && covered > area) {
        warnings.push_back(fmt::format(
            "--drops: {} droplets cover {:.3g} times the {:.3g} cm2 that they start on, so they merge to fewer and "
            "larger ones at once; give fewer, or a smaller --volume",
            scattered.size(), covered / area, area / 1e-4));
    }
}

std::vector<droplet::FlowStart> startsOf(const FlowOptions& options, const FlowPlan& plan,
                                         std::vector<std::string>& warnings)
{
    std::vector<droplet::FlowStart> starts;
    if (options.preset) {
        starts = options.preset->starts;
    }
    if (options.start) {
        const auto read = droplet::readFlowStart(*options.start);
        starts.insert(starts.end(), read.begin(), read.end());
    }
    if (options.drops > 0) {
        droplet::ScatterOptions scatter;
        scatter.count = options.drops;
        scatter.volumes = options.volumes;
        scatter.from = options.from;
        scatter.seed = plan.parameters.seed;
        std::optional<droplet::Mask> mask;
        if (options.mask) {
            mask = droplet::readMask(*options.mask, {.accept_any = true});
            scatter.coverage = forOption(
                "--mask", [&] { return droplet::coverageOver(*mask, plan.object, plan.terrain().surface()); });
        }
        if (options.reading.weights) {
            scatter.coverage = forOption("--vertex-weights",
                                         [&] { return droplet::weightsOver(plan.object, plan.terrain().surface()); });
        }
        if (options.floor) {
            scatter.coverage = [&plan, inner = scatter.coverage](const droplet::FlowTerrain::Point& point) {
                const bool is_floor = plan.terrain().surface().faces[point.face].source >= plan.floor_begins;
                return is_floor ? 0.0 : inner ? inner(point) : 1.0;
            };
        }
        const auto scattered = forOption("--drops", [&] { return droplet::scatterDroplets(plan.terrain(), scatter); });
        warnOfCover(scattered, plan, droplet::scatterArea(plan.terrain(), scatter), warnings);
        starts.insert(starts.end(), scattered.begin(), scattered.end());
    }
    return starts;
}

/// Length of edges over which faces are as fine as the droplets, or as many as can be afforded: what a droplet wets is
/// known for each face. The paper's own scenes keep their faces.
double longestEdge(const FlowOptions& options, const droplet::FlowSurface& surface)
{
    constexpr double kMostFaces = 150'000.0;
    double area = 0.0;
    for (const droplet::FlowSurface::Face& face : surface.faces) {
        area += 0.5 * length(cross(face.corners[1] - face.corners[0], face.corners[2] - face.corners[0]));
    }
    const double width =
        2.0 * droplet::capOf(options.volumes.median, options.parameters.forces.wetting.contact_angle).contact_radius;
    // Halved, edges are ¾ of the longest on average; a triangle with such sides has an area of about a quarter of its
    // square.
    return std::max(width, std::sqrt(4.0 * area / kMostFaces));
}

/// Files of the shapes that the frames show.
std::vector<std::string> shapesOf(const FlowOptions& options, std::size_t frames)
{
    std::vector<std::string> files = objectFiles(options);
    if (options.shapes && frames > files.size()) {
        throw droplet::Error(
            droplet::ErrorCode::InvalidArgument,
            fmt::format("--time: {} frames need as many meshes, but {} has {}; give at most {:.6g} s", frames,
                        *options.object, files.size(), static_cast<double>(files.size()) / options.frames_per_second));
    }
    files.resize(options.shapes ? frames : files.size());
    return files;
}

droplet::ObjectSampling samplingOf(const FlowOptions& options)
{
    return {options.frames_per_second, {}, options.animation};
}

/// The object in its shapes: one, or one for every frame.
droplet::DeformingObject readShapes(const FlowOptions& options, std::size_t frames)
{
    if (options.preset) {
        return {droplet::presetObject(options.preset->object), {}};
    }
    if (options.shapes || !options.keeps_animation) {
        return droplet::readDeformingObject(shapesOf(options, frames), options.reading);
    }
    droplet::ObjectSampling sampling = samplingOf(options);
    sampling.frames = frames;
    return droplet::readAnimatedObject(*options.object, sampling, options.reading);
}

droplet::FaceProperties groundOf(const FlowOptions& options, const FlowPlan& plan)
{
    std::map<std::string, droplet::MaterialProperties> materials = options.materials;
    if (options.preset) {
        materials.insert(options.preset->materials.begin(), options.preset->materials.end());
    }
    if (!options.roughness_map && !options.friction_map && materials.empty()) {
        return {};
    }
    droplet::FacePropertyOptions ground;
    ground.contact_angle = options.parameters.forces.wetting.contact_angle;
    ground.roughness = options.parameters.roughness;
    ground.max_roughness = options.parameters.roughness;
    if (options.roughness_map) {
        ground.roughness_picture = droplet::readHeightMap(*options.roughness_map);
    }
    if (options.friction_map) {
        ground.friction_picture = droplet::readHeightMap(*options.friction_map);
    }
    ground.materials = std::move(materials);
    std::string given;
    for (const auto& [is_given, option] : {std::pair{options.roughness_map.has_value(), "--roughness-map"},
                                           {options.friction_map.has_value(), "--friction-map"},
                                           {!options.materials.empty(), "--ground"}}) {
        given += is_given ? (given.empty() ? "" : ", ") + std::string(option) : "";
    }
    return forOption(given, [&] { return droplet::faceProperties(plan.object, plan.terrain().surface(), ground); });
}

}  // namespace

std::string nameOfObject(const FlowOptions& options)
{
    return options.preset ? "preset " + options.preset->name : *options.object;
}

std::vector<std::string> objectFiles(const FlowOptions& options)
{
    std::vector<std::string> files;
    if (options.shapes) {
        for (const auto& [number, path] : options.shapes->existing()) {
            files.push_back(path);
        }
    } else if (options.object) {
        files.push_back(*options.object);
    }
    return files;
}

std::size_t frameCount(const FlowOptions& options)
{
    if (options.shapes && !options.duration) {
        return objectFiles(options).size();
    }
    if (!options.duration && options.object && options.keeps_animation) {
        if (const auto frames = droplet::deformingFrames(*options.object, samplingOf(options))) {
            return *frames;
        }
    }
    const double duration = options.duration.value_or(options.preset ? options.preset->duration : kDefaultDuration);
    return std::max<std::size_t>(static_cast<std::size_t>(std::llround(duration * options.frames_per_second)), 1);
}

FlowPlan planOf(const FlowOptions& options)
{
    const std::string name = nameOfObject(options);
    const std::size_t frames = frameCount(options);
    droplet::DeformingObject read = readShapes(options, frames);
    const bool deforms = options.shapes || read.vertices.size() > 1;
    droplet::FlowObject object = std::move(read.object);
    const std::size_t triangles = object.triangles.size();
    const droplet::Vec3 size = sizeOf(object);
    const auto surface_of = [&](const droplet::FlowObject& mesh) {
        return forOption(name, [&] { return droplet::flowSurface(mesh.vertices, mesh.triangles); });
    };
    droplet::FlowSurface surface = surface_of(object);
    faceAs(surface, object);
    if (options.floor) {
        object = onFloor(std::move(object), *options.floor, read.vertices);
        const droplet::FlowSurfaceReport report = surface.report;
        surface = surface_of(object);
        surface.report = report;
    }
    if (!options.preset || options.parameters.model == droplet::FlowModel::Capillary) {
        const double width = longestEdge(options, surface);
        surface = droplet::refined(surface, droplet::hasHoles(object) ? 0.5 * width : width);
    }
    surface = forOption(name, [&] { return droplet::withoutHoles(surface, object); });
    droplet::FlowShapes shapes =
        deforms ? forOption(name,
                            [&] {
                                return droplet::FlowShapes(std::move(surface), object.triangles,
                                                           std::move(read.vertices), options.frames_per_second);
                            })
                : droplet::FlowShapes(std::move(surface));
    FlowPlan plan{std::move(object), std::move(shapes), options.parameters, {}, 1, {}, triangles, size};
    if (deforms) {
        plan.parameters.step = std::min(plan.parameters.step, 1.0 / options.frames_per_second);
    }
    plan.warnings = plan.object.warnings;
    warnOfDefects(plan.terrain().surface().report, name, plan.warnings);
    if (options.keeps_animation && !deforms) {
        plan.parameters.motion = plan.object.motion;
    } else if (options.motion) {
        plan.parameters.motion = droplet::readObjectMotion(*options.motion);
    }
    if (options.floor && !plan.parameters.motion.rests()) {
        throw droplet::Error(droplet::ErrorCode::InvalidArgument,
                             "--floor needs an object that rests; this one moves, and the floor would move with it");
    }
    plan.parameters.ground = groundOf(options, plan);
    plan.starts = startsOf(options, plan, plan.warnings);
    plan.frames = frames;
    return plan;
}

}  // namespace cli
