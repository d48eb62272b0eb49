// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "droplet/expression/expression.h"
#include "drops.h"
#include "particle_cells.h"
#include "surface_kernel.h"

namespace droplet {

/// Scalar field around the rim of the liquid on nodes of square cells; liquid is where it exceeds kIsoValue.
struct Field {
    /// Tile without nodes.
    static constexpr std::int32_t kDry = -1;
    static constexpr std::int32_t kLiquid = -2;
    double spacing = 0.0;                             ///< of the particles [m]
    int nodes_per_cell = 2;                           ///< along a side of a cell
    std::vector<TilePlace> tiles;                     ///< those with nodes
    std::vector<std::array<std::int32_t, 9>> around;  ///< as in ParticleCells, or kDry, kLiquid
    std::vector<float> values;                        ///< rows of nodes of each tile

    [[nodiscard]] int side() const { return kTileSide * nodes_per_cell; }
    [[nodiscard]] std::size_t nodes() const
    {
        return static_cast<std::size_t>(side()) * static_cast<std::size_t>(side());
    }
};

/// What the field is made of.
struct FieldOptions {
    double smoothing = 1.0;
    int nodes_per_cell = 2;
    bool everywhere = false;  ///< evaluates all nodes, also those that are surely liquid
};

/// Kernel of a particle by how much liquid is around it.
struct KernelShape {
    double support = 0.0;  ///< in spacings
    double weight = 0.0;
};

/// Support of the kernel in bulk liquid, in spacings.
double bulkSupport(double smoothing);

/// @param coverage  sum of the bulk kernels of the particle and its neighbours at its place: ~1 in bulk liquid
KernelShape kernelShape(double coverage, double smoothing);

/// Coverage of particles and its gradient, for particles near the rim; 1 for all others.
struct Coverage {
    std::vector<std::uint64_t> full;      ///< cells of each tile that are surely liquid
    std::vector<std::uint64_t> occupied;  ///< cells of each tile with particles
    std::vector<std::uint64_t> near;      ///< cells of each tile whose particles act on the rim
    std::vector<float> coverage;          ///< sorted
};

/// @param opened  cells of each tile that are not to count as full
Coverage coverageOf(const ParticleCells& cells, const std::vector<std::uint64_t>& opened, const FieldOptions& options);

/// Field of a particle that holds air: below zero in the middle, and just below the surface's value on a ring.
/// @param inner  radius of the air, > 0
/// @param outer  radius of air and water, > inner
double eraser(double distance, double inner, double outer);

/// Field around the particles of a frame.
/// @param drops       of the frame: those far from liquid are left out
/// @param everywhere  evaluates all nodes, also those that are surely liquid
Field fieldOf(const std::vector<Drop>& drops, const ExpressionState& state, const ParticleFrame& frame,
              const ExpressionOptions& options, bool everywhere = false);

}  // namespace droplet
