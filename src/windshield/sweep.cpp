// SPDX-License-Identifier: GPL-3.0-or-later
#include "windshield/sweep.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace droplet {
namespace {

constexpr double kPi = std::numbers::pi;

/// To (−π, π].
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
    sweep.before_ = wiper.angleAt(from);
    sweep.after_ = wiper.angleAt(to);
    sweep.low_ = std::min(sweep.before_, sweep.after_);
    sweep.high_ = std::max(sweep.before_, sweep.after_);
    if (to > wiper.start) {
        // It may turn in between: at `last` half a stroke after it has left `first`, and at `first` itself.
        const double since = std::max(from - wiper.start, 0.0);
        const double till = to - wiper.start;
        const auto turns = [&](double phase) {
            const double next = phase + wiper.period * std::ceil((since - phase) / wiper.period);
            return next >= since && next <= till;
        };
        const auto reach = [&](double angle) {
            sweep.low_ = std::min(sweep.low_, angle);
            sweep.high_ = std::max(sweep.high_, angle);
        };
        if (turns(0.5 * wiper.stroke)) {
            reach(wiper.last);
        }
        if (turns(0.0) || turns(wiper.stroke)) {
            reach(wiper.first);
        }
    }
    return sweep.low_ < sweep.high_ ? std::optional(sweep) : std::nullopt;
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
    const double beyond = angleOf(p) - low_;
    return beyond - 2.0 * kPi * std::floor(beyond / (2.0 * kPi)) <= high_ - low_;
}

bool Sweep::meets(Vec2 a, Vec2 b) const
{
    if (covers(b)) {
        return true;
    }
    if (a == b || !inReach(a) || !inReach(b)) {
        return false;
    }
    const double was = wrapped(angleOf(a) - before_);
    const double is = wrapped(angleOf(b) - after_);
    return was * is < 0.0 && std::abs(was - is) < 0.5 * kPi;
}

std::vector<Vec2> Sweep::hull() const
{
    constexpr double kMaxTurn = kPi / 18.0;
    const int parts = static_cast<int>(std::ceil((high_ - low_) / kMaxTurn));
    const double turn = (high_ - low_) / parts;
    const auto at = [this](double radius, double angle) {
        return pivot_ + radius * Vec2{std::cos(angle), std::sin(angle)};
    };
    std::vector<Vec2> corners;
    for (int k = 0; k <= parts; ++k) {
        corners.push_back(at(inner_, low_ + turn * k));
    }
    for (int k = parts; k >= 0; --k) {
        corners.push_back(at(outer_ / std::cos(0.5 * turn), low_ + turn * k));  // tangents to the arc meet there
    }
    return corners;
}

}  // namespace droplet
