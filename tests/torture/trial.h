// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <string>

#include "droplet/droplet.h"
#include "droplet/mask/mask.h"
#include "droplet/shape/fill.h"
#include "torture/corpus.h"

namespace droplet::torture {

/// Outcome of an item.
enum class Outcome {
    Droplets,  ///< sound droplets
    Refused,   ///< with Error InvalidInput, exit code 3
    Failed,    ///< anything else
};

/// Outcome and cost of an item.
struct Verdict {
    Outcome outcome = Outcome::Failed;
    std::size_t droplets = 0;
    std::size_t triangles = 0;
    double seconds = 0.0;                                        ///< processor time without the proof of soundness
    double min_angle = std::numeric_limits<double>::infinity();  ///< [rad]
    std::string message;                                         ///< reason of a refusal or failure; one line
};

/// Kinds of fill between which items alternate, the default first.
inline constexpr std::size_t kFills = 4;
Fill fillOf(std::size_t turn);

/// First flaw of droplets made of a mask, in one line; empty if none. They must be sound and filled as asked, all
/// figures must be finite, and every border of the mask must be a loop or a dropped speck.
std::string flawsOf(const Droplet& droplet, const Mask& mask, const Fill& fill);

/// Makes a surface of an item, with default options except for the fill and 5k triangles, and proves that the surface
/// is sound and the fill reached.
Verdict tryLibrary(const Item& item, const Fill& fill);

/// Runs a reader on a file that may be broken. It must return or throw Error InvalidInput or InvalidArgument.
Verdict tryReading(const std::function<void()>& read);

/// Runs the command droplet-shape. It must end with exit code 0 and a file, or 3 and one line.
Verdict tryCommand(const Item& item);

}  // namespace droplet::torture
