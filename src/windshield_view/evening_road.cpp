// SPDX-License-Identifier: GPL-3.0-or-later
// Default background of the driver's view. Sizes are those of a country road; colours are chosen by eye.
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "drawing/tone.h"
#include "droplet/windshield_view/view.h"
#include "hashed_number.h"
#include "render/optics.h"
#include "require.h"
#include "windshield_view/backdrop.h"

namespace droplet {
namespace {

constexpr float kEye = 1.2F;         // height of the eye over the road [m]
constexpr float kLane = 3.5F;        // width of a lane [m]
constexpr float kLineWidth = 0.15F;  // width of a painted line [m]
constexpr float kDash = 6.0F;        // length of a painted dash; gaps are twice as long [m]
constexpr float kFarthest = 420.0F;  // largest distance of a visible light [m]
constexpr double kSpread = 0.009;    // radius of a light out of focus, over the picture's width

/// Place in the picture: tangents of the angles to the right and up from straight ahead.
struct Tangents {
    float right = 0.0F;
    float up = 0.0F;
};

/// Light out of focus.
struct Disc {
    Tangents at;
    float radius = 0.0F;
    Vec3f radiance;
};

/// Reflection of a light in the wet road: narrow and long.
struct Streak {
    Tangents at;
    float width = 0.0F;
    float length = 0.0F;
    Vec3f radiance;
};

/// Constant parts of the picture: sky, verges, road and the continuous lines.
class Scenery {
public:
    /// @param spread  radius of the disc of a point of light, as a tangent
    explicit Scenery(float spread) : spread_(spread) {}

    [[nodiscard]] Vec3f seen(Tangents at) const
    {
        return mix(ground(at), sky(at), smoothstep(-0.6F * spread_, 0.6F * spread_, at.up - skyline(at.right)));
    }

    /// Share of paint at a place, for a line along the road `across` to the right.
    [[nodiscard]] float line(Tangents at, float across) const
    {
        const float depth = depthOf(at);
        // Distances are perpendicular to the line, which ends in the vanishing point: the lens blurs in all directions.
        const float slope = across / kEye;
        const float square = 1.0F / std::sqrt(1.0F + slope * slope);
        const float distance = square * std::abs(at.right + slope * at.up);
        const float half = 0.5F * square * kLineWidth / depth;
        const auto within = [&](float from) { return smoothstep(-spread_, spread_, half + from); };
        return (within(distance) + within(-distance) - 1.0F) * (1.0F - smoothstep(60.0F, 160.0F, depth));
    }

    static float depthOf(Tangents at) { return std::min(kEye / std::max(-at.up, 1e-4F), kFarthest); }

    /// Light of wet paint on a road with a given light.
    static Vec3f paintOn(Vec3f road) { return grey(0.16F) + 0.5F * road; }

private:
    /// Height of the horizon: hills with trees.
    static float skyline(float right)
    {
        const float hills = 0.010F + 0.009F * std::sin(5.1F * right + 0.6F) + 0.006F * std::sin(13.7F * right + 2.0F);
        const float trees = 0.004F * std::sin(57.0F * right) + 0.003F * std::sin(101.0F * right + 1.0F);
        // The sky is open ahead; near trees stand at the sides.
        const float sides = 0.11F * smoothstep(0.16F, 0.5F, std::abs(right + 0.02F));
        return std::max(hills + trees, 0.0F) + sides * (1.0F + 0.25F * std::sin(31.0F * right));
    }

    static Vec3f sky(Tangents at)
    {
        const float up = std::max(at.up, 0.0F);
        const Vec3f high{0.030F, 0.055F, 0.120F};
        const Vec3f middle{0.145F, 0.165F, 0.260F};
        const Vec3f low{0.850F, 0.430F, 0.200F};
        const Vec3f colour = mix(mix(low, middle, smoothstep(0.0F, 0.11F, up)), high, smoothstep(0.06F, 0.34F, up));
        const float x = at.right - 0.06F;
        const float y = at.up - 0.012F;
        const Vec3f glow{1.10F, 0.55F, 0.22F};
        const float bands = 0.5F + 0.5F * std::sin(70.0F * up + 4.0F * std::sin(3.0F * at.right + 9.0F * up));
        const Vec3f clouds = (0.05F * bands * smoothstep(0.015F, 0.05F, up) * (1.0F - smoothstep(0.10F, 0.24F, up))) *
                             Vec3f{1.0F, 0.62F, 0.50F};
        return colour + std::exp(-(x * x / 0.022F + y * y / 0.0030F)) * glow + clouds;
    }

