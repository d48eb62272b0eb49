// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>

#include "droplet/footprint/mask.h"

namespace droplet {

/// What is done to a mask before it is traced. By default nothing.
struct CleanOptions {
    double smooth = 0.0;              ///< bends and spots narrower than this are smoothed away [m], ≥ 0
    double fill_holes = 0.0;          ///< holes smaller than this are filled [m²], ≥ 0
    std::optional<std::size_t> keep;  ///< only so many of the largest droplets stay, ≥ 1

    /// Whether anything is asked for.
    [[nodiscard]] bool any() const { return smooth > 0.0 || fill_holes > 0.0 || keep; }
    /// @throws Error InvalidArgument
    void validate() const;
};

/// Cleans a mask: smooths its rims, then fills small holes, then keeps the largest droplets.
///
/// Smoothing averages the coverage by a Gaussian and takes what is more than half: straight rims and large droplets
/// stay where they are, spots narrower than that length vanish. Rims keep fractional coverage throughout. A
/// hole is dry that is 4-connected and does not reach the picture's border, a droplet is liquid that is 8-connected, as
/// in trace; of droplets of one size the first in reading order is kept.
/// @param mask        valid
/// @param options     what is done
/// @param pixel_size  edge of a pixel [m], > 0
/// @param threshold   coverage at which liquid begins, in (0, 1)
/// @throws Error      InvalidArgument
Mask clean(Mask mask, const CleanOptions& options, double pixel_size, double threshold);

}  // namespace droplet
