// SPDX-License-Identifier: GPL-3.0-or-later
// Continuation in the volume with a tangent predictor and Newton's method as corrector: E. Allgower, K. Georg,
// "Numerical Continuation Methods" (1990). Sheets are stable along the whole path: what is found at its end is what
// liquid does that is slowly poured.
#include "shape/sheet_path.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

#include "shape/sheet_contact.h"
#include "shape/sheet_energy.h"
#include "shape/sheet_limits.h"
#include "shape/sheet_newton.h"
#include "shape/sheet_remesh.h"
#include "shape/work.h"
#include "union_find.h"

namespace droplet {
namespace {

/// Steps of Newton's method after which steps of the volume grow or shrink.
constexpr int kFew = 4;
constexpr int kMany = 7;
constexpr double kGrow = 1.6;
constexpr double kShrink = 0.7;
constexpr double kRefused = 0.4;
/// Growth of the area above which a sheet needs new triangles.
constexpr double kGrowth = 1.25;
/// First step of the volume, in cubes of the radius of a disc as large as the footprint.
constexpr double kFirstPart = 0.02;
/// Cost of new triangles, for each of them, measured from 5000 to 400 000, and of divided ones that are mended.
constexpr double kRemeshWork = 3000.0;
constexpr double kMendWork = 600.0;
/// Factorisations that a sheet on new triangles is worth at least: one with too many for its work is not solved.
constexpr double kLeastFactorisations = 30.0;
/// Work on the final triangles, in factorisations, whatever the way there took.
constexpr double kFinalFactorisations = 80.0;
/// Change of the volume, over it, after which a sheet is confirmed on new triangles once one was refused on them, and
/// number of confirmed ones that are kept.
constexpr double kConfirmed = 0.02;
constexpr std::size_t kFirm = 6;
/// Angle of a triangle that stays, over that when it was made, below which the sheet ends.
constexpr double kKeptWorn = 0.1;
/// Growth of the most work to confirm the end of a path.
constexpr double kConfirmWork = 1.5;
/// Most times that a sheet gets new triangles until it is in equilibrium, while liquid rolls, as over dry ground
/// between the teeth of a comb, or along a slit that it closes, and the relative residual up to which it does: it was
/// 0.03 to 0.3 there, and 1 to 100 where triangles crumpled, which get new ones but once. With 12, 221 of 255
/// silhouettes were made at 90°, with 40 231.
constexpr int kRenewals = 40;
constexpr double kRolling = 1.0;
/// Most reductions of the first volume, to a quarter each: less liquid is nearer to the dry ground, where it is known.
/// Then, as many times, it is doubled, for over rough ground little liquid lies in many puddles.
constexpr int kReductions = 6;
/// Growth of edges when a sheet fails with small ones.
constexpr double kCoarser = 1.6;
/// Change of the pressure by new triangles above which they are not the same liquid, over the pressure or, where that
/// is 0 somewhere on a slope, twice the curvature of a cap as wide as the sheet.
constexpr double kSamePressure = 0.1;
/// Mean angle from which on the rim does not hold the liquid: above by the error of angles on coarse triangles [rad].
constexpr double kNotHeld = 179.8 * std::numbers::pi / 180.0;
/// Share of the rim beside which the sheet lies on the ground, from which on it does not, either.
constexpr double kLaid = 0.95;
/// Fall of the mean angle from its maximum that proves the maximum [rad].
constexpr double kFallen = std::numbers::pi / 180.0;
/// Height over its maximum that proves the maximum.
constexpr double kLower = 0.99;
/// Relative residual, and error of the share, of sheets that are a start for finer triangles, which change them by
/// more.
constexpr double kLoose = 1e-3;
/// Relative residual from which on Newton's method keeps its factors on such a way.
constexpr double kChord = 1e-3;

double heightOf(const CapillarySurface& sheet, const SheetBase& base)
{
    double height = 0.0;
    for (const Vec3& p : sheet.vertices) {
        const double clearance = base.clearance(p);
        height = std::isfinite(clearance) ? std::max(height, clearance) : height;
    }
    return height;
}

/// Equilibrium on the path.
struct State {
    CapillarySurface sheet;
    double pressure = 0.0;  ///< λ over the surface tension [1/m]
    double volume = 0.0;    ///< [m³]
    NewtonResult newton;    ///< how it was reached, and where it leads
};

/// How a sheet near an equilibrium is solved on new triangles.
struct Renewal {
    NewtonLimits limits = kSettling;
    bool is_last = false;  ///< whether it touches itself is asked later
};

/// Place of every vertex after a motion along the tangent, for a change of the volume.
std::vector<Vec3> movedPlaces(const State& state, double size)
{
    std::vector<Vec3> vertices = state.sheet.vertices;
    for (std::size_t v = state.sheet.rimVertexCount(); v < vertices.size(); ++v) {
        vertices[v] = vertices[v] + size * state.newton.tangent[v];
    }
    return vertices;
}

/// Path of one sheet.
class Path {
public:
    Path(const PlanarMesh& footprint, const SheetTarget& target, const SheetOptions& options)
        : target_(target), options_(options), base_(baseOf(footprint, options.ground, options.weight))
    {
        options_.path_edge = std::max(options_.edge, options_.path_edge);
        now_.sheet = newTriangles(drySheet(footprint, options.ground), trianglesOf(options_.path_edge));
        for (Vec3& place : now_.sheet.vertices) {
            place.z = base_.under(place).height;
        }
        const CapillarySurface dry = now_.sheet;
        if (!isSolvable(dry)) {
            work_ = options_.max_work;
            meshed_area_ = integrate(dry, options_.weight).area;
            return;
        }
        use(solverOf(now_.sheet), now_.sheet);
        // The flat sheet is in equilibrium with no liquid, but not where gravity pulls along it, or on other ground.
        const bool is_level = base_.ground.flat() && options_.weight.x == 0.0 && options_.weight.y == 0.0;
        const double most = target_.by == FillBy::Volume ? target_.amount : std::numeric_limits<double>::infinity();
        const double first = kFirstPart * std::pow(meshed_area_ / std::numbers::pi, 1.5);
        const double volume = is_level ? 0.0 : std::min(first, most);
        for (int k = 0; k <= 2 * kReductions && hasWork(); ++k) {
            now_.sheet = dry;
            now_.volume = volume * (k <= kReductions ? std::pow(0.25, k) : std::pow(2.0, k - kReductions));
            if (now_.volume > most) {
                break;
            }
            now_.pressure = is_level ? 0.0 : liftingPressure(dry);
            now_.newton = solver_->solve(now_.sheet, now_.volume, now_.pressure, within(kSettling));
            count(now_, k == 0 ? kRemeshWork : 0.0);
            if (now_.newton.converged || is_level) {
                break;
            }
        }
        firm_ = {now_};
    }

