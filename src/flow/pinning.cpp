// SPDX-License-Identifier: GPL-3.0-or-later
// A droplet that moves is held at the front of its contact line, by σ (cos θ_r − cos θ_a) for each length of its width
// (C. G. L. Furmidge, J. Colloid Sci. 17 (1962) 309). Where dirt and roughness make this uneven, the force is the
// integral over the front: larger or smaller than the mean, and not quite against the way, so that the droplet turns to
// where it is held less. The field is a smooth one of random numbers at the corners of cubes.
#include "flow/pinning.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "wind/random_field.h"

namespace droplet {

double PinningField::at(Vec3 place) const
{
    return factor(smoothRandom((1.0 / pinning_.length) * place, seed_));
}

double PinningField::least() const
{
    return factor(-1.0);
}

double PinningField::most() const
{
    return factor(1.0);
}

double PinningField::factor(double random) const
{
    return std::exp(pinning_.spread * (random / kSmoothRandomDeviation) - 0.5 * pinning_.spread * pinning_.spread);
}

PinningHold PinningField::over(const ContactFront& front) const
{
    // The middles of equal parts of the front half. Weights are their shares of the width; asides, the same times the
    // tangent of their angle: on an even slope of the field 3/4 of it times the radius, where the integral has π/4.
    constexpr int kParts = 3;
    constexpr double kPart = std::numbers::pi / kParts;
    static const std::array<Vec2, kParts> parts = [] {
        std::array<Vec2, kParts> units;
        for (int k = 0; k < kParts; ++k) {
            const double angle = (k - 0.5 * (kParts - 1)) * kPart;
            units[static_cast<std::size_t>(k)] = {std::cos(angle), std::sin(angle)};
        }
        return units;
    }();
    double width = 0.0;
    PinningHold hold{0.0, 0.0};
    for (const Vec2 part : parts) {
        const Vec3 outward = part.x * front.ahead + part.y * front.left;
        const double here = at(front.middle + front.radius * outward);
        width += part.x;
        hold.along += here * part.x;
        hold.aside -= here * part.y;
    }
    hold.along /= width;
    // It never pushes more than friction takes.
    hold.aside = std::clamp(hold.aside / width, -hold.along, hold.along);
    return hold;
}

}  // namespace droplet
