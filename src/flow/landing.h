// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "droplet/flow/flow_surface.h"
#include "droplet/flow/leg.h"
#include "rays/triangle_tree.h"

namespace droplet {

/// Smallest box around all faces: its lowest and its highest corner [m].
std::pair<Vec3, Vec3> boxOf(const FlowSurface& surface);

/// Where droplets in free flight meet a surface; for any number of threads.
class Landing {
public:
    struct Hit {
        double time = 0.0;  ///< [s]
        std::uint32_t face = 0;
        Vec3 place;  ///< on the face [m]
    };

    /// @param surface  must outlive this
    /// @param scaled   the surface's triangles, with the box around them in [−1, 1]³
    Landing(const FlowSurface& surface, const std::vector<Corners3>& scaled);
    ~Landing();
    Landing(Landing&& other) noexcept;

    /// The first face that the flight meets from outside.
    /// @param flight  without friction: a parabola
    /// @param left    face that the droplet left
    /// @param from    [s], ≥ flight.begin
    /// @param to      [s]
    [[nodiscard]] std::optional<Hit> next(const Leg& flight, std::uint32_t left, double from, double to) const;

    /// The first face that a ray meets, from either side. The hit's time is without meaning.
    /// @param direction  not 0
    [[nodiscard]] std::optional<Hit> firstAlong(Vec3 origin, Vec3 direction) const;

private:
    struct Scene;
    std::unique_ptr<Scene> scene_;
};

}  // namespace droplet
