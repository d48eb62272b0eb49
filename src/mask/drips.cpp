// SPDX-License-Identifier: GPL-3.0-or-later
// Footprint and drips are signed distances, joined with round corners (I. Quilez, "smooth minimum", 2013: the
// polynomial one), as the tension of a surface rounds them.
#include "droplet/mask/drips.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <utility>

#include "droplet/error.h"
#include "hashed_number.h"
#include "require.h"

namespace droplet {
namespace {

constexpr std::uint16_t kHalf = 32768;  // coverage from which a pixel is liquid
// Shapes and times are chosen by eye, after paint on a wall.
constexpr double kSmallest = 0.4;   // radius of a bulge over half the width of strokes
constexpr double kLargest = 0.8;    // likewise
constexpr double kShortest = 0.15;  // way down over the footprint's height
constexpr double kLongest = 0.75;   // likewise
constexpr double kLatest = 0.4;     // begin of the last drip
constexpr double kHangs = 0.3;      // share of a drip's time in which its bulge grows

double smoothMinimum(double a, double b, double width)
{
    const double near = std::max(width - std::abs(a - b), 0.0) / width;
    return std::min(a, b) - 0.25 * near * near * width;
}

/// From 0 to 1 with both ends at rest: the cubic is the lowest polynomial that has no speed at 0 and at 1, so that no
/// bulge starts or stops with a jerk. Which curve it is has no physical reason.
double smoothstep(double t)
{
    t = std::clamp(t, 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

/// Bulge and trail of a drip at a time.
struct DripShape {
    Vec2 middle;          ///< of the bulge
    double radius = 0.0;  ///< likewise
    double trail = 0.0;   ///< half the trail's width

    static std::optional<DripShape> of(const Drips::Drip& drip, double time)
    {
        const double since = (time - drip.begin) / (1.0 - drip.begin);
        if (since <= 0.0) {
            return {};
        }
        const double grown = smoothstep(since / kHangs);
        const double left = std::clamp((1.0 - since) / (1.0 - kHangs), 0.0, 1.0);
        const double run = smoothstep(1.0 - std::pow(left, 1.5));
        const double radius = drip.radius * (0.5 + 0.5 * grown);
        return DripShape{{drip.root.x, drip.root.y + (grown - 0.8) * drip.radius + run * drip.length},
                         radius,
                         (0.65 - 0.2 * run) * drip.radius};
    }

    /// Signed distance of a place [px].
    [[nodiscard]] double distance(Vec2 place, const Drips::Drip& drip) const
    {
        const double top = std::min(drip.root.y - drip.radius, middle.y);
        const double beside = std::hypot(place.x - drip.root.x, place.y - std::clamp(place.y, top, middle.y));
        return smoothMinimum(length(place - middle) - radius, beside - trail, 1.5 * drip.radius);
    }
};

/// Places at lower edges that have room for a drip above them, the lowest of their surroundings first.
std::vector<Vec2> rootsOf(const Mask& mask, const cv::Mat& inside, double room, std::uint64_t seed)
{
    struct Candidate {
        Vec2 place;
        double order = 0.0;
    };
    std::vector<Candidate> candidates;
    const auto reach = std::max(static_cast<int>(std::lround(room)), 1);
    const auto is_liquid = [&](int x, int y) {
        return x >= 0 && x < mask.width && y >= 0 && y < mask.height &&
               mask.coverage[static_cast<std::size_t>(y) * static_cast<std::size_t>(mask.width) +
                             static_cast<std::size_t>(x)] >= kHalf;
    };
    // Bottom of the liquid beside a place, looked for a little above and below it.
    const auto bottom_beside = [&](int x, int y) -> std::optional<int> {
        for (int k = y + reach; k >= y - reach; --k) {
            if (is_liquid(x, k) && !is_liquid(x, k + 1)) {
                return k;
            }
        }
        return {};
    };
    for (int y = 0; y < mask.height; ++y) {
        for (int x = 0; x < mask.width; ++x) {
            if (!is_liquid(x, y) || is_liquid(x, y + 1)) {
                continue;
            }
            const int above = std::max(y - reach, 0);
            if (inside.at<float>(above, x) < 0.6F * static_cast<float>(room)) {
                continue;  // a spike, or the edge of a thin stroke
            }
            const std::optional<int> left = bottom_beside(x - reach / 2, y);
            const std::optional<int> right = bottom_beside(x + reach / 2, y);
            if (!left || !right) {
                continue;  // a corner
            }
            // Liquid runs along a slope to its lower end.
            const double slope = std::abs(*right - *left) / static_cast<double>(std::max(reach, 1));
            const double lowest = 0.5 * (2 * y - *left - *right) / room;
            const auto number = static_cast<std::uint32_t>(y) * 0x9e3779b9U +
                                static_cast<std::uint32_t>(x) * 0x85ebca6bU + hashed(static_cast<std::uint32_t>(seed));
            candidates.push_back({{x + 0.5, y + 0.5}, slope - lowest + static_cast<double>(hashedNumber(number))});
        }
    }
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.order < b.order; });
    std::vector<Vec2> roots;
    for (const Candidate& one : candidates) {
        const bool is_free = std::none_of(roots.begin(), roots.end(), [&](Vec2 other) {
            return std::abs(other.x - one.place.x) < 2.5 * room;  // else one would run into the other
        });
        if (is_free) {
            roots.push_back(one.place);
        }
    }
    return roots;
}

}  // namespace

void DripOptions::validate() const
{
    require(count > 0, "count", count, "more than 0");
}

Drips::Drips(Mask mask, const DripOptions& options) : mask_(std::move(mask))
{
    mask_.validate();
    options.validate();
    cv::Mat liquid(mask_.height, mask_.width, CV_8U);
    std::transform(mask_.coverage.begin(), mask_.coverage.end(), liquid.begin<std::uint8_t>(),
                   [](std::uint16_t coverage) { return static_cast<std::uint8_t>(coverage >= kHalf ? 255 : 0); });
    const double area = cv::countNonZero(liquid);
    if (area == 0.0) {
        throw Error(ErrorCode::InvalidInput, "mask has no liquid");
    }
    cv::Mat inside;
    cv::distanceTransform(liquid, inside, cv::DIST_L2, cv::DIST_MASK_PRECISE);
    // In a stroke, the mean distance from the rim is a quarter of its width.
    const double half_width = 2.0 * cv::sum(inside)[0] / area;
    const cv::Rect box = cv::boundingRect(liquid);
    const std::vector<Vec2> roots = rootsOf(mask_, inside, half_width, options.seed);
    double bottom = 0.0;
    for (std::size_t k = 0; k < roots.size() && k < static_cast<std::size_t>(options.count); ++k) {
        const auto number = [&](std::uint32_t which) {
            return static_cast<double>(hashedNumber(
                hashed(static_cast<std::uint32_t>(options.seed) + 4U * static_cast<std::uint32_t>(k)) + which));
        };
        const double size = number(0);
        // Large ones run farther.
        const double far = kShortest + (kLongest - kShortest) * 0.5 * (size + number(1));
        const Drip& drip = drips_.emplace_back(Drip{roots[k], half_width * (kSmallest + (kLargest - kSmallest) * size),
                                                    far * box.height, k == 0 ? 0.0 : kLatest * number(2)});
        bottom = std::max(bottom, drip.root.y + drip.length + 2.0 * drip.radius + half_width);
    }
    const int rows = std::max(static_cast<int>(std::ceil(bottom)) - mask_.height, 0);
    mask_.height += rows;
    mask_.coverage.resize(static_cast<std::size_t>(mask_.width) * static_cast<std::size_t>(mask_.height), 0);
    cv::copyMakeBorder(liquid, liquid, 0, rows, 0, 0, cv::BORDER_CONSTANT, cv::Scalar(0));
    cv::distanceTransform(liquid, inside, cv::DIST_L2, cv::DIST_MASK_PRECISE);
    cv::Mat outside;
    cv::distanceTransform(255 - liquid, outside, cv::DIST_L2, cv::DIST_MASK_PRECISE);
    distance_.resize(mask_.coverage.size());
    // The rim is half a pixel from the middles of the pixels beside it.
    std::transform(inside.begin<float>(), inside.end<float>(), outside.begin<float>(), distance_.begin(),
                   [](float in, float out) { return out > 0.0F ? out - 0.5F : 0.5F - in; });
}

Mask Drips::at(double time) const
{
    require(time >= 0.0 && time <= 1.0, "time", time, "from 0 to 1");
    Mask mask = mask_;
    for (const Drip& drip : drips_) {
        const std::optional<DripShape> shape = DripShape::of(drip, time);
        if (!shape) {
            continue;
        }
        const double round = 1.5 * drip.radius;  // of the corners with the footprint
        const double reach = 2.0 * drip.radius + round;
        const auto first = [&](double place) { return std::max(static_cast<int>(std::floor(place - reach)), 0); };
        const auto last = [&](double place, int size) {
            return std::min(static_cast<int>(std::ceil(place + reach)), size);
        };
        for (int y = first(drip.root.y); y < last(std::max(shape->middle.y, drip.root.y), mask.height); ++y) {
            for (int x = first(drip.root.x); x < last(drip.root.x, mask.width); ++x) {
                const std::size_t i =
                    static_cast<std::size_t>(y) * static_cast<std::size_t>(mask.width) + static_cast<std::size_t>(x);
                const double own = distance_[i];
                const double distance = shape->distance({x + 0.5, y + 0.5}, drip);
                if (distance - own > round) {
                    continue;  // far from the drip, the picture's own edges stay
                }
                const double covered = std::clamp(0.5 - smoothMinimum(own, distance, round), 0.0, 1.0);
                mask.coverage[i] =
                    std::max(mask.coverage[i], static_cast<std::uint16_t>(std::lrint(65535.0 * covered)));
            }
        }
    }
    return mask;
}

}  // namespace droplet
