// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

// What the library and its module of image codecs, which is opened at run time, say to each other: plain data, no
// exceptions. Both are of one build.

extern "C" {

enum class DropletOutcome { Decoded, TooLarge, Damaged, OutOfMemory };

struct DropletPicture {
    int width;
    int height;
    int channels;        ///< 1 grey; 3 blue, green, red; 4 with alpha
    int bits;            ///< of a sample: 8 or 16, unsigned; 32 or 64, floating point; 0 of another kind
    const void* pixels;  ///< row by row, without gaps
    void* owner;         ///< of the pixels, for dropletRelease
    char problem[160];   ///< of a damaged file: what OpenCV says of it, or nothing
};

/// Decodes a file with OpenCV, silently. Before memory for its pixels is taken, its size is held against max_pixels:
/// of one too large, only width and height are filled in.
using DropletDecode = DropletOutcome(const void* encoded, std::size_t size, std::size_t max_pixels,
                                     DropletPicture* picture);

using DropletRelease = void(DropletPicture* picture);

/// Encodes 32-bit floats as OpenEXR, silently.
/// @param channels  1 grey, 3 red, green, blue
/// @param picture   takes the file's bytes as `pixels`, so many as its width; for dropletRelease
using DropletEncodeExr = DropletOutcome(const float* values, int width, int height, int channels,
                                        DropletPicture* picture);
}
