// SPDX-License-Identifier: GPL-3.0-or-later
//
// Fields that are chosen by eye: where a film's rims are when it is thin, and the waves that run over it, an
// orange-peel of bumps.
#pragma once

#include <algorithm>
#include <cmath>

#include "droplet/vector.h"
#include "windshield_view/glass_frame.h"
#include "windshield_view/smooth_noise.h"

namespace droplet {

/// Value and its slopes along the glass's x and y.
struct Sloped {
    float value = 0.0F;
    Vec2f slope;
};

/// What the film of heavy rain has that is finer than its cells: irregular rims where it is thin, and waves that run
/// over it. rain.glsl draws the same.
class RunoffRelief {
public:
    /// @param drift  way that the waves have run [m]
    explicit RunoffRelief(Vec2 drift);

    /// Surface of a film within a pixel.
    struct Surface {
        float cover = 0.0F;  ///< share of the pixel that the film covers; 0 or less: none
        Vec2f slope;         ///< along the glass's x and y
    };
    /// @param thickness  of the film without waves [m]
    /// @param pixel      width of the pixel [m]
    /// @param covered    share of the pixel that other water covers; a film that covers no more has no slope
    [[nodiscard]] Surface at(Vec2f place, const Sloped& thickness, float pixel, float covered = 0.0F) const;

private:
    // Waves per metre.
    static constexpr float kLong = 1.0F / 7e-3F;
    static constexpr float kHigh = 1.0F / 5e-3F;  // of long ones, up the glass
    static constexpr float kShort = 1.0F / 2.9e-3F;

    [[nodiscard]] Sloped distanceFromRim(Vec2f place, const Sloped& thickness) const;
    [[nodiscard]] Sloped wavesAt(Vec2f place) const;

    const SmoothNoise* noise_;
    Vec2f long_run_;  ///< of the waves, in their lengths
    Vec2f short_run_;
};

// Below, all is inlined: small structures of floats that are returned pass through memory.

[[gnu::always_inline]] inline Sloped RunoffRelief::distanceFromRim(Vec2f place, const Sloped& thickness) const
{
    constexpr float kThin = 1.0F / 50e-6F;   // over the thickness where rims are
    constexpr float kCoarse = 1.0F / 5e-3F;  // waves of the rims per metre
    constexpr float kFine = 1.0F / 1.7e-3F;
    const Float4 coarse = noise_->at(kCoarse * place.x, kCoarse * place.y);
    const Float4 fine = noise_->at(kFine * place.x, kFine * place.y);
    return {kThin * thickness.value + 0.9F * coarse[0] + 0.5F * fine[0] - 1.25F,
            {kThin * thickness.slope.x + 0.9F * kCoarse * coarse[1] + 0.5F * kFine * fine[1],
             kThin * thickness.slope.y + 0.9F * kCoarse * coarse[2] + 0.5F * kFine * fine[2]}};
}

[[gnu::always_inline]] inline Sloped RunoffRelief::wavesAt(Vec2f place) const
{
    const Float4 large = noise_->at(kLong * place.x - long_run_.x, kHigh * place.y - long_run_.y);
    const Float4 small = noise_->at(kShort * place.x - 3.0F - short_run_.x, kShort * place.y - short_run_.y);
    return {large[0] + 0.6F * small[0] - 0.8F,
            {kLong * large[1] + 0.6F * kShort * small[1], kHigh * large[2] + 0.6F * kShort * small[2]}};
}

[[gnu::always_inline]] inline RunoffRelief::Surface RunoffRelief::at(Vec2f place, const Sloped& thickness, float pixel,
                                                                     float covered) const
{
    constexpr float kThinnest = 2e-6F;  // [m]
    constexpr float kWhole = 110e-6F;   // so thick a film has no rims [m]
    if (thickness.value < kThinnest) {
        return {};
    }
    const Sloped rim = thickness.value < kWhole ? distanceFromRim(place, thickness) : Sloped{1.0F, {}};
    const float wide = std::max(std::sqrt(rim.slope.x * rim.slope.x + rim.slope.y * rim.slope.y) * pixel, 0.05F);
    const float cover = std::min(rim.value / wide, 1.0F);
    if (!(cover > covered)) {
        return {cover, {}};
    }
    constexpr float kWaves = 0.8F;    // height of waves over the thickness
    constexpr float kRounded = 0.8F;  // distance from the rim where the film is flat
    const Sloped waves = wavesAt(place);
    const float t = std::min(rim.value / kRounded, 1.0F);
    const float rounded = t * t * (3.0F - 2.0F * t);
    const float by_rim = t < 1.0F ? 6.0F * t * (1.0F - t) / kRounded : 0.0F;
    const float high = 1.0F + kWaves * waves.value;
    const auto sum = [&](float film, float wave, float at_rim) {
        return high * rounded * film + kWaves * thickness.value * rounded * wave +
               thickness.value * high * by_rim * at_rim;
    };
    return {cover,
            {sum(thickness.slope.x, waves.slope.x, rim.slope.x), sum(thickness.slope.y, waves.slope.y, rim.slope.y)}};
}

}  // namespace droplet
