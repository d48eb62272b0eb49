// SPDX-License-Identifier: GPL-3.0-or-later
// P. Fournier, A. Habibi, P. Poulin, "Simulating the flow of liquid droplets", Graphics Interface 1998, section 2.2.
// The paper lets the constant force include friction; it may not, as friction is the exponential.
#include "droplet/flow/leg.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "flow/leg_means.h"

namespace droplet {
namespace {

/// ln(1 + x)/x, whose value at 0 is 1.
double logMean(double x)
{
    return x == 0.0 ? 1.0 : std::log1p(x) / x;
}

/// When place + velocity t + acceleration t²/2 falls to 0 [s]; no number if it does not.
double firstGuess(double place, double velocity, double acceleration)
{
    return 2.0 * place / (std::sqrt(velocity * velocity - 2.0 * acceleration * place) - velocity);
}

/// Coordinate::fallsBelowZero.
/// @param at_to  legMeans(c.decay · to); null if `to` is not finite
std::optional<double> root(const Coordinate& c, double from, double to, const LegMeans* at_to)
{
    // Times e^{decay t} the velocity is monotone: there is at most one extremum.
    double begin = from;
    std::optional<double> lowest;
    const double speed = from == 0.0 ? c.velocity : c.velocityAt(from);  // the same number, sooner
    if (speed > 0.0 || (speed == 0.0 && c.push >= 0.0)) {
        if (c.push >= 0.0) {
            return std::nullopt;
        }
        begin = std::max(from, c.turns().value_or(from));
    } else if (c.push > 0.0) {
        lowest = std::max(from, c.turns().value_or(from));
    } else if (c.push == 0.0 && c.decay > 0.0 && c.place + c.velocity / c.decay >= 0.0) {
        return std::nullopt;  // it stops before
    }
    if (!(begin < to)) {
        return std::nullopt;
    }
    double low = begin == 0.0 ? c.place : c.placeAt(begin);
    if (low <= 0.0) {
        return !lowest || begin < *lowest ? std::optional(begin) : std::nullopt;
    }
    // From begin on it falls, up to its lowest place. The bracket does not depend on `to`, so that the root does not.
    double end = std::numeric_limits<double>::infinity();
    if (lowest) {
        end = *lowest;
        if (!(c.placeAt(end) < 0.0)) {
            return std::nullopt;
        }
    }
    if (at_to != nullptr && to < end && placeAfter(c, to, *at_to) >= 0.0) {
        return std::nullopt;
    }
    // Newton's method inside of a bracket, on a monotone piece; first, the root without the change of the friction.
    double slope = begin == from ? speed : c.velocityAt(begin);
    double time = begin + firstGuess(low, slope, c.push - c.decay * slope);
    if (!(time > begin && time < end)) {
        time = std::isfinite(end) ? begin + 0.5 * (end - begin)
                                  : begin + (speed < 0.0 ? -low / speed : std::sqrt(-2.0 * low / c.push));
    }
    for (int i = 0; i < 100; ++i) {
        const LegMeans mean = legMeans(c.decay * time);
        low = placeAfter(c, time, mean);
        slope = velocityAfter(c, time, mean);
        if (low == 0.0) {
            break;
        }
        (low < 0.0 ? end : begin) = time;
        const double change = slope < 0.0 ? -low / slope : -std::numeric_limits<double>::infinity();
        const double next = time + change;
        if (next > begin && next < end) {
            time = next;
            // What the next step would change at most.
            const double bend = std::abs(c.push - c.decay * slope);
            if (std::abs(change) <= 4e-16 * time || bend * change * change <= -2e-17 * time * slope) {
                break;
            }
        } else if (!std::isfinite(end)) {
            time *= 2.0;
            if (!std::isfinite(time)) {
                return std::nullopt;
            }
        } else {
            if (end - begin <= 4e-16 * end) {
                break;
            }
            time = begin + 0.5 * (end - begin);
        }
    }
    return time <= to ? std::optional(time) : std::nullopt;
}

}  // namespace

Vec3 Leg::placeAt(double time) const
{
    const double t = time - begin;
    return placeAfter(*this, t, legMeans(decay * t));
}

Vec3 Leg::velocityAt(double time) const
{
    const double t = time - begin;
    return velocityAfter(*this, t, legMeans(decay * t));
}

double Coordinate::placeAt(double time) const
{
    return placeAfter(*this, time, legMeans(decay * time));
}

double Coordinate::velocityAt(double time) const
{
    return velocityAfter(*this, time, legMeans(decay * time));
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
    if (!std::isfinite(to)) {
        return root(*this, from, to, nullptr);
    }
    const LegMeans at_to = legMeans(decay * to);
    return root(*this, from, to, &at_to);
}

std::optional<double> firstBelowZero(const Coordinate& c, double to, const LegMeans& at_to)
{
    return root(c, 0.0, to, &at_to);
}

}  // namespace droplet
