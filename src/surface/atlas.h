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

/// Object around a vertex of a chart.
struct AtlasCorner {
    Vec3 place;
    Vec3 normal;
    double scale = 0.0;            ///< length on the object per length in the picture
    std::array<Vec3, 2> along;     ///< ∂X/∂x and ∂X/∂y; x and y are in the picture's plane
    std::array<Vec3, 2> swelling;  ///< the same derivatives of scale · normal
};

/// Point of the picture on a chart.
struct Hit {
    std::uint32_t vertex = 0;  ///< vertex of the droplets
    std::uint32_t chart = 0;
    std::uint32_t facet = 0;
    double depth = 0.0;  ///< distance from the triangle's sides, negative outside [m]
};

/// Vertex of a droplet on the object.
struct PlacedVertex {
    Vec3 position;
    Vec3 normal;
    Vec3 ground_normal;
    double scale = 0.0;
    double volume_ratio = 0.0;  ///< volume ratio of the map there; negative if it is mirrored
};

/// Object in the picture's coordinates.
struct Atlas {
    std::vector<Facet> facets;
    std::vector<AtlasCorner> corners;
    std::vector<double> facing;  ///< of every chart: 1, or −1 if it mirrors the picture
    FacetBoxes boxes;
    double tolerance = 0.0;  ///< largest distance of a point that counts as on a triangle [m]

    /// Charts at a point, in order, with the triangle of each in which the point lies deepest; the first one of equals.
    [[nodiscard]] std::vector<Hit> at(Vec2 p) const;
    /// Maps a point over a facet to the object.
    /// @param p       point of the facet, in the picture's plane [m]
    /// @param z       height above it [m]
    /// @param normal  normal of the droplet there
    [[nodiscard]] PlacedVertex placeVertex(const Facet& facet, Vec2 p, double z, Vec3 normal) const;
};

/// Makes the atlas of an object under a picture.
/// @param extent  size of the picture [m]
/// @throws Error  InvalidInput: no triangle has an area both in space and in uv
Atlas atlasOf(const TexturedMesh& object, Vec2 extent);

}  // namespace droplet
