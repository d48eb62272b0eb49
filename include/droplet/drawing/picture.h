// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <span>
#include <vector>

namespace droplet {

/// Picture of 8-bit sRGB pixels.
/// Invariant: `rgb.size() == 3 * width * height`, width and height ≥ 1.
struct Picture {
    int width = 0;                  ///< [px]
    int height = 0;                 ///< [px]
    std::vector<std::uint8_t> rgb;  ///< three bytes per pixel, row by row from the top left

    friend bool operator==(const Picture&, const Picture&) = default;  ///< equal pixels

    /// Guarantees: returns only if the invariant holds.
    /// @throws Error InvalidArgument
    void validate() const;
};

/// Picture with transparency, to put over another one.
/// Invariant: `rgba.size() == 4 * width * height`, width and height ≥ 1.
struct Layer {
    int width = 0;                   ///< [px]
    int height = 0;                  ///< [px]
    std::vector<std::uint8_t> rgba;  ///< sRGB and straight alpha, four bytes per pixel, row by row from the top left

    friend bool operator==(const Layer&, const Layer&) = default;  ///< equal pixels

    /// Guarantees: returns only if the invariant holds.
    /// @throws Error InvalidArgument
    void validate() const;
};

/// Puts a layer over a picture: mixes sRGB levels by alpha, as video programs do, rounded to the nearest.
/// @param layer   valid
/// @param below   valid, of the layer's size
/// @throws Error  InvalidArgument
Picture over(const Layer& layer, const Picture& below);

/// 16-bit data for each pixel, without a colour space.
/// Invariant: `levels.size() == channels * width * height`, width and height ≥ 1, channels 1 or 3.
struct DeepPicture {
    int width = 0;                      ///< [px]
    int height = 0;                     ///< [px]
    int channels = 1;                   ///< 1: grey; 3: red, green and blue
    std::vector<std::uint16_t> levels;  ///< row by row from the top left

    friend bool operator==(const DeepPicture&, const DeepPicture&) = default;  ///< equal pixels

    /// Guarantees: returns only if the invariant holds.
    /// @throws Error InvalidArgument
    void validate() const;
};

/// Floating-point data for each pixel.
/// Invariant: `values.size() == channels * width * height`, width and height ≥ 1, channels 1 or 3.
struct FloatPicture {
    int width = 0;              ///< [px]
    int height = 0;             ///< [px]
    int channels = 1;           ///< 1: grey; 3: red, green and blue
    std::vector<float> values;  ///< row by row from the top left

    friend bool operator==(const FloatPicture&, const FloatPicture&) = default;  ///< equal values

    /// Guarantees: returns only if the invariant holds.
    /// @throws Error InvalidArgument
    void validate() const;
};

/// Effort of PNG compression.
enum class PngEffort {
    Small,  ///< zlib's default level
    Fast,   ///< several times as fast, about a fifth larger: for sequences of frames
};

/// Writes a picture as 8-bit RGB PNG without a date.
///
/// Guarantees: the same picture gives the same bytes; the stream is left failed if it did not take everything.
/// @param picture  valid
/// @param out      stream of bytes
/// @param effort   speed or size
/// @return         bytes handed to the stream
/// @throws Error   InvalidArgument
std::uint64_t writePng(const Picture& picture, std::ostream& out, PngEffort effort = PngEffort::Small);
/// Writes a layer as 8-bit RGBA PNG, otherwise like a picture.
std::uint64_t writePng(const Layer& layer, std::ostream& out, PngEffort effort = PngEffort::Small);
/// Writes data as 16-bit PNG without a colour space, otherwise like a picture.
std::uint64_t writePng(const DeepPicture& picture, std::ostream& out, PngEffort effort = PngEffort::Small);

/// Writes floating-point data as OpenEXR with 32-bit floats, without loss, by OpenCV.
/// @param picture  valid
/// @param out      stream of bytes
/// @return         bytes handed to the stream
/// @throws Error   InvalidArgument; OutputFailed if OpenCV is not installed or cannot encode
std::uint64_t writeExr(const FloatPicture& picture, std::ostream& out);

/// Scales a picture so that it just covers a frame, and cuts off equal parts on both sides. Pixels are averaged when
/// the picture shrinks and interpolated when it grows; a picture of the frame's size is returned unchanged.
/// @param picture        valid
/// @param width, height  of the frame [px] 1 … 8192
/// @throws Error         InvalidArgument
Picture scaledToCover(const Picture& picture, int width, int height);

/// Default size limit of decoded pictures: 8192 × 8192 pixels.
inline constexpr std::size_t kMaxPicturePixels = std::size_t{1} << 26;

/// Decodes a picture of any format a mask can have, upright, as 8-bit RGB. Colour profiles are ignored; transparent
/// pixels are mixed with white.
/// @param encoded     bytes of the file
/// @param max_pixels  size limit, checked in the header
/// @throws Error      InvalidInput
Picture decodePicture(std::span<const std::byte> encoded, std::size_t max_pixels = kMaxPicturePixels);

/// The same with its transparency, unmixed.
Layer decodeLayer(std::span<const std::byte> encoded, std::size_t max_pixels = kMaxPicturePixels);

/// Reads a picture from a file, as decodePicture does.
/// @param path        file to read
/// @param max_pixels  size limit, checked in the header
/// @throws Error      InvalidInput, naming the file
Picture readPicture(const std::filesystem::path& path, std::size_t max_pixels = kMaxPicturePixels);

}  // namespace droplet
