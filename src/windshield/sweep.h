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

/// Area that a wiper blade passes over between two times.
class Sweep {
public:
    /// @return  empty if the blade rests all the time
    static std::optional<Sweep> of(const Wiper& wiper, double from, double to);

    /// Whether the blade passes over a position.
    [[nodiscard]] bool covers(Vec2 p) const;
    /// Whether the blade meets a droplet that moves straight from a to b in that time: it covers the end, or the two
    /// pass each other.
    [[nodiscard]] bool meets(Vec2 a, Vec2 b) const;
    /// Calls visit(first, last) for every row with the range of cells that the blade may pass over.
    template <class Visit>
    void visitCells(const Cells& cells, const Visit& visit) const;

private:
    [[nodiscard]] bool inReach(Vec2 p) const;
    [[nodiscard]] double angleOf(Vec2 p) const;
    /// Corners of a polygon that contains the area.
    [[nodiscard]] std::vector<Vec2> hull() const;

    Vec2 pivot_;
    double inner_ = 0.0;
    double outer_ = 0.0;
    double begin_ = 0.0;  // angle at the beginning
    double end_ = 0.0;    // angle at the end
    double min_ = 0.0;    // smallest angle in between
    double max_ = 0.0;    // largest angle in between
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
