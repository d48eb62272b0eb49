// SPDX-License-Identifier: GPL-3.0-or-later
//
// Constrained Delaunay triangulation (CGAL), refined after J. Ruppert, "A Delaunay refinement algorithm for quality
// 2-dimensional mesh generation" (1995), with his concentric shells at sharp corners. Two departures: Inner edges
// between two rim vertices count as bad, because the liquid's surface would lie on the ground along them. Nothing is
// refined below a fraction of a pixel, so that refinement ends for all input angles. CGAL's own refinement,
// Delaunay_mesher_2, does neither; on masks of noise it ends in a segmentation fault (5.5.1).

#include "mesh/band.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>
#include <utility>

#include "mesh/smoothing.h"
#include "mesh/triangulation.h"

namespace droplet {
namespace {

/// Squared tangent of the smallest angle: Ruppert's bound, the largest for which refinement provably ends, is
/// arcsin(1/√8) = arctan(1/√7) = 20.7°.
constexpr double kMinTangentSquared = 1.0 / 7.0;

/// Triangles lower than this share of their longest edge, with angles below about 3°, are needles.
constexpr double kNeedle = 0.05;

/// Corners sharper than this get concentric shells; without them, halving one side would encroach upon the other
/// without end.
constexpr double kSharpCorner = std::numbers::pi / 3.0;

using Point = Triangulation::Point;
using FaceHandle = Triangulation::Face_handle;
using Edge = Triangulation::Edge;
using Corners = std::array<VertexHandle, 3>;

Vec2 vec(const Point& p)
{
    return {p.x(), p.y()};
}

double angleAt(Vec2 corner, Vec2 a, Vec2 b)
{
    const Vec2 u = a - corner;
    const Vec2 v = b - corner;
    return std::atan2(std::abs(cross(u, v)), dot(u, v));
}

using Polygons = std::vector<std::vector<Vec2>>;

/// Triangulation of one footprint, or of the part of it outside its lattice core.
class Band {
public:
    /// @param finest  length below which nothing is refined [m]
    Band(const Polygons& polygons, const std::vector<Vec2>& points, double finest)
        : finest_(finest), inserted_(insert(triangulation_, polygons, points))
    {
        for (const std::vector<VertexHandle>& loop : inserted_.loops) {
            for (const VertexHandle v : loop) {
                v->info().is_rim = true;
            }
        }
    }

    /// Marks the vertices of a cavity's polygons that are on the rim, and those whose edges must not be split.
    void mark(const Cavity& cavity)
    {
        for (std::size_t k = 0; k < cavity.polygons.size(); ++k) {
            for (std::size_t i = 0; i < cavity.polygons[k].size(); ++i) {
                VertexTag& tag = inserted_.loops[k][i]->info();
                tag.is_rim = cavity.on_rim[k][i] != 0;
                tag.is_core = cavity.at_seam[k][i] != 0;
            }
        }
    }

    /// Marks points from an index on as core points and adds the edges between them; nothing behind these edges is
    /// changed.
    void markCore(std::size_t first, const std::vector<std::array<std::uint32_t, 2>>& boundary)
    {
        for (std::size_t i = first; i < inserted_.points.size(); ++i) {
            inserted_.points[i]->info().is_core = true;
        }
        for (const auto& [a, b] : boundary) {
            triangulation_.insert_constraint(inserted_.points[first + a], inserted_.points[first + b]);
        }
    }

