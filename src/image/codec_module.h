// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

// Interface between the library and its module of image codecs, which is opened at run time: plain data, no exceptions.
// Both come from the same build.

extern "C" {

enum class DropletOutcome { Decoded, TooLarge, Damaged, OutOfMemory };

struct DropletPicture {
    int width;
    int height;
    int channels;        ///< 1 grey; 3 blue, green, red; 4 with alpha
    int bits;            ///< bits of a sample: 8 or 16, unsigned; 32 or 64, floating point; 0 for other kinds
    const void* pixels;  ///< row by row, without gaps
    void* owner;         ///< owner of the pixels, for dropletRelease
    char problem[160];   ///< for a damaged file: OpenCV's message, or empty
};

/// Decodes a file with OpenCV, without output. The size is compared with max_pixels before memory for the pixels is
/// allocated; for an image that is too large, only width and height are filled in.
using DropletDecode = DropletOutcome(const void* encoded, std::size_t size, std::size_t max_pixels,
                                     DropletPicture* picture);

using DropletRelease = void(DropletPicture* picture);

/// Encodes 32-bit floats as OpenEXR, without output.
/// @param channels  1 grey, 3 red, green, blue
/// @param picture   receives the file's bytes as `pixels`, with their number as width; for dropletRelease
using DropletEncodeExr = DropletOutcome(const float* values, int width, int height, int channels,
                                        DropletPicture* picture);

// The module's functions.
DropletDecode dropletDecode;
DropletEncodeExr dropletEncodeExr;
DropletRelease dropletRelease;
}
