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
    // Long waves run half as fast, and rims rest. The fields repeat.
    const auto run = [&](Field field, double share) {
        const auto along = [&](double way, float per_metre) {
            return static_cast<float>(
                std::remainder(share * way * static_cast<double>(per_metre), double{SmoothNoise::kUnits}));
        };
        shifts_[field] = {along(drift.x, kPerMetre[field].x), along(drift.y, kPerMetre[field].y)};
    };
    run(LongWaves, 0.5);
    run(ShortWaves, 1.0);
    shifts_[ShortWaves].x += 3.0F;  // the four are parts of one field
}

}  // namespace droplet
