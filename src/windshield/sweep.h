// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "droplet/vector.h"
#include "droplet/windshield/wipers.h"
#include "windshield/cells.h"

namespace droplet {

/// What a blade passes over between two times.
class Sweep {
public:
    /// @return  empty where it rests all that time
    static std::optional<Sweep> of(const Wiper& wiper, double from, double to);

    [[nodiscard]] bool covers(Vec2 p) const;
    /// Whether it and something that goes straight from a to b in that time meet: it covers the end, or they pass each
    /// other.
    [[nodiscard]] bool meets(Vec2 a, Vec2 b) const;
    /// Calls visit(first, last) with the numbers of the cells of every row that it may cover a part of.
    template <class Visit>
    void visitCells(const Cells& cells, const Visit& visit) const;

private:
    [[nodiscard]] bool inReach(Vec2 p) const;
    [[nodiscard]] double angleOf(Vec2 p) const;
    /// Corners of a polygon that holds all of it.
    [[nodiscard]] std::vector<Vec2> hull() const;

    Vec2 pivot_;
    double inner_ = 0.0;
    double outer_ = 0.0;
    double before_ = 0.0;  // the blade's angle at the beginning
    double after_ = 0.0;   // and the end
    double low_ = 0.0;     // of all its angles in between
    double high_ = 0.0;
};

template <class Visit>
void Sweep::visitCells(const Cells& cells, const Visit& visit) const
{
    const std::vector<Vec2> corners = hull();
    const auto by_y = [](Vec2 a, Vec2 b) { return a.y < b.y; };
    const auto [bottom, top] = std::minmax_element(corners.begin(), corners.end(), by_y);
    if (top->y < 0.0 || bottom->y > static_cast<double>(cells.rows) * cells.width) {
        return;
    }
    const std::uint32_t last_row = cells.row(top->y);
    for (std::uint32_t row = cells.row(bottom->y); row <= last_row; ++row) {
        const double low = static_cast<double>(row) * cells.width;
        const double high = low + cells.width;
        double left = static_cast<double>(cells.columns) * cells.width;
        double right = 0.0;
        for (std::size_t k = 0; k < corners.size(); ++k) {
            Vec2 a = corners[k];
            Vec2 b = corners[(k + 1) % corners.size()];
            if (a.y > b.y) {
                std::swap(a, b);
            }
            if (b.y < low || a.y > high) {
                continue;
            }
            const auto at = [&](double y) {
                return b.y > a.y ? a.x + std::clamp((y - a.y) / (b.y - a.y), 0.0, 1.0) * (b.x - a.x) : a.x;
            };
            const double x0 = at(low);
            const double x1 = b.y > a.y ? at(high) : b.x;
            left = std::min({left, x0, x1});
            right = std::max({right, x0, x1});
        }
        if (left <= right) {
            const std::size_t start = std::size_t{row} * cells.columns;
            visit(start + cells.column(left), start + cells.column(right));
        }
    }
}

}  // namespace droplet
