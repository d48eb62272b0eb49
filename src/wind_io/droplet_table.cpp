// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/wind_io/droplet_table.h"

#include <array>
#include <charconv>
#include <ostream>
#include <string>

#include "wind_io/rounded_time.h"

namespace droplet {
namespace {

constexpr std::array<const char*, 10> kColumns{
    "frame",     "time_s",           "id",      "x_m", "y_m", "velocity_x_m_per_s", "velocity_y_m_per_s",
    "volume_m3", "contact_radius_m", "length_m"};

/// Appends a number.
/// @param format  std::chars_format of a floating-point number
template <typename Number, typename... Format>
void append(std::string& row, Number number, Format... format)
{
    std::array<char, 32> room{};
    const auto end = std::to_chars(room.data(), room.data() + room.size(), number, format...).ptr;
    if (!row.empty() && row.back() != '[') {
        row += ',';
    }
    row.append(room.data(), end);
}

}  // namespace

DropletTable::DropletTable(std::ostream& out, TableFormat format, const ShapeOptions& shape)
    : out_(out), format_(format), shape_(shape)
{
    shape_.validate();
    const bool is_json = format_ == TableFormat::Json;
    std::string head = is_json ? "{\"schema\":\"droplet-shape.windshield-droplets/1\",\n\"columns\":[" : "";
    for (std::size_t i = 0; i < kColumns.size(); ++i) {
        head += i > 0 ? "," : "";
        head += is_json ? std::string("\"") + kColumns[i] + '"' : kColumns[i];
    }
    out_ << head << (is_json ? "],\n\"rows\":[" : "\n");
}

void DropletTable::add(std::size_t frame, const WindshieldState& state, DropletRows which)
{
    std::string rows;
    const double time = roundedTime(state.time);
    for (const RunningDroplet& droplet : state.droplets) {
        if (which == DropletRows::Moving && droplet.velocity == Vec2{}) {
            continue;
        }
        const RunningShape shape = runningShape(droplet.volume, length(droplet.velocity), shape_);
        std::string row = format_ == TableFormat::Json ? "[" : "";
        append(row, frame);
        append(row, time, std::chars_format::fixed);
        append(row, droplet.id);
        for (const double number :
             {droplet.position.x, droplet.position.y, droplet.velocity.x, droplet.velocity.y, droplet.volume,
              shape.contact_radius, 2.0 * (shape.half_length + shape.contact_radius)}) {
            append(row, number);
        }
        if (format_ == TableFormat::Json) {
            rows += has_rows_ ? ",\n" : "\n";
            row += ']';
        } else {
            row += '\n';
        }
        has_rows_ = true;
        rows += row;
    }
    out_ << rows;
}

void DropletTable::finish()
{
    if (format_ == TableFormat::Json) {
        out_ << "\n]}\n";
    }
    out_.flush();
}

}  // namespace droplet
