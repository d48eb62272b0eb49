// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace droplet {

/// Text with entities of XML in place of special characters.
/// @param special  those that have a meaning at its place, of `&`, `<`, `>` and `"`
inline std::string xmlText(std::string_view text, std::string_view special)
{
    std::string result;
    for (const char c : text) {
        if (special.find(c) == std::string_view::npos) {
            result += c;
        } else {
            result += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : "&quot;";
        }
    }
    return result;
}

}  // namespace droplet
