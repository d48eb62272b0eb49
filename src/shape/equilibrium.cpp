// SPDX-License-Identifier: GPL-3.0-or-later
//
// Newton's method on the energy with the fill as a constraint. The systems leave out the rows of the rim; these give
// the flux through it: G. F. Carey, "Derivative calculation from finite element solutions" (1982). Contact with the
// ground: the primal–dual active set of M. Hintermüller, K. Ito, K. Kunisch, "The primal-dual active set strategy as a
// semismooth Newton method" (2002), on the quadratic problem of every step. So all sheets of the line search are above
// the ground.

#include "shape/equilibrium.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "blocks.h"
#include "droplet/error.h"
#include "number_text.h"
#include "shape/hanging.h"

namespace droplet {
namespace {

/// Tolerances of linear systems: for a first Newton step, and for the result.
constexpr double kLooseTolerance = 1e-2;
constexpr double kTightTolerance = 1e-10;

/// Residuals of Newton's method that may be due to round-off.
constexpr double kStuckResidual = 1e-7;

/// Cost of a step besides its linear systems, in iterations of these.
constexpr double kStepWork = 16.0;

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

/// Newton step of one droplet, affine in the volume it gains.
struct Step {
    std::vector<double> base;       ///< change of the inner heights at no gain [m]; empty: 0
    std::vector<double> rise;       ///< change per volume gained [1/m²]; empty if the volume stays
    double pressure = 0.0;          ///< λ/σ after the step at no gain [1/m]
    double pressure_rise = 0.0;     ///< change per volume gained [1/m⁴]
    std::vector<double> flux;       ///< flux through the rim after the step at no gain
    std::vector<double> flux_rise;  ///< change per volume gained [1/m³]
    std::optional<double> loss;     ///< volume that is lost if all vertices are held [m³]
    bool converged = true;
    std::size_t iterations = 0;
    double residual = 0.0;
};

/// A number and its derivative.
struct Jet {
    double value = 0.0;
    double derivative = 0.0;
};

/// Argument at which an increasing function has a value, by Newton's method inside a bracket that bisection keeps.
/// @param scale   distance over which the function changes
/// @return        empty if the value is farther than 2⁶⁰ scales away
std::optional<double> solveIncreasing(const std::function<Jet(double)>& f, double wanted, double start, double scale)
{
    Jet at = f(start);
    const double side = at.value < wanted ? 1.0 : -1.0;
    double near = start;
    double far = start;
    for (int k = 0; side * (wanted - at.value) > 0.0; ++k) {
        if (k == 60 || !std::isfinite(at.value)) {
            return std::nullopt;
        }
        near = far;
        far = start + side * scale * std::ldexp(1.0, k);
        at = f(far);
    }
    double low = std::min(near, far);
    double high = std::max(near, far);
    double x = far;
    for (int k = 0; k < 200; ++k) {
        if (at.value == wanted) {
            return x;
        }
        (at.value < wanted ? low : high) = x;
        const double newton = x + (wanted - at.value) / at.derivative;
        const bool inside = newton > low && newton < high;
        const double next = inside ? newton : 0.5 * (low + high);
        if (std::abs(next - x) <= 2.0 * kEpsilon * std::max(std::abs(x), std::abs(scale))) {
            return next;
        }
        x = next;
        at = f(x);
    }
    return x;
}

std::uint32_t rimOf(const Member& member)
{
    return member.energy->mesh().rimVertexCount();
}

double thickness(const Member& member, std::size_t vertex)
{
    const std::vector<double>& ground = member.energy->ground();
    return member.sheet->height[vertex] - (ground.empty() ? 0.0 : ground[vertex]);
}

/// Largest thickness after a step with a gain of volume.
Jet heightAt(const Member& member, const Step& step, double gain)
{
    const std::uint32_t rim = rimOf(member);
    const std::size_t inner = member.sheet->height.size() - rim;
    const std::vector<Jet> blocks = mapBlocks<Jet>(inner, [&](std::size_t begin, std::size_t end) {
        Jet best{-std::numeric_limits<double>::infinity(), 0.0};
        for (std::size_t i = begin; i < end; ++i) {
            const double here =
                thickness(member, rim + i) + (step.base.empty() ? 0.0 : step.base[i]) + gain * step.rise[i];
            if (here > best.value) {
                best = {here, step.rise[i]};
            }
        }
        return best;
    });
    return *std::max_element(blocks.begin(), blocks.end(),
                             [](const Jet& a, const Jet& b) { return a.value < b.value; });
}

/// Mean contact angle after a step with a gain of volume, times the length of the rim.
Jet angleAt(const Member& member, const Step& step, double gain)
{
    Jet sum;
    const std::vector<double>& weights = member.energy->rimWeights();
    for (std::uint32_t v = 0; v < weights.size(); ++v) {
        const auto [angle, derivative] = member.energy->contactAngle(v, step.flux[v] + gain * step.flux_rise[v]);
        sum.value += weights[v] * angle;
        sum.derivative += weights[v] * derivative * step.flux_rise[v];
    }
    return sum;
}

/// Distribution of a gain of volume among members.
struct Shares {
    std::vector<Jet> gains;  ///< gain of each member, and its derivative by the total gain
    double pressure = 0.0;   ///< common λ/σ [1/m]
};

Shares sharesOf(const std::vector<Step>& steps, double gain)
{
    if (steps.size() == 1) {
        return {{{gain, 1.0}}, steps[0].pressure + gain * steps[0].pressure_rise};
    }
    // At a common pressure p a member gains (p − its pressure) / its rise.
    double compliance = 0.0;
    double offset = 0.0;
    for (const Step& step : steps) {
        if (step.loss) {
            gain += *step.loss;
        } else {
            compliance += 1.0 / step.pressure_rise;
            offset += step.pressure / step.pressure_rise;
        }
    }
    Shares shares;
    shares.pressure = (gain + offset) / compliance;
    for (const Step& step : steps) {
        shares.gains.push_back(step.loss ? Jet{-*step.loss, 0.0}
                                         : Jet{(shares.pressure - step.pressure) / step.pressure_rise,
                                               1.0 / (step.pressure_rise * compliance)});
    }
    return shares;
}

/// Largest thickness of all members, or mean angle along all rims.
Jet amountAt(const std::vector<Member>& members, const std::vector<Step>& steps, FillBy by, double gain)
{
    const std::vector<Jet> shares = sharesOf(steps, gain).gains;
    Jet total;
    double rim_length = 0.0;
    for (std::size_t k = 0; k < members.size(); ++k) {
        const Jet part = by == FillBy::Height ? heightAt(members[k], steps[k], shares[k].value)
                                              : angleAt(members[k], steps[k], shares[k].value);
        const double derivative = part.derivative * shares[k].derivative;
        if (by == FillBy::ContactAngle) {
            rim_length += members[k].energy->rimLength();
            total = {total.value + part.value, total.derivative + derivative};
        } else if (k == 0 || part.value > total.value) {
            total = {part.value, derivative};
        }
    }
    return by == FillBy::ContactAngle ? Jet{total.value / rim_length, total.derivative / rim_length} : total;
}

/// Amount of a step, and the accuracy of its linear systems.
struct StepOptions {
    Fill fill;
    std::optional<double> max_height;  ///< as in SettleOptions
    double tolerance = 1e-10;          ///< of linear systems
    double max_work = std::numeric_limits<double>::infinity();
};

/// Gain of volume that meets the fill, if there is one: the smaller one of those for the angle and the height.
std::optional<double> gainFor(const std::vector<Member>& members, const std::vector<Step>& steps,
                              const StepOptions& options)
{
    const Fill& fill = options.fill;
    double volume = 0.0;
    double footprint = 0.0;
    for (const Member& member : members) {
        volume += member.sheet->volume;
        footprint += member.energy->area();
    }
    if (fill.by == FillBy::Volume) {
        return fill.amount - volume;
    }
    // The order of magnitude of a droplet's volume on that footprint.
    const double scale = 1e-3 * std::pow(footprint, 1.5);
    const auto gain_to = [&](FillBy by, double amount) {
        return solveIncreasing([&](double g) { return amountAt(members, steps, by, g); }, amount, 0.0, scale);
    };
    const std::optional<double> gain = gain_to(fill.by, fill.amount);
    const bool is_low = !options.max_height || fill.by != FillBy::ContactAngle ||
                        (gain && amountAt(members, steps, FillBy::Height, *gain).value <= *options.max_height);
    return is_low ? gain : gain_to(FillBy::Height, *options.max_height);
}

[[noreturn]] void refuse(const Fill& fill)
{
    // Rim pieces in sharp corners steepen slowly, so the mean angle may stay small up to a large volume.
    throw Error(ErrorCode::NoSuchDroplet, fill.by == FillBy::Height
                                              ? "no volume gives a droplet of that height on this footprint"
                                              : "no volume gives a mean contact angle of " +
                                                    numberText(fill.amount / kDegree) +
                                                    " degrees on this footprint; ask for a smaller contact angle");
}

bool preventsPenetration(const std::vector<Member>& members)
{
    return members.front().energy->physics().no_penetration;
}

bool isVolumeOfOne(const std::vector<Member>& members, const Fill& fill)
{
    return members.size() == 1 && fill.by == FillBy::Volume;
}

/// Flux through the rim that balances the rows of the rim, λm − ∂E/∂u.
std::vector<double> fluxThroughRim(const Member& member, double pressure, const std::vector<double>& gradient)
{
    std::vector<double> forces(rimOf(member));
    for (std::size_t v = 0; v < forces.size(); ++v) {
        forces[v] = pressure * member.energy->load()[v] - gradient[v];
    }
    return member.energy->fluxOf(forces);
}

/// Step that leaves all ground of a member dry.
Step dryStep(const Member& member)
{
    const std::uint32_t rim = rimOf(member);
    Step step;
    for (std::size_t v = rim; v < member.sheet->height.size(); ++v) {
        step.base.push_back(-thickness(member, v));
    }
    step.rise.assign(step.base.size(), 0.0);
    step.flux.assign(rim, 0.0);
    step.flux_rise.assign(rim, 0.0);
    step.loss = member.sheet->volume;
    return step;
}

/// Newton step of one member from its sheet. The held vertices of `op` move to the ground.
Step stepOf(const Member& member, const Operator& op, const std::vector<double>& gradient, bool with_rise,
            double tolerance)
{
    const Energy& energy = *member.energy;
    const std::uint32_t rim = rimOf(member);
    const std::size_t inner = energy.mesh().vertices.size() - rim;
    Step step;
    if (!op.held.empty() && std::find(op.held.begin(), op.held.end(), std::uint8_t{0}) == op.held.end()) {
        return dryStep(member);
    }
    const auto take = [&](const ConstrainedSolution& solution) {
        step.converged = step.converged && solution.converged;
        step.iterations = std::max(step.iterations, solution.iterations);
        step.residual = std::max(step.residual, solution.residual);
    };
    if (!gradient.empty()) {
        ConstrainedProblem problem;
        problem.tolerance = tolerance;
        problem.right.resize(inner);
        // The unknown is the change of the pressure, so the right side is as small as the remaining error.
        const double pressure = member.sheet->pressure;
        for (std::size_t i = 0; i < inner; ++i) {
            problem.right[i] = pressure * energy.load()[rim + i] - gradient[rim + i];
        }
        std::vector<double> down;  // change of held vertices, to the ground
        if (!op.held.empty()) {
            down.assign(energy.mesh().vertices.size(), 0.0);
            for (std::size_t i = 0; i < inner; ++i) {
                if (op.held[i] != 0) {
                    down[rim + i] = -thickness(member, rim + i);
                    problem.volume -= down[rim + i] * energy.load()[rim + i];
                }
            }
            const std::vector<double> pull = energy.applied(op, down);
            for (std::size_t i = 0; i < inner; ++i) {
                problem.right[i] -= pull[rim + i];
            }
        }
        ConstrainedSolution solution = member.solver->solve(problem);
        take(solution);
        if (!step.converged) {
            return step;
        }
        step.pressure = member.sheet->pressure + solution.multiplier;
        step.base = std::move(solution.values);
        for (std::size_t i = 0; i < inner && !down.empty(); ++i) {
            step.base[i] += down[rim + i];
        }
    }
    if (with_rise) {
        ConstrainedSolution solution = member.solver->solve({{}, 1.0, tolerance});
        take(solution);
        if (!step.converged) {
            return step;
        }
        step.pressure_rise = solution.multiplier;
        step.rise = std::move(solution.values);
        step.flux_rise = fluxThroughRim(member, step.pressure_rise, energy.appliedOnRim(op, step.rise));
    }
    step.flux.assign(rim, 0.0);
    if (!gradient.empty()) {
        std::vector<double> after = energy.appliedOnRim(op, step.base);
        for (std::uint32_t v = 0; v < rim; ++v) {
            after[v] += gradient[v];
        }
        step.flux = fluxThroughRim(member, step.pressure, after);
    }
    for (const std::uint32_t v : energy.dryRim(op.held)) {
        step.flux[v] = energy.groundFlux(v);
        if (with_rise) {
            step.flux_rise[v] = 0.0;
        }
    }
    return step;
}

/// Change of a member's heights at all vertices.
std::vector<double> changeOf(const Member& member, const Step& step, double gain)
{
    std::vector<double> change(member.sheet->height.size(), 0.0);
    const std::uint32_t rim = rimOf(member);
    forBlocks(change.size() - rim, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            change[rim + i] =
                (step.base.empty() ? 0.0 : step.base[i]) + (step.rise.empty() ? 0.0 : gain * step.rise[i]);
        }
    });
    return change;
}

