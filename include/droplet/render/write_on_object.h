// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <iosfwd>

#include "droplet/io/output.h"
#include "droplet/render/object_stand.h"
#include "droplet/scene/format.h"
#include "droplet/surface/surface.h"

namespace droplet {

/// Writes an object with the droplets on it: glTF or USD, metres, +Y up, the object where its own file has it.
///
/// The object is one mesh in a node `object`, at rest, with its materials and, in glTF, their textures, as the files of
/// `dew` have it. Below this node the droplets are as writeSurface() writes them, in the same frame, so that both go
/// together when the node is moved. A texture of `options` tints the droplets alone; compression has both in one grid.
/// @param droplets  on the object, in its frame, as of placeOnto(); or empty
/// @param object    read with StandParts::All
/// @param out       takes the bytes
/// @param format    one that holds scenes: see isAnimated()
/// @param options   of the droplets
/// @return          bytes handed to the stream, which is left failed if it did not take everything
/// @throws Error    InvalidArgument, as writeSurface() does, or if the format holds one surface alone
std::uint64_t writeOnObject(const Surface& droplets, const ObjectStand& object, std::ostream& out, Format format,
                            const WriteOptions& options = {});

}  // namespace droplet
