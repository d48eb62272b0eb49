// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "windshield/still_droplets.h"
#include "windshield_view/still_map.h"
#include "windshield_view/view_context.h"

namespace droplet {

/// Ray through a still droplet. It is kept as long as the droplet is there, whatever is behind the glass.
struct StillSample {
    std::uint32_t outside = 0;  ///< pixel of the backdrop
    std::uint8_t pixel = 0;     ///< pixel of the tile
    std::uint8_t light = 0;     ///< share of light that is transmitted, in 255ths
    std::uint8_t cover = 0;     ///< covered share, in 255ths
};

/// Rays through still droplets.
class StillSamples {
public:
    /// @param scene  must outlive this
    explicit StillSamples(const ViewContext& scene);

    /// Updates the samples.
    void update(const StillCells& still);

    [[nodiscard]] const std::vector<StillSample>& inTile(std::size_t tile) const { return samples_[tile]; }
    [[nodiscard]] std::size_t cellsDrawn() const { return map_.cellsDrawn(); }

private:
    class ChangedCells;

    void sample(int column, int row, const ChangedCells& cells);

    const ViewContext& scene_;
    StillMap map_;
    std::vector<std::vector<StillSample>> samples_;  ///< samples of each tile, ordered by pixel
};

}  // namespace droplet
