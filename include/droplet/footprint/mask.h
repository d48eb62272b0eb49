// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "droplet/footprint/css_colour.h"
#include "droplet/footprint/segment.h"

namespace droplet {

/// Which part of an image's pixels says where the liquid is.
enum class Channel {
    Auto,   ///< alpha if the image uses it, else luma against the colour of the image's border
    Alpha,  ///< opaque is liquid, as it stands: no stretching of levels
    Luma,   ///< bright is liquid, as it stands: no look at the border, no stretching of levels
};

/// Levels of a channel, in [0, 1], that are dry and liquid.
struct MaskLevels {
    Channel channel = Channel::Luma;  ///< never Auto
    double dry = 0.0;
    double liquid = 1.0;
};

/// How the pixels of an image become coverage by liquid.
struct MaskOptions {
    Channel channel = Channel::Auto;
    bool invert = false;                            ///< exchange liquid and dry, after all other decisions
    std::size_t max_pixels = std::size_t{1} << 28;  ///< largest image decoded: 16384 × 16384
    int vector_long_side = 2048;                    ///< longer side that SVG is drawn with [px], 1 … 32767
    Segmentation segment = Segmentation::Auto;      ///< Auto with a channel but Auto is Threshold; alpha that
                                                    ///< is used goes before it
    bool insist = false;                            ///< take a picture even if it does not look like a mask
    bool may_be_dry = false;                        ///< a picture without an edge, or without the colour, is a mask
                                                    ///< without liquid, as a frame may be
    std::optional<CssColour> colour = {};           ///< what has it is liquid, whatever segment and channel say
    double vector_seconds = 10.0;  ///< that drawing an SVG may take, by the clock and of processor time
    std::size_t vector_memory = std::size_t{1} << 30;  ///< that drawing an SVG may take beside its pixels [B], ≥ 64 MiB
    std::optional<MaskLevels> levels = {};  ///< with Channel::Auto: taken instead of the image's own, so that
                                            ///< the frames of a sequence are read alike; an image without
                                            ///< alpha is opaque then
};

/// How much of every pixel liquid covers, and how that was decided.
/// Invariant: `coverage.size() == width * height`, width and height ≥ 1.
struct Mask {
    int width = 0;                        ///< [px]
    int height = 0;                       ///< [px]
    std::vector<std::uint16_t> coverage;  ///< row by row from the top left; 0 dry, 65535 liquid

    Channel channel = Channel::Luma;                 ///< the channel that was used; never Auto
    bool inverted = false;                           ///< true if dark (or transparent) pixels are the liquid
    Segmentation segment = Segmentation::Threshold;  ///< the way that was taken; never Auto
    double segment_confidence = 1.0;  ///< how much the picture looks like a mask taken that way, in [0, 1]
    double level_dry = 0.0;           ///< channel level in [0, 1] that became coverage 0
    double level_liquid = 1.0;        ///< channel level in [0, 1] that became coverage 65535

    std::optional<MaskLevels> found;  ///< with Channel::Auto: what the image by itself says, before `invert`; empty if
                                      ///< nothing stands out in it, as in an image of one level

    std::optional<double> drawn_scale;     ///< of an SVG image: pixels of the mask per CSS px of the page, > 0
    std::optional<double> physical_width;  ///< of an SVG image that states its size in cm, mm, in, pt or pc [m]

    [[nodiscard]] std::uint16_t at(int x, int y) const
    {
        return coverage[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
    }

    /// Guarantees: returns only when the invariant holds.
    /// @throws Error InvalidInput
    void validate() const;
};

/// Reads a mask from an encoded image: PNG or JPEG; TIFF, WebP, BMP, PBM/PGM/PPM, JPEG 2000, OpenEXR or Radiance HDR
/// where OpenCV's image codecs are installed; of 1 to 16 bits or, but for TIFF, of floats, which are cut to 0 … 1;
/// grey, palette, RGB, CMYK, with or without alpha; turned upright if its EXIF data say so. Or from an SVG image,
/// compressed by gzip or not, which is drawn on a transparent page.
///
/// The mask of an SVG image is exactly as wide as its page and less than a pixel higher. Its longer side has
/// vector_long_side pixels or one more, or as many as max_pixels and 32767 a side admit; more if the shorter side would
/// have fewer than 16. The page is that of the SVG's width and height, at 96 px to the inch, or its viewBox, or just
/// what is drawn. Nothing the image refers to is read, neither from disk nor from the network, but what it holds itself
/// as data: URLs. Text depends on the fonts installed. A process of its own draws, which ends with the call: whatever a
/// drawing does to it is an error here. The host's threads, signals and descriptors are left alone.
///
/// The size in the file's header is checked before any pixel is decoded or memory for it taken. Levels are those
/// stored: 8-bit v is 257 v of 65535, luma is ITU-R BT.601 of the image in front of black, so that transparent
/// pixels are dark.
///
/// With Channel::Auto, an image with at least one pixel less than half opaque is read by its alpha, liquid being
/// its most opaque level if that is a quarter or more, else full opacity. Any other is read by luma, dry being the
/// level of the border (its median) and liquid the level farthest from it that is not a stray: more than 1 % of
/// all pixels clear of dry lie at it or up to an eighth nearer to dry. Clear of dry means apart by a quarter of the
/// range; if no pixel is, levels stay unstretched and no coverage reaches half. Levels on the other side of dry
/// are dry. An image of one level is all liquid if brighter than half, all dry otherwise.
///
/// With Segmentation::Auto, a picture read by luma that this makes no clean mask of (rims without an edge in the
/// picture, ground or liquid of many levels, grains) is taken by Segmentation::Adaptive if that makes a better one.
/// Its rims have fractional coverage, too; what is too small or has no edge of its own is dropped.
///
/// A colour asked for is looked for in CIE Lab, to a distance of 20; where it blends into another its share is the
/// coverage. What is transparent has no colour.
/// @param encoded  the file's bytes
/// @param options  which channel, whether to invert, largest size
/// @throws Error   InvalidInput: not an image, truncated, larger than max_pixels, of a kind not read, codecs not
///                 installed, no alpha where alpha was asked;
///                 no mask, whichever way it is taken, unless insist; no edge or nothing of the colour, unless
///                 may_be_dry;
///                 SVG: no area; over 64 MiB, 250 000 tags, 500 000 references, vector_seconds or vector_memory;
///                 nested too deeply; librsvg or the program that draws with it missing
Mask decodeMask(std::span<const std::byte> encoded, const MaskOptions& options = {});

/// The bytes of an image's file, for decodeMask. Of a file that does not begin like an image only the beginning.
/// @throws Error InvalidInput: missing, unreadable, a directory
std::vector<std::byte> readImageBytes(const std::filesystem::path& path);

/// Reads a mask from a file, as decodeMask does.
/// @throws Error InvalidInput: missing, unreadable, a directory, empty, or as decodeMask
Mask readMask(const std::filesystem::path& path, const MaskOptions& options = {});

}  // namespace droplet
