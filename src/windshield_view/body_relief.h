// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "droplet/body/droplet_body.h"
#include "droplet/wind/forces.h"
#include "droplet/windshield/droplets.h"
#include "droplet/windshield/glass.h"
#include "render/optics.h"
#include "windshield_view/glass_frame.h"

namespace droplet {

/// @throws Error InvalidArgument unless the shape is Capsule or Capillary
void checkBody(BodyShape shape);

/// Heights and normals of a droplet's surface over the glass, in the frame of the droplet (BodyConditions). Where the
/// droplet overhangs its contact, the air below it is ignored.
class BodyRelief {
public:
    /// Point of the surface.
    struct Point {
        float height = 0.0F;  ///< [m]
        Vec3f normal;         ///< unit, outward
    };

    /// @param bodies  capillary ones: their vertices lie in planes through the apex
    BodyRelief(const DropletBodies& bodies, const BodyConditions& conditions);

    /// Distance from the outline, seen from above, positive inside [m]; exact near the outline.
    [[nodiscard]] float inside(Vec2f place) const;
    /// Surface over a place within the outline; beyond it, its nearest point along the ray from the apex.
    [[nodiscard]] Point at(Vec2f place) const;
    /// Outward normal where a ray leaves the droplet.
    /// @param from       point on the glass
    /// @param direction  unit, z > 0
    [[nodiscard]] Vec3f normalAtExit(Vec2f from, Vec3f direction) const;

    Vec2f low;                ///< corner of the box around the outline [m]
    Vec2f high;               ///< opposite corner [m]
    float half_width = 0.0F;  ///< half the width across the motion [m]

private:
    static constexpr std::size_t kAngles = 64;
    static constexpr std::size_t kLevels = 16;

    struct Node {
        float height = 0.0F;
        float x = 0.0F;  ///< of the normal
        float y = 0.0F;
    };
    /// Ray from the apex, seen from above.
    struct Direction {
        float radius = 0.0F;  ///< of the outline [m]
        float square = 0.0F;  ///< cosine of the angle between the ray and the outline's normal
        std::array<Node, kLevels + 1> nodes;
    };
    /// Place in the table.
    struct Cell;
    [[nodiscard]] Cell cellAt(Vec2f place) const;
    [[nodiscard]] float heightAt(Vec2f place) const;
    [[nodiscard]] float volume() const;
    void scale(float factor);

    Vec2f apex_;
    float top_ = 0.0F;  ///< largest height [m]
    std::array<Direction, kAngles + 1> directions_;
};

/// Makes the reliefs of running droplets on a glass.
class Reliefs {
public:
    /// @param shape  Capillary, or Capsule, which has no relief
    Reliefs(const Glass& glass, BodyShape shape, const ForceModel& forces);

    /// Relief of a droplet; empty if its shape is a capsule or it is beside the glass. Its x axis is along the motion,
    /// at rest along the glass's x. A running droplet is as in steady motion: what drives it equals its friction.
    [[nodiscard]] std::optional<BodyRelief> of(const RunningDroplet& droplet) const;

private:
    Glass glass_;
    ForceModel forces_;
    std::optional<DropletBodies> bodies_;
};

}  // namespace droplet
