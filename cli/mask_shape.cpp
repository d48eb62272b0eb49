// SPDX-License-Identifier: GPL-3.0-or-later
#include "mask_shape.h"

#include <fmt/core.h>

#include <cmath>
#include <numeric>
#include <string_view>
#include <utility>
#include <vector>

#include "droplet/colours/colour_regions.h"
#include "droplet/error.h"
#include "droplet/image/css_colour.h"
#include "droplet/surface/onto.h"
#include "droplet/units.h"

namespace cli {

using droplet::Error;
using droplet::ErrorCode;

void refuseTooShortEdge(double area, const droplet::DropletOptions& options)
{
    if (!options.mesh.edge) {
        return;
    }
    const double edge = *options.mesh.edge;
    const double equilateral = std::sqrt(3.0) / 4.0 * edge * edge;
    const double triangles = area / equilateral;
    if (triangles > static_cast<double>(kMaxTriangles)) {
        const double min = edge * std::sqrt(triangles / static_cast<double>(kMaxTriangles));
        throw Error(ErrorCode::InvalidArgument,
                    fmt::format("--edge: {:.3g}mm would take {:.3g} triangles on this footprint, must be at least "
                                "{:.3g}mm",
                                edge / droplet::kMillimetre, triangles, min / droplet::kMillimetre));
    }
}

double coveredArea(const droplet::Outline& outline)
{
    return std::accumulate(outline.loops.begin(), outline.loops.end(), 0.0,
                           [](double sum, const droplet::Loop& loop) { return sum + droplet::signedArea(loop); });
}

double coveredArea(const droplet::Mask& mask, const droplet::TraceOptions& options)
{
    const double pixel = droplet::pixelSize(mask, options);
    return std::accumulate(mask.coverage.begin(), mask.coverage.end(), 0.0) / 65535.0 * pixel * pixel;
}

bool takesOwnSize(const droplet::Mask& mask, const DropletSettings& settings, const FootprintOptions& footprint)
{
    return mask.physical_width && !footprint.sized && !settings.onto;
}

droplet::MaskOptions readMaskOptions(const FootprintOptions& footprint)
{
    droplet::MaskOptions options = footprint.mask;
    if (footprint.seeds) {
        options.seeds = droplet::readSeeds(*footprint.seeds);
    }
    return options;
}

droplet::Mask decodedMask(std::span<const std::byte> picture, const droplet::MaskOptions& options)
{
    try {
        return droplet::decodeMask(picture, options);
    } catch (const Error& error) {
        constexpr std::string_view kField = "options.seeds";
        const std::string_view message = error.what();
        if (!message.starts_with(kField)) {
            throw;
        }
        throw Error(error.code(), "--seeds: it" + std::string(message.substr(kField.size())));
    }
}

droplet::Mask tracedMask(const droplet::Mask& mask, const droplet::TraceOptions& options)
{
    return droplet::clean(mask, options.clean, droplet::pixelSize(mask, options), options.threshold);
}

void invert(droplet::Mask& mask)
{
    for (std::uint16_t& coverage : mask.coverage) {
        coverage = static_cast<std::uint16_t>(0xFFFF - coverage);
    }
    mask.inverted = !mask.inverted;
}

DropletSettings completeSettings(const droplet::Mask& mask, const Surroundings& around, const ShapeOptions& options)
{
    DropletSettings settings = options.settings;
    droplet::TraceOptions& trace = settings.droplet.trace;
    trace = options.footprint.trace;
    if (around.object && !options.footprint.sized) {
        const double per_uv =
            forOption("--onto " + *settings.onto, [&] { return droplet::metresPerUv(around.object->mesh); });
        trace.width = per_uv * std::sqrt(static_cast<double>(mask.width) / mask.height);
    } else if (takesOwnSize(mask, settings, options.footprint)) {
        trace.width = *mask.physical_width;
        if (!(trace.width >= kLength.min && trace.width <= kLength.max)) {
            throw Error(ErrorCode::InvalidInput,
                        fmt::format("the page states a width of {:.6g}m, which must be {}; give --width instead",
                                    trace.width, kLength.allowed));
        }
    }
    const double pixel = droplet::pixelSize(mask, trace);
    settings.droplet.solve.ground = groundOf(settings, around, {pixel * mask.width, pixel * mask.height});
    return settings;
}

MaskShape makeOfMask(const droplet::Mask& mask, const DropletSettings& settings, const ShapeOptions& options,
                     const droplet::Progress& progress)
{
    refuseTooShortEdge(coveredArea(mask, settings.droplet.trace), settings.droplet);
    MaskShape made{droplet::makeDroplet(mask, settings.droplet, progress), {}};
    const droplet::Outline& outline = made.droplet.outline;
    droplet::InputReport& input = made.input;
    input.path = options.input;
    input.width_px = mask.width;
    input.height_px = mask.height;
    input.drawn = mask.raster_scale.has_value();
    input.own_size = takesOwnSize(mask, settings, options.footprint);
    input.pixel_size = outline.pixel_size;
    input.channel = mask.channel;
    input.inverted = mask.inverted;
    input.segment = mask.segment;
    input.segment_confidence = mask.segment_confidence;
    input.threshold = settings.droplet.trace.threshold;
    input.level_dry = mask.level_dry;
    input.level_liquid = mask.level_liquid;
    input.anti_aliased = outline.anti_aliased;
    input.specks_dropped = outline.specks_dropped;
    input.largest_speck_px = outline.largest_speck_px;
    return made;
}

std::optional<std::string> drawingWarning(const droplet::Mask& mask)
{
    return mask.lacking.empty()
               ? std::nullopt
               : std::optional("parts of the drawing are not drawn as they are meant: " + mask.lacking);
}

std::optional<std::string> seedsWarning(const droplet::MaskOptions& options)
{
    if (!options.seeds || options.seeds->varied < droplet::kVariedSeeds) {
        return std::nullopt;
    }
    return "--seeds: it looks like a photograph, whose light and dark parts are taken for strokes; give a picture with "
           "the strokes alone, on transparent or evenly grey ground";
}

std::optional<std::string> maskWarning(const droplet::Mask& mask, const std::string& advice)
{
    constexpr double kMinConfidence = 0.5;
    if (mask.segment_confidence >= kMinConfidence) {
        return std::nullopt;
    }
    return fmt::format(
        "the footprints may be wrong: the picture is hardly a mask ({:.0f} % sure, by --segment {}); {}, change it "
        "with --segment, --channel or --threshold",
        100.0 * mask.segment_confidence, name(mask.segment), advice);
}

std::optional<std::string> hiddenColoursWarning(const droplet::Mask& mask, std::span<const std::byte> picture,
                                                const droplet::MaskOptions& options)
{
    if (mask.channel != droplet::Channel::Alpha || options.channel != droplet::Channel::Auto) {
        return std::nullopt;
    }
    constexpr int kSide = 256;  // of drawings [px]; parts of 5 % are large
    std::vector<droplet::PaletteColour> palette =
        droplet::decodePalette(picture, {.channel = droplet::Channel::Alpha,
                                         .max_pixels = options.max_pixels,
                                         .vector_long_side = kSide,
                                         .vector_seconds = options.vector_seconds,
                                         .vector_memory = options.vector_memory});
    const auto pixels = [](std::size_t sum, const droplet::PaletteColour& colour) { return sum + colour.pixels; };
    const std::size_t all = std::accumulate(palette.begin(), palette.end(), std::size_t{0}, pixels);
    std::erase_if(palette, [&](const droplet::PaletteColour& colour) { return 20 * colour.pixels <= all; });
    if (palette.size() < 2) {
        return std::nullopt;
    }
    std::string names;
    for (const droplet::PaletteColour& colour : palette) {
        names += (names.empty() ? "" : ", ") + droplet::text(colour.colour);
    }
    return fmt::format(
        "all opaque parts of the picture are liquid, whatever their colour ({}); --by-colour makes a droplet of each "
        "colour, and --colour COLOUR droplets of one of them",
        names);
}

}  // namespace cli
