// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace droplet {

/// Shape of droplets in pictures; the balance of forces does not use it.
struct ShapeOptions {
    double contact_angle = 1.6580627893946132;  ///< θ [rad], from 1° to 179°; 95° is coated glass (thesis 3.1)
    double largest_stretch = 1.2;               ///< limit of half_length / contact_radius at high speed, from 0 to 10
    double stretch_speed = 0.25;                ///< speed at which half of that limit is reached [m/s], > 0

    /// Checks all fields.
    /// @throws Error InvalidArgument if a field is out of its range
    void validate() const;
};

/// Capsule cut by the glass (thesis, section 3.2.1): all points above the glass within `radius` of a straight line
/// segment, the axis. At rest the axis is a point and the capsule a spherical cap.
struct RunningShape {
    double contact_radius = 0.0;  ///< radius of the round ends on the glass [m]
    double half_length = 0.0;     ///< half the length of the axis, along the motion [m]
    double radius = 0.0;          ///< radius of the round ends [m]
    double centre_height = 0.0;   ///< height of the axis over the glass [m]; negative if θ < 90°

    /// Height of the droplet [m].
    [[nodiscard]] double height() const { return radius + centre_height; }
    /// Radius of the round ends seen from above [m]; if θ > 90°, larger than contact_radius.
    [[nodiscard]] double silhouette() const { return centre_height > 0.0 ? radius : contact_radius; }
    /// Volume of the water above the glass [m³].
    [[nodiscard]] double volume() const;
};

/// Shape of a droplet at a speed. The thesis gives no law for the length; here the axis grows as v/(v + stretch_speed)
/// and the cross-section shrinks accordingly.
///
/// Guarantees: volume() equals `volume` up to rounding.
/// @param volume   [m³], > 0
/// @param speed    along the glass [m/s], ≥ 0
/// @param options  valid
/// @throws Error   InvalidArgument if an argument is out of its range
RunningShape runningShape(double volume, double speed, const ShapeOptions& options = {});

}  // namespace droplet
