// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "image/image.h"
#include "image/svg/drawn_line.h"
#include "image/svg_drawing.h"

namespace droplet {

/// Drawing of a page, and its pixels: premultiplied ARGB, row by row.
struct DrawnSvg {
    SvgDrawing drawing;
    std::shared_ptr<const std::uint32_t> pixels;
};

/// Draws a page. Nothing that it refers to is read.
/// @param tags    tags in the text, as in SvgRequest
/// @throws Error InvalidInput, as decodeSvg
DrawnSvg drawSvg(std::span<const std::byte> text, std::size_t tags, const DecodeOptions& options);

/// Text of a drawing, with limits that hold for all that is done with it.
struct SvgText {
    std::vector<std::byte> inflated;  ///< empty unless the file was compressed
    std::span<const std::byte> text;
    std::size_t tags = 0;
};

/// Text of an SVG file.
/// @throws Error InvalidInput, as decodeSvg
SvgText svgText(std::span<const std::byte> encoded);

/// Finds the line that text may follow; nothing is drawn.
/// @throws Error InvalidInput: no XML, or the limits
SvgLine lineOfSvg(const SvgText& drawing, const DrawingLimits& limits);

/// @throws Error InvalidInput: "SVG image " and the detail
[[noreturn]] void throwSvgRefused(const std::string& detail);

}  // namespace droplet
