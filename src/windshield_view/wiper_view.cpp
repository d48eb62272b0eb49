// SPDX-License-Identifier: GPL-3.0-or-later
#include "windshield_view/wiper_view.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "hashed_number.h"
#include "wide_vectors.h"
#include "windshield_view/smooth_noise.h"

namespace droplet {
namespace {

constexpr float kBladeHalf = 0.0045F;  // half the width of a blade in its middle [m]
constexpr float kArmHalf = 0.0075F;    // half the width of an arm at its joint [m]
constexpr float kArmAside = 0.028F;    // distance of an arm from the line of its blade, at its joint [m]
constexpr float kFilmLasts = 0.75F;    // lifetime of a film [s]
constexpr float kWedgeLasts = 0.8F;    // lifetime of a wedge [s]
constexpr float kWidestBead = 0.007F;  // largest width of pushed water [m]
// How far arm, blade and pushed water reach at either side of the blade's line [m].
constexpr float kOnArmsSide = -kArmAside - 1.15F * kArmHalf;
constexpr float kOnOtherSide = kBladeHalf + kWidestBead;
constexpr float kWidestWedge = 1.7F * kWidestBead * 1.1F;

float numberAt(std::int32_t column, std::int32_t row, std::uint32_t seed)
{
    return hashedNumber(static_cast<std::uint32_t>(column) * 0x9e3779b9U +
                        static_cast<std::uint32_t>(row) * 0x85ebca6bU + seed * 0xc2b2ae35U);
}

/// Value of a smooth random field from 0 to 1, and its derivatives.
struct NoiseValue {
    float value = 0.0F;
    float by_u = 0.0F;
    float by_v = 0.0F;
};

/// @param number  random numbers of (column, row)
template <typename Number>
NoiseValue fieldFrom(float u, float v, const Number& number)
{
    const float column = std::floor(u);
    const float row = std::floor(v);
    const auto corner = [&](float i, float j) {
        return number(static_cast<std::int32_t>(column + i), static_cast<std::int32_t>(row + j));
    };
    const float x = u - column;
    const float y = v - row;
    const float sx = x * x * (3.0F - 2.0F * x);
    const float sy = y * y * (3.0F - 2.0F * y);
    const float a = corner(0.0F, 0.0F);
    const float b = corner(1.0F, 0.0F);
    const float c = corner(0.0F, 1.0F);
    const float d = corner(1.0F, 1.0F);
    const float twist = a - b - c + d;
    return {a + sx * (b - a) + sy * (c - a) + sx * sy * twist, 6.0F * x * (1.0F - x) * (b - a + sy * twist),
            6.0F * y * (1.0F - y) * (c - a + sx * twist)};
}

NoiseValue fieldAt(float u, float v, std::uint32_t seed)
{
    return fieldFrom(u, v, [&](std::int32_t i, std::int32_t j) { return numberAt(i, j, seed); });
}

// Streaks of the film along the blade's motion, thick and thin, that repeat after some metres.
constexpr float kLong = 0.045F;   // [m]
constexpr float kWide = 0.0042F;  // [m]
constexpr std::int32_t kThickAlong = 16;
constexpr std::int32_t kThickAcross = 64;
constexpr std::int32_t kThinAlong = 34;
constexpr std::int32_t kThinAcross = 173;
constexpr float kThickShare = 0.62F;
constexpr float kThinShare = 0.38F;
constexpr float kRoundAlong = static_cast<float>(kThickAlong) * kLong;    // after which they repeat [m]
constexpr float kRoundAcross = static_cast<float>(kThickAcross) * kWide;  // likewise
// Samples: eight along the shortest streak, three across it, so that they fit into a processor's own cache.
constexpr std::int32_t kSamplesAlong = 256;
constexpr std::int32_t kSamplesAcross = 512;

// Level below which the glass is bare, by the film's age.
constexpr float kBareAtOnce = 0.12F;
float bareLevel(float age)
{
    return kBareAtOnce + (1.0F - kBareAtOnce) * std::sqrt(age * (1.0F / kFilmLasts));
}

/// Age at which a level is bare.
float dryAge(float level)
{
    const float root = std::max(level - kBareAtOnce, 0.0F) / (1.0F - kBareAtOnce);
    return kFilmLasts * root * root;
}

/// Slope of a film over that of its level [m].
/// @param above  level above the bare one; rims are steeper, as they recede
float thickness(float age, float above)
{
    constexpr float kThick = 4.5e-5F;  // [m]
    constexpr float kRim = 0.15F;      // of the level
    const float old = age * (1.0F / kFilmLasts);
    const float at_rim = std::max(1.0F - above * (1.0F / kRim), 0.0F);
    return kThick * (1.0F - 0.6F * old * (2.0F - old)) * (1.0F + 1.2F * at_rim * at_rim);
}

Vec2f toFloats2(Vec2 v)
{
    return {static_cast<float>(v.x), static_cast<float>(v.y)};
}

float size(Vec2f v)
{
    return std::sqrt(v.x * v.x + v.y * v.y);
}

/// Progress of a wiper from `first` to `last` at an angle, 0 … 1; outside that range it never has this angle.
float shareOfWay(const Wiper& wiper, float angle)
{
    const auto first = static_cast<float>(wiper.first);
    const auto way = static_cast<float>(wiper.last - wiper.first);
    constexpr float kRound = 2.0F * std::numbers::pi_v<float>;
    const float turned = std::remainder(angle - first - 0.5F * way, kRound) + 0.5F * way;
    return turned / way;
}

/// Water that a blade has pushed together.
/// @param across  distance from its near edge, in the given direction [m]
WaterMet pushedAt(float across, float width, Vec2f direction, float pixel)
{
    constexpr float kHeight = 0.35F;       // over its width
    constexpr float kNarrowest = 0.3e-3F;  // [m]
    return width < kNarrowest ? WaterMet() : Bead{width, kHeight}.at(across, direction, pixel);
}

}  // namespace

WiperView::FilmField::FilmField() : samples_(static_cast<std::size_t>(kSamplesAlong) * kSamplesAcross)
{
    const auto octave = [](float u, float v, std::int32_t along, std::int32_t across) {
        return fieldFrom(u * static_cast<float>(along), v * static_cast<float>(across),
                         [&](std::int32_t i, std::int32_t j) {
                             return numberAt(i % along, j % across, static_cast<std::uint32_t>(along));
                         });
    };
    const Vec2f thick_slope{kThickShare * static_cast<float>(kThickAlong),
                            kThickShare * static_cast<float>(kThickAcross)};
    const Vec2f thin_slope{kThinShare * static_cast<float>(kThinAlong), kThinShare * static_cast<float>(kThinAcross)};
    tbb::parallel_for(0, kSamplesAcross, [&](std::int32_t row) {
        for (std::int32_t column = 0; column < kSamplesAlong; ++column) {
            const float u = static_cast<float>(column) / kSamplesAlong;
            const float v = static_cast<float>(row) / kSamplesAcross;
            const NoiseValue thick = octave(u, v, kThickAlong, kThickAcross);
            const NoiseValue thin = octave(u, v, kThinAlong, kThinAcross);
            samples_[static_cast<std::size_t>(row) * kSamplesAlong + static_cast<std::size_t>(column)] =
                Float4{kThickShare * thick.value + kThinShare * thin.value,
                       (thick_slope.x * thick.by_u + thin_slope.x * thin.by_u) / kRoundAlong,
                       (thick_slope.y * thick.by_v + thin_slope.y * thin.by_v) / kRoundAcross, 0.0F};
        }
    });
}

[[gnu::always_inline]] inline Float4 WiperView::FilmField::at(float along, float across) const
{
    const float u = along * (kSamplesAlong / kRoundAlong);
    const float v = across * (kSamplesAcross / kRoundAcross);
    const std::int32_t column = floorOf(u);
    const std::int32_t row = floorOf(v);
    const auto sample = [&](std::int32_t i, std::int32_t j) -> const Float4& {
        return samples_[static_cast<std::size_t>((row + j) & (kSamplesAcross - 1)) * kSamplesAlong +
                        static_cast<std::size_t>((column + i) & (kSamplesAlong - 1))];
    };
    const Float4 x = float4(u - static_cast<float>(column));
    const Float4 y = float4(v - static_cast<float>(row));
    const Float4 low = sample(0, 0) + x * (sample(1, 0) - sample(0, 0));
    const Float4 high = sample(0, 1) + x * (sample(1, 1) - sample(0, 1));
    return low + y * (high - low);
}

WiperView::Blade WiperView::bladeAt(const Wiper& wiper, double time)
{
    const double angle = wiper.angleAt(time);
    Blade blade{{static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))}, 0.0F, 0.0F};
    const double since = time - wiper.start;
    const double within_period = since - wiper.period * std::floor(since / wiper.period);
    if (since > 0.0 && within_period < wiper.stroke) {
        const bool is_there = within_period < 0.5 * wiper.stroke;
        const auto done =
            static_cast<float>(std::abs((angle - (is_there ? wiper.first : wiper.last)) / (wiper.last - wiper.first)));
        blade.forward = is_there == (wiper.last > wiper.first) ? 1.0F : -1.0F;
        // The blade releases the water just before it turns.
        blade.pushed = std::sqrt(done) * (1.0F - smoothstep(0.97F, 1.0F, done));
    }
    return blade;
}

