// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "droplet/flow/flow.h"
#include "droplet/flow/flow_parameters.h"
#include "droplet/flow/flow_terrain.h"
#include "droplet/progress.h"
#include "droplet/vector.h"
#include "droplet/wind/forces.h"

namespace droplet {

/// How many droplets have which radius r.
enum class DewSizes {
    /// Droplets that condensed, grew and joined: n(r) ∝ r^(−8/3) (E. J. Le Fevre and J. W. Rose, "A theory of heat
    /// transfer by dropwise condensation", Proc. 3rd Int. Heat Transfer Conf. 2 (1966) 362).
    Condensation,
    LogNormal,  ///< the logarithm of r has a normal distribution: sprayed or rained on
};

/// Ellipsoid that has a droplet, as far as it is off the ground.
struct DewExtent {
    Vec3 middle;               ///< from the droplet's place [m]
    std::array<Vec3, 3> axes;  ///< half of each [m], perpendicular to one another; the first two are along the ground
                               ///< unless all are alike
};

/// Options of dewDroplets.
struct DewOptions {
    double coverage = 0.4;                    ///< share of the surface below droplets, from 0.001 to 0.7
    double smallest = 0.2e-3;                 ///< radius of the smallest droplets seen from above: dewRadius() [m], > 0
    double largest = 1.2e-3;                  ///< of the largest ones [m], ≥ smallest; larger ones come from joining
    DewSizes sizes = DewSizes::Condensation;  ///< how many have which radius
    double median = 0.6e-3;                   ///< of the radii, LogNormal [m], > 0
    double spread = 0.5;                      ///< standard deviation of their logarithm, LogNormal, from 0 to 3
    ForceModel forces = {};                   ///< liquid, contact angle, and the slopes that hold a droplet
    FlowPinning pinning = {};                 ///< how hysteresis varies; with one seed as droplets that run
    Vec3 gravity = {0.0, 0.0, -kStandardGravity};  ///< in the object's frame [m/s²]
    std::optional<Vec3> from = {};  ///< only where rain from this direction meets the object first; not 0
    /// Probability, 0 … 1, that a point of the surface may have a droplet; empty: 1.
    std::function<double(const FlowTerrain::Point&)> weight = {};
    /// Ellipsoid that has a droplet with a volume on ground with a normal; empty: the ball of its cap without gravity.
    std::function<DewExtent(double volume, Vec3 normal)> extent = {};
    bool inside = false;     ///< also on inner sides, which see next to nothing of the outside
    std::uint64_t seed = 1;  ///< of the random numbers

    /// Checks all fields.
    /// @throws Error InvalidArgument if a field is out of its range
    void validate() const;
};

/// What kept droplets from the places that they tried.
enum class DewObstacle {
    None,
    Droplets,  ///< there was no room between others
    Slopes,    ///< they would have run off, or fallen
    Edges,     ///< they are too large for the ground between edges
};

/// Droplets at rest on an object.
struct DewDroplets {
    std::vector<FlowSample> samples;           ///< at rest, from large to small as they were placed; ids count from 0
    double area = 0.0;                         ///< of the surface where droplets may be [m²]
    double covered = 0.0;                      ///< of it, below droplets [m²]
    std::size_t joined = 0;                    ///< droplets that found no room and became part of others
    std::size_t run_off = 0;                   ///< droplets that no slope holds
    std::size_t between_edges = 0;             ///< droplets that find no place clear of the object's edges
    DewObstacle obstacle = DewObstacle::None;  ///< what kept most of the droplets tried last from a place
};

/// Radius of a droplet seen from above, without gravity: that of its contact circle, or beyond 90° of its equator [m].
/// @param volume         [m³], > 0
/// @param contact_angle  [rad], in (0, π)
double dewRadius(double volume, double contact_angle);

/// Covers an object with droplets at rest.
///
/// Droplets are placed at random from large to small. None touches another; one that finds no room in some tries joins
/// the one that it met, which grows and may meet others. None is larger than its slope holds, by contact angle
/// hysteresis, or surface tension below an overhang, as for droplets that run. None hangs over the end of the surface,
/// and no contact line crosses a sharp edge, where Gibbs' condition would hold it: both ends of an edge of over 50°,
/// and what lies farther off the droplet's plane than a ridge of 37° below its middle. More are placed as long as the
/// coverage is not reached and they find room. The share of it that falls to ground that holds no droplet runs off.
///
/// Guarantees: the same options give the same droplets.
/// @param terrain  the object
/// @param options  share, sizes, place, what holds droplets
/// @param progress  called with Stage::Solve and the share of the droplets that were tried
/// @throws Error   InvalidArgument if an option is out of its range, or the coverage takes over a million droplets;
///                 InvalidInput if the object has no place for them
DewDroplets dewDroplets(const FlowTerrain& terrain, const DewOptions& options, const Progress& progress = {});

}  // namespace droplet
