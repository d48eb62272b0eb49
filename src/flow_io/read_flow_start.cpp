// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/flow_io/read_flow_start.h"

#include <cstddef>

#include "axes.h"
#include "csv_table.h"
#include "number_text.h"

namespace droplet {

std::vector<FlowStart> parseFlowStart(std::string_view text, const std::string& name)
{
    const CsvTable table(text, name);
    if (!table.header()) {
        table.refuse("droplets need a header and at least one row");
    }
    const std::vector<std::size_t> place = table.columnsNamed({"x_m", "y_m", "z_m"});
    const std::vector<std::size_t> velocity =
        table.columnsNamed({"velocity_x_m_per_s", "velocity_y_m_per_s", "velocity_z_m_per_s"});
    const std::optional<std::size_t> volume = table.columnNamed("volume_m3");
    if (place.empty() || !volume) {
        table.refuse(table.header()->number, "needs the headings x_m, y_m, z_m and volume_m3");
    }
    if (table.rows().empty()) {
        table.refuse("droplets need a header and at least one row");
    }
    std::vector<FlowStart> starts;
    for (const CsvTable::Row& row : table.rows()) {
        FlowStart start;
        start.place = zUp(table.vector(row, place));
        start.volume = table.number(row, *volume);
        if (!velocity.empty()) {
            start.velocity = zUp(table.vector(row, velocity));
        }
        if (!(start.volume > 0.0)) {
            table.refuse(row.number, "volume_m3 is " + numberText(start.volume) + "; it must be more than 0");
        }
        starts.push_back(start);
    }
    return starts;
}

std::vector<FlowStart> readFlowStart(const std::filesystem::path& path)
{
    return parseFlowStart(readTable(path), path.string());
}

}  // namespace droplet
