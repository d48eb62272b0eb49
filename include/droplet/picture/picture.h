// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <span>
#include <vector>

namespace droplet {

/// A picture as a screen shows it.
/// Invariant: `rgb.size() == 3 * width * height`, width and height ≥ 1.
struct Picture {
    int width = 0;                  ///< [px]
    int height = 0;                 ///< [px]
    std::vector<std::uint8_t> rgb;  ///< sRGB, three bytes a pixel, row by row from the top left

    friend bool operator==(const Picture&, const Picture&) = default;

    /// Guarantees: returns only when the invariant holds.
    /// @throws Error InvalidArgument
    void validate() const;
};

/// Writes a picture as PNG: 8-bit RGB, without a date.
///
/// Guarantees: the same picture gives the same bytes; the stream is left failed if it did not take everything.
/// @param picture  valid
/// @return         bytes handed to the stream
/// @throws Error   InvalidArgument
std::uint64_t writePng(const Picture& picture, std::ostream& out);

/// The largest picture decoded unless said otherwise: 8192 × 8192 pixels.
inline constexpr std::size_t kMostPicturePixels = std::size_t{1} << 26;

/// Decodes a picture of any format a mask can have, upright, in 8-bit RGB as stored (no colour profile); what of it is
/// transparent shows white.
/// @param encoded     the file's bytes
/// @param max_pixels  larger ones are refused by their header
/// @throws Error      InvalidInput
Picture decodePicture(std::span<const std::byte> encoded, std::size_t max_pixels = kMostPicturePixels);

/// Reads a picture from a file, as decodePicture does.
/// @throws Error InvalidInput, naming the file
Picture readPicture(const std::filesystem::path& path, std::size_t max_pixels = kMostPicturePixels);

}  // namespace droplet
