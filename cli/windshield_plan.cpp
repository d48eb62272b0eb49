// SPDX-License-Identifier: GPL-3.0-or-later
#include "windshield_plan.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "droplet/io/object.h"
#include "droplet/wind_io/read_drive_cycle.h"
#include "option_values.h"

namespace cli {
namespace {

using droplet::Error;
using droplet::ErrorCode;

/// A drive cycle that begins at 0, held to what the options are held to.
/// @param whole  all of it is to be played
droplet::DriveCycle driveCycleFrom(const std::string& path, bool whole)
{
    droplet::DriveCycle cycle = droplet::readDriveCycle(path);
    const auto refuse_file = [&](const std::string& words) {
        throw Error(ErrorCode::InvalidInput, path + ": " + words);
    };
    constexpr double kFastest = 150.0;  // as of --speed
    const double fastest = *std::max_element(cycle.speeds.begin(), cycle.speeds.end());
    if (fastest > kFastest) {
        refuse_file(fmt::format("goes at {:.6g} m/s; a car may go at 150 m/s at most", fastest));
    }
    const double first = cycle.times.front();
    for (double& time : cycle.times) {
        time -= first;
    }
    constexpr double kLongest = 86400.0;  // as of --time
    if (whole && cycle.times.back() > kLongest) {
        refuse_file("lasts longer than 24h: --time tells how much of it to play");
    }
    return cycle;
}

/// The glass that a surface is, and a warning if it is not one that can be rolled out.
droplet::Glass glassFrom(const std::string& surface, std::vector<std::string>& warnings)
{
    const droplet::TexturedMesh object = droplet::readObject(surface);
    droplet::Glass glass = forOption(surface, [&] { return droplet::Glass(object, {}); });
    constexpr double kBent = 0.02;
    if (glass.maxStretch() > 1.0 + kBent || glass.minStretch() < 1.0 - kBent) {
        warnings.push_back(
            fmt::format("{}: rolled out by its uv, lengths are {:.3g} to {:.3g} times what they are on the rolled out "
                        "glass",
                        surface, glass.minStretch(), glass.maxStretch()));
    }
    return glass;
}

/// A surface may face away from the rain, above all if its triangles are the wrong way round.
void requireRain(const std::string& surface, const droplet::WindshieldParameters& parameters)
{
    const droplet::Glass& glass = parameters.glass;
    const double speed = *std::max_element(parameters.vehicle.speeds.begin(), parameters.vehicle.speeds.end());
    constexpr double kFastestRaindrop = 9.65;  // [m/s], Atlas
    constexpr int kPlaces = 32;
    for (int j = 0; j < kPlaces; ++j) {
        for (int i = 0; i < kPlaces; ++i) {
            const auto place = glass.place({(i + 0.5) / kPlaces * glass.width(), (j + 0.5) / kPlaces * glass.height()});
            if (place && kFastestRaindrop * place->normal.z + speed * place->normal.y > 0.0) {
                return;
            }
        }
    }
    throw Error(ErrorCode::InvalidInput,
                surface + ": no rain meets it: its triangles face downward, backward or inward");
}

}  // namespace

WindshieldPlan planOf(const WindshieldOptions& options)
{
    WindshieldPlan plan;
    plan.parameters = options.parameters;
    droplet::WindshieldParameters& parameters = plan.parameters;
    if (options.drive_cycle) {
        parameters.vehicle = driveCycleFrom(*options.drive_cycle, !options.duration);
    }
    if (options.surface) {
        parameters.glass = glassFrom(*options.surface, plan.warnings);
    }
    if (options.wiper) {
        parameters.wipers = droplet::tandemWipers(parameters.glass, *options.wiper);
    }
    const double duration = options.duration.value_or(options.drive_cycle ? parameters.vehicle.times.back() : 10.0);
    // The cycle begins with the first frame.
    for (double& time : parameters.vehicle.times) {
        time += options.warm_up;
    }
    forGlass(options, [&] { parameters.validate(); });
    if (options.surface) {
        requireRain(*options.surface, parameters);
    }
    plan.frames =
        std::max<std::size_t>(static_cast<std::size_t>(std::llround(duration * options.frames_per_second)), 1);
    // No step is longer than a sixtieth of a second, and each frame is one.
    constexpr double kLongest = 1.0 / 60.0;
    plan.steps = static_cast<std::size_t>(std::ceil(1.0 / (kLongest * options.frames_per_second) - 1e-9));
    plan.step = 1.0 / (options.frames_per_second * static_cast<double>(plan.steps));
    return plan;
}

}  // namespace cli
