// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/windshield/mist.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "droplet/compensated_sum.h"
#include "windshield/mist_cells.h"
#include "windshield/segment.h"

namespace droplet {

double Mist::volume() const
{
    CompensatedSum sum;
    for (const float height : thickness) {
        sum.add(height);
    }
    return sum.value() * cell * cell;
}

double growMist(Mist& mist, Vec2 size, double growth)
{
    if (mist.thickness.empty()) {
        const Cells cells = Cells::over(size, kMistCell);
        mist = {kMistCell, cells.columns, cells.rows, std::vector<float>(cells.count())};
    }
    double added = 0.0;
    const auto more = static_cast<float>(growth);
    constexpr auto kMost = static_cast<float>(kDenseMist);
    for (float& height : mist.thickness) {
        const float before = std::exchange(height, std::min(height + more, kMost));
        added += static_cast<double>(height) - static_cast<double>(before);
    }
    return added * mist.cell * mist.cell;
}

double takeMist(Mist& mist, const MistStroke& stroke)
{
    if (mist.thickness.empty()) {
        return 0.0;
    }
    const Cells cells{mist.cell, mist.columns, mist.rows};
    const Segment middle(stroke.from, stroke.to);
    double taken = 0.0;
    // The share of a cell inside the stroke is that of a straight edge along its distance from the middle.
    const double margin = 0.5 * mist.cell;
    cells.visitAround(stroke.from, stroke.to, stroke.reach + margin, [&](std::size_t first, std::size_t last) {
        const std::size_t row = first / mist.columns;
        const double up = (static_cast<double>(row) + 0.5) * mist.cell;
        for (std::size_t k = first; k <= last; ++k) {
            float& height = mist.thickness[k];
            if (height == 0.0F) {
                continue;
            }
            const double across = (static_cast<double>(k % mist.columns) + 0.5) * mist.cell;
            const double away = std::sqrt(middle.squaredDistance({across, up}));
            const double outside = std::clamp((away - stroke.reach + margin) / mist.cell, 0.0, 1.0);
            const auto left = static_cast<float>(outside * height);
            taken += static_cast<double>(std::exchange(height, left)) - static_cast<double>(left);
        }
    });
    return taken * mist.cell * mist.cell;
}

double takeMist(Mist& mist, const Sweep& blade)
{
    if (mist.thickness.empty()) {
        return 0.0;
    }
    double taken = 0.0;
    blade.visitCells({mist.cell, mist.columns, mist.rows}, [&](std::size_t first, std::size_t last) {
        const std::size_t row = first / mist.columns;
        const double up = (static_cast<double>(row) + 0.5) * mist.cell;
        for (std::size_t k = first; k <= last; ++k) {
            if (blade.covers({(static_cast<double>(k % mist.columns) + 0.5) * mist.cell, up})) {
                taken += static_cast<double>(std::exchange(mist.thickness[k], 0.0F));
            }
        }
    });
    return taken * mist.cell * mist.cell;
}

}  // namespace droplet
