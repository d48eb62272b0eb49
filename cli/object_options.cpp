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

double plainOr(const Given& given, const Range& range)
{
    if (const auto plain = finiteNumber(given.text)) {
        if (*plain < range.min || *plain > range.max) {
            refuse(given, range.allowed);
        }
        return *plain;
    }
    return quantity(given, range);
}

std::vector<Given> partsOf(const Given& given)
{
    std::vector<Given> parts;
    std::string_view rest = given.text;
    for (;;) {
        const std::size_t comma = rest.find(',');
        parts.push_back({std::string(rest.substr(0, comma)), given.subject});
        if (comma == std::string_view::npos) {
            return parts;
        }
        rest.remove_prefix(comma + 1);
    }
}

Vec3 vector(const Given& given, const Range& range)
{
    const std::vector<Given> parts = partsOf(given);
    if (parts.size() != 3) {
        refuse(given, "three numbers x,y,z");
    }
    const double x = plainOr(parts[0], range);
    const double y = plainOr(parts[1], range);
    const double z = plainOr(parts[2], range);
    return {x, 0.0 - z, y};
}

Vec3 direction(const Given& given)
{
    constexpr Range kNumber{Dimension::Length, -1e6, 1e6, "three numbers x,y,z from -1e6 to 1e6"};
    const Vec3 d = vector(given, kNumber);
    if (!(length(d) > 0.0)) {
        refuse(given, "a direction x,y,z other than 0,0,0");
    }
    return (1.0 / length(d)) * d;
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
