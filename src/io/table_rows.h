// SPDX-License-Identifier: GPL-3.0-or-later
// Tables of numbers as CSV or JSON.
#pragma once

#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <span>
#include <string>

#include "droplet/io/table_format.h"

namespace droplet {

/// Writes a table of droplets row by row. Its first columns are frame, time_s and id. Numbers are the shortest that
/// read back as the same doubles. JSON is an object with `schema`, `columns`
/// and `rows`, an array of arrays.
class TableRows {
public:
    /// Writes the text before the first row.
    /// @param out      must outlive the table
    /// @param schema   of JSON
    /// @param columns  names
    TableRows(std::ostream& out, TableFormat format, const char* schema, std::span<const char* const> columns);

    void beginRow(std::size_t frame, double time, std::uint64_t id);
    template <typename Number>
    void add(Number number)
    {
        append(number);
    }
    void endRow();

    /// Writes the rows since the last call to the stream.
    void writeRows();
    /// Writes the text after the last row. The stream is in a failed state if a write failed.
    void finish();

private:
    /// @param format  std::chars_format of a floating-point number
    template <typename Number, typename... Format>
    void append(Number number, Format... format)
    {
        std::array<char, 32> room{};
        const auto end = std::to_chars(room.data(), room.data() + room.size(), number, format...).ptr;
        if (!is_first_) {
            rows_ += ',';
        }
        is_first_ = false;
        rows_.append(room.data(), end);
    }

    std::ostream& out_;
    TableFormat format_;
    std::string rows_;
    bool has_rows_ = false;
    bool is_first_ = true;  ///< of its row
};

}  // namespace droplet
