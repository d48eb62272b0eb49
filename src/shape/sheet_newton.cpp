// SPDX-License-Identifier: GPL-3.0-or-later
// Newton's method on area and gravity under a volume constraint, along normals as Surface Evolver's hessian_normal
// does (K. A. Brakke). The inertia of one factorisation tells minima from saddles: N. Gould, "On practical conditions
// for the existence and uniqueness of solutions to the general equality quadratic programming problem" (1985). The
// ground is a bound, by a primal-dual active set: M. Hintermüller, K. Ito, K. Kunisch, SIAM J. Optim. 13
// (2002).
#include "shape/sheet_newton.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "blocks.h"
#include "shape/sheet_remesh.h"
#include "shape/work.h"

namespace droplet {
namespace {

using Vector = Eigen::VectorXd;

/// Rounds of the active set in a step, and those in which vertices may leave the ground.
constexpr int kGroundRounds = 12;
constexpr int kReleaseRounds = 6;
/// Vertical part of a direction from which on a step is bounded by the ground.
constexpr double kLevel = 0.1;

/// Rounds in which the base follows the vertices that lie on the ground, which Newton's method holds or releases.
constexpr int kBaseRounds = 6;

/// Refinements of the bordered system.
constexpr int kRefinements = 2;
/// Rounds in which a step is damped where triangles would turn too much, and factors of the damping.
constexpr int kDampingRounds = 6;
constexpr double kDamped = 4.0;
constexpr double kReleased = 0.2;
constexpr double kUndamped = 0.05;
/// Relative residual of a linear system that needs no refinement: that of Newton's next step is larger.
constexpr double kSolved = 1e-11;
/// Relative residual of an equilibrium from which on its matrix serves for the next place as well: the vertices differ
/// by as much, and Newton's next step ends.
constexpr double kSamePlace = 1e-5;
/// Relative residual of a place from which on its factors serve for chord steps, and show the inertia at their end; and
/// the most of its residual that a chord step may leave. Full steps leave less, but cost three times as much.
constexpr double kChordPlace = 1e-2;
constexpr double kChordRate = 0.2;
/// Work of moving and integrating a triangle, and of finding the ground under it.
constexpr double kPassWork = 8.0;
constexpr double kGroundWork = 30.0;
/// Triangles of a block: some 0.05 ms of work.
constexpr std::size_t kTriangles = 4096;

}  // namespace

bool isGentle(Vec3 area_before, Vec3 area_after, const MotionLimits& limits)
{
    const double before = length(area_before);
    const double after = length(area_after);
    return dot(area_before, area_after) >= limits.min_cosine * before * after && after >= limits.min_area * before &&
           after <= limits.max_area * before;
}

bool isGentle(const CapillarySurface& before, const CapillarySurface& after, const MotionLimits& limits)
{
    const std::vector<std::uint8_t> are_gentle = mapBlocks<std::uint8_t>(
        before.triangles.size(),
        [&](std::size_t begin, std::size_t end) {
            const auto first = before.triangles.begin();
            return std::all_of(first + static_cast<std::ptrdiff_t>(begin), first + static_cast<std::ptrdiff_t>(end),
                               [&](const Triangle& t) {
                                   return isGentle(areaVector(before.vertices, t), areaVector(after.vertices, t),
                                                   limits);
                               })
                       ? std::uint8_t{1}
                       : std::uint8_t{0};
        },
        kTriangles);
    return std::find(are_gentle.begin(), are_gentle.end(), 0) == are_gentle.end();
}

SheetSolver::SheetSolver(const CapillarySurface& sheet, Vec3 weight, SheetBase base)
    : rim_(sheet.rimVertexCount()),
      weight_(weight),
      base_(std::move(base)),
      pattern_(sheet.triangles, sheet.vertices.size(), sheet.rimVertexCount()),
      held_(sheet.vertices.size() - sheet.rimVertexCount(), 0),
      held_motion_(sheet.vertices.size() - sheet.rimVertexCount(), 0.0),
      damping_(sheet.vertices.size() - sheet.rimVertexCount(), 0.0)
{
    linear_.matrix = pattern_.empty();
    factor_ = multifrontalFactor(linear_.matrix, {sheet.vertices.begin() + rim_, sheet.vertices.end()});
}

void SheetSolver::linearise(const CapillarySurface& sheet)
{
    const SheetGradients gradients = gradientsOf(sheet, weight_, pattern_);
    const std::size_t count = sheet.vertices.size() - rim_;
    const auto size = static_cast<Eigen::Index>(count);
    linear_.gradient.resize(size);
    linear_.volume.resize(size);
    linear_.mass.resize(size);
    linear_.directions.assign(sheet.vertices.size(), {});
    linear_.clearance.resize(count);
    linear_.rise.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t v = rim_ + i;
        const auto k = static_cast<Eigen::Index>(i);
        const double size_of = length(gradients.volume[v]);
        Vec3 direction = size_of > 0.0 ? (1.0 / size_of) * gradients.volume[v] : Vec3{0.0, 0.0, 1.0};
        const GroundPoint ground = base_.under(sheet.vertices[v]);
        linear_.clearance[i] = sheet.vertices[v].z - ground.height;
        if (linear_.clearance[i] <= 0.0) {
            const Vec3 up = normalOf(ground);
            direction = dot(direction, up) < 0.0 ? -1.0 * up : up;
        } else {
            held_[i] = 0;
        }
        linear_.rise[i] = dot(direction, {-ground.gradient.x, -ground.gradient.y, 1.0});
        linear_.directions[v] = direction;
        linear_.gradient[k] = dot(direction, gradients.energy[v]);
        linear_.volume[k] = dot(direction, gradients.volume[v]);
        linear_.mass[k] = gradients.area[v];
    }
}

