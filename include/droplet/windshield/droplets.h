// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "droplet/vector.h"

namespace droplet {

struct StillCells;

/// Droplet large enough to run; it may be at rest. Its shape is a spherical cap.
struct RunningDroplet {
    std::uint64_t id = 0;     ///< unique; selects the droplet's random stream
    Vec2 position;            ///< centre, on the unrolled glass (Glass) [m]
    Vec2 velocity;            ///< [m/s]; exactly 0 at rest
    double volume = 0.0;      ///< [m³], > 0
    double since_bead = 0.0;  ///< distance run since it last left water behind [m]
    std::uint64_t beads = 0;  ///< number of times that it left water behind

    friend bool operator==(const RunningDroplet&, const RunningDroplet&) = default;  ///< Compares all members.
};

/// Droplet that never moves: it has less water than a raindrop of WindshieldParameters::still_diameter.
struct StillDroplet {
    Vec2 position;        ///< centre, on the unrolled glass [m]
    double volume = 0.0;  ///< [m³], > 0

    friend bool operator==(const StillDroplet&, const StillDroplet&) = default;  ///< Compares all members.
};

/// All still droplets of a glass; only startWindshield, step and stateFromBytes change them. The area of the glass
/// bounds the memory, however long it rains.
class StillDroplets {
public:
    /// Makes an empty set.
    StillDroplets();
    ~StillDroplets();
    StillDroplets(const StillDroplets& other);                 ///< Copies all droplets.
    StillDroplets(StillDroplets&& other) noexcept;             ///< Moves all droplets.
    StillDroplets& operator=(const StillDroplets& other);      ///< Copies all droplets.
    StillDroplets& operator=(StillDroplets&& other) noexcept;  ///< Moves all droplets.

    /// Number of droplets.
    [[nodiscard]] std::size_t count() const;
    /// All droplets; their order depends on history.
    [[nodiscard]] std::vector<StillDroplet> all() const;

    friend bool operator==(const StillDroplets& a, const StillDroplets& b);  ///< Compares droplets and their order.

private:
    friend struct StillCells;
    std::unique_ptr<StillCells> cells_;  // empty: no droplets
};

/// Straight path of a running droplet in the last step. It swept everything within `radius` of the path.
struct TrackPiece {
    std::uint64_t id = 0;  ///< id of the droplet
    Vec2 from;             ///< [m]
    Vec2 to;               ///< [m]
    double radius = 0.0;   ///< half the droplet's width, seen from above [m]

    friend bool operator==(const TrackPiece&, const TrackPiece&) = default;  ///< Compares all members.
};

}  // namespace droplet
