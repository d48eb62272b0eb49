// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace droplet {

/// Share of even light from all around that reaches a stand past itself, on grids over its triangles as those of
/// StandWater.
struct StandOpenness {
    std::vector<std::uint16_t> divisions;  ///< n of every triangle of the stand, > 0
    std::vector<std::uint32_t> first;      ///< index in `front` and `back` of every triangle's first value
    std::vector<float> front;              ///< 0 … 1
    std::vector<float> back;               ///< of the other sides; empty: none is seen

    /// Checks lengths and ranges.
    /// @param triangles  of the stand
    /// @throws Error     InvalidArgument
    void validate(std::size_t triangles) const;
};

}  // namespace droplet
