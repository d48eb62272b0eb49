// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace droplet {

/// What somebody says about a pixel.
enum class Seed : std::uint8_t { Open, Dry, Liquid };

/// Strokes on a photograph that say what is liquid and what is dry.
struct Seeds {
    int width = 0;             ///< [px]
    int height = 0;            ///< [px]
    std::vector<Seed> pixels;  ///< row by row from the top left
    double varied = 0.0;       ///< share of the picture that is open, but neither transparent nor its most common grey
};

/// Seeds::varied of pictures that are not strokes alone. Photographs and renderings have 0.1 to 0.6, strokes below
/// 0.01.
inline constexpr double kVariedSeeds = 0.05;

/// Reads strokes from an encoded picture: light ones are liquid and dark ones dry; what is transparent, or of a middle
/// grey, is open. Light is luma from three quarters of white on, dark is up to one quarter.
/// @param encoded  as decodeMask() reads it, without drawings
/// @throws Error   InvalidInput
Seeds decodeSeeds(std::span<const std::byte> encoded);

/// Reads strokes from a file, as decodeSeeds() does.
/// @throws Error InvalidInput, naming the file
Seeds readSeeds(const std::filesystem::path& path);

}  // namespace droplet
