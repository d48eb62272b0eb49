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

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "blocks.h"
#include "grid_pressure.h"
#include "grid_shape.h"
#include "grid_viscosity.h"
#include "kernel.h"
#include "reorder.h"
#include "wall_distance.h"

namespace droplet {
namespace {

/// Side of a cell, in spacings.
constexpr double kCell = 2.0;

/// Longest way in a step, in spacings, if none is asked for.
constexpr double kCourant = 4.0;

/// Longest step at that way, in times in which liquid falls freely through half a cell.
constexpr double kFall = 0.5;

/// Cells around the particles: those of a step's way, and one for the surface.
constexpr std::size_t kPad = 5;

/// Particles in nine cells below which liquid flies.
constexpr std::uint32_t kFlying = 4;

/// Least part of the way between two cells' middles at which the surface may lie: less makes the equations stiff.
constexpr double kLeastPart = 0.1;

/// Open part of a side below which it counts as closed.
constexpr double kClosed = 0.02;

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

/// Part of the sides' greatest flow that may be left over.
constexpr double kTolerance = 1e-4;

/// Values on the sides of cells that face one axis.
struct Sides {
    std::size_t columns = 0;
    Vec2 lower{};                      ///< middle of the first one [m]
    std::vector<double> value;         ///< velocity along the axis, or a displacement
    std::vector<double> weight;        ///< of the particles near
    std::vector<double> open;          ///< part outside of walls
    std::vector<double> wall;          ///< velocity of the wall along the axis
    std::vector<double> before;        ///< value before the pressure changed it
    std::vector<std::uint8_t> solved;  ///< whether the pressure acts on it
    std::vector<std::uint8_t> known;

    void reset(Vec2 first, std::size_t across, std::size_t up)
    {
        lower = first;
        columns = across;
        const std::size_t count = across * up;
        value.assign(count, 0.0);
        weight.assign(count, 0.0);
        open.assign(count, 1.0);
        wall.assign(count, 0.0);
        solved.assign(count, 0);
        known.assign(count, 0);
    }
    [[nodiscard]] Vec2 placeOf(std::size_t k, double cell) const
    {
        return lower + cell * Vec2{static_cast<double>(k % columns), static_cast<double>(k / columns)};
    }
};

enum class Cell : std::uint8_t {
    Empty,
    Flying,  ///< liquid thinner than a cell
    Fringe,  ///< beside liquid, with the surface below its middle
    Liquid,
};

/// Part of a side outside of walls, from the distances of its ends in cells.
double openPart(double a, double b)
{
    constexpr double kOnWall = 1e-6;  // rounding puts ends on either side of a wall
    const double most = std::max(a, b);
    const double least = std::min(a, b);
    if (most <= kOnWall) {
        return 0.0;
    }
    const double part = least < 0.0 ? most / (most - least) : 1.0;
    return part < kClosed ? 0.0 : part;
}

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

    void step(FluidState& state, double dt) override
    {
        dt_ = dt;
        accelerate(state);
        sort(state);
        placeWalls(state.time);
        collect(state);
        classify();
        if (scene_.viscosity.value_or(0.0) > 0.0) {
            diffuse(*scene_.viscosity);
        }
        findSurface();
        u_.before = u_.value;
        v_.before = v_.value;
        // Pressures and displacements that mend the density have the same equations.
        const GridEquations whole = join(std::vector<std::uint8_t>(grid_.cells(), 0));
        project(state, whole);
        extend(u_);
        extend(v_);
        restrainAtWalls();
        spread(state, whole);
        if (walls_.areMoving()) {
            field_ = walls_.at(state.time + dt, grid_);
        }
        shift(state);
        move(state);
    }

private:
    /// Longest way in a step, in spacings.
    [[nodiscard]] double courant() const { return options_.courant.value_or(kCourant); }

