// SPDX-License-Identifier: GPL-3.0-or-later
//
// Exact areas of polygons in pixels, summed up along rows from their edges, as by R. Levien's font-rs (2016).
#include "droplet/colours/colour_drawing.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

#include "droplet/error.h"
#include "require.h"

namespace droplet {
namespace {

/// Edge of an area [px], y down.
struct Edge {
    Vec2 from;
    Vec2 to;
    std::size_t area = 0;
};

/// Calls a function with the pieces of a line between consecutive whole numbers of a coordinate.
template <class Visit>
void divide(Vec2 from, Vec2 to, double Vec2::*along, const Visit& visit)
{
    const double length = to.*along - from.*along;
    const auto [low, high] = std::minmax(from.*along, to.*along);
    const double first = std::floor(low) + 1.0;
    const auto count = static_cast<int>(std::ceil(high) - first);
    Vec2 last = from;
    for (int k = 0; k < count; ++k) {
        const double at = length > 0.0 ? first + k : first + (count - 1 - k);
        Vec2 next = from + ((at - from.*along) / length) * (to - from);
        next.*along = at;
        visit(last, next);
        last = next;
    }
    visit(last, to);
}

/// Index of the row or column in which a piece lies.
int cellOf(double a, double b, int size)
{
    return std::clamp(static_cast<int>(std::floor(0.5 * (a + b))), 0, size - 1);
}

/// Areas of colours in the pixels of one row.
class RowOfPixels {
public:
    explicit RowOfPixels(int width) : width_(width), sum_(at(width) + 1), total_(at(width)), shares_(at(width)) {}

    /// Adds an edge's piece in this row; what lies to the right of an edge that runs down is inside.
    void add(Vec2 from, Vec2 to)
    {
        divide(from, to, &Vec2::x, [&](Vec2 a, Vec2 b) {
            const int x = cellOf(a.x, b.x, width_);
            const double right = 0.5 * (a.x + b.x) - x;
            sum_[at(x)] += (b.y - a.y) * (1.0 - right);
            sum_[at(x) + 1] += (b.y - a.y) * right;
        });
    }

    /// Ends an area, all of whose edges have been added.
    void finish(std::uint8_t label)
    {
        double inside = 0.0;
        for (std::size_t x = 0; x < total_.size(); ++x) {
            inside += std::exchange(sum_[x], 0.0);
            const double share = std::clamp(inside, 0.0, 1.0);
            total_[x] += share;
            auto& [first, second] = shares_[x];
            if (share > first.area) {
                second = std::exchange(first, {share, label});
            } else if (share > second.area) {
                second = {share, label};
            }
        }
        sum_.back() = 0.0;
    }

    void store(int y, ColourRegions& regions) const
    {
        constexpr double kLeast = 1e-6;  // less is an effect of rounding
        constexpr double kDeep = std::numeric_limits<std::uint16_t>::max();
        constexpr double kFull = std::numeric_limits<std::uint8_t>::max();
        for (std::size_t x = 0; x < total_.size(); ++x) {
            const std::size_t i = at(y) * at(width_) + x;
            const auto& [first, second] = shares_[x];
            const bool is_mixed = second.area > kLeast;
            regions.alpha[i] = static_cast<std::uint16_t>(std::lround(kDeep * std::min(1.0, total_[x])));
            regions.label[i] = total_[x] >= 0.5 ? first.label : std::uint8_t{0};
            const double share = is_mixed ? first.area / (first.area + second.area) : 1.0;
            regions.mixture[i] = {is_mixed ? second.label : std::uint8_t{0},
                                  static_cast<std::uint8_t>(std::lround(kFull * share))};
        }
    }

private:
    struct Share {
        double area = 0.0;
        std::uint8_t label = 0;
    };

    static std::size_t at(int i) { return static_cast<std::size_t>(i); }

    int width_;
    std::vector<double> sum_;  ///< changes of the area from pixel to pixel
    std::vector<double> total_;
    std::vector<std::pair<Share, Share>> shares_;  ///< the largest two
};

std::vector<Edge> edgesOf(const ColourDrawing& drawing, Vec2 top_left, double pixel)
{
    std::vector<Edge> edges;
    for (std::size_t k = 0; k < drawing.areas.size(); ++k) {
        for (const std::vector<Vec2>& loop : drawing.areas[k].loops) {
            for (std::size_t i = 0; i < loop.size(); ++i) {
                const auto place = [&](Vec2 p) { return Vec2{(p.x - top_left.x) / pixel, (top_left.y - p.y) / pixel}; };
                edges.push_back({place(loop[i]), place(loop[(i + 1) % loop.size()]), k});
            }
        }
    }
    return edges;
}

}  // namespace

double area(const ColourArea& colour_area)
{
    double sum = 0.0;
    for (const std::vector<Vec2>& loop : colour_area.loops) {
        for (std::size_t i = 0; i < loop.size(); ++i) {
            sum += 0.5 * cross(loop[i], loop[(i + 1) % loop.size()]);
        }
    }
    return sum;
}

ColourRegions drawColours(const ColourDrawing& drawing, int long_side)
{
    constexpr int kMaxSide = 16384;
    constexpr std::size_t kMaxAreas = std::numeric_limits<std::uint8_t>::max();
    requireWithin("long_side", long_side, 1, kMaxSide);
    if (drawing.areas.size() > kMaxAreas) {
        throw Error(ErrorCode::InvalidInput, "has " + std::to_string(drawing.areas.size()) +
                                                 " colours; at most 255 can become droplets by colour");
    }
    const double pixel = std::max(drawing.extent.x, drawing.extent.y) / long_side;
    const auto pixels = [&](double side) {
        constexpr double kRounding = 1e-9;
        return std::max(1, static_cast<int>(std::ceil(side / pixel - kRounding)));
    };
    ColourRegions regions;
    regions.width = pixels(drawing.extent.x);
    regions.height = pixels(drawing.extent.y);
    regions.raster_scale = 1.0;
    regions.physical_width = pixel * regions.width;
    const auto size = static_cast<std::size_t>(regions.width) * static_cast<std::size_t>(regions.height);
    regions.label.assign(size, 0);
    regions.alpha.assign(size, 0);
    regions.mixture.assign(size, {});

    // Pieces of edges by row, in the order of the areas.
    std::vector<std::vector<Edge>> rows(static_cast<std::size_t>(regions.height));
    for (const Edge& edge : edgesOf(drawing, {-0.5 * pixel * regions.width, 0.5 * pixel * regions.height}, pixel)) {
        divide(edge.from, edge.to, &Vec2::y, [&](Vec2 a, Vec2 b) {
            rows[static_cast<std::size_t>(cellOf(a.y, b.y, regions.height))].push_back({a, b, edge.area});
        });
    }
    tbb::parallel_for(0, regions.height, [&](int y) {
        RowOfPixels row(regions.width);
        const std::vector<Edge>& edges = rows[static_cast<std::size_t>(y)];
        for (std::size_t i = 0; i < edges.size(); ++i) {
            row.add(edges[i].from, edges[i].to);
            if (i + 1 == edges.size() || edges[i + 1].area != edges[i].area) {
                row.finish(static_cast<std::uint8_t>(edges[i].area + 1));
            }
        }
        row.store(y, regions);
    });
    std::array<std::size_t, kMaxAreas + 1> count{};
    for (const std::uint8_t label : regions.label) {
        ++count[label];
    }
    for (std::size_t k = 0; k < drawing.areas.size(); ++k) {
        regions.palette.push_back({drawing.areas[k].colour, count[k + 1]});
    }
    return regions;
}

}  // namespace droplet
