// SPDX-License-Identifier: GPL-3.0-or-later
//
// Tracing: borders of the thresholded mask, refined to the crossings of marching squares.

#include "droplet/outline/outline.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "droplet/error.h"
#include "number_text.h"
#include "outline/borders.h"
#include "outline/corners.h"
#include "outline/faired_rim.h"
#include "outline/pixels.h"
#include "outline/slot.h"
#include "require.h"

namespace droplet {
namespace {

/// Least coverage of liquid.
std::uint16_t levelOf(double threshold)
{
    return static_cast<std::uint16_t>(std::ceil(threshold * 65535.0));
}

/// Message about a mask in which no pixel reaches the threshold, with its levels, such as those of labels, and what
/// would choose among them.
std::string noLiquid(const Mask& mask, double threshold)
{
    constexpr std::size_t kMaxListed = 12;
    constexpr int kWhite = 65535;
    std::vector<bool> occurs(kWhite + 1);
    for (const std::uint16_t level : mask.coverage) {
        occurs[level] = true;
    }
    std::vector<int> levels;
    for (int level = 0; level <= kWhite; ++level) {
        if (occurs[static_cast<std::size_t>(level)]) {
            levels.push_back(level);
        }
    }
    const auto share = [](double level) { return numberText(level / kWhite, 2); };
    std::string message = "no liquid in the mask: no pixel reaches the threshold " + numberText(threshold);
    if (levels.size() > kMaxListed) {
        return message + "; the largest coverage is " + share(levels.back());
    }
    if (levels.size() == 1) {
        return message + "; all of it has the coverage " + share(levels.front());
    }
    const int unit = std::all_of(levels.begin(), levels.end(), [](int level) { return level % 257 == 0; }) ? 257 : 1;
    message += "; the picture has the levels ";
    for (std::size_t k = 0; k < levels.size(); ++k) {
        message += (k == 0 ? "" : k + 1 == levels.size() ? " and " : ", ") + std::to_string(levels[k] / unit);
    }
    const double between = 0.5 * (levels.back() + levels[levels.size() - 2]);
    return message + " of " + std::to_string(kWhite / unit) + ": choose a threshold, " + share(between) +
           " for the highest, or a colour";
}

/// Area enclosed [px²]; positive for liquid inside when y points down and the loop is as traced.
double enclosedArea(const SlotLoop& loop)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        sum += cross(loop[i].point(), loop[(i + 1) % loop.size()].point());
    }
    return -0.5 * sum;
}

}  // namespace

void TraceOptions::validate() const
{
    require(threshold > 0.0 && threshold < 1.0, "threshold", threshold, "between 0 and 1");
    require(width > 0.0 && std::isfinite(width), "width", width, "finite and more than 0 m");
    if (pixel_size) {
        require(*pixel_size > 0.0 && std::isfinite(*pixel_size), "pixel_size", *pixel_size, "finite and more than 0 m");
    }
    require(speck_size >= 0.0 && std::isfinite(speck_size), "speck_size", speck_size, "finite and at least 0 px²");
    clean.validate();
}

double signedArea(const Loop& loop)
{
    // Relative to the first point, because far from the origin products of coordinates would cancel.
    double sum = 0.0;
    for (std::size_t i = 1; i + 1 < loop.points.size(); ++i) {
        sum += cross(loop.points[i] - loop.points[0], loop.points[i + 1] - loop.points[0]);
    }
    return 0.5 * sum;
}

double pixelSize(const Mask& mask, const TraceOptions& options)
{
    return pixelSize(mask.width, mask.raster_scale, options);
}

Outline trace(const Mask& mask, const TraceOptions& options)
{
    mask.validate();
    options.validate();
    if (options.clean.any()) {
        TraceOptions without_cleaning = options;
        without_cleaning.clean = {};
        const Mask cleaned = clean(mask, options.clean, pixelSize(mask, options), options.threshold);
        const auto has_liquid = [level = levelOf(options.threshold)](const Mask& of) {
            return std::any_of(of.coverage.begin(), of.coverage.end(),
                               [=](std::uint16_t coverage) { return coverage >= level; });
        };
        if (!options.allow_dry && has_liquid(mask) && !has_liquid(cleaned)) {
            throw Error(ErrorCode::InvalidInput, "no liquid is left after smoothing over " +
                                                     numberText(options.clean.smooth) + " m; smooth less");
        }
        return trace(cleaned, without_cleaning);
    }
    const CoverageField field(mask, options.threshold);
    const std::vector<Border> borders = followBorders(mask, levelOf(options.threshold));
    if (borders.empty() && !options.allow_dry) {
        throw Error(ErrorCode::InvalidInput, noLiquid(mask, options.threshold));
    }

    Outline outline;
    outline.pixel_size = pixelSize(mask, options);
    outline.extent = {mask.width * outline.pixel_size, mask.height * outline.pixel_size};
    outline.anti_aliased = looksAntiAliased(field, borders);

    Coverage coverage;
    if (outline.anti_aliased) {
        coverage = [&field](int x, int y) { return field.coverage(x, y); };
    }
    // Specks need only their area. Every loop is computed independently, so that order and number of threads do not
    // matter.
    std::vector<CorneredLoop> faired(borders.size());
    std::vector<double> enclosed(borders.size());
    tbb::parallel_for(std::size_t{0}, borders.size(), [&](std::size_t k) {
        SlotLoop slots = placeSlots(field, borders[k], outline.anti_aliased);
        enclosed[k] = std::abs(enclosedArea(slots));
        if (enclosed[k] >= options.speck_size) {
            faired[k] = options.corners ? fairWithCorners(slots, coverage) : fairWhole(std::move(slots));
        }
    });
    for (const double area : enclosed) {
        if (area < options.speck_size) {
            ++outline.specks_dropped;
            outline.largest_speck_px = std::max(outline.largest_speck_px, area);
        }
    }
    std::erase_if(faired, [](const CorneredLoop& loop) { return loop.slots.empty(); });
    removeTouchingCorners(faired);
    for (const CorneredLoop& cornered : faired) {
        PixelLoop pixels = withCorners(cornered);
        Loop loop;
        loop.corner = std::move(pixels.corner);
        loop.points.reserve(pixels.points.size());
        for (const Vec2 p : pixels.points) {
            loop.points.push_back(placeOf(p, mask.width, mask.height, outline.pixel_size));
        }
        outline.loops.push_back(std::move(loop));
    }
    if (std::none_of(outline.loops.begin(), outline.loops.end(), [](const Loop& l) { return signedArea(l) > 0; })) {
        if (options.allow_dry) {
            outline.loops.clear();
            return outline;
        }
        throw Error(ErrorCode::InvalidInput, "only specks in the mask: the largest of " +
                                                 std::to_string(outline.specks_dropped) + " has " +
                                                 numberText(outline.largest_speck_px, 3) +
                                                 " px², less than the speck size " + numberText(options.speck_size));
    }
    return outline;
}

}  // namespace droplet
