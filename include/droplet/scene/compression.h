// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string_view>

#include "droplet/surface/surface.h"
#include "droplet/vector.h"

namespace droplet {

/// Compression of a GLB.
enum class Compression {
    None,      ///< floats, which every viewer reads
    Quantize,  ///< KHR_mesh_quantization: integers of 16 bits
    Meshopt,   ///< EXT_meshopt_compression of such integers, with vertices and triangles in another order
};

/// Finds a compression by its name: none, quantize or meshopt.
/// @throws Error InvalidArgument
Compression compressionNamed(std::string_view name);

/// Name of a compression.
const char* name(Compression compression);

/// Largest changes by a compression.
struct CompressionError {
    double position = 0.0;  ///< distance of a vertex from its place [m]
    double normal = 0.0;    ///< angle of a normal with its direction [rad]
};

/// Measures what a compression changes, with a refill at all its states. Positions lie on a grid of 65536 steps along
/// the longest side of the surface's box, or along the longest change by a refill, so their error is below 0.87 steps,
/// and twice as much for changes. Vertices at one place stay at one place.
/// @param surface      valid or empty
/// @param compression  with None, nothing changes
/// @param beside       other vertices of the file, in whose common box the grid is
/// @throws Error       InvalidArgument beyond float's range
CompressionError compressionError(const Surface& surface, Compression compression, std::span<const Vec3> beside = {});

}  // namespace droplet