void WiperView::update(double time)
{
    const ViewOptions& options = scene_.options;
    if (options.wipers.empty()) {
        return;
    }
    if (!film_) {
        film_.emplace();
        placeFilms();
    }
    states_.clear();
    moments_ = 1;
    const Vec2 middle{0.5 * scene_.glass.width(), 0.5 * scene_.glass.height()};
    for (const Wiper& wiper : options.wipers) {
        constexpr double kInstant = 1e-4;  // [s]
        const double turn = wiper.angleAt(time + 0.5 * kInstant) - wiper.angleAt(time - 0.5 * kInstant);
        moments_ = std::max(moments_, scene_.momentsOf(middle, wiper.outer * std::abs(turn) / kInstant));
    }
    for (const Wiper& wiper : options.wipers) {
        const double since = time - wiper.start;
        const double strokes = std::floor(since / wiper.period);
        WiperState one{
            wiper, since - wiper.period * strokes, since > 0.0 ? static_cast<std::uint32_t>(strokes) : 0U, {}, {}, {}};
        if (since <= 0.0) {
            one.since = -1.0;
        }
        for (int k = 0; k < moments_; ++k) {
            one.blades.push_back(bladeAt(wiper, time + scene_.timeOf(k, moments_)));
        }
        // Each way there and back has a part of the film of its own.
        for (std::uint32_t way = 0; way < one.film_shifts.size(); ++way) {
            const std::uint32_t seed = 2 * one.stroke + way;
            one.film_shifts[way] = {kRoundAlong * numberAt(0, 0, seed), kRoundAcross * numberAt(1, 0, seed)};
        }
        one.wedge = wedgeOf(one);
        states_.push_back(std::move(one));
    }
    tiles_.assign(scene_.tiles.count(), {});
    tbb::parallel_for(std::size_t{0}, tiles_.size(), [&](std::size_t k) { updateTile(k); });
}

