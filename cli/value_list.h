// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "option_values.h"

namespace cli {

/// No list is longer.
inline constexpr std::size_t kMaxValues = 1'000'000;

/// Values in a list, each a quantity or a range with its step: `10uL,20uL`, `10..100uL:10`, `0..16m/s:0.25`,
/// `1,2,5..20uL:5`. A unit may be written once for all; a number without one has that of the next number that has, or
/// of the last. A range holds its start, and its end if steps lead there.
///
/// Numbers of one unit are those that would have been written out: `10..100uL:10` has exactly what `30uL` is.
/// @return the values in SI units, in the order written, at least one
/// @throws droplet::Error InvalidArgument: no such list, a value beyond the range's bounds, over kMaxValues
std::vector<double> quantities(const Given& given, const Range& range);

/// Bounds of numbers without a unit, and what a message says of them.
struct NumberRange {
    double min;
    double max;
    const char* words;
};

/// The same of numbers without a unit: `0.05,0.5`, `0..1:0.1`.
std::vector<double> numbers(const Given& given, const NumberRange& range);

/// One number without a unit.
double number(const Given& given, const NumberRange& range);

}  // namespace cli
