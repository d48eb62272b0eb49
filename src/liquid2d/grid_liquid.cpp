// SPDX-License-Identifier: GPL-3.0-or-later
// Particles carry velocities with their gradients to a staggered grid and back (Jiang, Schroeder, Selle, Teran,
// Stomakhin: The affine particle-in-cell method. ACM TOG 34(4), 2015). There the pressure makes the velocity free of
// divergence: walls of any shape by the open parts of cells' sides (Batty, Bertails, Bridson: A fast variational
// framework for accurate solid-fluid coupling. ACM TOG 26(3), 2007), the surface where it lies between two cells
// (Gibou, Fedkiw, Cheng, Kang: A second-order-accurate symmetric discretization of the Poisson equation on irregular
// domains. Journal of Computational Physics 176, 2002), with the pressure that surface tension gives there. The same
// equations, with the error of the density on their right side, move particles apart or together (Kugelstadt, Longva,
// Thürey, Bender: Implicit density projection for volume conserving liquids. IEEE TVCG 27(4), 2021).
//
// A cell is two spacings wide and holds four particles at rest. Departures: the surface is where the smoothed density
// is half of that at rest, so that it encloses the particles' area; liquid thinner than a cell falls freely, and so do
// groups of a few particles; walls do not hold liquid back.
#include "grid_liquid.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "blocks.h"
#include "bounds.h"
#include "grid_pressure.h"
#include "grid_shape.h"
#include "grid_sides.h"
#include "grid_viscosity.h"
#include "kernel.h"
#include "plain_length.h"
#include "reorder.h"
#include "wall_distance.h"
#include "wide_vectors.h"

namespace droplet {
namespace {

/// Side of a cell, in spacings.
constexpr double kCell = 2.0;

/// Longest way in a step, in spacings, if none is asked for: with more, a thin crown has wrinkles.
constexpr double kCourant = 3.0;

/// One liquid particle in so many may go farther, by this factor at most: few fast ones would shorten the steps of all.
constexpr std::size_t kFastOnes = 100;
constexpr double kFaster = 1.5;

/// Longest step at that way, in times in which liquid falls freely through half a cell.
constexpr double kFall = 0.5;

/// Cells by which the grid grows beyond them: it need not grow in every step.
constexpr std::int64_t kGrowth = 16;

/// Particles in nine cells below which liquid flies.
constexpr std::uint32_t kFlying = 4;

/// Least part of the way between two cells' middles at which the surface may lie: less makes the equations stiff.
constexpr double kLeastPart = 0.1;

/// Errors of density that one step mends, at most.
constexpr double kMostGap = 0.1;
constexpr double kMostCompression = 0.5;

/// Part of what particles lack to the distance on the lattice that a step mends, and the most of it, in spacings.
constexpr double kShift = 0.2;
constexpr double kMostShift = 0.1;

/// Density that the first row of particles below a surface is under, and the second one is over.
constexpr double kFirstRow = 0.85;

/// Distance that particles keep from walls, in spacings.
constexpr double kClearance = 0.25;

/// Particles that are compared with another one at a time.
constexpr int kLanes = 4;

/// Weight of particles below which a side has no velocity of its own.
constexpr double kLeastWeight = 1e-9;

/// Part of the sides' greatest flow that may be left over: with a tenth of it, energies differ by less than 1 % after
/// two seconds of all scenes.
constexpr double kTolerance = 1e-3;

/// Part of a cell that may be left over of what mends the density: a tenth of it leaves the same errors of density and
/// energies after it, in all scenes.
constexpr double kSpreadTolerance = 1e-2;

/// Quotient, rounded down.
std::int64_t floorOf(std::int64_t a, std::int64_t b)
{
    return a / b - (a % b < 0 ? 1 : 0);
}

enum class Cell : std::uint8_t {
    Empty,
    Flying,  ///< liquid thinner than a cell
    Fringe,  ///< beside liquid, with the surface below its middle
    Liquid,
};

class GridLiquid final : public FluidSolver {
public:
    GridLiquid(const FluidScene& scene, const FluidOptions& options)
        : scene_(scene), options_(options), walls_(scene, kCell * scene.spacing)
    {
        grid_.cell = kCell * scene.spacing;
    }

    [[nodiscard]] double emitterCourant() const override { return courant(); }

    [[nodiscard]] double longestStep(const FluidState& state) const override
    {
        const double h = grid_.cell;
        constexpr double kLongest = std::numeric_limits<double>::max();
        const double pull = length(scene_.gravity);
        double dt = std::min(state.approach_speed > 0.0 ? courant() * scene_.spacing / state.approach_speed : kLongest,
                             pull > 0.0 ? kFall * courant() / kCourant * std::sqrt(h / pull) : kLongest);
        if (scene_.surface_tension > 0.0) {
            // Period of the shortest capillary waves.
            dt = std::min(
                dt, 0.4 * std::sqrt(scene_.density * h * h * h / (2.0 * std::numbers::pi * scene_.surface_tension)));
        }
        return std::min(dt, walls_.longestStep(state.time));
    }

    [[nodiscard]] bool isFull(Vec2 place) const override
    {
        const std::size_t start = places_.at(place).cell();
        if (kind_[start] != Cell::Liquid) {
            return false;
        }
        std::vector<std::uint8_t> is_reached(grid_.cells());
        std::vector<std::size_t> cells{start};
        is_reached[start] = 1;
        double filled = 0.0;
        for (std::size_t n = 0; n < cells.size(); ++n) {
            const std::size_t k = cells[n];
            filled += density_[k] + solid_[k];
            const std::array<std::pair<double, std::size_t>, 4> ways{{{u_.open[left_side_[k]], k - 1},
                                                                      {u_.open[left_side_[k] + 1], k + 1},
                                                                      {v_.open[k], k - grid_.columns},
                                                                      {v_.open[k + grid_.columns], k + grid_.columns}}};
            for (const auto& [open, other] : ways) {
                if (!(open > 0.0) || is_reached[other] != 0) {
                    continue;
                }
                if (kind_[other] != Cell::Liquid) {
                    return false;  // a surface
                }
                is_reached[other] = 1;
                cells.push_back(other);
            }
        }
        return filled > static_cast<double>(cells.size());
    }

    void begin() override { is_first_ = true; }

