// SPDX-License-Identifier: GPL-3.0-or-later
#include "windshield_view/film_optics.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace droplet {

FilmOptics FilmOptics::of(const ViewContext& scene, std::size_t number)
{
    const Eye& eye = scene.eye;
    const ViewTile& tile = scene.tiles[number];
    const auto columns = static_cast<std::size_t>(scene.tiles.columns());
    const float half = 0.5F * kTile;
    const std::size_t row = number / columns;
    const Vec3f ray =
        unit(eye.rayAt(static_cast<float>(number % columns) * kTile + half, static_cast<float>(row) * kTile + half));
    const auto through = [&](Vec2f slope) {
        const Interface out = scene.beyond(slope, tile, ray);
        const float scale = 1.0F / (std::max(out.transmitted.y, 1e-3F) * eye.tangent());
        return std::pair(Vec2f{scale * out.transmitted.x, -scale * out.transmitted.z}, out.reflected);
    };
    constexpr float kSlope = 0.01F;  // of usual films
    const auto by = [&](Vec2f slope) {
        const Vec2f more = through(slope).first;
        const Vec2f less = through({-slope.x, -slope.y}).first;
        return Vec2f{(more.x - less.x) / (2.0F * kSlope), (more.y - less.y) / (2.0F * kSlope)};
    };
    constexpr float kSteps = 512.0F;  // so few that tables of levels serve many tiles
    return {by({kSlope, 0.0F}), by({0.0F, kSlope}), std::round(kSteps * through({}).second) / kSteps};
}

}  // namespace droplet
