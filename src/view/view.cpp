// SPDX-License-Identifier: GPL-3.0-or-later
// The thesis, sections 3.2.1 and 3.2.2: large droplets one by one, small ones as a map of the glass, both by the
// directions in which their normals refract what the driver sees.
#include "droplet/view/view.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include "droplet/error.h"
#include "picture/panorama.h"
#include "require.h"
#include "view/defocus.h"
#include "view/running_rays.h"
#include "view/sight.h"
#include "view/still_samples.h"
#include "view/water_optics.h"
#include "view/wiper_view.h"

namespace droplet {

void ViewOptions::validate() const
{
    requireWithin("width", width, 16, 8192);
    requireWithin("height", height, 16, 8192);
    require(field_of_view >= kDegree && field_of_view <= 150.0 * kDegree, "field_of_view", field_of_view,
            "from 1 to 150 degrees");
    require(eye_distance >= 0.01 && eye_distance <= 100.0, "eye_distance", eye_distance, "from 0.01 to 100 m");
    if (aim) {
        require(std::isfinite(aim->x), "aim.x", aim->x, "finite");
        require(std::isfinite(aim->y), "aim.y", aim->y, "finite");
    }
    for (const auto& place : {eye, look_at}) {
        require(!place || std::isfinite(place->x + place->y + place->z), "eye, look_at", place ? place->x : 0.0,
                "finite");
    }
    shape.validate();
    require(ior >= 1.0 && ior <= 2.0, "ior", ior, "from 1 to 2");
    requireWithin("samples", samples, 1, 4);
    require(exposure >= -8.0 && exposure <= 8.0, "exposure", exposure, "from -8 to 8");
    if (highlight_boost) {
        require(*highlight_boost >= 0.0 && *highlight_boost <= 4.0, "highlight_boost", *highlight_boost, "from 0 to 4");
    }
    require(open_time >= 0.0 && open_time <= 1.0, "open_time", open_time, "from 0 to 1 s");
    require(background_blur >= 0.0 && background_blur <= 20.0 * kDegree, "background_blur", background_blur,
            "from 0 to 20 degrees");
    for (const Wiper& wiper : wipers) {
        wiper.validate();
    }
    for (const double share : {glass_colour.x, glass_colour.y, glass_colour.z}) {
        require(share >= 0.0 && share <= 1.0, "glass_colour", share, "from 0 to 1");
    }
}

namespace {

/// Light of a tile's pixels.
using TileLight = std::array<Four, kTilePixels>;

/// Levels and alpha of a pixel.
struct Straight {
    std::uint8_t red = 0;
    std::uint8_t green = 0;
    std::uint8_t blue = 0;
    std::uint32_t alpha = 0;
};

/// @param light  premultiplied
[[gnu::always_inline]] inline Straight straightOf(const Four& light, const EncodedLevels& levels = encodedLevels())
{
    const std::uint32_t alpha = level8(light[3]);
    if (alpha == 0) {
        return {};
    }
    // What is brighter than white keeps its hue.
    const float max = std::max(std::max(light[0], light[1]), std::max(light[2], light[3]));
    const Four straight = four(1.0F / max) * light;
    return {encoded(straight[0], levels), encoded(straight[1], levels), encoded(straight[2], levels), alpha};
}

/// Linear light of levels.
Four lightOf(std::uint8_t red, std::uint8_t green, std::uint8_t blue)
{
    const std::array<float, 256>& levels = displayLevels();
    return Four{levels[red], levels[green], levels[blue], 1.0F};
}

/// A frame over which droplets are laid.
class FrameTaker {
public:
    explicit FrameTaker(Picture& frame) : frame_(frame) {}

    void take(std::size_t pixel, const Straight& seen)
    {
        std::uint8_t* const to = frame_.rgb.data() + 3 * pixel;
        to[0] = mixedLevel(seen.red, to[0], seen.alpha);
        to[1] = mixedLevel(seen.green, to[1], seen.alpha);
        to[2] = mixedLevel(seen.blue, to[2], seen.alpha);
    }