    /// Refines until every angle is good and no inner edge joins two rim vertices, or as far as `finest` allows.
    void refine()
    {
        markDomain(triangulation_);
        std::vector<Corners> sharp;
        std::vector<Ends> flat;
        std::vector<FaceHandle> whole;
        for (auto f = triangulation_.finite_faces_begin(); f != triangulation_.finite_faces_end(); ++f) {
            collectSharp(f, sharp);
            if (f->is_in_domain() && f->vertex(0)->info().is_rim && f->is_constrained(0) && f->is_constrained(1) &&
                f->is_constrained(2)) {
                whole.push_back(f);
            }
        }
        for (auto e = triangulation_.finite_edges_begin(); e != triangulation_.finite_edges_end(); ++e) {
            collectFlat(*e, flat);
        }
        // A face that is a whole droplet has no inner edge to halve, but needs an inner vertex to have a height.
        for (const FaceHandle f : whole) {
            insertInside(CGAL::centroid(f->vertex(0)->point(), f->vertex(1)->point(), f->vertex(2)->point()),
                         Triangulation::FACE, f, 0);
        }
        // Every round repairs the damage of the one before; real footprints need two or three.
        constexpr int kMaxRounds = 30;
        for (int round = 0; !sharp.empty() || !flat.empty() || !fresh_.empty(); ++round) {
            std::vector<Corners> tried;
            for (const Corners& v : sharp) {
                FaceHandle f;
                // An earlier insertion may have removed this face.
                if (round < kMaxRounds && triangulation_.is_face(v[0], v[1], v[2], f) && split(f)) {
                    tried.push_back(v);
                }
            }
            sharp.clear();
            // New edges have a new vertex.
            for (const VertexHandle v : fresh_) {
                collectFlatAround(v, flat);
            }
            for (const Ends& ends : flat) {
                FaceHandle f;
                int i = 0;
                // Halving another edge may have removed this one.
                if (triangulation_.is_edge(ends[0], ends[1], f, i)) {
                    insertInside(middleOf({f, i}), Triangulation::EDGE, f, i);
                }
            }
            flat.clear();
            const std::vector<VertexHandle> last = std::exchange(fresh_, {});
            for (const VertexHandle v : last) {
                collectSharpAround(v, sharp);
            }
            // The edges in the way of a face have been split, but maybe not the face itself.
            for (const Corners& v : tried) {
                FaceHandle f;
                if (triangulation_.is_face(v[0], v[1], v[2], f)) {
                    sharp.push_back(v);
                }
            }
        }
    }

    [[nodiscard]] Filling filling() const;

    /// Vertices in order: those of the rim, all others outside the core, then the core's points with the given numbers.
    [[nodiscard]] PlanarMesh extract(const std::vector<std::uint32_t>& core_numbers) const;

private:
    using Ends = std::array<VertexHandle, 2>;

    /// Collects a face of the domain that has too small an angle, by its vertices, because faces are replaced.
    void collectSharp(FaceHandle f, std::vector<Corners>& sharp) const
    {
        if (f->is_in_domain() && isSharp(f)) {
            sharp.push_back({f->vertex(0), f->vertex(1), f->vertex(2)});
        }
    }

    /// Collects those faces around a new vertex of which it is the newest, so that each face is collected once.
    void collectSharpAround(VertexHandle v, std::vector<Corners>& sharp) const
    {
        auto f = triangulation_.incident_faces(v);
        const auto done = f;
        do {
            const std::uint32_t newest =
                std::max({f->vertex(0)->info().order, f->vertex(1)->info().order, f->vertex(2)->info().order});
            if (newest == v->info().order) {
                collectSharp(f, sharp);
            }
        } while (++f != done);
    }

    /// Collects an inner edge that joins two rim vertices.
    void collectFlat(const Edge& e, std::vector<Ends>& flat) const
    {
        const VertexHandle a = e.first->vertex(Triangulation::cw(e.second));
        const VertexHandle b = e.first->vertex(Triangulation::ccw(e.second));
        if (a->info().is_rim && b->info().is_rim && e.first->is_in_domain() && !triangulation_.is_constrained(e)) {
            flat.push_back({a, b});
        }
    }

    void collectFlatAround(VertexHandle v, std::vector<Ends>& flat) const
    {
        if (!v->info().is_rim) {
            return;
        }
        auto e = triangulation_.incident_edges(v);
        const auto done = e;
        do {
            const VertexHandle a = e->first->vertex(Triangulation::cw(e->second));
            const VertexHandle other = a == v ? e->first->vertex(Triangulation::ccw(e->second)) : a;
            if (other->info().order < v->info().order) {
                collectFlat(*e, flat);
            }
        } while (++e != done);
    }

