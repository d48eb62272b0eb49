// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "droplet/picture/environment.h"
#include "picture/optics.h"

namespace droplet {

/// An environment to be looked up by direction, so bright that level ground gets a given light.
class Sky {
public:
    /// A part of the sphere.
    struct Cell {
        Vec3f toward;        ///< the middle of its light, unit
        Vec3f radiance;      ///< mean
        float angle = 0.0F;  ///< solid [sr]
    };

    /// @param environment  valid
    /// @param irradiance   of level ground in the open, green
    Sky(const Environment& environment, float irradiance);

    [[nodiscard]] Vec3f at(Vec3f direction) const;
    /// The whole sphere in parts of a few degrees.
    [[nodiscard]] const std::vector<Cell>& cells() const { return cells_; }

private:
    Environment environment_;
    std::vector<Cell> cells_;
};

}  // namespace droplet
