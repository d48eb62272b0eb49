// SPDX-License-Identifier: GPL-3.0-or-later
#include "render/camera.h"

#include <numbers>

#include "droplet/units.h"

namespace droplet {
namespace {

struct Place {
    double azimuth;    // direction of the eye, counter-clockwise from +x [rad]
    double elevation;  // [rad]
};

Place placeOf(View view)
{
    switch (view) {
        case View::Top:
            return {-90.0 * kDegree, 90.0 * kDegree};
        case View::Side:
            return {-80.0 * kDegree, 13.0 * kDegree};
        case View::ThreeQuarter:
            break;
    }
    return {-79.0 * kDegree, 48.0 * kDegree};
}

constexpr float kHalfHeight = 0.20F;  // tangent of half the vertical field of view; small for little distortion
constexpr float kFilled = 0.86F;      // share of the picture's width or height that is filled

// Bounding circles of all points about the vertical axis, for views at every azimuth.
std::vector<Vec3f> turned(const std::vector<Vec3f>& points, const CameraTurn& turn)
{
    float radius = 0.0F;
    float low = points.front().z;
    float high = low;
    for (const Vec3f& p : points) {
        radius = std::max(radius, std::hypot(p.x, p.y));
        low = std::min(low, p.z);
        high = std::max(high, p.z);
    }
    constexpr int kSides = 72;
    std::vector<Vec3f> rings;
    for (int k = 0; k < kSides; ++k) {
        const auto angle = static_cast<float>(2.0 * std::numbers::pi * k / kSides);
        for (const float z : {low, high}) {
            rings.push_back(turn({radius * std::cos(angle), radius * std::sin(angle), z}));
        }
    }
    return rings;
}

}  // namespace

double pixelAngle(const RenderOptions& options)
{
    // A narrow picture keeps the horizontal field of view.
    return static_cast<double>(kHalfHeight) / std::max(0.5 * options.height, 0.375 * options.width);
}

CameraTurn turnedBack(double azimuth)
{
    return {static_cast<float>(std::cos(azimuth)), static_cast<float>(-std::sin(azimuth))};
}

Camera::Camera(const std::vector<Vec3f>& points, const RayTracer& scene, const RenderOptions& options, int aside)
    : width_(static_cast<float>(options.width)), height_(static_cast<float>(options.height))
{
    focal_ = static_cast<float>(1.0 / pixelAngle(options));
    const Place place =
        options.camera ? Place{options.camera->azimuth, options.camera->elevation} : placeOf(options.view);
    const CameraTurn turn = turnedBack(options.azimuth);
    const auto cos_azimuth = static_cast<float>(std::cos(place.azimuth));
    const auto sin_azimuth = static_cast<float>(std::sin(place.azimuth));
    const auto cos_elevation = static_cast<float>(std::cos(place.elevation));
    const auto sin_elevation = static_cast<float>(std::sin(place.elevation));
    back_ = turn({cos_elevation * cos_azimuth, cos_elevation * sin_azimuth, sin_elevation});
    right_ = turn({-sin_azimuth, cos_azimuth, 0.0F});
    up_ = cross(back_, right_);

    const std::vector<Vec3f> rings = options.fit_all_azimuths ? turned(points, turn) : std::vector<Vec3f>();
    const std::vector<Vec3f>& framed = options.fit_all_azimuths ? rings : points;
    Vec3f target = options.look_at ? scene.toScene(*options.look_at) : Vec3f{};
    float distance = options.distance ? static_cast<float>(*options.distance / scene.scale()) : 12.0F;
    const float room = width_ - static_cast<float>(aside);
    constexpr int kRounds = 12;  // each round reduces the error to a tenth
    for (int round = 0; round < kRounds; ++round) {
        eye_ = target + distance * back_;
        double low_x = 1e30;
        double low_y = 1e30;
        double high_x = -1e30;
        double high_y = -1e30;
        for (const Vec3f& p : framed) {
            const Vec2 at = seen(p);
            low_x = std::min(low_x, at.x);
            high_x = std::max(high_x, at.x);
            low_y = std::min(low_y, at.y);
            high_y = std::max(high_y, at.y);
        }
        const float step = distance / focal_;
        double filled = std::max((high_x - low_x) / room, (high_y - low_y) / height_);
        if (!options.look_at) {
            target = target + static_cast<float>(0.5 * (low_x + high_x - room)) * step * right_ -
                     static_cast<float>(0.5 * (low_y + high_y - height_)) * step * up_;
        } else {
            // What is farthest from the middle decides.
            const double middle_x = 0.5 * room;
            const double middle_y = 0.5 * height_;
            filled = std::max(std::max(high_x - middle_x, middle_x - low_x) / middle_x,
                              std::max(high_y - middle_y, middle_y - low_y) / middle_y);
        }
        if (!options.distance) {
            // The camera stays so far away that no point is behind the eye.
            distance = std::max(distance * static_cast<float>(filled) / kFilled, 1.5F);
        }
    }
    eye_ = target + distance * back_;
}

RayF Camera::ray(float x, float y) const
{
    return {eye_, unit((x - 0.5F * width_) * right_ - (y - 0.5F * height_) * up_ - focal_ * back_)};
}

Vec2 Camera::seen(Vec3f point) const
{
    const Vec3f relative = point - eye_;
    const float depth = std::max(-dot(relative, back_), 1e-3F);
    return {static_cast<double>(0.5F * width_ + focal_ * dot(relative, right_) / depth),
            static_cast<double>(0.5F * height_ - focal_ * dot(relative, up_) / depth)};
}

}  // namespace droplet
