// SPDX-License-Identifier: GPL-3.0-or-later
// The thesis, sections 3.2.1 and 3.2.2: large droplets one by one, small ones as a map of the glass. Both refract the
// driver's rays by their normals.
#include "droplet/windshield_view/view.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>

#include "droplet/error.h"
#include "render/panorama.h"
#include "require.h"
#include "wide_vectors.h"
#include "windshield_view/body_relief.h"
#include "windshield_view/defocus.h"
#include "windshield_view/running_rays.h"
#include "windshield_view/runoff_view.h"
#include "windshield_view/splash_view.h"
#include "windshield_view/still_samples.h"
#include "windshield_view/view_context.h"
#include "windshield_view/water_optics.h"
#include "windshield_view/wiper_view.h"

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
    checkBody(body);
    shape.validate();
    forces.validate();
    require(ior >= 1.0 && ior <= 2.0, "ior", ior, "from 1 to 2");
    requireWithin("samples", samples, 1, 4);
    require(exposure >= -8.0 && exposure <= 8.0, "exposure", exposure, "from -8 to 8");
    if (highlight_boost) {
        require(*highlight_boost >= 0.0 && *highlight_boost <= 4.0, "highlight_boost", *highlight_boost, "from 0 to 4");
    }
    require(shutter_time >= 0.0 && shutter_time <= 1.0, "open_time", shutter_time, "from 0 to 1 s");
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

/// Light of the pixels of a tile.
using TileLight = std::array<Float4, kTilePixels>;

/// Levels and alpha of a pixel, not premultiplied.
struct StraightPixel {
    std::uint32_t levels = 0;  ///< from the lowest byte: red, green, blue; in one word, which fits a register
    std::uint8_t alpha = 0;

    [[nodiscard]] std::uint8_t red() const { return static_cast<std::uint8_t>(levels); }
    [[nodiscard]] std::uint8_t green() const { return static_cast<std::uint8_t>(levels >> 8U); }
    [[nodiscard]] std::uint8_t blue() const { return static_cast<std::uint8_t>(levels >> 16U); }
};

inline std::uint32_t packed(std::uint32_t red, std::uint32_t green, std::uint32_t blue)
{
    return red | green << 8U | blue << 16U;
}

/// @param light  premultiplied
[[gnu::always_inline]] inline StraightPixel straightOf(const Float4& light,
                                                       const EncodedLevels& levels = encodedLevels())
{
    const std::uint8_t alpha = level8(light[3]);
    if (alpha == 0) {
        return {};
    }
    // What is brighter than white keeps its hue.
    const float max = std::max(std::max(light[0], light[1]), std::max(light[2], light[3]));
    const Float4 straight = float4(1.0F / max) * light;
    return {packed(encoded(straight[0], levels), encoded(straight[1], levels), encoded(straight[2], levels)), alpha};
}

using Int4 = std::int32_t __attribute__((vector_size(16)));
using Short8 = std::uint16_t __attribute__((vector_size(16)));

/// What a tile shows of things that are not blurred.
struct TileContent {
    bool has_light = false;
    TileLight light;  ///< if there is any: premultiplied by what covers the pixels
};

/// Linear light of levels.
Float4 lightOf(std::uint8_t red, std::uint8_t green, std::uint8_t blue)
{
    const std::array<float, 256>& levels = displayLevels();
    return Float4{levels[red], levels[green], levels[blue], 1.0F};
}

/// What is seen through the films of a tile.
struct ThroughFilms {
    std::array<std::uint8_t, 3 * kTilePixels + 1> levels{};  ///< of red, green and blue; one more is not used
    std::array<std::uint8_t, kTilePixels> alpha;             ///< 0: levels have no meaning

    [[nodiscard]] StraightPixel operator[](std::size_t k) const
    {
        return {packed(levels[3 * k], levels[3 * k + 1], levels[3 * k + 2]), alpha[k]};
    }
};

/// Draws droplets over a frame.
class FrameWriter {
public:
    explicit FrameWriter(Picture& frame) : frame_(frame) {}

    void take(std::size_t pixel, const StraightPixel& seen)
    {
        std::uint8_t* const to = frame_.rgb.data() + 3 * pixel;
        if (seen.alpha == 255) {
            to[0] = seen.red();
            to[1] = seen.green();
            to[2] = seen.blue();
            return;
        }
        to[0] = mixedLevel(seen.red(), to[0], seen.alpha);
        to[1] = mixedLevel(seen.green(), to[1], seen.alpha);
        to[2] = mixedLevel(seen.blue(), to[2], seen.alpha);
    }

