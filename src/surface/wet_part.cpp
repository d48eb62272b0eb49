// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/wet_part.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include "surface/rim_normals.h"

namespace droplet {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// Next half-edge of a triangle. Half-edge 3i + k runs from vertex k of triangle i to the next vertex.
std::uint32_t nextInTriangle(std::uint32_t half_edge)
{
    return half_edge % 3 == 2 ? half_edge - 2 : half_edge + 1;
}

std::uint32_t previousInTriangle(std::uint32_t half_edge)
{
    return half_edge % 3 == 0 ? half_edge + 2 : half_edge - 1;
}

std::vector<Triangle> liquidTriangles(const PlanarMesh& mesh, const HeightField& field)
{
    std::vector<Triangle> liquid;
    liquid.reserve(mesh.triangles.size());
    for (const Triangle& t : mesh.triangles) {
        const bool grounded =
            std::all_of(t.begin(), t.end(), [&](std::uint32_t v) { return mesh.onRim(v) || field.dry[v] != 0; });
        if (!grounded) {
            liquid.push_back(t);
        }
    }
    return liquid;
}

/// Opposite half-edge of every half-edge, or kNone on the boundary.
std::vector<std::uint32_t> findTwins(const std::vector<Triangle>& triangles, std::size_t vertex_count)
{
    const auto count = static_cast<std::uint32_t>(3 * triangles.size());
    std::vector<std::uint32_t> first(vertex_count, kNone);  // half-edges by the vertex they start at
    std::vector<std::uint32_t> following(count);
    for (std::uint32_t h = 0; h < count; ++h) {
        following[h] = std::exchange(first[triangles[h / 3][h % 3]], h);
    }
    std::vector<std::uint32_t> twins(count, kNone);
    for (std::uint32_t h = 0; h < count; ++h) {
        const Triangle& t = triangles[h / 3];
        for (std::uint32_t g = first[t[(h + 1) % 3]]; g != kNone; g = following[g]) {
            if (triangles[g / 3][(g + 1) % 3] == t[h % 3]) {
                twins[h] = g;
            }
        }
    }
    return twins;
}

/// Remaining triangles as a manifold. A vertex at which triangles only touch has one copy for every fan.
struct Manifold {
    std::vector<Triangle> triangles;      ///< indices of vertices of the whole mesh
    std::vector<std::uint32_t> twins;     ///< opposite of every half-edge
    std::vector<std::uint32_t> fans;      ///< fan at the start of every half-edge; fans on the boundary come first
    std::vector<std::uint32_t> boundary;  ///< boundary half-edge that starts at every fan on the boundary
    std::uint32_t fan_count = 0;

