// SPDX-License-Identifier: GPL-3.0-or-later
// Prolongation of nested iteration. Rims are matched by dynamic programming, as in H. Sakoe, S. Chiba, "Dynamic
// programming algorithm optimization for spoken word recognition" (1978): every vertex of the coarse rim goes to one of
// the fine rim, in order, so that the sum of the squared ways is least. The motion fades inside by relaxation.
#include "shape/sheet_divide.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "mesh/rim_corner.h"
#include "unit_vector.h"

namespace droplet {
namespace {

/// What it costs if a corner does not go to a corner, in squared edges.
constexpr double kNoCorner = 1.0;
/// Fine vertices beside the likeliest one that are tried, and most that an edge of the coarse rim spans.
constexpr int kBand = 16;
constexpr int kSpan = 8;
/// Coarse vertices of a loop without corners of which the one nearest to a fine vertex begins.
constexpr std::size_t kStarts = 64;
/// Longest way of a rim vertex, in coarse edges: that into a rounded corner of 90° is 0.2, and 1.7 was seen in acute
/// ones.
constexpr double kFar = 4.0;
/// Sweeps of the relaxation: such a motion fades within some triangles.
constexpr int kSweeps = 30;
/// Longest way from the middle of an edge to that of its curve, over the edge.
constexpr double kBulge = 0.2;

using Places = std::vector<Vec2>;

struct Loop {
    std::uint32_t first = 0;  ///< vertex of the mesh
    Places vertices;
    std::vector<std::uint8_t> corner;
    Vec2 middle;
    double length = 0.0;
    double area = 0.0;
};

std::vector<Loop> loopsOf(const PlanarMesh& mesh)
{
    std::vector<Loop> loops;
    for (std::size_t k = 0; k < mesh.loopCount(); ++k) {
        Loop& loop = loops.emplace_back();
        loop.first = mesh.loop_starts[k];
        loop.vertices.assign(mesh.vertices.begin() + mesh.loop_starts[k],
                             mesh.vertices.begin() + mesh.loop_starts[k + 1]);
        const std::size_t count = loop.vertices.size();
        for (std::size_t i = 0; i < count; ++i) {
            const Vec2 in = loop.vertices[i] - loop.vertices[(i + count - 1) % count];
            const Vec2 out = loop.vertices[(i + 1) % count] - loop.vertices[i];
            loop.corner.push_back(std::abs(turnBetween(in, out)) > kCorner ? 1 : 0);
            loop.length += length(out);
            loop.middle = loop.middle + length(out) * (loop.vertices[i] + 0.5 * out);
            loop.area += 0.5 * cross(loop.vertices[i], loop.vertices[i] + out);
        }
        loop.middle = (1.0 / loop.length) * loop.middle;
    }
    return loops;
}

double squared(Vec2 way)
{
    return dot(way, way);
}

/// Fine loop of every coarse one: that with the nearest middle and length.
std::optional<std::vector<std::size_t>> pairedLoops(const std::vector<Loop>& coarse, const std::vector<Loop>& fine)
{
    if (coarse.size() != fine.size()) {
        return std::nullopt;
    }
    std::vector<std::uint8_t> is_taken(fine.size(), 0);
    std::vector<std::size_t> pairs;
    for (const Loop& loop : coarse) {
        std::size_t nearest = fine.size();
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < fine.size(); ++k) {
            const double apart = length(fine[k].middle - loop.middle) + std::abs(fine[k].length - loop.length);
            if (is_taken[k] == 0 && fine[k].area * loop.area > 0.0 && apart < least) {
                least = apart;
                nearest = k;
            }
        }
        if (nearest == fine.size()) {
            return std::nullopt;
        }
        is_taken[nearest] = 1;
        pairs.push_back(nearest);
    }
    return pairs;
}

/// Vertices of a coarse and a fine loop that surely belong together: a pair of corners, if there are any, as near as
/// can be.
std::pair<std::size_t, std::size_t> startOf(const Loop& coarse, const Loop& fine)
{
    const auto has_corner = [](const Loop& loop) {
        return std::find(loop.corner.begin(), loop.corner.end(), 1) != loop.corner.end();
    };
    const bool by_corners = has_corner(coarse) && has_corner(fine);
    const std::size_t stride = by_corners ? 1 : std::max<std::size_t>(1, coarse.vertices.size() / kStarts);
    std::pair<std::size_t, std::size_t> start{0, 0};
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < coarse.vertices.size(); i += stride) {
        for (std::size_t j = 0; j < fine.vertices.size() && (!by_corners || coarse.corner[i] != 0); ++j) {
            const double apart = squared(fine.vertices[j] - coarse.vertices[i]);
            if ((!by_corners || fine.corner[j] != 0) && apart < least) {
                least = apart;
                start = {i, j};
            }
        }
    }
    return start;
}

