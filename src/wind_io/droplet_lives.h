// SPDX-License-Identifier: GPL-3.0-or-later
// What a scene holds of droplets before a file's form is known.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <queue>
#include <vector>

#include "droplet/units.h"
#include "droplet/vector.h"
#include "droplet/windshield/glass.h"
#include "droplet/windshield/running_shape.h"
#include "droplet/windshield/windshield.h"

namespace droplet {

/// Normals of droplets are right to this, some micrometres at a rim.
inline constexpr double kFacing = 1.5 * kDegree;

/// Where, which way and how large a droplet is, in the file's frame: +Y up, +Z ahead.
struct DropletPose {
    std::array<float, 3> place{};                       ///< [m]
    std::array<float, 4> turn{0.0F, 0.0F, 0.0F, 1.0F};  ///< x along its way, y off the glass
    float along = 0.0F;                                 ///< scale of a cap of contact radius 1 m along its way
    float across = 0.0F;                                ///< and across it, also its height's
    bool moves = false;

    friend bool operator==(const DropletPose&, const DropletPose&) = default;

    /// Of the cap of the same volume [m].
    [[nodiscard]] float restRadius() const;
    /// Off the glass.
    [[nodiscard]] Vec3 normal() const;
    /// Whether it may be shown in the other's place, wherever that is: its contact radius at rest is right to 1 %,
    /// its outline to a quarter of its width, and it faces where the other does, to kFacing.
    [[nodiscard]] bool looksLike(const DropletPose& other) const;
};

/// From this frame on.
struct DropletSample {
    std::uint32_t frame = 0;
    DropletPose pose;
};

struct DropletLife {
    std::vector<DropletSample> samples;  ///< where something changes, in the order of frames; at least one
    std::uint32_t end = 0;               ///< the first frame without it

    [[nodiscard]] std::uint32_t begin() const { return samples.front().frame; }
    /// @param frame  from begin() to end - 1
    [[nodiscard]] const DropletPose& at(std::uint32_t frame) const;
};

/// Follows droplets from frame to frame.
class DropletLives {
public:
    DropletLives(const Glass& glass, const ShapeOptions& shape) : glass_(glass), shape_(shape) {}

    void add(const WindshieldState& state);

    [[nodiscard]] std::uint32_t frames() const { return frames_; }
    [[nodiscard]] std::size_t max() const { return max_; }          ///< droplets at once
    [[nodiscard]] std::size_t samples() const { return samples_; }  ///< of all lives
    /// All lives in the order of their beginnings, as long as this lives unchanged.
    [[nodiscard]] std::vector<const DropletLife*> all() const;

private:
    [[nodiscard]] DropletPose poseOf(const RunningDroplet& droplet, const GlassPlace& place,
                                     const DropletLife& life) const;

    Glass glass_;
    ShapeOptions shape_;
    std::map<std::uint64_t, DropletLife> lives_;  ///< by id
    std::vector<DropletLife> earlier_;            ///< of droplets that came back
    std::uint32_t frames_ = 0;
    std::size_t max_ = 0;
    std::size_t samples_ = 0;
};

/// From the vehicle's frame, y ahead and z up, to the file's.
Vec3 inFile(Vec3 v);

/// A vector turned by a quaternion, x first, w last.
Vec3 turnedBy(const std::array<float, 4>& turn, Vec3 v);

/// Hands spans of time to as few slots as there are spans at once, each slot's with a pause in between.
///
/// Guarantees: a slot is taken again as soon as it may be; the lowest free one first.
/// @param spans  with members begin and end, in the order of begin
/// @param pause  from one's end to the next one's begin, at least [frames]
/// @return       for each slot numbers of its spans, in order
template <typename Span>
std::vector<std::vector<std::size_t>> pooled(const std::vector<Span>& spans, std::uint32_t pause)
{
    using Entry = std::pair<std::uint32_t, std::size_t>;  // when it is free again, slot
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> taken;
    std::priority_queue<std::size_t, std::vector<std::size_t>, std::greater<>> free;
    std::vector<std::vector<std::size_t>> slots;
    for (std::size_t i = 0; i < spans.size(); ++i) {
        while (!taken.empty() && taken.top().first <= spans[i].begin) {
            free.push(taken.top().second);
            taken.pop();
        }
        std::size_t slot = slots.size();
        if (free.empty()) {
            slots.emplace_back();
        } else {
            slot = free.top();
            free.pop();
        }
        slots[slot].push_back(i);
        taken.emplace(spans[i].end + pause, slot);
    }
    return slots;
}

}  // namespace droplet
