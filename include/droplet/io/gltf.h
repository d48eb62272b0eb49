// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <iosfwd>
#include <span>
#include <string>
#include <vector>

#include "droplet/io/file_droplet.h"
#include "droplet/scene/compression.h"
#include "droplet/surface/material.h"
#include "droplet/surface/surface.h"

namespace droplet {

/// Options of a glTF file.
struct GltfOptions {
    bool binary = true;                   ///< GLB; otherwise JSON with the buffer embedded as base64
    Material material = Material::Water;  ///< of the liquid, without `droplets`
    bool closed = true;        ///< false: no volume extension, since viewers would refract at the missing base
    Nodes nodes = Nodes::One;  ///< Each: needs `droplets`
    std::vector<FileDroplet> droplets = {};  ///< by SurfacePart::droplet; empty: all are alike, of `material`
    std::string texture = {};  ///< bytes of a PNG over the surface's uv, which tints the liquid; empty: none
    Compression compression = Compression::None;  ///< of a GLB
    std::span<const Surface> levels = {};  ///< the surface with ever fewer triangles, as of simplify(), for MSFT_lod
};

/// Writes a surface as glTF 2.0: metres, +Y up, the image's lower edge toward +Z, float attributes POSITION, NORMAL
/// and TEXCOORD_0, 32-bit indices where needed.
///
/// Contact angles, if the surface has them, are the float scalar _CONTACT_ANGLE in degrees; attributes that glTF does
/// not define begin with an underscore (section 3.7.2.1), and viewers ignore them. The file uses the extensions for
/// transmission, ior and volume but requires none. A surface that can be refilled has a morph target named `volume`;
/// its weight w shows 1 + w fills. mesh.weights is then [0], and mesh.extras holds `targetNames` and `fill_range`,
/// the minimum and maximum fill. Colour by depth is given at the mean height; an open surface has it as plain tint.
///
/// With `droplets`, every look has a primitive of one mesh, with a material for the mean height of its droplets; or,
/// with Nodes::Each, every droplet has a node with its name, a mesh, a material for its own mean height, and extras
/// `volume_m3`, `contact_angle_deg`, `height_max_m` and `pressure_pa`. Nodes follow each other as in `droplets`; a
/// droplet without liquid has none.
///
/// With `texture`, the PNG is embedded as the base colour of every material. Liquid multiplies the light that passes by
/// it, as KHR_materials_transmission says.
///
/// With `levels`, every node names those that take its place where it is smaller (MSFT_lod). They are in no scene.
/// Their shares of the picture are those of their triangles, so that triangles are as large on the screen.
///
/// A compressed file requires the extensions of its Compression, and its nodes have one scale and one translation, so
/// that vertices that droplets share stay together. Changes by a refill are compressed, too. Meshopt gives vertices and
/// triangles another order.
///
/// Guarantees: the same surface gives the same bytes; the stream is left failed if it did not take everything.
/// @return       bytes handed to the stream
/// @throws Error InvalidArgument if the surface is invalid, beyond float's range, or has parts that `droplets` lacks;
///               if Nodes::Each has no `droplets`; if levels have other parts; if text would be compressed; or if the
///               file would reach 2 GiB
std::uint64_t writeGltf(const Surface& surface, std::ostream& out, const GltfOptions& options = {});

}  // namespace droplet