/// Fine vertex of every coarse one, in ascending order along the loop.
std::optional<std::vector<std::size_t>> match(const Loop& coarse, const Loop& fine)
{
    struct Cell {
        double cost = std::numeric_limits<double>::infinity();
        int from = 0;  ///< offset of the vertex before
    };
    const auto count = static_cast<int>(coarse.vertices.size());
    const auto fine_count = static_cast<int>(fine.vertices.size());
    if (fine_count < count) {
        return std::nullopt;
    }
    const auto [first, fine_first] = startOf(coarse, fine);
    const auto coarse_at = [&, begin = first](int i) {
        return (begin + static_cast<std::size_t>(i)) % coarse.vertices.size();
    };
    const auto fine_at = [&, begin = fine_first](int j) {
        return (begin + static_cast<std::size_t>(j)) % fine.vertices.size();
    };
    const double edge = coarse.length / count;
    const double ratio = static_cast<double>(fine_count) / count;
    std::vector<std::array<Cell, 2 * kBand + 1>> rows(static_cast<std::size_t>(count));
    std::vector<int> centres(static_cast<std::size_t>(count), 0);  // offsets of the rows' middles
    rows[0][kBand].cost = 0.0;
    int best = 0;
    for (int i = 1; i < count; ++i) {
        const auto row = static_cast<std::size_t>(i);
        const int centre = best + static_cast<int>(std::lround(ratio));
        centres[row] = centre;
        const std::size_t here = coarse_at(i);
        double least = std::numeric_limits<double>::infinity();
        for (int b = 0; b <= 2 * kBand; ++b) {
            const int j = centre - kBand + b;
            // Those that are left need vertices as well.
            if (j < i || j > fine_count - (count - i)) {
                continue;
            }
            Cell& cell = rows[row][static_cast<std::size_t>(b)];
            for (int span = 1; span <= kSpan; ++span) {
                const int before = j - span - centres[row - 1] + kBand;
                if (before >= 0 && before <= 2 * kBand &&
                    rows[row - 1][static_cast<std::size_t>(before)].cost < cell.cost) {
                    cell = {rows[row - 1][static_cast<std::size_t>(before)].cost, j - span};
                }
            }
            const std::size_t there = fine_at(j);
            cell.cost += squared(fine.vertices[there] - coarse.vertices[here]) +
                         (coarse.corner[here] == fine.corner[there] ? 0.0 : kNoCorner * edge * edge);
            if (cell.cost < least) {
                least = cell.cost;
                best = j;
            }
        }
        if (!std::isfinite(least)) {
            return std::nullopt;
        }
    }
    if (fine_count - best > kSpan) {
        return std::nullopt;
    }
    std::vector<std::size_t> matched(coarse.vertices.size());
    for (int i = count - 1; i >= 0; --i) {
        const std::size_t here = coarse_at(i);
        matched[here] = fine_at(best);
        if (squared(fine.vertices[matched[here]] - coarse.vertices[here]) > kFar * kFar * edge * edge) {
            return std::nullopt;
        }
        const auto row = static_cast<std::size_t>(i);
        const int column = best - centres[row] + kBand;
        best = rows[row][static_cast<std::size_t>(column)].from;
    }
    return matched;
}

/// Rim vertex of the fine mesh for every one of the coarse mesh, and the number of vertices up to that of the next one.
struct RimMatch {
    std::vector<std::uint32_t> vertex;
    std::vector<std::uint32_t> span;
    std::vector<std::uint32_t> next;  ///< rim vertex of the fine mesh, after every one of them
};

