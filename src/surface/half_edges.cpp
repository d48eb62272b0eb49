// SPDX-License-Identifier: GPL-3.0-or-later
// M. Botsch, S. Steinberg, S. Bischoff, L. Kobbelt, "OpenMesh: a generic and efficient polygon mesh data structure"
// (2002).
#include "surface/half_edges.h"

#include <algorithm>
#include <mutex>
#include <string>
#include <unordered_map>
#include <utility>

#include "droplet/error.h"
#include "surface/open_edges.h"

// OpenMesh returns handles with a mesh, and its functions take handles without one.
// NOLINTBEGIN(cppcoreguidelines-slicing)

namespace droplet {
namespace {

/// Turns off OpenMesh's messages. It prints one for every triangle that it refuses, to a stream of the whole process.
class Silence {
public:
    Silence() : lock_(mutex()), was_enabled_(omerr().is_enabled()) { omerr().disable(); }
    Silence(const Silence&) = delete;
    Silence& operator=(const Silence&) = delete;
    ~Silence()
    {
        if (was_enabled_) {
            omerr().enable();
        }
    }

private:
    static std::mutex& mutex()
    {
        static std::mutex one;
        return one;
    }

    std::lock_guard<std::mutex> lock_;
    bool was_enabled_;
};

bool isDegenerate(const Triangle& t)
{
    return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

}  // namespace

HalfEdges halfEdges(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles)
{
    constexpr std::size_t kMax = std::size_t{1} << 28;  // indices of half-edges are int, with up to six for a triangle
    if (triangles.size() > kMax || vertices.size() > kMax) {
        throw Error(ErrorCode::InvalidArgument, "surface has " + std::to_string(triangles.size()) + " triangles and " +
                                                    std::to_string(vertices.size()) + " vertices; up to " +
                                                    std::to_string(kMax) + " can be examined");
    }
    const Silence silence;
    HalfEdges result;
    auto& mesh = result.mesh;
    mesh.reserve(vertices.size(), triangles.size() * 3 / 2 + vertices.size() / 8, triangles.size());
    const auto add_vertex = [&](Vec3 p) { return mesh.add_vertex({p.x, p.y, p.z}); };
    for (const Vec3 p : vertices) {
        add_vertex(p);
    }
    const auto add_face = [&](std::uint32_t t, const auto& vertex) {
        const auto& [a, b, c] = triangles[t];
        const OpenMesh::FaceHandle face = mesh.add_face(vertex(a), vertex(b), vertex(c));
        if (face.is_valid()) {
            result.triangles.push_back(t);
        }
        return face.is_valid();
    };
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        if (isDegenerate(triangles[t]) ||
            !add_face(t, [](std::uint32_t v) { return OpenMesh::VertexHandle(static_cast<int>(v)); })) {
            result.separate.push_back(t);
        }
    }
    for (const std::uint32_t t : result.separate) {
        add_face(t, [&](std::uint32_t v) { return add_vertex(vertices[v]); });
    }
    return result;
}

UnionFind joinedAcrossEdges(const HalfEdges& half_edges, const std::vector<Triangle>& triangles)
{
    const auto& mesh = half_edges.mesh;
    UnionFind joined(triangles.size());
    const auto join = [&](std::uint32_t t, OpenMesh::FaceHandle face) {
        if (face.is_valid()) {
            joined.join(t, half_edges.triangles[static_cast<std::size_t>(face.idx())]);
        }
    };
    for (const auto h : mesh.halfedges()) {
        if (const OpenMesh::FaceHandle face = mesh.face_handle(h); face.is_valid()) {
            join(half_edges.triangles[static_cast<std::size_t>(face.idx())], mesh.opposite_face_handle(h));
        }
    }
    std::unordered_map<std::uint64_t, std::uint32_t> first;  // separate triangle at every edge
    for (const std::uint32_t t : half_edges.separate) {
        for (std::size_t k = 0; k < 3; ++k) {
            const auto [low, high] = std::minmax(triangles[t][k], triangles[t][(k + 1) % 3]);
            joined.join(t, first.try_emplace(std::uint64_t{low} << 32 | high, t).first->second);
            const OpenMesh::HalfedgeHandle beside = mesh.find_halfedge(OpenMesh::VertexHandle(static_cast<int>(low)),
                                                                       OpenMesh::VertexHandle(static_cast<int>(high)));
            if (beside.is_valid()) {
                join(t, mesh.face_handle(beside));
                join(t, mesh.opposite_face_handle(beside));
            }
        }
    }
    return joined;
}

Topology topology(const HalfEdges& half_edges)
{
    const auto& mesh = half_edges.mesh;
    Topology result;
    std::size_t vertices = 0;
    std::size_t around = 0;
    bool manifold = half_edges.separate.empty();
    for (const auto v : mesh.vertices()) {
        vertices += mesh.is_isolated(v) ? 0 : 1;
        around += mesh.valence(v);
        manifold = manifold && mesh.is_manifold(v);
    }
    // OpenMesh visits only one of two rings around a vertex.
    if (!manifold || around != mesh.n_halfedges()) {
        return result;
    }
    UnionFind joined(mesh.n_vertices());
    result.manifold = true;
    result.components = vertices;
    std::vector<bool> walked(mesh.n_halfedges(), false);
    for (const auto h : mesh.halfedges()) {
        const auto from = static_cast<std::uint32_t>(mesh.from_vertex_handle(h).idx());
        result.components -= joined.join(from, static_cast<std::uint32_t>(mesh.to_vertex_handle(h).idx())) ? 1 : 0;
        if (mesh.is_boundary(h) && !walked[static_cast<std::size_t>(h.idx())]) {
            ++result.boundary_loops;
            for (OpenMesh::HalfedgeHandle at = h; !walked[static_cast<std::size_t>(at.idx())];
                 at = mesh.next_halfedge_handle(at)) {
                walked[static_cast<std::size_t>(at.idx())] = true;
            }
        }
    }
    result.closed = result.boundary_loops == 0;
    result.euler = static_cast<long>(vertices + mesh.n_faces()) - static_cast<long>(mesh.n_edges());
    return result;
}

HalfEdges halfEdges(const Surface& surface)
{
    return halfEdges(surface.vertices, weldedTriangles(surface.triangles, surface.weld));
}

}  // namespace droplet

// NOLINTEND(cppcoreguidelines-slicing)
