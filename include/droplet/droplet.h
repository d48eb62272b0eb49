// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "droplet/domain/domain.h"
#include "droplet/mask/mask.h"
#include "droplet/mesh/planar_mesh.h"
#include "droplet/mesh/triangulate.h"
#include "droplet/outline/outline.h"
#include "droplet/progress.h"
#include "droplet/shape/figures.h"
#include "droplet/shape/refill.h"
#include "droplet/shape/solve.h"
#include "droplet/surface/loft.h"
#include "droplet/surface/surface.h"

/// The library's names.
namespace droplet {

/// Options of all stages from a mask to a surface.
struct DropletOptions {
    TraceOptions trace;                        ///< from the mask to its outline
    TriangulateOptions mesh;                   ///< from the outline to meshes
    SolveOptions solve{.model = Model::Auto};  ///< liquid, forces, ground and fill
    bool allow_less = false;                   ///< take the most liquid that a footprint can hold where the fill does
                                               ///< not exist; warnings and Droplet::limits say so
    bool open = false;                         ///< leave out the base
    std::optional<FillRange> fill_range = {};  ///< fills of a surface that can be filled and drained; not with
                                               ///< solve.no_penetration. Model::Auto is then Linear, where every
                                               ///< fill exists, unless the range may shrink
};

/// Results of all stages.
struct Droplet {
    Outline outline;                    ///< rims of the mask; empty if the droplets were made from a domain
    Domain domain;                      ///< footprints
    std::vector<PlanarMesh> meshes;     ///< one per droplet
    Solution solution;                  ///< one surface per droplet, and how they were found
    std::vector<ShapeFigures> figures;  ///< one per droplet
    ShapeFigures total;                 ///< figures of all droplets together
    std::vector<FillLimit> limits;      ///< one per droplet: what makes its amount smaller than the wanted one
    Surface surface;                    ///< surface in space
    std::vector<std::string> warnings;  ///< one line each, the grave ones first
    std::size_t severe_warnings = 0;    ///< number of warnings that say that the droplet cannot be right
};

/// Runs all stages: trace, split, triangulate, solve, measure, loft.
/// @param mask      valid
/// @param options   options of all stages
/// @param progress  called at the start of every stage; may be empty
/// @throws Error    InvalidInput: no liquid; InvalidArgument: options; NoSuchDroplet: the solver failed
Droplet makeDroplet(const Mask& mask, const DropletOptions& options = {}, const Progress& progress = {});

/// Runs the stages after tracing, with an outline from any source: split, triangulate, solve, measure, loft.
/// @param outline   loops that do not cross, and an extent
/// @param options   options of all stages; trace is not used
/// @param progress  called at the start of every stage but Trace; may be empty
/// @throws Error    InvalidInput: no loop encloses liquid; InvalidArgument: options, crossing loops; NoSuchDroplet: the
///                  solver failed
Droplet makeDroplet(Outline outline, const DropletOptions& options = {}, const Progress& progress = {});

/// Runs the stages after splitting: triangulate, solve, measure, loft.
/// @param domain    footprints; those of different droplets may have a boundary in common, as from traceColours
/// @param options   options of all stages; trace is not used
/// @param progress  called at the start of every stage but Trace; may be empty
/// @throws Error    InvalidArgument: options, crossing loops; NoSuchDroplet: the solver failed
Droplet makeDroplet(Domain domain, const DropletOptions& options = {}, const Progress& progress = {});

}  // namespace droplet
