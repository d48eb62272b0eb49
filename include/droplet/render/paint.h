// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "droplet/surface/surface.h"
#include "droplet/vector.h"

namespace droplet {

/// Colour map: evenly spaced sRGB colours (red, green, blue, 0 … 1), interpolated linearly.
using ColourScale = std::vector<Vec3>;

/// Colour map from dark blue over green to yellow with evenly growing lightness.
ColourScale sequentialScale();

/// Colour map from blue over near-white to red, for values on both sides of a middle.
ColourScale divergingScale();

/// Values to show as colours on an opaque, softly lit surface, with a legend.
/// Invariants: `values` has one entry per vertex, `share` too unless it is empty; all numbers are finite;
/// low < high; unit and line_spacing > 0.
struct Paint {
    std::vector<double> values;          ///< at the vertices, interpolated linearly
    std::vector<double> share;           ///< at the vertices: 0 (plain grey) to 1 (colour); empty: 1
    ColourScale scale;                   ///< at least two colours, from `low` to `high`
    double low = 0.0;                    ///< value of the first colour, also used below it
    double high = 1.0;                   ///< value of the last colour, also used above it
    std::optional<double> line_spacing;  ///< distance of contour lines; empty: none
    std::string caption;                 ///< title of the legend, with the unit: "height [mm]"
    double unit = 1.0;                   ///< unit of the legend's numbers: 1e-3 for millimetres

    /// Guarantees: returns only if the invariants hold.
    /// @param vertices  number of vertices of the surface
    /// @throws Error    InvalidArgument
    void validate(std::size_t vertices) const;
};

/// Round number (1, 2 or 5 times a power of ten) that divides a span into about `parts` parts.
/// @param span   > 0
/// @param parts  > 0
double roundStep(double span, double parts);

/// Heights above the lowest vertex, with 8 to 20 contour lines at round distances.
/// @param surface  valid
Paint heightPaint(const Surface& surface);

/// Contact angles in a band along the rim, on plain grey; the scale diverges from a round number near their mean.
/// @param surface  valid, with contact angles
/// @throws Error   InvalidArgument if the surface has none
Paint contactAnglePaint(const Surface& surface);

/// Signed distance of every vertex from another surface, positive outside, as in signedDistances; the scale diverges
/// from 0 to the largest distance.
/// @param surface  valid
/// @param other    valid
Paint differencePaint(const Surface& surface, const Surface& other);

}  // namespace droplet
