// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "droplet/type/font.h"

namespace cli {

/// Names of files for all glyphs of a font, by glyph: the glyphs' own, made safe.
///
/// An underscore follows every capital, so that `A_` and `a` are two files also where case does not count; characters
/// other than letters, digits, hyphens, dots and underscores, and a dot in front, become underscores; names that
/// Windows keeps for devices get one in front. Of glyphs whose names come out the same, all but the first have a hyphen
/// and their index added. The same for every choice of glyphs.
std::vector<std::string> fileNames(const droplet::Font& font);

/// One such name, before it is told apart from others.
std::string safeName(const std::string& name);

}  // namespace cli
