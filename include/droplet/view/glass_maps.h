// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "droplet/picture/picture.h"
#include "droplet/windshield/glass.h"
#include "droplet/windshield/running_shape.h"
#include "droplet/windshield/windshield.h"

namespace droplet {

/// How maps of the glass are drawn.
struct GlassMapOptions {
    int width = 2048;  ///< [px] 16 … 8192; the height follows, so that pixels are as square as whole ones can be
    ShapeOptions shape = {};       ///< of droplets
    double full_thickness = 5e-3;  ///< what the highest level stands for [m], > 0; more is cut off
    double full_speed = 2.0;       ///< [m/s], > 0; more is cut off

    /// @throws Error InvalidArgument
    void validate() const;
};

/// The water on the whole glass as textures for other programs' renderers, all rolled out flat as the driver sees the
/// glass from inside: left edge left, upper edge up, 16 bits a channel, without a colour space. A glass mesh whose uv
/// cover it once takes them as they are.
struct GlassMaps {
    /// Outward unit normal of the water in the glass's tangent frame: red x, to the driver's right; green y, up the
    /// glass; blue z, out of it; each (n + 1)/2 of 65535. Bare glass is (32768, 32768, 65535). +Y up, as OpenGL has it.
    /// The mean over the pixel, of length 1 again: what is smaller than a pixel does not glitter.
    DeepPicture normal;
    /// Grey: the water's mean thickness over full_thickness; 0: bare. Added up over all pixels it is the water on the
    /// glass, at any width, but for what is cut off.
    DeepPicture thickness;
    /// Red and green: velocity along x and y of what runs or may run there, (v/full_speed + 1)/2 of 65535; at rest
    /// (32768, 32768). Blue: the share of the pixel that it covers, of 65535.
    DeepPicture velocity;
};

/// The same as numbers, for renderers that take floating point.
struct GlassFloatMaps {
    /// Outward unit normal of the water in the glass's tangent frame, each part from −1 to 1; bare glass is (0, 0, 1).
    FloatPicture normal;
    /// Mean thickness of the water [m]; none is cut off.
    FloatPicture thickness;
    /// Red and green: velocity along x and y [m/s] of what runs or may run there; blue: the share of the pixel that it
    /// covers, 0 … 1.
    FloatPicture velocity;
};

/// Draws them: means over the areas of pixels. Where droplets overlap, so does their water.
///
/// Guarantees: the same bytes from the same arguments, at any number of threads.
/// @param state    of this glass
/// @throws Error   InvalidArgument
GlassMaps glassMaps(const Glass& glass, const WindshieldState& state, const GlassMapOptions& options = {});

/// The same as numbers; full_thickness and full_speed do not matter.
GlassFloatMaps glassFloatMaps(const Glass& glass, const WindshieldState& state, const GlassMapOptions& options = {});

}  // namespace droplet
