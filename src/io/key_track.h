// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "droplet/vector.h"
#include "file_bytes.h"
#include "rotation.h"

namespace droplet {

/// Key track of one property. Khronos Group, "glTF 2.0 Specification" (2021), appendix C.
struct KeyTrack {
    using Value = std::array<double, 4>;
    enum class Interpolation { Linear, Step, CubicSpline };

    Interpolation interpolation = Interpolation::Linear;
    bool turns = false;         ///< values are quaternions
    std::vector<double> times;  ///< ascending
    std::vector<Value> values;  ///< with CubicSpline, three for each time: tangent before, value, tangent after

    /// Value at a time; at a jump, the one before or after it.
    [[nodiscard]] Value at(double time, bool after) const
    {
        const auto next = after ? std::upper_bound(times.begin(), times.end(), time)
                                : std::lower_bound(times.begin(), times.end(), time);
        const bool is_cubic = interpolation == Interpolation::CubicSpline;
        const auto key = [&](std::size_t i) { return is_cubic ? values[3 * i + 1] : values[i]; };
        if (next == times.begin() || next == times.end()) {
            return key(next == times.begin() ? 0 : times.size() - 1);
        }
        const auto i = static_cast<std::size_t>(next - times.begin()) - 1;
        const double span = times[i + 1] - times[i];
        const double t = (time - times[i]) / span;
        if (interpolation == Interpolation::Step) {
            return key(i);
        }
        if (!is_cubic && turns) {
            const Rotation from = turnOf(key(i));
            const Rotation turn = rotationBy(t * vectorOf(turnOf(key(i + 1)) * from.inverse())) * from;
            return {turn.axis.x, turn.axis.y, turn.axis.z, turn.real};
        }
        Value value{};
        for (std::size_t k = 0; k < value.size(); ++k) {
            const double a = key(i)[k];
            const double b = key(i + 1)[k];
            value[k] = a + t * (b - a);
            if (is_cubic) {
                value[k] = (1 + 2 * t) * (1 - t) * (1 - t) * a + t * (1 - t) * (1 - t) * span * values[3 * i + 2][k] +
                           t * t * (3 - 2 * t) * b - t * t * (1 - t) * span * values[3 * i + 3][k];
            }
        }
        return value;
    }

    static Rotation turnOf(const Value& value)
    {
        const Vec3 axis{value[0], value[1], value[2]};
        const double size = std::hypot(length(axis), value[3]);
        if (!(size > 0.0) || !std::isfinite(size)) {
            throw Damage("the rotation of an animation is not a quaternion");
        }
        return {(1.0 / size) * axis, value[3] / size};
    }
};

}  // namespace droplet