void addChange(std::vector<double>& height, const std::vector<double>& change)
{
    forBlocks(height.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t v = begin; v < end; ++v) {
            height[v] += change[v];
        }
    });
}

/// Inner vertices that the ground should hold: held ones that it pushes up, and free ones that sank into it.
std::vector<std::uint8_t> heldAfter(const Member& member, const Operator& op, const std::vector<double>& gradient,
                                    const std::vector<double>& change, double pressure)
{
    const Energy& energy = *member.energy;
    const std::uint32_t rim = rimOf(member);
    const std::size_t inner = change.size() - rim;
    const bool any = !op.held.empty();
    const std::vector<double> pull = any ? energy.applied(op, change) : std::vector<double>{};
    std::vector<std::uint8_t> held(inner, 0);
    bool some = false;
    for (std::size_t i = 0; i < inner; ++i) {
        const std::size_t v = rim + i;
        if (any && op.held[i] != 0) {
            held[i] = (gradient.empty() ? 0.0 : gradient[v]) + pull[v] - pressure * energy.load()[v] > 0.0 ? 1 : 0;
        } else {
            held[i] = thickness(member, v) + change[v] < 0.0 ? 1 : 0;
        }
        some = some || held[i] != 0;
    }
    return some ? held : std::vector<std::uint8_t>{};
}

