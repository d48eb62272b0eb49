// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/surface/material.h"

#include <algorithm>
#include <array>
#include <string>

#include "droplet/error.h"
#include "entry_named.h"

namespace droplet {
namespace {

struct Entry {
    Material material;
    Look look;
};

// Water: index of refraction at 589 nm, 20 °C; ink is water with dye. Honey: Wedmore's table for 18 % water. Mercury:
// reflectance of about 0.78 in visible light. The other colours are chosen by eye.
const std::array<Entry, 5>& entries()
{
    static const std::array<Entry, 5> all{{
        {Material::Water, {"water", {1.0, 1.0, 1.0}, 0.0, 0.0, 1.0, 1.333, false}},
        {Material::Ink, {"ink", {0.03, 0.06, 0.35}, 0.0, 0.0, 1.0, 1.333, true}},
        {Material::Mercury, {"mercury", {0.78, 0.78, 0.78}, 1.0, 0.02, 0.0, 1.5, false}},
        {Material::Honey, {"honey", {0.9, 0.5, 0.1}, 0.0, 0.0, 1.0, 1.489, true}},
        {Material::Plain, {"plain", {0.8, 0.8, 0.8}, 0.0, 0.5, 0.0, 1.5, false}},
    }};
    return all;
}

}  // namespace

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
