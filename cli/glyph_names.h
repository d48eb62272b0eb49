// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "droplet/type/font.h"

namespace cli {

/// File names for all glyphs of a font, by glyph: the glyphs' own names, made safe.
///
/// - An underscore follows every capital, so that `A_` and `a` differ also if case is ignored.
/// - Characters other than letters, digits, hyphens, dots and underscores, and a leading dot, become underscores.
/// - Device names of Windows get an underscore in front.
/// - If several names become the same, all but the first get a hyphen and the glyph's index.
///
/// A name does not depend on which glyphs are chosen.
std::vector<std::string> fileNames(const droplet::Font& font);

/// Safe name of one glyph, by the first three rules.
std::string safeName(const std::string& name);

}  // namespace cli
