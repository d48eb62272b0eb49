// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/lattice.h"

namespace droplet {

std::size_t irregularTriangleCount(const PlanarMesh& mesh)
{
    return mesh.lattice ? mesh.lattice->first_regular_triangle : mesh.triangles.size();
}

std::vector<GridRun> regularRuns(const Lattice* lattice)
{
    std::vector<GridRun> runs;
    if (lattice != nullptr) {
        const LatticeGrid& grid = lattice->grid;
        for (const RowInterval& i : eroded(grid.region()).intervals()) {
            runs.push_back(grid.run(i));
        }
    }
    return runs;
}

}  // namespace droplet
