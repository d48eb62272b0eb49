// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "droplet/vector.h"
#include "rays/nearest.h"

namespace droplet {

/// Conditions to end the search for the largest distance.
struct HausdorffOptions {
    double share = 0.01;              ///< largest difference of both bounds, as a share of the upper one
    std::optional<double> tolerance;  ///< distance that both bounds must be on one side of
    std::size_t max_pieces = 0;       ///< limit of pieces; then the bounds are returned as they are
};

/// Bounds of the largest distance of a surface's points from another.
struct HausdorffBounds {
    double lower = 0.0;  ///< distance of `at`
    double upper = 0.0;
    Vec3 at;
    Vec3 nearest;  ///< point of the other surface nearest to `at`
};

/// Largest distance of points of triangles from other triangles; the same at any number of threads.
/// @param from  coordinates within [−1, 1]
HausdorffBounds hausdorff(const std::vector<Corners3>& from, const NearestTriangles& to,
                          const HausdorffOptions& options);

}  // namespace droplet