void SheetSolver::assemble(const CapillarySurface& sheet, double pressure)
{
    linear_.full = hessianOf(sheet, linear_.directions, weight_, pressure, pattern_);
}

bool SheetSolver::factor(double shift)
{
    Eigen::SparseMatrix<double>& matrix = linear_.matrix;
    const int* outer = matrix.outerIndexPtr();
    const int* inner = matrix.innerIndexPtr();
    const double* full = linear_.full.valuePtr();
    double* values = matrix.valuePtr();
    for (Eigen::Index column = 0; column < matrix.outerSize(); ++column) {
        const auto c = static_cast<std::size_t>(column);
        for (int at = outer[column]; at < outer[column + 1]; ++at) {
            const bool is_held = held_[static_cast<std::size_t>(inner[at])] != 0 || held_[c] != 0;
            if (inner[at] == column) {
                const double damping = damping_[c] * std::abs(full[at]);
                values[at] = is_held ? 1.0 : full[at] + shift * linear_.mass[column] + damping;
            } else {
                values[at] = is_held ? 0.0 : full[at];
            }
        }
    }
    return factor_->factorize(matrix) && respond();
}

bool SheetSolver::respond()
{
    Vector border = linear_.volume;
    for (std::size_t i = 0; i < held_.size(); ++i) {
        if (held_[i] != 0) {
            border[static_cast<Eigen::Index>(i)] = 0.0;
        }
    }
    response_ = factor_->solve(border);
    return response_.allFinite();
}

int SheetSolver::negatives() const
{
    return static_cast<int>(factor_->negatives()) + (linear_.volume.dot(response_) > 0.0 ? 1 : 0);
}

SheetSolver::Step SheetSolver::solveBordered(const Vector& forces, double volume_change) const
{
    // Held unknowns have a motion of their own; what they push goes to the right side.
    const Eigen::Index size = forces.size();
    Vector given = Vector::Zero(size);
    Vector free_volume = linear_.volume;
    Vector right = forces;
    bool any = false;
    for (Eigen::Index i = 0; i < size; ++i) {
        if (held_[static_cast<std::size_t>(i)] != 0) {
            given[i] = held_motion_[static_cast<std::size_t>(i)];
            any = true;
        }
    }
    if (any) {
        right -= linear_.full.selfadjointView<Eigen::Lower>() * given;
        volume_change -= linear_.volume.dot(given);
        for (Eigen::Index i = 0; i < size; ++i) {
            if (held_[static_cast<std::size_t>(i)] != 0) {
                right[i] = 0.0;
                free_volume[i] = 0.0;
            }
        }
    }
    Step step;
    step.motion = Vector::Zero(size);
    const double across = free_volume.dot(response_);
    Vector rest = right;
    double rest_volume = volume_change;
    for (int round = 0; round <= kRefinements; ++round) {
        const Vector part = factor_->solve(rest);
        const double change = (rest_volume - free_volume.dot(part)) / across;
        step.motion += part + change * response_;
        step.pressure += change;
        rest = right - linear_.matrix.selfadjointView<Eigen::Lower>() * step.motion + step.pressure * free_volume;
        rest_volume = volume_change - free_volume.dot(step.motion);
        if (rest.norm() <= kSolved * (right.norm() + std::abs(step.pressure) * free_volume.norm()) &&
            std::abs(rest_volume) <=
                kSolved * (std::abs(volume_change) + free_volume.cwiseAbs().dot(step.motion.cwiseAbs()))) {
            break;
        }
    }
    step.motion += given;
    return step;
}

