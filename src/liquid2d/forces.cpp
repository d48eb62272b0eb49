// SPDX-License-Identifier: GPL-3.0-or-later
// Viscosity: Monaghan: Smoothed particle hydrodynamics. Reports on Progress in Physics 68, 2005.
// Surface tension: Brackbill, Kothe, Zemach: A continuum method for modeling surface tension. Journal of Computational
// Physics 100, 1992; for particles: Morris: Simulating surface tension with smoothed particle hydrodynamics.
// International Journal for Numerical Methods in Fluids 33, 2000. Forces between pairs of particles would need no
// curvature, but the pressure that balances them freezes the particles into a lattice.
#include "forces.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "blocks.h"

namespace droplet {
namespace {

/// Support of the colour's kernel, in supports of the pressure's kernel: wide enough for smooth normals.
constexpr double kReach = 2.0;

/// Gradient of the colour, in wide supports, below which a particle lies within the liquid.
constexpr double kFaint = 0.15;

/// Integral of the colour's gradient over the liquid's side of a flat rim of the lattice, and its mean depth [m].
struct Rim {
    double jump = 0.0;
    double depth = 0.0;
};

Rim latticeRim(const Kernel& kernel, double spacing)
{
    const double step = latticeStep(spacing);
    const double height = 0.5 * std::sqrt(3.0) * step;
    const double area = spacing * spacing;
    constexpr int kRows = 6;
    Rim rim;
    for (int row = 0; row < kRows; ++row) {
        double gradient = 0.0;
        for (int other = 0; other < 2 * kRows; ++other) {
            for (int column = -kRows; column <= kRows; ++column) {
                const double y = height * (row - other);
                const double r = std::hypot(step * (column + 0.5 * ((other - row) % 2 == 0 ? 0 : 1)), y);
                if (r > 0.0 && r < kernel.support()) {
                    gradient += area * kernel.both(r).slope_over_distance * y;
                }
            }
        }
        rim.jump += height * std::abs(gradient);
        rim.depth += height * std::abs(gradient) * (row + 0.5) * height;
    }
    rim.depth /= rim.jump;
    return rim;
}

/// Calls work(j, x_i − x_j, distance) for all other particles within a distance of one.
template <typename Work>
void forOthersWithin(double reach, std::size_t i, std::span<const Vec2> position, const CellGrid& cells,
                     const Work& work)
{
    const int away = static_cast<int>(std::ceil(kReach));
    const int column = cells.column(position[i].x);
    const int row = cells.row(position[i].y);
    for (int r = row - away; r <= row + away; ++r) {
        const auto [first, last] = cells.range(r, column - away, column + away);
        for (std::uint32_t j = first; j < last; ++j) {
            const Vec2 x = position[i] - position[j];
            const double square = dot(x, x);
            if (square < reach * reach && square > 0.0) {
                work(j, x, std::sqrt(square));
            }
        }
    }
}

}  // namespace

void addViscosity(std::span<Vec2> acceleration, const FluidState& state, const Neighbourhood& near, double viscosity)
{
    near.forEach([&](std::size_t i, auto groups, auto) {
        Vec2 sum;
        for (const auto& g : groups) {
            for (std::size_t k = 0; k < 4; ++k) {
                const Vec2 x = state.position[i] - state.position[g.index[k]];
                const double square = dot(x, x);
                if (square > 0.0) {
                    // 8 = 2(d + 2) in the plane.
                    const double approach = dot(state.velocity[i] - state.velocity[g.index[k]], x);
                    sum = sum + (8.0 * viscosity * approach / square) * Vec2{g.x[k], g.y[k]};
                }
            }
        }
        acceleration[i] = acceleration[i] + sum;
    });
}

void addSurfaceTension(std::span<Vec2> acceleration, std::span<const Vec2> position, const CellGrid& cells,
                       const SurfaceTension& tension)
{
    const Kernel kernel(kReach * tension.spacing);
    const double area = tension.spacing * tension.spacing;
    std::vector<Vec2> gradient(position.size());
    std::vector<Vec2> normal(position.size());
    forBlocks(
        position.size(),
        [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                forOthersWithin(kernel.support(), i, position, cells, [&](std::uint32_t, Vec2 x, double distance) {
                    gradient[i] = gradient[i] + (area * kernel.both(distance).slope_over_distance) * x;
                });
                const double size = length(gradient[i]);
                if (size * kernel.support() > kFaint) {
                    normal[i] = (1.0 / size) * gradient[i];
                }
            }
        },
        Neighbourhood::kBlock);
    const Rim rim = latticeRim(kernel, tension.spacing);
    const double strength = tension.over_density / rim.jump;
    forBlocks(
        position.size(),
        [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                if (normal[i] == Vec2{}) {
                    continue;
                }
                // The normals turn along the rim alone: their divergence is exact if they turn evenly.
                double spread = 0.0;
                double places = 0.0;
                forOthersWithin(kernel.support(), i, position, cells, [&](std::uint32_t j, Vec2 x, double distance) {
                    if (normal[j] != Vec2{}) {
                        const double slope = kernel.both(distance).slope_over_distance;
                        spread += slope * dot(normal[i] - normal[j], x);
                        places += slope * cross(normal[i], x) * cross(normal[i], x);
                    }
                });
                if (places != 0.0) {
                    // Normals point into the liquid, so round liquid has a negative divergence.
                    // Particles show no curve narrower than themselves.
                    const double sharpest = 1.0 / tension.spacing;
                    const double below = std::clamp(-spread / places, -0.5 * sharpest, sharpest);
                    const double curvature = below / (1.0 + below * rim.depth);
                    acceleration[i] = acceleration[i] + (strength * curvature) * gradient[i];
                }
            }
        },
        Neighbourhood::kBlock);
}

}  // namespace droplet
