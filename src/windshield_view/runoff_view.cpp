// SPDX-License-Identifier: GPL-3.0-or-later
//
// The film of Runoff has cells of some millimetres. Between them its thickness is a quadratic spline. Finer than that
// are fields that are chosen by eye: where its rims are when it is thin, and the waves that run over it, an orange-peel
// of bumps. Its slope displaces what lies behind.
#include "windshield_view/runoff_view.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace droplet {
namespace {

constexpr int kBorder = 2;  // cells
// Waves on the film, chosen by eye [m].
constexpr float kLong = 7e-3F;
constexpr float kHigh = 5e-3F;  // of long ones, up the glass
constexpr float kShort = 2.9e-3F;

Vec2f scaled(float factor, Vec2f v)
{
    return {factor * v.x, factor * v.y};
}

Vec2f sum(Vec2f a, Vec2f b)
{
    return {a.x + b.x, a.y + b.y};
}

}  // namespace

void RunoffView::update(const Runoff& film)
{
    reach_.clear();
    if (film.thickness.empty()) {
        return;
    }
    if (!noise_) {
        noise_.emplace();
    }
    // Long waves run half as fast. The field repeats.
    const auto run = [](double way, float wave) {
        return static_cast<float>(std::remainder(way / static_cast<double>(wave), double{SmoothNoise::kWaves}));
    };
    long_run_ = {run(0.5 * film.drift.x, kLong), run(0.5 * film.drift.y, kHigh)};
    short_run_ = {run(film.drift.x, kShort), run(film.drift.y, kShort)};
    cell_ = static_cast<float>(film.cell);
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

RunoffView::Sloped RunoffView::thicknessAt(Vec2f place) const
{
    const float x = std::clamp(place.x / cell_, 0.0F, static_cast<float>(columns_));
    const float y = std::clamp(place.y / cell_, 0.0F, static_cast<float>(rows_));
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
    Sloped thickness;
    for (std::size_t j = 0; j < 3; ++j, from += across) {
        const float value = wx.of[0] * from[0] + wx.of[1] * from[1] + wx.of[2] * from[2];
        thickness.value += wy.of[j] * value;
        thickness.slope.x += wy.of[j] * (wx.slope[0] * from[0] + wx.slope[1] * from[1] + wx.slope[2] * from[2]);
        thickness.slope.y += wy.slope[j] * value;
    }
    thickness.slope = scaled(1.0F / cell_, thickness.slope);
    return thickness;
}

RunoffView::Sloped RunoffView::distanceFromRim(Vec2f place, const Sloped& thickness) const
{
    constexpr float kThin = 50e-6F;   // where rims are [m]
    constexpr float kCoarse = 5e-3F;  // waves of the rims [m]
    constexpr float kFine = 1.7e-3F;
    const Float4 coarse = noise_->at(place.x / kCoarse, place.y / kCoarse);
    const Float4 fine = noise_->at(place.x / kFine, place.y / kFine);
    return {thickness.value / kThin + 0.9F * coarse[0] + 0.5F * fine[0] - 1.25F,
            {thickness.slope.x / kThin + 0.9F / kCoarse * coarse[1] + 0.5F / kFine * fine[1],
             thickness.slope.y / kThin + 0.9F / kCoarse * coarse[2] + 0.5F / kFine * fine[2]}};
}

RunoffView::Sloped RunoffView::wavesAt(Vec2f place) const
{
    const Float4 large = noise_->at(place.x / kLong - long_run_.x, place.y / kHigh - long_run_.y);
    const Float4 small = noise_->at(place.x / kShort - 3.0F - short_run_.x, place.y / kShort - short_run_.y);
    return {large[0] + 0.6F * small[0] - 0.8F,
            {large[1] / kLong + 0.6F / kShort * small[1], large[2] / kHigh + 0.6F / kShort * small[2]}};
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
        constexpr float kThinnest = 2e-6F;  // [m]
        constexpr float kWhole = 110e-6F;   // so thick a film has no rims [m]
        const Sloped thickness = thicknessAt(place);
        if (thickness.value < kThinnest) {
            continue;
        }
        const Sloped rim = thickness.value < kWhole ? distanceFromRim(place, thickness) : Sloped{1.0F, {}};
        const float wide =
            std::max(std::sqrt(rim.slope.x * rim.slope.x + rim.slope.y * rim.slope.y) * places.pixel, 0.05F);
        const float cover = std::min(rim.value / wide, 1.0F);
        if (!(cover > left.cover[k])) {
            continue;
        }
        constexpr float kWaves = 0.8F;    // height of waves over the thickness
        constexpr float kRounded = 0.8F;  // distance from the rim where the film is flat
        const Sloped waves = wavesAt(place);
        const float t = std::min(rim.value / kRounded, 1.0F);
        const float rounded = t * t * (3.0F - 2.0F * t);
        const float by_rim = t < 1.0F ? 6.0F * t * (1.0F - t) / kRounded : 0.0F;
        const float high = 1.0F + kWaves * waves.value;
        const Vec2f slope =
            sum(scaled(high * rounded, thickness.slope), sum(scaled(kWaves * thickness.value * rounded, waves.slope),
                                                             scaled(thickness.value * high * by_rim, rim.slope)));
        left.cover[k] = cover;
        left.shift_x[k] = optics.by_x.x * slope.x + optics.by_y.x * slope.y;
        left.shift_y[k] = optics.by_x.y * slope.x + optics.by_y.y * slope.y;
    }
}

}  // namespace droplet
