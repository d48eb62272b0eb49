// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/liquid2d_io/fluid_presets.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "droplet/error.h"
#include "droplet/expression/expression.h"
#include "droplet/liquid2d/fluid.h"
#include "droplet/liquid2d_io/liquid_drawing.h"
#include "droplet/liquid2d_io/read_scene.h"

namespace {

using droplet::DeepPicture;
using droplet::Error;
using droplet::ExpressionOptions;
using droplet::ExpressionState;
using droplet::FluidPreset;
using droplet::FluidScene;
using droplet::FluidState;
using droplet::LiquidStyle;
using droplet::ParticleFrame;
using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(FluidPresets, AreValidAndHoldLiquid)
{
    for (const FluidPreset& preset : droplet::fluidPresets()) {
        SCOPED_TRACE(preset.name);
        EXPECT_NO_THROW(preset.scene.validate());
        EXPECT_NO_THROW(droplet::checkEmitters(preset.scene));
        EXPECT_EQ(&droplet::fluidPresetNamed(preset.name), &preset);
        FluidScene coarse = preset.scene;
        coarse.spacing = 0.05;
        const FluidState state = advanceFluid(startFluid(coarse), coarse, 0.2);
        EXPECT_GT(state.position.size(), 10U);
        EXPECT_EQ(state.counts.removed, 0U);
    }
    EXPECT_THAT([] { droplet::fluidPresetNamed("rain"); }, ThrowsMessage<Error>(HasSubstr("splash, wave, dam, pour")));
}

/// Pixels that are wet in `now`, but farther than a distance from what was wet in `before`.
int newlyWet(const DeepPicture& before, const DeepPicture& now, double distance, bool is_wet)
{
    const auto wet = [&](const DeepPicture& picture, int x, int y) {
        return (picture.levels[static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                               static_cast<std::size_t>(x)] > 32767) == is_wet;
    };
    const int reach = static_cast<int>(std::ceil(distance));
    int count = 0;
    for (int y = 0; y < now.height; ++y) {
        for (int x = 0; x < now.width; ++x) {
            if (!wet(now, x, y) || wet(before, x, y)) {
                continue;
            }
            bool near = false;
            for (int v = std::max(0, y - reach); v <= std::min(now.height - 1, y + reach) && !near; ++v) {
                for (int u = std::max(0, x - reach); u <= std::min(now.width - 1, x + reach) && !near; ++u) {
                    near = wet(before, u, v) && std::hypot(u - x, v - y) <= distance;
                }
            }
            count += near ? 0 : 1;
        }
    }
    return count;
}

/// Between two frames the outline moves no farther than the liquid flows.
TEST(FluidPresets, NothingPops)
{
    constexpr double kRate = 192.0;
    constexpr int kPixelsPerSpacing = 2;
    struct Moment {
        const char* preset;
        double begin, end;
    };
    // The impact, the breaking wave, the meeting with the other wall, the jet on the ball.
    for (const auto& [name, begin, end] :
         {Moment{"splash", 0.1, 0.6}, Moment{"wave", 2.0, 2.6}, Moment{"dam", 0.8, 1.3}, Moment{"pour", 0.5, 1.0}}) {
        SCOPED_TRACE(name);
        const FluidPreset& preset = droplet::fluidPresetNamed(name);
        FluidScene scene = preset.scene;
        scene.spacing = 0.03;
        const ExpressionOptions controls =
            expressionOf(preset.style == "wave" ? LiquidStyle::Wave : LiquidStyle::Cartoon);
        const auto pixels = [&](double size) { return static_cast<int>(kPixelsPerSpacing * size / scene.spacing); };
        const droplet::LiquidView view{scene.size, pixels(scene.size.x), pixels(scene.size.y)};
        FluidState state = advanceFluid(startFluid(scene), scene, begin);
        ExpressionState surface;
        DeepPicture before;
        int worst = 0;
        for (int k = 0; begin + k / kRate < end; ++k) {
            state = advanceFluid(std::move(state), scene, begin + k / kRate);
            const ParticleFrame frame = frameOf(state, scene);
            surface = advanceExpression(std::move(surface), frame, controls);
            DeepPicture now = liquidMask(liquidShape(surface, frame, controls), view);
            double fastest = 0.0;
            for (const droplet::Vec2 v : frame.velocity) {
                fastest = std::max(fastest, length(v));
            }
            const double way = kPixelsPerSpacing * (1.0 + fastest / kRate / scene.spacing);
            if (k > 0) {
                worst = std::max({worst, newlyWet(before, now, way, true), newlyWet(before, now, way, false)});
            }
            before = std::move(now);
        }
        // Areas of particles.
        EXPECT_LE(worst, 3 * kPixelsPerSpacing * kPixelsPerSpacing);
    }
}

}  // namespace
