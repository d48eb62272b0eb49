// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <iosfwd>

#include "droplet/surface/material.h"
#include "droplet/surface/surface.h"

namespace droplet {

/// Writes a surface as Universal Scene Description in text: metres, +Y up like glTF, a default prim `/droplet` with a
/// mesh `/droplet/surface` and its material.
///
/// Points are welded, so that the mesh is watertight. Normals are the indexed primvar `normals` of every corner, so
/// that the rim is crisp. Texture coordinates are the primvar `st` with its origin at the lower left; contact angles,
/// if the surface has them, are the primvar `contact_angle` of every point, in degrees. The material is a
/// UsdPreviewSurface: colour, index of refraction, roughness, metal. It has no transmission; clear liquids have an
/// opacity below 1.
///
/// Guarantees: the same surface gives the same bytes, in any locale; numbers are read back as the same floats; the
/// stream is left failed if it did not take everything.
/// @return       bytes handed to the stream
/// @throws Error InvalidArgument if the surface is invalid, beyond float's range, or has more than 2³¹ − 1 corners
std::uint64_t writeUsda(const Surface& surface, std::ostream& out, Material material = Material::Water);

/// Writes the file of writeUsda, `droplet.usda`, into a USD package: a zip without compression, in which the data begin
/// at a multiple of 64 bytes.
///
/// Guarantees: as writeUsda.
/// @return       bytes handed to the stream
/// @throws Error InvalidArgument as writeUsda, and if the package would reach 4 GiB
std::uint64_t writeUsdz(const Surface& surface, std::ostream& out, Material material = Material::Water);

}  // namespace droplet
