// SPDX-License-Identifier: GPL-3.0-or-later
//
// U. Trottenberg, C. Oosterlee, A. Schüller, "Multigrid" (2001). Coarser lattices ignore the rim. A coarse function
// that crosses the rim is cut off there, and kept if enough of it lies inside. Galerkin products give the right
// matrices for the functions that are kept.

#include "shape/hierarchy.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "blocks.h"
#include "mesh/lattice.h"
#include "mesh/mean_edge.h"

namespace droplet {
namespace {

using Index = std::uint32_t;

/// Kinds of a row; other values are its number among irregular rows.
constexpr Index kNone = std::numeric_limits<Index>::max();
constexpr Index kRegular = kNone - 1;

/// Smallest sum of a coarse function's values at the finer level's unknowns at which it is kept; a whole function
/// has 4. From 1.6 to 2.2 the number of iterations is the same; at 2.6 it rises from 9 to 14.
constexpr double kEnoughInside = 1.9;

/// Size of the coarsest level, which is factored; below it this takes almost no time.
constexpr Index kCoarsest = 400;

/// Smallest ratio of unknowns at which a coarser level pays.
constexpr double kMinCoarsening = 1.5;

/// Kinds and indices of the rows of a level that is being built.
struct Plan {
    LatticeGrid grid;
    Index off_lattice = 0;   ///< unknowns off the lattice; they come first
    LatticeRegion region;    ///< lattice points that are unknowns
    std::vector<Index> row;  ///< kNone, kRegular or a number for every index

    [[nodiscard]] bool isUnknown(Index i) const { return row[i] != kNone; }
};

/// Coarse points on or beside the unknowns of a region, and others.
LatticeRegion parentsOf(const LatticeRegion& region, std::vector<RowInterval> others = {})
{
    std::vector<RowInterval> parents = std::move(others);
    for (const RowInterval& i : region.intervals()) {
        const std::array<Site, 2> first = toCoarser(i.first());
        const std::array<Site, 2> last = toCoarser(i.last());
        for (std::size_t k = 0; k < 2; ++k) {
            parents.push_back({first[k].row, first[k].column, last[k].column + 1});
        }
    }
    return LatticeRegion(std::move(parents));
}

/// Storage of a level: its own points, and those that coarser functions and stencils read.
LatticeGrid gridFor(const LatticeRegion& own, const LatticeRegion& parents, Index first)
{
    std::vector<RowInterval> storage;
    const auto add_with_neighbours = [&](Site begin, Site last) {
        for (std::int32_t dr = -1; dr <= 1; ++dr) {
            storage.push_back({begin.row + dr, begin.column - 1, last.column + 2});
        }
    };
    for (const RowInterval& i : own.intervals()) {
        add_with_neighbours(i.first(), i.last());
    }
    for (const RowInterval& i : parents.intervals()) {
        add_with_neighbours(toFiner(i.first()), toFiner(i.last()));
    }
    return {LatticeRegion(std::move(storage)), first};
}

/// Calls visit with pieces of a row that are short enough for several threads.
template <typename Visit>
void forEachPiece(const RowInterval& i, const Visit& visit)
{
    constexpr std::int32_t kPiece = 4096;
    for (std::int32_t c = i.begin; c < i.end; c += kPiece) {
        visit(RowInterval{i.row, c, std::min(c + kPiece, i.end)});
    }
}

void addRegularRuns(Level& level, const Plan& plan, const RowInterval& i)
{
    forEachPiece(i, [&](const RowInterval& piece) { level.regular.push_back(plan.grid.run(piece)); });
}

/// Merges the entries of one row that share a column.
class RowBuilder {
public:
    void add(Index column, double value)
    {
        for (Entry& entry : entries_) {
            if (entry.column == column) {
                entry.value += value;
                return;
            }
        }
        entries_.push_back({column, value});
    }

