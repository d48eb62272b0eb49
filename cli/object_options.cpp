// SPDX-License-Identifier: GPL-3.0-or-later
#include "object_options.h"

#include <algorithm>
#include <string>
#include <string_view>

#include "droplet/units.h"

namespace cli {

using droplet::Dimension;
using droplet::Vec3;

void declareReading(CommandLine& line, const char* group, droplet::FlowObjectOptions& reading)
{
    constexpr Range kSize{Dimension::Length, 1e-4, 1e3, "from 0.1mm to 1000m"};
    line.add(group, "--scale", "NUMBER", "Factor on the lengths of the file [1]",
             into(reading.scale, NumberRange{1e-9, 1e9, "a number from 1e-9 to 1e9"}));
    line.add(group, "--object-size,--size", "LENGTH", "Longest side of the object; scales it",
             into(reading.size, kSize));
    line.exclude({"--scale", "--object-size"});
    line.add(group, "--up", "Axis that points up in an .obj, .ply or .stl [y, of .ply z]",
             into(reading.up, {{"y", droplet::UpAxis::Y}, {"z", droplet::UpAxis::Z}}));
}

namespace {

void turn(droplet::Vec3& v)
{
    v = {v.x, v.z, 0.0 - v.y};
}

}  // namespace

void turnToFile(droplet::Surface& surface, droplet::Format format, const droplet::FlowObjectOptions& reading)
{
    const bool is_z_up_file = format == droplet::Format::Ply || format == droplet::Format::Stl;
    if (!is_z_up_file || reading.up == droplet::UpAxis::Z) {
        return;
    }
    std::for_each(surface.vertices.begin(), surface.vertices.end(), turn);
    std::for_each(surface.normals.begin(), surface.normals.end(), turn);
}

void turnToFile(std::vector<droplet::FlowPoint>& points, const droplet::FlowObjectOptions& reading)
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

}  // namespace cli
