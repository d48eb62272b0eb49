// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstddef>
#include <cstdint>
#include <utility>

#include "droplet/shape/sheet.h"
#include "union_find.h"

namespace droplet {
namespace {

/// Vertices of several meshes in one: all rims first, then all others.
class Numbering {
public:
    explicit Numbering(std::uint32_t rim) : next_inside_(rim) {}

    /// Takes up a mesh.
    void add(std::uint32_t rim, std::size_t vertices)
    {
        rim_ = rim;
        first_on_rim_ = next_on_rim_;
        first_inside_ = next_inside_;
        next_on_rim_ += rim;
        next_inside_ += static_cast<std::uint32_t>(vertices) - rim;
    }

    /// Number of a vertex of the mesh that was added last.
    [[nodiscard]] std::uint32_t of(std::uint32_t v) const
    {
        return v < rim_ ? first_on_rim_ + v : first_inside_ + (v - rim_);
    }

    [[nodiscard]] std::uint32_t firstOnRim() const { return first_on_rim_; }

private:
    std::uint32_t rim_ = 0;
    std::uint32_t first_on_rim_ = 0;
    std::uint32_t first_inside_ = 0;
    std::uint32_t next_on_rim_ = 0;
    std::uint32_t next_inside_ = 0;
};

/// Adds a mesh to a larger one.
template <typename Place>
void add(const std::vector<Place>& places, const std::vector<Triangle>& triangles, const Numbering& numbering,
         std::vector<Place>& all_places, std::vector<Triangle>& all_triangles)
{
    for (std::uint32_t v = 0; v < places.size(); ++v) {
        all_places[numbering.of(v)] = places[v];
    }
    for (const Triangle& t : triangles) {
        all_triangles.push_back({numbering.of(t[0]), numbering.of(t[1]), numbering.of(t[2])});
    }
}

/// Whether a loop is an outer one, with liquid on its left inside.
bool isOuter(const PlanarMesh& mesh, std::size_t loop)
{
    double area = 0.0;
    for (std::uint32_t v = mesh.loop_starts[loop]; v < mesh.loop_starts[loop + 1]; ++v) {
        area += cross(mesh.vertices[v], mesh.vertices[nextOnRim(mesh, loop, v)]);
    }
    return area > 0.0;
}

/// Parts of a mesh: for every vertex the number of its part, in the order of outer loops.
std::vector<std::size_t> partsOf(const PlanarMesh& footprint, std::size_t vertices,
                                 const std::vector<Triangle>& triangles)
{
    UnionFind sets(vertices);
    for (const Triangle& t : triangles) {
        sets.join(t[0], t[1]);
        sets.join(t[0], t[2]);
    }
    std::vector<std::size_t> part_of_root(vertices, 0);
    std::size_t part = 0;
    for (std::size_t loop = 0; loop < footprint.loopCount(); ++loop) {
        if (isOuter(footprint, loop)) {
            part_of_root[sets.find(footprint.loop_starts[loop])] = part++;
        }
    }
    std::vector<std::size_t> parts(vertices);
    for (std::size_t v = 0; v < vertices; ++v) {
        parts[v] = part_of_root[sets.find(static_cast<std::uint32_t>(v))];
    }
    return parts;
}

/// Numbers of vertices within their parts.
std::vector<std::uint32_t> numbersWithin(const std::vector<std::size_t>& parts, std::size_t count)
{
    std::vector<std::uint32_t> next(count, 0);
    std::vector<std::uint32_t> numbers;
    numbers.reserve(parts.size());
    for (const std::size_t part : parts) {
        numbers.push_back(next[part]++);
    }
    return numbers;
}

template <typename Place>
void distribute(const std::vector<Place>& places, const std::vector<Triangle>& triangles,
                const std::vector<std::size_t>& parts, std::size_t count, auto&& places_of, auto&& triangles_of)
{
    const std::vector<std::uint32_t> number = numbersWithin(parts, count);
    for (std::size_t v = 0; v < places.size(); ++v) {
        places_of(parts[v]).push_back(places[v]);
    }
    for (const Triangle& t : triangles) {
        triangles_of(parts[t[0]]).push_back({number[t[0]], number[t[1]], number[t[2]]});
    }
}

}  // namespace

PlanarMesh join(const std::vector<PlanarMesh>& footprints)
{
    std::uint32_t rim = 0;
    std::size_t vertices = 0;
    for (const PlanarMesh& mesh : footprints) {
        rim += mesh.rimVertexCount();
        vertices += mesh.vertices.size();
    }
    PlanarMesh joined;
    joined.vertices.resize(vertices);
    Numbering numbering(rim);
    for (const PlanarMesh& mesh : footprints) {
        numbering.add(mesh.rimVertexCount(), mesh.vertices.size());
        add(mesh.vertices, mesh.triangles, numbering, joined.vertices, joined.triangles);
        for (std::size_t loop = 0; loop < mesh.loopCount(); ++loop) {
            joined.loop_starts.push_back(numbering.firstOnRim() + mesh.loop_starts[loop]);
        }
    }
    joined.loop_starts.push_back(rim);
    return joined;
}

CapillarySurface join(const std::vector<CapillarySurface>& surfaces)
{
    std::uint32_t rim = 0;
    std::size_t vertices = 0;
    std::vector<PlanarMesh> footprints;
    for (const CapillarySurface& surface : surfaces) {
        rim += surface.rimVertexCount();
        vertices += surface.vertices.size();
        footprints.push_back(footprintOf(surface));
    }
    CapillarySurface joined;
    joined.footprint = join(footprints);
    joined.loop_starts = joined.footprint->loop_starts;
    joined.pressure = surfaces.front().pressure;
    joined.vertices.resize(vertices);
    joined.dry.resize(vertices, 0);
    Numbering numbering(rim);
    for (const CapillarySurface& surface : surfaces) {
        numbering.add(surface.rimVertexCount(), surface.vertices.size());
        add(surface.vertices, surface.triangles, numbering, joined.vertices, joined.triangles);
        for (std::uint32_t v = 0; v < surface.dry.size(); ++v) {
            joined.dry[numbering.of(v)] = surface.dry[v];
        }
        joined.contact_angle.insert(joined.contact_angle.end(), surface.contact_angle.begin(),
                                    surface.contact_angle.end());
    }
    return joined;
}

std::vector<CapillarySurface> separate(const CapillarySurface& surface)
{
    std::vector<CapillarySurface> surfaces;
    const PlanarMesh footprint = footprintOf(surface);
    std::uint32_t rim = 0;
    for (std::size_t loop = 0; loop < footprint.loopCount(); ++loop) {
        if (isOuter(footprint, loop)) {
            surfaces.emplace_back().footprint.emplace();
            surfaces.back().pressure = surface.pressure;
            surfaces.back().loop_starts.push_back(0);
            rim = 0;
        }
        rim += footprint.loop_starts[loop + 1] - footprint.loop_starts[loop];
        surfaces.back().loop_starts.push_back(rim);
    }
    distribute(
        footprint.vertices, footprint.triangles, partsOf(footprint, footprint.vertices.size(), footprint.triangles),
        surfaces.size(), [&](std::size_t part) -> auto& { return surfaces[part].footprint->vertices; },
        [&](std::size_t part) -> auto& { return surfaces[part].footprint->triangles; });
    const std::vector<std::size_t> parts = partsOf(footprint, surface.vertices.size(), surface.triangles);
    distribute(
        surface.vertices, surface.triangles, parts,
        surfaces.size(), [&](std::size_t part) -> auto& { return surfaces[part].vertices; },
        [&](std::size_t part) -> auto& { return surfaces[part].triangles; });
    for (std::size_t v = 0; v < surface.dry.size(); ++v) {
        surfaces[parts[v]].dry.push_back(surface.dry[v]);
    }
    for (std::uint32_t v = 0; v < surface.rimVertexCount(); ++v) {
        surfaces[parts[v]].contact_angle.push_back(surface.contact_angle[v]);
    }
    for (CapillarySurface& own : surfaces) {
        own.footprint->loop_starts = own.loop_starts;
    }
    return surfaces;
}

}  // namespace droplet
