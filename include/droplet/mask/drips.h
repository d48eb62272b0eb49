// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "droplet/mask/mask.h"
#include "droplet/vector.h"

namespace droplet {

/// How liquid drips from a footprint.
struct DripOptions {
    int count = 5;           ///< largest number of drips, > 0; fewer where a footprint has no room for them
    std::uint64_t seed = 1;  ///< of their places, sizes and times

    /// @throws Error InvalidArgument
    void validate() const;
};

/// Footprint from which liquid drips, as paint that runs down a wall: at its lower edges a bulge grows, hangs for a
/// while, runs down and slows, since it leaves a trail. Down is toward the bottom of the picture.
class Drips {
public:
    /// @param mask     valid, with liquid
    /// @param options  valid
    /// @throws Error InvalidArgument, InvalidInput without liquid
    Drips(Mask mask, const DripOptions& options);

    /// Footprint at a time.
    ///
    /// Guarantees: it has one size at all times, that of the mask with rows added at the bottom if drips need them. At
    /// 0 it is the mask, exactly; later it covers no less.
    /// @param time  share of the whole, 0 … 1
    /// @throws Error InvalidArgument
    [[nodiscard]] Mask at(double time) const;

    /// Drip, in pixels from the top left corner of the mask.
    struct Drip {
        Vec2 root;            ///< on the rim
        double radius = 0.0;  ///< of its bulge
        double length = 0.0;  ///< of its way down
        double begin = 0.0;   ///< time at which the bulge begins to grow
    };
    /// Drips, the most fitting first.
    [[nodiscard]] const std::vector<Drip>& drips() const { return drips_; }

private:
    Mask mask_;                    ///< with the added rows
    std::vector<float> distance_;  ///< from the rim, negative inside [px]
    std::vector<Drip> drips_;
};

}  // namespace droplet