/// Vertices held in either of two sets.
std::vector<std::uint8_t> united(std::vector<std::uint8_t> a, const std::vector<std::uint8_t>& b)
{
    if (a.empty()) {
        return b;
    }
    for (std::size_t i = 0; i < b.size(); ++i) {
        a[i] = std::max(a[i], b[i]);
    }
    return a;
}

/// One Newton step of all members together.
struct Advance {
    std::vector<Operator> operators;
    std::vector<std::vector<double>> changes;  ///< at all vertices [m]
    std::vector<double> pressures;             ///< [1/m]
    std::vector<double> gains;                 ///< [m³]
    std::vector<std::vector<double>> fluxes;   ///< predicted fluxes at rim vertices
    bool converged = true;
    bool stable = true;
    std::size_t iterations = 0;
    double work = 0.0;  ///< as in SolveOptions::max_work
    double residual = 0.0;
};

bool isStable(const std::vector<Step>& steps)
{
    std::vector<double> rises;
    for (const Step& step : steps) {
        if (!step.loss) {
            rises.push_back(step.pressure_rise);
        }
    }
    return shareOnePressure(rises);
}

Advance advanceOf(const std::vector<Member>& members, const std::vector<std::vector<double>>& gradients,
                  const StepOptions& options)
{
    const std::size_t count = members.size();
    Advance advance;
    advance.operators.resize(count);
    for (std::size_t k = 0; k < count; ++k) {
        advance.operators[k] = members[k].energy->hessian(members[k].sheet->height);
        advance.operators[k].held = members[k].sheet->held;
    }
    std::vector<Step> steps(count);
    std::vector<std::uint8_t> changed(count, 1);
    // Sets of held vertices tried so far, to detect cycles.
    std::set<std::vector<std::vector<std::uint8_t>>> tried;
    bool release = true;
    for (;;) {
        const bool with_rise = !isVolumeOfOne(members, options.fill) ||
                               std::abs(options.fill.amount - members[0].sheet->volume) > 1e-13 * options.fill.amount;
        tbb::parallel_for(std::size_t{0}, count, [&](std::size_t k) {
            if (changed[k] != 0) {
                members[k].solver->prepare(advance.operators[k]);
                steps[k] = stepOf(members[k], advance.operators[k], gradients[k], with_rise, options.tolerance);
            }
        });
        for (std::size_t k = 0; k < count; ++k) {
            const Step& step = steps[k];
            advance.converged = advance.converged && step.converged;
            advance.iterations = std::max(advance.iterations, step.iterations);
            advance.residual = std::max(advance.residual, step.residual);
            if (changed[k] != 0) {
                const std::size_t unknowns = members[k].sheet->height.size() - rimOf(members[k]);
                advance.work += std::max(kStepWork * static_cast<double>(unknowns), members[k].solver->prepareWork()) +
                                static_cast<double>(step.iterations) * static_cast<double>(unknowns);
            }
        }
        // The set of held vertices may take many systems to settle.
        advance.converged = advance.converged && advance.work < options.max_work;
        // At least one droplet must keep liquid.
        advance.converged =
            advance.converged && std::any_of(steps.begin(), steps.end(), [](const Step& step) { return !step.loss; });
        advance.stable = count == 1 || isStable(steps);
        if (!advance.converged || !advance.stable) {
            return advance;
        }
        const std::optional<double> gain = with_rise ? gainFor(members, steps, options) : 0.0;
        if (!gain && members.front().energy->physics().model == Model::Linear) {
            refuse(options.fill);
        }
        if (!gain) {
            advance.converged = false;
            return advance;
        }
        const Shares shares = sharesOf(steps, *gain);
        advance.changes.resize(count);
        advance.pressures.resize(count);
        advance.gains.resize(count);
        tbb::parallel_for(std::size_t{0}, count, [&](std::size_t k) {
            advance.gains[k] = shares.gains[k].value;
            advance.pressures[k] = shares.pressure;
            advance.changes[k] = changeOf(members[k], steps[k], shares.gains[k].value);
            changed[k] = 0;
        });
        if (preventsPenetration(members)) {
            std::vector<std::vector<std::uint8_t>> held(count);
            tbb::parallel_for(std::size_t{0}, count, [&](std::size_t k) {
                held[k] =
                    heldAfter(members[k], advance.operators[k], gradients[k], advance.changes[k], advance.pressures[k]);
            });
            // A cycle is due to the tolerance of the systems. After one, no vertex is released any more.
            release = release && tried.insert(held).second;
            bool settled = true;
            for (std::size_t k = 0; k < count; ++k) {
                if (!release) {
                    held[k] = united(std::move(held[k]), advance.operators[k].held);
                }
                changed[k] = held[k] != advance.operators[k].held ? 1 : 0;
                settled = settled && changed[k] == 0;
                advance.operators[k].held = std::move(held[k]);
            }
            if (!settled) {
                continue;
            }
        }
        for (std::size_t k = 0; k < count; ++k) {
            std::vector<double>& flux = advance.fluxes.emplace_back(std::move(steps[k].flux));
            for (std::size_t v = 0; v < flux.size() && !steps[k].flux_rise.empty(); ++v) {
                flux[v] += shares.gains[k].value * steps[k].flux_rise[v];
            }
        }
        return advance;
    }
}

