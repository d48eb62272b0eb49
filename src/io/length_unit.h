// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "droplet/io/mesh_files.h"

namespace droplet {

/// Name of a unit in comments of our files; the readers look for it.
struct NamedUnit {
    LengthUnit unit;
    std::string_view name;
    double metres;
};

inline constexpr std::array<NamedUnit, 3> kLengthUnits{{{LengthUnit::Millimetre, "millimetre", 1e-3},
                                                        {LengthUnit::Centimetre, "centimetre", 1e-2},
                                                        {LengthUnit::Metre, "metre", 1.0}}};

inline const NamedUnit& namedUnit(LengthUnit unit)
{
    return kLengthUnits.at(static_cast<std::size_t>(unit));
}

}  // namespace droplet
