// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "droplet/surface/material.h"
#include "droplet/surface/surface.h"

namespace droplet {

/// Unit of length in a file whose format does not state one.
enum class LengthUnit { Millimetre, Centimetre, Metre };

/// Options of an OBJ file.
struct ObjOptions {
    LengthUnit unit = LengthUnit::Millimetre;       ///< of the coordinates
    Material material = Material::Water;            ///< used with material_file, without `looks`
    std::optional<std::string> material_file = {};  ///< name of the file from writeMtl, a line of UTF-8; empty: none
    std::vector<Look> looks = {};                   ///< by SurfacePart::droplet, with material_file; empty: `material`
};

// All writers below throw Error InvalidArgument for an invalid surface, give the same bytes for the same surface, leave
// the stream failed if it did not take everything, and return the number of bytes handed to it.

/// Writes Wavefront OBJ: +Y up like glTF, welded vertices, separate normal indices for crisp rims, uv with its origin
/// at the lower left. Text with nine significant digits, in any locale. Also throws if the surface has no parts, or
/// more droplets than there are looks.
std::uint64_t writeObj(const Surface& surface, std::ostream& out, const ObjOptions& options = {});

/// Writes the material of an OBJ: linear colour, index of refraction, transparency, and roughness and metallic as the
/// common extensions Pr and Pm.
std::uint64_t writeMtl(Material material, std::ostream& out);

/// Writes the materials of an OBJ, every look once.
std::uint64_t writeMtl(const std::vector<Look>& looks, std::ostream& out);

/// Writes PLY, binary little-endian, floats: metres, z up, welded vertices, on the rim the liquid's normals, texture
/// coordinates s, t with their origin at the lower left, contact_angle in degrees if the surface has it.
std::uint64_t writePly(const Surface& surface, std::ostream& out);

/// Writes binary STL: z up, facet normals by the winding. Slicers expect millimetres.
std::uint64_t writeStl(const Surface& surface, std::ostream& out, LengthUnit unit = LengthUnit::Millimetre);

}  // namespace droplet
