// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string_view>

namespace droplet {

/// The page around what each droplet puts into it: title, content and model come between these. Made at build time.
extern const std::array<std::string_view, 4> kPageParts;

}  // namespace droplet
