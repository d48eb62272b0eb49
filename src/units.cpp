// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/units.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <span>
#include <system_error>
#include <utility>

#include "droplet/error.h"
#include "droplet/liquid.h"
#include "droplet/printable.h"

namespace droplet {
namespace {

/// Unit as a fraction. Division by an exact power of ten rounds once; multiplication by 1e-3 would round twice.
struct Unit {
    std::string_view name;
    double numerator;
    double denominator;
};

struct Kind {
    std::string_view noun;  ///< with its article
    std::string_view example;
    std::span<const Unit> units;
};

constexpr std::array kLengths{Unit{"nm", 1, 1e9}, Unit{"um", 1, 1e6}, Unit{"mm", 1, 1e3},
                              Unit{"cm", 1, 1e2}, Unit{"m", 1, 1},    Unit{"in", 254, 1e4}};
constexpr std::array kAreas{Unit{"um2", 1, 1e12}, Unit{"mm2", 1, 1e6}, Unit{"cm2", 1, 1e4}, Unit{"m2", 1, 1}};
constexpr std::array kVolumes{Unit{"nL", 1, 1e12}, Unit{"uL", 1, 1e9},  Unit{"mL", 1, 1e6}, Unit{"L", 1, 1e3},
                              Unit{"mm3", 1, 1e9}, Unit{"cm3", 1, 1e6}, Unit{"m3", 1, 1}};
constexpr std::array kAngles{Unit{"deg", std::numbers::pi, 180}, Unit{"rad", 1, 1}};
constexpr std::array kTensions{Unit{"mN/m", 1, 1e3}, Unit{"N/m", 1, 1}, Unit{"dyn/cm", 1, 1e3}};
constexpr std::array kDensities{Unit{"kg/m3", 1, 1}, Unit{"g/cm3", 1e3, 1}, Unit{"g/mL", 1e3, 1}};
constexpr std::array kAccelerations{Unit{"m/s2", 1, 1}, Unit{"mm/s2", 1, 1e3}, Unit{"g", kStandardGravity, 1}};
constexpr std::array kSpeeds{Unit{"mm/s", 1, 1e3}, Unit{"m/s", 1, 1}, Unit{"km/h", 1e3, 3600},
                             Unit{"mph", 1609.344, 3600}};
constexpr std::array kDurations{Unit{"ms", 1, 1e3}, Unit{"s", 1, 1}, Unit{"min", 60, 1}, Unit{"h", 3600, 1}};
constexpr std::array kRainfalls{Unit{"mm/h", 1, 3.6e6}, Unit{"in/h", 254, 3.6e7}};
constexpr std::array kViscosities{Unit{"mPa.s", 1, 1e3}, Unit{"Pa.s", 1, 1}};

Kind kindOf(Dimension dimension)
{
    switch (dimension) {
        case Dimension::Length:
            return {"a length", "4mm", kLengths};
        case Dimension::Area:
            return {"an area", "1.5mm2", kAreas};
        case Dimension::Volume:
            return {"a volume", "30uL", kVolumes};
        case Dimension::Angle:
            return {"an angle", "45deg", kAngles};
        case Dimension::SurfaceTension:
            return {"a surface tension", "72.8mN/m", kTensions};
        case Dimension::Density:
            return {"a density", "998kg/m3", kDensities};
        case Dimension::Acceleration:
            return {"an acceleration", "9.81m/s2", kAccelerations};
        case Dimension::Speed:
            return {"a speed", "11m/s", kSpeeds};
        case Dimension::Duration:
            return {"a duration", "10s", kDurations};
        case Dimension::Rainfall:
            return {"a rainfall", "5mm/h", kRainfalls};
        case Dimension::Viscosity:
            return {"a viscosity", "0.5Pa.s", kViscosities};
    }
    throw Error(ErrorCode::InvalidArgument, "dimension: no such kind of quantity");
}

/// Replaces typographic signs of a unit by the plain characters of the tables.
std::string plainUnit(std::string_view unit)
{
    constexpr std::array<std::pair<std::string_view, std::string_view>, 6> kSigns{{
        {"\u00b5", "u"},    // micro sign
        {"\u03bc", "u"},    // Greek mu
        {"\u00b2", "2"},    // superscript two
        {"\u00b3", "3"},    // superscript three
        {"\u00b0", "deg"},  // degree sign
        {"\u00b7", "."},    // middle dot
    }};
    std::string plain(unit);
    for (const auto& [sign, replacement] : kSigns) {
        for (auto at = plain.find(sign); at != std::string::npos; at = plain.find(sign, at + replacement.size())) {
            plain.replace(at, sign.size(), replacement);
        }
    }
    return plain;
}

/// Quotes a text for a message of one line.
std::string quoted(std::string_view text)
{
    constexpr std::size_t kLongest = 40;  // a quantity takes about twelve characters
    std::size_t end = std::min(text.size(), kLongest);
    while (end < text.size() && end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0U) == 0x80U) {
        --end;  // no part of a character
    }
    return "'" + printable(text.substr(0, end)) + (end < text.size() ? "…'" : "'");
}

[[noreturn]] void refuse(std::string_view text, const std::string& reason, Dimension dimension)
{
    throw Error(ErrorCode::InvalidArgument, quoted(text) + " " + reason + "; write a number and " + unitsOf(dimension) +
                                                ", as in " + std::string(kindOf(dimension).example));
}

}  // namespace

std::string unitsOf(Dimension dimension)
{
    const auto units = kindOf(dimension).units;
    std::string list;
    for (std::size_t i = 0; i < units.size(); ++i) {
        list += i == 0 ? "" : i + 1 == units.size() ? " or " : ", ";
        list += units[i].name;
    }
    return list;
}

double parseQuantity(std::string_view text, Dimension dimension)
{
    const Kind kind = kindOf(dimension);
    double value = 0.0;
    const char* const end = text.data() + text.size();
    const auto [rest, failure] = std::from_chars(text.data(), end, value);
    if (failure == std::errc::invalid_argument) {
        refuse(text, "is not " + std::string(kind.noun), dimension);
    }
    // from_chars also reads "inf" and "nan".
    if (failure == std::errc::result_out_of_range || !std::isfinite(value)) {
        refuse(text, "is not a finite number", dimension);
    }

    std::string_view unit(rest, static_cast<std::size_t>(end - rest));
    if (unit.empty()) {
        refuse(text, "has no unit", dimension);
    }
    if (unit.front() == ' ') {
        unit.remove_prefix(1);
    }
    const std::string plain = plainUnit(unit);
    for (const Unit& known : kind.units) {
        if (known.name == plain) {
            const double si = value * known.numerator / known.denominator;
            if (!std::isfinite(si)) {
                refuse(text, "is not a finite number", dimension);
            }
            return si;
        }
    }
    refuse(text, "is not " + std::string(kind.noun), dimension);
}

}  // namespace droplet
