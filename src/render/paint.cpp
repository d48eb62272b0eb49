// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/render/paint.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "box_corners.h"
#include "droplet/compare/compare.h"
#include "droplet/error.h"
#include "droplet/units.h"
#include "number_text.h"

namespace droplet {
namespace {

[[noreturn]] void refuse(const std::string& text)
{
    throw Error(ErrorCode::InvalidArgument, "paint." + text);
}

// Diagonal of the surface's bounding box, about the picture's field of view.
double diameter(const Surface& surface)
{
    const auto [low, high] = cornersOf(surface.vertices);
    return length(high - low);
}

/// Position and value of a rim vertex.
struct RimPoint {
    Vec3 place;
    double angle = 0.0;
};

/// Plane grid of points, to find the nearest one within a cell's width.
class NearestPoint {
public:
    NearestPoint(std::vector<RimPoint> points, double reach) : points_(std::move(points)), reach_(reach)
    {
        std::sort(points_.begin(), points_.end(), [&](const RimPoint& a, const RimPoint& b) {
            return std::pair(cellOf(a.place.x), cellOf(a.place.y)) < std::pair(cellOf(b.place.x), cellOf(b.place.y));
        });
    }

    /// Nearest point and its distance; empty beyond the reach.
    [[nodiscard]] std::pair<const RimPoint*, double> to(Vec3 place) const
    {
        std::pair<const RimPoint*, double> nearest{nullptr, reach_};
        for (long column = cellOf(place.x) - 1; column <= cellOf(place.x) + 1; ++column) {
            const std::pair first{column, cellOf(place.y) - 1};
            const std::pair last{column, cellOf(place.y) + 1};
            auto point =
                std::lower_bound(points_.begin(), points_.end(), first, [&](const RimPoint& a, const auto& key) {
                    return std::pair(cellOf(a.place.x), cellOf(a.place.y)) < key;
                });
            for (; point != points_.end() && std::pair(cellOf(point->place.x), cellOf(point->place.y)) <= last;
                 ++point) {
                const double away = length(point->place - place);
                if (away < nearest.second) {
                    nearest = {&*point, away};
                }
            }
        }
        return nearest;
    }

private:
    [[nodiscard]] long cellOf(double a) const { return static_cast<long>(std::floor(a / reach_)); }

    std::vector<RimPoint> points_;
    double reach_;
};

}  // namespace

ColourScale sequentialScale()
{
    // Lightness rises evenly (CIELAB L* 20, 35, 50, 65, 80, 92); hues are chosen by eye.
    return {{0.14, 0.17, 0.40}, {0.10, 0.33, 0.55}, {0.08, 0.50, 0.57},
            {0.25, 0.66, 0.47}, {0.62, 0.80, 0.36}, {0.97, 0.91, 0.55}};
}

ColourScale divergingScale()
{
    return {{0.13, 0.30, 0.60}, {0.36, 0.58, 0.80}, {0.70, 0.82, 0.90}, {0.95, 0.94, 0.91},
            {0.96, 0.76, 0.64}, {0.86, 0.47, 0.38}, {0.65, 0.12, 0.17}};
}

void Paint::validate(std::size_t vertices) const
{
    if (values.size() != vertices || (!share.empty() && share.size() != vertices)) {
        refuse(fmt::format("values and share have {} and {} entries; the surface has {} vertices", values.size(),
                           share.size(), vertices));
    }
    const auto all = [](const std::vector<double>& numbers, const auto& holds) {
        return std::all_of(numbers.begin(), numbers.end(), holds);
    };
    if (!all(values, [](double a) { return std::isfinite(a); })) {
        refuse("values must be finite");
    }
    if (!all(share, [](double a) { return a >= 0.0 && a <= 1.0; })) {
        refuse("share must be from 0 to 1");
    }
    if (scale.size() < 2) {
        refuse("scale has " + std::to_string(scale.size()) + " colours; it must have 2 or more");
    }
    for (const Vec3& c : scale) {
        if (!(std::min({c.x, c.y, c.z}) >= 0.0 && std::max({c.x, c.y, c.z}) <= 1.0)) {
            refuse("scale must have colours from 0 to 1");
        }
    }
    if (!(low < high) || !std::isfinite(low) || !std::isfinite(high)) {
        refuse(fmt::format("low = {} must be below high = {}", numberText(low), numberText(high)));
    }
    if (!(unit > 0.0) || (line_spacing && !(*line_spacing > 0.0))) {
        refuse("unit and line_spacing must be above 0");
    }
}

double roundStep(double span, double parts)
{
    const double rough = span / parts;
    const double power = std::pow(10.0, std::floor(std::log10(rough)));
    for (const double step : {1.0, 2.0, 5.0}) {
        // The limit between two steps is their geometric mean.
        if (rough < step * power * (step == 2.0 ? std::sqrt(2.5) : std::sqrt(2.0))) {
            return step * power;
        }
    }
    return 10.0 * power;
}

Paint heightPaint(const Surface& surface)
{
    surface.validate();
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const Vec3& p : surface.vertices) {
        low = std::min(low, p.z);
        high = std::max(high, p.z);
    }
    Paint paint;
    for (const Vec3& p : surface.vertices) {
        paint.values.push_back(p.z - low);
    }
    const double span = std::max(high - low, 1e-12);
    const double step = roundStep(span, 12.0);
    paint.scale = sequentialScale();
    paint.low = 0.0;
    paint.high = step * std::ceil(span / step - 1e-9);
    paint.line_spacing = step;
    const bool millimetres = span >= 1e-3;
    paint.unit = millimetres ? kMillimetre : 1e-6;
    paint.caption = millimetres ? "height [mm]" : "height [\u00b5m]";
    return paint;
}

