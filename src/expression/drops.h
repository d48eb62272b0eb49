// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "droplet/expression/expression.h"

namespace droplet {

/// Particles that are drawn as one droplet.
struct DropMembers {
    std::vector<std::uint32_t> indices;  ///< in the frame, ascending
    bool is_landed = false;              ///< whether it has touched liquid
};

/// Ellipse of the second moments of a droplet's particles, scaled to the area π.
struct DropEllipse {
    Vec2 centre;           ///< centroid of the particles [m]
    Vec2 axis{1.0, 0.0};   ///< of length 1, along the ellipse
    double stretch = 1.0;  ///< half of the length; its inverse is half of the width
    double fill = 1.0;     ///< area of the particles over that of their ellipse: about 1 if they fill it evenly

    /// Vector from the space in which the ellipse is a circle.
    [[nodiscard]] Vec2 stretched(Vec2 a) const
    {
        const double along = dot(axis, a);
        return a + (along * (stretch - 1.0)) * axis + ((1.0 / stretch - 1.0)) * (a - along * axis);
    }
    /// Vector into the space in which the ellipse is a circle.
    [[nodiscard]] Vec2 compressed(Vec2 a) const
    {
        const double along = dot(axis, a);
        return a + (along * (1.0 / stretch - 1.0)) * axis + (stretch - 1.0) * (a - along * axis);
    }
};

/// Ellipse of some particles of a frame, each of which is a disc.
DropEllipse ellipseOf(const std::vector<std::uint32_t>& indices, const ParticleFrame& frame);

/// Half of a teardrop's contour along its axis: a round head, and a tail (1 − t)^p that leaves it along its tangent.
struct Teardrop {
    double head = 1.0;      ///< radius of the head
    double length = 1.0;    ///< from the head's middle to the tip; a disc if not more than the radius
    double exponent = 1.0;  ///< p
    double tangent = 1.0;   ///< sine of the angle at which the tail leaves the head, from its widest place

    /// Half of the width at a distance behind the head's middle, from −head to the tip.
    [[nodiscard]] double halfWidth(double along) const;
    /// Area, exact.
    [[nodiscard]] double area() const;
};

/// Teardrop of the area of a disc.
/// @param radius  of the disc
/// @param length  from the head's middle to the tip
/// @param slope   0.2: a thick body that ends late … 1.2: a round head with a thin tail
Teardrop teardropOf(double radius, double length, double slope);

/// Droplet of a drawing.
struct Drop {
    DropMembers members;
    bool is_near = false;  ///< whether it is near to liquid: then the two have a common field, and flow together
    double share = 1.0;    ///< of its shape in that field; the rest is that of its particles
    double water = 1.0;    ///< area, in areas of a particle: particles that hold air have none
    DropEllipse ellipse;
    Teardrop shape;
    std::vector<Vec2> spine;  ///< from the ellipse's centre to the tip, at equal distances, in the ellipse's space

    /// Outline, counter-clockwise, of the area of the particles.
    [[nodiscard]] std::vector<Vec2> outline(double spacing) const;
};

/// Droplets of the last frame that `state` has seen.
std::vector<Drop> dropsOf(const ExpressionState& state, const ParticleFrame& frame, const ExpressionOptions& options);

}  // namespace droplet
