// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/windshield/splash.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace droplet {

std::optional<Splash> splashOf(double diameter, double speed, const Liquid& liquid)
{
    constexpr double kThreshold = 57.7;      // Mundo et al.
    constexpr double kViscosity = 1.002e-3;  // water at 20 °C (Lide, CRC Handbook) [Pa s]
    const double weber = liquid.density * diameter * speed * speed / liquid.surface_tension;
    const double reynolds = liquid.density * diameter * speed / kViscosity;
    if (!(std::sqrt(weber) * std::pow(reynolds, 0.25) >= kThreshold)) {
        return std::nullopt;
    }
    const double half = 0.5 * diameter;
    return Splash{{},
                  0.0,
                  diameter,
                  speed,
                  half * std::pow(weber, 0.25),
                  2.6 * std::sqrt(liquid.density * half * half * half / liquid.surface_tension)};
}

std::optional<SplashRing> ringOf(const Splash& splash, double time)
{
    constexpr double kGrowth = 1.1;  // Yarin and Weiss
    const double age = time - splash.time;
    if (!(age >= 0.0 && age < splash.lifetime)) {
        return std::nullopt;
    }
    const double d = splash.diameter;
    const double grown = splash.radius * splash.radius / (kGrowth * kGrowth * splash.speed * d);  // when it is largest
    const double back = std::max((age - grown) / (splash.lifetime - grown), 0.0);
    const double radius = age < grown ? std::max(kGrowth * std::sqrt(splash.speed * d * age), 0.5 * d)
                                      : splash.radius - back * (splash.radius - 0.5 * d);
    // A half disc of radius a along a ring has the volume π² a² r; the raindrop has π D³/6.
    const auto half_width = [d](double of) { return std::sqrt(d * d * d / (6.0 * std::numbers::pi * of)); };
    constexpr double kWavelength = 9.02;  // over the half width (Rayleigh)
    const double knots = 2.0 * std::numbers::pi * splash.radius / (kWavelength * half_width(splash.radius));
    return SplashRing{radius, half_width(radius), age / splash.lifetime, static_cast<int>(std::lround(knots))};
}

}  // namespace droplet
