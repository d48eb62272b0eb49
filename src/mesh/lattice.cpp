// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/lattice.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "droplet/error.h"
#include "mesh/lattice_triangles.h"
#include "number_text.h"

namespace droplet {
namespace {

[[noreturn]] void fail(const std::string& message)
{
    throw Error(ErrorCode::InvalidArgument, message);
}

/// Whether the grid holds the last vertices, each at its place.
void validatePlaces(const PlanarMesh& mesh)
{
    const Lattice& lattice = *mesh.lattice;
    if (!(lattice.edge > 0.0 && std::isfinite(lattice.edge))) {
        fail("lattice.edge " + numberText(lattice.edge) + " m of the mesh must be positive");
    }
    const LatticeGrid& grid = lattice.grid;
    if (grid.region().empty() || grid.begin() < mesh.rimVertexCount() || grid.end() != mesh.vertices.size()) {
        fail("lattice.grid of the mesh must hold its last vertices, none of the rim");
    }
    std::uint32_t v = grid.begin();
    for (const Site& site : grid.region().sites()) {
        if (!(mesh.vertices[v] == latticePoint(lattice.edge, site))) {
            fail("vertex " + std::to_string(v) + " of the mesh must be at its lattice point");
        }
        ++v;
    }
}

}  // namespace

void validateLattice(const PlanarMesh& mesh)
{
    if (!mesh.lattice) {
        return;
    }
    validatePlaces(mesh);
    const LatticeGrid& grid = mesh.lattice->grid;
    const double just_longer = 1.01 * mesh.lattice->edge;  // the next distance on the lattice is √3 edges
    std::vector<std::uint8_t> regular(mesh.vertices.size(), 0);
    for (const GridRun& run : regularRuns(mesh)) {
        std::fill_n(regular.begin() + run.first, run.count, std::uint8_t{1});
    }
    std::size_t in_lattice = 0;
    std::size_t all_regular = 0;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const Triangle& t = mesh.triangles[i];
        bool neighbours = true;
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec2 side = mesh.vertices[t[k]] - mesh.vertices[t[(k + 1) % 3]];
            neighbours = neighbours && t[k] >= grid.begin() && length(side) < just_longer;
        }
        const bool is_regular = regular[t[0]] + regular[t[1]] + regular[t[2]] == 3;
        in_lattice += neighbours ? 1 : 0;
        all_regular += is_regular ? 1 : 0;
        if (is_regular != (i >= mesh.lattice->first_regular_triangle)) {
            fail("lattice.first_regular_triangle of the mesh must part regular triangles from others");
        }
    }
    if (in_lattice != trianglesOf(grid.region()).size() || all_regular != trianglesOf(eroded(grid.region())).size()) {
        fail("neighbouring points of the mesh's lattice must form triangles");
    }
}

std::size_t irregularTriangleCount(const PlanarMesh& mesh)
{
    return mesh.lattice ? mesh.lattice->first_regular_triangle : mesh.triangles.size();
}

std::vector<GridRun> regularRuns(const PlanarMesh& mesh)
{
    std::vector<GridRun> runs;
    if (mesh.lattice) {
        const LatticeGrid& grid = mesh.lattice->grid;
        for (const RowInterval& i : eroded(grid.region()).intervals()) {
            runs.push_back(grid.run(i));
        }
    }
    return runs;
}

}  // namespace droplet
