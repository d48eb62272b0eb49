// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "droplet/surface/surface.h"
#include "droplet/vector.h"

namespace droplet {

/// Colours evenly spaced, red, green and blue, 0 … 1, sRGB; between them they are mixed.
using ColourScale = std::vector<Vec3>;

/// From dark blue over green to yellow, evenly growing brighter.
ColourScale sequentialScale();

/// From blue over near-white to red: for values about a middle.
ColourScale divergingScale();

/// Values shown as colours on an opaque, softly lit surface, with a legend.
/// Invariants: values and share have one entry a vertex of the surface, share may be empty; all numbers finite;
/// low < high; unit and line_spacing > 0.
struct Paint {
    std::vector<double> values;          ///< at the vertices, interpolated between them
    std::vector<double> share;           ///< of colour against plain grey, 0 … 1, at the vertices; empty: 1
    ColourScale scale;                   ///< colours from low to high; at least two
    double low = 0.0;                    ///< value of the first colour; lower ones have it too
    double high = 1.0;                   ///< value of the last colour
    std::optional<double> line_spacing;  ///< lines are drawn where values are its multiples
    std::string caption;                 ///< of the legend, with the unit: "height [mm]"
    double unit = 1.0;                   ///< what the legend's numbers count: 1e-3 for millimetres

    /// Guarantees: returns only when the invariants hold on a surface of that many vertices.
    /// @throws Error InvalidArgument
    void validate(std::size_t vertices) const;
};

/// A round number (1, 2 or 5 times a power of ten) that divides a span into about `parts` parts.
/// @param span   > 0
/// @param parts  > 0
double roundStep(double span, double parts);

/// Heights above the lowest vertex's, with lines at a round number of micrometres or millimetres: 8 to 20 of them.
/// @param surface  valid
Paint heightPaint(const Surface& surface);

/// Contact angles in a band along the rim, on plain grey; diverging about a round number near their mean.
/// @param surface  valid, with contact angles
/// @throws Error   InvalidArgument where the surface has none
Paint contactAnglePaint(const Surface& surface);

/// How far every vertex lies outside another surface, or inside where it is less than zero, as signedDistances has it;
/// diverging about 0, out to the largest.
/// @param surface  valid
/// @param other    valid
Paint differencePaint(const Surface& surface, const Surface& other);

}  // namespace droplet
