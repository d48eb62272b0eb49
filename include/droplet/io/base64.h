// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace droplet {

/// Bytes as text of RFC 4648, section 4, with its padding.
/// @param bytes  any; of parts that each have a multiple of three bytes, the texts one after another are that of all
std::string base64(std::string_view bytes);

}  // namespace droplet
