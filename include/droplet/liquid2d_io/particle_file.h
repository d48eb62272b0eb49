// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "droplet/liquid2d/particle_frame.h"

namespace droplet {

/// How numbers of a particle file are taken.
struct ParticleFileOptions {
    std::optional<double> spacing;       ///< of particles at rest [m], > 0; empty: estimated
    double scale = 1.0;                  ///< length of the file's unit [m], > 0; velocities are in that unit per second
    std::string plane = "xy";            ///< axes of the file that become x and y: two of the letters x, y and z
    std::optional<double> rest_density;  ///< in the unit of the file's densities, > 0; empty: the median of the file

    /// @throws Error InvalidArgument, naming field, value and constraint
    void validate() const;
};

/// Particles from a file.
struct ParticleFile {
    ParticleFrame frame;             ///< valid; `time` is that of the file, or 0
    bool has_velocity = false;       ///< if false, all velocities are zero: see fillVelocities()
    bool has_id = false;             ///< if false, ids are the order in the file, from 0
    bool spacing_estimated = false;  ///< whether the spacing is the median distance of nearest neighbours
    std::optional<double> time;      ///< that the file tells [s]
};

/// Reads particles that another simulation wrote.
///
/// The content tells the format; each may be gzipped:
/// - CSV with a header: `x, y, z`, `x_m, y_m, z_m` or ParaView's `Points:0` …; optional velocities `vx, vy, vz`,
///   `velocity_x_m_per_s` … or `velocity:0` …; optional `id` and `density`;
/// - VTK legacy 2.0 to 5.1, ASCII or binary, POLYDATA or UNSTRUCTURED_GRID, as SPlisHSPlasH writes it;
/// - VTK XML (.vtp, .vtu): ASCII, binary or appended, raw or compressed by zlib;
/// - classic BGEO (version 5), as Partio and SPlisHSPlasH write it.
///
/// Point data named velocity, vel or v, id or particle_id, and density or rho are read, in any case of letters. No more
/// than 20 million particles are read, and no more memory is taken than the length of the file justifies.
/// @param path     of the file
/// @param options  valid: unit, plane, spacing
/// @throws Error   InvalidInput, one line that begins with the file's name: unreadable, cut off, wrong counts, numbers
///                 that are not finite, equal ids, fewer than two particles without a given spacing; InvalidArgument
///                 for options
ParticleFile readParticles(const std::filesystem::path& path, const ParticleFileOptions& options = {});

/// Particles from the content of a file, as readParticles() reads it.
/// @param bytes    of the file
/// @param name     of the file, for messages
/// @param options  valid: unit, plane, spacing
/// @throws Error   as readParticles()
ParticleFile parseParticles(std::string_view bytes, const std::string& name, const ParticleFileOptions& options = {});

/// Velocities by differences: (position − previous position) / (time − previous time) of particles with the same id.
/// Particles that the previous frame lacks keep their velocity.
/// @param previous  valid frame
/// @param frame     valid frame of a later time
/// @return          `frame` with new velocities
/// @throws Error    InvalidArgument if `frame` is not later
ParticleFrame fillVelocities(const ParticleFrame& previous, ParticleFrame frame);

}  // namespace droplet
