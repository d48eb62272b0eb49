// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "droplet/flow/flow.h"
#include "droplet/flow/flow_surface.h"
#include "droplet/surface/surface.h"
#include "droplet/vector.h"

namespace droplet {

/// Options of StreakRibbons.
struct StreakRibbonOptions {
    std::optional<double> drying = {};  ///< time after which a piece of a streak has vanished [s], > 0; empty: never
    double thickness = 20e-6;           ///< height of a ribbon's middle over the surface [m], ≥ 0

    /// Checks all fields.
    /// @throws Error InvalidArgument if a field is out of its range
    void validate() const;
};

/// Ribbons at a time.
struct StreakMesh {
    Surface surface;             ///< without triangles if there are no streaks
    std::vector<double> wetted;  ///< when each triangle was wetted [s]
};

/// Mesh of the streaks behind droplets: a ribbon along the path of each droplet, from face to face. Where a droplet has
/// flown over more than its width, one ribbon ends and another begins.
class StreakRibbons {
public:
    /// Makes a builder without streaks.
    /// @throws Error InvalidArgument if an option is out of its range
    explicit StreakRibbons(const StreakRibbonOptions& options = {});

    /// Adds the paths of one advanceFlow(). Straight paths over a face need few points.
    /// @param tracks   FlowState::tracks, of ascending times for each droplet
    /// @param surface  that the droplets run over; the same in all calls
    void add(std::span<const FlowTrack> tracks, const FlowSurface& surface);

    /// Ribbons at a time, in the order of the droplets' ids. A ribbon is as wide as the droplet, its ends are round,
    /// its middle is raised by the thickness and its sides by a fifth of it. uv: u from 0 to 1 across it, v the
    /// distance along it over its mean width. It is open below.
    /// @param time  [s]; not before the last track
    /// @param step  if given, no triangle is wetted over the multiples of this time, such as that of a frame [s], > 0
    [[nodiscard]] StreakMesh mesh(double time, std::optional<double> step = {}) const;

private:
    struct Point {
        Vec3 place;              // [m]
        Vec3 normal;             // of the surface there, unit
        double width = 0.0;      // [m]
        double time = 0.0;       // [s]
        std::uint32_t face = 0;  // of the piece that ends here
    };
    using Ribbon = std::vector<Point>;  // at least two points

    void extend(Ribbon& ribbon, const FlowTrack& track, Vec3 normal) const;
    [[nodiscard]] Ribbon wetPart(const Ribbon& ribbon, double time) const;

    StreakRibbonOptions options_;
    std::map<std::uint64_t, std::vector<Ribbon>> ribbons_;  // by the droplet's id
};

}  // namespace droplet
