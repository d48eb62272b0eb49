// SPDX-License-Identifier: GPL-3.0-or-later
// A scene to look at through water, so that the windshield has one when nobody brings a picture. Its sizes are a
// country road's; its colours are chosen by eye.
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "droplet/view/view.h"
#include "picture/optics.h"
#include "picture/tone.h"
#include "require.h"

namespace droplet {
namespace {

constexpr float kEye = 1.2F;         // of the driver over the road [m]
constexpr float kLane = 3.5F;        // width [m]
constexpr float kLineWidth = 0.15F;  // of paint [m]
constexpr float kDash = 6.0F;        // length of paint, and twice that of gap [m]
constexpr float kFarthest = 420.0F;  // at which a light is still one [m]
constexpr double kSpread = 0.009;    // radius of a light out of focus, over the picture's width

/// Place in the picture: tangents of the angles to the right and up from straight ahead.
struct Tangents {
    float right = 0.0F;
    float up = 0.0F;
};

/// A light out of focus.
struct Disc {
    Tangents at;
    float radius = 0.0F;
    Vec3f radiance;
};

/// A light's image in the wet road: narrow and long.
struct Streak {
    Tangents at;
    float width = 0.0F;
    float length = 0.0F;
    Vec3f radiance;
};

/// From 0 to 1, the same for the same number.
float scattered(std::uint32_t n)
{
    // C. Wellons, "Prospecting for Hash Functions" (2018): lowbias32.
    n ^= n >> 16;
    n *= 0x7feb352dU;
    n ^= n >> 15;
    n *= 0x846ca68bU;
    n ^= n >> 16;
    return static_cast<float>(n >> 8) / 16777216.0F;
}

class Road {
public:
    Road(double field_of_view, double travelled)
        : travelled_(std::fmod(static_cast<float>(std::fmod(travelled, 1e5)), 1e5F)),
          spread_(static_cast<float>(2.0 * kSpread * std::tan(0.5 * field_of_view)))
    {
        light();
    }