    /// Gravity and the caller's accelerations.
    void accelerate(FluidState& state)
    {
        state.affine.resize(state.position.size());
        acceleration_.assign(state.position.size(), scene_.gravity);
        if (options_.control) {
            options_.control(state, acceleration_);
        }
        for (std::size_t i = 0; i < acceleration_.size(); ++i) {
            state.velocity[i] = state.velocity[i] + dt_ * acceleration_[i];
        }
    }

    /// Sets the grid around the particles, and sorts them by its cells.
    void sort(FluidState& state)
    {
        const double h = grid_.cell;
        Vec2 lower = state.position.empty() ? Vec2{} : state.position.front();
        Vec2 upper = lower;
        for (const Vec2 x : state.position) {
            lower = {std::min(lower.x, x.x), std::min(lower.y, x.y)};
            upper = {std::max(upper.x, x.x), std::max(upper.y, x.y)};
        }
        // Cells are always at the same places.
        const double left = std::floor(lower.x / h) - double{kPad};
        const double bottom = std::floor(lower.y / h) - double{kPad};
        grid_.lower = {left * h, bottom * h};
        grid_.columns = static_cast<std::size_t>(std::floor(upper.x / h) - left) + 1 + kPad;
        grid_.rows = static_cast<std::size_t>(std::floor(upper.y / h) - bottom) + 1 + kPad;
        const std::size_t count = state.position.size();
        cell_.resize(count);
        begin_.assign(grid_.cells() + 1, 0);
        for (std::size_t i = 0; i < count; ++i) {
            cell_[i] = static_cast<std::uint32_t>(cellOf(state.position[i]));
            ++begin_[cell_[i] + 1];
        }
        for (std::size_t k = 0; k < grid_.cells(); ++k) {
            begin_[k + 1] += begin_[k];
        }
        std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
        std::vector<std::uint32_t> order(count);
        for (std::uint32_t i = 0; i < count; ++i) {
            order[next[cell_[i]]++] = i;
        }
        reorder(state.position, order);
        reorder(state.velocity, order);
        reorder(state.affine, order);
        reorder(state.id, order);
        reorder(state.pressure, order);
        reorder(acceleration_, order);
        reorder(cell_, order);
        flies_.resize(count);
        for (std::size_t k = 0; k < grid_.cells(); ++k) {
            if (begin_[k] == begin_[k + 1]) {
                continue;
            }
            std::uint32_t near = 0;
            for (const std::size_t row : {k - grid_.columns, k, k + grid_.columns}) {
                near += begin_[row + 2] - begin_[row - 1];
            }
            for (std::uint32_t i = begin_[k]; i < begin_[k + 1]; ++i) {
                flies_[i] = near < kFlying ? 1 : 0;
            }
        }
        u_.reset(grid_.lower + Vec2{0.0, 0.5 * h}, grid_.columns + 1, grid_.rows);
        v_.reset(grid_.lower + Vec2{0.5 * h, 0.0}, grid_.columns, grid_.rows + 1);
    }

