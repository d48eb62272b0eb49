// SPDX-License-Identifier: GPL-3.0-or-later
// J. S. Marshall, W. M. Palmer, "The distribution of raindrops with size", J. Meteor. 5 (1948) 165: N(D) and Λ(R).
// D. Atlas, R. C. Srivastava, R. S. Sekhon, "Doppler radar characteristics of precipitation at vertical incidence",
// Rev. Geophys. 11 (1973) 1: v(D).
#include "droplet/wind/rain.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "droplet/error.h"
#include "droplet/units.h"
#include "number_text.h"

namespace droplet {
namespace {

// v = kFastest − kSlowed e^(−kFall D), Atlas et al., eq. 8 (there in mm).
constexpr double kFastest = 9.65;  // [m/s]
constexpr double kSlowed = 10.3;   // [m/s]
constexpr double kFall = 600.0;    // [1/m]

/// Diameter with a terminal speed, ≥ 0; infinity if there is none.
double diameterAt(double speed)
{
    return speed < kFastest ? std::log(kSlowed / (kFastest - speed)) / kFall : std::numeric_limits<double>::infinity();
}

/// ∫ e^(−kD) dD.
double integral(double k, double from, double to)
{
    return from < to ? std::exp(-k * from) * -std::expm1(-k * (to - from)) / k : 0.0;
}

/// Raindrops per volume of air: ∫ N dD.
double numberOf(const RaindropSizes& sizes, double from, double to)
{
    return sizes.slope > 0.0 ? sizes.intercept * integral(sizes.slope, from, to) : 0.0;
}
/// Rate at which raindrops fall on a floor: ∫ N v dD.
double fallRateOf(const RaindropSizes& sizes, double from, double to)
{
    from = std::max(from, diameterAt(0.0));
    return sizes.slope > 0.0 ? sizes.intercept * (kFastest * integral(sizes.slope, from, to) -
                                                  kSlowed * integral(sizes.slope + kFall, from, to))
                             : 0.0;
}

/// Share of the water in diameters above x/Λ: e^(−x) Σ xᵏ/k!, k ≤ 3, as D³ N is a gamma density of shape 4.
double waterAbove(double x)
{
    return std::exp(-x) * (1.0 + x * (1.0 + x / 2.0 * (1.0 + x / 3.0)));
}

}  // namespace

double RaindropSizes::density(double diameter) const
{
    return slope > 0.0 ? intercept * std::exp(-slope * diameter) : 0.0;
}

double RaindropSizes::largerThan(double diameter) const
{
    return slope > 0.0 ? intercept / slope * std::exp(-slope * diameter) : 0.0;
}

double RaindropSizes::waterContent() const
{
    return slope > 0.0 ? std::numbers::pi * intercept / std::pow(slope, 4.0) : 0.0;
}

double RaindropSizes::waterShare(double min, double max) const
{
    return slope > 0.0 ? waterAbove(slope * min) - waterAbove(slope * max) : 0.0;
}

RaindropSizes raindropSizes(double rainfall)
{
    if (!(rainfall >= 0.0) || !std::isfinite(rainfall)) {
        throw Error(ErrorCode::InvalidArgument,
                    "rainfall is " + numberText(rainfall / kMillimetrePerHour) + " mm/h; it must be at least 0");
    }
    RaindropSizes sizes;
    if (rainfall > 0.0) {
        sizes.slope = 4.1e3 * std::pow(rainfall / kMillimetrePerHour, -0.21);  // Marshall and Palmer, eq. 3
    }
    return sizes;
}

double terminalSpeed(double diameter)
{
    return std::max(0.0, kFastest - kSlowed * std::exp(-kFall * diameter));  // Atlas et al., eq. 8
}

void RaindropRange::validate() const
{
    if (!(min > 0.0 && max > min && std::isfinite(max))) {
        throw Error(ErrorCode::InvalidArgument, "raindrops.min and raindrops.max are " + numberText(min / kMillimetre) +
                                                    " and " + numberText(max / kMillimetre) +
                                                    " mm; they must be above 0 and ascend");
    }
}

Exposure Exposure::ofSlope(double slope)
{
    return {std::cos(slope), std::sin(slope)};
}

double RainImpacts::density(double diameter, const Exposure& exposure) const
{
    if (diameter < range.min || diameter > range.max) {
        return 0.0;
    }
    return sizes.density(diameter) *
           std::max(0.0, terminalSpeed(diameter) * exposure.upward + speed * exposure.forward);
}

double RainImpacts::rainfall() const
{
    const double min = std::max(range.min, diameterAt(0.0));
    if (!(sizes.slope > 0.0) || min >= range.max) {
        return 0.0;
    }
    // The exponential term of the speed makes a steeper distribution.
    const RaindropSizes slowed{sizes.intercept, sizes.slope + kFall};
    return kFastest * sizes.waterContent() * sizes.waterShare(min, range.max) -
           kSlowed * slowed.waterContent() * slowed.waterShare(min, range.max);
}

double RainImpacts::rate(double min, const Exposure& exposure) const
{
    double from = std::max(min, range.min);
    double to = range.max;
    const double wall = speed * exposure.forward;
    // One of the two terms may be negative: raindrops of one speed then move parallel to the surface.
    if (exposure.upward > 0.0 && wall < 0.0) {
        from = std::max(from, diameterAt(-wall / exposure.upward));
    } else if (exposure.upward < 0.0 && wall > 0.0) {
        to = std::min(to, diameterAt(-wall / exposure.upward));
    } else if (exposure.upward <= 0.0 && wall <= 0.0) {
        return 0.0;
    }
    return from < to ? exposure.upward * fallRateOf(sizes, from, to) + wall * numberOf(sizes, from, to) : 0.0;
}

double RainImpacts::bound() const
{
    return fallRateOf(sizes, range.min, range.max) + speed * numberOf(sizes, range.min, range.max);
}

RaindropSampler::RaindropSampler(const RainImpacts& impacts)
    : impacts_(impacts),
      floor_share_(fallRateOf(impacts.sizes, impacts.range.min, impacts.range.max) / impacts.bound()),
      floor_rate_(fallRateOf(impacts.sizes, impacts.range.min, impacts.range.max)),
      in_range_(-std::expm1(-impacts.sizes.slope * (impacts.range.max - impacts.range.min)))
{
}

double RaindropSampler::diameter(double which, double u) const
{
    const RaindropSizes& sizes = impacts_.sizes;
    const auto [min, max] = impacts_.range;
    if (which >= floor_share_) {
        return std::min(min - std::log1p(-u * in_range_) / sizes.slope, max);
    }
    // Newton's method on the floor's rate, kept between bounds that narrow.
    double low = std::max(min, diameterAt(0.0));
    double high = max;
    const double from = low;
    double diameter = std::min(from + 1.0 / sizes.slope, 0.5 * (low + high));
    for (int tries = 0; tries < 60; ++tries) {
        const double residual = fallRateOf(sizes, from, diameter) - u * floor_rate_;
        (residual > 0.0 ? high : low) = diameter;
        const double slope = sizes.density(diameter) * terminalSpeed(diameter);
        const double newton = slope > 0.0 ? diameter - residual / slope : low;
        const double next = newton > low && newton < high ? newton : 0.5 * (low + high);
        const double moved = std::abs(next - diameter);
        diameter = next;
        if (moved <= 1e-9 * diameter) {
            break;
        }
    }
    return diameter;
}

double RainImpacts::kept(double diameter, const Exposure& exposure) const
{
    const double fall = terminalSpeed(diameter);
    const double all = fall + speed;
    return all > 0.0 ? std::max(0.0, fall * exposure.upward + speed * exposure.forward) / all : 0.0;
}

}  // namespace droplet
