// SPDX-License-Identifier: GPL-3.0-or-later
//
// A front of points, after J.-F. Remacle, F. Henrotte, T. Carrier-Baudouin, E. Bechet, E. Marchandise, C. Geuzaine and
// T. Mouton, "A frontal Delaunay quad mesh generator using the L-infinity norm" (2013). Every point asks for its four
// neighbours along a field of crosses, beginning at the rim. One is taken if no point is nearer to it than 0.7 sides,
// as the larger of the distances along both bars of its cross. A Delaunay triangulation of such points consists of
// right-angled triangles, nearly all in pairs.
//
// A cross is the number exp(4 i a), with a the angle of any of its bars, which does not depend on the bar. Along the
// rim it is that of the tangent; inside, both parts of the number are harmonic, so that the field is as smooth as it
// can be and has few singular points (F. Kowalski, F. Ledoux and P. Frey, "A PDE based approach to multidomain
// partitioning and quadrilateral meshing", 2012). The sides grow from the rim's edges inward.

#include "mesh/aligned_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <queue>
#include <utility>

#include "droplet/mesh/planar_mesh.h"
#include "mesh/band.h"
#include "mesh/harmonic.h"
#include "mesh/lattice_core.h"
#include "mesh/triangle_pairs.h"

namespace droplet {
namespace {

using Cross = std::complex<double>;  ///< exp(4 i angle), or shorter where the direction is unsure

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// Least distance of two points, in sides. The paper's; with 1, rows would have gaps wherever they narrow, with 0.5 two
/// rows would fit between others.
constexpr double kNearest = 0.7;

/// A square beside the rim is a little shorter than its sides, so that in a corner of the rim, where sides may differ,
/// the triangulation joins the corner with the opposite one, not the two beside it: an edge between two vertices of the
/// rim would be split.
constexpr double kShorter = 0.95;

/// Growth of the sides per distance from the rim. With a quarter, a square next to one of side 1 has 1.25 at most.
constexpr double kGrowth = 0.25;

/// Edges of the triangles that carry the field, in sides; they become longer inward. The field bends where the rim
/// does, and there the rim's own edges are as short as the sides.
constexpr double kFieldEdge = 2.0;
constexpr int kFieldGrading = 8;

/// Place in the field: a triangle and the weights of its corners.
struct Place {
    std::uint32_t triangle = 0;
    std::array<double, 3> weights = {};
};

/// Direction and length of the side of a square.
struct Side {
    Vec2 along;     ///< unit vector
    double length;  ///< [m]
};

/// Field of crosses and sides on a triangulation of the polygons.
class Field {
public:
    Field(const std::vector<RimPolygon>& polygons, double edge)
    {
        for (const RimPolygon& polygon : polygons) {
            vertices_.insert(vertices_.end(), polygon.begin(), polygon.end());
        }
        rim_ = static_cast<std::uint32_t>(vertices_.size());
        const std::vector<Vec2> inner = gradedPoints(polygons, kFieldEdge * edge, kFieldGrading);
        vertices_.insert(vertices_.end(), inner.begin(), inner.end());
        triangles_ = triangulateUnrefined(polygons, inner);
        connect();
        setRim(polygons, edge);
        solveCrosses();
        growSides();
    }

    [[nodiscard]] Vec2 vertex(std::uint32_t v) const { return vertices_[v]; }
    [[nodiscard]] double side(std::uint32_t v) const { return sides_[v]; }
    /// A triangle of a vertex.
    [[nodiscard]] std::uint32_t triangleOf(std::uint32_t v) const { return triangle_of_[v]; }

    /// Walks from a triangle to a point; nothing if the rim is in the way.
    [[nodiscard]] std::optional<Place> find(Vec2 p, std::uint32_t from) const
    {
        // A walk among constrained triangles may turn in circles. Points are a few triangles away.
        constexpr int kMaxSteps = 200;
        std::uint32_t t = from;
        for (int step = 0; step < kMaxSteps; ++step) {
            std::array<double, 3> areas = {};
            std::optional<std::uint32_t> next;
            bool is_inside = true;
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec2 a = vertices_[triangles_[t][(k + 1) % 3]];
                const Vec2 b = vertices_[triangles_[t][(k + 2) % 3]];
                areas[k] = cross(b - a, p - a);
                if (areas[k] < 0.0) {
                    is_inside = false;
                    if (neighbours_[t][k] != kNone) {
                        next = neighbours_[t][k];
                    }
                }
            }
            if (is_inside) {
                const double whole = areas[0] + areas[1] + areas[2];
                return Place{t, {areas[0] / whole, areas[1] / whole, areas[2] / whole}};
            }
            if (!next) {
                return std::nullopt;
            }
            t = *next;
        }
        return std::nullopt;
    }

