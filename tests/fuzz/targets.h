// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>

namespace droplet {

// Fuzzers run these functions on arbitrary bytes, the tests on every file of corpus/. They must return: an exception
// other than Error, or a crash, is a failure.

/// Reads an image file's bytes as a mask, by every channel, and as a height map.
void fuzzMask(std::span<const std::byte> bytes);

/// Draws an SVG in a child process; refusals must be one line.
void fuzzSvg(std::span<const std::byte> bytes);

/// Takes the bytes as a small mask and makes a footprint mesh of it.
void fuzzFootprint(std::span<const std::byte> bytes);

/// Reads a mesh's file as an object for droplets to run over; refusals must be one line.
void fuzzObject(std::span<const std::byte> bytes);

/// Reads particles of any format; refusals must be one line.
void fuzzParticles(std::span<const std::byte> bytes);

/// Reads the scene of a 2D liquid; refusals must be one line.
void fuzzScene(std::span<const std::byte> bytes);

}  // namespace droplet
