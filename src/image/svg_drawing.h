// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>

// Interface between the library and its program that draws SVG: plain data in two files in memory. Both come from the
// same build.
//
// The program reads an SvgRequest and then the SVG's text from its standard input. It writes an SvgDrawing and, from
// kSvgContent on, the pixels or the line to its standard output. It maps both. Messages of the program and its
// libraries go to standard error, a pipe whose closing also signals the program's end.

namespace droplet {

struct SvgRequest {
    std::size_t max_pixels = 0;  ///< as in DecodeOptions
    int long_side = 0;           ///< as in DecodeOptions [px]
    double seconds = 0.0;        ///< limit of processor time [s]
    std::size_t memory = 0;      ///< limit of memory without the pixels, with the stack [B]
    std::size_t tags = 0;        ///< tags in the text: a bound on the depth of references between elements
    bool line = false;           ///< whether the line that text follows is requested instead of pixels
};

enum class SvgOutcome { None, Drawn, Damaged, Refused };

struct SvgDrawing {
    SvgOutcome outcome = SvgOutcome::None;
    int width = 0;                     ///< [px]
    int height = 0;                    ///< [px]
    double scale = 0.0;                ///< pixels per CSS px
    double physical_width = 0.0;       ///< physical width of the page [m]; 0 if it states none
    std::size_t points = 0;            ///< of the line, as in SvgLine
    std::size_t others = 0;            ///< the same
    double page_width = 0.0;           ///< the same
    std::array<char, 1000> problem{};  ///< why it is not drawn, in one line
    std::array<char, 1000> lacking{};  ///< as Image::lacking
};

/// Offset of the pixels: premultiplied ARGB in 32 bits, row by row; or of the line's points: two doubles each.
inline constexpr std::size_t kSvgContent = 4096;
static_assert(sizeof(SvgDrawing) <= kSvgContent);

}  // namespace droplet
