// SPDX-License-Identifier: GPL-3.0-or-later
#include "neighbours.h"

#include <algorithm>

namespace droplet {

Neighbourhood::Neighbourhood(const Places& places, const Kernel& kernel)
    : blocks_((places.particles.size() + kBlock - 1) / kBlock),
      density_(places.particles.size()),
      inverse_diagonal_(places.particles.size())
{
    tbb::parallel_for(std::size_t{0}, blocks_.size(), [&](std::size_t b) {
        blocks_[b].begin = b * kBlock;
        fill(blocks_[b], places, kernel);
    });
}

void Neighbourhood::fill(Block& block, const Places& places, const Kernel& kernel)
{
    const std::span<const Vec2> x = places.particles;
    const std::size_t end = std::min(block.begin + kBlock, x.size());
    const double reach = kernel.support() * kernel.support();
    block.groups.reserve(4 * (end - block.begin));
    for (std::size_t i = block.begin; i < end; ++i) {
        double density = kernel.area() * kernel(0.0);
        Vec2 gradient;
        double squares = 0.0;
        std::size_t lane = 0;
        const int column = places.particle_cells.column(x[i].x);
        const int row = places.particle_cells.row(x[i].y);
        for (int r = row - 1; r <= row + 1; ++r) {
            const auto [first, last] = places.particle_cells.range(r, column - 1, column + 1);
            for (std::uint32_t j = first; j < last; ++j) {
                const Vec2 between = x[i] - x[j];
                const double square = dot(between, between);
                if (square >= reach || j == i) {
                    continue;
                }
                const double distance = std::sqrt(square);
                const Kernel::Both near = kernel.both(distance);
                density += kernel.area() * near.value;
                const double slope = kernel.area() * near.slope_over_distance;
                const auto gx = static_cast<float>(slope * between.x);
                const auto gy = static_cast<float>(slope * between.y);
                if (lane == 0) {
                    const auto self = static_cast<std::uint32_t>(i);
                    block.groups.push_back(Group{Four{}, Four{}, {self, self, self, self}});
                }
                Group& group = block.groups.back();
                group.x[lane] = gx;
                group.y[lane] = gy;
                group.index[lane] = j;
                lane = (lane + 1) % 4;
                const Vec2 g{gx, gy};
                gradient = gradient + g;
                squares += dot(g, g);
            }
        }
        for (int r = row - 1; r <= row + 1; ++r) {
            const auto [first, last] = places.wall_cells.range(r, column - 1, column + 1);
            for (std::uint32_t k = first; k < last; ++k) {
                const Vec2 between = x[i] - places.walls.position[k];
                const double square = dot(between, between);
                if (square >= reach) {
                    continue;
                }
                const double distance = std::sqrt(square);
                const Kernel::Both near = kernel.both(distance);
                density += places.walls.area[k] * near.value;
                const double slope = places.walls.area[k] * near.slope_over_distance;
                block.samples.push_back(
                    {k, static_cast<float>(slope * between.x), static_cast<float>(slope * between.y)});
                gradient = gradient + slope * between;
            }
        }
        block.liquid.push_back(static_cast<std::uint32_t>(block.groups.size()));
        block.solid.push_back(static_cast<std::uint32_t>(block.samples.size()));
        density_[i] = density;
        const double diagonal = dot(gradient, gradient) + squares;
        // A particle far from all others has no pressure.
        inverse_diagonal_[i] = diagonal * reach > 1e-9 ? 1.0 / diagonal : 0.0;
    }
}

}  // namespace droplet
