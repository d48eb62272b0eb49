// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "droplet/shape/capillary_surface.h"
#include "droplet/shape/figures.h"
#include "droplet/surface/surface.h"

namespace droplet {

/// Options of onPlate().
struct PlateOptions {
    double thickness = 1e-3;  ///< of the plate [m], > 0
    Vec2 extent;              ///< size of the image, as for loft() [m]; both > 0

    /// Checks all options.
    /// @throws Error InvalidArgument
    void validate() const;
};

/// Puts droplets on a plate, as one closed solid that can be printed.
///
/// The plate is a rectangle with rounded corners around all liquid, seen from above, and is two thicknesses wider on
/// every side; so droplets that lie apart hold together, and the plate has the picture's direction. Its top is z = 0.
/// Droplets have no bases: the liquid's rim is joined to the plate's top.
///
/// Guarantees: the liquid's triangles are those of loft(), and come first; the surface is one part.
/// @param surfaces  one per droplet, on flat ground, without dry ground; their rims do not touch
/// @param options   thickness and extent
/// @throws Error    InvalidArgument: options or surfaces; rims touch or are not at z = 0
Surface onPlate(const std::vector<CapillarySurface>& surfaces, const PlateOptions& options);

/// Adds a plate below droplets, as a part of its own: so every droplet stays a body of its look, for prints of several
/// filaments. The plate is that of onPlate(), but closed by itself.
///
/// Guarantees: the droplets stay as they are, and come first.
/// @param droplets  valid, closed, with parts, on flat ground, without a refill
/// @param number    of the plate's part, as SurfacePart::droplet
/// @param options   thickness and extent
/// @throws Error    InvalidArgument: options, or a surface without parts
Surface withPlate(Surface droplets, std::size_t number, const PlateOptions& options);

/// Warning about what cannot be printed as it is meant, with a usual nozzle of 0.4 mm and layers of 0.2 mm: a plate of
/// less than two layers, or one whose margins together are wider than the image; droplets lower than a layer; and parts
/// of them in which a disc as wide as the nozzle has no room. Points of corners do not count. Nothing if there is none.
/// @param footprints  of the droplets; their loops alone are used
/// @param droplets    figures of every droplet
/// @param plate       valid
std::optional<std::string> printWarning(const std::vector<PlanarMesh>& footprints,
                                        const std::vector<ShapeFigures>& droplets, const PlateOptions& plate);

}  // namespace droplet
