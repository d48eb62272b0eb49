// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "droplet/flow/leg.h"

namespace droplet {

/// The decay and its means over the time since the begin; x is decay times that time. All coordinates of a leg share
/// them.
struct LegMeans {
    double decayed = 1.0;  ///< e^−x
    double first = 1.0;    ///< (1 − e^−x)/x, whose value at 0 is 1
    double second = 0.5;   ///< (x − 1 + e^−x)/x², whose value at 0 is 1/2
};

inline LegMeans legMeans(double x)
{
    // Below, the series' first term left out, x¹²/14!, is less than rounding.
    constexpr double kSeriesUntil = 0.25;
    constexpr std::array<double, 12> kSeries = [] {
        std::array<double, 12> terms{};
        double factorial = 1.0;
        for (std::size_t n = 0; n < terms.size(); ++n) {
            factorial *= static_cast<double>(n + 2);
            terms[n] = 1.0 / factorial;
        }
        return terms;
    }();
    if (x == 0.0) {
        return {};
    }
    if (x >= kSeriesUntil) {
        const double rest = std::expm1(-x);
        const double first = -rest / x;
        return {1.0 + rest, first, (1.0 - first) / x};
    }
    // Σ (−x)^n / (n + 2)!, as the difference would lose digits.
    double second = kSeries.back();
    for (std::size_t n = kSeries.size() - 1; n > 0; --n) {
        second = kSeries[n - 1] - x * second;
    }
    const double first = 1.0 - x * second;
    return {1.0 - x * first, first, second};
}

/// Leg::placeAt and Leg::velocityAt.
/// @param t     time since the begin [s]
/// @param mean  legMeans(leg.decay · t)
inline Vec3 placeAfter(const Leg& leg, double t, const LegMeans& mean)
{
    return leg.place + (t * mean.first) * leg.velocity + (t * t * mean.second) * leg.push;  // p(τ)
}
inline Vec3 velocityAfter(const Leg& leg, double t, const LegMeans& mean)
{
    return mean.decayed * leg.velocity + (t * mean.first) * leg.push;  // v(τ)
}

/// Coordinate::placeAt and Coordinate::velocityAt.
/// @param mean  legMeans(c.decay · t)
inline double placeAfter(const Coordinate& c, double t, const LegMeans& mean)
{
    return c.place + t * (mean.first * c.velocity + t * mean.second * c.push);
}
inline double velocityAfter(const Coordinate& c, double t, const LegMeans& mean)
{
    return mean.decayed * c.velocity + t * mean.first * c.push;
}

/// Coordinate::fallsBelowZero from time 0 on.
/// @param to     [s], finite
/// @param at_to  legMeans(c.decay · to)
std::optional<double> firstBelowZero(const Coordinate& c, double to, const LegMeans& at_to);

}  // namespace droplet
