// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <memory>
#include <optional>
#include <span>

#include "droplet/body/droplet_body.h"
#include "droplet/flow/flow.h"
#include "droplet/flow/flow_shapes.h"
#include "droplet/flow/flow_terrain.h"
#include "droplet/flow/object_motion.h"
#include "droplet/flow_io/flow_object.h"
#include "droplet/flow_io/streak_ribbons.h"
#include "droplet/scene/format.h"
#include "droplet/surface/material.h"
#include "droplet/units.h"
#include "droplet/vector.h"

namespace droplet {

/// Options of a FlowAnimation.
struct FlowAnimationOptions {
    double frames_per_second = 30.0;               ///< > 0
    Material material = Material::Water;           ///< material of the droplets
    Vec3 gravity = {0.0, 0.0, -kStandardGravity};  ///< in the world [m/s²]
    ObjectMotion motion = {};                      ///< of the object in the world

    /// Checks all fields.
    /// @throws Error InvalidArgument if a field is out of its range
    void validate() const;
};

/// Animation of droplets that run over an object, glTF or USD. Takes one frame after another, keeps their data in
/// memory, and writes the file at the end.
///
/// Droplets are joints of skinned meshes, as in AnimationMethod::Nodes. Positions are exact to a tenth of the droplet's
/// half width, plus 2 ms of the way along a path; other tolerances are those of AnimationMethod::Nodes. There are three
/// meshes of a droplet, all with the right volume: a round cap at rest, which is scaled alike in all directions; a head
/// with a tail for running droplets, with the length and width of the droplet's body at every key; and a ball in the
/// air. Droplets sit on the object as seatedDroplets() does it: their rims are within a twentieth of the contact radius
/// of it at every frame, unless it bends more than a droplet can follow. Joints lie in the object's node, which is
/// animated if the object moves. The object has a material for each name in its file. Metres, +Y up.
///
/// An object that deforms has morph targets: the principal components of its shapes, as many as keep its vertices
/// within 5e-5 of its size, and 99 % of its normals within 6 degrees, at every frame; between frames vertices move
/// along lines. Droplets at rest move and turn with it. USD has its points in every frame.
class FlowAnimation {
public:
    /// Makes an animation without frames.
    /// @param object   that the droplets run over
    /// @param terrain  of this object's triangles; must outlive the animation
    /// @param bodies   shapes of the droplets; must outlive the animation
    /// @param options  frame rate, look, gravity
    /// @throws Error  InvalidArgument if an option is out of its range
    FlowAnimation(FlowObject object, const FlowTerrain& terrain, const DropletBodies& bodies,
                  const FlowAnimationOptions& options = {});
    ~FlowAnimation();
    FlowAnimation(FlowAnimation&&) noexcept;             ///< Moves all frames.
    FlowAnimation& operator=(FlowAnimation&&) noexcept;  ///< Moves all frames.

    /// Makes an animation of an object that deforms, without frames.
    /// @param object   in its first shape
    /// @param shapes   of this object's triangles; must outlive the animation
    /// @param bodies   shapes of the droplets; must outlive the animation
    /// @param options  frame rate, look, gravity; their motion rests
    /// @throws Error  InvalidArgument if an option is out of its range
    FlowAnimation(FlowObject object, const FlowShapes& shapes, const DropletBodies& bodies,
                  const FlowAnimationOptions& options = {});

    /// Adds the next frame.
    /// @param time     for the pose of the object [s]
    /// @param samples  droplets of that time, in the object's frame
    /// @param shape    of the object in this frame, and of the samples
    /// @throws Error   InvalidArgument if the file would exceed 128 MiB
    void add(double time, std::span<const FlowSample> samples, std::size_t shape = 0);

    /// Sets the streaks: they appear frame by frame as they are wetted.
    /// @param streaks  of the whole animation: StreakRibbons::growing(), of a film that does not dry
    void setStreaks(StreakMesh streaks);

    /// Writes the file.
    ///
    /// Guarantees: the same frames give the same bytes with any number of threads; the stream is in a failed state if a
    /// write failed.
    /// @param out    takes the bytes
    /// @param file   form; by default GLB
    /// @return       number of bytes written
    /// @throws Error InvalidArgument if there is no frame, or the form does not exist
    std::uint64_t write(std::ostream& out, const AnimatedFile& file = {}) const;

private:
    struct Content;
    std::unique_ptr<Content> content_;
};

}  // namespace droplet
