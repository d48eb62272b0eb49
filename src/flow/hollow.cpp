// SPDX-License-Identifier: GPL-3.0-or-later
//
// Level rises from the lowest place near the droplet, and faces are flooded in the order of the edges that it passes
// (priority flood: R. Barnes, C. Lehman, D. Mulla, Computers & Geosciences 62 (2014) 117), until a face beyond leads
// down, or the hollow is known to hold the liquid.
#include "flow/hollow.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <queue>
#include <tuple>
#include <unordered_set>
#include <vector>

#include "droplet/wind/forces.h"
#include "flow/flow_terrain_content.h"

namespace droplet {
namespace {

// A hollow shallower than this share of the droplet's radius is none, as for hops (walk.cpp).
constexpr double kShallow = 2e-3;
// Faces after which it is asked first whether the hollow holds the liquid; then after twice as many, and so on.
constexpr std::size_t kFirstCheck = 16;
// Hollows with more faces are not followed to their end: they hold the liquid.
constexpr std::size_t kMostFaces = 1'000'000;

using Heights = std::array<double, 3>;

/// Part of a face below a level, seen from above.
struct Flooded {
    double area = 0.0;
    double volume = 0.0;
};

/// @param area  of the face seen from above; negative where it overhangs
Flooded floodedPart(Heights h, double area, double level)
{
    std::sort(h.begin(), h.end());
    const double mean = (h[0] + h[1] + h[2]) / 3.0;
    if (level >= h[2]) {
        return {area, area * (level - mean)};
    }
    if (level <= h[0]) {
        return {};
    }
    if (level <= h[1]) {
        const double part = area * (level - h[0]) * (level - h[0]) / ((h[1] - h[0]) * (h[2] - h[0]));
        return {part, part * (level - h[0]) / 3.0};
    }
    const double dry = area * (h[2] - level) * (h[2] - level) / ((h[2] - h[0]) * (h[2] - h[1]));
    return {area - dry, area * (level - mean) + dry * (h[2] - level) / 3.0};
}

/// An edge that the level may pass.
struct Pass {
    /// Of its lower and its upper end, in parts of the slack: rounding must not choose between edges of one height. Of
    /// edges that meet in a corner, level ones come first.
    std::array<double, 2> rank = {};
    std::uint32_t face = 0;  ///< before it
    std::uint32_t side = 0;
    double height = 0.0;  ///< of its lower end
    double top = 0.0;
    friend bool operator>(const Pass& a, const Pass& b)
    {
        return std::tie(a.rank, a.face, a.side) > std::tie(b.rank, b.face, b.side);
    }
};

class Flood {
public:
    Flood(const FlowSurface& surface, Vec3 up, const RestingLiquid& liquid)
        : faces_(surface.faces), up_(up), liquid_(liquid), slack_(kShallow * liquid.radius)
    {
    }

    Hollow run()
    {
        const Hollow known{std::nullopt, liquid_.volume};
        if (!begin(liquid_.face, dot(up_, liquid_.place))) {
            return known;
        }
        std::size_t check = kFirstCheck;
        while (!passes_.empty()) {
            const Pass pass = passes_.top();
            if (!exits_.empty() && pass.height > bottom_ + slack_) {
                break;
            }
            passes_.pop();
            const std::uint32_t next = faces_[pass.face].neighbour[pass.side];
            if (next != FlowSurface::kNone && flooded_.contains(next)) {
                continue;
            }
            level_ = std::max(level_, pass.height);
            if (flooded_.size() >= check) {
                if (const double held = heldBy(filled()); held >= liquid_.volume) {
                    return {std::nullopt, held};
                }
                if (flooded_.size() > kMostFaces) {
                    return known;
                }
                check *= 2;
            }
            if (next != FlowSurface::kNone && heightsOf(next)[lowestOf(next)] >= level_ - slack_) {
                flood(next);
            } else if (level_ - bottom_ > slack_) {
                return over(pass);
            } else if (is_flat_ && isEdge(next)) {
                exits_.push_back(pass);  // the whole flat counts, as a puddle on a plate does
            } else if (next == FlowSurface::kNone || !begin(next, level_)) {
                return known;
            }
        }
        return exits_.empty() ? known : over(*nearestExit());
    }

private:
    [[nodiscard]] Heights heightsOf(std::uint32_t face) const
    {
        const auto& [a, b, c] = faces_[face].corners;
        return {dot(up_, a), dot(up_, b), dot(up_, c)};
    }

    [[nodiscard]] std::size_t lowestOf(std::uint32_t face) const
    {
        const Heights heights = heightsOf(face);
        return static_cast<std::size_t>(std::min_element(heights.begin(), heights.end()) - heights.begin());
    }

