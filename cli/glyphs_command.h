// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "droplet/io/report.h"
#include "droplet/surface/textured_mesh.h"
#include "droplet/type/font.h"
#include "glyphs_options.h"

namespace cli {

/// Describes a font, as the options take it, for the report.
droplet::TypeReport describe(const droplet::Font& font, const GlyphsOptions& options);

/// Reads the line that the text follows, if one is given.
/// @throws droplet::Error InvalidInput, InvalidArgument, naming the option
void readPath(GlyphsOptions& options);

/// Makes a text on an object as large as a picture would be, with the line that it follows, unless its size is given.
void fitToObject(GlyphsOptions& options, const droplet::TexturedMesh& object, const droplet::Font& font,
                 const std::string& text);

/// Letters of a text that are not set.
struct LeftOut {
    const std::vector<char32_t>& missing;  ///< as in TextLayout
    std::size_t beyond = 0;                ///< the same
};

/// @throws droplet::Error InvalidInput, unless there is ink
void requireInk(bool has_ink, const LeftOut& left_out, const GlyphsOptions& options);

/// Adds warnings about letters that are not set.
void noteLeftOut(const LeftOut& left_out, GlyphsOptions& options);

/// Runs `droplet-shape glyphs`: one droplet file from a text, or one for each glyph of a font.
/// @param argv            `glyphs` and its arguments
/// @return                exit code
/// @throws droplet::Error on any failure
int runGlyphs(int argc, const char* const* argv);

}  // namespace cli