    /// Begins at an equilibrium, and keeps its triangles.
    Path(const CapillarySurface& sheet, double pressure, const SheetTarget& target, Vec3 weight, const SheetBase& base)
        : target_(target),
          options_{weight},
          base_(base),
          now_{sheet, pressure, base.liquidUnder(sheet, weight).volume, {}},
          is_final_(true),
          keeps_triangles_(true)
    {
        options_.min_step = kKeptStep;
        options_.max_work = kKeptWork * factorWork(sheet.triangles.size());
        use(solverOf(now_.sheet), now_.sheet);
        now_.newton = solver_->solve(now_.sheet, now_.volume, now_.pressure, kSettling);
        count(now_);
        firm_ = {now_};
    }

    /// Begins near an equilibrium.
    Path(SheetStart start, const SheetTarget& target, const SheetOptions& options)
        : target_(target),
          options_(options),
          now_{std::move(start.mesh), start.pressure, start.volume, {}},
          is_final_(true)
    {
        options_.max_work = kFinalFactorisations * factorWork(options_.triangles);
        options_.tolerance = start.is_last ? options_.tolerance : kLoose;
        chord_ = kChord;
    }

    /// Leads the start to the target.
    /// @return  none if there is no such equilibrium near
    std::optional<FilledSheet> settled(bool is_last)
    {
        NewtonLimits limits = kSettling;
        limits.tolerance = kLoose;
        RemeshOptions triangles = trianglesOf(options_.edge);
        triangles.triangles = options_.triangles;
        triangles.rounds = 0;
        triangles.mends = true;
        if (!renew(now_, triangles, {limits, true})) {
            return std::nullopt;
        }
        firm_ = {now_};
        const bool has_reached = advance(wayTo()) && settle() && (!is_last || isFree());
        return has_reached ? std::optional(filled(SheetEnd::Reached)) : std::nullopt;
    }

