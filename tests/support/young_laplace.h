// SPDX-License-Identifier: GPL-3.0-or-later
//
// Droplets of revolution by integration of their meridian: F. Bashforth and J. C. Adams, "An attempt to test the
// theories of capillary action" (1883); without gravity by one quadrature: R. Finn, "Equilibrium capillary surfaces"
// (1986), 1.2.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace droplet::testing {

/// Droplet of revolution on the circle of radius 1 at height 0, with σ = 1; it hangs if weight < 0.
struct Revolution {
    /// Point of the meridian.
    struct Node {
        double r = 0.0;
        double u = 0.0;
        double angle = 0.0;  ///< between the tangent and the level, falling outward [rad]
    };

    double weight = 0.0;     ///< ρg
    double curvature = 0.0;  ///< of the meridian at the apex
    double arc = 0.0;        ///< length of the meridian
    double rim_radius = 0.0;
    double height = 0.0;
    double pressure = 0.0;  ///< λ
    double rim_angle = 0.0;
    double volume = 0.0;
    double area = 0.0;
    double squares = 0.0;  ///< ∫u²
    std::vector<Node> nodes;

    [[nodiscard]] double energy() const { return area + 0.5 * weight * squares; }

    /// u by cubic Hermite interpolation; beyond the rim, which polygons cross, along the tangent.
    [[nodiscard]] double at(double r) const
    {
        if (r >= nodes.back().r) {
            return nodes.back().u - std::tan(nodes.back().angle) * (r - nodes.back().r);
        }
        std::size_t low = 0;
        for (std::size_t high = nodes.size() - 1; high - low > 1;) {
            const std::size_t middle = (low + high) / 2;
            (nodes[middle].r <= r ? low : high) = middle;
        }
        const Node& a = nodes[low];
        const Node& b = nodes[low + 1];
        const double step = b.r - a.r;
        const double t = (r - a.r) / step;
        const double s = 1.0 - t;
        return s * s * (1.0 + 2.0 * t) * a.u + t * t * (3.0 - 2.0 * t) * b.u - s * s * t * step * std::tan(a.angle) +
               t * t * s * step * std::tan(b.angle);
    }
};

/// Integrates the meridian from the apex: ψ' + sin ψ/r = 2κ + w·depth, along its arc, by Runge and Kutta's fourth
/// order.
inline Revolution meridian(double weight, double curvature, double arc, std::size_t steps)
{
    // r, depth below the apex, ψ, volume, area, ∫depth dV
    using State = std::array<double, 6>;
    const auto rate = [&](const State& y) {
        const double bend = y[0] > 0.0 ? std::sin(y[2]) / y[0] : curvature;
        const double disc = std::numbers::pi * y[0] * y[0] * std::sin(y[2]);
        return State{
            std::cos(y[2]), std::sin(y[2]), 2.0 * curvature + weight * y[1] - bend, disc, 2.0 * std::numbers::pi * y[0],
            disc * y[1]};
    };
    const auto advanced = [](const State& y, double h, const State& slope) {
        State z{};
        for (std::size_t i = 0; i < z.size(); ++i) {
            z[i] = y[i] + h * slope[i];
        }
        return z;
    };
    const double h = arc / static_cast<double>(steps);
    std::vector<State> states{State{}};
    for (std::size_t k = 0; k < steps; ++k) {
        const State& y = states.back();
        const State k1 = rate(y);
        const State k2 = rate(advanced(y, 0.5 * h, k1));
        const State k3 = rate(advanced(y, 0.5 * h, k2));
        const State k4 = rate(advanced(y, h, k3));
        State next{};
        for (std::size_t i = 0; i < next.size(); ++i) {
            next[i] = y[i] + h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]);
        }
        states.push_back(next);
    }
    const State& rim = states.back();
    Revolution droplet;
    droplet.weight = weight;
    droplet.curvature = curvature;
    droplet.arc = arc;
    droplet.rim_radius = rim[0];
    droplet.height = rim[1];
    droplet.pressure = 2.0 * curvature + weight * rim[1];
    droplet.rim_angle = rim[2];
    droplet.volume = rim[3];
    droplet.area = rim[4];
    // ∫u² over the disc is ∫2u dV over the layers.
    droplet.squares = 2.0 * (rim[1] * rim[3] - rim[5]);
    for (const State& y : states) {
        droplet.nodes.push_back({y[0], rim[1] - y[1], y[2]});
    }
    return droplet;
}

