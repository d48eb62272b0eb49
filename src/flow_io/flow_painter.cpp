// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/flow_io/flow_painter.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "droplet/error.h"
#include "droplet/flow_io/droplet_surfaces.h"
#include "droplet/render/object_stand.h"
#include "flow_io/box_of.h"
#include "flow_io/object_faces.h"
#include "flow_io/settled_droplets.h"
#include "flow_io/wet_spots.h"
#include "render/camera.h"
#include "require.h"

namespace droplet {
namespace {

constexpr double kMostDivisions = 2048;

double areaOf(const TexturedMesh& mesh)
{
    double area = 0.0;
    for (const Triangle& triangle : mesh.triangles) {
        const Vec3 a = mesh.vertices[triangle[0]];
        area += 0.5 * length(cross(mesh.vertices[triangle[1]] - a, mesh.vertices[triangle[2]] - a));
    }
    return area;
}

}  // namespace

void FlowPainterOptions::validate() const
{
    film.validate();
    RenderOptions checked = render;
    checked.stand.reset();
    checked.stand_water.reset();
    checked.extent = {1.0, 1.0};
    checked.validate();
}

std::optional<ViewBox> framedOver(const FlowObject& object, const ObjectMotion& motion, double duration)
{
    if (motion.rests()) {
        return {};
    }
    constexpr int kPoses = 96;
    std::vector<Vec3> corners;
    for (int k = 0; k <= kPoses; ++k) {
        const ObjectPose pose = motion.at(duration * k / kPoses);
        std::vector<Vec3> moved;
        for (const Vec3 p : object.vertices) {
            moved.push_back(pose.place + pose.toWorld(p));
        }
        const ViewBox box = boxOf(moved);
        corners.insert(corners.end(), {box.low, box.high});
    }
    return boxOf(corners);
}

std::optional<ViewBox> framedOver(const FlowShapes& shapes)
{
    if (shapes.count() == 1) {
        return {};
    }
    std::vector<Vec3> corners;
    for (std::size_t shape = 0; shape < shapes.count(); ++shape) {
        const ViewBox box = boxOf(shapes.vertices(shape));
        corners.insert(corners.end(), {box.low, box.high});
    }
    return boxOf(corners);
}

struct FlowPainter::Content {
    Content(const FlowObject& object, const FlowTerrain& of, const FlowPainterOptions& given)
        : terrain(&of), options(given), faces(of.surface()), box(boxOf(object.vertices))
    {
        RenderOptions& render = options.render;
        render.extent = {1.0, 1.0};
        FlowObject own = onFaces(object, terrain->surface());
        stand.mesh = {std::move(own.vertices), std::move(own.normals),
                      own.uvs.empty() ? std::vector<Vec2>(3 * own.triangles.size()) : std::move(own.uvs),
                      std::move(own.triangles)};
        stand.is_open = terrain->surface().report.boundary_edges > 0;
        if (!object.looks.empty() && !own.materials.empty()) {
            stand.looks = object.looks;
            stand.materials = std::move(own.materials);
            stand.colours = std::move(own.colours);
        }
        stand.showIn(render);
        water.divisions.resize(stand.mesh.triangles.size());
        water.first.resize(stand.mesh.triangles.size());
        spots.middle = 0.5 * (box.low + box.high);
        // About one place for a pixel, also of a camera that is near.
        spots.spacing = length(box.high - box.low) / std::max(render.width, render.height);
        if (render.distance) {
            constexpr double kMostPlaces = 6e6;
            spots.spacing = std::min(spots.spacing, std::max(*render.distance * pixelAngle(render),
                                                             std::sqrt(areaOf(stand.mesh) / kMostPlaces)));
        }
        for (std::uint32_t face = 0; face < stand.mesh.triangles.size(); ++face) {
            addPlaces(face);
        }
        spots.first.push_back(static_cast<std::uint32_t>(spots.places.size()));
        water.film.resize(spots.places.size());
        wet.emplace(spots.places.size(), options.film);
    }

