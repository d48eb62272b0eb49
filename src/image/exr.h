// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace droplet {

/// Pixels of 32-bit floats, row by row from the top left.
struct FloatPixels {
    int width = 0;
    int height = 0;
    int channels = 1;  ///< 1 grey; 3 red, green, blue
    std::span<const float> values;
};

/// Encodes pixels as an OpenEXR file with unchanged values, by OpenCV.
/// @throws Error OutputFailed: OpenCV is not installed, or cannot encode it
std::vector<std::byte> encodeExr(const FloatPixels& pixels);

}  // namespace droplet