    /// Begins at the bottom of a face, if the droplet reaches it: otherwise it rests on a slope.
    /// @param height  of the droplet, or of the last bottom
    bool begin(std::uint32_t face, double height)
    {
        const Vec3 corner = faces_[face].corners[lowestOf(face)];
        bottom_ = std::min(height, dot(up_, corner));
        level_ = bottom_;
        constexpr double kLevel = 0.9994;  // cosine of 2°
        is_flat_ = height - bottom_ <= slack_ && dot(faces_[face].normal, up_) >= kLevel;
        exits_.clear();
        flooded_.clear();
        passes_ = {};
        flood(face);
        return height - bottom_ <= slack_ || length(corner - liquid_.place) <= liquid_.radius;
    }

    void flood(std::uint32_t face)
    {
        flooded_.insert(face);
        const Heights heights = heightsOf(face);
        for (std::uint32_t side = 0; side < 3; ++side) {
            const auto [low, high] = std::minmax(heights[side], heights[(side + 1) % 3]);
            const double ground = dot(up_, liquid_.place);
            passes_.push({{ranked(low - ground), ranked(high - ground)}, face, side, low, high});
        }
    }

    [[nodiscard]] Flooded filled() const
    {
        Flooded sum;
        for (const std::uint32_t face : flooded_) {
            const double area = dot(faces_[face].normal, up_) * areaOf(faces_[face]);
            const Flooded part = floodedPart(heightsOf(face), area, level_);
            sum.area += part.area;
            sum.volume += part.volume;
        }
        return {std::max(sum.area, 0.0), std::max(sum.volume, 0.0)};
    }

    /// Volume up to the level, and what surface tension holds above it.
    [[nodiscard]] double heldBy(const Flooded& sum) const
    {
        const double cap = capVolume(std::sqrt(sum.area / std::numbers::pi), liquid_.contact_angle);
        return sum.volume + std::min(sum.area * liquid_.puddle, cap);
    }

    /// Whether level ground ends where another face, or nothing, follows; ground that slopes a little does not.
    [[nodiscard]] bool isEdge(std::uint32_t next) const
    {
        constexpr double kSteep = 0.87;  // cosine of 30°
        return next == FlowSurface::kNone || dot(faces_[next].normal, up_) < kSteep;
    }

    [[nodiscard]] double ranked(double length) const
    {
        constexpr double kParts = 100.0;
        return std::round(length * kParts / slack_);
    }

    /// Middle of a level edge, or the lower end of one.
    [[nodiscard]] Vec3 placeOf(const Pass& pass) const
    {
        const FlowSurface::Face& face = faces_[pass.face];
        const Vec3 a = face.corners[pass.side];
        const Vec3 b = face.corners[(pass.side + 1) % 3];
        return pass.top - pass.height <= slack_ ? 0.5 * (a + b) : dot(up_, a) <= dot(up_, b) ? a : b;
    }

    [[nodiscard]] std::vector<Pass>::const_iterator nearestExit() const
    {
        return std::min_element(exits_.begin(), exits_.end(), [&](const Pass& a, const Pass& b) {
            return ranked(length(placeOf(a) - liquid_.place)) < ranked(length(placeOf(b) - liquid_.place));
        });
    }

    [[nodiscard]] Hollow over(const Pass& pass) const
    {
        const Flooded sum = filled();
        const double held = heldBy(sum);
        if (held >= liquid_.volume) {
            return {std::nullopt, held};
        }
        const FlowSurface::Face& from = faces_[pass.face];
        const std::uint32_t next = from.neighbour[pass.side];
        const bool is_open = next == FlowSurface::kNone;
        Brim result{is_open ? pass.face : next, placeOf(pass), {}, is_open, sum.volume, held};
        const Vec3 way = is_open ? -1.0 * from.inward[pass.side] : faces_[next].corners[lowestOf(next)] - result.place;
        result.ahead = (1.0 / length(way)) * way;
        return {result, 0.0};
    }

    const std::vector<FlowSurface::Face>& faces_;
    Vec3 up_;
    const RestingLiquid& liquid_;
    double slack_;          ///< [m]
    bool is_flat_ = false;  ///< the droplet lies on level ground
    double bottom_ = 0.0;
    double level_ = 0.0;
    std::unordered_set<std::uint32_t> flooded_;
    std::vector<Pass> exits_;  ///< downward from level ground
    std::priority_queue<Pass, std::vector<Pass>, std::greater<>> passes_;
};

}  // namespace

Hollow hollowAround(const FlowSurface& surface, Vec3 up, const RestingLiquid& liquid)
{
    return Flood(surface, up, liquid).run();
}

}  // namespace droplet
