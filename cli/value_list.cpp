// SPDX-License-Identifier: GPL-3.0-or-later
#include "value_list.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <string>
#include <string_view>
#include <utility>

namespace cli {
namespace {

/// Number with its unit.
struct Piece {
    std::string number;
    std::string unit;
};

/// Item of a list: one value, or begin, end and step of a range.
using Item = std::vector<Piece>;

constexpr const char* kForm = "values such as 10,20,30 or a range with its step such as 0..10:0.5";

Piece pieceOf(const Given& given, std::string_view text)
{
    while (!text.empty() && text.front() == ' ') {
        text.remove_prefix(1);
    }
    while (!text.empty() && text.back() == ' ') {
        text.remove_suffix(1);
    }
    double value = 0.0;
    const auto [rest, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (failure == std::errc::invalid_argument) {
        refuse(given, kForm);
    }
    std::string_view unit(rest, static_cast<std::size_t>(text.data() + text.size() - rest));
    const std::string number(text.substr(0, text.size() - unit.size()));
    if (failure != std::errc{} || !std::isfinite(value)) {
        refuse(given, "finite numbers");
    }
    if (!unit.empty() && unit.front() == ' ') {
        unit.remove_prefix(1);
    }
    return {number, std::string(unit)};
}

Item itemOf(const Given& given, std::string_view text)
{
    const auto dots = text.find("..");
    if (dots == std::string_view::npos) {
        return {pieceOf(given, text)};
    }
    const std::string_view rest = text.substr(dots + 2);
    const auto colon = rest.find(':');
    if (colon == std::string_view::npos) {
        refuse(given, "a range with its step, such as 0..10:0.5");
    }
    return {pieceOf(given, text.substr(0, dots)), pieceOf(given, rest.substr(0, colon)),
            pieceOf(given, rest.substr(colon + 1))};
}

/// Gives numbers without a unit the unit of the next number with one, or of the last.
void shareUnits(std::vector<Item>& items)
{
    std::vector<Piece*> pieces;
    for (Item& item : items) {
        for (Piece& piece : item) {
            pieces.push_back(&piece);
        }
    }
    std::string unit;
    for (const Piece* piece : pieces) {
        unit = piece->unit.empty() ? unit : piece->unit;
    }
    std::for_each(pieces.rbegin(), pieces.rend(), [&](Piece* piece) {
        if (piece->unit.empty()) {
            piece->unit = unit;
        }
        unit = piece->unit;
    });
}

using ValueOf = std::function<double(const Piece&)>;

std::vector<double> valuesOf(const Given& given, const Item& item, const ValueOf& value_of)
{
    if (item.size() == 1) {
        return {value_of(item[0])};
    }
    const bool same_unit = item[0].unit == item[1].unit && item[1].unit == item[2].unit;
    const auto plain = [&](const Piece& piece) {
        return same_unit ? finiteNumber(piece.number).value() : value_of(piece);
    };
    // The ends must be in range, and so must the step's dimension.
    const double first = value_of(item[0]);
    const double last = value_of(item[1]);
    const double from = plain(item[0]);
    const double to = plain(item[1]);
    const double step = plain(item[2]);
    if (!(last >= first) || !(step > 0.0)) {
        refuse(given, "a range from a smaller to a larger value, with a step over 0");
    }
    constexpr double kRounding = 1e-9;
    const double steps = std::floor((to - from) / step + kRounding);
    if (!(steps < static_cast<double>(kMaxValues))) {
        refuse(given, "at most " + std::to_string(kMaxValues) + " values");
    }
    std::vector<double> values;
    for (std::size_t k = 0; k <= static_cast<std::size_t>(steps); ++k) {
        const double value = from + static_cast<double>(k) * step;
        // Rounding removes the errors of decimal steps.
        values.push_back(same_unit ? value_of({fmt::format("{:.12g}", value), item[0].unit}) : value);
    }
    return values;
}

std::vector<double> listOf(const Given& given, const ValueOf& value_of)
{
    std::vector<Item> items;
    std::string_view rest = given.text;
    for (bool more = true; more;) {
        const auto comma = rest.find(',');
        items.push_back(itemOf(given, rest.substr(0, comma)));
        more = comma != std::string_view::npos;
        rest.remove_prefix(more ? comma + 1 : rest.size());
    }
    shareUnits(items);
    std::vector<double> values;
    for (const Item& item : items) {
        for (const double value : valuesOf(given, item, value_of)) {
            values.push_back(value);
        }
        if (values.size() > kMaxValues) {
            refuse(given, "at most " + std::to_string(kMaxValues) + " values");
        }
    }
    return values;
}

}  // namespace

std::vector<double> quantities(const Given& given, const Range& range)
{
    return listOf(given, [&](const Piece& piece) {
        return quantity({piece.number + piece.unit, given.subject}, range);
    });
}

std::vector<double> numbers(const Given& given, const NumberRange& range)
{
    return listOf(given, [&](const Piece& piece) { return number({piece.number + piece.unit, given.subject}, range); });
}

double number(const Given& given, const NumberRange& range)
{
    const auto value = finiteNumber(given.text);
    if (!value || *value < range.min || *value > range.max) {
        refuse(given, range.allowed);
    }
    return *value;
}

}  // namespace cli
