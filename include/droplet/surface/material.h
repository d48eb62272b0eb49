// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "droplet/liquid.h"
#include "droplet/vector.h"

namespace droplet {

/// Named looks of a droplet in a viewer.
enum class Material {
    Water,
    Ink,
    Mercury,
    Honey,
    Plain,
    Gel,
    Enamel,
    Glass,
    Resin,
    Oil,
    Milk,
    Lacquer,
    Blood,
    Gold,
    Frosted,
    Ice
};

/// All materials.
std::vector<Material> materials();

/// Finds a material by its name: that of its look.
/// @throws Error InvalidArgument
Material materialNamed(std::string_view name);

/// Material for a liquid: mercury and honey by their names, otherwise water.
Material materialOf(const Liquid& liquid);

/// Clear layer on a surface, thin enough that its two sides' reflections interfere: its colour changes with the angle.
struct ThinFilm {
    double ior = 1.5;        ///< index of refraction, from 1 to 4
    double thickness = 0.0;  ///< [m], up to 10 um

    /// Whether all properties are equal.
    friend bool operator==(const ThinFilm&, const ThinFilm&) = default;
};

/// Optical properties of a material.
struct Look {
    std::string name = "water";  ///< name in files
    Vec3 colour = {1.0, 1.0,
                   1.0};        ///< linear red, green, blue; for liquids, that of white ground below the mean height
    double metallic = 0.0;      ///< 1 for metal
    double roughness = 0.0;     ///< 0 (mirror) … 1 (matt)
    double transmission = 1.0;  ///< share of the light that passes, 0 … 1
    double ior = 1.333;         ///< index of refraction
    bool tinted = false;        ///< whether the colour deepens with the path through the liquid
    std::optional<ThinFilm> film = {};  ///< on its surface

    /// Whether all properties are equal.
    friend bool operator==(const Look&, const Look&) = default;
};

/// Looks up a material.
/// @throws Error InvalidArgument
Look lookOf(Material material);

/// Absorption in a liquid (Beer and Lambert): white light has this colour after this distance.
struct Attenuation {
    Vec3 colour;            ///< linear red, green, blue; > 0
    double distance = 0.0;  ///< [m]
};

/// Absorption in a tinted liquid. Light from above passes the liquid down to the ground and up again, so the distance
/// is twice the mean height: then white ground below that height has the look's colour.
///
/// Guarantees: every channel is at least 0.02. A channel of 0 would absorb all light in the thinnest liquid, and a
/// colour as bright as a logo's would come out nearly black where the liquid is thick.
/// @param look         tinted
/// @param mean_height  of the liquid [m] > 0
Attenuation attenuationOf(const Look& look, double mean_height);

}  // namespace droplet
