// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <vector>

#include "droplet/drawing/picture.h"

namespace droplet {

/// Light from all directions, as an equirectangular picture. Columns are longitudes: the middle is far behind the
/// droplet, the right at the droplet's right. Rows are latitudes, from the zenith down.
/// Invariant: `radiance.size() == width * height`, width and height ≥ 1; all values finite and ≥ 0, at least one > 0.
struct Environment {
    int width = 0;                               ///< [px]
    int height = 0;                              ///< [px]
    std::vector<std::array<float, 3>> radiance;  ///< linear red, green and blue, in any unit, row by row

    /// Guarantees: returns only if the invariant holds.
    /// @throws Error InvalidArgument
    void validate() const;
};

/// Reads an environment from a picture of any format a mask can have. Floating-point samples (OpenEXR, HDR) are
/// radiance, others sRGB.
/// @param path        file to read
/// @param max_pixels  size limit, checked in the header
/// @throws Error      InvalidInput, naming the file; also if the picture is black
Environment readEnvironment(const std::filesystem::path& path, std::size_t max_pixels = kMaxPicturePixels);

}  // namespace droplet
