// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/shape/spread.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "droplet/shape/figures.h"
#include "droplet/units.h"
#include "shape/cap.h"
#include "shape/recovered_normals.h"

namespace droplet {
namespace {

/// Angle up to which meshes do not change: even triangles on the ground are as good, and keep their lattice. At 60° the
/// rim's triangles are twice as long on the surface as on the ground.
constexpr double kSteep = 60.0 * kDegree;

/// Largest angle for which meshes are spread: toward 90° triangles at the rim become infinitely thin.
constexpr double kSteepest = 86.0 * kDegree;

/// Mean of the squared slope along the rim.
double meanSquaredSlope(const PlanarMesh& mesh, const CapillarySurface& field)
{
    double sum = 0.0;
    double rim_length = 0.0;
    const std::vector<double> slopes = rimSlopes(field, {});
    for (std::size_t loop = 0; loop < mesh.loopCount(); ++loop) {
        for (std::uint32_t v = mesh.loop_starts[loop]; v < mesh.loop_starts[loop + 1]; ++v) {
            const double edge = length(mesh.vertices[nextOnRim(mesh, loop, v)] - mesh.vertices[v]);
            sum += edge * slopes[v] * slopes[v];
            rim_length += edge;
        }
    }
    return sum / rim_length;
}

/// Displacement of every vertex [m].
std::vector<Vec2> displacements(const PlanarMesh& mesh, const CapillarySurface& field, double angle)
{
    double highest = 0.0;
    for (const Vec3& p : field.vertices) {
        highest = std::max(highest, p.z);
    }
    const double t = std::tan(0.5 * angle);
    const double squared = t * t;
    // On a disc of radius 1 with u ∝ 1 − r² the projection maps r to r(1 + t²) / (1 + t²r²). So a point moves along −r,
    // the direction of ∇u, by t²(1 − r²) / (1 + t²r²). The scale makes this independent of the sizes of u and the
    // footprint: the spacing at the rim shrinks by (1 − t²) / (1 + t²) = cos θ where the slope is the mean slope.
    const double scale = 2.0 * highest / meanSquaredSlope(mesh, field);
    const double max = 2.0 * squared / (1.0 + squared);
    const std::vector<Vec3> normals = recoveredNormals(field, {});
    std::vector<Vec2> moves(normals.size());
    for (std::size_t v = mesh.rimVertexCount(); v < moves.size(); ++v) {
        const double height = field.vertices[v].z;
        const double share = height / highest;
        const Vec2 gradient = (-1.0 / normals[v].z) * Vec2{normals[v].x, normals[v].y};
        const double slope = length(gradient);
        if (!(slope > 0.0 && share > 0.0)) {
            continue;
        }
        const double wanted = scale * squared * share / (1.0 + squared * (1.0 - share)) * slope;
        // u / |∇u| is about the distance to the rim.
        moves[v] = (-std::min(wanted, max * height / slope) / slope) * gradient;
    }
    return moves;
}

/// Moves the vertices of a mesh as far as every triangle keeps a share of its area.
void move(PlanarMesh& mesh, const std::vector<Vec2>& moves, double angle)
{
    constexpr double kShrink = 0.7;
    constexpr int kMaxShrinks = 40;
    // A triangle at a cap's rim keeps about cos θ of its area; some keep less.
    const double min = 0.25 * std::cos(angle);
    PlanarMesh moved = mesh;
    double part = 1.0;
    for (int k = 0; k < kMaxShrinks; ++k, part *= kShrink) {
        for (std::size_t v = 0; v < moves.size(); ++v) {
            moved.vertices[v] = mesh.vertices[v] + part * moves[v];
        }
        const bool whole = std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const Triangle& t) {
            return doubleArea(moved, t) >= min * doubleArea(mesh, t);
        });
        if (whole) {
            moved.lattice = {};
            mesh = std::move(moved);
            return;
        }
    }
}

}  // namespace

bool spreads(const SolveOptions& options)
{
    const Fill& fill = options.fill;
    const bool has_small_angle = options.volumes.empty() && fill.by == FillBy::ContactAngle &&
                                 fill.sharing == FillSharing::Each && fill.amount <= kSteep;
    return options.model != Model::Linear && !has_small_angle;
}

std::vector<PlanarMesh> spread(std::vector<PlanarMesh> meshes, const SolveOptions& options)
{
    if (!spreads(options)) {
        return meshes;
    }
    // For the mean steepness neither tilt nor ground nor gravity away from the ground matters.
    SolveOptions level = options;
    level.model = Model::Linear;
    level.gravity = std::max(planeGravity(options).normal, 0.0);
    level.tilt = 0.0;
    level.ground = {};
    level.no_penetration = false;
    if (level.fill.by == FillBy::ContactAngle) {
        level.fill.amount = linearAngleOfCap(level.fill.amount);
    }
    const Solution solution = solve(meshes, level);
    if (!solution.report.usable()) {
        return meshes;
    }
    tbb::parallel_for(std::size_t{0}, meshes.size(), [&](std::size_t k) {
        const CapillarySurface& field = solution.droplets[k];
        const double linear = measure(field, level).contact_angle.mean;
        const double angle = std::min(capAngleOfLinear(linear), kSteepest);
        if (angle > kSteep) {
            move(meshes[k], displacements(meshes[k], field, angle), angle);
        }
    });
    return meshes;
}

}  // namespace droplet
