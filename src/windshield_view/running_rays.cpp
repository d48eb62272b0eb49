// SPDX-License-Identifier: GPL-3.0-or-later
#include "windshield_view/running_rays.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "windshield_view/body_relief.h"
#include "windshield_view/water_optics.h"

namespace droplet {

/// Droplet to be traced, at one moment.
struct RunningRays::Traced {
    Vec2f position;
    Vec2f along;       ///< unit direction of the motion
    GlassFrame frame;  ///< x along the motion
    Capsule capsule;
    const BodyRelief* relief = nullptr;  ///< in place of the capsule
    float wide = 0.0F;                   ///< half the width, seen from above [m]
    std::uint8_t level = 0;              ///< level of the backdrop
    std::uint8_t calm_level = 0;         ///< level of the backdrop with one ray per pixel
    int moment = 0;
    bool is_passing = false;  ///< true: one ray per pixel suffices, as there are many moments
    int left = 0;             ///< box of pixels that it may reach
    int right = -1;
    int top = 0;
    int bottom = -1;
};

void RunningRays::update(const std::vector<RunningDroplet>& droplets)
{
    std::vector<Drawn> next(droplets.size());
    // Unchanged droplets keep their rays; both lists are in the order of ids.
    auto before = drawn_.begin();
    for (std::size_t k = 0; k < droplets.size(); ++k) {
        const RunningDroplet& droplet = droplets[k];
        before = std::find_if(before, drawn_.end(), [&](const Drawn& one) { return one.droplet.id >= droplet.id; });
        if (before != drawn_.end() && before->droplet.id == droplet.id &&
            before->droplet.position == droplet.position && before->droplet.velocity == droplet.velocity &&
            before->droplet.volume == droplet.volume) {
            next[k] = std::move(*before);
        }
    }
    constexpr std::size_t kDropletsPerBlock = 32;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, droplets.size(), kDropletsPerBlock), [&](const auto& range) {
        for (std::size_t k = range.begin(); k < range.end(); ++k) {
            if (next[k].droplet.volume == 0.0) {
                next[k] = drawnOf(droplets[k]);
            }
        }
    });
    drawn_ = std::move(next);
    for (std::vector<RaysInTile>& rays : in_tiles_) {
        rays.clear();
    }
    for (const Drawn& one : drawn_) {
        for (const Part& part : one.parts) {
            in_tiles_[part.tile].push_back({&part.rays, part.moment, one.moments});
        }
    }
}

RunningRays::Drawn RunningRays::drawnOf(const RunningDroplet& droplet) const
{
    Drawn result{droplet, scene_.momentsOf(droplet.position, length(droplet.velocity)), {}};
    const std::optional<BodyRelief> relief = scene_.reliefs.of(droplet);
    for (int moment = 0; moment < result.moments; ++moment) {
        RunningDroplet there = droplet;
        there.position = there.position + scene_.timeOf(moment, result.moments) * droplet.velocity;
        Traced one = prepare(there, relief ? &*relief : nullptr);
        one.moment = moment;
        constexpr int kManyMoments = 4;
        one.is_passing = result.moments >= kManyMoments;
        trace(one, result.parts);
    }
    return result;
}

RunningRays::Traced RunningRays::prepare(const RunningDroplet& droplet, const BodyRelief* relief) const
{
    const ViewOptions& options = scene_.options;
    const float tangent = scene_.eye.tangent();
    Traced one;
    const auto on_glass = scene_.glass.place(droplet.position);
    if (!on_glass) {
        return one;
    }
    const GlassPlace place = scene_.eye.seen(*on_glass);
    const double speed = length(droplet.velocity);
    const Vec2 along = speed > 0.0 ? (1.0 / speed) * droplet.velocity : Vec2{1.0, 0.0};
    const Vec3 right = along.x * place.across + along.y * place.up;
    const Vec3 left = along.x * place.up - along.y * place.across;
    one.position = {static_cast<float>(droplet.position.x), static_cast<float>(droplet.position.y)};
    one.along = {static_cast<float>(along.x), static_cast<float>(along.y)};
    one.frame = {toFloats(right), toFloats(left), toFloats(place.normal)};
    one.relief = relief;
    Vec2f low;
    Vec2f high;
    if (relief != nullptr) {
        one.wide = relief->half_width;
        low = relief->low;
        high = relief->high;
    } else {
        const RunningShape shape = runningShape(droplet.volume, speed, options.shape);
        one.capsule = {static_cast<float>(shape.half_length), static_cast<float>(shape.radius),
                       static_cast<float>(shape.centre_height)};
        one.wide = static_cast<float>(shape.silhouette());
        high = {one.capsule.half_length + one.wide, one.wide};
        low = {-high.x, -high.y};
    }
    float leftmost = 1e9F;
    float rightmost = -1e9F;
    float top = 1e9F;
    float bottom = -1e9F;
    for (const double x : {low.x, high.x}) {
        for (const double y : {low.y, high.y}) {
            const Vec3 corner = place.point + x * right + y * left;
            if (corner.y < 1e-3) {
                return one;
            }
            const auto px =
                static_cast<float>(corner.x / corner.y) / tangent + 0.5F * static_cast<float>(options.width);
            const auto py =
                0.5F * static_cast<float>(options.height) - static_cast<float>(corner.z / corner.y) / tangent;
            leftmost = std::min(leftmost, px);
            rightmost = std::max(rightmost, px);
            top = std::min(top, py);
            bottom = std::max(bottom, py);
        }
    }
    constexpr float kRim = 2.0F;  // [px]; for the soft edge and the curve of the glass
    const auto w = static_cast<float>(options.width);
    const auto h = static_cast<float>(options.height);
    if (rightmost < -kRim || leftmost > w + kRim || bottom < -kRim || top > h + kRim) {
        return one;
    }
    one.left = static_cast<int>(std::max(leftmost - kRim, 0.0F));
    one.right = static_cast<int>(std::min(rightmost + kRim, w - 1.0F));
    one.top = static_cast<int>(std::max(top - kRim, 0.0F));
    one.bottom = static_cast<int>(std::min(bottom + kRim, h - 1.0F));
    const Tiles& tiles = scene_.tiles;
    const ViewTile& tile = tiles[tiles.number((one.left + one.right) / 2 / kTile, (one.top + one.bottom) / 2 / kTile)];
    const float diameter = tile.on_glass ? 2.0F * one.wide / tile.pixel : rightmost - leftmost;
    one.level = scene_.levelFor(diameter);
    one.calm_level = scene_.levelFor(diameter / static_cast<float>(options.samples));
    return one;
}

