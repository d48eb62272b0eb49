// SPDX-License-Identifier: GPL-3.0-or-later
// Half-edge structure: M. Botsch, S. Steinberg, S. Bischoff, L. Kobbelt, "OpenMesh – a generic and efficient polygon
// mesh data structure" (OpenSG Symposium, 2002).
#include "droplet/surface/surface.h"

#include <OpenMesh/Core/Mesh/TriConnectivity.hh>
#include <algorithm>
#include <cmath>
#include <string>

#include "droplet/error.h"

namespace droplet {
namespace {

constexpr double kUnitTolerance = 1e-6;  // far above double round-off, far below what float32 or shading would show

using HalfEdgeMesh = OpenMesh::TriConnectivity;  // no coordinates: topology needs none

[[noreturn]] void refuse(const std::string& field, std::size_t index, const std::string& constraint)
{
    throw Error(ErrorCode::InvalidArgument, "surface." + field + "[" + std::to_string(index) + "] " + constraint);
}

bool finite(Vec2 a)
{
    return std::isfinite(a.x) && std::isfinite(a.y);
}
bool finite(Vec3 a)
{
    return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

// A triangle seen from one of its vertices v: winding (v, from, to).
struct Wedge {
    std::uint32_t from;
    std::uint32_t to;
};

// The wedges around every vertex, those of vertex v in [starts[v], starts[v + 1]), sorted by `from`.
struct Wedges {
    std::vector<std::size_t> starts;
    std::vector<Wedge> wedges;
};

Wedges wedgesOf(const std::vector<Triangle>& triangles, std::size_t vertex_count)
{
    Wedges result;
    result.starts.assign(vertex_count + 1, 0);
    for (const Triangle& triangle : triangles) {
        for (const std::uint32_t vertex : triangle) {
            ++result.starts[vertex + 1];
        }
    }
    for (std::size_t v = 0; v < vertex_count; ++v) {
        result.starts[v + 1] += result.starts[v];
    }
    result.wedges.resize(3 * triangles.size());
    std::vector<std::size_t> next(result.starts.begin(), result.starts.end() - 1);
    for (const auto& [a, b, c] : triangles) {
        result.wedges[next[a]++] = {b, c};
        result.wedges[next[b]++] = {c, a};
        result.wedges[next[c]++] = {a, b};
    }
    for (std::size_t v = 0; v < vertex_count; ++v) {
        std::sort(result.wedges.begin() + static_cast<std::ptrdiff_t>(result.starts[v]),
                  result.wedges.begin() + static_cast<std::ptrdiff_t>(result.starts[v + 1]),
                  [](const Wedge& a, const Wedge& b) { return a.from < b.from; });
    }
    return result;
}

// What triangles make of a vertex, or of the whole surface; the worst comes first.
enum class Kind { NoManifold, Bounded, Closed };

// One ring is closed, one chain bounded. Every `from` and every `to` must stand once.
Kind kindOfFan(const Wedge* wedges, std::size_t count)
{
    const auto follower = [&](std::size_t i) {
        const Wedge* end = wedges + count;
        const Wedge* found = std::lower_bound(wedges, end, wedges[i].to,
                                              [](const Wedge& wedge, std::uint32_t from) { return wedge.from < from; });
        return found != end && found->from == wedges[i].to ? static_cast<std::size_t>(found - wedges) : count;
    };
    // A chain has to be walked from its first wedge, the one following none: the sum of all indices less that of the
    // followers. In a ring this is 0, as good as any.
    std::size_t first = 0;
    std::size_t followed = 0;
    for (std::size_t i = 0; i < count; ++i) {
        first += i;
        if (const std::size_t next = follower(i); next != count) {
            first -= next;
            ++followed;
        }
    }
    if (followed + 1 < count) {
        return Kind::NoManifold;
    }
    std::size_t walked = 1;
    for (std::size_t i = follower(first); i != count && i != first; i = follower(i)) {
        ++walked;
    }
    if (walked < count) {
        return Kind::NoManifold;
    }
    return followed == count ? Kind::Closed : Kind::Bounded;
}

std::vector<Triangle> weldedTriangles(const Surface& surface)
{
    std::vector<Triangle> triangles = surface.triangles;
    for (Triangle& triangle : triangles) {
        for (std::uint32_t& vertex : triangle) {
            vertex = surface.weld[vertex];
        }
    }
    return triangles;
}

Kind kindOf(const std::vector<Triangle>& triangles, std::size_t vertex_count)
{
    for (const auto& [a, b, c] : triangles) {
        if (a == b || b == c || c == a) {
            return Kind::NoManifold;
        }
    }
    const Wedges around = wedgesOf(triangles, vertex_count);
    const auto wedges_at = [&](std::size_t v) { return around.wedges.data() + around.starts[v]; };
    const auto count_at = [&](std::size_t v) { return around.starts[v + 1] - around.starts[v]; };
    for (std::size_t v = 0; v < vertex_count; ++v) {
        const Wedge* wedges = wedges_at(v);
        for (std::size_t i = 1; i < count_at(v); ++i) {
            if (wedges[i].from == wedges[i - 1].from) {
                return Kind::NoManifold;  // the edge is run through twice in one direction
            }
        }
    }
    Kind whole = Kind::Closed;
    for (std::size_t v = 0; v < vertex_count; ++v) {
        if (count_at(v) > 0) {
            whole = std::min(whole, kindOfFan(wedges_at(v), count_at(v)));
        }
    }
    return whole;
}

HalfEdgeMesh halfEdges(const std::vector<Triangle>& triangles, std::size_t vertex_count)
{
    std::vector<OpenMesh::VertexHandle> handles(vertex_count);
    HalfEdgeMesh mesh;
    for (const Triangle& triangle : triangles) {
        for (const std::uint32_t vertex : triangle) {
            if (!handles[vertex].is_valid()) {
                handles[vertex] = mesh.new_vertex();
            }
        }
        mesh.add_face(handles[triangle[0]], handles[triangle[1]], handles[triangle[2]]);
    }
    return mesh;
}

std::size_t countComponents(const HalfEdgeMesh& mesh)
{
    std::vector<bool> seen(mesh.n_vertices(), false);
    std::vector<OpenMesh::VertexHandle> open;
    std::size_t count = 0;
    const auto visit = [&](OpenMesh::VertexHandle vertex) {
        const auto index = static_cast<std::size_t>(vertex.idx());
        if (!seen[index]) {
            seen[index] = true;
            open.push_back(vertex);
        }
    };
    for (const auto start : mesh.vertices()) {
        if (seen[static_cast<std::size_t>(start.idx())]) {
            continue;
        }
        ++count;
        visit(start);
        while (!open.empty()) {
            const OpenMesh::VertexHandle vertex = open.back();
            open.pop_back();
            for (auto neighbour = mesh.cvv_begin(vertex); neighbour.is_valid(); ++neighbour) {
                visit(*neighbour);
            }
        }
    }
    return count;
}

std::size_t countBoundaryLoops(const HalfEdgeMesh& mesh)
{
    std::vector<bool> seen(mesh.n_halfedges(), false);
    std::size_t count = 0;
    for (const auto start : mesh.halfedges()) {
        if (!mesh.is_boundary(start) || seen[static_cast<std::size_t>(start.idx())]) {
            continue;
        }
        ++count;
        OpenMesh::HalfedgeHandle at = start;
        while (!seen[static_cast<std::size_t>(at.idx())]) {
            seen[static_cast<std::size_t>(at.idx())] = true;
            at = mesh.next_halfedge_handle(at);
        }
    }
    return count;
}

}  // namespace

void Surface::validate() const
{
    const std::size_t count = positions.size();
    if (triangles.empty()) {
        throw Error(ErrorCode::InvalidArgument, "surface.triangles is empty; there must be at least one");
    }
    if (normals.size() != count || uvs.size() != count || weld.size() != count) {
        throw Error(ErrorCode::InvalidArgument,
                    "surface has " + std::to_string(count) + " positions, " + std::to_string(normals.size()) +
                        " normals, " + std::to_string(uvs.size()) + " uvs, " + std::to_string(weld.size()) +
                        " weld entries; there must be equally many");
    }
    if (!std::isfinite(mean_height) || mean_height < 0.0) {
        throw Error(ErrorCode::InvalidArgument,
                    "surface.mean_height = " + std::to_string(mean_height) + " must be finite and not negative");
    }
    for (std::size_t i = 0; i < count; ++i) {
        if (!finite(positions[i])) {
            refuse("positions", i, "must be finite");
        }
        if (!(std::abs(length(normals[i]) - 1.0) <= kUnitTolerance)) {
            refuse("normals", i, "must have length 1");
        }
        if (!finite(uvs[i])) {
            refuse("uvs", i, "must be finite");
        }
        if (weld[i] > i || weld[weld[i]] != weld[i] || !(positions[weld[i]] == positions[i])) {
            refuse("weld", i, "= " + std::to_string(weld[i]) + " must be the first vertex at the same place");
        }
    }
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        for (const std::uint32_t vertex : triangles[i]) {
            if (vertex >= count) {
                refuse("triangles", i, "names vertex " + std::to_string(vertex) + " of " + std::to_string(count));
            }
        }
    }
}

bool isClosed(const Surface& surface)
{
    surface.validate();
    return kindOf(weldedTriangles(surface), surface.positions.size()) == Kind::Closed;
}

Topology topology(const Surface& surface)
{
    surface.validate();
    const std::vector<Triangle> triangles = weldedTriangles(surface);
    // Half-edges cannot hold anything but manifolds, and OpenMesh prints when it is tried; so it is known beforehand.
    const Kind kind = kindOf(triangles, surface.positions.size());
    Topology result;
    result.manifold = kind != Kind::NoManifold;
    if (!result.manifold) {
        return result;
    }
    const HalfEdgeMesh mesh = halfEdges(triangles, surface.positions.size());
    result.euler =
        static_cast<long>(mesh.n_vertices()) - static_cast<long>(mesh.n_edges()) + static_cast<long>(mesh.n_faces());
    result.components = countComponents(mesh);
    result.boundary_loops = countBoundaryLoops(mesh);
    result.closed = result.boundary_loops == 0;
    return result;
}

double enclosedVolume(const Surface& surface)
{
    // ∫ div(0, 0, z) dV: every triangle's signed area in the plane times its mean height.
    double volume = 0.0;
    for (const auto& [ia, ib, ic] : surface.triangles) {
        const Vec3 a = surface.positions[ia];
        const Vec3 b = surface.positions[ib];
        const Vec3 c = surface.positions[ic];
        const double double_area = cross(Vec2{b.x - a.x, b.y - a.y}, Vec2{c.x - a.x, c.y - a.y});
        volume += double_area * (a.z + b.z + c.z) / 6.0;
    }
    return volume;
}

}  // namespace droplet
