// SPDX-License-Identifier: GPL-3.0-or-later
#include "wind/random_field.h"

#include <array>
#include <cmath>
#include <cstddef>

#include "wind/random.h"

namespace droplet {

double smoothRandom(Vec3 place, std::uint64_t seed)
{
    const std::array<double, 3> at{place.x, place.y, place.z};
    std::array<std::array<std::uint64_t, 2>, 3> keys;
    std::array<double, 3> step;
    constexpr std::array<std::uint64_t, 3> kStrides{0x9E3779B97F4A7C15U, 0xC2B2AE3D27D4EB4FU, 0x165667B19E3779F9U};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double cell = std::floor(at[axis]);
        const double t = at[axis] - cell;
        step[axis] = t * t * (3.0 - 2.0 * t);
        const auto number = static_cast<std::uint64_t>(static_cast<std::int64_t>(cell));
        keys[axis] = {number * kStrides[axis], (number + 1) * kStrides[axis]};
    }
    double sum = 0.0;
    for (std::size_t corner = 0; corner < 8; ++corner) {
        std::uint64_t key = seed;
        double weight = 1.0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::size_t upper = corner >> axis & 1U;
            key += keys[axis][upper];
            weight *= upper == 1 ? step[axis] : 1.0 - step[axis];
        }
        sum += weight * (static_cast<double>(mix(key) >> 11U) * 0x1p-52 - 1.0);
    }
    return sum;
}

}  // namespace droplet
