// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string_view>

#include "droplet/picture/paint.h"
#include "droplet/picture/picture.h"
#include "droplet/shape/base_surface.h"
#include "droplet/surface/material.h"
#include "droplet/surface/surface.h"
#include "droplet/surface/textured_mesh.h"
#include "droplet/vector.h"

namespace droplet {

/// Where a droplet is looked at from.
enum class View { ThreeQuarter, Top, Side };

/// The view of that name: three-quarter, top, side.
/// @throws Error InvalidArgument
View viewNamed(std::string_view name);

/// What shines on a droplet.
enum class Lighting {
    Studio,   ///< soft boxes in a room; they keep their places beside the camera
    Uniform,  ///< radiance 1 from everywhere, unit light on all ground: for measuring
};

/// A box with edges along the axes [m].
struct ViewBox {
    Vec3 low;
    Vec3 high;
};

/// The smallest box around a surface and another box; of a surface without vertices, that box.
std::optional<ViewBox> around(const Surface& surface, const std::optional<ViewBox>& box = {});

/// How a picture is taken.
struct RenderOptions {
    int width = 1280;  ///< [px] 1 … 8192
    int height = 960;  ///< [px] 1 … 8192
    View view = View::ThreeQuarter;
    double azimuth = 0.0;        ///< how far the droplet is turned, counter-clockwise seen from above [rad]
    bool fits_any_turn = false;  ///< framed so that it fits at every azimuth, as the pictures of a turntable must be
    int samples = 16;            ///< rays through a pixel where there is something to see, a quarter of it elsewhere
                                 ///< 4 … 256
    Look look;                   ///< of the liquid: lookOf(material)
    Lighting lighting = Lighting::Studio;
    Vec2 extent = {};                    ///< physical size of the image, centred at the origin [m]; > 0 with `ground`
    std::optional<Picture> ground = {};  ///< what the droplet stands on; empty: a table with a fine ruling
    std::optional<TexturedMesh> stand = {};  ///< what the droplet stands on if not the plane z = 0, uv as the droplet's
    bool frames_stand = true;            ///< show all of the stand, an object then; otherwise the droplets, on ground
    std::optional<ViewBox> framed = {};  ///< what the camera frames, and what gives the table its ruling and light, so
                                         ///< that pictures of several surfaces can be compared; it must hold the
                                         ///< surface. Empty: the surface
    std::optional<Paint> paint = {};     ///< opaque colours instead of the material

    /// @throws Error InvalidArgument
    void validate() const;
};

/// A picture of droplets as they would look, by tracing rays: refraction and reflection by Snell's and Fresnel's laws
/// at the surface with its smooth normals, absorption along the way through the liquid (Beer and Lambert), a table or
/// picture they stand on, and the light they gather there. The base touches the ground as a liquid does, without air
/// between: what is below is seen through one surface.
///
/// Liquid on the plane z = 0 stands on ground without end; where a picture is given it covers the mask's extent, and
/// beyond it is mirrored again and again, so that it goes on without a seam. On curved ground give `stand`, made by
/// groundMesh, or nothing but the base is seen of it. With `paint` there is a legend, too, where the picture is at
/// least 320 by 240.
///
/// Guarantees: the same bytes for the same surface and options, at any number of threads. Floating-point modes of the
/// caller's threads are as before.
/// @param surface  valid; closed or open; with `framed` it may be without triangles: then there is the ground alone
/// @throws Error   InvalidArgument
Picture render(const Surface& surface, const RenderOptions& options = {});

/// Curved ground as a mesh to stand droplets on: its height field over the image's extent and a part of it around, as
/// far as there is ground.
/// @param ground  not flat
/// @param extent  of the image, centred at the origin [m]; both > 0
/// @throws Error  InvalidArgument
TexturedMesh groundMesh(const BaseSurface& ground, Vec2 extent);

}  // namespace droplet
