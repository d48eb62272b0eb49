// SPDX-License-Identifier: GPL-3.0-or-later
//
// m v' = D(t) − W ∓ F − c v with the drag D of (3.3), the weight W along the slope, friction F and c of (3.5) is linear
// between events. It is solved by exponential quadrature (Hochbruck and Ostermann, "Exponential integrators", Acta
// Numer. 19 (2010) 209, section 2.1) with nodes 0, ½ and 1. Like Simpson's rule it interpolates by a parabola and is of
// fourth order.
#include "droplet/wind/trace.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <sstream>
#include <string>

#include "droplet/error.h"
#include "require.h"
#include "wind/root.h"

namespace droplet {
namespace {

bool isPositive(double value)
{
    return value > 0.0 && std::isfinite(value);
}

/// φ₀(z) = eᶻ and φ_k(z) = (φ_{k−1}(z) − 1/(k−1)!)/z, z ≤ 0.
std::array<double, 5> phi(double z)
{
    std::array<double, 5> f{};
    if (z < -1.0) {
        double factorial = 1.0;
        f[0] = std::exp(z);
        f[1] = std::expm1(z) / z;
        for (std::size_t k = 2; k < f.size(); ++k) {
            factorial *= static_cast<double>(k - 1);
            f[k] = (f[k - 1] - 1.0 / factorial) / z;
        }
        return f;
    }
    // Near 0 the differences cancel: φ₄ by its series Σ zʲ/(j+4)!, and the others from it.
    double term = 1.0 / 24.0;
    for (int j = 1; j <= 20; ++j) {
        f[4] += term;
        term *= z / (j + 4);
    }
    f[3] = z * f[4] + 1.0 / 6.0;
    f[2] = z * f[3] + 0.5;
    f[1] = z * f[2] + 1.0;
    f[0] = std::exp(z);
    return f;
}

struct Place {
    double position = 0.0;
    double velocity = 0.0;
};

/// Motion of a droplet in one direction.
struct Sliding {
    const DropletForces* forces;
    double slope;
    const Gust* wind;
    double direction;  ///< 1: up the slope; −1: down

    /// Acceleration without viscous drag [m/s²].
    [[nodiscard]] double push(double time) const
    {
        return (drivingForce(*forces, slope, wind->at(time)) - direction * forces->sliding_friction) / forces->mass;
    }

    [[nodiscard]] Place after(Place from, double time, double step) const
    {
        const double g0 = push(time);
        const double g1 = push(time + 0.5 * step);
        const double g2 = push(time + step);
        // The acceleration over the step is g0 + a s + b s², s from 0 to 1.
        const double a = -3.0 * g0 + 4.0 * g1 - g2;
        const double b = 2.0 * (g0 - 2.0 * g1 + g2);
        const auto f = phi(-forces->viscous / forces->mass * step);
        return {from.position + step * (f[1] * from.velocity + step * (f[2] * g0 + f[3] * a + 2.0 * f[4] * b)),
                f[0] * from.velocity + step * (f[1] * g0 + f[2] * a + 2.0 * f[3] * b)};
    }
};

/// Times at which a gust turns; between them it rises or falls.
class GustTurns {
public:
    explicit GustTurns(const Gust& wind) : wind_(&wind) {}

    /// First turn after a time; `end` if there is none before.
    [[nodiscard]] double after(double time, double end) const
    {
        if (wind_->amplitude == 0.0) {
            return end;
        }
        const double half = 0.5 * wind_->period;
        double turn = (std::floor(time / half - 0.5) + 1.5) * half;
        while (turn <= time) {
            turn += half;
        }
        return std::min(turn, end);
    }

private:
    const Gust* wind_;
};

class Tracer {
public:
    Tracer(const DropletForces& forces, double slope, const Gust& wind, const MotionOptions& options)
        : forces_(&forces), slope_(slope), wind_(&wind), options_(&options), motion_{0.0, options.velocity}
    {
        fastest_ = std::abs(motion_.velocity);
        direction_ = motion_.velocity > 0.0 ? 1.0 : motion_.velocity < 0.0 ? -1.0 : releaseDirection(0.0);
        next_step_ = options.fixed_step.value_or(0.01 * (wind.amplitude == 0.0 ? options.duration : wind.period));
    }

    Motion run()
    {
        const auto last = static_cast<std::size_t>(std::floor(options_->duration / options_->interval * (1.0 + 1e-12)));
        trace_.points.reserve(last + 1);
        record();
        for (std::size_t k = 1; k <= last; ++k) {
            advance(static_cast<double>(k) * options_->interval);
            record();
        }
        return std::move(trace_);
    }

private:
    [[nodiscard]] double driving(double time) const { return drivingForce(*forces_, slope_, wind_->at(time)); }

    /// Direction in which a droplet at rest begins to move; 0: it is held.
    [[nodiscard]] double releaseDirection(double time) const
    {
        const double force = driving(time);
        return std::abs(force) <= forces_->retention ? 0.0 : std::copysign(1.0, force);
    }

    void record()
    {
        const double force = driving(time_);
        // A droplet that was just released has no speed yet, but a direction.
        double rate = 0.0;
        if (direction_ != 0.0) {
            rate =
                (force - direction_ * forces_->sliding_friction - forces_->viscous * motion_.velocity) / forces_->mass;
        }
        trace_.points.push_back({time_, wind_->at(time_), motion_.position, motion_.velocity, rate});
    }

    void advance(double until)
    {
        while (time_ < until) {
            if (direction_ == 0.0) {
                wait(until);
            } else {
                slide(until);
            }
        }
    }

