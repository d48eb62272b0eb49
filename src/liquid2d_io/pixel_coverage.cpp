// SPDX-License-Identifier: GPL-3.0-or-later
#include "pixel_coverage.h"

#include <algorithm>
#include <cmath>

namespace droplet {

PixelCoverage::PixelCoverage(int width, int height)
    : width_(width), height_(height), sums_(static_cast<std::size_t>(width + 1) * static_cast<std::size_t>(height))
{
}

void PixelCoverage::addLine(Vec2 a, Vec2 b)
{
    // Cut where the line enters and leaves the picture sideways, so that each part is on one side of both edges.
    std::vector<double> cuts{0.0, 1.0};
    for (const double edge : {0.0, static_cast<double>(width_)}) {
        if ((a.x < edge) != (b.x < edge)) {
            cuts.push_back((edge - a.x) / (b.x - a.x));
        }
    }
    std::sort(cuts.begin(), cuts.end());
    const auto clamped = [&](double t) {
        const Vec2 x = a + t * (b - a);
        return Vec2{std::clamp(x.x, 0.0, static_cast<double>(width_)), x.y};
    };
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
        addInside(clamped(cuts[k]), clamped(cuts[k + 1]));
    }
}

std::vector<double> PixelCoverage::shares() const
{
    std::vector<double> shares;
    shares.reserve(sums_.size());
    for (int y = 0; y < height_; ++y) {
        double sum = 0.0;
        for (int x = 0; x < width_; ++x) {
            sum += sums_[index(x, y)];
            shares.push_back(sum);
        }
    }
    return shares;
}

std::size_t PixelCoverage::index(int x, int y) const
{
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_ + 1) + static_cast<std::size_t>(x);
}

void PixelCoverage::addInside(Vec2 a, Vec2 b)
{
    const double sign = a.y < b.y ? 1.0 : -1.0;
    if (a.y > b.y) {
        std::swap(a, b);
    }
    // Limited before the cast: a place far outside is no int.
    const int first = static_cast<int>(std::clamp(std::floor(a.y), 0.0, static_cast<double>(height_)));
    for (int y = first; y < height_ && y < b.y; ++y) {
        const double top = std::max(a.y, static_cast<double>(y));
        const double bottom = std::min(b.y, static_cast<double>(y) + 1.0);
        if (!(bottom > top)) {
            continue;
        }
        const auto x_at = [&](double at) { return a.x + (b.x - a.x) * (at - a.y) / (b.y - a.y); };
        addRow(y, std::minmax(x_at(top), x_at(bottom)), sign * (bottom - top));
    }
}

/// Adds a line through a row: of each pixel the part to the right of it.
void PixelCoverage::addRow(int y, std::pair<double, double> range, double height)
{
    const double left = std::clamp(range.first, 0.0, static_cast<double>(width_));
    const double right = std::clamp(range.second, 0.0, static_cast<double>(width_));
    const int begin = std::min(static_cast<int>(left), width_);
    const int end = std::min(static_cast<int>(right), width_);
    if (begin == end) {
        const double beyond = 1.0 - (0.5 * (left + right) - begin);
        sums_[index(begin, y)] += height * beyond;
        if (begin < width_) {
            sums_[index(begin + 1, y)] += height * (1.0 - beyond);
        }
        return;
    }
    // Within each column the line covers a part of the height; behind it pixels are covered by all of that part.
    for (int x = begin; x <= end; ++x) {
        const double from = std::max(left, static_cast<double>(x));
        const double to = std::min(right, static_cast<double>(x) + 1.0);
        const double part = height * (to - from) / (right - left);
        const double beyond = 1.0 - (0.5 * (from + to) - x);
        sums_[index(x, y)] += part * beyond;
        if (x < width_) {
            sums_[index(x + 1, y)] += part * (1.0 - beyond);
        }
    }
}

}  // namespace droplet
