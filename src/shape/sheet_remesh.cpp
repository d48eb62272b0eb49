// SPDX-License-Identifier: GPL-3.0-or-later
// M. Botsch, L. Kobbelt, "A remeshing approach to multiresolution modeling" (2004): splits, collapses, flips and
// tangential smoothing. Departures: sizes follow the curvature; flips are Delaunay's instead of valences; flips and
// smoothing come first, for splitting the needles of planar meshes would never end; the rim is untouched.
#include "shape/sheet_remesh.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <queue>
#include <utility>

namespace droplet {
namespace {

struct Traits : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
    using Normal = OpenMesh::Vec3d;
    VertexAttributes(OpenMesh::Attributes::Status);
    EdgeAttributes(OpenMesh::Attributes::Status);
    HalfedgeAttributes(OpenMesh::Attributes::PrevHalfedge | OpenMesh::Attributes::Status);
    FaceAttributes(OpenMesh::Attributes::Status);
};
using HalfEdgeMesh = OpenMesh::TriMesh_ArrayKernelT<Traits>;
using Point = OpenMesh::Vec3d;
using VertexHandle = HalfEdgeMesh::VertexHandle;
using HalfedgeHandle = HalfEdgeMesh::HalfedgeHandle;
using EdgeHandle = HalfEdgeMesh::EdgeHandle;
using FaceHandle = HalfEdgeMesh::FaceHandle;

/// Edges over curvature, growth of edges over length, and ratios to the wanted length that are split and collapsed.
constexpr double kBend = 0.35;
constexpr double kGrowth = 0.3;
constexpr double kLong = 4.0 / 3.0;
constexpr double kShort = 0.75;
/// Cosine of the largest turn of a triangle: 45°.
constexpr double kTurn = 0.707;
/// Cosine of the sharpest edge that is flipped: 60°.
constexpr double kSharp = 0.5;
constexpr int kFlipRounds = 10;
/// Shape of a triangle, 1 if equilateral, below which a collapse must not make one, unless there is a worse one.
constexpr double kGoodShape = 0.35;

class Remesher {
public:
    Remesher(const SheetMesh& sheet, const RemeshOptions& options)
        : rim_(static_cast<int>(sheet.rim)), options_(options)
    {
        for (const Vec3& p : sheet.places) {
            mesh_.add_vertex(Point(p.x, p.y, p.z));
        }
        for (const Triangle& t : sheet.triangles) {
            mesh_.add_face(mesh_.vertex_handle(t[0]), mesh_.vertex_handle(t[1]), mesh_.vertex_handle(t[2]));
        }
    }

    SheetMesh run()
    {
        findNormals();
        flip();
        smooth();
        flip();
        findSizes();
        for (int round = 0; round < options_.rounds; ++round) {
            findNormals();
            split();
            collapse();
            flip();
            findNormals();
            smooth();
            smooth();
        }
        flip();
        return result();
    }

    SheetMesh relax(int rounds)
    {
        for (int round = 0; round < rounds; ++round) {
            findNormals();
            smooth();
        }
        return result();
    }

private:
    [[nodiscard]] bool onRim(VertexHandle v) const { return v.idx() < rim_; }

    [[nodiscard]] static Point areaVector(const Point& a, const Point& b, const Point& c)
    {
        return 0.5 * OpenMesh::cross(b - a, c - a);
    }

    [[nodiscard]] Point areaVector(FaceHandle face) const
    {
        auto v = mesh_.cfv_begin(face);
        const Point a = mesh_.point(*v++);
        const Point b = mesh_.point(*v++);
        return areaVector(a, b, mesh_.point(*v));
    }

    [[nodiscard]] bool onGround(VertexHandle v) const
    {
        return options_.is_ground_flat && mesh_.point(v)[2] <= 0.0 &&
               normals_[static_cast<std::size_t>(v.idx())][2] < 0.0;
    }