    void step(FluidState& state, double dt) override
    {
        dt_ = dt;
        accelerate(state);
        if (growTo(state) || walls_.areMoving()) {
            placeWalls(state.time);
        }
        sort(state);
        collect(state);
        classify();
        if (scene_.viscosity.value_or(0.0) > 0.0) {
            diffuse(*scene_.viscosity);
        }
        findSurface();
        for (Sides* sides : {&u_, &v_}) {
            forSpans(sides->spans, [&](std::size_t k) { sides->before[k] = sides->value[k]; });
        }
        if (walls_.areMoving()) {
            moved_field_ = walls_.at(state.time + dt, grid_);
        }
        tbb::parallel_invoke(
            [&] {
                // Pressures and displacements that mend the density have the same equations.
                join(whole_);
                tbb::parallel_invoke(
                    // The last one is done at once, and is the longest.
                    [&] { spread(state); },
                    [&] {
                        project(state);
                        extend(u_);
                        extend(v_);
                        restrainAtWalls();
                    });
            },
            [&] { shift(state); });
        move(state);
    }

private:
    /// Walls at the end of a step, where particles go.
    [[nodiscard]] const WallField& fieldAfter() const { return walls_.areMoving() ? moved_field_ : field_; }

    /// Longest way in a step, in spacings.
    [[nodiscard]] double courant() const { return options_.courant.value_or(kCourant); }

    /// Gravity and the caller's accelerations.
    void accelerate(FluidState& state)
    {
        state.affine.resize(state.position.size());
        acceleration_.clear();
        if (options_.control) {
            acceleration_.assign(state.position.size(), scene_.gravity);
            options_.control(state, acceleration_);
        }
        for (std::size_t i = 0; i < state.velocity.size(); ++i) {
            state.velocity[i] = state.velocity[i] + dt_ * accelerationOf(i);
        }
    }

    [[nodiscard]] Vec2 accelerationOf(std::size_t i) const
    {
        return acceleration_.empty() ? scene_.gravity : acceleration_[i];
    }

    /// Makes the grid large enough for the particles; returns whether it is a new one.
    [[nodiscard]] bool growTo(const FluidState& state)
    {
        const double h = grid_.cell;
        const auto [lower, upper] = state.position.empty() ? Bounds{{}, {}} : boundsOf(state.position);
        // The longest way of a step, of up to 6 kFaster spacings or 4.5 cells, and its neighbours. What matters is
        // less.
        constexpr std::int64_t kMargin = 6;
        static_assert(kMargin > static_cast<std::int64_t>(kPad));
        const auto number = [h](double x) { return static_cast<std::int64_t>(std::floor(x / h)); };
        const auto right = grid_.left + static_cast<std::int64_t>(grid_.columns);
        const auto top = grid_.bottom + static_cast<std::int64_t>(grid_.rows);
        // The first grid of a run depends on the particles alone, in steps so long that it is often that of the run
        // before.
        const bool is_first = std::exchange(is_first_, false);
        const auto grown = [is_first](std::int64_t bound, std::int64_t needed, std::int64_t outwards) {
            const bool holds = !is_first && outwards * bound >= outwards * needed;
            return holds ? bound : outwards * (kGrowth * (1 + floorOf(outwards * needed, kGrowth)));
        };
        const std::int64_t new_left = grown(grid_.left, number(lower.x) - kMargin, -1);
        const std::int64_t new_bottom = grown(grid_.bottom, number(lower.y) - kMargin, -1);
        const std::int64_t new_right = grown(right, number(upper.x) + 1 + kMargin, 1);
        const std::int64_t new_top = grown(top, number(upper.y) + 1 + kMargin, 1);
        if (new_left == grid_.left && new_bottom == grid_.bottom && new_right == right && new_top == top) {
            return false;
        }
        grid_ = {h, new_left, new_bottom, static_cast<std::size_t>(new_right - new_left),
                 static_cast<std::size_t>(new_top - new_bottom)};
        places_ = GridPlaces(grid_);
        u_ = Sides({0.0, 0.5}, grid_.columns + 1, grid_.rows);
        v_ = Sides({0.5, 0.0}, grid_.columns, grid_.rows + 1);
        spans_.clear();
        for (std::vector<double>* values :
             {&density_, &solid_, &room_, &total_, &filled_, &curvature_, &pressure_, &potential_, &rhs_, &excess_}) {
            values->assign(grid_.cells(), 0.0);
        }
        left_side_.resize(grid_.cells());
        for (std::size_t k = 0; k < grid_.cells(); ++k) {
            left_side_[k] = static_cast<std::uint32_t>(k + k / grid_.columns);  // u_ has one more in each row
        }
        kind_.assign(grid_.cells(), Cell::Empty);
        free_.assign(grid_.cells(), 0);
        whole_ = GridEquations(grid_);
        rest_ = GridEquations(grid_);
        solving_ = GridEquations::Memory(grid_);
        spreading_ = GridEquations::Memory(grid_);
        return true;
    }

    /// Sorts the particles by the grid's cells, and forgets what they brought to it.
    void sort(FluidState& state)
    {
        const std::size_t count = state.position.size();
        cell_.resize(count);
        constexpr std::size_t kParticlesPerBlock = 4096;
        forBlocks(
            count,
            [&](std::size_t begin, std::size_t end) {
                for (std::size_t i = begin; i < end; ++i) {
                    cell_[i] = static_cast<std::uint32_t>(places_.at(state.position[i]).cell());
                }
            },
            kParticlesPerBlock);
        // Numbers of particles, then the first ones, are two cells further on: filling the cells moves them by one.
        begin_.assign(grid_.cells() + 2, 0);
        for (const std::uint32_t cell : cell_) {
            ++begin_[cell + 2];
        }
        for (std::size_t k = 2; k < begin_.size(); ++k) {
            begin_[k] += begin_[k - 1];
        }
        order_.resize(count);
        for (std::uint32_t i = 0; i < count; ++i) {
            order_[begin_[cell_[i] + 1]++] = i;
        }
        tbb::parallel_invoke(
            [&] {
                reorder(state.position, order_, sorted_vectors_);
                reorder(state.velocity, order_, sorted_vectors_);
                if (!acceleration_.empty()) {
                    reorder(acceleration_, order_, sorted_vectors_);
                }
            },
            [&] {
                reorder(state.affine, order_, sorted_gradients_);
                reorder(state.id, order_, sorted_numbers_);
                reorder(cell_, order_, sorted_numbers_);
                reorder(state.pressure, order_, squares_);
            });
        flies_.resize(count);
        clearSpans();
        std::vector<Span> columns(grid_.rows);  // of the particles that do not fly
        for (std::uint32_t i = 0; i < count;) {
            const std::size_t k = cell_[i];
            std::uint32_t near = 0;
            for (const std::size_t row : {k - grid_.columns, k, k + grid_.columns}) {
                near += begin_[row + 2] - begin_[row - 1];
            }
            const bool flies = near < kFlying;
            if (!flies) {
                Span& row = columns[k / grid_.columns];
                const std::size_t column = k % grid_.columns;
                row = row.end == 0 ? Span{column, column + 1} : Span{row.begin, column + 1};
            }
            for (; i < begin_[k + 1]; ++i) {
                flies_[i] = flies ? 1 : 0;
            }
        }
        setSpans(columns);
    }

