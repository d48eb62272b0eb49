// SPDX-License-Identifier: GPL-3.0-or-later
//
// The linear model of shape/ gives heights w over the footprint; a projective map takes them to wide contact angles.
// With t = tan(θ/2), it moves (p, w) to (p (1 + t²), t w) / (1 + t² (1 − w)). The rim stays, and the paraboloid
// w = 1 − |p|², the solution on a disc without gravity, becomes the spherical cap with the contact angle θ. Let ρ be
// the distance from the middle over that of the rim. Then w = (1 − ρ²) q with a smooth q, which is 1 for that
// paraboloid.
//
// Forces are those of the whole droplet, not of a flat one. A Bond number of the table belongs to the round droplet
// that gravity makes as much lower; that of a flat droplet would be too small. Gravity along the ground counts 8 V / (π
// r³ sin²θ) times: then the sum of surface tensions along the rim of a disc holds the weight of a cap with volume V.
#include "body/capillary_body.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <numbers>
#include <utility>

#include "body/axial_droplet.h"
#include "body/running_footprint.h"
#include "droplet/mesh/planar_mesh.h"
#include "shape/constrained.h"
#include "shape/operator.h"

namespace droplet {
namespace {

constexpr std::size_t kSolvedRings = 14;  // rim included, middle not
constexpr auto kSolvedSteps = static_cast<double>(kSolvedRings);
using SolvedRays = std::array<std::array<double, kSolvedRings>, kBodySlices>;  // from the middle, without the rim

/// Bond numbers of the linear model; negative ones are fractions of the limit.
constexpr std::array kHanging{-1.0, -0.8, -0.55, -0.3, -0.12};
constexpr std::array kStanding{0.0, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 128.0};

constexpr std::size_t kLevel = kHanging.size();  // the entry without gravity

double squared(double x)
{
    return x * x;
}

// ρ = (1 + c) s − c s² of even steps s: edges are shorter at the rim, where gravity bends the surface.
constexpr double kCrowding = 0.6;

/// ρ of a ring of the solved mesh.
double solvedRadius(std::size_t ring)
{
    const double s = 1.0 - static_cast<double>(ring) / kSolvedSteps;
    return s * (1.0 + kCrowding * (1.0 - s));
}

/// Mesh of the same form as a body.
PlanarMesh meshOf(const std::array<Vec2, kBodySlices>& rim)
{
    PlanarMesh mesh;
    for (std::size_t ring = 0; ring < kSolvedRings; ++ring) {
        for (const Vec2 p : rim) {
            mesh.vertices.push_back(solvedRadius(ring) * p);
        }
    }
    const auto middle = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.push_back({});
    for (std::size_t ring = 0; ring < kSolvedRings; ++ring) {
        for (std::size_t j = 0; j < kBodySlices; ++j) {
            const auto a = static_cast<std::uint32_t>(ring * kBodySlices + j);
            const auto b = static_cast<std::uint32_t>(ring * kBodySlices + (j + 1) % kBodySlices);
            if (ring + 1 == kSolvedRings) {
                mesh.triangles.push_back({a, b, middle});
                continue;
            }
            const auto c = static_cast<std::uint32_t>(b + kBodySlices);
            const auto d = static_cast<std::uint32_t>(a + kBodySlices);
            if (j < kBodySlices / 2) {
                mesh.triangles.push_back({a, b, c});
                mesh.triangles.push_back({a, c, d});
            } else {
                mesh.triangles.push_back({a, b, d});
                mesh.triangles.push_back({b, c, d});
            }
        }
    }
    mesh.loop_starts = {0, static_cast<std::uint32_t>(kBodySlices)};
    return mesh;
}

/// Heights along the slices, times a factor.
/// @param height  at inner vertices
SolvedRays raysOf(const std::vector<double>& height, double factor)
{
    SolvedRays rays;
    for (std::size_t j = 0; j < kBodySlices; ++j) {
        rays[j][0] = factor * height.back();
        for (std::size_t i = 1; i < kSolvedRings; ++i) {
            rays[j][i] = factor * height[(kSolvedRings - 1 - i) * kBodySlices + j];
        }
    }
    return rays;
}

/// Cubic interpolation at ρ of values on the solved rings; extrapolation to ρ = 1.
double valueAt(const std::array<double, kSolvedRings>& values, double radius)
{
    constexpr double kHalf = 0.5 * (1.0 + kCrowding);
    const double place = (kHalf - std::sqrt(kHalf * kHalf - kCrowding * radius)) / kCrowding * kSolvedSteps;
    const auto first =
        static_cast<std::size_t>(std::clamp(std::floor(place) - 1.0, 0.0, static_cast<double>(kSolvedRings) - 4.0));
    const double x = place - static_cast<double>(first);
    const double* const v = &values[first];
    return v[0] * (x - 1.0) * (x - 2.0) * (x - 3.0) / -6.0 + v[1] * x * (x - 2.0) * (x - 3.0) / 2.0 +
           v[2] * x * (x - 1.0) * (x - 3.0) / -2.0 + v[3] * x * (x - 1.0) * (x - 2.0) / 6.0;
}

/// Solutions on one footprint at one Bond number.
struct Solved {
    SolvedRays level;  ///< heights per pressure on level ground
    SolvedRays along;  ///< change of heights per slope to +x, at the same pressure
    SolvedRays aside;  ///< change of heights per slope to +y
};

/// ∫xφ at inner vertices, for the coordinate x along a direction.
std::vector<double> pullAlong(const PlanarMesh& mesh, Vec2 direction)
{
    std::vector<double> pull(mesh.vertices.size());
    for (const Triangle& triangle : mesh.triangles) {
        double sum = 0.0;
        for (const std::uint32_t v : triangle) {
            sum += dot(direction, mesh.vertices[v]);
        }
        for (const std::uint32_t v : triangle) {
            pull[v] += doubleArea(mesh, triangle) / 24.0 * (sum + dot(direction, mesh.vertices[v]));
        }
    }
    pull.erase(pull.begin(), pull.begin() + mesh.rimVertexCount());
    return pull;
}

/// Heights per pressure on level ground.
SolvedRays perPressure(const ConstrainedSolver& solver)
{
    const ConstrainedSolution level = solver.solve({.right = {}, .volume = 1.0});
    return raysOf(level.values, 1.0 / level.multiplier);
}

/// @param bond  Bond number into the ground by the radius of a disc of the footprint's area
Solved solveAll(const PlanarMesh& mesh, double bond)
{
    const std::unique_ptr<ConstrainedSolver> solver = directSolver(mesh);
    Operator op;
    op.mass_weight = bond;
    solver->prepare(op);
    Solved result;
    result.level = perPressure(*solver);
    const auto per_slope = [&](Vec2 direction) {
        const ConstrainedSolution tilted = solver->solve({.right = pullAlong(mesh, direction)});
        SolvedRays rays = raysOf(tilted.values, 1.0);
        for (std::size_t j = 0; j < kBodySlices; ++j) {
            for (std::size_t i = 0; i < kSolvedRings; ++i) {
                rays[j][i] -= tilted.multiplier * result.level[j][i];
            }
        }
        return rays;
    };
    result.along = per_slope({1.0, 0.0});
    result.aside = per_slope({0.0, 1.0});
    return result;
}

/// Moves the origin of a footprint to the summit of the droplet on level ground without gravity. The projective map is
/// the most sensitive there.
void centre(std::array<Vec2, kBodySlices>& rim)
{
    constexpr int kSteps = 3;
    for (int step = 0; step < kSteps; ++step) {
        const PlanarMesh mesh = meshOf(rim);
        const std::unique_ptr<ConstrainedSolver> solver = directSolver(mesh);
        solver->prepare(Operator{});
        const SolvedRays heights = perPressure(*solver);
        // The parabola through the middle and two places ahead and behind
        constexpr std::size_t kRing = 2;
        const double x = rim.front().x * solvedRadius(kSolvedRings - kRing);
        const double y = rim[kBodySlices / 2].x * solvedRadius(kSolvedRings - kRing);
        const double ahead = (heights.front()[kRing] - heights.front()[0]) / x;
        const double behind = (heights[kBodySlices / 2][kRing] - heights.front()[0]) / y;
        const double bend = (ahead - behind) / (x - y);
        const double summit = 0.5 * (bend * x - ahead) / bend;
        for (Vec2& point : rim) {
            point.x -= summit;
        }
    }
}

/// q at the vertices of a body.
/// @param disc  heights on a disc at every distance from its middle, close to 1 − ρ²
std::array<double, kBodyVertices> bodyField(const SolvedRays& rays, const std::array<double, kSolvedRings>& disc,
                                            const std::array<double, kBodyRings>& radii)
{
    std::array<double, kBodyVertices> field;
    field[kBodyApex] = rays[0][0] / disc[0];
    for (std::size_t j = 0; j < kBodySlices; ++j) {
        std::array<double, kSolvedRings> ray;
        for (std::size_t i = 0; i < kSolvedRings; ++i) {
            ray[i] = rays[j][i] / disc[i];
        }
        for (std::size_t k = 0; k < kBodyRings; ++k) {
            field[k * kBodySlices + j] = valueAt(ray, radii[k]);
        }
    }
    return field;
}

/// Share of the way between two neighbours of a rising list, and the index of the first.
template <std::size_t Count>
std::pair<std::size_t, double> locate(const std::array<double, Count>& rising, double value)
{
    std::size_t i = 0;
    while (i + 2 < Count && rising[i + 1] <= value) {
        ++i;
    }
    return {i, std::clamp((value - rising[i]) / (rising[i + 1] - rising[i]), 0.0, 1.0)};
}

/// ρ of a body's rings on a cap, at even steps of the polar angle.
std::array<double, kBodyRings> capRadii(double tangent)
{
    std::array<double, kBodyRings> radii{1.0};
    for (std::size_t k = 1; k < kBodyRings; ++k) {
        const double share = 1.0 - static_cast<double>(k) / static_cast<double>(kBodyRings);
        radii[k] = std::tan(std::atan(tangent) * share) / tangent;
    }
    return radii;
}

/// ρ of a body's rings on a round droplet, at even steps of the sum of the arc's length and of its turn, each over its
/// total.
/// @param q  along a slice, to any scale
std::array<double, kBodyRings> evenRadii(std::array<double, kSolvedRings> q, double tangent)
{
    const double at_rim = valueAt(q, 1.0);  // 1 at the contact angle
    for (double& value : q) {
        value /= at_rim;
    }
    constexpr std::size_t kSamples = 200;
    const auto place_of = [&](double radius) {
        const double w = (1.0 - radius * radius) * valueAt(q, radius);
        const double inverse = 1.0 / (1.0 + tangent * tangent * (1.0 - w));
        return Vec2{radius * (1.0 + tangent * tangent) * inverse, tangent * w * inverse};
    };
    // Samples are even on a cap, too.
    const auto radius_of = [&](std::size_t sample) {
        return std::tan(std::atan(tangent) * static_cast<double>(sample) / kSamples) / tangent;
    };
    std::array<double, kSamples + 1> arcs{};
    std::array<double, kSamples + 1> turns{};
    Vec2 last = place_of(0.0);
    double last_slope = 0.0;
    for (std::size_t i = 1; i <= kSamples; ++i) {
        const Vec2 next = place_of(radius_of(i));
        const double slope = std::atan2(last.y - next.y, next.x - last.x);
        arcs[i] = arcs[i - 1] + length(next - last);
        turns[i] = turns[i - 1] + std::abs(slope - last_slope);
        last = next;
        last_slope = slope;
    }
    std::array<double, kSamples + 1> way{};
    for (std::size_t i = 0; i <= kSamples; ++i) {
        way[i] = 0.5 * (arcs[i] / arcs.back() + turns[i] / turns.back());
    }
    std::array<double, kBodyRings> radii{1.0};
    for (std::size_t k = 1; k < kBodyRings; ++k) {
        const auto [i, share] = locate(way, 1.0 - static_cast<double>(k) / static_cast<double>(kBodyRings));
        radii[k] = radius_of(i) + share * (radius_of(i + 1) - radius_of(i));
    }
    return radii;
}

/// 1 − ρ² of a vertex.
double paraboloid(const std::array<double, kBodyRings>& radii, std::size_t vertex)
{
    const std::size_t ring = vertex / kBodySlices;
    return ring < kBodyRings ? 1.0 - radii[ring] * radii[ring] : 1.0;
}

/// Sets all slices to their mean.
template <std::size_t Rings>
void average(std::array<std::array<double, Rings>, kBodySlices>& rays)
{
    for (std::size_t i = 0; i < Rings; ++i) {
        double sum = 0.0;
        for (const auto& ray : rays) {
            sum += ray[i];
        }
        for (auto& ray : rays) {
            ray[i] = sum / static_cast<double>(kBodySlices);
        }
    }
}

}  // namespace

CapillaryBody::CapillaryBody(const ForceModel& model)
{
    const double angle = model.wetting.contact_angle;
    tangent_ = std::tan(0.5 * angle);
    cap_radius_ = capOf(1.0, angle).contact_radius;
    weight_ = model.liquid.density / model.liquid.surface_tension;
    wedge_speed_ = model.wetting.viscosity_factor > 0.0 ? model.liquid.surface_tension / model.wetting.viscosity_factor
                                                        : std::numeric_limits<double>::infinity();
    slope_share_ = 8.0 * capVolume(1.0, angle) / (std::numbers::pi * squared(std::sin(angle)));
    const double hanging = 6.0 * squared(std::cos(0.5 * angle));  // droplets are then nearly as large as can hang
    std::transform(kHanging.begin(), kHanging.end(), bonds_.begin(), [&](double share) { return share * hanging; });
    std::copy(kStanding.begin(), kStanding.end(), bonds_.begin() + kLevel);

    // On small footprints of wide contact angles droplets roll without a tail.
    const double longest = std::min(1.0, 2.0 * std::cos(0.5 * angle));
    rows_.resize(kElongations);
    for (std::size_t e = 0; e < kElongations; ++e) {
        rows_[e].rim = runningFootprint(longest * static_cast<double>(e) / static_cast<double>(kElongations - 1));
    }
    tbb::parallel_for(std::size_t{1}, kElongations, [&](std::size_t e) { centre(rows_[e].rim); });
    std::vector<Solved> solved(kElongations * kBonds);
    tbb::parallel_for(std::size_t{0}, solved.size(), [&](std::size_t i) {
        solved[i] = solveAll(meshOf(rows_[i / kBonds].rim), bonds_[i % kBonds]);
        if (i < kBonds) {
            average(solved[i].level);
        }
    });
    // Dividing by the discrete solution on the disc, rather than by 1 − ρ², cancels most of its error.
    std::array<double, kSolvedRings> disc = solved[kLevel].level[0];
    for (double& height : disc) {
        height *= 4.0;
    }
    for (std::size_t b = 0; b < kBonds; ++b) {
        std::array<double, kSolvedRings> q = solved[b].level[0];
        for (std::size_t i = 0; i < kSolvedRings; ++i) {
            q[i] /= disc[i];
        }
        radii_[b] = b == kLevel ? capRadii(tangent_) : evenRadii(q, tangent_);
    }
    tbb::parallel_for(std::size_t{0}, kElongations, [&](std::size_t e) {
        for (std::size_t b = 0; b < kBonds; ++b) {
            const Solved& one = solved[e * kBonds + b];
            Entry& entry = rows_[e].entries[b];
            entry.level = bodyField(one.level, disc, radii_[b]);
            entry.along = bodyField(one.along, disc, radii_[b]);
            entry.aside = bodyField(one.aside, disc, radii_[b]);
        }
        scale(rows_[e]);
    });
    calibrate(angle);
}

void CapillaryBody::calibrate(double angle)
{
    // Heights over the cube root of the volume, over that of a cap
    const auto slimness = [&](std::size_t b) {
        BodyGrid grid;
        place(grid, {rows_[0].rim, 1.0, radii_[b]}, rows_[0].entries[b].level);
        close(grid);
        return grid.apex.z / std::cbrt(volumeOf(grid));
    };
    const double cap = slimness(kLevel);
    const double cap_volume = capVolume(1.0, angle);
    const double true_cap = tangent_ / std::cbrt(cap_volume);
    std::array<double, kBonds> bonds{};
    for (const bool hangs : {false, true}) {
        const std::vector<AxialDroplet> droplets = axialDroplets(angle, hangs);
        const double sign = hangs ? -1.0 : 1.0;
        const auto slimness_of = [&](const AxialDroplet& one) { return one.height / std::cbrt(one.volume) / true_cap; };
        const auto bond_of = [&](const AxialDroplet& one) {
            return sign * std::pow(one.volume / cap_volume, 2.0 / 3.0);
        };
        for (std::size_t b = hangs ? 0 : kLevel + 1; b < (hangs ? kLevel : kBonds); ++b) {
            const double wanted = slimness(b) / cap;
            std::size_t k = 0;
            while (k + 2 < droplets.size() && (slimness_of(droplets[k + 1]) - wanted) * sign > 0.0) {
                ++k;
            }
            const double first = slimness_of(droplets[k]);
            const double share = (wanted - first) / (slimness_of(droplets[k + 1]) - first);
            bonds[b] = bond_of(droplets[k]) + share * (bond_of(droplets[k + 1]) - bond_of(droplets[k]));
        }
    }
    for (Row& row : rows_) {
        for (std::size_t b = 0; b < kBonds; ++b) {
            row.cap_bonds[b] = bonds[b] * row.entries[b].growth / rows_[0].entries[b].growth;
        }
    }
}

void CapillaryBody::scale(Row& row) const
{
    row.height = 0.0;
    for (const Vec2 p : row.rim) {
        row.height = std::max(row.height, p.y);
    }
    // Without gravity, w is 1 at its largest; with gravity, the mean slope at the rim is the same.
    const auto mean_slope = [&](const Field& q) {
        double sum = 0.0;
        double total = 0.0;
        for (std::size_t j = 0; j < kBodySlices; ++j) {
            const Vec2 along = row.rim[(j + 1) % kBodySlices] - row.rim[(j + kBodySlices - 1) % kBodySlices];
            sum += dot(along, along) / cross(row.rim[j], along) * q[j];
            total += length(along);
        }
        return sum / total;
    };
    const Field& level = row.entries[kLevel].level;
    double most = 0.0;
    for (std::size_t v = 0; v < kBodyVertices; ++v) {
        most = std::max(most, paraboloid(radii_[kLevel], v) * level[v]);
    }
    const double slope = mean_slope(level) / most;
    for (std::size_t b = 0; b < kBonds; ++b) {
        Entry& entry = row.entries[b];
        const double factor = slope / mean_slope(entry.level);
        for (double& q : entry.level) {
            q *= factor;
        }
        limitSlopes(row, radii_[b], entry);
    }
}

void CapillaryBody::limitSlopes(const Row& row, const std::array<double, kBodyRings>& radii, Entry& entry) const
{
    const double t = tangent_;
    // Slopes make the liquid thinner on one side, to 40 % at most, and the bulge at most 1.5 times as wide.
    constexpr double kThinned = 0.6;
    constexpr double kWidened = 0.5;
    constexpr double kFar = 1e6;
    entry.ahead = kFar;
    entry.behind = kFar;
    entry.sideways = kFar;
    for (std::size_t v = 0; v < kBodyVertices; ++v) {
        const double bulge = t * t * paraboloid(radii, v);
        const double room = kWidened * (1.0 + t * t - bulge * entry.level[v]);
        const double level = kThinned * entry.level[v] / std::sqrt(1.0 + t * t);
        const auto limit = [&](double change) {
            const double thinned = change < 0.0 ? level / -change : kFar;
            return change > 0.0 && bulge > 0.0 ? std::min(thinned, room / (bulge * change)) : thinned;
        };
        entry.ahead = std::min(entry.ahead, limit(entry.along[v]));
        entry.behind = std::min(entry.behind, limit(-entry.along[v]));
        entry.sideways = std::min({entry.sideways, limit(entry.aside[v]), limit(-entry.aside[v])});
    }

    BodyGrid grid;
    place(grid, {row.rim, row.height, radii}, entry.level);
    close(grid);
    BodyGrid cap;
    Field ones;
    ones.fill(1.0);
    place(cap, {rows_[0].rim, 1.0, radii_[kLevel]}, ones);
    close(cap);
    entry.growth = std::pow(volumeOf(grid) / volumeOf(cap), 2.0 / 3.0);
}

void CapillaryBody::place(BodyGrid& grid, const Base& footprint, const Field& q) const
{
    const double t = tangent_;
    const double t2 = t * t;
    for (std::size_t k = 0; k < kBodyRings; ++k) {
        const double share = 1.0 - footprint.radii[k] * footprint.radii[k];
        const double* const values = &q[k * kBodySlices];
        for (std::size_t j = 0; j < kBodySlices; ++j) {
            const double w = share * values[j];
            const double inverse = 1.0 / (1.0 + t2 * (1.0 - w));
            const double out = footprint.radii[k] * (1.0 + t2) * inverse;
            grid.x[k][j + 1] = out * footprint.rim[j].x;
            grid.y[k][j + 1] = out * footprint.rim[j].y;
            grid.z[k][j + 1] = footprint.height * t * w * inverse;
        }
    }
    const double w = q[kBodyApex];
    grid.apex = {0.0, 0.0, footprint.height * t * w / (1.0 + t2 * (1.0 - w))};
    for (std::size_t j = 0; j < kBodySlices; ++j) {
        // Derivative of the map at the rim, where w falls by 2 q per ρ.
        const double out = 2.0 * t2 * q[j] - 1.0 - t2;
        grid.inward[j] = {out * footprint.rim[j].x, out * footprint.rim[j].y, 2.0 * footprint.height * t * q[j]};
    }
}

double CapillaryBody::elongation(double volume, double speed) const
{
    const double stretch = speed / wedge_speed_ + weight_ * speed * speed * std::cbrt(volume);
    return stretch / (1.0 + stretch);
}

BodyGrid CapillaryBody::shape(const BodyConditions& conditions) const
{
    const double per_gravity = weight_ * squared(cap_radius_ * std::cbrt(conditions.volume));
    const double place_e = elongation(conditions.volume, conditions.speed) * static_cast<double>(kElongations - 1);
    const std::size_t e = std::min(static_cast<std::size_t>(place_e), kElongations - 2);
    const double longer = place_e - static_cast<double>(e);
    double bond = 0.0;
    for (const std::size_t i : {std::size_t{0}, std::size_t{1}}) {
        const auto [k, share] = locate(rows_[e + i].cap_bonds, -conditions.gravity.z * per_gravity);
        bond += (i == 0 ? 1.0 - longer : longer) * (bonds_[k] + share * (bonds_[k + 1] - bonds_[k]));
    }
    const auto [b, heavier] = locate(bonds_, bond);
    struct Corner {
        const Entry* entry;
        double weight;
    };
    const std::array<Corner, 4> corners{{{&rows_[e].entries[b], (1.0 - longer) * (1.0 - heavier)},
                                         {&rows_[e].entries[b + 1], (1.0 - longer) * heavier},
                                         {&rows_[e + 1].entries[b], longer * (1.0 - heavier)},
                                         {&rows_[e + 1].entries[b + 1], longer * heavier}}};
    const auto mixed = [&](double Entry::*value) {
        double sum = 0.0;
        for (const Corner& corner : corners) {
            sum += corner.weight * corner.entry->*value;
        }
        return sum;
    };
    // The contact radius is that of the cap divided by the root of `growth`.
    const double per_slope = slope_share_ * per_gravity / mixed(&Entry::growth);
    const double ahead = per_slope * conditions.gravity.x;
    const double aside = per_slope * conditions.gravity.y;
    const double far_ahead = ahead / (ahead > 0.0 ? mixed(&Entry::ahead) : mixed(&Entry::behind));
    const double far_aside = aside / mixed(&Entry::sideways);
    const double limited = 1.0 / std::sqrt(1.0 + far_ahead * far_ahead + far_aside * far_aside);
    const double x = limited * ahead;
    const double y = limited * aside;

    Field q;
    const auto add = [&](const Corner& corner, bool first) {
        const Field& level = corner.entry->level;
        const Field& along = corner.entry->along;
        const Field& across = corner.entry->aside;
        for (std::size_t v = 0; v < kBodyVertices; ++v) {
            q[v] = (first ? 0.0 : q[v]) + corner.weight * (level[v] + x * along[v] + y * across[v]);
        }
    };
    for (std::size_t i = 0; i < corners.size(); ++i) {
        add(corners[i], i == 0);
    }
    Base footprint;
    footprint.height = (1.0 - longer) * rows_[e].height + longer * rows_[e + 1].height;
    for (std::size_t k = 0; k < kBodyRings; ++k) {
        footprint.radii[k] = (1.0 - heavier) * radii_[b][k] + heavier * radii_[b + 1][k];
    }
    for (std::size_t j = 0; j < kBodySlices; ++j) {
        footprint.rim[j] = (1.0 - longer) * rows_[e].rim[j] + longer * rows_[e + 1].rim[j];
    }
    BodyGrid grid;
    place(grid, footprint, q);
    return grid;
}

}  // namespace droplet
