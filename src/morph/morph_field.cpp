// SPDX-License-Identifier: GPL-3.0-or-later
#include "morph_field.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "expression/field.h"
#include "expression/isoline.h"

namespace droplet {
namespace {

double areaOf(const std::vector<Loop>& loops)
{
    double area = 0.0;
    for (const Loop& loop : loops) {
        area += signedArea(loop);
    }
    return area;
}

double distanceFromSide(Vec2 p, Vec2 a, Vec2 b)
{
    const Vec2 side = b - a;
    const double square = dot(side, side);
    const double t = square > 0.0 ? std::clamp(dot(p - a, side) / square, 0.0, 1.0) : 0.0;
    return length(p - (a + t * side));
}

}  // namespace

MorphField::MorphField(Vec2 lower, Vec2 upper, double cell) : lower_(lower), cell_(cell)
{
    // Whole tiles; their last nodes stay dry, so that all loops are closed.
    const int side = 2 * kTileSide;
    const auto nodes = [&](double way) { return side * (static_cast<int>(std::ceil(way / cell / side)) + 1); };
    columns_ = nodes(upper.x - lower.x);
    rows_ = nodes(upper.y - lower.y);
    values_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
}

Vec2 MorphField::place(int column, int row) const
{
    return lower_ + Vec2{cell_ * column, cell_ * row};
}

double& MorphField::at(int column, int row)
{
    return values_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                   static_cast<std::size_t>(column)];
}

void MorphField::add(const Particles& particles, double weight)
{
    const double radius = particles.radius;
    // Integral 1 over the disc.
    const double peak = weight * particles.area * 4.0 / (std::numbers::pi * radius * radius);
    for (const Vec2 x : particles.position) {
        const Vec2 local = x - lower_;
        const auto first = [&](double middle) {
            return std::max(static_cast<int>(std::ceil((middle - radius) / cell_)), 0);
        };
        const auto last = [&](double middle, int count) {
            return std::min(static_cast<int>(std::floor((middle + radius) / cell_)), count - 1);
        };
        for (int j = first(local.y); j <= last(local.y, rows_); ++j) {
            for (int i = first(local.x); i <= last(local.x, columns_); ++i) {
                const Vec2 arm = place(i, j) - x;
                const double q = 1.0 - dot(arm, arm) / (radius * radius);
                if (q > 0.0) {
                    at(i, j) += peak * q * q * q;
                }
            }
        }
    }
}

void MorphField::add(const Region& region, double width, double weight)
{
    const double reach = 0.5 * width;
    std::vector<double> distance(values_.size(), reach);
    std::vector<std::vector<double>> crossings(static_cast<std::size_t>(rows_));
    for (const std::vector<Vec2>& loop : region.loops) {
        for (std::size_t k = 0; k < loop.size(); ++k) {
            const Vec2 a = loop[k];
            const Vec2 b = loop[k + 1 == loop.size() ? 0 : k + 1];
            const auto column = [&](double x) { return static_cast<int>(std::floor((x - lower_.x) / cell_)); };
            const auto row = [&](double y) { return static_cast<int>(std::floor((y - lower_.y) / cell_)); };
            const int i1 = std::min(column(std::max(a.x, b.x) + reach), columns_ - 1);
            const int j1 = std::min(row(std::max(a.y, b.y) + reach), rows_ - 1);
            for (int j = std::max(row(std::min(a.y, b.y) - reach) + 1, 0); j <= j1; ++j) {
                for (int i = std::max(column(std::min(a.x, b.x) - reach) + 1, 0); i <= i1; ++i) {
                    double& nearest = distance[static_cast<std::size_t>(j) * static_cast<std::size_t>(columns_) +
                                               static_cast<std::size_t>(i)];
                    nearest = std::min(nearest, distanceFromSide(place(i, j), a, b));
                }
            }
            // Rows at a.y or above, below b.y, or the reverse: a corner counts once.
            const auto above = [&](double y) {
                return std::max(static_cast<int>(std::ceil((y - lower_.y) / cell_)), 0);
            };
            for (int j = above(std::min(a.y, b.y)); j < std::min(above(std::max(a.y, b.y)), rows_); ++j) {
                const double t = (place(0, j).y - a.y) / (b.y - a.y);
                crossings[static_cast<std::size_t>(j)].push_back(a.x + t * (b.x - a.x));
            }
        }
    }
    for (int j = 0; j < rows_; ++j) {
        std::vector<double>& row = crossings[static_cast<std::size_t>(j)];
        std::sort(row.begin(), row.end());
        std::size_t passed = 0;
        for (int i = 0; i < columns_; ++i) {
            while (passed < row.size() && row[passed] <= place(i, j).x) {
                ++passed;
            }
            const double d = distance[static_cast<std::size_t>(j) * static_cast<std::size_t>(columns_) +
                                      static_cast<std::size_t>(i)];
            at(i, j) += weight * (0.5 + (passed % 2 == 1 ? d : -d) / width);
        }
    }
}

std::vector<Loop> MorphField::loops(double level, double min_area) const
{
    Field field;
    field.nodes_per_cell = 2;
    field.spacing = cell_ * field.nodes_per_cell;
    const int side = field.side();
    const int across = columns_ / side;
    const int up = rows_ / side;
    field.values.reserve(values_.size());
    for (int ty = 0; ty < up; ++ty) {
        for (int tx = 0; tx < across; ++tx) {
            field.tiles.push_back({tx, ty});
            std::array<std::int32_t, 9>& around = field.around.emplace_back();
            for (int k = 0; k < 9; ++k) {
                const int x = tx + k % 3 - 1;
                const int y = ty + k / 3 - 1;
                around[indexOf(k)] = x < 0 || y < 0 || x >= across || y >= up ? Field::kDry : y * across + x;
            }
            for (int j = 0; j < side; ++j) {
                for (int i = 0; i < side; ++i) {
                    const double value =
                        values_[indexOf(ty * side + j) * static_cast<std::size_t>(columns_) + indexOf(tx * side + i)];
                    field.values.push_back(static_cast<float>(value - level + 0.5));
                }
            }
        }
    }
    std::vector<Loop> all = isolines(field);
    std::erase_if(all, [&](const Loop& loop) { return std::abs(signedArea(loop)) < min_area; });
    for (Loop& loop : all) {
        for (Vec2& p : loop.points) {
            p = p + lower_;
        }
    }
    return all;
}

std::vector<Loop> MorphField::loopsOfArea(double area, double min_area) const
{
    // The area falls with the level. Loops that appear or vanish make it jump, by less than min_area each.
    constexpr double kClose = 1e-6;
    constexpr int kHalvings = 40;
    double low = 0.0;
    double high = 1.5;
    std::vector<Loop> best;
    double best_error = std::numeric_limits<double>::max();
    double level = 0.5;
    for (int k = 0; k < kHalvings && best_error > kClose * area; ++k) {
        std::vector<Loop> found = loops(level, min_area);
        const double error = areaOf(found) - area;
        if (std::abs(error) < best_error) {
            best_error = std::abs(error);
            best = std::move(found);
        }
        (error > 0.0 ? low : high) = level;
        level = 0.5 * (low + high);
    }
    return best;
}

}  // namespace droplet
