// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "droplet/surface/textured_mesh.h"
#include "droplet/units.h"
#include "droplet/vector.h"

namespace droplet {

/// Place on the glass, in the vehicle's frame: x to the driver's right, y ahead, z up; the origin is the middle of the
/// lower edge.
struct GlassPlace {
    Vec3 point;   ///< [m]
    Vec3 normal;  ///< outward unit normal, towards wind and rain
    Vec3 across;  ///< unit tangent along the glass's x
    Vec3 up;      ///< unit tangent along the glass's y, perpendicular to `across`
};

/// Triangle of the glass, on the plane and in space.
struct GlassTriangle {
    std::array<Vec2, 3> positions;     ///< corners on the unrolled glass [m]
    std::array<GlassPlace, 3> places;  ///< of the corners
};

/// Speed of the air along the glass, outside of its boundary layer. The direction is always the horizontal wind
/// projected onto the tangent plane.
enum class WindAlongGlass {
    Turned,     ///< full speed of the wind: the glass deflects the flow and does not stop it
    Projected,  ///< speed of the projection: U cos β in the middle of a glass at slope β
};

/// Shape and size of a windshield.
///
/// Positions are on the unrolled glass, as the driver sees it from inside: x from 0 at the left edge to `width`, y from
/// 0 at the lower edge to `height` up the glass [m]. Lengths on the unrolled glass are lengths on the glass, so
/// droplets, tracks and their distances are computed in the plane.
///
/// The vehicle drives ahead through still air, so the wind is horizontal, towards −y. In the thesis (3.1.4) it pulls
/// the droplets horizontally. Air cannot pass through the glass, so here it runs along the glass, in the direction of
/// its projection onto the tangent plane. By default it keeps its full speed (Turned): a windshield turns the flow,
/// which is slower than the vehicle at the lower edge and faster at the upper edge, and the thesis's V is the wind's
/// velocity "out of the boundary layer (relative to the solid plane)", eq. (3.4). With δ/C_D = 6.8 mm, as measured in
/// the thesis's figure 3.3 (Air::boundary_layer), figures 3.10 to 3.12 result only in this way. Projected has the speed
/// of a wind that only the plane itself obstructs: 0 if the glass stands across the wind.
class Glass {
public:
    /// Part of a cylinder: curved across, straight up the glass, leaning back (thesis 3.2.3: 5 m, 45°).
    struct Cylinder {
        double width = 1.4;             ///< along the arc [m], > 0, at most π · radius
        double height = 0.8;            ///< up the glass [m], > 0
        double radius = 5.0;            ///< radius of the curve across [m], > 0; infinity: flat
        double slope = 45.0 * kDegree;  ///< β in the middle, from horizontal [rad], 0 to π/2
    };

    /// Scale and direction of an object that becomes a glass.
    struct Developed {
        double scale = 0.0;     ///< metres on the unrolled glass per unit of u and v, ≥ 0; 0: metresPerUv(object)
        Vec2 ahead{0.0, -1.0};  ///< horizontal driving direction in the object's frame; −y is glTF's +Z
    };

    /// Makes a glass from a part of a cylinder.
    /// @throws Error InvalidArgument if a field is out of its range
    explicit Glass(const Cylinder& cylinder);
    /// Makes the default glass.
    Glass() : Glass(Cylinder{}) {}

    /// Makes a glass from a mesh, such as from readObject. Its uv times one scale are the unrolled glass: v runs down
    /// the glass, u runs to the driver's right or left (x always to the right), and the bounding box in uv is the
    /// whole glass. The frame is turned so that the vehicle drives towards y; the origin stays.
    ///
    /// Lengths are exact if the uv are an isometry up to the scale; minStretch() and maxStretch() tell the deviation.
    /// Directions use the isometry nearest to each triangle's map (polar decomposition); normals are interpolated.
    /// Where triangles overlap in uv, the first one is the glass. Where there is none, there is no glass: droplets that
    /// arrive there have left it.
    /// @param object     valid; normals outward
    /// @param developed  scale and driving direction
    /// @throws Error     InvalidArgument; InvalidInput if no triangle has an area both in space and in uv
    Glass(const TexturedMesh& object, const Developed& developed);

    [[nodiscard]] double width() const { return width_; }    ///< Width of the unrolled glass [m].
    [[nodiscard]] double height() const { return height_; }  ///< Height of the unrolled glass [m].
    /// The cylinder; empty for a mesh.
    [[nodiscard]] std::optional<Cylinder> cylinder() const;
    /// Smallest ratio of a length on the object to its length on the unrolled glass; 1 for a cylinder.
    [[nodiscard]] double minStretch() const { return min_stretch_; }
    /// Largest such ratio, over all triangles and directions.
    [[nodiscard]] double maxStretch() const { return max_stretch_; }

    /// Place in space of a position; empty where there is no glass.
    /// @param position  on the unrolled glass [m]
    [[nodiscard]] std::optional<GlassPlace> place(Vec2 position) const;
    /// Whether there is glass at a position.
    [[nodiscard]] bool holds(Vec2 position) const;
    /// Triangles for drawing, which run counter-clockwise on the unrolled glass: those of the mesh, or strips of a
    /// cylinder.
    [[nodiscard]] std::vector<GlassTriangle> triangles() const;

private:
    struct Shape;
    struct CylinderShape;
    struct MeshShape;
    std::shared_ptr<const Shape> shape_;  // immutable: copies share it
    double width_ = 0.0;
    double height_ = 0.0;
    double min_stretch_ = 1.0;
    double max_stretch_ = 1.0;
};

/// Gravity along the glass, (g·across, g·up) [m/s²]; it points to −y in the middle of a cylinder.
/// @param place    place on the glass
/// @param gravity  [m/s²], downward
Vec2 gravityAlong(const GlassPlace& place, double gravity);

/// Inertia along the glass, against the acceleration of the vehicle [m/s²].
/// @param place         place on the glass
/// @param acceleration  acceleration of the vehicle [m/s²]; negative: it brakes
Vec2 inertiaAlong(const GlassPlace& place, double acceleration);

/// Wind along the glass outside of its boundary layer [m/s]; it points to +y in the middle of a cylinder.
/// @param place  place on the glass
/// @param speed  speed of the vehicle [m/s]
/// @param how    speed along the glass: full or projected
Vec2 windAlong(const GlassPlace& place, double speed, WindAlongGlass how);

}  // namespace droplet
