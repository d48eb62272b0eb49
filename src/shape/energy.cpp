// SPDX-License-Identifier: GPL-3.0-or-later
//
// The thesis, chapter 4: energy (4.1)–(4.3) over P1 finite elements. In-plane gravity is a potential linear in x. The
// ground gives the rim values and the lower limit of the gravity integral.

#include "shape/energy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "blocks.h"
#include "mesh/lattice.h"
#include "shape/gradient.h"

namespace droplet {
namespace {

/// Sine of 89.9°, the upper limit for fluxes: recovered ones may exceed 1 by their error.
constexpr double kSteepestFlux = 0.9999985;

/// Number of smoothing passes. Forces on single vertices oscillate with the lengths of the edges beside them: by 1.7°
/// of angle on a disc of 3000 triangles at 60°; after four passes by 0.1°.
constexpr int kSmoothingPasses = 4;

std::vector<double> rimWeightsOf(const PlanarMesh& mesh)
{
    std::vector<double> weights(mesh.rimVertexCount(), 0.0);
    for (std::size_t loop = 0; loop < mesh.loopCount(); ++loop) {
        for (std::uint32_t v = mesh.loop_starts[loop]; v < mesh.loop_starts[loop + 1]; ++v) {
            const std::uint32_t next = nextOnRim(mesh, loop, v);
            const double half = 0.5 * length(mesh.vertices[next] - mesh.vertices[v]);
            weights[v] += half;
            weights[next] += half;
        }
    }
    return weights;
}

/// Whether neither a rim vertex nor the next is a corner.
std::vector<std::uint8_t> openEdgesOf(const PlanarMesh& mesh)
{
    constexpr double kCorner = 0.5;  // sin 30°; a smooth rim turns by less at a vertex
    std::vector<std::uint8_t> smooth(mesh.rimVertexCount(), 0);
    std::vector<std::uint8_t> open(mesh.rimVertexCount(), 0);
    for (std::size_t loop = 0; loop < mesh.loopCount(); ++loop) {
        std::uint32_t before = mesh.loop_starts[loop + 1] - 1;
        for (std::uint32_t v = mesh.loop_starts[loop]; v < mesh.loop_starts[loop + 1]; ++v) {
            const Vec2 in = mesh.vertices[v] - mesh.vertices[before];
            const Vec2 out = mesh.vertices[nextOnRim(mesh, loop, v)] - mesh.vertices[v];
            const double lengths = length(in) * length(out);
            smooth[v] = dot(in, out) > 0.0 && std::abs(cross(in, out)) < kCorner * lengths ? 1 : 0;
            before = v;
        }
        for (std::uint32_t v = mesh.loop_starts[loop]; v < mesh.loop_starts[loop + 1]; ++v) {
            open[v] = smooth[v] != 0 && smooth[nextOnRim(mesh, loop, v)] != 0 ? 1 : 0;
        }
    }
    return open;
}

std::vector<double> loadOf(const PlanarMesh& mesh)
{
    std::vector<double> load(mesh.vertices.size(), 0.0);
    const std::size_t irregular = irregularTriangleCount(mesh);
    for (std::size_t i = 0; i < irregular; ++i) {
        const Triangle& t = mesh.triangles[i];
        const double third = doubleArea(mesh, t) / 6.0;
        for (const std::uint32_t v : t) {
            load[v] += third;
        }
    }
    for (const GridRun& run : regularRuns(mesh.lattice.get())) {
        // A third of each of six equilateral triangles.
        const double regular = 0.5 * std::numbers::sqrt3 * mesh.lattice->edge * mesh.lattice->edge;
        std::fill_n(load.begin() + run.first, run.count, regular);
    }
    return load;
}

/// Triangles that touch the rim; all of them are irregular.
std::vector<std::uint32_t> rimTrianglesOf(const PlanarMesh& mesh)
{
    std::vector<std::uint32_t> triangles;
    const std::size_t count = irregularTriangleCount(mesh);
    for (std::uint32_t i = 0; i < count; ++i) {
        const Triangle& t = mesh.triangles[i];
        if (mesh.onRim(std::min({t[0], t[1], t[2]}))) {
            triangles.push_back(i);
        }
    }
    return triangles;
}

}  // namespace

Energy::Energy(const PlanarMesh& mesh, const BaseSurface& ground, const Physics& physics)
    : mesh_(&mesh),
      physics_(physics),
      load_(loadOf(mesh)),
      rim_weights_(rimWeightsOf(mesh)),
      rim_open_(openEdgesOf(mesh)),
      rim_triangles_(rimTrianglesOf(mesh))
{
    area_ = std::accumulate(load_.begin(), load_.end(), 0.0);
    rim_length_ = std::accumulate(rim_weights_.begin(), rim_weights_.end(), 0.0);
    smoothed_weights_ = smoothed(rim_weights_, kSmoothingPasses);
    if (!ground.flat()) {
        sampleGround(ground);
    }
}

std::vector<double> Energy::smoothed(std::vector<double> forces, int times) const
{
    const PlanarMesh& mesh = *mesh_;
    std::vector<double> next;
    for (int k = 0; k < times; ++k) {
        next = forces;
        for (std::size_t loop = 0; loop < mesh.loopCount(); ++loop) {
            for (std::uint32_t v = mesh.loop_starts[loop]; v < mesh.loop_starts[loop + 1]; ++v) {
                if (rim_open_[v] != 0) {
                    const std::uint32_t other = nextOnRim(mesh, loop, v);
                    const double moved = 0.25 * (forces[v] - forces[other]);
                    next[v] -= moved;
                    next[other] += moved;
                }
            }
        }
        forces.swap(next);
    }
    return forces;
}

std::vector<double> Energy::fluxOf(const std::vector<double>& forces) const
{
    const PlanarMesh& mesh = *mesh_;
    std::vector<double> flux = smoothed(forces, kSmoothingPasses);
    for (std::size_t loop = 0; loop < mesh.loopCount(); ++loop) {
        double missing = 0.0;
        double rim_length = 0.0;
        for (std::uint32_t v = mesh.loop_starts[loop]; v < mesh.loop_starts[loop + 1]; ++v) {
            flux[v] /= smoothed_weights_[v];
            missing += forces[v] - flux[v] * rim_weights_[v];
            rim_length += rim_weights_[v];
        }
        // Balances need the total force of the loop.
        for (std::uint32_t v = mesh.loop_starts[loop]; v < mesh.loop_starts[loop + 1]; ++v) {
            flux[v] += missing / rim_length;
        }
    }
    return flux;
}

void Energy::sampleGround(const BaseSurface& ground)
{
    const PlanarMesh& mesh = *mesh_;
    ground_.resize(mesh.vertices.size());
    forBlocks(mesh.vertices.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t v = begin; v < end; ++v) {
            ground_[v] = ground.at(mesh.vertices[v]).height;
        }
    });
    for (std::size_t loop = 0; loop < mesh.loopCount(); ++loop) {
        std::uint32_t before = mesh.loop_starts[loop + 1] - 1;
        for (std::uint32_t v = mesh.loop_starts[loop]; v < mesh.loop_starts[loop + 1]; ++v) {
            const Vec2 chord = mesh.vertices[nextOnRim(mesh, loop, v)] - mesh.vertices[before];
            const Vec2 along = (1.0 / length(chord)) * chord;
            const Vec2 slope = ground.at(mesh.vertices[v]).gradient;
            rim_stretch_.push_back(std::hypot(1.0, dot(slope, along)));
            // Liquid lies left of the rim.
            ground_angle_.push_back(std::atan(cross(along, slope) / rim_stretch_.back()));
            before = v;
        }
    }
}

