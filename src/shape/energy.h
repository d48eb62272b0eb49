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

/// Forces on a liquid's surface, divided by the surface tension.
struct Physics {
    Model model = Model::Linear;
    double normal = 0.0;  ///< w = ρg⊥/σ [1/m²]
    Vec2 along;           ///< ρg∥/σ [1/m²]
    bool no_penetration = false;
};

/// Energy of one droplet, divided by σ, as a function of u, the height at every vertex of its mesh:
/// ∫a(∇u) + ½w∫(u² − h²) − ∫(s·x)(u − h). a(p) is 1 + ½p² in the linear model and √(1 + p²) in the exact one.
class Energy {
public:
    /// @param mesh  valid; kept by reference
    Energy(const PlanarMesh& mesh, const BaseSurface& ground, const Physics& physics);

    [[nodiscard]] const PlanarMesh& mesh() const { return *mesh_; }
    /// h at every vertex [m]; empty on flat ground.
    [[nodiscard]] const std::vector<double>& ground() const { return ground_; }
    [[nodiscard]] const Physics& physics() const { return physics_; }
    void use(Model model) { physics_.model = model; }
    /// m = ∫φ at every vertex [m²].
    [[nodiscard]] const std::vector<double>& load() const { return load_; }
    /// Half the length of both rim edges at every rim vertex [m].
    [[nodiscard]] const std::vector<double>& rimWeights() const { return rim_weights_; }
    /// Area of the footprint [m²].
    [[nodiscard]] double area() const { return area_; }
    /// Length of all rims [m].
    [[nodiscard]] double rimLength() const { return rim_length_; }
    /// Smooths forces on rim vertices between neighbours, but not across corners, so many times. Their sum stays.
    [[nodiscard]] std::vector<double> smoothed(std::vector<double> forces, int times) const;
    /// Smoothed flux through the rim, from forces on its vertices. The total on every loop stays.
    [[nodiscard]] std::vector<double> fluxOf(const std::vector<double>& forces) const;

    /// Inward flux −∂a/∂p·n of a sheet that lies on the ground, through the rim there; n points outward.
    [[nodiscard]] double groundFlux(std::uint32_t rim_vertex) const;
    /// Contact angle at a rim vertex [rad], and its derivative by the flux. It is not negative if the liquid cannot be
    /// below the ground: beside dry ground and on ragged rims, recovered angles oscillate around 0.
    [[nodiscard]] std::pair<double, double> contactAngle(std::uint32_t rim_vertex, double flux) const;

    /// Whether a sheet on the ground is in equilibrium without pressure: the ground is level and flat.
    [[nodiscard]] bool isLevelAndFlat() const;

    /// Rim vertices with all their triangles on the ground.
    [[nodiscard]] std::vector<std::uint32_t> dryRim(const std::vector<std::uint8_t>& held) const;

    /// ∂E/∂u at every vertex [m].
    [[nodiscard]] std::vector<double> gradient(const std::vector<double>& u) const;
    /// ∂²E/∂u².
    [[nodiscard]] Operator hessian(const std::vector<double>& u) const;
    /// ∂²E/∂u²·x at every vertex, for an x that is 0 on the rim.
    [[nodiscard]] std::vector<double> applied(const Operator& op, const std::vector<double>& x) const;
    /// The same at rim vertices only, for x given at inner vertices.
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
    std::vector<double> smoothed_weights_;
    std::vector<std::uint8_t> rim_open_;  ///< 1 if neither a rim vertex nor the next is a corner
    std::vector<double> rim_stretch_;     ///< √(1 + (∂h/∂t)²) along the rim; empty on flat ground
    std::vector<double>
        ground_angle_;  ///< slope angle of the ground across the rim, inward [rad]; empty on flat ground
    std::vector<std::uint32_t> rim_triangles_;
};

}  // namespace droplet
