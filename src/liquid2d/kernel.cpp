// SPDX-License-Identifier: GPL-3.0-or-later
#include "kernel.h"

#include <cmath>

namespace droplet {

double latticeStep(double spacing)
{
    return spacing * std::sqrt(2.0 / std::sqrt(3.0));
}

double Kernel::latticeSum(double spacing) const
{
    const double step = latticeStep(spacing);
    double sum = 0.0;
    constexpr int kReach = 3;
    for (int row = -kReach; row <= kReach; ++row) {
        for (int column = -kReach; column <= kReach; ++column) {
            const double x = step * (column + 0.5 * row);
            const double y = step * 0.5 * std::sqrt(3.0) * row;
            sum += (*this)(std::hypot(x, y));
        }
    }
    return sum;
}

}  // namespace droplet
