// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "type/font_face.h"

namespace droplet {

/// A line of glyphs, from left to right; lengths in ems.
struct LaidLine {
    std::vector<ShapedGlyph> glyphs;
    double advance = 0.0;
    bool leftward = false;  ///< whether it starts on the right
};

/// @param text  one line
LaidLine layLine(const FontFace& face, const std::u32string& text);

}  // namespace droplet