    struct Entry {
        Index column = 0;
        double value = 0.0;
    };
    [[nodiscard]] const std::vector<Entry>& entries() const { return entries_; }

    /// Reserves space for a typical row.
    void reserve() { entries_.reserve(16); }

    /// Sorts by column, so that a row does not depend on the order of add().
    void sort()
    {
        std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) { return a.column < b.column; });
    }

private:
    std::vector<Entry> entries_;
};

/// Makes rows in parallel and stores them in order.
template <typename Make>
void fillRows(SparseRows& rows, const Make& make)
{
    std::vector<RowBuilder> made(rows.unknowns.size());
    tbb::parallel_for(std::size_t{0}, made.size(), [&](std::size_t k) {
        made[k].reserve();
        make(k, made[k]);
        made[k].sort();
    });
    for (const RowBuilder& row : made) {
        rows.starts.push_back(rows.starts.back() + static_cast<Index>(row.entries().size()));
    }
    rows.columns.resize(rows.starts.back());
    rows.values.resize(rows.starts.back());
    tbb::parallel_for(std::size_t{0}, made.size(), [&](std::size_t k) {
        Index at = rows.starts[k];
        for (const RowBuilder::Entry& entry : made[k].entries()) {
            rows.columns[at] = entry.column;
            rows.values[at++] = entry.value;
        }
    });
}

/// Triangle of the lattice that contains a point.
struct LatticeTriangle {
    std::array<Site, 3> corners;
    std::array<double, 3> weights{};
};

LatticeTriangle triangleAround(Vec2 p, double edge)
{
    const double height = 0.5 * std::numbers::sqrt3 * edge;
    const auto row = static_cast<std::int32_t>(std::floor(p.y / height));
    // Steps along the row and along the direction 60° further.
    const double up = p.y / height - static_cast<double>(row);
    const double along = p.x / edge - (row % 2 == 0 ? 0.0 : 0.5) - 0.5 * up;
    const auto column = static_cast<std::int32_t>(std::floor(along));
    const double right = along - static_cast<double>(column);
    const Site left{row, column};
    const Site next = neighbour(left, LatticeStep::Right);
    const Site above = neighbour(left, LatticeStep::AboveRight);
    if (right + up <= 1.0) {
        return {{left, next, above}, {1.0 - right - up, right, up}};
    }
    return {{neighbour(above, LatticeStep::Right), above, next}, {right + up - 1.0, 1.0 - right, 1.0 - up}};
}

/// Points of a mesh's lattice that are not held.
LatticeRegion freePoints(const PlanarMesh& mesh, const std::vector<std::uint8_t>& held)
{
    if (!mesh.lattice) {
        return {};
    }
    const LatticeGrid& grid = mesh.lattice->grid;
    if (held.empty()) {
        return grid.region();
    }
    std::vector<RowInterval> free;
    for (const RowInterval& i : grid.region().intervals()) {
        const Index first = grid.at(i.first()) - mesh.rimVertexCount();
        std::int32_t begin = i.begin;
        for (std::int32_t c = i.begin; c <= i.end; ++c) {
            if (c == i.end || held[first + static_cast<Index>(c - i.begin)] != 0) {
                free.push_back({i.row, begin, c});
                begin = c + 1;
            }
        }
    }
    return LatticeRegion(std::move(free));
}

/// One more than the last vertex off the lattice.
std::uint32_t endOffLattice(const PlanarMesh& mesh)
{
    return mesh.lattice ? mesh.lattice->grid.begin() : static_cast<std::uint32_t>(mesh.vertices.size());
}

