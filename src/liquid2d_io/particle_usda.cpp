// SPDX-License-Identifier: GPL-3.0-or-later
// Pixar, "OpenUSD": UsdGeomPoints, and its text format.
#include "droplet/liquid2d_io/particle_usda.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <ostream>
#include <tuple>

#include "byte_stream.h"
#include "droplet/version.h"
#include "require.h"

namespace droplet {
namespace {

std::array<float, 2> pairOf(Vec2 v)
{
    return {toFloat(v.x), toFloat(v.y)};
}

/// Writes a list of values, each by write_value(value).
template <typename Values, typename WriteValue>
void writeList(ByteStream& bytes, const Values& values, const WriteValue& write_value)
{
    bytes.u8('[');
    for (std::size_t i = 0; i < values.size(); ++i) {
        bytes.text(i > 0 ? ", " : "");
        write_value(values[i]);
    }
    bytes.u8(']');
}

}  // namespace

ParticleUsda::ParticleUsda(double frames_per_second) : frames_per_second_(frames_per_second)
{
    require(frames_per_second > 0.0 && std::isfinite(frames_per_second), "frames_per_second", frames_per_second,
            "a finite number above 0");
}

void ParticleUsda::add(const ParticleFrame& frame)
{
    spacing_ = frame.spacing;
    Frame& kept = frames_.emplace_back();
    for (std::size_t i = 0; i < frame.position.size(); ++i) {
        kept.position.push_back(pairOf(frame.position[i]));
        kept.velocity.push_back(pairOf(frame.velocity[i]));
    }
    kept.id = frame.id;
    for (const double density : frame.density) {
        kept.density.push_back(toFloat(density));
    }
}

void ParticleUsda::write(std::ostream& out) const
{
    ByteStream bytes(out);
    bytes.text(fmt::format("#usda 1.0\n(\n    defaultPrim = \"liquid\"\n    doc = \"droplet-shape {}\"\n", kVersion));
    const auto line = [&](const char* name, double number) {
        bytes.text(fmt::format("    {} = ", name));
        bytes.digits(number);
        bytes.u8('\n');
    };
    line("endTimeCode", static_cast<double>(std::max<std::size_t>(frames_.size(), 1) - 1));
    line("framesPerSecond", frames_per_second_);
    line("metersPerUnit", 1.0);
    line("startTimeCode", 0.0);
    line("timeCodesPerSecond", frames_per_second_);
    bytes.text("    upAxis = \"Y\"\n)\n\ndef Points \"liquid\"\n{\n");
    const auto over_time = [&](const char* declaration, const auto& write_value) {
        bytes.text(fmt::format("    {}.timeSamples = {{", declaration));
        for (std::size_t k = 0; k < frames_.size(); ++k) {
            bytes.text(fmt::format("{}\n        {}: ", k > 0 ? "," : "", k));
            write_value(frames_[k]);
        }
        bytes.text("\n    }\n");
    };
    const auto write_float = [&](float value) { bytes.digits(value); };
    const auto write_place = [&](const Pair& pair) {
        bytes.u8('(');
        bytes.digits(pair[0]);
        bytes.text(", ");
        bytes.digits(pair[1]);
        bytes.text(", 0)");
    };
    const float radius = toFloat(0.5 * spacing_);
    over_time("float3[] extent", [&](const Frame& frame) {
        Pair lower{};
        Pair upper{};
        for (std::size_t axis = 0; axis < 2 && !frame.position.empty(); ++axis) {
            const auto [least, most] =
                std::minmax_element(frame.position.begin(), frame.position.end(),
                                    [axis](const Pair& a, const Pair& b) { return a[axis] < b[axis]; });
            lower[axis] = (*least)[axis] - radius;
            upper[axis] = (*most)[axis] + radius;
        }
        for (const auto& [text, corner, z] : {std::tuple{"[(", lower, -radius}, std::tuple{", (", upper, radius}}) {
            bytes.text(text);
            for (const float number : corner) {
                bytes.digits(number);
                bytes.text(", ");
            }
            bytes.digits(z);
            bytes.u8(')');
        }
        bytes.u8(']');
    });
    over_time("int64[] ids",
              [&](const Frame& frame) { writeList(bytes, frame.id, [&](std::uint32_t id) { bytes.digits(id); }); });
    over_time("point3f[] points", [&](const Frame& frame) { writeList(bytes, frame.position, write_place); });
    const auto has_density = [](const Frame& frame) { return frame.density.size() == frame.position.size(); };
    if (std::all_of(frames_.begin(), frames_.end(), has_density)) {
        bytes.text("    float[] primvars:density (\n        interpolation = \"vertex\"\n    )\n");
        over_time("float[] primvars:density",
                  [&](const Frame& frame) { writeList(bytes, frame.density, write_float); });
    }
    over_time("vector3f[] velocities", [&](const Frame& frame) { writeList(bytes, frame.velocity, write_place); });
    bytes.text("    float[] widths = [");
    write_float(2.0F * radius);
    bytes.text("] (\n        interpolation = \"constant\"\n    )\n}\n");
    bytes.finish();
}

}  // namespace droplet
