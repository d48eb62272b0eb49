// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <iosfwd>
#include <vector>

#include "droplet/shape/capillary_surface.h"
#include "droplet/shape/solve.h"

namespace droplet {

/// Writes droplets as a datafile for Surface Evolver (K. A. Brakke, version 2.70). Evolver finds their equilibrium
/// independently and so checks ours: fixed rims, true area of all triangles, and gravity, tilt and volume exact for
/// plane triangles.
///
/// In the file σ is 1, and the unit of length is a power of ten metres near the footprints' size. The comments at its
/// beginning give the factors to SI units, the energy, pressure, height and volume of the heights written, and the
/// commands that the file defines: equilibrate, report, vertically and freely. Vertices that move vertically minimise
/// among the same functions as the exact model; vertices that move freely may hang over. Those of sheets move freely,
/// and stay in place where they lie on the ground.
/// With FillSharing::Total all droplets form one body, with FillSharing::Each every droplet is a body.
///
/// Guarantees: text in any locale, numbers with all their digits; the same bytes for the same droplets. The stream is
/// left failed if it did not take everything.
/// @param out       text stream
/// @param surfaces  at least one, of any model
/// @param options   options of the solution; of the fill only `sharing` is used: volumes are those of the surfaces
/// @return          bytes handed to the stream
/// @throws Error    InvalidArgument: options or surfaces
std::uint64_t writeEvolver(std::ostream& out, const std::vector<CapillarySurface>& surfaces,
                           const SolveOptions& options);

}  // namespace droplet