    [[nodiscard]] Vec3f seen(Tangents at) const
    {
        Vec3f colour = mix(ground(at), sky(at), smoothstep(-0.6F * spread_, 0.6F * spread_, at.up - skyline(at.right)));
        for (const Streak& streak : streaks_) {
            const float x = (at.right - streak.at.right) / streak.width;
            const float y = (at.up - streak.at.up) / streak.length;
            const float far2 = x * x + y * y;
            if (far2 < 9.0F) {
                colour = colour + std::exp(-2.0F * far2) * streak.radiance;
            }
        }
        for (const Disc& disc : discs_) {
            const float x = at.right - disc.at.right;
            const float y = at.up - disc.at.up;
            const float far2 = x * x + y * y;
            if (far2 < 1.44F * disc.radius * disc.radius) {
                const float far = std::sqrt(far2) / disc.radius;
                // Lenses gather a little more light at the rim of what they do not focus.
                const float inside = (1.0F - smoothstep(0.88F, 1.08F, far)) * (0.8F + 0.35F * far * far);
                colour = colour + inside * disc.radiance;
            }
        }
        return colour;
    }

private:
    /// How high what stands at the horizon reaches: hills, with trees on them.
    static float skyline(float right)
    {
        const float hills = 0.010F + 0.009F * std::sin(5.1F * right + 0.6F) + 0.006F * std::sin(13.7F * right + 2.0F);
        const float trees = 0.004F * std::sin(57.0F * right) + 0.003F * std::sin(101.0F * right + 1.0F);
        // The road's cutting leaves the sky open ahead; trees close by stand at its sides.
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

    /// Share of a stripe's light, `width` wide in tangents, at a distance from its middle.
    [[nodiscard]] float stripe(float distance, float width) const
    {
        const float blur = 0.7F * spread_;
        const float reach = 0.5F * width + blur;
        return width / (width + 1.4F * blur) * (1.0F - smoothstep(0.5F * reach, 1.25F * reach, std::abs(distance)));
    }

    [[nodiscard]] Vec3f ground(Tangents at) const
    {
        const float down = std::max(-at.up, 1e-4F);
        const float depth = std::min(kEye / down, kFarthest);
        const float across = at.right * depth;
        // Verges are dark; the wet road mirrors the sky.
        // Far verges fade into what stands at the horizon.
        const Vec3f verge = mix(kFarVerge, kNearVerge, 1.0F - std::exp(-down / 0.05F));
        const float mirror = 0.10F + 0.55F * smoothstep(6.0F, 120.0F, depth);
        Vec3f road = Vec3f{0.018F, 0.020F, 0.025F} + mirror * sky({0.6F * at.right, 0.55F * down});
        const float edge = (spread_ + 0.02F) * depth;
        const float on_road = smoothstep(-1.5F * kLane - 0.6F - edge, -1.5F * kLane - 0.6F + edge, across) *
                              (1.0F - smoothstep(0.5F * kLane + 0.6F - edge, 0.5F * kLane + 0.6F + edge, across));
        const float thin = kLineWidth / depth;
        const Vec3f paint = grey(0.16F) + 0.5F * road;
        float painted =
            std::max(stripe(at.right - 0.5F * kLane / depth, thin), stripe(at.right + 1.5F * kLane / depth, thin));
        const float phase = std::fmod(depth + travelled_, 3.0F * kDash);
        const float soft = 0.2F + spread_ * depth * depth / kEye;
        const float dash = smoothstep(-soft, soft, phase) * (1.0F - smoothstep(kDash - soft, kDash + soft, phase)) +
                           smoothstep(3.0F * kDash - soft, 3.0F * kDash + soft, phase);
        painted = std::max(painted, std::min(dash, 1.0F) * stripe(at.right + 0.5F * kLane / depth, thin));
        road = mix(road, paint, painted * (1.0F - smoothstep(60.0F, 160.0F, depth)));
        return mix(verge, road, on_road);
    }

    /// A light in the open, and what the road shows of it.
    void add(float across, float height, float depth, float size, Vec3f radiance, float mirrored_share)
    {
        const Tangents at{across / depth, (height - kEye) / depth};
        // Out of focus a point's light is spread out; what is larger than that looks it.
        const float radius = std::hypot(spread_, size / depth);
        discs_.push_back({at, radius, radiance});
        if (mirrored_share > 0.0F) {
            const float drop = (height + kEye) / depth;
            streaks_.push_back({{at.right, -drop - 0.012F},
                                1.1F * radius,
                                std::max(2.0F * radius, 0.45F * drop),
                                mirrored_share * radiance});
        }
    }

    void light()
    {
        const Vec3f sodium{1.60F, 0.78F, 0.20F};
        const Vec3f white{1.75F, 1.65F, 1.40F};
        const Vec3f red{1.50F, 0.06F, 0.04F};
        // Lamps stand 36 m apart on both sides.
        constexpr float kLamps = 36.0F;
        for (int k = 1; k < 12; ++k) {
            const float depth = kLamps * static_cast<float>(k) - std::fmod(travelled_, kLamps);
            const float dim = (1.0F - smoothstep(250.0F, kFarthest, depth)) * smoothstep(9.0F, 14.0F, depth);
            if (dim > 0.0F) {
                add(4.6F, 7.5F, depth, 0.12F, dim * sodium, 0.16F);
                add(-8.1F, 7.5F, depth + 0.5F * kLamps, 0.12F, dim * sodium, 0.12F);
            }
        }
        // Cars ahead keep their distance; those that come are met at the sum of both speeds.
        constexpr float kTrain = 150.0F;
        for (const float depth : {21.0F, 52.0F, 96.0F}) {
            for (const float side : {-0.68F, 0.68F}) {
                add(0.15F + side, 0.85F, depth, 0.09F, red, 0.22F);
            }
        }
        for (const float place : {38.0F, 71.0F, 140.0F}) {
            const float gap = std::fmod(place - 1.9F * std::fmod(travelled_, kTrain) + 2.0F * kTrain, kTrain);
            const float depth = gap + 9.0F;
            const float near = smoothstep(9.0F, 13.0F, depth) * (1.0F - smoothstep(140.0F, 158.0F, depth));
            for (const float side : {-0.66F, 0.66F}) {
                add(-kLane + side, 0.7F, depth, 0.10F, near * white, 0.30F);
            }
        }
        // A village: windows and signs at both sides, of all the colours that electric light has.
        constexpr std::uint32_t kWindows = 46;
        constexpr float kVillage = 320.0F;
        for (std::uint32_t k = 0; k < kWindows; ++k) {
            const float depth =
                24.0F +
                std::fmod(kVillage * scattered(7 * k + 1) - std::fmod(travelled_, kVillage) + kVillage, kVillage);
            const float side = k % 2 == 0 ? 1.0F : -1.0F;
            const float across = side * (9.0F + 16.0F * scattered(7 * k + 2)) - 1.7F;
            const float warm = scattered(7 * k + 4);
            const Vec3f tint = warm < 0.62F   ? Vec3f{1.10F, 0.62F, 0.24F}
                               : warm < 0.8F  ? Vec3f{0.85F, 0.90F, 1.05F}
                               : warm < 0.92F ? Vec3f{0.25F, 0.85F, 0.62F}
                                              : Vec3f{1.10F, 0.25F, 0.30F};
            const float dim = smoothstep(24.0F, 34.0F, depth) * (1.0F - smoothstep(200.0F, kVillage + 24.0F, depth));
            add(across, 1.2F + 5.0F * scattered(7 * k + 3), depth, 0.25F,
                dim * (0.25F + 0.55F * scattered(7 * k + 5)) * tint, 0.0F);
        }
        // Traffic lights, far ahead.
        add(3.2F, 5.2F, 130.0F, 0.12F, {0.10F, 1.25F, 0.62F}, 0.15F);
        add(-6.9F, 5.2F, 130.0F, 0.12F, {0.10F, 1.25F, 0.62F}, 0.12F);
    }

    float travelled_;
    float spread_;  ///< radius of a point's light, a tangent
    std::vector<Disc> discs_;
    std::vector<Streak> streaks_;
};

}  // namespace

Picture defaultBackground(const ViewOptions& options, double travelled)
{
    options.validate();
    require(std::isfinite(travelled), "travelled", travelled, "finite");
    const Road road(options.field_of_view, travelled);
    Picture picture{options.width, options.height, {}};
    const auto width = static_cast<std::size_t>(options.width);
    picture.rgb.resize(3 * width * static_cast<std::size_t>(options.height));
    const auto pixel = static_cast<float>(2.0 * std::tan(0.5 * options.field_of_view) / options.width);
    tbb::parallel_for(0, options.height, [&](int y) {
        std::uint8_t* at = picture.rgb.data() + 3 * width * static_cast<std::size_t>(y);
        for (int x = 0; x < options.width; ++x) {
            const Vec3f light =
                road.seen({pixel * (static_cast<float>(x) + 0.5F - 0.5F * static_cast<float>(options.width)),
                           pixel * (0.5F * static_cast<float>(options.height) - static_cast<float>(y) - 0.5F)});
            for (const float level : {light.x, light.y, light.z}) {
                *at++ = encoded(1.0F - std::exp(-1.15F * level));
            }
        }
    });
    return picture;
}

}  // namespace droplet