    /// Light of the pixel where this is seen of it; the mean of such light is what a blurred one has.
    [[nodiscard]] Four light(std::size_t pixel, const Straight& seen) const
    {
        const std::uint8_t* const below = frame_.rgb.data() + 3 * pixel;
        return lightOf(mixedLevel(seen.red, below[0], seen.alpha), mixedLevel(seen.green, below[1], seen.alpha),
                       mixedLevel(seen.blue, below[2], seen.alpha));
    }

    void takeMean(std::size_t pixel, const Four& mean)
    {
        for (std::size_t c = 0; c < 3; ++c) {
            frame_.rgb[3 * pixel + c] = encoded(mean[static_cast<int>(c)]);
        }
    }

private:
    Picture& frame_;
};

/// A layer that holds droplets alone.
class LayerTaker {
public:
    explicit LayerTaker(Layer& layer) : layer_(layer) {}

    void take(std::size_t pixel, const Straight& seen)
    {
        std::uint8_t* const to = layer_.rgba.data() + 4 * pixel;
        to[0] = seen.red;
        to[1] = seen.green;
        to[2] = seen.blue;
        to[3] = static_cast<std::uint8_t>(seen.alpha);
    }

    [[nodiscard]] Four light(std::size_t /*pixel*/, const Straight& seen) const
    {
        return four(static_cast<float>(seen.alpha) / 255.0F) * lightOf(seen.red, seen.green, seen.blue);
    }

    void takeMean(std::size_t pixel, const Four& mean) { take(pixel, straightOf(mean)); }

private:
    Layer& layer_;
};

}  // namespace

struct DriversView::Content {
    Content(const Glass& glass, const ViewOptions& options)
        : sight(glass, options), stills(std::in_place, sight), running(std::in_place, sight), wipers(sight)
    {
        bare.width = options.width;
        bare.height = options.height;
        bare.rgb.assign(3 * static_cast<std::size_t>(options.width) * static_cast<std::size_t>(options.height), 0);
        // What dims light by a share dims levels by its 2.4th root, sRGB's but for the darkest.
        const std::array<double, 3> shares{options.glass_colour.x, options.glass_colour.y, options.glass_colour.z};
        for (std::size_t i = 0; i < through_pane.size(); ++i) {
            through_pane[i] = static_cast<std::uint16_t>(std::lround(256.0 * std::pow(shares[i % 3], 1.0 / 2.4)));
        }
        for (std::size_t c = 0; c < exposed.size() && options.exposure != 0.0; ++c) {
            for (std::size_t level = 0; level < 256; ++level) {
                exposed[c][level] =
                    encoded(static_cast<float>(shares[c] * std::exp2(options.exposure)) * displayLevels()[level]);
            }
        }
        pane = Four{static_cast<float>(options.glass_colour.x), static_cast<float>(options.glass_colour.y),
                    static_cast<float>(options.glass_colour.z), 1.0F};
    }

    /// Makes the bare picture of one that is out of focus.
    void takeBlurred(const Picture& picture, const Highlights& highlights)
    {
        LightPicture behind{picture.width, picture.height, {}};
        behind.light.resize(picture.rgb.size() / 3);
        std::array<float, 256> times{};
        for (std::size_t level = 0; level < times.size(); ++level) {
            times[level] = highlights.times(static_cast<float>(level) / 255.0F);
        }
        const std::array<float, 256>& levels = displayLevels();
        forPixels([&](std::size_t at) {
            const std::uint8_t* const from = picture.rgb.data() + 3 * at;
            const Four light{levels[from[0]], levels[from[1]], levels[from[2]], 1.0F};
            behind.light[at] = four(times[std::max({from[0], from[1], from[2]})]) * light;
        });
        expose(defocused(std::move(behind), blur()));
    }

    /// Diameter of the blur [px].
    [[nodiscard]] float blur() const
    {
        return static_cast<float>(2.0 * std::tan(0.5 * sight.options.background_blur)) / sight.eye.tangent();
    }

