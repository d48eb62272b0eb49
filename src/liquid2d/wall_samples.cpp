// SPDX-License-Identifier: GPL-3.0-or-later
// Akinci, Ihmsen, Akinci, Solenthaler, Teschner: Versatile rigid-fluid coupling for incompressible SPH. ACM TOG 31(4),
// 2012. Departure: the samples lie a little below the surface, so that liquid at rest touches it.
#include "wall_samples.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "droplet/error.h"
#include "droplet/liquid2d/fluid.h"
#include "number_text.h"
#include "region.h"

namespace droplet {
namespace {

/// Distance of samples, in spacings: close enough that a wall is smooth.
constexpr double kSampleStep = 0.7;

Vec2 turned(Vec2 a, double angle)
{
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    return {c * a.x - s * a.y, s * a.x + c * a.y};
}

Vec2 placed(Vec2 a, const WallMotion& motion, const WallPose& pose)
{
    return motion.pivot + pose.shift + turned(a - motion.pivot, pose.angle);
}

/// Depth at which samples of a flat wall give a half-plane of particles, the first row half a row above the wall, the
/// density at rest.
double restDepth(const Kernel& kernel, double spacing)
{
    const double step = latticeStep(spacing);
    const double row = 0.5 * std::sqrt(3.0) * step;
    double liquid = 0.0;
    for (int j = 0; j <= 3; ++j) {
        for (int i = -4; i <= 4; ++i) {
            liquid += kernel.area() * kernel(std::hypot((i + 0.5 * (j % 2)) * step, j * row));
        }
    }
    const auto line = [&](double distance) {
        double sum = 0.0;
        for (int i = -8; i <= 8; ++i) {
            sum += kernel(std::hypot(i * kSampleStep * spacing, distance));
        }
        return sum;
    };
    const double area = 1.0 / line(0.0);
    double near = 0.0;
    double far = kernel.support();
    for (int k = 0; k < 60; ++k) {
        const double middle = 0.5 * (near + far);
        (liquid + area * line(middle) > 1.0 ? near : far) = middle;
    }
    return std::max(near - 0.5 * row, 0.0);
}

/// Part of a side, from 0 at its begin to 1 at its end.
struct Part {
    double from = 0.0;
    double to = 1.0;
};

/// Part of a side in a box.
Part partIn(Vec2 begin, Vec2 along, Vec2 lower, Vec2 upper)
{
    Part part;
    const auto clip = [&](double at, double change, double low, double high) {
        if (change == 0.0) {
            part = at >= low && at <= high ? part : Part{1.0, 0.0};
            return;
        }
        const double first = (low - at) / change;
        const double second = (high - at) / change;
        part = {std::max(part.from, std::min(first, second)), std::min(part.to, std::max(first, second))};
    };
    clip(begin.x, along.x, lower.x, upper.x);
    clip(begin.y, along.y, lower.y, upper.y);
    return part;
}

/// Places where liquid can meet a wall.
class Vicinity {
public:
    /// @param reach  of the kernel [m]
    Vicinity(const FluidScene& scene, double reach)
    {
        // Beyond the margin particles are removed; what is thrown over the upper edge comes back. Samples of the next
        // two supports act on the liquid or on the area of those that do.
        const double around = scene.margin + 3.0 * reach;
        lower_ = {-around, -around};
        upper_ = scene.size + Vec2{around, scene.size.y + around};
    }