/// ∂E/∂u of every member; empty if it is known to be 0.
std::vector<std::vector<double>> gradientsOf(const std::vector<Member>& members)
{
    std::vector<std::vector<double>> gradients(members.size());
    tbb::parallel_for(std::size_t{0}, members.size(), [&](std::size_t k) {
        const bool empty = members[k].sheet->volume == 0.0 && members[k].sheet->pressure == 0.0;
        if (!(empty && members[k].energy->isLevelAndFlat())) {
            gradients[k] = members[k].energy->gradient(members[k].sheet->height);
        }
    });
    return gradients;
}

/// ‖λm − ∂E/∂u‖ over free vertices, relative to ‖λm‖; if λ is almost 0, to the value for a droplet of that size.
double residualOf(const Member& member, const std::vector<double>& gradient)
{
    const std::vector<double>& load = member.energy->load();
    const std::vector<std::uint8_t>& held = member.sheet->held;
    const std::uint32_t rim = rimOf(member);
    double squares = 0.0;
    double loads = 0.0;
    for (std::size_t v = rim; v < load.size(); ++v) {
        if (held.empty() || held[v - rim] == 0) {
            const double force = member.sheet->pressure * load[v] - gradient[v];
            squares += force * force;
            loads += load[v] * load[v];
        }
    }
    const double pressure = std::max(std::abs(member.sheet->pressure), 1.0 / std::sqrt(member.energy->area()));
    return std::sqrt(squares / loads) / pressure;
}

