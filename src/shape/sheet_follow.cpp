// SPDX-License-Identifier: GPL-3.0-or-later
// Continuation in the place of the rim, with Newton's method as corrector. What the rim's motion has of a translation,
// a turn and a growth, the sheet takes over exactly; the rest goes inwards harmonically.
#include "shape/sheet_follow.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <utility>

#include "mesh/harmonic.h"
#include "shape/sheet_energy.h"
#include "shape/sheet_limits.h"
#include "shape/sheet_newton.h"
#include "shape/sheet_remesh.h"

namespace droplet {
namespace {

/// Steps of Newton's method up to which steps of the rim grow, their growth, shortening until no triangle turns too
/// far, and shortening of a step that was refused.
constexpr int kFew = 4;
constexpr double kGrow = 1.6;
constexpr double kGentler = 0.6;
constexpr double kRefused = 0.4;
/// Angle of a triangle, over that when it was made, below which a sheet is solved anew. Of 119 steps in which a word
/// becomes a ring, 75 kept their vertices with 0.2 and 78 with 0.1; heights of both are as near to those of new
/// triangles as these are to each other: 0.14 % in the median, 0.7 % in nine of ten frames.
constexpr double kMostWorn = 0.1;
/// Growth of the area above which, or below the inverse of which, it is: as for the edges of moved footprints.
constexpr double kMostGrowth = 2.25;

using Place = std::complex<double>;

Place placeOf(const Vec3& p)
{
    return {p.x, p.y};
}

/// Motion z ↦ turn · (z − from) + to of the plane.
struct Similarity {
    Place turn;  ///< and growth
    Place from;
    Place to;

    [[nodiscard]] Place operator()(Place z) const { return turn * (z - from) + to; }
    [[nodiscard]] double growth() const { return std::abs(turn); }
};

/// Similarity that is nearest to the motion of a rim.
Similarity nearestSimilarity(const CapillarySurface& sheet, const std::vector<Vec2>& rim)
{
    Similarity similarity;
    for (std::size_t v = 0; v < rim.size(); ++v) {
        similarity.from += placeOf(sheet.vertices[v]);
        similarity.to += Place(rim[v].x, rim[v].y);
    }
    similarity.from /= static_cast<double>(rim.size());
    similarity.to /= static_cast<double>(rim.size());
    Place turned;
    double size = 0.0;
    for (std::size_t v = 0; v < rim.size(); ++v) {
        const Place arm = placeOf(sheet.vertices[v]) - similarity.from;
        turned += std::conj(arm) * (Place(rim[v].x, rim[v].y) - similarity.to);
        size += std::norm(arm);
    }
    similarity.turn = turned / size;
    return similarity;
}

/// Motion of all vertices when the rim goes to new places.
std::vector<Vec3> motionOf(const CapillarySurface& sheet, const std::vector<Vec2>& rim, const Similarity& similarity)
{
    std::vector<Vec3> motion;
    motion.reserve(sheet.vertices.size());
    for (const Vec3& p : sheet.vertices) {
        const Place way = similarity(placeOf(p)) - placeOf(p);
        motion.push_back({way.real(), way.imag(), (similarity.growth() - 1.0) * p.z});
    }
    Eigen::MatrixX2d rest(static_cast<Eigen::Index>(rim.size()), 2);
    for (std::size_t v = 0; v < rim.size(); ++v) {
        const Vec3 there = sheet.vertices[v] + motion[v];
        rest.row(static_cast<Eigen::Index>(v)) << rim[v].x - there.x, rim[v].y - there.y;
        motion[v] = {rim[v].x - sheet.vertices[v].x, rim[v].y - sheet.vertices[v].y, 0.0};
    }
    const Eigen::MatrixX2d inside = harmonic(sheet.vertices, sheet.triangles, rest);
    for (std::size_t v = rim.size(); v < motion.size(); ++v) {
        const auto row = static_cast<Eigen::Index>(v - rim.size());
        motion[v] = motion[v] + Vec3{inside(row, 0), inside(row, 1), 0.0};
    }
    return motion;
}

/// Pressure after a motion, where gravity does not change the shape: it grows inversely to the sheet, at its middle.
double pressureAfter(const Similarity& similarity, double pressure, Vec3 weight)
{
    const auto at_middle = [&](Place middle) { return weight.x * middle.real() + weight.y * middle.imag(); };
    return (pressure - at_middle(similarity.from)) / similarity.growth() + at_middle(similarity.to);
}

/// Sheet whose rim moves.
class MovedSheet {
public:
    MovedSheet(const CapillarySurface& first, const CapillarySurface& last, double pressure, Vec3 weight)
        : weight_(weight),
          sheet_(last),
          pressure_(pressure),
          volume_(integrate(last, weight).volume),
          made_angles_(minAngles(first)),
          made_area_(integrate(first, weight).area),
          solver_(last, weight)
    {
    }