void WiperView::updateTile(std::size_t number)
{
    TileReach& reach = tiles_[number];
    const ViewTile& tile = scene_.tiles[number];
    if (!tile.on_glass) {
        return;
    }
    const Vec2f half{0.5F * (tile.high.x - tile.low.x), 0.5F * (tile.high.y - tile.low.y)};
    for (std::size_t k = 0; k < states_.size(); ++k) {
        const WiperState& one = states_[k];
        if (TileFilm& film = films_[k][number]; film.pixels != nullptr) {
            renew(one, film, number);
            reach.has_water_left = reach.has_water_left || film.is_wet;
        }
        reach.has_water_left = reach.has_water_left || reachWedge(one, tile);
        const Vec2f pivot = toFloats2(one.wiper.pivot);
        const float x = std::clamp(pivot.x, tile.low.x, tile.high.x) - pivot.x;
        const float y = std::clamp(pivot.y, tile.low.y, tile.high.y) - pivot.y;
        const auto far = static_cast<float>(one.wiper.outer) + 0.02F;
        if (x * x + y * y >= far * far) {
            continue;
        }
        const Vec2f middle{tile.low.x + half.x - pivot.x, tile.low.y + half.y - pivot.y};
        for (const Blade& blade : one.blades) {
            const float aside = middle.y * blade.along.x - middle.x * blade.along.y;
            const float along = middle.x * blade.along.x + middle.y * blade.along.y;
            const float beside = half.x * std::abs(blade.along.y) + half.y * std::abs(blade.along.x) + tile.pixel;
            const float before = half.x * std::abs(blade.along.x) + half.y * std::abs(blade.along.y) + tile.pixel;
            // The arm ends in the middle of its blade.
            const bool has_arm = along - before < 0.5F * static_cast<float>(one.wiper.inner + one.wiper.outer);
            const bool is_there = aside + beside > (has_arm ? kOnArmsSide : -kOnOtherSide) &&
                                  aside - beside < kOnOtherSide && along + before > 0.0F;
            reach.blades |= std::uint64_t{is_there ? 1U : 0U} << (&blade - one.blades.data());
        }
    }
}

