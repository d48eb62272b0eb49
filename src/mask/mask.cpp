// SPDX-License-Identifier: GPL-3.0-or-later
// Decides which levels of a picture are liquid, on histograms of 65536 levels, and applies the result through one
// table, in place: two passes over the pixels, and no memory beyond the plane that becomes the coverage.
#include "droplet/mask/mask.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <new>
#include <opencv2/core.hpp>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "droplet/error.h"
#include "droplet/mask/two_levels.h"
#include "image/image.h"
#include "image/image_file.h"
#include "mask/segmentation.h"
#include "number_text.h"

namespace droplet {

namespace {

constexpr std::int64_t kWhite = std::numeric_limits<std::uint16_t>::max();

/// Number of pixels of each level.
using Histogram = std::vector<std::uint64_t>;

Histogram emptyHistogram()
{
    return Histogram(static_cast<std::size_t>(kWhite) + 1);
}

Histogram histogramOf(const std::vector<std::uint16_t>& plane)
{
    // Most of a mask has one level over wide areas, which compilers compare by vector instructions.
    constexpr std::size_t kBlock = 64;
    Histogram histogram = emptyHistogram();
    for (std::size_t first = 0; first < plane.size(); first += kBlock) {
        const std::size_t end = std::min(first + kBlock, plane.size());
        const std::uint16_t level = plane[first];
        std::uint16_t others = 0;
        for (std::size_t i = first; i < end; ++i) {
            others = static_cast<std::uint16_t>(others | (plane[i] ^ level));
        }
        if (others == 0) {
            histogram[level] += end - first;
            continue;
        }
        for (std::size_t i = first; i < end; ++i) {
            ++histogram[plane[i]];
        }
    }
    return histogram;
}

std::uint64_t pixelsAt(const Histogram& histogram, std::int64_t level)
{
    return level < 0 || level > kWhite ? 0 : histogram[static_cast<std::size_t>(level)];
}

/// Levels that become coverage 0 and 1.
struct Range {
    std::int64_t dry = 0;
    std::int64_t liquid = kWhite;
    bool clear = false;      ///< whether the picture itself shows them
    bool is_uneven = false;  ///< whether much of the picture is far on the dry side: the border's level is not that of
                             ///< the whole ground
};

/// Whether two levels at this distance are clearly different: a quarter of the range.
bool isClear(std::int64_t distance)
{
    return 4 * distance >= kWhite;
}

/// Level that half of the border's pixels do not exceed (the darker of two if exactly half).
std::int64_t borderLevel(const std::vector<std::uint16_t>& plane, int width, int height)
{
    const auto columns = static_cast<std::size_t>(width);
    const auto rows = static_cast<std::size_t>(height);
    Histogram border = emptyHistogram();
    std::uint64_t count = 0;
    const auto add = [&](std::size_t x, std::size_t y) {
        ++border[plane[y * columns + x]];
        ++count;
    };
    for (std::size_t x = 0; x < columns; ++x) {
        add(x, 0);
        if (rows > 1) {
            add(x, rows - 1);
        }
    }
    for (std::size_t y = 1; y + 1 < rows; ++y) {
        add(0, y);
        if (columns > 1) {
            add(columns - 1, y);
        }
    }
    std::int64_t level = 0;
    for (std::uint64_t seen = pixelsAt(border, 0); 2 * seen < count; seen += pixelsAt(border, level)) {
        ++level;
    }
    return level;
}

/// Distance from `dry` of the farthest level towards `sign` that is not a stray: more than a hundredth of all marked
/// pixels have this level or one up to an eighth nearer. 0 if no pixel in that direction is clear of `dry`.
///
/// The farthest level alone would depend on one hot pixel, and a quantile would cut the top off a soft mark. So a level
/// is a stray if few pixels are near it. They are counted relative to the marked pixels, not to the image, so that a
/// mark of under a hundred pixels keeps its level in an image of any size. The noise of a mark may reach an eighth of
/// the distance. Then the stretched level of its body is still above 7/8, and its half level is off by less than 1/16
/// of the step.
std::int64_t farthest(const Histogram& histogram, std::int64_t dry, int sign, std::uint64_t marked)
{
    const std::int64_t reach = sign > 0 ? kWhite - dry : dry;
    std::int64_t inner = reach;  // pixels at distances inner … outer are counted
    std::uint64_t counted = pixelsAt(histogram, dry + sign * reach);
    for (std::int64_t outer = reach; isClear(outer); --outer) {
        while (8 * (inner - 1) >= 7 * outer) {
            --inner;
            counted += pixelsAt(histogram, dry + sign * inner);
        }
        const std::uint64_t here = pixelsAt(histogram, dry + sign * outer);
        if (here > 0 && 100 * counted > marked) {
            return outer;
        }
        counted -= here;
    }
    return 0;
}

/// Levels of the two parts of a picture, the lower one first; none if it has not just two. A level is that of a part if
/// some pixel and all its neighbours have it; soft rims have other levels.
std::optional<std::pair<std::int64_t, std::int64_t>> levelsOfTwoParts(const std::vector<std::uint16_t>& plane,
                                                                      int width, int height)
{
    if (const auto both = twoLevels(std::span(plane))) {
        return both;
    }
    std::optional<std::pair<std::uint16_t, std::uint16_t>> parts;  // the same level twice while there is one
    for (int y = 1; y + 1 < height; ++y) {
        const std::uint16_t* const row = plane.data() + static_cast<std::ptrdiff_t>(y) * width;
        for (int x = 1; x + 1 < width; ++x) {
            const std::uint16_t level = row[x];
            if (parts && (level == parts->first || level == parts->second)) {
                continue;
            }
            const auto is_even = [&](const std::uint16_t* at) {
                return at[-1] == level && at[0] == level && at[1] == level;
            };
            if (!is_even(row + x) || !is_even(row + x - width) || !is_even(row + x + width)) {
                continue;
            }
            if (parts && parts->first != parts->second) {
                return std::nullopt;  // a third
            }
            parts = std::minmax({parts ? parts->first : level, level});
        }
    }
    return parts && parts->first != parts->second ? parts : std::nullopt;
}

/// Levels of a picture of two parts that differ little. Tools that label pixels count from 0, so among dark levels the
/// higher one is the liquid. Otherwise it is a pale drawing, whose ground reaches the border.
Range faintLevels(std::pair<std::int64_t, std::int64_t> parts, std::int64_t border)
{
    const auto [lower, higher] = parts;
    const bool is_drawing = 2 * higher > kWhite;
    const bool is_dark = is_drawing && higher - border < border - lower;
    return {is_dark ? higher : lower, is_dark ? lower : higher, true};
}

/// Levels of a picture that shows liquid on a dry ground which reaches the border.
Range levelsAgainstBorder(const std::vector<std::uint16_t>& plane, int width, int height)
{
    const Histogram histogram = histogramOf(plane);
    const std::int64_t first = plane.front();
    if (pixelsAt(histogram, first) == plane.size()) {
        return 2 * first > kWhite ? Range{0, first, false} : Range{first, kWhite, false};
    }
    const std::int64_t dry = borderLevel(plane, width, height);
    std::uint64_t marked = 0;
    for (std::int64_t level = 0; level <= kWhite; ++level) {
        marked += isClear(std::abs(level - dry)) ? pixelsAt(histogram, level) : 0;
    }
    const std::int64_t darker = farthest(histogram, dry, -1, marked);
    const std::int64_t brighter = farthest(histogram, dry, +1, marked);
    if (std::max(darker, brighter) > 0) {
        const bool is_dark = brighter < darker;
        const std::int64_t distance = is_dark ? darker : brighter;
        std::uint64_t beyond = 0;
        for (std::int64_t level = 0; level <= kWhite; ++level) {
            beyond += 4 * (is_dark ? level - dry : dry - level) > distance ? pixelsAt(histogram, level) : 0;
        }
        return {dry, is_dark ? dry - distance : dry + distance, true, 10 * beyond > plane.size()};
    }
    const auto parts = levelsOfTwoParts(plane, width, height);
    if (parts && 2 * (pixelsAt(histogram, parts->first) + pixelsAt(histogram, parts->second)) > plane.size()) {
        return faintLevels(*parts, dry);
    }
    // Nothing stands out. Without stretching, no pixel reaches half towards the farther end of the range.
    return {dry, 2 * dry > kWhite ? 0 : kWhite, false};
}

/// Whether a picture uses its alpha: some pixel is less than half opaque.
bool usesAlpha(const std::vector<std::uint16_t>& alpha)
{
    // std::any_of and std::min_element would not be vectorised.
    std::uint16_t min = kWhite;
    for (const std::uint16_t level : alpha) {
        min = std::min(min, level);
    }
    return 2 * std::int64_t{min} < kWhite;
}

/// Levels of an alpha channel. It is drawn, not photographed, so it has no strays.
Range levelsOfAlpha(const std::vector<std::uint16_t>& alpha)
{
    std::uint16_t max = 0;
    for (const std::uint16_t level : alpha) {
        max = std::max(max, level);
    }
    const bool is_clear = isClear(max) || twoLevels(std::span(alpha));
    return {0, is_clear ? max : kWhite, is_clear};
}

void applyRange(std::vector<std::uint16_t>& plane, const Range& range, bool invert)
{
    const std::int64_t distance = std::abs(range.liquid - range.dry);
    const std::int64_t sign = range.liquid < range.dry ? -1 : 1;
    if (distance == kWhite) {
        if ((sign < 0) != invert) {
            for (std::uint16_t& level : plane) {
                level = static_cast<std::uint16_t>(kWhite - level);
            }
        }
        return;
    }
    std::vector<std::uint16_t> table(static_cast<std::size_t>(kWhite) + 1);
    for (std::int64_t level = 0; level <= kWhite; ++level) {
        const std::int64_t covered = std::clamp<std::int64_t>(sign * (level - range.dry), 0, distance);
        const std::int64_t coverage = (covered * kWhite + distance / 2) / distance;
        table[static_cast<std::size_t>(level)] = static_cast<std::uint16_t>(invert ? kWhite - coverage : coverage);
    }
    for (std::uint16_t& level : plane) {
        level = table[level];
    }
}

/// Plane of a channel; missing alpha is opaque.
std::vector<std::uint16_t> planeOf(Image image, Channel channel)
{
    if (channel != Channel::Alpha) {
        return lumaOverBlack(std::move(image));
    }
    return image.alpha.empty()
               ? std::vector<std::uint16_t>(
                     static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height), kWhite)
               : std::move(image.alpha);
}

double shareOfWhite(std::int64_t level)
{
    return static_cast<double>(level) / static_cast<double>(kWhite);
}

/// Mask with all properties of its picture except the coverage.
/// @param of  Image or Mask
template <typename Picture>
Mask blankMask(const Picture& of)
{
    Mask mask;
    mask.width = of.width;
    mask.height = of.height;
    mask.raster_scale = of.raster_scale;
    mask.physical_width = of.physical_width;
    mask.lacking = of.lacking;
    return mask;
}

/// Mask of a picture in which a segmentation method finds nothing.
/// @param of  Image or Mask
template <typename Picture>
Mask dryMask(const Picture& of, const MaskOptions& options, Segmentation segment)
{
    Mask mask = blankMask(of);
    mask.coverage.assign(static_cast<std::size_t>(mask.width) * static_cast<std::size_t>(mask.height),
                         options.invert ? std::numeric_limits<std::uint16_t>::max() : 0);
    mask.segment = segment;
    mask.inverted = options.invert;
    return mask;
}

/// Mask found by levels, and whether its ground has several levels.
struct LevelMask {
    Mask mask;
    bool is_uneven = false;
};

/// Decides which levels are liquid, and turns one plane of the image into coverage in place.
/// @throws Error InvalidInput: no alpha although Channel::Alpha is set
LevelMask maskFromImage(Image image, const MaskOptions& options)
{
    if (options.levels) {
        const MaskLevels& levels = *options.levels;
        const auto within = [](double level) { return level >= 0.0 && level <= 1.0; };
        if (options.channel != Channel::Auto || levels.channel == Channel::Auto || !within(levels.dry) ||
            !within(levels.liquid) || levels.dry == levels.liquid) {
            throw Error(ErrorCode::InvalidArgument,
                        "options.levels must be two different levels from 0 to 1 of one channel, and options.channel "
                        "must be Auto");
        }
    }
    Mask mask = blankMask(image);
    mask.channel = options.channel;
    if (options.channel == Channel::Auto) {
        mask.channel = usesAlpha(image.alpha) ? Channel::Alpha : Channel::Luma;
    } else if (options.channel == Channel::Alpha && image.alpha.empty()) {
        throw Error(ErrorCode::InvalidInput, "the channel is alpha, but the image has no alpha channel");
    }
    std::vector<std::uint16_t> given;  // plane of the given levels' channel, if the image's own channel differs
    if (options.levels && options.levels->channel != mask.channel) {
        given = planeOf(image, options.levels->channel);
    }
    mask.coverage = planeOf(std::move(image), mask.channel);
    image = {};

    Range range;
    if (options.channel == Channel::Auto) {
        range = mask.channel == Channel::Alpha ? levelsOfAlpha(mask.coverage)
                                               : levelsAgainstBorder(mask.coverage, mask.width, mask.height);
        if (range.clear) {
            mask.found = MaskLevels{mask.channel, shareOfWhite(range.dry), shareOfWhite(range.liquid)};
        }
    }
    if (options.levels) {
        const auto level = [](double share) { return std::int64_t{std::lround(share * static_cast<double>(kWhite))}; };
        range = {level(options.levels->dry), level(options.levels->liquid), true};
        mask.channel = options.levels->channel;
        if (!given.empty()) {
            mask.coverage = std::move(given);
        }
    }
    applyRange(mask.coverage, range, options.invert);
    if (options.invert) {
        std::swap(range.dry, range.liquid);
    }
    mask.inverted = range.liquid < range.dry;
    mask.level_dry = shareOfWhite(range.dry);
    mask.level_liquid = shareOfWhite(range.liquid);
    return {std::move(mask), range.is_uneven};
}

/// Mask by a segmentation method other than Threshold; none if it finds nothing.
/// @param image    with colour
/// @param segment  Adaptive, GrabCut, Colour or Seeds
std::optional<Mask> segmented(const Image& image, const MaskOptions& options, Segmentation segment)
{
    std::optional<Segmented> found;
    if (segment == Segmentation::Seeds) {
        found = segmentSeeds(image, *options.seeds);
    } else if (segment == Segmentation::Colour) {
        found = segmentColour(image, *options.colour);
    } else if (segment == Segmentation::GrabCut) {
        found = segmentGrabCut(image);
    } else {
        found = segmentAdaptive({image.width, image.height, image.luma});
    }
    if (!found) {
        return std::nullopt;
    }
    Mask mask = blankMask(image);
    mask.coverage = std::move(found->coverage.levels);
    mask.segment = segment;
    mask.segment_confidence = found->confidence;
    if (segment != Segmentation::Colour && segment != Segmentation::Seeds) {
        mask.segment_confidence *= hueUniformity(image, mask.coverage);
    }
    mask.level_dry = found->level_dry;
    mask.level_liquid = found->level_liquid;
    if (options.invert) {
        applyRange(mask.coverage, {}, true);
        std::swap(mask.level_dry, mask.level_liquid);
    }
    mask.inverted = mask.level_liquid < mask.level_dry;
    return mask;
}

Image decode(std::span<const std::byte> encoded, const MaskOptions& options, bool keeps_colour)
{
    Image image = decodeImage(encoded, {.max_pixels = options.max_pixels,
                                        .vector_long_side = options.vector_long_side,
                                        .keeps_colour = keeps_colour,
                                        .drawing = {options.vector_seconds, options.vector_memory}});
    if (!options.allow_dry) {
        requireInk(image);
    }
    return image;
}

/// The picture with the luma it has in front of black.
Image inFrontOfBlack(Image image)
{
    if (!image.alpha.empty()) {
        Image grey;
        grey.luma = std::move(image.luma);
        grey.alpha = std::move(image.alpha);
        grey.premultiplied = image.premultiplied;
        image.luma = lumaOverBlack(std::move(grey));
        image.alpha.clear();
    }
    return image;
}

/// Mask by Segmentation::Auto: the one by levels, or the adaptive one if that is better.
/// @throws Error InvalidInput: neither looks like a mask
Mask autoMask(std::span<const std::byte> encoded, const MaskOptions& options, LevelMask levels)
{
    constexpr double kClean = 0.9;
    constexpr double kBetter = 0.05;
    constexpr double kMinConfidence = 0.3;
    Mask mask = std::move(levels.mask);
    const MaskLikeness likeness = maskLikeness({mask.width, mask.height, mask.coverage}, true);
    mask.segment_confidence = likeness.confidence;
    if (likeness.confidence >= kClean && !levels.is_uneven) {
        return mask;
    }
    const Image image = inFrontOfBlack(decode(encoded, options, true));
    // One level between several grounds displaces rims.
    constexpr double kUneven = 0.7;
    mask.segment_confidence *= hueUniformity(image, mask.coverage) * (levels.is_uneven ? kUneven : 1.0);
    // A drawing may have any number of colours.
    if (likeness.has_rim && isDrawn({image.width, image.height, image.luma})) {
        mask.segment_confidence = std::max(0.5, mask.segment_confidence);
        if (likeness.sharp) {
            return mask;
        }
    }
    auto other = segmented(image, options, Segmentation::Adaptive);
    if (other && other->segment_confidence > mask.segment_confidence + kBetter &&
        other->segment_confidence >= kMinConfidence) {
        return std::move(*other);
    }
    if (likeness.has_rim && mask.segment_confidence < kMinConfidence && !options.accept_any) {
        if (!other && options.allow_dry) {
            return dryMask(image, options, Segmentation::Threshold);
        }
        throw Error(ErrorCode::InvalidInput,
                    "does not look like a footprint: no clear edge between liquid and dry; "
                    "give a segmentation method or a threshold to read it anyway");
    }
    return mask;
}

}  // namespace

