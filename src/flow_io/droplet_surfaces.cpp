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
        bodies.make(conditionsOf(samples[i], gravity), vertices, normals);
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

Surface withBases(Surface surface, const DropletBodies& bodies)
{
    const std::size_t rim = bodies.rimVertices();
    const std::size_t droplets = surface.vertices.size() / bodies.vertices();
    for (std::size_t i = 0; i < droplets; ++i) {
        const auto first = static_cast<std::uint32_t>(i * bodies.vertices());
        const auto centre = static_cast<std::uint32_t>(surface.vertices.size());
        Vec3 middle;
        Vec3 area;
        for (std::uint32_t k = 0; k < rim; ++k) {
            const Vec3 position = surface.vertices[first + k];
            const auto next = static_cast<std::uint32_t>((k + 1) % rim);
            middle = middle + (1.0 / static_cast<double>(rim)) * position;
            area = area + cross(position - surface.vertices[first], surface.vertices[first + next] - position);
            surface.triangles.push_back({centre, centre + 1 + next, centre + 1 + k});
        }
        // A ball in the air touches the ground in a point.
        const Vec3 down = length(area) > 0.0 ? (-1.0 / length(area)) * area : Vec3{0.0, 0.0, -1.0};
        surface.vertices.push_back(middle);
        surface.weld.push_back(centre);
        for (std::uint32_t k = 0; k < rim; ++k) {
            surface.vertices.push_back(surface.vertices[first + k]);
            surface.weld.push_back(surface.weld[first + k]);
        }
        surface.normals.resize(surface.vertices.size(), down);
    }
    surface.uvs.resize(surface.vertices.size());
    surface.contact_angle.resize(surface.vertices.size());
    return surface;
}

}  // namespace droplet