bool WiperView::isInOtherField(const WiperState& own, Vec2f place) const
{
    return std::any_of(states_.begin(), states_.end(), [&](const WiperState& other) {
        const Vec2f pivot = toFloats2(other.wiper.pivot);
        const Vec2f from{place.x - pivot.x, place.y - pivot.y};
        const float far = size(from);
        const float share = shareOfWay(other.wiper, std::atan2(from.y, from.x));
        return &other != &own && far > static_cast<float>(other.wiper.inner) &&
               far < static_cast<float>(other.wiper.outer) && share > 0.0F && share < 1.0F;
    });
}

WiperView::FilmPlace WiperView::filmPlaceOf(const Wiper& wiper, Vec2f from)
{
    const float radius = size(from);
    if (!(radius >= static_cast<float>(wiper.inner) && radius <= static_cast<float>(wiper.outer))) {
        return {};  // NaN, too: beside the glass
    }
    const float angle = std::atan2(from.y, from.x);
    const float share = shareOfWay(wiper, angle);
    if (share <= 0.0F || share >= 1.0F) {
        return {};
    }
    return {static_cast<float>(wiper.stroke) / (2.0F * std::numbers::pi_v<float>)*std::acos(1.0F - 2.0F * share),
            angle * static_cast<float>(wiper.outer)};
}

WiperView::Passed WiperView::passed(const WiperState& one, float there)
{
    // Times at which the blade passed: forward, and on its way back.
    const auto stroke = static_cast<float>(one.wiper.stroke);
    const auto since = static_cast<float>(one.since);
    if (since >= stroke - there) {
        return {2, since - (stroke - there)};
    }
    if (since - there >= 0.0F) {
        return {1, since - there};
    }
    if (one.stroke == 0) {
        return {0, std::numeric_limits<float>::infinity()};
    }
    return {0, since + static_cast<float>(one.wiper.period) - (stroke - there)};
}

void WiperView::renew(const WiperState& one, TileFilm& film, std::size_t tile) const
{
    const Passed first = passed(one, film.first);
    const Passed last = passed(one, film.last);
    const float age = std::min(first.age, last.age);
    film.is_wet = age < kFilmLasts;
    if (!film.is_wet) {
        return;
    }
    std::array<std::uint32_t, kTilePixels> ways;
    if (first.way != last.way) {
        film.way.reset();
        for (std::size_t k = 0; k < kTilePixels; ++k) {
            ways[k] = 2 * one.stroke + passed(one, film.pixels->there[k]).way;
        }
        renew(one, *film.pixels, tile, ways);
        return;
    }
    const std::uint32_t way = 2 * one.stroke + first.way;
    if (film.way != way) {
        film.way = way;
        ways.fill(way);
        renew(one, *film.pixels, tile, ways);
        const std::uint16_t highest = *std::max_element(film.pixels->levels.begin(), film.pixels->levels.end());
        film.lasts = dryAge(static_cast<float>(highest) / FilmPixels::kLevel);
    }
    film.is_wet = age < film.lasts;
}