    static constexpr Vec3f kNearVerge{0.012F, 0.016F, 0.014F};
    static constexpr Vec3f kFarVerge{0.05F, 0.045F, 0.05F};

    [[nodiscard]] Vec3f ground(Tangents at) const
    {
        const float down = std::max(-at.up, 1e-4F);
        const float depth = depthOf(at);
        const float across = at.right * depth;
        // Verges are dark and fade into the horizon; the wet road mirrors the sky.
        const Vec3f verge = mix(kFarVerge, kNearVerge, 1.0F - std::exp(-down / 0.05F));
        const float mirror = 0.10F + 0.55F * smoothstep(6.0F, 120.0F, depth);
        Vec3f road = Vec3f{0.018F, 0.020F, 0.025F} + mirror * sky({0.6F * at.right, 0.55F * down});
        const float edge = (spread_ + 0.02F) * depth;
        const float on_road = smoothstep(-1.5F * kLane - 0.6F - edge, -1.5F * kLane - 0.6F + edge, across) *
                              (1.0F - smoothstep(0.5F * kLane + 0.6F - edge, 0.5F * kLane + 0.6F + edge, across));
        const float painted = std::max(line(at, 0.5F * kLane), line(at, -1.5F * kLane));
        return mix(verge, mix(road, paintOn(road), painted), on_road);
    }

    float spread_;
};

/// Lights and dashes as seen from one place of the road.
class Lights {
public:
    /// @param spread     radius of the disc of a point of light, as a tangent
    /// @param pixel      width of a pixel, as a tangent
    /// @param travelled  distance of the car from the start [m]
    /// @param passed     distance that the car travels while the shutter is open [m]
    Lights(float spread, float pixel, double travelled, double passed)
        : travelled_(travelled), passed_(static_cast<float>(passed)), spread_(spread), pixel_(pixel)
    {
        addLights();
    }

    [[nodiscard]] const std::vector<Disc>& discs() const { return discs_; }
    [[nodiscard]] const std::vector<Streak>& streaks() const { return streaks_; }

    /// Share of paint in the dashed middle line at a depth.
    [[nodiscard]] float dashes(float depth) const
    {
        constexpr float kPeriod = 3.0F * kDash;
        // Mean over the length that the lens blurs.
        const float soft = 0.2F + spread_ * depth * depth / kEye;
        const auto painted = [](float way) {
            const float whole = std::floor(way / kPeriod);
            return kDash * whole + std::min(way - kPeriod * whole, kDash);
        };
        const float middle = depth + passed(kPeriod);
        const auto share = [&](float at) { return (painted(at + soft) - painted(at - soft)) / (2.0F * soft); };
        if (passed_ == 0.0F) {
            return share(middle);
        }
        constexpr int kMoments = 16;
        float sum = 0.0F;
        for (int k = 0; k < kMoments; ++k) {
            sum += share(middle + passed_ * ((static_cast<float>(k) + 0.5F) / kMoments - 0.5F));
        }
        return sum / kMoments;
    }

private:
    /// Distance since the last one of objects that repeat with a period.
    [[nodiscard]] float passed(double period, double times = 1.0) const
    {
        const double way = std::fmod(times * travelled_, period);
        return static_cast<float>(way < 0.0 ? way + period : way);
    }

    /// Lamp at a place of the road.
    struct Lamp {
        float across = 0.0F;  ///< [m]
        float height = 0.0F;  ///< [m]
        float depth = 0.0F;   ///< [m]
        float size = 0.0F;    ///< [m]
        Vec3f radiance;
        float mirrored_share = 0.0F;  ///< share of light that the road mirrors
        float rate = 1.0F;            ///< speed at which it comes nearer, over the car's speed
    };

    /// Adds a lamp and its reflection, at as many moments as its motion needs while the shutter is open.
    void add(const Lamp& lamp)
    {
        const float way = passed_ * lamp.rate;
        const float far = std::max(lamp.depth - 0.5F * way, 1.0F);
        const float shift = way / (far * far) * std::hypot(lamp.across, lamp.height + kEye);
        constexpr float kApart = 2.0F;  // [px]
        constexpr float kMax = 32.0F;
        const float moments = std::clamp(std::ceil(shift / (kApart * pixel_)), 1.0F, kMax);
        for (int k = 0; k < static_cast<int>(moments); ++k) {
            Lamp there = lamp;
            there.depth = std::max(lamp.depth + way * ((static_cast<float>(k) + 0.5F) / moments - 0.5F), 1.0F);
            there.radiance = (1.0F / moments) * lamp.radiance;
            addOne(moments > 1.0F ? there : lamp);
        }
    }