    void clearSpans()
    {
        for (std::vector<double>* values : {&density_, &filled_, &curvature_, &pressure_}) {
            fillSpans(spans_, *values, 0.0);
        }
        fillSpans(spans_, kind_, Cell::Empty);
        spans_.clear();
        u_.clear();
        v_.clear();
    }

    /// Sets what matters in every row: the particles and the cells around them.
    /// @param columns  of the particles in every row
    void setSpans(const std::vector<Span>& columns)
    {
        const auto hull = [](Span a, Span b) {
            return a.end == 0 ? b : b.end == 0 ? a : Span{std::min(a.begin, b.begin), std::max(a.end, b.end)};
        };
        Span below;
        for (std::size_t row = 0; row < grid_.rows; ++row) {
            Span near;
            for (std::size_t r = row < kPad ? 0 : row - kPad; r <= row + kPad && r < grid_.rows; ++r) {
                near = hull(near, columns[r]);
            }
            if (near.end > 0) {
                near = {near.begin - kPad, near.end + kPad};
                const std::size_t first = row * grid_.columns;
                spans_.push_back({first + near.begin, first + near.end});
                u_.spans.push_back({first + row + near.begin, first + row + near.end + 1});
            }
            if (const Span both = hull(below, near); both.end > 0) {
                v_.spans.push_back({row * grid_.columns + both.begin, row * grid_.columns + both.end});
            }
            below = near;
        }
    }

    /// Open parts of the cells' sides, and the part of cells that walls take, smoothed as the liquid's density.
    void placeWalls(double time)
    {
        // Liquid lies beside the walls as they are at the start, and goes the way that they go in the step.
        field_ = walls_.at(time, grid_);
        field_.poses = walls_.posesAt(time + 0.5 * dt_);
        const std::size_t corner_columns = grid_.cornerColumns();
        const double h = grid_.cell;
        // Velocity of the wall at the middle of a side; of two walls, of that which is nearer to liquid.
        const auto velocity = [&](std::size_t a, std::size_t b, Vec2 place) {
            const bool is_closed = std::max(field_.distance[a], field_.distance[b]) <= 0.0;
            const bool is_a_less = field_.distance[a] <= field_.distance[b];
            return walls_.velocity(field_, field_.wall[is_a_less == is_closed ? b : a], place);
        };
        for (std::size_t row = 0; row < grid_.rows; ++row) {
            for (std::size_t column = 0; column <= grid_.columns; ++column) {
                const std::size_t k = row * u_.columns + column;
                const std::size_t a = grid_.cornerAt(column, row);
                u_.open[k] = openPart(field_.distance[a] / h, field_.distance[a + corner_columns] / h);
                u_.wall[k] = u_.open[k] < 1.0 ? velocity(a, a + corner_columns, u_.placeOf(k, grid_)).x : 0.0;
            }
        }
        for (std::size_t row = 0; row <= grid_.rows; ++row) {
            for (std::size_t column = 0; column < grid_.columns; ++column) {
                const std::size_t k = row * v_.columns + column;
                const std::size_t a = grid_.cornerAt(column, row);
                v_.open[k] = openPart(field_.distance[a] / h, field_.distance[a + 1] / h);
                v_.wall[k] = v_.open[k] < 1.0 ? velocity(a, a + 1, v_.placeOf(k, grid_)).y : 0.0;
            }
        }
        for (std::size_t row = 0; row < grid_.rows; ++row) {
            for (std::size_t column = 0; column < grid_.columns; ++column) {
                const std::size_t a = grid_.cornerAt(column, row);
                const double middle =
                    0.25 * (field_.distance[a] + field_.distance[a + 1] + field_.distance[a + corner_columns] +
                            field_.distance[a + corner_columns + 1]);
                const std::size_t k = grid_.at(column, row);
                solid_[k] = std::clamp(0.5 - middle / h, 0.0, 1.0);
                room_[k] = 1.0 - solid_[k];
            }
        }
        // The integral of a hat function over its cell is 3/4, over the next ones 1/8.
        smooth(solid_, 0.125, 0.75);
    }

    /// Averages values of cells with their neighbours, along both axes; those at the rim stay.
    void smooth(std::vector<double>& values, double beside, double own)
    {
        for (const std::size_t step : {std::size_t{1}, grid_.columns}) {
            scratch_ = values;
            for (std::size_t k = step; k + step < values.size(); ++k) {
                values[k] = own * scratch_[k] + beside * (scratch_[k - step] + scratch_[k + step]);
            }
        }
    }

    /// Brings density and velocity of the particles to the grid.
    void collect(const FluidState& state)
    {
        // Bands of rows that do not reach into one another's next but one are worked on at once.
        constexpr std::size_t kBand = 4;
        const std::size_t bands = (grid_.rows + kBand - 1) / kBand;
        for (const std::size_t parity : {std::size_t{0}, std::size_t{1}}) {
            tbb::parallel_for(std::size_t{0}, (bands + 1 - parity) / 2, [&](std::size_t pair) {
                const std::size_t band = 2 * pair + parity;
                const std::uint32_t first = begin_[band * kBand * grid_.columns];
                const std::uint32_t last = begin_[std::min((band + 1) * kBand, grid_.rows) * grid_.columns];
                collectSome(state, first, last);
            });
        }
        for (Sides* sides : {&u_, &v_}) {
            forSpans(sides->spans, [&](std::size_t k) {
                if (sides->weight[k] > kLeastWeight) {
                    sides->value[k] /= sides->weight[k];
                }
            });
        }
    }

    DROPLET_WIDE_VECTORS void collectSome(const FluidState& state, std::size_t begin, std::size_t end)
    {
        for (std::size_t i = begin; i < end; ++i) {
            if (flies_[i] == 0) {
                collectOne(state, i);
            }
        }
    }

