// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/flow/flow_parameters.h"

#include <cmath>
#include <string>

#include "require.h"
#include "wind/random.h"

namespace droplet {
namespace {

bool isFinite(Vec3 v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool atLeastZero(double value)
{
    return value >= 0.0 && std::isfinite(value);
}

bool aboveZero(double value)
{
    return value > 0.0 && std::isfinite(value);
}

template <typename Value>
void requireFaces(const std::vector<Value>& values, std::size_t faces, const char* field)
{
    if (!values.empty() && values.size() != faces) {
        refuseValue(field, values.size(), "empty or " + std::to_string(faces) + " values, one for each face");
    }
}

}  // namespace

double VolumeDistribution::at(double u, double v) const
{
    return median * std::exp(spread * normal(u, v));
}

void VolumeDistribution::validate() const
{
    require(aboveZero(median), "volumes.median", median, "finite and more than 0 m3");
    require(spread >= 0.0 && spread <= 3.0, "volumes.spread", spread, "from 0 to 3");
}

void FlowPinning::validate() const
{
    require(spread >= 0.0 && spread <= 1.5, "pinning.spread", spread, "from 0 to 1.5");
    require(aboveZero(length), "pinning.length", length, "finite and more than 0 m");
}

void FlowParameters::validate(std::size_t faces) const
{
    forces.validate();
    motion.validate();
    require(isFinite(gravity), "gravity", length(gravity), "finite");
    require(isFinite(wind), "wind", length(wind), "finite");
    if (friction) {
        require(atLeastZero(*friction), "friction", *friction, "finite and at least 0 kg/s");
    }
    if (adhesion) {
        require(atLeastZero(*adhesion), "adhesion", *adhesion, "finite and at least 0 Pa");
    }
    require(atLeastZero(roughness), "roughness", roughness, "finite and at least 0 m");
    requireFaces(ground.roughness, faces, "ground.roughness");
    requireFaces(ground.friction, faces, "ground.friction");
    requireFaces(ground.hysteresis, faces, "ground.hysteresis");
    requireFaces(ground.contact_angle, faces, "ground.contact_angle");
    for (const Vec2 height : ground.roughness) {
        require(atLeastZero(height.x), "ground.roughness", height.x, "finite and at least 0 m");
        require(atLeastZero(height.y), "ground.roughness", height.y, "finite and at least 0 m");
    }
    for (const double factor : ground.friction) {
        require(atLeastZero(factor), "ground.friction", factor, "finite and at least 0");
    }
    for (const double factor : ground.hysteresis) {
        require(atLeastZero(factor), "ground.hysteresis", factor, "finite and at least 0");
    }
    for (const double angle : ground.contact_angle) {
        Wetting wetting = forces.wetting;
        wetting.contact_angle = angle;
        wetting.validate();
    }
    pinning.validate();
    streaks.validate();
    if (drying) {
        require(aboveZero(*drying), "drying", *drying, "finite and more than 0 s");
    }
    for (const FlowEmitter& emitter : emitters) {
        require(isFinite(emitter.place), "emitter.place", length(emitter.place), "finite");
        require(atLeastZero(emitter.rate), "emitter.rate", emitter.rate, "finite and at least 0 m3/s");
        emitter.volumes.validate();
    }
    if (rain) {
        require(atLeastZero(rain->rainfall), "rain.rainfall", rain->rainfall, "finite and at least 0 m/s");
        require(aboveZero(length(rain->from)), "rain.from", length(rain->from), "a direction that is not 0");
        rain->raindrops.validate();
        require(rain->small_diameter > 0.0 && rain->small_diameter < rain->raindrops.max, "rain.small_diameter",
                rain->small_diameter, "more than 0 m and less than the largest raindrop");
    }
    if (condensation) {
        require(atLeastZero(condensation->rate), "condensation.rate", condensation->rate, "finite and at least 0 m/s");
        require(aboveZero(condensation->spacing), "condensation.spacing", condensation->spacing,
                "finite and more than 0 m");
    }
    require(aboveZero(small_volume), "small_volume", small_volume, "finite and more than 0 m3");
    require(aboveZero(step), "step", step, "finite and more than 0 s");
}

}  // namespace droplet
