// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "droplet/surface/material.h"

namespace droplet {

/// Name, look and figures of a droplet in a file.
struct FileDroplet {
    std::string name;            ///< of its node in glTF, of its prim in USD
    Look look;                   ///< of its liquid; droplets with the same look share a material
    double volume = 0.0;         ///< [m³]
    double contact_angle = 0.0;  ///< mean along the rim [rad]
    double height_max = 0.0;     ///< [m]
    double pressure = 0.0;       ///< at height 0 [Pa]
};

/// Nodes of a file.
enum class Nodes {
    One,  ///< all droplets are one mesh
    Each  ///< every droplet has a mesh and a node
};

/// Looks of droplets, in their order.
std::vector<Look> looksOf(const std::vector<FileDroplet>& droplets);

}  // namespace droplet
