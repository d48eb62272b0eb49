// SPDX-License-Identifier: GPL-3.0-or-later
// Writer of animated droplets as joints of skinned meshes, which every glTF reader supports.
#pragma once

#include <tiny_gltf.h>

#include <array>
#include <cstdint>
#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

#include "droplet/surface/material.h"
#include "droplet/vector.h"
#include "io/byte_stream.h"
#include "io/droplet_histories.h"
#include "io/droplet_meshes.h"

namespace droplet {

/// What droplets run over.
struct SceneGround {
    /// Pose of the ground in a frame, in the file's frame.
    struct Pose {
        std::array<float, 3> place{};                       ///< [m]
        std::array<float, 4> turn{0.0F, 0.0F, 0.0F, 1.0F};  ///< x first, w last
    };

    std::function<int(tinygltf::Model&)> add;  ///< adds meshes and nodes; returns the node of all
    std::function<void(ByteStream&)> write;    ///< writes the bytes of the meshes
    std::array<Vec3, 2> corners;  ///< of a box that holds all droplets at all times, z up; viewers need it once
    std::string corner;           ///< name of the nodes of these corners
    std::vector<Pose> poses;      ///< of all frames; empty if it rests
};

/// A scene of droplets. Each mesh of a droplet has the volume of a cap of contact radius 1 m; z is off the ground.
struct JointScene {
    double frames_per_second = 30.0;
    Material material = Material::Water;
    std::string animation;          ///< name
    int decimals = 5;               ///< of places in metres in JSON; sizes have one more
    double place_tolerance = 0.25;  ///< of a run across its path and of a rest, over the half width of the droplet
    double time_tolerance = 5e-3;   ///< additional, of a run along its path [s]
    SceneGround ground;
    DropletMesh resting;  ///< droplets at rest, which are scaled alike in all directions
    DropletMesh running;  ///< droplets on their way; +x is ahead
    DropletMesh falling;  ///< droplets in the air
};

/// Writes the scene. A joint belongs to one droplet after another, so there are about as many joints as droplets at
/// once, with one draw call for 62 of them. Keys are written where a change exceeds a tolerance: those of the scene,
/// DropletPose::looksLike() and, for droplets at rest, kFacing.
/// @return  number of bytes written
std::uint64_t writeSceneOfJoints(const DropletHistories& histories, const JointScene& scene, std::ostream& out);

/// Rejects scenes whose file would be too large for viewers.
/// @param remedy  what the user can do besides using a shorter time or fewer frames per second
/// @throws Error  InvalidArgument from 128 MiB on
void checkSceneOfJoints(const DropletHistories& histories, const char* remedy);

}  // namespace droplet
