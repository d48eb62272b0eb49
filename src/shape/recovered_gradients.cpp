// SPDX-License-Identifier: GPL-3.0-or-later
//
// O. C. Zienkiewicz and J. Z. Zhu, "A simple error estimator and adaptive procedure for practical engineering analysis"
// (1987).

#include "shape/recovered_gradients.h"

#include <tbb/parallel_for.h>

#include <cstddef>
#include <cstdint>
#include <numbers>

#include "mesh/lattice.h"
#include "shape/gradient.h"

namespace droplet {

std::vector<Vec2> recoveredGradients(const PlanarMesh& mesh, const std::vector<double>& values)
{
    std::vector<Vec2> gradients(mesh.vertices.size());
    const std::size_t irregular = irregularTriangleCount(mesh);
    std::vector<double> weights(mesh.vertices.size(), 0.0);
    for (std::size_t i = 0; i < irregular; ++i) {
        const Triangle& t = mesh.triangles[i];
        const double twice = doubleArea(mesh, t);
        const Vec2 g = gradient(mesh, t, values);
        for (const std::uint32_t v : t) {
            gradients[v] = gradients[v] + twice * g;
            weights[v] += twice;
        }
    }
    for (std::size_t v = 0; v < gradients.size(); ++v) {
        if (weights[v] > 0.0) {
            gradients[v] = (1.0 / weights[v]) * gradients[v];
        }
    }
    const std::vector<GridRun> runs = regularRuns(mesh);
    tbb::parallel_for(std::size_t{0}, runs.size(), [&](std::size_t k) {
        // Around six equilateral triangles the mean is Σ u·(direction to the neighbour) / (3·edge).
        const double along = 1.0 / (3.0 * mesh.lattice->edge);
        const GridRun& run = runs[k];
        const double* centre = values.data() + run.first;
        const double* below = values.data() + run.below;
        const double* above = values.data() + run.above;
        const double* left = centre - 1;
        for (std::uint32_t i = 0; i < run.count; ++i) {
            const double across = (above[i + 1] - above[i]) + (below[i + 1] - below[i]);
            const double up = (above[i] + above[i + 1]) - (below[i] + below[i + 1]);
            gradients[run.first + i] =
                along * Vec2{(centre[i + 1] - left[i]) + 0.5 * across, 0.5 * std::numbers::sqrt3 * up};
        }
    });
    return gradients;
}

}  // namespace droplet
