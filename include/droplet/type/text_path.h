// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "droplet/vector.h"

namespace droplet {

/// Line of a drawing, for text to follow.
struct TextPath {
    std::vector<Vec2> points;  ///< as TextOptions::path [m]; the origin is the page's, y up
    std::size_t others = 0;    ///< further lines of the drawing, which might be meant as well
};

/// Finds the line of an SVG drawing, compressed or not, that its own text follows (`textPath`), or else the longest of
/// its displayed paths and basic shapes, each part that begins with a move by itself. Colours do not matter.
///
/// Lengths are those of the drawing; a px and a number without a unit on a page without any are 1/96 inch, as in CSS.
/// @param encoded     bytes of an SVG file
/// @param page_width  width that the page gets instead of its own [m], > 0
/// @throws Error      InvalidInput: not such a drawing, or it has no line; InvalidArgument: page_width
TextPath decodeTextPath(std::span<const std::byte> encoded, std::optional<double> page_width = {});

/// Reads a file as decodeTextPath() does. Errors name the file.
/// @throws Error  as decodeTextPath(); InvalidInput: the file cannot be read
TextPath readTextPath(const std::filesystem::path& path, std::optional<double> page_width = {});

}  // namespace droplet