    FilledSheet run()
    {
        SheetEnd end = follow();
        if (keeps_triangles_ || (end != SheetEnd::Reached && !options_.is_end_wanted)) {
            return filled(end);
        }
        options_.max_work *= kConfirmWork;
        const bool is_limit = end == SheetEnd::Unstable || end == SheetEnd::NotHeld;
        if (is_limit && options_.is_end_confirmed && refineFirm()) {
            end = follow();
        }
        if (end == SheetEnd::NoAngle || end == SheetEnd::NoHeight ||
            (options_.is_largest_wanted && end != SheetEnd::Reached)) {
            goBackToLargest();
        }
        const std::optional<SheetContact> contact = contact_;
        if (end != SheetEnd::Reached && now_.newton.converged) {
            options_.max_work *= kConfirmWork;
            // New triangles may bring a sheet that is nearly there beyond the target; then an earlier one is taken.
            bool stands = refine(false);
            for (; wayTo() < 0.0 && firm_.size() > 1; stands = refine(false)) {
                if (stands && settle() && isFree()) {
                    return filled(SheetEnd::Reached);
                }
                firm_.pop_back();
                goBack();
            }
            if (stands && target_.by == FillBy::Volume && now_.volume == target_.amount) {
                return filled(SheetEnd::Reached);
            }
        }
        contact_ = contact;
        return filled(end);
    }

private:
    static constexpr int kMaxSteps = 400;
    static constexpr int kMaxSettling = 8;

    [[nodiscard]] FilledSheet filled(SheetEnd end) const
    {
        return {now_.sheet,
                now_.pressure,
                now_.volume,
                heightOf(now_.sheet, base_),
                rimAngles(now_.sheet, options_.weight, now_.pressure, base_.ground).mean(),
                end,
                end == SheetEnd::Contact ? std::optional(contact_->place) : std::nullopt,
                newton_steps_,
                work_,
                now_.newton.residual};
    }

