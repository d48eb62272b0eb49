// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace droplet {

/// How droplets on glass are shaped: what the force balance does not need and a picture does.
struct ShapeOptions {
    double contact_angle = 1.6580627893946132;  ///< θ [rad], 95°, of coated glass (thesis 3.1); over 0, below π
    double largest_stretch = 1.2;  ///< half the straight part over the contact radius, of the fastest; ≥ 0, ≤ 10
    double stretch_speed = 0.25;   ///< at which half of that is reached [m/s], > 0

    /// @throws Error InvalidArgument
    void validate() const;
};

/// A droplet as a drug capsule cut by the glass (thesis, section 3.2.1): all that is within a radius of a straight
/// piece of line, above the glass. At rest the line is a point, and the capsule the spherical cap.
struct RunningShape {
    double contact_radius = 0.0;  ///< of the round ends on the glass [m]
    double half_length = 0.0;     ///< of the line, along the motion [m]
    double radius = 0.0;          ///< of the round ends [m]
    double centre_height = 0.0;   ///< of the line over the glass [m]; negative below 90°

    [[nodiscard]] double height() const { return radius + centre_height; }
    /// Of what is seen of the round ends from over the glass [m]: beyond 90° more than their contact.
    [[nodiscard]] double silhouette() const { return centre_height > 0.0 ? radius : contact_radius; }
    /// Of the water over the glass [m³].
    [[nodiscard]] double volume() const;
};

/// A droplet's shape at a speed. The thesis gives no law for how droplets lengthen; here the line grows as v/(v + v½)
/// and the cross-section shrinks to make up for it.
///
/// Guarantees: volume() is `volume` to rounding.
/// @param volume   [m³], > 0
/// @param speed    along the glass [m/s], ≥ 0
/// @param options  valid
/// @throws Error   InvalidArgument
RunningShape runningShape(double volume, double speed, const ShapeOptions& options = {});

}  // namespace droplet
