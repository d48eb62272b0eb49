// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "droplet/mesh/planar_mesh.h"
#include "droplet/vector.h"
#include "droplet/wind/forces.h"

namespace droplet {

/// Model of the shape of droplets on a surface.
enum class BodyShape {
    Capillary,  ///< surface of least energy over a family of footprints: round at rest, with a tail when running
    Springs,    ///< masses and springs with a smooth skin (Fournier, Habibi and Poulin 1998)
    Capsule,    ///< capsule cut by the ground (thesis, section 3.2.1)
};

/// What shapes a droplet. The frame of the droplet: the ground is z = 0, the droplet runs to +x, and the centre of mass
/// of its footprint is the origin.
struct BodyConditions {
    double volume = 0.0;                       ///< [m³], > 0
    double speed = 0.0;                        ///< along the ground [m/s], ≥ 0
    Vec3 gravity;                              ///< in the droplet's frame [m/s²]
    bool airborne = false;                     ///< true: a ball around the origin
    std::optional<double> contact_angle = {};  ///< one that the bodies know [rad]; empty: that of their force model
};

/// Makes the surfaces of droplets. All have the same vertices and triangles, so that one can become another. Immutable,
/// for any number of threads.
class DropletBodies {
public:
    /// Prepares a model: the capillary one solves its table here.
    /// @param shape  model of the shape
    /// @param model  liquid and contact angle
    /// @param contact_angles  further ones that it shall know [rad], from 1° to 179°
    /// @throws Error InvalidArgument
    explicit DropletBodies(BodyShape shape, const ForceModel& model = {}, std::span<const double> contact_angles = {});
    ~DropletBodies();
    DropletBodies(DropletBodies&&) noexcept;             ///< Moves the data.
    DropletBodies& operator=(DropletBodies&&) noexcept;  ///< Moves the data.

    /// Number of vertices.
    [[nodiscard]] std::size_t vertices() const;
    /// Number of vertices on the contact line. They are the first ones, in order around the footprint,
    /// counter-clockwise seen from above, from +x.
    [[nodiscard]] std::size_t rimVertices() const;
    /// Triangles of the liquid's surface, wound outward; the base is open.
    [[nodiscard]] const std::vector<Triangle>& triangles() const;
    /// Makes one droplet.
    /// @param conditions  what shapes it; of the known contact angles, the nearest serves
    /// @param vertices   receives all vertices [m]; the volume over z = 0 is `volume` to 1e-9
    /// @param normals     receives one per vertex, unit, outward
    void make(const BodyConditions& conditions, std::span<Vec3> vertices, std::span<Vec3> normals) const;

private:
    struct Content;
    std::unique_ptr<Content> content_;
};

}  // namespace droplet
