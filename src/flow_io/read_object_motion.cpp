// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/flow_io/read_object_motion.h"

#include <cmath>
#include <cstddef>
#include <vector>

#include "axes.h"
#include "csv_table.h"
#include "number_text.h"

namespace droplet {

ObjectMotion parseObjectMotion(std::string_view text, const std::string& name)
{
    const CsvTable table(text, name);
    if (!table.header()) {
        table.refuse("a motion needs a header and at least one row");
    }
    const std::optional<std::size_t> time = table.columnNamed("time_s");
    const std::vector<std::size_t> place = table.columnsNamed({"x_m", "y_m", "z_m"});
    const std::vector<std::size_t> axis = table.columnsNamed({"rotation_x", "rotation_y", "rotation_z", "rotation_w"});
    if (!time || (place.empty() && axis.empty())) {
        table.refuse(table.header()->number,
                     "needs the headings time_s, and x_m, y_m, z_m or rotation_x, rotation_y, rotation_z, rotation_w");
    }
    if (table.rows().empty()) {
        table.refuse("a motion needs a header and at least one row");
    }
    ObjectMotion motion;
    for (const CsvTable::Row& row : table.rows()) {
        ObjectMotion::Key key;
        key.time = table.number(row, *time);
        if (!motion.keys.empty() && key.time <= motion.keys.back().time) {
            table.refuse(row.number, "time_s is " + numberText(key.time) + "; it must be more than " +
                                         numberText(motion.keys.back().time) + ", the time of the key before");
        }
        if (!place.empty()) {
            key.pose.place = zUp(table.vector(row, place));
        }
        if (!axis.empty()) {
            const Vec3 vector = zUp(table.vector(row, axis));
            const double real = table.number(row, axis[3]);
            const double size = std::hypot(length(vector), real);
            if (!(size > 0.0 && std::isfinite(size))) {
                table.refuse(row.number, "its rotation has the length " + numberText(size) + "; it must be 1");
            }
            key.pose.axis = (1.0 / size) * vector;
            key.pose.real = real / size;
        }
        motion.keys.push_back(key);
    }
    return motion;
}

ObjectMotion readObjectMotion(const std::filesystem::path& path)
{
    return parseObjectMotion(readTable(path), path.string());
}

}  // namespace droplet
