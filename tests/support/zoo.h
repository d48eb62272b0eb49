// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdlib>
#include <numbers>
#include <string>
#include <vector>

#include "droplet/domain/domain.h"
#include "support/domains.h"
#include "support/masks.h"

namespace droplet::testing {

/// Test footprint with a name for messages.
struct Animal {
    std::string name;
    Domain domain;
};

/// A star of five points, 180 pixels high, about the middle of 400.
inline Inside star(double angle)
{
    return [=](Vec2 p) {
        const Vec2 d = p - Vec2{200, 200};
        const double turn = std::fmod(std::atan2(d.y, d.x) + angle + 10 * std::numbers::pi, 2 * std::numbers::pi / 5);
        return length(d) < 180 * (1 - 0.75 * std::abs(turn - std::numbers::pi / 5) / (std::numbers::pi / 5));
    };
}

/// The letter R in 300 × 400 pixels: a stem, a bowl with a hole, a slanted leg, strokes of one width.
inline bool insideLetter(Vec2 p)
{
    const bool stem = p.x > 60 && p.x < 100 && p.y > 40 && p.y < 360;
    const double from_bowl = length(p - Vec2{160, 130});
    const bool bowl = p.x >= 160 && from_bowl < 90 && from_bowl > 50;
    const bool bars = p.x > 80 && p.x < 161 && std::abs(std::abs(p.y - 130) - 70) < 20;
    const bool leg = p.y > 200 && p.y < 360 && std::abs(p.x - 150 - 0.5 * (p.y - 200)) < 22;
    return stem || bowl || bars || leg;
}

/// Footprints with different difficulties: wide and narrow parts, corners, holes, detail of one pixel.
inline std::vector<Animal> zoo()
{
    const auto thin_ring = [](Vec2 p) {
        const double r = length(p - Vec2{120, 120});
        return r < 100 && r > 96.5;
    };
    const auto chessboard = [](Vec2 p) { return (static_cast<int>(p.x) + static_cast<int>(p.y)) % 2 == 0; };
    const auto hair = [](Vec2 p) { return std::abs(p.y - 30.5) < 0.7 && p.x > 3 && p.x < 97; };
    return {{"disc", split(trace(smoothMask(240, 240, disc({120.2, 119.7}, 100))))},
            {"rectangle", split(trace(smoothMask(240, 240, rectangle({120.2, 119.7}, {80, 50}, 0.3))))},
            {"star", split(trace(smoothMask(400, 400, star(0.0))))},
            {"rough star", split(trace(hardMask(400, 400, star(0.2))))},
            {"thin ring", split(trace(smoothMask(240, 240, thin_ring)))},
            {"chessboard", split(trace(hardMask(64, 64, chessboard)))},
            {"hair", split(trace(hardMask(100, 60, hair)))},
            {"L", domainOf(polygonLoop({{-1, -1}, {1, -1}, {1, 0}, {0, 0}, {0, 1}, {-1, 1}}))},
            {"ring", domainOf(ellipseLoop(1, 1), {reversed(ellipseLoop(0.3, 0.6))})},
            {"letter", split(trace(smoothMask(300, 400, insideLetter)))}};
}

}  // namespace droplet::testing
