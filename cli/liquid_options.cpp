// SPDX-License-Identifier: GPL-3.0-or-later
#include "liquid_options.h"

#include <string>

#include "droplet/surface/material.h"

namespace cli {
namespace {

constexpr Range kTension{droplet::Dimension::SurfaceTension, 1e-6, 1e3, "from 0.001mN/m to 1000N/m"};

}  // namespace

void declareLiquidProperties(CommandLine& line, const char* group, const Range& density)
{
    line.add(group, "--liquid", wordsOf(droplet::liquids(), &droplet::Liquid::name).c_str(),
             "Liquid, at 20 C [" + droplet::Liquid().name + "]");
    line.add(group, "--surface-tension", "S", "Surface tension, instead of the liquid's own", within(kTension));
    line.add(group, "--density", "D", "Density, instead of the liquid's own", within(density));
}

void readLiquidProperties(const CommandLine& line, const Range& density, droplet::Liquid& liquid)
{
    const auto name = line.value("--liquid");
    if (name) {
        liquid = forOption(name->subject, [&] { return droplet::liquidNamed(name->text); });
    }
    const auto tension = line.value("--surface-tension");
    if (tension) {
        liquid.surface_tension = quantity(*tension, kTension);
    }
    const auto own_density = line.value("--density");
    if (own_density) {
        liquid.density = quantity(*own_density, density);
    }
    if (!name && (tension || own_density)) {
        liquid.name = "custom";
    }
}

void declareMaterial(CommandLine& line, const char* group, const std::string& text)
{
    const auto name = [](droplet::Material material) { return droplet::lookOf(material).name; };
    line.add(group, "--material", wordsOf(droplet::materials(), name).c_str(), text);
}

}  // namespace cli
