// SPDX-License-Identifier: GPL-3.0-or-later
//
// Rim vertices and an equilateral lattice inside go into one constrained Delaunay triangulation (CGAL), which is then
// refined after J. Ruppert, "A Delaunay refinement algorithm for quality 2-dimensional mesh generation" (1995), with
// his concentric shells at sharp corners. Departures: inner edges between two rim vertices count as bad, for the
// liquid's surface would lie on the ground along them, and nothing is refined below a fraction of a pixel, so that
// refinement ends whatever the input angles. CGAL's own refinement, Delaunay_mesher_2, knows neither; on masks of noise
// it ends in a segmentation fault (5.5.1).
//
// Uniform, not graded toward the rim, because strokes of type and logos are a capillary length wide or less, where
// grading gains nothing. Measured on the unit disc with 10 000 triangles, L² error and relative error of λ, uniform
// against edges three times as long in the middle as at the rim (radially stretched): without gravity 5.4e-5, 1.3e-4
// against 5.4e-5, 2.8e-4; at radius = 3 capillary lengths 2.1e-4, 1.5e-4 against 0.9e-4, 1.7e-4; at 10, a wide puddle,
// 1.2e-3, 5.5e-4 against 3.4e-4, 2.1e-4. There grading would pay.

#include "droplet/mesh/triangulate.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "droplet/error.h"
#include "mesh/rim_sampling.h"
#include "mesh/triangulation.h"

namespace droplet {
namespace {

/// Lattice points stay this many edges away from the rim. At 1/√3 ≈ 0.577 and more, every lattice triangle away from
/// the rim is Delaunay; with 0.65 the smallest angles between the lattice and the rim are 27° to 32° on discs and type.
constexpr double kClearance = 0.65;

/// Smallest angle wanted: Ruppert's bound, the largest for which refinement provably ends, arcsin(1/√8) = 20.7°.
const double kLeastAngle = std::asin(std::sqrt(0.125));

/// Corners sharper than this get concentric shells: below it, halving one side encroaches upon the other for ever.
constexpr double kSharpCorner = std::numbers::pi / 3.0;

/// Edges are not refined below this share of the loops' own detail.
constexpr double kFinest = 0.03;

constexpr double kRoot3 = std::numbers::sqrt3;

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

/// The points of an equilateral lattice inside polygons and clear of them, row by row.
class Lattice {
public:
    Lattice(const std::vector<RimPolygon>& polygons, double edge) : edge_(edge), height_(0.5 * kRoot3 * edge)
    {
        fill(polygons);
        for (const RimPolygon& polygon : polygons) {
            for (std::size_t i = 0; i < polygon.size(); ++i) {
                clear(polygon[i], polygon[(i + 1) % polygon.size()]);
            }
        }
    }

    /// Calls with every point, rows in turn from left to right and back, so that each is near the one before.
    template <typename Visit>
    void forEach(const Visit& visit) const
    {
        for (std::size_t r = 0; r < rows_.size(); ++r) {
            const Row& row = rows_[r];
            for (std::size_t k = 0; k < row.columns.size(); ++k) {
                const std::size_t i = r % 2 == 0 ? k : row.columns.size() - 1 - k;
                if (row.kept[i] != 0) {
                    visit(at(first_row_ + static_cast<long>(r), row.columns[i]));
                }
            }
        }
    }

    [[nodiscard]] std::size_t size() const
    {
        std::size_t count = 0;
        for (const Row& row : rows_) {
            count += static_cast<std::size_t>(std::count(row.kept.begin(), row.kept.end(), 1));
        }
        return count;
    }

private:
    struct Row {
        std::vector<long> columns;       ///< of points inside the polygons, ascending
        std::vector<std::uint8_t> kept;  ///< 1 while clear of the rim
    };

    [[nodiscard]] Vec2 at(long row, long column) const
    {
        return {(static_cast<double>(column) + (row % 2 == 0 ? 0.0 : 0.5)) * edge_, static_cast<double>(row) * height_};
    }
    [[nodiscard]] static double shift(long row) { return row % 2 == 0 ? 0.0 : 0.5; }

