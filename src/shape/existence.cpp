// SPDX-License-Identifier: GPL-3.0-or-later
//
// A sheet over a footprint is upright where the flux through its rim reaches 1: R. Finn, "Equilibrium Capillary
// Surfaces" (1986), chapter 1. At the tip of a corner that points into the liquid it always does.

#include "shape/existence.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>

#include "droplet/units.h"
#include "shape/cap.h"
#include "shape/hanging.h"
#include "shape/puddle.h"
#include "shape/work.h"

namespace droplet {
namespace {

double bondNumber(const Energy& energy, double weight)
{
    return std::abs(weight) * energy.area() / std::numbers::pi;
}

/// Piece of rim.
struct RimPiece {
    double flux = 0.0;    ///< sine of its contact angle
    double length = 0.0;  ///< [m]
};

/// Angle that a share of some pieces exceeds.
double angleExceededBy(std::vector<RimPiece> pieces, double share)
{
    if (pieces.empty()) {
        return 0.0;
    }
    std::sort(pieces.begin(), pieces.end(), [](const RimPiece& a, const RimPiece& b) { return a.flux > b.flux; });
    double left = share * std::accumulate(pieces.begin(), pieces.end(), 0.0,
                                          [](double sum, const RimPiece& piece) { return sum + piece.length; });
    auto steepest = pieces.begin();
    for (; left > steepest->length && steepest + 1 != pieces.end(); ++steepest) {
        left -= steepest->length;
    }
    return std::asin(std::clamp(steepest->flux, -1.0, 1.0));
}

/// Steepness of the rim: the angle that a fiftieth of it exceeds, without bends into the liquid, or a tenth of all of
/// it. Tips of corners that point into the liquid are always upright; in bends this depends on the size of the bend.
double steepestAngle(const Member& member)
{
    constexpr double kShare = 0.02;
    constexpr double kShareWithBends = 0.1;
    constexpr int kSmoothingPasses = 8;  // so that no single vertex decides
    constexpr std::uint32_t kReach = 5;  // vertices on either side that define a bend
    constexpr double kStraight = 0.02;   // sine of the turn between them
    const PlanarMesh& mesh = member.energy->mesh();
    const std::vector<double>& weights = member.energy->rimWeights();
    std::vector<double> forces = weights;
    for (std::size_t v = 0; v < forces.size(); ++v) {
        forces[v] *= member.sheet->flux[v];
    }
    forces = member.energy->smoothed(std::move(forces), kSmoothingPasses);
    const std::vector<double> lengths = member.energy->smoothed(weights, kSmoothingPasses);
    std::vector<RimPiece> all;
    std::vector<RimPiece> straight;
    for (std::size_t loop = 0; loop < mesh.loopCount(); ++loop) {
        const std::uint32_t first = mesh.loop_starts[loop];
        const std::uint32_t count = mesh.loop_starts[loop + 1] - first;
        const std::uint32_t reach = std::min(kReach, (count - 1) / 2);
        for (std::uint32_t i = 0; i < count; ++i) {
            const Vec2 here = mesh.vertices[first + i];
            const Vec2 in = here - mesh.vertices[first + (i + count - reach) % count];
            const Vec2 out = mesh.vertices[first + (i + reach) % count] - here;
            const RimPiece piece{forces[first + i] / lengths[first + i], weights[first + i]};
            all.push_back(piece);
            // Liquid lies on the left, so a bend into it turns right.
            if (cross(in, out) > -kStraight * length(in) * length(out)) {
                straight.push_back(piece);
            }
        }
    }
    return std::max(angleExceededBy(std::move(straight), kShare), angleExceededBy(std::move(all), kShareWithBends));
}

/// Tolerance of a linear solution from which Newton's method starts.
constexpr double kStartTolerance = 1e-4;

/// Mean angle at which the linear and the exact model are close.
constexpr double kStartAngle = 20.0 * kDegree;

/// Largest angle that fluxes give to some tenths of a degree. Volumes of steeper sheets are extrapolated.
constexpr double kReliableAngle = 88.5 * kDegree;

/// Volume and steepness of a sheet.
struct Waypoint {
    double volume = 0.0;  ///< [m³]
    double angle = 0.0;   ///< [rad]
};

/// Volume at which the rim is upright, extrapolated through four waypoints: the volume is a smooth function of the
/// angle.
double uprightVolume(const std::array<Waypoint, 4>& way)
{
    constexpr double kUpright = 90.0 * kDegree;
    double volume = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
        double weight = 1.0;
        for (std::size_t j = 0; j < 4; ++j) {
            weight *= i == j ? 1.0 : (kUpright - way[j].angle) / (way[i].angle - way[j].angle);
        }
        volume += weight * way[i].volume;
    }
    return volume;
}

class Search {
public:
    Search(const std::vector<Member>& members, const SolveOptions& options, const std::function<void(double)>& reached)
        : members_(&members), options_(&options), report_(&reached)
    {
        std::vector<const PlanarMesh*> meshes;
        meshes.reserve(members.size());
        for (const Member& member : members) {
            meshes.push_back(&member.energy->mesh());
        }
        max_height_ = maxHeight(meshes, options);
    }

