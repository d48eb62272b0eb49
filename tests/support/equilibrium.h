// SPDX-License-Identifier: GPL-3.0-or-later
//
// Forces on the vertices of a solved droplet, assembled independently: the gradient of
// ∫√(1+|∇u|²) (or ∫½|∇u|²) + ½w∫u² − (ρ/σ)∫(g∥·x)u − (λ/σ)∫u.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <vector>

#include "droplet/mesh/planar_mesh.h"
#include "droplet/mesh/triangulate.h"
#include "droplet/shape/figures.h"
#include "droplet/shape/solve.h"
#include "support/domains.h"
#include "support/heights.h"

namespace droplet::testing {

/// σ = ρ = 1, so that gravity is ρg/σ.
inline SolveOptions unitOptions(Model model, double gravity, double volume)
{
    SolveOptions options;
    options.liquid = {"unit", 1.0, 1.0};
    options.gravity = gravity;
    options.model = model;
    options.fill = {FillBy::Volume, volume, FillSharing::Each};
    return options;
}

inline std::vector<PlanarMesh> discMeshes(double edge)
{
    return triangulate(domainOf(ellipseLoop(1, 1)), {.edge = edge});
}

/// Mean order of convergence of errors on meshes whose edges are halved each time.
inline double meanOrder(const std::vector<double>& errors)
{
    return std::log2(errors.front() / errors.back()) / static_cast<double>(errors.size() - 1);
}

inline Vec2 gradientOn(const PlanarMesh& mesh, const Triangle& t, const std::vector<double>& u)
{
    const Vec2 e1 = mesh.vertices[t[1]] - mesh.vertices[t[0]];
    const Vec2 e2 = mesh.vertices[t[2]] - mesh.vertices[t[0]];
    const double d1 = u[t[1]] - u[t[0]];
    const double d2 = u[t[2]] - u[t[0]];
    const double twice = cross(e1, e2);
    return {(d1 * e2.y - d2 * e1.y) / twice, (d2 * e1.x - d1 * e2.x) / twice};
}

/// ∫f over the mesh, by quadrature at the edges' middles: exact for quadratics.
/// @param f  function of a point and of the interpolated value of `values` there
inline double integrate(const PlanarMesh& mesh, const std::vector<double>& values,
                        const std::function<double(Vec2, double)>& f)
{
    double sum = 0.0;
    for (const Triangle& t : mesh.triangles) {
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t j = (i + 1) % 3;
            const Vec2 p = 0.5 * (mesh.vertices[t[i]] + mesh.vertices[t[j]]);
            sum += doubleArea(mesh, t) / 6.0 * f(p, 0.5 * (values[t[i]] + values[t[j]]));
        }
    }
    return sum;
}

/// √∫(u − exact)²
inline double l2Error(const PlanarMesh& mesh, const CapillarySurface& field, const std::function<double(Vec2)>& exact)
{
    return std::sqrt(integrate(mesh, heightsOf(field), [&](Vec2 p, double u) {
        const double error = u - exact(p);
        return error * error;
    }));
}

/// ∫f along the rim, by the trapezoidal rule.
/// @param f  function of a rim vertex and the outward normal of an edge at it
inline double integrateRim(const PlanarMesh& mesh, const std::function<double(std::uint32_t, Vec2)>& f)
{
    double sum = 0.0;
    for (std::size_t loop = 0; loop < mesh.loopCount(); ++loop) {
        for (std::uint32_t v = mesh.loop_starts[loop]; v < mesh.loop_starts[loop + 1]; ++v) {
            const std::uint32_t next = nextOnRim(mesh, loop, v);
            const Vec2 along = mesh.vertices[next] - mesh.vertices[v];
            const double edge = length(along);
            const Vec2 outward = (1.0 / edge) * Vec2{along.y, -along.x};
            sum += 0.5 * edge * (f(v, outward) + f(next, outward));
        }
    }
    return sum;
}

/// Deviation of a droplet from equilibrium. Forces are relative to the largest force on any vertex.
struct Equilibrium {
    double free_force = 0.0;     ///< largest force on an inner vertex that is not held
    double held_force = 0.0;     ///< smallest force on a held vertex; positive: the ground pushes the surface up
    double held_gap = 0.0;       ///< largest |u − h| at a held vertex
    double rim_gap = 0.0;        ///< largest |u − h| at a rim vertex
    double min_thickness = 0.0;  ///< smallest u − h at any vertex
    double volume = 0.0;
};

inline Equilibrium equilibrium(const PlanarMesh& mesh, const CapillarySurface& field, const SolveOptions& options)
{
    const double sigma = options.liquid.surface_tension;
    const double weight_density = options.liquid.density * options.gravity / sigma;
    const double w = weight_density * std::cos(options.tilt);
    const Vec2 along = weight_density * std::sin(options.tilt) *
                       Vec2{std::cos(options.tilt_direction), std::sin(options.tilt_direction)};
    const std::vector<double> u = heightsOf(field);
    std::vector<double> force(u.size(), 0.0);
    std::vector<double> size(u.size(), 0.0);
    Equilibrium found;
    for (const Triangle& t : mesh.triangles) {
        const double area = 0.5 * doubleArea(mesh, t);
        const Vec2 g = gradientOn(mesh, t, u);
        const double stretch = options.model == Model::Exact ? std::sqrt(1.0 + dot(g, g)) : 1.0;
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec2 opposite = mesh.vertices[t[(i + 2) % 3]] - mesh.vertices[t[(i + 1) % 3]];
            const Vec2 hat = (0.5 / area) * Vec2{-opposite.y, opposite.x};
            const double tension = area * dot(g, hat) / stretch;
            double weight = 0.0;
            for (std::size_t j = 0; j < 3; ++j) {
                weight += area / (i == j ? 6.0 : 12.0) * (w * u[t[j]] - dot(along, mesh.vertices[t[j]]));
            }
            const double push = field.pressure / sigma * area / 3.0;
            force[t[i]] += tension + weight - push;
            size[t[i]] += std::abs(tension) + std::abs(weight) + std::abs(push);
            found.volume += area / 3.0 * thicknessAt(field, t[i], options.ground);
        }
    }
    const double largest = *std::max_element(size.begin(), size.end());
    found.held_force = std::numeric_limits<double>::infinity();
    found.min_thickness = std::numeric_limits<double>::infinity();
    for (std::uint32_t v = 0; v < u.size(); ++v) {
        const double gap = std::abs(thicknessAt(field, v, options.ground));
        found.min_thickness = std::min(found.min_thickness, thicknessAt(field, v, options.ground));
        if (mesh.onRim(v)) {
            found.rim_gap = std::max(found.rim_gap, gap);
        } else if (!field.dry.empty() && field.dry[v] != 0) {
            found.held_force = std::min(found.held_force, force[v] / largest);
            found.held_gap = std::max(found.held_gap, gap);
        } else {
            found.free_force = std::max(found.free_force, std::abs(force[v]) / largest);
        }
    }
    return found;
}

}  // namespace droplet::testing
