// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <iosfwd>
#include <nlohmann/json.hpp>
#include <string_view>

#include "droplet/io/compression.h"

namespace droplet {

/// Writes a GLB with compressed vertices. All meshes are quantized in one cube, so that vertices that they share stay
/// together.
/// @param json    glTF by jsonOf: float attributes without gaps and pictures in one buffer, no morph targets, no
///                animations; nodes with a mesh have no rotation, scale or children
/// @param buffer  of the glTF
/// @return        bytes handed to the stream
std::uint64_t writeCompressed(std::ostream& out, nlohmann::json json, std::string_view buffer, Compression compression);

}  // namespace droplet
