// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "type/font_face.h"

namespace droplet {

/// Line of glyphs from left to right; lengths in ems.
struct TextLine {
    std::vector<ShapedGlyph> glyphs;
    double advance = 0.0;
    bool leftward = false;  ///< whether the line starts on the right
};

/// Sets one line of text.
/// @param text  without line feeds
TextLine layOutLine(const FontFace& face, const std::u32string& text);

}  // namespace droplet
