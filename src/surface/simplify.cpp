// SPDX-License-Identifier: GPL-3.0-or-later
//
// Edges are collapsed by their error, M. Garland and P. Heckbert, "Surface simplification using quadric error metrics"
// (1997), on OpenMesh, which tells collapses that would change the topology; meshoptimizer 0.18 leaves doubled
// triangles on some droplets. Creases, where a vertex has several normals, are collapsed along themselves alone,
// and planes upright on them count as well, since a flat rim has hardly a bend. Meshes that are triangulated and solved
// anew would have better triangles, but not as few: the detail of a logo's outline takes 8000, and that of a line of
// type 10 000, when 2000 are asked for.

#include "droplet/surface/simplify.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <queue>
#include <utility>
#include <vector>

#include "box_corners.h"
#include "droplet/error.h"
#include "surface/half_edges.h"
#include "surface/open_edges.h"

// OpenMesh returns handles with a mesh, and its functions take handles without one.
// NOLINTBEGIN(cppcoreguidelines-slicing)

namespace droplet {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

using MeshType = decltype(HalfEdges::mesh);
using Point = MeshType::Point;

/// Sum of squared distances from planes, with their weights: half of a symmetric matrix of four rows.
struct Quadric {
    std::array<double, 10> sum{};
    double weight = 0.0;

    /// @param normal  unit length
    void add(Point normal, Point at, double by)
    {
        const std::array<double, 4> plane{normal[0], normal[1], normal[2], -OpenMesh::dot(normal, at)};
        std::size_t k = 0;
        for (std::size_t i = 0; i < 4; ++i) {
            for (std::size_t j = i; j < 4; ++j) {
                sum[k++] += by * plane[i] * plane[j];
            }
        }
        weight += by;
    }
    void add(const Quadric& other)
    {
        std::transform(sum.begin(), sum.end(), other.sum.begin(), sum.begin(), std::plus<>());
        weight += other.weight;
    }
    [[nodiscard]] double at(Point point) const
    {
        const std::array<double, 4> place{point[0], point[1], point[2], 1.0};
        double value = 0.0;
        std::size_t k = 0;
        for (std::size_t i = 0; i < 4; ++i) {
            for (std::size_t j = i; j < 4; ++j) {
                value += (i == j ? 1.0 : 2.0) * sum[k++] * place[i] * place[j];
            }
        }
        return std::max(0.0, value);
    }
};

/// What collapses need and change.
struct Collapsing {
    const Surface& surface;
    std::vector<std::uint32_t> triangle_of;  ///< of every face
    std::vector<Triangle> corners;           ///< of every triangle: vertices of the surface
    std::vector<Quadric> quadrics = {};      ///< of every vertex of the mesh
    std::vector<int> creases = {};           ///< of every vertex of the mesh: number of edges on a crease
    double worst = 0.0;                      ///< largest error of a collapse

    /// Vertex of the surface at a face's corner.
    [[nodiscard]] std::uint32_t& corner(OpenMesh::FaceHandle face, OpenMesh::VertexHandle at)
    {
        Triangle& t = corners[triangle_of[static_cast<std::size_t>(face.idx())]];
        return *std::find_if(t.begin(), t.end() - 1,
                             [&](std::uint32_t v) { return surface.weld[v] == static_cast<std::uint32_t>(at.idx()); });
    }
    [[nodiscard]] Quadric& quadric(OpenMesh::VertexHandle v) { return quadrics[static_cast<std::size_t>(v.idx())]; }
    [[nodiscard]] int& crease(OpenMesh::VertexHandle v) { return creases[static_cast<std::size_t>(v.idx())]; }