    [[nodiscard]] bool onBoundary(std::uint32_t fan) const { return fan < boundary.size(); }
    [[nodiscard]] std::uint32_t nextOnBoundary(std::uint32_t fan) const { return fans[nextInTriangle(boundary[fan])]; }
    /// Whether an inner edge joins two boundary vertices.
    [[nodiscard]] bool crosses(std::uint32_t half_edge) const
    {
        return twins[half_edge] != kNone && onBoundary(fans[half_edge]) && onBoundary(fans[nextInTriangle(half_edge)]);
    }
};

Manifold manifoldOf(std::vector<Triangle> triangles, std::size_t vertex_count)
{
    Manifold liquid;
    liquid.triangles = std::move(triangles);
    liquid.twins = findTwins(liquid.triangles, vertex_count);
    const auto count = static_cast<std::uint32_t>(liquid.twins.size());
    liquid.fans.assign(count, kNone);
    const auto mark = [&](std::uint32_t first) {
        for (std::uint32_t h = first; h != kNone && liquid.fans[h] == kNone; h = liquid.twins[previousInTriangle(h)]) {
            liquid.fans[h] = liquid.fan_count;
        }
        ++liquid.fan_count;
    };
    for (std::uint32_t h = 0; h < count; ++h) {
        if (liquid.twins[h] == kNone) {
            liquid.boundary.push_back(h);
            mark(h);
        }
    }
    for (std::uint32_t h = 0; h < count; ++h) {
        if (liquid.fans[h] == kNone) {
            mark(h);
        }
    }
    return liquid;
}

/// Triangles of every part.
std::vector<std::vector<std::uint32_t>> trianglesOfParts(const Manifold& liquid)
{
    std::vector<std::vector<std::uint32_t>> parts;
    std::vector<std::uint8_t> seen(liquid.triangles.size(), 0);
    for (std::uint32_t start = 0; start < seen.size(); ++start) {
        if (seen[start] != 0) {
            continue;
        }
        std::vector<std::uint32_t> part{start};
        seen[start] = 1;
        for (std::size_t k = 0; k < part.size(); ++k) {
            for (std::uint32_t h = 3 * part[k]; h < 3 * part[k] + 3; ++h) {
                const std::uint32_t twin = liquid.twins[h];
                if (twin != kNone && seen[twin / 3] == 0) {
                    seen[twin / 3] = 1;
                    part.push_back(twin / 3);
                }
            }
        }
        std::sort(part.begin(), part.end());
        parts.push_back(std::move(part));
    }
    return parts;
}

/// Makes all parts.
class PartMaker {
public:
    PartMaker(const PlanarMesh& mesh, const HeightField& field, const BaseSurface& ground)
        : mesh_(mesh),
          field_(field),
          ground_(ground),
          liquid_(manifoldOf(liquidTriangles(mesh, field), mesh.vertices.size())),
          number_(liquid_.fan_count, kNone),
          middle_(liquid_.twins.size(), kNone)
    {
    }

    std::vector<WetPart> makeAll()
    {
        std::vector<WetPart> parts;
        for (const std::vector<std::uint32_t>& triangles : trianglesOfParts(liquid_)) {
            parts.push_back(make(triangles));
        }
        return parts;
    }

private:
    [[nodiscard]] std::uint32_t vertexAt(std::uint32_t half_edge) const
    {
        return liquid_.triangles[half_edge / 3][half_edge % 3];
    }

    WetPart make(const std::vector<std::uint32_t>& triangles)
    {
        WetPart part;
        part.field.pressure = field_.pressure;
        const std::vector<std::uint32_t> rim = addRim(part, triangles);
        for (const std::uint32_t i : triangles) {
            for (std::uint32_t h = 3 * i; h < 3 * i + 3; ++h) {
                std::uint32_t& number = number_[liquid_.fans[h]];
                if (number == kNone) {
                    number = addVertex(part, vertexAt(h));
                }
            }
        }
        for (const std::uint32_t i : triangles) {
            addTriangle(part, i);
        }
        addSlopes(part, rim);
        return part;
    }

    std::uint32_t addVertex(WetPart& part, std::uint32_t vertex) const
    {
        const auto number = static_cast<std::uint32_t>(part.mesh.vertices.size());
        part.mesh.vertices.push_back(mesh_.vertices[vertex]);
        part.field.height.push_back(field_.height[vertex]);
        part.field.dry.push_back(field_.dry[vertex]);
        if (!field_.ground.empty()) {
            part.field.ground.push_back(field_.ground[vertex]);
        }
        return number;
    }

