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
    std::uint32_t fine = 0;   ///< first unknown as a point of the finer lattice; the next one is two further
    std::uint32_t below = 0;  ///< left one of its two neighbours in the row below
    std::uint32_t above = 0;  ///< left one of its two neighbours in the row above
};

/// Unknowns along a lattice row, each half-way between two points of the coarser lattice. From one unknown to the next,
/// `early` and `late` advance in turn, `early` first.
struct ProlongationRun {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
    std::uint32_t early = 0;
    std::uint32_t late = 0;
};

/// Rows of a sparse matrix.
struct SparseRows {
    std::vector<std::uint32_t> unknowns;  ///< unknown of every row
    std::vector<std::uint32_t> starts{0};
    std::vector<std::uint32_t> columns;
    std::vector<double> values;
};

/// Rows of regular unknowns that differ from the stencil. An entry off the diagonal is stored at the unknown further
/// left in the row, or in the row below. Entries that no regular unknown uses are undefined.
struct LatticeRows {
    std::vector<double> diagonal;
    std::vector<double> next;
    std::vector<double> above_left;
    std::vector<double> above_right;

    [[nodiscard]] bool empty() const { return diagonal.empty(); }
};

/// Unknown off the lattice, inside a triangle of the coarser lattice.
struct Inside {
    std::array<std::uint32_t, 3> corners{};
    std::array<double, 3> weights{};  ///< 0 at corners that are not unknowns
};

/// One level of the hierarchy: a matrix, and the transfer to the next coarser level. Vectors have an entry for every
/// index below `size`; entries without an unknown are 0.
struct Level {
    std::uint32_t size = 0;
    std::uint32_t unknowns = 0;
    Stencil stencil;
    std::vector<GridRun> regular;  ///< unknowns with the stencil or rows of `varying`
    LatticeRows varying;           ///< empty: all rows are the stencil
    SparseRows irregular;
    // Transfer to the coarser level, if there is one.
    std::vector<RestrictionRun> restriction;    ///< for unknowns of the coarser level
    std::vector<ProlongationRun> prolongation;  ///< for unknowns of this level on the lattice
    std::vector<Inside> inside;                 ///< unknowns of this level off the lattice; they come first
    SparseRows outside;                         ///< transpose of `inside`, for the restriction
};

/// Index of a held vertex.
inline constexpr std::uint32_t kNoUnknown = std::numeric_limits<std::uint32_t>::max();

/// Row of a regular unknown.
struct RegularRow {
    double diagonal = 0.0;
    std::array<double, 6> neighbours{};  ///< left, right, below left, below right, above left, above right
};

/// Reads the row of a regular unknown.
/// @param below  index of its lower left neighbour
RegularRow regularRow(const Level& level, std::uint32_t index, std::uint32_t below);

/// Levels of a mesh, finest first: its inner vertices, then lattices with twice, four times … the edge length.
struct Hierarchy {
    std::vector<Level> levels;
    std::optional<Level> indefinite;             ///< matrix of the finest level if w < 0
    std::vector<double> load;                    ///< ∫φ/edge² for the finest level's unknowns
    std::vector<std::uint32_t> index_of_vertex;  ///< index of every inner vertex; kNoUnknown if held
    double edge = 0.0;                           ///< [m]
};

/// Builds the levels of K + wM on a mesh; if w < 0, those of K alone.
///
/// The finest level has the matrix itself, the others Galerkin products. In a regular neighbourhood these are the same
/// stencil for the longer edge, or with tensors that of their means. The result is small if most of the mesh is a
/// lattice: its rows are stored only with tensors, and then without columns. A mesh without a lattice has coarser
/// levels with its mean edge length.
Hierarchy buildHierarchy(const PlanarMesh& mesh, const Operator& op);

}  // namespace droplet