    /// Follows the path up to the target, or to its end.
    SheetEnd follow()
    {
        if (!now_.newton.converged) {
            now_.volume = 0.0;
            return hasWork() ? SheetEnd::Unstable : SheetEnd::OutOfWork;
        }
        const double base = meshed_area_;
        const double length_scale = std::sqrt(base / std::numbers::pi);
        double step = keeps_triangles_ ? std::abs(wayTo()) : kFirstPart * length_scale * length_scale * length_scale;
        double largest = 0.0;
        double barrier = -1.0;  // volume that was refused; up to it steps do not grow again
        int settled = 0;
        for (int k = 0; k < kMaxSteps && hasWork(); ++k) {
            const double left = wayTo();
            bool is_refused = false;
            double tried = std::abs(left);
            if (tried <= 1e-12 * std::max(now_.volume, 1e-300) || settled > kMaxSettling) {
                tried = now_.volume - firm_.back().volume;
                if (keeps_triangles_ ? isFree() : refine(true)) {
                    return SheetEnd::Reached;
                }
                is_refused = true;
            } else {
                const double size = gentle(tried <= step ? left : std::copysign(step, left));
                const bool is_last = size == left;
                tried = std::abs(size);
                is_refused = !advance(size);
                if (!is_refused && is_last) {
                    ++settled;
                    if (target_.by == FillBy::Volume) {
                        now_.volume = target_.amount;
                    }
                } else if (!is_refused) {
                    const int steps = now_.newton.steps;
                    const bool may_grow = now_.volume > barrier;
                    step = std::min(tried, step) * (steps > kMany ? kShrink : steps <= kFew && may_grow ? kGrow : 1.0);
                }
            }
            if (is_refused && !hasWork()) {
                break;
            }
            if (is_refused) {
                settled = 0;
                largest = 0.0;
                barrier = std::max(barrier, now_.volume + tried);
                step = kRefused * std::min(step, tried);
                const double least = options_.min_step * std::max(now_.volume, 1e-3 * length_scale * base);
                if (step < least && contact_) {
                    return SheetEnd::Contact;
                }
                if (step < least && is_loose_) {
                    return SheetEnd::NotHeld;
                }
                if (step < least) {
                    const double end = now_.volume;
                    if (isFirm(least)) {
                        return SheetEnd::Unstable;
                    }
                    barrier = std::max(barrier, end);
                    step = kRefused * (end - now_.volume);
                }
                continue;
            }
            if (target_.by == FillBy::Volume) {
                report(now_.volume / target_.amount);
                continue;
            }
            const double share = shareOf(now_.sheet, now_.pressure);
            report(share);
            if (share > highest_share_) {
                highest_ = now_;
                highest_share_ = share;
            }
            largest = std::max(largest, share);
            const bool is_angle = target_.by == FillBy::ContactAngle;
            if (share < (is_angle ? largest - kFallen / target_.amount : kLower * largest)) {
                if (slopeOfShare() <= 0.0) {
                    return is_angle ? SheetEnd::NoAngle : SheetEnd::NoHeight;
                }
                largest = share;  // it fell with new triangles
            }
        }
        return hasWork() ? SheetEnd::Unstable : SheetEnd::OutOfWork;
    }

    void report(double share) const
    {
        if (options_.reached) {
            options_.reached(std::clamp(share, 0.0, 1.0));
        }
    }

    /// Height or mean contact angle, whichever is the target, over it.
    [[nodiscard]] double shareOf(const CapillarySurface& sheet, double pressure) const
    {
        if (target_.by == FillBy::Height) {
            return heightOf(sheet, base_) / target_.amount;
        }
        const double share = rimAngles(sheet, options_.weight, pressure, base_.ground).mean() / target_.amount;
        return target_.max_height ? std::max(share, heightOf(sheet, base_) / *target_.max_height) : share;
    }

    /// Volume that is missing to the target, by the tangent.
    [[nodiscard]] double wayTo() const
    {
        if (target_.by == FillBy::Volume) {
            return target_.amount - now_.volume;
        }
        const double missing = 1.0 - shareOf(now_.sheet, now_.pressure);
        // On the way to the final triangles a target need not be met better than they change it.
        if (std::abs(missing) <= (is_final_ ? options_.tolerance : kOnTheWay)) {
            return 0.0;
        }
        const double slope = slopeOfShare();
        return slope > 0.0 ? missing / slope : std::copysign(std::pow(meshed_area_, 1.5), missing);
    }

    /// Change of the share of the target per volume, by a motion along the tangent that is small against the sheet.
    [[nodiscard]] double slopeOfShare() const
    {
        const double probe = 1e-6 * std::pow(meshed_area_, 1.5);
        CapillarySurface moved = now_.sheet;
        moved.vertices = movedPlaces(now_, probe);
        return (shareOf(moved, now_.pressure + probe * now_.newton.pressure_slope) -
                shareOf(now_.sheet, now_.pressure)) /
               probe;
    }

    /// Size of a step along the tangent, shortened until no triangle turns too far.
    [[nodiscard]] double gentle(double size) const
    {
        CapillarySurface moved = now_.sheet;
        for (int k = 0; k < 30; ++k, size *= 0.6) {
            moved.vertices = movedPlaces(now_, size);
            if (isGentle(now_.sheet, moved, kPredicted)) {
                break;
            }
        }
        return size;
    }

