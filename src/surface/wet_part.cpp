// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/wet_part.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include "droplet/mesh/triangulate.h"
#include "mesh/mean_edge.h"
#include "shape/area_vector.h"
#include "surface/flat_map.h"

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

std::vector<Triangle> wetTriangles(const std::vector<Triangle>& triangles, const std::vector<std::uint8_t>& is_dry)
{
    std::vector<Triangle> wet;
    for (std::size_t k = 0; k < triangles.size(); ++k) {
        if (is_dry[k] == 0) {
            wet.push_back(triangles[k]);
        }
    }
    return wet;
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
    const auto count = static_cast<std::uint32_t>(liquid.triangles.size());
    std::vector<std::uint8_t> seen(count, 0);
    for (std::uint32_t start = 0; start < count; ++start) {
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

/// Connected triangles that remain, as a manifold in numbers of its own; vertices of the rim come first, as those of a
/// PlanarMesh.
struct Part {
    std::vector<std::array<std::uint32_t, 2>> origins;  ///< two vertices of the whole that each lies half-way between;
                                                        ///< or one of them, twice
    std::vector<std::uint32_t> loop_starts;
    std::vector<Triangle> triangles;
};

/// Makes all parts.
class PartMaker {
public:
    /// @param places  of all vertices, seen from above
    PartMaker(std::vector<Triangle> triangles, const std::vector<Vec2>& places)
        : places_(places),
          liquid_(manifoldOf(std::move(triangles), places.size())),
          number_(liquid_.fan_count, kNone),
          middle_(liquid_.twins.size(), kNone)
    {
    }

    std::vector<Part> makeAll()
    {
        std::vector<Part> parts;
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

    Part make(const std::vector<std::uint32_t>& triangles)
    {
        Part part;
        addRim(part, triangles);
        for (const std::uint32_t i : triangles) {
            for (std::uint32_t h = 3 * i; h < 3 * i + 3; ++h) {
                std::uint32_t& number = number_[liquid_.fans[h]];
                if (number == kNone) {
                    number = addVertex(part, {vertexAt(h), vertexAt(h)});
                }
            }
        }
        for (const std::uint32_t i : triangles) {
            addTriangle(part, i);
        }
        return part;
    }

    static std::uint32_t addVertex(Part& part, std::array<std::uint32_t, 2> origin)
    {
        part.origins.push_back(origin);
        return static_cast<std::uint32_t>(part.origins.size() - 1);
    }

    /// Adds the loops of a part, the outer one first: the one with the largest area, the only positive one.
    void addRim(Part& part, const std::vector<std::uint32_t>& triangles)
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
                const Vec2 origin = places_[vertexAt(h)];
                for (std::uint32_t fan = liquid_.fans[h]; number_[fan] == kNone; fan = liquid_.nextOnBoundary(fan)) {
                    const std::uint32_t along = liquid_.boundary[fan];
                    number_[fan] = 0;  // marks it as found; the number follows below
                    loop.push_back(fan);
                    twice_area +=
                        cross(places_[vertexAt(along)] - origin, places_[vertexAt(nextInTriangle(along))] - origin);
                }
                if (twice_area > largest) {
                    largest = twice_area;
                    outer = loops.size();
                }
                loops.push_back(std::move(loop));
            }
        }
        std::swap(loops.front(), loops[outer]);
        part.loop_starts.push_back(0);
        for (const std::vector<std::uint32_t>& loop : loops) {
            for (const std::uint32_t fan : loop) {
                const std::uint32_t vertex = vertexAt(liquid_.boundary[fan]);
                number_[fan] = addVertex(part, {vertex, vertex});
            }
            part.loop_starts.push_back(static_cast<std::uint32_t>(part.origins.size()));
        }
    }

    /// Vertex in the middle of an edge between two boundary vertices.
    std::uint32_t middleOf(Part& part, std::uint32_t half_edge)
    {
        std::uint32_t& number = middle_[std::min(half_edge, liquid_.twins[half_edge])];
        if (number == kNone) {
            number = addVertex(part, {vertexAt(half_edge), vertexAt(nextInTriangle(half_edge))});
        }
        return number;
    }

    void addTriangle(Part& part, std::uint32_t triangle)
    {
        const std::uint32_t h = 3 * triangle;
        const Triangle t{number_[liquid_.fans[h]], number_[liquid_.fans[h + 1]], number_[liquid_.fans[h + 2]]};
        Triangle middle{kNone, kNone, kNone};  // of the edge from every corner
        for (std::uint32_t k = 0; k < 3; ++k) {
            middle[k] = liquid_.crosses(h + k) ? middleOf(part, h + k) : kNone;
        }
        const auto count = 3 - std::count(middle.begin(), middle.end(), kNone);
        // The first edge is the only one with a middle, or the only one without.
        const auto first = static_cast<std::size_t>(
            std::find_if(middle.begin(), middle.end(), [&](std::uint32_t m) { return (m != kNone) == (count == 1); }) -
            middle.begin());
        const std::size_t i = first % 3;
        const std::size_t j = (first + 1) % 3;
        const std::size_t k = (first + 2) % 3;
        std::vector<Triangle>& made = part.triangles;
        switch (count) {
            case 1:
                made.insert(made.end(), {{t[i], middle[i], t[k]}, {middle[i], t[j], t[k]}});
                break;
            case 2:
                made.insert(made.end(),
                            {{t[i], t[j], middle[j]}, {t[i], middle[j], middle[k]}, {middle[k], middle[j], t[k]}});
                break;
            case 3:
                made.insert(
                    made.end(),
                    {{t[0], middle[0], middle[2]}, {middle[0], t[1], middle[1]}, {middle[2], middle[1], t[2]}, middle});
                break;
            default:
                made.push_back(t);
        }
    }

    const std::vector<Vec2>& places_;
    Manifold liquid_;
    std::vector<std::uint32_t> number_;  // number of every fan in its part
    std::vector<std::uint32_t> middle_;  // middle vertex of an edge, stored at its smaller half-edge
};

