// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string_view>

namespace droplet {

/// Parts of the page; title, content and model of a droplet come between them. Made at build time.
extern const std::array<std::string_view, 4> kPageParts;

}  // namespace droplet