    void fill(const std::vector<RimPolygon>& polygons)
    {
        double low = std::numeric_limits<double>::infinity();
        double high = -low;
        for (const Vec2 p : polygons.front()) {
            low = std::min(low, p.y);
            high = std::max(high, p.y);
        }
        first_row_ = static_cast<long>(std::ceil(low / height_));
        const long last_row = static_cast<long>(std::floor(high / height_));
        if (last_row < first_row_) {
            return;
        }
        std::vector<std::vector<double>> crossings(static_cast<std::size_t>(last_row - first_row_ + 1));
        for (const RimPolygon& polygon : polygons) {
            for (std::size_t i = 0; i < polygon.size(); ++i) {
                Vec2 a = polygon[i];
                Vec2 b = polygon[(i + 1) % polygon.size()];
                if (a.y > b.y) {
                    std::swap(a, b);
                }
                // Half-open, so that a vertex on a row counts once.
                for (long r = static_cast<long>(std::ceil(a.y / height_)); static_cast<double>(r) * height_ < b.y;
                     ++r) {
                    if (r >= first_row_ && r <= last_row) {
                        const double y = static_cast<double>(r) * height_;
                        crossings[static_cast<std::size_t>(r - first_row_)].push_back(a.x + (y - a.y) / (b.y - a.y) *
                                                                                                (b.x - a.x));
                    }
                }
            }
        }
        rows_.resize(crossings.size());
        for (std::size_t r = 0; r < crossings.size(); ++r) {
            std::sort(crossings[r].begin(), crossings[r].end());
            const double offset = shift(first_row_ + static_cast<long>(r));
            for (std::size_t k = 0; k + 1 < crossings[r].size(); k += 2) {
                const long begin = static_cast<long>(std::ceil(crossings[r][k] / edge_ - offset));
                const long end = static_cast<long>(std::floor(crossings[r][k + 1] / edge_ - offset));
                for (long column = begin; column <= end; ++column) {
                    rows_[r].columns.push_back(column);
                }
            }
            rows_[r].kept.assign(rows_[r].columns.size(), 1);
        }
    }

    /// Drops the points too near to a rim edge.
    void clear(Vec2 a, Vec2 b)
    {
        const double reach = kClearance * edge_;
        const long low = static_cast<long>(std::ceil((std::min(a.y, b.y) - reach) / height_));
        const long high = static_cast<long>(std::floor((std::max(a.y, b.y) + reach) / height_));
        for (long r = std::max(low, first_row_); r <= high && r - first_row_ < static_cast<long>(rows_.size()); ++r) {
            Row& row = rows_[static_cast<std::size_t>(r - first_row_)];
            const double left = (std::min(a.x, b.x) - reach) / edge_ - shift(r);
            const double right = (std::max(a.x, b.x) + reach) / edge_ - shift(r);
            auto it = std::lower_bound(row.columns.begin(), row.columns.end(), static_cast<long>(std::ceil(left)));
            for (; it != row.columns.end() && static_cast<double>(*it) <= right; ++it) {
                if (distance(at(r, *it), a, b) < reach) {
                    row.kept[static_cast<std::size_t>(it - row.columns.begin())] = 0;
                }
            }
        }
    }

    static double distance(Vec2 p, Vec2 a, Vec2 b)
    {
        const Vec2 ab = b - a;
        const double t = std::clamp(dot(p - a, ab) / dot(ab, ab), 0.0, 1.0);
        return length(p - (a + t * ab));
    }

    double edge_;
    double height_;
    long first_row_ = 0;
    std::vector<Row> rows_;
};

/// One footprint's triangulation in the making.
class Mesh {
public:
    /// @param finest  length below which nothing is refined [m]
    Mesh(const std::vector<RimPolygon>& polygons, double finest)
        : finest_(finest), loops_(insertPolygons(triangulation_, polygons))
    {
    }

    void insert(const Lattice& lattice)
    {
        FaceHandle hint;
        lattice.forEach([&](Vec2 p) { hint = triangulation_.insert(Point(p.x, p.y), hint)->face(); });
    }

    /// Refines until every angle and every edge's tie to the inside is good, or as fine as it may be.
    void refine()
    {
        // Every round mends what the one before stirred up; real footprints need two or three.
        constexpr int kRounds = 30;
        for (int round = 0; round < kRounds; ++round) {
            markDomain(triangulation_);
            const std::vector<Corners> sharp = sharpFaces();
            std::size_t changes = 0;
            for (const Corners& v : sharp) {
                FaceHandle f;
                // An earlier insertion may have mended this one already.
                if (triangulation_.is_face(v[0], v[1], v[2], f)) {
                    changes += split(f) ? 1 : 0;
                }
            }
            changes += splitFlatEdges();
            if (changes == 0) {
                return;
            }
        }
        while (splitFlatEdges() > 0) {
        }
        markDomain(triangulation_);
    }