std::optional<RimMatch> matchRims(const PlanarMesh& coarse, const PlanarMesh& fine)
{
    const std::vector<Loop> coarse_loops = loopsOf(coarse);
    const std::vector<Loop> fine_loops = loopsOf(fine);
    const auto pairs = pairedLoops(coarse_loops, fine_loops);
    if (!pairs) {
        return std::nullopt;
    }
    RimMatch rim{std::vector<std::uint32_t>(coarse.rimVertexCount()),
                 std::vector<std::uint32_t>(coarse.rimVertexCount()),
                 std::vector<std::uint32_t>(fine.rimVertexCount())};
    for (std::size_t k = 0; k < coarse_loops.size(); ++k) {
        const Loop& loop = coarse_loops[k];
        const Loop& fine_loop = fine_loops[(*pairs)[k]];
        const auto matched = match(loop, fine_loop);
        if (!matched) {
            return std::nullopt;
        }
        const std::size_t count = loop.vertices.size();
        const std::size_t fine_count = fine_loop.vertices.size();
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t after = (*matched)[(i + 1) % count];
            rim.vertex[loop.first + i] = fine_loop.first + static_cast<std::uint32_t>((*matched)[i]);
            rim.span[loop.first + i] =
                static_cast<std::uint32_t>((after + fine_count - (*matched)[i] - 1) % fine_count + 1);
        }
        for (std::size_t j = 0; j < fine_count; ++j) {
            rim.next[fine_loop.first + j] = fine_loop.first + static_cast<std::uint32_t>((j + 1) % fine_count);
        }
    }
    return rim;
}

/// Edge of a triangle, once for each of its two triangles.
struct Edge {
    std::uint32_t low;
    std::uint32_t high;
    std::uint32_t side;  ///< three times the triangle, and the number of the corner at which it begins
};

/// Vertices inside of every sheet's edge, with the edges in ascending order.
class Divider {
public:
    Divider(const CapillarySurface& sheet, const PlanarMesh& fine, const RimMatch& rim)
        : sheet_(sheet), fine_(fine), rim_(rim)
    {
    }

    CapillarySurface run()
    {
        moveRim();
        findNormals();
        result_.loop_starts = fine_.loop_starts;
        for (std::uint32_t v = 0; v < result_.rimVertexCount(); ++v) {
            result_.vertices.push_back({fine_.vertices[v].x, fine_.vertices[v].y, 0.0});
        }
        result_.vertices.insert(result_.vertices.end(), sheet_.vertices.begin() + sheet_.rimVertexCount(),
                                sheet_.vertices.end());
        addMiddles();
        for (std::uint32_t k = 0; k < sheet_.triangles.size(); ++k) {
            divideTriangle(k);
        }
        return std::move(result_);
    }

private:
    [[nodiscard]] bool onRim(std::uint32_t v) const { return v < sheet_.rimVertexCount(); }

    /// Number of a vertex of the coarse sheet in the result.
    [[nodiscard]] std::uint32_t numberOf(std::uint32_t v) const
    {
        return onRim(v) ? rim_.vertex[v] : v - sheet_.rimVertexCount() + result_.rimVertexCount();
    }

    /// Moves the rim to its new places, and what is near along with it.
    void moveRim()
    {
        const std::size_t count = sheet_.vertices.size();
        std::vector<std::vector<std::uint32_t>> around(count);
        for (const Triangle& t : sheet_.triangles) {
            for (std::size_t a = 0; a < 3; ++a) {
                around[t[a]].push_back(t[(a + 1) % 3]);
            }
        }
        std::vector<Vec2> way(count);
        for (std::uint32_t v = 0; v < sheet_.rimVertexCount(); ++v) {
            way[v] = fine_.vertices[rim_.vertex[v]] - Vec2{sheet_.vertices[v].x, sheet_.vertices[v].y};
        }
        for (int sweep = 0; sweep < kSweeps; ++sweep) {
            for (std::size_t v = sheet_.rimVertexCount(); v < count; ++v) {
                Vec2 sum;
                for (const std::uint32_t other : around[v]) {
                    sum = sum + way[other];
                }
                way[v] = (1.0 / static_cast<double>(around[v].size())) * sum;
            }
        }
        for (std::size_t v = 0; v < count; ++v) {
            sheet_.vertices[v].x += way[v].x;
            sheet_.vertices[v].y += way[v].y;
        }
    }

    void findNormals()
    {
        normals_.assign(sheet_.vertices.size(), {});
        for (const Triangle& t : sheet_.triangles) {
            const Vec3 normal = areaVector(sheet_.vertices, t);
            for (const std::uint32_t v : t) {
                normals_[v] = normals_[v] + normal;
            }
        }
        for (Vec3& normal : normals_) {
            normal = unit(normal);
        }
    }

