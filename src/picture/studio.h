// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "droplet/picture/render.h"
#include "picture/camera.h"
#include "picture/optics.h"
#include "picture/sky.h"

namespace droplet {

/// What is seen at the horizon.
inline constexpr Vec3f kDistance = {0.050F, 0.080F, 0.100F};

/// A glowing rectangle far away, with round corners, its middle brighter than its edge.
struct SoftBox {
    Vec3f centre;  ///< direction toward it, unit
    Vec3f right;
    Vec3f up;
    float half_width = 0.0F;   ///< tangent of half its angle
    float half_height = 0.0F;  ///< tangent of half its angle
    Vec3f radiance;

    [[nodiscard]] Vec3f seen(Vec3f direction) const;
};

/// Parallel light.
struct Beam {
    Vec3f toward;        ///< where it comes from, unit, z > 0
    float share = 0.0F;  ///< of its light's irradiance on level ground
};

/// A light as beams.
struct Light {
    Vec3f irradiance;  ///< on level ground
    std::vector<Beam> beams;
    bool soft = false;  ///< from all over the sky: its shadows have no detail
};

/// What shines on a droplet: a dim room brighter at its walls, a key light behind the droplet on the left, a band
/// above it, and a narrow one on the right; on an object that stands upright, a key light in front of it on the left,
/// and two at its sides.
class Studio {
public:
    /// @param environment  in place of it; null: none
    Studio(Lighting lighting, bool upright, CameraTurn turn, const Environment* environment = nullptr);

    /// What comes from a direction.
    [[nodiscard]] Vec3f radiance(Vec3f direction) const;
    /// What is seen behind everything.
    [[nodiscard]] Vec3f backdrop(Vec3f direction) const;
    /// Light on a surface of that normal, divided by π, in the open: the first nine spherical harmonics of it.
    [[nodiscard]] Vec3f diffuse(Vec3f normal) const;
    [[nodiscard]] const std::vector<Light>& lights() const { return lights_; }
    [[nodiscard]] bool uniform() const { return uniform_; }
    /// Light on level ground in the open.
    [[nodiscard]] Vec3f level() const;

private:
    [[nodiscard]] Vec3f room(Vec3f direction) const;
    void addBoxes(bool upright, CameraTurn turn);
    void addRoom(CameraTurn turn);
    void addSky(CameraTurn turn);
    [[nodiscard]] Vec3f skyAt(Vec3f direction) const;

    bool uniform_;
    std::optional<Sky> sky_;
    CameraTurn back_;  ///< from directions in the scene to those in the sky
    std::vector<SoftBox> boxes_;
    std::vector<Light> lights_;
    std::array<Vec3f, 9> harmonics_;
};

}  // namespace droplet
