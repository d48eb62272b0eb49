// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "batch_options.h"
#include "droplet/type/font.h"
#include "droplet/type/glyph.h"
#include "option_values.h"
#include "shape_options.h"

namespace cli {

/// Which glyphs of a font are made into a file each.
struct GlyphChoice {
    std::optional<std::vector<char32_t>> characters;  ///< all glyphs if empty
};

/// Glyphs of a font, a file each.
struct GlyphSetOptions {
    GlyphChoice choice;
    Given output;               ///< how paths of outputs are made
    std::optional<Given> json;  ///< likewise of reports
    BatchOptions batch;
};

/// A job of `droplet-shape glyphs`: everything in range, nothing looked up on disk yet but the configuration file and
/// a charset's.
struct GlyphsOptions {
    std::string font;
    droplet::FontOptions face;
    droplet::TextOptions type;           ///< its glyph options hold for sets of glyphs, too
    std::optional<std::string> text;     ///< one output
    std::optional<GlyphSetOptions> set;  ///< if there is no text, or neither where the font is to be listed
    bool sized = false;                  ///< whether the em is given
    bool equal_height = false;
    ShapeOptions shape;  ///< all that a text's output and each glyph's share
};

/// Reads the command line of `droplet-shape glyphs`.
/// @return                the job, or text for standard output if --help or --version asked for it
/// @throws droplet::Error InvalidArgument, naming option, value and what is allowed
std::variant<GlyphsOptions, std::string> parseGlyphs(int argc, const char* const* argv);

}  // namespace cli
