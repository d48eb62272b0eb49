// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fmt/core.h>

#include <string>

namespace droplet {

/// Number for a message: in its shortest form, with that many significant digits, never −0.
inline std::string numberText(double value, int digits = 6)
{
    return fmt::format("{:.{}g}", value + 0.0, digits);
}

}  // namespace droplet
