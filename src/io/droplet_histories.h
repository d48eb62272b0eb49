// SPDX-License-Identifier: GPL-3.0-or-later
// Droplets of a scene over time, independent of the file format.
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

namespace droplet {

/// Tolerance of the normals of droplets; it shifts a rim by some micrometres.
inline constexpr double kFacing = 1.5 * kDegree;

/// Position, direction and size of a droplet in the file's frame, +Y up. Sizes are scales of a mesh with the volume of
/// a cap of contact radius 1 m.
struct DropletPose {
    std::array<float, 3> place{};                       ///< [m]
    std::array<float, 4> turn{0.0F, 0.0F, 0.0F, 1.0F};  ///< rotation: x along the motion, y off the ground
    float along = 0.0F;                                 ///< scale along the motion
    float across = 0.0F;                                ///< scale across the motion
    float up = 0.0F;                                    ///< scale of the height
    bool moves = false;                                 ///< over the ground
    bool airborne = false;
    std::uint32_t face = 0;   ///< of ground that deforms
    std::uint32_t shape = 0;  ///< of this ground

    friend bool operator==(const DropletPose&, const DropletPose&) = default;

    /// Contact radius of the cap of the same volume [m].
    [[nodiscard]] float restRadius() const;
    /// Direction off the ground.
    [[nodiscard]] Vec3 normal() const;
    /// Whether it may replace the other pose, apart from the place: their contact radii at rest differ by at most 1 %,
    /// their outlines by a quarter of the width, and their normals by kFacing.
    [[nodiscard]] bool looksLike(const DropletPose& other) const;
};

/// Pose from a frame on.
struct DropletSample {
    std::uint32_t frame = 0;
    DropletPose pose;
};

/// Poses of one droplet over time.
struct DropletHistory {
    std::vector<DropletSample> samples;  ///< changes of the pose, in the order of frames; at least one
    std::uint32_t end = 0;               ///< first frame without the droplet

    [[nodiscard]] std::uint32_t begin() const { return samples.front().frame; }
    /// @param frame  from begin() to end - 1
    [[nodiscard]] const DropletPose& at(std::uint32_t frame) const;
};

/// Follows droplets from frame to frame.
class DropletHistories {
public:
    /// Pose of a droplet in the frame before, or null.
    [[nodiscard]] const DropletPose* last(std::uint64_t id) const;

    /// Adds a droplet to the frame.
    void add(std::uint64_t id, const DropletPose& pose);
    /// Begins the next frame.
    void endFrame();

    [[nodiscard]] std::uint32_t frames() const { return frames_; }
    [[nodiscard]] std::size_t maxCount() const { return max_count_; }  ///< largest number of droplets at once
    [[nodiscard]] std::size_t samples() const { return samples_; }     ///< number of samples of all histories
    /// All histories in the order of their first frames; the pointers are valid until the next add().
    [[nodiscard]] std::vector<const DropletHistory*> all() const;

private:
    std::map<std::uint64_t, DropletHistory> current_;  ///< by id
    std::vector<DropletHistory> earlier_;              ///< former histories of droplets that came back
    std::uint32_t frames_ = 0;
    std::size_t count_ = 0;  ///< number of droplets in the frame
    std::size_t max_count_ = 0;
    std::size_t samples_ = 0;
};

/// Quaternion of the rotation that turns the coordinate axes to x, y and z; x first, w last.
std::array<float, 4> turnTo(Vec3 x, Vec3 y, Vec3 z);

/// Vector rotated by a quaternion, x first, w last.
Vec3 turnedBy(const std::array<float, 4>& turn, Vec3 v);

/// Assigns spans of time to the smallest number of slots, with a pause between the spans of a slot.
///
/// Guarantees: a span gets the lowest slot that is free.
/// @param spans  spans with members begin and end, in the order of begin
/// @param pause  smallest distance from the end of a span to the begin of the next one [frames]
/// @return       for each slot the indices of its spans, in order
template <typename Span>
std::vector<std::vector<std::size_t>> assignSlots(const std::vector<Span>& spans, std::uint32_t pause)
{
    using Entry = std::pair<std::uint32_t, std::size_t>;  // frame from which the slot is free, slot
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