/// Numbers the unknowns of the finest level.
void planFinest(const PlanarMesh& mesh, const LatticeRegion& free, const std::vector<std::uint8_t>& held,
                const LatticeRegion& parents, Hierarchy& hierarchy, Level& level, Plan& plan)
{
    const std::uint32_t rim = mesh.rimVertexCount();
    const auto inner = static_cast<Index>(mesh.vertices.size()) - rim;
    plan.region = free;
    plan.off_lattice = endOffLattice(mesh) - rim;
    plan.grid = gridFor(plan.region, parents, plan.off_lattice);
    plan.row.assign(plan.grid.end(), kNone);
    level.size = plan.grid.end();

    hierarchy.index_of_vertex.assign(inner, kNoUnknown);
    for (Index i = 0; i < plan.off_lattice; ++i) {
        if (!held.empty() && held[i] != 0) {
            continue;
        }
        ++level.unknowns;
        hierarchy.index_of_vertex[i] = i;
        plan.row[i] = static_cast<Index>(level.irregular.unknowns.size());
        level.irregular.unknowns.push_back(i);
    }
    for (const RowInterval& i : eroded(plan.region).intervals()) {
        std::fill_n(plan.row.begin() + plan.grid.at(i.first()), i.size(), kRegular);
        addRegularRuns(level, plan, i);
    }
    for (const RowInterval& points : plan.region.intervals()) {
        level.unknowns += points.size();
        const Index vertex = mesh.lattice->grid.at(points.first()) - rim;
        const Index first = plan.grid.at(points.first());
        for (Index i = 0; i < points.size(); ++i) {
            hierarchy.index_of_vertex[vertex + i] = first + i;
            if (plan.row[first + i] != kRegular) {
                plan.row[first + i] = static_cast<Index>(level.irregular.unknowns.size());
                level.irregular.unknowns.push_back(first + i);
            }
        }
    }
}

/// Stiffness between two corners of a lattice triangle, by the direction of the edge between them. It is the same for
/// triangles that point up and down, and linear in the tensor.
struct EdgeStiffness {
    double next = 0.0;
    double above_left = 0.0;
    double above_right = 0.0;
};

EdgeStiffness edgeStiffness(const SymmetricTensor& g)
{
    // The gradient of a corner is the opposite edge, turned by 90°, divided by twice the area.
    const double half_shear = 0.5 * g.xy;
    const double half = 0.5 * std::numbers::inv_sqrt3;
    return {half * (0.5 * g.yy - 1.5 * g.xx), half_shear - half * g.yy, -half_shear - half * g.yy};
}

/// Stiffness of all lattice triangles. The index of one that points up is its lower left corner; of one that points
/// down, its lower corner.
struct LatticeStiffness {
    std::vector<EdgeStiffness> upward;
    std::vector<EdgeStiffness> downward;

    explicit LatticeStiffness(std::size_t size = 0) : upward(size), downward(size) {}
};

/// Unknowns on a level's lattice, with their neighbours.
std::vector<GridRun> latticeRuns(const Plan& plan)
{
    std::vector<GridRun> runs;
    for (const RowInterval& i : plan.region.intervals()) {
        forEachPiece(i, [&](const RowInterval& piece) { runs.push_back(plan.grid.run(piece)); });
    }
    return runs;
}

/// Stiffness of the triangles of a mesh's lattice.
LatticeStiffness finestTriangles(const PlanarMesh& mesh, const Operator& op, const Hierarchy& hierarchy,
                                 const Plan& plan)
{
    std::vector<Index> above(plan.grid.end(), kNone);
    for (const GridRun& run : latticeRuns(plan)) {
        for (Index k = 0; k < run.count; ++k) {
            above[run.first + k] = run.above + k;
        }
    }
    LatticeStiffness triangles(plan.grid.end());
    const std::uint32_t rim = mesh.rimVertexCount();
    forBlocks(mesh.triangles.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            std::array<Index, 3> at{};
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t v = mesh.triangles[i][k];
                at[k] = mesh.onRim(v) ? kNoUnknown : hierarchy.index_of_vertex[v - rim];
            }
            std::sort(at.begin(), at.end());
            if (at[0] < plan.off_lattice || at[2] == kNoUnknown) {
                continue;
            }
            if (at[1] == at[0] + 1 && at[2] == above[at[0]] + 1) {
                triangles.upward[at[0]] = edgeStiffness(op.tensors[i]);
            } else if (at[1] == above[at[0]] && at[2] == at[1] + 1) {
                triangles.downward[at[0]] = edgeStiffness(op.tensors[i]);
            }
        }
    });
    return triangles;
}

