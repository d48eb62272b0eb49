// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "droplet/body/droplet_body.h"
#include "droplet/body/running_shape.h"
#include "droplet/drawing/picture.h"
#include "droplet/wind/forces.h"
#include "droplet/windshield/glass.h"
#include "droplet/windshield/windshield.h"

namespace droplet {

/// Options of glassMaps(), glassFloatMaps() and GlassMapFrames.
struct GlassMapOptions {
    int width = 2048;  ///< [px], 16 … 8192; the height follows from the glass, with nearly square pixels
    BodyShape body = BodyShape::Capsule;  ///< shape of running droplets: Capsule or Capillary
    ShapeOptions shape = {};              ///< shape of droplets at rest, and of capsules
    ForceModel forces = {};               ///< liquid, contact angle and friction, which shape capillary droplets
    double full_thickness = 5e-3;         ///< thickness of the highest level [m], > 0; more is clipped
    double full_speed = 2.0;              ///< speed of the highest level [m/s], > 0; more is clipped

    /// Checks all fields.
    /// @throws Error InvalidArgument if a field is out of its range
    void validate() const;
};

/// Water on the whole unrolled glass as textures for other renderers, as the driver sees the glass from inside: left
/// edge left, upper edge up, 16 bits per channel, without a colour space. They fit a glass mesh whose uv cover the unit
/// square once.
struct GlassMaps {
    /// Outward unit normal of the water in the glass's tangent frame: red x, to the driver's right; green y, up the
    /// glass; blue z, out of the glass; each (n + 1)/2 of 65535. Bare glass is (32768, 32768, 65535). +Y up, as in
    /// OpenGL. It is the normalised mean over the pixel, so droplets smaller than a pixel do not flicker.
    DeepPicture normal;
    /// Grey: mean thickness of the water over full_thickness; 0: bare. The sum over all pixels is the water on the
    /// glass at any width, except for clipped water.
    DeepPicture thickness;
    /// Red and green: velocity of running droplets along x and y, (v/full_speed + 1)/2 of 65535; at rest (32768,
    /// 32768). Blue: share of the pixel that they cover, of 65535.
    DeepPicture velocity;
};

/// The maps of GlassMaps in floating point.
struct GlassFloatMaps {
    /// Outward unit normal of the water in the glass's tangent frame, from −1 to 1; bare glass is (0, 0, 1).
    FloatPicture normal;
    /// Mean thickness of the water [m]; not clipped.
    FloatPicture thickness;
    /// Red and green: velocity of running droplets along x and y [m/s]; blue: share of the pixel that they cover, 0
    /// … 1.
    FloatPicture velocity;
};

/// Draws maps; pixels are means over their areas. The water of overlapping droplets, and of the film that runs off, is
/// added. Rings of splashes change
/// normals alone: their water is in droplets already.
///
/// Guarantees: the same arguments give the same bytes with any number of threads.
/// @param glass    glass of the simulation
/// @param state    state on this glass
/// @param options  valid
/// @throws Error   InvalidArgument if an option is out of its range
GlassMaps glassMaps(const Glass& glass, const WindshieldState& state, const GlassMapOptions& options = {});

/// Draws maps in floating point; full_thickness and full_speed have no effect.
GlassFloatMaps glassFloatMaps(const Glass& glass, const WindshieldState& state, const GlassMapOptions& options = {});

/// Maps of a simulation, frame by frame: only what has changed since the last frame is drawn.
///
/// Guarantees: each frame has the bytes of glassMaps() or glassFloatMaps(), with any number of threads.
class GlassMapFrames {
public:
    /// Maps of a dry glass.
    /// @param glass    glass of the simulation
    /// @param options  valid
    /// @throws Error   InvalidArgument if an option is out of its range
    explicit GlassMapFrames(const Glass& glass, const GlassMapOptions& options = {});
    ~GlassMapFrames();
    GlassMapFrames(GlassMapFrames&& other) noexcept;             ///< Moves the data.
    GlassMapFrames& operator=(GlassMapFrames&& other) noexcept;  ///< Moves the data.

    /// Maps of a state.
    /// @param state  of one simulation; for another one make new maps
    /// @return       valid until the next call
    const GlassMaps& maps(const WindshieldState& state);
    /// Maps of a state in floating point.
    /// @param state  of one simulation; for another one make new maps
    GlassFloatMaps floatMaps(const WindshieldState& state);

private:
    struct Content;
    std::unique_ptr<Content> content_;
};

}  // namespace droplet
