// SPDX-License-Identifier: GPL-3.0-or-later
//
// P. Fournier, A. Habibi, P. Poulin, "Simulating the Flow of Liquid Droplets", Graphics Interface 1998, section 3.4:
// "randomly displacing the spline control points", with an amplitude that is 0 at rest and for fast droplets. Here the
// random numbers belong to places of the surface, whose variation the paper names as the reason: a droplet that moves
// over them changes its outline smoothly, alike at every frame rate. In the cylinder's coordinates about the middle,
// (r, φ, z) becomes (f(φ) r, φ, c z), which keeps the surface free of folds; c keeps the volume.
#include "flow_io/small_deformation.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "wind/random_field.h"

namespace droplet {
namespace {

// Speed of the largest deformation [m/s]: of a droplet that creeps. Chosen by eye on the paper's presets and on rain on
// a window, whose droplets run at 2 to 60 cm/s.
constexpr double kSlow = 0.1;

/// Factor on the distance from the middle, by direction: linear between those of the rim's vertices.
class Outline {
public:
    Outline(const DropletDeformation& deformation, const FlatDroplet& droplet)
    {
        constexpr double kLeast = 0.5;
        for (std::size_t k = 0; k < droplet.rim; ++k) {
            const Vec3 p = droplet.vertices[k];
            const DropletFrame& frame = deformation.frame;
            const Vec3 place = frame.place + p.x * frame.ahead + p.y * frame.left;
            const double value = smoothRandom((1.0 / deformation.field.length) * place, deformation.field.seed);
            points_.push_back(
                {std::atan2(p.y, p.x), std::max(1.0 + deformation.share * value / kSmoothRandomDeviation, kLeast)});
        }
        std::sort(points_.begin(), points_.end(), [](const Point& a, const Point& b) { return a.angle < b.angle; });
        const Point first = points_.front();
        const Point last = points_.back();
        points_.insert(points_.begin(), {last.angle - 2.0 * std::numbers::pi, last.factor});
        points_.push_back({first.angle + 2.0 * std::numbers::pi, first.factor});
    }

    struct Value {
        double factor = 1.0;
        double slope = 0.0;  ///< by the angle
    };
    [[nodiscard]] Value at(double angle) const
    {
        const auto next = std::upper_bound(points_.begin() + 1, points_.end() - 1, angle,
                                           [](double value, const Point& point) { return value < point.angle; });
        const Point& a = *(next - 1);
        const Point& b = *next;
        const double width = std::max(b.angle - a.angle, 1e-12);
        const double share = std::clamp((angle - a.angle) / width, 0.0, 1.0);
        return {a.factor + share * (b.factor - a.factor), (b.factor - a.factor) / width};
    }

private:
    struct Point {
        double angle = 0.0;
        double factor = 1.0;
    };
    std::vector<Point> points_;
};

}  // namespace

double SmallDeformation::at(double speed) const
{
    const double relative = speed / kSlow;
    return amplitude * relative * std::exp(1.0 - relative);
}

void deform(const DropletDeformation& deformation, const FlatDroplet& droplet)
{
    const Outline outline(deformation, droplet);
    // The open base lies in the plane of the origin.
    const double before = volumeUnder(droplet.vertices, droplet.triangles);
    std::vector<Outline::Value> values;
    values.reserve(droplet.vertices.size());
    for (Vec3& p : droplet.vertices) {
        values.push_back(outline.at(std::atan2(p.y, p.x)));
        p = {values.back().factor * p.x, values.back().factor * p.y, p.z};
    }
    const double height = before / volumeUnder(droplet.vertices, droplet.triangles);
    for (std::size_t k = 0; k < droplet.vertices.size(); ++k) {
        Vec3& p = droplet.vertices[k];
        p.z *= height;
        // The normal is the gradient of a function that moves along.
        const double radius = std::hypot(p.x, p.y);
        const Vec3 out = radius > 0.0 ? (1.0 / radius) * Vec3{p.x, p.y, 0.0} : Vec3{1.0, 0.0, 0.0};
        const Vec3 round{-out.y, out.x, 0.0};
        Vec3& n = droplet.normals[k];
        const auto [factor, slope] = values[k];
        const Vec3 moved = (dot(n, out) / factor) * out +
                           ((dot(n, round) - dot(n, out) * slope / factor) / factor) * round +
                           Vec3{0.0, 0.0, n.z / height};
        n = (1.0 / length(moved)) * moved;
    }
}

}  // namespace droplet
