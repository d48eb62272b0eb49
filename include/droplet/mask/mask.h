// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "droplet/image/css_colour.h"
#include "droplet/mask/seeds.h"
#include "droplet/mask/segment.h"

namespace droplet {

/// Channel of an image that says where the liquid is.
enum class Channel {
    Auto,   ///< alpha if the image uses it, else luma relative to the luma of the image's border
    Alpha,  ///< opaque is liquid; levels are not stretched
    Luma,   ///< bright is liquid; the border is ignored, levels are not stretched
};

/// Levels of a channel that mean dry and liquid, in [0, 1].
struct MaskLevels {
    Channel channel = Channel::Luma;  ///< never Auto
    double dry = 0.0;                 ///< level that becomes coverage 0
    double liquid = 1.0;              ///< level that becomes coverage 1
};

/// Rules that turn the pixels of an image into coverage.
struct MaskOptions {
    Channel channel = Channel::Auto;                ///< channel that says where the liquid is
    bool invert = false;                            ///< exchange liquid and dry, after all other decisions
    std::size_t max_pixels = std::size_t{1} << 28;  ///< largest image decoded: 16384 × 16384
    int vector_long_side = 2048;                    ///< longer side at which an SVG is drawn [px], 1 … 32767
    Segmentation segment = Segmentation::Auto;  ///< segmentation method, ignored if alpha is read; Auto means Threshold
                                                ///< if channel is not Auto
    bool accept_any = false;                    ///< accept a picture that does not look like a mask
    bool allow_dry = false;  ///< a picture without an edge, or without the colour, is not an error but gives a mask
                             ///< without liquid
    std::optional<CssColour> colour = {};  ///< everything of this colour is liquid; overrides segment and channel
    std::optional<Seeds> seeds = {};       ///< strokes of the picture's size, on liquid and on dry ground, for clear
                                           ///< droplets; override all of these
    double vector_seconds = 10.0;          ///< limit for drawing an SVG [s], of wall-clock time and of processor time
    std::size_t vector_memory = std::size_t{1} << 30;  ///< limit for drawing an SVG, without its pixels [B], ≥ 64 MiB
    /// With Channel::Auto: used instead of the image's own levels, so that all frames of a sequence are read alike. An
    /// image without alpha then counts as opaque.
    std::optional<MaskLevels> levels = {};
};

/// Coverage of every pixel by liquid, and how it was found.
/// Invariant: `coverage.size() == width * height`, width and height ≥ 1.
struct Mask {
    int width = 0;                        ///< [px]
    int height = 0;                       ///< [px]
    std::vector<std::uint16_t> coverage;  ///< row by row from the top left; 0 dry, 65535 liquid

    Channel channel = Channel::Luma;                 ///< channel that was used; never Auto
    bool inverted = false;                           ///< true if dark (or transparent) pixels are the liquid
    Segmentation segment = Segmentation::Threshold;  ///< method that was used; never Auto
    double segment_confidence = 1.0;  ///< how much the picture looks like a mask by that method, in [0, 1]
    double level_dry = 0.0;           ///< channel level in [0, 1] that became coverage 0
    double level_liquid = 1.0;        ///< channel level in [0, 1] that became coverage 65535

    std::optional<MaskLevels> found;  ///< with Channel::Auto: levels found in the image itself, before `invert`; empty
                                      ///< if nothing stands out, as in an image of one level

    std::optional<double> raster_scale;    ///< for an SVG image: pixels of the mask per CSS px of the page, > 0
    std::optional<double> physical_width;  ///< for an SVG image with a size in cm, mm, in, pt or pc: its width [m]
    std::string lacking;  ///< for an SVG image: what it has and is not drawn, such as textPath, with advice; else empty

    /// Coverage of the pixel in column x and row y, both from 0; the range is not checked.
    [[nodiscard]] std::uint16_t at(int x, int y) const
    {
        return coverage[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
    }

    /// Checks the invariant.
    /// @throws Error InvalidInput if it does not hold
    void validate() const;
};

/// Reads a mask from an encoded image.
///
/// Formats: PNG and JPEG; TIFF, WebP, BMP, PBM/PGM/PPM, JPEG 2000, OpenEXR and Radiance HDR if OpenCV's image codecs
/// are installed; SVG, gzipped or not. Samples have 1 to 16 bits or, except in TIFF, are floats, which are clipped to
/// [0, 1]. Colours are grey, palette, RGB or CMYK, with or without alpha. The image is turned upright as its EXIF data
/// say. The size in the file's header is checked before memory is allocated or a pixel decoded. Levels are used as
/// stored: an 8-bit level v is 257 v of 65535. Luma is ITU-R BT.601 of the image in front of black, so transparent
/// pixels are dark.
///
/// SVG: The drawing is made on a transparent page. The page has the SVG's width and height at 96 px per inch, or its
/// viewBox, or else the bounds of the drawing. The mask is exactly as wide as the page and less than a pixel higher.
/// Its longer side has vector_long_side pixels or one more, but no more than max_pixels and 32767 a side allow. It has
/// more if the shorter side would be under 16 pixels. Nothing outside the file is read, from disk or from the network;
/// data: URLs are. Text depends on the installed fonts. A separate process draws and ends with the call. If it crashes
/// or exceeds a limit, this call throws. The host's threads, signals and descriptors do not change.
///
/// Channel::Auto: An image with at least one pixel less than half opaque is read by its alpha. Liquid is then its most
/// opaque level if that is a quarter or more, else full opacity. All other images are read by luma. Dry is the median
/// level of the border. Liquid is the level farthest from dry that is not a stray: more than 1 % of all pixels that are
/// clear of dry have this level or one up to an eighth nearer to dry. Clear of dry means at least a quarter of the
/// range away. If no pixel is, the higher of two dark levels is liquid, of two others the one off the border; of more,
/// none is stretched or reaches half. Levels beyond dry are dry. One level is all liquid if over half, else all dry.
///
/// Segmentation::Auto: If a picture read by luma gives no clean mask (rims without an edge in the picture, many levels
/// of ground or liquid, grains), Segmentation::Adaptive is used if its mask is better. Its rims have fractional
/// coverage, too. Regions that are too small or have no edge are dropped.
///
/// A colour is searched in CIE Lab, up to a distance of 20. Where it blends into another colour, its share is the
/// coverage. Transparent pixels have no colour.
/// @param encoded  the file's bytes
/// @param options  channel, inversion, segmentation, limits
/// @throws Error   InvalidInput: not an image, truncated, larger than max_pixels, an unsupported format, missing
///                 codecs, no alpha although Channel::Alpha is set; no mask by any method, unless insist; no edge, or
///                 nothing of the colour, unless allow_dry; SVG: no area or ink; over 64 MiB, 250 000 tags, 500 000
///                 references, vector_seconds or vector_memory; nested too deeply; librsvg or the program that draws
///                 with it missing
Mask decodeMask(std::span<const std::byte> encoded, const MaskOptions& options = {});

/// Reads an image file for decodeMask. Of a file that does not begin like an image, only the beginning is read.
/// @throws Error InvalidInput: missing, unreadable, a directory
std::vector<std::byte> readImageBytes(const std::filesystem::path& path);

/// Reads a mask from a file, as decodeMask does.
/// @throws Error InvalidInput: missing, unreadable, a directory, empty, or as decodeMask
Mask readMask(const std::filesystem::path& path, const MaskOptions& options = {});

}  // namespace droplet
