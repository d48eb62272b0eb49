// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <numbers>

#include "droplet/wind/forces.h"

namespace droplet {

/// Sizes of caps with one contact angle, scaled from the cap of 1 m³.
class CapScale {
public:
    explicit CapScale(double contact_angle)
        : unit_(capOf(1.0, contact_angle)), overhangs_(contact_angle > 0.5 * std::numbers::pi), reach_(reach(unit_))
    {
    }

    [[nodiscard]] CapSize cap(double volume) const
    {
        const double s = std::cbrt(volume);
        return {volume, s * unit_.radius, s * unit_.contact_radius, s * unit_.height, s * s * unit_.frontal_area};
    }
    /// Half the width seen from above: caps of more than 90° overhang their rims.
    [[nodiscard]] double reach(const CapSize& cap) const { return overhangs_ ? cap.radius : cap.contact_radius; }
    [[nodiscard]] double volumeOfHeight(double height) const
    {
        const double s = height / unit_.height;
        return s * s * s;
    }
    [[nodiscard]] double reach(double volume) const { return reach_ * std::cbrt(volume); }
    [[nodiscard]] double reach() const { return reach_; }

private:
    CapSize unit_;
    bool overhangs_ = false;
    double reach_ = 0.0;
};

}  // namespace droplet