    /// Goes a step of the volume.
    /// @return  false if refused; then nothing has changed
    bool advance(double size)
    {
        contact_.reset();
        is_loose_ = false;
        State next{now_.sheet, now_.pressure + size * now_.newton.pressure_slope, now_.volume + size, {}};
        next.sheet.vertices = movedPlaces(now_, size);
        base_.lift(next.sheet.vertices, next.sheet.rimVertexCount());
        next.newton = solver_->solve(next.sheet, next.volume, next.pressure, within({}));
        count(next);
        if (!next.newton.converged) {
            return false;
        }
        is_loose_ = isLoose(next);
        if (is_loose_ || (keeps_triangles_ && !repair(next))) {
            return false;
        }
        const int steps = next.newton.steps;
        const bool is_far = std::abs(next.volume - firm_.back().volume) > gap_ * next.volume;
        if (!is_final_ && (is_far || needsTriangles(next.sheet))) {
            if (!renew(next, trianglesOf(options_.path_edge))) {
                goBack();
                return false;
            }
            confirm(next);
        }
        now_ = std::move(next);
        now_.newton.steps = steps;  // those of the step itself set the size of the next one
        return true;
    }

    /// Whether a droplet lies on the ground all along its rim, or would with finer triangles.
    [[nodiscard]] bool isLoose(const State& state) const
    {
        std::vector<std::uint8_t> is_laid(state.sheet.rimVertexCount(), 0);
        for (const Triangle& t : state.sheet.triangles) {
            const bool is_grounded = std::any_of(t.begin(), t.end(), [&](std::uint32_t v) {
                return v >= state.sheet.rimVertexCount() && base_.clearance(state.sheet.vertices[v]) <= 0.0;
            });
            for (const std::uint32_t v : t) {
                if (v < state.sheet.rimVertexCount() && is_grounded) {
                    is_laid[v] = 1;
                }
            }
        }
        struct Rim {
            double turned = 0.0;  ///< integral of the angle
            double length = 0.0;
            double laid = 0.0;
            double vertices = 0.0;
        };
        const RimAngles angles = rimAngles(state.sheet, options_.weight, state.pressure, base_.ground);
        std::vector<Rim> rims(state.sheet.rimVertexCount());
        for (std::uint32_t v = 0; v < state.sheet.rimVertexCount(); ++v) {
            Rim& rim = rims[droplet_[v]];
            rim.turned += angles.angle[v] * angles.weight[v];
            rim.length += angles.weight[v];
            // Where the liquid is on the other side, ground inside of the rim is dry.
            rim.laid += angles.angle[v] > 0.5 * std::numbers::pi ? is_laid[v] : 0.0;
            rim.vertices += 1.0;
        }
        return std::any_of(rims.begin(), rims.end(), [](const Rim& rim) {
            return rim.vertices > 0.0 && (rim.turned >= kNotHeld * rim.length || rim.laid >= kLaid * rim.vertices);
        });
    }

    /// Moves the vertices of an equilibrium along it where triangles that stay are worn.
    /// @return  false if they are still, or it is no equilibrium then
    bool repair(State& state)
    {
        if (isWorn(meshed_angles_, state.sheet, kWorn)) {
            state.sheet = relax(state.sheet, kRelaxations, base_.ground.flat());
            base_.lift(state.sheet.vertices, state.sheet.rimVertexCount());
            state.newton = solver_->solve(state.sheet, state.volume, state.pressure, within(kSettling));
            count(state);
        }
        return state.newton.converged && !isWorn(meshed_angles_, state.sheet, kKeptWorn);
    }

    /// Keeps a sheet on new triangles.
    void confirm(const State& state)
    {
        firm_.push_back(state);
        if (firm_.size() > kFirm) {
            firm_.pop_front();
        }
    }

    /// Takes up the last sheet that stood on new triangles; from now on every one has to.
    void goBack()
    {
        now_ = firm_.back();
        gap_ = std::min(gap_, kConfirmed);
        use(solverOf(now_.sheet), now_.sheet);
    }

    /// Takes up the sheet with the largest share of the target.
    void goBackToLargest()
    {
        if (highest_ && highest_share_ > shareOf(now_.sheet, now_.pressure)) {
            firm_ = {*highest_};
            goBack();
        }
    }

