// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>

#include "droplet/surface/material.h"
#include "droplet/surface/surface.h"

namespace droplet {

/// What a length of 1 is in a file that does not say so to programs.
enum class LengthUnit { Millimetre, Centimetre, Metre };

/// How an OBJ is written.
struct ObjOptions {
    LengthUnit unit = LengthUnit::Millimetre;
    Material material = Material::Water;
    std::optional<std::string> material_file = {};  ///< name of the file that writeMtl made; empty: no material
};

// All three refuse an invalid surface (Error InvalidArgument), give the same bytes for the same surface, leave the
// stream failed if it did not take everything, and return how many bytes they handed to it.

/// Wavefront OBJ: millimetres unless asked otherwise, +Y up like glTF, positions welded, crisp normals by separate
/// normal indices, uv with its origin at the lower left. Text, nine significant digits, in any locale.
std::uint64_t writeObj(const Surface& surface, std::ostream& out, const ObjOptions& options = {});

/// The material of an OBJ: colour, index of refraction and transparency, and roughness and metal as many programs read
/// them beside (Pr, Pm). Colours are linear.
std::uint64_t writeMtl(Material material, std::ostream& out);

/// PLY, binary little-endian, floats: metres, z up, positions welded, normals of the liquid's side on the rim, texture
/// coordinates s, t with their origin at the lower left, contact_angle in degrees if the surface has it.
std::uint64_t writePly(const Surface& surface, std::ostream& out);

/// STL, binary: millimetres unless asked otherwise, as slicers expect, z up; facet normals by the winding.
std::uint64_t writeStl(const Surface& surface, std::ostream& out, LengthUnit unit = LengthUnit::Millimetre);

}  // namespace droplet
