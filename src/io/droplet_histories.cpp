// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/droplet_histories.h"

#include <cmath>
#include <utility>

#include "byte_stream.h"

namespace droplet {
namespace {

std::array<double, 4> quaternion(Vec3 x, Vec3 y, Vec3 z)
{
    // S. W. Shepperd, "Quaternion from rotation matrix", J. Guidance and Control 1 (1978) 223: divides by the largest.
    const double trace = x.x + y.y + z.z;
    const std::array<double, 4> squares{1.0 + 2.0 * x.x - trace, 1.0 + 2.0 * y.y - trace, 1.0 + 2.0 * z.z - trace,
                                        1.0 + trace};
    const auto max = static_cast<std::size_t>(std::max_element(squares.begin(), squares.end()) - squares.begin());
    const double s = 0.5 / std::sqrt(squares[max]);
    const double xy = x.y + y.x;
    const double yz = y.z + z.y;
    const double zx = z.x + x.z;
    const double wx = y.z - z.y;
    const double wy = z.x - x.z;
    const double wz = x.y - y.x;
    switch (max) {
        case 0:
            return {s * squares[0], s * xy, s * zx, s * wx};
        case 1:
            return {s * xy, s * squares[1], s * yz, s * wy};
        case 2:
            return {s * zx, s * yz, s * squares[2], s * wz};
        default:
            return {s * wx, s * wy, s * wz, s * squares[3]};
    }
}

}  // namespace

float DropletPose::restRadius() const
{
    return std::cbrt(along * across * up);
}

Vec3 DropletPose::normal() const
{
    return turnedBy(turn, {0.0, 1.0, 0.0});
}

bool DropletPose::looksLike(const DropletPose& other) const
{
    constexpr float kRadius = 0.01F;
    constexpr float kOutline = 0.25F;
    double cosine = 0.0;  // cosine of half the angle between the two
    for (std::size_t i = 0; i < 4; ++i) {
        cosine += static_cast<double>(turn[i] * other.turn[i]);
    }
    const double square = std::min(cosine * cosine, 1.0);
    const double sine = square < 0.5 ? 1.0 : 2.0 * std::sqrt(square * (1.0 - square));
    const float aside = static_cast<float>(sine) * (other.along - other.across);
    const bool faces = dot(normal(), other.normal()) > std::cos(kFacing);
    const float off = std::max({aside, std::abs(along - other.along), std::abs(across - other.across)});
    return faces && std::abs(restRadius() - other.restRadius()) <= kRadius * other.restRadius() &&
           off <= kOutline * other.across;
}

const DropletPose& DropletHistory::at(std::uint32_t frame) const
{
    const auto after = std::upper_bound(samples.begin(), samples.end(), frame,
                                        [](std::uint32_t f, const DropletSample& sample) { return f < sample.frame; });
    return (after - 1)->pose;
}

std::array<float, 4> turnTo(Vec3 x, Vec3 y, Vec3 z)
{
    const std::array<double, 4> turn = quaternion(x, y, z);
    return {toFloat(turn[0]), toFloat(turn[1]), toFloat(turn[2]), toFloat(turn[3])};
}

Vec3 turnedBy(const std::array<float, 4>& turn, Vec3 v)
{
    const Vec3 u{static_cast<double>(turn[0]), static_cast<double>(turn[1]), static_cast<double>(turn[2])};
    const Vec3 t = 2.0 * cross(u, v);
    return v + static_cast<double>(turn[3]) * t + cross(u, t);
}

const DropletPose* DropletHistories::last(std::uint64_t id) const
{
    const auto found = current_.find(id);
    return found != current_.end() && found->second.end == frames_ ? &found->second.samples.back().pose : nullptr;
}

void DropletHistories::add(std::uint64_t id, const DropletPose& pose)
{
    ++count_;
    DropletHistory& history = current_[id];
    if (!history.samples.empty() && history.end < frames_) {
        earlier_.push_back(std::exchange(history, {}));
    }
    if (history.samples.empty() || history.samples.back().pose != pose) {
        history.samples.push_back({frames_, pose});
        ++samples_;
    }
    history.end = frames_ + 1;
}

void DropletHistories::endFrame()
{
    max_count_ = std::max(max_count_, count_);
    count_ = 0;
    ++frames_;
}

std::vector<const DropletHistory*> DropletHistories::all() const
{
    std::vector<const DropletHistory*> all;
    all.reserve(earlier_.size() + current_.size());
    for (const DropletHistory& history : earlier_) {
        all.push_back(&history);
    }
    for (const auto& [id, history] : current_) {
        if (!history.samples.empty()) {
            all.push_back(&history);
        }
    }
    std::stable_sort(all.begin(), all.end(),
                     [](const DropletHistory* a, const DropletHistory* b) { return a->begin() < b->begin(); });
    return all;
}

}  // namespace droplet