    /// Whether the last sheet stands on new triangles. If not, the path goes back, and confirms every step.
    /// @param least  change of the volume that needs no new triangles [m³]
    bool isFirm(double least)
    {
        const double ahead = std::abs(now_.volume - firm_.back().volume);
        if (ahead <= least || keeps_triangles_) {
            return true;
        }
        if (renew(now_, trianglesOf(options_.path_edge))) {
            confirm(now_);
            return true;
        }
        goBack();
        gap_ = 0.0;
        return kRefused * ahead < least;
    }

    /// Takes up the last sheet that stands on triangles of the final size, to go on with them: with coarse ones, sheets
    /// may end too early or too late.
    bool refineFirm()
    {
        if (options_.edge >= options_.path_edge) {
            return false;
        }
        std::deque<State> states = std::move(firm_);
        for (; !states.empty() && hasWork(); states.pop_back()) {
            State state = states.back();
            if (renew(state, trianglesOf(options_.edge))) {
                now_ = state;
                firm_ = {state};
                options_.path_edge = options_.edge;
                gap_ = std::numeric_limits<double>::infinity();
                return true;
            }
            if (firm_.empty()) {
                firm_ = {states.back()};
            }
        }
        return false;
    }

    /// Gives the last sheet its final triangles, or, where small ones fail at a fold, coarser ones, and leads it to the
    /// target on them.
    /// @return  false if it does not stand on any; then the path goes back
    bool refine(bool has_target)
    {
        if (!has_allowance_) {
            has_allowance_ = true;
            options_.max_work =
                std::max(options_.max_work, work_) + kFinalFactorisations * factorWork(options_.triangles);
        }
        const State coarse = now_;
        is_final_ = true;
        const auto stands = [&](const RemeshOptions& triangles) {
            now_ = coarse;
            return renew(now_, triangles, {.is_last = true}) && (!has_target || settle()) && isFree();
        };
        RemeshOptions finest = trianglesOf(options_.edge);
        finest.triangles = options_.triangles;
        finest.mends = options_.mends;
        bool is_done = stands(finest);
        for (double edge = options_.edge; !is_done; edge = std::min(kCoarser * edge, options_.path_edge)) {
            is_done = stands(trianglesOf(edge));
            if (edge >= options_.path_edge) {
                break;
            }
        }
        if (!is_done) {
            is_final_ = false;
            goBack();
        }
        return is_done;
    }

    /// Whether the last sheet does not touch itself.
    bool isFree()
    {
        contact_ = firstContact({&now_.sheet});
        return !contact_;
    }

    /// Leads the last sheet to the target on its final triangles.
    bool settle()
    {
        for (int round = 0; round < kMaxSettling; ++round) {
            const double left = wayTo();
            if (std::abs(left) <= 1e-12 * now_.volume) {
                return true;
            }
            if (std::abs(left) > 0.1 * now_.volume || !advance(left)) {
                return false;
            }
        }
        return std::abs(wayTo()) <= 1e-6 * now_.volume;
    }

    [[nodiscard]] bool needsTriangles(const CapillarySurface& sheet) const
    {
        return isWorn(meshed_angles_, sheet, kWorn) || integrate(sheet, options_.weight).area > kGrowth * meshed_area_;
    }