    [[gnu::always_inline]] void collectOne(const FluidState& state, std::size_t i)
    {
        const GridPlace place = places_.at(state.position[i]);
        constexpr double kShare = 1.0 / (kCell * kCell);
        const double h = grid_.cell;
        forPoints(place.amongMiddles(), [&](std::size_t k, double w, double, double) { density_[k] += kShare * w; });
        const auto add = [&](Sides& sides, const Bilinear& at, double own, Vec2 slope) {
            forPoints(at, [&](std::size_t k, double w, double right, double up) {
                sides.weight[k] += w;
                sides.value[k] += w * (own + h * (slope.x * right + slope.y * up));
            });
        };
        add(u_, place.amongLeftSides(), state.velocity[i].x, state.affine[i][0]);
        add(v_, place.amongLowerSides(), state.velocity[i].y, state.affine[i][1]);
    }

    /// Calls work(point, weight, steps to the right and up from the place to the point).
    template <typename Work>
    static void forPoints(const Bilinear& at, const Work& work)
    {
        const double left = 1.0 - at.u;
        const double low = 1.0 - at.v;
        work(at.first, left * low, -at.u, -at.v);
        work(at.first + 1, at.u * low, left, -at.v);
        work(at.first + at.columns, left * at.v, -at.u, low);
        work(at.first + at.columns + 1, at.u * at.v, left, low);
    }

    /// Calls work(side of u_ or v_, cell behind it, index) for the four sides of a cell.
    template <typename Work>
    void forSides(std::size_t k, const Work& work)
    {
        const std::size_t right = left_side_[k];
        work(u_, k - 1, right, -1.0);
        work(u_, k + 1, right + 1, 1.0);
        work(v_, k - grid_.columns, k, -1.0);
        work(v_, k + grid_.columns, k + grid_.columns, 1.0);
    }

    void classify()
    {
        liquid_.clear();
        forSpans(spans_, [&](std::size_t k) {
            if (!(density_[k] > 0.0)) {
                return;
            }
            filled_[k] = density_[k] / std::max(1.0 - solid_[k], 0.25);
            double open = 0.0;
            forSides(k, [&](const Sides& sides, std::size_t, std::size_t s, double) { open += sides.open[s]; });
            if (filled_[k] >= 0.5 && open > 0.0) {
                kind_[k] = Cell::Liquid;
            }
        });
        floodRims();
        std::vector<std::size_t> fringe;
        forSpans(spans_, [&](std::size_t k) {
            if (kind_[k] == Cell::Liquid || begin_[k] == begin_[k + 1] || flies_[begin_[k]] != 0) {
                return;
            }
            bool is_beside = false;
            forSides(k, [&](const Sides& sides, std::size_t other, std::size_t s, double) {
                is_beside = is_beside || (sides.open[s] > 0.0 && kind_[other] == Cell::Liquid);
            });
            kind_[k] = is_beside ? Cell::Fringe : Cell::Flying;
            if (is_beside) {
                fringe.push_back(k);
            }
        });
        const auto is_open = [&](std::size_t k) {
            bool is_closed = true;
            forSides(k, [&](const Sides& sides, std::size_t other, std::size_t s, double) {
                is_closed = is_closed && (sides.open[s] == 0.0 || kind_[other] == Cell::Liquid);
            });
            return !is_closed;
        };
        fringe.erase(std::remove_if(fringe.begin(), fringe.end(), is_open), fringe.end());
        for (const std::size_t k : fringe) {
            kind_[k] = Cell::Liquid;
            filled_[k] = std::max(filled_[k], 0.5);
        }
        forSpans(spans_, [&](std::size_t k) {
            if (kind_[k] == Cell::Liquid) {
                liquid_.push_back(k);
            }
        });
        // Velocities are known at liquid, and where liquid falls freely.
        for (std::size_t n = 0; n < spans_.size(); ++n) {
            const std::size_t row = u_.spans[n].begin - spans_[n].begin;
            for (std::size_t s = u_.spans[n].begin; s < u_.spans[n].end; ++s) {
                mark(u_, s, s - row - 1, s - row);
            }
        }
        forSpans(v_.spans, [&](std::size_t s) { mark(v_, s, s - grid_.columns, s); });
    }

    /// Cells that are mostly wall may have no room for a particle: they are liquid if the next one is. Air there would
    /// let liquid flow into the wall.
    void floodRims()
    {
        std::vector<std::pair<std::size_t, std::size_t>> flooded;  // and the next ones
        // In a corner of walls the next one is such a cell, too.
        constexpr int kRounds = 2;
        for (int round = 0; round < kRounds; ++round) {
            flooded.clear();
            forSpans(spans_, [&](std::size_t k) {
                if (kind_[k] == Cell::Liquid || !(room_[k] < 0.5)) {
                    return;
                }
                double widest = 0.0;
                std::size_t next = k;
                forSides(k, [&](const Sides& sides, std::size_t other, std::size_t s, double) {
                    if (sides.open[s] > widest) {
                        widest = sides.open[s];
                        next = other;
                    }
                });
                if (kind_[next] == Cell::Liquid) {
                    flooded.emplace_back(k, next);
                }
            });
            for (const auto& [k, next] : flooded) {
                kind_[k] = Cell::Liquid;
                filled_[k] = filled_[next];
            }
        }
    }

    void mark(Sides& sides, std::size_t s, std::size_t a, std::size_t b) const
    {
        const bool at_liquid = kind_[a] == Cell::Liquid || kind_[b] == Cell::Liquid;
        const bool at_fringe = kind_[a] == Cell::Fringe || kind_[b] == Cell::Fringe;
        const bool is_met = sides.weight[s] > kLeastWeight;
        if (sides.open[s] > 0.0) {
            sides.solved[s] = at_liquid ? 1 : 0;
            sides.known[s] = at_liquid || (is_met && !at_fringe) ? 1 : 0;
        }
    }

    void diffuse(double viscosity)
    {
        const auto met = [](const Sides& sides) {
            std::vector<std::uint8_t> has(sides.value.size());
            for (std::size_t k = 0; k < has.size(); ++k) {
                has[k] = sides.open[k] > 0.0 && sides.weight[k] > kLeastWeight ? 1 : 0;
            }
            return has;
        };
        const std::vector<std::uint8_t> has_across = met(u_);
        const std::vector<std::uint8_t> has_up = met(v_);
        applyViscosity(grid_, viscosity * dt_ / (grid_.cell * grid_.cell),
                       {u_.value, v_.value, has_across, has_up, filled_});
    }