/// Galerkin product on the triangles of the coarser lattice. Gradients are constant there, so the stiffness, which is
/// linear in the tensors, is the mean over the four parts.
LatticeStiffness coarserTriangles(const LatticeStiffness& fine, const std::vector<RestrictionRun>& runs,
                                  std::size_t size)
{
    const auto mean = [](const EdgeStiffness& a, const EdgeStiffness& b, const EdgeStiffness& c,
                         const EdgeStiffness& d) -> EdgeStiffness {
        return {0.25 * ((a.next + b.next) + (c.next + d.next)),
                0.25 * ((a.above_left + b.above_left) + (c.above_left + d.above_left)),
                0.25 * ((a.above_right + b.above_right) + (c.above_right + d.above_right))};
    };
    LatticeStiffness coarse(size);
    tbb::parallel_for(std::size_t{0}, runs.size(), [&](std::size_t i) {
        const RestrictionRun& run = runs[i];
        for (Index k = 0; k < run.count; ++k) {
            const Index at = run.fine + 2 * k;
            const Index above = run.above + 2 * k;
            coarse.upward[run.first + k] =
                mean(fine.upward[at], fine.upward[at + 1], fine.upward[above + 1], fine.downward[at + 1]);
            coarse.downward[run.first + k] =
                mean(fine.downward[at], fine.downward[above], fine.downward[above + 1], fine.upward[above]);
        }
    });
    return coarse;
}

/// Sums the triangles of the lattice up to rows.
LatticeRows rowsOf(const LatticeStiffness& triangles, const Plan& plan, const Operator& op, double edge)
{
    const double mass = op.mass_weight * 0.25 * std::numbers::sqrt3 * edge * edge;
    const double shared = mass / 6.0;
    const std::size_t size = plan.grid.end();
    LatticeRows rows{std::vector<double>(size, 0.0), std::vector<double>(size, 0.0), std::vector<double>(size, 0.0),
                     std::vector<double>(size, 0.0)};
    const std::vector<GridRun> runs = latticeRuns(plan);
    tbb::parallel_for(std::size_t{0}, runs.size(), [&](std::size_t r) {
        const GridRun& run = runs[r];
        for (Index k = 0; k < run.count; ++k) {
            const Index i = run.first + k;
            const EdgeStiffness& up = triangles.upward[i];
            const EdgeStiffness& down = triangles.downward[i];
            const EdgeStiffness& up_left = triangles.upward[i - 1];
            const EdgeStiffness& up_below = triangles.upward[run.below + k];
            const EdgeStiffness& down_left = triangles.downward[run.below + k];
            const EdgeStiffness& down_right = triangles.downward[run.below + k + 1];
            const double next = up.next + down_right.next;
            const double above_left = down.above_left + up_left.above_left;
            const double above_right = down.above_right + up.above_right;
            const double others = (up_left.next + down_left.next) + (down_left.above_right + up_below.above_right) +
                                  (down_right.above_left + up_below.above_left);
            // A row of K sums to 0.
            rows.diagonal[i] = mass - (next + above_left + above_right) - others;
            rows.next[i] = next + shared;
            rows.above_left[i] = above_left + shared;
            rows.above_right[i] = above_right + shared;
        }
    });
    return rows;
}

