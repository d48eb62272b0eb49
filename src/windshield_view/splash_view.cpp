// SPDX-License-Identifier: GPL-3.0-or-later
#include "windshield_view/splash_view.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace droplet {

void SplashView::update(const std::vector<Splash>& splashes, double time)
{
    const MapWindow& window = scene_.tiles.window();
    std::vector<SplashRim> rims;
    for (const Splash& splash : splashes) {
        const Vec2 p = splash.position;
        const double reach = 2.0 * splash.radius;  // with its rim
        if (p.x + reach < window.low.x || p.x - reach > window.high.x || p.y + reach < window.low.y ||
            p.y - reach > window.high.y) {
            continue;
        }
        if (const std::optional<SplashRim> rim = SplashRim::of(splash, time)) {
            rims.push_back(*rim);
        }
    }
    tiles_.clear();
    if (rims.empty()) {
        return;
    }
    tiles_.resize(scene_.tiles.count());
    for (std::size_t k = 0; k < tiles_.size(); ++k) {
        const ViewTile& tile = scene_.tiles[k];
        if (!tile.on_glass) {
            continue;
        }
        for (const SplashRim& rim : rims) {
            const float reach = rim.reach() + tile.pixel;
            const float x = std::clamp(rim.middle.x, tile.low.x, tile.high.x) - rim.middle.x;
            const float y = std::clamp(rim.middle.y, tile.low.y, tile.high.y) - rim.middle.y;
            if (x * x + y * y < reach * reach) {
                tiles_[k].push_back(rim);
            }
        }
    }
}

SplashMet SplashView::at(std::size_t tile, Vec2f place, float pixel) const
{
    SplashMet met;
    for (const SplashRim& rim : tiles_[tile]) {
        const Vec2f from{place.x - rim.middle.x, place.y - rim.middle.y};
        const float far = std::sqrt(from.x * from.x + from.y * from.y);
        met.inside = std::max(met.inside, rim.strength() * within(rim.radius - far, pixel));
        if (far > 0.0F && std::abs(far - rim.radius) < 2.0F * rim.half_width + pixel) {
            const Vec2f outward{from.x / far, from.y / far};
            const float half = rim.halfWidthTowards(outward);
            constexpr float kHalfDisc = 0.5F;
            WaterMet water = Bead{2.0F * half, kHalfDisc}.at(far - rim.radius + half, outward, pixel);
            water.cover *= rim.strength();
            if (water.cover > met.rim.cover) {
                met.rim = water;
            }
        }
    }
    return met;
}

}  // namespace droplet
