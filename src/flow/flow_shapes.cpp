// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/flow/flow_shapes.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "droplet/error.h"
#include "flow/flow_face.h"
#include "flow/following.h"
#include "require.h"

namespace droplet {
namespace {

// Terrains that are remembered: one that droplets leave, one that they go to, one that is shown.
constexpr std::size_t kRemembered = 3;

using Corners = std::array<Vec3, 3>;

/// The surface with other corners.
FlowSurface shaped(const FlowSurface& surface, const std::vector<Corners>& corners)
{
    FlowSurface result = surface;
    for (std::size_t f = 0; f < corners.size(); ++f) {
        if (result.faces[f].corners != corners[f]) {
            setCorners(result.faces[f], corners[f]);
        }
    }
    return result;
}

bool hasArea(const Corners& corners)
{
    const auto& [a, b, c] = corners;
    const double longest = std::max({length(b - a), length(c - b), length(a - c)});
    return length(cross(b - a, c - a)) > 2e-12 * longest * longest;  // as flowSurface() has it
}

}  // namespace

FlowShapes::FlowShapes(FlowSurface surface) : first_(std::make_shared<const FlowTerrain>(std::move(surface))) {}

FlowShapes::FlowShapes(FlowSurface surface, std::vector<Triangle> triangles, std::vector<std::vector<Vec3>> vertices,
                       double frames_per_second)
    : triangles_(std::move(triangles)), vertices_(std::move(vertices)), frames_per_second_(frames_per_second)
{
    require(!vertices_.empty(), "number of shapes", 0.0, "at least 1");
    require(frames_per_second > 0.0 && std::isfinite(frames_per_second), "frames_per_second", frames_per_second,
            "finite and more than 0");
    for (std::size_t shape = 0; shape < vertices_.size(); ++shape) {
        require(vertices_[shape].size() == vertices_.front().size(), "number of vertices of a shape",
                vertices_[shape].size(), "that of the first");
        for (const FlowSurface::Face& face : surface.faces) {
            const auto& [a, b, c] = triangles_[face.source];
            if (!hasArea({vertices_[shape][a], vertices_[shape][b], vertices_[shape][c]})) {
                throw Error(ErrorCode::InvalidInput, "triangle " + std::to_string(face.source) +
                                                         " has no area in frame " + std::to_string(shape + 1) + " of " +
                                                         std::to_string(vertices_.size()) +
                                                         ", but has one in the first; droplets cannot stand on it");
            }
        }
    }
    for (const FlowSurface::Face& face : surface.faces) {
        const auto& [a, b, c] = triangles_[face.source];
        auto& weights = weights_.emplace_back();
        for (std::size_t k = 0; k < 3; ++k) {
            weights[k] = weightsOn({vertices_[0][a], vertices_[0][b], vertices_[0][c]}, face.corners[k]);
            for (double& weight : weights[k]) {
                constexpr double kParts = 1 << 24;  // edges are halved: exact, so that neighbours have one edge
                weight = std::round(weight * kParts) / kParts;
            }
        }
    }
    rest_ = std::make_shared<const FlowSurface>(std::move(surface));
    first_ = std::make_shared<const FlowTerrain>(*rest_, motionAt(0), rest_);
}

std::vector<std::array<Vec3, 3>> FlowShapes::cornersAt(std::size_t shape) const
{
    std::vector<Corners> corners(weights_.size());
    if (vertices_[shape] == vertices_.front()) {  // the same numbers
        std::transform(rest_->faces.begin(), rest_->faces.end(), corners.begin(),
                       [](const FlowSurface::Face& face) { return face.corners; });
        return corners;
    }
    const std::vector<Vec3>& vertices = vertices_[shape];
    for (std::size_t f = 0; f < corners.size(); ++f) {
        const auto& [a, b, c] = triangles_[rest_->faces[f].source];
        for (std::size_t k = 0; k < 3; ++k) {
            corners[f][k] = mixed({vertices[a], vertices[b], vertices[c]}, weights_[f][k]);
        }
    }
    return corners;
}

FlowSurface::Face FlowShapes::faceAt(std::size_t shape, std::uint32_t face) const
{
    FlowSurface::Face result = first_->surface().faces[face];
    if (shape > 0) {
        const auto& [a, b, c] = triangles_[result.source];
        const std::vector<Vec3>& vertices = vertices_[shape];
        std::array<Vec3, 3> corners;
        for (std::size_t k = 0; k < 3; ++k) {
            corners[k] = mixed({vertices[a], vertices[b], vertices[c]}, weights_[face][k]);
        }
        setCorners(result, corners);
    }
    return result;
}

GroundMotion FlowShapes::motionAt(std::size_t shape) const
{
    GroundMotion motion;
    const std::size_t last = vertices_.size() - 1;
    motion.time = static_cast<double>(shape) / frames_per_second_;
    if (last == 0) {
        return motion;
    }
    // Differences of three shapes; the first and the last one have the acceleration of their neighbours.
    const std::size_t middle = last == 1 ? shape : std::clamp<std::size_t>(shape, 1, last - 1);
    const std::vector<Corners> before = cornersAt(middle == 0 ? 0 : middle - 1);
    const std::vector<Corners> now = cornersAt(middle);
    const std::vector<Corners> after = cornersAt(std::min(middle + 1, last));
    const double rate = frames_per_second_;
    const double off = static_cast<double>(shape) - static_cast<double>(middle);  // in frames
    bool rests = true;
    for (std::size_t f = 0; f < now.size(); ++f) {
        Corners& velocity = motion.velocity.emplace_back();
        Corners& acceleration = motion.acceleration.emplace_back();
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 onward = after[f][k] - now[f][k];
            const Vec3 until = now[f][k] - before[f][k];
            if (last == 1) {
                velocity[k] = rate * (onward + until);
            } else {
                const Vec3 change = onward - until;
                acceleration[k] = rate * rate * change;
                velocity[k] = rate * (0.5 * (onward + until) + off * change);
            }
            rests = rests && velocity[k] == Vec3{} && acceleration[k] == Vec3{};
        }
    }
    return rests ? GroundMotion{motion.time, {}, {}} : motion;
}

std::shared_ptr<const FlowTerrain> FlowShapes::at(std::size_t shape)
{
    if (shape == 0) {
        return first_;
    }
    const auto found = std::find_if(last_.begin(), last_.end(), [&](const auto& one) { return one.first == shape; });
    if (found != last_.end()) {
        return found->second;
    }
    if (last_.size() == kRemembered) {
        last_.erase(last_.begin());
    }
    last_.emplace_back(shape,
                       std::make_shared<const FlowTerrain>(shaped(*rest_, cornersAt(shape)), motionAt(shape), rest_));
    return last_.back().second;
}

std::size_t FlowShapes::ofStep(std::uint64_t step, double seconds) const
{
    constexpr double kRounding = 1e-9;  // of two that are equally near, the later one
    const double nearest =
        std::floor((static_cast<double>(step) + 0.5) * seconds * frames_per_second_ + 0.5 + kRounding);
    return std::min(static_cast<std::size_t>(nearest), count() - 1);
}

std::size_t FlowShapes::of(const FlowState& state, double seconds) const
{
    const bool is_within_step = state.time > static_cast<double>(state.steps) * seconds * (1.0 + 1e-12);
    if (is_within_step) {
        return ofStep(state.steps, seconds);
    }
    return state.steps == 0 ? 0 : ofStep(state.steps - 1, seconds);
}

}  // namespace droplet