    /// Makes all that is seen what is around the car, until there is a picture.
    void takeSurroundings(const Environment& environment)
    {
        const Eye& eye = sight.eye;
        LightPicture behind{eye.width(), eye.height(), {}};
        behind.light.resize(bare.rgb.size() / 3);
        const PictureFrame frame = eye.frame();
        forPixels([&](std::size_t at) {
            const auto column = static_cast<float>(at % static_cast<std::size_t>(eye.width()));
            const std::size_t rows_above = at / static_cast<std::size_t>(eye.width());
            const auto row = static_cast<float>(rows_above);
            constexpr int kAcross = 2;  // rays a pixel, each way
            Vec3f sum;
            for (int k = 0; k < kAcross * kAcross; ++k) {
                const float u = 0.25F + 0.5F * static_cast<float>(k % kAcross);
                const float v = k < kAcross ? 0.25F : 0.75F;
                sum = sum + radianceFrom(environment, unit(frame.toCar(eye.rayAt(column + u, row + v))));
            }
            const float share = exposure() / (kAcross * kAcross);
            behind.light[at] = Four{share * sum.x, share * sum.y, share * sum.z, 1.0F};
        });
        expose(defocused(std::move(behind), blur()));
        Four sum = four(0.0F);
        for (std::size_t at = 0; at < bare.rgb.size(); at += 3) {
            sum += lightOf(bare.rgb[at], bare.rgb[at + 1], bare.rgb[at + 2]);
        }
        darken(four(3.0F / static_cast<float>(bare.rgb.size())) * sum);
    }

    /// What directions meet from now on, and no water until it is shown.
    void begin()
    {
        if (around) {
            sight.backdrop.surround(*around, sight.eye.frame(), exposure(), !has_picture);
        }
        stills.emplace(sight);
        running.emplace(sight);
    }

    [[nodiscard]] float exposure() const { return static_cast<float>(std::exp2(sight.options.exposure)); }

    /// As dark as it is behind the eye, by eye: a tenth of what is ahead.
    void darken(const Four& mean) { cabin = Four{0.1F, 0.1F, 0.1F, 1.0F} * mean; }

    /// Makes light the bare picture, seen through the pane.
    void expose(const LightPicture& behind)
    {
        const EncodedLevels& levels = encodedLevels();
        forPixels([&](std::size_t at) {
            const Four light = pane * behind.light[at];
            // What is brighter than white keeps its hue.
            const Four straight = four(1.0F / std::max({light[0], light[1], light[2], 1.0F})) * light;
            for (std::size_t c = 0; c < 3; ++c) {
                bare.rgb[3 * at + c] = encoded(straight[static_cast<int>(c)], levels);
            }
        });
    }

