// SPDX-License-Identifier: GPL-3.0-or-later
// P. Fournier, A. Habibi, P. Poulin, "Simulating the flow of liquid droplets", Graphics Interface 1998, section 2.2.
// The paper lets the constant force include friction; it may not, as friction is the exponential.
#include "droplet/flow/leg.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace droplet {
namespace {

/// (1 − e^−x)/x, whose value at 0 is 1: the mean of e^−x from 0 to x.
double firstMean(double x)
{
    return x == 0.0 ? 1.0 : -std::expm1(-x) / x;
}

/// (x − 1 + e^−x)/x², whose value at 0 is 1/2. Below 1 by its series, as the difference would lose digits.
double secondMean(double x)
{
    if (x >= 1.0) {
        return (1.0 - firstMean(x)) / x;
    }
    double sum = 0.0;
    double term = 0.5;
    for (double k = 3.0; std::abs(term) > 1e-18; k += 1.0) {  // Σ (−x)^n / (n + 2)!
        sum += term;
        term *= -x / k;
    }
    return sum;
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
    const double x = decay * t;
    return place + (t * firstMean(x)) * velocity + (t * t * secondMean(x)) * push;  // p(τ)
}

Vec3 Leg::velocityAt(double time) const
{
    const double t = time - begin;
    const double x = decay * t;
    return std::exp(-x) * velocity + (t * firstMean(x)) * push;  // v(τ)
}

double Coordinate::placeAt(double time) const
{
    const double x = decay * time;
    return place + time * (firstMean(x) * velocity + time * secondMean(x) * push);
}

double Coordinate::velocityAt(double time) const
{
    const double x = decay * time;
    return std::exp(-x) * velocity + time * firstMean(x) * push;
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
    const double speed = velocityAt(from);
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
    double low = placeAt(begin);
    if (low <= 0.0) {
        return !lowest || begin < *lowest ? std::optional(begin) : std::nullopt;
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
    for (int i = 0; i < 100; ++i) {
        const double slope = velocityAt(time);
        double next = slope < 0.0 ? time - low / slope : begin;
        if (!(next > begin && next < end)) {
            next = begin + 0.5 * (end - begin);
        }
        const double change = std::abs(next - time);
        time = next;
        low = placeAt(time);
        if (low == 0.0 || change <= 4e-16 * time) {
            break;
        }
        (low < 0.0 ? end : begin) = time;
    }
    return time <= to ? std::optional(time) : std::nullopt;
}

}  // namespace droplet
