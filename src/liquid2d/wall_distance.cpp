// SPDX-License-Identifier: GPL-3.0-or-later
// Distances of grid corners from polygons: sides are drawn into the corners near them, and the sign comes from the
// crossings of each row of corners, by the even-odd rule.
#include "wall_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "droplet/liquid2d/fluid.h"
#include "region.h"

namespace droplet {
namespace {

/// Thickness of walls that is told from greater ones, in cells.
constexpr double kThickest = 8.0;

/// Part of a wall's thickness that it may go in a step: liquid is put back to the nearer side.
constexpr double kWay = 0.35;

/// Range of `count` numbers from `first` on, times a step, that lie from `low` to `high`: [first, second).
std::pair<std::size_t, std::size_t> pointsBetween(double low, double high, double step, std::int64_t first,
                                                  std::size_t count)
{
    const auto begin = static_cast<double>(first);
    const auto last = static_cast<double>(count);
    return {static_cast<std::size_t>(std::clamp(std::ceil(low / step) - begin, 0.0, last)),
            static_cast<std::size_t>(std::clamp(std::floor(high / step) + 1.0 - begin, 0.0, last))};
}

}  // namespace

WallDistance::WallDistance(const FluidScene& scene, double cell) : scene_(scene)
{
    for (const Wall& wall : scene.walls) {
        std::vector<std::uint8_t>& thin = thin_.emplace_back();
        const Interior interior(wall.region);
        double thickness = kThickest;  // in cells
        double reach = 0.0;
        for (const std::vector<Vec2>& loop : wall.region.loops) {
            const double side = isInsideOnLeft(wall.region, loop) ? 1.0 : -1.0;
            for (std::size_t i = 0; i < loop.size(); ++i) {
                const Vec2 along = loop[(i + 1) % loop.size()] - loop[i];
                const double size = length(along);
                const Vec2 into = size > 0.0 ? (side * cell / size) * Vec2{-along.y, along.x} : Vec2{};
                const Vec2 middle = loop[i] + 0.5 * along;
                thin.push_back(interior.contains(middle + into) ? 0 : 1);
                while (thickness > 1.0 && !interior.contains(middle + thickness * into)) {
                    thickness *= 0.5;
                }
                reach = wall.motion ? std::max(reach, length(loop[i] - wall.motion->pivot)) : 0.0;
            }
        }
        if (wall.motion) {
            moving_.push_back({&*wall.motion, reach, kWay * thickness * cell});
        }
    }
}

double WallDistance::longestStep(double time) const
{
    double step = std::numeric_limits<double>::max();
    for (const auto& [motion, reach, way] : moving_) {
        const WallPose pose = poseAt(*motion, time);
        const double speed = length(pose.shift_velocity) + std::abs(pose.angle_velocity) * reach;
        // The fade adds up to a half to the greatest acceleration.
        const double rate = 2.0 * std::numbers::pi / motion->period;
        const double acceleration = 1.5 * rate * rate * (length(motion->amplitude) + std::abs(motion->swing) * reach);
        if (speed > 0.0 || acceleration > 0.0) {
            // speed t + acceleration t²/2 = way
            step = std::min(step, 2.0 * way / (speed + std::sqrt(speed * speed + 2.0 * acceleration * way)));
        }
    }
    return step;
}

std::vector<WallPose> WallDistance::posesAt(double time) const
{
    std::vector<WallPose> poses;
    for (const Wall& wall : scene_.walls) {
        poses.push_back(wall.motion ? poseAt(*wall.motion, time) : WallPose{});
    }
    return poses;
}

WallField WallDistance::at(double time, const GridShape& grid) const
{
    const double reach = kReach * grid.cell;
    const std::size_t columns = grid.cornerColumns();
    const std::size_t rows = grid.rows + 1;
    WallField field;
    field.poses = posesAt(time);
    field.distance.assign(grid.corners(), reach);
    field.wall.assign(grid.corners(), 0);
    std::vector<double> near;
    std::vector<std::vector<double>> crossed(rows);  // abscissae at which sides cross each row
    for (std::uint32_t w = 0; w < scene_.walls.size(); ++w) {
        const Wall& wall = scene_.walls[w];
        const Region region = wallAt(wall, time);
        near.assign(grid.corners(), reach);
        for (std::vector<double>& row : crossed) {
            row.clear();
        }
        std::size_t number = 0;
        for (const std::vector<Vec2>& loop : region.loops) {
            for (std::size_t i = 0; i < loop.size(); ++i, ++number) {
                const Vec2 a = loop[i];
                const Vec2 b = loop[(i + 1) % loop.size()];
                const Vec2 along = b - a;
                const double square = dot(along, along);
                const double thickened = thin_[w][number] != 0 ? 0.5 * grid.cell : 0.0;
                const auto [low, high] =
                    pointsBetween(std::min(a.y, a.y + along.y) - reach, std::max(a.y, a.y + along.y) + reach, grid.cell,
                                  grid.bottom, rows);
                for (std::size_t row = low; row < high; ++row) {
                    const double y = grid.placeOf(0.0, static_cast<double>(row)).y;
                    if ((a.y <= y) != (b.y <= y)) {
                        crossed[row].push_back(a.x + along.x * (y - a.y) / along.y);
                    }
                    // Part of the side within reach of the row.
                    double from = 0.0;
                    double to = 1.0;
                    if (along.y != 0.0) {
                        const double first = (y - reach - a.y) / along.y;
                        const double second = (y + reach - a.y) / along.y;
                        from = std::clamp(std::min(first, second), 0.0, 1.0);
                        to = std::clamp(std::max(first, second), 0.0, 1.0);
                    }
                    const double begin = a.x + from * along.x;
                    const double end = a.x + to * along.x;
                    const auto [left, right] = pointsBetween(std::min(begin, end) - reach, std::max(begin, end) + reach,
                                                             grid.cell, grid.left, columns);
                    for (std::size_t column = left; column < right; ++column) {
                        const Vec2 arm = Vec2{grid.placeOf(static_cast<double>(column), 0.0).x, y} - a;
                        const double at = square > 0.0 ? std::clamp(dot(arm, along) / square, 0.0, 1.0) : 0.0;
                        const Vec2 way = arm - at * along;
                        double& least = near[row * columns + column];
                        // Written so that few roots are taken.
                        const double beyond = least + thickened;
                        if (const double far = dot(way, way); far < beyond * beyond) {
                            least = std::sqrt(far) - thickened;
                        }
                    }
                }
            }
        }
        for (std::size_t row = 0; row < rows; ++row) {
            std::sort(crossed[row].begin(), crossed[row].end());
            std::size_t passed = 0;
            for (std::size_t column = 0; column < columns; ++column) {
                const double x = grid.placeOf(static_cast<double>(column), 0.0).x;
                while (passed < crossed[row].size() && crossed[row][passed] <= x) {
                    ++passed;
                }
                const std::size_t k = row * columns + column;
                const double distance = passed % 2 == 1 ? -std::abs(near[k]) : near[k];
                if (distance < field.distance[k]) {
                    field.distance[k] = distance;
                    field.wall[k] = w;
                }
            }
        }
    }
    // Corners amid walls that adjoin one another lie on a side, but not on the surface of the solid.
    const std::vector<double> alone = field.distance;
    constexpr double kOnSide = 1e-6;
    for (std::size_t row = 1; row + 1 < rows; ++row) {
        for (std::size_t k = row * columns + 1; k + 1 < (row + 1) * columns; ++k) {
            double most = -reach;
            for (const std::size_t other : {k - columns, k, k + columns}) {
                most = std::max({most, alone[other - 1], alone[other], alone[other + 1]});
            }
            if (most <= kOnSide * grid.cell) {
                field.distance[k] = std::min(field.distance[k], -grid.cell * std::numbers::sqrt2 / 2.0);
            }
        }
    }
    return field;
}

Vec2 WallDistance::velocity(const WallField& field, std::uint32_t wall, Vec2 place) const
{
    if (wall >= scene_.walls.size() || !scene_.walls[wall].motion) {
        return {};
    }
    const WallPose& pose = field.poses[wall];
    const Vec2 arm = place - (scene_.walls[wall].motion->pivot + pose.shift);
    return pose.shift_velocity + pose.angle_velocity * Vec2{-arm.y, arm.x};
}

}  // namespace droplet
