// SPDX-License-Identifier: GPL-3.0-or-later
//
// Number n of pieces, in equal steps of the parameter, that are no farther than ε from a Bézier curve of degree d:
// n² = d(d−1)/8 · max|P_{i+2} − 2P_{i+1} + P_i| / ε, G. Wang, "The subdivision method for finding the intersection
// between two Bézier curves or surfaces" (1984).

#include "type/flatten.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>

namespace droplet {
namespace {

constexpr double kTurn = 10.0 * std::numbers::pi / 180.0;

double turned(Vec2 from, Vec2 to)
{
    return std::abs(std::atan2(cross(from, to), dot(from, to)));
}

std::size_t pieces(std::span<const Vec2> control, const Flatness& flatness)
{
    double along = 0.0;
    double bend = 0.0;
    double turn = 0.0;
    for (std::size_t i = 0; i + 1 < control.size(); ++i) {
        along += length(control[i + 1] - control[i]);
    }
    for (std::size_t i = 0; i + 2 < control.size(); ++i) {
        const Vec2 before = control[i + 1] - control[i];
        const Vec2 after = control[i + 2] - control[i + 1];
        bend = std::max(bend, length(after - before));
        turn += turned(before, after);
    }
    const auto degree = static_cast<double>(control.size() - 1);
    const double count = std::max({std::sqrt(degree * (degree - 1.0) / 8.0 * bend / flatness.tolerance),
                                   along / flatness.spacing, turn / kTurn, 1.0});
    return static_cast<std::size_t>(std::ceil(count));
}

/// Point at parameter t, by de Casteljau's algorithm.
template <std::size_t kCount>
Vec2 at(std::array<Vec2, kCount> control, double t)
{
    for (std::size_t last = kCount - 1; last > 0; --last) {
        for (std::size_t i = 0; i < last; ++i) {
            control[i] = (1.0 - t) * control[i] + t * control[i + 1];
        }
    }
    return control[0];
}

template <std::size_t kCount>
void add(Contour& contour, const std::array<Vec2, kCount>& control, const Flatness& flatness)
{
    const std::size_t count = pieces(control, flatness);
    for (std::size_t i = 1; i < count; ++i) {
        contour.push_back(at(control, static_cast<double>(i) / static_cast<double>(count)));
    }
    contour.push_back(control.back());
}

}  // namespace

void addConic(Contour& contour, Vec2 control, Vec2 end, const Flatness& flatness)
{
    add(contour, std::array<Vec2, 3>{contour.back(), control, end}, flatness);
}

void addCubic(Contour& contour, Vec2 first, Vec2 second, Vec2 end, const Flatness& flatness)
{
    add(contour, std::array<Vec2, 4>{contour.back(), first, second, end}, flatness);
}

}  // namespace droplet
