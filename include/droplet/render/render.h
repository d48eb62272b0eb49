// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "droplet/drawing/picture.h"
#include "droplet/render/environment.h"
#include "droplet/render/paint.h"
#include "droplet/render/stand_look.h"
#include "droplet/render/stand_openness.h"
#include "droplet/render/stand_water.h"
#include "droplet/shape/base_surface.h"
#include "droplet/surface/material.h"
#include "droplet/surface/surface.h"
#include "droplet/surface/textured_mesh.h"
#include "droplet/vector.h"

namespace droplet {

/// Preset viewpoint.
enum class View { ThreeQuarter, Top, Side };

/// View with a name: three-quarter, top, side.
/// @throws Error InvalidArgument
View viewNamed(std::string_view name);

/// Direction from the droplet to the camera.
struct CameraPlace {
    double azimuth = 0.0;    ///< counter-clockwise from the picture's right, seen from above [rad]
    double elevation = 0.0;  ///< above the ground [rad] 0 … π/2; with a stand that is an object −π/2 … π/2
};

/// Light on a droplet.
enum class Lighting {
    Studio,   ///< soft boxes in a room, fixed relative to the camera
    Uniform,  ///< radiance 1 from all directions, for measurements
};

/// Box with edges along the axes [m].
struct ViewBox {
    Vec3 low;   ///< corner with the smallest coordinates
    Vec3 high;  ///< corner with the largest coordinates
};

/// Smallest box around a surface and another box; for a surface without vertices, that box.
std::optional<ViewBox> around(const Surface& surface, const std::optional<ViewBox>& box = {});

/// Options of a rendered picture.
struct RenderOptions {
    int width = 1280;                        ///< [px] 1 … 8192
    int height = 960;                        ///< [px] 1 … 8192
    View view = View::ThreeQuarter;          ///< of the camera
    std::optional<CameraPlace> camera = {};  ///< replaces the view's direction
    std::optional<Vec3> look_at = {};        ///< point in the picture's middle [m]; empty: all is in the middle
    std::optional<double> distance = {};     ///< from there to the camera [m], > 0; empty: all fits into the picture
    double azimuth = 0.0;                    ///< turn of the droplet, counter-clockwise seen from above [rad]
    bool fit_all_azimuths = false;           ///< frame the droplet so that it fits at every azimuth, for a turntable
    int samples = 16;                        ///< rays per pixel with detail; a quarter of it elsewhere. 4 … 256
    Look look;                               ///< of the liquid: lookOf(material)
    std::vector<Look> looks = {};            ///< by SurfacePart::droplet, instead of `look`; empty: all are alike
    std::optional<Picture> colour_map = {};  ///< picture over the surface's uv: its colours multiply the light that
                                             ///< enters the liquid, or the colour of opaque matter
    Lighting lighting = Lighting::Studio;    ///< Uniform ignores `environment`
    std::optional<Environment> environment = {};  ///< light instead of the studio's, fixed relative to the camera and
                                                  ///< scaled to the same brightness of level ground
    Vec2 extent = {};                    ///< physical size of the mask, centred at the origin [m]; > 0 with `ground`
    std::optional<Picture> ground = {};  ///< picture on the ground; empty: a table with a fine ruling
    bool light_table = false;            ///< that table is light grey, which shows colours as they are; else dark
    std::optional<TexturedMesh> stand = {};            ///< ground instead of the plane z = 0, uv as the droplet's
    std::vector<StandLook> stand_looks = {};           ///< of an object as stand; empty: it is plain
    std::vector<std::uint32_t> stand_materials = {};   ///< in `stand_looks`, of every triangle of the stand
    std::vector<Vec3> stand_colours = {};              ///< of every vertex of the stand: multiply the looks' colours,
                                                       ///< linear, 0 … 1; empty: all are 1
    std::optional<StandOpenness> stand_openness = {};  ///< light that reaches a stand that is an object past the object
                                                       ///< itself; empty: all of it
    bool shows_room = false;                           ///< behind all, the room that lights it, as for glass; else dark
    bool shows_whole_stand = true;                     ///< true: the stand is an object, shown whole; false: ground
    std::optional<StandWater> stand_water = {};  ///< light and wetness below many small droplets on a stand that is an
                                                 ///< object, instead of one map of light over its uv. The picture then
                                                 ///< frames the stand, or `framed`, and not the droplets
    std::optional<ViewBox> framed = {};  ///< box for the camera, the ruling and the light, so that pictures of several
                                         ///< surfaces are comparable; contains the surface. Empty: the surface's box
    std::optional<Paint> paint = {};     ///< opaque colours instead of the material

    /// @throws Error InvalidArgument
    void validate() const;
};

/// Whether this build has the ray tracer. Builds without Embree and Cairo, such as the npm package, have not.
[[nodiscard]] bool canRender() noexcept;

/// Renders droplets realistically by ray tracing: refraction and reflection by Snell's and Fresnel's laws with smooth
/// normals, absorption in the liquid (Beer and Lambert), the ground, and the light that the droplets focus on it. The
/// base touches the ground without air between: the ground is seen through one surface.
///
/// The plane z = 0 is endless ground. A picture on it covers the mask's extent and is mirrored repeatedly beyond, so it
/// has no seams. For curved ground, set `stand` to groundMesh(…); otherwise only its part below the droplets is seen.
/// With `paint`, pictures of at least 320 by 240 pixels have a legend.
///
/// Guarantees: the same bytes for the same surface and options, with any number of threads. Floating-point modes of the
/// caller's threads are as before.
/// @param surface  valid; closed or open; with `framed` or `stand_water` it may have no triangles: then only the ground
///                 is drawn
/// @param options  size, camera, light and ground
/// @throws Error   InvalidArgument
Picture render(const Surface& surface, const RenderOptions& options = {});

/// Renders droplets without ground and backdrop, to put over another picture. Reflections are opaque, the liquid is
/// transparent where the ground would be seen, and shadows are dark. Over black the layer shows what the liquid
/// reflects, over white also the white ground seen through it, in sRGB levels. A stand is drawn, with the droplet's
/// shadow on it; a legend is not. Arguments and guarantees as of render.
Layer renderCutOut(const Surface& surface, const RenderOptions& options = {});

/// Mesh of curved ground for RenderOptions::stand: its height field over the mask's extent and a margin, as far as the
/// ground reaches.
/// @param ground  not flat
/// @param extent  of the mask, centred at the origin [m]; both > 0
/// @throws Error  InvalidArgument
TexturedMesh groundMesh(const BaseSurface& ground, Vec2 extent);

}  // namespace droplet