/// Droplet of revolution whose `figure` equals `target`: Newton's method on curvature and arc, from small droplets on.
inline Revolution shoot(double weight, double target, const std::function<double(const Revolution&)>& figure,
                        std::size_t steps = 1000)
{
    constexpr std::size_t kStages = 12;
    const auto at = [&](double curvature, double arc) { return meridian(weight, curvature, arc, steps); };
    std::array<double, 2> now{0.1 * target, 1.0};
    std::array<double, 2> before{0.0, 1.0};
    Revolution droplet;
    for (std::size_t stage = 1; stage <= kStages; ++stage) {
        const double wanted = target * static_cast<double>(stage) / kStages;
        const std::array<double, 2> found = now;
        if (stage > 2) {
            now = {2.0 * now[0] - before[0], 2.0 * now[1] - before[1]};
        }
        double error = 1.0;
        for (int k = 0; k < 40 && error > 1e-12; ++k) {
            droplet = at(now[0], now[1]);
            const double radius_error = droplet.rim_radius - 1.0;
            const double figure_error = figure(droplet) - wanted;
            error = std::max(std::abs(radius_error), std::abs(figure_error));
            constexpr double kStep = 1e-6;
            const Revolution more_curved = at(now[0] + kStep, now[1]);
            const Revolution less_curved = at(now[0] - kStep, now[1]);
            const Revolution longer = at(now[0], now[1] + kStep);
            const Revolution shorter = at(now[0], now[1] - kStep);
            const double a = (more_curved.rim_radius - less_curved.rim_radius) / (2.0 * kStep);
            const double b = (longer.rim_radius - shorter.rim_radius) / (2.0 * kStep);
            const double c = (figure(more_curved) - figure(less_curved)) / (2.0 * kStep);
            const double d = (figure(longer) - figure(shorter)) / (2.0 * kStep);
            const double determinant = a * d - b * c;
            now[0] -= (d * radius_error - b * figure_error) / determinant;
            now[1] -= (a * figure_error - c * radius_error) / determinant;
        }
        if (!(error < 1e-10)) {
            throw std::runtime_error("no droplet of revolution found");
        }
        before = found;
    }
    return droplet;
}

inline Revolution dropletOfVolume(double weight, double volume)
{
    return shoot(weight, volume, [](const Revolution& d) { return d.volume; });
}

inline Revolution dropletOfAngle(double weight, double rim_angle)
{
    return shoot(weight, rim_angle, [](const Revolution& d) { return d.rim_angle; });
}

/// The spherical cap of a height on the circle of radius 1, σ = 1.
struct Cap {
    double height = 0.0;

    [[nodiscard]] double volume() const { return std::numbers::pi * height * (3.0 + height * height) / 6.0; }
    [[nodiscard]] double area() const { return std::numbers::pi * (1.0 + height * height); }
    [[nodiscard]] double pressure() const { return 4.0 * height / (1.0 + height * height); }
    [[nodiscard]] double rimAngle() const { return 2.0 * std::atan(height); }
    [[nodiscard]] double at(double r) const
    {
        const double radius = 2.0 / pressure();
        // Beyond the rim, which polygons cross, heights are negative.
        return std::sqrt(std::max(radius * radius - r * r, 0.0)) - (radius - height);
    }
};

inline Cap capOfAngle(double rim_angle)
{
    return {std::tan(0.5 * rim_angle)};
}

inline Cap capOfVolume(double volume)
{
    double low = 0.0;
    double high = 1.0 + volume;
    for (int k = 0; k < 100; ++k) {
        const double middle = 0.5 * (low + high);
        (Cap{middle}.volume() < volume ? low : high) = middle;
    }
    return {low};
}

/// ∫f by Simpson's rule.
inline double simpson(double from, double to, const std::function<double(double)>& f, int pieces = 4000)
{
    const double h = (to - from) / pieces;
    double sum = f(from) + f(to);
    for (int k = 1; k < pieces; ++k) {
        sum += (k % 2 == 1 ? 4.0 : 2.0) * f(from + k * h);
    }
    return sum * h / 3.0;
}

/// A surface of constant mean curvature around a hole, without gravity: sin ψ = λr/2 + c/r, du/dr = −tan ψ.
struct RingSurface {
    double inner = 0.0;
    double pressure = 0.0;  ///< λ
    double constant = 0.0;  ///< c

    [[nodiscard]] double sine(double r) const { return 0.5 * pressure * r + constant / r; }
    [[nodiscard]] double fall(double r) const
    {
        const double s = sine(r);
        return s / std::sqrt(1.0 - s * s);
    }
    /// u(from) − u(to)
    [[nodiscard]] double drop(double from, double to, int pieces = 4000) const
    {
        return simpson(
            from, to, [this](double r) { return fall(r); }, pieces);
    }
    /// ∫u between inner and 1, where u(1) = 0
    [[nodiscard]] double volume() const
    {
        return std::numbers::pi * simpson(inner, 1.0, [this](double r) { return (r * r - inner * inner) * fall(r); });
    }
    [[nodiscard]] double area() const
    {
        return 2.0 * std::numbers::pi *
               simpson(inner, 1.0, [this](double r) { return r / std::sqrt(1.0 - sine(r) * sine(r)); });
    }
};

}  // namespace droplet::testing
