// SPDX-License-Identifier: GPL-3.0-or-later
// M. Botsch, L. Kobbelt, "A remeshing approach to multiresolution modeling" (2004): splits, collapses, flips and
// tangential smoothing. Departures: sizes follow the curvature; flips are Delaunay's instead of valences; flips and
// smoothing come first, for splitting the needles of planar meshes would never end; the rim is untouched.
#include "shape/sheet_remesh.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
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
/// Smoothings more of a division: with none, the smallest angles of an A and a star were 2° to 6°, with two 10° to 17°.
constexpr int kSmoothings = 2;
/// Most rounds more, until the number of triangles is near the wanted one, and the error that is near.
constexpr int kCountRounds = 6;
constexpr double kCountError = 0.05;
/// Classes of edges, per doubling of the length, of which the longest is split first.
constexpr double kLengths = 4.0;
/// Shape of a triangle, 1 if equilateral, below which the shortest edge of a divided one is collapsed, that of angles
/// of 15°, and rounds of that. After other rounds, sheets with folds were in equilibrium on fewer triangles with it.
constexpr double kNarrowShape = 0.5;
constexpr int kMendings = 3;
/// Shape of a triangle, 1 if equilateral, below which a collapse must not make one, unless there is a worse one.
constexpr double kGoodShape = 0.35;

/// Bits of a number, with two zeros after each.
std::uint64_t spread(std::uint64_t bits)
{
    std::uint64_t result = 0;
    for (unsigned k = 0; k < 21; ++k) {
        result |= (bits >> k & 1U) << (3 * k);
    }
    return result;
}

/// The same sheet, with inner vertices and triangles along a Z-curve: neighbours in space are so in memory.
CapillarySurface inSpaceOrder(const CapillarySurface& sheet)
{
    Vec3 least = sheet.vertices.front();
    Vec3 most = least;
    for (const Vec3& p : sheet.vertices) {
        least = {std::min(least.x, p.x), std::min(least.y, p.y), std::min(least.z, p.z)};
        most = {std::max(most.x, p.x), std::max(most.y, p.y), std::max(most.z, p.z)};
    }
    constexpr double kCells = 1023.0;
    const Vec3 size = most - least;
    const double scale = kCells / std::max({size.x, size.y, size.z});
    std::vector<std::pair<std::uint64_t, std::uint32_t>> keys;
    for (std::uint32_t v = sheet.rimVertexCount(); v < sheet.vertices.size(); ++v) {
        const Vec3 at = scale * (sheet.vertices[v] - least);
        keys.emplace_back(spread(static_cast<std::uint64_t>(at.x)) | spread(static_cast<std::uint64_t>(at.y)) << 1U |
                              spread(static_cast<std::uint64_t>(at.z)) << 2U,
                          v);
    }
    std::sort(keys.begin(), keys.end());
    CapillarySurface ordered;
    ordered.loop_starts = sheet.loop_starts;
    ordered.vertices.assign(sheet.vertices.begin(), sheet.vertices.begin() + sheet.rimVertexCount());
    std::vector<std::uint32_t> number(sheet.vertices.size());
    for (std::uint32_t v = 0; v < sheet.rimVertexCount(); ++v) {
        number[v] = v;
    }
    for (const auto& [key, v] : keys) {
        number[v] = static_cast<std::uint32_t>(ordered.vertices.size());
        ordered.vertices.push_back(sheet.vertices[v]);
    }
    std::vector<std::pair<std::uint32_t, std::uint32_t>> first;  // largest number of a corner, triangle
    for (std::uint32_t k = 0; k < sheet.triangles.size(); ++k) {
        const Triangle& t = sheet.triangles[k];
        first.emplace_back(std::max({number[t[0]], number[t[1]], number[t[2]]}), k);
    }
    std::sort(first.begin(), first.end());
    for (const auto& [vertex, k] : first) {
        const Triangle& t = sheet.triangles[k];
        ordered.triangles.push_back({number[t[0]], number[t[1]], number[t[2]]});
    }
    return ordered;
}

class Remesher {
public:
    Remesher(const CapillarySurface& sheet, const RemeshOptions& options)
        : loop_starts_(sheet.loop_starts), rim_(static_cast<int>(sheet.rimVertexCount())), options_(options)
    {
        for (const Vec3& p : sheet.vertices) {
            mesh_.add_vertex(Point(p.x, p.y, p.z));
        }
        for (const Triangle& t : sheet.triangles) {
            mesh_.add_face(mesh_.vertex_handle(t[0]), mesh_.vertex_handle(t[1]), mesh_.vertex_handle(t[2]));
        }
    }

