// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/lattice_region.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

namespace droplet {
namespace {

/// An interval of x, open or closed as its user says.
struct Span {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;

    void add(double x)
    {
        low = std::min(low, x);
        high = std::max(high, x);
    }
};

/// Where the line at height y runs through what is nearer to the piece ab than `reach`: a capsule, so one span.
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

std::int32_t column(double x)
{
    return static_cast<std::int32_t>(x);
}

}  // namespace

const LatticeRegion::Row& LatticeRegion::row(std::int32_t row) const
{
    static const Row empty;
    return row < first_row_ || row >= endRow() ? empty : rows_[static_cast<std::size_t>(row - first_row_)];
}

bool LatticeRegion::contains(std::int32_t row, std::int32_t column) const
{
    const Row& intervals = this->row(row);
    const auto after = std::upper_bound(intervals.begin(), intervals.end(), column,
                                        [](std::int32_t c, const ColumnInterval& i) { return c < i.begin; });
    return after != intervals.begin() && column < std::prev(after)->end;
}

std::size_t LatticeRegion::size() const
{
    std::size_t count = 0;
    for (const Row& row : rows_) {
        for (const ColumnInterval& i : row) {
            count += static_cast<std::size_t>(i.end - i.begin);
        }
    }
    return count;
}

LatticeRegion pointsInside(const std::vector<std::vector<Vec2>>& polygons, double edge, double clearance)
{
    const double height = 0.5 * std::numbers::sqrt3 * edge;
    Span tall;
    for (const Vec2 p : polygons.front()) {
        tall.add(p.y);
    }
    const std::int32_t first = column(std::ceil(tall.low / height));
    const std::int32_t end = column(std::floor(tall.high / height)) + 1;
    if (end <= first) {
        return {};
    }
    const auto count = static_cast<std::size_t>(end - first);
    std::vector<std::vector<double>> crossings(count);
    std::vector<LatticeRegion::Row> near(count);
    for (const std::vector<Vec2>& polygon : polygons) {
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const Vec2 a = polygon[i];
            const Vec2 b = polygon[i + 1 < polygon.size() ? i + 1 : 0];
            const auto [low, high] = std::minmax(a.y, b.y);
            const std::int32_t from = std::max(first, column(std::ceil((low - clearance) / height)));
            const std::int32_t to = std::min(end, column(std::floor((high + clearance) / height)) + 1);
            for (std::int32_t row = from; row < to; ++row) {
                const auto k = static_cast<std::size_t>(row - first);
                const double y = static_cast<double>(row) * height;
                // Half-open, so that a vertex on a row counts once.
                if (low <= y && y < high) {
                    crossings[k].push_back(a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x));
                }
                const Span span = nearPiece(a, b, clearance, y);
                const double shift = row % 2 == 0 ? 0.0 : 0.5;
                const ColumnInterval interval{column(std::floor(span.low / edge - shift)) + 1,
                                              column(std::ceil(span.high / edge - shift))};
                if (span.low < span.high && interval.begin < interval.end) {
                    near[k].push_back(interval);
                }
            }
        }
    }
    std::vector<LatticeRegion::Row> rows(count);
    for (std::size_t k = 0; k < count; ++k) {
        std::sort(crossings[k].begin(), crossings[k].end());
        const double shift = (first + static_cast<std::int32_t>(k)) % 2 == 0 ? 0.0 : 0.5;
        LatticeRegion::Row inside;
        for (std::size_t i = 0; i + 1 < crossings[k].size(); i += 2) {
            const ColumnInterval interval{column(std::ceil(crossings[k][i] / edge - shift)),
                                          column(std::floor(crossings[k][i + 1] / edge - shift)) + 1};
            if (interval.begin < interval.end) {
                inside.push_back(interval);
            }
        }
        rows[k] = minus(united(std::move(inside)), united(std::move(near[k])));
    }
    return {first, std::move(rows)};
}

LatticeRegion eroded(const LatticeRegion& region)
{
    std::vector<LatticeRegion::Row> rows;
    for (std::int32_t r = region.firstRow(); r < region.endRow(); ++r) {
        // The point at c has its neighbours at c + left and c + left + 1 in the rows above and below.
        const LatticeRegion::Row own = shifted(region.row(r), 1, 2);
        const LatticeRegion::Row below = shifted(region.row(r - 1), -leftOf(r), 1);
        const LatticeRegion::Row above = shifted(region.row(r + 1), -leftOf(r), 1);
        rows.push_back(common(own, common(below, above)));
    }
    return {region.firstRow(), std::move(rows)};
}

LatticeRegion::Row minus(const LatticeRegion::Row& row, const LatticeRegion::Row& removed)
{
    LatticeRegion::Row result;
    auto cut = removed.begin();
    for (ColumnInterval i : row) {
        while (cut != removed.end() && cut->end <= i.begin) {
            ++cut;
        }
        // The last cut may reach into the next interval, so it is only looked at.
        for (auto c = cut; c != removed.end() && c->begin < i.end; ++c) {
            if (i.begin < c->begin) {
                result.push_back({i.begin, c->begin});
            }
            i.begin = std::max(i.begin, c->end);
        }
        if (i.begin < i.end) {
            result.push_back(i);
        }
    }
    return result;
}

LatticeRegion::Row common(const LatticeRegion::Row& a, const LatticeRegion::Row& b)
{
    LatticeRegion::Row result;
    auto i = a.begin();
    auto j = b.begin();
    while (i != a.end() && j != b.end()) {
        const ColumnInterval both{std::max(i->begin, j->begin), std::min(i->end, j->end)};
        if (both.begin < both.end) {
            result.push_back(both);
        }
        (i->end < j->end ? i : j)++;
    }
    return result;
}

LatticeRegion::Row united(LatticeRegion::Row row)
{
    std::sort(row.begin(), row.end(),
              [](const ColumnInterval& a, const ColumnInterval& b) { return a.begin < b.begin; });
    std::size_t last = 0;
    for (std::size_t i = 1; i < row.size(); ++i) {
        if (row[i].begin <= row[last].end) {
            row[last].end = std::max(row[last].end, row[i].end);
        } else {
            row[++last] = row[i];
        }
    }
    row.resize(std::min(row.size(), last + 1));
    return row;
}

LatticeRegion::Row shifted(const LatticeRegion::Row& row, std::int32_t by, std::int32_t shorter)
{
    LatticeRegion::Row result;
    for (const ColumnInterval& i : row) {
        if (i.end - i.begin > shorter) {
            result.push_back({i.begin + by, i.end + by - shorter});
        }
    }
    return result;
}

}  // namespace droplet
