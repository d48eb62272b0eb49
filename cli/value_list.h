// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "option_values.h"

namespace cli {

/// Limit of a list's values.
inline constexpr std::size_t kMaxValues = 1'000'000;

/// Parses a list of quantities and ranges with a step: `10uL,20uL`, `10..100uL:10`, `0..16m/s:0.25`, `1,2,5..20uL:5`. A
/// number without a unit has the unit of the next number with one, or of the last. A range contains its start, and its
/// end if a step meets it.
///
/// Values of a range are exactly those of single numbers: `10..100uL:10` contains exactly `30uL`.
/// @return                values in SI units, in the order written, at least one
/// @throws droplet::Error InvalidArgument: not a list, a value out of range, more than kMaxValues
std::vector<double> quantities(const Given& given, const Range& range);

/// Allowed range of a number without a unit.
struct NumberRange {
    double min;
    double max;
    const char* allowed;  ///< range in words, for messages
};

/// Parses a list of numbers without a unit: `0.05,0.5`, `0..1:0.1`.
std::vector<double> numbers(const Given& given, const NumberRange& range);

/// Parses one number without a unit.
double number(const Given& given, const NumberRange& range);

}  // namespace cli