Paint contactAnglePaint(const Surface& surface)
{
    surface.validate();
    std::vector<RimPoint> rim;
    for (std::size_t v = 0; v < surface.contact_angle.size(); ++v) {
        if (surface.contact_angle[v] != 0.0F) {
            rim.push_back({surface.vertices[v], static_cast<double>(surface.contact_angle[v])});
        }
    }
    if (rim.empty()) {
        throw Error(ErrorCode::InvalidArgument, "surface has no contact angles to show");
    }
    double sum = 0.0;
    double low = std::numeric_limits<double>::infinity();
    double high = 0.0;
    for (const RimPoint& point : rim) {
        sum += point.angle;
        low = std::min(low, point.angle);
        high = std::max(high, point.angle);
    }
    const double mean = sum / static_cast<double>(rim.size());
    // The band is wide enough to be seen and leaves the middle free.
    const double width = 0.022 * diameter(surface);
    const NearestPoint nearest(std::move(rim), 3.0 * width);
    Paint paint;
    for (const Vec3& p : surface.vertices) {
        const auto [point, away] = nearest.to(p);
        paint.values.push_back(point == nullptr ? mean : point->angle);
        paint.share.push_back(point == nullptr ? 0.0 : std::clamp(1.5 - away / width, 0.0, 1.0));
    }
    const double reach = std::max({high - mean, mean - low, 0.5 * kDegree});
    const double step = roundStep(reach / kDegree, 3.0) * kDegree;
    paint.scale = divergingScale();
    // The scale has round numbers at both ends and in the middle.
    const double middle = step * std::round(mean / step);
    const double half = step * std::ceil(std::max(high - middle, middle - low) / step - 1e-9);
    paint.low = middle - std::max(half, step);
    paint.high = middle + std::max(half, step);
    paint.unit = kDegree;
    paint.caption = "contact angle [\u00b0]";
    return paint;
}

Paint differencePaint(const Surface& surface, const Surface& other)
{
    Paint paint;
    paint.values = signedDistances(surface, other);
    constexpr double kMin = 1e-9;  // range of the scale for identical surfaces
    double largest = kMin;
    for (const double value : paint.values) {
        largest = std::max(largest, std::abs(value));
    }
    const double step = roundStep(largest, 4.0);
    paint.scale = divergingScale();
    paint.high = step * std::ceil(largest / step - 1e-9);
    paint.low = -paint.high;
    const bool millimetres = largest >= 1e-3;
    paint.unit = millimetres ? kMillimetre : 1e-6;
    paint.caption = millimetres ? "outside [mm]" : "outside [\u00b5m]";
    return paint;
}

}  // namespace droplet
