// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

namespace droplet {

/// Picture whose brightness is height.
/// Invariant: `levels.size() == width * height`, width and height ≥ 1, levels finite.
struct HeightMap {
    int width = 0;              ///< [px]
    int height = 0;             ///< [px]
    std::vector<float> levels;  ///< row by row from the top left; 0 black … 1 white, or any finite value if in_floats
    bool in_floats = false;     ///< the picture's samples are floating-point numbers, of any range

    /// Level of the pixel in column x and row y, both from 0; the range is not checked.
    [[nodiscard]] float at(int x, int y) const
    {
        return levels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
    }

    /// Checks the invariant.
    /// @throws Error InvalidInput if it does not hold
    void validate() const;
};

/// Most pixels of a height map: 16384 × 16384.
inline constexpr std::size_t kMaxHeightMapPixels = std::size_t{1} << 28;

/// Reads a height map from an encoded image: the luma in front of black of any format that decodeMask() reads, or the
/// luma of a TIFF, OpenEXR or Radiance HDR with floating-point samples. The image is turned upright as its EXIF data
/// say.
///
/// The size in the file's header is checked before memory is allocated or a pixel decoded.
/// @param encoded     the file's bytes
/// @param max_pixels  most pixels that are decoded
/// @throws Error      InvalidInput: not an image, truncated, larger than max_pixels, or a sample that is not a finite
///                    number, with its place
HeightMap decodeHeightMap(std::span<const std::byte> encoded, std::size_t max_pixels = kMaxHeightMapPixels);

/// Reads a height map from a file, as decodeHeightMap does.
/// @throws Error InvalidInput: missing, unreadable, a directory, empty, or as decodeHeightMap
HeightMap readHeightMap(const std::filesystem::path& path, std::size_t max_pixels = kMaxHeightMapPixels);

}  // namespace droplet