    /// Whether the two sides of an edge have vertices of their own, or one side has no face.
    [[nodiscard]] bool isCrease(const MeshType& mesh, OpenMesh::HalfedgeHandle edge)
    {
        const OpenMesh::FaceHandle left = mesh.face_handle(edge);
        const OpenMesh::FaceHandle right = mesh.face_handle(mesh.opposite_halfedge_handle(edge));
        if (!left.is_valid() || !right.is_valid()) {
            return true;
        }
        const auto differs = [&](OpenMesh::VertexHandle v) { return corner(left, v) != corner(right, v); };
        return differs(mesh.from_vertex_handle(edge)) || differs(mesh.to_vertex_handle(edge));
    }
};

void addPlanes(const MeshType& mesh, Collapsing& data)
{
    data.quadrics.resize(mesh.n_vertices());
    data.creases.resize(mesh.n_vertices());
    for (const auto half : mesh.halfedges()) {
        const OpenMesh::FaceHandle face = mesh.face_handle(half);
        if (!face.is_valid()) {
            continue;
        }
        const OpenMesh::VertexHandle from = mesh.from_vertex_handle(half);
        const OpenMesh::VertexHandle to = mesh.to_vertex_handle(half);
        const Point along = mesh.point(to) - mesh.point(from);
        const Point across = OpenMesh::cross(along, mesh.point(mesh.opposite_vh(half)) - mesh.point(from));
        const double area = OpenMesh::norm(across);
        if (!(area > 0.0)) {
            continue;
        }
        const Point normal = across / area;
        data.quadric(from).add(normal, mesh.point(from), area);
        if (data.isCrease(mesh, half)) {
            const Point upright = OpenMesh::cross(along, normal) / OpenMesh::norm(along);
            for (const OpenMesh::VertexHandle end : {from, to}) {
                data.quadric(end).add(upright, mesh.point(from), OpenMesh::dot(along, along));
            }
        }
    }
    for (const auto edge : mesh.edges()) {
        const OpenMesh::HalfedgeHandle half = mesh.halfedge_handle(edge, 0);
        if (data.isCrease(mesh, half)) {
            ++data.crease(mesh.from_vertex_handle(half));
            ++data.crease(mesh.to_vertex_handle(half));
        }
    }
}

/// Collapse of a vertex into a neighbour, with the faces that vanish.
struct Collapse {
    OpenMesh::HalfedgeHandle half;
    OpenMesh::VertexHandle from;
    OpenMesh::VertexHandle to;
    std::array<OpenMesh::FaceHandle, 2> sides;       ///< left and right; may be invalid
    std::array<OpenMesh::VertexHandle, 2> opposite;  ///< their third vertices
};

Collapse collapseOf(const MeshType& mesh, OpenMesh::HalfedgeHandle half)
{
    Collapse collapse;
    collapse.half = half;
    collapse.from = mesh.from_vertex_handle(half);
    collapse.to = mesh.to_vertex_handle(half);
    for (std::size_t k = 0; k < 2; ++k) {
        const OpenMesh::HalfedgeHandle side = k == 0 ? half : mesh.opposite_halfedge_handle(half);
        collapse.sides[k] = mesh.face_handle(side);
        if (collapse.sides[k].is_valid()) {
            collapse.opposite[k] = mesh.to_vertex_handle(mesh.next_halfedge_handle(side));
        }
    }
    return collapse;
}

/// Collapses edges, the best ones first.
class Collapser {
public:
    Collapser(MeshType& mesh, Collapsing& data) : mesh_(mesh), data_(data), versions_(mesh.n_vertices())
    {
        mesh_.request_vertex_status();
        mesh_.request_halfedge_status();
        mesh_.request_edge_status();
        mesh_.request_face_status();
        for (const auto v : mesh_.vertices()) {
            propose(v);
        }
    }

    void reduceTo(std::size_t triangles)
    {
        std::size_t count = mesh_.n_faces();
        while (count > triangles && !queue_.empty()) {
            const Candidate best = queue_.top();
            queue_.pop();
            const OpenMesh::VertexHandle v = mesh_.from_vertex_handle(best.half);
            if (best.version != version(best.from) || mesh_.status(best.from).deleted()) {
                continue;
            }
            if (v != best.from || !isAllowed(collapseOf(mesh_, best.half))) {
                propose(best.from);
                continue;
            }
            const Collapse collapse = collapseOf(mesh_, best.half);
            carryOver(collapse);
            for (const OpenMesh::FaceHandle side : collapse.sides) {
                count -= side.is_valid() ? 1 : 0;
            }
            mesh_.collapse(best.half);
            propose(collapse.to);
            for (const auto neighbour : mesh_.vv_range(collapse.to)) {
                propose(neighbour);
            }
        }
    }

private:
    /// Best collapse of a vertex, until the vertex has another version.
    struct Candidate {
        double cost = 0.0;
        OpenMesh::VertexHandle from;
        OpenMesh::HalfedgeHandle half;
        unsigned version = 0;

        /// Order of a queue whose top costs least; the first of equals.
        friend bool operator<(const Candidate& a, const Candidate& b)
        {
            return std::pair(a.cost, a.from.idx()) > std::pair(b.cost, b.from.idx());
        }
    };

    unsigned& version(OpenMesh::VertexHandle v) { return versions_[static_cast<std::size_t>(v.idx())]; }