    CapillarySurface run()
    {
        findNormals();
        flip();
        smooth();
        // Triangles of a division are even already, but for where their number of neighbours changes.
        for (int k = 0; k < kSmoothings && options_.rounds == 0; ++k) {
            findNormals();
            smooth();
        }
        flip();
        const int count_rounds = options_.triangles > 0 ? kCountRounds : 0;
        if (options_.rounds > 0) {
            findSizes();
            bool is_near = false;
            for (int round = 0; round < count_rounds && !is_near; ++round) {
                is_near = !changeSizes(trianglesOfSizes());
            }
            for (int round = 0; round < options_.rounds; ++round) {
                changeTriangles();
            }
        }
        for (int round = 0; round < count_rounds && changeSizes(static_cast<double>(faceCount())); ++round) {
            changeTriangles();
        }
        flip();
        for (int round = 0; round < kMendings && options_.mends && mend(); ++round) {
            flip();
        }
        return inSpaceOrder(result());
    }

    CapillarySurface relax(int rounds)
    {
        for (int round = 0; round < rounds; ++round) {
            findNormals();
            smooth();
        }
        return result();
    }

private:
    void changeTriangles()
    {
        findNormals();
        split();
        collapse();
        flip();
        findNormals();
        smooth();
        smooth();
    }

    [[nodiscard]] std::size_t faceCount() const
    {
        return static_cast<std::size_t>(std::distance(mesh_.faces_sbegin(), mesh_.faces_end()));
    }

    /// Number of equilateral triangles with the wanted edges.
    [[nodiscard]] double trianglesOfSizes() const
    {
        double count = 0.0;
        for (const FaceHandle face : mesh_.faces()) {
            const std::array<VertexHandle, 3> corners = cornersOf(face);
            double size = 0.0;
            for (const VertexHandle v : corners) {
                size += sizes_[static_cast<std::size_t>(v.idx())] / 3.0;
            }
            count += areaVector(mesh_.point(corners[0]), mesh_.point(corners[1]), mesh_.point(corners[2])).norm() /
                     (0.25 * std::numbers::sqrt3 * size * size);
        }
        return count;
    }

    /// Makes the largest edges shorter or longer, so that a number of triangles becomes the wanted one. Those at the
    /// rim and in folds, which are short, stay as they are: with shorter ones sheets at inner corners found no
    /// equilibrium.
    /// @return  false if it is near
    bool changeSizes(double count)
    {
        const double ratio = count / static_cast<double>(options_.triangles);
        if (std::abs(ratio - 1.0) <= kCountError) {
            return false;
        }
        options_.edge *= std::clamp(std::sqrt(ratio), 0.5, 2.0);
        findSizes();
        return true;
    }

    [[nodiscard]] bool onRim(VertexHandle v) const { return v.idx() < rim_; }

    [[nodiscard]] static Point areaVector(const Point& a, const Point& b, const Point& c)
    {
        return 0.5 * OpenMesh::cross(b - a, c - a);
    }

    [[nodiscard]] std::array<VertexHandle, 3> cornersOf(FaceHandle face) const
    {
        const HalfedgeHandle h = mesh_.halfedge_handle(face);
        const HalfedgeHandle next = mesh_.next_halfedge_handle(h);
        return {mesh_.from_vertex_handle(h), mesh_.to_vertex_handle(h), mesh_.to_vertex_handle(next)};
    }

    /// Finds the vertices around one inside, counter-clockwise.
    void findRing(VertexHandle v)
    {
        ring_.clear();
        const HalfedgeHandle first = mesh_.halfedge_handle(v);
        HalfedgeHandle h = first;
        do {
            ring_.push_back(mesh_.to_vertex_handle(h));
            h = mesh_.opposite_halfedge_handle(mesh_.prev_halfedge_handle(h));
        } while (h != first);
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
            const std::array<VertexHandle, 3> corners = cornersOf(face);
            const Point normal = areaVector(mesh_.point(corners[0]), mesh_.point(corners[1]), mesh_.point(corners[2]));
            for (const VertexHandle v : corners) {
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
                size = bend > 0.0 ? std::min(std::max(kBend / bend, options_.min_edge), options_.edge) : options_.edge;
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
                edges.emplace_back(1e9, edge);
            } else if (ratio > kLong) {
                // Neighbours that are as long stay together in memory.
                edges.emplace_back(std::floor(kLengths * std::log2(ratio)), edge);
            }
        }
        std::stable_sort(edges.begin(), edges.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
        std::size_t triangles = faceCount();
        for (const auto& [ratio, edge] : edges) {
            if (triangles >= options_.max_triangles) {
                return;
            }
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
            triangles += 2;
        }
    }

