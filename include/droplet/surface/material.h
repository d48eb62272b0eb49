// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

#include "droplet/liquid.h"
#include "droplet/vector.h"

namespace droplet {

/// How a droplet looks in a viewer.
enum class Material { Water, Ink, Mercury, Honey, Plain };

/// The material of that name: water, ink, mercury, honey, plain.
/// @throws Error InvalidArgument
Material materialNamed(std::string_view name);

/// The material that a liquid looks like by its name: that of mercury and honey, else water.
Material materialOf(const Liquid& liquid);

/// A material's optics.
struct Look {
    const char* name = "water";
    Vec3 colour = {1.0, 1.0, 1.0};  ///< red, green, blue, linear; of metal and opaque matter its own, of liquid that of
                                    ///< white light through the mean height
    double metallic = 0.0;
    double roughness = 0.0;
    double transmission = 1.0;
    double ior = 1.333;
    bool tinted = false;  ///< colour deepens with the way through the liquid
};

/// The optics of a material.
/// @throws Error InvalidArgument
Look lookOf(Material material);

}  // namespace droplet
