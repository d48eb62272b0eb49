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

ParametricSheet join(const std::vector<ParametricSheet>& sheets)
{
    std::vector<PlanarMesh> footprints;
    std::size_t vertices = 0;
    for (const ParametricSheet& sheet : sheets) {
        footprints.push_back(sheet.footprint);
        vertices += sheet.vertices.size();
    }
    ParametricSheet joined;
    joined.footprint = join(footprints);
    joined.rim = joined.footprint.rimVertexCount();
    joined.pressure = sheets.front().pressure;
    joined.vertices.resize(vertices);
    Numbering numbering(joined.rim);
    for (const ParametricSheet& sheet : sheets) {
        numbering.add(sheet.rim, sheet.vertices.size());
        add(sheet.vertices, sheet.triangles, numbering, joined.vertices, joined.triangles);
        joined.contact_angle.insert(joined.contact_angle.end(), sheet.contact_angle.begin(), sheet.contact_angle.end());
    }
    return joined;
}

std::vector<ParametricSheet> separate(const ParametricSheet& sheet)
{
    std::vector<ParametricSheet> sheets;
    const PlanarMesh& footprint = sheet.footprint;
    for (std::size_t loop = 0; loop < footprint.loopCount(); ++loop) {
        if (isOuter(footprint, loop)) {
            sheets.emplace_back();
        }
        ParametricSheet& own = sheets.back();
        own.footprint.loop_starts.push_back(own.rim);
        own.rim += footprint.loop_starts[loop + 1] - footprint.loop_starts[loop];
        own.pressure = sheet.pressure;
    }
    distribute(
        footprint.vertices, footprint.triangles, partsOf(footprint, footprint.vertices.size(), footprint.triangles),
        sheets.size(), [&](std::size_t part) -> auto& { return sheets[part].footprint.vertices; },
        [&](std::size_t part) -> auto& { return sheets[part].footprint.triangles; });
    const std::vector<std::size_t> parts = partsOf(footprint, sheet.vertices.size(), sheet.triangles);
    distribute(
        sheet.vertices, sheet.triangles, parts,
        sheets.size(), [&](std::size_t part) -> auto& { return sheets[part].vertices; },
        [&](std::size_t part) -> auto& { return sheets[part].triangles; });
    for (std::uint32_t v = 0; v < sheet.rim; ++v) {
        sheets[parts[v]].contact_angle.push_back(sheet.contact_angle[v]);
    }
    for (ParametricSheet& own : sheets) {
        own.footprint.loop_starts.push_back(own.rim);
    }
    return sheets;
}

}  // namespace droplet