bool SheetSolver::changeHeld(const Step& step, const Vector& forces, bool may_release)
{
    bool has_changed = false;
    const Vector pushed =
        linear_.full.selfadjointView<Eigen::Lower>() * step.motion - forces - step.pressure * linear_.volume;
    for (std::size_t i = 0; i < held_.size(); ++i) {
        const auto k = static_cast<Eigen::Index>(i);
        const double rise = linear_.rise[i];
        if (held_[i] != 0) {
            if (may_release && rise * pushed[k] < 0.0) {
                held_[i] = 0;
                has_changed = true;
            }
        } else if (std::abs(rise) > kLevel && linear_.clearance[i] + step.motion[k] * rise < 0.0) {
            held_[i] = 1;
            held_motion_[i] = -linear_.clearance[i] / rise;
            has_changed = true;
        }
    }
    return has_changed;
}

std::optional<SheetSolver::Step> SheetSolver::chord(const CapillarySurface& sheet, double pressure, double missing)
{
    if (!respond()) {
        return std::nullopt;
    }
    const Vector forces = pressure * linear_.volume - linear_.gradient;
    Step step = solveBordered(forces, missing);
    const bool is_fit = step.motion.allFinite() && !changeHeld(step, forces, true) && !damp(sheet, step);
    return is_fit ? std::optional(std::move(step)) : std::nullopt;
}

bool SheetSolver::damp(const CapillarySurface& sheet, const Step& step)
{
    std::vector<Vec3> vertices = sheet.vertices;
    for (Eigen::Index i = 0; i < step.motion.size(); ++i) {
        const std::size_t v = rim_ + static_cast<std::size_t>(i);
        vertices[v] = vertices[v] + step.motion[i] * linear_.directions[v];
    }
    std::vector<std::uint8_t> is_wild(damping_.size(), 0);
    for (const Triangle& t : sheet.triangles) {
        if (!isGentle(areaVector(sheet.vertices, t), areaVector(vertices, t), {})) {
            for (const std::uint32_t v : t) {
                if (v >= rim_) {
                    is_wild[v - rim_] = 1;
                }
            }
        }
    }
    for (std::size_t i = 0; i < damping_.size(); ++i) {
        if (is_wild[i] != 0) {
            damping_[i] = std::max(1.0, kDamped * damping_[i]);
        }
    }
    return std::find(is_wild.begin(), is_wild.end(), 1) != is_wild.end();
}

double SheetSolver::residual(double pressure) const
{
    double rest = 0.0;
    double scale = 0.0;
    double area = 0.0;
    for (Eigen::Index i = 0; i < linear_.gradient.size(); ++i) {
        area += linear_.mass[i];
        if (held_[static_cast<std::size_t>(i)] != 0) {
            continue;
        }
        const double r = linear_.gradient[i] - pressure * linear_.volume[i];
        rest += r * r / linear_.mass[i];
        scale += linear_.volume[i] * linear_.volume[i] / linear_.mass[i];
    }
    return std::sqrt(rest / scale) / std::max(std::abs(pressure), 2.0 / std::sqrt(area));
}

SheetIntegrals SheetSolver::liquidUnder(const CapillarySurface& sheet) const
{
    return integrate(sheet, weight_) - under_;
}

