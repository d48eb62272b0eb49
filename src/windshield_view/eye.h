// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "droplet/vector.h"
#include "droplet/windshield_view/view.h"
#include "render/optics.h"
#include "windshield_view/backdrop.h"
#include "windshield_view/glass_frame.h"

namespace droplet {

/// The driver's eye: rays of the pixels, and the places where they meet the glass.
class Eye {
public:
    /// @param options  valid
    /// @throws Error   InvalidArgument if the eye is not behind the glass or looks beside it
    Eye(const Glass& glass, const ViewOptions& options);

    [[nodiscard]] int width() const { return width_; }    ///< [px]
    [[nodiscard]] int height() const { return height_; }  ///< [px]
    /// Tangent of half the field of view.
    [[nodiscard]] float halfWidth() const { return half_width_; }
    /// Tangent across a pixel.
    [[nodiscard]] float tangent() const { return tangent_; }
    /// Place of the glass in the eye's frame: x right, y ahead, z up.
    [[nodiscard]] GlassPlace seen(const GlassPlace& place) const
    {
        return {turned(place.point - position_), turned(place.normal), turned(place.across), turned(place.up)};
    }

    /// Axes of the frame in the car's frame.
    [[nodiscard]] PictureFrame frame() const { return {toFloats(right_), toFloats(ahead_), toFloats(up_)}; }

    /// Unit direction of a pixel's ray in the eye's frame.
    [[nodiscard]] Vec3f ray(int x, int y) const
    {
        return unit({tangent_ * (static_cast<float>(x) + 0.5F - 0.5F * static_cast<float>(width_)), 1.0F,
                     tangent_ * (0.5F * static_cast<float>(height_) - static_cast<float>(y) - 0.5F)});
    }
    /// Direction of a place in the frame; not a unit vector.
    /// @param x, y  distance from the upper left corner [px]
    [[nodiscard]] Vec3f rayAt(float x, float y) const
    {
        return {tangent_ * (x - 0.5F * static_cast<float>(width_)), 1.0F,
                tangent_ * (0.5F * static_cast<float>(height_) - y)};
    }
    /// Index of a pixel, row by row.
    [[nodiscard]] std::size_t at(int x, int y) const
    {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
    }
    /// Place on the glass at the middle of a pixel [m]; NaN beside the glass.
    [[nodiscard]] Vec2f place(int x, int y) const { return places_[at(x, y)]; }

private:
    class GlassMesh;

    [[nodiscard]] Vec3 turned(Vec3 v) const { return {dot(v, right_), dot(v, ahead_), dot(v, up_)}; }

    int width_;
    int height_;
    float half_width_;
    float tangent_;
    Vec3 position_;
    Vec3 right_{1.0, 0.0, 0.0};
    Vec3 ahead_{0.0, 1.0, 0.0};
    Vec3 up_{0.0, 0.0, 1.0};
    std::vector<Vec2f> places_;  ///< place of each pixel
};

}  // namespace droplet
