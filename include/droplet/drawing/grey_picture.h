// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <iosfwd>
#include <vector>

#include "droplet/drawing/picture.h"

namespace droplet {

/// 8-bit data for each pixel, without a colour space.
/// Invariant: `levels.size() == width * height`, width and height ≥ 1.
struct GreyPicture {
    int width = 0;                     ///< [px]
    int height = 0;                    ///< [px]
    std::vector<std::uint8_t> levels;  ///< row by row from the top left

    /// Guarantees: returns only if the invariant holds.
    /// @throws Error InvalidArgument
    void validate() const;
};

/// Writes data as 8-bit grey PNG without a colour space, otherwise like a Picture.
/// @throws Error InvalidArgument
std::uint64_t writePng(const GreyPicture& picture, std::ostream& out, PngEffort effort = PngEffort::Small);

/// Writes grey data with 8 bits if that loses nothing, else as a DeepPicture with 16.
/// @param picture  valid, with one channel
/// @param out      binary
/// @return         number of bytes
/// @throws Error   InvalidArgument
std::uint64_t writeShortestPng(const DeepPicture& picture, std::ostream& out);

}  // namespace droplet
