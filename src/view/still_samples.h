// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "view/sight.h"
#include "view/still_map.h"
#include "windshield/still_droplets.h"

namespace droplet {

/// What a ray through a still droplet shows. Kept as long as the droplet is there, whatever is behind the glass.
struct StillSample {
    std::uint32_t outside = 0;  ///< pixel of the backdrop
    std::uint8_t pixel = 0;     ///< of the tile
    std::uint8_t light = 0;     ///< share of it that gets through, in 255ths
    std::uint8_t cover = 0;     ///< in 255ths
};

/// Rays through still droplets, kept up with them.
class StillSamples {
public:
    /// @param sight  must outlive this
    explicit StillSamples(const Sight& sight);

    /// Brings the samples to the state of the droplets.
    void follow(const StillCells& still);

    [[nodiscard]] const std::vector<StillSample>& inTile(std::size_t tile) const { return samples_[tile]; }
    [[nodiscard]] std::size_t cellsDrawn() const { return map_.cellsDrawn(); }

private:
    class ChangedCells;

    void sample(int column, int row, const ChangedCells& cells);

    const Sight& sight_;
    StillMap map_;
    std::vector<std::vector<StillSample>> samples_;  ///< of each tile, by their pixels
};

}  // namespace droplet