    /// Part of a wall's side, at rest, that ever comes near liquid.
    [[nodiscard]] Part partNear(Vec2 begin, Vec2 along, const std::optional<WallMotion>& motion) const
    {
        if (!motion) {
            return partIn(begin, along, lower_, upper_);
        }
        // A turn keeps the distance from the pivot.
        const Vec2 pivot = motion->pivot;
        const Vec2 farthest{std::max(std::abs(lower_.x - pivot.x), std::abs(upper_.x - pivot.x)),
                            std::max(std::abs(lower_.y - pivot.y), std::abs(upper_.y - pivot.y))};
        const double radius = length(farthest) + length(motion->amplitude);
        return partIn(begin, along, pivot - Vec2{radius, radius}, pivot + Vec2{radius, radius});
    }

private:
    Vec2 lower_;
    Vec2 upper_;
};

/// Limit of all samples: they take two gigabytes.
constexpr std::size_t kMaxSamples = 20'000'000;

}  // namespace

WallPose poseAt(const WallMotion& motion, double time)
{
    WallPose pose;
    const double since = time - motion.begin;
    if (since <= 0.0) {
        return pose;
    }
    // The first period fades in by 3t² − 2t³, so that velocities are continuous.
    const double rate = 2.0 * std::numbers::pi / motion.period;
    const double t = std::min(since / motion.period, 1.0);
    const double fade = t * t * (3.0 - 2.0 * t);
    const double fade_rate = t < 1.0 ? 6.0 * t * (1.0 - t) / motion.period : 0.0;
    const double wave = std::sin(rate * since + motion.phase);
    const double factor = fade * wave;
    const double factor_rate = fade_rate * wave + fade * rate * std::cos(rate * since + motion.phase);
    pose.shift = factor * motion.amplitude;
    pose.shift_velocity = factor_rate * motion.amplitude;
    pose.angle = factor * motion.swing;
    pose.angle_velocity = factor_rate * motion.swing;
    return pose;
}

Region wallAt(const Wall& wall, double time)
{
    Region region = wall.region;
    if (wall.motion) {
        const WallPose pose = poseAt(*wall.motion, time);
        for (std::vector<Vec2>& loop : region.loops) {
            for (Vec2& point : loop) {
                point = placed(point, *wall.motion, pose);
            }
        }
    }
    return region;
}

std::vector<Region> visibleWalls(const FluidScene& scene, double time)
{
    std::vector<Region> regions;
    for (const Wall& wall : scene.walls) {
        if (wall.visible) {
            regions.push_back(wallAt(wall, time));
        }
    }
    return regions;
}

WallSampler::WallSampler(const FluidScene& scene, const Kernel& kernel)
{
    rest_.depth = restDepth(kernel, scene.spacing);
    const Vicinity vicinity(scene, kernel.support());
    for (std::size_t w = 0; w < scene.walls.size(); ++w) {
        const Wall& wall = scene.walls[w];
        walls_.push_back({{}, wall.motion, wall.visible});
        const std::size_t first = rest_.position.size();
        for (const std::vector<Vec2>& loop : wall.region.loops) {
            const double side = isInsideOnLeft(wall.region, loop) ? -1.0 : 1.0;
            for (std::size_t i = 0; i < loop.size(); ++i) {
                const Vec2 along = loop[(i + 1) % loop.size()] - loop[i];
                const double size = length(along);
                if (!(size > 0.0)) {
                    continue;
                }
                const Vec2 normal = (side / size) * Vec2{-along.y, along.x};
                const auto parts =
                    static_cast<std::size_t>(std::max(std::round(size / (kSampleStep * scene.spacing)), 1.0));
                const Part near = vicinity.partNear(loop[i], along, wall.motion);
                const double all = static_cast<double>(parts);
                const auto end = static_cast<std::size_t>(std::max(std::ceil(near.to * all), 0.0));
                for (auto k = static_cast<std::size_t>(std::floor(near.from * all)); k < end; ++k) {
                    if (rest_.position.size() == kMaxSamples) {
                        throw Error(ErrorCode::InvalidArgument,
                                    fmt::format("walls[{}].region has too long a rim near the window for a spacing of "
                                                "{} m; all rims together may have {} m",
                                                w, numberText(scene.spacing),
                                                numberText(kMaxSamples * kSampleStep * scene.spacing)));
                    }
                    const double at = (static_cast<double>(k) + 0.5) / all;
                    rest_.position.push_back(loop[i] + at * along - rest_.depth * normal);
                    rest_.normal.push_back(normal);
                    wall_.push_back(w);
                }
            }
        }
        if (wall.motion) {
            moves_ = true;
            const WallMotion& motion = *wall.motion;
            double reach = 0.0;
            for (std::size_t k = first; k < rest_.position.size(); ++k) {
                reach = std::max(reach, length(rest_.position[k] - motion.pivot));
            }
            // The fade adds up to 1.5 amplitudes per period.
            max_speed_ = std::max(max_speed_, (2.0 * std::numbers::pi + 1.5) / motion.period *
                                                  (length(motion.amplitude) + std::abs(motion.swing) * reach));
        }
    }
    rest_.velocity.resize(rest_.position.size());
    rest_.area.resize(rest_.position.size());
    // Sorted by cells of the support, so that only near samples are compared.
    const double cell = kernel.support();
    std::vector<std::pair<std::pair<long long, long long>, std::size_t>> cells;
    for (std::size_t k = 0; k < rest_.position.size(); ++k) {
        cells.push_back({{static_cast<long long>(std::floor(rest_.position[k].y / cell)),
                          static_cast<long long>(std::floor(rest_.position[k].x / cell))},
                         k});
    }
    std::sort(cells.begin(), cells.end());
    for (std::size_t k = 0; k < rest_.position.size(); ++k) {
        double sum = 0.0;
        const auto x = static_cast<long long>(std::floor(rest_.position[k].x / cell));
        const auto y = static_cast<long long>(std::floor(rest_.position[k].y / cell));
        for (long long row = y - 1; row <= y + 1; ++row) {
            auto at = std::lower_bound(cells.begin(), cells.end(), std::pair{std::pair{row, x - 1}, std::size_t{0}});
            for (; at != cells.end() && at->first <= std::pair{row, x + 1}; ++at) {
                if (wall_[at->second] == wall_[k]) {
                    sum += kernel(length(rest_.position[at->second] - rest_.position[k]));
                }
            }
        }
        rest_.area[k] = 1.0 / sum;
    }
}

WallSamples WallSampler::at(double time) const
{
    WallSamples samples = rest_;
    if (!moves_) {
        return samples;
    }
    std::vector<WallPose> poses(walls_.size());
    for (std::size_t w = 0; w < walls_.size(); ++w) {
        if (walls_[w].motion) {
            poses[w] = poseAt(*walls_[w].motion, time);
        }
    }
    for (std::size_t k = 0; k < samples.position.size(); ++k) {
        const auto& motion = walls_[wall_[k]].motion;
        if (motion) {
            const WallPose& pose = poses[wall_[k]];
            samples.position[k] = placed(samples.position[k], *motion, pose);
            samples.normal[k] = turned(samples.normal[k], pose.angle);
            const Vec2 arm = samples.position[k] - (motion->pivot + pose.shift);
            samples.velocity[k] = pose.shift_velocity + pose.angle_velocity * Vec2{-arm.y, arm.x};
        }
    }
    return samples;
}

}  // namespace droplet
