// SPDX-License-Identifier: GPL-3.0-or-later
#include "render/triangle_grid.h"

#include <algorithm>

namespace droplet {

std::size_t gridValues(std::size_t divisions)
{
    return divisions == 0 ? 0 : (divisions + 1) * (divisions + 2) / 2;
}

GridValue onGrid(const float* values, int divisions, const Meeting& meeting)
{
    const int n = divisions;
    const float u = std::clamp(meeting.u, 0.0F, 1.0F) * static_cast<float>(n);
    const float v = std::clamp(meeting.v, 0.0F, 1.0F) * static_cast<float>(n);
    const int j = std::min(static_cast<int>(v), n - 1);
    const int i = std::clamp(static_cast<int>(u), 0, n - 1 - j);
    const auto value = [&](int column, int row) { return values[row * (n + 1) - row * (row - 1) / 2 + column]; };
    const float fu = u - static_cast<float>(i);
    const float fv = v - static_cast<float>(j);
    // A cell is cut into two triangles; the grid's last cells have one.
    GridValue grid;
    if (fu + fv <= 1.0F || i + j + 2 > n) {
        grid.along_u = value(i + 1, j) - value(i, j);
        grid.along_v = value(i, j + 1) - value(i, j);
        grid.here = value(i, j) + fu * grid.along_u + fv * grid.along_v;
    } else {
        grid.along_u = value(i + 1, j + 1) - value(i, j + 1);
        grid.along_v = value(i + 1, j + 1) - value(i + 1, j);
        grid.here = value(i + 1, j + 1) - (1.0F - fu) * grid.along_u - (1.0F - fv) * grid.along_v;
    }
    return grid;
}

}  // namespace droplet