    template <typename Work>
    void forPixels(const Work& work) const
    {
        constexpr std::size_t kWorthAThread = 16384;
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, bare.rgb.size() / 3, kWorthAThread),
                          [&](const auto& range) {
                              for (std::size_t at = range.begin(); at < range.end(); ++at) {
                                  work(at);
                              }
                          });
    }

    /// Light of a tile's droplets, premultiplied by what they cover, but for those that are blurred.
    /// @return  at how many moments those are looked at; 1: there are none
    int shine(std::size_t tile, TileLight& light) const
    {
        light.fill(four(0.0F));
        const float share = shareOfRay();
        for (const StillSample& sample : stills->inTile(tile)) {
            light[sample.pixel] += four(share * static_cast<float>(sample.cover)) *
                                   seen(sight.backdrop.at(sample.outside), static_cast<float>(sample.light) / 255.0F);
        }
        const bool has_wipers = wipers.reach(tile);
        if (has_wipers) {
            layUnder(tile, light);
        }
        int moments = has_wipers ? wipers.moments() : 1;
        for (const RaysInTile& in_tile : running->inTile(tile)) {
            moments = std::max(moments, in_tile.moments);
            if (in_tile.moments == 1) {
                lay(*in_tile.rays, light);
            }
        }
        if (has_wipers && moments == 1) {
            layWipers(tile, 0, light, [](std::size_t) {});
        }
        return moments;
    }

    /// Calls work(pixel of the tile, its ray's direction, place on the glass) for all pixels that see the glass.
    template <typename Work>
    void forTile(std::size_t tile, const Work& work) const
    {
        const auto columns = static_cast<std::size_t>(sight.tiles.columns());
        const int left = static_cast<int>(tile % columns) * kTile;
        const int top = static_cast<int>(tile / columns) * kTile;
        for (int y = top; y < std::min(top + kTile, sight.eye.height()); ++y) {
            for (int x = left; x < std::min(left + kTile, sight.eye.width()); ++x) {
                const Vec2f place = sight.eye.place(x, y);
                if (!std::isnan(place.x)) {
                    work(pixelInTile(x, y), sight.eye.ray(x, y), place);
                }
            }
        }
    }

    /// Where a ray goes on to that leaves water on the glass.
    [[nodiscard]] Interface beyond(const WaterMet& water, const ViewTile& tile, Vec3f ray) const
    {
        const auto ior = static_cast<float>(sight.options.ior);
        Interface out =
            intoAir(intoWater(toFrame(tile.frame, ray), ior), unit({-water.slope.x, -water.slope.y, 1.0F}), ior);
        out.transmitted = fromFrame(tile.frame, out.transmitted);
        return out;
    }

    /// What is seen through a bead, premultiplied.
    [[nodiscard]] Four throughBead(const WaterMet& water, const ViewTile& tile, Vec3f ray) const
    {
        const Interface out = beyond(water, tile, ray);
        const Four outside =
            out.reflected < 1.0F ? sight.backdrop.at(sight.backdrop.placeOf(out.transmitted, 0)) : cabin;
        return four(water.cover) * seen(outside, 1.0F - out.reflected);
    }

    /// What is seen through thin water, premultiplied: the bare picture, a little aside.
    [[nodiscard]] Four throughFilm(const WaterMet& water, const ViewTile& tile, Vec3f ray) const
    {
        const Interface out = beyond(water, tile, ray);
        if (out.reflected >= 1.0F || out.transmitted.y <= 0.0F) {
            Four dark = pane * cabin;
            dark[3] = 1.0F;
            return four(water.cover) * dark;
        }
        const auto index = [](float place, int count) {
            return std::clamp(place - 0.5F, 0.0F, static_cast<float>(count - 1));
        };
        const Eye& eye = sight.eye;
        const float scale = 1.0F / (out.transmitted.y * eye.tangent());
        const float x = index(scale * out.transmitted.x + 0.5F * static_cast<float>(eye.width()), eye.width());
        const float y = index(0.5F * static_cast<float>(eye.height()) - scale * out.transmitted.z, eye.height());
        const int column = std::min(static_cast<int>(x), eye.width() - 2);
        const int row = std::min(static_cast<int>(y), eye.height() - 2);
        const auto at = [&](int i, int j) {
            const std::uint8_t* const from = bare.rgb.data() + 3 * eye.at(column + i, row + j);
            return lightOf(from[0], from[1], from[2]);
        };
        const float right = x - static_cast<float>(column);
        const float below = y - static_cast<float>(row);
        const Four above = at(0, 0) + four(right) * (at(1, 0) - at(0, 0));
        const Four under = at(0, 1) + four(right) * (at(1, 1) - at(0, 1));
        Four light =
            (above + four(below) * (under - above)) * four(1.0F - out.reflected) + four(out.reflected) * (pane * cabin);
        light[3] = 1.0F;
        return four(water.cover) * light;
    }

    /// Lays water that wipers have left under light.
    void layUnder(std::size_t number, TileLight& light) const
    {
        const ViewTile& tile = sight.tiles[number];
        forTile(number, [&](std::size_t pixel, Vec3f ray, Vec2f place) {
            const WaterMet water = wipers.left(place, tile.pixel);
            if (water.cover > 0.0F) {
                light[pixel] += four(1.0F - light[pixel][3]) *
                                (water.is_bead ? throughBead(water, tile, ray) : throughFilm(water, tile, ray));
            }
        });
    }

    /// Lays wipers, and the water that they push, over light.
    template <typename Touch>
    void layWipers(std::size_t number, int moment, TileLight& light, const Touch& touch) const
    {
        const ViewTile& tile = sight.tiles[number];
        forTile(number, [&](std::size_t pixel, Vec3f ray, Vec2f place) {
            const WiperMet met = wipers.at(place, tile.pixel, moment);
            if (met.cover > 0.0F) {
                Four rubber = four(met.cover * met.shine) * (pane * cabin);
                rubber[3] = met.cover;
                light[pixel] = rubber + four(1.0F - met.cover) * light[pixel];
            }
            if (met.pushed.cover > 0.0F) {
                light[pixel] = throughBead(met.pushed, tile, ray) + four(1.0F - met.pushed.cover) * light[pixel];
            }
            if (met.cover > 0.0F || met.pushed.cover > 0.0F) {
                touch(pixel);
            }
        });
    }

    /// Lays a droplet's rays over light.
    [[gnu::always_inline]] void lay(const std::vector<Ray>& rays, TileLight& light) const
    {
        const float share = shareOfRay();
        for (auto ray = rays.begin(); ray != rays.end();) {
            const std::uint8_t pixel = ray->pixel;
            Four sum = four(0.0F);
            for (; ray != rays.end() && ray->pixel == pixel; ++ray) {
                const float part = (ray->is_whole ? 1.0F / 255.0F : share) * static_cast<float>(ray->cover);
                const Four outside = ray->light > 0 ? sight.backdrop.at(ray->place) : cabin;
                sum += four(part) * seen(outside, static_cast<float>(ray->light) / 255.0F);
            }
            light[pixel] = sum + four(1.0F - sum[3]) * light[pixel];
        }
    }

    /// Of a pixel, in 255ths of what it covers.
    [[nodiscard]] float shareOfRay() const
    {
        return 1.0F / (255.0F * static_cast<float>(sight.options.samples * sight.options.samples));
    }

    /// What is seen along a ray of which a share gets out and the rest is led back inside.
    [[nodiscard]] Four seen(Four outside, float share) const
    {
        return pane * (cabin + four(share) * (outside - cabin));
    }

    /// Pixels of a tile that blurred droplets pass, and the sum of what is seen in them.
    struct Passed {
        std::array<Four, kTilePixels> sums;
        std::array<int, kTilePixels> moments;  ///< at how many there is something else than at rest
    };

    /// Adds up what is seen in a tile at each of the moments.
    /// @param base  light of what does not move
    /// @param look  what of (pixel of the tile, light) is added up
    template <typename Look>
    void pass(std::size_t tile, int moments, const TileLight& base, const Look& look, Passed& passed) const
    {
        passed.sums.fill(four(0.0F));
        passed.moments.fill(0);
        TileLight light = base;
        std::vector<std::uint8_t> touched;
        for (int moment = 0; moment < moments; ++moment) {
            touched.clear();
            for (const RaysInTile& in_tile : running->inTile(tile)) {
                if (in_tile.moments > 1 && in_tile.moment == moment * in_tile.moments / moments) {
                    lay(*in_tile.rays, light);
                    for (const Ray& ray : *in_tile.rays) {
                        touched.push_back(ray.pixel);
                    }
                }
            }
            if (wipers.reach(tile)) {
                layWipers(tile, moment * wipers.moments() / moments, light,
                          [&](std::size_t pixel) { touched.push_back(static_cast<std::uint8_t>(pixel)); });
            }
            std::sort(touched.begin(), touched.end());
            touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
            for (const std::uint8_t pixel : touched) {
                passed.sums[pixel] += look(pixel, light[pixel]);
                ++passed.moments[pixel];
                light[pixel] = base[pixel];
            }
        }
    }

    /// Puts the light of a tile in which nothing is blurred on what takes it.
    template <typename Taker>
    void takeTile(int column, int row, const TileLight& light, const EncodedLevels& levels, Taker& taker) const
    {
        const int left = column * kTile;
        const auto across = static_cast<std::size_t>(std::min(kTile, sight.eye.width() - left));
        const int bottom = std::min((row + 1) * kTile, sight.eye.height());
        const Four* from = light.data();
        for (int y = row * kTile; y < bottom; ++y, from += kTile) {
            const std::size_t first = sight.eye.at(left, y);
            for (std::size_t x = 0; x < across; ++x) {
                const Straight straight = straightOf(from[x], levels);
                if (straight.alpha > 0) {
                    taker.take(first + x, straight);
                }
            }
        }
    }

    /// Puts what is seen on what takes it, in parallel; tiles without water are skipped.
    template <typename Taker>
    void forWet(Taker& taker) const
    {
        const Tiles& tiles = sight.tiles;
        tbb::parallel_for(0, tiles.rows(), [&](int r) {
            TileLight light;
            Passed passed;
            const EncodedLevels& levels = encodedLevels();
            for (int c = 0; c < tiles.columns(); ++c) {
                const std::size_t tile = tiles.number(c, r);
                if (stills->inTile(tile).empty() && running->inTile(tile).empty() && !wipers.reach(tile)) {
                    continue;
                }
                const int moments = shine(tile, light);
                const auto number = [&](std::size_t pixel) {
                    return sight.eye.at(c * kTile + static_cast<int>(pixel % kTile),
                                        r * kTile + static_cast<int>(pixel / kTile));
                };
                if (moments == 1) {
                    takeTile(c, r, light, levels, taker);
                    continue;
                }
                const auto look = [&](std::uint8_t pixel, const Four& seen) {
                    return taker.light(number(pixel), straightOf(seen));
                };
                pass(tile, moments, light, look, passed);
                for (int y = r * kTile; y < std::min((r + 1) * kTile, sight.eye.height()); ++y) {
                    for (int x = c * kTile; x < std::min((c + 1) * kTile, sight.eye.width()); ++x) {
                        const std::uint8_t pixel = pixelInTile(x, y);
                        const Straight straight = straightOf(light[pixel], levels);
                        if (passed.moments[pixel] > 0) {
                            const std::size_t at = sight.eye.at(x, y);
                            const auto rest = static_cast<float>(moments - passed.moments[pixel]);
                            taker.takeMean(at, four(1.0F / static_cast<float>(moments)) *
                                                   (passed.sums[pixel] + four(rest) * taker.light(at, straight)));
                        } else if (straight.alpha > 0) {
                            taker.take(sight.eye.at(x, y), straight);
                        }
                    }
                }
            }
        });
    }

    Sight sight;
    std::optional<StillSamples> stills;
    std::optional<RunningRays> running;
    WiperView wipers;
    std::optional<Environment> around;
    bool has_picture = false;
    Picture bare;
    std::array<std::uint16_t, 48> through_pane{};            ///< of levels, in 256ths, for 16 pixels
    std::array<std::array<std::uint8_t, 256>, 3> exposed{};  ///< of each level and colour, where there is an exposure
    Four pane{};
    std::uint8_t thin_level = 0;         ///< of the backdrop, through thin water
    Four cabin{0.0F, 0.0F, 0.0F, 1.0F};  ///< light of what is inside
};

