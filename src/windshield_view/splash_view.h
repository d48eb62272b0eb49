// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "droplet/windshield/splash.h"
#include "windshield_view/bead.h"
#include "windshield_view/splash_rim.h"
#include "windshield_view/view_context.h"

namespace droplet {

/// Ring that a ray meets.
struct SplashMet {
    float inside = 0.0F;  ///< share of the pixel in which flat water replaces what is on the glass
    WaterMet rim;         ///< over it
};

/// Rings of splashes, as they are at the state's time, also while the shutter is open. The water
/// inside a ring is flat, and so thin that it is clear; it takes the place of droplets.
class SplashView {
public:
    /// @param scene  must outlive this
    explicit SplashView(const ViewContext& scene) : scene_(scene) {}

    /// Moves the rings to a time [s].
    void update(const std::vector<Splash>& splashes, double time);

    /// Whether rings may be visible in a tile (upper bound).
    [[nodiscard]] bool reach(std::size_t tile) const { return !tiles_.empty() && !tiles_[tile].empty(); }
    /// Rings of a tile at a place; where several are, the strongest.
    /// @param place  [m]
    /// @param pixel  size of the ray's part of a pixel on the glass [m]
    [[nodiscard]] SplashMet at(std::size_t tile, Vec2f place, float pixel) const;

private:
    const ViewContext& scene_;
    std::vector<std::vector<SplashRim>> tiles_;  ///< rings that reach into each tile; empty: there are none
};

}  // namespace droplet
