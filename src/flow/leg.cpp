// SPDX-License-Identifier: GPL-3.0-or-later
// P. Fournier, A. Habibi, P. Poulin, "Simulating the flow of liquid droplets", Graphics Interface 1998, section 2.2.
// The paper lets the constant force include friction; it may not, as friction is the exponential.
#include "droplet/flow/leg.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace droplet {
namespace {

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

/// The decay and its means over the time since the begin.
struct Means {
    double decayed = 1.0;  ///< e^−x
    double first = 1.0;    ///< (1 − e^−x)/x, whose value at 0 is 1
    double second = 0.5;   ///< (x − 1 + e^−x)/x², whose value at 0 is 1/2
};

Means meansOf(double x)
{
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

/// ln(1 + x)/x, whose value at 0 is 1.
double logMean(double x)
{
    return x == 0.0 ? 1.0 : std::log1p(x) / x;
}

}  // namespace

Vec3 Leg::placeAt(double time) const
{
    const double t = time - begin;
    const Means mean = meansOf(decay * t);
    return place + (t * mean.first) * velocity + (t * t * mean.second) * push;  // p(τ)
}

Vec3 Leg::velocityAt(double time) const
{
    const double t = time - begin;
    const Means mean = meansOf(decay * t);
    return mean.decayed * velocity + (t * mean.first) * push;  // v(τ)
}

double Coordinate::placeAt(double time) const
{
    const Means mean = meansOf(decay * time);
    return place + time * (mean.first * velocity + time * mean.second * push);
}

double Coordinate::velocityAt(double time) const
{
    const Means mean = meansOf(decay * time);
    return mean.decayed * velocity + time * mean.first * push;
}

std::optional<double> Coordinate::turns() const
{
    if (velocity * push >= 0.0) {
        return std::nullopt;
    }
    return -(velocity / push) * logMean(-velocity * decay / push);
}

std::optional<double> Coordinate::fallsBelowZero(double from, double to) const
{
    // Times e^{decay t} the velocity is monotone: there is at most one extremum.
    double begin = from;
    std::optional<double> lowest;
    const double speed = from == 0.0 ? velocity : velocityAt(from);  // the same number, sooner
    if (speed > 0.0 || (speed == 0.0 && push >= 0.0)) {
        if (push >= 0.0) {
            return std::nullopt;
        }
        begin = std::max(from, turns().value_or(from));
    } else if (push > 0.0) {
        lowest = std::max(from, turns().value_or(from));
    } else if (push == 0.0 && decay > 0.0 && place + velocity / decay >= 0.0) {
        return std::nullopt;  // it stops before
    }
    if (!(begin < to)) {
        return std::nullopt;
    }
    double low = begin == 0.0 ? place : placeAt(begin);
    if (low <= 0.0) {
        return !lowest || begin < *lowest ? std::optional(begin) : std::nullopt;
    }
    // From begin on it falls, up to its lowest place.
    if (std::isfinite(to) && placeAt(lowest ? std::min(*lowest, to) : to) >= 0.0) {
        return std::nullopt;
    }
    // The bracket does not depend on `to`, so that the root does not.
    double end = 0.0;
    if (lowest) {
        end = *lowest;
        if (!(placeAt(end) < 0.0)) {
            return std::nullopt;
        }
    } else {
        double step = speed < 0.0 ? -low / speed : std::sqrt(-2.0 * low / push);
        for (end = begin + step; placeAt(end) >= 0.0; end = begin + step) {
            if (end > to || !(end < std::numeric_limits<double>::max())) {
                return std::nullopt;
            }
            step *= 2.0;
        }
    }
    // Newton's method inside of a bracket, on a monotone piece.
    double time = begin;
    double slope = begin == from ? speed : velocityAt(time);
    for (int i = 0; i < 100; ++i) {
        double next = slope < 0.0 ? time - low / slope : begin;
        if (!(next > begin && next < end)) {
            next = begin + 0.5 * (end - begin);
        }
        const double change = std::abs(next - time);
        time = next;
        const Means mean = meansOf(decay * time);
        low = place + time * (mean.first * velocity + time * mean.second * push);
        slope = mean.decayed * velocity + time * mean.first * push;
        if (low == 0.0 || change <= 4e-16 * time) {
            break;
        }
        (low < 0.0 ? end : begin) = time;
    }
    return time <= to ? std::optional(time) : std::nullopt;
}

}  // namespace droplet
