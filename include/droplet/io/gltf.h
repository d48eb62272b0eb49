// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <iosfwd>

#include "droplet/surface/material.h"
#include "droplet/surface/surface.h"

namespace droplet {

/// What a glTF file holds beside the surface.
struct GltfOptions {
    bool binary = true;  ///< GLB; otherwise JSON with the buffer embedded as base64
    Material material = Material::Water;
    bool closed = true;  ///< an open surface gets no volume: viewers would refract at a missing base
};

/// Writes a surface as glTF 2.0: metres, +Y up, the image's lower edge toward +Z, float attributes POSITION, NORMAL
/// and TEXCOORD_0, 32-bit indices where needed; and, if the surface has them, contact angles as a float scalar in
/// degrees, _CONTACT_ANGLE: names of attributes that glTF does not define begin with an underscore (section 3.7.2.1),
/// and viewers ignore them. No extension is required to show it; transmission, ior and volume
/// are used where known. A surface that can be refilled has a morph target named `volume`, whose weight w shows 1 + w
/// fills: mesh.weights [0], and in mesh.extras `targetNames` and `fill_range`, the fills of least and most. Colour by
/// depth is given at the mean height; an open surface has it as plain tint.
///
/// Guarantees: the same surface gives the same bytes; the stream is left failed if it did not take everything.
/// @return       bytes handed to the stream
/// @throws Error InvalidArgument if the surface is invalid, beyond float's range, or the file would reach 2 GiB
std::uint64_t writeGltf(const Surface& surface, std::ostream& out, const GltfOptions& options = {});

}  // namespace droplet
