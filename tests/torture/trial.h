// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <string>

#include "droplet/droplet.h"
#include "droplet/footprint/mask.h"
#include "droplet/shape/fill.h"
#include "torture/corpus.h"

namespace droplet::torture {

/// What became of an item.
enum class Outcome {
    Droplets,  ///< sound ones
    Refused,   ///< with Error InvalidInput, exit code 3
    Failed,    ///< anything else
};

/// What became of an item, and what it took.
struct Verdict {
    Outcome outcome = Outcome::Failed;
    std::size_t droplets = 0;
    std::size_t triangles = 0;
    double seconds = 0.0;                                        ///< of processor time, proof of soundness not counted
    double min_angle = std::numeric_limits<double>::infinity();  ///< [rad]
    std::string message;                                         ///< why refused or failed; one line
};

/// The ways in which items take turns to be filled, the default first.
inline constexpr std::size_t kFills = 4;
Fill fillOf(std::size_t turn);

/// What is wrong with droplets made of a mask, in one line: whether they are sound, filled as asked, all figures
/// finite, and every border of the mask is a loop or was dropped as a speck. Empty if nothing is.
std::string flawsOf(const Droplet& droplet, const Mask& mask, const Fill& fill);

/// Takes an item from its bytes to the surface, all options but the fill and the number of triangles (5k) as they are
/// by default, and proves the surface sound and the fill reached.
Verdict tryLibrary(const Item& item, const Fill& fill);

/// Runs what reads a file that may be broken: it has to return, or to throw Error InvalidInput or InvalidArgument.
Verdict tryReading(const std::function<void()>& read);

/// Runs droplet-shape itself: it has to end with exit code 0 and a file, or 3 and one line.
Verdict tryCommand(const Item& item);

}  // namespace droplet::torture
