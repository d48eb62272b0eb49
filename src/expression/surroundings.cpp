// SPDX-License-Identifier: GPL-3.0-or-later
// Churn: Ihmsen, Akinci, Akinci, Teschner: Unified spray, foam and air bubbles for particle-based fluids. The Visual
// Computer 28, 2012: trapped air, Σ‖v_ij‖(1 − v̂_ij·x̂_ij)W.
#include "surroundings.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "blocks.h"
#include "droplet/error.h"
#include "liquid2d/bounds.h"
#include "liquid2d/kernel.h"
#include "number_text.h"
#include "union_find.h"

namespace droplet {
namespace {

/// Distance up to which particles are connected, in spacings: neighbours in the lattice are 1.07 apart.
constexpr double kConnected = 1.5;

constexpr std::size_t kBlockSize = 1024;

}  // namespace

double Surroundings::alone()
{
    const Kernel kernel(1.0);
    return kernel.area() * kernel(0.0);
}

Surroundings surroundingsOf(const ParticleFrame& frame, double below)
{
    const std::size_t count = frame.position.size();
    Surroundings result;
    result.coverage.resize(count);
    result.outward.resize(count);
    result.churn.resize(count);
    result.body.resize(count);
    result.size.resize(count);
    if (count == 0) {
        return result;
    }
    const auto [lower, upper] = boundsOf(frame.position);
    const Kernel kernel(frame.spacing);
    const double reach = kernel.support();
    constexpr double kMaxCells = 1e8;
    if (!(((upper.x - lower.x) / reach + 1.0) * ((upper.y - lower.y) / reach + 1.0) < kMaxCells)) {
        throw Error(
            ErrorCode::InvalidInput,
            fmt::format("the particles are spread over {} m by {} m, too far for their spacing of {} m; leave "
                        "out those that are far away",
                        numberText(upper.x - lower.x), numberText(upper.y - lower.y), numberText(frame.spacing)));
    }
    CellGrid cells(lower, upper, reach);
    const std::vector<std::uint32_t> order = cells.sort(frame.position);
    std::vector<Vec2> position(count);
    std::vector<Vec2> velocity(count);
    for (std::size_t k = 0; k < count; ++k) {
        position[k] = frame.position[order[k]];
        velocity[k] = frame.velocity[order[k]];
    }
    struct Pair {
        std::uint32_t a;
        std::uint32_t b;
    };
    const double connected_within = kConnected * kConnected * frame.spacing * frame.spacing;
    const auto pairs = mapBlocks<std::vector<Pair>>(
        count,
        [&](std::size_t begin, std::size_t end) {
            std::vector<Pair> connected;
            for (std::size_t k = begin; k < end; ++k) {
                const Vec2 x = position[k];
                const int column = cells.column(x.x);
                const int row = cells.row(x.y);
                // Of two neighbours, the one that comes first in the order tells of the pair.
                for (int r = row; r <= row + 1; ++r) {
                    const auto [first, last] = cells.range(r, column - 1, column + 1);
                    for (std::uint32_t m = std::max(first, static_cast<std::uint32_t>(k) + 1); m < last; ++m) {
                        const Vec2 between = x - position[m];
                        if (dot(between, between) < connected_within) {
                            connected.push_back({static_cast<std::uint32_t>(k), m});
                        }
                    }
                }
                const std::uint32_t i = order[k];
                if (!(frame.density.empty() ? below > 0.0 : frame.density[i] < below)) {
                    continue;
                }
                double coverage = kernel.area() * kernel(0.0);
                Vec2 gradient;
                double churn = 0.0;
                for (int r = row - 1; r <= row + 1; ++r) {
                    const auto [first, last] = cells.range(r, column - 1, column + 1);
                    for (std::uint32_t m = first; m < last; ++m) {
                        const Vec2 between = x - position[m];
                        const double square = dot(between, between);
                        if (m == k || square >= reach * reach) {
                            continue;
                        }
                        const double distance = std::sqrt(square);
                        const Kernel::Both near = kernel.both(std::max(distance, 1e-9 * reach));
                        coverage += kernel.area() * near.value;
                        gradient = gradient + (kernel.area() * near.slope_over_distance) * between;
                        if (distance > 0.0) {
                            const Vec2 relative = velocity[k] - velocity[m];
                            const double speed = std::sqrt(dot(relative, relative));
                            churn += kernel.area() * near.value * (speed - dot(relative, between) / distance);
                        }
                    }
                }
                result.coverage[i] = coverage;
                result.outward[i] = (-frame.spacing) * gradient;
                result.churn[i] = churn / frame.spacing;
            }
            return connected;
        },
        kBlockSize);
    UnionFind bodies(count);
    for (const std::vector<Pair>& block : pairs) {
        for (const Pair& pair : block) {
            bodies.join(pair.a, pair.b);
        }
    }
    // Bodies are named by their smallest index in the frame, so that they do not depend on the grid.
    std::vector<std::uint32_t> name(count, std::numeric_limits<std::uint32_t>::max());
    std::vector<std::uint32_t> size(count);
    for (std::uint32_t k = 0; k < count; ++k) {
        const std::uint32_t root = bodies.find(k);
        name[root] = std::min(name[root], order[k]);
        ++size[root];
    }
    for (std::uint32_t k = 0; k < count; ++k) {
        const std::uint32_t root = bodies.find(k);
        result.body[order[k]] = name[root];
        result.size[order[k]] = size[root];
    }
    return result;
}

}  // namespace droplet