    /// Gives a sheet near an equilibrium new triangles at the same volume.
    /// @return  false if there is no such equilibrium on them, or it touches itself; then nothing has changed
    bool renew(State& state, const RemeshOptions& triangles, const Renewal& renewal = {})
    {
        State next = state;
        std::unique_ptr<SheetSolver> solver;
        // At inner corners liquid may have far to roll; there triangles wear out on the way.
        const auto may_go_on = [&](int round) {
            return round < 2 || (round < kRenewals && next.newton.residual < kRolling);
        };
        for (int round = 0; may_go_on(round) && hasWork(); ++round) {
            next.sheet = newTriangles(next.sheet, triangles);
            if (!isSolvable(next.sheet)) {
                work_ = options_.max_work;
                return false;
            }
            solver = solverOf(next.sheet);
            next.newton = solver->solve(next.sheet, next.volume, next.pressure, within(renewal.limits));
            count(next, triangles.rounds > 0 ? kRemeshWork : kMendWork);
            const double scale = std::max(std::abs(state.pressure), 2.0 / std::sqrt(meshed_area_));
            if (std::abs(next.pressure - state.pressure) > kSamePressure * scale) {
                return false;
            }
            if (next.newton.converged) {
                break;
            }
        }
        if (!solver || !next.newton.converged) {
            return false;
        }
        if (!renewal.is_last) {
            contact_ = firstContact({&next.sheet});
            if (contact_) {
                return false;
            }
        }
        use(std::move(solver), next.sheet);
        state = std::move(next);
        return true;
    }

    [[nodiscard]] RemeshOptions trianglesOf(double edge) const { return {edge, edge / 8.0, base_.ground.flat()}; }

    [[nodiscard]] CapillarySurface newTriangles(const CapillarySurface& sheet, const RemeshOptions& triangles) const
    {
        RemeshOptions limited = triangles;
        limited.max_triangles = most();
        CapillarySurface made = remesh(sheet, limited);
        base_.lift(made.vertices, made.rimVertexCount());
        return made;
    }

    [[nodiscard]] std::unique_ptr<SheetSolver> solverOf(const CapillarySurface& sheet) const
    {
        return std::make_unique<SheetSolver>(sheet, options_.weight, base_);
    }

    /// Pressure under which all of a dry sheet rises: more than the largest force on a vertex over its area [1/m].
    [[nodiscard]] double liftingPressure(const CapillarySurface& sheet) const
    {
        const SheetGradients gradients = gradientsOf(sheet, options_.weight);
        double pressure = 0.0;
        for (std::size_t v = sheet.rimVertexCount(); v < sheet.vertices.size(); ++v) {
            const Vec3& volume = gradients.volume[v];
            pressure = std::max(pressure, dot(gradients.energy[v], volume) / dot(volume, volume));
        }
        return pressure;
    }

    /// Counts the work of Newton's method, and that of new triangles, for each of them.
    void count(const State& state, double remeshing = 0.0)
    {
        newton_steps_ += state.newton.steps;
        work_ += state.newton.work + remeshing * static_cast<double>(state.sheet.triangles.size());
    }

    /// Limits of Newton's method, with the work that is left.
    [[nodiscard]] NewtonLimits within(NewtonLimits limits) const
    {
        limits.max_work = options_.max_work - work_;
        limits.tolerance = std::max({limits.tolerance, options_.tolerance, is_final_ ? 0.0 : kOnTheWay});
        limits.chord = chord_;
        return limits;
    }

    /// Most triangles that the work that is left is enough for.
    [[nodiscard]] std::size_t most() const
    {
        return trianglesFor(std::max(options_.max_work - work_, 0.0), kLeastFactorisations);
    }

    [[nodiscard]] bool isSolvable(const CapillarySurface& sheet) const { return sheet.triangles.size() < most(); }

    [[nodiscard]] bool hasWork() const { return work_ < options_.max_work; }

    /// Takes the solver of new triangles.
    void use(std::unique_ptr<SheetSolver> solver, const CapillarySurface& sheet)
    {
        solver_ = std::move(solver);
        meshed_area_ = integrate(sheet, options_.weight).area;
        meshed_angles_ = minAngles(sheet);
        UnionFind droplets(sheet.vertices.size());
        for (const Triangle& t : sheet.triangles) {
            droplets.join(t[0], t[1]);
            droplets.join(t[0], t[2]);
        }
        droplet_.resize(sheet.rimVertexCount());
        for (std::uint32_t v = 0; v < sheet.rimVertexCount(); ++v) {
            droplet_[v] = droplets.find(v);
        }
    }

