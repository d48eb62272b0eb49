// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/flow_io/flow_table.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "axes.h"
#include "io/table_rows.h"

namespace droplet {
namespace {

constexpr std::array<const char*, 18> kColumns{"frame",
                                               "time_s",
                                               "id",
                                               "x_m",
                                               "y_m",
                                               "z_m",
                                               "velocity_x_m_per_s",
                                               "velocity_y_m_per_s",
                                               "velocity_z_m_per_s",
                                               "volume_m3",
                                               "face",
                                               "radius_m",
                                               "elongation",
                                               "rotation_x",
                                               "rotation_y",
                                               "rotation_z",
                                               "rotation_w",
                                               "age_s"};

}  // namespace

FlowTable::FlowTable(std::ostream& out, TableFormat format)
    : rows_(std::make_unique<TableRows>(out, format, "droplet-shape.flow-droplets/1", kColumns))
{
}

FlowTable::~FlowTable() = default;
FlowTable::FlowTable(FlowTable&&) noexcept = default;
FlowTable& FlowTable::operator=(FlowTable&&) noexcept = default;

void FlowTable::add(std::size_t frame, double time, std::span<const FlowPoint> points)
{
    for (const FlowPoint& point : points) {
        rows_->beginRow(frame, time, point.id);
        for (const Vec3 v : {yUp(point.place), yUp(point.velocity)}) {
            for (const double number : {v.x, v.y, v.z}) {
                rows_->add(number + 0.0);  // never −0
            }
        }
        rows_->add(point.volume);
        rows_->add(point.face ? static_cast<std::int64_t>(*point.face) : -1);
        FlowPoint turned = point;
        std::transform(point.axes.begin(), point.axes.end(), turned.axes.begin(), yUp);
        const auto [x, y, z, w] = rotationOf(turned);
        for (const double number : {point.radius, point.elongation, x, y, z, w, point.age}) {
            rows_->add(number);
        }
        rows_->endRow();
    }
    rows_->writeRows();
}

void FlowTable::finish()
{
    rows_->finish();
}

}  // namespace droplet
