// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "droplet/windshield/droplets.h"
#include "view/sight.h"

namespace droplet {

/// What a ray through a droplet that may run shows.
struct Ray {
    PlaceInPicture place;
    std::uint8_t pixel = 0;  ///< of the tile
    std::uint8_t light = 0;  ///< share of it that gets through, in 255ths
    std::uint8_t cover = 0;  ///< of a ray's share of the pixel, in 255ths
    bool is_whole = false;   ///< it stands for the whole pixel
};

/// Rays through a droplet that reaches into a tile, at one of the moments at which it is looked at while the shutter is
/// open.
struct RaysInTile {
    const std::vector<Ray>* rays = nullptr;
    int moment = 0;
    int moments = 1;  ///< a power of two; 1: it is where it is all the time
};

/// Rays through droplets that may run, kept as long as a droplet rests.
class RunningRays {
public:
    /// @param sight  must outlive this
    explicit RunningRays(const Sight& sight) : sight_(sight), in_tiles_(sight.tiles.count()) {}

    /// Brings the rays to the state of the droplets.
    /// @param droplets  in the order of their ids
    void follow(const std::vector<RunningDroplet>& droplets);

    /// Those of each droplet that reaches into a tile, in the droplets' order and that of their moments.
    [[nodiscard]] const std::vector<RaysInTile>& inTile(std::size_t tile) const { return in_tiles_[tile]; }

private:
    struct Traced;
    /// A droplet's rays in a tile, those of a pixel one after another.
    struct Part {
        std::uint32_t tile = 0;
        int moment = 0;
        std::vector<Ray> rays;
    };
    /// A droplet as it is drawn.
    struct Drawn {
        RunningDroplet droplet;
        int moments = 1;
        std::vector<Part> parts;
    };

    [[nodiscard]] Drawn drawn(const RunningDroplet& droplet) const;
    [[nodiscard]] Traced prepared(const RunningDroplet& droplet) const;
    void trace(const Traced& one, std::vector<Part>& parts) const;
    void trace(const Traced& one, int column, int row, std::vector<Ray>& rays) const;

    const Sight& sight_;
    std::vector<Drawn> drawn_;
    std::vector<std::vector<RaysInTile>> in_tiles_;
};

}  // namespace droplet
