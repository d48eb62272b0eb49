// SPDX-License-Identifier: GPL-3.0-or-later
#include "value_kind.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

namespace cli {
namespace {

using Named = std::pair<std::string_view, ValueKind>;

constexpr std::array kKinds{
    Named{"LENGTH", {"length", "m"}},
    Named{"L", {"length", "m"}},
    Named{"AREA", {"area", "m2"}},
    Named{"VOLUME", {"volume", "m3"}},
    Named{"V|every", {"volume", "m3"}},
    Named{"ANGLE", {"angle", "rad"}},
    Named{"ANGLE/s", {"spin", "rad/s"}},
    Named{"S", {"tension", "N/m"}},
    Named{"TENSION", {"tension", "N/m"}},
    Named{"D", {"density", "kg/m3"}},
    Named{"G", {"acceleration", "m/s2"}},
    Named{"ACCELERATION", {"acceleration", "m/s2"}},
    Named{"SPEED", {"speed", "m/s"}},
    Named{"turned|projected|SPEED", {"speed", "m/s"}},
    Named{"DURATION", {"duration", "s"}},
    Named{"TIME", {"duration", "s"}},
    Named{"RAINFALL", {"rainfall", "m/s"}},
    Named{"V|artistic|wedge", {"viscosity", "Pa.s"}},
    Named{"SHARE", {"share"}},
    Named{"N", {"count"}},
    Named{"N|FILE", {"count"}},
    Named{"K|auto", {"count"}},
    Named{"F", {"number"}},
    Named{"C", {"number"}},
    Named{"P", {"number"}},
    Named{"NUMBER", {"number"}},
    Named{"RATE", {"number"}},
    Named{"STOPS", {"number"}},
    Named{"OPEN", {"open"}},
    Named{"FILE", {"path"}},
    Named{"OUTPUT", {"path"}},
    Named{"OBJECT", {"path"}},
    Named{"PATH", {"path"}},
    Named{"PICTURE", {"path"}},
    Named{"splash|wave|dam|pour|FILE.toml", {"path"}},
    Named{"left|right|top|bottom|middle|X,Y", {"text"}},
    Named{"GROUND", {"ground"}},
    Named{"COLOUR", {"text"}},
    Named{"NAME", {"text"}},
    Named{"FAMILY", {"text"}},
    Named{"SET", {"text"}},
    Named{"TEXT", {"text"}},
    Named{"RANGE", {"range"}},
    Named{"SIZE", {"size", "px"}},
    Named{"AXIS", {"axes"}},
    Named{"X,Y,Z", {"vector", "m or m/s"}},
    Named{"X,Y,Z,RATE", {"texts"}},
    Named{"NAME:VALUES", {"texts"}},
    Named{"BAND", {"band", "m/s"}},
    Named{"VOLUMES", {"volumes", "m3"}},
    Named{"SPEEDS", {"speeds", "m/s"}},
    Named{"ANGLES", {"angles", "rad"}},
    Named{"NUMBERS", {"numbers"}},
    Named{"DIRECTION", {"angles_of_place", "rad"}},
    Named{"PLACE", {"lengths_of_place", "m"}},
};

}  // namespace

std::optional<ValueKind> valueKind(std::string_view name)
{
    const auto named = std::find_if(kKinds.begin(), kKinds.end(), [&](const Named& one) { return one.first == name; });
    if (named != kKinds.end()) {
        return named->second;
    }
    const bool are_words =
        name.find('|') != std::string_view::npos &&
        std::none_of(name.begin(), name.end(), [](char c) { return std::isupper(static_cast<unsigned char>(c)) != 0; });
    return are_words ? std::optional(ValueKind{"words"}) : std::nullopt;
}

}  // namespace cli
