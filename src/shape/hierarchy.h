// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "droplet/mesh/planar_mesh.h"
#include "mesh/lattice_grid.h"
#include "shape/operator.h"

namespace droplet {

/// Unknowns along a lattice row, as points of the finer lattice.
struct RestrictionRun {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
    std::uint32_t fine = 0;   ///< the first as a point of the finer lattice; the next is two further
    std::uint32_t below = 0;  ///< left of its two neighbours there in the row below
    std::uint32_t above = 0;
};

/// Unknowns along a lattice row, each half-way between two points of the coarser lattice. From one to the next the one
/// and the other moves on in turn, `early` first.
struct ProlongationRun {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
    std::uint32_t early = 0;
    std::uint32_t late = 0;
};

/// Rows of a matrix, one after the other.
struct SparseRows {
    std::vector<std::uint32_t> unknowns;  ///< whose rows they are
    std::vector<std::uint32_t> starts{0};
    std::vector<std::uint32_t> columns;
    std::vector<double> values;
};

/// Rows of regular unknowns that differ: entries by the index of the unknown itself and, off the diagonal, of the one
/// further left in the row or in the row below. What no regular unknown looks at means nothing.
struct LatticeRows {
    std::vector<double> diagonal;
    std::vector<double> next;
    std::vector<double> above_left;
    std::vector<double> above_right;

    [[nodiscard]] bool empty() const { return diagonal.empty(); }
};

/// An unknown off the lattice, within a triangle of the coarser lattice.
struct Inside {
    std::array<std::uint32_t, 3> corners{};
    std::array<double, 3> weights{};  ///< 0 at corners that are no unknowns
};

/// One level of the hierarchy: a matrix, and the way to the next coarser level. Vectors have an entry for every index
/// below `size`; those that belong to no unknown are 0.
struct Level {
    std::uint32_t size = 0;
    std::uint32_t unknowns = 0;
    Stencil stencil;
    std::vector<GridRun> regular;  ///< unknowns whose rows are the stencil, or those of `varying`
    LatticeRows varying;           ///< empty: the stencil
    SparseRows irregular;
    // To the coarser level, if there is one.
    std::vector<RestrictionRun> restriction;    ///< of the coarser level's unknowns
    std::vector<ProlongationRun> prolongation;  ///< of this level's unknowns on the lattice
    std::vector<Inside> inside;                 ///< of this level's unknowns off the lattice, which come first
    SparseRows outside;                         ///< its transpose: what they add to the coarser level's unknowns
};

/// Stands for the index of a vertex that is held.
inline constexpr std::uint32_t kNoUnknown = std::numeric_limits<std::uint32_t>::max();

/// The row of a regular unknown.
struct RegularRow {
    double diagonal = 0.0;
    std::array<double, 6> neighbours{};  ///< left, right; below left and right; above left and right
};

/// @param below  index of the neighbour below to the left
RegularRow regularRow(const Level& level, std::uint32_t index, std::uint32_t below);

/// The levels of a mesh, finest first: its inner vertices, then lattices of twice, four times … the edge.
struct Hierarchy {
    std::vector<Level> levels;
    std::optional<Level> indefinite;             ///< the finest level's matrix where w < 0
    std::vector<double> load;                    ///< ∫φ over the finest level's unknowns, by edge² [1]
    std::vector<std::uint32_t> index_of_vertex;  ///< of inner vertices, from the first; kNoUnknown where held
    double edge = 0.0;                           ///< [m]
};

/// Builds the levels of K + wM on a mesh: on the finest, the matrix itself; on the others Galerkin's products, which
/// where all is regular are the same stencil for the longer edge, or with tensors that of their means. Where w < 0 the
/// levels are those of K alone.
///
/// Cheap where most of the mesh is its lattice, the rows of which are stored only with tensors, and then without their
/// columns. Any mesh will do, though: without a lattice, coarser ones of its mean edge length take over.
Hierarchy buildHierarchy(const PlanarMesh& mesh, const Operator& op);

}  // namespace droplet
