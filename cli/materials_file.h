// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "droplet/image/css_colour.h"
#include "droplet/surface/material.h"

namespace cli {

/// Material of one droplet, or of all; members that the file does not give are empty.
struct MaterialEntry {
    std::optional<std::size_t> index;  ///< number of the droplet, from 0; empty: all
    std::optional<droplet::Material> material;
    std::optional<droplet::CssColour> colour;
    std::optional<double> roughness;
    std::optional<double> ior;
};

/// Materials of droplets from a file.
struct Materials {
    std::string path;
    std::vector<MaterialEntry> entries;  ///< in the order of the file
};

/// Reads tables `[[droplet]]` of TOML, with `index` and any of `material`, `colour`, `roughness` and `ior`.
/// @throws droplet::Error InvalidArgument, naming file, line, key and what is allowed
Materials readMaterials(const std::string& path);

/// Look that shows a colour: of white ground below the mean height if the look is clear, otherwise of its matter.
droplet::Look inColour(droplet::Look look, const droplet::CssColour& colour);

/// Applies a file to the looks of droplets, its later entries over earlier ones. Looks that change get a name that says
/// how, so that equal names mean equal looks.
/// @return  warnings about droplets that do not exist
std::vector<std::string> applyMaterials(const Materials& materials, std::vector<droplet::Look>& looks);

}  // namespace cli
