// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

#include "drawing/tone.h"
#include "droplet/windshield_view/view.h"
#include "windshield_view/backdrop.h"
#include "windshield_view/body_relief.h"
#include "windshield_view/eye.h"
#include "windshield_view/tiles.h"
#include "windshield_view/water_optics.h"

namespace droplet {

/// Share from 0 to 1 as a level from 0 to 255.
inline std::uint8_t level8(float share)
{
    return static_cast<std::uint8_t>(nearest(255.0F * share, 255));
}

/// Constant parts of the view: options, glass, eye, tiles and backdrop.
struct ViewContext {
    ViewContext(const Glass& its_glass, const ViewOptions& its_options)
        : options(its_options),
          glass(its_glass),
          eye(glass, options),
          tiles(eye, glass, options),
          backdrop(options.width, options.height, eye.halfWidth(),
                   0.5F * eye.tangent() * static_cast<float>(options.height)),
          reliefs(glass, options.body, options.forces)
    {
    }

    /// Offset from the middle of a pixel of the k-th ray in a row [px].
    [[nodiscard]] float offset(int k) const
    {
        return (static_cast<float>(k) + 0.5F) / static_cast<float>(options.samples) - 0.5F;
    }

    /// Level of the backdrop for rays through a droplet, which shows about the whole picture across its diameter.
    /// @param diameter  diameter of the droplet [px]
    [[nodiscard]] std::uint8_t levelFor(float diameter) const
    {
        constexpr float kShare = 0.8F;
        return backdrop.levelOf(kShare * static_cast<float>(options.width) /
                                std::max(diameter * static_cast<float>(options.samples), 1.0F));
    }

    /// Number of moments at which a moving object is drawn while the shutter is open; from one to the next it moves
    /// about a pixel.
    /// @return  a power of two
    [[nodiscard]] int momentsOf(Vec2 position, double speed) const
    {
        const auto place = options.shutter_time > 0.0 && speed > 0.0 ? glass.place(position) : std::nullopt;
        if (!place) {
            return 1;
        }
        constexpr double kApart = 1.25;  // [px]
        constexpr double kMax = 64.0;
        const double pixel = static_cast<double>(eye.tangent()) * std::max(eye.seen(*place).point.y, 1e-3);
        const double moments = std::ceil(speed * options.shutter_time / (kApart * pixel));
        return static_cast<int>(std::bit_ceil(static_cast<unsigned>(std::clamp(moments, 1.0, kMax))));
    }

    /// Time of a moment, relative to the state's time [s].
    [[nodiscard]] double timeOf(int moment, int moments) const
    {
        return options.shutter_time * ((moment + 0.5) / moments - 0.5);
    }

    /// Places on the glass of the pixels of a tile.
    struct TilePlaces {
        const Eye& eye;
        int left = 0;
        int top = 0;
        float pixel = 0.0F;  ///< as ViewTile::pixel

        /// As Eye::place(); NaN beyond the frame.
        Vec2f operator()(std::size_t index) const
        {
            constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
            const int x = left + static_cast<int>(index % kTile);
            const int y = top + static_cast<int>(index / kTile);
            return x < eye.width() && y < eye.height() ? eye.place(x, y) : Vec2f{kNone, kNone};
        }
    };
    [[nodiscard]] TilePlaces placesOf(std::size_t tile) const
    {
        const auto columns = static_cast<std::size_t>(tiles.columns());
        return {eye, static_cast<int>(tile % columns) * kTile, static_cast<int>(tile / columns) * kTile,
                tiles[tile].pixel};
    }

    /// Refraction of a ray that leaves water on the glass.
    /// @param slope  slope of the water along the glass's x and y
    [[nodiscard]] Interface beyond(Vec2f slope, const ViewTile& tile, Vec3f ray) const
    {
        const auto ior = static_cast<float>(options.ior);
        Interface out = intoAir(intoWater(toFrame(tile.frame, ray), ior), unit({-slope.x, -slope.y, 1.0F}), ior);
        out.transmitted = fromFrame(tile.frame, out.transmitted);
        return out;
    }

    ViewOptions options;
    Glass glass;
    Eye eye;
    Tiles tiles;
    Backdrop backdrop;
    Reliefs reliefs;  ///< shapes of running droplets
};

}  // namespace droplet
