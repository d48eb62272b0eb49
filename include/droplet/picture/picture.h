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

/// What lies over a picture, and how much of it is hidden.
/// Invariant: `rgba.size() == 4 * width * height`, width and height ≥ 1.
struct Layer {
    int width = 0;                   ///< [px]
    int height = 0;                  ///< [px]
    std::vector<std::uint8_t> rgba;  ///< sRGB and straight alpha, four bytes a pixel, row by row from the top left

    friend bool operator==(const Layer&, const Layer&) = default;

    /// @throws Error InvalidArgument
    void validate() const;
};

/// A layer over a picture, mixed by alpha in sRGB levels as programs for video do, rounded to the nearest.
/// @param layer   valid
/// @param below   valid, of the same size
/// @throws Error  InvalidArgument
Picture over(const Layer& layer, const Picture& below);

/// Numbers for each pixel that are no colours.
/// Invariant: `levels.size() == channels * width * height`, width and height ≥ 1, channels 1 or 3.
struct DeepPicture {
    int width = 0;                      ///< [px]
    int height = 0;                     ///< [px]
    int channels = 1;                   ///< 1: grey; 3: red, green and blue
    std::vector<std::uint16_t> levels;  ///< row by row from the top left

    friend bool operator==(const DeepPicture&, const DeepPicture&) = default;

    /// @throws Error InvalidArgument
    void validate() const;
};

/// Numbers for each pixel, as they are.
/// Invariant: `values.size() == channels * width * height`, width and height ≥ 1, channels 1 or 3.
struct FloatPicture {
    int width = 0;              ///< [px]
    int height = 0;             ///< [px]
    int channels = 1;           ///< 1: grey; 3: red, green and blue
    std::vector<float> values;  ///< row by row from the top left

    friend bool operator==(const FloatPicture&, const FloatPicture&) = default;

    /// @throws Error InvalidArgument
    void validate() const;
};

/// What is spent on making a PNG small.
enum class PngEffort {
    Small,  ///< as small as zlib makes it at its own default
    Fast,   ///< several times as fast, and about a fifth larger: for frame after frame
};

/// Writes a picture as PNG: 8-bit RGB, 8-bit RGBA, or 16-bit without a colour space, without a date.
///
/// Guarantees: the same picture gives the same bytes; the stream is left failed if it did not take everything.
/// @param picture  valid
/// @return         bytes handed to the stream
/// @throws Error   InvalidArgument
std::uint64_t writePng(const Picture& picture, std::ostream& out, PngEffort effort = PngEffort::Small);
std::uint64_t writePng(const Layer& layer, std::ostream& out, PngEffort effort = PngEffort::Small);
std::uint64_t writePng(const DeepPicture& picture, std::ostream& out, PngEffort effort = PngEffort::Small);

/// Writes numbers as OpenEXR, 32-bit floats without loss, by OpenCV.
/// @param picture  valid
/// @return         bytes handed to the stream
/// @throws Error   InvalidArgument; OutputFailed: OpenCV's module is not installed
std::uint64_t writeExr(const FloatPicture& picture, std::ostream& out);

/// A picture scaled so that it just covers a frame, its middle kept and what sticks out cut off. What shrinks is
/// averaged, what grows is interpolated; a picture of the frame's size is returned as it is.
/// @param picture        valid
/// @param width, height  of the frame [px] 1 … 8192
/// @throws Error         InvalidArgument
Picture covering(const Picture& picture, int width, int height);

/// The largest picture decoded unless said otherwise: 8192 × 8192 pixels.
inline constexpr std::size_t kMaxPicturePixels = std::size_t{1} << 26;

/// Decodes a picture of any format a mask can have, upright, in 8-bit RGB as stored (no colour profile); what of it is
/// transparent shows white.
/// @param encoded     the file's bytes
/// @param max_pixels  larger ones are refused by their header
/// @throws Error      InvalidInput
Picture decodePicture(std::span<const std::byte> encoded, std::size_t max_pixels = kMaxPicturePixels);

/// Reads a picture from a file, as decodePicture does.
/// @throws Error InvalidInput, naming the file
Picture readPicture(const std::filesystem::path& path, std::size_t max_pixels = kMaxPicturePixels);

}  // namespace droplet