    /// Middle of the curve with the tangents of the sheet at its ends.
    [[nodiscard]] Vec3 middle(std::uint32_t a, std::uint32_t b) const
    {
        const Vec3 side = sheet_.vertices[b] - sheet_.vertices[a];
        const auto tangent = [&](std::uint32_t v) { return side - dot(side, normals_[v]) * normals_[v]; };
        // The normal of a rim vertex is that of triangles on one side: half of the bulge is known.
        Vec3 bulge = (onRim(a) != onRim(b) ? 0.0625 : 0.125) * (tangent(a) - tangent(b));
        const double limit = kBulge * length(side);
        if (length(bulge) > limit) {
            bulge = (limit / length(bulge)) * bulge;
        }
        Vec3 place = 0.5 * (sheet_.vertices[a] + sheet_.vertices[b]) + bulge;
        const auto on_ground = [&](std::uint32_t v) { return sheet_.vertices[v].z <= 0.0 && normals_[v].z < 0.0; };
        if (on_ground(a) && on_ground(b)) {
            place.z = 0.0;
        }
        return place;
    }

    void addMiddles()
    {
        std::vector<Edge> edges;
        edges.reserve(3 * sheet_.triangles.size());
        for (std::uint32_t k = 0; k < sheet_.triangles.size(); ++k) {
            const Triangle& t = sheet_.triangles[k];
            for (std::uint32_t a = 0; a < 3; ++a) {
                const auto [low, high] = std::minmax({t[a], t[(a + 1) % 3]});
                if (!onRim(high)) {
                    edges.push_back({low, high, 3 * k + a});
                }
            }
        }
        std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
            return a.high != b.high ? a.high < b.high : a.low != b.low ? a.low < b.low : a.side < b.side;
        });
        middles_.assign(3 * sheet_.triangles.size(), 0);
        for (std::size_t i = 0; i < edges.size(); ++i) {
            if (i == 0 || edges[i].low != edges[i - 1].low || edges[i].high != edges[i - 1].high) {
                result_.vertices.push_back(middle(edges[i].low, edges[i].high));
            }
            middles_[edges[i].side] = static_cast<std::uint32_t>(result_.vertices.size() - 1);
        }
    }

    void divideTriangle(std::uint32_t k)
    {
        const Triangle& t = sheet_.triangles[k];
        std::uint32_t first = 0;  // corner at which its edge on the rim begins, if it has one
        while (first < 3 && !(onRim(t[first]) && onRim(t[(first + 1) % 3]))) {
            ++first;
        }
        const std::uint32_t begin = first % 3;
        const auto corner = [&](std::uint32_t a) { return t[(begin + a) % 3]; };
        const auto middle_of = [&](std::uint32_t a) { return middles_[3 * k + (begin + a) % 3]; };
        std::vector<Triangle>& triangles = result_.triangles;
        triangles.push_back({middle_of(2), middle_of(1), numberOf(corner(2))});
        if (first == 3) {
            triangles.push_back({numberOf(corner(0)), middle_of(0), middle_of(2)});
            triangles.push_back({middle_of(0), numberOf(corner(1)), middle_of(1)});
            triangles.push_back({middle_of(0), middle_of(1), middle_of(2)});
            return;
        }
        // A strip between the rim's new edges and the two middles.
        const std::uint32_t span = rim_.span[corner(0)];
        std::uint32_t at = rim_.vertex[corner(0)];
        for (std::uint32_t i = 0; i < span; ++i) {
            if (i == (span + 1) / 2) {
                triangles.push_back({at, middle_of(1), middle_of(2)});
            }
            triangles.push_back({at, rim_.next[at], 2 * i < span ? middle_of(2) : middle_of(1)});
            at = rim_.next[at];
        }
        if (span == 1) {
            triangles.push_back({at, middle_of(1), middle_of(2)});
        }
    }

    CapillarySurface sheet_;  ///< coarse
    const PlanarMesh& fine_;
    const RimMatch& rim_;
    std::vector<Vec3> normals_;
    std::vector<std::uint32_t> middles_;  ///< of every triangle's edge inside, in the result
    CapillarySurface result_;
};

}  // namespace

std::optional<CapillarySurface> divide(const CapillarySurface& sheet, const PlanarMesh& coarse, const PlanarMesh& fine)
{
    const std::optional<RimMatch> rim = matchRims(coarse, fine);
    return rim ? std::optional(Divider(sheet, fine, *rim).run()) : std::nullopt;
}

}  // namespace droplet
