// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow_plan.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "droplet/flow/scatter.h"
#include "droplet/flow_io/read_flow_start.h"
#include "droplet/flow_io/read_object_motion.h"
#include "option_values.h"

namespace cli {
namespace {

constexpr double kDefaultDuration = 5.0;  // [s]

/// What of a mesh droplets have to get over.
void warnOfDefects(const droplet::FlowSurfaceReport& report, const std::string& path,
                   std::vector<std::string>& warnings)
{
    const auto warn = [&](std::size_t count, const char* what) {
        if (count > 0) {
            warnings.push_back(fmt::format("{}: {} of {} triangles {}", path, count, report.triangles, what));
        }
    };
    warn(report.without_area, "have no area and are left out");
    warn(report.duplicates, "are duplicates and are left out");
    warn(report.turned, "face the other way than their neighbours and are turned");
}

std::vector<droplet::FlowStart> startsOf(const FlowOptions& options, const FlowPlan& plan)
{
    std::vector<droplet::FlowStart> starts;
    if (options.start) {
        starts = droplet::readFlowStart(*options.start);
    }
    if (options.drops > 0) {
        droplet::ScatterOptions scatter;
        scatter.count = options.drops;
        scatter.volumes = options.volumes;
        scatter.from = options.from;
        scatter.seed = plan.parameters.seed;
        const auto scattered = forOption("--drops", [&] { return droplet::scatterDroplets(plan.scene, scatter); });
        starts.insert(starts.end(), scattered.begin(), scattered.end());
    }
    return starts;
}

}  // namespace

FlowPlan planOf(const FlowOptions& options)
{
    droplet::FlowObject object = droplet::readFlowObject(*options.object, options.reading);
    droplet::FlowSurface surface =
        forOption(*options.object, [&] { return droplet::flowSurface(object.positions, object.triangles); });
    FlowPlan plan{std::move(object), droplet::FlowScene(std::move(surface)), options.parameters, {}, 1, {}};
    plan.warnings = plan.object.warnings;
    warnOfDefects(plan.scene.surface().report, *options.object, plan.warnings);
    if (options.keeps_animation) {
        plan.parameters.motion = plan.object.motion;
    } else if (options.motion) {
        plan.parameters.motion = droplet::readObjectMotion(*options.motion);
    }
    plan.starts = startsOf(options, plan);
    const double duration = options.duration.value_or(kDefaultDuration);
    plan.frames =
        std::max<std::size_t>(static_cast<std::size_t>(std::llround(duration * options.frames_per_second)), 1);
    return plan;
}

}  // namespace cli
