// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "droplet/wind/windshield.h"
#include "wind/cells.h"

namespace droplet {

/// Width of the still droplets' cells [m].
inline constexpr double kStillCell = 4e-3;

inline Cells cellsOf(const StillDroplets& still)
{
    return {still.cell, still.columns, still.rows};
}

/// None, on a glass of that size.
StillDroplets noStillDroplets(Vec2 size);

/// When still droplets touch and what becomes of them.
struct StillRules {
    double reach = 0.0;     ///< half the width of a droplet of 1 m³, seen from above [m]
    double greatest = 0.0;  ///< from this volume on a droplet runs [m³]

    [[nodiscard]] double reachOf(double volume) const;
    /// Of the largest one.
    [[nodiscard]] double greatestReach() const { return reachOf(greatest); }
};

/// Puts a droplet on the glass, or joins it with the nearest one that it touches, at the centre of their masses; in a
/// full cell with the nearest there.
/// @return  empty where it now stands; else what the two make, which is off the glass
std::optional<StillDroplet> settle(StillDroplets& still, const StillDroplet& droplet, const StillRules& rules);

/// Where a still droplet stands.
struct StillSlot {
    std::size_t cell = 0;
    std::uint8_t slot = 0;
};

/// Takes still droplets away one by one; gaps are closed at the end, so that slots stay what they are until then.
class Taking {
public:
    explicit Taking(StillDroplets& still) : still_(&still) {}

    /// @return  its volume; 0 if it is gone already
    double take(StillSlot place)
    {
        double& volume = still_->slots[place.cell * StillDroplets::kMost + place.slot].volume;
        if (volume > 0.0) {
            touched_.push_back(place.cell);
        }
        return std::exchange(volume, 0.0);
    }
    void close();

private:
    StillDroplets* still_;
    std::vector<std::size_t> touched_;
};

}  // namespace droplet
