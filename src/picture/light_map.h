// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <vector>

#include "picture/optics.h"
#include "picture/scene.h"
#include "picture/studio.h"

namespace droplet {

/// What liquid does to light, in a scene's units of length.
struct Medium {
    bool clear = true;  ///< light goes through; otherwise none does
    float ior = 1.0F;
    Vec3f absorption;  ///< per length
};

/// Share of light left after a way through it (Beer and Lambert).
inline Vec3f passed(const Medium& medium, float distance)
{
    const Vec3f depth = distance * medium.absorption;
    return largest(depth) <= 0.0F ? grey(1.0F) : Vec3f{std::exp(-depth.x), std::exp(-depth.y), std::exp(-depth.z)};
}

/// How much of a light reaches the plane around and below a droplet, 1 being as much as without it; or light itself.
struct LightMap {
    int columns = 0;
    int rows = 0;
    float cell = 0.0F;
    Vec3f low;                        ///< corner of the first cell
    std::vector<Vec3f> values;        ///< row by row
    Vec3f open = {1.0F, 1.0F, 1.0F};  ///< beyond the map, and reached within a margin of it

    /// Between the cells' centres linearly.
    [[nodiscard]] Vec3f at(Vec3f place) const;
};

/// Sends a light's beams through the liquid onto the plane: of every ray on a regular grid what arrives there is added,
/// and what would have arrived without liquid taken away.
///
/// Guarantees: the same result at any number of threads.
/// @param scene   on the plane
/// @param medium  the liquid
/// @param light   beams
/// @param cells   along the map's longer side; ≥ 8
/// @param blur    standard deviation of a Gaussian that takes away the grain [cells]; 0 for none
LightMap lightGain(const Scene& scene, const Medium& medium, const Light& light, int cells, float blur);

/// All the lights' irradiance on the plane, divided by π: soft lights on a coarse map, others on one as fine as
/// `cells` says.
LightMap lightOnPlane(const Scene& scene, const Medium& medium, const std::vector<Light>& lights, int cells);

/// How much of a light's direct share reaches a stand around and below droplets, by uv from (0,0) to (1,1): rays
/// through the liquid against those that would have arrived without it.
LightMap lightGainOnStand(const Scene& scene, const Medium& medium, const Light& light, int cells);

}  // namespace droplet
