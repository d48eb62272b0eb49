// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "droplet/picture/render.h"
#include "picture/optics.h"
#include "picture/scene.h"

namespace droplet {

/// A turn about the vertical axis.
struct CameraTurn {
    float cosine = 1.0F;
    float sine = 0.0F;

    [[nodiscard]] Vec3f operator()(Vec3f a) const
    {
        return {cosine * a.x - sine * a.y, sine * a.x + cosine * a.y, a.z};
    }
};

/// The turn that keeps camera and lights beside a droplet that stays where it is while it is seen turned by an azimuth.
CameraTurn turnedBack(double azimuth);

/// A camera with a long lens, framed so that the points fill the picture up to a margin.
class Camera {
public:
    /// @param points   what to frame, not empty
    /// @param options  size, view, azimuth
    /// @param aside    width at the right that is kept free [px]
    Camera(const std::vector<Vec3f>& points, const RenderOptions& options, int aside = 0);

    /// The ray through a point of the picture [px], y down.
    [[nodiscard]] RayF ray(float x, float y) const;
    /// Where a point is seen [px].
    [[nodiscard]] Vec2 seen(Vec3f point) const;
    /// How wide a pixel is at distance 1.
    [[nodiscard]] float pixel() const { return 1.0F / focal_; }

private:
    float width_;
    float height_;
    float focal_;
    Vec3f eye_;
    Vec3f right_;
    Vec3f up_;
    Vec3f back_;
};

}  // namespace droplet
