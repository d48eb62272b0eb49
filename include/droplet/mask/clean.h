// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>

#include "droplet/mask/mask.h"

namespace droplet {

/// Changes made to a mask before it is traced; none by default.
struct CleanOptions {
    double smooth = 0.0;              ///< width [m] below which bends and spots are smoothed away, ≥ 0
    double fill_holes = 0.0;          ///< area [m²] below which holes are filled, ≥ 0
    std::optional<std::size_t> keep;  ///< number of droplets to keep, the largest first, ≥ 1; empty keeps all

    /// Whether any change is requested.
    [[nodiscard]] bool any() const { return smooth > 0.0 || fill_holes > 0.0 || keep; }
    /// @throws Error InvalidArgument if a value is out of its range
    void validate() const;
};

/// Cleans a mask: smooths its rims, then fills small holes, then keeps the largest droplets.
///
/// Smoothing averages the coverage by a Gaussian; liquid is where the average is more than half. Straight rims and
/// large droplets stay in place, and spots narrower than the smoothing width disappear. Rims keep fractional coverage.
/// As in trace(), a hole is a 4-connected dry region that does not reach the picture's border, and a droplet is an
/// 8-connected liquid region. Of droplets of equal size the first in reading order is kept.
/// @param mask        valid
/// @param options     changes to make
/// @param pixel_size  edge of a pixel [m], > 0
/// @param threshold   coverage at which liquid begins, in (0, 1)
/// @throws Error      InvalidArgument
Mask clean(Mask mask, const CleanOptions& options, double pixel_size, double threshold);

}  // namespace droplet