    void addPlaces(std::uint32_t triangle)
    {
        const Vec3 a = stand.mesh.vertices[stand.mesh.triangles[triangle][0]];
        const Vec3 p = stand.mesh.vertices[stand.mesh.triangles[triangle][1]] - a;
        const Vec3 q = stand.mesh.vertices[stand.mesh.triangles[triangle][2]] - a;
        const double longest = std::max({length(p), length(q), length(q - p)});
        const auto n = static_cast<std::uint32_t>(std::clamp(std::ceil(longest / spots.spacing), 1.0, kMostDivisions));
        water.divisions[triangle] = static_cast<std::uint16_t>(n);
        water.first[triangle] = static_cast<std::uint32_t>(spots.places.size());
        spots.first.push_back(water.first[triangle]);
        for (std::uint32_t j = 0; j <= n; ++j) {
            for (std::uint32_t i = 0; i + j <= n; ++i) {
                spots.add(a + static_cast<double>(i) / n * p + static_cast<double>(j) / n * q);
            }
        }
    }

    [[nodiscard]] std::vector<bool> shownOf(std::span<const FlowSample> samples) const
    {
        const Vec3 margin = length(box.high - box.low) * Vec3{1.0, 1.0, 1.0};
        const Vec3 low = box.low - margin;
        const Vec3 high = box.high + margin;
        std::vector<bool> shown;
        for (const FlowSample& sample : samples) {
            const Vec3 p = sample.place;
            shown.push_back(p.x > low.x && p.y > low.y && p.z > low.z && p.x < high.x && p.y < high.y && p.z < high.z);
        }
        return shown;
    }

    const FlowTerrain* terrain;  // of the shape that is shown
    FlowPainterOptions options;
    FacesAround faces;
    ViewBox box;  // around the object
    ObjectStand stand;
    WetSpots spots;  // on the first shape
    StandWater water;
    std::optional<WetPlaces> wet;
};

FlowPainter::FlowPainter(const FlowObject& object, const FlowTerrain& terrain, const FlowPainterOptions& options)
{
    options.validate();
    if (options.render.ground && object.uvs.empty()) {
        throw Error(ErrorCode::InvalidArgument,
                    "a texture needs an object with texture coordinates (uv), but this one has none");
    }
    content_ = std::make_unique<Content>(object, terrain, options);
}
FlowPainter::~FlowPainter() = default;
FlowPainter::FlowPainter(FlowPainter&&) noexcept = default;
FlowPainter& FlowPainter::operator=(FlowPainter&&) noexcept = default;

void FlowPainter::add(std::span<const FlowTrack> tracks)
{
    wetTracks(content_->spots, tracks, content_->faces, *content_->wet);
}

void FlowPainter::reshape(const FlowObject& object, const FlowTerrain& terrain)
{
    Content& c = *content_;
    c.terrain = &terrain;
    c.box = boxOf(object.vertices);
    FlowObject own = onFaces(object, terrain.surface());
    c.stand.mesh.vertices = std::move(own.vertices);
    c.stand.mesh.normals = std::move(own.normals);
    c.stand.showIn(c.options.render);
}

Picture FlowPainter::picture(const FlowMoment& moment, std::span<const FlowSample> samples, const Surface& droplets)
{
    return picture(moment, settled(*content_->terrain, samples, droplets, content_->shownOf(samples)));
}

Picture FlowPainter::picture(const FlowMoment& moment, SettledDroplets water)
{
    Content& c = *content_;
    RenderOptions render = c.options.render;
    render.azimuth += moment.azimuth;
    render.stand_water = c.water;
    render.stand_water->bases = std::move(water.bases);
    std::vector<float>& film = render.stand_water->film;
    tbb::parallel_for(std::size_t{0}, film.size(), [&](std::size_t spot) {
        film[spot] = static_cast<float>(c.wet->thickness(spot, c.spots.place(spot), moment.time));
    });
    const auto move = [&](std::vector<Vec3>& places, std::vector<Vec3>& directions) {
        for (Vec3& p : places) {
            p = moment.pose.place + moment.pose.toWorld(p);
        }
        for (Vec3& d : directions) {
            d = moment.pose.toWorld(d);
        }
    };
    move(render.stand->vertices, render.stand->normals);
    move(water.surface.vertices, water.surface.normals);
    for (DropletBase& base : render.stand_water->bases) {
        base.place = moment.pose.place + moment.pose.toWorld(base.place);
        base.ahead = moment.pose.toWorld(base.ahead);
        base.normal = moment.pose.toWorld(base.normal);
    }
    return droplet::render(water.surface, render);
}

std::string FlowPainter::bytes() const
{
    return content_->wet->bytes();
}

void FlowPainter::restore(std::string_view bytes, const std::string& name)
{
    content_->wet->restore(bytes, name);
}

}  // namespace droplet
