// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "droplet/footprint/domain.h"
#include "droplet/footprint/mask.h"
#include "droplet/footprint/outline.h"
#include "droplet/mesh/planar_mesh.h"
#include "droplet/mesh/triangulate.h"
#include "droplet/progress.h"
#include "droplet/shape/figures.h"
#include "droplet/shape/refill.h"
#include "droplet/shape/solve.h"
#include "droplet/surface/loft.h"
#include "droplet/surface/surface.h"

/// The library's names.
namespace droplet {

/// Every stage's options on the way from a mask to a surface.
struct DropletOptions {
    TraceOptions trace;
    TriangulateOptions mesh;
    SolveOptions solve;
    bool open = false;                         ///< leave out the base
    std::optional<FillRange> fill_range = {};  ///< makes a surface that can be filled and drained; of the linear model
                                               ///< alone, without no_penetration
};

/// What every stage made.
struct Droplet {
    Outline outline;
    Domain domain;
    std::vector<PlanarMesh> meshes;  ///< one per droplet
    Solution solution;
    std::vector<ShapeFigures> figures;  ///< one per droplet
    ShapeFigures total;
    Surface surface;
    std::vector<std::string> warnings;  ///< one line each; empty when all is well
    std::size_t grave_warnings = 0;     ///< so many of the first say that the droplet cannot be right
};

/// All stages in one call: trace, split, triangulate, solve, measure, loft.
/// @param mask      valid
/// @param options   of every stage
/// @param progress  told of every stage; may be empty
/// @throws Error    InvalidInput: no liquid; InvalidArgument: options; NoSuchDroplet: the solver failed
Droplet makeDroplet(const Mask& mask, const DropletOptions& options = {}, const Progress& progress = {});

/// The stages from an outline on, wherever that comes from: split, triangulate, solve, measure, loft.
/// @param outline   loops that do not cross, and an extent
/// @param options   of every stage but trace
/// @param progress  told of every stage but Trace; may be empty
/// @throws Error    InvalidInput: no loop encloses liquid; InvalidArgument: options, crossing loops; NoSuchDroplet: the
///                  solver failed
Droplet makeDroplet(Outline outline, const DropletOptions& options = {}, const Progress& progress = {});

}  // namespace droplet
