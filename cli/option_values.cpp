// SPDX-License-Identifier: GPL-3.0-or-later
#include "option_values.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <numeric>
#include <system_error>

namespace cli {
namespace {

/// Number of single-letter changes that turn one word into the other (Levenshtein).
std::size_t distance(std::string_view a, std::string_view b)
{
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i + 1;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
        }
    }
    return row.back();
}

}  // namespace

void refuse(const std::string& message)
{
    throw droplet::Error(droplet::ErrorCode::InvalidArgument, message);
}

void refuse(const Given& given, const std::string& constraint)
{
    refuse(fmt::format("{}: '{}' must be {}", given.subject, given.text, constraint));
}

std::string nearestName(std::string_view word, const std::vector<std::string>& names)
{
    constexpr std::size_t kFarthest = 2;  // more changes make another word
    std::string best;
    std::size_t min = kFarthest + 1;
    for (const std::string& name : names) {
        const std::size_t changes = distance(name, word);
        if (changes < min) {
            min = changes;
            best = name;
        }
    }
    return best;
}

double quantity(const Given& given, const Range& range)
{
    const double value = forOption(given.subject, [&] { return droplet::parseQuantity(given.text, range.dimension); });
    // Conversion of units rounds, and 179deg itself must pass.
    const double slack = 4 * std::numeric_limits<double>::epsilon();
    if (value < range.min - slack * std::abs(range.min) || value > range.max + slack * std::abs(range.max)) {
        refuse(given, range.allowed);
    }
    return std::clamp(value, range.min, range.max);
}

std::optional<double> finiteNumber(std::string_view text)
{
    double value = 0.0;
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (failure != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) {
        return std::nullopt;
    }
    return value;
}

std::size_t count(const Given& given, const CountRange& range)
{
    std::string_view digits = given.text;
    double factor = 1.0;
    if (!digits.empty() && (digits.back() == 'k' || digits.back() == 'M')) {
        factor = digits.back() == 'k' ? 1e3 : 1e6;
        digits.remove_suffix(1);
    }
    const double value = finiteNumber(digits).value_or(-1.0) * factor;
    if (value < static_cast<double>(range.min) || value > static_cast<double>(range.max) ||
        value != std::floor(value)) {
        refuse(given, fmt::format("a whole number from {} to {}", range.min, range.max_text));
    }
    return static_cast<std::size_t>(value);
}

double plainOr(const Given& given, const Range& range)
{
    if (const auto plain = finiteNumber(given.text)) {
        if (*plain < range.min || *plain > range.max) {
            refuse(given, range.allowed);
        }
        return *plain;
    }
    return quantity(given, range);
}

std::vector<Given> partsOf(const Given& given)
{
    std::vector<Given> parts;
    std::string_view rest = given.text;
    for (;;) {
        const std::size_t comma = rest.find(',');
        parts.push_back({std::string(rest.substr(0, comma)), given.subject});
        if (comma == std::string_view::npos) {
            return parts;
        }
        rest.remove_prefix(comma + 1);
    }
}

droplet::Vec3 vector(const Given& given, const Range& range)
{
    const std::vector<Given> parts = partsOf(given);
    if (parts.size() != 3) {
        refuse(given, "three numbers x,y,z");
    }
    const double x = plainOr(parts[0], range);
    const double y = plainOr(parts[1], range);
    const double z = plainOr(parts[2], range);
    return {x, 0.0 - z, y};
}

droplet::Vec3 direction(const Given& given)
{
    constexpr Range kNumber{droplet::Dimension::Length, -1e6, 1e6, "three numbers x,y,z from -1e6 to 1e6"};
    const droplet::Vec3 d = vector(given, kNumber);
    if (!(length(d) > 0.0)) {
        refuse(given, "a direction x,y,z other than 0,0,0");
    }
    return (1.0 / length(d)) * d;
}

}  // namespace cli
