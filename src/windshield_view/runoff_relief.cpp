// SPDX-License-Identifier: GPL-3.0-or-later
#include "windshield_view/runoff_relief.h"

namespace droplet {
namespace {

const SmoothNoise& sampledNoise()
{
    static const SmoothNoise noise;
    return noise;
}

}  // namespace

RunoffRelief::RunoffRelief(Vec2 drift) : noise_(&sampledNoise())
{
    // Long waves run half as fast. The field repeats.
    const auto run = [](double way, float per_metre) {
        return static_cast<float>(std::remainder(way * static_cast<double>(per_metre), double{SmoothNoise::kWaves}));
    };
    long_run_ = {run(0.5 * drift.x, kLong), run(0.5 * drift.y, kHigh)};
    short_run_ = {run(drift.x, kShort), run(drift.y, kShort)};
}

}  // namespace droplet
