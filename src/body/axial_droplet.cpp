// SPDX-License-Identifier: GPL-3.0-or-later
//
// The profile of a round droplet by F. Bashforth and J. C. Adams, "An Attempt to Test the Theories of Capillary Action"
// (1883): with x from the axis, z from the apex towards the ground and the slope φ along the arc,
// dφ/ds = 2/b ± z − sin φ/x, where b is the radius at the apex; minus if it hangs.
#include "body/axial_droplet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>

namespace droplet {
namespace {

using Profile = std::array<double, 4>;  // x, z, φ, volume

/// The droplet with the radius b at its apex; empty if its surface never has the contact angle.
std::optional<AxialDroplet> dropletOf(double b, double contact_angle, double sign)
{
    const auto slope = [&](const Profile& p) {
        const double bend = 2.0 / b + sign * p[1] - (p[0] > 0.0 ? std::sin(p[2]) / p[0] : 1.0 / b);
        return Profile{std::cos(p[2]), std::sin(p[2]), bend, std::numbers::pi * p[0] * p[0] * std::sin(p[2])};
    };
    const auto moved = [](const Profile& p, const Profile& by, double step) {
        return Profile{p[0] + step * by[0], p[1] + step * by[1], p[2] + step * by[2], p[3] + step * by[3]};
    };
    Profile p{};
    constexpr double kTurn = 0.06;    // of the slope in a step [rad]
    constexpr double kLongest = 0.2;  // step
    constexpr int kMaxSteps = 2000;
    for (int i = 0; i < kMaxSteps; ++i) {
        const Profile k1 = slope(p);
        if (k1[2] <= 0.0) {
            return {};
        }
        // The last step ends at the contact angle.
        const double left = (contact_angle - p[2]) / k1[2];
        const double step = std::min({kTurn / k1[2], kLongest, left});
        const Profile k2 = slope(moved(p, k1, 0.5 * step));
        const Profile k3 = slope(moved(p, k2, 0.5 * step));
        const Profile k4 = slope(moved(p, k3, step));
        for (std::size_t k = 0; k < p.size(); ++k) {
            p[k] += step / 6.0 * (k1[k] + 2.0 * k2[k] + 2.0 * k3[k] + k4[k]);
        }
        constexpr double kClose = 1e-6;  // [rad]
        if (std::abs(p[2] - contact_angle) < kClose) {
            return AxialDroplet{p[3], p[1], p[0]};
        }
    }
    return {};
}

}  // namespace

std::vector<AxialDroplet> axialDroplets(double contact_angle, bool hangs)
{
    std::vector<AxialDroplet> droplets;
    constexpr int kCount = 120;
    for (int i = 0; i < kCount; ++i) {
        // Radii at the apex grow to those of puddles, which are flat there.
        const double b = 0.02 * std::pow(1.13, i);
        const auto droplet = dropletOf(b, contact_angle, hangs ? -1.0 : 1.0);
        if (!droplet || (!droplets.empty() && droplet->volume <= droplets.back().volume)) {
            break;
        }
        droplets.push_back(*droplet);
    }
    return droplets;
}

}  // namespace droplet
