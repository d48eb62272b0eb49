// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "droplet/drawing/picture.h"
#include "droplet/flow/flow.h"
#include "droplet/flow/flow_shapes.h"
#include "droplet/flow/flow_terrain.h"
#include "droplet/flow/object_motion.h"
#include "droplet/flow_io/droplet_surfaces.h"
#include "droplet/flow_io/flow_object.h"
#include "droplet/flow_io/trail_film.h"
#include "droplet/render/render.h"
#include "droplet/surface/surface.h"

namespace droplet {

/// Options of FlowPainter.
struct FlowPainterOptions {
    /// Size, view, samples, look and light. A picture on the ground (`ground`) is the object's texture, and needs uvs.
    /// `framed` is a box in the world that the pictures show, framedOver() for an object that moves; empty: the object
    /// fills the picture. `stand`, `stand_water` and `extent` are replaced.
    RenderOptions render = {};
    TrailFilm film = {};  ///< behind the droplets

    /// Checks all fields.
    /// @throws Error InvalidArgument if a field is out of its range
    void validate() const;
};

/// What a picture shows besides droplets.
struct FlowMoment {
    double time = 0.0;     ///< [s]; not before the last track
    ObjectPose pose = {};  ///< of the object in the world
    double azimuth = 0.0;  ///< turn of the whole scene, added to that of the options, for a turntable [rad]
};

/// Box in the world around an object in all poses of a motion from time 0 on; empty if it rests.
/// @param object    at its place
/// @param motion    of it
/// @param duration  [s], ≥ 0
std::optional<ViewBox> framedOver(const FlowObject& object, const ObjectMotion& motion, double duration);

/// Box around an object in all of its shapes; empty if it has one.
/// @param shapes  of its surface
std::optional<ViewBox> framedOver(const FlowShapes& shapes);

/// Renders droplets on an object, frame by frame: droplets refract, gather light below them and cast shadows; where
/// they ran, the object is darker and glossier until it dries. For every frame: advanceFlow(), add(), then picture().
/// All frames have one camera.
///
/// Guarantees: the same calls give the same bytes with any number of threads.
class FlowPainter {
public:
    /// Prepares a dry object.
    /// @param object   with uvs if it has a texture
    /// @param terrain  of this object's triangles; must outlive the painter
    /// @param options  camera, light, film
    /// @throws Error   InvalidArgument if an option is out of its range, or the object has no uvs for a texture
    FlowPainter(const FlowObject& object, const FlowTerrain& terrain, const FlowPainterOptions& options = {});
    ~FlowPainter();
    FlowPainter(FlowPainter&&) noexcept;             ///< Moves the state.
    FlowPainter& operator=(FlowPainter&&) noexcept;  ///< Moves the state.

    /// Leaves films on the paths of one advanceFlow().
    /// @param tracks  FlowState::tracks
    void add(std::span<const FlowTrack> tracks);

    /// Shows another shape of the object from now on. What is wet stays so; tracks are still those on the first shape.
    /// @param object   as inShape() makes it
    /// @param terrain  of this shape; must outlive the pictures of it
    void reshape(const FlowObject& object, const FlowTerrain& terrain);

    /// Renders a picture. Droplets are bent to follow the object. Those in the air, farther from the object than its
    /// size, are left out.
    /// @param moment    time, pose and view
    /// @param samples   droplets at that time
    /// @param droplets  dropletSurfaces() of these samples, in the object's frame
    Picture picture(const FlowMoment& moment, std::span<const FlowSample> samples, const Surface& droplets);

    /// Renders a picture of droplets that sit on the object.
    /// @param moment    time, pose and view
    /// @param droplets  in the object's frame
    Picture picture(const FlowMoment& moment, SettledDroplets droplets);

    /// Exact bytes of what is wet.
    [[nodiscard]] std::string bytes() const;

    /// Wets what was wet, so that the next pictures equal those of the painter that was saved.
    /// @param bytes  of bytes(), by a painter of the same object and options
    /// @param name   of the source, for messages
    /// @throws Error InvalidInput if the bytes are damaged, or of another object or other options
    void restore(std::string_view bytes, const std::string& name);

private:
    struct Content;
    std::unique_ptr<Content> content_;
};

}  // namespace droplet
