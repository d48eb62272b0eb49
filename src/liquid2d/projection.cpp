// SPDX-License-Identifier: GPL-3.0-or-later
// Bender, Koschier: Divergence-free SPH for incompressible and viscous fluids. IEEE TVCG 23(3), 2017. Both of its
// solvers are this one. Departure: it iterates on the pressures and not on the velocities, as IISPH does (Ihmsen et
// al.: Implicit incompressible SPH. IEEE TVCG 20(3), 2014), so that pressures of the last step are a first guess and
// none becomes negative.
#include "projection.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace droplet {
namespace {

/// Part of Jacobi's correction that is made: the greatest eigenvalue of the scaled matrix is near 4 for random
/// particles.
constexpr double kRelaxation = 0.25;

/// Sums over all particles.
struct Sums {
    double violation = 0.0;
    double uphill = 0.0;

    Sums& operator+=(const Sums& other)
    {
        violation += other.violation;
        uphill += other.uphill;
        return *this;
    }
};

using Four = Neighbourhood::Four;

float total(Four a)
{
    return (a[0] + a[2]) + (a[1] + a[3]);
}

/// Rate of compression of a particle by velocities of its own and of its neighbours [1/s].
float compression(const std::vector<Change>& velocity, Change own, std::span<const Neighbourhood::Group> groups)
{
    Four sum{};
    for (const Neighbourhood::Group& g : groups) {
        const Change a = velocity[g.index[0]];
        const Change b = velocity[g.index[1]];
        const Change c = velocity[g.index[2]];
        const Change d = velocity[g.index[3]];
        sum += (own.x - Four{a.x, b.x, c.x, d.x}) * g.x + (own.y - Four{a.y, b.y, c.y, d.y}) * g.y;
    }
    return total(sum);
}

}  // namespace

std::vector<float> compressionRates(const Neighbourhood& near, std::span<const Vec2> velocity, const WallSamples& walls)
{
    std::vector<Change> v(velocity.size());
    for (std::size_t i = 0; i < v.size(); ++i) {
        v[i] = {static_cast<float>(velocity[i].x), static_cast<float>(velocity[i].y)};
    }
    std::vector<float> rates(v.size());
    near.forEach([&](std::size_t i, auto groups, auto samples) {
        float rate = compression(v, v[i], groups);
        for (const auto& n : samples) {
            rate += (v[i].x - static_cast<float>(walls.velocity[n.index].x)) * n.x +
                    (v[i].y - static_cast<float>(walls.velocity[n.index].y)) * n.y;
        }
        rates[i] = rate;
    });
    return rates;
}

double approachSpeed(const Neighbourhood& near, std::span<const Vec2> velocity, const WallSamples& walls)
{
    struct Greatest {
        double square = 0.0;
        Greatest& operator+=(const Greatest& other)
        {
            square = std::max(square, other.square);
            return *this;
        }
    };
    return std::sqrt(near.sum([&](std::size_t i, auto groups, auto samples) {
                             Greatest greatest;
                             for (const auto& g : groups) {
                                 for (std::size_t k = 0; k < 4; ++k) {
                                     // Gradients point to the neighbour. Written so that no division by zero counts.
                                     const Vec2 v = velocity[i] - velocity[g.index[k]];
                                     const double along = v.x * g.x[k] + v.y * g.y[k];
                                     const double size = double{g.x[k]} * g.x[k] + double{g.y[k]} * g.y[k];
                                     if (along > 0.0 && along * along > greatest.square * size) {
                                         greatest.square = along * along / size;
                                     }
                                 }
                             }
                             for (const auto& n : samples) {
                                 // Liquid that slides along a wall does not approach it.
                                 const double into = -dot(velocity[i] - walls.velocity[n.index], walls.normal[n.index]);
                                 greatest.square = std::max(greatest.square, into > 0.0 ? into * into : 0.0);
                             }
                             return greatest;
                         })
                         .square);
}

Projection project(const Neighbourhood& near, std::span<const float> rate, std::vector<float>& pressure,
                   const ProjectionOptions& options)
{
    const std::size_t count = rate.size();
    Projection result;
    result.change.resize(count);
    if (count == 0) {
        return result;
    }
    // Floats are enough for pressures, and half as long; a pair's two forces are still exactly opposite.
    std::vector<Change>& change = result.change;
    std::vector<float> scale(count);
    for (std::size_t i = 0; i < count; ++i) {
        scale[i] = static_cast<float>(kRelaxation * near.inverseDiagonal()[i]);
    }
    std::vector<float> last = pressure;
    std::vector<float> ahead(count);
    double momentum = 1.0;
    while (true) {
        near.forEach([&](std::size_t i, auto groups, auto samples) {
            const float own = pressure[i];
            Four sum_x{};
            Four sum_y{};
            for (const auto& g : groups) {
                const Four both =
                    own + Four{pressure[g.index[0]], pressure[g.index[1]], pressure[g.index[2]], pressure[g.index[3]]};
                sum_x -= both * g.x;
                sum_y -= both * g.y;
            }
            float x = total(sum_x);
            float y = total(sum_y);
            for (const auto& n : samples) {
                x -= own * n.x;
                y -= own * n.y;
            }
            change[i] = {x, y};
        });
        ++result.iterations;
        const bool may_stop = result.iterations > options.min_iterations;
        const double following = 0.5 * (1.0 + std::sqrt(1.0 + 4.0 * momentum * momentum));
        const auto carry = static_cast<float>((momentum - 1.0) / following);
        const Sums sums = near.sum([&](std::size_t i, auto groups, auto samples) {
            const Change own = change[i];
            float rest = rate[i] + compression(change, own, groups);
            for (const auto& n : samples) {
                rest += own.x * n.x + own.y * n.y;
            }
            const float next = std::max(pressure[i] + rest * scale[i], 0.0F);
            const bool counts = scale[i] > 0.0F && (rest > 0.0F || pressure[i] > 0.0F);
            // The energy's gradient times the way from the last pressures tells whether momentum leads uphill.
            const Sums term{counts ? std::abs(rest) : 0.0F, -rest * (next - last[i])};
            ahead[i] = std::max(next + carry * (next - last[i]), 0.0F);
            last[i] = next;
            return term;
        });
        result.residual = sums.violation / static_cast<double>(count);
        if (result.iterations >= options.max_iterations || (may_stop && result.residual <= options.tolerance)) {
            return result;
        }
        momentum = sums.uphill > 0.0 ? 1.0 : following;
        std::swap(pressure, ahead);
    }
}

}  // namespace droplet
