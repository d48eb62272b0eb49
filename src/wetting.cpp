// SPDX-License-Identifier: GPL-3.0-or-later
//
// Static angles of drops at rest, at 20 °C to 25 °C:
// - water and mercury on glass, water on PTFE (108° to 112°) and on paraffin (105° to 111°), mercury on glass (128° to
//   148°) and on PTFE: Adamson and Gast, "Physical Chemistry of Surfaces", 6th ed. (1997), table X-2. Water on glass is
//   "small" there; 20° is that of glass as it lies about, clean glass has less.
// - glycerol: Fox and Zisman, J. Colloid Sci. 5 (1950) 514 (PTFE) and 7 (1952) 428 (paraffin).
// - lotus: Barthlott and Neinhuis, Planta 202 (1997) 1, table 1.
// - ethanol spreads on glass.
#include "droplet/wetting.h"

#include <array>

#include "droplet/error.h"
#include "droplet/units.h"

namespace droplet {
namespace {

struct Wetting {
    std::string_view liquid;
    Solid solid;
    double degrees;
};

constexpr std::array<Wetting, 9> kWettings{{{"water", Solid::Glass, 20.0},
                                            {"water", Solid::Ptfe, 110.0},
                                            {"water", Solid::Wax, 105.0},
                                            {"water", Solid::Lotus, 160.0},
                                            {"mercury", Solid::Glass, 140.0},
                                            {"mercury", Solid::Ptfe, 150.0},
                                            {"glycerol", Solid::Ptfe, 100.0},
                                            {"glycerol", Solid::Wax, 97.0},
                                            {"ethanol", Solid::Glass, 0.0}}};

}  // namespace

std::optional<double> naturalContactAngle(std::string_view liquid, Solid solid)
{
    for (const Wetting& wetting : kWettings) {
        if (wetting.liquid == liquid && wetting.solid == solid) {
            return wetting.degrees * kDegree;
        }
    }
    return std::nullopt;
}

const char* name(Solid solid)
{
    switch (solid) {
        case Solid::Glass:
            return "glass";
        case Solid::Ptfe:
            return "ptfe";
        case Solid::Wax:
            return "wax";
        case Solid::Lotus:
            return "lotus";
    }
    throw Error(ErrorCode::InvalidArgument, "solid has an unknown value");
}

}  // namespace droplet
