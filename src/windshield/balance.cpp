// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/windshield/balance.h"

#include "droplet/compensated_sum.h"
#include "droplet/windshield/windshield.h"

namespace droplet {

double WaterBalance::residual() const
{
    CompensatedSum difference;
    for (const double term : {rained, sprayed, condensed, -on_glass_mist, -on_glass_film, -on_glass_still,
                              -on_glass_running, -left, -wiped}) {
        difference.add(term);
    }
    const double come = rained + sprayed + condensed;
    return come > 0.0 ? difference.value() / come : 0.0;
}

WaterBalance balanceOf(const WindshieldState& state)
{
    CompensatedSum still;
    for (const StillDroplet& d : state.still.all()) {
        still.add(d.volume);
    }
    for (const StillDroplet& d : state.arriving) {
        still.add(d.volume);
    }
    CompensatedSum running;
    for (const RunningDroplet& d : state.droplets) {
        running.add(d.volume);
    }
    return {state.rained.value(), state.sprayed.value(), state.condensed.value(), state.mist.volume(),
            state.film.volume(),  still.value(),         running.value(),         state.left.value(),
            state.wiped.value(),  state.merged.value(),  state.swept.value(),     state.shed.value()};
}

}  // namespace droplet