/// Sheets after a part of a step.
struct Trial {
    std::vector<std::vector<double>> heights;
    std::vector<std::vector<double>> gradients;  ///< ∂E/∂u there
    double part = 1.0;
};

Trial trialAt(const std::vector<Member>& members, const Advance& advance, double part)
{
    Trial trial{std::vector<std::vector<double>>(members.size()), std::vector<std::vector<double>>(members.size()),
                part};
    tbb::parallel_for(std::size_t{0}, members.size(), [&](std::size_t k) {
        std::vector<double>& height = trial.heights[k];
        height = members[k].sheet->height;
        for (std::size_t v = 0; v < height.size(); ++v) {
            height[v] += part * advance.changes[k][v];
        }
        trial.gradients[k] = members[k].energy->gradient(height);
    });
    return trial;
}

/// Derivative of all energies, minus the work of the pressures, along a step.
double slopeAlong(const std::vector<Member>& members, const Advance& advance,
                  const std::vector<std::vector<double>>& gradients)
{
    double slope = 0.0;
    for (std::size_t k = 0; k < members.size(); ++k) {
        const std::vector<double>& load = members[k].energy->load();
        const std::vector<double>& change = advance.changes[k];
        slope += sumOverBlocks(change.size(), [&](std::size_t begin, std::size_t end) {
            double sum = 0.0;
            for (std::size_t v = begin; v < end; ++v) {
                sum += (gradients[k][v] - advance.pressures[k] * load[v]) * change[v];
            }
            return sum;
        });
    }
    return slope;
}

