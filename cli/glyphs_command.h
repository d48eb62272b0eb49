// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace cli {

/// Runs `droplet-shape glyphs`: one droplet file from a text, or one for each glyph of a font.
/// @param argv            `glyphs` and its arguments
/// @return                exit code
/// @throws droplet::Error on any failure
int runGlyphs(int argc, const char* const* argv);

}  // namespace cli