/// Assembles the irregular rows, and the load of all unknowns.
void assembleFinest(const PlanarMesh& mesh, const Operator& op, Hierarchy& hierarchy, Level& level, const Plan& plan)
{
    const std::uint32_t rim = mesh.rimVertexCount();
    const auto index = [&](std::uint32_t v) { return mesh.onRim(v) ? kNoUnknown : hierarchy.index_of_vertex[v - rim]; };
    // Regular triangles have irregular rows only around held vertices.
    const std::size_t count = op.held.empty() ? irregularTriangleCount(mesh) : mesh.triangles.size();

    // Triangles around every irregular unknown.
    const std::size_t rows = level.irregular.unknowns.size();
    std::vector<Index> starts(rows + 1, 0);
    const auto for_each_corner = [&](const auto& visit) {
        for (std::uint32_t t = 0; t < count; ++t) {
            for (std::uint32_t k = 0; k < 3; ++k) {
                const Index i = index(mesh.triangles[t][k]);
                if (i != kNoUnknown && plan.row[i] < kRegular) {
                    visit(plan.row[i], t, k);
                }
            }
        }
    };
    for_each_corner([&](Index row, std::uint32_t, std::uint32_t) { ++starts[row + 1]; });
    for (std::size_t k = 0; k < rows; ++k) {
        starts[k + 1] += starts[k];
    }
    struct Corner {
        std::uint32_t triangle = 0;
        std::uint32_t corner = 0;
    };
    std::vector<Corner> corners(starts.back());
    std::vector<Index> filled(starts.begin(), starts.end() - 1);
    for_each_corner([&](Index row, std::uint32_t t, std::uint32_t k) { corners[filled[row]++] = {t, k}; });

    const double scale = 1.0 / (hierarchy.edge * hierarchy.edge);
    hierarchy.load.assign(level.size, 0.0);
    fillRows(level.irregular, [&](std::size_t k, RowBuilder& row) {
        double load = 0.0;
        for (Index c = starts[k]; c < starts[k + 1]; ++c) {
            const Triangle& t = mesh.triangles[corners[c].triangle];
            const auto matrix = elementMatrix(mesh, corners[c].triangle, op);
            load += doubleArea(mesh, t) / 6.0;
            for (std::size_t b = 0; b < 3; ++b) {
                if (index(t[b]) != kNoUnknown) {
                    row.add(index(t[b]), matrix[corners[c].corner][b]);
                }
            }
        }
        hierarchy.load[level.irregular.unknowns[k]] = load * scale;
    });
    const double area = 0.25 * std::numbers::sqrt3;  // area of a triangle divided by edge²
    for (const GridRun& run : level.regular) {
        std::fill_n(hierarchy.load.begin() + run.first, run.count, 2.0 * area);
    }
}

/// Unknowns along a row of the coarser lattice, as points of the finer one.
RestrictionRun restrictionOf(const LatticeGrid& coarse, const LatticeGrid& fine, const RowInterval& i)
{
    const Site first = toFiner(i.first());
    return {coarse.at(i.first()), i.size(), fine.at(first), fine.at(neighbour(first, LatticeStep::BelowLeft)),
            fine.at(neighbour(first, LatticeStep::AboveLeft))};
}

/// Points of the finer lattice where a coarse function is not 0: its centre, and six half-way around.
std::array<Index, 7> childrenOf(const RestrictionRun& run, Index k)
{
    const Index centre = run.fine + 2 * k;
    const Index below = run.below + 2 * k;
    const Index above = run.above + 2 * k;
    return {centre, centre - 1, centre + 1, below, below + 1, above, above + 1};
}

constexpr double weightOfChild(std::size_t child)
{
    return child == 0 ? 1.0 : 0.5;
}

/// Unknowns of the finest level off the lattice, with the coarser lattice's triangles around them.
struct OffLattice {
    std::vector<LatticeTriangle> triangles;
    std::vector<RowInterval> corners;
};

