// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "droplet/shape/solve.h"

namespace droplet {

/// Options of one droplet, or of all at one pressure: with volumes, its own is the fill.
inline SolveOptions ownOptions(const SolveOptions& options, std::size_t group)
{
    SolveOptions own = options;
    if (!options.volumes.empty()) {
        own.volumes.clear();
        own.fill = {FillBy::Volume, options.volumes[group], FillSharing::Each};
    }
    return own;
}

}  // namespace droplet