    /// @param places  of the tile
    DROPLET_WIDE_VECTORS void take(const ViewContext::TilePlaces& places, const ThroughFilms& seen)
    {
        const int across = std::min(kTile, frame_.width - places.left);
        const int rows = std::min(kTile, frame_.height - places.top);
        constexpr std::size_t kChannels = std::size_t{3} * kTile;  // of a row
        const std::uint8_t* levels = seen.levels.data();
        const std::uint8_t* alpha = seen.alpha.data();
        for (int row = 0; row < rows; ++row, levels += kChannels, alpha += kTile) {
            std::array<std::uint8_t, kChannels + 1> alphas;
            for (std::size_t c = 0; c < kTile; ++c) {
                const std::uint32_t word = 0x01010101U * alpha[c];  // the next pixel overwrites its last byte
                std::memcpy(alphas.data() + 3 * c, &word, sizeof(word));
            }
            std::uint8_t* const to =
                frame_.rgb.data() + 3 * (std::ptrdiff_t{places.top + row} * frame_.width + places.left);
            for (int c = 0; c < 3 * across; ++c) {
                to[c] = mixedLevel(levels[c], to[c], alphas[static_cast<std::size_t>(c)]);
            }
        }
    }

    /// Light of the pixel below droplets; a blurred pixel has the mean of such light.
    [[nodiscard]] Float4 light(std::size_t pixel, const StraightPixel& seen) const
    {
        const std::uint8_t* const below = frame_.rgb.data() + 3 * pixel;
        return lightOf(mixedLevel(seen.red(), below[0], seen.alpha), mixedLevel(seen.green(), below[1], seen.alpha),
                       mixedLevel(seen.blue(), below[2], seen.alpha));
    }

    void writeMean(std::size_t pixel, const Float4& mean)
    {
        for (std::size_t c = 0; c < 3; ++c) {
            frame_.rgb[3 * pixel + c] = encoded(mean[static_cast<int>(c)]);
        }
    }

private:
    Picture& frame_;
};

/// Draws droplets alone, into a layer.
class LayerWriter {
public:
    explicit LayerWriter(Layer& layer) : layer_(layer) {}

    void take(std::size_t pixel, const StraightPixel& seen)
    {
        std::uint8_t* const to = layer_.rgba.data() + 4 * pixel;
        to[0] = seen.red();
        to[1] = seen.green();
        to[2] = seen.blue();
        to[3] = seen.alpha;
    }

    /// @param places  of the tile
    void take(const ViewContext::TilePlaces& places, const ThroughFilms& seen)
    {
        for (std::size_t k = 0; k < kTilePixels; ++k) {
            if (seen.alpha[k] > 0) {
                take(places.eye.at(places.left + static_cast<int>(k % kTile), places.top + static_cast<int>(k / kTile)),
                     seen[k]);
            }
        }
    }

    [[nodiscard]] Float4 light(std::size_t /*pixel*/, const StraightPixel& seen) const
    {
        return float4(static_cast<float>(seen.alpha) / 255.0F) * lightOf(seen.red(), seen.green(), seen.blue());
    }

    void writeMean(std::size_t pixel, const Float4& mean) { take(pixel, straightOf(mean)); }

private:
    Layer& layer_;
};

}  // namespace

struct DriversView::Content {
    Content(const Glass& glass, const ViewOptions& options)
        : scene(glass, options),
          stills(std::in_place, scene),
          running(std::in_place, scene),
          wipers(scene),
          runoff(scene),
          splashes(scene)
    {
        bare.width = options.width;
        bare.height = options.height;
        bare.rgb.assign(3 * static_cast<std::size_t>(options.width) * static_cast<std::size_t>(options.height), 0);
        // A factor of light is its 2.4th root for levels, as in sRGB except for the darkest levels.
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
        pane = Float4{static_cast<float>(options.glass_colour.x), static_cast<float>(options.glass_colour.y),
                      static_cast<float>(options.glass_colour.z), 1.0F};
    }

    /// Sets the bare picture to a blurred picture.
    void setBlurred(const Picture& picture, const Highlights& highlights)
    {
        LightPicture behind{picture.width, picture.height, {}};
        behind.light.resize(picture.rgb.size() / 3);
        std::array<float, 256> times{};
        for (std::size_t level = 0; level < times.size(); ++level) {
            times[level] = highlights.factor(static_cast<float>(level) / 255.0F);
        }
        const std::array<float, 256>& levels = displayLevels();
        forPixels([&](std::size_t at) {
            const std::uint8_t* const from = picture.rgb.data() + 3 * at;
            const Float4 light{levels[from[0]], levels[from[1]], levels[from[2]], 1.0F};
            behind.light[at] = float4(times[std::max({from[0], from[1], from[2]})]) * light;
        });
        expose(defocused(std::move(behind), blur()));
    }

