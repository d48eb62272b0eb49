// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "droplet/flow/flow_surface.h"
#include "droplet/flow/ground_motion.h"
#include "droplet/vector.h"

namespace droplet {

/// Area of a face [m²].
double areaOf(const FlowSurface::Face& face);

/// A surface, prepared for droplets: searches for landings and for the nearest point. Immutable, for any number of
/// threads.
class FlowTerrain {
public:
    /// Point on a face.
    struct Point {
        std::uint32_t face = 0;  ///< number in FlowSurface::faces
        Vec3 place;              ///< [m]
    };
    /// Prepared data, private to the library.
    struct Content;

    /// Prepares a surface.
    explicit FlowTerrain(FlowSurface surface);
    /// Prepares a shape of a surface that deforms.
    /// @param surface  in this shape
    /// @param motion   of its faces
    /// @param rest     the surface in the shape that what varies over it belongs to
    FlowTerrain(FlowSurface surface, GroundMotion motion, std::shared_ptr<const FlowSurface> rest);
    ~FlowTerrain();
    FlowTerrain(FlowTerrain&& other) noexcept;             ///< Moves the data.
    FlowTerrain& operator=(FlowTerrain&& other) noexcept;  ///< Moves the data.

    /// The surface.
    [[nodiscard]] const FlowSurface& surface() const;
    /// How the surface moves.
    [[nodiscard]] const GroundMotion& motion() const;
    /// Area of all faces [m²].
    [[nodiscard]] double area() const;
    /// Diagonal of the box around the surface [m].
    [[nodiscard]] double diameter() const;
    /// Point for two random numbers, uniform by area.
    /// @param u, v  uniform in [0, 1)
    [[nodiscard]] Point pointAt(double u, double v) const;
    /// Nearest point of the surface.
    [[nodiscard]] Point nearest(Vec3 place) const;
    /// First point that a ray meets, from either side.
    /// @param origin     begin of the ray [m]
    /// @param direction  not 0
    [[nodiscard]] std::optional<Point> firstAlong(Vec3 origin, Vec3 direction) const;
    /// Whether a place is inside a closed part of the surface.
    [[nodiscard]] bool isInside(Vec3 place) const;

    /// The prepared data.
    [[nodiscard]] const Content& content() const { return *content_; }

private:
    std::unique_ptr<Content> content_;
};

}  // namespace droplet