    [[nodiscard]] std::size_t cellOf(Vec2 place) const
    {
        return grid_.at(static_cast<std::size_t>((place.x - grid_.lower.x) / grid_.cell),
                        static_cast<std::size_t>((place.y - grid_.lower.y) / grid_.cell));
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
                if (u_.open[k] < 1.0) {
                    u_.wall[k] = velocity(a, a + corner_columns, u_.placeOf(k, h)).x;
                }
            }
        }
        for (std::size_t row = 0; row <= grid_.rows; ++row) {
            for (std::size_t column = 0; column < grid_.columns; ++column) {
                const std::size_t k = row * v_.columns + column;
                const std::size_t a = grid_.cornerAt(column, row);
                v_.open[k] = openPart(field_.distance[a] / h, field_.distance[a + 1] / h);
                if (v_.open[k] < 1.0) {
                    v_.wall[k] = velocity(a, a + 1, v_.placeOf(k, h)).y;
                }
            }
        }
        solid_.assign(grid_.cells(), 0.0);
        for (std::size_t row = 0; row < grid_.rows; ++row) {
            for (std::size_t column = 0; column < grid_.columns; ++column) {
                const std::size_t a = grid_.cornerAt(column, row);
                const double middle =
                    0.25 * (field_.distance[a] + field_.distance[a + 1] + field_.distance[a + corner_columns] +
                            field_.distance[a + corner_columns + 1]);
                solid_[grid_.at(column, row)] = std::clamp(0.5 - middle / h, 0.0, 1.0);
            }
        }
        room_.resize(grid_.cells());
        for (std::size_t k = 0; k < room_.size(); ++k) {
            room_[k] = 1.0 - solid_[k];
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
        density_.assign(grid_.cells(), 0.0);
        // Bands of rows that do not reach into one another's next but one are worked on at once.
        constexpr std::size_t kBand = 4;
        const std::size_t bands = (grid_.rows + kBand - 1) / kBand;
        for (const std::size_t parity : {std::size_t{0}, std::size_t{1}}) {
            tbb::parallel_for(std::size_t{0}, (bands + 1 - parity) / 2, [&](std::size_t pair) {
                const std::size_t band = 2 * pair + parity;
                const std::uint32_t first = begin_[band * kBand * grid_.columns];
                const std::uint32_t last = begin_[std::min((band + 1) * kBand, grid_.rows) * grid_.columns];
                for (std::uint32_t i = first; i < last; ++i) {
                    if (flies_[i] == 0) {
                        collectOne(state, i);
                    }
                }
            });
        }
        for (Sides* sides : {&u_, &v_}) {
            for (std::size_t k = 0; k < sides->value.size(); ++k) {
                if (sides->weight[k] > kLeastWeight) {
                    sides->value[k] /= sides->weight[k];
                }
            }
        }
    }

    void collectOne(const FluidState& state, std::size_t i)
    {
        const GridPlace place(grid_, state.position[i]);
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
        const std::size_t right = k + k / grid_.columns;  // u_ has one more in each row
        work(u_, k - 1, right, -1.0);
        work(u_, k + 1, right + 1, 1.0);
        work(v_, k - grid_.columns, k, -1.0);
        work(v_, k + grid_.columns, k + grid_.columns, 1.0);
    }