    void addOne(const Lamp& lamp)
    {
        const Tangents at{lamp.across / lamp.depth, (lamp.height - kEye) / lamp.depth};
        // The lens spreads a point over a disc; larger lamps are larger.
        const float radius = std::hypot(spread_, lamp.size / lamp.depth);
        discs_.push_back({at, radius, lamp.radiance});
        if (lamp.mirrored_share > 0.0F) {
            const float drop = (lamp.height + kEye) / lamp.depth;
            streaks_.push_back({{at.right, -drop - 0.012F},
                                1.1F * radius,
                                std::max(2.0F * radius, 0.45F * drop),
                                lamp.mirrored_share * lamp.radiance});
        }
    }

    void addLights()
    {
        const Vec3f sodium{1.60F, 0.78F, 0.20F};
        const Vec3f white{1.75F, 1.65F, 1.40F};
        const Vec3f red{1.50F, 0.06F, 0.04F};
        // Street lamps, 36 m apart on both sides.
        constexpr float kLamps = 36.0F;
        for (int k = 1; k < 12; ++k) {
            const float depth = kLamps * static_cast<float>(k) - passed(kLamps);
            const float dim = (1.0F - smoothstep(250.0F, kFarthest, depth)) * smoothstep(9.0F, 14.0F, depth);
            if (dim > 0.0F) {
                add({4.6F, 7.5F, depth, 0.12F, dim * sodium, 0.16F});
                add({-8.1F, 7.5F, depth + 0.5F * kLamps, 0.12F, dim * sodium, 0.12F});
            }
        }
        // Cars ahead keep their distance; oncoming cars approach at the sum of both speeds.
        constexpr float kTrain = 150.0F;
        for (const float depth : {21.0F, 52.0F, 96.0F}) {
            for (const float side : {-0.68F, 0.68F}) {
                add({0.15F + side, 0.85F, depth, 0.09F, red, 0.22F, 0.0F});
            }
        }
        constexpr float kMet = 1.9F;
        for (const float place : {38.0F, 71.0F, 140.0F}) {
            const float gap = std::fmod(place - passed(kTrain, 1.9) + kTrain, kTrain);
            const float depth = gap + 9.0F;
            const float near = smoothstep(9.0F, 13.0F, depth) * (1.0F - smoothstep(140.0F, 158.0F, depth));
            for (const float side : {-0.66F, 0.66F}) {
                add({-kLane + side, 0.7F, depth, 0.10F, near * white, 0.30F, kMet});
            }
        }
        // A village: windows and signs at both sides, in the colours of electric light.
        constexpr std::uint32_t kWindows = 46;
        constexpr float kVillage = 320.0F;
        for (std::uint32_t k = 0; k < kWindows; ++k) {
            const float depth =
                24.0F + std::fmod(kVillage * hashedNumber(7 * k + 1) - passed(kVillage) + kVillage, kVillage);
            const float side = k % 2 == 0 ? 1.0F : -1.0F;
            const float across = side * (9.0F + 16.0F * hashedNumber(7 * k + 2)) - 1.7F;
            const float warm = hashedNumber(7 * k + 4);
            const Vec3f tint = warm < 0.62F   ? Vec3f{1.10F, 0.62F, 0.24F}
                               : warm < 0.8F  ? Vec3f{0.85F, 0.90F, 1.05F}
                               : warm < 0.92F ? Vec3f{0.25F, 0.85F, 0.62F}
                                              : Vec3f{1.10F, 0.25F, 0.30F};
            const float dim = smoothstep(24.0F, 34.0F, depth) * (1.0F - smoothstep(200.0F, kVillage + 24.0F, depth));
            add({across, 1.2F + 5.0F * hashedNumber(7 * k + 3), depth, 0.25F,
                 dim * (0.25F + 0.55F * hashedNumber(7 * k + 5)) * tint, 0.0F});
        }
        // Traffic lights, far ahead.
        add({3.2F, 5.2F, 130.0F, 0.12F, {0.10F, 1.25F, 0.62F}, 0.15F, 0.0F});
        add({-6.9F, 5.2F, 130.0F, 0.12F, {0.10F, 1.25F, 0.62F}, 0.12F, 0.0F});
    }