    /// Diameter of the blur's disc [px].
    [[nodiscard]] float blur() const
    {
        return static_cast<float>(2.0 * std::tan(0.5 * scene.options.background_blur)) / scene.eye.tangent();
    }

    /// Sets the bare picture to the panorama, until there is a picture.
    void setSurroundings(const Environment& environment)
    {
        const Eye& eye = scene.eye;
        LightPicture behind{eye.width(), eye.height(), {}};
        behind.light.resize(bare.rgb.size() / 3);
        const PictureFrame frame = eye.frame();
        forPixels([&](std::size_t at) {
            const auto column = static_cast<float>(at % static_cast<std::size_t>(eye.width()));
            const std::size_t rows_above = at / static_cast<std::size_t>(eye.width());
            const auto row = static_cast<float>(rows_above);
            constexpr int kAcross = 2;  // rays per pixel, across and down
            Vec3f sum;
            for (int k = 0; k < kAcross * kAcross; ++k) {
                const float u = 0.25F + 0.5F * static_cast<float>(k % kAcross);
                const float v = k < kAcross ? 0.25F : 0.75F;
                sum = sum + radianceFrom(environment, unit(frame.toCar(eye.rayAt(column + u, row + v))));
            }
            const float share = exposure() / (kAcross * kAcross);
            behind.light[at] = Float4{share * sum.x, share * sum.y, share * sum.z, 1.0F};
        });
        expose(defocused(std::move(behind), blur()));
        Float4 sum = float4(0.0F);
        for (std::size_t at = 0; at < bare.rgb.size(); at += 3) {
            sum += lightOf(bare.rgb[at], bare.rgb[at + 1], bare.rgb[at + 2]);
        }
        darken(float4(3.0F / static_cast<float>(bare.rgb.size())) * sum);
    }

    /// Restarts with the present surroundings and without water.
    void restart()
    {
        if (around) {
            scene.backdrop.setEnvironment(*around, scene.eye.frame(), exposure(), !has_picture);
        }
        stills.emplace(scene);
        running.emplace(scene);
    }

    [[nodiscard]] float exposure() const { return static_cast<float>(std::exp2(scene.options.exposure)); }

    /// Sets the light of the cabin: a tenth of the light ahead, chosen by eye.
    void darken(const Float4& mean) { cabin = Float4{0.1F, 0.1F, 0.1F, 1.0F} * mean; }

    /// Sets the bare picture to light seen through the pane.
    void expose(const LightPicture& behind)
    {
        const EncodedLevels& levels = encodedLevels();
        forPixels([&](std::size_t at) {
            const Float4 light = pane * behind.light[at];
            // What is brighter than white keeps its hue.
            const Float4 straight = float4(1.0F / std::max({light[0], light[1], light[2], 1.0F})) * light;
            for (std::size_t c = 0; c < 3; ++c) {
                bare.rgb[3 * at + c] = encoded(straight[static_cast<int>(c)], levels);
            }
        });
    }