    Outcome run()
    {
        search();
        outcome_.work = work_;
        return outcome_;
    }

private:
    void search()
    {
        if (!settleLinear(linearFill(options_->fill))) {
            checkStability();
            return;
        }
        if (options_->model == Model::Linear) {
            outcome_.termination = Termination::Converged;
            return;
        }
        outcome_.iterations = 0;
        use(Model::Exact);
        // If this fails, half of the work is left for raising the volume.
        max_work_ = 0.5 * maxWork();
        const bool settled = settleExact(options_->fill) && steepest() < kReliableAngle;
        max_work_ = maxWork();
        if (settled || raiseVolume()) {
            outcome_.termination = Termination::Converged;
        } else if (isOutOfSteps()) {
            outcome_.termination = Termination::OutOfSteps;
            outcome_.largest_volume = reached_;
        }
    }

    [[nodiscard]] std::size_t stepsLeft() const
    {
        return options_->max_newton_steps - std::min(outcome_.newton_steps, options_->max_newton_steps);
    }

    [[nodiscard]] double maxWork() const
    {
        std::size_t unknowns = 0;
        for (const Member& member : *members_) {
            unknowns += unknownsOf(member.energy->mesh());
        }
        return options_->max_work.value_or(fieldWork(unknowns));
    }

    [[nodiscard]] bool isOutOfSteps() const { return stepsLeft() == 0 || work_ >= max_work_; }

    void use(Model model) const
    {
        for (const Member& member : *members_) {
            member.energy->use(model);
        }
    }

    /// Fill of the linear model that gives about the same volume as the exact one.
    [[nodiscard]] Fill linearFill(Fill fill) const
    {
        if (options_->model == Model::Exact && fill.by == FillBy::ContactAngle) {
            fill.amount = linearAngleOfCap(fill.amount);
        }
        return fill;
    }

    bool settleLinear(const Fill& fill)
    {
        constexpr double kFaster = 4.0;  // a system costs less than a step of the exact model
        SettleOptions options{.fill = fill, .max_height = max_height_, .max_work = kFaster * maxWork()};
        if (options_->model == Model::Exact) {
            options.linear_tolerance = kStartTolerance;
        }
        const Settled settled = settle(*members_, options);
        outcome_.iterations = settled.iterations;
        outcome_.residual = settled.residual;
        outcome_.newton_steps = options_->model == Model::Linear ? settled.newton_steps : 0;
        if (!settled.stable) {
            const auto area = [](const Member& member) { return member.energy->area(); };
            const auto largest = std::max_element(members_->begin(), members_->end(),
                                                  [&](const Member& a, const Member& b) { return area(a) < area(b); });
            refuseAsUnstable(static_cast<std::size_t>(largest - members_->begin()), criticalSharedWeight(*members_));
        }
        return settled.converged;
    }

