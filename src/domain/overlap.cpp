// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/domain/overlap.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "droplet/error.h"
#include "require.h"

namespace droplet {
namespace {

/// Place where a row enters or leaves a droplet.
struct Crossing {
    double x = 0.0;
    std::size_t droplet = 0;
};

using Rows = std::map<long, std::vector<Crossing>>;

/// Height of a row. Rows lie between multiples of their distance, because rims along pixels lie on those.
double heightOf(long row, double distance)
{
    return (static_cast<double>(row) + 0.5) * distance;
}

void addLoop(const Loop& loop, std::size_t droplet, double distance, Rows& rows)
{
    for (std::size_t i = 0; i < loop.points.size(); ++i) {
        Vec2 a = loop.points[i];
        Vec2 b = loop.points[(i + 1) % loop.points.size()];
        if (a.y > b.y) {
            std::swap(a, b);
        }
        // Rows from a (included) to b (excluded), so that each loop crosses a row an even number of times.
        for (long row = std::lround(std::ceil(a.y / distance - 0.5)); heightOf(row, distance) < b.y; ++row) {
            const double y = heightOf(row, distance);
            if (y >= a.y) {
                rows[row].push_back({a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x), droplet});
            }
        }
    }
}

Rows rowsOf(const Domain& domain, double distance)
{
    Rows rows;
    for (std::size_t k = 0; k < domain.droplets.size(); ++k) {
        addLoop(domain.droplets[k].rim, k, distance, rows);
        for (const Loop& hole : domain.droplets[k].holes) {
            addLoop(hole, k, distance, rows);
        }
    }
    for (auto& [row, crossings] : rows) {
        std::stable_sort(crossings.begin(), crossings.end(),
                         [](const Crossing& a, const Crossing& b) { return a.x < b.x; });
    }
    return rows;
}

/// Interval of a row inside a droplet.
struct Interval {
    double from = 0.0;
    double to = 0.0;
    std::size_t droplet = 0;
};

/// Intervals in ascending order. They do not overlap, because droplets of a domain do not.
std::vector<Interval> intervalsOf(const std::vector<Crossing>& crossings)
{
    std::map<std::size_t, double> open;
    std::vector<Interval> intervals;
    for (const Crossing& crossing : crossings) {
        const auto at = open.find(crossing.droplet);
        if (at == open.end()) {
            open.emplace(crossing.droplet, crossing.x);
        } else {
            intervals.push_back({at->second, crossing.x, crossing.droplet});
            open.erase(at);
        }
    }
    std::sort(intervals.begin(), intervals.end(), [](const Interval& a, const Interval& b) { return a.from < b.from; });
    return intervals;
}

}  // namespace

std::vector<Overlap> overlaps(const Domain& first, const Domain& second, double row)
{
    require(row > 0.0 && std::isfinite(row), "row", row, "finite and more than 0 m");
    const Rows of_first = rowsOf(first, row);
    const Rows of_second = rowsOf(second, row);
    std::map<std::pair<std::size_t, std::size_t>, double> areas;
    for (const auto& [index, crossings] : of_first) {
        const auto other = of_second.find(index);
        if (other == of_second.end()) {
            continue;
        }
        const std::vector<Interval> a = intervalsOf(crossings);
        const std::vector<Interval> b = intervalsOf(other->second);
        for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
            const double common = std::min(a[i].to, b[j].to) - std::max(a[i].from, b[j].from);
            if (common > 0.0) {
                areas[{a[i].droplet, b[j].droplet}] += common * row;
            }
            ++(a[i].to < b[j].to ? i : j);
        }
    }
    std::vector<Overlap> result;
    result.reserve(areas.size());
    for (const auto& [pair, area] : areas) {
        result.push_back({pair.first, pair.second, area});
    }
    return result;
}

}  // namespace droplet