    [[nodiscard]] PlanarMesh extract() const;

private:
    /// The faces of the domain with too small an angle, by their vertices, for faces come and go.
    [[nodiscard]] std::vector<Corners> sharpFaces() const
    {
        std::vector<Corners> result;
        for (auto f = triangulation_.finite_faces_begin(); f != triangulation_.finite_faces_end(); ++f) {
            if (f->is_in_domain() && isSharp(f)) {
                result.push_back({f->vertex(0), f->vertex(1), f->vertex(2)});
            }
        }
        return result;
    }

    /// Whether a face has too small an angle that is not a corner of the rim.
    [[nodiscard]] bool isSharp(FaceHandle f) const
    {
        for (int i = 0; i < 3; ++i) {
            const double angle = angleAt(vec(f->vertex(i)->point()), vec(f->vertex(Triangulation::ccw(i))->point()),
                                         vec(f->vertex(Triangulation::cw(i))->point()));
            const bool is_corner = f->is_constrained(Triangulation::ccw(i)) && f->is_constrained(Triangulation::cw(i));
            if (angle < kLeastAngle && !is_corner) {
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

    /// Splits a bad face by its circumcentre, or the rim edges that stand in its way.
    /// @return whether anything was inserted
    bool split(FaceHandle f)
    {
        if (std::min({edgeLength({f, 0}), edgeLength({f, 1}), edgeLength({f, 2})}) < finest_) {
            return false;
        }
        const Point centre = triangulation_.circumcenter(f);
        FaceHandle at = f;
        if (const std::optional<Edge> wall = walk(at, centre)) {
            return splitRim(*wall);
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
            triangulation_.insert(centre, type, place, index);
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

    /// Walks straight from a face to a point; returns the rim edge in the way, or leaves the point's face in `at`.
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

    /// Splits a rim edge in the middle, or, next to a sharp corner, at a power of two away from it.
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
        triangulation_.insert(Point(middle.x, middle.y), Triangulation::EDGE, e.first, e.second);
        return true;
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

    /// Halves every inner edge that joins two rim vertices.
    /// @return how many there were
    std::size_t splitFlatEdges()
    {
        markDomain(triangulation_);
        markRim();
        std::vector<std::array<VertexHandle, 2>> flat;
        for (auto e = triangulation_.finite_edges_begin(); e != triangulation_.finite_edges_end(); ++e) {
            const VertexHandle a = e->first->vertex(Triangulation::cw(e->second));
            const VertexHandle b = e->first->vertex(Triangulation::ccw(e->second));
            if (isRim(a) && isRim(b) && !triangulation_.is_constrained(*e) && e->first->is_in_domain()) {
                flat.push_back({a, b});
            }
        }
        for (const std::array<VertexHandle, 2>& ends : flat) {
            FaceHandle f;
            int i = 0;
            // Halving another edge may have flipped this one away.
            if (triangulation_.is_edge(ends[0], ends[1], f, i)) {
                triangulation_.insert(CGAL::midpoint(ends[0]->point(), ends[1]->point()), Triangulation::EDGE, f, i);
            }
        }
        return flat.size();
    }

    void markRim()
    {
        for (auto v = triangulation_.finite_vertices_begin(); v != triangulation_.finite_vertices_end(); ++v) {
            v->info().index.reset();
        }
        for (auto e = triangulation_.finite_edges_begin(); e != triangulation_.finite_edges_end(); ++e) {
            if (triangulation_.is_constrained(*e)) {
                e->first->vertex(Triangulation::cw(e->second))->info().index = 0;
                e->first->vertex(Triangulation::ccw(e->second))->info().index = 0;
            }
        }
    }
    static bool isRim(VertexHandle v) { return v->info().index.has_value(); }

    /// The vertex after `from` along the rim polygon toward `to`: the mesher may have split the edge between.
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
    std::vector<std::vector<VertexHandle>> loops_;  ///< the rim's vertices as they were given
};

PlanarMesh Mesh::extract() const
{
    PlanarMesh mesh;
    for (auto v = triangulation_.finite_vertices_begin(); v != triangulation_.finite_vertices_end(); ++v) {
        v->info().index.reset();
    }
    const auto take = [&](VertexHandle v) {
        v->info().index = static_cast<std::uint32_t>(mesh.vertices.size());
        mesh.vertices.push_back({v->point().x(), v->point().y()});
    };
    mesh.loop_starts.push_back(0);
    for (const std::vector<VertexHandle>& loop : loops_) {
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const VertexHandle end = loop[(i + 1) % loop.size()];
            for (VertexHandle v = loop[i]; v != end; v = nextToward(v, end)) {
                take(v);
            }
        }
        mesh.loop_starts.push_back(static_cast<std::uint32_t>(mesh.vertices.size()));
    }
    for (auto f = triangulation_.finite_faces_begin(); f != triangulation_.finite_faces_end(); ++f) {
        if (!f->is_in_domain()) {
            continue;
        }
        Triangle triangle{};
        for (int k = 0; k < 3; ++k) {
            const VertexHandle v = f->vertex(k);
            if (!v->info().index) {
                take(v);
            }
            triangle[static_cast<std::size_t>(k)] = *v->info().index;
        }
        mesh.triangles.push_back(triangle);
    }
    return mesh;
}

double smallestAngle(Vec2 a, Vec2 b, Vec2 c)
{
    const auto angle = [](Vec2 u, Vec2 v) { return std::atan2(cross(u, v), dot(u, v)); };
    return std::min({angle(b - a, c - a), angle(c - b, a - b), angle(a - c, b - c)});
}

/// Moves inner vertices toward the area-weighted mean of their triangles' centroids wherever that makes no angle around
/// them smaller than the smallest there was: the band between lattice and rim evens out, the lattice stays.
void smooth(PlanarMesh& mesh)
{
    constexpr int kSweeps = 4;  // the band is two triangles wide: this carries a move across it and back
    const std::size_t rim = mesh.rimVertexCount();
    const std::size_t n = mesh.vertices.size();
    std::vector<std::uint32_t> starts(n + 1, 0);
    for (const Triangle& t : mesh.triangles) {
        for (const std::uint32_t v : t) {
            ++starts[v + 1];
        }
    }
    for (std::size_t v = 0; v < n; ++v) {
        starts[v + 1] += starts[v];
    }
    std::vector<std::uint32_t> around(starts.back());
    std::vector<std::uint32_t> filled(starts.begin(), starts.end() - 1);
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        for (const std::uint32_t v : mesh.triangles[t]) {
            around[filled[v]++] = t;
        }
    }
    const auto worst = [&](std::size_t v) {
        double angle = std::numbers::pi;
        for (std::uint32_t k = starts[v]; k < starts[v + 1]; ++k) {
            const Triangle& t = mesh.triangles[around[k]];
            angle = std::min(angle, smallestAngle(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]));
        }
        return angle;
    };
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
        for (std::size_t v = rim; v < n; ++v) {
            Vec2 sum{};
            double weight = 0.0;
            for (std::uint32_t k = starts[v]; k < starts[v + 1]; ++k) {
                const Triangle& t = mesh.triangles[around[k]];
                const double twice = doubleArea(mesh, t);
                sum = sum + (twice / 3.0) *
                                ((mesh.vertices[t[0]] - mesh.vertices[v]) + (mesh.vertices[t[1]] - mesh.vertices[v]) +
                                 (mesh.vertices[t[2]] - mesh.vertices[v]));
                weight += twice;
            }
            const Vec2 move = (1.0 / weight) * sum;
            const double size = std::sqrt(weight / static_cast<double>(starts[v + 1] - starts[v]));
            if (length(move) < 1e-3 * size) {
                continue;
            }
            const Vec2 before = mesh.vertices[v];
            const double was = worst(v);
            mesh.vertices[v] = before + move;
            if (worst(v) < was) {
                mesh.vertices[v] = before;
            }
        }
    }
}

PlanarMesh meshFootprint(const RimSampler& sampler, double edge)
{
    const std::vector<RimPolygon> polygons = sampler.sample(edge);
    Mesh mesh(polygons, kFinest * sampler.finest());
    mesh.insert(Lattice(polygons, edge));
    mesh.refine();
    PlanarMesh result = mesh.extract();
    smooth(result);
    return result;
}

std::vector<PlanarMesh> meshAll(const std::vector<RimSampler>& samplers, double edge)
{
    std::vector<PlanarMesh> meshes(samplers.size());
    tbb::parallel_for(std::size_t{0}, samplers.size(),
                      [&](std::size_t k) { meshes[k] = meshFootprint(samplers[k], edge); });
    return meshes;
}

std::size_t countTriangles(const std::vector<PlanarMesh>& meshes)
{
    std::size_t count = 0;
    for (const PlanarMesh& mesh : meshes) {
        count += mesh.triangles.size();
    }
    return count;
}

/// Triangles that an edge length will give, from the rim's and the lattice's vertices alone: 2·inner + rim − 2 per
/// droplet, plus 2 per hole (Euler), without what refinement adds.
double predictTriangles(const std::vector<RimSampler>& samplers, double edge)
{
    std::vector<double> counts(samplers.size());
    tbb::parallel_for(std::size_t{0}, samplers.size(), [&](std::size_t k) {
        const std::vector<RimPolygon> polygons = samplers[k].sample(edge);
        std::size_t rim = 0;
        for (const RimPolygon& polygon : polygons) {
            rim += polygon.size();
        }
        counts[k] = 2.0 * static_cast<double>(Lattice(polygons, edge).size()) + static_cast<double>(rim) +
                    2.0 * static_cast<double>(polygons.size()) - 4.0;
    });
    double sum = 0.0;
    for (const double count : counts) {
        sum += std::max(count, 1.0);
    }
    return sum;
}

/// One more edge length to try, from two that were: the count goes like edge^(−p), p found from both.
double nextEdge(double edge, double count, double other_edge, double other_count, double wanted)
{
    double power = 2.0;
    if (edge != other_edge && count != other_count) {
        power = std::clamp(-std::log(count / other_count) / std::log(edge / other_edge), 0.25, 3.0);
    }
    return edge * std::clamp(std::pow(count / wanted, 1.0 / power), 0.25, 4.0);
}

std::vector<PlanarMesh> meshToCount(const std::vector<RimSampler>& samplers, double area, std::size_t wanted)
{
    const auto target = static_cast<double>(wanted);
    double edge = std::sqrt(4.0 * area / (kRoot3 * target));
    double last_edge = edge;
    double last_count = 0.0;
    // Cheap guesses first: most of the way without triangulating.
    for (int k = 0; k < 4; ++k) {
        const double count = predictTriangles(samplers, edge);
        const double next = nextEdge(edge, count, k == 0 ? edge : last_edge, k == 0 ? count : last_count, target);
        const bool near = std::abs(count / target - 1.0) < 0.02;
        last_edge = edge;
        last_count = count;
        if (near) {
            break;
        }
        edge = next;
    }
    constexpr double kEnough = 0.08;  // the promise is 10 %
    std::vector<PlanarMesh> best;
    double best_error = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 5 && best_error > kEnough; ++k) {
        std::vector<PlanarMesh> meshes = meshAll(samplers, edge);
        const auto count = static_cast<double>(countTriangles(meshes));
        const double error = std::abs(std::log(count / target));
        const double next = nextEdge(edge, count, k == 0 ? edge : last_edge, k == 0 ? count : last_count, target);
        // Where narrow parts alone want more triangles than that, longer edges change nothing.
        const bool stuck = k > 0 && std::abs(count / last_count - 1.0) < 0.005;
        if (error < best_error) {
            best_error = error;
            best = std::move(meshes);
        }
        if (stuck) {
            break;
        }
        last_edge = edge;
        last_count = count;
        edge = next;
    }
    return best;
}

}  // namespace

void TriangulateOptions::validate() const
{
    if (triangles < 1) {
        throw Error(ErrorCode::InvalidArgument, "triangles 0 must be at least 1");
    }
    if (edge && !(*edge > 0.0 && std::isfinite(*edge))) {
        throw Error(ErrorCode::InvalidArgument, "edge " + std::to_string(*edge) + " m must be positive");
    }
}

std::vector<PlanarMesh> triangulate(const Domain& domain, const TriangulateOptions& options)
{
    options.validate();
    double total_area = 0.0;
    for (const Footprint& footprint : domain.droplets) {
        total_area += area(footprint);
    }
    std::vector<std::optional<RimSampler>> made(domain.droplets.size());
    tbb::parallel_for(std::size_t{0}, made.size(), [&](std::size_t k) { made[k].emplace(domain.droplets[k]); });
    std::vector<RimSampler> samplers;
    samplers.reserve(made.size());
    for (std::optional<RimSampler>& sampler : made) {
        samplers.push_back(std::move(*sampler));
    }
    return options.edge ? meshAll(samplers, *options.edge) : meshToCount(samplers, total_area, options.triangles);
}

}  // namespace droplet
