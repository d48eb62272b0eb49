// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/table_rows.h"

#include <ostream>

namespace droplet {

TableRows::TableRows(std::ostream& out, TableFormat format, const char* schema, std::span<const char* const> columns)
    : out_(out), format_(format)
{
    const bool is_json = format_ == TableFormat::Json;
    std::string head = is_json ? std::string("{\"schema\":\"") + schema + "\",\n\"columns\":[" : "";
    for (std::size_t i = 0; i < columns.size(); ++i) {
        head += i > 0 ? "," : "";
        head += is_json ? std::string("\"") + columns[i] + '"' : columns[i];
    }
    out_ << head << (is_json ? "],\n\"rows\":[" : "\n");
}

void TableRows::beginRow(std::size_t frame, double time, std::uint64_t id)
{
    if (format_ == TableFormat::Json) {
        rows_ += has_rows_ ? ",\n[" : "\n[";
    }
    has_rows_ = true;
    is_first_ = true;
    append(frame);
    append(time, std::chars_format::fixed);
    append(id);
}

void TableRows::endRow()
{
    rows_ += format_ == TableFormat::Json ? ']' : '\n';
}

void TableRows::writeRows()
{
    out_ << rows_;
    rows_.clear();
}

void TableRows::finish()
{
    writeRows();
    if (format_ == TableFormat::Json) {
        out_ << "\n]}\n";
    }
    out_.flush();
}

}  // namespace droplet
