// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <iosfwd>

#include "droplet/windshield/running_shape.h"
#include "droplet/windshield/windshield.h"

namespace droplet {

enum class TableFormat { Csv, Json };

/// Which droplets have a row: all that may run, or only those that do.
enum class DropletRows { All, Moving };

/// Droplets that may run, frame by frame, as a table: a row for each droplet and frame. Nothing is kept: rows go to the
/// stream as they come.
///
/// Columns, all in SI units: frame, time_s, id, x_m and y_m on the rolled out glass, velocity_x_m_per_s,
/// velocity_y_m_per_s, volume_m3, contact_radius_m and length_m of its footprint. Numbers are the shortest that read
/// back as the same doubles, times those of whole nanoseconds: steps add up to them but for rounding. CSV has a header;
/// JSON is an object with `schema` "droplet-shape.windshield-droplets/1", `columns` and `rows`, an array of arrays.
class DropletTable {
public:
    /// Writes what stands before the first row.
    /// @param out    must outlive the table
    DropletTable(std::ostream& out, TableFormat format, const ShapeOptions& shape);

    void add(std::size_t frame, const WindshieldState& state, DropletRows which = DropletRows::All);

    /// Writes what stands behind the last row. The stream is left failed if it did not take everything.
    void finish();

private:
    std::ostream& out_;
    TableFormat format_;
    ShapeOptions shape_;
    bool has_rows_ = false;
};

}  // namespace droplet
