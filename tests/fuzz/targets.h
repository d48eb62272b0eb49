// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>

namespace droplet {

// What a fuzzer runs on any bytes at all, and the tests on every file of corpus/. Each returns, or lets an
// exception other than Error out, or crashes; only the first is right.

/// Reads a mask from the bytes of an image file, by every channel, and a height map.
void fuzzMask(std::span<const std::byte> bytes);

/// Draws an SVG in a child process; refusals must be one line.
void fuzzSvg(std::span<const std::byte> bytes);

/// Takes the bytes for a small mask and goes from there to a footprint mesh.
void fuzzFootprint(std::span<const std::byte> bytes);

}  // namespace droplet