    /// Whether a face has too small an angle, other than at a corner of the rim.
    [[nodiscard]] bool isSharp(FaceHandle f) const
    {
        for (int i = 0; i < 3; ++i) {
            const Vec2 corner = vec(f->vertex(i)->point());
            const Vec2 u = vec(f->vertex(Triangulation::ccw(i))->point()) - corner;
            const Vec2 v = vec(f->vertex(Triangulation::cw(i))->point()) - corner;
            const double sine = cross(u, v);
            const double cosine = dot(u, v);
            const bool is_corner = f->is_constrained(Triangulation::ccw(i)) && f->is_constrained(Triangulation::cw(i));
            if (cosine > 0.0 && sine * sine < kMinTangentSquared * cosine * cosine && !is_corner) {
                return true;
            }
        }
        return false;
    }

    [[nodiscard]] double edgeLength(const Edge& e) const
    {
        return length(vec(e.first->vertex(Triangulation::cw(e.second))->point()) -
                      vec(e.first->vertex(Triangulation::ccw(e.second))->point()));
    }

    /// Splits a bad face at its circumcentre, or splits the rim edges in the way.
    /// @return whether anything was inserted
    bool split(FaceHandle f)
    {
        const auto [shortest, longest] = std::minmax({edgeLength({f, 0}), edgeLength({f, 1}), edgeLength({f, 2})});
        const Vec2 corner = vec(f->vertex(0)->point());
        const double height = cross(vec(f->vertex(1)->point()) - corner, vec(f->vertex(2)->point()) - corner) / longest;
        // A very narrow strip is not cut into squares unless its triangles are needles.
        if (shortest < finest_ || (height < finest_ && height > kNeedle * longest)) {
            return false;
        }
        const Point centre = triangulation_.circumcenter(f);
        FaceHandle at = f;
        if (const std::optional<Edge> wall = walk(at, centre)) {
            return !isCore(*wall) && splitRim(*wall);
        }
        std::vector<FaceHandle> conflicts;
        std::vector<Edge> boundary;
        triangulation_.get_conflicts_and_boundary(centre, std::back_inserter(conflicts), std::back_inserter(boundary),
                                                  at);
        std::vector<std::array<VertexHandle, 2>> encroached;
        for (const Edge& e : boundary) {
            const VertexHandle a = e.first->vertex(Triangulation::cw(e.second));
            const VertexHandle b = e.first->vertex(Triangulation::ccw(e.second));
            if (e.first->is_constrained(e.second) &&
                dot(vec(a->point()) - vec(centre), vec(b->point()) - vec(centre)) < 0) {
                if (isCore(e)) {
                    return false;
                }
                encroached.push_back({a, b});
            }
        }
        if (encroached.empty()) {
            Triangulation::Locate_type type{};
            int index = 0;
            const FaceHandle place = triangulation_.locate(centre, type, index, at);
            if (type == Triangulation::VERTEX || type == Triangulation::OUTSIDE_CONVEX_HULL) {
                return false;
            }
            if (type == Triangulation::EDGE && place->is_constrained(index)) {
                return !isCore({place, index}) && splitRim({place, index});
            }
            insertInside(centre, type, place, index);
            return true;
        }
        bool changed = false;
        for (const std::array<VertexHandle, 2>& ends : encroached) {
            FaceHandle g;
            int i = 0;
            if (triangulation_.is_edge(ends[0], ends[1], g, i)) {
                changed = splitRim({g, i}) || changed;
            }
        }
        return changed;
    }