double Energy::groundFlux(std::uint32_t rim_vertex) const
{
    if (ground_angle_.empty()) {
        return 0.0;
    }
    const double angle = ground_angle_[rim_vertex];
    return physics_.model == Model::Linear ? rim_stretch_[rim_vertex] * std::tan(angle) : std::sin(angle);
}

std::pair<double, double> Energy::contactAngle(std::uint32_t rim_vertex, double flux) const
{
    const double ground = ground_angle_.empty() ? 0.0 : ground_angle_[rim_vertex];
    double angle = 0.0;
    double derivative = 0.0;
    // Seen along the rim, the liquid rises by (∂u/∂n) / √(1 + (∂u/∂t)²), and ∂u/∂t = ∂h/∂t there.
    if (physics_.model == Model::Linear) {
        const double stretch = rim_stretch_.empty() ? 1.0 : rim_stretch_[rim_vertex];
        const double rise = flux / stretch;
        angle = std::atan(rise) - ground;
        derivative = 1.0 / (stretch * (1.0 + rise * rise));
    } else {
        // The flux (∂u/∂n) / √(1 + (∂u/∂t)² + (∂u/∂n)²) is the sine of that angle.
        const double sine = std::clamp(flux, -kSteepestFlux, kSteepestFlux);
        angle = std::asin(sine) - ground;
        derivative = sine == flux ? 1.0 / std::sqrt(1.0 - sine * sine) : 0.0;
    }
    // On level flat ground the liquid stays above it; a negative angle is an error of the recovery.
    const bool above = physics_.no_penetration || (isLevelAndFlat() && physics_.normal >= 0.0);
    if (above && angle < 0.0) {
        return {0.0, 0.0};
    }
    return {angle, derivative};
}