DriversView::DriversView(const Glass& glass, const ViewOptions& options)
{
    options.validate();
    content_ = std::make_unique<Content>(glass, options);
}

DriversView::~DriversView() = default;
DriversView::DriversView(DriversView&&) noexcept = default;
DriversView& DriversView::operator=(DriversView&&) noexcept = default;

void DriversView::lookAt(const Picture& picture)
{
    picture.validate();
    Content& content = *content_;
    if (picture.width != content.sight.eye.width() || picture.height != content.sight.eye.height()) {
        throw Error(ErrorCode::InvalidArgument, "picture of " + std::to_string(picture.width) + " by " +
                                                    std::to_string(picture.height) + " pixels must be of the frame's " +
                                                    std::to_string(content.sight.eye.width()) + " by " +
                                                    std::to_string(content.sight.eye.height()));
    }
    const ViewOptions& options = content.sight.options;
    if (content.around && !content.has_picture) {
        content.has_picture = true;
        content.begin();
    }
    content.has_picture = true;
    const Highlights highlights(picture, content.exposure(), options.highlight_boost);
    content.sight.backdrop.take(picture, highlights);
    content.darken(content.sight.backdrop.mean());
    if (options.background_blur > 0.0) {
        content.takeBlurred(picture, highlights);
        return;
    }
    const std::array<std::uint16_t, 48> shares = content.through_pane;
    const std::uint8_t* const from = picture.rgb.data();
    std::uint8_t* const to = content.bare.rgb.data();
    constexpr std::size_t kRun = 48;  // as many as are done at once
    constexpr std::size_t kRunsWorthAThread = 512;
    const std::size_t runs = picture.rgb.size() / kRun;
    if (options.exposure != 0.0) {
        const auto& levels = content.exposed;
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, picture.rgb.size() / 3, kRun * kRunsWorthAThread),
                          [&](const auto& range) {
                              for (std::size_t at = range.begin(); at < range.end(); ++at) {
                                  for (std::size_t c = 0; c < 3; ++c) {
                                      to[3 * at + c] = levels[c][from[3 * at + c]];
                                  }
                              }
                          });
        return;
    }
    // By 16 bits, which hold it all: 255 x 256 + 128.
    const auto dimmed = [](std::uint8_t level, std::uint16_t share) {
        return static_cast<std::uint8_t>(static_cast<std::uint16_t>(level * share + 128) >> 8);
    };
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, runs, kRunsWorthAThread), [&](const auto& range) {
        // The thread's own: bytes written may be any that are read, for all that a compiler knows.
        const std::array<std::uint16_t, kRun> own = shares;
        for (std::size_t run = range.begin(); run < range.end(); ++run) {
            std::array<std::uint8_t, kRun> levels;
            std::copy_n(from + run * kRun, kRun, levels.begin());
            for (std::size_t k = 0; k < kRun; ++k) {
                levels[k] = dimmed(levels[k], own[k]);
            }
            std::copy_n(levels.begin(), kRun, to + run * kRun);
        }
    });
    for (std::size_t k = 0; runs * kRun + k < picture.rgb.size(); ++k) {
        to[runs * kRun + k] = dimmed(from[runs * kRun + k], shares[k]);
    }
}