    SheetTarget target_;
    SheetOptions options_;
    SheetBase base_;
    State now_;
    std::unique_ptr<SheetSolver> solver_;                   ///< for the triangles of now_
    double meshed_area_ = 0.0;                              ///< when the triangles were made
    std::vector<double> meshed_angles_;                     ///< of every triangle then [rad]
    std::vector<std::uint32_t> droplet_;                    ///< of every rim vertex: the first vertex of the same one
    std::deque<State> firm_;                                ///< last equilibria that were confirmed on new triangles
    std::optional<State> highest_;                          ///< equilibrium with the largest share of the target
    double highest_share_ = 0.0;                            ///< that share
    double gap_ = std::numeric_limits<double>::infinity();  ///< change of the volume, over it, until the next one
    double chord_ = 0.0;                                    ///< as of NewtonLimits
    bool is_final_ = false;                                 ///< the triangles stay until the target
    bool keeps_triangles_ = false;                          ///< they stay for good
    bool has_allowance_ = false;                            ///< whether the final triangles got their work
    std::optional<SheetContact> contact_;                   ///< of the sheet with itself, if that stopped the last step
    bool is_loose_ = false;                                 ///< whether that was a rim that does not hold the liquid
    int newton_steps_ = 0;
    double work_ = 0.0;  ///< so far, as SheetOptions::max_work
};

}  // namespace

double RimAngles::mean() const
{
    double sum = 0.0;
    double total = 0.0;
    for (std::size_t k = 0; k < angle.size(); ++k) {
        sum += angle[k] * weight[k];
        total += weight[k];
    }
    return sum / total;
}

RimAngles rimAngles(const CapillarySurface& sheet, Vec3 weight, double pressure, const BaseSurface& ground)
{
    const SheetGradients gradients = rimGradientsOf(sheet, weight);
    RimAngles rim;
    rim.angle.resize(sheet.rimVertexCount());
    rim.weight.resize(sheet.rimVertexCount(), 0.0);
    std::vector<Vec3> up(sheet.rimVertexCount());
    for (std::uint32_t v = 0; v < sheet.rimVertexCount(); ++v) {
        up[v] = normalOf(ground.at({sheet.vertices[v].x, sheet.vertices[v].y}));
    }
    std::vector<Vec3> outward(sheet.rimVertexCount());
    for (const Triangle& t : sheet.triangles) {
        for (std::size_t a = 0; a < 3; ++a) {
            const std::uint32_t i = t[a];
            const std::uint32_t j = t[(a + 1) % 3];
            // No inner edge joins two rim vertices.
            if (i < sheet.rimVertexCount() && j < sheet.rimVertexCount()) {
                const Vec3 side = sheet.vertices[j] - sheet.vertices[i];
                outward[i] = outward[i] + 0.5 * cross(side, up[i]);
                outward[j] = outward[j] + 0.5 * cross(side, up[j]);
                const double seen_from_above = length(Vec2{side.x, side.y});  // as of height fields
                rim.weight[i] += 0.5 * seen_from_above;
                rim.weight[j] += 0.5 * seen_from_above;
            }
        }
    }
    for (std::uint32_t v = 0; v < sheet.rimVertexCount(); ++v) {
        const Vec3 force = gradients.energy[v] - pressure * gradients.volume[v];
        const double along = dot(force, outward[v]) / length(outward[v]);
        const double angle = std::atan2(-dot(force, up[v]), along);
        // At the tips of dry wedges forces may point up a little, or beyond the ground.
        rim.angle[v] = angle >= 0.0 ? angle : along < 0.0 ? std::numbers::pi : 0.0;
    }
    return rim;
}

FilledSheet fillSheet(const PlanarMesh& footprint, const SheetTarget& target, const SheetOptions& options)
{
    return Path(footprint, target, options).run();
}

std::optional<FilledSheet> settleSheet(SheetStart start, const SheetTarget& target, const SheetOptions& options)
{
    const bool is_last = start.is_last;
    return Path(std::move(start), target, options).settled(is_last);
}

FilledSheet refillSheet(const CapillarySurface& sheet, double pressure, const SheetTarget& target, Vec3 weight,
                        const SheetBase& base)
{
    return Path(sheet, pressure, target, weight, base).run();
}

}  // namespace droplet
