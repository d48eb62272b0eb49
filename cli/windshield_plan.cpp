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

/// Reads a drive cycle and moves its beginning to 0; the limits are those of --speed and --time.
/// @param whole  whether all of the cycle is shown
droplet::DriveCycle driveCycleFrom(const std::string& path, bool whole)
{
    droplet::DriveCycle cycle = droplet::readDriveCycle(path);
    const auto refuse_file = [&](const std::string& reason) {
        throw Error(ErrorCode::InvalidInput, path + ": " + reason);
    };
    constexpr double kFastest = 150.0;  // limit of --speed
    const double fastest = *std::max_element(cycle.speeds.begin(), cycle.speeds.end());
    if (fastest > kFastest) {
        refuse_file(fmt::format("has a speed of {:.6g} m/s; at most 150 m/s is allowed", fastest));
    }
    const double first = cycle.times.front();
    for (double& time : cycle.times) {
        time -= first;
    }
    constexpr double kLongest = 86400.0;  // limit of --time
    if (whole && cycle.times.back() > kLongest) {
        refuse_file("lasts longer than 24h; give --time to show a part of it");
    }
    return cycle;
}

/// Reads the glass from a surface, and adds a warning if its texture coordinates do not preserve lengths.
droplet::Glass glassFrom(const std::string& surface, std::vector<std::string>& warnings)
{
    const droplet::TexturedMesh object = droplet::readObject(surface);
    droplet::Glass glass = forOption(surface, [&] { return droplet::Glass(object, {}); });
    constexpr double kMaxError = 0.02;
    if (glass.maxStretch() > 1.0 + kMaxError || glass.minStretch() < 1.0 - kMaxError) {
        warnings.push_back(fmt::format(
            "{}: droplets will be distorted: lengths on the surface are {:.3g} to {:.3g} times those in its "
            "texture coordinates; unwrap it with less distortion",
            surface, glass.minStretch(), glass.maxStretch()));
    }
    return glass;
}

/// Refuses a surface that faces away from the rain everywhere, as it does if its triangles have the wrong winding.
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
    throw Error(
        ErrorCode::InvalidInput,
        surface +
            ": rain cannot reach it: its triangles face downward, backward or inward; normals must point outward");
}

std::size_t framesIn(double duration, const WindshieldOptions& options)
{
    return std::max<std::size_t>(static_cast<std::size_t>(std::llround(duration * options.frames_per_second)), 1);
}

}  // namespace

std::optional<std::size_t> frameCount(const WindshieldOptions& options)
{
    constexpr double kDefault = 10.0;  // [s]
    return options.drive_cycle && !options.duration
               ? std::nullopt
               : std::optional(framesIn(options.duration.value_or(kDefault), options));
}

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
    const double duration = options.drive_cycle ? parameters.vehicle.times.back() : 0.0;
    // The cycle begins at the first frame.
    for (double& time : parameters.vehicle.times) {
        time += options.warm_up;
    }
    forGlass(options, [&] { parameters.validate(); });
    if (options.surface) {
        requireRain(*options.surface, parameters);
    }
    plan.frames = frameCount(options).value_or(framesIn(duration, options));
    // A frame is a whole number of steps of at most a sixtieth of a second.
    constexpr double kLongest = 1.0 / 60.0;
    plan.steps = static_cast<std::size_t>(std::ceil(1.0 / (kLongest * options.frames_per_second) - 1e-9));
    plan.step = 1.0 / (options.frames_per_second * static_cast<double>(plan.steps));
    return plan;
}

}  // namespace cli
