// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/windshield/drive_cycle.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "droplet/error.h"
#include "number_text.h"

namespace droplet {

double DriveCycle::speedAt(double time) const
{
    const auto after = std::upper_bound(times.begin(), times.end(), time);
    if (after == times.begin()) {
        return speeds.front();
    }
    if (after == times.end()) {
        return speeds.back();
    }
    const auto k = static_cast<std::size_t>(after - times.begin());
    const double part = (time - times[k - 1]) / (times[k] - times[k - 1]);
    return (1.0 - part) * speeds[k - 1] + part * speeds[k];
}

double DriveCycle::meanAcceleration(double from, double to) const
{
    return (speedAt(to) - speedAt(from)) / (to - from);
}

void DriveCycle::validate() const
{
    const auto refuse = [](const std::string& what) { throw Error(ErrorCode::InvalidArgument, "vehicle." + what); };
    if (times.empty() || times.size() != speeds.size()) {
        refuse("times and speeds must be equally many and at least one: " + std::to_string(times.size()) + ", " +
               std::to_string(speeds.size()));
    }
    for (std::size_t i = 0; i < times.size(); ++i) {
        if (!std::isfinite(times[i]) || (i > 0 && !(times[i] > times[i - 1]))) {
            refuse("times[" + std::to_string(i) + "] is " + numberText(times[i]) + " s; times must ascend");
        }
        if (!(speeds[i] >= 0.0) || !std::isfinite(speeds[i])) {
            refuse("speeds[" + std::to_string(i) + "] is " + numberText(speeds[i]) +
                   " m/s; it must be finite and at least 0");
        }
    }
}

DriveCycle constantSpeed(double speed)
{
    return {{0.0}, {speed}};
}

}  // namespace droplet
