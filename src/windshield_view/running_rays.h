// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "droplet/windshield/droplets.h"
#include "windshield_view/view_context.h"

namespace droplet {

/// Ray through a running droplet.
struct Ray {
    PlaceInPicture place;
    std::uint8_t pixel = 0;  ///< pixel of the tile
    std::uint8_t light = 0;  ///< share of light that is transmitted, in 255ths
    std::uint8_t cover = 0;  ///< share that is covered of the ray's part of the pixel, in 255ths
    bool is_whole = false;   ///< true: the only ray of its pixel
};

/// Rays through a droplet in a tile, at one moment while the shutter is open.
struct RaysInTile {
    const std::vector<Ray>* rays = nullptr;
    int moment = 0;
    int moments = 1;  ///< number of moments, a power of two; 1: the droplet does not move visibly
};

/// Rays through running droplets, kept as long as a droplet rests.
class RunningRays {
public:
    /// @param scene  must outlive this
    explicit RunningRays(const ViewContext& scene) : scene_(scene), in_tiles_(scene.tiles.count()) {}

    /// Updates the rays.
    /// @param droplets  running droplets, in the order of their ids
    void update(const std::vector<RunningDroplet>& droplets);

    /// Rays of each droplet in a tile, in the order of the droplets and of their moments.
    [[nodiscard]] const std::vector<RaysInTile>& inTile(std::size_t tile) const { return in_tiles_[tile]; }

private:
    struct Traced;
    /// Rays of a droplet in a tile; rays of one pixel are adjacent.
    struct Part {
        std::uint32_t tile = 0;
        int moment = 0;
        std::vector<Ray> rays;
    };
    /// Droplet with its rays.
    struct Drawn {
        RunningDroplet droplet;
        int moments = 1;
        std::vector<Part> parts;
    };

    [[nodiscard]] Drawn drawnOf(const RunningDroplet& droplet) const;
    [[nodiscard]] Traced prepare(const RunningDroplet& droplet, const BodyRelief* relief) const;
    void trace(const Traced& one, std::vector<Part>& parts) const;
    void trace(const Traced& one, int column, int row, std::vector<Ray>& rays) const;

    const ViewContext& scene_;
    std::vector<Drawn> drawn_;
    std::vector<std::vector<RaysInTile>> in_tiles_;
};

}  // namespace droplet
