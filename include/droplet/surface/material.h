// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "droplet/liquid.h"
#include "droplet/vector.h"

namespace droplet {

/// Named looks of a droplet in a viewer.
enum class Material { Water, Ink, Mercury, Honey, Plain };

/// Finds a material by its name: water, ink, mercury, honey or plain.
/// @throws Error InvalidArgument
Material materialNamed(std::string_view name);

/// Material for a liquid: mercury and honey by their names, otherwise water.
Material materialOf(const Liquid& liquid);

/// Optical properties of a material.
struct Look {
    std::string name = "water";     ///< name in files
    Vec3 colour = {1.0, 1.0, 1.0};  ///< linear red, green, blue; for liquids, the colour of white light after the mean
                                    ///< height
    double metallic = 0.0;          ///< 1 for metal
    double roughness = 0.0;         ///< 0 (mirror) … 1 (matt)
    double transmission = 1.0;      ///< share of the light that passes, 0 … 1
    double ior = 1.333;             ///< index of refraction
    bool tinted = false;            ///< whether the colour deepens with the path through the liquid

    /// Whether all properties are equal.
    friend bool operator==(const Look&, const Look&) = default;
};

/// Looks up a material.
/// @throws Error InvalidArgument
Look lookOf(Material material);

}  // namespace droplet
