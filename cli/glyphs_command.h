// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "droplet/io/report.h"
#include "droplet/type/font.h"
#include "glyphs_options.h"

namespace cli {

/// Describes a font, as the options take it, for the report.
droplet::TypeReport describe(const droplet::Font& font, const GlyphsOptions& options);

/// Runs `droplet-shape glyphs`: one droplet file from a text, or one for each glyph of a font.
/// @param argv            `glyphs` and its arguments
/// @return                exit code
/// @throws droplet::Error on any failure
int runGlyphs(int argc, const char* const* argv);

}  // namespace cli
