// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "body/body_grid.h"
#include "droplet/body/droplet_body.h"
#include "droplet/vector.h"
#include "droplet/wind/forces.h"

namespace droplet {

/// Network of springs and its forces. The ground is z = 0.
struct SpringNetwork {
    std::size_t slices = 8;      ///< M, at least 3
    std::size_t levels = 4;      ///< N, at least 1; the basis is one of them
    double radius = 1.0;         ///< of the circle through the basis points [m]
    double volume = 1.0;         ///< of the network [m³]
    double longitudinal = 1.0;   ///< stiffness k_l of the springs between levels [N/m]
    double transverse = 1.0;     ///< stiffness k_t of the springs along the basis; those of level i have k_t s_i [N/m]
    double guide = 1.0;          ///< stiffness of the springs from the guide point to the basis [N/m]
    double guide_length = 10.0;  ///< their rest length over the radius
    Vec3 force;                  ///< uniform field: force on every point above the basis [N]
};

/// Network in balance.
struct SpringBalance {
    std::vector<Vec3> points;  ///< A_{i,j} at (i − 1) M + j − 1, the apex last [m]
    double pressure = 0.0;     ///< force of the solco connection per weight [N]
    std::vector<double> rods;  ///< tensions along the basis [N]
    std::size_t steps = 0;     ///< of Newton's method
};

/// s_i = (N + 1 − i)/N, the size of a level over that of the basis.
/// @param level  i, from 1 to N + 1
double levelScale(const SpringNetwork& network, std::size_t level);

/// Weight α_i of a level in the volume S/(3N²) Σ α_i h_i; 0 for the basis.
double levelWeight(const SpringNetwork& network, std::size_t level);

/// Finds the balance of a network, to 1e-12 of its forces.
///
/// Stiff springs are rigid: the basis points stay on the ground and the sides of the basis keep their length; the solco
/// connection keeps the weighted sum of heights exactly. The guide point is the centre of the basis.
/// @throws Error NoSuchDroplet if Newton's method does not converge
SpringBalance balance(const SpringNetwork& network);

/// Smooth skin: uniform bicubic B-splines, closed around; the rim is on the ground.
BodyGrid skin(const SpringNetwork& network, const std::vector<Vec3>& points);

/// Droplets of springs under gravity. Balance and skin are affine in the force, because the levels only shift: a few
/// balances give them all. The speed has no influence.
class SpringBody {
public:
    /// @param model  valid
    explicit SpringBody(const ForceModel& model);

    /// Shape of a droplet, of any size.
    [[nodiscard]] BodyGrid shape(const BodyConditions& conditions) const;

private:
    BodyGrid rest_;
    std::array<BodyGrid, 3> changes_;  ///< per force along x, y and z
    double per_gravity_ = 0.0;         ///< force on a point of a droplet of volume 1, over σ and gravity
    double largest_force_ = 0.0;       ///< limit, so that levels stay above each other
};

}  // namespace droplet
