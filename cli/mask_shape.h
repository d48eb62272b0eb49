// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "droplet/droplet.h"
#include "droplet/io/report.h"
#include "droplet/mask/mask.h"
#include "droplet/outline/outline.h"
#include "droplet/progress.h"
#include "shape_options.h"
#include "surroundings.h"

namespace cli {

/// Refuses an --edge that would give more than kMaxTriangles triangles on a footprint.
/// @param area             area of the footprint [m²]
/// @throws droplet::Error  InvalidArgument
void refuseTooShortEdge(double area, const droplet::DropletOptions& options);

/// Area of all footprints [m²].
double coveredArea(const droplet::Outline& outline);
/// Area that a mask covers [m²].
double coveredArea(const droplet::Mask& mask, const droplet::TraceOptions& options);

/// Whether the picture's size is the one that its file states.
bool takesOwnSize(const droplet::Mask& mask, const DropletSettings& settings, const FootprintOptions& footprint);

/// Rules that turn the picture into a mask, with the strokes that --seeds names.
/// @throws droplet::Error  InvalidInput: the strokes' file
droplet::MaskOptions readMaskOptions(const FootprintOptions& footprint);

/// Reads a mask from an encoded picture.
/// @param options          of readMaskOptions
/// @throws droplet::Error  as droplet::decodeMask; what is wrong with strokes begins with --seeds
droplet::Mask decodedMask(std::span<const std::byte> picture, const droplet::MaskOptions& options);

/// The mask as it is traced: without spots and holes that the options drop.
droplet::Mask tracedMask(const droplet::Mask& mask, const droplet::TraceOptions& options);

/// Exchanges liquid and dry.
void invert(droplet::Mask& mask);

/// Settings completed by the picture's size, which may depend on an object or on the picture, and by the ground.
/// @throws droplet::Error  InvalidInput: the picture states a size out of range; InvalidArgument
DropletSettings completeSettings(const droplet::Mask& mask, const Surroundings& around, const ShapeOptions& options);

/// Droplet of a mask, with what its report needs.
struct MaskShape {
    droplet::Droplet droplet;
    droplet::InputReport input;
};

/// Makes the droplet of a mask.
/// @param settings         from completeSettings
/// @param options          the input's path and the footprint
/// @param progress         called at every stage but Read and Write
/// @throws droplet::Error  as droplet::makeDroplet
MaskShape makeOfMask(const droplet::Mask& mask, const DropletSettings& settings, const ShapeOptions& options,
                     const droplet::Progress& progress);

/// Warning about parts of an SVG image that are not drawn.
std::optional<std::string> drawingWarning(const droplet::Mask& mask);

/// Warning about strokes that look like a photograph.
std::optional<std::string> seedsWarning(const droplet::MaskOptions& options);

/// Warning about a mask that may be wrong.
/// @param advice  how to look at the mask
std::optional<std::string> maskWarning(const droplet::Mask& mask, const std::string& advice);

/// Warning about a mask by the transparency of a picture, where that hides two or more colours of over 5 % of its area
/// each: a sign on a disc becomes a blank disc.
/// @param picture  encoded picture of the mask
/// @param options  from which the mask was decoded; without a warning if they name a channel
std::optional<std::string> hiddenColoursWarning(const droplet::Mask& mask, std::span<const std::byte> picture,
                                                const droplet::MaskOptions& options);

}  // namespace cli
