// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "option_values.h"
#include "value_list.h"

namespace cli {

/// Where the value of an option goes, and what it may be. into() makes it from a variable, which must outlive it, and
/// whose present value is the default.
struct OptionTarget {
    /// Reads a given value into the variable; empty for an option that the command reads by itself.
    /// @throws droplet::Error InvalidArgument, naming option, value and what is allowed
    std::function<void(const Given&)> read;
    std::string usual = {};                           ///< default value as text; empty if there is none
    std::string words = {};                           ///< all allowed words, `linear|exact`; empty for other values
    std::optional<std::array<double, 2>> range = {};  ///< least and greatest value, in SI units
};

/// Text of a quantity in the unit that makes it shortest: `20mm`, `0.5m/s2`, `25mm/h`.
/// @param value  in SI units
std::string quantityText(double value, droplet::Dimension dimension);

/// Text of a count: `500`, `40k`, `1M`.
std::string countText(std::size_t value);

OptionTarget into(double& value, const Range& range);
OptionTarget into(double& value, const NumberRange& range);
OptionTarget into(std::string& text);
/// Target without a variable, for an option that the command reads by itself: its range for --help=json.
/// @param min  least value, in SI units
/// @param max  greatest value, in SI units
OptionTarget within(double min, double max);
OptionTarget within(const Range& range);
/// The same target for an option whose default the help does not show, as it only switches something off.
OptionTarget withoutDefault(OptionTarget target);
/// Target of a random seed.
OptionTarget seedInto(std::uint64_t& seed);

/// Target of a whole number.
template <std::integral Value>
OptionTarget into(Value& value, const CountRange& range)
{
    return {[&value, range](const Given& given) { value = static_cast<Value>(count(given, range)); },
            countText(static_cast<std::size_t>(value)),
            {},
            std::array{static_cast<double>(range.min), static_cast<double>(range.max)}};
}

/// Target of a variable that is empty until the option is given.
template <typename Value, typename... Allowed>
OptionTarget into(std::optional<Value>& value, const Allowed&... allowed)
{
    Value usual = value.value_or(Value{});
    OptionTarget target = into(usual, allowed...);
    if (!value) {
        target.usual.clear();
    }
    target.read = [&value, allowed...](const Given& given) {
        Value read{};
        into(read, allowed...).read(given);
        value = std::move(read);
    };
    return target;
}

/// Target of a value that has a name; of an optional one, the default has a name only if it is among these.
template <typename Value>
OptionTarget into(Value& value, std::initializer_list<std::pair<const char*, std::type_identity_t<Value>>> known)
{
    OptionTarget target;
    for (const auto& [name, one] : known) {
        target.words += (target.words.empty() ? "" : "|") + std::string(name);
        if (one == value) {
            target.usual = name;
        }
    }
    target.read = [&value, known = std::vector(known)](const Given& given) { value = choiceOf(given, known); };
    return target;
}

}  // namespace cli