std::vector<std::uint32_t> Energy::dryRim(const std::vector<std::uint8_t>& held) const
{
    const PlanarMesh& mesh = *mesh_;
    const std::uint32_t rim = mesh.rimVertexCount();
    std::vector<std::uint32_t> dry;
    if (held.empty()) {
        return dry;
    }
    std::vector<std::uint8_t> wet(rim, 0);
    for (const std::uint32_t i : rim_triangles_) {
        const Triangle& t = mesh.triangles[i];
        const bool has_liquid =
            std::any_of(t.begin(), t.end(), [&](std::uint32_t v) { return !mesh.onRim(v) && held[v - rim] == 0; });
        for (const std::uint32_t v : t) {
            if (has_liquid && mesh.onRim(v)) {
                wet[v] = 1;
            }
        }
    }
    for (std::uint32_t v = 0; v < rim; ++v) {
        if (wet[v] == 0) {
            dry.push_back(v);
        }
    }
    return dry;
}

bool Energy::isLevelAndFlat() const
{
    return ground_.empty() && physics_.along == Vec2{};
}

std::vector<double> Energy::gradient(const std::vector<double>& u) const
{
    const PlanarMesh& mesh = *mesh_;
    std::vector<double> result(mesh.vertices.size(), 0.0);
    for (const Triangle& t : mesh.triangles) {
        const std::array<Vec2, 3> hats = hatGradients(mesh, t);
        const double area = 0.5 * doubleArea(mesh, t);
        const Vec2 slope = u[t[0]] * hats[0] + u[t[1]] * hats[1] + u[t[2]] * hats[2];
        const double stretch = physics_.model == Model::Exact ? 1.0 / std::sqrt(1.0 + dot(slope, slope)) : 1.0;
        const Vec2 flux = area * stretch * slope;
        // ∫fφ for a linear f = wu − s·x on a triangle: A/12 (sum over its corners + value at the vertex).
        std::array<double, 3> head{};
        for (std::size_t k = 0; k < 3; ++k) {
            head[k] = physics_.normal * u[t[k]] - dot(physics_.along, mesh.vertices[t[k]]);
        }
        const double sum = head[0] + head[1] + head[2];
        for (std::size_t k = 0; k < 3; ++k) {
            result[t[k]] += dot(flux, hats[k]) + area / 12.0 * (sum + head[k]);
        }
    }
    return result;
}

Operator Energy::hessian(const std::vector<double>& u) const
{
    Operator op;
    op.mass_weight = physics_.normal;
    if (physics_.model == Model::Linear) {
        return op;
    }
    op.tensors.resize(mesh_->triangles.size());
    forBlocks(mesh_->triangles.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const Vec2 p = droplet::gradient(*mesh_, mesh_->triangles[i], u);
            // ∂²√(1+p²)/∂p² = (I − ppᵀ/(1+p²)) / √(1+p²).
            const double squared = 1.0 + dot(p, p);
            const double scale = 1.0 / std::sqrt(squared);
            op.tensors[i] = {scale * (1.0 - p.x * p.x / squared), -scale * p.x * p.y / squared,
                             scale * (1.0 - p.y * p.y / squared)};
        }
    });
    return op;
}

std::vector<double> Energy::applied(const Operator& op, const std::vector<double>& x) const
{
    std::vector<double> result(mesh_->vertices.size(), 0.0);
    for (std::size_t i = 0; i < mesh_->triangles.size(); ++i) {
        const Triangle& t = mesh_->triangles[i];
        const auto matrix = elementMatrix(*mesh_, i, op);
        for (std::size_t a = 0; a < 3; ++a) {
            result[t[a]] += matrix[a][0] * x[t[0]] + matrix[a][1] * x[t[1]] + matrix[a][2] * x[t[2]];
        }
    }
    return result;
}

std::vector<double> Energy::appliedOnRim(const Operator& op, const std::vector<double>& x) const
{
    const std::uint32_t rim = mesh_->rimVertexCount();
    const auto at = [&](std::uint32_t v) { return v < rim ? 0.0 : x[v - rim]; };
    std::vector<double> result(rim, 0.0);
    for (const std::uint32_t i : rim_triangles_) {
        const Triangle& t = mesh_->triangles[i];
        const auto matrix = elementMatrix(*mesh_, i, op);
        for (std::size_t a = 0; a < 3; ++a) {
            if (mesh_->onRim(t[a])) {
                result[t[a]] += matrix[a][0] * at(t[0]) + matrix[a][1] * at(t[1]) + matrix[a][2] * at(t[2]);
            }
        }
    }
    return result;
}

}  // namespace droplet
