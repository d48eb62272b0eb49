// SPDX-License-Identifier: GPL-3.0-or-later
// Continuation in the volume with a tangent predictor and Newton's method as corrector: E. Allgower, K. Georg,
// "Numerical Continuation Methods" (1990). Sheets are stable along the whole path: what is found at its end is what
// liquid does that is slowly poured.
#include "shape/sheet_path.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "shape/sheet_energy.h"
#include "shape/sheet_newton.h"
#include "shape/sheet_remesh.h"

namespace droplet {
namespace {

/// Limits of a predicted step: no triangle turns by more than 22°.
constexpr MotionLimits kPredicted{0.927, 0.4, 2.5};
/// Steps of Newton's method after which steps of the volume grow or shrink.
constexpr int kFew = 4;
constexpr int kMany = 7;
constexpr double kGrow = 1.6;
constexpr double kShrink = 0.7;
constexpr double kRefused = 0.4;
/// Angle of a triangle below which, and growth of the area above which, a sheet needs new triangles.
constexpr double kLeastAngle = 18.0;
constexpr double kGrowth = 1.25;
/// Growth of edges when a sheet fails with small ones.
constexpr double kCoarser = 1.6;
/// Change of the pressure by new triangles above which they are not the same liquid.
constexpr double kSamePressure = 0.1;
/// Fall of the mean angle from its maximum that proves the maximum [rad].
constexpr double kFallen = std::numbers::pi / 180.0;

double heightOf(const SheetMesh& sheet)
{
    double height = 0.0;
    for (const Vec3& p : sheet.places) {
        height = std::max(height, p.z);
    }
    return height;
}

/// Path of one sheet. Lengths are in roots of the footprint's area over π.
class Path {
public:
    Path(const PlanarMesh& footprint, const SheetTarget& target, const SheetOptions& options)
        : target_(target), options_(options)
    {
        sheet_.rim = footprint.rimVertexCount();
        sheet_.triangles = footprint.triangles;
        for (const Vec2 p : footprint.vertices) {
            sheet_.places.push_back({p.x, p.y, 0.0});
        }
    }

    FilledSheet run()
    {
        FilledSheet result;
        solver_ = std::make_unique<SheetSolver>(sheet_, options_.weight);
        // The flat sheet is in equilibrium with no liquid.
        NewtonResult flat = solver_->solve(sheet_, 0.0, pressure_);
        newton_steps_ += flat.steps;
        meshed_area_ = integrate(sheet_, options_.weight).area;
        meshed_angle_ = minAngle(sheet_);
        const double base = meshed_area_;
        const double length_scale = std::sqrt(base / std::numbers::pi);
        double step = 0.02 * length_scale * length_scale * length_scale;
        SheetEnd end = SheetEnd::Unstable;
        double largest_angle = 0.0;
        double largest_height = 0.0;
        int settled = 0;
        for (steps_ = 0; steps_ < kMaxSteps; ++steps_) {
            const double left = wayTo();
            if (std::abs(left) <= 1e-12 * std::max(volume_, 1e-300) || settled > kMaxSettling) {
                end = SheetEnd::Reached;
                break;
            }
            bool is_last = std::abs(left) <= step;
            double size = is_last ? left : std::copysign(step, left);
            size = gentle(size);
            is_last = is_last && size == left;
            const int steps = advance(size);
            if (steps < 0) {
                step = kRefused * std::min(step, std::abs(size));
                if (step < options_.min_step * std::max(volume_, 1e-3 * length_scale * base)) {
                    break;
                }
                continue;
            }
            settled += is_last ? 1 : 0;
            if (!is_last) {
                step = std::min(std::abs(size), step) * (steps <= kFew ? kGrow : steps > kMany ? kShrink : 1.0);
            }
            if (is_last && target_.by == FillBy::Volume) {
                volume_ = target_.amount;
                end = SheetEnd::Reached;
                break;
            }
            const double angle = rimAngles(sheet_, options_.weight, pressure_).mean();
            largest_angle = std::max(largest_angle, angle);
            if (target_.by == FillBy::ContactAngle && angle < largest_angle - kFallen) {
                end = SheetEnd::NoAngle;
                break;
            }
            const double height = heightOf(sheet_);
            largest_height = std::max(largest_height, height);
            if (target_.by == FillBy::Height && height < 0.99 * largest_height) {
                end = SheetEnd::NoHeight;
                break;
            }
        }
        refine(end);
        result.mesh = sheet_;
        result.pressure = pressure_;
        result.volume = volume_;
        result.height = heightOf(sheet_);
        result.angle = rimAngles(sheet_, options_.weight, pressure_).mean();
        result.end = end;
        result.steps = steps_;
        result.newton_steps = newton_steps_;
        return result;
    }

private:
    static constexpr int kMaxSteps = 400;
    static constexpr int kMaxSettling = 8;