    void findNormals()
    {
        normals_.assign(mesh_.n_vertices(), Point(0.0, 0.0, 0.0));
        for (const FaceHandle face : mesh_.faces()) {
            const Point normal = areaVector(face);
            for (const VertexHandle v : mesh_.fv_range(face)) {
                normals_[static_cast<std::size_t>(v.idx())] += normal;
            }
        }
        for (Point& normal : normals_) {
            normal.normalize_cond();
        }
    }

    [[nodiscard]] double lengthOf(EdgeHandle edge) const { return mesh_.calc_edge_length(edge); }

    /// Wanted length of edges at every vertex.
    void findSizes()
    {
        findNormals();
        sizes_.assign(mesh_.n_vertices(), 0.0);
        using Entry = std::pair<double, int>;
        std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
        for (const VertexHandle v : mesh_.vertices()) {
            double size = 0.0;
            if (onRim(v)) {
                for (const EdgeHandle edge : mesh_.ve_range(v)) {
                    size = mesh_.is_boundary(edge) ? std::max(size, lengthOf(edge)) : size;
                }
                size = std::min(size, options_.edge);
            } else {
                double bend = 0.0;
                for (const VertexHandle other : mesh_.vv_range(v)) {
                    const Point side = mesh_.point(other) - mesh_.point(v);
                    const Point turn =
                        normals_[static_cast<std::size_t>(other.idx())] - normals_[static_cast<std::size_t>(v.idx())];
                    bend = onRim(other) ? bend : std::max(bend, turn.norm() / side.norm());
                }
                size = bend > 0.0 ? std::clamp(kBend / bend, options_.min_edge, options_.edge) : options_.edge;
            }
            sizes_[static_cast<std::size_t>(v.idx())] = size;
            queue.emplace(size, v.idx());
        }
        // Sizes grow by no more than a part of the way from every vertex.
        while (!queue.empty()) {
            const auto [size, index] = queue.top();
            queue.pop();
            if (size > sizes_[static_cast<std::size_t>(index)]) {
                continue;
            }
            const VertexHandle v(index);
            for (const VertexHandle other : mesh_.vv_range(v)) {
                const double limit = size + kGrowth * (mesh_.point(other) - mesh_.point(v)).norm();
                double& there = sizes_[static_cast<std::size_t>(other.idx())];
                if (limit < there) {
                    there = limit;
                    queue.emplace(limit, other.idx());
                }
            }
        }
    }

    [[nodiscard]] double wanted(VertexHandle a, VertexHandle b) const
    {
        return 0.5 * (sizes_[static_cast<std::size_t>(a.idx())] + sizes_[static_cast<std::size_t>(b.idx())]);
    }

    /// Middle of an edge on the cubic with the tangents of the sheet at its ends.
    [[nodiscard]] Point middle(VertexHandle a, VertexHandle b) const
    {
        const Point side = mesh_.point(b) - mesh_.point(a);
        const auto tangent = [&](VertexHandle v) {
            const Point& normal = normals_[static_cast<std::size_t>(v.idx())];
            return side - (side | normal) * normal;
        };
        Point bulge = 0.125 * (tangent(a) - tangent(b));
        // The normal of a rim vertex is that of triangles on one side: half of the bulge is known.
        if (onRim(a) != onRim(b)) {
            bulge *= 0.5;
        } else if (onRim(a)) {
            bulge = Point(0.0, 0.0, 0.0);
        }
        const double limit = 0.2 * side.norm();
        if (bulge.norm() > limit) {
            bulge *= limit / bulge.norm();
        }
        Point place = 0.5 * (mesh_.point(a) + mesh_.point(b)) + bulge;
        if (onGround(a) && onGround(b)) {
            place[2] = 0.0;
        }
        return place;
    }

    [[nodiscard]] std::pair<VertexHandle, VertexHandle> endsOf(EdgeHandle edge) const
    {
        const HalfedgeHandle h = mesh_.halfedge_handle(edge, 0);
        return {mesh_.from_vertex_handle(h), mesh_.to_vertex_handle(h)};
    }