DROPLET_WIDE_VECTORS void WiperView::renew(const WiperState& one, FilmPixels& film, std::size_t tile,
                                           const std::array<std::uint32_t, kTilePixels>& ways) const
{
    std::array<std::uint8_t, kTilePixels> pixels;
    std::size_t count = 0;
    for (std::size_t k = 0; k < kTilePixels; ++k) {
        pixels[count] = static_cast<std::uint8_t>(k);
        // No blade has passed before the first way, which is number 1.
        const bool is_new = ways[k] != film.ways[k] && film.there[k] >= 0.0F && ways[k] != 0;
        count += is_new ? 1 : 0;  // without a branch, which would be guessed wrong
    }
    film.ways = ways;
    const ViewContext::TilePlaces places = scene_.placesOf(tile);
    const Vec2f pivot = toFloats2(one.wiper.pivot);
    std::array<float, kTilePixels> from_x;  // of the pixels that are new, from the pivot
    std::array<float, kTilePixels> from_y;
    for (std::size_t j = 0; j < count; ++j) {
        const Vec2f place = places(pixels[j]);
        from_x[j] = place.x - pivot.x;
        from_y[j] = place.y - pivot.y;
    }
    std::array<float, kTilePixels> fars;
    for (std::size_t j = 0; j < count; ++j) {
        fars[j] = size({from_x[j], from_y[j]});
    }
    std::array<float, kTilePixels> along;  // slopes of the level
    std::array<float, kTilePixels> across;
    for (std::size_t j = 0; j < count; ++j) {
        const std::size_t k = pixels[j];
        const Vec2f moved = one.film_shifts[ways[k] - 2 * one.stroke];
        const Float4 field = film_->at(film.along[k] + moved.x, fars[j] + moved.y);
        film.levels[k] = static_cast<std::uint16_t>(FilmPixels::kLevel * field[0]);
        along[j] = field[1];
        across[j] = field[2];
    }
    // Loops without a branch, which are vectorised.
    std::array<float, kTilePixels> steepnesses;
    std::array<float, kTilePixels> shifts_x;
    std::array<float, kTilePixels> shifts_y;
    const FilmOptics& optics = film.optics;
    const auto within = [](float value, float least, float most) { return std::min(std::max(value, least), most); };
    for (std::size_t j = 0; j < count; ++j) {
        constexpr float kMost = 32767.0F;
        const float x = (across[j] * from_x[j] - along[j] * from_y[j]) / fars[j];
        const float y = (across[j] * from_y[j] + along[j] * from_x[j]) / fars[j];
        const float steepest = size({along[j], across[j]});
        steepnesses[j] = within(FilmPixels::kSteepness * places.pixel * steepest, 1.0F, 65535.0F);
        shifts_x[j] = within((optics.by_x.x * x + optics.by_y.x * y) / FilmPixels::kShift, -kMost, kMost);
        shifts_y[j] = within((optics.by_x.y * x + optics.by_y.y * y) / FilmPixels::kShift, -kMost, kMost);
    }
    for (std::size_t j = 0; j < count; ++j) {
        const std::size_t k = pixels[j];
        film.steepnesses[k] = static_cast<std::uint16_t>(steepnesses[j]);
        film.shifts_x[k] = static_cast<std::int16_t>(shifts_x[j]);
        film.shifts_y[k] = static_cast<std::int16_t>(shifts_y[j]);
    }
}

