// SPDX-License-Identifier: GPL-3.0-or-later
// Droplets over time in a scene, as crowds of copies of a few meshes.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "droplet/surface/material.h"
#include "droplet/vector.h"
#include "io/droplet_histories.h"
#include "io/droplet_meshes.h"
#include "scene/scene.h"

namespace droplet {

/// Pose of the ground in a frame, in the file's frame.
struct CrowdPose {
    Float3 place{};                       ///< [m]
    Float4 turn{0.0F, 0.0F, 0.0F, 1.0F};  ///< x first, w last
};

/// Vertices and normals that a mesh has instead of its own.
struct DropletShape {
    std::vector<Vec3> vertices;
    std::vector<Vec3> normals;
};

/// How droplets sit on ground that is not flat. Both functions may be called at once.
struct CrowdSeating {
    /// Shape of a mesh that sits on the ground in a pose, in the mesh's frame.
    std::function<DropletShape(const DropletMesh& mesh, const DropletPose& pose)> seat;
    /// Largest distance of a rim from the ground, over the contact radius, of such vertices or a mesh's own.
    std::function<double(const std::vector<Vec3>& vertices, const DropletPose& pose)> gap;
};

/// How droplets look, and what they run over. Each mesh of a droplet has the volume of a cap of contact radius 1 m; z
/// is off the ground.
struct CrowdOptions {
    Material material = Material::Water;
    std::string animation;          ///< name
    int decimals = 5;               ///< of places at the start in metres; sizes have one more
    double place_tolerance = 0.25;  ///< of a run across its path and of a rest, over the half width of the droplet
    double time_tolerance = 5e-3;   ///< additional, of a run along its path [s]
    std::size_t ground = 0;         ///< node that the droplets run over, a root
    std::vector<CrowdPose> poses;   ///< of it, in all frames; empty if it rests
    bool deforms = false;           ///< it deforms, so that droplets at rest on it move
    std::array<Vec3, 2> corners;    ///< of a box that holds all droplets at all times, z up
    std::string corner;             ///< name of the nodes of these corners
    DropletMesh resting;            ///< droplets at rest, which are scaled alike in all directions
    DropletMesh running;            ///< droplets on their way; +x is ahead
    DropletMesh falling;            ///< droplets in the air
    std::optional<CrowdSeating> seating = {};  ///< empty: the ground is flat below a droplet
};

/// Adds droplets to a scene, and the motion of the ground.
///
/// A copy belongs to one droplet after another, so there are about as many as droplets at once. Keys are written where
/// a change exceeds a tolerance: those of the options, DropletPose::looksLike() and, for droplets at rest, kFacing.
///
/// On ground that is not flat a copy has a shape of its own, and another copy follows where that shape fits no more.
/// The rim is within a twentieth of the contact radius of the ground, unless seating leaves it farther away.
/// @param scene  with the ground and its frames per second
void addDroplets(const DropletHistories& histories, const CrowdOptions& options, Scene& scene);

/// Rejects droplets whose file would be too large for viewers.
/// @param shapes  number of copies with a shape of their own
/// @param remedy  what the user can do besides using a shorter time or fewer frames per second
/// @throws Error  InvalidArgument from 128 MiB on
void checkCrowd(const DropletHistories& histories, std::size_t shapes, const char* remedy);

}  // namespace droplet
