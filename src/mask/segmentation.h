// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "droplet/image/css_colour.h"
#include "droplet/mask/seeds.h"
#include "image/image.h"

namespace droplet {

/// Plane of levels, row by row from the top left.
struct LevelPlane {
    int width = 0;   ///< [px]
    int height = 0;  ///< [px]
    std::vector<std::uint16_t> levels;
};

/// Non-owning view of a plane of levels.
struct LevelView {
    int width = 0;   ///< [px]
    int height = 0;  ///< [px]
    const std::uint16_t* levels = nullptr;
    LevelView(int w, int h, const std::vector<std::uint16_t>& of) : width(w), height(h), levels(of.data()) {}
    LevelView(const LevelPlane& plane) : LevelView(plane.width, plane.height, plane.levels) {}  // NOLINT: a view
};

/// Result of a segmentation method.
struct Segmented {
    LevelPlane coverage;
    double confidence = 0.0;  ///< as in MaskLikeness, of the levels before they were set to 0 and 1 away from the rims
    double level_dry = 0.0;   ///< median luma of the dry parts of the picture, in [0, 1]
    double level_liquid = 1.0;  ///< median luma of the liquid parts, in [0, 1]
};

/// Properties by which a picture resembles a mask.
struct MaskLikeness {
    double confidence = 0.0;  ///< similarity to a mask, in [0, 1]
    bool has_rim = false;     ///< whether there are liquid and dry pixels
    bool sharp = false;       ///< whether nearly all of the rim lies at an edge
};

/// Measures how much coverages resemble those of a mask: liquid and dry have one level each, with an edge between them
/// everywhere, and without grains. Pictures that are too small to judge count as masks.
/// @param is_original  the levels were not corrected for light; then two plateaus give at least one half, however soft
///                     the rims
MaskLikeness maskLikeness(const LevelView& coverage, bool is_original);

/// Whether a picture is a drawing, not a photograph: many wide areas have exactly one level.
bool isDrawn(const LevelView& luma);

/// Uniformity of the hues of liquid and of dry, in [0, 1]; 1 if all is grey.
/// @param image     with colour
/// @param coverage  of the image's size
double hueUniformity(const Image& image, const std::vector<std::uint16_t>& coverage);

/// Segmentation by edges and the levels on either side of them; none if there are no edges.
///
/// Near strong edges, the threshold is the middle between the levels on either side; elsewhere it is interpolated. Rims
/// without an edge are dropped. After that, the levels of dry ground and of liquid are estimated smoothly over the
/// picture.
std::optional<Segmented> segmentAdaptive(const LevelView& luma);

/// Segmentation by colour, initialised with the result of segmentAdaptive; none if that finds nothing.
/// @param image  with colour
std::optional<Segmented> segmentGrabCut(const Image& image);

/// Regions of a colour; none if no pixel has it.
/// @param image  with colour
std::optional<Segmented> segmentColour(const Image& image, const CssColour& colour);

/// Liquid and dry ground around strokes.
/// @param image  with colour
/// @throws Error InvalidInput: seeds of another size, or without strokes of both kinds
Segmented segmentSeeds(const Image& image, const Seeds& seeds);

/// Most common colours of a picture, for an error message.
/// @param image  with colour
std::string commonColours(const Image& image);

}  // namespace droplet