void RunningRays::trace(const Traced& one, std::vector<Part>& parts) const
{
    for (int r = one.top / kTile; r <= one.bottom / kTile && one.bottom >= 0; ++r) {
        for (int c = one.left / kTile; c <= one.right / kTile && one.right >= 0; ++c) {
            const auto number = static_cast<std::uint32_t>(scene_.tiles.number(c, r));
            Part part{number, one.moment, {}};
            trace(one, c, r, part.rays);
            if (!part.rays.empty()) {
                parts.push_back(std::move(part));
            }
        }
    }
}

void RunningRays::trace(const Traced& one, int column, int row, std::vector<Ray>& rays) const
{
    const ViewOptions& options = scene_.options;
    const ViewTile& tile = scene_.tiles[scene_.tiles.number(column, row)];
    const auto ior = static_cast<float>(options.ior);
    const int n = options.samples;
    const float soft = one.is_passing ? tile.pixel : tile.pixel / static_cast<float>(n);
    // In its middle a droplet is smooth: one ray per pixel suffices.
    const float calm = 0.4F * one.wide + tile.pixel;
    const auto inside_by = [&](float along, float aside) {
        if (one.relief != nullptr) {
            return one.relief->inside({along, aside});
        }
        const float end = std::max(std::abs(along) - one.capsule.half_length, 0.0F);
        return one.wide - std::sqrt(end * end + aside * aside);
    };
    for (int y = std::max(one.top, row * kTile); y <= std::min(one.bottom, row * kTile + kTile - 1); ++y) {
        for (int x = std::max(one.left, column * kTile); x <= std::min(one.right, column * kTile + kTile - 1); ++x) {
            const Vec2f middle = scene_.eye.place(x, y);
            if (std::isnan(middle.x)) {
                continue;
            }
            const float dx = middle.x - one.position.x;
            const float dy = middle.y - one.position.y;
            const float inside_outline =
                inside_by(one.along.x * dx + one.along.y * dy, one.along.x * dy - one.along.y * dx);
            if (inside_outline < -2.0F * tile.pixel) {
                continue;
            }
            const Vec3f inside = intoWater(toFrame(one.frame, scene_.eye.ray(x, y)), ior);
            // Adds a ray with an offset from the pixel's middle.
            const auto add = [&](float u, float v, bool is_whole) {
                const float ex = dx + u * tile.right.x + v * tile.down.x;
                const float ey = dy + u * tile.right.y + v * tile.down.y;
                const float a = one.along.x * ex + one.along.y * ey;
                const float b = one.along.x * ey - one.along.y * ex;
                const float cover = std::min(inside_by(a, b) / soft + 0.5F, 1.0F);
                if (cover <= 0.0F) {
                    return;
                }
                const Vec3f normal = one.relief != nullptr ? one.relief->normalAtExit({a, b}, inside)
                                                           : normalAtExit(one.capsule, {a, b, 0.0F}, inside);
                const Interface met = intoAir(inside, normal, ior);
                Ray found;
                found.pixel = pixelInTile(x, y);
                found.cover = level8(cover);
                found.is_whole = is_whole;
                if (met.reflected < 1.0F) {
                    found.place = scene_.backdrop.placeOf(fromFrame(one.frame, met.transmitted),
                                                          is_whole ? one.calm_level : one.level);
                    found.light = level8(1.0F - met.reflected);
                }
                rays.push_back(found);
            };
            if (one.is_passing || inside_outline > calm) {
                add(0.0F, 0.0F, true);
            } else {
                for (int j = 0; j < n; ++j) {
                    for (int i = 0; i < n; ++i) {
                        add(scene_.offset(i), scene_.offset(j), false);
                    }
                }
            }
        }
    }
}

}  // namespace droplet
