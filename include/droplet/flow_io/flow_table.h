// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <iosfwd>
#include <memory>
#include <span>

#include "droplet/flow/flow.h"
#include "droplet/flow/flow_surface.h"
#include "droplet/io/table_format.h"

namespace droplet {

class TableRows;

/// Table of droplets on an object with a row for each droplet and frame. Rows are written at once; nothing is kept in
/// memory.
///
/// Columns, all in SI units: frame, time_s, id, x_m, y_m, z_m, velocity_x_m_per_s, velocity_y_m_per_s,
/// velocity_z_m_per_s, volume_m3 and face. Places and velocities are in the object's frame, +Y up. The face is the
/// number of the triangle in the object's mesh, −1 in the air. Numbers are the shortest that read back as the same
/// doubles; times are rounded to whole nanoseconds. CSV has a header; JSON is an object with `schema`
/// "droplet-shape.flow-droplets/1", `columns` and `rows`, an array of arrays.
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
    /// @param frame    number of the frame
    /// @param time     [s]
    /// @param samples  of that time
    /// @param surface  that the samples' faces belong to
    void add(std::size_t frame, double time, std::span<const FlowSample> samples, const FlowSurface& surface);

    /// Writes the text after the last row. The stream is in a failed state if a write failed.
    void finish();

private:
    std::unique_ptr<TableRows> rows_;
};

}  // namespace droplet
