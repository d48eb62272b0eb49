// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "droplet/render/environment.h"
#include "render/optics.h"

namespace droplet {

/// Environment with look-up by direction, scaled to a given irradiance of level ground.
class Sky {
public:
    /// Part of the sphere.
    struct Cell {
        Vec3f toward;        ///< mean direction of its light, unit
        Vec3f radiance;      ///< mean radiance
        float angle = 0.0F;  ///< solid angle [sr]
    };

    /// @param environment  valid
    /// @param irradiance   green irradiance of open level ground
    Sky(const Environment& environment, float irradiance);

    [[nodiscard]] Vec3f at(Vec3f direction) const;
    /// The whole sphere, divided into parts of a few degrees.
    [[nodiscard]] const std::vector<Cell>& cells() const { return cells_; }

private:
    Environment environment_;
    std::vector<Cell> cells_;
};

}  // namespace droplet
