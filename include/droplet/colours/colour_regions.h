// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "droplet/image/css_colour.h"
#include "droplet/mask/mask.h"

namespace droplet {

/// Largest number of colours of a picture.
inline constexpr std::size_t kMaxColours = 64;

/// Options of decodeColours().
struct ColourOptions {
    /// Number of colours of the liquid, 1 … kMaxColours; empty: as many as stand out.
    std::optional<std::size_t> colours = {};
    /// What is dry: Alpha: what is less than half opaque, nothing in an opaque picture. Luma: the most common colour of
    /// the picture's border. Auto: as Alpha if the picture has transparent parts, else as Luma if that colour has at
    /// least 95 % of the border, else nothing.
    Channel channel = Channel::Auto;
    std::size_t max_pixels = std::size_t{1} << 28;     ///< as in MaskOptions
    int vector_long_side = 2048;                       ///< as in MaskOptions
    double vector_seconds = 10.0;                      ///< as in MaskOptions
    std::size_t vector_memory = std::size_t{1} << 30;  ///< as in MaskOptions

    /// @throws Error InvalidArgument if the number of colours is out of its range
    void validate() const;
};

/// Colour of a picture's palette.
struct PaletteColour {
    CssColour colour;        ///< mean of its pixels, or the most common one
    std::size_t pixels = 0;  ///< number of its pixels
};

/// Two colours of a pixel whose areas are known.
struct PixelMixture {
    std::uint8_t other = 0;    ///< label of the second colour; 0 for none
    std::uint8_t share = 255;  ///< of the pixel's label, beside the second colour; 255 all
};

/// Picture whose pixels are sorted by colour.
/// Invariants: label has width · height entries; alpha too, or none; either is_blend and colour, or mixture and alpha
/// have as many. A label is 0 for dry, or 1 + index in the palette.
struct ColourRegions {
    int width = 0;                                    ///< [px]
    int height = 0;                                   ///< [px]
    std::vector<std::uint8_t> label;                  ///< row by row from the top left
    std::vector<std::uint8_t> is_blend;               ///< 1 for a pixel at a rim that mixes the colours on both sides
    std::vector<std::array<std::uint8_t, 3>> colour;  ///< of every pixel, sRGB
    std::vector<PixelMixture> mixture;                ///< of every pixel of a drawing, whose areas are exact
    std::vector<std::uint16_t> alpha;                 ///< where that says what is dry; 65535 opaque
    std::vector<PaletteColour> palette;               ///< colours of the liquid, the one with most pixels first
    std::optional<CssColour> background;              ///< colour of what is dry, if it has one
    std::optional<double> raster_scale;               ///< as in Mask
    std::optional<double> physical_width;             ///< as in Mask [m]
    std::string lacking;                              ///< as in Mask
};

/// Sorts the pixels of an encoded image by colour.
///
/// Colours of even parts of the picture are grouped by their distance in CIE 1976 L*a*b*; without a number of colours,
/// groups nearer than 16 become one, and at most 12 remain. A pixel that lies between two colours on opposite sides of
/// it is a blend; it goes to the one with the larger share, and does not become a colour of its own. The result does
/// not depend on the number of threads.
/// @param encoded  the file's bytes, in any format of decodeMask
/// @param options  number of colours, channel, limits
/// @throws Error   InvalidArgument; InvalidInput as decodeMask, or if nothing but background is in the picture
ColourRegions decodeColours(std::span<const std::byte> encoded, const ColourOptions& options = {});

/// Palette of decodeColours() alone, in a fraction of its time. Blends do not count as pixels of a colour.
/// @param encoded  the file's bytes, in any format of decodeMask
/// @param options  number of colours, channel, limits
/// @return         the colour with most pixels first; empty if nothing but background is in the picture
/// @throws Error   InvalidArgument; InvalidInput as decodeMask
std::vector<PaletteColour> decodePalette(std::span<const std::byte> encoded, const ColourOptions& options = {});

}  // namespace droplet