    bool settleExact(const Fill& fill)
    {
        SettleOptions options{.fill = fill, .max_height = max_height_};
        options.max_steps = std::min(options.max_steps, stepsLeft());
        options.max_work = max_work_ - work_;
        const Settled settled = settle(*members_, options);
        outcome_.residual = settled.residual;
        outcome_.newton_steps += settled.newton_steps;
        work_ += settled.work;
        outcome_.iterations = outcome_.newton_steps;
        return settled.converged;
    }

    void refuseAsUnstable(std::size_t member, double critical_weight)
    {
        const Energy& energy = *(*members_)[member].energy;
        outcome_.termination = Termination::Unstable;
        outcome_.failed_member = member;
        outcome_.bond_number = bondNumber(energy, energy.physics().normal);
        outcome_.critical_bond_number = bondNumber(energy, critical_weight);
    }

    /// Looks for a droplet that falls off at any volume.
    void checkStability()
    {
        for (std::size_t k = 0; k < members_->size() && outcome_.termination != Termination::Unstable; ++k) {
            const Member& member = (*members_)[k];
            const double weight = -member.energy->physics().normal;
            if (weight > 0.0) {
                const double critical = criticalWeight(*member.energy, Operator{}, *member.solver);
                if (weight >= critical) {
                    refuseAsUnstable(k, critical);
                }
            }
        }
    }

    /// Steepest angle of all members. This member fails first.
    double steepest()
    {
        double angle = -1.0;
        for (std::size_t k = 0; k < members_->size(); ++k) {
            const double here = steepestAngle((*members_)[k]);
            if (here > angle) {
                angle = here;
                outcome_.failed_member = k;
            }
        }
        return angle;
    }

    [[nodiscard]] std::vector<Sheet> sheets() const
    {
        std::vector<Sheet> copies;
        for (const Member& member : *members_) {
            copies.push_back(*member.sheet);
        }
        return copies;
    }

    void restore(const std::vector<Sheet>& sheets) const
    {
        for (std::size_t k = 0; k < sheets.size(); ++k) {
            *(*members_)[k].sheet = sheets[k];
        }
    }

    [[nodiscard]] double volume() const
    {
        return std::accumulate(members_->begin(), members_->end(), 0.0,
                               [](double sum, const Member& member) { return sum + member.sheet->volume; });
    }

    /// Height or angle over what the fill allows.
    [[nodiscard]] double shareOfAmount() const
    {
        const Fill& wanted = options_->fill;
        const double share = amountOf(*members_, wanted.by) / wanted.amount;
        return max_height_ ? std::max(share, amountOf(*members_, FillBy::Height) / *max_height_) : share;
    }

    /// Solves for a volume at which no rim is upright, the start of raiseVolume().
    bool settleSmallVolume()
    {
        constexpr int kMaxHalvings = 20;
        use(Model::Linear);
        for (const Member& member : *members_) {
            *member.sheet = emptySheet(*member.energy);
        }
        const Fill& wanted = options_->fill;
        const Fill gentle{FillBy::ContactAngle, kStartAngle, wanted.sharing};
        const Settled start = settle(*members_, {.fill = gentle, .max_height = max_height_});
        use(Model::Exact);
        double small = wanted.by == FillBy::Volume ? std::min(volume(), wanted.amount) : volume();
        bool settled = start.converged && settleExact({FillBy::Volume, small, wanted.sharing});
        // Liquid that leaves ground dry stands upright elsewhere at small mean angles, too.
        for (int k = 0; k < kMaxHalvings && settled && steepest() >= kReliableAngle; ++k) {
            small *= 0.5;
            settled = settleExact({FillBy::Volume, small, wanted.sharing});
        }
        return settled;
    }