double SheetSolver::volumeScale(double volume) const
{
    // Without liquid, a sheet that gravity pulls along its plane is no plane.
    return std::max(volume, 1e-6 * std::pow(linear_.mass.sum(), 1.5));
}

double SheetSolver::workOf(int factorisations, const CapillarySurface& sheet) const
{
    const double pass = base_.ground.flat() ? kPassWork : kPassWork + kGroundWork;
    return factorisations * factorWork(sheet.triangles.size()) +
           static_cast<double>(passes_) * pass * static_cast<double>(sheet.triangles.size());
}

bool SheetSolver::moveWithin(CapillarySurface& sheet, const Step& step, double volume, SheetIntegrals& sums)
{
    const CapillarySurface before = sheet;
    const SheetIntegrals start = sums;
    // A step that first has to reach the volume may cost energy.
    const double scale = volumeScale(volume);
    const bool has_volume = std::abs(start.volume - volume) <= 1e-9 * scale;
    // Slope of the energy along the step at fixed volume.
    const double slope = std::min(0.0, linear_.gradient.dot(step.motion));
    const double across = linear_.volume.dot(response_);
    const Vector along = (1.0 / across) * response_;
    constexpr int kHalvings = 12;
    double part = 1.0;
    for (int k = 0; k < kHalvings; ++k, part *= 0.5) {
        sheet.vertices = before.vertices;
        const auto move = [&](const Vector& motion, double size) {
            for (Eigen::Index i = 0; i < motion.size(); ++i) {
                const std::size_t v = rim_ + static_cast<std::size_t>(i);
                sheet.vertices[v] = sheet.vertices[v] + (size * motion[i]) * linear_.directions[v];
            }
        };
        move(step.motion, part);
        base_.lift(sheet.vertices, rim_);
        SheetIntegrals now = liquidUnder(sheet);
        ++passes_;
        for (int round = 0; round < 8 && std::abs(volume - now.volume) > 1e-13 * scale; ++round) {
            move(along, volume - now.volume);
            base_.lift(sheet.vertices, rim_);
            now = liquidUnder(sheet);
            ++passes_;
        }
        if (std::abs(now.volume - volume) > 1e-10 * scale || !isGentle(before, sheet, {})) {
            continue;
        }
        if (!has_volume || now.energy() <= start.energy() + 1e-4 * part * slope + 1e-12 * std::abs(start.energy())) {
            sums = now;
            return true;
        }
    }
    sheet.vertices = before.vertices;
    return false;
}

void SheetSolver::describe(NewtonResult& result) const
{
    const double across = linear_.volume.dot(response_);
    result.converged = true;
    result.pressure_slope = 1.0 / across;
    result.tangent.assign(linear_.directions.size(), {});
    for (Eigen::Index i = 0; i < response_.size(); ++i) {
        const std::size_t v = rim_ + static_cast<std::size_t>(i);
        result.tangent[v] = (response_[i] / across) * linear_.directions[v];
    }
}

NewtonResult SheetSolver::solve(CapillarySurface& sheet, double volume, double& pressure, const NewtonLimits& limits)
{
    NewtonResult result;
    under_ = base_.baseOf(sheet, weight_);
    for (int round = 0; round < kBaseRounds; ++round) {
        NewtonLimits left = limits;
        left.max_work -= result.work;
        NewtonResult next = solveOnBase(sheet, volume, pressure, left);
        next.steps += result.steps;
        next.factorisations += result.factorisations;
        next.work += result.work;
        result = std::move(next);
        const SheetIntegrals last = std::exchange(under_, base_.baseOf(sheet, weight_));
        if (!result.converged || std::abs(under_.volume - last.volume) <= limits.tolerance * volumeScale(volume)) {
            break;
        }
    }
    return result;
}

