// SPDX-License-Identifier: GPL-3.0-or-later
#include "windshield/sweep.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace droplet {
namespace {

constexpr double kPi = std::numbers::pi;

/// Angle wrapped to (−π, π].
double wrapped(double angle)
{
    return angle - 2.0 * kPi * std::ceil((angle - kPi) / (2.0 * kPi));
}

}  // namespace

std::optional<Sweep> Sweep::of(const Wiper& wiper, double from, double to)
{
    Sweep sweep;
    sweep.pivot_ = wiper.pivot;
    sweep.inner_ = wiper.inner;
    sweep.outer_ = wiper.outer;
    sweep.begin_ = wiper.angleAt(from);
    sweep.end_ = wiper.angleAt(to);
    sweep.min_ = std::min(sweep.begin_, sweep.end_);
    sweep.max_ = std::max(sweep.begin_, sweep.end_);
    if (to > wiper.start) {
        // The blade may turn in between: at `last` half a stroke after its start, and at `first`.
        const double since = std::max(from - wiper.start, 0.0);
        const double until = to - wiper.start;
        const auto turns = [&](double phase) {
            const double next = phase + wiper.period * std::ceil((since - phase) / wiper.period);
            return next >= since && next <= until;
        };
        const auto reach = [&](double angle) {
            sweep.min_ = std::min(sweep.min_, angle);
            sweep.max_ = std::max(sweep.max_, angle);
        };
        if (turns(0.5 * wiper.stroke)) {
            reach(wiper.last);
        }
        if (turns(0.0) || turns(wiper.stroke)) {
            reach(wiper.first);
        }
    }
    return sweep.min_ < sweep.max_ ? std::optional(sweep) : std::nullopt;
}

bool Sweep::inReach(Vec2 p) const
{
    const Vec2 from = p - pivot_;
    const double squared = dot(from, from);
    return squared >= inner_ * inner_ && squared <= outer_ * outer_;
}

double Sweep::angleOf(Vec2 p) const
{
    return std::atan2(p.y - pivot_.y, p.x - pivot_.x);
}

bool Sweep::covers(Vec2 p) const
{
    if (!inReach(p)) {
        return false;
    }
    const double beyond = angleOf(p) - min_;
    return beyond - 2.0 * kPi * std::floor(beyond / (2.0 * kPi)) <= max_ - min_;
}

bool Sweep::meets(Vec2 a, Vec2 b) const
{
    if (covers(b)) {
        return true;
    }
    if (a == b || !inReach(a) || !inReach(b)) {
        return false;
    }
    const double before = wrapped(angleOf(a) - begin_);
    const double after = wrapped(angleOf(b) - end_);
    return before * after < 0.0 && std::abs(before - after) < 0.5 * kPi;
}

std::vector<Vec2> Sweep::hull() const
{
    constexpr double kMaxTurn = kPi / 18.0;
    const int parts = static_cast<int>(std::ceil((max_ - min_) / kMaxTurn));
    const double turn = (max_ - min_) / parts;
    const auto at = [this](double radius, double angle) {
        return pivot_ + radius * Vec2{std::cos(angle), std::sin(angle)};
    };
    std::vector<Vec2> corners;
    for (int k = 0; k <= parts; ++k) {
        corners.push_back(at(inner_, min_ + turn * k));
    }
    for (int k = parts; k >= 0; --k) {
        corners.push_back(at(outer_ / std::cos(0.5 * turn), min_ + turn * k));  // tangents of the arc meet here
    }
    return corners;
}

}  // namespace droplet
