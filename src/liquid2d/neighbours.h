// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tbb/parallel_for.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "cell_grid.h"
#include "droplet/vector.h"
#include "kernel.h"
#include "wall_samples.h"

namespace droplet {

/// Neighbours of all particles, in blocks that are worked on in parallel.
class Neighbourhood {
public:
    /// Number of particles in a block.
    static constexpr std::size_t kBlock = 512;

    /// Four floats, added and multiplied at once.
    using Four = float __attribute__((vector_size(16)));

    /// Four neighbours, with the gradients of the kernel times the neighbours' areas [1/m]. The two gradients of a pair
    /// of particles are exactly opposite. A place that no neighbour needs has the particle itself and a zero gradient.
    struct Group {
        Four x;
        Four y;
        std::array<std::uint32_t, 4> index;
    };

    /// Sample of a wall near a particle, with its gradient.
    struct Sample {
        std::uint32_t index;
        float x;  ///< [1/m]
        float y;  ///< [1/m]
    };

    /// Particles and walls near one another, each sorted by its grid.
    struct Places {
        std::span<const Vec2> particles;
        const CellGrid& particle_cells;
        const WallSamples& walls;
        const CellGrid& wall_cells;
    };

    Neighbourhood(const Places& places, const Kernel& kernel);

    /// Calls work(i, groups, samples) with the neighbours of every particle, in parallel.
    template <typename Work>
    void forEach(const Work& work) const
    {
        tbb::parallel_for(std::size_t{0}, blocks_.size(), [&](std::size_t b) { forBlock(b, work); });
    }

    /// Sum of term(i, groups, samples) over all particles, the same at any number of threads.
    template <typename Term>
    [[nodiscard]] auto sum(const Term& term) const
    {
        using Sum = decltype(term(std::size_t{}, std::span<const Group>{}, std::span<const Sample>{}));
        std::vector<Sum> sums(blocks_.size());
        tbb::parallel_for(std::size_t{0}, blocks_.size(), [&](std::size_t b) {
            Sum sum{};
            forBlock(b, [&](auto... arguments) { sum += term(arguments...); });
            sums[b] = sum;
        });
        Sum total{};
        for (const Sum& s : sums) {
            total += s;
        }
        return total;
    }

    /// Density of each particle, relative to that at rest.
    [[nodiscard]] const std::vector<double>& density() const { return density_; }
    /// Inverse of the diagonal of the pressure's matrix [m²].
    [[nodiscard]] const std::vector<double>& inverseDiagonal() const { return inverse_diagonal_; }

private:
    struct Block {
        std::size_t begin = 0;              ///< first particle
        std::vector<std::uint32_t> liquid;  ///< end of each particle's neighbours in `groups`
        std::vector<std::uint32_t> solid;   ///< end of each particle's neighbours in `samples`
        std::vector<Group> groups;
        std::vector<Sample> samples;
    };

    template <typename Work>
    void forBlock(std::size_t b, const Work& work) const
    {
        const Block& block = blocks_[b];
        std::uint32_t p = 0;
        std::uint32_t s = 0;
        for (std::size_t k = 0; k < block.liquid.size(); ++k) {
            work(block.begin + k, std::span(block.groups.data() + p, block.groups.data() + block.liquid[k]),
                 std::span(block.samples.data() + s, block.samples.data() + block.solid[k]));
            p = block.liquid[k];
            s = block.solid[k];
        }
    }

    void fill(Block& block, const Places& places, const Kernel& kernel);

    std::vector<Block> blocks_;
    std::vector<double> density_;
    std::vector<double> inverse_diagonal_;
};

}  // namespace droplet
