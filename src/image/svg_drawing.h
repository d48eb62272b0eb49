// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>

// What the library and its program that draws SVG say to each other: plain data in two files in memory. Both are of
// one build.
//
// The program reads an SvgRequest and then the SVG's text from its standard input, and writes an SvgDrawing and, a page
// (kSvgPixels) from the beginning, the pixels to its standard output, both of which it maps. What it and its libraries
// say goes to standard error, a pipe that also tells when it has ended.

namespace droplet {

struct SvgRequest {
    std::size_t max_pixels = 0;  ///< as in DecodeOptions
    int long_side = 0;           ///< as in DecodeOptions [px]
    double seconds = 0.0;        ///< of processor time
    std::size_t memory = 0;      ///< beside the pixels, its stack included [B]
    std::size_t tags = 0;        ///< of the text: no more elements can refer to one another
};

enum class SvgOutcome { None, Drawn, Damaged, Refused };

struct SvgDrawing {
    SvgOutcome outcome = SvgOutcome::None;
    int width = 0;                     ///< [px]
    int height = 0;                    ///< [px]
    double scale = 0.0;                ///< pixels per CSS px
    double physical_width = 0.0;       ///< of the page, if it states one [m]; else 0
    std::array<char, 1000> problem{};  ///< why it is not drawn, in one line
};

/// Where the pixels begin: premultiplied ARGB in 32 bits, row by row.
inline constexpr std::size_t kSvgPixels = 4096;
static_assert(sizeof(SvgDrawing) <= kSvgPixels);

}  // namespace droplet