    /// Curvature of the surface at the cells' middles, for surface tension.
    void findSurface()
    {
        if (!(scene_.surface_tension > 0.0)) {
            return;
        }
        std::vector<double> level = filled_;
        for (int pass = 0; pass < 2; ++pass) {
            smooth(level, 0.25, 0.5);
        }
        const double h = grid_.cell;
        const std::size_t columns = grid_.columns;
        const auto normal = [&](std::size_t k) {  // at the corner above and right of a cell's middle
            const double a = level[k];
            const double b = level[k + 1];
            const double c = level[k + columns];
            const double d = level[k + columns + 1];
            const Vec2 slope{b + d - a - c, c + d - a - b};
            const double size = plainLength(slope);
            return size > 1e-6 ? (1.0 / size) * slope : Vec2{};
        };
        forSpans(spans_, [&](std::size_t k) {
            if (level[k] > 0.02 && level[k] < 0.98) {
                const Vec2 a = normal(k - columns - 1);
                const Vec2 b = normal(k - columns);
                const Vec2 c = normal(k - 1);
                const Vec2 d = normal(k);
                const double spread = (0.5 / h) * (b.x + d.x - a.x - c.x + c.y + d.y - a.y - b.y);
                // The level rises into the liquid, so round liquid has a negative divergence.
                curvature_[k] = std::clamp(-spread, -1.0 / h, 1.0 / h);
            }
        });
    }

    /// Way to the surface from a liquid cell's middle to another one's, as a part of the whole.
    [[nodiscard]] double partTo(std::size_t liquid, std::size_t other) const
    {
        const double inside = std::max(filled_[liquid] - 0.5, 0.0);
        const double outside = std::max(0.5 - std::min(filled_[other], 0.5), 0.0);
        const double part = inside + outside > 0.0 ? inside / (inside + outside) : 0.5;
        return std::clamp(part, kLeastPart, 1.0);
    }

    /// Curvature of the surface between a liquid cell and another one.
    [[nodiscard]] double curvatureAt(std::size_t liquid, std::size_t other, double part) const
    {
        return (1.0 - part) * curvature_[liquid] + part * curvature_[other];
    }

    /// Takes from the velocities what would compress liquid.
    void project(FluidState& state)
    {
        const double h = grid_.cell;
        const double capillary = scene_.surface_tension / scene_.density * dt_ / h;  // of pressures below
        std::vector<double>& pressure = pressure_;                                   // times dt/(density h) [m/s]
        guess(state, pressure);
        constexpr int kRounds = 3;
        for (int round = 0; round < kRounds; ++round) {
            GridEquations& equations = round == 0 ? whole_ : rest_;
            if (round > 0) {
                join(rest_);
            }
            double flow = 0.0;
            for (const std::size_t k : liquid_) {
                rhs_[k] = 0.0;
                if (free_[k] != 0) {
                    pressure[k] = 0.0;
                    continue;
                }
                forSides(k, [&](const Sides& sides, std::size_t other, std::size_t s, double) {
                    if (sides.open[s] > 0.0 && kind_[other] != Cell::Liquid) {
                        const double part = partTo(k, other);
                        rhs_[k] += sides.open[s] / part * capillary * curvatureAt(k, other, part);
                    }
                });
                forSides(k, [&](const Sides& sides, std::size_t, std::size_t s, double sign) {
                    if (const double w = sides.open[s]; w > 0.0) {
                        rhs_[k] -= sign * w * sides.value[s];
                        flow = std::max(flow, std::abs(sides.value[s]));
                    }
                });
                const std::size_t right = left_side_[k];
                rhs_[k] += swept(u_, right, right + 1) + swept(v_, k, k + grid_.columns);
            }
            const auto solved = equations.solve({rhs_, kTolerance * flow}, pressure, solving_);
            state.counts.divergence_iterations += static_cast<std::uint64_t>(solved.iterations);
            // Walls do not hold liquid back.
            double highest = 0.0;
            for (const std::size_t k : liquid_) {
                highest = std::max(highest, pressure[k]);
            }
            const double least = -std::max(2.0 * capillary / h, 0.02 * highest);
            bool is_held = false;
            for (const std::size_t k : liquid_) {
                if (free_[k] == 0 && pressure[k] < least) {
                    bool at_wall = false;
                    forSides(k, [&](const Sides& sides, std::size_t, std::size_t s, double) {
                        at_wall = at_wall || sides.open[s] < 1.0;
                    });
                    if (at_wall) {
                        free_[k] = 1;
                        is_held = true;
                    }
                }
            }
            if (!is_held) {
                break;
            }
        }
        changeSides(&Sides::value, pressure, capillary, [&](std::size_t k) { return free_[k] != 0; });
        for (const std::size_t k : liquid_) {
            pressure[k] *= h / dt_;
            free_[k] = 0;
        }
    }

    /// What a wall sweeps between two opposite sides of a cell: its velocity is that at the side it closes more.
    static double swept(const Sides& sides, std::size_t low, std::size_t high)
    {
        const double wall = sides.open[low] < sides.open[high] ? sides.wall[low] : sides.wall[high];
        return wall * (sides.open[high] - sides.open[low]);
    }

    /// First guess: pressures that the particles had.
    void guess(const FluidState& state, std::vector<double>& pressure) const
    {
        for (const std::size_t k : liquid_) {
            double sum = 0.0;
            for (std::uint32_t i = begin_[k]; i < begin_[k + 1]; ++i) {
                sum += state.pressure[i];
            }
            const std::uint32_t count = begin_[k + 1] - begin_[k];
            pressure[k] = count > 0 ? sum / count * dt_ / grid_.cell : 0.0;
        }
    }

    /// Sets the equations of the liquid cells but for those in which the pressure is 0.
    void join(GridEquations& equations)
    {
        equations.clear();
        for (const std::size_t k : liquid_) {
            if (free_[k] != 0) {
                continue;
            }
            equations.add(k);
            forSides(k, [&](const Sides& sides, std::size_t other, std::size_t s, double sign) {
                const double w = sides.open[s];
                if (!(w > 0.0)) {
                    return;
                }
                if (kind_[other] != Cell::Liquid) {
                    equations.hold(k, w / partTo(k, other));
                } else if (free_[other] != 0) {
                    equations.hold(k, w);
                } else if (sign > 0.0) {
                    other == k + 1 ? equations.joinRight(k, w) : equations.joinAbove(k, w);
                }
            });
        }
        equations.factorise();
    }