/// Line search along a step. The energy is convex along it, so the slope rises. The search ends where the slope is at
/// most half of the size of the first one.
Trial lineSearch(const std::vector<Member>& members, const Advance& advance,
                 const std::vector<std::vector<double>>& gradients)
{
    constexpr double kEnough = 0.5;
    constexpr int kMaxCuts = 12;
    const double first = slopeAlong(members, advance, gradients);
    Trial trial = trialAt(members, advance, 1.0);
    for (int k = 0; k < kMaxCuts; ++k) {
        const double slope = slopeAlong(members, advance, trial.gradients);
        if (slope <= kEnough * std::abs(first)) {
            break;
        }
        // The zero of a line through both slopes; the part shrinks to a tenth at most.
        trial = trialAt(members, advance, trial.part * std::clamp(first / (first - slope), 0.1, 0.7));
    }
    return trial;
}

/// Applies a part of a step to all of a sheet but its heights, which are up to date.
void apply(const Member& member, const Advance& by, std::size_t k, double part)
{
    Sheet& sheet = *member.sheet;
    sheet.volume += part * by.gains[k];
    sheet.pressure = by.pressures[k];
    sheet.held = by.operators[k].held;
    sheet.flux = by.fluxes[k];
    const std::vector<double>& ground = member.energy->ground();
    const std::uint32_t rim = rimOf(member);
    for (std::size_t i = 0; i < sheet.held.size(); ++i) {
        if (sheet.held[i] != 0 && part == 1.0) {
            sheet.height[rim + i] = ground.empty() ? 0.0 : ground[rim + i];
        }
    }
}

}  // namespace

