// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

#include "droplet/io/file_droplet.h"
#include "droplet/surface/material.h"
#include "droplet/surface/surface.h"

namespace droplet {

/// Options of a USD file.
struct UsdOptions {
    Material material = Material::Water;     ///< of the liquid, without `droplets`
    Nodes nodes = Nodes::One;                ///< Each: needs `droplets`
    std::vector<FileDroplet> droplets = {};  ///< by SurfacePart::droplet; empty: all are alike, of `material`
    std::string texture = {};                ///< USDZ: bytes of a PNG over the surface's uv, which tints the liquid
};

/// Writes a surface as Universal Scene Description in text: metres, +Y up like glTF, a default prim `/droplet` with a
/// mesh `/droplet/surface` and its material.
///
/// Points are welded, so that the mesh is watertight. Normals are the indexed primvar `normals` of every corner, so
/// that the rim is crisp. Texture coordinates are the primvar `st` with its origin at the lower left; contact angles,
/// if the surface has them, are the primvar `contact_angle` of every point, in degrees. The material is a
/// UsdPreviewSurface: colour, index of refraction, roughness, metal. It has no transmission; clear liquids have an
/// opacity below 1.
///
/// With `droplets`, every look has a material, bound to a subset of the mesh's faces (family `materialBind`) if there
/// are several; or, with Nodes::Each, every droplet is a mesh with its name and with attributes
/// `userProperties:volume_m3`, `:contact_angle_deg`, `:height_max_m` and `:pressure_pa`. Names of prims are those of
/// droplets and looks, with an underscore before a digit that begins the name and for what USD does not allow, and a
/// number after a name that occurs before; `displayName` is then the name as it was.
///
/// Guarantees: the same surface gives the same bytes, in any locale; numbers are read back as the same floats; the
/// stream is left failed if it did not take everything.
/// @return       bytes handed to the stream
/// @throws Error InvalidArgument if the surface is invalid, beyond float's range, or has more than 2³¹ − 1 corners; if
///               it has parts that `droplets` lacks; if Nodes::Each has no `droplets`; or if there is a texture, which
///               needs a package
std::uint64_t writeUsda(const Surface& surface, std::ostream& out, const UsdOptions& options = {});

/// Writes the file of writeUsda, `droplet.usda`, into a USD package: a zip without compression, in which the data begin
/// at a multiple of 64 bytes. A texture is the file `picture.png` behind it; in every material, its colours multiply
/// the look's colour.
///
/// Guarantees: as writeUsda.
/// @return       bytes handed to the stream
/// @throws Error InvalidArgument as writeUsda, and if the package would reach 4 GiB
std::uint64_t writeUsdz(const Surface& surface, std::ostream& out, const UsdOptions& options = {});

}  // namespace droplet
