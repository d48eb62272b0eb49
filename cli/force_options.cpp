// SPDX-License-Identifier: GPL-3.0-or-later
#include "force_options.h"

#include <cctype>

#include "droplet/liquid.h"
#include "liquid_options.h"
#include "option_values.h"
#include "value_list.h"

namespace cli {
namespace {

using droplet::Dimension;

constexpr Range kViscosity{Dimension::Viscosity, 0.0, 1e3,
                           "from 0Pa.s to 1000Pa.s, or artistic, or wedge for water by wedge theory"};
constexpr Range kBoundaryLayer{Dimension::Length, 0.0, 1.0, "from 0mm to 1m"};
constexpr Range kAirDensity{Dimension::Density, 0.0, 1e3, "from 0kg/m3 to 1000kg/m3"};
constexpr Range kDensity{Dimension::Density, 1e-3, 1e6, "from 0.001kg/m3 to 1e6kg/m3"};
constexpr Range kGravity{Dimension::Acceleration, 0.0, 1e4, "from 0m/s2 to 1e4m/s2"};
constexpr NumberRange kDragCoefficient{0.0, 100.0, "a number from 0 to 100"};
constexpr NumberRange kExponent{0.0, 2.0, "a number from 0 to 2"};
constexpr NumberRange kFraction{0.0, 1.0, "a number from 0 to 1"};

double viscosityFactor(const Given& given, double contact_angle)
{
    if (given.text == "artistic") {
        return droplet::kArtisticViscosityFactor;
    }
    if (given.text == "wedge") {
        // Only the logarithm of the radius matters, so that of any running droplet is good enough.
        constexpr double kVolume = 30e-9;
        return droplet::wedgeViscosityFactor(droplet::kWaterViscosity, contact_angle,
                                             droplet::capOf(kVolume, contact_angle).radius);
    }
    if (!given.text.empty() && std::isalpha(static_cast<unsigned char>(given.text.front())) != 0) {
        refuse(given, kViscosity.allowed);
    }
    return quantity(given, kViscosity);
}

}  // namespace

void declareForces(CommandLine& line, droplet::ForceModel& model)
{
    constexpr const char* kCoating = "Coating";
    line.add(kCoating, "--contact-angle", "ANGLE", "Contact angle of droplets at rest, from 1deg to 179deg [by preset]",
             into(model.wetting.contact_angle, kContactAngle));
    line.add(
        kCoating, "--viscosity-factor", "V|artistic|wedge",
        "Viscous drag per radius and speed: artistic is 0.5Pa.s, wedge is that of water by wedge theory [by preset]",
        within(kViscosity));
    line.add(kCoating, "--kinetic-fraction", "F", "Friction of a moving droplet, as a fraction of that at rest",
             into(model.wetting.kinetic_fraction, kFraction));
    constexpr const char* kAir = "Air";
    line.add(kAir, "--drag-coefficient", "C", "Drag coefficient of droplets in the wind",
             into(model.air.drag_coefficient, kDragCoefficient));
    line.add(kAir, "--boundary-layer", "L", "Thickness of the layer in which the wind is slower [by preset]",
             into(model.air.boundary_layer, kBoundaryLayer));
    line.add(kAir, "--profile-exponent", "NUMBER",
             "Exponent of the wind's growth with height in that layer; 0.143 for a turbulent one",
             into(model.air.profile_exponent, kExponent));
    line.add(kAir, "--air-density", "D", "Density of the air", into(model.air.density, kAirDensity));
    constexpr const char* kLiquid = "Liquid";
    declareLiquidProperties(line, kLiquid, kDensity);
    line.add(kLiquid, "--gravity", "G", "Gravity, downwards", into(model.gravity, kGravity));
}

void readForces(const CommandLine& line, droplet::ForceModel& model)
{
    readLiquidProperties(line, kDensity, model.liquid);
    if (const auto factor = line.value("--viscosity-factor")) {
        model.wetting.viscosity_factor = viscosityFactor(*factor, model.wetting.contact_angle);
    }
}

}  // namespace cli
