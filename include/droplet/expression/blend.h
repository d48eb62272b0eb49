// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "droplet/expression/liquid_shape.h"

namespace droplet {

/// How two shapes become one between them.
struct BlendOptions {
    double weight = 0.5;      ///< of the second shape, 0 … 1
    double spacing = 0.02;    ///< of the particles that both are drawn around [m], > 0
    double resolution = 0.4;  ///< side of the grid's cells in spacings, 0.2 … 1
    double min_area = 0.6;    ///< loops below this area, in areas of a particle, are dropped, ≥ 0

    /// @throws Error InvalidArgument, naming field, value and constraint
    void validate() const;
};

/// Shape between two others, for loops that fade from one part of a film to another.
///
/// Guarantees: weights 0 and 1 give the two shapes; the area of liquid, and that of all droplets, is the weighted mean
/// of both; two equal shapes stay as they are, to a fraction of a cell. Liquid that is in one shape alone shrinks, and
/// what is in the other one grows; it vanishes and appears the earlier the smaller it is. Holes are foam where one of
/// the shapes has foam. The result has the time of the first shape, and does not follow holes.
/// @param from     first shape
/// @param to       second shape
/// @param options  valid: weight and resolution
/// @throws Error   InvalidArgument for options
LiquidShape blended(const LiquidShape& from, const LiquidShape& to, const BlendOptions& options);

}  // namespace droplet
