// SPDX-License-Identifier: GPL-3.0-or-later
//
// Nesting of loops as in S. Suzuki and K. Abe, "Topological structural analysis of digitized binary images by border
// following" (1985): the nearest loop to the left of a hole's leftmost point is its surrounding rim, or a hole whose
// rim is known.

#include "droplet/domain/domain.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

#include "droplet/error.h"

namespace droplet {
namespace {

struct Edge {
    Vec2 from;
    Vec2 to;
    std::size_t loop = 0;
};

/// Edges of all loops, sorted by rows and within a row by their right ends.
class EdgeRows {
public:
    explicit EdgeRows(const std::vector<Loop>& loops)
    {
        double top = -std::numeric_limits<double>::infinity();
        std::size_t count = 0;
        for (const Loop& loop : loops) {
            count += loop.points.size();
        }
        edges_.reserve(count);
        for (std::size_t k = 0; k < loops.size(); ++k) {
            const std::vector<Vec2>& points = loops[k].points;
            for (std::size_t i = 0; i < points.size(); ++i) {
                edges_.push_back({points[i], points[(i + 1) % points.size()], k});
                bottom_ = std::min(bottom_, points[i].y);
                top = std::max(top, points[i].y);
            }
        }
        // With about this many rows, traced loops have as many entries of edges as rows.
        const std::size_t rows = std::max<std::size_t>(1, static_cast<std::size_t>(std::sqrt(edges_.size())));
        rows_.resize(rows);
        per_unit_ = top > bottom_ ? static_cast<double>(rows) / (top - bottom_) : 0.0;
        for (std::size_t e = 0; e < edges_.size(); ++e) {
            const auto [low, high] = std::minmax(edges_[e].from.y, edges_[e].to.y);
            const auto [left, right] = std::minmax(edges_[e].from.x, edges_[e].to.x);
            for (std::size_t row = rowOf(low); row <= rowOf(high); ++row) {
                rows_[row].entries.push_back({right, e});
                rows_[row].widest = std::max(rows_[row].widest, right - left);
            }
        }
        tbb::parallel_for(std::size_t{0}, rows,
                          [&](std::size_t row) { std::sort(rows_[row].entries.begin(), rows_[row].entries.end()); });
    }

    /// The loop whose edge is met first on the way left from a point; one loop is excepted.
    [[nodiscard]] std::optional<std::size_t> firstLeftOf(Vec2 point, std::size_t excepted) const
    {
        std::optional<std::size_t> found;
        double nearest = -std::numeric_limits<double>::infinity();
        const Row& row = rows_[rowOf(point.y)];
        // Edges that end further right than this begin to the right of the point.
        const Entry rightmost{point.x + row.widest, edges_.size()};
        for (auto entry = std::upper_bound(row.entries.begin(), row.entries.end(), rightmost);
             entry != row.entries.begin() && std::prev(entry)->right >= nearest; --entry) {
            const Edge& edge = edges_[std::prev(entry)->edge];
            // Edges are half-open in height, so that a line through a vertex meets one of its two edges.
            if (edge.loop == excepted || (edge.from.y > point.y) == (edge.to.y > point.y)) {
                continue;
            }
            const double x =
                edge.from.x + (point.y - edge.from.y) / (edge.to.y - edge.from.y) * (edge.to.x - edge.from.x);
            if (x <= point.x && x > nearest) {
                nearest = x;
                found = edge.loop;
            }
        }
        return found;
    }

private:
    struct Entry {
        double right = 0.0;  ///< right end of the edge
        std::size_t edge = 0;

        friend bool operator<(const Entry& a, const Entry& b)
        {
            return std::tie(a.right, a.edge) < std::tie(b.right, b.edge);
        }
    };

    struct Row {
        std::vector<Entry> entries;
        double widest = 0.0;  ///< largest width of an edge
    };

    [[nodiscard]] std::size_t rowOf(double y) const
    {
        const auto row = static_cast<std::size_t>(std::max(0.0, (y - bottom_) * per_unit_));
        return std::min(row, rows_.size() - 1);
    }

    std::vector<Edge> edges_;
    std::vector<Row> rows_;
    double bottom_ = std::numeric_limits<double>::infinity();
    double per_unit_ = 0.0;
};

Vec2 leftmost(const Loop& loop)
{
    return *std::min_element(loop.points.begin(), loop.points.end(),
                             [](Vec2 a, Vec2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
}

double loopLength(const Loop& loop)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < loop.points.size(); ++i) {
        sum += length(loop.points[(i + 1) % loop.points.size()] - loop.points[i]);
    }
    return sum;
}

}  // namespace

Domain split(const Outline& outline)
{
    const std::vector<Loop>& loops = outline.loops;
    Domain domain;
    domain.extent = outline.extent;
    // Droplet of every loop: for a rim its own, for a hole the one it lies in, once that is known.
    std::vector<std::size_t> droplet_of(loops.size());
    std::vector<std::size_t> holes;
    for (std::size_t k = 0; k < loops.size(); ++k) {
        if (signedArea(loops[k]) > 0) {
            droplet_of[k] = domain.droplets.size();
            domain.droplets.push_back({loops[k], {}});
        } else {
            holes.push_back(k);
        }
    }
    if (domain.droplets.empty()) {
        throw Error(ErrorCode::InvalidInput, "no loop of the outline encloses liquid");
    }
    if (holes.empty()) {
        return domain;
    }
    // Holes go from left to right, so that a hole met on the way left has its droplet already.
    std::vector<std::pair<Vec2, std::size_t>> from_left;
    from_left.reserve(holes.size());
    for (const std::size_t hole : holes) {
        from_left.emplace_back(leftmost(loops[hole]), hole);
    }
    std::sort(from_left.begin(), from_left.end(), [](const auto& a, const auto& b) { return a.first.x < b.first.x; });
    const EdgeRows rows(loops);
    for (const auto& [point, hole] : from_left) {
        const std::optional<std::size_t> neighbour = rows.firstLeftOf(point, hole);
        if (!neighbour) {
            throw Error(ErrorCode::InvalidInput, "a hole of the outline lies outside of all rims");
        }
        droplet_of[hole] = droplet_of[*neighbour];
    }
    // Holes keep the order of the outline.
    for (const std::size_t hole : holes) {
        domain.droplets[droplet_of[hole]].holes.push_back(loops[hole]);
    }
    return domain;
}

double area(const Footprint& footprint)
{
    double sum = signedArea(footprint.rim);
    for (const Loop& hole : footprint.holes) {
        sum += signedArea(hole);
    }
    return sum;
}

double rimLength(const Footprint& footprint)
{
    double sum = loopLength(footprint.rim);
    for (const Loop& hole : footprint.holes) {
        sum += loopLength(hole);
    }
    return sum;
}

}  // namespace droplet
