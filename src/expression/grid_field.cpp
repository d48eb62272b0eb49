// SPDX-License-Identifier: GPL-3.0-or-later
//
// Shapes between two others, as lines of equal value of a field. Distances from a rim are exact near it; farther away a
// node takes the nearest side of its neighbours', in two sweeps (P.-E. Danielsson, "Euclidean distance mapping",
// Computer Graphics and Image Processing 14, 1980).
#include "grid_field.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "field.h"
#include "isoline.h"

namespace droplet {
namespace {

/// Part of what is around a place that is liquid, above which the place is, too. It is more than a half, which is
/// around a straight edge: slits of a standard deviation of the average are filled, holes of that radius close, and
/// nothing grows outwards.
constexpr double kFilled = 0.6;

/// Difference from the field within which the average rounds it.
constexpr double kRounded = 0.1;

double squareFromSide(Vec2 p, Vec2 a, Vec2 b)
{
    const Vec2 side = b - a;
    const double square = dot(side, side);
    const double t = square > 0.0 ? std::clamp(dot(p - a, side) / square, 0.0, 1.0) : 0.0;
    const Vec2 way = p - (a + t * side);
    return dot(way, way);
}

/// Side of a region that is nearest to a node.
struct Nearest {
    double square;  ///< of the distance
    Vec2 a;
    Vec2 b;

    void take(Vec2 place, Vec2 from, Vec2 to)
    {
        if (const double other = squareFromSide(place, from, to); other < square) {
            *this = {other, from, to};
        }
    }
};

/// Lines of a grid: their number and length, and the steps from one to the next and along them.
struct Lines {
    int count;
    int length;
    int next;
    int along;
};

/// Gives every value the mean of those within `half` steps of it along its line; there is nothing beyond the ends.
void averageLines(std::vector<double>& values, const Lines& lines, int half)
{
    std::vector<double> sums(indexOf(lines.length) + 1);
    const double share = 1.0 / (2 * half + 1);
    for (int n = 0; n < lines.count; ++n) {
        const auto at = [&](int k) -> double& { return values[indexOf(n * lines.next) + indexOf(k * lines.along)]; };
        for (int k = 0; k < lines.length; ++k) {
            sums[indexOf(k + 1)] = sums[indexOf(k)] + at(k);
        }
        for (int k = 0; k < lines.length; ++k) {
            at(k) =
                share * (sums[indexOf(std::min(k + half + 1, lines.length))] - sums[indexOf(std::max(k - half, 0))]);
        }
    }
}

}  // namespace

double areaOf(const std::vector<Loop>& loops)
{
    double area = 0.0;
    for (const Loop& loop : loops) {
        area += signedArea(loop);
    }
    return area;
}

GridField::GridField(Vec2 lower, Vec2 upper, double cell) : lower_(lower), cell_(cell)
{
    // Whole tiles; their last nodes stay dry, so that all loops are closed.
    const int side = 2 * kTileSide;
    const auto nodes = [&](double way) { return side * (static_cast<int>(std::ceil(way / cell / side)) + 1); };
    columns_ = nodes(upper.x - lower.x);
    rows_ = nodes(upper.y - lower.y);
    values_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
}

Vec2 GridField::place(int column, int row) const
{
    return lower_ + Vec2{cell_ * column, cell_ * row};
}

std::size_t GridField::node(int column, int row) const
{
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
}

double GridField::at(Vec2 place) const
{
    const double x = (place.x - lower_.x) / cell_;
    const double y = (place.y - lower_.y) / cell_;
    const int i = std::clamp(static_cast<int>(x), 0, columns_ - 2);
    const int j = std::clamp(static_cast<int>(y), 0, rows_ - 2);
    const auto row = [&](int k) { return std::lerp(values_[node(i, k)], values_[node(i + 1, k)], x - i); };
    return std::lerp(row(j), row(j + 1), y - j);
}

void GridField::add(const Particles& particles, double weight)
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
                    values_[node(i, j)] += peak * q * q * q;
                }
            }
        }
    }
}

void GridField::add(const Region& region, const std::function<double(double)>& value_at)
{
    const std::vector<double> distance = signedDistance(region);
    std::transform(values_.begin(), values_.end(), distance.begin(), values_.begin(),
                   [&](double value, double d) { return value + value_at(d); });
}

