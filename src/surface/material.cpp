// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/surface/material.h"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "droplet/error.h"
#include "entry_named.h"

namespace droplet {
namespace {

struct Entry {
    Material material;
    Look look;
};

// Indices of refraction at 589 nm, 20 °C. Water; ink is water with dye, gel water with a little polymer, milk water
// with casein and fat. Honey: Wedmore's table for 18 % water. Mercury: reflectance of about 0.78 in visible light.
// Glass: soda lime, whose iron makes it greenish. Resin: cast epoxy. Oil: mineral oil. Ice: of the ordinary ray. Blood:
// whole blood (H. Li, L. Lin, S. Xie, "Refractive index of human whole blood", Proc. SPIE 3914 (2000) 517). Gold:
// reflectance by S. Lagarde, "Feeding a physically based shading model" (2011). The film on oil has more than any oil's
// index, so that its colours are as strong as those of a slick below a bright sky. The other numbers are chosen by eye.
const std::array<Entry, 16>& entries()
{
    static const std::array<Entry, 16> all{{
        {Material::Water, {"water", {1.0, 1.0, 1.0}, 0.0, 0.0, 1.0, 1.333, false}},
        {Material::Ink, {"ink", {0.03, 0.06, 0.35}, 0.0, 0.0, 1.0, 1.333, true}},
        {Material::Mercury, {"mercury", {0.78, 0.78, 0.78}, 1.0, 0.02, 0.0, 1.5, false}},
        {Material::Honey, {"honey", {0.9, 0.5, 0.1}, 0.0, 0.0, 1.0, 1.489, true}},
        {Material::Plain, {"plain", {0.8, 0.8, 0.8}, 0.0, 0.5, 0.0, 1.5, false}},
        {Material::Gel, {"gel", {0.45, 0.93, 0.88}, 0.0, 0.06, 0.94, 1.37, true}},
        {Material::Enamel, {"enamel", {0.02, 0.11, 0.42}, 0.0, 0.03, 0.0, 1.55, false}},
        {Material::Glass, {"glass", {0.86, 0.97, 0.92}, 0.0, 0.0, 1.0, 1.52, true}},
        {Material::Resin, {"resin", {0.98, 0.88, 0.62}, 0.0, 0.0, 1.0, 1.56, true}},
        {Material::Oil, {"oil", {0.07, 0.04, 0.02}, 0.0, 0.0, 1.0, 1.47, true, ThinFilm{1.9, 430e-9}}},
        {Material::Milk, {"milk", {0.9, 0.87, 0.78}, 0.0, 0.0, 0.0, 1.35, false}},
        {Material::Lacquer, {"lacquer", {0.45, 0.012, 0.01}, 0.0, 0.0, 0.0, 1.54, false}},
        {Material::Blood, {"blood", {0.5, 0.012, 0.01}, 0.0, 0.0, 0.8, 1.38, true}},
        {Material::Gold, {"gold", {1.0, 0.71, 0.29}, 1.0, 0.1, 0.0, 1.5, false}},
        {Material::Frosted, {"frosted", {1.0, 1.0, 1.0}, 0.0, 0.35, 0.8, 1.52, false}},
        {Material::Ice, {"ice", {0.75, 0.92, 1.0}, 0.0, 0.14, 0.9, 1.309, true}},
    }};
    return all;
}

}  // namespace

std::vector<Material> materials()
{
    std::vector<Material> all;
    all.reserve(entries().size());
    for (const Entry& entry : entries()) {
        all.push_back(entry.material);
    }
    return all;
}

Look lookOf(Material material)
{
    for (const Entry& entry : entries()) {
        if (entry.material == material) {
            return entry.look;
        }
    }
    throw Error(ErrorCode::InvalidArgument, "options.material = " + std::to_string(static_cast<int>(material)) +
                                                " must be one of the " + std::to_string(entries().size()) +
                                                " materials");
}

Attenuation attenuationOf(const Look& look, double mean_height)
{
    constexpr double kDarkest = 0.02;
    const auto channel = [&](double share) { return std::max(share, kDarkest); };
    return {{channel(look.colour.x), channel(look.colour.y), channel(look.colour.z)}, 2.0 * mean_height};
}

Material materialOf(const Liquid& liquid)
{
    for (const Material own : {Material::Mercury, Material::Honey}) {
        if (liquid.name == lookOf(own).name) {
            return own;
        }
    }
    return Material::Water;
}

Material materialNamed(std::string_view name)
{
    std::string names;
    for (const Entry& entry : entries()) {
        if (name == entry.look.name) {
            return entry.material;
        }
        names += (names.empty() ? "" : ", ") + entry.look.name;
    }
    refuseName("material", name, names);
}

}  // namespace droplet
