// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "droplet/vector.h"

namespace droplet {

struct StillCells;

/// A droplet large enough to run, whether it does or rests: a spherical cap by its volume and the contact angle.
struct RunningDroplet {
    std::uint64_t id = 0;     ///< never used again; its random numbers hang on it
    Vec2 position;            ///< of its middle, on the rolled out glass (Glass) [m]
    Vec2 velocity;            ///< [m/s]; exactly 0 at rest
    double volume = 0.0;      ///< [m³], > 0
    double since_bead = 0.0;  ///< way since it last left water behind [m]
    std::uint64_t beads = 0;  ///< how often it did

    friend bool operator==(const RunningDroplet&, const RunningDroplet&) = default;
};

/// A droplet of less water than a raindrop of WindshieldParameters::still_diameter: it never moves.
struct StillDroplet {
    Vec2 position;        ///< [m]
    double volume = 0.0;  ///< [m³], > 0

    friend bool operator==(const StillDroplet&, const StillDroplet&) = default;
};

/// The still droplets of a glass: a value that the windshield's functions alone change. Its memory is bounded by the
/// glass's area, however long it rains.
class StillDroplets {
public:
    StillDroplets();
    ~StillDroplets();
    StillDroplets(const StillDroplets& other);
    StillDroplets(StillDroplets&& other) noexcept;
    StillDroplets& operator=(const StillDroplets& other);
    StillDroplets& operator=(StillDroplets&& other) noexcept;

    /// How many there are.
    [[nodiscard]] std::size_t count() const;
    /// All of them, in an order that depends on history.
    [[nodiscard]] std::vector<StillDroplet> all() const;

    friend bool operator==(const StillDroplets& a, const StillDroplets& b);

private:
    friend struct StillCells;
    std::unique_ptr<StillCells> cells_;  ///< empty: none
};

/// The way of a running droplet in the last step: it swept all within `radius` of it.
struct TrackPiece {
    std::uint64_t id = 0;
    Vec2 from;  ///< [m]
    Vec2 to;
    double radius = 0.0;  ///< half its width, seen from above [m]

    friend bool operator==(const TrackPiece&, const TrackPiece&) = default;
};

}  // namespace droplet