std::vector<double> GridField::signedDistance(const Region& region) const
{
    const double reach = 2.0 * cell_;
    const double farthest = cell_ * std::hypot(columns_, rows_);
    std::vector<Nearest> nearest(values_.size(), {farthest * farthest, {}, {}});
    std::vector<std::vector<double>> crossings(indexOf(rows_));
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
                    nearest[node(i, j)].take(place(i, j), a, b);
                }
            }
            // Rows at a.y or above, below b.y, or the reverse: a corner counts once.
            const auto above = [&](double y) {
                return std::max(static_cast<int>(std::ceil((y - lower_.y) / cell_)), 0);
            };
            for (int j = above(std::min(a.y, b.y)); j < std::min(above(std::max(a.y, b.y)), rows_); ++j) {
                const double t = (place(0, j).y - a.y) / (b.y - a.y);
                crossings[indexOf(j)].push_back(a.x + t * (b.x - a.x));
            }
        }
    }
    // Nodes farther away take the side that is nearest to one of their neighbours: up, then down.
    const auto pass = [&](int row, int next) {
        const auto from = [&](int i, int column, int other) {
            if (column < 0 || column >= columns_ || other < 0 || other >= rows_) {
                return;
            }
            if (const Nearest& of = nearest[node(column, other)]; of.square < farthest * farthest) {
                nearest[node(i, row)].take(place(i, row), of.a, of.b);
            }
        };
        for (int i = 0; i < columns_; ++i) {
            for (int k = -1; k <= 1; ++k) {
                from(i, i + k, row - next);
            }
            from(i, i - 1, row);
        }
        for (int i = columns_ - 1; i >= 0; --i) {
            from(i, i + 1, row);
        }
    };
    for (int j = 0; j < rows_; ++j) {
        pass(j, 1);
    }
    for (int j = rows_ - 1; j >= 0; --j) {
        pass(j, -1);
    }
    std::vector<double> distance(values_.size());
    for (int j = 0; j < rows_; ++j) {
        std::vector<double>& row = crossings[indexOf(j)];
        std::sort(row.begin(), row.end());
        std::size_t passed = 0;
        for (int i = 0; i < columns_; ++i) {
            while (passed < row.size() && row[passed] <= place(i, j).x) {
                ++passed;
            }
            const double d = std::sqrt(nearest[node(i, j)].square);
            distance[node(i, j)] = passed % 2 == 1 ? d : -d;
        }
    }
    return distance;
}

void GridField::fill(double width)
{
    // Three boxes make almost a Gaussian, of the width as its standard deviation.
    const double side = std::sqrt(4.0 * width * width / (cell_ * cell_) + 1.0);
    const int half = static_cast<int>(std::lround(0.5 * (side - 1.0)));
    if (half < 1) {
        return;
    }
    std::vector<double> mean(values_.size());
    std::transform(values_.begin(), values_.end(), mean.begin(), [](double v) { return std::clamp(v, 0.0, 1.0); });
    for (int pass = 0; pass < 3; ++pass) {
        averageLines(mean, {rows_, columns_, columns_, 1}, half);
        averageLines(mean, {columns_, rows_, 1, columns_}, half);
    }
    for (std::size_t k = 0; k < values_.size(); ++k) {
        // The larger one, but for a rounding where both are alike.
        const double filled = mean[k] - kFilled + 0.5;
        values_[k] = 0.5 * (values_[k] + filled + std::hypot(values_[k] - filled, kRounded));
    }
}

std::vector<Loop> GridField::loops(double level, double min_area) const
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

std::vector<Loop> GridField::loopsOfArea(double area, double min_area) const
{
    // The area falls with the level. Loops that appear or vanish make it jump, by less than min_area each.
    constexpr double kClose = 1e-6;
    constexpr int kTrials = 40;
    constexpr double kHighest = 10.0;
    struct Bound {
        double level;
        double error;
        bool is_tried;
    };
    Bound low{-kHighest, 0.0, false};
    Bound high{kHighest, 0.0, false};
    double step = 0.05;
    std::vector<Loop> best;
    double best_error = std::numeric_limits<double>::max();
    double level = 0.5;
    for (int k = 0; k < kTrials && best_error > kClose * area; ++k) {
        std::vector<Loop> found = loops(level, min_area);
        const double error = areaOf(found) - area;
        if (std::abs(error) < best_error) {
            best_error = std::abs(error);
            best = std::move(found);
        }
        (error > 0.0 ? low : high) = {level, error, true};
        if (low.is_tried && high.is_tried) {
            // The chord's zero, but for every third time, lest one bound stays.
            const double share = k % 3 == 2 ? 0.5 : low.error / (low.error - high.error);
            level = low.level + share * (high.level - low.level);
        } else {
            level = std::clamp(level + (error > 0.0 ? step : -step), low.level, high.level);
            step *= 2.0;
        }
    }
    return best;
}

}  // namespace droplet
