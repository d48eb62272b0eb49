// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <iosfwd>

#include "droplet/surface/surface.h"

namespace droplet {

// All three refuse an invalid surface (Error InvalidArgument), give the same bytes for the same surface, leave the
// stream failed if it did not take everything, and return how many bytes they handed to it.

/// Wavefront OBJ: millimetres, +Y up like glTF, positions welded, crisp normals by separate normal indices, uv with
/// its origin at the lower left. Text, nine significant digits, in any locale.
std::uint64_t writeObj(const Surface& surface, std::ostream& out);

/// PLY, binary little-endian, floats: metres, z up, positions welded, normals of the liquid's side on the rim, texture
/// coordinates s, t with their origin at the lower left, contact_angle in degrees if the surface has it.
std::uint64_t writePly(const Surface& surface, std::ostream& out);

/// STL, binary: millimetres, z up, as slicers expect; facet normals by the winding.
std::uint64_t writeStl(const Surface& surface, std::ostream& out);

}  // namespace droplet