std::vector<Part> partsOf(std::vector<Triangle> triangles, const std::vector<Vec2>& places)
{
    return PartMaker(std::move(triangles), places).makeAll();
}

bool hasDry(const std::vector<std::uint8_t>& is_dry)
{
    return std::find(is_dry.begin(), is_dry.end(), 1) != is_dry.end();
}

/// Keeps triangles at vertices at which liquid would touch itself otherwise.
void keepPinches(const CapillarySurface& surface, std::vector<std::uint8_t>& is_dry)
{
    for (bool has_changed = hasDry(is_dry); has_changed;) {
        const Manifold liquid = manifoldOf(wetTriangles(surface.triangles, is_dry), surface.vertices.size());
        std::vector<std::uint8_t> is_passed(surface.vertices.size(), 0);
        std::vector<std::uint8_t> is_pinch(surface.vertices.size(), 0);
        for (const std::uint32_t h : liquid.boundary) {
            const std::uint32_t v = liquid.triangles[h / 3][h % 3];
            is_pinch[v] = std::exchange(is_passed[v], std::uint8_t{1});
        }
        has_changed = false;
        for (std::size_t k = 0; k < is_dry.size(); ++k) {
            const Triangle& t = surface.triangles[k];
            if (is_dry[k] != 0 && std::any_of(t.begin(), t.end(), [&](std::uint32_t v) { return is_pinch[v] != 0; })) {
                is_dry[k] = 0;
                has_changed = true;
            }
        }
    }
}

CapillarySurface surfaceOf(Part&& part, const CapillarySurface& whole, const BaseSurface& ground)
{
    CapillarySurface own;
    own.loop_starts = std::move(part.loop_starts);
    own.triangles = std::move(part.triangles);
    own.pressure = whole.pressure;
    for (std::uint32_t v = 0; v < part.origins.size(); ++v) {
        const auto [a, b] = part.origins[v];
        const bool is_middle = a != b;
        Vec3 place = 0.5 * (whole.vertices[a] + whole.vertices[b]);
        if (is_middle && !ground.flat()) {
            place.z = ground.at({place.x, place.y}).height;
        }
        own.vertices.push_back(is_middle ? place : whole.vertices[a]);
        own.dry.push_back(!own.onRim(v) && (is_middle || whole.dry[a] != 0) ? 1 : 0);
        if (own.onRim(v)) {
            own.contact_angle.push_back(whole.onRim(a) ? whole.contact_angle[a] : 0.0);
        }
    }
    if (whole.footprint) {
        const PlanarMesh& footprint = *whole.footprint;
        own.footprint = ground.flat() ? cover(rimOf(own))
                                      : cover(rimOf(own), meanEdge(area(footprint), footprint.triangles.size()));
    }
    return own;
}

}  // namespace

std::optional<std::vector<CapillarySurface>> wetParts(const CapillarySurface& surface, const BaseSurface& ground)
{
    std::vector<std::uint8_t> is_dry;
    for (const Triangle& t : surface.triangles) {
        is_dry.push_back(isDry(surface, t) ? 1 : 0);
    }
    if (!surface.isHeightField()) {
        keepPinches(surface, is_dry);
    }
    if (!hasDry(is_dry)) {
        return std::nullopt;
    }
    const std::vector<Vec2> seen_from_above = projected(surface).places;
    std::vector<CapillarySurface> parts;
    for (Part& part : partsOf(wetTriangles(surface.triangles, is_dry), seen_from_above)) {
        parts.push_back(surfaceOf(std::move(part), surface, ground));
    }
    return parts;
}

}  // namespace droplet
