// SPDX-License-Identifier: GPL-3.0-or-later
// Morphological opening by a disc, as two offsets of polygons: A. Johnson, Clipper.
#include "mesh/narrow_parts.h"

#include <cmath>
#include <polyclipping/clipper.hpp>

#include "mesh/clipper_paths.h"

namespace droplet {
namespace {

/// Units of Clipper's integers in a diameter, and the distance between arcs and their chords in them.
constexpr double kUnits = 1e5;
constexpr double kChord = 0.002 * kUnits;

/// Least area of a piece that counts, in squared diameters.
constexpr double kLeastPiece = 2.0;

double area(const ClipperLib::Paths& paths)
{
    double sum = 0.0;
    for (const ClipperLib::Path& path : paths) {
        sum += ClipperLib::Area(path);  // those of holes are negative
    }
    return sum;
}

}  // namespace

double narrowArea(const PlanarMesh& footprint, double diameter)
{
    const double unit = diameter / kUnits;
    ClipperLib::Paths outline = pathsOf(footprint, unit);
    const double whole = area(outline);
    // Rims are finer than what matters here.
    ClipperLib::CleanPolygons(outline, 0.25 * kChord);
    // A little less than the disc, so that a strip as wide as it counts as wide enough.
    constexpr double kMargin = 3.0 * kChord;
    const double radius = 0.5 * kUnits - kMargin;
    const ClipperLib::Paths room = offset(outline, -radius, kChord);
    if (room.empty()) {
        return whole * unit * unit;
    }
    // Wider by what chords leave over all along the rim.
    ClipperLib::Clipper clipper;
    clipper.AddPaths(outline, ClipperLib::ptSubject, true);
    clipper.AddPaths(offset(room, radius + kMargin, kChord), ClipperLib::ptClip, true);
    ClipperLib::PolyTree pieces;
    clipper.Execute(ClipperLib::ctDifference, pieces, ClipperLib::pftNonZero, ClipperLib::pftNonZero);
    double narrow = 0.0;
    for (const ClipperLib::PolyNode* node = pieces.GetFirst(); node != nullptr; node = node->GetNext()) {
        if (!node->IsHole()) {
            double piece = ClipperLib::Area(node->Contour);
            for (const ClipperLib::PolyNode* hole : node->Childs) {
                piece -= std::abs(ClipperLib::Area(hole->Contour));
            }
            narrow += piece >= kLeastPiece * kUnits * kUnits ? piece : 0.0;
        }
    }
    return narrow * unit * unit;
}

}  // namespace droplet
