// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/windshield/balance.h"

#include <cmath>

#include "droplet/windshield/windshield.h"

namespace droplet {

void CompensatedSum::add(double term)
{
    const double total = sum + term;
    carry += std::abs(sum) >= std::abs(term) ? (sum - total) + term : (term - total) + sum;
    sum = total;
}

double WaterBalance::residual() const
{
    CompensatedSum difference;
    for (const double term : {rained, -on_glass_still, -on_glass_running, -left, -wiped}) {
        difference.add(term);
    }
    return rained > 0.0 ? difference.value() / rained : 0.0;
}

WaterBalance balanceOf(const WindshieldState& state)
{
    CompensatedSum still;
    for (const StillDroplet& d : state.still.all()) {
        still.add(d.volume);
    }
    CompensatedSum running;
    for (const RunningDroplet& d : state.droplets) {
        running.add(d.volume);
    }
    return {state.rained.value(), still.value(),        running.value(),     state.left.value(),
            state.wiped.value(),  state.merged.value(), state.swept.value(), state.shed.value()};
}

}  // namespace droplet
