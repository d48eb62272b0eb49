// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "droplet/shape/sheet.h"
#include "droplet/surface/surface.h"
#include "droplet/vector.h"

namespace droplet {

/// Places of a sheet's vertices in the picture.
struct FlatMap {
    std::vector<Vec2> places;                  ///< one per vertex [m]; those of the rim are their own
    TextureMap kind = TextureMap::Projection;  ///< how they were found
};

/// Vertical projection of a sheet; its kind is Folded if a triangle leans out.
FlatMap projected(const CapillarySurface& sheet);

/// Spreads a sheet over its footprint, so that every point of the footprint belongs to one point of the sheet.
///
/// Where no triangle leans out, this is the vertical projection. Else every triangle gets, as far as possible, the
/// shape that its projection has, but those that lean out are unfolded, and steep ones are not narrower than a part of
/// their length.
///
/// Guarantees: the rim stays; unless the kind is Folded, every triangle is counter-clockwise, so that none overlap; the
/// same input gives the same bits.
/// @param sheet  result of solveSheet
FlatMap flatMap(const CapillarySurface& sheet);

}  // namespace droplet
