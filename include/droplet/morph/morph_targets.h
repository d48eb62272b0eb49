// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "droplet/liquid2d/fluid_scene.h"

namespace droplet {

/// Well-spread points in a region.
///
/// A hexagonal lattice, whose spacing is found by bisection, gives at least `count` points; those that remain over are
/// left out evenly. Then points that are too close push one another apart, inside of the region. The same input gives
/// the same points.
/// @param region  area > 0
/// @param count   number of points, ≥ 1
/// @return        exactly `count` points, all inside
/// @throws Error  InvalidArgument for an empty region or a count of zero
std::vector<Vec2> sampleRegion(const Region& region, std::size_t count);

/// Partners of two sets of points of the same size, one to one, so that the sum of squared distances is near its
/// minimum.
///
/// Sliced optimal transport (Rabin, Peyré, Delon, Bernot 2011; Bonneel, Rabin, Peyré, Pfister 2015): points are moved
/// along directions in turn until their projections are those of the targets. What remains is paired by halving both
/// sets alike, and pairs are exchanged among neighbours while that shortens the sum. Both papers match distributions;
/// the pairing is this project's. Takes O(n log n) for each direction. A translation is found exactly. The same input
/// gives the same pairs at any number of threads.
/// @param sources  finite
/// @param targets  finite, as many
/// @return         for each source the index of its target: a permutation
/// @throws Error   InvalidArgument if the numbers of points differ or exceed 2³² − 1
std::vector<std::uint32_t> assignTargets(const std::vector<Vec2>& sources, const std::vector<Vec2>& targets);

}  // namespace droplet
