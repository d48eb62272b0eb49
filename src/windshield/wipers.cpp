// SPDX-License-Identifier: GPL-3.0-or-later
#include "windshield/wipers.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "droplet/error.h"

namespace droplet {
namespace {

constexpr double kPi = std::numbers::pi;

/// To (−π, π].
double wrapped(double angle)
{
    return angle - 2.0 * kPi * std::ceil((angle - kPi) / (2.0 * kPi));
}

}  // namespace

double Wiper::angleAt(double time) const
{
    const double since = time - start;
    if (since <= 0.0) {
        return first;
    }
    const double within = since - period * std::floor(since / period);
    if (within >= stroke) {
        return first;
    }
    return first + (last - first) * 0.5 * (1.0 - std::cos(2.0 * kPi * within / stroke));
}

void Wiper::validate() const
{
    const auto require = [](bool holds, const char* field, double value, const char* constraint) {
        if (!holds) {
            throw Error(ErrorCode::InvalidArgument,
                        std::string("wiper.") + field + " is " + std::to_string(value) + "; it must be " + constraint);
        }
    };
    require(std::isfinite(pivot.x) && std::isfinite(pivot.y), "pivot", length(pivot), "finite");
    require(inner >= 0.0 && std::isfinite(inner), "inner", inner, "finite and at least 0 m");
    require(outer > inner && std::isfinite(outer), "outer", outer, "finite and more than inner");
    require(std::isfinite(first), "first", first, "finite");
    require(std::isfinite(last) && last != first && std::abs(last - first) <= 2.0 * kPi, "last", last,
            "other than first, by at most 2 pi");
    require(stroke > 0.0 && std::isfinite(stroke), "stroke", stroke, "finite and more than 0 s");
    require(period >= stroke && std::isfinite(period), "period", period, "finite and at least the stroke");
    require(std::isfinite(start), "start", start, "finite");
}

std::vector<Wiper> tandemWipers(const Glass& glass, double period)
{
    // Blades of half the glass's width rest along its lower edge, pivots at a sixteenth and nine sixteenths of it; both
    // rise a little beyond upright. What is higher than wide limits them, else they would leave the glass.
    std::vector<Wiper> wipers;
    for (const double share : {1.0 / 16.0, 9.0 / 16.0}) {
        Wiper wiper;
        wiper.pivot = {share * glass.width(), -0.03 * glass.height()};
        wiper.outer = std::min((share < 0.5 ? 0.5 : 0.42) * glass.width(), 1.02 * glass.height());
        wiper.inner = 0.12 * wiper.outer;
        wiper.first = 4.0 * kDegree;
        wiper.last = 98.0 * kDegree;
        wiper.stroke = 1.2;
        wiper.period = period;
        wipers.push_back(wiper);
    }
    return wipers;
}

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
    constexpr double kMostTurn = kPi / 18.0;
    const int parts = static_cast<int>(std::ceil((high_ - low_) / kMostTurn));
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