    /// Walks straight from a face to a point. Returns the rim edge in the way, or else leaves the point's face in `at`.
    std::optional<Edge> walk(FaceHandle& at, const Point& to) const
    {
        const Point from = CGAL::centroid(at->vertex(0)->point(), at->vertex(1)->point(), at->vertex(2)->point());
        FaceHandle last;
        while (true) {
            int through = -1;
            for (int i = 0; i < 3; ++i) {
                const Point& a = at->vertex(Triangulation::ccw(i))->point();
                const Point& b = at->vertex(Triangulation::cw(i))->point();
                if (at->neighbor(i) != last && CGAL::orientation(a, b, to) == CGAL::RIGHT_TURN &&
                    CGAL::orientation(from, to, a) != CGAL::LEFT_TURN &&
                    CGAL::orientation(from, to, b) != CGAL::RIGHT_TURN) {
                    through = i;
                }
            }
            if (through < 0) {
                return std::nullopt;
            }
            if (at->is_constrained(through)) {
                return Edge{at, through};
            }
            last = at;
            at = at->neighbor(through);
        }
    }

    /// Whether the core lies behind an edge.
    static bool isCore(const Edge& e)
    {
        return e.first->vertex(Triangulation::cw(e.second))->info().is_core &&
               e.first->vertex(Triangulation::ccw(e.second))->info().is_core;
    }

    /// Splits a rim edge in the middle, or, next to a sharp corner, at a power of two from the corner.
    bool splitRim(const Edge& e)
    {
        const double whole = edgeLength(e);
        if (whole < 2.0 * finest_) {
            return false;
        }
        VertexHandle a = e.first->vertex(Triangulation::cw(e.second));
        VertexHandle b = e.first->vertex(Triangulation::ccw(e.second));
        double part = 0.5;
        if (isSharpCorner(b)) {
            std::swap(a, b);
        }
        if (isSharpCorner(a)) {
            part = std::exp2(std::round(std::log2(0.5 * whole / finest_))) * finest_ / whole;
        }
        const Vec2 middle = vec(a->point()) + part * (vec(b->point()) - vec(a->point()));
        // The face of the edge lies to the left on the way to this end.
        const VertexHandle end = e.first->vertex(Triangulation::cw(e.second));
        const bool left = e.first->is_in_domain();
        const bool right = e.first->neighbor(e.second)->is_in_domain();
        const VertexHandle v = triangulation_.insert(Point(middle.x, middle.y), Triangulation::EDGE, e.first, e.second);
        addFresh(v);
        v->info().is_rim = true;
        auto f = triangulation_.incident_faces(v);
        while (f->vertex(Triangulation::ccw(f->index(v))) != end) {
            ++f;
        }
        const auto done = f;
        bool inside = left;
        do {
            f->set_in_domain(inside);
            // The walk crosses the rim to the other side.
            if (f->is_constrained(Triangulation::ccw(f->index(v)))) {
                inside = right;
            }
        } while (++f != done);
        return true;
    }

    /// Middle of an edge; for an edge across a corner of the rim, the point where the corner is bisected.
    [[nodiscard]] Point middleOf(const Edge& e) const
    {
        const VertexHandle a = e.first->vertex(Triangulation::cw(e.second));
        const VertexHandle b = e.first->vertex(Triangulation::ccw(e.second));
        double share = 0.5;
        for (const Edge& side : {e, triangulation_.mirror_edge(e)}) {
            const auto [f, i] = side;
            if (f->is_constrained(Triangulation::cw(i)) && f->is_constrained(Triangulation::ccw(i))) {
                const double to_a = length(vec(a->point()) - vec(f->vertex(i)->point()));
                const double to_b = length(vec(b->point()) - vec(f->vertex(i)->point()));
                share = to_a / (to_a + to_b);
            }
        }
        const Vec2 middle = vec(a->point()) + share * (vec(b->point()) - vec(a->point()));
        return {middle.x, middle.y};
    }

    void insertInside(const Point& p, Triangulation::Locate_type type, FaceHandle place, int index)
    {
        const VertexHandle v = triangulation_.insert(p, type, place, index);
        addFresh(v);
        auto f = triangulation_.incident_faces(v);
        const auto done = f;
        do {
            f->set_in_domain(true);
        } while (++f != done);
    }

