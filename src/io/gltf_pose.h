// SPDX-License-Identifier: GPL-3.0-or-later
// What an animation of a glTF file does to nodes, joints and morph targets.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <vector>

#include "io/gltf_file.h"
#include "io/key_track.h"
#include "io/placement.h"

namespace droplet {

/// Node of a scene.
struct GltfVisit {
    std::size_t node = 0;
    std::optional<std::size_t> parent;  ///< node
};

/// All nodes of a scene, parents before their children.
using GltfVisits = std::vector<GltfVisit>;

/// Where all is at a time, in the frame of the scene.
struct GltfPose {
    std::vector<Placement> nodes;                ///< of every node
    std::vector<std::vector<double>> weights;    ///< of the morph targets, of every node; empty: they are ignored
    std::vector<std::vector<Placement>> joints;  ///< of every skin, for vertices as the mesh has them; empty: ignored
};

/// Pose without an animation; skins and morph targets are ignored.
GltfPose restPose(const tinygltf::Model& model, const GltfVisits& visits);

/// Reads the keys of a channel that changes a translation, rotation or scale.
/// @throws Damage
KeyTrack trackOf(const tinygltf::Model& model, const GltfChannel& channel);

/// Whether a channel leaves its node where it is without an animation: all keys are the same, that of the node; or all
/// weights of morph targets are 0.
/// @throws Damage
bool isStill(const GltfFile& file, const GltfChannel& channel);

/// Animation of a scene.
class GltfMotion {
public:
    /// Reads an animation.
    /// @param file    must outlive the object
    /// @param visits  of the scene
    /// @param skins   numbers of the skins that the scene uses
    /// @throws Damage
    GltfMotion(const GltfFile& file, GltfVisits visits, const GltfAnimation& animation,
               const std::vector<std::size_t>& skins);

    /// First time of a key [s].
    [[nodiscard]] double begin() const { return begin_; }
    /// Last time of a key [s].
    [[nodiscard]] double end() const { return end_; }
    /// Pose at a time [s]; before and after all keys, that of the nearest one. At a jump, the pose after it.
    [[nodiscard]] GltfPose at(double time) const;

private:
    /// What changes a node.
    struct Tracks {
        std::optional<KeyTrack> translation;
        std::optional<KeyTrack> rotation;
        std::optional<KeyTrack> scale;
        std::vector<KeyTrack> weights;  ///< of every morph target
    };
    /// Joints of a skin.
    struct Skin {
        std::vector<std::size_t> nodes;
        std::vector<Placement> binds;  ///< inverse bind matrices
    };

    void add(const GltfChannel& channel);
    void addSkin(std::size_t number);
    [[nodiscard]] Placement placementAt(std::size_t node, double time) const;
    [[nodiscard]] std::vector<double> weightsAt(std::size_t node, double time) const;

    const GltfFile& file_;
    GltfVisits visits_;
    std::map<std::size_t, Tracks> tracks_;  ///< of nodes
    std::map<std::size_t, Skin> skins_;
    double begin_ = 0.0;
    double end_ = 0.0;
};

}  // namespace droplet
