// SPDX-License-Identifier: GPL-3.0-or-later
// Interpolation between pixels: R. G. Keys, "Cubic convolution interpolation for digital image processing" (1981), with
// a = −1/2, the spline of Catmull and Rom (1974). It is once differentiable and of third order.
#include "droplet/shape/base_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <tuple>
#include <utility>

#include "droplet/error.h"
#include "droplet/units.h"
#include "number_text.h"

namespace droplet {
namespace {

std::string millimetres(double length)
{
    return numberText(length / kMillimetre) + " mm";
}

void checkRadius(double radius, const char* body)
{
    if (!(std::isfinite(radius) && radius != 0.0)) {
        throw Error(ErrorCode::InvalidArgument,
                    "radius " + millimetres(radius) + " " + body + " must be finite and not zero");
    }
}

/// Circle that touches the plane, at a distance from that point.
struct Arc {
    double height = 0.0;
    double slope = 0.0;  ///< derivative by the distance
};

std::optional<Arc> arcAt(double radius, double distance)
{
    const double size = std::abs(radius);
    if (!(distance < size)) {
        return std::nullopt;
    }
    const double root = std::sqrt((size - distance) * (size + distance));
    const double sign = radius > 0.0 ? -1.0 : 1.0;
    // R − √(R² − r²), without cancellation.
    return Arc{sign * distance * distance / (size + root), sign / root};
}

/// Weights of cubic convolution, and their derivatives, at t between the second and third of four neighbours.
struct Weights {
    std::array<double, 4> value{};
    std::array<double, 4> slope{};
};

Weights weightsAt(double t)
{
    return {{0.5 * t * (-1.0 + t * (2.0 - t)), 1.0 + 0.5 * t * t * (3.0 * t - 5.0),
             0.5 * t * (1.0 + t * (4.0 - 3.0 * t)), 0.5 * t * t * (t - 1.0)},
            {0.5 * (-1.0 + t * (4.0 - 3.0 * t)), 0.5 * t * (9.0 * t - 10.0), 0.5 * (1.0 + t * (8.0 - 9.0 * t)),
             0.5 * t * (3.0 * t - 2.0)}};
}

/// Four pixels of a row around a place. Pixels beyond the picture are replaced by the last one.
struct Taps {
    std::array<std::size_t, 4> index{};
    Weights weights;
};

/// @param place  [px]; 0 is the centre of the first pixel
Taps tapsAt(double place, int count)
{
    // The result is constant farther out, and an int holds these values.
    const double within = std::clamp(place, -3.0, static_cast<double>(count) + 2.0);
    const double left = std::floor(within);
    Taps taps;
    taps.weights = weightsAt(within - left);
    for (int k = 0; k < 4; ++k) {
        taps.index[static_cast<std::size_t>(k)] =
            static_cast<std::size_t>(std::clamp(static_cast<int>(left) + k - 1, 0, count - 1));
    }
    return taps;
}

/// A height map stretched over a rectangle.
class StretchedMap {
public:
    StretchedMap(HeightMap map, Vec2 extent, double depth) : map_(std::move(map)), extent_(extent), depth_(depth) {}

