// SPDX-License-Identifier: GPL-3.0-or-later
// Replaces the page in libraries built without it.
#include "io/page_parts.h"

namespace droplet {

const std::array<std::string_view, 4> kPageParts = {};

}  // namespace droplet
