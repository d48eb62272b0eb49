// SPDX-License-Identifier: GPL-3.0-or-later
#include "body/body_grid.h"

#include <cmath>
#include <cstdint>
#include <numbers>

#include "unit_vector.h"

namespace droplet {
namespace {

Vec3 at(const BodyGrid& grid, std::size_t ring, std::size_t column)
{
    return {grid.x[ring][column], grid.y[ring][column], grid.z[ring][column]};
}

/// Six times the volume below a triangle.
double below(Vec3 a, Vec3 b, Vec3 c)
{
    return (a.z + b.z + c.z) * ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
}

}  // namespace

std::vector<Triangle> bodyTriangles()
{
    std::vector<Triangle> triangles;
    const auto index = [](std::size_t ring, std::size_t slice) {
        return static_cast<std::uint32_t>(ring * kBodySlices + slice % kBodySlices);
    };
    for (std::size_t ring = 0; ring + 1 < kBodyRings; ++ring) {
        for (std::size_t j = 0; j < kBodySlices; ++j) {
            const std::uint32_t a = index(ring, j);
            const std::uint32_t b = index(ring, j + 1);
            const std::uint32_t c = index(ring + 1, j + 1);
            const std::uint32_t d = index(ring + 1, j);
            if (j < kBodySlices / 2) {
                triangles.push_back({a, b, c});
                triangles.push_back({a, c, d});
            } else {
                triangles.push_back({a, b, d});
                triangles.push_back({b, c, d});
            }
        }
    }
    for (std::size_t j = 0; j < kBodySlices; ++j) {
        triangles.push_back(
            {index(kBodyRings - 1, j), index(kBodyRings - 1, j + 1), static_cast<std::uint32_t>(kBodyApex)});
    }
    return triangles;
}

void close(BodyGrid& grid)
{
    for (auto* const axis : {&grid.x, &grid.y, &grid.z}) {
        for (BodyGrid::Ring& ring : *axis) {
            ring.front() = ring[kBodySlices];
            ring.back() = ring[1];
        }
    }
}

double volumeOf(const BodyGrid& grid)
{
    double sum = 0.0;
    for (std::size_t ring = 0; ring + 1 < kBodyRings; ++ring) {
        for (std::size_t j = 1; j <= kBodySlices; ++j) {
            const Vec3 a = at(grid, ring, j);
            const Vec3 b = at(grid, ring, j + 1);
            const Vec3 c = at(grid, ring + 1, j + 1);
            const Vec3 d = at(grid, ring + 1, j);
            sum += j <= kBodySlices / 2 ? below(a, b, c) + below(a, c, d) : below(a, b, d) + below(b, c, d);
        }
    }
    for (std::size_t j = 1; j <= kBodySlices; ++j) {
        sum += below(at(grid, kBodyRings - 1, j), at(grid, kBodyRings - 1, j + 1), grid.apex);
    }
    return sum / 6.0;
}

void finish(BodyGrid& grid, double volume, std::span<Vec3> vertices, std::span<Vec3> normals)
{
    close(grid);
    double area = 0.0;
    Vec2 centre;
    for (std::size_t j = 1; j <= kBodySlices; ++j) {
        const Vec2 a{grid.x[0][j], grid.y[0][j]};
        const Vec2 b{grid.x[0][j + 1], grid.y[0][j + 1]};
        const double twice = cross(a, b);
        area += twice;
        centre = centre + twice * (a + b);
    }
    centre = (1.0 / (3.0 * area)) * centre;
    const double scale = std::cbrt(volume / volumeOf(grid));
    const auto placed = [&](Vec3 p) { return Vec3{scale * (p.x - centre.x), scale * (p.y - centre.y), scale * p.z}; };
    for (std::size_t ring = 0; ring < kBodyRings; ++ring) {
        const std::size_t first = ring * kBodySlices;
        for (std::size_t j = 0; j < kBodySlices; ++j) {
            vertices[first + j] = placed(at(grid, ring, j + 1));
            Vec3 up = grid.inward[j];
            if (ring > 0) {
                const Vec3 above = ring + 1 < kBodyRings ? at(grid, ring + 1, j + 1) : grid.apex;
                up = above - at(grid, ring - 1, j + 1);
            }
            normals[first + j] = unit(cross(at(grid, ring, j + 2) - at(grid, ring, j), up));
        }
    }
    vertices[kBodyApex] = placed(grid.apex);
    Vec3 top;
    for (std::size_t j = 1; j <= kBodySlices; ++j) {
        top = top + cross(at(grid, kBodyRings - 1, j) - grid.apex, at(grid, kBodyRings - 1, j + 1) - grid.apex);
    }
    normals[kBodyApex] = unit(top);
}

void makeBall(double volume, std::span<Vec3> vertices, std::span<Vec3> normals)
{
    BodyGrid grid;
    const double step = std::numbers::pi / static_cast<double>(kBodyRings);
    for (std::size_t ring = 0; ring < kBodyRings; ++ring) {
        const double polar = std::numbers::pi - step * static_cast<double>(ring);
        const double sine = ring == 0 ? 0.0 : std::sin(polar);
        for (std::size_t j = 0; j < kBodySlices; ++j) {
            const double around = 2.0 * std::numbers::pi / static_cast<double>(kBodySlices) * static_cast<double>(j);
            const Vec3 normal{sine * std::cos(around), sine * std::sin(around), std::cos(polar)};
            grid.set(ring, j, normal);
            normals[ring * kBodySlices + j] = normal;
        }
    }
    grid.apex = {0.0, 0.0, 1.0};
    normals[kBodyApex] = grid.apex;
    close(grid);
    const double scale = std::cbrt(volume / volumeOf(grid));
    for (std::size_t v = 0; v < kBodyVertices; ++v) {
        vertices[v] = scale * normals[v];
    }
}

}  // namespace droplet