    /// Adds differences of a potential to values at the sides of liquid cells.
    /// @param is_free  (cell): whether the pressure is 0 there
    template <typename IsFree>
    void changeSides(std::vector<double> Sides::*values, const std::vector<double>& potential, double capillary,
                     const IsFree& is_free)
    {
        for (const std::size_t k : liquid_) {
            forSides(k, [&](Sides& sides, std::size_t other, std::size_t s, double sign) {
                if (!(sides.open[s] > 0.0) || (sign < 0.0 && kind_[other] == Cell::Liquid)) {
                    return;
                }
                double& value = (sides.*values)[s];
                if (kind_[other] == Cell::Liquid) {
                    value += potential[k] - potential[other];
                } else {
                    const double part = is_free(k) ? 1.0 : partTo(k, other);
                    const double beyond = capillary * curvatureAt(k, other, part);
                    value += sign * (potential[k] - (is_free(k) ? 0.0 : beyond)) / part;
                }
            });
        }
    }

    /// Continues values from the known sides to the next ones. Where the surface is below a cell's middle, liquid keeps
    /// its own velocity, and the pressure changes it as that of the next sides.
    static void extend(Sides& sides)
    {
        forSpans(sides.spans, [&](std::size_t k) {
            sides.change[k] = sides.solved[k] != 0 ? sides.value[k] - sides.before[k] : 0.0;
        });
        sides.extend(sides.change, sides.solved, sides.of_value);
        forSpans(sides.spans, [&](std::size_t k) {
            if (sides.known[k] == 0 && sides.open[k] > 0.0 && sides.weight[k] > kLeastWeight) {
                sides.value[k] = sides.before[k] + sides.change[k];
                sides.known[k] = 1;
            }
        });
        sides.extend(sides.value, sides.known, sides.of_value);
    }

    /// Gives velocities in walls the walls' part along their normals.
    void restrainAtWalls()
    {
        for (Sides* sides : {&u_, &v_}) {
            forSpans(sides->spans, [&](std::size_t k) { sides->before[k] = sides->value[k]; });
        }
        for (const bool is_across : {true, false}) {
            Sides& sides = is_across ? u_ : v_;
            forSpans(sides.spans, [&](std::size_t k) {
                if (sides.open[k] > 0.0 || sides.of_value.reached[k] != Reached::Yes) {
                    return;
                }
                const Vec2 place = sides.placeOf(k, grid_);
                const GridPlace in_grid = places_.at(place);
                const Bilinear at = in_grid.amongCorners();
                const Vec2 slope = at.slopeIn(field_.distance);
                const double size = plainLength(slope);
                if (!(size > 0.0)) {
                    sides.value[k] = sides.wall[k];
                    return;
                }
                const Vec2 normal = (1.0 / size) * slope;
                const Vec2 velocity = {in_grid.amongLeftSides().in(u_.before), in_grid.amongLowerSides().in(v_.before)};
                const Vec2 wall = walls_.velocity(field_, field_.wall[at.first], place);
                const double into = dot(velocity - wall, normal);
                sides.value[k] -= into * (is_across ? normal.x : normal.y);
            });
        }
    }

    /// Finds displacements of the sides that mend the density.
    void spread(FluidState& state)
    {
        const double h = grid_.cell;
        double mean = 0.0;
        for (const std::size_t k : liquid_) {
            const double density = density_[k] + solid_[k];
            mean += std::max(density - 1.0, 0.0);
            bool is_inside = true;
            forSides(k, [&](const Sides& sides, std::size_t other, std::size_t s, double) {
                is_inside = is_inside && (!(sides.open[s] > 0.0) || kind_[other] == Cell::Liquid);
            });
            excess_[k] = h * std::clamp(density - 1.0, is_inside ? -kMostGap : 0.0, kMostCompression);
        }
        state.density_error = mean / std::max(static_cast<double>(liquid_.size()), 1.0);
        const auto solved = whole_.solve({excess_, kSpreadTolerance * h}, potential_, spreading_);
        state.counts.density_iterations += static_cast<std::uint64_t>(solved.iterations);
        changeSides(&Sides::shift, potential_, 0.0, [](std::size_t) { return false; });
        for (const std::size_t k : liquid_) {
            potential_[k] = 0.0;
        }
        for (Sides* sides : {&u_, &v_}) {
            sides->extend(sides->shift, sides->solved, sides->of_shift);
        }
    }

    /// Finds displacements that part particles which are closer than on the lattice at rest: the grid does not see how
    /// they lie in a cell.
    void shift(const FluidState& state)
    {
        placeLanes(state, latticeStep(scene_.spacing));
        shift_.resize(state.position.size());
        constexpr std::size_t kParticlesPerBlock = 1024;
        forBlocks(
            state.position.size(), [&](std::size_t begin, std::size_t end) { shiftSome(state, begin, end); },
            kParticlesPerBlock);
    }

    DROPLET_WIDE_VECTORS void shiftSome(const FluidState& state, std::size_t begin, std::size_t end)
    {
        const double reach = latticeStep(scene_.spacing);
        std::size_t cell = grid_.cells();
        bool is_inner = false;  // of most cells: particles are sorted by them
        std::array<float, 2> corner{};
        for (std::size_t i = begin; i < end; ++i) {
            if (flies_[i] != 0) {
                continue;
            }
            if (cell_[i] != cell) {
                cell = cell_[i];
                is_inner = isInner(cell, reach);
                const std::size_t row = cell / grid_.columns;
                const std::size_t column = cell % grid_.columns;
                const Vec2 place = grid_.placeOf(static_cast<double>(column), static_cast<double>(row));
                corner = {static_cast<float>(place.x / reach), static_cast<float>(place.y / reach)};
            }
            const Vec2 apart = reach * overlap(i, reach, corner);
            const Vec2 sum = is_inner ? apart : beside(state.position[i], apart, reach);
            const double square = dot(sum, sum);
            const double most = kMostShift / kShift * scene_.spacing;
            shift_[i] = (square > most * most ? kShift * most / std::sqrt(square) : kShift) * sum;
        }
    }

    /// Sets the particles' places in units of a reach.
    void placeLanes(const FluidState& state, double reach)
    {
        const std::size_t count = state.position.size();
        // What is read beyond the last one is far away.
        constexpr float kFar = 1e6F;
        lanes_x_.resize(count + kLanes);
        lanes_y_.resize(count + kLanes);
        std::fill(lanes_x_.end() - kLanes, lanes_x_.end(), kFar);
        for (std::size_t i = 0; i < count; ++i) {
            const Vec2 place = (1.0 / reach) * state.position[i];
            lanes_x_[i] = static_cast<float>(place.x);
            lanes_y_[i] = static_cast<float>(place.y);
        }
    }

