// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "droplet/error.h"
#include "droplet/mesh/planar_mesh.h"
#include "mesh/lattice.h"
#include "mesh/lattice_triangles.h"
#include "number_text.h"

namespace droplet {
namespace {

[[noreturn]] void fail(const std::string& message)
{
    throw Error(ErrorCode::InvalidArgument, message);
}

/// Checks that the grid holds the last vertices, each at its place.
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

/// Checks the recorded lattice.
void validateLattice(const PlanarMesh& mesh)
{
    validatePlaces(mesh);
    const LatticeGrid& grid = mesh.lattice->grid;
    const double just_longer = 1.01 * mesh.lattice->edge;  // the next larger distance on the lattice is √3 edges
    std::vector<std::uint8_t> regular(mesh.vertices.size(), 0);
    for (const GridRun& run : regularRuns(mesh.lattice.get())) {
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
            fail("lattice.first_regular_triangle of the mesh must separate regular triangles from others");
        }
    }
    if (in_lattice != trianglesOf(grid.region()).size() || all_regular != trianglesOf(eroded(grid.region())).size()) {
        fail("neighbouring points of the mesh's lattice must form triangles");
    }
}

}  // namespace

void PlanarMesh::validate() const
{
    if (loop_starts.size() < 2 || loop_starts.front() != 0 || loop_starts.back() > vertices.size()) {
        fail("loop_starts of the mesh must run from 0 to the number of rim vertices");
    }
    for (std::size_t k = 0; k < loopCount(); ++k) {
        if (loop_starts[k] + 3 > loop_starts[k + 1]) {
            fail("loop " + std::to_string(k) + " of the mesh must have at least three vertices");
        }
    }
    for (const Vec2 v : vertices) {
        if (!std::isfinite(v.x) || !std::isfinite(v.y)) {
            fail("vertices of the mesh must be finite");
        }
    }
    std::vector<std::uint32_t> next(rimVertexCount());
    for (std::size_t k = 0; k < loopCount(); ++k) {
        for (std::uint32_t v = loop_starts[k]; v < loop_starts[k + 1]; ++v) {
            next[v] = nextOnRim(*this, k, v);
        }
    }
    for (const Triangle& t : triangles) {
        if (std::max({t[0], t[1], t[2]}) >= vertices.size()) {
            fail("triangles of the mesh must index its " + std::to_string(vertices.size()) + " vertices");
        }
        if (!(doubleArea(*this, t) > 0)) {
            fail("triangles of the mesh must be counter-clockwise with positive area");
        }
        if (onRim(std::max({t[0], t[1], t[2]}))) {
            fail("triangles of the mesh must not have all three vertices on the rim");
        }
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t v = t[k];
            const std::uint32_t w = t[(k + 1) % 3];
            if (onRim(v) && onRim(w) && next[v] != w) {
                fail(fmt::format(
                    "vertices {} and {} of the mesh are joined by an inner edge though both are on the rim", v, w));
            }
        }
    }
    if (lattice) {
        validateLattice(*this);
    }
}

}  // namespace droplet
