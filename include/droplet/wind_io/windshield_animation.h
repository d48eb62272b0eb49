// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <iosfwd>
#include <memory>

#include "droplet/body/running_shape.h"
#include "droplet/scene/format.h"
#include "droplet/surface/material.h"
#include "droplet/windshield/glass.h"
#include "droplet/windshield/windshield.h"

namespace droplet {

/// Method of animating the droplets of a scene.
enum class AnimationMethod {
    /// Joints of skinned meshes, which every glTF reader supports. A joint belongs to one droplet after another: there
    /// are about as many joints as droplets at once, with one draw call for 62 of them. Droplets at rest have a
    /// translation and a scale, both STEP. Running ones have a translation, LINEAR, and a rotation and a scale, both
    /// STEP. The scale is 0 while a joint has no droplet. Keys are written where a change exceeds these tolerances:
    /// positions a quarter of the contact radius, plus 5 ms of the way if running; directions of droplets at rest 1.5°
    /// from the glass's normal; contact radii 1 %; outlines of running droplets a quarter of their width. Droplets
    /// appear and disappear at exact times.
    Nodes,
    /// Texture with every droplet of every frame, for one draw call with a shader of the viewer (docs/formats.md).
    /// Positions are exact to 1/65535 of the glass; contact radii and outlines as for Nodes, rounded to bytes.
    Texture,
};

/// Options of a WindshieldAnimation.
struct WindshieldAnimationOptions {
    double frames_per_second = 30.0;                     ///< > 0
    Material material = Material::Water;                 ///< material of the droplets
    ShapeOptions shape = {};                             ///< shape of the droplets
    AnimationMethod animation = AnimationMethod::Nodes;  ///< method of animation

    /// Checks all fields.
    /// @throws Error InvalidArgument if a field is out of its range
    void validate() const;
};

/// Animation of droplets that run over a windshield, glTF or USD. Takes one state after another, keeps their data in
/// memory, and writes the file at the end.
///
/// A droplet is a scaled mesh of a cap with contact radius 1 m, slightly enlarged to the volume of the true cap. A
/// running droplet is stretched along its motion by λ and made narrower and lower by √λ, which keeps its volume; λ^1.5
/// is the capsule's length over its width (RunningShape). Still droplets are left out: they are in glassMaps(). The
/// glass is a node `glass`. Metres, +Y up, +Z ahead: the front of an object in glTF, as Glass reads it.
class WindshieldAnimation {
public:
    /// Makes a scene without frames.
    /// @throws Error InvalidArgument if an option is out of its range
    WindshieldAnimation(const Glass& glass, const WindshieldAnimationOptions& options = {});
    ~WindshieldAnimation();
    WindshieldAnimation(WindshieldAnimation&&) noexcept;             ///< Moves all frames.
    WindshieldAnimation& operator=(WindshieldAnimation&&) noexcept;  ///< Moves all frames.

    /// Adds the next frame.
    /// @throws Error InvalidArgument if the file would exceed 128 MiB, or its texture 8192 rows
    void add(const WindshieldState& state);

    /// Writes the file.
    ///
    /// Guarantees: the same frames give the same bytes; the stream is in a failed state if a write failed.
    /// @param out    takes the bytes
    /// @param file   form; by default GLB
    /// @return       number of bytes written
    /// @throws Error InvalidArgument if there is no frame, or the form does not exist; USD has no
    /// AnimationMethod::Texture
    std::uint64_t write(std::ostream& out, const AnimatedFile& file = {}) const;

private:
    struct Content;
    std::unique_ptr<Content> content_;
};

}  // namespace droplet