OffLattice findOffLattice(const PlanarMesh& mesh, const std::vector<std::uint8_t>& held, double coarse_edge)
{
    OffLattice off;
    const std::uint32_t rim = mesh.rimVertexCount();
    for (std::uint32_t v = rim; v < endOffLattice(mesh); ++v) {
        LatticeTriangle triangle = triangleAround(mesh.vertices[v], coarse_edge);
        for (const Site& s : triangle.corners) {
            off.corners.push_back({s.row, s.column, s.column + 1});
        }
        if (!held.empty() && held[v - rim] != 0) {
            triangle.weights = {};
        }
        off.triangles.push_back(triangle);
    }
    return off;
}

/// Transpose of `inside`, which restricts unknowns off the lattice to the coarser level.
SparseRows transposed(const std::vector<Inside>& inside, Index coarse_size)
{
    std::vector<Index> starts(coarse_size + std::size_t{1}, 0);
    const auto for_each = [&](const auto& visit) {
        for (Index i = 0; i < inside.size(); ++i) {
            for (std::size_t k = 0; k < 3; ++k) {
                if (inside[i].weights[k] != 0.0) {
                    visit(inside[i].corners[k], i, inside[i].weights[k]);
                }
            }
        }
    };
    for_each([&](Index corner, Index, double) { ++starts[corner + 1]; });
    for (Index i = 0; i < coarse_size; ++i) {
        starts[i + 1] += starts[i];
    }
    SparseRows rows;
    for (Index i = 0; i < coarse_size; ++i) {
        if (starts[i] != starts[i + 1]) {
            rows.unknowns.push_back(i);
            rows.starts.push_back(starts[i + 1]);
        }
    }
    rows.columns.resize(starts.back());
    rows.values.resize(starts.back());
    for_each([&](Index corner, Index i, double weight) {
        rows.columns[starts[corner]] = i;
        rows.values[starts[corner]++] = weight;
    });
    return rows;
}

/// Chooses the unknowns of the coarser level among the candidates, and finds their regular rows.
void planCoarser(const Plan& fine, const LatticeRegion& candidates, const SparseRows& outside, Plan& plan, Level& level)
{
    std::vector<double> sums(plan.grid.end(), 0.0);
    for (std::size_t k = 0; k < outside.unknowns.size(); ++k) {
        for (Index e = outside.starts[k]; e < outside.starts[k + 1]; ++e) {
            sums[outside.unknowns[k]] += outside.values[e];
        }
    }
    plan.row.assign(plan.grid.end(), kNone);
    std::vector<RowInterval> chosen;
    for (const RowInterval& i : candidates.intervals()) {
        const RestrictionRun run = restrictionOf(plan.grid, fine.grid, i);
        RowInterval kept{i.row, i.begin, i.begin};
        for (Index k = 0; k < run.count; ++k) {
            double sum = sums[run.first + k];
            bool regular = true;
            const std::array<Index, 7> children = childrenOf(run, k);
            for (std::size_t child = 0; child < children.size(); ++child) {
                const Index row = fine.row[children[child]];
                sum += row != kNone ? weightOfChild(child) : 0.0;
                regular = regular && row == kRegular;
            }
            const std::int32_t column = i.begin + static_cast<std::int32_t>(k);
            if (sum < kEnoughInside) {
                chosen.push_back(kept);
                kept = {i.row, column + 1, column + 1};
                continue;
            }
            kept.end = column + 1;
            plan.row[run.first + k] = regular ? kRegular : 0;
        }
        chosen.push_back(kept);
    }
    plan.region = LatticeRegion(std::move(chosen));

    // All neighbours of a regular point are kept: the sum of each is at least 1 + 3/2.
    for (const RowInterval& i : plan.region.intervals()) {
        const Index first = plan.grid.at(i.first());
        level.unknowns += i.size();
        RowInterval regular{i.row, i.begin, i.begin};
        for (std::int32_t c = i.begin; c < i.end; ++c) {
            Index& row = plan.row[first + static_cast<Index>(c - i.begin)];
            if (row == kRegular) {
                regular.end = c + 1;
                continue;
            }
            addRegularRuns(level, plan, regular);
            regular = {i.row, c + 1, c + 1};
            row = static_cast<Index>(level.irregular.unknowns.size());
            level.irregular.unknowns.push_back(first + static_cast<Index>(c - i.begin));
        }
        addRegularRuns(level, plan, regular);
    }
    level.size = plan.grid.end();
}

