// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "droplet/vector.h"

namespace droplet {

/// Closed polygon, parametrised by the length from its first point.
class Curve {
public:
    explicit Curve(std::vector<Vec2> points) : points_(std::move(points)), arc_{0.0}
    {
        for (std::size_t i = 0; i < points_.size(); ++i) {
            arc_.push_back(arc_.back() + droplet::length(end(i) - points_[i]));
        }
    }

    [[nodiscard]] std::size_t size() const { return points_.size(); }
    [[nodiscard]] double length() const { return arc_.back(); }
    [[nodiscard]] double arc(std::size_t point) const { return arc_[point]; }

    /// Maps any length into one lap.
    [[nodiscard]] double wrapped(double s) const { return s - length() * std::floor(s / length()); }

    [[nodiscard]] std::size_t pieceAt(double s) const
    {
        const auto after = std::upper_bound(arc_.begin(), arc_.end(), wrapped(s));
        return std::min(static_cast<std::size_t>(after - arc_.begin()), size()) - 1;
    }

    [[nodiscard]] Vec2 at(double s) const
    {
        const std::size_t i = pieceAt(s);
        const double t = (wrapped(s) - arc_[i]) / (arc_[i + 1] - arc_[i]);
        return points_[i] + t * (end(i) - points_[i]);
    }

    /// Place of the nearest point on the `pieces` pieces that begin at `from`, as a length that counts full laps.
    [[nodiscard]] double nearest(Vec2 p, double from, std::size_t pieces) const
    {
        double best = std::numeric_limits<double>::infinity();
        double place = from;
        std::size_t i = pieceAt(from);
        double lap = from - wrapped(from);
        for (std::size_t k = 0; k < pieces; ++k) {
            const Vec2 along = end(i) - points_[i];
            const double squared = dot(along, along);
            const double t = std::clamp(dot(p - points_[i], along) / squared, 0.0, 1.0);
            const Vec2 away = p - (points_[i] + t * along);
            if (dot(away, away) < best) {
                best = dot(away, away);
                place = lap + arc_[i] + t * (arc_[i + 1] - arc_[i]);
            }
            if (++i == size()) {
                i = 0;
                lap += length();
            }
        }
        return place;
    }

private:
    [[nodiscard]] Vec2 end(std::size_t i) const { return points_[(i + 1) % size()]; }

    std::vector<Vec2> points_;
    std::vector<double> arc_;
};

}  // namespace droplet
