// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <optional>

#include "droplet/liquid2d/particle_frame.h"

namespace droplet {

/// Formats of particle files.
enum class ParticleFormat {
    Csv,   ///< a row for each particle
    Vtp,   ///< VTK XML PolyData, for ParaView and Houdini
    Bgeo,  ///< classic Houdini geometry, version 5
    Ply,   ///< a point cloud, for Blender and others
};

/// Format by a path's extension: .csv, .vtp, .bgeo or .ply in any case of letters; empty for others.
std::optional<ParticleFormat> particleFormatOf(const std::filesystem::path& path);

/// Writes particles to one file.
///
/// Each has its place x, y, z = 0 and its velocity in metres and seconds, its id, its density relative to that at rest,
/// if that is known, and half a spacing as its radius (`pscale` in BGEO); VTP has the time. CSV has full precision, the
/// others have floats. readParticles() reads CSV, VTP and BGEO. The same frame gives the same bytes; the stream is in a
/// failed state if a write failed.
/// @param frame   valid
/// @param out     takes the bytes
/// @param format  of the file
/// @return        number of bytes
/// @throws Error  InvalidArgument if a number does not fit into a float
std::uint64_t writeParticles(const ParticleFrame& frame, std::ostream& out, ParticleFormat format);

}  // namespace droplet
