// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "droplet/render/stand_water.h"
#include "droplet/surface/material.h"
#include "render/light_map.h"
#include "render/optics.h"
#include "render/ray_tracer.h"
#include "render/studio_light.h"

namespace droplet {

/// Light that small droplets gather below themselves, and their shadows, on ground of any shape. It comes from textures
/// that are computed once for a typical droplet, by the light's angle to the normal. Each droplet's textures are turned
/// by the light's azimuth and stretched to its base.
class BaseLight {
public:
    /// @param scene   for lengths
    /// @param look    of the liquid
    /// @param mean_height  of the surface [m], for the liquid's absorption
    /// @param lights  of the studio
    BaseLight(const RayTracer& scene, const Look& look, double mean_height, const std::vector<DropletBase>& bases,
              const std::vector<Light>& lights);

    /// Irradiance divided by π on the ground.
    /// @param open  without droplets
    [[nodiscard]] Vec3f at(Vec3f place, Vec3f normal, Vec3f open) const;

private:
    /// A light as parallel light.
    struct Lamp {
        Vec3f toward;
        Vec3f irradiance;  ///< across it, divided by π
    };
    /// A base in the scene.
    struct Spot {
        Vec3f place;
        Vec3f ahead;  ///< divided by the half length
        Vec3f left;   ///< divided by the half width
        Vec3f normal;
        float reach = 0.0F;
        float size = 0.0F;  ///< mean radius
    };

    /// How a lamp shines on a spot.
    struct Turn {
        Vec2 x;                 ///< direction of the light along the base, unit, in radii
        std::size_t below = 0;  ///< the texture of the next smaller angle
        float share = 0.0F;     ///< of the texture after it
        bool is_lit = false;
    };

    void makeTextures(const Look& look, double mean_height, const std::vector<DropletBase>& bases);
    void sortSpots();
    [[nodiscard]] std::uint64_t cellOf(int x, int y, int z) const;
    [[nodiscard]] Turn turnOf(const Spot& spot, Vec3f toward) const;
    [[nodiscard]] Vec3f gain(const Turn& turn, Vec2 place) const;

    std::vector<Lamp> lamps_;
    std::vector<LightMap> by_angle_;  ///< light from +x, at equal steps of its angle to the normal
    LightMap soft_;                   ///< light from everywhere
    float margin_ = 1.0F;             ///< of the textures, in radii
    std::vector<Spot> spots_;
    std::vector<Turn> turns_;  ///< of all lamps, for each spot
    float cell_ = 1.0F;
    std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> in_cell_;  ///< spots that reach a cell
};

}  // namespace droplet