    /// Moves the rim to new places, in steps, and fills or drains the sheet on the way.
    /// @return  false if the triangles cannot follow
    bool move(const std::vector<Vec2>& rim, const SheetTarget& target)
    {
        if (!solve(sheet_, volume_, pressure_, kSettling)) {
            return false;
        }
        const Similarity similarity = nearestSimilarity(sheet_, rim);
        const std::vector<Vec3> motion = motionOf(sheet_, rim, similarity);
        // With an angle or a height as the target, the volume comes near it if it grows as the rim does.
        const double volume =
            target.by == FillBy::Volume ? target.amount : volume_ * std::pow(similarity.growth(), 3.0);
        const double filling = volume - volume_;
        const double pressing = pressureAfter(similarity, pressure_, weight_) - pressure_;
        double step = 1.0;
        for (double left = 1.0; left > 0.0;) {
            const bool is_last = step >= left;
            const double size = std::min(step, left);
            CapillarySurface next = sheet_;
            for (std::size_t v = 0; v < next.vertices.size(); ++v) {
                next.vertices[v] = next.vertices[v] + size * motion[v];
            }
            for (std::size_t v = 0; is_last && v < rim.size(); ++v) {
                next.vertices[v] = {rim[v].x, rim[v].y, 0.0};
            }
            const double next_volume = is_last ? volume : volume_ + size * filling;
            const double missing = next_volume - integrate(next, weight_).volume;
            for (std::size_t v = next.rimVertexCount(); v < next.vertices.size(); ++v) {
                next.vertices[v] = next.vertices[v] + missing * newton_.tangent[v];
                next.vertices[v].z = std::max(next.vertices[v].z, 0.0);
            }
            double next_pressure = pressure_ + size * pressing + missing * newton_.pressure_slope;
            const bool is_gentle = isGentle(sheet_, next, kPredicted);
            const NewtonResult before = newton_;
            const bool is_solved = is_gentle && solve(next, next_volume, next_pressure, {});
            if (is_solved && !repair(next, next_volume, next_pressure)) {
                return false;  // smaller steps would lead to the same triangles
            }
            if (is_solved) {
                sheet_ = std::move(next);
                pressure_ = next_pressure;
                volume_ = next_volume;
                left -= size;
                step = size * (newton_.steps <= kFew ? kGrow : 1.0);
                continue;
            }
            newton_ = before;
            step = size * (is_gentle ? kRefused : kGentler);
            if (step < kKeptStep || factorisations_ > kKeptWork) {
                return false;
            }
        }
        const double growth = integrate(sheet_, weight_).area / made_area_;
        return growth <= kMostGrowth && growth >= 1.0 / kMostGrowth;
    }

    [[nodiscard]] const CapillarySurface& sheet() const { return sheet_; }
    [[nodiscard]] double pressure() const { return pressure_; }
    [[nodiscard]] int newtonSteps() const { return newton_steps_; }

private:
    bool solve(CapillarySurface& sheet, double volume, double& pressure, const NewtonLimits& limits)
    {
        newton_ = solver_.solve(sheet, volume, pressure, limits);
        newton_steps_ += newton_.steps;
        factorisations_ += newton_.factorisations;
        return newton_.converged;
    }

    /// Moves the vertices of an equilibrium along it where triangles are worn.
    bool repair(CapillarySurface& sheet, double volume, double& pressure)
    {
        if (!isWorn(made_angles_, sheet, kWorn)) {
            return true;
        }
        sheet = relax(sheet, kRelaxations, true);
        return solve(sheet, volume, pressure, kSettling) && !isWorn(made_angles_, sheet, kMostWorn);
    }

    Vec3 weight_;
    CapillarySurface sheet_;
    double pressure_;
    double volume_;
    std::vector<double> made_angles_;
    double made_area_;
    SheetSolver solver_;
    NewtonResult newton_;
    int newton_steps_ = 0;
    int factorisations_ = 0;
};

}  // namespace

FilledSheet followSheet(const CapillarySurface& first, const CapillarySurface& last, double pressure,
                        const std::vector<Vec2>& rim, const SheetTarget& target, Vec3 weight)
{
    MovedSheet moved(first, last, pressure, weight);
    if (!moved.move(rim, target)) {
        FilledSheet unmoved;
        unmoved.mesh = last;
        unmoved.pressure = pressure;
        unmoved.end = SheetEnd::Unstable;
        unmoved.newton_steps = moved.newtonSteps();
        return unmoved;
    }
    FilledSheet filled = refillSheet(moved.sheet(), moved.pressure(), target, weight, {});
    filled.newton_steps += moved.newtonSteps();
    if (filled.end == SheetEnd::Reached && isWorn(minAngles(first), filled.mesh, kMostWorn)) {
        filled.end = SheetEnd::Unstable;
    }
    return filled;
}

}  // namespace droplet