void DriversView::surround(const Environment& environment)
{
    environment.validate();
    Content& content = *content_;
    content.around = environment;
    content.begin();
    if (!content.has_picture) {
        content.takeSurroundings(environment);
    }
}

void DriversView::show(const WindshieldState& state)
{
    content_->stills->follow(StillCells::of(state.still));
    content_->running->follow(state.droplets);
    content_->wipers.follow(state.time);
}

const Picture& DriversView::bare() const
{
    return content_->bare;
}

Layer DriversView::layer() const
{
    const Content& content = *content_;
    Layer layer{content.sight.eye.width(), content.sight.eye.height(), {}};
    layer.rgba.assign(content.bare.rgb.size() / 3 * 4, 0);
    LayerTaker taker(layer);
    content.forWet(taker);
    return layer;
}

Picture DriversView::frame() const
{
    const Content& content = *content_;
    Picture frame = content.bare;
    FrameTaker taker(frame);
    content.forWet(taker);
    return frame;
}

std::optional<Vec2> DriversView::onGlass(int x, int y) const
{
    const Content& content = *content_;
    if (x < 0 || y < 0 || x >= content.sight.eye.width() || y >= content.sight.eye.height()) {
        return std::nullopt;
    }
    const Vec2f place = content.sight.eye.place(x, y);
    return std::isnan(place.x) ? std::nullopt
                               : std::optional(Vec2{static_cast<double>(place.x), static_cast<double>(place.y)});
}

std::size_t DriversView::cellsDrawn() const
{
    return content_->stills->cellsDrawn();
}

}  // namespace droplet