    /// Sum over the neighbours within a reach of what lacks to it, away from them, in reaches.
    /// @param corner  the lower left one of the particle's cell, in reaches
    [[nodiscard, gnu::always_inline]] Vec2 overlap(std::size_t i, double reach,
                                                   const std::array<float, 2>& corner) const
    {
        using Lanes = Eigen::Array<float, kLanes, 1>;
        // At a distance q, (1 - q)/q of the way between the two is wanted: within 0.02 q that is, from q = 1/2 on, the
        // following polynomial of 1 - q^2, which needs neither root nor quotient.
        constexpr float kFirst = 0.5F;
        constexpr float kThird = 1.4F;
        Lanes right = Lanes::Zero();
        Lanes up = Lanes::Zero();
        // Of the nine cells around, four are within reach mostly.
        constexpr float kRounding = 1e-3F;
        const auto side = static_cast<float>(grid_.cell / reach);
        const auto is_near = [&](float from_border) { return from_border < 1.0F + kRounding; };
        const float x_in_cell = lanes_x_[i] - corner[0];
        const float y_in_cell = lanes_y_[i] - corner[1];
        const std::size_t left = is_near(x_in_cell) ? 1 : 0;
        const std::size_t right_end = is_near(side - x_in_cell) ? 2 : 1;
        const std::size_t lowest = cell_[i] - (is_near(y_in_cell) ? grid_.columns : 0);
        const std::size_t highest = cell_[i] + (is_near(side - y_in_cell) ? grid_.columns : 0);
        for (std::size_t row = lowest; row <= highest; row += grid_.columns) {
            // The last lanes are those of cells farther right, out of reach.
            for (std::size_t j = begin_[row - left]; j < begin_[row + right_end]; j += kLanes) {
                const Lanes x = lanes_x_[i] - Eigen::Map<const Lanes>(&lanes_x_[j]);
                const Lanes y = lanes_y_[i] - Eigen::Map<const Lanes>(&lanes_y_[j]);
                const Lanes near = (1.0F - x * x - y * y).max(0.0F);
                const Lanes weight = near * (kFirst + kThird * near * near);
                right += weight * x;
                up += weight * y;
            }
        }
        return {static_cast<double>(right.sum()), static_cast<double>(up.sum())};
    }

    /// Least distance of a cell's corners from walls, at the end of the step.
    [[nodiscard]] double cornerDistance(std::size_t cell) const
    {
        const std::vector<double>& distance = fieldAfter().distance;
        const std::size_t corner = left_side_[cell];  // as many in a row as sides
        const std::size_t above = corner + grid_.cornerColumns();
        return std::min({distance[corner], distance[corner + 1], distance[above], distance[above + 1]});
    }

    /// Whether neither walls nor the surface are near a cell, so that beside() changes nothing in it.
    [[nodiscard]] bool isInner(std::size_t cell, double reach) const
    {
        constexpr double kRounding = 1e-6;
        const bool is_far = cornerDistance(cell) > (0.5 + kRounding) * reach;
        bool is_full = true;
        for (const std::size_t row : {cell - grid_.columns, cell, cell + grid_.columns}) {
            is_full = is_full && std::min({filled_[row - 1], filled_[row], filled_[row + 1]}) > kFirstRow + kRounding;
        }
        return is_far && is_full;
    }

    /// Changes a displacement near walls, which count as mirrors, and at the surface, along which it must go.
    [[nodiscard]] Vec2 beside(Vec2 place, Vec2 displacement, double reach) const
    {
        const GridPlace in_grid = places_.at(place);
        const Bilinear corner = in_grid.amongCorners();
        const double distance = corner.in(fieldAfter().distance);
        if (2.0 * distance < reach) {
            const Vec2 slope = corner.slopeIn(fieldAfter().distance);
            const double size = plainLength(slope);
            return size > 0.0 ? displacement + ((reach - 2.0 * std::max(distance, 0.0)) / size) * slope : displacement;
        }
        const Bilinear middle = in_grid.amongMiddles();
        if (middle.in(filled_) < kFirstRow) {
            const Vec2 slope = middle.slopeIn(filled_);
            const double square = dot(slope, slope);
            return square > 0.0 ? displacement - (dot(displacement, slope) / square) * slope : displacement;
        }
        return displacement;
    }

    /// Takes velocities from the grid, and moves the particles.
    void move(FluidState& state)
    {
        const std::size_t count = state.position.size();
        state.density.resize(count);
        forSpans(spans_, [&](std::size_t k) { total_[k] = density_[k] + solid_[k]; });
        constexpr std::size_t kParticlesPerBlock = 2048;
        squares_.assign(count, 0.0);
        for (const std::uint64_t rescued : mapBlocks<std::uint64_t>(
                 count, [&](std::size_t begin, std::size_t end) { return moveSome(state, begin, end); },
                 kParticlesPerBlock)) {
            state.counts.rescued += rescued;
        }
        state.approach_speed = count > 0 ? stepSpeed() : 0.0;
    }

    /// Moves particles; returns how many came into walls. They go straight on with their own velocities: what is on
    /// liquid goes with it, however fast that is. On paths through the grid's velocities, particles on fast liquid
    /// would pass what goes with them, and waves of some cells would grow on it.
    [[nodiscard]] DROPLET_WIDE_VECTORS std::uint64_t moveSome(FluidState& state, std::size_t begin, std::size_t end)
    {
        std::uint64_t rescued = 0;
        std::size_t cell = grid_.cells();
        double room = 0.0;  // of the cell: most particles are too far from walls to meet one
        for (std::size_t i = begin; i < end; ++i) {
            if (flies_[i] != 0) {
                rescued += fly(state, i) ? 1 : 0;
                continue;
            }
            take(state, i);
            if (cell_[i] != cell) {
                cell = cell_[i];
                room = roomIn(cell);
            }
            const Vec2 way = dt_ * state.velocity[i] + shift_[i];
            state.position[i] = state.position[i] + way;
            rescued += !(dot(way, way) < room * room) && keepOutOfWalls(state, i) ? 1 : 0;
            squares_[i] = dot(state.velocity[i], state.velocity[i]);
        }
        return rescued;
    }