    /// Raises the volume from small values to the fill.
    bool raiseVolume()
    {
        if (!settleSmallVolume()) {
            return false;
        }
        constexpr int kMaxTries = 80;
        constexpr double kCloseEnough = 1e-2;  // relative to the last volume; the rest is extrapolated
        const Fill& wanted = options_->fill;
        const bool by_volume = wanted.by == FillBy::Volume;
        double here = volume();
        double before = here;
        std::vector<Sheet> good = sheets();
        std::optional<double> too_much;
        bool upright = false;
        for (int k = 0; k < kMaxTries && !isOutOfSteps(); ++k) {
            reached_ = here;
            const double share = by_volume ? here / wanted.amount : shareOfAmount();
            if (*report_) {
                (*report_)(std::clamp(share, 0.0, 1.0));
            }
            if (share >= 1.0) {
                return by_volume || settleExact(wanted) || searchVolume(before, here);
            }
            if (too_much && *too_much - here <= kCloseEnough * here) {
                break;
            }
            double next = too_much ? std::sqrt(here * *too_much) : 1.5 * here;
            next = by_volume ? std::min(next, wanted.amount) : next;
            const bool found = settleExact({FillBy::Volume, next, wanted.sharing});
            if (found && steepest() < kReliableAngle) {
                before = here;
                here = next;
                good = sheets();
            } else {
                upright = found;
                too_much = next;
                restore(good);
            }
        }
        outcome_.largest_volume = upright ? extrapolateUprightVolume(here) : here;
        restore(good);
        // A solution may exist between the last sheet with a reliable angle and the upright one.
        if (upright && (!by_volume || wanted.amount <= outcome_.largest_volume) && settleExact(wanted) &&
            volume() <= outcome_.largest_volume) {
            return true;
        }
        outcome_.termination = Termination::NoHeightField;
        return false;
    }

    /// Meets the fill by a search for the volume between two: the first is too small, the second large enough. Uses the
    /// Illinois variant of regula falsi, which needs no derivative.
    bool searchVolume(double low, double high)
    {
        constexpr int kMaxTries = 60;
        constexpr double kAccuracy = 1e-9;
        const Fill& wanted = options_->fill;
        const auto excess = [&](double volume) -> std::optional<double> {
            if (!settleExact({FillBy::Volume, volume, wanted.sharing})) {
                return std::nullopt;
            }
            return shareOfAmount() - 1.0;
        };
        std::optional<double> at_high = excess(high);
        std::optional<double> at_low = excess(low);
        for (int k = 0; k < kMaxTries && at_low && at_high; ++k) {
            const double middle = low + (high - low) * *at_low / (*at_low - *at_high);
            const std::optional<double> here = excess(middle);
            if (!here) {
                return false;
            }
            if (std::abs(*here) <= kAccuracy) {
                return true;
            }
            if (*here < 0.0) {
                low = middle;
                at_low = here;
                *at_high *= 0.5;
            } else {
                high = middle;
                at_high = here;
                *at_low *= 0.5;
            }
        }
        return false;
    }

    /// Volume at which the rim is upright, extrapolated from sheets of smaller volumes than now.
    double extrapolateUprightVolume(double now)
    {
        constexpr double kFarthest = 1.25;  // on a disc the ratio from 88.5° to 90° is far smaller
        std::array<Waypoint, 4> way;
        const std::array<double, 4> parts{0.8, 0.7, 0.6, 0.5};
        for (std::size_t i = 0; i < 4; ++i) {
            if (!settleExact({FillBy::Volume, parts[i] * now, options_->fill.sharing})) {
                return now;
            }
            way[i] = {parts[i] * now, steepest()};
        }
        return way[0].angle > way[1].angle && way[1].angle > way[2].angle && way[2].angle > way[3].angle
                   ? std::clamp(uprightVolume(way), now, kFarthest * now)
                   : now;
    }

    const std::vector<Member>* members_;
    const SolveOptions* options_;
    const std::function<void(double)>* report_;
    std::optional<double> max_height_;  ///< as in SettleOptions [m]
    Outcome outcome_;
    double work_ = 0.0;      ///< work done by the exact model
    double max_work_ = 0.0;  ///< limit for it at present
    double reached_ = 0.0;   ///< largest volume that raiseVolume() reached [m³]
};

}  // namespace

Outcome findEquilibrium(const std::vector<Member>& members, const SolveOptions& options,
                        const std::function<void(double)>& reached)
{
    return Search(members, options, reached).run();
}

}  // namespace droplet
