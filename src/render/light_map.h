// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "droplet/surface/material.h"
#include "render/optics.h"
#include "render/ray_tracer.h"
#include "render/studio_light.h"
#include "render/table.h"

namespace droplet {

/// Optical properties of the liquid, in a scene's units of length.
struct Medium {
    bool clear = true;  ///< false: opaque
    float ior = 1.0F;
    Vec3f absorption;        ///< coefficient, per length
    double roughness = 0.0;  ///< of its surface, 0 … 1
    float transmission = 1;  ///< share of the light that enters
};

/// Medium of a look.
/// @param mean_height  of the liquid, whose white ground has the look's colour [m]
/// @param scale        unit of length [m]
Medium mediumOf(const Look& look, double mean_height, double scale);

/// Medium that light enters at a stand. Without an absorption it takes nothing.
Medium mediumOf(const StandLook& look, double scale);

/// Media of all droplets.
struct Media {
    Medium only;                              ///< of all, unless there are several
    std::vector<Medium> several = {};         ///< by droplet
    std::vector<std::uint32_t> droplet = {};  ///< of every vertex of the surface
    std::optional<PicturePyramid> map = {};   ///< RenderOptions::colour_map

    /// Number of the droplet that a ray meets.
    [[nodiscard]] std::uint32_t dropletAt(const RayTracer& scene, const Meeting& meeting) const
    {
        return droplet.empty() ? 0 : droplet[scene.triangle(meeting)[0]];
    }
    [[nodiscard]] const Medium& of(std::uint32_t number) const { return several.empty() ? only : several[number]; }
    /// Colour of the map where a ray meets liquid; beyond the picture, that of its edge.
    /// @param width  of the area to average, in uv
    [[nodiscard]] Vec3f mapAt(const Meeting& meeting, double width) const
    {
        return map ? map->at({std::clamp(meeting.uv.x, 0.0, 1.0), std::clamp(meeting.uv.y, 0.0, 1.0)}, width)
                   : grey(1.0F);
    }
};

/// Media of a surface, with `looks` or `look` of the options.
Media mediaOf(const Surface& surface, const RenderOptions& options, double scale);

/// Share of light left after a path through the liquid (Beer and Lambert).
inline Vec3f passed(const Medium& medium, float distance)
{
    const Vec3f depth = distance * medium.absorption;
    return largest(depth) <= 0.0F ? grey(1.0F) : Vec3f{std::exp(-depth.x), std::exp(-depth.y), std::exp(-depth.z)};
}

/// Map of light on the plane around and below a droplet: its share of the light without liquid, or the light itself.
struct LightMap {
    int columns = 0;
    int rows = 0;
    float cell = 0.0F;
    Vec3f low;                        ///< corner of the first cell
    std::vector<Vec3f> values;        ///< row by row
    Vec3f open = {1.0F, 1.0F, 1.0F};  ///< value beyond the map; a margin of the map blends into it

    /// Value at a place, linear between the centres of cells.
    [[nodiscard]] Vec3f at(Vec3f place) const;
};

/// Sends a light's beams through the liquid onto the plane. For every ray of a regular grid, the light that arrives is
/// added, and the light that would arrive without liquid is subtracted.
///
/// Guarantees: the same result with any number of threads.
/// @param scene   liquid on the plane
/// @param media   liquid
/// @param light   beams
/// @param cells   number along the map's longer side; ≥ 8
/// @param blur    standard deviation of a Gaussian that removes grain [cells]; 0 for none
LightMap lightGain(const RayTracer& scene, const Media& media, const Light& light, int cells, float blur);

/// Irradiance of all lights on the plane, divided by π: soft lights on a coarse map, others on a map of `cells` cells.
LightMap lightOnPlane(const RayTracer& scene, const Media& media, const std::vector<Light>& lights, int cells);

/// Share of a light's direct rays that reach a stand around and below droplets, over uv from (0,0) to (1,1): rays
/// through the liquid divided by rays without it.
LightMap lightGainOnStand(const RayTracer& scene, const Media& media, const Light& light, int cells);

}  // namespace droplet