    /// Speed of liquid that bounds steps, from the squares of the particles' speeds, which it puts into another order.
    [[nodiscard]] double stepSpeed()
    {
        const double fastest = *std::max_element(squares_.begin(), squares_.end());
        const std::size_t rank = squares_.size() - 1 - squares_.size() / kFastOnes;
        const auto at = squares_.begin() + static_cast<std::ptrdiff_t>(rank);
        std::nth_element(squares_.begin(), at, squares_.end());
        return std::max(std::sqrt(*at), std::sqrt(fastest) / kFaster);
    }

    /// Moves a particle that flies, in parts of half a cell, so that it meets walls; returns whether one stopped it.
    [[nodiscard]] bool fly(FluidState& state, std::size_t i) const
    {
        state.affine[i] = {};
        state.pressure[i] = 0.0;
        state.density[i] = 0.0;
        constexpr double kMostParts = 1000.0;
        const int parts = static_cast<int>(
            std::clamp(std::ceil(2.0 * length(state.velocity[i]) * dt_ / grid_.cell), 1.0, kMostParts));
        bool is_rescued = false;
        for (int part = 0; part < parts; ++part) {
            // The velocity is that at the end of the step.
            const Vec2 mean = state.velocity[i] - (dt_ * (1.0 - (part + 0.5) / parts)) * accelerationOf(i);
            state.position[i] = state.position[i] + (dt_ / parts) * mean;
            is_rescued = keepOutOfWalls(state, i) || is_rescued;
        }
        return is_rescued;
    }

    /// Way of a particle in a cell on which it meets no wall.
    [[nodiscard]] double roomIn(std::size_t cell) const { return std::max(cornerDistance(cell) - grid_.cell, 0.0); }

    /// Takes what the grid has at a particle.
    [[gnu::always_inline]] void take(FluidState& state, std::size_t i)
    {
        const GridPlace place = places_.at(state.position[i]);
        const Bilinear across = place.amongLeftSides();
        const Bilinear up = place.amongLowerSides();
        const Bilinear::Ascent rightwards = across.ascentIn(u_.value);
        const Bilinear::Ascent upwards = up.ascentIn(v_.value);
        const double inverse = 1.0 / grid_.cell;
        state.velocity[i] = {rightwards.value, upwards.value};
        state.affine[i] = {inverse * rightwards.slope, inverse * upwards.slope};
        const Bilinear middle = place.amongMiddles();
        state.pressure[i] = middle.in(pressure_);
        state.density[i] = middle.in(total_);
        shift_[i] = shift_[i] + Vec2{across.in(u_.shift), up.in(v_.shift)};
    }

    /// Puts a particle back that came into a wall.
    [[nodiscard]] bool keepOutOfWalls(FluidState& state, std::size_t i) const
    {
        const double clearance = kClearance * scene_.spacing;
        bool is_rescued = false;
        // Out of one wall may lead into another one; in a corner the way is halved each time.
        constexpr int kRounds = 8;
        for (int round = 0; round < kRounds; ++round) {
            const Vec2 x = state.position[i];
            const Bilinear at = places_.at(x).amongCorners();
            const double distance = at.in(fieldAfter().distance);
            if (!(distance < clearance)) {
                break;
            }
            const Vec2 slope = at.slopeIn(fieldAfter().distance);
            const double size = plainLength(slope);
            if (!(size > 0.0)) {
                break;
            }
            const Vec2 normal = (1.0 / size) * slope;
            state.position[i] = x + (clearance - distance) * normal;
            const Vec2 wall = walls_.velocity(fieldAfter(), fieldAfter().wall[at.first], x);
            const double inward = dot(state.velocity[i] - wall, normal);
            if (inward < 0.0) {
                state.velocity[i] = state.velocity[i] - inward * normal;
            }
            is_rescued = is_rescued || distance < 0.0;
        }
        return is_rescued;
    }

    const FluidScene& scene_;
    const FluidOptions& options_;
    WallDistance walls_;
    double dt_ = 0.0;
    GridShape grid_;
    GridPlaces places_;
    bool is_first_ = true;             ///< whether the next step begins a run
    Sides u_;                          ///< across
    Sides v_;                          ///< up
    std::vector<Span> spans_;          ///< of cells near particles: what all others have is of no account
    GridEquations whole_;              ///< of all liquid cells
    GridEquations rest_;               ///< without those in which the pressure is 0
    GridEquations::Memory solving_;    ///< for pressures
    GridEquations::Memory spreading_;  ///< for displacements
    WallField field_;                  ///< at the start of a step
    WallField moved_field_;            ///< at its end, if walls are moving
    // Of cells:
    std::vector<std::uint32_t> begin_;      ///< their first particles
    std::vector<std::uint32_t> left_side_;  ///< in u_
    std::vector<double> density_;           ///< of liquid, relative to that at rest
    std::vector<double> solid_;             ///< part that walls take, smoothed likewise
    std::vector<double> total_;             ///< both of them
    std::vector<double> room_;              ///< part outside of walls
    std::vector<double> filled_;            ///< density over what walls leave free
    std::vector<double> curvature_;         ///< of the surface [1/m]
    std::vector<double> pressure_;          ///< over the density [m²/s²]
    std::vector<double> potential_;         ///< of displacements
    std::vector<double> rhs_;               ///< of the pressures
    std::vector<double> excess_;            ///< of density, times a cell [m]
    std::vector<Cell> kind_;
    std::vector<std::uint8_t> free_;   ///< whether the pressure is 0, as walls do not hold liquid back
    std::vector<std::size_t> liquid_;  ///< liquid cells
    std::vector<double> scratch_;
    // Of particles:
    std::vector<Vec2> acceleration_;  ///< empty: gravity alone
    std::vector<std::uint32_t> cell_;
    std::vector<std::uint32_t> order_;
    std::vector<std::uint8_t> flies_;
    std::vector<Vec2> sorted_vectors_;  ///< memory for sorting, as are the following
    std::vector<std::array<Vec2, 2>> sorted_gradients_;
    std::vector<std::uint32_t> sorted_numbers_;
    std::vector<float> lanes_x_;  ///< places from the grid's corner, in distances on the lattice
    std::vector<float> lanes_y_;
    std::vector<Vec2> shift_;      ///< displacements that part particles [m]
    std::vector<double> squares_;  ///< of speeds [m²/s²]
};

}  // namespace

std::unique_ptr<FluidSolver> gridLiquid(const FluidScene& scene, const FluidOptions& options)
{
    return std::make_unique<GridLiquid>(scene, options);
}

}  // namespace droplet