NewtonResult SheetSolver::solveOnBase(CapillarySurface& sheet, double volume, double& pressure,
                                      const NewtonLimits& limits)
{
    NewtonResult result;
    passes_ = 0;
    const auto has_work = [&] {
        result.work = workOf(result.factorisations, sheet);
        return result.work < limits.max_work;
    };
    const std::vector<double> angles = limits.worn > 0.0 ? minAngles(sheet) : std::vector<double>{};
    SheetIntegrals sums = liquidUnder(sheet);
    std::fill(damping_.begin(), damping_.end(), 0.0);
    std::fill(held_.begin(), held_.end(), 1);  // until it turns out that they are above the ground
    if (limits.chord == 0.0) {
        factored_held_.clear();
    }
    const auto has_factors = [&](double residual) {
        return !factored_held_.empty() && factored_held_ == held_ && factored_residual_ <= residual;
    };
    bool was_chord = false;
    int shifted = 0;
    double last = std::numeric_limits<double>::infinity();
    for (;; ++result.steps) {
        linearise(sheet);
        std::fill(held_motion_.begin(), held_motion_.end(), 0.0);
        for (std::size_t i = 0; i < held_.size(); ++i) {
            // Vertices on the ground are held while the energy presses them down.
            const auto k = static_cast<Eigen::Index>(i);
            if (held_[i] != 0) {
                held_motion_[i] = -linear_.clearance[i] / linear_.rise[i];
                if (linear_.rise[i] * (linear_.gradient[k] - pressure * linear_.volume[k]) <= 0.0) {
                    held_[i] = 0;
                }
            }
        }
        result.residual = residual(pressure);
        const double missing = volume - sums.volume;
        const bool is_full = std::abs(missing) <= 1e-10 * volumeScale(volume);
        const double area = linear_.mass.sum();
        const double least = 0.05 * std::max(pressure * pressure, 4.0 * std::numbers::pi / area);
        const bool is_done = is_full && (result.residual <= limits.tolerance ||
                                         (result.residual <= limits.stagnated && result.residual > 0.3 * last));
        if (is_done) {
            std::fill(damping_.begin(), damping_.end(), 0.0);
            if (!has_factors(limits.chord > 0.0 ? kChordPlace : kSamePlace)) {
                assemble(sheet, pressure);
                factored_held_.clear();
                if (!factor(0.0) || negatives() != 1) {
                    return result;
                }
                factored_held_ = held_;
                factored_residual_ = result.residual;
            }
            describe(result);
            return result;
        }
        if (result.steps >= limits.steps || result.factorisations >= limits.factorisations || !has_work()) {
            return result;
        }
        const bool may_chord = result.residual <= limits.chord && has_factors(kChordPlace) &&
                               (!was_chord || result.residual <= kChordRate * last);
        last = is_full ? result.residual : last;
        for (double& damping : damping_) {
            damping = kReleased * damping < kUndamped ? 0.0 : kReleased * damping;
        }

        std::optional<Step> step = may_chord ? chord(sheet, pressure, missing) : std::nullopt;
        was_chord = step.has_value();
        if (!was_chord) {
            assemble(sheet, pressure);
            factored_held_.clear();
        }
        bool is_plain = true;  // without shift and damping
        int damped = 0;
        for (int round = 0; !was_chord; ++round) {
            double shift = 0.0;
            for (++result.factorisations; !factor(shift) || negatives() != 1; ++result.factorisations) {
                shift = shift == 0.0 ? least : 3.0 * shift;
                if (shift > 1e12 * least || !has_work()) {
                    return result;
                }
            }
            shifted += shift > 0.0 && round == 0 ? 1 : 0;
            is_plain = shift == 0.0 && std::all_of(damping_.begin(), damping_.end(), [](double d) { return d == 0.0; });
            const Vector forces = pressure * linear_.volume - linear_.gradient;
            step = solveBordered(forces, missing);
            if (!step->motion.allFinite()) {
                return result;
            }
            const bool has_changed = changeHeld(*step, forces, round < kReleaseRounds);
            if (!has_work()) {
                return result;
            }
            if (has_changed && round < kGroundRounds) {
                continue;
            }
            if (damped++ == kDampingRounds || !damp(sheet, *step)) {
                break;
            }
        }
        if (!was_chord && is_plain) {
            factored_held_ = held_;
            factored_residual_ = result.residual;
        }
        const bool has_moved = shifted <= limits.shifted_steps && moveWithin(sheet, *step, volume, sums);
        if (!has_moved || !has_work()) {
            return result;
        }
        pressure += step->pressure;
        if (limits.worn > 0.0 && isWorn(angles, sheet, limits.worn)) {
            return result;
        }
    }
}

}  // namespace droplet
