// SPDX-License-Identifier: GPL-3.0-or-later
#include "colour_shape.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "droplet/colours/colour_domain.h"
#include "mask_shape.h"

namespace cli {
namespace {

/// Edge of the triangles on a footprint [m].
double triangleEdge(double area, const droplet::TriangulateOptions& mesh)
{
    return mesh.edge.value_or(std::sqrt(4.0 / std::sqrt(3.0) * area / static_cast<double>(mesh.triangles)));
}

/// Warnings of droplets by colour.
std::vector<std::string> colourWarnings(const droplet::ColourRegions& regions, const droplet::ColourDomain& traced,
                                        const ByColourOptions& options)
{
    std::vector<std::string> warnings;
    if (options.colours && regions.palette.size() < *options.colours) {
        warnings.push_back(fmt::format("--colours: the picture has only {} that stand out", regions.palette.size()));
    }
    for (const std::size_t lost : traced.lost) {
        warnings.push_back(fmt::format("the colour {} has no droplet: its regions are too small",
                                       droplet::text(regions.palette[lost].colour)));
    }
    return warnings;
}

droplet::InputReport describeInput(const droplet::ColourRegions& regions, const droplet::ColourDomain& traced,
                                   const ShapeOptions& options)
{
    droplet::InputReport input;
    input.path = options.input;
    input.width_px = regions.width;
    input.height_px = regions.height;
    input.drawn = regions.raster_scale.has_value();
    input.pixel_size = traced.pixel_size;
    input.channel = regions.alpha.empty() ? droplet::Channel::Luma : droplet::Channel::Alpha;
    input.segment = droplet::Segmentation::Colour;
    input.anti_aliased = traced.anti_aliased;
    input.specks_dropped = traced.specks_dropped;
    input.largest_speck_px = traced.largest_speck_px;
    input.palette = regions.palette;
    input.background = regions.background;
    return input;
}

}  // namespace

droplet::Mask maskOf(const droplet::ColourRegions& regions)
{
    droplet::Mask mask;
    mask.width = regions.width;
    mask.height = regions.height;
    mask.raster_scale = regions.raster_scale;
    mask.physical_width = regions.physical_width;
    mask.lacking = regions.lacking;
    for (const std::uint8_t label : regions.label) {
        mask.coverage.push_back(label == 0 ? 0 : std::numeric_limits<std::uint16_t>::max());
    }
    return mask;
}

ColourShape makeOfColours(const droplet::ColourRegions& regions, const DropletSettings& settings,
                          const ShapeOptions& options, const droplet::Progress& progress)
{
    const ByColourOptions& by_colour = *options.footprint.by_colour;
    const droplet::Mask mask = maskOf(regions);
    const double area = coveredArea(mask, settings.droplet.trace);
    refuseTooShortEdge(area, settings.droplet);
    progress(droplet::Stage::Trace, 0.0);
    droplet::ColourDomain traced = droplet::traceColours(
        regions, {settings.droplet.trace, by_colour.gap, triangleEdge(area, settings.droplet.mesh)});
    ColourShape made;
    made.input = describeInput(regions, traced, options);
    made.input.own_size = takesOwnSize(mask, settings, options.footprint);
    for (const std::size_t colour : traced.colour) {
        made.colours.push_back(regions.palette[colour].colour);
    }
    made.warnings = colourWarnings(regions, traced, by_colour);
    made.droplet = droplet::makeDroplet(std::move(traced.domain), settings.droplet, progress);
    const std::vector<droplet::ShapeFigures>& figures = made.droplet.figures;
    const bool leans = std::any_of(figures.begin(), figures.end(),
                                   [](const droplet::ShapeFigures& each) { return each.overhang > 0.0; });
    if (leans && by_colour.gap == 0.0 && figures.size() > 1) {
        made.warnings.emplace_back(
            "droplets hang over their rims, and may overlap their neighbours; use --gap, or ask for less liquid");
    }
    return made;
}

}  // namespace cli
