// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

namespace droplet {

/// Film behind running droplets, alike in pictures, textures and meshes. Beside the droplet it is as wide as the
/// droplet; behind, it draws together to an uneven rivulet with a round cross-section, becomes thinner as it drains,
/// and breaks up where it is narrow. What a droplet runs over it takes along, with the film of others.
struct TrailFilm {
    double thickness = 20e-6;           ///< spread over the droplet's width [m], ≥ 0
    bool becomes_beads = false;         ///< whether it breaks up altogether, as beads that are droplets take its place
    std::optional<double> drying = {};  ///< time in which it becomes thinner, to nothing [s], > 0; empty: never
    double kinematic_viscosity = 1e-6;  ///< of the liquid, which drains in standard gravity [m²/s], > 0

    /// Checks all fields.
    /// @throws Error InvalidArgument if a field is out of its range
    void validate() const;
};

}  // namespace droplet