/// Adds the transfer between the lattice unknowns of two levels.
void addTransfer(const Plan& fine, const Plan& coarse, Level& level)
{
    for (const RowInterval& i : coarse.region.intervals()) {
        forEachPiece(i, [&](const RowInterval& piece) {
            level.restriction.push_back(restrictionOf(coarse.grid, fine.grid, piece));
        });
    }
    for (const RowInterval& i : fine.region.intervals()) {
        forEachPiece(i, [&](const RowInterval& piece) {
            const std::array<Site, 2> parents = toCoarser(piece.first());
            const std::array<Site, 2> next = toCoarser(neighbour(piece.first(), LatticeStep::Right));
            const std::size_t early = next[0].column != parents[0].column ? 0 : 1;
            level.prolongation.push_back({fine.grid.at(piece.first()), piece.size(), coarse.grid.at(parents[early]),
                                          coarse.grid.at(parents[1 - early])});
        });
    }
}

/// Computes the irregular rows of PᵀAP.
void multiply(const Level& fine, const Plan& fine_plan, Level& coarse, const Plan& plan)
{
    // Row of `outside` for every irregular row here.
    std::vector<Index> outside_row(coarse.irregular.unknowns.size(), kNone);
    for (Index k = 0; k < fine.outside.unknowns.size(); ++k) {
        const Index row = plan.row[fine.outside.unknowns[k]];
        if (row < kRegular) {
            outside_row[row] = k;
        }
    }
    fillRows(coarse.irregular, [&](std::size_t k, RowBuilder& result) {
        // Adds a·(row of P).
        const auto add_parents = [&](Site site, double a) {
            for (const Site& parent : toCoarser(site)) {
                const Index at = plan.grid.at(parent);
                if (plan.isUnknown(at)) {
                    result.add(at, 0.5 * a);
                }
            }
        };
        const auto add_irregular = [&](Index row, double weight) {
            for (Index e = fine.irregular.starts[row]; e < fine.irregular.starts[row + 1]; ++e) {
                const Index column = fine.irregular.columns[e];
                const double a = weight * fine.irregular.values[e];
                if (column >= fine_plan.off_lattice) {
                    add_parents(fine_plan.grid.siteOf(column), a);
                    continue;
                }
                const Inside& inside = fine.inside[column];
                for (std::size_t corner = 0; corner < 3; ++corner) {
                    if (inside.weights[corner] != 0.0) {
                        result.add(inside.corners[corner], a * inside.weights[corner]);
                    }
                }
            }
        };
        const Site centre = toFiner(plan.grid.siteOf(coarse.irregular.unknowns[k]));
        const auto add_child = [&](Site child, double weight) {
            const Index index = fine_plan.grid.at(child);
            const Index row = fine_plan.row[index];
            if (row == kRegular) {
                const std::array<Site, 6> neighbours = neighboursOf(child);
                const RegularRow entries = regularRow(fine, index, fine_plan.grid.at(neighbours[2]));
                add_parents(child, weight * entries.diagonal);
                for (std::size_t n = 0; n < neighbours.size(); ++n) {
                    add_parents(neighbours[n], weight * entries.neighbours[n]);
                }
            } else if (row != kNone) {
                add_irregular(row, weight);
            }
        };
        add_child(centre, 1.0);
        for (const Site& child : neighboursOf(centre)) {
            add_child(child, 0.5);
        }
        if (const Index row = outside_row[k]; row != kNone) {
            for (Index e = fine.outside.starts[row]; e < fine.outside.starts[row + 1]; ++e) {
                add_irregular(fine_plan.row[fine.outside.columns[e]], fine.outside.values[e]);
            }
        }
    });
}

}  // namespace

