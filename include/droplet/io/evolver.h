// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <iosfwd>
#include <vector>

#include "droplet/mesh/planar_mesh.h"
#include "droplet/shape/solve.h"

namespace droplet {

/// Writes droplets as a datafile for Surface Evolver (K. A. Brakke, version 2.70), which finds their equilibrium by
/// itself and can so check ours: rims fixed, true area of all triangles, gravity, tilt and volume exact for plane
/// triangles.
///
/// σ is 1 there and the unit of length a power of ten metres near the footprints' size. Opening comments give the
/// factors back to SI, the energy, pressure, height and volume of the heights written, and the commands the file
/// defines: equilibrate, report, and vertical or free, which say how vertices move. Moving vertically they minimise
/// among the same functions as the exact model does, whichever model the heights are from; moving freely they may hang
/// over. With FillSharing::Total all droplets are one body, with FillSharing::Each one each.
///
/// Guarantees: text in any locale, numbers with all their digits; the same bytes for the same droplets. The stream is
/// left failed if it did not take everything.
/// @param meshes   valid, at least one
/// @param fields   heights on them, of either model, in their order
/// @param options  what they were solved with; of the fill only its sharing is used: volumes are those of the heights
/// @return         bytes handed to the stream
/// @throws Error   InvalidArgument for options, or where meshes and fields do not fit together
std::uint64_t writeEvolver(std::ostream& out, const std::vector<PlanarMesh>& meshes,
                           const std::vector<HeightField>& fields, const SolveOptions& options);

}  // namespace droplet
