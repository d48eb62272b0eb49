// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/lattice_region.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <tuple>
#include <utility>

namespace droplet {
namespace {

/// Interval of x; its user decides whether it is open or closed.
struct Span {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;

    void add(double x)
    {
        low = std::min(low, x);
        high = std::max(high, x);
    }
};

/// Interval in which the line at height y is nearer to the segment ab than `reach`. That region is a capsule, so there
/// is one interval.
Span nearPiece(Vec2 a, Vec2 b, double reach, double y)
{
    Span span;
    for (const Vec2 end : {a, b}) {
        const double dy = y - end.y;
        if (std::abs(dy) < reach) {
            const double half = std::sqrt(reach * reach - dy * dy);
            span.add(end.x - half);
            span.add(end.x + half);
        }
    }
    const Vec2 along = b - a;
    const double size = length(along);
    if (size > 0.0) {
        const Vec2 aside = (reach / size) * Vec2{-along.y, along.x};
        const std::array<Vec2, 4> corners{a + aside, b + aside, b - aside, a - aside};
        for (std::size_t k = 0; k < 4; ++k) {
            const Vec2 p = corners[k];
            const Vec2 q = corners[(k + 1) % 4];
            if ((p.y <= y) != (q.y <= y)) {
                span.add(p.x + (y - p.y) / (q.y - p.y) * (q.x - p.x));
            }
        }
    }
    return span;
}

std::int32_t whole(double x)
{
    return static_cast<std::int32_t>(x);
}

bool beginsAfter(std::int32_t column, const RowInterval& interval)
{
    return column < interval.begin;
}

constexpr std::int32_t ceilHalf(std::int32_t n)
{
    return n >= 0 ? (n + 1) / 2 : -(-n / 2);
}

}  // namespace

LatticeRegion::LatticeRegion(std::vector<RowInterval> intervals) : intervals_(std::move(intervals))
{
    std::erase_if(intervals_, [](const RowInterval& i) { return i.begin >= i.end; });
    if (intervals_.empty()) {
        return;
    }
    if (!std::is_sorted(intervals_.begin(), intervals_.end())) {
        std::sort(intervals_.begin(), intervals_.end());
    }
    auto last = intervals_.begin();
    for (auto i = last + 1; i != intervals_.end(); ++i) {
        if (i->row == last->row && i->begin <= last->end) {
            last->end = std::max(last->end, i->end);
        } else {
            *++last = *i;
        }
    }
    intervals_.erase(last + 1, intervals_.end());
    row_starts_.reserve(static_cast<std::size_t>(endRow() - firstRow()) + 1);
    for (std::uint32_t k = 0; k < intervals_.size(); ++k) {
        row_starts_.resize(static_cast<std::size_t>(intervals_[k].row - firstRow()) + 1, k);
    }
    row_starts_.push_back(static_cast<std::uint32_t>(intervals_.size()));
}

std::span<const RowInterval> LatticeRegion::row(std::int32_t row) const
{
    if (empty() || row < firstRow() || row >= endRow()) {
        return {};
    }
    const auto k = static_cast<std::size_t>(row - firstRow());
    return std::span(intervals_).subspan(row_starts_[k], row_starts_[k + 1] - row_starts_[k]);
}

bool LatticeRegion::contains(Site site) const
{
    const std::span<const RowInterval> row = this->row(site.row);
    const auto after = std::upper_bound(row.begin(), row.end(), site.column, beginsAfter);
    return after != row.begin() && site.column < std::prev(after)->end;
}

std::size_t LatticeRegion::intervalOf(Site site) const
{
    const auto k = static_cast<std::size_t>(site.row - firstRow());
    const auto after = std::upper_bound(intervals_.begin() + row_starts_[k], intervals_.begin() + row_starts_[k + 1],
                                        site.column, beginsAfter);
    return static_cast<std::size_t>(after - intervals_.begin()) - 1;
}

std::size_t LatticeRegion::size() const
{
    std::size_t count = 0;
    for (const RowInterval& i : intervals_) {
        count += i.size();
    }
    return count;
}

std::vector<Site> LatticeRegion::sites() const
{
    std::vector<Site> sites;
    sites.reserve(size());
    for (const RowInterval& i : intervals_) {
        for (std::int32_t column = i.begin; column < i.end; ++column) {
            sites.push_back({i.row, column});
        }
    }
    return sites;
}

LatticeRegion common(const LatticeRegion& a, const LatticeRegion& b)
{
    std::vector<RowInterval> result;
    auto i = a.intervals().begin();
    auto j = b.intervals().begin();
    while (i != a.intervals().end() && j != b.intervals().end()) {
        if (i->row == j->row && std::max(i->begin, j->begin) < std::min(i->end, j->end)) {
            result.push_back({i->row, std::max(i->begin, j->begin), std::min(i->end, j->end)});
        }
        (std::tie(i->row, i->end) < std::tie(j->row, j->end) ? i : j)++;
    }
    return LatticeRegion(std::move(result));
}

LatticeRegion without(const LatticeRegion& region, const LatticeRegion& removed)
{
    std::vector<RowInterval> result;
    auto cut = removed.intervals().begin();
    const auto end = removed.intervals().end();
    for (RowInterval i : region.intervals()) {
        while (cut != end && std::tie(cut->row, cut->end) <= std::tie(i.row, i.begin)) {
            ++cut;
        }
        // The last cut may reach into the next interval, so it is not consumed here.
        for (auto c = cut; c != end && std::tie(c->row, c->begin) < std::tie(i.row, i.end); ++c) {
            result.push_back({i.row, i.begin, c->begin});
            i.begin = std::max(i.begin, c->end);
        }
        result.push_back(i);
    }
    return LatticeRegion(std::move(result));
}

LatticeRegion moved(const LatticeRegion& region, LatticeStep step)
{
    std::vector<RowInterval> result;
    result.reserve(region.intervals().size());
    for (const RowInterval& i : region.intervals()) {
        const Site first = neighbour(i.first(), step);
        result.push_back({first.row, first.column, first.column + (i.end - i.begin)});
    }
    return LatticeRegion(std::move(result));
}

LatticeRegion eroded(const LatticeRegion& region)
{
    LatticeRegion result = region;
    for (const LatticeStep step : kLatticeSteps) {
        result = common(result, moved(region, step));
    }
    return result;
}

LatticeRegion everySecond(const LatticeRegion& region)
{
    std::vector<RowInterval> result;
    for (const RowInterval& i : region.intervals()) {
        if (i.row % 2 == 0) {
            const std::int32_t row = i.row / 2;
            const std::int32_t origin = toFiner({row, 0}).column;
            result.push_back({row, ceilHalf(i.begin - origin), ceilHalf(i.end - origin)});
        }
    }
    return LatticeRegion(std::move(result));
}

LatticeRegion pointsInside(const std::vector<std::vector<Vec2>>& polygons, double edge, double clearance)
{
    const double height = 0.5 * std::numbers::sqrt3 * edge;
    Span tall;
    for (const Vec2 p : polygons.front()) {
        tall.add(p.y);
    }
    const std::int32_t first = whole(std::ceil(tall.low / height));
    const std::int32_t end = whole(std::floor(tall.high / height)) + 1;
    if (end <= first) {
        return {};
    }
    const auto shift = [](std::int32_t row) { return row % 2 == 0 ? 0.0 : 0.5; };
    std::vector<std::vector<double>> crossings(static_cast<std::size_t>(end - first));
    std::vector<RowInterval> near;
    for (const std::vector<Vec2>& polygon : polygons) {
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const Vec2 a = polygon[i];
            const Vec2 b = polygon[i + 1 < polygon.size() ? i + 1 : 0];
            const auto [low, high] = std::minmax(a.y, b.y);
            const std::int32_t from = std::max(first, whole(std::ceil((low - clearance) / height)));
            const std::int32_t to = std::min(end, whole(std::floor((high + clearance) / height)) + 1);
            for (std::int32_t row = from; row < to; ++row) {
                const double y = static_cast<double>(row) * height;
                // Half-open, so that a vertex on a row counts once
                if (low <= y && y < high) {
                    crossings[static_cast<std::size_t>(row - first)].push_back(a.x +
                                                                               (y - a.y) / (b.y - a.y) * (b.x - a.x));
                }
                const Span span = nearPiece(a, b, clearance, y);
                if (span.low < span.high) {
                    near.push_back({row, whole(std::floor(span.low / edge - shift(row))) + 1,
                                    whole(std::ceil(span.high / edge - shift(row)))});
                }
            }
        }
    }
    std::vector<RowInterval> inside;
    for (std::int32_t row = first; row < end; ++row) {
        std::vector<double>& xs = crossings[static_cast<std::size_t>(row - first)];
        std::sort(xs.begin(), xs.end());
        for (std::size_t i = 0; i + 1 < xs.size(); i += 2) {
            inside.push_back({row, whole(std::ceil(xs[i] / edge - shift(row))),
                              whole(std::floor(xs[i + 1] / edge - shift(row))) + 1});
        }
    }
    return without(LatticeRegion(std::move(inside)), LatticeRegion(std::move(near)));
}

}  // namespace droplet