    [[nodiscard]] Side at(const Place& place) const
    {
        Cross cross = {};
        double side = 0.0;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t v = triangles_[place.triangle][k];
            cross += place.weights[k] * crosses_[v];
            side += place.weights[k] * sides_[v];
        }
        const double angle = 0.25 * std::arg(cross);
        return {{std::cos(angle), std::sin(angle)}, side};
    }

private:
    /// Finds the triangles beside each other, and one of every vertex.
    void connect()
    {
        triangle_of_.resize(vertices_.size(), 0);
        for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
            for (const std::uint32_t v : triangles_[t]) {
                triangle_of_[v] = t;
            }
        }
        neighbours_.assign(triangles_.size(), {kNone, kNone, kNone});
        for (const auto& [one, other] : trianglePairs(triangles_)) {
            neighbours_[one.triangle][one.corner] = other.triangle;
            neighbours_[other.triangle][other.corner] = one.triangle;
        }
    }

    /// Crosses and sides along the rim: means of both edges at a vertex.
    void setRim(const std::vector<RimPolygon>& polygons, double edge)
    {
        crosses_.assign(vertices_.size(), {});
        sides_.assign(vertices_.size(), edge);
        std::size_t first = 0;
        for (const RimPolygon& polygon : polygons) {
            const std::size_t count = polygon.size();
            for (std::size_t i = 0; i < count; ++i) {
                const Vec2 step = polygon[(i + 1) % count] - polygon[i];
                const Cross cross = std::polar(0.5, 4.0 * std::atan2(step.y, step.x));
                const double half = 0.5 * length(step);
                for (const std::size_t v : {first + i, first + (i + 1) % count}) {
                    crosses_[v] += cross;
                    sides_[v] += half;
                }
            }
            for (std::size_t v = first; v < first + count; ++v) {
                sides_[v] -= edge;
            }
            first += count;
        }
    }

    /// Continues the crosses inside.
    void solveCrosses()
    {
        std::vector<Vec3> places;
        places.reserve(vertices_.size());
        for (const Vec2 p : vertices_) {
            places.push_back({p.x, p.y, 0.0});
        }
        Eigen::MatrixX2d rim(static_cast<Eigen::Index>(rim_), 2);
        for (std::uint32_t v = 0; v < rim_; ++v) {
            rim.row(static_cast<Eigen::Index>(v)) << crosses_[v].real(), crosses_[v].imag();
        }
        const Eigen::MatrixX2d inside = harmonic(places, triangles_, rim);
        for (std::uint32_t v = rim_; v < vertices_.size(); ++v) {
            const auto row = static_cast<Eigen::Index>(v - rim_);
            crosses_[v] = {inside(row, 0), inside(row, 1)};
        }
    }

    /// Limits the sides' growth away from every vertex, by shortest ways along edges (Dijkstra).
    void growSides()
    {
        std::vector<std::vector<std::uint32_t>> around(vertices_.size());
        for (const Triangle& t : triangles_) {
            for (std::size_t k = 0; k < 3; ++k) {
                around[t[k]].push_back(t[(k + 1) % 3]);
                around[t[k]].push_back(t[(k + 2) % 3]);
            }
        }
        using Entry = std::pair<double, std::uint32_t>;
        std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
        for (std::uint32_t v = 0; v < rim_; ++v) {
            queue.emplace(sides_[v], v);
        }
        while (!queue.empty()) {
            const auto [side, v] = queue.top();
            queue.pop();
            if (side > sides_[v]) {
                continue;
            }
            for (const std::uint32_t w : around[v]) {
                const double grown = side + kGrowth * length(vertices_[w] - vertices_[v]);
                if (grown < sides_[w]) {
                    sides_[w] = grown;
                    queue.emplace(grown, w);
                }
            }
        }
    }

    std::vector<Vec2> vertices_;  ///< those of the rim first
    std::uint32_t rim_ = 0;       ///< number of the rim's
    std::vector<Triangle> triangles_;
    std::vector<std::array<std::uint32_t, 3>> neighbours_;  ///< beyond the edge that faces a corner; kNone: the rim
    std::vector<std::uint32_t> triangle_of_;                ///< of every vertex
    std::vector<Cross> crosses_;
    std::vector<double> sides_;  ///< [m]
};

