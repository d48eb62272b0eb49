// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/liquid2d/particle_frame.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "droplet/error.h"
#include "number_text.h"

namespace droplet {
namespace {

void requireSize(const char* field, std::size_t size, std::size_t count)
{
    if (size != count) {
        throw Error(ErrorCode::InvalidInput, fmt::format("{} has {} values for {} particles", field, size, count));
    }
}

}  // namespace

void ParticleFrame::validate() const
{
    if (!(spacing > 0.0) || !std::isfinite(spacing)) {
        throw Error(ErrorCode::InvalidInput,
                    fmt::format("spacing is {}, must be finite and more than 0 m", numberText(spacing)));
    }
    requireSize("velocity", velocity.size(), position.size());
    requireSize("id", id.size(), position.size());
    if (!density.empty()) {
        requireSize("density", density.size(), position.size());
    }
    const auto is_finite = [](Vec2 a) { return std::isfinite(a.x) && std::isfinite(a.y); };
    for (std::size_t i = 0; i < position.size(); ++i) {
        if (!is_finite(position[i]) || !is_finite(velocity[i]) || (!density.empty() && !std::isfinite(density[i]))) {
            throw Error(ErrorCode::InvalidInput, fmt::format("particle {} has a number that is not finite", id[i]));
        }
    }
    std::vector<std::uint32_t> sorted = id;
    std::sort(sorted.begin(), sorted.end());
    if (const auto twice = std::adjacent_find(sorted.begin(), sorted.end()); twice != sorted.end()) {
        throw Error(ErrorCode::InvalidInput, fmt::format("two particles have the id {}", *twice));
    }
}

}  // namespace droplet
