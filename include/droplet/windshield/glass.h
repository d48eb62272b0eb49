// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>

#include "droplet/surface/textured_mesh.h"
#include "droplet/units.h"
#include "droplet/vector.h"

namespace droplet {

/// A place on the glass, in the vehicle's frame: x to the driver's right, y ahead, z up; the origin is the middle of
/// the developed glass's lower edge.
struct GlassPlace {
    Vec3 point;   ///< [m]
    Vec3 normal;  ///< unit, outward: into the wind and the rain
    Vec3 across;  ///< unit tangent along the glass's x
    Vec3 up;      ///< unit tangent along the glass's y, at a right angle to across
};

/// How fast the air runs along the glass, outside of its boundary layer. Its direction is always that of the level wind
/// projected onto the tangent plane.
enum class WindAlongGlass {
    Turned,     ///< with the wind's whole speed: the flow is deflected, not stopped
    Projected,  ///< with that of the projection: U cos β in the middle of a glass at slope β
};

/// A windshield's shape, its measures and how the wind meets it.
///
/// Positions are on the glass rolled out flat, as the driver sees it from inside: x from 0 at the left edge to `width`,
/// y from 0 at the lower edge to `height` up the glass [m]. Rolled out, it is developable: lengths on it are lengths on
/// the glass, so that droplets, tracks and their distances are dealt with in the plane.
///
/// The wind is that of a vehicle driving ahead through still air: level, towards −y. The thesis (3.1.4) has it pull the
/// droplets horizontally; air cannot pass through the glass, so here it runs along it: projected onto the tangent
/// plane. The drag's size is that of its speed. By default this is the whole speed (Turned): a windshield turns the
/// flow, which slows down at its foot and is faster than the vehicle at its upper edge, and the thesis's V is the
/// wind's velocity "out of the boundary layer (relative to the solid plane)", eq. (3.4). With δ/C_D = 6.8 mm, as the
/// thesis's figure 3.3 measures it (Air::boundary_layer), only so do figures 3.10 to 3.12 come out as the thesis tells
/// them. Projected is what is left of the wind that has no obstacle but the plane itself: none on a glass across it.
class Glass {
public:
    /// A part of a cylinder: bent across, straight up the glass, leaning back (thesis 3.2.3: 5 m, 45°).
    struct Cylinder {
        double width = 1.4;             ///< along the arc [m], > 0, at most π · radius
        double height = 0.8;            ///< up the glass [m], > 0
        double radius = 5.0;            ///< of the bend across [m], > 0; infinity: flat
        double slope = 45.0 * kDegree;  ///< β of its middle from horizontal [rad], 0 to π/2
    };

    /// How an object becomes a glass.
    struct Developed {
        double scale = 0.0;     ///< metres of the rolled out glass per unit of uv, both ways; 0: metresPerUv(object)
        Vec2 ahead{0.0, -1.0};  ///< where the vehicle drives in the object's frame, level: −y is where glTF's +Z goes
    };

    /// @throws Error InvalidArgument
    explicit Glass(const Cylinder& cylinder);
    Glass() : Glass(Cylinder{}) {}

    /// A mesh, such as readObject gives: rolled out by its uv times one scale, v down the glass, u so that the driver
    /// sees x run to the right; its bounding box in uv is the rolled out glass. The frame is turned so that the vehicle
    /// drives towards y; the origin stays where the object has it.
    ///
    /// Lengths are right where the uv are an isometry up to that scale; how far they are from one, minStretch() and
    /// maxStretch() tell. Directions go by the isometry nearest to each triangle's map (polar decomposition), normals
    /// are interpolated. Where triangles overlap in uv, the first one is the glass; where there is none, there is no
    /// glass: droplets that come there have left it.
    /// @param object  valid; normals outward
    /// @throws Error  InvalidArgument; InvalidInput if no triangle has an area both in space and in uv
    Glass(const TexturedMesh& object, const Developed& developed);

    [[nodiscard]] double width() const { return width_; }    ///< of the rolled out glass [m]
    [[nodiscard]] double height() const { return height_; }  ///< [m]
    /// The cylinder, or empty for a mesh.
    [[nodiscard]] std::optional<Cylinder> cylinder() const;
    /// Length on the object per length on the rolled out glass, over all its triangles and directions; 1 for a
    /// cylinder.
    [[nodiscard]] double minStretch() const { return min_stretch_; }
    [[nodiscard]] double maxStretch() const { return max_stretch_; }

    /// @param position  on the rolled out glass [m]
    /// @return          empty where there is no glass
    [[nodiscard]] std::optional<GlassPlace> place(Vec2 position) const;
    [[nodiscard]] bool holds(Vec2 position) const;

private:
    struct Shape;
    struct Bent;
    struct Meshed;
    std::shared_ptr<const Shape> shape_;  ///< never changes: copies may share it
    double width_ = 0.0;
    double height_ = 0.0;
    double min_stretch_ = 1.0;
    double max_stretch_ = 1.0;
};

/// Gravity along the glass, (g·across, g·up) [m/s²]; the way down is towards −y in the middle of a cylinder.
/// @param gravity  [m/s²], downward
Vec2 gravityAlong(const GlassPlace& place, double gravity);

/// What an accelerating vehicle does to water along the glass: less its acceleration, which points ahead [m/s²].
/// @param acceleration  of the vehicle, ahead [m/s²]; negative: it brakes
Vec2 inertiaAlong(const GlassPlace& place, double acceleration);

/// The wind along the glass outside of its boundary layer [m/s], towards +y in the middle of a cylinder.
/// @param speed  of the vehicle [m/s]
Vec2 windAlong(const GlassPlace& place, double speed, WindAlongGlass how);

}  // namespace droplet
