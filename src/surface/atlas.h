// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "droplet/surface/textured_mesh.h"
#include "droplet/vector.h"
#include "surface/charts.h"
#include "surface/facet_boxes.h"

namespace droplet {

/// What a chart's vertex knows of the object around it.
struct AtlasCorner {
    Vec3 place;
    Vec3 normal;
    double scale = 0.0;            ///< length on the object per length in the picture
    std::array<Vec3, 2> along;     ///< ∂X/∂x, ∂X/∂y, x and y in the picture's plane
    std::array<Vec3, 2> swelling;  ///< the same of scale · normal: how a layer grows with its height
};

/// A point of the picture on a chart.
struct Hit {
    std::uint32_t vertex = 0;  ///< of the droplets
    std::uint32_t chart = 0;
    std::uint32_t facet = 0;
    double depth = 0.0;  ///< how far inside the triangle, negative within a hair of it [m]
};

/// A vertex of a droplet on the object.
struct Laid {
    Vec3 position;
    Vec3 normal;
    Vec3 ground_normal;
    double scale = 0.0;
    double swept = 0.0;  ///< volume per volume of the map there, negative where mirrored
};

/// The object as the picture sees it.
struct Atlas {
    std::vector<Facet> facets;
    std::vector<AtlasCorner> corners;
    std::vector<double> facing;  ///< of every chart: 1, or −1 where it shows the picture mirrored
    FacetBoxes boxes;
    double hair = 0.0;  ///< [m]

    /// The charts at a point, in order; on each the triangle it lies deepest in, of equals the first.
    [[nodiscard]] std::vector<Hit> at(Vec2 p) const;
    /// A point over a facet.
    /// @param p       within the facet, in the picture's plane [m]
    /// @param z       height above it [m]
    /// @param normal  there
    [[nodiscard]] Laid lay(const Facet& facet, Vec2 p, double z, Vec3 normal) const;
};

/// The object under a picture.
/// @param extent  of the picture [m]
/// @throws Error  InvalidInput where no triangle has an area both in space and in uv
Atlas atlasOf(const TexturedMesh& object, Vec2 extent);

}  // namespace droplet
