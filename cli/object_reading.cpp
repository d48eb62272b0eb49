// SPDX-License-Identifier: GPL-3.0-or-later
#include "object_reading.h"

#include "droplet/units.h"
#include "option_target.h"
#include "option_values.h"

namespace cli {

void declareReading(CommandLine& line, const char* group, droplet::ObjectOptions& reading, const std::string& when)
{
    constexpr Range kSize{droplet::Dimension::Length, 1e-4, 1e3, "from 0.1mm to 1000m"};
    line.add(group, "--scale", "NUMBER", when + "Factor on the lengths of the file [1]",
             into(reading.scale, NumberRange{1e-9, 1e9, "a number from 1e-9 to 1e9"}));
    line.add(group, "--object-size,--size", "LENGTH", when + "Longest side of the object, 0.1mm to 1000m; scales it",
             into(reading.size, kSize));
    line.exclude({"--scale", "--object-size"});
    line.add(group, "--up", when + "Axis that points up in an .obj, .ply or .stl [y, of .ply z]",
             into(reading.up, {{"y", droplet::UpAxis::Y}, {"z", droplet::UpAxis::Z}}));
}

}  // namespace cli
