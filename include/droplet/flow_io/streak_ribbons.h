// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "droplet/flow/flow.h"
#include "droplet/flow/flow_surface.h"
#include "droplet/flow_io/trail_film.h"
#include "droplet/surface/surface.h"
#include "droplet/vector.h"

namespace droplet {

/// Ribbons at a time.
struct StreakMesh {
    Surface surface;             ///< without triangles if there are no streaks
    std::vector<double> wetted;  ///< when each triangle was wetted [s]
    std::vector<double> gone;    ///< when nothing of it is left, or up to √2 times as long after `wetted` [s]
};

/// Mesh of the streaks behind droplets: a ribbon along the path of each droplet, from face to face. Where a droplet has
/// flown over more than its width, one ribbon ends and another begins.
class StreakRibbons {
public:
    /// Makes a builder without streaks.
    /// @throws Error InvalidArgument if an option is out of its range
    explicit StreakRibbons(const TrailFilm& film = {});

    /// Adds the paths of one advanceFlow(). Straight paths over a face need few points.
    /// @param tracks   FlowState::tracks, of ascending times for each droplet
    /// @param surface  that the droplets run over; the same in all calls, and longer there than the ribbons
    void add(std::span<const FlowTrack> tracks, const FlowSurface& surface);

    /// Forgets ribbons that are dry at a time, which mesh() would leave out from then on.
    /// @param time  [s]
    void forgetDry(double time);

    /// Ribbons at a time, in the order of the droplets' ids, with the sections of TrailFilm: five vertices across, of
    /// which the outer ones lie a tenth of the height over the surface. Where the film has broken up there are gaps.
    /// uv: u from 0 to 1 across it, v the distance along it over its mean width. It is open below.
    /// @param time  [s]; not before the last track
    /// @param shape  another shape of the surface that the ribbons are on; null: that of their tracks
    [[nodiscard]] StreakMesh mesh(double time, const FlowSurface* shape = nullptr) const;

    /// Ribbons of an animation in which each triangle is there from `wetted` on until `gone`: the film after it has
    /// drawn together.
    /// @param step  of time between frames; no triangle is wetted over one of its multiples [s], > 0
    [[nodiscard]] StreakMesh growing(double step) const;

private:
    struct Point {
        Vec3 place;              // [m]
        Vec3 normal;             // of the surface there, unit
        double width = 0.0;      // [m]
        double time = 0.0;       // [s]
        double speed = 0.0;      // [m/s]
        std::uint32_t face = 0;  // of the piece that ends here
        Vec3 rest;               // the place where the track was [m]
    };
    using Ribbon = std::vector<Point>;  // at least two points

    static void extend(Ribbon& ribbon, const FlowTrack& track, Vec3 normal);
    [[nodiscard]] Ribbon onShape(Ribbon ribbon, const FlowSurface& shape) const;
    [[nodiscard]] StreakMesh meshOf(std::optional<double> time, std::optional<double> step,
                                    const FlowSurface* shape) const;

    TrailFilm film_;
    const FlowSurface* surface_ = nullptr;                  // of the tracks
    std::map<std::uint64_t, std::vector<Ribbon>> ribbons_;  // by the droplet's id
};

}  // namespace droplet
