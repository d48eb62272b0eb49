// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/flow_io/flow_table.h"

#include <array>
#include <cstdint>

#include "axes.h"
#include "io/table_rows.h"

namespace droplet {
namespace {

constexpr std::array<const char*, 11> kColumns{
    "frame",     "time_s", "id", "x_m", "y_m", "z_m", "velocity_x_m_per_s", "velocity_y_m_per_s", "velocity_z_m_per_s",
    "volume_m3", "face"};

}  // namespace

FlowTable::FlowTable(std::ostream& out, TableFormat format)
    : rows_(std::make_unique<TableRows>(out, format, "droplet-shape.flow-droplets/1", kColumns))
{
}

FlowTable::~FlowTable() = default;
FlowTable::FlowTable(FlowTable&&) noexcept = default;
FlowTable& FlowTable::operator=(FlowTable&&) noexcept = default;

void FlowTable::add(std::size_t frame, double time, std::span<const FlowSample> samples, const FlowSurface& surface)
{
    for (const FlowSample& sample : samples) {
        rows_->beginRow(frame, time, sample.id);
        for (const Vec3 v : {yUp(sample.place), yUp(sample.velocity)}) {
            for (const double number : {v.x, v.y, v.z}) {
                rows_->add(number + 0.0);  // never −0
            }
        }
        rows_->add(sample.volume);
        rows_->add(sample.face ? static_cast<std::int64_t>(surface.faces[*sample.face].source) : -1);
        rows_->endRow();
    }
    rows_->writeRows();
}

void FlowTable::finish()
{
    rows_->finish();
}

}  // namespace droplet
