// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "droplet/vector.h"

namespace droplet {

/// Grid of square cells over the unrolled glass, from its lower left corner.
struct Cells {
    double width = 0.0;  ///< [m]
    std::uint32_t columns = 0;
    std::uint32_t rows = 0;
    double per_metre = 1.0 / width;

    static Cells over(Vec2 size, double width)
    {
        const auto across = [width](double length) {
            return static_cast<std::uint32_t>(std::max(1.0, std::ceil(length / width)));
        };
        return {width, across(size.x), across(size.y)};
    }

    [[nodiscard]] std::size_t count() const { return std::size_t{columns} * rows; }
    /// Column of a position; beyond the edge, the last one there.
    [[nodiscard]] std::uint32_t column(double x) const { return index(x, columns); }
    [[nodiscard]] std::uint32_t row(double y) const { return index(y, rows); }
    [[nodiscard]] std::size_t number(Vec2 p) const { return std::size_t{row(p.y)} * columns + column(p.x); }

    /// Calls visit(first, last) for every row with the range of cells that are within `radius` of the segment from a to
    /// b; includes a few more.
    template <class Visit>
    void visitAround(Vec2 a, Vec2 b, double radius, const Visit& visit) const
    {
        const double low = std::min(a.y, b.y) - radius;
        const double high = std::max(a.y, b.y) + radius;
        const double leftmost = std::min(a.x, b.x) - radius;
        const double rightmost = std::max(a.x, b.x) + radius;
        if (high < 0.0 || low > static_cast<double>(rows) * width || rightmost < 0.0 ||
            leftmost > static_cast<double>(columns) * width) {
            return;
        }
        const Vec2 along = b - a;
        const std::uint32_t top = row(high);
        if (std::abs(along.x) <= width) {
            // A short segment crosses few cells; its rows differ too little to be told apart.
            const std::uint32_t first = column(leftmost);
            const std::uint32_t last = column(rightmost);
            for (std::uint32_t r = row(low); r <= top; ++r) {
                const std::size_t start = std::size_t{r} * columns;
                visit(start + first, start + last);
            }
            return;
        }
        const double per_y = along.y != 0.0 ? 1.0 / along.y : 0.0;
        for (std::uint32_t r = row(low); r <= top; ++r) {
            double from = 0.0;
            double to = 1.0;
            if (along.y != 0.0) {
                const double enters = (static_cast<double>(r) * width - radius - a.y) * per_y;
                const double leaves = (static_cast<double>(r + 1) * width + radius - a.y) * per_y;
                from = std::clamp(std::min(enters, leaves), 0.0, 1.0);
                to = std::clamp(std::max(enters, leaves), 0.0, 1.0);
            }
            const double x0 = a.x + from * along.x;
            const double x1 = a.x + to * along.x;
            const double left = std::min(x0, x1) - radius;
            const double right = std::max(x0, x1) + radius;
            if (right >= 0.0 && left <= static_cast<double>(columns) * width) {
                const std::size_t start = std::size_t{r} * columns;
                visit(start + column(left), start + column(right));
            }
        }
    }

private:
    [[nodiscard]] std::uint32_t index(double v, std::uint32_t count) const
    {
        return static_cast<std::uint32_t>(std::clamp(v * per_metre, 0.0, static_cast<double>(count - 1)));
    }
};

}  // namespace droplet
