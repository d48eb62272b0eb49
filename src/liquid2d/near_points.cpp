// SPDX-License-Identifier: GPL-3.0-or-later
#include "liquid2d/near_points.h"

#include <algorithm>
#include <numeric>

namespace droplet {
namespace {

double coordinate(Vec2 a, bool by_x)
{
    return by_x ? a.x : a.y;
}

}  // namespace

NearPoints::NearPoints(const std::vector<Vec2>& points) : points_(points), order_(points.size())
{
    std::iota(order_.begin(), order_.end(), 0U);
    halve(order_, true);
}

std::vector<NearPoints::Neighbour> NearPoints::nearest(Vec2 from, std::size_t count) const
{
    Query query{from, count, {}};
    if (count > 0) {
        search(order_, true, query);
    }
    return std::move(query.found);
}

void NearPoints::halve(std::span<std::uint32_t> part, bool by_x)
{
    if (part.size() < 2) {
        return;
    }
    const std::size_t middle = part.size() / 2;
    std::nth_element(part.begin(), part.begin() + static_cast<std::ptrdiff_t>(middle), part.end(),
                     [&](std::uint32_t a, std::uint32_t b) {
                         const double u = coordinate(points_[a], by_x);
                         const double v = coordinate(points_[b], by_x);
                         return u < v || (u == v && a < b);
                     });
    halve(part.first(middle), !by_x);
    halve(part.subspan(middle + 1), !by_x);
}

void NearPoints::search(std::span<const std::uint32_t> part, bool by_x, Query& query) const
{
    if (part.empty()) {
        return;
    }
    const std::size_t middle = part.size() / 2;
    const Vec2 to = points_[part[middle]] - query.from;
    const Neighbour met{dot(to, to), part[middle]};
    std::vector<Neighbour>& found = query.found;
    const auto is_before = [](const Neighbour& a, const Neighbour& b) {
        return a.squared < b.squared || (a.squared == b.squared && a.index < b.index);
    };
    if (found.size() < query.count || is_before(met, found.back())) {
        found.insert(std::upper_bound(found.begin(), found.end(), met, is_before), met);
        found.resize(std::min(found.size(), query.count));
    }
    const double aside = coordinate(to, by_x);
    const std::span<const std::uint32_t> before = part.first(middle);
    const std::span<const std::uint32_t> after = part.subspan(middle + 1);
    search(aside > 0.0 ? before : after, !by_x, query);
    if (found.size() < query.count || aside * aside <= found.back().squared) {
        search(aside > 0.0 ? after : before, !by_x, query);
    }
}

}  // namespace droplet
