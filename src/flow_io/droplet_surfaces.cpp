// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/flow_io/droplet_surfaces.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace droplet {

Surface dropletSurfaces(std::span<const FlowSample> samples, const DropletBodies& bodies, Vec3 gravity)
{
    const std::size_t vertices = bodies.vertices();
    const std::vector<Triangle>& triangles = bodies.triangles();
    Surface surface;
    surface.positions.resize(samples.size() * vertices);
    surface.normals.resize(surface.positions.size());
    surface.uvs.resize(surface.positions.size());
    surface.contact_angle.resize(surface.positions.size());
    surface.weld.resize(surface.positions.size());
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
        const std::span positions = std::span(surface.positions).subspan(i * vertices, vertices);
        const std::span normals = std::span(surface.normals).subspan(i * vertices, vertices);
        bodies.make(conditionsOf(samples[i], gravity), positions, normals);
        const auto turned = [&](Vec3 v) { return v.x * frame.ahead + v.y * frame.left + v.z * frame.normal; };
        for (std::size_t k = 0; k < vertices; ++k) {
            positions[k] = frame.place + turned(positions[k]);
            normals[k] = turned(normals[k]);
        }
        const auto first = static_cast<std::uint32_t>(i * vertices);
        for (std::size_t k = 0; k < triangles.size(); ++k) {
            const auto& [a, b, c] = triangles[k];
            surface.triangles[i * triangles.size() + k] = {first + a, first + b, first + c};
        }
    });
    return surface;
}

Surface withBases(Surface surface, const DropletBodies& bodies)
{
    const std::size_t rim = bodies.rimVertices();
    const std::size_t droplets = surface.positions.size() / bodies.vertices();
    for (std::size_t i = 0; i < droplets; ++i) {
        const auto first = static_cast<std::uint32_t>(i * bodies.vertices());
        const auto centre = static_cast<std::uint32_t>(surface.positions.size());
        Vec3 middle;
        Vec3 area;
        for (std::uint32_t k = 0; k < rim; ++k) {
            const Vec3 position = surface.positions[first + k];
            const auto next = static_cast<std::uint32_t>((k + 1) % rim);
            middle = middle + (1.0 / static_cast<double>(rim)) * position;
            area = area + cross(position - surface.positions[first], surface.positions[first + next] - position);
            surface.triangles.push_back({centre, centre + 1 + next, centre + 1 + k});
        }
        // A ball in the air touches the ground in a point.
        const Vec3 down = length(area) > 0.0 ? (-1.0 / length(area)) * area : Vec3{0.0, 0.0, -1.0};
        surface.positions.push_back(middle);
        surface.weld.push_back(centre);
        for (std::uint32_t k = 0; k < rim; ++k) {
            surface.positions.push_back(surface.positions[first + k]);
            surface.weld.push_back(surface.weld[first + k]);
        }
        surface.normals.resize(surface.positions.size(), down);
    }
    surface.uvs.resize(surface.positions.size());
    surface.contact_angle.resize(surface.positions.size());
    return surface;
}

}  // namespace droplet
