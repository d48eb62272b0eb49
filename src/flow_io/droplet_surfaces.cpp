// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/flow_io/droplet_surfaces.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include "flow/flow_terrain_content.h"
#include "flow/following.h"
#include "flow_io/pond_surface.h"
#include "flow_io/seat.h"
#include "flow_io/small_deformation.h"

namespace droplet {
namespace {

/// Frame of a droplet on the first shape of ground that deforms.
DropletFrame restFrame(const FlowSample& sample, const DropletFrame& frame, const FlowTerrain* ground)
{
    if (ground == nullptr || !sample.face || !ground->content().rest) {
        return frame;
    }
    const FlowSurface::Face& now = ground->surface().faces[*sample.face];
    const FlowSurface::Face& first = ground->content().rest->faces[*sample.face];
    return {followed(now, first, frame.place), turnedWith(now, first, frame.ahead), turnedWith(now, first, frame.left),
            turnedWith(now, first, frame.normal)};
}

}  // namespace

Surface dropletSurfaces(std::span<const FlowSample> samples, const DropletShapes& shapes)
{
    const DropletBodies& bodies = shapes.bodies;
    const Vec3 gravity = shapes.gravity;
    const std::size_t vertex_count = bodies.vertices();
    const std::vector<Triangle>& triangles = bodies.triangles();
    Surface surface;
    surface.vertices.resize(samples.size() * vertex_count);
    surface.normals.resize(surface.vertices.size());
    surface.uvs.resize(surface.vertices.size());
    surface.contact_angle.resize(surface.vertices.size());
    surface.weld.resize(surface.vertices.size());
    std::iota(surface.weld.begin(), surface.weld.end(), std::uint32_t{0});
    surface.triangles.resize(samples.size() * triangles.size());
    double volume = 0.0;
    double area = 0.0;  // of the sides of cubes with these volumes
    for (const FlowSample& sample : samples) {
        volume += sample.volume;
        area += std::cbrt(sample.volume * sample.volume);
    }
    surface.mean_height = samples.empty() ? 0.0 : volume / area;
    tbb::parallel_for(std::size_t{0}, samples.size(), [&](std::size_t i) {
        const DropletFrame frame = frameOf(samples[i], gravity);
        const std::span vertices = std::span(surface.vertices).subspan(i * vertex_count, vertex_count);
        const std::span normals = std::span(surface.normals).subspan(i * vertex_count, vertex_count);
        const BodyConditions conditions = conditionsOf(samples[i], gravity);
        bodies.make(conditions, vertices, normals);
        if (const double share = shapes.small.at(conditions.speed); share > 0.0 && !conditions.airborne) {
            const DropletFrame rest = restFrame(samples[i], frame, shapes.small.ground);
            deform({share, shapes.small, rest}, {vertices, normals, triangles, bodies.rimVertices()});
        }
        const auto turned = [&](Vec3 v) { return v.x * frame.ahead + v.y * frame.left + v.z * frame.normal; };
        for (std::size_t k = 0; k < vertex_count; ++k) {
            vertices[k] = frame.place + turned(vertices[k]);
            normals[k] = turned(normals[k]);
        }
        const auto first = static_cast<std::uint32_t>(i * vertex_count);
        for (std::size_t k = 0; k < triangles.size(); ++k) {
            const auto& [a, b, c] = triangles[k];
            surface.triangles[i * triangles.size() + k] = {first + a, first + b, first + c};
        }
    });
    return surface;
}

SeatedDroplets seatedDroplets(const FlowTerrain& terrain, std::span<const FlowSample> samples,
                              const DropletShapes& shapes)
{
    const DropletBodies& bodies = shapes.bodies;
    const Vec3 gravity = shapes.gravity;
    std::vector<FlowSample> bodied;  // samples with bodies
    std::vector<std::size_t> whose;  // their indices
    std::vector<std::size_t> pond_samples;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        if (samples[i].pond) {
            pond_samples.push_back(i);
        } else {
            bodied.push_back(samples[i]);
            whose.push_back(i);
        }
    }
    SeatedDroplets made{dropletSurfaces(bodied, shapes), std::vector<double>(samples.size())};
    Surface& surface = made.surface;
    const std::size_t vertex_count = bodies.vertices();
    const std::size_t rim = bodies.rimVertices();
    const std::size_t triangle_count = bodies.triangles().size();
    const std::vector<Triangle> base_triangles = baseTriangles(rim);
    const std::size_t base_count = baseVertices(rim);
    std::vector<std::vector<Vec3>> bases(bodied.size());
    tbb::parallel_for(std::size_t{0}, bodied.size(), [&](std::size_t i) {
        const std::span vertices = std::span(surface.vertices).subspan(i * vertex_count, vertex_count);
        const std::span normals = std::span(surface.normals).subspan(i * vertex_count, vertex_count);
        if (bodied[i].contact == FlowContact::Air) {
            // The base of a ball is a point.
            bases[i].assign(vertices.begin(), vertices.begin() + static_cast<std::ptrdiff_t>(rim));
            bases[i].resize(base_count, vertices.front());
        } else {
            bases[i] = seat(terrain, frameOf(bodied[i], gravity), {vertices, normals, bodies.triangles(), rim});
        }
        made.volumes[whose[i]] = volumeUnder(vertices, bodies.triangles(), vertices.front()) +
                                 volumeUnder(bases[i], base_triangles, vertices.front());
    });
    surface.triangles.reserve(bodied.size() * (triangle_count + base_triangles.size()));
    for (std::size_t i = 0; i < bodied.size(); ++i) {
        const auto first = static_cast<std::uint32_t>(i * vertex_count);
        const auto base = static_cast<std::uint32_t>(surface.vertices.size());
        for (const auto& [a, b, c] : base_triangles) {
            surface.triangles.push_back({base + a, base + b, base + c});
        }
        for (std::size_t k = 0; k < base_count; ++k) {
            surface.vertices.push_back(bases[i][k]);
            surface.weld.push_back(k < rim ? surface.weld[first + k] : base + static_cast<std::uint32_t>(k));
        }
        surface.normals.resize(surface.vertices.size(), -1.0 * frameOf(bodied[i], gravity).normal);
    }
    std::vector<PondSurface> ponds(pond_samples.size());
    tbb::parallel_for(std::size_t{0}, ponds.size(), [&](std::size_t k) {
        const Pond& pond = *samples[pond_samples[k]].pond;
        ponds[k] = pondSurface(terrain.surface(), pond);
        made.volumes[pond_samples[k]] = volumeUnder(ponds[k].vertices, ponds[k].triangles, pond.level * pond.up);
    });
    for (const PondSurface& pond : ponds) {
        const auto first = static_cast<std::uint32_t>(surface.vertices.size());
        surface.vertices.insert(surface.vertices.end(), pond.vertices.begin(), pond.vertices.end());
        surface.normals.insert(surface.normals.end(), pond.normals.begin(), pond.normals.end());
        for (const std::uint32_t same : pond.weld) {
            surface.weld.push_back(first + same);
        }
        for (const auto& [a, b, c] : pond.triangles) {
            surface.triangles.push_back({first + a, first + b, first + c});
        }
    }
    surface.uvs.resize(surface.vertices.size());
    surface.contact_angle.resize(surface.vertices.size());
    return made;
}

}  // namespace droplet