DROPLET_WIDE_VECTORS void WiperView::addFilm(const WiperState& one, const TileFilm& in_tile, bool is_first,
                                             WaterLeft& left) const
{
    const FilmPixels& film = *in_tile.pixels;
    const auto stroke = static_cast<float>(one.wiper.stroke);
    const auto since = static_cast<float>(one.since);
    const float later = since + static_cast<float>(one.wiper.period);
    const std::uint32_t last_way_before = 2 * one.stroke;
    const std::uint32_t way_there = last_way_before + 1;
    std::array<float, kTilePixels> ages;
    if (in_tile.way) {
        const float now = *in_tile.way == last_way_before ? later : since;
        const bool is_there = *in_tile.way == way_there;
        for (std::size_t k = 0; k < kTilePixels; ++k) {
            ages[k] = now - (is_there ? film.there[k] : stroke - film.there[k]);
        }
    } else {
        for (std::size_t k = 0; k < kTilePixels; ++k) {
            ages[k] = (film.ways[k] == last_way_before ? later : since) -
                      (film.ways[k] == way_there ? film.there[k] : stroke - film.there[k]);
        }
    }
    left.reflected = film.optics.reflected;
    // Loops without a branch, which are vectorised.
    std::array<float, kTilePixels> covers;
    std::array<float, kTilePixels> scales;
    for (std::size_t k = 0; k < kTilePixels; ++k) {
        const float age = std::min(std::max(ages[k], 0.0F), kFilmLasts);
        const float above = static_cast<float>(film.levels[k]) * (1.0F / FilmPixels::kLevel) - bareLevel(age);
        const float within = above * FilmPixels::kSteepness / static_cast<float>(film.steepnesses[k]);
        covers[k] = above > 0.0F ? std::min(within + 0.5F, 1.0F) : 0.0F;
        scales[k] = FilmPixels::kShift * thickness(age, std::max(above, 0.0F));
    }
    if (is_first) {
        left.cover = covers;
        for (std::size_t k = 0; k < kTilePixels; ++k) {
            left.shift_x[k] = scales[k] * static_cast<float>(film.shifts_x[k]);
            left.shift_y[k] = scales[k] * static_cast<float>(film.shifts_y[k]);
        }
        return;
    }
    std::array<float, kTilePixels> is_more;
    for (std::size_t k = 0; k < kTilePixels; ++k) {
        is_more[k] = covers[k] > left.cover[k] ? 1.0F : 0.0F;
    }
    for (std::size_t k = 0; k < kTilePixels; ++k) {
        const float own = is_more[k] * scales[k];
        const float others = 1.0F - is_more[k];
        left.cover[k] = std::max(left.cover[k], covers[k]);
        left.shift_x[k] = own * static_cast<float>(film.shifts_x[k]) + others * left.shift_x[k];
        left.shift_y[k] = own * static_cast<float>(film.shifts_y[k]) + others * left.shift_y[k];
    }
}

WiperView::Wedge WiperView::wedgeOf(const WiperState& one)
{
    const Wiper& wiper = one.wiper;
    // Place of the last turn: at `last`, or back at `first`.
    const bool is_far = one.since >= 0.5 * wiper.stroke && one.since < wiper.stroke;
    const double turned = is_far                      ? 0.5 * wiper.stroke
                          : one.since >= wiper.stroke ? wiper.stroke
                                                      : wiper.stroke - wiper.period;
    const auto age = static_cast<float>(one.since - turned);
    if (one.since < 0.0 || age > kWedgeLasts || (turned < 0.0 && one.stroke == 0)) {
        return {};
    }
    const double angle = is_far ? wiper.last : wiper.first;
    const float way = is_far == (wiper.last > wiper.first) ? 1.0F : -1.0F;
    return {true,
            {-way * static_cast<float>(std::sin(angle)), way * static_cast<float>(std::cos(angle))},
            age / kWedgeLasts,
            2 * one.stroke + (is_far ? 1U : 0U)};
}

