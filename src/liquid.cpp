// SPDX-License-Identifier: GPL-3.0-or-later
//
// Values at 20 °C:
// - water: 72.8 mN/m is the value in common use (IAPWS R1-76: 72.74); density IAPWS-95.
// - ethanol, mercury: Jasper, "The surface tension of pure liquid compounds", J. Phys. Chem. Ref. Data 1 (1972) 841,
//   γ = 24.05 − 0.0832 t and 490.6 − 0.2049 t; densities: CRC Handbook of Chemistry and Physics, 95th ed.
// - glycerol: Miner and Dalton (eds.), "Glycerol" (1953).
// - honey: Bogdanov, "Book of Honey" (2009), chapter 4, for 18 % water; the middle of its range of surface tensions, 50
//   to 60 mN/m.
#include "droplet/liquid.h"

#include <cmath>

#include "entry_named.h"
#include "require.h"

namespace droplet {
void Liquid::validate() const
{
    require(std::isfinite(surface_tension) && surface_tension > 0.0, "liquid.surface_tension", surface_tension,
            "finite and more than 0 N/m");
    require(std::isfinite(density) && density >= 0.0, "liquid.density", density, "finite and at least 0 kg/m3");
}

const std::vector<Liquid>& liquids()
{
    static const std::vector<Liquid> known{
        {"water", 0.0728, 998.2},     {"ethanol", 0.02239, 789.3}, {"glycerol", 0.0634, 1261.0},
        {"mercury", 0.4865, 13545.9}, {"honey", 0.055, 1417.0},
    };
    return known;
}

const Liquid& liquidNamed(std::string_view name)
{
    return entryNamed(liquids(), name, "liquid");
}

std::optional<double> capillaryLength(const Liquid& liquid, double gravity)
{
    const double length = std::sqrt(liquid.surface_tension / (liquid.density * std::abs(gravity)));
    return std::isfinite(length) ? std::optional(length) : std::nullopt;
}

}  // namespace droplet