    /// Keeps the droplet at rest until friction releases it.
    void wait(double until)
    {
        // Between turns of the gust the driving force is monotone, so it exceeds the retention at most once.
        const double to = GustTurns(*wind_).after(time_, until);
        if (releaseDirection(to) != 0.0) {
            double held = time_;
            time_ = to;
            while (time_ - held > std::numeric_limits<double>::epsilon() * time_) {
                const double middle = 0.5 * (held + time_);
                (releaseDirection(middle) == 0.0 ? held : time_) = middle;
            }
            direction_ = releaseDirection(time_);
            trace_.events.push_back({time_, true});
        } else {
            time_ = to;
        }
    }

    void slide(double until)
    {
        const Sliding sliding{forces_, slope_, wind_, direction_};
        // Where the gust turns, friction may stop and release the droplet: no step passes a turn.
        const double room = GustTurns(*wind_).after(time_, until) - time_;
        double step = std::min(next_step_, room);
        if (wind_->amplitude == 0.0 && !options_->fixed_step) {
            step = room;
        }
        Place to = sliding.after(motion_, time_, step);
        if (wind_->amplitude != 0.0 && !options_->fixed_step) {
            const Place half = sliding.after(motion_, time_, 0.5 * step);
            const Place twice = sliding.after(half, time_ + 0.5 * step, 0.5 * step);
            fastest_ = std::max({fastest_, std::abs(to.velocity), std::abs(twice.velocity)});
            // The method is of fourth order: halved steps have a 16th of the error.
            const double error = std::abs(to.velocity - twice.velocity) / 15.0;
            const double allowed = options_->tolerance * fastest_;
            constexpr double kSafety = 0.9;
            const double growth = error > 0.0 ? kSafety * std::pow(allowed / error, 0.2) : 4.0;
            const double min = 1e-12 * wind_->period;
            if (error > allowed && step > min) {
                next_step_ = std::max(min, step * std::clamp(growth, 0.1, 0.9));
                ++trace_.rejected;
                return;
            }
            if (step == next_step_ || growth < 1.0) {
                next_step_ = step * std::clamp(growth, 0.2, 4.0);
            }
            to = twice;
            if (!(direction_ * half.velocity > 0.0) && motion_.velocity != 0.0) {
                step *= 0.5;  // it stops, but may move again before the step's end
                to = half;
            }
        }
        ++trace_.steps;
        finish(sliding, step, to);
    }

    /// Accepts a step, or the part of it before friction stops the droplet.
    void finish(const Sliding& sliding, double step, Place to)
    {
        const double from = time_;
        if (direction_ * to.velocity > 0.0) {
            motion_ = to;
            time_ = from + step;
            return;
        }
        const Place start = motion_;
        const auto speed = [&](double part) { return direction_ * sliding.after(start, from, part).velocity; };
        // A droplet that was just released has no speed yet: the stop is searched after it has some.
        const double beginning = start.velocity != 0.0 ? 0.0 : firstMoving(speed, step);
        // Halved steps may find a stop that the whole step does not.
        const double part = beginning < step && !(speed(step) > 0.0) ? rootBetween(beginning, step, speed) : step;
        motion_ = {sliding.after(start, from, part).position, 0.0};
        time_ = part > 0.0 ? from + part : std::nextafter(from, from + step);
        const double direction = releaseDirection(time_);
        if (direction == 0.0) {
            trace_.events.push_back({time_, false});
        }
        direction_ = direction;
    }

    /// Part of the step after which the droplet has some speed; the whole step if it has none.
    static double firstMoving(const std::function<double(double)>& speed, double step)
    {
        double part = 0.5 * step;
        while (part > 1e-9 * step && !(speed(part) > 0.0)) {
            part *= 0.5;
        }
        return part > 1e-9 * step ? part : step;
    }

    const DropletForces* forces_;
    double slope_;
    const Gust* wind_;
    const MotionOptions* options_;
    Place motion_;
    double time_ = 0.0;
    double direction_ = 0.0;  ///< 0: at rest
    double next_step_;
    double fastest_ = 0.0;
    Motion trace_;
};

}  // namespace

double Gust::at(double time) const
{
    return amplitude == 0.0 ? mean : mean + amplitude * std::sin(2.0 * std::numbers::pi * time / period);
}

void MotionOptions::validate() const
{
    require(isPositive(duration), "duration", duration, "finite and more than 0 s");
    require(isPositive(interval), "interval", interval, "finite and more than 0 s");
    require(duration / interval <= static_cast<double>(kMaxMotionPoints), "interval", interval,
            "at least a ten-millionth of the duration");
    require(std::isfinite(velocity), "velocity", velocity, "finite");
    require(tolerance > 0.0 && tolerance < 1.0, "tolerance", tolerance, "more than 0 and less than 1");
    if (fixed_step) {
        require(isPositive(*fixed_step), "fixed_step", *fixed_step, "finite and more than 0 s");
    }
}

Motion traceMotion(const DropletForces& forces, double slope, const Gust& wind, const MotionOptions& options)
{
    options.validate();
    require(isPositive(forces.mass), "forces.mass", forces.mass, "finite and more than 0 kg");
    require(std::isfinite(slope), "slope", slope, "finite");
    require(std::isfinite(wind.mean), "wind.mean", wind.mean, "finite");
    require(wind.amplitude >= 0.0 && std::isfinite(wind.amplitude), "wind.amplitude", wind.amplitude,
            "finite and at least 0 m/s");
    require(isPositive(wind.period), "wind.period", wind.period, "finite and more than 0 s");
    require(wind.amplitude == 0.0 || options.duration / wind.period <= kMaxGusts, "wind.period", wind.period,
            "at least a 100000th of the duration");
    return Tracer(forces, slope, wind, options).run();
}

}  // namespace droplet