WaterMet WiperView::wedge(const WiperState& one, Vec2f from, float pixel)
{
    const Wedge& wedge = one.wedge;
    const float beyond = from.x * wedge.ahead.x + from.y * wedge.ahead.y - kBladeHalf;
    if (beyond < -pixel || beyond > kWidestWedge + pixel) {
        return {};
    }
    const float radius = size(from);
    const auto inner = static_cast<float>(one.wiper.inner);
    const auto outer = static_cast<float>(one.wiper.outer);
    if (radius < inner || radius > outer) {
        return {};
    }
    // The wedge drains along the blade's line, last at thick places, and is wider further out.
    const float left = wedge.drained;
    const float place = (radius - inner) / (outer - inner);
    const NoiseValue uneven = fieldAt(radius / 0.018F + 2.0F * left, 0.5F, wedge.seed);
    const float width = 1.7F * kWidestBead * (0.35F + 0.65F * place) *
                        std::max(uneven.value * 0.6F + 0.5F - 1.1F * left, 0.0F) *
                        smoothstep(0.0F, 0.03F, std::min(radius - inner, outer - radius));
    return pushedAt(beyond, width, wedge.ahead, pixel);
}

bool WiperView::reachWedge(const WiperState& one, const ViewTile& tile)
{
    const Vec2f ahead = one.wedge.ahead;
    const Vec2f pivot = toFloats2(one.wiper.pivot);
    const Vec2f middle{0.5F * (tile.low.x + tile.high.x) - pivot.x, 0.5F * (tile.low.y + tile.high.y) - pivot.y};
    const float extent =
        0.5F * ((tile.high.x - tile.low.x) * std::abs(ahead.x) + (tile.high.y - tile.low.y) * std::abs(ahead.y)) +
        tile.pixel;
    const float beyond = middle.x * ahead.x + middle.y * ahead.y - kBladeHalf;
    return one.wedge.is_there && beyond > -extent && beyond < kWidestWedge + extent;
}

void WiperView::waterLeft(std::size_t tile, WaterLeft& left) const
{
    left.beads.clear();
    bool is_first = true;
    for (std::size_t k = 0; k < states_.size(); ++k) {
        if (const TileFilm& film = films_[k][tile]; film.is_wet) {
            addFilm(states_[k], film, std::exchange(is_first, false), left);
        }
    }
    if (is_first) {
        left.cover.fill(0.0F);
        left.shift_x.fill(0.0F);
        left.shift_y.fill(0.0F);
    }
    addWedges(tile, left);
}

void WiperView::addWedges(std::size_t tile, WaterLeft& left) const
{
    const ViewTile& seen = scene_.tiles[tile];
    const ViewContext::TilePlaces places = scene_.placesOf(tile);
    if (std::none_of(states_.begin(), states_.end(), [&](const WiperState& one) { return reachWedge(one, seen); })) {
        return;
    }
    for (std::size_t k = 0; k < kTilePixels; ++k) {
        const Vec2f place = places(k);
        const auto at_place = [&](const WiperState& one) {
            const Vec2f pivot = toFloats2(one.wiper.pivot);
            const WaterMet bead = reachWedge(one, seen) && !std::isnan(place.x)
                                      ? wedge(one, {place.x - pivot.x, place.y - pivot.y}, seen.pixel)
                                      : WaterMet();
            if (!(bead.cover > 0.0F) || isInOtherField(one, place)) {
                return false;
            }
            left.beads.push_back({bead, static_cast<std::uint8_t>(k)});
            left.cover[k] = 0.0F;
            return true;
        };
        static_cast<void>(std::any_of(states_.begin(), states_.end(), at_place));
    }
}