Mask decodeMask(std::span<const std::byte> encoded, const MaskOptions& options)
{
    try {
        if (options.seeds) {
            return *segmented(inFrontOfBlack(decode(encoded, options, true)), options, Segmentation::Seeds);
        }
        if (options.colour) {
            const Image image = decode(encoded, options, true);
            if (auto found = segmented(image, options, Segmentation::Colour)) {
                return std::move(*found);
            }
            if (options.allow_dry) {
                return dryMask(image, options, Segmentation::Colour);
            }
            throw Error(ErrorCode::InvalidInput, "nothing in the picture has the colour " + text(*options.colour) +
                                                     "; its most common colours are " + commonColours(image));
        }
        const bool by_threshold = options.segment == Segmentation::Auto || options.segment == Segmentation::Threshold;
        LevelMask levels = maskFromImage(decode(encoded, options, false), options);
        Mask& mask = levels.mask;
        if (mask.channel == Channel::Alpha) {
            return mask;
        }
        if (by_threshold) {
            const bool is_auto =
                options.segment == Segmentation::Auto && options.channel == Channel::Auto && !options.levels;
            return is_auto && !mask.raster_scale ? autoMask(encoded, options, std::move(levels)) : std::move(mask);
        }
        if (auto found = segmented(inFrontOfBlack(decode(encoded, options, true)), options, options.segment)) {
            return std::move(*found);
        }
        if (options.allow_dry) {
            return dryMask(mask, options, options.segment);
        }
        throw Error(ErrorCode::InvalidInput, std::string("the segmentation method ") + name(options.segment) +
                                                 " finds no edge in the picture, so no liquid");
    } catch (const cv::Exception&) {
        throwOutOfMemory();
    } catch (const std::bad_alloc&) {
        throwOutOfMemory();
    }
}

std::vector<std::byte> readImageBytes(const std::filesystem::path& path)
{
    return readImageFile(path);
}

Mask readMask(const std::filesystem::path& path, const MaskOptions& options)
{
    return fromImageFile(path, [&](std::span<const std::byte> encoded) { return decodeMask(encoded, options); });
}

void Mask::validate() const
{
    if (width < 1 || height < 1) {
        throw Error(ErrorCode::InvalidInput,
                    "mask size " + std::to_string(width) + " x " + std::to_string(height) + " must be at least 1 x 1");
    }
    if (raster_scale && !(*raster_scale > 0.0 && std::isfinite(*raster_scale))) {
        throw Error(ErrorCode::InvalidInput, "mask drawn_scale " + numberText(*raster_scale) + " must be positive");
    }
    const auto pixels = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
    if (coverage.size() != pixels) {
        throw Error(ErrorCode::InvalidInput, "mask coverage holds " + std::to_string(coverage.size()) +
                                                 " values, must be width * height = " + std::to_string(pixels));
    }
}

}  // namespace droplet
