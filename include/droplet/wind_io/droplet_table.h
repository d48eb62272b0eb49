// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <iosfwd>
#include <memory>

#include "droplet/body/running_shape.h"
#include "droplet/io/table_format.h"
#include "droplet/windshield/windshield.h"

namespace droplet {

class TableRows;

/// Choice of the droplets that have a row.
enum class DropletRows {
    All,     ///< all running droplets, also those at rest
    Moving,  ///< only droplets that move
};

/// Table of running droplets with a row for each droplet and frame. Rows are written at once; nothing is kept in
/// memory.
///
/// Columns, all in SI units: frame, time_s, id, x_m and y_m on the unrolled glass, velocity_x_m_per_s,
/// velocity_y_m_per_s, volume_m3, contact_radius_m and length_m of its footprint. Numbers are the shortest that read
/// back as the same doubles; times are rounded to whole nanoseconds. CSV has a header; JSON is an object with `schema`
/// "droplet-shape.windshield-droplets/1", `columns` and `rows`, an array of arrays.
class DropletTable {
public:
    /// Writes the text before the first row.
    /// @param out     must outlive the table
    /// @param format  file format
    /// @param shape   shape of the droplets, for their footprints
    DropletTable(std::ostream& out, TableFormat format, const ShapeOptions& shape);
    ~DropletTable();
    DropletTable(DropletTable&&) noexcept;             ///< Moves the table.
    DropletTable& operator=(DropletTable&&) noexcept;  ///< Moves the table.

    /// Writes the rows of one frame.
    void add(std::size_t frame, const WindshieldState& state, DropletRows which = DropletRows::All);

    /// Writes the text after the last row. The stream is in a failed state if a write failed.
    void finish();

private:
    std::unique_ptr<TableRows> rows_;
    ShapeOptions shape_;
};

}  // namespace droplet