    template <typename Work>
    void forPixels(const Work& work) const
    {
        constexpr std::size_t kPixelsPerBlock = 16384;
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, bare.rgb.size() / 3, kPixelsPerBlock),
                          [&](const auto& range) {
                              for (std::size_t at = range.begin(); at < range.end(); ++at) {
                                  work(at);
                              }
                          });
    }

    /// Levels through films, by levels behind them.
    struct FilmLevels {
        float reflected = -1.0F;  ///< share of light for which they hold
        std::array<std::array<std::uint8_t, 256>, 3> levels;
    };

    /// Draws what is not blurred in a tile.
    /// @param through  of the last tile, or new
    /// @param writer   as in drawWaterLeft()
    /// @return         number of moments of blurred droplets; 1: there are none
    template <typename Writer>
    int drawResting(std::size_t tile, FilmLevels& through, TileContent& content, Writer& writer) const
    {
        const bool has_blades = wipers.reachNow(tile);
        content.has_light =
            !stills->inTile(tile).empty() || !running->inTile(tile).empty() || splashes.reach(tile) || has_blades;
        if (content.has_light) {
            content.light.fill(float4(0.0F));
        }
        TileLight& light = content.light;
        const float share = shareOfRay();
        for (const StillSample& sample : stills->inTile(tile)) {
            light[sample.pixel] += float4(share * static_cast<float>(sample.cover)) *
                                   seen(scene.backdrop.at(sample.outside), static_cast<float>(sample.light) / 255.0F);
        }
        if (wipers.hasWaterLeft(tile) || runoff.reach(tile)) {
            drawWaterLeft(tile, through, content, writer);
        }
        int moments = has_blades ? wipers.moments() : 1;
        for (const RaysInTile& in_tile : running->inTile(tile)) {
            moments = std::max(moments, in_tile.moments);
            if (in_tile.moments == 1) {
                drawRays(*in_tile.rays, light);
            }
        }
        if (splashes.reach(tile)) {
            drawSplashes(tile, light);
        }
        if (has_blades && moments == 1) {
            drawWipers(tile, 0, light, [](std::size_t) {});
        }
        return moments;
    }

    /// Calls work(x, y, place on the glass) for all pixels of a tile that see the glass.
    template <typename Work>
    void forTile(std::size_t tile, const Work& work) const
    {
        const auto columns = static_cast<std::size_t>(scene.tiles.columns());
        const int left = static_cast<int>(tile % columns) * kTile;
        const int top = static_cast<int>(tile / columns) * kTile;
        for (int y = top; y < std::min(top + kTile, scene.eye.height()); ++y) {
            for (int x = left; x < std::min(left + kTile, scene.eye.width()); ++x) {
                const Vec2f place = scene.eye.place(x, y);
                if (!std::isnan(place.x)) {
                    work(x, y, place);
                }
            }
        }
    }

    /// Light through a bead, premultiplied.
    [[nodiscard]] Float4 throughBead(const WaterMet& water, const ViewTile& tile, Vec3f ray) const
    {
        const Interface out = scene.beyond(water.slope, tile, ray);
        const Float4 outside =
            out.reflected < 1.0F ? scene.backdrop.at(scene.backdrop.placeOf(out.transmitted, 0)) : cabin;
        return float4(water.cover) * seen(outside, 1.0F - out.reflected);
    }

    /// Pixel of the bare picture, and a place between it, the next one and the row below.
    struct PlaceBetween {
        std::int32_t pixel = 0;  ///< upper left one
        std::int32_t below = 0;  ///< from its row to the next, in kParts
        float across = 0.0F;     ///< from it to the next
    };
    static constexpr std::int32_t kParts = 256;  // weights of rows have 8 bits, as levels

    /// @param x, y  within the picture [px]
    [[nodiscard]] PlaceBetween placeBetween(float x, float y) const
    {
        const auto rows = static_cast<std::int32_t>(static_cast<float>(kParts) * y);
        const std::int32_t left = std::min(static_cast<std::int32_t>(x), scene.eye.width() - 2);
        const std::int32_t top = std::min(rows / kParts, scene.eye.height() - 2);
        return {top * scene.eye.width() + left, rows - kParts * top, x - static_cast<float>(left)};
    }

    /// Levels of a place in the bare picture. Levels, not light, are interpolated: a part of a pixel makes no
    /// difference that is seen.
    [[nodiscard]] Int4 levelsAt(const PlaceBetween& place) const
    {
        const std::uint8_t* const above = bare.rgb.data() + 3 * std::ptrdiff_t{place.pixel};
        const std::uint8_t* const under = above + 3 * std::ptrdiff_t{scene.eye.width()};
        // Words of eight bytes have two pixels, and two bytes of pixels that follow or precede them.
        std::uint64_t upper = 0;
        std::uint64_t lower = 0;
        std::memcpy(&upper, above, sizeof(upper));
        std::memcpy(&lower, under - 2, sizeof(lower));
        const auto below = static_cast<std::uint16_t>(place.below);
        const Short8 across =
            shortsOf(upper) * static_cast<std::uint16_t>(kParts - below) + shortsOf(lower >> 16U) * below;
        const Short8 none{};
        const Float4 one = floatsOf(across);
        const Float4 other = floatsOf(__builtin_shufflevector(across, none, 3, 4, 5, 6, 7, 8, 9, 10));
        const Float4 sum = one + float4(place.across) * (other - one);
        return __builtin_convertvector(float4(1.0F / static_cast<float>(kParts)) * sum + float4(0.5F), Int4);
    }

    static Short8 shortsOf(std::uint64_t bytes)
    {
        using Byte16 = std::uint8_t __attribute__((vector_size(16)));
        using Long2 = std::uint64_t __attribute__((vector_size(16)));
        return reinterpret_cast<Short8>(__builtin_shufflevector(reinterpret_cast<Byte16>(Long2{bytes, 0}), Byte16{}, 0,
                                                                16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6, 22, 7, 23));
    }

    /// The first four.
    static Float4 floatsOf(Short8 shorts)
    {
        return __builtin_convertvector(
            reinterpret_cast<Int4>(__builtin_shufflevector(shorts, Short8{}, 0, 8, 1, 9, 2, 10, 3, 11)), Float4);
    }

    void setReflected(float reflected, FilmLevels& through) const
    {
        if (std::exchange(through.reflected, reflected) == reflected) {
            return;
        }
        const Float4 mirrored = float4(reflected) * (pane * cabin);
        for (std::size_t level = 0; level < 256; ++level) {
            const Float4 light = float4((1.0F - reflected) * displayLevels()[level]) + mirrored;
            for (std::size_t c = 0; c < 3; ++c) {
                through.levels[c][level] = encoded(light[static_cast<int>(c)]);
            }
        }
    }

    /// What is seen through the films of a tile.
    [[nodiscard]] DROPLET_WIDE_VECTORS ThroughFilms lookThrough(const WaterLeft& left,
                                                                const ViewContext::TilePlaces& places,
                                                                const FilmLevels& through) const
    {
        ThroughFilms seen;
        // Places of the picture that all pixels show.
        std::array<std::int32_t, kTilePixels> pixels;
        std::array<std::int32_t, kTilePixels> belows;
        std::array<float, kTilePixels> acrosses;
        const auto max_x = static_cast<float>(scene.eye.width() - 1);
        const auto max_y = static_cast<float>(scene.eye.height() - 1);
        for (std::size_t k = 0; k < kTilePixels; ++k) {
            const float x = static_cast<float>(places.left + static_cast<int>(k % kTile)) + left.shift_x[k];
            const float y = static_cast<float>(places.top + static_cast<int>(k / kTile)) + left.shift_y[k];
            const PlaceBetween place =
                placeBetween(std::min(std::max(x, 0.0F), max_x), std::min(std::max(y, 0.0F), max_y));
            pixels[k] = place.pixel;
            belows[k] = place.below;
            acrosses[k] = place.across;
        }
        for (std::size_t k = 0; k < kTilePixels; ++k) {
            seen.alpha[k] = level8(left.cover[k]);
        }
        std::array<std::uint8_t, kTilePixels> wet;
        std::size_t count = 0;
        for (std::size_t k = 0; k < kTilePixels; ++k) {
            wet[count] = static_cast<std::uint8_t>(k);
            count += left.cover[k] > 0.0F ? 1 : 0;  // without a branch, which would be guessed wrong
        }
        for (std::size_t j = 0; j < count; ++j) {
            const std::size_t k = wet[j];
            const Int4 behind = levelsAt({pixels[k], belows[k], acrosses[k]});
            const auto level = [&](int c) {
                return through.levels[static_cast<std::size_t>(c)][static_cast<std::size_t>(behind[c])];
            };
            // Its last byte is overwritten by the next pixel, or belongs to one that is dry.
            const std::uint32_t word = packed(level(0), level(1), level(2));
            std::memcpy(seen.levels.data() + 3 * k, &word, sizeof(word));
        }
        return seen;
    }

    /// Draws films, and other water that wipers have left, below the light.
    /// @param through  of the last tile, or new
    /// @param writer   gets pixels that show nothing but a film, which need no light
    template <typename Writer>
    void drawWaterLeft(std::size_t number, FilmLevels& through, TileContent& content, Writer& writer) const
    {
        WaterLeft left;
        wipers.waterLeft(number, left);
        if (runoff.reach(number)) {
            runoff.add(number, left);
        }
        setReflected(left.reflected, through);
        TileLight& light = content.light;
        if (!left.beads.empty() && !std::exchange(content.has_light, true)) {
            light.fill(float4(0.0F));
        }
        const ViewContext::TilePlaces places = scene.placesOf(number);
        for (const BeadMet& bead : left.beads) {
            const int x = places.left + bead.pixel % kTile;
            const int y = places.top + bead.pixel / kTile;
            Float4& behind = light[bead.pixel];
            behind += float4(1.0F - behind[3]) * throughBead(bead.water, scene.tiles[number], scene.eye.ray(x, y));
        }
        ThroughFilms seen = lookThrough(left, places, through);
        if (content.has_light) {
            drawUnderLight(number, left.cover, seen, light);
        }
        writer.take(places, seen);
    }

    /// Draws films where there will be other light in a tile, and takes them away.
    void drawUnderLight(std::size_t number, const std::array<float, kTilePixels>& cover, ThroughFilms& films,
                        TileLight& light) const
    {
        std::array<bool, kTilePixels> is_lit;
        is_lit.fill(splashes.reach(number) || wipers.reachNow(number));
        if (!is_lit.front()) {
            for (std::size_t k = 0; k < kTilePixels; ++k) {
                is_lit[k] = light[k][3] > 0.0F;
            }
            for (const RaysInTile& in_tile : running->inTile(number)) {
                for (const Ray& ray : *in_tile.rays) {
                    is_lit[ray.pixel] = true;
                }
            }
        }
        for (std::size_t k = 0; k < kTilePixels; ++k) {
            if (is_lit[k] && cover[k] > 0.0F) {
                const StraightPixel seen = films[k];
                light[k] += float4((1.0F - light[k][3]) * cover[k]) * lightOf(seen.red(), seen.green(), seen.blue());
                films.alpha[k] = 0;
            }
        }
    }

    /// Draws rings of splashes into the light of what rests.
    void drawSplashes(std::size_t number, TileLight& light) const
    {
        const ViewTile& tile = scene.tiles[number];
        forTile(number, [&](int x, int y, Vec2f place) {
            const int across = scene.options.samples;
            Float4 rims = float4(0.0F);
            float inside = 0.0F;
            for (int k = 0; k < across * across; ++k) {
                const float u = scene.offset(k % across);
                const float v = scene.offset(k / across);
                const SplashMet met = splashes.at(
                    number,
                    {place.x + u * tile.right.x + v * tile.down.x, place.y + u * tile.right.y + v * tile.down.y},
                    tile.pixel / static_cast<float>(across));
                inside += met.inside;
                if (met.rim.cover > 0.0F) {
                    rims += throughBead(met.rim, tile, scene.eye.ray(x, y));
                }
            }
            if (inside > 0.0F || rims[3] > 0.0F) {
                const float share = 1.0F / static_cast<float>(across * across);
                Float4& pixel = light[pixelInTile(x, y)];
                pixel *= float4(1.0F - share * inside);
                pixel = float4(share) * rims + float4(1.0F - share * rims[3]) * pixel;
            }
        });
    }

    /// Draws wipers, and the water that they push, over the light.
    template <typename Touch>
    void drawWipers(std::size_t number, int moment, TileLight& light, const Touch& touch) const
    {
        const ViewTile& tile = scene.tiles[number];
        forTile(number, [&](int x, int y, Vec2f place) {
            const std::uint8_t pixel = pixelInTile(x, y);
            const WiperMet met = wipers.at(place, tile.pixel, moment);
            if (met.cover > 0.0F) {
                Float4 rubber = float4(met.cover * met.shine) * (pane * cabin);
                rubber[3] = met.cover;
                light[pixel] = rubber + float4(1.0F - met.cover) * light[pixel];
            }
            if (met.pushed.cover > 0.0F) {
                light[pixel] =
                    throughBead(met.pushed, tile, scene.eye.ray(x, y)) + float4(1.0F - met.pushed.cover) * light[pixel];
            }
            if (met.cover > 0.0F || met.pushed.cover > 0.0F) {
                touch(pixel);
            }
        });
    }

    /// Draws the rays of a droplet over the light.
    [[gnu::always_inline]] void drawRays(const std::vector<Ray>& rays, TileLight& light) const
    {
        const float share = shareOfRay();
        for (auto ray = rays.begin(); ray != rays.end();) {
            const std::uint8_t pixel = ray->pixel;
            Float4 sum = float4(0.0F);
            for (; ray != rays.end() && ray->pixel == pixel; ++ray) {
                const float part = (ray->is_whole ? 1.0F / 255.0F : share) * static_cast<float>(ray->cover);
                const Float4 outside = ray->light > 0 ? scene.backdrop.at(ray->place) : cabin;
                sum += float4(part) * seen(outside, static_cast<float>(ray->light) / 255.0F);
            }
            light[pixel] = sum + float4(1.0F - sum[3]) * light[pixel];
        }
    }

    /// Weight of a ray in its pixel, for a cover of 1/255.
    [[nodiscard]] float shareOfRay() const
    {
        return 1.0F / (255.0F * static_cast<float>(scene.options.samples * scene.options.samples));
    }

    /// Light of a ray of which a share leaves the water and the rest returns to the cabin.
    [[nodiscard]] Float4 seen(Float4 outside, float share) const
    {
        return pane * (cabin + float4(share) * (outside - cabin));
    }

    /// Light of a tile's pixels, summed over the moments in which blurred droplets or wipers cover them.
    struct MomentSums {
        std::array<Float4, kTilePixels> light;
        std::array<int, kTilePixels> moments;  ///< number of moments that differ from `base`
    };

    /// Sums up the light of a tile over all moments.
    /// @param base  light of everything that does not move
    /// @param look  value of (pixel of the tile, light) that is summed up
    template <typename Look>
    void sumMoments(std::size_t tile, int moments, const TileLight& base, const Look& look, MomentSums& sums) const
    {
        sums.light.fill(float4(0.0F));
        sums.moments.fill(0);
        TileLight light = base;
        std::vector<std::uint8_t> touched;
        for (int moment = 0; moment < moments; ++moment) {
            touched.clear();
            for (const RaysInTile& in_tile : running->inTile(tile)) {
                if (in_tile.moments > 1 && in_tile.moment == moment * in_tile.moments / moments) {
                    drawRays(*in_tile.rays, light);
                    for (const Ray& ray : *in_tile.rays) {
                        touched.push_back(ray.pixel);
                    }
                }
            }
            if (const int blade = moment * wipers.moments() / moments; wipers.reachNow(tile, blade)) {
                drawWipers(tile, blade, light,
                           [&](std::size_t pixel) { touched.push_back(static_cast<std::uint8_t>(pixel)); });
            }
            std::sort(touched.begin(), touched.end());
            touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
            for (const std::uint8_t pixel : touched) {
                sums.light[pixel] += look(pixel, light[pixel]);
                ++sums.moments[pixel];
                light[pixel] = base[pixel];
            }
        }
    }

    /// Writes the light of a tile in which nothing is blurred.
    template <typename Writer>
    void writeTile(int column, int row, const TileLight& light, const EncodedLevels& levels, Writer& writer) const
    {
        const int left = column * kTile;
        const auto across = static_cast<std::size_t>(std::min(kTile, scene.eye.width() - left));
        const int bottom = std::min((row + 1) * kTile, scene.eye.height());
        const Float4* from = light.data();
        for (int y = row * kTile; y < bottom; ++y, from += kTile) {
            const std::size_t first = scene.eye.at(left, y);
            for (std::size_t x = 0; x < across; ++x) {
                if (from[x][3] > 0.0F) {
                    writer.take(first + x, straightOf(from[x], levels));
                }
            }
        }
    }

    /// Draws all water, in parallel; tiles without water are skipped.
    template <typename Writer>
    void drawWater(Writer& writer) const
    {
        const Tiles& tiles = scene.tiles;
        tbb::parallel_for(0, tiles.rows(), [&](int r) {
            TileContent content;
            FilmLevels through;
            const TileLight& light = content.light;
            MomentSums sums;
            const EncodedLevels& levels = encodedLevels();
            for (int c = 0; c < tiles.columns(); ++c) {
                const std::size_t tile = tiles.number(c, r);
                if (stills->inTile(tile).empty() && running->inTile(tile).empty() && !wipers.reach(tile) &&
                    !runoff.reach(tile) && !splashes.reach(tile)) {
                    continue;
                }
                const int moments = drawResting(tile, through, content, writer);
                const auto number = [&](std::size_t pixel) {
                    return scene.eye.at(c * kTile + static_cast<int>(pixel % kTile),
                                        r * kTile + static_cast<int>(pixel / kTile));
                };
                if (moments == 1) {
                    if (content.has_light) {
                        writeTile(c, r, light, levels, writer);
                    }
                    continue;
                }
                const auto look = [&](std::uint8_t pixel, const Float4& seen) {
                    return writer.light(number(pixel), straightOf(seen));
                };
                sumMoments(tile, moments, light, look, sums);
                for (int y = r * kTile; y < std::min((r + 1) * kTile, scene.eye.height()); ++y) {
                    for (int x = c * kTile; x < std::min((c + 1) * kTile, scene.eye.width()); ++x) {
                        const std::uint8_t pixel = pixelInTile(x, y);
                        const StraightPixel straight = straightOf(light[pixel], levels);
                        if (sums.moments[pixel] > 0) {
                            const std::size_t at = scene.eye.at(x, y);
                            const auto rest = static_cast<float>(moments - sums.moments[pixel]);
                            writer.writeMean(at, float4(1.0F / static_cast<float>(moments)) *
                                                     (sums.light[pixel] + float4(rest) * writer.light(at, straight)));
                        } else if (straight.alpha > 0) {
                            writer.take(scene.eye.at(x, y), straight);
                        }
                    }
                }
            }
        });
    }

    ViewContext scene;
    std::optional<StillSamples> stills;
    std::optional<RunningRays> running;
    WiperView wipers;
    RunoffView runoff;
    SplashView splashes;
    std::optional<Environment> around;
    bool has_picture = false;
    Picture bare;
    std::array<std::uint16_t, 48> through_pane{};            ///< factors of levels, in 256ths, for 16 pixels
    std::array<std::array<std::uint8_t, 256>, 3> exposed{};  ///< level after exposure, for each colour and level
    Float4 pane{};
    Float4 cabin{0.0F, 0.0F, 0.0F, 1.0F};  ///< light inside the car
};

