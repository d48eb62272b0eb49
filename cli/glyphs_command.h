// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace cli {

/// Runs `droplet-shape glyphs`: a line of type, or glyphs of a font, a file each.
/// @param argv            `glyphs` and what follows it
/// @return                exit code
/// @throws droplet::Error for whatever goes wrong
int runGlyphs(int argc, const char* const* argv);

}  // namespace cli
