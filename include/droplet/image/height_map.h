// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

namespace droplet {

/// A picture whose brightness is height.
/// Invariant: `levels.size() == width * height`, width and height ≥ 1, levels finite.
struct HeightMap {
    int width = 0;              ///< [px]
    int height = 0;             ///< [px]
    std::vector<float> levels;  ///< row by row from the top left; 0 black … 1 white, or as stored in floats
    bool in_floats = false;     ///< the picture's samples are floating-point numbers, of no range of their own

    [[nodiscard]] float at(int x, int y) const
    {
        return levels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
    }

    /// Guarantees: returns only when the invariant holds.
    /// @throws Error InvalidInput
    void validate() const;
};

/// Largest picture decoded: 16384 × 16384.
inline constexpr std::size_t kMaxHeightMapPixels = std::size_t{1} << 28;

/// Reads a height map from an encoded image of any kind a mask is read from, by its luma in front of black; or from a
/// TIFF, OpenEXR or Radiance HDR of floating-point samples, by their luma. Turned upright if its EXIF data say so.
///
/// The size in the file's header is checked before any pixel is decoded or memory for it taken.
/// @param encoded     the file's bytes
/// @param max_pixels  largest size
/// @throws Error      InvalidInput: not an image, truncated, larger than max_pixels, or a sample that is not a
///                    finite number, with its place
HeightMap decodeHeightMap(std::span<const std::byte> encoded, std::size_t max_pixels = kMaxHeightMapPixels);

/// Reads a height map from a file, as decodeHeightMap does.
/// @throws Error InvalidInput: missing, unreadable, a directory, empty, or as decodeHeightMap
HeightMap readHeightMap(const std::filesystem::path& path, std::size_t max_pixels = kMaxHeightMapPixels);

}  // namespace droplet
