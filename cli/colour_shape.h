// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "droplet/colours/colour_regions.h"
#include "droplet/droplet.h"
#include "droplet/image/css_colour.h"
#include "droplet/io/report.h"
#include "droplet/mask/mask.h"
#include "droplet/progress.h"
#include "shape_options.h"

namespace cli {

/// Mask of all liquid, without the places of its rims within pixels.
droplet::Mask maskOf(const droplet::ColourRegions& regions);

/// Droplets of the regions of a picture, with what their report needs.
struct ColourShape {
    droplet::Droplet droplet;
    droplet::InputReport input;
    std::vector<droplet::CssColour> colours;  ///< one per droplet
    std::vector<std::string> warnings;
};

/// Makes one droplet for each region.
/// @param settings         from completeSettings
/// @param options          the input's path and the footprint, by colour
/// @param progress         called at every stage but Read and Write
/// @throws droplet::Error  as droplet::traceColours and droplet::makeDroplet
ColourShape makeOfColours(const droplet::ColourRegions& regions, const DropletSettings& settings,
                          const ShapeOptions& options, const droplet::Progress& progress);

}  // namespace cli
