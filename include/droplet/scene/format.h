// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

#include "droplet/scene/compression.h"

namespace droplet {

/// File formats of meshes.
enum class Format { Glb, Gltf, Obj, Ply, Stl, Usda, Usdz, ThreeMf };

/// Format with a name (`glb`) or a file extension (`.GLB`).
/// @throws Error InvalidArgument, listing the known names
Format formatNamed(std::string_view name);

/// Lower-case name of a format; also its file extension without the dot.
const char* name(Format format);

/// Whether files of a format hold animations: glTF and USD.
bool isAnimated(Format format);

/// Whether files of a format hold quadrilaterals: OBJ, PLY and USD.
bool hasQuads(Format format);

/// Form of a file with an animation.
struct AnimatedFile {
    Format format = Format::Glb;                  ///< one that holds animations
    Compression compression = Compression::None;  ///< GLB alone
};

}  // namespace droplet