DriversView::DriversView(const Glass& glass, const ViewOptions& options)
{
    options.validate();
    content_ = std::make_unique<Content>(glass, options);
}

DriversView::~DriversView() = default;
DriversView::DriversView(DriversView&&) noexcept = default;
DriversView& DriversView::operator=(DriversView&&) noexcept = default;

void DriversView::setBackground(const Picture& picture)
{
    picture.validate();
    Content& content = *content_;
    if (picture.width != content.scene.eye.width() || picture.height != content.scene.eye.height()) {
        throw Error(ErrorCode::InvalidArgument,
                    "the picture has " + std::to_string(picture.width) + " by " + std::to_string(picture.height) +
                        " pixels; it must have the frame's " + std::to_string(content.scene.eye.width()) + " by " +
                        std::to_string(content.scene.eye.height()));
    }
    const ViewOptions& options = content.scene.options;
    if (content.around && !content.has_picture) {
        content.has_picture = true;
        content.restart();
    }
    content.has_picture = true;
    const Highlights highlights(picture, content.exposure(), options.highlight_boost);
    content.scene.backdrop.setPicture(picture, highlights);
    content.darken(content.scene.backdrop.mean());
    if (options.background_blur > 0.0) {
        content.setBlurred(picture, highlights);
        return;
    }
    const std::array<std::uint16_t, 48> shares = content.through_pane;
    const std::uint8_t* const from = picture.rgb.data();
    std::uint8_t* const to = content.bare.rgb.data();
    constexpr std::size_t kRun = 48;  // levels that are computed at once
    constexpr std::size_t kRunsPerBlock = 512;
    const std::size_t runs = picture.rgb.size() / kRun;
    if (options.exposure != 0.0) {
        const auto& levels = content.exposed;
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, picture.rgb.size() / 3, kRun * kRunsPerBlock),
                          [&](const auto& range) {
                              for (std::size_t at = range.begin(); at < range.end(); ++at) {
                                  for (std::size_t c = 0; c < 3; ++c) {
                                      to[3 * at + c] = levels[c][from[3 * at + c]];
                                  }
                              }
                          });
        return;
    }
    // 16 bits suffice: 255 × 256 + 128.
    const auto dimmed = [](std::uint8_t level, std::uint16_t share) {
        return static_cast<std::uint8_t>(static_cast<std::uint16_t>(level * share + 128) >> 8);
    };
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, runs, kRunsPerBlock), [&](const auto& range) {
        // Copies for each thread: for the compiler, written bytes may alias read ones.
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

void DriversView::setEnvironment(const Environment& environment)
{
    environment.validate();
    Content& content = *content_;
    content.around = environment;
    content.restart();
    if (!content.has_picture) {
        content.setSurroundings(environment);
    }
}

void DriversView::show(const WindshieldState& state)
{
    content_->stills->update(StillCells::of(state.still));
    content_->running->update(state.droplets);
    content_->wipers.update(state.time);
    content_->runoff.update(state.film);
    content_->splashes.update(state.splashes, state.time);
}

const Picture& DriversView::bare() const
{
    return content_->bare;
}

Layer DriversView::layer() const
{
    const Content& content = *content_;
    Layer layer{content.scene.eye.width(), content.scene.eye.height(), {}};
    layer.rgba.assign(content.bare.rgb.size() / 3 * 4, 0);
    LayerWriter writer(layer);
    content.drawWater(writer);
    return layer;
}

Picture DriversView::frame() const
{
    const Content& content = *content_;
    Picture frame = content.bare;
    FrameWriter writer(frame);
    content.drawWater(writer);
    return frame;
}

std::optional<Vec2> DriversView::onGlass(int x, int y) const
{
    const Content& content = *content_;
    if (x < 0 || y < 0 || x >= content.scene.eye.width() || y >= content.scene.eye.height()) {
        return std::nullopt;
    }
    const Vec2f place = content.scene.eye.place(x, y);
    return std::isnan(place.x) ? std::nullopt
                               : std::optional(Vec2{static_cast<double>(place.x), static_cast<double>(place.y)});
}

std::size_t DriversView::cellsDrawn() const
{
    return content_->stills->cellsDrawn();
}

}  // namespace droplet
