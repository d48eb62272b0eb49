// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/wind_io/droplet_table.h"

#include <array>

#include "io/rounded_time.h"
#include "io/table_rows.h"

namespace droplet {
namespace {

constexpr std::array<const char*, 10> kColumns{
    "frame",     "time_s",           "id",      "x_m", "y_m", "velocity_x_m_per_s", "velocity_y_m_per_s",
    "volume_m3", "contact_radius_m", "length_m"};

}  // namespace

DropletTable::DropletTable(std::ostream& out, TableFormat format, const ShapeOptions& shape) : shape_(shape)
{
    shape_.validate();
    rows_ = std::make_unique<TableRows>(out, format, "droplet-shape.windshield-droplets/1", kColumns);
}

DropletTable::~DropletTable() = default;
DropletTable::DropletTable(DropletTable&&) noexcept = default;
DropletTable& DropletTable::operator=(DropletTable&&) noexcept = default;

void DropletTable::add(std::size_t frame, const WindshieldState& state, DropletRows which)
{
    for (const RunningDroplet& droplet : state.droplets) {
        if (which == DropletRows::Moving && droplet.velocity == Vec2{}) {
            continue;
        }
        const RunningShape shape = runningShape(droplet.volume, length(droplet.velocity), shape_);
        rows_->beginRow(frame, roundedTime(state.time), droplet.id);
        for (const double number :
             {droplet.position.x, droplet.position.y, droplet.velocity.x, droplet.velocity.y, droplet.volume,
              shape.contact_radius, 2.0 * (shape.half_length + shape.contact_radius)}) {
            rows_->add(number);
        }
        rows_->endRow();
    }
    rows_->writeRows();
}

void DropletTable::finish()
{
    rows_->finish();
}

}  // namespace droplet