    /// Volume that is missing to the target, by the tangent.
    [[nodiscard]] double wayTo() const
    {
        if (target_.by == FillBy::Volume) {
            return target_.amount - volume_;
        }
        // By a motion along the tangent that is small against the sheet.
        const double scale = std::pow(meshed_area_, 1.5);
        const double probe = 1e-6 * scale;
        SheetMesh moved = sheet_;
        for (std::size_t v = 0; v < moved.places.size(); ++v) {
            moved.places[v] = moved.places[v] + probe * solver_->tangent()[v];
        }
        const double pressure = pressure_ + probe * solver_->pressureSlope();
        double now = 0.0;
        double then = 0.0;
        if (target_.by == FillBy::Height) {
            now = heightOf(sheet_);
            then = heightOf(moved);
        } else {
            now = rimAngles(sheet_, options_.weight, pressure_).mean();
            then = rimAngles(moved, options_.weight, pressure).mean();
        }
        const double missing = target_.amount - now;
        if (std::abs(missing) <= 1e-9 * target_.amount) {
            return 0.0;
        }
        const double slope = (then - now) / probe;
        return slope > 0.0 ? missing / slope : std::copysign(scale, missing);
    }

    /// Size of a step along the tangent, shortened until no triangle turns too far.
    [[nodiscard]] double gentle(double size) const
    {
        SheetMesh moved = sheet_;
        for (int k = 0; k < 30; ++k, size *= 0.6) {
            for (std::size_t v = 0; v < moved.places.size(); ++v) {
                moved.places[v] = sheet_.places[v] + size * solver_->tangent()[v];
            }
            if (isGentle(sheet_, moved, kPredicted)) {
                break;
            }
        }
        return size;
    }

    /// Goes a step of the volume.
    /// @return  number of Newton's steps; negative if refused
    int advance(double size)
    {
        const SheetMesh before = sheet_;
        const double pressure_before = pressure_;
        for (std::size_t v = sheet_.rim; v < sheet_.places.size(); ++v) {
            sheet_.places[v] = sheet_.places[v] + size * solver_->tangent()[v];
            if (solver_->tangent()[v].z < 0.0 && sheet_.places[v].z < 0.0) {
                sheet_.places[v].z = 0.0;
            }
        }
        pressure_ += size * solver_->pressureSlope();
        const NewtonResult newton = solver_->solve(sheet_, volume_ + size, pressure_);
        newton_steps_ += newton.steps;
        bool is_good = newton.converged;
        if (is_good && !is_final_ && needsTriangles()) {
            is_good = renew(volume_ + size, std::max(options_.edge, options_.path_edge));
        }
        if (!is_good) {
            sheet_ = before;
            pressure_ = pressure_before;
            solver_ = std::make_unique<SheetSolver>(sheet_, options_.weight);
            newton_steps_ += solver_->solve(sheet_, volume_, pressure_).steps;
            return -1;
        }
        volume_ += size;
        return newton.steps;
    }