RegularRow regularRow(const Level& level, std::uint32_t index, std::uint32_t below)
{
    if (level.varying.empty()) {
        const double n = level.stencil.neighbour;
        return {level.stencil.diagonal, {n, n, n, n, n, n}};
    }
    const LatticeRows& rows = level.varying;
    return {rows.diagonal[index],
            {rows.next[index - 1], rows.next[index], rows.above_right[below], rows.above_left[below + 1],
             rows.above_left[index], rows.above_right[index]}};
}

Hierarchy buildHierarchy(const PlanarMesh& mesh, const Operator& whole)
{
    Operator op = whole;
    op.mass_weight = std::max(op.mass_weight, 0.0);
    Hierarchy hierarchy;
    hierarchy.edge = mesh.lattice ? mesh.lattice->edge : meanEdge(area(mesh), mesh.triangles.size());
    double edge = hierarchy.edge;
    const LatticeRegion free = freePoints(mesh, op.held);
    const OffLattice off = findOffLattice(mesh, op.held, 2.0 * edge);
    LatticeRegion candidates = parentsOf(free, off.corners);
    Plan plan;
    Level level;
    level.stencil = regularStencil(edge, op);
    planFinest(mesh, free, op.held, candidates, hierarchy, level, plan);
    LatticeStiffness triangles;
    if (!op.tensors.empty()) {
        triangles = finestTriangles(mesh, op, hierarchy, plan);
        level.varying = rowsOf(triangles, plan, op, edge);
    }
    if (whole.mass_weight < 0.0) {
        hierarchy.indefinite = level;
        hierarchy.indefinite->stencil = regularStencil(edge, whole);
        if (!op.tensors.empty()) {
            hierarchy.indefinite->varying = rowsOf(triangles, plan, whole, edge);
        }
        assembleFinest(mesh, whole, hierarchy, *hierarchy.indefinite, plan);
    }
    assembleFinest(mesh, op, hierarchy, level, plan);
    while (level.unknowns > kCoarsest) {
        edge *= 2.0;
        LatticeRegion next_candidates = parentsOf(candidates);
        Plan coarse_plan;
        coarse_plan.grid = gridFor(candidates, next_candidates, 0);
        if (hierarchy.levels.empty()) {
            for (const LatticeTriangle& triangle : off.triangles) {
                Inside& inside = level.inside.emplace_back();
                for (std::size_t k = 0; k < 3; ++k) {
                    inside.corners[k] = coarse_plan.grid.at(triangle.corners[k]);
                    inside.weights[k] = triangle.weights[k];
                }
            }
        }
        SparseRows outside = transposed(level.inside, coarse_plan.grid.end());
        Level coarse;
        coarse.stencil = regularStencil(edge, op);
        planCoarser(plan, candidates, outside, coarse_plan, coarse);
        if (static_cast<double>(level.unknowns) < kMinCoarsening * static_cast<double>(coarse.unknowns) ||
            coarse.unknowns == 0) {
            level.inside.clear();
            break;
        }
        for (Inside& inside : level.inside) {
            for (std::size_t k = 0; k < 3; ++k) {
                inside.weights[k] = coarse_plan.isUnknown(inside.corners[k]) ? inside.weights[k] : 0.0;
            }
        }
        level.outside = transposed(level.inside, coarse_plan.grid.end());
        addTransfer(plan, coarse_plan, level);
        if (!op.tensors.empty()) {
            triangles = coarserTriangles(triangles, level.restriction, coarse_plan.grid.end());
            coarse.varying = rowsOf(triangles, coarse_plan, op, edge);
        }
        multiply(level, plan, coarse, coarse_plan);
        hierarchy.levels.push_back(std::move(level));
        level = std::move(coarse);
        plan = std::move(coarse_plan);
        candidates = std::move(next_candidates);
    }
    hierarchy.levels.push_back(std::move(level));
    return hierarchy;
}

}  // namespace droplet
