// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "droplet/mesh/planar_mesh.h"
#include "droplet/shape/solve.h"
#include "shape/operator.h"

namespace droplet {

/// What acts on a liquid's surface, divided by the surface tension.
struct Physics {
    Model model = Model::Linear;
    double normal = 0.0;  ///< w = ρg⊥/σ [1/m²]
    Vec2 along;           ///< ρg∥/σ [1/m²]
    bool no_penetration = false;
};

/// The energy of one droplet as a function of u, the height at every vertex of its mesh, divided by σ:
/// ∫a(∇u) + ½w∫(u² − h²) − ∫(s·x)(u − h), with a(p) = 1 + ½p² or √(1 + p²) by the model.
class Energy {
public:
    /// @param mesh  valid; kept by reference
    Energy(const PlanarMesh& mesh, const BaseSurface& ground, const Physics& physics);

    [[nodiscard]] const PlanarMesh& mesh() const { return *mesh_; }
    /// h at every vertex [m]; empty where flat.
    [[nodiscard]] const std::vector<double>& ground() const { return ground_; }
    [[nodiscard]] const Physics& physics() const { return physics_; }
    void use(Model model) { physics_.model = model; }
    /// m = ∫φ at every vertex [m²].
    [[nodiscard]] const std::vector<double>& load() const { return load_; }
    /// Half the length of the two rim edges at every rim vertex [m].
    [[nodiscard]] const std::vector<double>& rimWeights() const { return rim_weights_; }
    /// Of the footprint [m²].
    [[nodiscard]] double area() const { return area_; }
    /// Of all its rims [m].
    [[nodiscard]] double rimLength() const { return rim_length_; }
    /// Forces on the rim's vertices, evened out between neighbours, but not across corners, so often; their sum stays.
    [[nodiscard]] std::vector<double> evenedOut(std::vector<double> forces, int times) const;
    /// The flux through the rim of forces on its vertices, evened out; over every loop it adds up to them.
    [[nodiscard]] std::vector<double> fluxOf(const std::vector<double>& forces) const;

    /// The slope −∂u/∂n at a rim vertex, n pointing outward, of a flux −∂a/∂p·n through the rim there.
    [[nodiscard]] double slopeOf(std::uint32_t rim_vertex, double flux) const;
    /// The flux of a sheet that lies on the ground there.
    [[nodiscard]] double groundFlux(std::uint32_t rim_vertex) const;
    /// The angle between liquid and ground at a rim vertex [rad], and its derivative by the flux. Where the liquid
    /// cannot be below the ground it is not negative: beside dry ground and on ragged rims recovered ones swing about
    /// 0.
    [[nodiscard]] std::pair<double, double> contactAngle(std::uint32_t rim_vertex, double flux) const;

    /// Whether the liquid's surface lies still on the ground without a pressure: level and flat.
    [[nodiscard]] bool restsOnGround() const;

    /// Rim vertices all of whose triangles lie on the ground.
    [[nodiscard]] std::vector<std::uint32_t> dryRim(const std::vector<std::uint8_t>& held) const;

    /// ∂E/∂u at every vertex [m].
    [[nodiscard]] std::vector<double> gradient(const std::vector<double>& u) const;
    /// ∂²E/∂u².
    [[nodiscard]] Operator hessian(const std::vector<double>& u) const;
    /// ∂²E/∂u²·x at every vertex, of an x that is 0 on the rim.
    [[nodiscard]] std::vector<double> applied(const Operator& op, const std::vector<double>& x) const;
    /// The same at the rim's vertices alone, of x at the inner vertices.
    [[nodiscard]] std::vector<double> appliedOnRim(const Operator& op, const std::vector<double>& x) const;

private:
    void sampleGround(const BaseSurface& ground);

    const PlanarMesh* mesh_;
    std::vector<double> ground_;
    Physics physics_;
    std::vector<double> load_;
    std::vector<double> rim_weights_;
    double area_ = 0.0;
    double rim_length_ = 0.0;
    std::vector<double> evened_weights_;
    std::vector<std::uint8_t> rim_open_;  ///< 1 where neither a rim vertex nor the next is a corner
    std::vector<double> rim_stretch_;     ///< √(1 + (∂h/∂t)²) along the rim; empty where flat
    std::vector<double> ground_angle_;    ///< of the ground across the rim, inward [rad]; empty where flat
    std::vector<std::uint32_t> rim_triangles_;
};

}  // namespace droplet
