// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/liquid2d/fluid_scene.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "require.h"

namespace droplet {
namespace {

bool isFinite(Vec2 a)
{
    return std::isfinite(a.x) && std::isfinite(a.y);
}

void requireFinite(Vec2 value, const std::string& field)
{
    if (!isFinite(value)) {
        throw Error(ErrorCode::InvalidArgument,
                    fmt::format("{} is ({}, {}), must be finite", field, numberText(value.x), numberText(value.y)));
    }
}

/// Number of spacings to which places are exact enough.
constexpr double kFarthest = 1e9;

void validateRegion(const Region& region, double spacing, const std::string& field)
{
    for (const std::vector<Vec2>& loop : region.loops) {
        if (loop.size() < 3) {
            refuseValue(field + ".loops", loop.size(), "of at least three points each");
        }
        for (const Vec2 point : loop) {
            requireFinite(point, field + ".loops");
            if (!(std::max(std::abs(point.x), std::abs(point.y)) <= kFarthest * spacing)) {
                throw Error(ErrorCode::InvalidArgument,
                            fmt::format("{}.loops is ({}, {}), must be within {} m, 1e9 spacings, of the origin", field,
                                        numberText(point.x), numberText(point.y), numberText(kFarthest * spacing)));
            }
        }
    }
}

}  // namespace

void FluidScene::validate() const
{
    const auto positive = [](const char* field, double value, const char* constraint) {
        require(std::isfinite(value) && value > 0.0, field, value, constraint);
    };
    const auto not_negative = [](const char* field, double value, const char* constraint) {
        require(std::isfinite(value) && value >= 0.0, field, value, constraint);
    };
    positive("size.x", size.x, "finite and more than 0 m");
    positive("size.y", size.y, "finite and more than 0 m");
    positive("spacing", spacing, "finite and more than 0 m");
    requireFinite(gravity, "gravity");
    positive("density", density, "finite and more than 0 kg/m³");
    not_negative("surface_tension", surface_tension, "finite and at least 0 N/m");
    not_negative("viscosity", viscosity.value_or(0.0), "finite and at least 0 m²/s");
    not_negative("margin", margin, "finite and at least 0 m");
    // The grid of the neighbour search covers the window and its margin.
    const double cells =
        ((size.x + 2.0 * margin) / (2.0 * spacing) + 2.0) * ((size.y + 2.0 * margin) / (2.0 * spacing) + 2.0);
    require(cells <= 1e8, "spacing", spacing,
            "so large that the window and its margin hold no more than 4e8 particles");
    for (std::size_t k = 0; k < liquid.size(); ++k) {
        const std::string field = fmt::format("liquid[{}]", k);
        validateRegion(liquid[k].region, spacing, field + ".region");
        requireFinite(liquid[k].velocity, field + ".velocity");
        requireFinite({liquid[k].spin, 0.0}, field + ".spin");
    }
    for (std::size_t k = 0; k < walls.size(); ++k) {
        const std::string field = fmt::format("walls[{}]", k);
        validateRegion(walls[k].region, spacing, field + ".region");
        if (walls[k].motion) {
            const WallMotion& motion = *walls[k].motion;
            requireFinite(motion.amplitude, field + ".motion.amplitude");
            requireFinite(motion.pivot, field + ".motion.pivot");
            requireFinite({motion.swing, motion.phase}, field + ".motion.swing and phase");
            requireFinite({motion.begin, 0.0}, field + ".motion.begin");
            if (!(motion.period > 0.0) || !std::isfinite(motion.period)) {
                refuseValue(field + ".motion.period", motion.period, "finite and more than 0 s");
            }
        }
    }
    for (std::size_t k = 0; k < emitters.size(); ++k) {
        const std::string field = fmt::format("emitters[{}]", k);
        const Emitter& emitter = emitters[k];
        requireFinite(emitter.position, field + ".position");
        requireFinite(emitter.velocity, field + ".velocity");
        if (!(length(emitter.velocity) > 0.0)) {
            refuseValue(field + ".velocity", 0.0, "more than 0 m/s");
        }
        if (!(emitter.width > 0.0) || !std::isfinite(emitter.width)) {
            refuseValue(field + ".width", emitter.width, "finite and more than 0 m");
        }
        if (!std::isfinite(emitter.begin) || !std::isfinite(emitter.end)) {
            refuseValue(field + ".begin and end", emitter.begin, "finite");
        }
    }
}

}  // namespace droplet