/// Points in cells of a grid.
class Cells {
public:
    Cells(const std::vector<RimPolygon>& polygons, double size) : size_(size)
    {
        Vec2 high = low_ = polygons.front().front();
        for (const Vec2 p : polygons.front()) {
            low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y)};
        }
        columns_ = static_cast<std::size_t>((high.x - low_.x) / size_) + 1;
        rows_ = static_cast<std::size_t>((high.y - low_.y) / size_) + 1;
        cells_.resize(columns_ * rows_);
    }

    void add(Vec2 p) { cells_[row(p.y) * columns_ + column(p.x)].push_back(p); }

    /// Whether a point is nearer than a distance, by the larger part along the sides of a square.
    [[nodiscard]] bool anyNear(Vec2 p, Vec2 along, double distance) const
    {
        const double reach = std::sqrt(2.0) * distance;
        for (std::size_t j = row(p.y - reach); j <= row(p.y + reach); ++j) {
            for (std::size_t i = column(p.x - reach); i <= column(p.x + reach); ++i) {
                for (const Vec2 q : cells_[j * columns_ + i]) {
                    if (std::max(std::abs(dot(along, q - p)), std::abs(cross(along, q - p))) < distance) {
                        return true;
                    }
                }
            }
        }
        return false;
    }

private:
    [[nodiscard]] std::size_t column(double x) const { return cellOf(x - low_.x, columns_); }
    [[nodiscard]] std::size_t row(double y) const { return cellOf(y - low_.y, rows_); }
    [[nodiscard]] std::size_t cellOf(double distance, std::size_t count) const
    {
        return std::min(static_cast<std::size_t>(std::max(distance, 0.0) / size_), count - 1);
    }

    double size_;
    Vec2 low_;
    std::size_t columns_ = 0;
    std::size_t rows_ = 0;
    std::vector<std::vector<Vec2>> cells_;
};

}  // namespace

std::vector<Vec2> alignedPoints(const std::vector<RimPolygon>& polygons, double edge)
{
    const Field field(polygons, edge);
    Cells cells(polygons, edge);
    struct Asking {
        Vec2 place;
        std::uint32_t triangle;
        bool is_rim;
    };
    std::queue<Asking> front;
    std::uint32_t first = 0;
    for (const RimPolygon& polygon : polygons) {
        const auto count = static_cast<std::uint32_t>(polygon.size());
        for (std::uint32_t v = first; v < first + count; ++v) {
            front.push({field.vertex(v), field.triangleOf(v), true});
            // Beside short edges, squares are smaller than a long edge is; they are to be clear of all of it.
            const std::uint32_t next = v + 1 < first + count ? v + 1 : first;
            const Vec2 way = field.vertex(next) - field.vertex(v);
            const double pieces = std::ceil(length(way) / std::min(field.side(v), field.side(next)));
            for (std::uint32_t k = 0; k < static_cast<std::uint32_t>(pieces); ++k) {
                cells.add(field.vertex(v) + (k / pieces) * way);
            }
        }
        first += count;
    }
    std::vector<Vec2> points;
    while (!front.empty()) {
        const Asking from = front.front();
        front.pop();
        const std::optional<Place> here = field.find(from.place, from.triangle);
        if (!here) {
            continue;
        }
        const Side side = field.at(*here);
        const Vec2 step = (from.is_rim ? kShorter : 1.0) * side.length * side.along;
        for (const Vec2 way : {step, Vec2{-step.y, step.x}, -1.0 * step, Vec2{step.y, -step.x}}) {
            const Vec2 p = from.place + way;
            const std::optional<Place> there = field.find(p, here->triangle);
            if (!there) {
                continue;
            }
            const Side square = field.at(*there);
            if (!cells.anyNear(p, square.along, kNearest * square.length)) {
                points.push_back(p);
                cells.add(p);
                front.push({p, there->triangle, false});
            }
        }
    }
    return points;
}

}  // namespace droplet