    double travelled_;
    float passed_;
    float spread_;
    float pixel_;
    std::vector<Disc> discs_;
    std::vector<Streak> streaks_;
};

/// Film response: levels of light in steps of 1/8192.
class Film {
public:
    Film() : levels_(kSteps * kBrightest + 1)
    {
        for (std::size_t i = 0; i < levels_.size(); ++i) {
            levels_[i] = encoded(1.0F - std::exp(-1.15F * static_cast<float>(i) / static_cast<float>(kSteps)));
        }
    }
    [[nodiscard]] std::uint8_t at(float light) const
    {
        return levels_[static_cast<std::size_t>(nearest(static_cast<float>(kSteps) * light, levels_.size() - 1))];
    }

private:
    static constexpr std::size_t kSteps = 8192;
    static constexpr std::size_t kBrightest = 6;
    std::vector<std::uint8_t> levels_;
};

/// Range of pixels from `first` to before `last`.
struct Run {
    int first = 0;
    int last = 0;
};

/// Row of pixels that copies the scenery's light only where it is changed.
class LitRow {
public:
    explicit LitRow(std::size_t width) : light_(width), touched_((width + kBlock - 1) / kBlock) {}

    void begin(const Float4* scenery)
    {
        scenery_ = scenery;
        std::fill(touched_.begin(), touched_.end(), std::uint8_t{0});
    }

    /// Light of the row, which may be changed within the run.
    Float4* touch(Run run)
    {
        for (std::size_t b = static_cast<std::size_t>(run.first) / kBlock;
             b * kBlock < static_cast<std::size_t>(run.last); ++b) {
            if (touched_[b] == 0) {
                touched_[b] = 1;
                const std::size_t end = std::min((b + 1) * kBlock, light_.size());
                std::copy(scenery_ + b * kBlock, scenery_ + end, light_.data() + b * kBlock);
            }
        }
        return light_.data();
    }

    /// Writes the levels of changed pixels.
    void develop(const Film& film, std::uint8_t* row) const
    {
        for (std::size_t b = 0; b < touched_.size(); ++b) {
            for (std::size_t x = b * kBlock; touched_[b] != 0 && x < std::min((b + 1) * kBlock, light_.size()); ++x) {
                for (std::size_t c = 0; c < 3; ++c) {
                    row[3 * x + c] = film.at(light_[x][static_cast<int>(c)]);
                }
            }
        }
    }

private:
    static constexpr std::size_t kBlock = 16;
    std::vector<Float4> light_;
    std::vector<std::uint8_t> touched_;
    const Float4* scenery_ = nullptr;
};

Float4 lightOf(Vec3f colour)
{
    return Float4{colour.x, colour.y, colour.z, 0.0F};
}

}  // namespace

struct DefaultBackground::Content {
    explicit Content(const ViewOptions& options)
        : pixel(static_cast<float>(2.0 * std::tan(0.5 * options.field_of_view) / options.width)),
          spread(static_cast<float>(2.0 * kSpread * std::tan(0.5 * options.field_of_view))),
          scenery(spread),
          still{options.width, options.height, {}}
    {
        const auto width = static_cast<std::size_t>(options.width);
        light.resize(width * static_cast<std::size_t>(options.height));
        still.rgb.resize(3 * light.size());
        tbb::parallel_for(0, options.height, [&](int y) {
            LitRow row(width);
            row.begin(light.data() + width * static_cast<std::size_t>(y));
            for (int x = 0; x < options.width; ++x) {
                light[width * static_cast<std::size_t>(y) + static_cast<std::size_t>(x)] =
                    lightOf(scenery.seen({rightOf(x), upOf(y)}));
            }
            row.touch({0, options.width});
            row.develop(film, still.rgb.data() + 3 * width * static_cast<std::size_t>(y));
        });
    }

    [[nodiscard]] float rightOf(int x) const
    {
        return pixel * (static_cast<float>(x) + 0.5F - 0.5F * static_cast<float>(still.width));
    }
    [[nodiscard]] float upOf(int y) const
    {
        return pixel * (0.5F * static_cast<float>(still.height) - static_cast<float>(y) - 0.5F);
    }

    /// Pixels whose middles are within `reach` of a place.
    [[nodiscard]] Run within(float right, float reach) const
    {
        const auto column = [&](float at) {
            const float x = at / pixel + 0.5F * static_cast<float>(still.width) - 0.5F;
            return static_cast<int>(std::ceil(std::clamp(x, 0.0F, static_cast<float>(still.width))));
        };
        return {column(right - reach), column(right + reach)};
    }