void WiperView::placeFilms()
{
    const Tiles& tiles = scene_.tiles;
    for (const Wiper& wiper : scene_.options.wipers) {
        std::vector<TileFilm>& films = films_.emplace_back(tiles.count());
        const Vec2f pivot = toFloats2(wiper.pivot);
        tbb::parallel_for(std::size_t{0}, tiles.count(), [&](std::size_t tile) {
            TileFilm film;
            auto pixels = std::make_unique<FilmPixels>();
            pixels->ways.fill(std::numeric_limits<std::uint32_t>::max());
            pixels->levels.fill(0);
            pixels->steepnesses.fill(1);
            pixels->shifts_x.fill(0);
            pixels->shifts_y.fill(0);
            const ViewContext::TilePlaces places = scene_.placesOf(tile);
            for (std::size_t k = 0; k < kTilePixels; ++k) {
                const Vec2f place = places(k);
                const FilmPlace at = filmPlaceOf(wiper, {place.x - pivot.x, place.y - pivot.y});
                pixels->there[k] = at.there;
                pixels->along[k] = at.along;
                if (at.there >= 0.0F) {
                    film.first = film.last < 0.0F ? at.there : std::min(film.first, at.there);
                    film.last = std::max(film.last, at.there);
                }
            }
            if (film.last >= 0.0F) {
                pixels->optics = FilmOptics::of(scene_, tile);
                film.pixels = std::move(pixels);
                films[tile] = std::move(film);
            }
        });
    }
}

WiperMet WiperView::at(Vec2f place, float pixel, int moment) const
{
    WiperMet met;
    for (const WiperState& one : states_) {
        const Wiper& wiper = one.wiper;
        const Blade& blade = one.blades[static_cast<std::size_t>(moment)];
        const Vec2f pivot = toFloats2(wiper.pivot);
        const Vec2f from{place.x - pivot.x, place.y - pivot.y};
        const float along = from.x * blade.along.x + from.y * blade.along.y;
        const float aside = from.y * blade.along.x - from.x * blade.along.y;
        if (aside + pixel < kOnArmsSide || aside - pixel > kOnOtherSide) {
            continue;
        }
        const auto inner = static_cast<float>(wiper.inner);
        const auto outer = static_cast<float>(wiper.outer);
        const float middle = 0.5F * (inner + outer);
        const float end = std::min(along - inner, outer - along);
        const float taper = 0.55F + 0.45F * smoothstep(0.0F, 0.4F * (outer - inner), end);
        // Its ends are round.
        const float round = std::clamp(1.0F - end / (1.5F * kBladeHalf), 0.0F, 1.0F);
        const float half = kBladeHalf * taper * std::sqrt(1.0F - round * round);
        const float on_blade = std::min(within(half - std::abs(aside), pixel), within(end, pixel));
        // The arm runs from the pivot beside the blade and meets it in its middle.
        const float joint = std::clamp(along / middle, 0.0F, 1.0F);
        const float arm_aside = aside + kArmAside * (1.0F - joint);
        const float arm_half = kArmHalf * (1.15F - 0.5F * joint);
        const float on_arm =
            std::min(within(arm_half - std::abs(arm_aside), pixel), within(std::min(along, middle - along), pixel));
        const float cover = std::max(on_blade, on_arm);
        if (cover > met.cover) {
            met.cover = cover;
            // Rubber is dark except for a gleam along one side; the arm is round.
            const float across = on_blade >= on_arm ? aside / std::max(half, 1e-5F) : arm_aside / arm_half;
            const float gleam = std::exp(-12.0F * (across - 0.45F) * (across - 0.45F));
            met.shine = on_blade >= on_arm ? 0.25F + 2.2F * gleam : 0.35F + 2.8F * gleam;
        }
        const float beyond = blade.forward * aside - half;
        if (blade.forward != 0.0F && end > 0.0F && beyond > -pixel && beyond < kWidestBead + pixel) {
            const Vec2f ahead{-blade.forward * blade.along.y, blade.forward * blade.along.x};
            const NoiseValue uneven = fieldAt(along / 0.014F, 2.0F * blade.pushed, 2 * one.stroke + 5U);
            const float fades = isInOtherField(one, place) ? 1.0F - smoothstep(0.6F, 0.95F, blade.pushed) : 1.0F;
            const float width =
                kWidestBead * blade.pushed * fades * (0.35F + 0.65F * uneven.value) * smoothstep(0.0F, 0.03F, end);
            const WaterMet bead = pushedAt(beyond, width, ahead, pixel);
            if (bead.cover > met.pushed.cover) {
                met.pushed = bead;
            }
        }
    }
    return met;
}

}  // namespace droplet
