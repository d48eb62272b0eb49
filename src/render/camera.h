// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "droplet/render/render.h"
#include "render/optics.h"
#include "render/ray_tracer.h"

namespace droplet {

/// Rotation about the vertical axis.
struct CameraTurn {
    float cosine = 1.0F;
    float sine = 0.0F;

    [[nodiscard]] Vec3f operator()(Vec3f a) const
    {
        return {cosine * a.x - sine * a.y, sine * a.x + cosine * a.y, a.z};
    }
};

/// Angle that a pixel covers in the middle of a picture [rad].
double pixelAngle(const RenderOptions& options);

/// Rotation of camera and lights that shows a fixed droplet as if it were turned by an azimuth.
CameraTurn turnedBack(double azimuth);

/// Camera with a long lens, placed so that given points fill the picture except for a margin.
class Camera {
public:
    /// @param points   points to frame, not empty
    /// @param scene    of these points
    /// @param options  size, view, azimuth, look_at, distance
    /// @param aside    width kept free at the right [px]
    Camera(const std::vector<Vec3f>& points, const RayTracer& scene, const RenderOptions& options, int aside = 0);

    /// Ray through a point of the picture [px], y down.
    [[nodiscard]] RayF ray(float x, float y) const;
    /// Position of a point in the picture [px].
    [[nodiscard]] Vec2 seen(Vec3f point) const;
    /// Width of a pixel at distance 1.
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
