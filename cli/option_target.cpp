// SPDX-License-Identifier: GPL-3.0-or-later
#include "option_target.h"

#include <fmt/core.h>

#include <charconv>
#include <limits>

namespace cli {
namespace {

/// Units in which people expect the quantities of a dimension.
std::vector<const char*> usualUnits(droplet::Dimension dimension)
{
    using droplet::Dimension;
    switch (dimension) {
        case Dimension::Length:
            return {"mm", "m", "um"};
        case Dimension::Area:
            return {"mm2", "m2"};
        case Dimension::Volume:
            return {"uL", "mL"};
        case Dimension::Angle:
            return {"deg"};
        case Dimension::SurfaceTension:
            return {"mN/m"};
        case Dimension::Density:
            return {"kg/m3"};
        case Dimension::Acceleration:
            return {"m/s2"};
        case Dimension::Speed:
            return {"m/s"};
        case Dimension::Duration:
            return {"s", "ms", "min", "h"};
        case Dimension::Rainfall:
            return {"mm/h"};
        case Dimension::Viscosity:
            return {"Pa.s", "mPa.s"};
    }
    return {};
}

}  // namespace

std::string quantityText(double value, droplet::Dimension dimension)
{
    std::string shortest;
    for (const std::string unit : usualUnits(dimension)) {
        // Conversion of units rounds; nobody writes seven digits.
        std::string text = fmt::format("{:.6g}{}", value / droplet::parseQuantity("1" + unit, dimension), unit);
        if (shortest.empty() || (value != 0.0 && text.size() < shortest.size())) {
            shortest = std::move(text);
        }
    }
    return shortest;
}

std::string countText(std::size_t value)
{
    constexpr std::size_t kThousand = 1000;
    constexpr std::size_t kMillion = 1'000'000;
    return value > 0 && value % kMillion == 0                 ? std::to_string(value / kMillion) + "M"
           : value >= 5 * kThousand && value % kThousand == 0 ? std::to_string(value / kThousand) + "k"
                                                              : std::to_string(value);
}

OptionTarget into(double& value, const Range& range)
{
    return {[&value, range](const Given& given) { value = quantity(given, range); },
            quantityText(value, range.dimension),
            {},
            std::array{range.min, range.max}};
}

OptionTarget into(double& value, const NumberRange& range)
{
    return {[&value, range](const Given& given) { value = number(given, range); },
            fmt::format("{:.6g}", value),
            {},
            std::array{range.min, range.max}};
}

OptionTarget into(std::string& text)
{
    return {[&text](const Given& given) { text = given.text; }, text};
}

OptionTarget within(double min, double max)
{
    return {.read = {}, .usual = {}, .words = {}, .range = std::array{min, max}};
}

OptionTarget within(const Range& range)
{
    return within(range.min, range.max);
}

OptionTarget withoutDefault(OptionTarget target)
{
    target.usual.clear();
    return target;
}

OptionTarget seedInto(std::uint64_t& seed)
{
    return {[&seed](const Given& given) {
                const char* const end = given.text.data() + given.text.size();
                const auto [stop, failure] = std::from_chars(given.text.data(), end, seed);
                if (failure != std::errc{} || stop != end) {
                    refuse(given, "a whole number from 0 to 18446744073709551615");
                }
            },
            std::to_string(seed),
            {},
            std::array{0.0, static_cast<double>(std::numeric_limits<std::uint64_t>::max())}};
}

}  // namespace cli
