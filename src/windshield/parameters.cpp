// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/windshield/parameters.h"

#include <cmath>

#include "require.h"

namespace droplet {
namespace {

/// Limit of the glass's area: still droplets take 213 bytes per 16 mm², so at most 1.33 GB.
constexpr double kMaxArea = 100.0;  // [m²]

}  // namespace

void Fluctuation::validate() const
{
    require(acceleration >= 0.0 && std::isfinite(acceleration), "fluctuation.acceleration", acceleration,
            "finite and at least 0 m/s2");
    require(interval > 0.0 && std::isfinite(interval), "fluctuation.interval", interval, "finite and more than 0 s");
}

void WindshieldParameters::validate() const
{
    const double area = glass.width() * glass.height();
    require(area <= kMaxArea, "the glass's area", area, "at most 100 m2");
    forces.validate();
    vehicle.validate();
    require(rainfall >= 0.0 && rainfall <= 1000.0 * kMillimetrePerHour, "rainfall", rainfall / kMillimetrePerHour,
            "from 0 to 1000 mm/h");
    raindrops.validate();
    require(still_diameter > 0.0 && still_diameter <= 2e-3, "still_diameter", still_diameter,
            "more than 0 and at most 0.002 m");
    fluctuation.validate();
    streaks.validate();
    require(tear_off_weber > 0.0, "tear_off_weber", tear_off_weber, "more than 0");
    require(runoff >= 0.0 && runoff <= 10.0, "runoff", runoff, "from 0 to 10 s");
    require(mist >= 0.0 && mist <= 1e-6, "mist", mist, "from 0 to 1e-6 m/s");
    for (const Wiper& wiper : wipers) {
        wiper.validate();
    }
}

}  // namespace droplet