    void paintDashes(LitRow& row, float up, const Lights& lights) const
    {
        const float depth = Scenery::depthOf({0.0F, up});
        const float share = up < 0.0F && depth < 160.0F ? lights.dashes(depth) : 0.0F;
        if (share <= 0.0F) {
            return;
        }
        constexpr float kAcross = -0.5F * kLane;
        const Run run = within(kAcross / depth, 0.5F * kLineWidth / depth + spread * std::hypot(1.0F, kAcross / kEye));
        Float4* const at = row.touch(run);
        for (int x = run.first; x < run.last; ++x) {
            const Float4 paint = lightOf(Scenery::paintOn({at[x][0], at[x][1], at[x][2]}));
            at[x] += float4(share * scenery.line({rightOf(x), up}, kAcross)) * (paint - at[x]);
        }
    }

    void paintStreak(LitRow& row, float up, const Streak& streak) const
    {
        constexpr float kReach = 2.2F;  // beyond it the light is less than a level
        const float y = (up - streak.at.up) / streak.length;
        if (std::abs(y) > kReach) {
            return;
        }
        const Run run = within(streak.at.right, kReach * streak.width);
        const Float4 middle = float4(std::exp(-2.0F * y * y)) * lightOf(streak.radiance);
        // e^(−2x²) by its ratio from pixel to pixel, which itself has a constant ratio.
        const float step = pixel / streak.width;
        const float x = (rightOf(run.first) - streak.at.right) / streak.width;
        float share = std::exp(-2.0F * x * x);
        float ratio = std::exp(-2.0F * step * (2.0F * x + step));
        const float turn = std::exp(-4.0F * step * step);
        Float4* const at = row.touch(run);
        for (int k = run.first; k < run.last; ++k) {
            at[k] += float4(share) * middle;
            share *= ratio;
            ratio *= turn;
        }
    }

    void paintDisc(LitRow& row, float up, const Disc& disc) const
    {
        const float y = (up - disc.at.up) / disc.radius;
        constexpr float kReach = 1.08F;
        if (std::abs(y) >= kReach) {
            return;
        }
        const Run run = within(disc.at.right, disc.radius * std::sqrt(kReach * kReach - y * y));
        const Float4 full = lightOf(disc.radiance);
        Float4* const at = row.touch(run);
        for (int k = run.first; k < run.last; ++k) {
            const float x = (rightOf(k) - disc.at.right) / disc.radius;
            const float far2 = x * x + y * y;
            // Discs of a lens are a little brighter at the rim.
            at[k] += float4((1.0F - smoothstep(0.88F, kReach, std::sqrt(far2))) * (0.8F + 0.35F * far2)) * full;
        }
    }

    float pixel;   ///< width of a pixel, as a tangent
    float spread;  ///< radius of the disc of a point of light, as a tangent
    Scenery scenery;
    Film film;
    std::vector<Float4> light;  ///< light of the scenery
    Picture still;              ///< picture of the scenery
};

DefaultBackground::DefaultBackground(const ViewOptions& options)
{
    options.validate();
    content_ = std::make_unique<const Content>(options);
}

DefaultBackground::~DefaultBackground() = default;
DefaultBackground::DefaultBackground(DefaultBackground&&) noexcept = default;
DefaultBackground& DefaultBackground::operator=(DefaultBackground&&) noexcept = default;

Picture DefaultBackground::at(double travelled, double passed) const
{
    require(std::isfinite(travelled), "travelled", travelled, "finite");
    require(passed >= 0.0 && passed <= 100.0, "passed", passed, "from 0 to 100 m");
    const Content& content = *content_;
    const Lights lights(content.spread, content.pixel, travelled, passed);
    Picture picture = content.still;
    const auto width = static_cast<std::size_t>(picture.width);
    constexpr int kRowsPerBlock = 8;
    tbb::parallel_for(tbb::blocked_range<int>(0, picture.height, kRowsPerBlock), [&](const auto& rows) {
        LitRow row(width);
        for (int y = rows.begin(); y < rows.end(); ++y) {
            const float up = content.upOf(y);
            row.begin(content.light.data() + width * static_cast<std::size_t>(y));
            content.paintDashes(row, up, lights);
            for (const Streak& streak : lights.streaks()) {
                content.paintStreak(row, up, streak);
            }
            for (const Disc& disc : lights.discs()) {
                content.paintDisc(row, up, disc);
            }
            row.develop(content.film, picture.rgb.data() + 3 * width * static_cast<std::size_t>(y));
        }
    });
    return picture;
}

Picture defaultBackground(const ViewOptions& options, double travelled)
{
    return DefaultBackground(options).at(travelled);
}

}  // namespace droplet