    [[nodiscard]] bool isLongestSomewhere(EdgeHandle edge) const
    {
        const double length = lengthOf(edge) * (1.0 + 1e-9);
        for (const int side : {0, 1}) {
            const HalfedgeHandle h = mesh_.halfedge_handle(edge, static_cast<unsigned>(side));
            const HalfedgeHandle next = mesh_.next_halfedge_handle(h);
            if (length >= lengthOf(mesh_.edge_handle(next)) &&
                length >= lengthOf(mesh_.edge_handle(mesh_.next_halfedge_handle(next)))) {
                return true;
            }
        }
        return false;
    }

    void split()
    {
        std::vector<std::pair<double, EdgeHandle>> edges;
        for (const EdgeHandle edge : mesh_.edges()) {
            if (mesh_.is_boundary(edge)) {
                continue;
            }
            const auto [a, b] = endsOf(edge);
            const double ratio = lengthOf(edge) / wanted(a, b);
            if (onRim(a) && onRim(b)) {
                edges.emplace_back(1e9 + ratio, edge);
            } else if (ratio > kLong) {
                edges.emplace_back(ratio, edge);
            }
        }
        std::stable_sort(edges.begin(), edges.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
        for (const auto& [ratio, edge] : edges) {
            const auto [a, b] = endsOf(edge);
            const bool joins_rim = onRim(a) && onRim(b);
            if (!joins_rim && !isLongestSomewhere(edge)) {
                continue;
            }
            const Point place = middle(a, b);
            const VertexHandle v(mesh_.add_vertex(place).idx());
            sizes_.push_back(wanted(a, b));
            Point normal = normals_[static_cast<std::size_t>(a.idx())] + normals_[static_cast<std::size_t>(b.idx())];
            normals_.push_back(normal.normalize_cond());
            mesh_.split(edge, v);
        }
    }

    [[nodiscard]] static double shapeOf(const Point& a, const Point& b, const Point& c)
    {
        return 4.0 * std::numbers::sqrt3 * areaVector(a, b, c).norm() /
               ((b - a).sqrnorm() + (c - b).sqrnorm() + (a - c).sqrnorm());
    }

    /// Whether triangles around a vertex that moves to a place stay much as they are; those of `gone` vanish.
    [[nodiscard]] bool staysFlat(VertexHandle v, const Point& place, VertexHandle gone) const
    {
        for (const FaceHandle face : mesh_.vf_range(v)) {
            std::array<Point, 3> before;
            std::array<Point, 3> after;
            bool vanishes = false;
            std::size_t k = 0;
            for (const VertexHandle corner : mesh_.fv_range(face)) {
                vanishes = vanishes || corner == gone;
                before[k] = mesh_.point(corner);
                after[k++] = corner == v ? place : mesh_.point(corner);
            }
            if (vanishes) {
                continue;
            }
            const Point a = areaVector(before[0], before[1], before[2]);
            const Point b = areaVector(after[0], after[1], after[2]);
            if ((a | b) < kTurn * a.norm() * b.norm() || b.norm() < 0.1 * a.norm()) {
                return false;
            }
            const double shape = shapeOf(after[0], after[1], after[2]);
            if (shape < kGoodShape && shape < shapeOf(before[0], before[1], before[2])) {
                return false;
            }
        }
        return true;
    }

    void collapse()
    {
        std::vector<std::pair<double, EdgeHandle>> edges;
        for (const EdgeHandle edge : mesh_.edges()) {
            const auto [a, b] = endsOf(edge);
            const double ratio = lengthOf(edge) / wanted(a, b);
            if (ratio < kShort && !(onRim(a) && onRim(b))) {
                edges.emplace_back(ratio, edge);
            }
        }
        std::stable_sort(edges.begin(), edges.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
        for (const auto& [ratio, edge] : edges) {
            if (mesh_.status(edge).deleted()) {
                continue;
            }
            HalfedgeHandle h = mesh_.halfedge_handle(edge, 0);
            if (onRim(mesh_.from_vertex_handle(h))) {
                h = mesh_.opposite_halfedge_handle(h);
            }
            const VertexHandle gone = mesh_.from_vertex_handle(h);
            const VertexHandle kept = mesh_.to_vertex_handle(h);
            if (lengthOf(edge) > kShort * wanted(gone, kept) || !mesh_.is_collapse_ok(h) || !mayCollapse(h)) {
                continue;
            }
            const Point place = onRim(kept) ? mesh_.point(kept) : middle(gone, kept);
            if (!staysFlat(gone, place, kept) || (!onRim(kept) && !staysFlat(kept, place, gone))) {
                continue;
            }
            bool grows = false;
            for (const VertexHandle other : mesh_.vv_range(gone)) {
                grows = grows || (other != kept && (mesh_.point(other) - place).norm() > kLong * wanted(other, kept));
            }
            if (grows) {
                continue;
            }
            mesh_.set_point(kept, place);
            mesh_.collapse(h);
        }
    }

    /// Whether a collapse leaves no edge inside between two rim vertices.
    [[nodiscard]] bool mayCollapse(HalfedgeHandle h) const
    {
        const VertexHandle gone = mesh_.from_vertex_handle(h);
        const VertexHandle kept = mesh_.to_vertex_handle(h);
        if (!onRim(kept)) {
            return true;
        }
        for (const VertexHandle other : mesh_.vv_range(gone)) {
            if (other == kept || !onRim(other)) {
                continue;
            }
            const HalfedgeHandle joining(mesh_.find_halfedge(kept, other).idx());
            if (!joining.is_valid() || !mesh_.is_boundary(mesh_.edge_handle(joining))) {
                return false;
            }
        }
        return true;
    }

    void flip()
    {
        for (int round = 0; round < kFlipRounds; ++round) {
            bool has_flipped = false;
            for (const EdgeHandle edge : mesh_.edges()) {
                if (mesh_.is_boundary(edge) || !shouldFlip(edge) || !mesh_.is_flip_ok(edge)) {
                    continue;
                }
                mesh_.flip(edge);
                has_flipped = true;
            }
            if (!has_flipped) {
                return;
            }
        }
    }

    [[nodiscard]] bool shouldFlip(EdgeHandle edge) const
    {
        const HalfedgeHandle h = mesh_.halfedge_handle(edge, 0);
        const HalfedgeHandle o = mesh_.halfedge_handle(edge, 1);
        const VertexHandle left = mesh_.to_vertex_handle(mesh_.next_halfedge_handle(h));
        const VertexHandle right = mesh_.to_vertex_handle(mesh_.next_halfedge_handle(o));
        if (onRim(left) && onRim(right)) {
            return false;
        }
        const Point& a = mesh_.point(mesh_.from_vertex_handle(h));
        const Point& b = mesh_.point(mesh_.to_vertex_handle(h));
        const Point& c = mesh_.point(left);
        const Point& d = mesh_.point(right);
        const auto angle = [](const Point& at, const Point& p, const Point& q) {
            return std::atan2(OpenMesh::cross(p - at, q - at).norm(), (p - at) | (q - at));
        };
        if (angle(c, a, b) + angle(d, a, b) <= std::numbers::pi * (1.0 + 1e-6)) {
            return false;
        }
        // In space, flips by angles alone may make needles where the sheet is folded.
        if (std::min(shapeOf(a, d, c), shapeOf(d, b, c)) <= std::min(shapeOf(a, b, c), shapeOf(b, a, d))) {
            return false;
        }
        Point old_left = areaVector(a, b, c);
        Point old_right = areaVector(b, a, d);
        Point new_first = areaVector(a, d, c);
        Point new_second = areaVector(d, b, c);
        const Point mean = (old_left + old_right).normalize_cond();
        if (new_first.norm() == 0.0 || new_second.norm() == 0.0) {
            return false;
        }
        new_first.normalize();
        new_second.normalize();
        old_left.normalize_cond();
        old_right.normalize_cond();
        // Needles have normals of no meaning.
        const bool is_needle =
            std::min(areaVector(a, b, c).norm(), areaVector(b, a, d).norm()) < 1e-3 * (b - a).sqrnorm();
        return (is_needle || (old_left | old_right) > kSharp) && (new_first | mean) > kSharp &&
               (new_second | mean) > kSharp && (new_first | new_second) > kSharp;
    }

    /// Moves vertices inside towards the middle of their triangles, along the sheet.
    void smooth()
    {
        for (const VertexHandle v : mesh_.vertices()) {
            if (onRim(v)) {
                continue;
            }
            Point centre(0.0, 0.0, 0.0);
            double total = 0.0;
            for (const FaceHandle face : mesh_.vf_range(v)) {
                const double area = areaVector(face).norm();
                Point sum(0.0, 0.0, 0.0);
                for (const VertexHandle corner : mesh_.fv_range(face)) {
                    sum += mesh_.point(corner);
                }
                centre += area / 3.0 * sum;
                total += area;
            }
            if (!(total > 0.0)) {
                continue;
            }
            Point way = centre / total - mesh_.point(v);
            const Point normal = onGround(v) ? Point(0.0, 0.0, -1.0) : normals_[static_cast<std::size_t>(v.idx())];
            way -= (way | normal) * normal;
            Point place = mesh_.point(v) + way;
            if (options_.is_ground_flat && place[2] < 0.0 && normal[2] < 0.0) {
                place[2] = 0.0;
            }
            if (staysFlat(v, place, VertexHandle())) {
                mesh_.set_point(v, place);
            }
        }
    }

    [[nodiscard]] SheetMesh result() const
    {
        SheetMesh sheet;
        sheet.rim = static_cast<std::uint32_t>(rim_);
        std::vector<std::uint32_t> number(mesh_.n_vertices(), 0);
        for (const VertexHandle v : mesh_.vertices()) {
            number[static_cast<std::size_t>(v.idx())] = static_cast<std::uint32_t>(sheet.places.size());
            const Point& p = mesh_.point(v);
            sheet.places.push_back({p[0], p[1], p[2]});
        }
        for (const FaceHandle face : mesh_.faces()) {
            Triangle& t = sheet.triangles.emplace_back();
            std::size_t k = 0;
            for (const VertexHandle v : mesh_.fv_range(face)) {
                t[k++] = number[static_cast<std::size_t>(v.idx())];
            }
        }
        return sheet;
    }

    int rim_;
    RemeshOptions options_;
    HalfEdgeMesh mesh_;
    std::vector<Point> normals_;
    std::vector<double> sizes_;
};

}  // namespace

SheetMesh remesh(const SheetMesh& sheet, const RemeshOptions& options)
{
    return Remesher(sheet, options).run();
}

SheetMesh relax(const SheetMesh& sheet, int rounds, bool is_ground_flat)
{
    SheetMesh relaxed = Remesher(sheet, {.is_ground_flat = is_ground_flat}).relax(rounds);
    relaxed.triangles = sheet.triangles;  // half-edges may turn them
    return relaxed;
}

std::vector<double> minAngles(const SheetMesh& sheet)
{
    std::vector<double> angles;
    angles.reserve(sheet.triangles.size());
    for (const Triangle& t : sheet.triangles) {
        double least = std::numbers::pi;
        for (std::size_t a = 0; a < 3; ++a) {
            const Vec3 p = sheet.places[t[(a + 1) % 3]] - sheet.places[t[a]];
            const Vec3 q = sheet.places[t[(a + 2) % 3]] - sheet.places[t[a]];
            least = std::min(least, std::atan2(length(cross(p, q)), dot(p, q)));
        }
        angles.push_back(least);
    }
    return angles;
}

bool isWorn(const std::vector<double>& before, const SheetMesh& sheet, double share)
{
    constexpr double kNarrow = std::numbers::pi / 10.0;
    const std::vector<double> now = minAngles(sheet);
    for (std::size_t k = 0; k < now.size(); ++k) {
        if (now[k] < std::min(kNarrow, share * before[k])) {
            return true;
        }
    }
    return false;
}

}  // namespace droplet
