// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "droplet/mesh/planar_mesh.h"
#include "droplet/shape/base_surface.h"
#include "droplet/shape/solve.h"
#include "shape/faceted_ground.h"
#include "shape/sheet_energy.h"

namespace droplet {

/// What a sheet lies on: ground that no part of it may sink below, and the part of it that is the liquid's base.
struct SheetBase {
    BaseSurface ground = {};
    SheetIntegrals integrals = {};                     ///< of the base's triangles; 0 on flat ground
    std::shared_ptr<const FacetedGround> facets = {};  ///< these triangles; empty on flat ground, or where the sheet
                                                       ///< has the same ones

    /// Marks of the vertices inside that lie on the ground, as of CapillarySurface::dry; empty if none does.
    [[nodiscard]] std::vector<std::uint8_t> dryOf(const CapillarySurface& sheet) const;
    /// Integrals over the base of a sheet. Where the sheet's triangles lie on the ground there is no liquid, though
    /// they are chords of it and those of the base are others: there, the sheet's own are the base.
    /// @param weight  as in integrate()
    [[nodiscard]] SheetIntegrals baseOf(const CapillarySurface& sheet, Vec3 weight) const;
    /// Integrals over the liquid between a sheet and its base; the area is what the sheet has more.
    [[nodiscard]] SheetIntegrals liquidUnder(const CapillarySurface& sheet, Vec3 weight) const
    {
        return integrate(sheet, weight) - baseOf(sheet, weight);
    }
    /// Ground below a place. Beyond the end of a ball or a pipe it is infinitely deep.
    [[nodiscard]] GroundPoint under(Vec3 place) const;
    /// Height of a place above the ground [m].
    [[nodiscard]] double clearance(Vec3 place) const { return place.z - under(place).height; }
    /// Lifts vertices that are below the ground onto it, and lays those down that are above it by rounding alone.
    /// @param first  index of the first place that may be moved
    void lift(std::vector<Vec3>& vertices, std::size_t first) const;
};

/// Gradient of gravity's potential over the surface tension, as of integrate() [1/m²].
Vec3 weightOf(const SolveOptions& options);

/// Upward unit normal of the ground.
Vec3 normalOf(const GroundPoint& ground);

/// Height of the ground at every vertex of a footprint [m].
std::vector<double> heightsUnder(const PlanarMesh& footprint, const BaseSurface& ground);

/// Ground under a footprint, as a surface without liquid.
CapillarySurface drySheet(const PlanarMesh& footprint, const BaseSurface& ground);

/// Base with the footprint's triangles.
/// @param weight  as in integrate()
SheetBase baseOf(const PlanarMesh& footprint, const BaseSurface& ground, Vec3 weight);

/// Base under a surface.
SheetBase baseOf(const CapillarySurface& surface, const BaseSurface& ground, Vec3 weight);

/// Volume of the liquid between a surface and the ground [m³].
double liquidVolume(const CapillarySurface& surface, const BaseSurface& ground);

}  // namespace droplet
