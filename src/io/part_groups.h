// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "droplet/io/file_droplet.h"
#include "droplet/surface/material.h"
#include "droplet/surface/surface.h"

namespace droplet {

/// Droplets of a surface that become one piece of a file.
struct PartGroup {
    Look look;
    std::optional<FileDroplet> droplet = {};  ///< with Nodes::Each
    std::vector<std::size_t> parts = {};      ///< indices of Surface::parts; empty: the whole surface
};

/// What decides the pieces of a file, as in GltfOptions.
struct Grouping {
    Material material = Material::Water;
    Nodes nodes = Nodes::One;
    const std::vector<FileDroplet>& droplets;
};

/// Groups the parts of a surface: one group for each look, or with Nodes::Each for each droplet. Groups are in the
/// order of their first droplets; a dry surface has none.
/// @throws Error InvalidArgument if the surface has parts that `droplets` lacks, or Nodes::Each has no `droplets`
std::vector<PartGroup> groupParts(const Surface& surface, const Grouping& grouping);

}  // namespace droplet
