// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <utility>

namespace droplet {

/// The lower and the higher of exactly two levels.
/// @param levels  of all pixels; any numbers
/// @return        none if there are fewer or more levels, or a NaN
template <typename Level>
std::optional<std::pair<Level, Level>> twoLevels(std::span<const Level> levels)
{
    const auto first = levels.begin();
    const auto second = std::find_if(first, levels.end(), [&](Level level) { return level != *first; });
    const bool has_two = second != levels.end() && std::all_of(second, levels.end(), [&](Level level) {
                             return level == *first || level == *second;
                         });
    return has_two ? std::optional(std::minmax({*first, *second})) : std::nullopt;
}

}  // namespace droplet