    void addFresh(VertexHandle v)
    {
        v->info().order = ++inserted_count_;
        fresh_.push_back(v);
    }

    [[nodiscard]] bool isSharpCorner(VertexHandle v) const
    {
        std::vector<Vec2> sides;
        auto edge = triangulation_.incident_edges(v);
        const auto done = edge;
        do {
            if (!triangulation_.is_infinite(*edge) && triangulation_.is_constrained(*edge)) {
                const VertexHandle a = edge->first->vertex(Triangulation::cw(edge->second));
                sides.push_back(vec((a == v ? edge->first->vertex(Triangulation::ccw(edge->second)) : a)->point()));
            }
        } while (++edge != done);
        return sides.size() == 2 && angleAt(vec(v->point()), sides[0], sides[1]) < kSharpCorner;
    }

    /// Next vertex after `from` along the rim polygon toward `to`; refinement may have split the edge between them.
    [[nodiscard]] VertexHandle nextToward(VertexHandle from, VertexHandle to) const
    {
        const Vec2 start{from->point().x(), from->point().y()};
        const Vec2 wanted = Vec2{to->point().x(), to->point().y()} - start;
        VertexHandle best = to;
        double best_cosine = -2.0;
        auto edge = triangulation_.incident_edges(from);
        const auto done = edge;
        do {
            if (!triangulation_.is_infinite(*edge) && triangulation_.is_constrained(*edge)) {
                const int i = edge->second;
                const VertexHandle a = edge->first->vertex(Triangulation::cw(i));
                const VertexHandle other = a == from ? edge->first->vertex(Triangulation::ccw(i)) : a;
                const Vec2 d = Vec2{other->point().x(), other->point().y()} - start;
                const double cosine = dot(d, wanted) / (length(d) * length(wanted));
                if (cosine > best_cosine) {
                    best_cosine = cosine;
                    best = other;
                }
            }
        } while (++edge != done);
        return best;
    }

    Triangulation triangulation_;
    double finest_;
    Inserted inserted_;
    std::uint32_t inserted_count_ = 0;  ///< vertices inserted by refinement
    std::vector<VertexHandle> fresh_;   ///< vertices inserted since the last round
};

Filling Band::filling() const
{
    Filling filling;
    for (auto v = triangulation_.finite_vertices_begin(); v != triangulation_.finite_vertices_end(); ++v) {
        v->info().index.reset();
    }
    std::uint32_t given = 0;
    for (const std::vector<VertexHandle>& loop : inserted_.loops) {
        for (const VertexHandle v : loop) {
            v->info().index = given++;
        }
    }
    const auto append = [&](VertexHandle v) {
        v->info().index = given + static_cast<std::uint32_t>(filling.points.size());
        filling.points.push_back(vec(v->point()));
    };
    for (const std::vector<VertexHandle>& loop : inserted_.loops) {
        filling.splits.emplace_back(loop.size());
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const VertexHandle end = loop[(i + 1) % loop.size()];
            for (VertexHandle v = nextToward(loop[i], end); v != end; v = nextToward(v, end)) {
                append(v);
                filling.splits.back()[i].push_back(*v->info().index - given);
            }
        }
    }
    for (auto f = triangulation_.finite_faces_begin(); f != triangulation_.finite_faces_end(); ++f) {
        if (f->is_in_domain()) {
            Triangle& triangle = filling.triangles.emplace_back();
            for (int k = 0; k < 3; ++k) {
                const VertexHandle v = f->vertex(k);
                if (!v->info().index) {
                    append(v);
                }
                triangle[static_cast<std::size_t>(k)] = *v->info().index;
            }
        }
    }
    return filling;
}

PlanarMesh Band::extract(const std::vector<std::uint32_t>& core_numbers) const
{
    PlanarMesh mesh;
    for (auto v = triangulation_.finite_vertices_begin(); v != triangulation_.finite_vertices_end(); ++v) {
        v->info().index.reset();
    }
    const auto append = [&](VertexHandle v) {
        v->info().index = static_cast<std::uint32_t>(mesh.vertices.size());
        mesh.vertices.push_back(vec(v->point()));
    };
    mesh.loop_starts.push_back(0);
    for (const std::vector<VertexHandle>& loop : inserted_.loops) {
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const VertexHandle end = loop[(i + 1) % loop.size()];
            for (VertexHandle v = loop[i]; v != end; v = nextToward(v, end)) {
                append(v);
            }
        }
        mesh.loop_starts.push_back(static_cast<std::uint32_t>(mesh.vertices.size()));
    }
    std::vector<FaceHandle> faces;
    for (auto f = triangulation_.finite_faces_begin(); f != triangulation_.finite_faces_end(); ++f) {
        if (!f->is_in_domain()) {
            continue;
        }
        faces.push_back(f);
        for (int k = 0; k < 3; ++k) {
            const VertexHandle v = f->vertex(k);
            if (!v->info().index && !v->info().is_core) {
                append(v);
            }
        }
    }
    const auto first_core = static_cast<std::uint32_t>(mesh.vertices.size());
    for (std::size_t i = 0; i < core_numbers.size(); ++i) {
        inserted_.points[inserted_.points.size() - core_numbers.size() + i]->info().index =
            first_core + core_numbers[i];
    }
    for (const FaceHandle f : faces) {
        mesh.triangles.push_back(
            {*f->vertex(0)->info().index, *f->vertex(1)->info().index, *f->vertex(2)->info().index});
    }
    return mesh;
}

}  // namespace

