// SPDX-License-Identifier: GPL-3.0-or-later
//
// The film of Runoff has cells of some millimetres. Between them its thickness is a quadratic spline; what is finer is
// a RunoffRelief. The slope of both displaces what lies behind.
#include "windshield_view/runoff_view.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace droplet {
namespace {

constexpr int kBorder = 2;  // cells

}  // namespace

void RunoffView::update(const Runoff& film)
{
    reach_.clear();
    if (film.thickness.empty()) {
        return;
    }
    relief_ = RunoffRelief(film.drift);
    cell_ = static_cast<float>(film.cell);
    per_metre_ = 1.0F / cell_;
    columns_ = static_cast<int>(film.columns);
    rows_ = static_cast<int>(film.rows);
    const int across = columns_ + 2 * kBorder;
    thickness_.resize(static_cast<std::size_t>(across) * static_cast<std::size_t>(rows_ + 2 * kBorder));
    auto* to = thickness_.data();
    for (int row = 0; row < rows_ + 2 * kBorder; ++row) {
        const auto from = static_cast<std::size_t>(std::clamp(row - kBorder, 0, rows_ - 1)) * film.columns;
        for (int column = 0; column < across; ++column) {
            const auto k = from + static_cast<std::size_t>(std::clamp(column - kBorder, 0, columns_ - 1));
            *to++ = static_cast<float>(Runoff::kThickness * film.thickness[k]);
        }
    }
    const Tiles& tiles = scene_.tiles;
    reach_.resize(tiles.count());
    optics_.resize(tiles.count());
    tbb::parallel_for(std::size_t{0}, tiles.count(), [&](std::size_t number) {
        const ViewTile& tile = tiles[number];
        const auto cell_of = [&](float x, int count) {
            return std::clamp(static_cast<int>(std::floor(x / cell_)), 0, count - 1);
        };
        for (int row = cell_of(tile.low.y - cell_, rows_); tile.on_glass && row <= cell_of(tile.high.y + cell_, rows_);
             ++row) {
            const auto first = static_cast<std::size_t>(row) * film.columns;
            const auto* const begin = film.thickness.data() + first + cell_of(tile.low.x - cell_, columns_);
            const auto* const end = film.thickness.data() + first + cell_of(tile.high.x + cell_, columns_) + 1;
            if (std::any_of(begin, end, [](std::int32_t thickness) { return thickness > 0; })) {
                reach_[number] = 1;
                break;
            }
        }
        if (reach_[number] != 0 && !optics_[number]) {
            optics_[number] = FilmOptics::of(scene_, number);
        }
    });
}

[[gnu::always_inline]] inline Float4 RunoffView::thicknessAt(Vec2f place) const
{
    const float x = std::clamp(place.x * per_metre_, 0.0F, static_cast<float>(columns_));
    const float y = std::clamp(place.y * per_metre_, 0.0F, static_cast<float>(rows_));
    const auto column = std::min(static_cast<int>(x), columns_ - 1);
    const auto row = std::min(static_cast<int>(y), rows_ - 1);
    struct Weights {
        std::array<float, 3> of;
        std::array<float, 3> slope;
    };
    const auto weights = [](float t) {  // of a quadratic spline, 0 to 1 from edge to edge of the cell
        return Weights{{0.5F * (1.0F - t) * (1.0F - t), 0.5F + t * (1.0F - t), 0.5F * t * t},
                       {t - 1.0F, 1.0F - 2.0F * t, t}};
    };
    const Weights wx = weights(x - static_cast<float>(column));
    const Weights wy = weights(y - static_cast<float>(row));
    const int across = columns_ + 2 * kBorder;
    const float* from = thickness_.data() + std::ptrdiff_t{row + kBorder - 1} * across + column + kBorder - 1;
    Float4 thickness = float4(0.0F);
    for (std::size_t j = 0; j < 3; ++j, from += across) {
        const float value = wx.of[0] * from[0] + wx.of[1] * from[1] + wx.of[2] * from[2];
        const float slope = wx.slope[0] * from[0] + wx.slope[1] * from[1] + wx.slope[2] * from[2];
        thickness += Float4{wy.of[j], wy.of[j], wy.slope[j], 0.0F} * Float4{value, slope, value, 0.0F};
    }
    return thickness * Float4{1.0F, per_metre_, per_metre_, 0.0F};
}

void RunoffView::add(std::size_t tile, WaterLeft& left) const
{
    const FilmOptics& optics = *optics_[tile];
    const ViewContext::TilePlaces places = scene_.placesOf(tile);
    left.reflected = optics.reflected;
    for (std::size_t k = 0; k < kTilePixels; ++k) {
        const Vec2f place = places(k);
        if (std::isnan(place.x)) {
            continue;
        }
        const RunoffRelief::Surface film = relief_->at(place, thicknessAt(place), places.pixel, left.cover[k]);
        if (film.cover > left.cover[k]) {
            left.cover[k] = film.cover;
            left.shift_x[k] = optics.by_x.x * film.relief[1] + optics.by_y.x * film.relief[2];
            left.shift_y[k] = optics.by_x.y * film.relief[1] + optics.by_y.y * film.relief[2];
        }
    }
}

}  // namespace droplet
