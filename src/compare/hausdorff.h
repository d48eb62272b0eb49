// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "droplet/vector.h"
#include "rays/nearest.h"

namespace droplet {

/// When the search for the largest distance may end.
struct HausdorffOptions {
    double share = 0.01;              ///< upper − lower, as a share of the upper bound
    std::optional<double> tolerance;  ///< also, whether the distance is over this must be certain
    std::size_t max_pieces = 0;       ///< looked at; then the bounds stay as they are
};

/// Bounds of the largest distance of a surface's points from another.
struct HausdorffBounds {
    double lower = 0.0;  ///< distance of `at`
    double upper = 0.0;
    Vec3 at;
    Vec3 nearest;  ///< on the other surface
};

/// The largest distance of points of triangles from other triangles, the same at any number of threads.
/// @param from  coordinates within [−1, 1]
HausdorffBounds hausdorff(const std::vector<Corners3>& from, const NearestTriangles& to,
                          const HausdorffOptions& options);

}  // namespace droplet
