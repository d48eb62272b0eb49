// SPDX-License-Identifier: GPL-3.0-or-later
#include "object_options.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

#include "droplet/units.h"

namespace cli {

void declarePinning(CommandLine& line, const char* group, droplet::FlowPinning& pinning)
{
    constexpr Range kVaries{droplet::Dimension::Length, 1e-4, 1.0, "from 0.1mm to 1m"};
    line.add(group, "--pinning", "NUMBER",
             "How much hysteresis varies over the surface, so that droplets stick, slip and wander: standard deviation "
             "of its logarithm, 0 to 1.5",
             into(pinning.spread, {0.0, 1.5, "a number from 0 to 1.5"}));
    line.add(group, "--pinning-length", "LENGTH", "Length over which it varies", into(pinning.length, kVaries));
}

namespace {

void turn(droplet::Vec3& v)
{
    v = {v.x, v.z, 0.0 - v.y};
}

}  // namespace

void turnToFile(droplet::Surface& surface, droplet::Format format, const droplet::ObjectOptions& reading)
{
    const bool is_z_up_file = format == droplet::Format::Ply || format == droplet::Format::Stl;
    if (!is_z_up_file || reading.up == droplet::UpAxis::Z) {
        return;
    }
    std::for_each(surface.vertices.begin(), surface.vertices.end(), turn);
    std::for_each(surface.normals.begin(), surface.normals.end(), turn);
}

void turnToFile(std::vector<droplet::FlowPoint>& points, const droplet::ObjectOptions& reading)
{
    if (reading.up == droplet::UpAxis::Z) {
        return;
    }
    for (droplet::FlowPoint& point : points) {
        turn(point.place);
        turn(point.velocity);
        std::for_each(point.axes.begin(), point.axes.end(), turn);
    }
}

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
    warn(report.inside_out,
         "face inward, as their closed part is inside out, and are turned; to mend the file, recalculate its normals "
         "outside");
    warn(report.turned - report.inside_out, "face the other way than their neighbours and are turned");
    const std::size_t sides = 3 * (report.triangles - report.without_area - report.duplicates);
    if (report.parts > 1 && 2 * report.boundary_edges > sides) {
        warnings.push_back(fmt::format(
            "{}: {} of {} sides of triangles have no neighbour, in {} parts, so droplets that run soon fall off; "
            "join the corners "
            "that should be one (merge by distance)",
            path, report.boundary_edges, sides, report.parts));
    }
}

}  // namespace cli