Sheet emptySheet(const Energy& energy)
{
    Sheet sheet;
    sheet.height = energy.ground();
    sheet.height.resize(energy.mesh().vertices.size(), 0.0);
    return sheet;
}

Settled settle(const std::vector<Member>& members, const SettleOptions& options)
{
    const bool exact = members.front().energy->physics().model == Model::Exact;
    Settled settled;
    std::vector<std::vector<double>> gradients = gradientsOf(members);
    // The set of held vertices can depend on the last digits of a step; with a loose tolerance it cycles.
    const double loose = exact && !preventsPenetration(members) ? kLooseTolerance : kTightTolerance;
    StepOptions step{options.fill, options.max_height, exact ? loose : options.linear_tolerance};
    double min_residual = std::numeric_limits<double>::infinity();
    while (settled.newton_steps < options.max_steps && settled.work < options.max_work) {
        step.max_work = options.max_work - settled.work;
        const Advance next = advanceOf(members, gradients, step);
        ++settled.newton_steps;
        settled.work += next.work;
        settled.iterations = std::max(settled.iterations, next.iterations);
        settled.stable = next.stable;
        if (!next.converged || !next.stable) {
            settled.residual = next.residual;
            return settled;
        }
        if (!exact) {
            for (std::size_t k = 0; k < members.size(); ++k) {
                addChange(members[k].sheet->height, next.changes[k]);
                apply(members[k], next, k, 1.0);
            }
            settled.residual = next.residual;
            settled.converged = true;
            return settled;
        }
        Trial trial = lineSearch(members, next, gradients);
        gradients = std::move(trial.gradients);
        settled.residual = 0.0;
        double volume_error = 0.0;
        for (std::size_t k = 0; k < members.size(); ++k) {
            Sheet& sheet = *members[k].sheet;
            sheet.height = std::move(trial.heights[k]);
            apply(members[k], next, k, trial.part);
            settled.residual = std::max(settled.residual, residualOf(members[k], gradients[k]));
            volume_error = std::max(volume_error, std::abs(next.gains[k]) / std::abs(sheet.volume));
        }
        const bool whole = trial.part == 1.0;
        const bool filled = isVolumeOfOne(members, options.fill) ? whole || !preventsPenetration(members)
                                                                 : whole && volume_error < options.tolerance;
        // With needle triangles round-off is larger; a small residual that no longer falls is accepted.
        const bool stuck = settled.residual < kStuckResidual && settled.residual > 0.5 * min_residual;
        min_residual = std::min(min_residual, settled.residual);
        if ((settled.residual <= options.tolerance || stuck) && filled) {
            settled.converged = true;
            for (std::size_t k = 0; k < members.size(); ++k) {
                Sheet& sheet = *members[k].sheet;
                sheet.flux = fluxThroughRim(members[k], sheet.pressure, gradients[k]);
                for (const std::uint32_t v : members[k].energy->dryRim(sheet.held)) {
                    sheet.flux[v] = members[k].energy->groundFlux(v);
                }
            }
            return settled;
        }
        // The next error is of the order of the square of this one, so a higher accuracy is not needed.
        step.tolerance = std::clamp(0.1 * settled.residual, kTightTolerance, loose);
    }
    return settled;
}

double amountOf(const std::vector<Member>& members, FillBy by)
{
    std::vector<Step> steps(members.size());
    for (std::size_t k = 0; k < members.size(); ++k) {
        steps[k].flux = members[k].sheet->flux;
        steps[k].flux_rise.assign(steps[k].flux.size(), 0.0);
        steps[k].rise.assign(members[k].sheet->height.size() - rimOf(members[k]), 0.0);
        steps[k].pressure_rise = 1.0;
    }
    return amountAt(members, steps, by, 0.0).value;
}

}  // namespace droplet
