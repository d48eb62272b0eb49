// SPDX-License-Identifier: GPL-3.0-or-later
//
// Nesting of loops as in S. Suzuki and K. Abe, "Topological structural analysis of digitized binary images by border
// following" (1985): what lies next to a hole's leftmost point is its surrounding rim, or a hole whose rim is known.

#include "droplet/footprint/domain.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>

#include "droplet/error.h"

namespace droplet {
namespace {

struct Edge {
    Vec2 from;
    Vec2 to;
    std::size_t loop = 0;
};

/// Edges of all loops, found by the height of a horizontal line.
class EdgeRows {
public:
    explicit EdgeRows(const std::vector<Loop>& loops)
    {
        double top = -std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < loops.size(); ++k) {
            const std::vector<Vec2>& points = loops[k].points;
            for (std::size_t i = 0; i < points.size(); ++i) {
                edges_.push_back({points[i], points[(i + 1) % points.size()], k});
                bottom_ = std::min(bottom_, points[i].y);
                top = std::max(top, points[i].y);
            }
        }
        // About as many rows as make the edges' entries and the rows themselves equally many for traced loops.
        const std::size_t rows = std::max<std::size_t>(1, static_cast<std::size_t>(std::sqrt(edges_.size())));
        rows_.resize(rows);
        per_unit_ = top > bottom_ ? static_cast<double>(rows) / (top - bottom_) : 0.0;
        for (std::size_t e = 0; e < edges_.size(); ++e) {
            const auto [low, high] = std::minmax(edges_[e].from.y, edges_[e].to.y);
            for (std::size_t row = rowOf(low); row <= rowOf(high); ++row) {
                rows_[row].push_back(e);
            }
        }
    }

    /// The loop whose edge is met first going left from a point, other than the loop excepted.
    [[nodiscard]] std::optional<std::size_t> firstLeftOf(Vec2 point, std::size_t excepted) const
    {
        std::optional<std::size_t> found;
        double nearest = -std::numeric_limits<double>::infinity();
        for (const std::size_t e : rows_[rowOf(point.y)]) {
            const Edge& edge = edges_[e];
            // Half-open in height, so that a line through a vertex meets one of its two edges.
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
    [[nodiscard]] std::size_t rowOf(double y) const
    {
        const auto row = static_cast<std::size_t>(std::max(0.0, (y - bottom_) * per_unit_));
        return std::min(row, rows_.size() - 1);
    }

    std::vector<Edge> edges_;
    std::vector<std::vector<std::size_t>> rows_;
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
    // For a rim, its own droplet; for a hole, the droplet it lies in once that is known.
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
    // From left to right, a hole met on the way has its droplet already.
    std::sort(holes.begin(), holes.end(),
              [&](std::size_t a, std::size_t b) { return leftmost(loops[a]).x < leftmost(loops[b]).x; });
    const EdgeRows rows(loops);
    for (const std::size_t hole : holes) {
        const std::optional<std::size_t> neighbour = rows.firstLeftOf(leftmost(loops[hole]), hole);
        if (!neighbour) {
            throw Error(ErrorCode::InvalidInput, "a hole of the outline lies in no rim");
        }
        droplet_of[hole] = droplet_of[*neighbour];
    }
    // Holes in the order of the outline, whatever order they were sorted out in.
    std::sort(holes.begin(), holes.end());
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
