// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "droplet/flow/flow_terrain.h"
#include "droplet/vector.h"
#include "wind/random.h"

namespace droplet {

/// Tries to find a place, after which there is none.
inline constexpr std::uint64_t kMaxTries = 1'000'000;

/// Points of a surface that droplets may have.
struct Places {
    const FlowTerrain& terrain;
    std::optional<Vec3> from;                                   ///< direction that rain comes from; not 0
    std::function<double(const FlowTerrain::Point&)> coverage;  ///< probability; empty: 1
    bool inside = true;  ///< also points that see less than a tenth of the outside

    /// Random point that takes a droplet.
    /// @param random   its numbers are used from `counter` on
    /// @param counter  number of the first try; behind the last one afterwards
    /// @return         empty after kMaxTries
    [[nodiscard]] std::optional<FlowTerrain::Point> pointOf(const RandomStream& random, std::uint64_t& counter) const;

    /// Share of the surface that takes droplets, from so many points.
    [[nodiscard]] double share(std::uint64_t seed, std::uint64_t points) const;

    /// Whether a point sees at least a tenth of the outside.
    [[nodiscard]] bool isOutside(const FlowTerrain::Point& point) const;

private:
    [[nodiscard]] bool takes(const FlowTerrain::Point& point, double u) const;
    [[nodiscard]] bool isMet(const FlowTerrain::Point& point) const;
};

}  // namespace droplet
