// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <iosfwd>
#include <vector>

#include "droplet/io/file_droplet.h"
#include "droplet/surface/material.h"
#include "droplet/surface/surface.h"

namespace droplet {

/// Options of a 3MF file.
struct ThreeMfOptions {
    Material material = Material::Water;     ///< of the liquid, without `droplets`
    Nodes nodes = Nodes::One;                ///< Each: needs `droplets`
    std::vector<FileDroplet> droplets = {};  ///< by SurfacePart::droplet; empty: all are alike, of `material`
};

/// Writes a surface as 3MF, which slicers read: millimetres, z up, the ground at z = 0 if it is flat.
///
/// One object lies on the plate. Its parts are the liquid of every look, or with Nodes::Each every droplet, by name; a
/// part has the colour of its look. Vertices are welded. There are no normals, texture coordinates and contact angles:
/// the format has none, or slicers do not read them.
///
/// Guarantees: the same surface gives the same bytes, in any locale; coordinates have nine digits; the stream is left
/// failed if it did not take everything.
/// @return       bytes handed to the stream
/// @throws Error InvalidArgument if the surface is invalid or beyond float's range; if it has parts that `droplets`
///               lacks; if Nodes::Each has no `droplets`; or if the file would reach 4 GiB
std::uint64_t writeThreeMf(const Surface& surface, std::ostream& out, const ThreeMfOptions& options = {});

}  // namespace droplet