    [[nodiscard]] static double shapeOf(const Point& a, const Point& b, const Point& c)
    {
        return 4.0 * std::numbers::sqrt3 * areaVector(a, b, c).norm() /
               ((b - a).sqrnorm() + (c - b).sqrnorm() + (a - c).sqrnorm());
    }

    /// Whether a triangle with a corner that moves stays much as it is.
    [[nodiscard]] static bool staysFlat(const Point& before, const Point& after, const Point& b, const Point& c)
    {
        const Point old_normal = areaVector(before, b, c);
        const Point new_normal = areaVector(after, b, c);
        const double turn = old_normal | new_normal;
        const double old_square = old_normal.sqrnorm();
        const double new_square = new_normal.sqrnorm();
        if (turn < 0.0 || turn * turn < kTurn * kTurn * old_square * new_square || new_square < 0.01 * old_square) {
            return false;
        }
        const double base = (c - b).sqrnorm();
        const double new_sum = base + (b - after).sqrnorm() + (after - c).sqrnorm();
        // The square of shapeOf() is 48 A² over that of the sum.
        if (48.0 * new_square < kGoodShape * kGoodShape * new_sum * new_sum) {
            const double old_sum = base + (b - before).sqrnorm() + (before - c).sqrnorm();
            return new_square * old_sum * old_sum >= old_square * new_sum * new_sum;
        }
        return true;
    }