PlanarMesh triangulateBand(const Polygons& polygons, const LatticeCore& core, double finest)
{
    std::vector<Vec2> points = core.loosePoints();
    const std::size_t loose = points.size();
    const std::vector<Vec2> seam = core.seamPoints();
    points.insert(points.end(), seam.begin(), seam.end());
    Band band(polygons, points, finest);
    band.markCore(loose, core.boundary());
    band.refine();
    PlanarMesh mesh = band.extract(core.seamNumbers());
    const std::size_t triangles = mesh.triangles.size();
    const std::size_t first_fixed = mesh.vertices.size();
    core.appendTo(mesh);
    smooth(mesh, {mesh.rimVertexCount(), first_fixed, triangles});
    return mesh;
}

PlanarMesh triangulatePoints(const Polygons& polygons, const std::vector<Vec2>& points, double finest)
{
    Band band(polygons, points, finest);
    band.refine();
    return band.extract({});
}

Filling fill(const Cavity& cavity, const std::vector<Vec2>& points, double finest)
{
    Band band(cavity.polygons, points, finest);
    band.mark(cavity);
    band.refine();
    return band.filling();
}

std::vector<Triangle> triangulateUnrefined(const Polygons& polygons, const std::vector<Vec2>& points)
{
    Triangulation triangulation;
    const Inserted inserted = insert(triangulation, polygons, points);
    std::uint32_t count = 0;
    for (const std::vector<VertexHandle>& loop : inserted.loops) {
        for (const VertexHandle v : loop) {
            v->info().index = count++;
        }
    }
    for (const VertexHandle v : inserted.points) {
        v->info().index = count++;
    }
    markDomain(triangulation);
    std::vector<Triangle> triangles;
    for (auto f = triangulation.finite_faces_begin(); f != triangulation.finite_faces_end(); ++f) {
        if (f->is_in_domain()) {
            Triangle triangle{*f->vertex(0)->info().index, *f->vertex(1)->info().index, *f->vertex(2)->info().index};
            std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
            triangles.push_back(triangle);
        }
    }
    // Last bits of places decide in which order CGAL finds the same triangles.
    std::sort(triangles.begin(), triangles.end());
    return triangles;
}

}  // namespace droplet
