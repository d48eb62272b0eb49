// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "droplet/footprint/css_colour.h"
#include "image/image.h"

namespace droplet {

/// A plane of levels, row by row from the top left.
struct LevelPlane {
    int width = 0;   ///< [px]
    int height = 0;  ///< [px]
    std::vector<std::uint16_t> levels;
};

/// Levels that someone else owns.
struct LevelView {
    int width = 0;   ///< [px]
    int height = 0;  ///< [px]
    const std::uint16_t* levels = nullptr;
    LevelView(int w, int h, const std::vector<std::uint16_t>& of) : width(w), height(h), levels(of.data()) {}
    LevelView(const LevelPlane& plane) : LevelView(plane.width, plane.height, plane.levels) {}  // NOLINT: a view
};

/// What a way of segmentation made of a picture.
struct Segmented {
    LevelPlane coverage;
    double confidence = 0.0;    ///< as of MaskLook, of the levels before they were cut to 0 and 1 off the rims
    double level_dry = 0.0;     ///< median of the picture's luma where it is dry, in [0, 1]
    double level_liquid = 1.0;  ///< and where it is liquid
};

/// How a picture taken for a mask looks.
struct MaskLook {
    double confidence = 0.0;  ///< how much like a mask, in [0, 1]
    bool has_rim = false;     ///< whether there is liquid and dry
    bool sharp = false;       ///< whether nearly all of the rim lies at an edge
};

/// How much coverages look like those of a mask: liquid and dry are each of one level, with an edge everywhere between
/// them, and free of grains. Pictures too small to tell are taken for masks.
/// @param as_they_stand  no light was taken out of the levels: then two plateaus are worth half, however soft the rims
MaskLook lookOfMask(const LevelView& coverage, bool as_they_stand);

/// Whether a picture is drawn rather than photographed: much of it has exactly one level over wide stretches.
bool isDrawn(const LevelView& luma);

/// How much a picture has but one hue where it is liquid and one where it is dry, in [0, 1]: 1 of all that is grey.
/// @param image     with colour
/// @param coverage  of the image's size
double fewColours(const Image& image, const std::vector<std::uint16_t>& coverage);

/// Segmentation by edges and the levels on either side of them; none if there are no edges.
///
/// The threshold near strong edges is the middle of what lies on either side, elsewhere interpolated from there; rims
/// without an edge are no rims. From then on dry ground and liquid tell their own levels, smoothly over the picture.
std::optional<Segmented> segmentAdaptive(const LevelView& luma);

/// Segmentation by colour, begun with what segmentAdaptive finds; none if that finds nothing.
/// @param image  with colour
std::optional<Segmented> segmentGrabCut(const Image& image);

/// The regions of a colour; none if nothing has it.
/// @param image  with colour
std::optional<Segmented> segmentColour(const Image& image, const CssColour& colour);

/// The colours that most of a picture has, for whoever asked for another.
/// @param image  with colour
std::string commonColours(const Image& image);

}  // namespace droplet