    /// Gives the last sheet its final triangles, and leads it to the target on them.
    void refine(SheetEnd end)
    {
        const FilledSheet coarse{sheet_, pressure_, volume_, 0.0, 0.0, end, 0, 0};
        // Where a sheet is folded at a corner, small triangles may fail.
        bool is_fine = renew(volume_, options_.edge);
        for (double edge = kCoarser * options_.edge; !is_fine && edge < options_.path_edge; edge *= kCoarser) {
            is_fine = renew(volume_, edge);
        }
        if (!is_fine) {
            return;
        }
        is_final_ = true;
        for (int round = 0; end == SheetEnd::Reached && round < kMaxSettling; ++round) {
            const double left = wayTo();
            if (std::abs(left) <= 1e-12 * volume_) {
                return;
            }
            if (std::abs(left) > 0.1 * volume_ || advance(left) < 0) {
                sheet_ = coarse.mesh;
                pressure_ = coarse.pressure;
                volume_ = coarse.volume;
                return;
            }
        }
    }

    [[nodiscard]] bool needsTriangles() const
    {
        return minAngle(sheet_) < std::min(kLeastAngle * std::numbers::pi / 180.0, 0.7 * meshed_angle_) ||
               integrate(sheet_, options_.weight).area > kGrowth * meshed_area_;
    }

    /// Gives the sheet new triangles at the same volume.
    bool renew(double volume, double edge)
    {
        SheetMesh next = remesh(sheet_, {edge, edge / 8.0});
        double pressure = pressure_;
        auto solver = std::make_unique<SheetSolver>(next, options_.weight);
        const NewtonResult newton = solver->solve(next, volume, pressure);
        newton_steps_ += newton.steps;
        if (!newton.converged || std::abs(pressure - pressure_) > kSamePressure * std::abs(pressure_)) {
            return false;
        }
        sheet_ = std::move(next);
        pressure_ = pressure;
        solver_ = std::move(solver);
        meshed_area_ = integrate(sheet_, options_.weight).area;
        meshed_angle_ = minAngle(sheet_);
        return true;
    }

    SheetTarget target_;
    SheetOptions options_;
    SheetMesh sheet_;
    std::unique_ptr<SheetSolver> solver_;
    double pressure_ = 0.0;
    double volume_ = 0.0;
    double meshed_area_ = 0.0;   ///< when the triangles were made
    double meshed_angle_ = 0.0;  ///< smallest one then [rad]
    bool is_final_ = false;      ///< the triangles stay
    int steps_ = 0;
    int newton_steps_ = 0;
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

RimAngles rimAngles(const SheetMesh& sheet, Vec3 weight, double pressure)
{
    const SheetGradients gradients = gradientsOf(sheet, weight);
    RimAngles rim;
    rim.angle.resize(sheet.rim);
    rim.weight.resize(sheet.rim, 0.0);
    std::vector<Vec3> outward(sheet.rim);
    for (const Triangle& t : sheet.triangles) {
        for (std::size_t a = 0; a < 3; ++a) {
            const std::uint32_t i = t[a];
            const std::uint32_t j = t[(a + 1) % 3];
            // No inner edge joins two rim vertices.
            if (i < sheet.rim && j < sheet.rim) {
                const Vec3 side = sheet.places[j] - sheet.places[i];
                const Vec3 half = 0.5 * cross(side, {0.0, 0.0, 1.0});
                outward[i] = outward[i] + half;
                outward[j] = outward[j] + half;
                rim.weight[i] += 0.5 * length(side);
                rim.weight[j] += 0.5 * length(side);
            }
        }
    }
    for (std::uint32_t v = 0; v < sheet.rim; ++v) {
        const Vec3 force = gradients.energy[v] - pressure * gradients.volume[v];
        const double along = dot(force, outward[v]) / length(outward[v]);
        const double angle = std::atan2(-force.z, along);
        // At the tips of dry wedges forces may point up a little, or beyond the ground.
        rim.angle[v] = angle >= 0.0 ? angle : along < 0.0 ? std::numbers::pi : 0.0;
    }
    return rim;
}

FilledSheet fillSheet(const PlanarMesh& footprint, const SheetTarget& target, const SheetOptions& options)
{
    return Path(footprint, target, options).run();
}

}  // namespace droplet