    void propose(OpenMesh::VertexHandle v)
    {
        ++version(v);
        std::optional<Candidate> best;
        for (const auto half : mesh_.voh_range(v)) {
            const Collapse collapse = collapseOf(mesh_, half);
            const double cost = costOf(collapse).first;
            if ((!best || cost < best->cost) && isAllowed(collapse)) {
                best = Candidate{cost, v, half, version(v)};
            }
        }
        if (best) {
            queue_.push(*best);
        }
    }

    bool isAllowed(const Collapse& collapse)
    {
        const int creases = data_.crease(collapse.from);
        const bool stays = creases == 0 || (creases == 2 && data_.isCrease(mesh_, collapse.half));
        return stays && keepsSides(collapse) && !thins(collapse) && !flips(collapse) &&
               mesh_.is_collapse_ok(collapse.half);
    }

    /// Adds the planes of the vertex that vanishes to the other one, and names the other one at its faces' corners.
    void carryOver(const Collapse& collapse)
    {
        const auto [cost, weight] = costOf(collapse);
        data_.worst = std::max(data_.worst, std::sqrt(cost / weight));
        data_.quadric(collapse.to).add(data_.quadric(collapse.from));
        std::vector<std::pair<std::uint32_t, std::uint32_t>> renamed;
        for (const OpenMesh::FaceHandle side : collapse.sides) {
            if (side.is_valid()) {
                renamed.emplace_back(data_.corner(side, collapse.from), data_.corner(side, collapse.to));
            }
        }
        for (const auto face : mesh_.vf_range(collapse.from)) {
            std::uint32_t& vertex = data_.corner(face, collapse.from);
            const auto found =
                std::find_if(renamed.begin(), renamed.end(), [&](const auto& pair) { return pair.first == vertex; });
            if (found != renamed.end()) {
                vertex = found->second;
            }
        }
    }

    /// Whether every copy of the vertex that vanishes has one of the other on its side.
    bool keepsSides(const Collapse& collapse)
    {
        const auto [left, right] = collapse.sides;
        return !left.is_valid() || !right.is_valid() ||
               data_.corner(left, collapse.from) != data_.corner(right, collapse.from) ||
               data_.corner(left, collapse.to) == data_.corner(right, collapse.to);
    }

    /// Whether a vertex would be left with two triangles that cover each other.
    bool thins(const Collapse& collapse) const
    {
        const bool few = std::any_of(collapse.opposite.begin(), collapse.opposite.end(), [&](OpenMesh::VertexHandle v) {
            return v.is_valid() && !mesh_.is_boundary(v) && mesh_.valence(v) <= 3;
        });
        return few || mesh_.valence(collapse.from) + mesh_.valence(collapse.to) < 7;
    }

    /// Whether a triangle would turn by more than 75°, or vanish.
    bool flips(const Collapse& collapse) const
    {
        constexpr double kCosine = 0.26;
        const Point old = mesh_.point(collapse.from);
        const Point now = mesh_.point(collapse.to);
        for (const auto half : mesh_.voh_range(collapse.from)) {
            const OpenMesh::FaceHandle face = mesh_.face_handle(half);
            if (!face.is_valid() || face == collapse.sides[0] || face == collapse.sides[1]) {
                continue;
            }
            const Point a = mesh_.point(mesh_.to_vertex_handle(half));
            const Point b = mesh_.point(mesh_.to_vertex_handle(mesh_.next_halfedge_handle(half)));
            const Point before = OpenMesh::cross(a - old, b - old);
            const Point after = OpenMesh::cross(a - now, b - now);
            if (!(OpenMesh::dot(before, after) > kCosine * OpenMesh::norm(before) * OpenMesh::norm(after))) {
                return true;
            }
        }
        return false;
    }

    /// Sum of squared distances of the vertex that stays from the planes of both, and its weight.
    std::pair<double, double> costOf(const Collapse& collapse)
    {
        Quadric both = data_.quadric(collapse.from);
        both.add(data_.quadric(collapse.to));
        return {both.at(mesh_.point(collapse.to)), both.weight};
    }

    MeshType& mesh_;
    Collapsing& data_;
    std::vector<unsigned> versions_;
    std::priority_queue<Candidate> queue_ = {};
};

/// Longest side of a box around a surface. The mesh is scaled by it, so that costs are far from the smallest number.
double longestSide(const Surface& surface)
{
    const auto [low, high] = cornersOf(surface.vertices);
    const Vec3 size = high - low;
    return std::max({size.x, size.y, size.z, std::numeric_limits<double>::min()});
}

}  // namespace

