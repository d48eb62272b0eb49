// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <iosfwd>
#include <memory>

#include "droplet/surface/material.h"
#include "droplet/windshield/glass.h"
#include "droplet/windshield/running_shape.h"
#include "droplet/windshield/windshield.h"

namespace droplet {

/// How a scene's droplets are animated.
enum class SceneAnimation {
    /// By joints of skinned meshes, which every reader of glTF knows. A joint is one droplet's after another's: there
    /// are about as many as droplets at once, and one draw call for 62 of them. Droplets at rest have a translation and
    /// a scale, both STEP; running ones a translation, LINEAR, and a rotation and a scale, both STEP. A joint's scale
    /// is
    /// 0 where it has no droplet. Keys stand only where more changes than these tolerances: running droplets are within
    /// a quarter of their contact radius of their place, and along their way within 5 ms more; those at rest within a
    /// quarter of their contact radius, and face within 1.5° where the glass does; contact radii are right to 1 %,
    /// outlines of running droplets to a quarter of their width. No droplet appears or goes earlier or later.
    Nodes,
    /// By a texture with every droplet of every frame, for one draw call and a shader of the viewer's own
    /// (docs/formats.md). Places are right to 1/65535 of the glass; contact radii and outlines are as right as those of
    /// Nodes, and the bytes they become.
    Texture,
};

struct DropletSceneOptions {
    double frames_per_second = 30.0;  ///< > 0
    Material material = Material::Water;
    ShapeOptions shape = {};  ///< of droplets
    SceneAnimation animation = SceneAnimation::Nodes;

    /// @throws Error InvalidArgument
    void validate() const;
};

/// An animated GLB of droplets on their way over a windshield: takes one state after another, keeps what the file will
/// hold of them, and is written in the end.
///
/// The mesh of a droplet is a cap of contact radius 1 m, as large as makes up for its chords, and scaled. A droplet
/// that runs is lengthened along its way by λ and made narrower and lower by √λ, which keeps its volume; λ^1.5 is the
/// capsule's length over its width (RunningShape). Still droplets are left out: they are a map's (glassMaps). The glass
/// is there, too, as a node `glass`. Metres, +Y up, +Z ahead, as glTF has an object's front and Glass reads one.
class DropletScene {
public:
    /// @throws Error InvalidArgument
    DropletScene(const Glass& glass, const DropletSceneOptions& options = {});
    ~DropletScene();
    DropletScene(DropletScene&&) noexcept;
    DropletScene& operator=(DropletScene&&) noexcept;

    /// The next frame.
    /// @throws Error InvalidArgument: the file would reach 128 MiB, or its texture 8192 rows
    void add(const WindshieldState& state);

    /// Guarantees: the same frames give the same bytes; the stream is left failed if it did not take everything.
    /// @return       bytes handed to the stream
    /// @throws Error InvalidArgument if there is no frame
    std::uint64_t write(std::ostream& out) const;

private:
    struct Content;
    std::unique_ptr<Content> content_;
};

}  // namespace droplet
