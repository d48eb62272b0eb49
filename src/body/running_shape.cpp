// SPDX-License-Identifier: GPL-3.0-or-later
// N. Nakata, M. Kakimoto, T. Nishita, "Animation of Water Droplets on a Hydrophobic Windshield" (2012), section 3.2.1
// of the thesis: a hemisphere at rest, a capsule of the same volume in motion.
#include "droplet/body/running_shape.h"

#include <cmath>
#include <numbers>

#include "droplet/units.h"
#include "require.h"

namespace droplet {
namespace {

/// Volume of a cap of contact radius 1: π (2 − 3 cos θ + cos³ θ)/(3 sin³ θ).
double capVolume(double angle)
{
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    return std::numbers::pi * (2.0 - 3.0 * c + c * c * c) / (3.0 * s * s * s);
}

/// Area of a circular segment with a chord of 2: (θ − sin θ cos θ)/sin² θ.
double segmentArea(double angle)
{
    const double s = std::sin(angle);
    return (angle - s * std::cos(angle)) / (s * s);
}

}  // namespace

void ShapeOptions::validate() const
{
    require(contact_angle >= kDegree && contact_angle <= 179.0 * kDegree, "contact_angle", contact_angle,
            "from 1 to 179 degrees");
    require(largest_stretch >= 0.0 && largest_stretch <= 10.0, "largest_stretch", largest_stretch, "from 0 to 10");
    require(stretch_speed > 0.0 && std::isfinite(stretch_speed), "stretch_speed", stretch_speed,
            "finite and more than 0 m/s");
}

double RunningShape::volume() const
{
    const double angle = std::atan2(contact_radius, -centre_height);
    return contact_radius * contact_radius *
           (capVolume(angle) * contact_radius + segmentArea(angle) * 2.0 * half_length);
}

RunningShape runningShape(double volume, double speed, const ShapeOptions& options)
{
    options.validate();
    require(volume > 0.0 && std::isfinite(volume), "volume", volume, "finite and more than 0 m3");
    require(speed >= 0.0 && std::isfinite(speed), "speed", speed, "finite and at least 0 m/s");
    const double angle = options.contact_angle;
    const double stretch = options.largest_stretch * speed / (speed + options.stretch_speed);
    RunningShape shape;
    // V = r³ (cap + 2 stretch segment), as half_length = stretch r
    shape.contact_radius = std::cbrt(volume / (capVolume(angle) + 2.0 * stretch * segmentArea(angle)));
    shape.half_length = stretch * shape.contact_radius;
    shape.radius = shape.contact_radius / std::sin(angle);
    shape.centre_height = -shape.radius * std::cos(angle);
    return shape;
}

}  // namespace droplet
