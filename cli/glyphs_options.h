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

/// Selection of glyphs.
struct GlyphChoice {
    std::optional<std::vector<char32_t>> characters;  ///< empty for all glyphs
};

/// Options for one file per glyph.
struct GlyphSetOptions {
    GlyphChoice choice;
    std::optional<std::string> charset_file;  ///< path of the file of characters
    Given output;                             ///< pattern of the output paths
    std::optional<Given> json;                ///< pattern of the reports' paths
    BatchOptions batch;
};

/// Options of `droplet-shape glyphs`. All values are in range; no file but the configuration file and that of --charset
/// has been read.
struct GlyphsOptions {
    std::string font;
    droplet::FontOptions face;
    droplet::TextOptions type;           ///< its glyph options apply to sets of glyphs, too
    std::optional<std::string> text;     ///< text for one output; if neither text nor set is given, the font is listed
    std::optional<GlyphSetOptions> set;  ///< glyphs for one output each
    std::optional<std::string> path;     ///< file of the drawing whose line the text follows; not read yet
    std::optional<double> path_width;    ///< width of that drawing's page [m]
    bool sized = false;                  ///< whether --em is given
    bool equal_height = false;
    ShapeOptions shape;  ///< options for every output
};

/// Reads the command line of `droplet-shape glyphs`.
/// @return                the options, or the text that --help or --version prints
/// @throws droplet::Error InvalidArgument, naming option, value and what is allowed
std::variant<GlyphsOptions, std::string> parseGlyphs(int argc, const char* const* argv);

}  // namespace cli