    /// Adds the loops of a part, the outer one first: the one with the largest area, the only positive one.
    /// Returns the vertices of the whole mesh along them.
    std::vector<std::uint32_t> addRim(WetPart& part, const std::vector<std::uint32_t>& triangles)
    {
        std::vector<std::vector<std::uint32_t>> loops;
        std::size_t outer = 0;
        double largest = 0.0;
        for (const std::uint32_t i : triangles) {
            for (std::uint32_t h = 3 * i; h < 3 * i + 3; ++h) {
                if (liquid_.twins[h] != kNone || number_[liquid_.fans[h]] != kNone) {
                    continue;
                }
                std::vector<std::uint32_t> loop;
                double twice_area = 0.0;
                const Vec2 origin = mesh_.vertices[vertexAt(h)];
                for (std::uint32_t fan = liquid_.fans[h]; number_[fan] == kNone; fan = liquid_.nextOnBoundary(fan)) {
                    const std::uint32_t along = liquid_.boundary[fan];
                    number_[fan] = 0;  // marks it as found; the number follows below
                    loop.push_back(fan);
                    twice_area += cross(mesh_.vertices[vertexAt(along)] - origin,
                                        mesh_.vertices[vertexAt(nextInTriangle(along))] - origin);
                }
                if (twice_area > largest) {
                    largest = twice_area;
                    outer = loops.size();
                }
                loops.push_back(std::move(loop));
            }
        }
        std::swap(loops.front(), loops[outer]);
        std::vector<std::uint32_t> rim;
        part.mesh.loop_starts.push_back(0);
        for (const std::vector<std::uint32_t>& loop : loops) {
            for (const std::uint32_t fan : loop) {
                const std::uint32_t vertex = vertexAt(liquid_.boundary[fan]);
                number_[fan] = addVertex(part, vertex);
                part.field.dry.back() = 0;
                rim.push_back(vertex);
            }
            part.mesh.loop_starts.push_back(static_cast<std::uint32_t>(part.mesh.vertices.size()));
        }
        return rim;
    }

    /// Vertex in the middle of an edge between two boundary vertices.
    std::uint32_t middleOf(WetPart& part, std::uint32_t half_edge)
    {
        std::uint32_t& number = middle_[std::min(half_edge, liquid_.twins[half_edge])];
        if (number == kNone) {
            const std::uint32_t from = vertexAt(half_edge);
            const Vec2 p = 0.5 * (mesh_.vertices[from] + mesh_.vertices[vertexAt(nextInTriangle(half_edge))]);
            number = addVertex(part, from);
            part.mesh.vertices.back() = p;
            part.field.height.back() = ground_.at(p).height;
            part.field.dry.back() = 1;
            if (!part.field.ground.empty()) {
                part.field.ground.back() = part.field.height.back();
            }
        }
        return number;
    }

    void addTriangle(WetPart& part, std::uint32_t triangle)
    {
        const std::uint32_t h = 3 * triangle;
        const Triangle t{number_[liquid_.fans[h]], number_[liquid_.fans[h + 1]], number_[liquid_.fans[h + 2]]};
        for (std::uint32_t k = 0; k < 3; ++k) {
            // One of its vertices is not on the ground, so at most one of its edges crosses.
            if (liquid_.crosses(h + k)) {
                const std::uint32_t middle = middleOf(part, h + k);
                part.mesh.triangles.push_back({t[k], middle, t[(k + 2) % 3]});
                part.mesh.triangles.push_back({middle, t[(k + 1) % 3], t[(k + 2) % 3]});
                return;
            }
        }
        part.mesh.triangles.push_back(t);
    }

    /// Sets slopes and angles at the rim. Along a new rim the liquid has the slope of the ground.
    void addSlopes(WetPart& part, const std::vector<std::uint32_t>& rim) const
    {
        const std::vector<Vec2> outward = rimNormals(part.mesh);
        for (std::size_t v = 0; v < rim.size(); ++v) {
            const bool is_old = mesh_.onRim(rim[v]);
            part.field.contact_angle.push_back(is_old ? field_.contact_angle[rim[v]] : 0.0);
            part.field.rim_slope.push_back(is_old ? field_.rim_slope[rim[v]]
                                                  : -dot(ground_.at(part.mesh.vertices[v]).gradient, outward[v]));
        }
    }

    const PlanarMesh& mesh_;
    const HeightField& field_;
    const BaseSurface& ground_;
    Manifold liquid_;
    std::vector<std::uint32_t> number_;  // number of every fan in its part
    std::vector<std::uint32_t> middle_;  // middle vertex of an edge, stored at its smaller half-edge
};

}  // namespace

std::vector<WetPart> wetParts(const PlanarMesh& mesh, const HeightField& field, const BaseSurface& ground)
{
    return PartMaker(mesh, field, ground).makeAll();
}

}  // namespace droplet
