// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace droplet {

/// A colour as style sheets write it, sRGB.
struct CssColour {
    std::uint8_t red = 0;
    std::uint8_t green = 0;
    std::uint8_t blue = 0;

    friend bool operator==(const CssColour&, const CssColour&) = default;
};

/// Reads `#rgb`, `#rrggbb` or one of the 148 names of CSS Color Module Level 4, in upper or lower case.
/// @throws Error InvalidArgument, naming the text and what is allowed
CssColour parseCssColour(std::string_view text);

/// The colour as `#rrggbb`.
std::string text(const CssColour& colour);

}  // namespace droplet
