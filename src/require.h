// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <type_traits>

#include "droplet/error.h"
#include "number_text.h"

namespace droplet {

/// Throws an error about a field: "field is value, must be constraint".
/// @param field       name with its owner: "wiper.stroke"; any type that libfmt takes
/// @param constraint  what the value must be, with its unit: "finite and more than 0 s"
template <typename Field, typename Value, typename Constraint>
[[noreturn]] void refuseValue(const Field& field, const Value& value, const Constraint& constraint)
{
    const auto text = [](const auto& of) {
        if constexpr (std::is_floating_point_v<std::remove_cvref_t<decltype(of)>>) {
            return numberText(of);
        } else {
            return fmt::format("{}", of);
        }
    };
    throw Error(ErrorCode::InvalidArgument, fmt::format("{} is {}, must be {}", field, text(value), constraint));
}

/// Throws refuseValue() unless the condition holds.
template <typename Value>
void require(bool holds, const char* field, const Value& value, const char* constraint)
{
    if (!holds) {
        refuseValue(field, value, constraint);
    }
}

/// Throws refuseValue() unless the value is from `min` to `max`.
inline void requireWithin(const char* field, int value, int min, int max)
{
    if (value < min || value > max) {
        refuseValue(field, value, "from " + std::to_string(min) + " to " + std::to_string(max));
    }
}

}  // namespace droplet