    /// Whether triangles around a vertex inside that moves to a place stay much as they are; those of `gone` vanish.
    [[nodiscard]] bool staysFlat(VertexHandle v, const Point& place, VertexHandle gone)
    {
        findRing(v);
        const Point& before = mesh_.point(v);
        for (std::size_t k = 0; k < ring_.size(); ++k) {
            const VertexHandle b = ring_[k];
            const VertexHandle c = ring_[k + 1 == ring_.size() ? 0 : k + 1];
            if (b != gone && c != gone && !staysFlat(before, place, mesh_.point(b), mesh_.point(c))) {
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

    /// Collapses the shortest edges of narrow triangles.
    /// @return  whether there were any
    bool mend()
    {
        findNormals();
        bool has_collapsed = false;
        for (const FaceHandle face : mesh_.faces()) {
            if (mesh_.status(face).deleted()) {
                continue;
            }
            const std::array<VertexHandle, 3> corners = cornersOf(face);
            if (shapeOf(mesh_.point(corners[0]), mesh_.point(corners[1]), mesh_.point(corners[2])) > kNarrowShape) {
                continue;
            }
            HalfedgeHandle h;
            for (const HalfedgeHandle side : mesh_.fh_range(face)) {
                const bool is_inside = !onRim(mesh_.from_vertex_handle(side)) || !onRim(mesh_.to_vertex_handle(side));
                if (is_inside && (!h.is_valid() || mesh_.calc_edge_sqr_length(side) < mesh_.calc_edge_sqr_length(h))) {
                    h = side;
                }
            }
            if (onRim(mesh_.from_vertex_handle(h))) {
                h = mesh_.opposite_halfedge_handle(h);
            }
            const VertexHandle gone = mesh_.from_vertex_handle(h);
            const VertexHandle kept = mesh_.to_vertex_handle(h);
            if (!mesh_.is_collapse_ok(h) || !mayCollapse(h)) {
                continue;
            }
            const Point place = onRim(kept) ? mesh_.point(kept) : middle(gone, kept);
            if (staysFlat(gone, place, kept) && (onRim(kept) || staysFlat(kept, place, gone))) {
                mesh_.set_point(kept, place);
                mesh_.collapse(h);
                has_collapsed = true;
            }
        }
        return has_collapsed;
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
        is_open_.assign(mesh_.n_edges(), 1);
        for (int round = 0; round < kFlipRounds; ++round) {
            bool has_flipped = false;
            for (const EdgeHandle edge : mesh_.edges()) {
                // After the first round, only edges between triangles that have changed.
                if (std::exchange(is_open_[static_cast<std::size_t>(edge.idx())], std::uint8_t{0}) == 0 ||
                    mesh_.is_boundary(edge) || !shouldFlip(edge) || !mesh_.is_flip_ok(edge)) {
                    continue;
                }
                mesh_.flip(edge);
                has_flipped = true;
                for (const unsigned side : {0U, 1U}) {
                    HalfedgeHandle h = mesh_.halfedge_handle(edge, side);
                    for (int k = 0; k < 2; ++k) {
                        h = mesh_.next_halfedge_handle(h);
                        is_open_[static_cast<std::size_t>(mesh_.edge_handle(h).idx())] = 1;
                    }
                }
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
        // The angles at c and d are more than 180° together if the sine of their sum is negative.
        const double cos_c = (a - c) | (b - c);
        const double cos_d = (a - d) | (b - d);
        if (cos_c >= 0.0 && cos_d >= 0.0) {
            return false;
        }
        const double sin_c = OpenMesh::cross(a - c, b - c).norm();
        const double sin_d = OpenMesh::cross(a - d, b - d).norm();
        const double scale = std::sqrt((sin_c * sin_c + cos_c * cos_c) * (sin_d * sin_d + cos_d * cos_d));
        if (sin_c * cos_d + sin_d * cos_c >= -std::numbers::pi * 1e-6 * scale) {
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
            findRing(v);
            points_.clear();
            for (const VertexHandle other : ring_) {
                points_.push_back(mesh_.point(other));
            }
            points_.push_back(points_.front());
            const Point& here = mesh_.point(v);
            Point centre(0.0, 0.0, 0.0);
            double total = 0.0;
            for (std::size_t k = 0; k + 1 < points_.size(); ++k) {
                const double area = areaVector(here, points_[k], points_[k + 1]).norm();
                centre += area / 3.0 * (here + points_[k] + points_[k + 1]);
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
            bool stays_flat = true;
            for (std::size_t k = 0; stays_flat && k + 1 < points_.size(); ++k) {
                stays_flat = staysFlat(here, place, points_[k], points_[k + 1]);
            }
            if (stays_flat) {
                mesh_.set_point(v, place);
            }
        }
    }

    [[nodiscard]] CapillarySurface result() const
    {
        CapillarySurface sheet;
        sheet.loop_starts = loop_starts_;
        std::vector<std::uint32_t> number(mesh_.n_vertices(), 0);
        for (const VertexHandle v : mesh_.vertices()) {
            number[static_cast<std::size_t>(v.idx())] = static_cast<std::uint32_t>(sheet.vertices.size());
            const Point& p = mesh_.point(v);
            sheet.vertices.push_back({p[0], p[1], p[2]});
        }
        for (const FaceHandle face : mesh_.faces()) {
            Triangle& t = sheet.triangles.emplace_back();
            std::size_t k = 0;
            for (const VertexHandle v : cornersOf(face)) {
                t[k++] = number[static_cast<std::size_t>(v.idx())];
            }
        }
        return sheet;
    }

    std::vector<std::uint32_t> loop_starts_;
    int rim_;
    RemeshOptions options_;
    HalfEdgeMesh mesh_;
    std::vector<Point> normals_;
    std::vector<double> sizes_;
    std::vector<VertexHandle> ring_;     ///< around the vertex of the last findRing()
    std::vector<Point> points_;          ///< places of its vertices, the first one again at the end
    std::vector<std::uint8_t> is_open_;  ///< edges that may have to be flipped
};

}  // namespace

CapillarySurface remesh(const CapillarySurface& sheet, const RemeshOptions& options)
{
    return Remesher(sheet, options).run();
}

CapillarySurface relax(const CapillarySurface& sheet, int rounds, bool is_ground_flat)
{
    CapillarySurface relaxed = Remesher(sheet, {.is_ground_flat = is_ground_flat}).relax(rounds);
    relaxed.triangles = sheet.triangles;  // half-edges may turn them
    return relaxed;
}

namespace {

/// Angle at the corner opposite to the shortest edge [rad].
double minAngleOf(const CapillarySurface& sheet, const Triangle& t)
{
    std::array<Vec3, 3> sides;  // opposite to every corner
    std::array<double, 3> squares{};
    for (std::size_t a = 0; a < 3; ++a) {
        sides[a] = sheet.vertices[t[(a + 2) % 3]] - sheet.vertices[t[(a + 1) % 3]];
        squares[a] = dot(sides[a], sides[a]);
    }
    const auto a = static_cast<std::size_t>(std::min_element(squares.begin(), squares.end()) - squares.begin());
    const Vec3& p = sides[(a + 1) % 3];
    const Vec3& q = sides[(a + 2) % 3];
    return std::atan2(length(cross(p, q)), -dot(p, q));
}

}  // namespace

std::vector<double> minAngles(const CapillarySurface& sheet)
{
    std::vector<double> angles;
    angles.reserve(sheet.triangles.size());
    for (const Triangle& t : sheet.triangles) {
        angles.push_back(minAngleOf(sheet, t));
    }
    return angles;
}

bool isWorn(const std::vector<double>& before, const CapillarySurface& sheet, double share)
{
    constexpr double kNarrow = std::numbers::pi / 10.0;
    for (std::size_t k = 0; k < sheet.triangles.size(); ++k) {
        if (minAngleOf(sheet, sheet.triangles[k]) < std::min(kNarrow, share * before[k])) {
            return true;
        }
    }
    return false;
}

}  // namespace droplet
