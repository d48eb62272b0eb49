// SPDX-License-Identifier: GPL-3.0-or-later
// The air below a crest is closed off when its tip touches the water, and open again a frame later: a hole flashes. The
// next frames are not known. So a hole with a thin bridge to the outside is drawn as a bay until it has lasted.
#include "bays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <utility>

#include "liquid2d/bounds.h"
#include "plain_length.h"

namespace droplet {
namespace {

/// Thickness of bridges that may break, in spacings: nearly all were thinner that broke within three frames in `wave`,
/// `dam` and `pour`, of 35.
constexpr double kThin = 2.7;

/// Width of the gap between the ends of a broken bridge, in spacings.
constexpr double kGap = 1.0;

/// Distance within which particles lie around a bridge, in spacings.
constexpr double kAround = 2.5;

/// Distance within which a bridge is that of an earlier gap, in spacings.
constexpr double kSamePlace = 4.0;

/// Points of a round end.
constexpr int kEndPoints = 5;

/// Part of a loop that a gap may take.
constexpr double kMostOfLoop = 0.4;

/// Points of a loop from behind a gap to before it.
struct Rest {
    std::size_t first = 0;
    std::size_t count = 0;
};

/// @param half  of the gap's width along the loop
std::optional<Rest> withoutGap(const Loop& loop, std::size_t at, double half)
{
    const std::vector<Vec2>& points = loop.points;
    const std::size_t count = points.size();
    const auto steps = [&](std::size_t step) {
        double way = 0.0;
        std::size_t k = at;
        std::size_t gone = 0;
        while (way < half && gone < count) {
            const std::size_t next = (k + step) % count;
            way += plainLength(points[next] - points[k]);
            k = next;
            ++gone;
        }
        return gone;
    };
    const std::size_t after = steps(1);
    const std::size_t before = steps(count - 1);
    if (static_cast<double>(after + before) > kMostOfLoop * static_cast<double>(count)) {
        return std::nullopt;
    }
    return Rest{(at + after) % count, count + 1 - after - before};
}

void append(Loop& result, const Loop& loop, const Rest& rest)
{
    const std::size_t count = loop.points.size();
    for (std::size_t n = 0; n < rest.count; ++n) {
        result.points.push_back(loop.points[(rest.first + n) % count]);
    }
}

/// Half of an ellipse from a to b, bent towards a direction.
void appendEnd(Loop& result, Vec2 a, Vec2 b, Vec2 outwards, double height)
{
    for (int k = 1; k <= kEndPoints; ++k) {
        const double angle = std::numbers::pi * k / (kEndPoints + 1);
        result.points.push_back(0.5 * ((1.0 + std::cos(angle)) * a + (1.0 - std::cos(angle)) * b) +
                                height * std::sin(angle) * outwards);
    }
}

/// Whether a convex polygon, counterclockwise or clockwise, holds a point.
bool holds(const std::array<Vec2, 4>& corners, Vec2 point)
{
    int left = 0;
    for (std::size_t k = 0; k < corners.size(); ++k) {
        left += cross(corners[(k + 1) % corners.size()] - corners[k], point - corners[k]) > 0.0 ? 1 : 0;
    }
    return left == 0 || left == 4;
}

/// Thin bridges of a hole, the thinnest at each of its points.
std::vector<Bridge> thinBridges(const Loop& hole, const std::vector<Loop>& rims, double spacing)
{
    std::vector<Bridge> bridges;
    for (std::size_t i = 0; i < hole.points.size(); ++i) {
        const Vec2 x = hole.points[i];
        double least = kThin * kThin * spacing * spacing;
        std::optional<Bridge> bridge;
        for (std::size_t n = 0; n < rims.size(); ++n) {
            if (signedArea(rims[n]) <= 0.0) {
                continue;
            }
            for (std::size_t k = 0; k < rims[n].points.size(); ++k) {
                const Vec2 across = rims[n].points[k] - x;
                if (const double square = dot(across, across); square < least) {
                    least = square;
                    bridge = Bridge{n, i, k, std::sqrt(square), x + 0.5 * across};
                }
            }
        }
        if (bridge) {
            bridges.push_back(*bridge);
        }
    }
    return bridges;
}

/// Rate at which particles around a place part from one another; less than 0 where they meet [1/s].
double partingAt(Vec2 place, const ParticleFrame& frame, const std::vector<std::uint32_t>& particles)
{
    const double reach = kAround * frame.spacing;
    std::vector<std::uint32_t> around;
    Vec2 middle;
    Vec2 velocity;
    for (const std::uint32_t i : particles) {
        const Vec2 arm = frame.position[i] - place;
        if (dot(arm, arm) < reach * reach) {
            around.push_back(i);
            middle = middle + arm;
            velocity = velocity + frame.velocity[i];
        }
    }
    double parting = 0.0;
    double squares = 0.0;
    const double share = around.empty() ? 0.0 : 1.0 / static_cast<double>(around.size());
    for (const std::uint32_t i : around) {
        const Vec2 arm = frame.position[i] - place - share * middle;
        parting += dot(frame.velocity[i] - share * velocity, arm);
        squares += dot(arm, arm);
    }
    return squares > 0.0 ? parting / squares : 0.0;
}

}  // namespace

std::vector<Bridge> bridgesOf(const Loop& hole, const std::vector<Loop>& rims, const ParticleFrame& frame,
                              std::optional<Vec2> gap)
{
    std::vector<Bridge> bridges = thinBridges(hole, rims, frame.spacing);
    Bounds box;
    for (const Bridge& bridge : bridges) {
        box.include(bridge.middle);
    }
    const double reach = kAround * frame.spacing;
    std::vector<std::uint32_t> particles;
    for (std::uint32_t i = 0; !gap && i < frame.position.size(); ++i) {
        const Vec2 x = frame.position[i];
        if (x.x > box.lower.x - reach && x.x < box.upper.x + reach && x.y > box.lower.y - reach &&
            x.y < box.upper.y + reach) {
            particles.push_back(i);
        }
    }
    std::vector<std::pair<double, Bridge>> ranked;
    for (const Bridge& bridge : bridges) {
        const double value = gap ? plainLength(bridge.middle - *gap) : partingAt(bridge.middle, frame, particles);
        if (!gap || value < kSamePlace * frame.spacing) {
            ranked.emplace_back(value, bridge);
        }
    }
    std::stable_sort(ranked.begin(), ranked.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    bridges.resize(ranked.size());
    std::transform(ranked.begin(), ranked.end(), bridges.begin(), [](const auto& entry) { return entry.second; });
    return bridges;
}

std::optional<Loop> withBay(const std::vector<Loop>& rims, const Loop& hole, const Bridge& bridge, double spacing)
{
    const Loop& outline = rims[bridge.outline];
    // The round ends reach into the gap.
    const double height = 0.5 * bridge.thickness;
    const double half = 0.5 * kGap * spacing + height;
    const std::optional<Rest> of_outline = withoutGap(outline, bridge.at_outline, half);
    const std::optional<Rest> of_hole = withoutGap(hole, bridge.at_hole, half);
    if (!of_outline || !of_hole) {
        return std::nullopt;
    }
    // Liquid is on the left of both: where the outline comes to the gap, the hole goes on.
    Loop result;
    append(result, outline, *of_outline);
    const Vec2 outline_before = result.points.back();
    const Vec2 outline_after = result.points.front();
    const std::size_t hole_size = hole.points.size();
    const Vec2 hole_after = hole.points[of_hole->first];
    const Vec2 hole_before = hole.points[(of_hole->first + of_hole->count - 1) % hole_size];
    const std::array<Vec2, 4> gap{outline_before, outline_after, hole_before, hole_after};
    for (const Loop& rim : rims) {
        for (const Vec2 point : rim.points) {
            if (&rim != &outline && holds(gap, point)) {
                return std::nullopt;
            }
        }
    }
    const Vec2 along = outline_after - outline_before;
    const double size = plainLength(along);
    if (!(size > 0.0)) {
        return std::nullopt;
    }
    const Vec2 forward = (1.0 / size) * along;
    appendEnd(result, outline_before, hole_after, forward, height);
    append(result, hole, *of_hole);
    appendEnd(result, hole_before, outline_after, -1.0 * forward, height);
    result.corner.resize(result.points.size());
    return signedArea(result) > 0.0 ? std::optional(std::move(result)) : std::nullopt;
}

}  // namespace droplet
