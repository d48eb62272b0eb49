// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <vector>

#include "droplet/picture/picture.h"

namespace droplet {

/// Light from all around, as a picture of the whole sphere: longitude across, its middle far behind the droplet and
/// its right at the picture's right; latitude down, from the zenith.
/// Invariant: `radiance.size() == width * height`, width and height ≥ 1; all finite and at least 0, some above it.
struct Environment {
    int width = 0;                               ///< [px]
    int height = 0;                              ///< [px]
    std::vector<std::array<float, 3>> radiance;  ///< linear red, green and blue, in any one unit, row by row

    /// @throws Error InvalidArgument
    void validate() const;
};

/// Reads an environment from a picture of any format a mask can have: floating-point samples (OpenEXR, HDR) are
/// radiance, others sRGB.
/// @param max_pixels  larger ones are refused by their header
/// @throws Error      InvalidInput, naming the file: also where nothing in it shines
Environment readEnvironment(const std::filesystem::path& path, std::size_t max_pixels = kMaxPicturePixels);

}  // namespace droplet
