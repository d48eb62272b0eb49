// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <iosfwd>
#include <memory>
#include <span>

#include "droplet/flow_io/flow_points.h"
#include "droplet/io/table_format.h"

namespace droplet {

class TableRows;

/// Table of droplets on an object with a row for each droplet and frame. Rows are written at once; nothing is kept in
/// memory.
///
/// Columns, all in SI units: frame, time_s, id, x_m, y_m, z_m, velocity_x_m_per_s, velocity_y_m_per_s,
/// velocity_z_m_per_s, volume_m3, face, radius_m, elongation, rotation_x, rotation_y, rotation_z, rotation_w and age_s,
/// as in FlowPoint. Places, velocities and rotations are in the object's frame, +Y up. The face is the number of the
/// triangle in the object's mesh, −1 in the air. A rotation turns x ahead and z to the ground's normal. Numbers are the
/// shortest that read back as the same doubles; times are rounded to whole nanoseconds. CSV has a header; JSON is an
/// object with `schema` "droplet-shape.flow-droplets/1", `columns` and `rows`, an array of arrays.
class FlowTable {
public:
    /// Writes the text before the first row.
    /// @param out     must outlive the table
    /// @param format  file format
    FlowTable(std::ostream& out, TableFormat format);
    ~FlowTable();
    FlowTable(FlowTable&&) noexcept;             ///< Moves the table.
    FlowTable& operator=(FlowTable&&) noexcept;  ///< Moves the table.

    /// Writes the rows of one frame.
    /// @param frame   number of the frame
    /// @param time    [s]
    /// @param points  of that time
    void add(std::size_t frame, double time, std::span<const FlowPoint> points);

    /// Writes the text after the last row. The stream is in a failed state if a write failed.
    void finish();

private:
    std::unique_ptr<TableRows> rows_;
};

}  // namespace droplet
