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
};

/// Reads strokes from an encoded picture: light ones are liquid and dark ones dry; what is transparent, or of a middle
/// grey, is open. Light is luma from three quarters of white on, dark is up to one quarter.
/// @param encoded  as decodeMask() reads it, without drawings
/// @throws Error   InvalidInput
Seeds decodeSeeds(std::span<const std::byte> encoded);

/// Reads strokes from a file, as decodeSeeds() does.
/// @throws Error InvalidInput, naming the file
Seeds readSeeds(const std::filesystem::path& path);

}  // namespace droplet
