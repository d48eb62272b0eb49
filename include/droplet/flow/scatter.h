// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "droplet/flow/flow_parameters.h"
#include "droplet/flow/flow_terrain.h"
#include "droplet/vector.h"

namespace droplet {

/// Options of scatterDroplets.
struct ScatterOptions {
    std::size_t count = 200;          ///< number of droplets
    VolumeDistribution volumes = {};  ///< of the droplets
    std::optional<Vec3> from = {};    ///< only points that rain from this direction meets first, from outside; not 0
    /// Probability, 0 … 1, that a point of the surface may have a droplet; empty: 1. Called by many threads.
    std::function<double(const FlowTerrain::Point&)> coverage = {};
    std::uint64_t seed = 1;  ///< of the random numbers

    /// Checks all fields.
    /// @throws Error InvalidArgument
    void validate() const;
};

/// Droplets at rest at random points of a surface, uniform by area.
///
/// Guarantees: the same options give the same droplets, with any number of threads; fewer droplets are the first ones
/// of more droplets.
/// @throws Error  InvalidArgument; InvalidInput if no point was found in a million tries: nothing of the surface faces
///                the rain, or the coverage is 0
std::vector<FlowStart> scatterDroplets(const FlowTerrain& terrain, const ScatterOptions& options);

/// Area of the surface where scatterDroplets() puts droplets, each part times its coverage, from a sample [m²].
/// @throws Error  InvalidArgument
double scatterArea(const FlowTerrain& terrain, const ScatterOptions& options);

}  // namespace droplet
