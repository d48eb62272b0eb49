// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "droplet/vector.h"

namespace droplet {

/// Colour in sRGB, as in style sheets.
struct CssColour {
    std::uint8_t red = 0;    ///< 0 … 255
    std::uint8_t green = 0;  ///< 0 … 255
    std::uint8_t blue = 0;   ///< 0 … 255

    /// Whether all three channels are equal.
    friend bool operator==(const CssColour&, const CssColour&) = default;
};

/// Reads `#rgb`, `#rrggbb` or one of the 148 names of CSS Color Module Level 4, in upper or lower case.
/// @throws Error InvalidArgument, with the text and the allowed forms
CssColour parseCssColour(std::string_view text);

/// The colour as `#rrggbb`.
std::string text(const CssColour& colour);

/// Name of a colour in files, where `#` may begin a comment: the first of its CSS names, such as `red`, or `rrggbb`.
std::string fileName(const CssColour& colour);

/// Linear light of a colour, 0 … 1 in every channel.
Vec3 linearLight(const CssColour& colour);

}  // namespace droplet
