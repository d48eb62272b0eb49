// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "droplet/render/render.h"
#include "render/camera.h"
#include "render/optics.h"
#include "render/sky.h"

namespace droplet {

/// Light at the horizon.
inline constexpr Vec3f kDistance = {0.050F, 0.080F, 0.100F};

/// Soft box: a glowing rectangle far away with round corners, brighter in the middle.
struct SoftBox {
    Vec3f centre;  ///< direction toward the centre, unit
    Vec3f right;
    Vec3f up;
    float half_width = 0.0F;   ///< tangent of half its angular width
    float half_height = 0.0F;  ///< tangent of half its angular height
    Vec3f radiance;

    [[nodiscard]] Vec3f seen(Vec3f direction) const;
};

/// Beam of parallel light.
struct Beam {
    Vec3f toward;        ///< direction toward its source, unit, z > 0
    float share = 0.0F;  ///< share of the light's irradiance on level ground
};

/// Light as a set of beams.
struct Light {
    Vec3f irradiance;  ///< on level ground
    std::vector<Beam> beams;
    bool soft = false;  ///< light from all over the sky: its shadows have no detail
};

/// Lighting of a scene. For droplets on the ground it is a dim room with brighter walls, a key light behind the droplet
/// on the left, a band of light above that, and a narrow band on the right. For an upright object the key light is in
/// front on the left, and two lights are at the sides.
class StudioLight {
public:
    /// @param options  lighting, stand, and an environment that replaces the room
    StudioLight(const RenderOptions& options, CameraTurn turn);

    /// Radiance from a direction.
    [[nodiscard]] Vec3f radiance(Vec3f direction) const;
    /// Colour of the backdrop in a direction.
    [[nodiscard]] Vec3f backdrop(Vec3f direction) const;
    /// Irradiance of an open surface, divided by π, by its normal: the first nine spherical harmonics.
    [[nodiscard]] Vec3f diffuse(Vec3f normal) const;
    [[nodiscard]] const std::vector<Light>& lights() const { return lights_; }
    [[nodiscard]] bool uniform() const { return uniform_; }
    /// Irradiance of open level ground.
    [[nodiscard]] Vec3f level() const;

private:
    [[nodiscard]] Vec3f room(Vec3f direction) const;
    void addBoxes(bool upright, CameraTurn turn);
    void addRoom(CameraTurn turn);
    void addSky(CameraTurn turn);
    [[nodiscard]] Vec3f skyAt(Vec3f direction) const;

    bool uniform_;
    bool shows_room_;
    std::optional<Sky> sky_;
    CameraTurn back_;  ///< from directions in the scene to directions in the sky
    std::vector<SoftBox> boxes_;
    std::vector<Light> lights_;
    std::array<Vec3f, 9> harmonics_;
};

}  // namespace droplet