    [[nodiscard]] GroundPoint at(Vec2 p) const
    {
        const Vec2 scale{map_.width / extent_.x, map_.height / extent_.y};
        const Taps across = tapsAt(0.5 * map_.width + p.x * scale.x - 0.5, map_.width);
        const Taps down = tapsAt(0.5 * map_.height - p.y * scale.y - 0.5, map_.height);
        GroundPoint ground;
        for (std::size_t j = 0; j < 4; ++j) {
            const float* row = map_.levels.data() + down.index[j] * static_cast<std::size_t>(map_.width);
            double level = 0.0;
            double slope = 0.0;
            for (std::size_t i = 0; i < 4; ++i) {
                const double tap = row[across.index[i]];
                level += across.weights.value[i] * tap;
                slope += across.weights.slope[i] * tap;
            }
            ground.height += depth_ * down.weights.value[j] * level;
            ground.gradient.x += depth_ * down.weights.value[j] * slope * scale.x;
            ground.gradient.y -= depth_ * down.weights.slope[j] * level * scale.y;
        }
        return ground;
    }

private:
    HeightMap map_;
    Vec2 extent_;
    double depth_;
};

}  // namespace

BaseSurface::BaseSurface(Sample sample) : sample_(std::move(sample)) {}

BaseSurface::BaseSurface(Sample sample, Bounds bounds) : sample_(std::move(sample)), bounds_(std::move(bounds)) {}

GroundPoint BaseSurface::at(Vec2 p) const
{
    if (const std::optional<GroundPoint> ground = find(p)) {
        return *ground;
    }
    if (!bounds_) {
        throw Error(ErrorCode::InvalidArgument, "there is no ground at x " + millimetres(p.x) + ", y " +
                                                    millimetres(p.y) + ", under the footprint");
    }
    throw Error(
        ErrorCode::InvalidArgument,
        fmt::format("radius {} {} must exceed {}, the largest distance of the footprint from its {}",
                    millimetres(bounds_->radius), bounds_->body, millimetres(bounds_->distance(p)), bounds_->middle));
}

void BaseSurface::requireAt(std::span<const Vec2> points) const
{
    if (bounds_ && !points.empty()) {
        std::ignore = at(*std::max_element(points.begin(), points.end(), [this](Vec2 a, Vec2 b) {
            return bounds_->distance(a) < bounds_->distance(b);
        }));
        return;
    }
    for (const Vec2 p : points) {
        std::ignore = at(p);
    }
}

BaseSurface BaseSurface::sphere(double radius)
{
    checkRadius(radius, "of the ground's sphere");
    const auto sample = [radius](Vec2 p) -> std::optional<GroundPoint> {
        const std::optional<Arc> arc = arcAt(radius, length(p));
        return arc ? std::optional(GroundPoint{arc->height, arc->slope * p}) : std::nullopt;
    };
    return {sample, {[](Vec2 p) { return length(p); }, std::abs(radius), "of the ground's sphere", "top"}};
}

BaseSurface BaseSurface::cylinder(double radius, double axis)
{
    checkRadius(radius, "of the ground's cylinder");
    if (!std::isfinite(axis)) {
        throw Error(ErrorCode::InvalidArgument,
                    "axis " + numberText(axis / kDegree) + " degrees of the ground's cylinder must be finite");
    }
    const Vec2 across{-std::sin(axis), std::cos(axis)};
    const auto sample = [radius, across](Vec2 p) -> std::optional<GroundPoint> {
        const double away = dot(across, p);
        const std::optional<Arc> arc = arcAt(radius, std::abs(away));
        return arc ? std::optional(GroundPoint{arc->height, arc->slope * away * across}) : std::nullopt;
    };
    return {
        sample,
        {[across](Vec2 p) { return std::abs(dot(across, p)); }, std::abs(radius), "of the ground's cylinder", "line"}};
}

BaseSurface BaseSurface::heightMap(HeightMap map, Vec2 extent, std::optional<double> depth)
{
    map.validate();
    if (!(extent.x > 0.0 && extent.y > 0.0 && std::isfinite(extent.x) && std::isfinite(extent.y))) {
        throw Error(ErrorCode::InvalidArgument, "extent " + millimetres(extent.x) + " × " + millimetres(extent.y) +
                                                    " of the height map must be positive");
    }
    if (!depth && !map.in_floats) {
        throw Error(ErrorCode::InvalidArgument, "depth of the height map must be given: its grey levels have no unit");
    }
    if (depth && !std::isfinite(*depth)) {
        throw Error(ErrorCode::InvalidArgument, "depth " + millimetres(*depth) + " of the height map must be finite");
    }
    // Copies of the ground share it.
    const auto stretched = std::make_shared<const StretchedMap>(std::move(map), extent, depth.value_or(1.0));
    return BaseSurface([stretched](Vec2 p) { return stretched->at(p); });
}

}  // namespace droplet