Surface withTriangles(const Surface& surface, std::vector<Triangle> triangles)
{
    std::vector<std::uint32_t> number(surface.vertices.size(), kNone);
    for (const Triangle& t : triangles) {
        for (const std::uint32_t v : t) {
            number[v] = 0;
        }
    }
    std::uint32_t count = 0;
    for (std::uint32_t& n : number) {
        n = n == kNone ? kNone : count++;
    }
    const auto kept = [&number](const auto& from) {
        auto to = from;
        to.clear();
        for (std::size_t v = 0; v < from.size(); ++v) {
            if (number[v] != kNone) {
                to.push_back(from[v]);
            }
        }
        return to;
    };
    Surface result;
    result.vertices = kept(surface.vertices);
    result.normals = kept(surface.normals);
    result.uvs = kept(surface.uvs);
    result.contact_angle = kept(surface.contact_angle);
    result.texture_map = surface.texture_map;
    result.mean_height = surface.mean_height;
    if (surface.refill) {
        result.refill = Refill{surface.refill->min, surface.refill->max, {}};
        for (const RefillState& state : surface.refill->states) {
            result.refill->states.push_back({state.fill, kept(state.vertices), kept(state.normals)});
        }
    }
    std::vector<std::uint32_t> first(surface.vertices.size(), kNone);  // that is left of all copies
    for (std::size_t v = 0; v < number.size(); ++v) {
        if (number[v] != kNone) {
            std::uint32_t& same = first[surface.weld[v]];
            same = std::min(same, number[v]);
            result.weld.push_back(same);
        }
    }
    auto t = triangles.begin();
    for (SurfacePart part : surface.parts) {
        const std::size_t end = part.first_vertex + part.vertices;
        const auto last = std::find_if(t, triangles.end(), [&](const Triangle& other) { return other[0] >= end; });
        const auto begin = number.begin() + static_cast<std::ptrdiff_t>(part.first_vertex);
        const auto lost = std::count(begin, begin + static_cast<std::ptrdiff_t>(part.vertices), kNone);
        part.first_vertex = result.parts.empty() ? 0 : result.parts.back().first_vertex + result.parts.back().vertices;
        part.vertices -= static_cast<std::size_t>(lost);
        part.first_triangle = static_cast<std::size_t>(t - triangles.begin());
        part.triangles = static_cast<std::size_t>(last - t);
        part.quads = 0;
        result.parts.push_back(part);
        t = last;
    }
    for (Triangle& triangle : triangles) {
        for (std::uint32_t& v : triangle) {
            v = number[v];
        }
    }
    result.triangles = std::move(triangles);
    return result;
}

SimplifiedSurface simplify(const Surface& surface, std::size_t triangles)
{
    surface.validate();
    if (triangles == 0) {
        throw Error(ErrorCode::InvalidArgument, "triangles 0 must be at least 1");
    }
    if (surface.triangles.size() <= triangles) {
        return {surface, 0.0};
    }
    HalfEdges half_edges = halfEdges(surface);
    if (!half_edges.separate.empty()) {
        throw Error(ErrorCode::InvalidArgument, "surface must be a manifold");
    }
    MeshType& mesh = half_edges.mesh;
    const double side = longestSide(surface);
    for (const auto v : mesh.vertices()) {
        mesh.point(v) /= side;
    }
    Collapsing data{surface, std::move(half_edges.triangles), surface.triangles};
    addPlanes(mesh, data);
    Collapser(mesh, data).reduceTo(triangles);
    std::vector<Triangle> kept;
    for (const auto face : mesh.all_faces()) {
        if (!mesh.status(face).deleted()) {
            kept.push_back(data.corners[data.triangle_of[static_cast<std::size_t>(face.idx())]]);
        }
    }
    // Triangles of a part have its vertices, which follow those of the part before.
    const auto part_of = [&](const Triangle& t) {
        return std::upper_bound(surface.parts.begin(), surface.parts.end(), t[0],
                                [](std::uint32_t v, const SurfacePart& part) { return v < part.first_vertex; });
    };
    std::stable_sort(kept.begin(), kept.end(),
                     [&](const Triangle& a, const Triangle& b) { return part_of(a) < part_of(b); });
    return {withTriangles(surface, std::move(kept)), data.worst * side};
}

Surface welded(const Surface& surface)
{
    surface.validate();
    return withTriangles(surface, weldedTriangles(surface.triangles, surface.weld));
}

}  // namespace droplet

// NOLINTEND(cppcoreguidelines-slicing)