    void classify()
    {
        const std::size_t cells = grid_.cells();
        kind_.assign(cells, Cell::Empty);
        filled_.assign(cells, 0.0);
        liquid_.clear();
        // No cell at the rim has particles or neighbours of particles in the density's reach.
        for (std::size_t k = grid_.columns + 1; k + grid_.columns + 1 < cells; ++k) {
            if (!(density_[k] > 0.0)) {
                continue;
            }
            filled_[k] = density_[k] / std::max(1.0 - solid_[k], 0.25);
            double open = 0.0;
            forSides(k, [&](const Sides& sides, std::size_t, std::size_t s, double) { open += sides.open[s]; });
            if (filled_[k] >= 0.5 && open > 0.0) {
                kind_[k] = Cell::Liquid;
            }
        }
        floodRims();
        for (std::size_t k = grid_.columns + 1; k + grid_.columns + 1 < cells; ++k) {
            if (kind_[k] == Cell::Liquid || begin_[k] == begin_[k + 1] || flies_[begin_[k]] != 0) {
                continue;
            }
            bool is_beside = false;
            forSides(k, [&](const Sides& sides, std::size_t other, std::size_t s, double) {
                is_beside = is_beside || (sides.open[s] > 0.0 && kind_[other] == Cell::Liquid);
            });
            kind_[k] = is_beside ? Cell::Fringe : Cell::Flying;
        }
        std::vector<std::size_t> enclosed;
        for (std::size_t k = grid_.columns + 1; k + grid_.columns + 1 < cells; ++k) {
            if (kind_[k] == Cell::Fringe) {
                bool is_closed = true;
                forSides(k, [&](const Sides& sides, std::size_t other, std::size_t s, double) {
                    is_closed = is_closed && (sides.open[s] == 0.0 || kind_[other] == Cell::Liquid);
                });
                if (is_closed) {
                    enclosed.push_back(k);
                }
            }
        }
        for (const std::size_t k : enclosed) {
            kind_[k] = Cell::Liquid;
            filled_[k] = std::max(filled_[k], 0.5);
        }
        for (std::size_t k = 0; k < cells; ++k) {
            if (kind_[k] == Cell::Liquid) {
                liquid_.push_back(k);
            }
        }
        // Velocities are known at liquid, and where liquid falls freely.
        for (std::size_t row = 1; row + 1 < grid_.rows; ++row) {
            for (std::size_t column = 1; column < grid_.columns; ++column) {
                const std::size_t k = grid_.at(column, row);
                mark(u_, row * u_.columns + column, k - 1, k);
            }
        }
        for (std::size_t row = 1; row < grid_.rows; ++row) {
            for (std::size_t column = 1; column + 1 < grid_.columns; ++column) {
                const std::size_t k = grid_.at(column, row);
                mark(v_, row * v_.columns + column, k - grid_.columns, k);
            }
        }
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
            for (std::size_t k = grid_.columns + 1; k + grid_.columns + 1 < grid_.cells(); ++k) {
                if (kind_[k] == Cell::Liquid || !(room_[k] < 0.5)) {
                    continue;
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
            }
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
        curvature_.assign(grid_.cells(), 0.0);
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
            const double size = length(slope);
            return size > 1e-6 ? (1.0 / size) * slope : Vec2{};
        };
        for (std::size_t k = columns + 1; k + columns + 1 < level.size(); ++k) {
            if (level[k] > 0.02 && level[k] < 0.98) {
                const Vec2 a = normal(k - columns - 1);
                const Vec2 b = normal(k - columns);
                const Vec2 c = normal(k - 1);
                const Vec2 d = normal(k);
                const double spread = (0.5 / h) * (b.x + d.x - a.x - c.x + c.y + d.y - a.y - b.y);
                // The level rises into the liquid, so round liquid has a negative divergence.
                curvature_[k] = std::clamp(-spread, -1.0 / h, 1.0 / h);
            }
        }
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
    /// @param whole  equations of all liquid cells
    void project(FluidState& state, const GridEquations& whole)
    {
        const double h = grid_.cell;
        const double capillary = scene_.surface_tension / scene_.density * dt_ / h;  // of pressures below
        std::vector<double> pressure(grid_.cells(), 0.0);                            // times dt/(density h) [m/s]
        guess(state, pressure);
        std::vector<std::uint8_t> free(grid_.cells(), 0);
        std::optional<GridEquations> rest;  // without these cells
        constexpr int kRounds = 3;
        for (int round = 0; round < kRounds; ++round) {
            const GridEquations& equations = round == 0 ? whole : rest.emplace(join(free));
            std::vector<double> rhs(grid_.cells(), 0.0);
            double flow = 0.0;
            for (const std::size_t k : liquid_) {
                if (free[k] != 0) {
                    pressure[k] = 0.0;
                    continue;
                }
                forSides(k, [&](const Sides& sides, std::size_t other, std::size_t s, double) {
                    if (sides.open[s] > 0.0 && kind_[other] != Cell::Liquid) {
                        const double part = partTo(k, other);
                        rhs[k] += sides.open[s] / part * capillary * curvatureAt(k, other, part);
                    }
                });
                forSides(k, [&](const Sides& sides, std::size_t, std::size_t s, double sign) {
                    if (const double w = sides.open[s]; w > 0.0) {
                        rhs[k] -= sign * w * sides.value[s];
                        flow = std::max(flow, std::abs(sides.value[s]));
                    }
                });
                const std::size_t right = k + k / grid_.columns;
                rhs[k] += swept(u_, right, right + 1) + swept(v_, k, k + grid_.columns);
            }
            const auto solved = equations.solve(rhs, pressure, kTolerance * flow);
            state.counts.divergence_iterations += static_cast<std::uint64_t>(solved.iterations);
            // Walls do not hold liquid back.
            double highest = 0.0;
            for (const std::size_t k : liquid_) {
                highest = std::max(highest, pressure[k]);
            }
            const double least = -std::max(2.0 * capillary / h, 0.02 * highest);
            bool is_held = false;
            for (const std::size_t k : liquid_) {
                if (free[k] == 0 && pressure[k] < least) {
                    bool at_wall = false;
                    forSides(k, [&](const Sides& sides, std::size_t, std::size_t s, double) {
                        at_wall = at_wall || sides.open[s] < 1.0;
                    });
                    if (at_wall) {
                        free[k] = 1;
                        is_held = true;
                    }
                }
            }
            if (!is_held) {
                break;
            }
        }
        changeSides(u_.value, v_.value, pressure, free, capillary);
        pressure_ = std::move(pressure);
        for (double& p : pressure_) {
            p *= h / dt_;
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

    /// Equations of the liquid cells.
    /// @param free  cells in which the pressure is 0
    [[nodiscard]] GridEquations join(const std::vector<std::uint8_t>& free)
    {
        GridEquations equations(grid_);
        for (const std::size_t k : liquid_) {
            if (free[k] != 0) {
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
                } else if (free[other] != 0) {
                    equations.hold(k, w);
                } else if (sign > 0.0) {
                    other == k + 1 ? equations.joinRight(k, w) : equations.joinAbove(k, w);
                }
            });
        }
        equations.factorise();
        return equations;
    }

    /// Adds differences of a potential to the values at the sides of liquid cells.
    void changeSides(std::vector<double>& across, std::vector<double>& up, const std::vector<double>& potential,
                     const std::vector<std::uint8_t>& free, double capillary)
    {
        for (const std::size_t k : liquid_) {
            forSides(k, [&](const Sides& sides, std::size_t other, std::size_t s, double sign) {
                if (!(sides.open[s] > 0.0) || (sign < 0.0 && kind_[other] == Cell::Liquid)) {
                    return;
                }
                double& value = (&sides == &u_ ? across : up)[s];
                if (kind_[other] == Cell::Liquid) {
                    value += potential[k] - potential[other];
                } else {
                    const double part = free[k] != 0 ? 1.0 : partTo(k, other);
                    const double beyond = capillary * curvatureAt(k, other, part);
                    value += sign * (potential[k] - (free[k] != 0 ? 0.0 : beyond)) / part;
                }
            });
        }
    }

    /// Continues values from the known sides to the next ones. Where the surface is below a cell's middle, liquid keeps
    /// its own velocity, and the pressure changes it as that of the next sides.
    static void extend(Sides& sides)
    {
        std::vector<double> change(sides.value.size(), 0.0);
        for (std::size_t k = 0; k < change.size(); ++k) {
            change[k] = sides.solved[k] != 0 ? sides.value[k] - sides.before[k] : 0.0;
        }
        extend(change, sides.solved, sides.columns);
        for (std::size_t k = 0; k < change.size(); ++k) {
            if (sides.known[k] == 0 && sides.open[k] > 0.0 && sides.weight[k] > kLeastWeight) {
                sides.value[k] = sides.before[k] + change[k];
                sides.known[k] = 1;
            }
        }
        extend(sides.value, sides.known, sides.columns);
    }

    /// Gives unknown values layer by layer the mean of the known ones beside them.
    static void extend(std::vector<double>& value, std::vector<std::uint8_t> known, std::size_t columns)
    {
        constexpr std::uint8_t kNext = 2;  // in the present layer
        const auto inside = [&](std::size_t k) { return k >= columns && k + columns < value.size(); };
        std::vector<std::uint32_t> layer;
        for (std::size_t k = columns; k + columns < value.size(); ++k) {
            if (known[k] == 0 &&
                (known[k - 1] == 1 || known[k + 1] == 1 || known[k - columns] == 1 || known[k + columns] == 1)) {
                known[k] = kNext;
                layer.push_back(static_cast<std::uint32_t>(k));
            }
        }
        for (std::size_t pass = 0; pass + 1 < kPad; ++pass) {
            for (const std::size_t k : layer) {
                double sum = 0.0;
                double count = 0.0;
                for (const std::size_t other : {k - 1, k + 1, k - columns, k + columns}) {
                    if (known[other] == 1) {
                        sum += value[other];
                        count += 1.0;
                    }
                }
                value[k] = sum / count;
            }
            for (const std::size_t k : layer) {
                known[k] = 1;
            }
            std::vector<std::uint32_t> next;
            for (const std::size_t k : layer) {
                for (const std::size_t other : {k - 1, k + 1, k - columns, k + columns}) {
                    if (known[other] == 0 && inside(other)) {
                        known[other] = kNext;
                        next.push_back(static_cast<std::uint32_t>(other));
                    }
                }
            }
            layer = std::move(next);
        }
    }

    /// Gives velocities in walls the walls' part along their normals.
    void restrainAtWalls()
    {
        const std::vector<double> across = u_.value;
        const std::vector<double> up = v_.value;
        for (const bool is_across : {true, false}) {
            Sides& sides = is_across ? u_ : v_;
            for (std::size_t k = 0; k < sides.value.size(); ++k) {
                if (sides.open[k] > 0.0) {
                    continue;
                }
                const Vec2 place = sides.placeOf(k, grid_.cell);
                const GridPlace in_grid(grid_, place);
                const Bilinear at = in_grid.amongCorners();
                const Vec2 slope = at.slopeIn(field_.distance);
                const double size = length(slope);
                if (!(size > 0.0)) {
                    sides.value[k] = sides.wall[k];
                    continue;
                }
                const Vec2 normal = (1.0 / size) * slope;
                const Vec2 velocity = {in_grid.amongLeftSides().in(across), in_grid.amongLowerSides().in(up)};
                const Vec2 wall = walls_.velocity(field_, field_.wall[at.first], place);
                const double into = dot(velocity - wall, normal);
                sides.value[k] -= into * (is_across ? normal.x : normal.y);
            }
        }
    }

    /// Finds displacements of the sides that mend the density.
    /// @param equations  of all liquid cells
    void spread(FluidState& state, const GridEquations& equations)
    {
        const double h = grid_.cell;
        std::vector<double> rhs(grid_.cells(), 0.0);
        double mean = 0.0;
        for (const std::size_t k : liquid_) {
            const double density = density_[k] + solid_[k];
            mean += std::max(density - 1.0, 0.0);
            bool is_inside = true;
            forSides(k, [&](const Sides& sides, std::size_t other, std::size_t s, double) {
                is_inside = is_inside && (!(sides.open[s] > 0.0) || kind_[other] == Cell::Liquid);
            });
            rhs[k] = h * std::clamp(density - 1.0, is_inside ? -kMostGap : 0.0, kMostCompression);
        }
        state.density_error = mean / std::max(static_cast<double>(liquid_.size()), 1.0);
        std::vector<double> potential(grid_.cells(), 0.0);
        const auto solved = equations.solve(rhs, potential, 1e-3 * h);
        state.counts.density_iterations += static_cast<std::uint64_t>(solved.iterations);
        across_.assign(u_.value.size(), 0.0);
        up_.assign(v_.value.size(), 0.0);
        changeSides(across_, up_, potential, std::vector<std::uint8_t>(grid_.cells(), 0), 0.0);
        extend(across_, u_.solved, u_.columns);
        extend(up_, v_.solved, v_.columns);
    }

    /// Finds displacements that part particles which are closer than on the lattice at rest: the grid does not see how
    /// they lie in a cell.
    void shift(const FluidState& state)
    {
        const double reach = latticeStep(scene_.spacing);
        placeLanes(state, reach);
        shift_.assign(state.position.size(), {});
        constexpr std::size_t kParticlesPerBlock = 1024;
        forBlocks(
            state.position.size(),
            [&](std::size_t begin, std::size_t end) {
                for (std::size_t i = begin; i < end; ++i) {
                    if (flies_[i] != 0) {
                        continue;
                    }
                    const Vec2 sum = beside(state.position[i], reach * overlap(i), reach);
                    const double square = dot(sum, sum);
                    const double most = kMostShift / kShift * scene_.spacing;
                    shift_[i] = (square > most * most ? kShift * most / std::sqrt(square) : kShift) * sum;
                }
            },
            kParticlesPerBlock);
    }

    /// Sets the particles' places in units of a reach.
    void placeLanes(const FluidState& state, double reach)
    {
        const std::size_t count = state.position.size();
        // What is read beyond the last one is far away.
        constexpr float kFar = 1e6F;
        lanes_x_.assign(count + kLanes, kFar);
        lanes_y_.assign(count + kLanes, kFar);
        for (std::size_t i = 0; i < count; ++i) {
            const Vec2 place = (1.0 / reach) * (state.position[i] - grid_.lower);
            lanes_x_[i] = static_cast<float>(place.x);
            lanes_y_[i] = static_cast<float>(place.y);
        }
    }

    /// Sum over the neighbours within a reach of what lacks to it, away from them, in reaches.
    [[nodiscard]] Vec2 overlap(std::size_t i) const
    {
        using Lanes = Eigen::Array<float, kLanes, 1>;
        // At a distance q, (1 - q)/q of the way between the two is wanted: within 0.02 q that is, from q = 1/2 on, the
        // following polynomial of 1 - q^2, which needs neither root nor quotient.
        constexpr float kFirst = 0.5F;
        constexpr float kThird = 1.4F;
        Lanes right = Lanes::Zero();
        Lanes up = Lanes::Zero();
        const std::size_t cell = cell_[i];
        for (const std::size_t row : {cell - grid_.columns, cell, cell + grid_.columns}) {
            // The last lanes are those of cells farther right, out of reach.
            for (std::size_t j = begin_[row - 1]; j < begin_[row + 2]; j += kLanes) {
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

    /// Changes a displacement near walls, which count as mirrors, and at the surface, along which it must go.
    [[nodiscard]] Vec2 beside(Vec2 place, Vec2 displacement, double reach) const
    {
        const GridPlace in_grid(grid_, place);
        const Bilinear corner = in_grid.amongCorners();
        const double distance = corner.in(field_.distance);
        if (2.0 * distance < reach) {
            const Vec2 slope = corner.slopeIn(field_.distance);
            const double size = length(slope);
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

    [[nodiscard]] Vec2 velocityAt(Vec2 place) const
    {
        const GridPlace in_grid(grid_, place);
        return {in_grid.amongLeftSides().in(u_.value), in_grid.amongLowerSides().in(v_.value)};
    }

    /// Takes velocities from the grid, and moves the particles.
    void move(FluidState& state)
    {
        const std::size_t count = state.position.size();
        state.density.resize(count);
        std::vector<double> density(grid_.cells());
        for (std::size_t k = 0; k < density.size(); ++k) {
            density[k] = density_[k] + solid_[k];
        }
        constexpr std::size_t kParticlesPerBlock = 2048;
        struct Block {
            double fastest = 0.0;
            std::uint64_t rescued = 0;
        };
        double fastest = 0.0;
        for (const Block& block : mapBlocks<Block>(
                 count,
                 [&](std::size_t begin, std::size_t end) {
                     Block result;
                     for (std::size_t i = begin; i < end; ++i) {
                         const bool is_rescued = flies_[i] != 0 ? fly(state, i) : flow(state, density, i);
                         result.rescued += is_rescued ? 1 : 0;
                         if (flies_[i] == 0) {
                             result.fastest = std::max(result.fastest, dot(state.velocity[i], state.velocity[i]));
                         }
                     }
                     return result;
                 },
                 kParticlesPerBlock)) {
            fastest = std::max(fastest, block.fastest);
            state.counts.rescued += block.rescued;
        }
        state.approach_speed = std::sqrt(fastest);
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
            const Vec2 mean = state.velocity[i] - (dt_ * (1.0 - (part + 0.5) / parts)) * acceleration_[i];
            state.position[i] = state.position[i] + (dt_ / parts) * mean;
            is_rescued = keepOutOfWalls(state, i) || is_rescued;
        }
        return is_rescued;
    }

    /// Moves a particle with the liquid; returns whether it came into a wall.
    [[nodiscard]] bool flow(FluidState& state, const std::vector<double>& density, std::size_t i) const
    {
        const Vec2 x = state.position[i];
        const GridPlace place(grid_, x);
        const Bilinear across = place.amongLeftSides();
        const Bilinear up = place.amongLowerSides();
        const Vec2 v{across.in(u_.value), up.in(v_.value)};
        const double inverse = 1.0 / grid_.cell;
        state.velocity[i] = v;
        state.affine[i] = {inverse * across.slopeIn(u_.value), inverse * up.slopeIn(v_.value)};
        const Bilinear middle = place.amongMiddles();
        state.pressure[i] = middle.in(pressure_);
        state.density[i] = middle.in(density);
        // Ralston's method of third order.
        const Vec2 second = velocityAt(x + (0.5 * dt_) * v);
        const Vec2 third = velocityAt(x + (0.75 * dt_) * second);
        const Vec2 apart{across.in(across_), up.in(up_)};
        state.position[i] = x + (dt_ / 9.0) * (2.0 * v + 3.0 * second + 4.0 * third) + apart + shift_[i];
        return keepOutOfWalls(state, i);
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
            const Bilinear at = GridPlace(grid_, x).amongCorners();
            const double distance = at.in(field_.distance);
            if (!(distance < clearance)) {
                break;
            }
            const Vec2 slope = at.slopeIn(field_.distance);
            const double size = length(slope);
            if (!(size > 0.0)) {
                break;
            }
            const Vec2 normal = (1.0 / size) * slope;
            state.position[i] = x + (clearance - distance) * normal;
            const Vec2 wall = walls_.velocity(field_, field_.wall[at.first], x);
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
    Sides u_;          ///< across
    Sides v_;          ///< up
    WallField field_;  ///< at the start of a step, and at its end when particles move
    // Of cells:
    std::vector<std::uint32_t> begin_;  ///< their first particles
    std::vector<double> density_;       ///< of liquid, relative to that at rest
    std::vector<double> solid_;         ///< part that walls take, smoothed likewise
    std::vector<double> room_;          ///< part outside of walls
    std::vector<double> filled_;        ///< density over what walls leave free
    std::vector<double> curvature_;     ///< of the surface [1/m]
    std::vector<double> pressure_;      ///< over the density [m²/s²]
    std::vector<Cell> kind_;
    std::vector<std::size_t> liquid_;  ///< liquid cells
    std::vector<double> scratch_;
    // Of particles:
    std::vector<Vec2> acceleration_;
    std::vector<std::uint32_t> cell_;
    std::vector<std::uint8_t> flies_;
    std::vector<float> lanes_x_;  ///< places from the grid's corner, in distances on the lattice
    std::vector<float> lanes_y_;
    std::vector<Vec2> shift_;  ///< displacements that part particles [m]
    // Of sides: displacements that mend the density [m]
    std::vector<double> across_;
    std::vector<double> up_;
};

}  // namespace

std::unique_ptr<FluidSolver> gridLiquid(const FluidScene& scene, const FluidOptions& options)
{
    return std::make_unique<GridLiquid>(scene, options);
}

}  // namespace droplet
