// SPDX-License-Identifier: GPL-3.0-or-later
#include "csv_table.h"

#include <charconv>
#include <cmath>
#include <utility>

#include "droplet/error.h"
#include "file_bytes.h"

namespace droplet {
namespace {

std::string trimmed(std::string_view text)
{
    const auto is_space = [](char c) { return c == ' ' || c == '\t'; };
    while (!text.empty() && is_space(text.front())) {
        text.remove_prefix(1);
    }
    while (!text.empty() && is_space(text.back())) {
        text.remove_suffix(1);
    }
    return std::string(text);
}

std::vector<std::string> fieldsOf(std::string_view line)
{
    std::vector<std::string> fields(1);
    bool quoted = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const char c = line[i];
        if (c == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"') {
            fields.back() += '"';
            ++i;
        } else if (c == '"') {
            quoted = !quoted;
        } else if (c == ',' && !quoted) {
            fields.emplace_back();
        } else {
            fields.back() += c;
        }
    }
    for (std::string& field : fields) {
        field = trimmed(field);
    }
    return fields;
}

}  // namespace

CsvTable::CsvTable(std::string_view text, std::string name, std::string_view gap)
    : name_(std::move(name)), gap_(gap.empty() ? "" : ": " + std::string(gap))
{
    if (text.substr(0, 3) == "\xEF\xBB\xBF") {
        text.remove_prefix(3);
    }
    std::size_t empty = 0;  // first empty line since the last row
    for (std::size_t number = 1; !text.empty(); ++number) {
        const std::size_t end = text.find('\n');
        std::string_view line = text.substr(0, end);
        text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
        if (!line.empty() && line.back() == '\r') {
            line.remove_suffix(1);
        }
        if (trimmed(line).empty()) {
            empty = empty == 0 ? number : empty;
            continue;
        }
        Row row{number, fieldsOf(line)};
        if (!header_) {
            header_ = std::move(row);
            empty = 0;
            continue;
        }
        if (row.fields.size() > header_->fields.size()) {
            refuse(number, "has " + std::to_string(row.fields.size()) + " cells, the header has " +
                               std::to_string(header_->fields.size()) +
                               ": write decimals with a point, and quote fields that contain a comma");
        }
        if (empty != 0) {
            refuse(empty, "is empty" + gap_);
        }
        rows_.push_back(std::move(row));
    }
}

std::optional<std::size_t> CsvTable::columnWhere(const std::function<bool(const std::string&)>& is_it) const
{
    std::optional<std::size_t> found;
    for (std::size_t c = 0; header_ && c < header_->fields.size(); ++c) {
        if (!is_it(header_->fields[c])) {
            continue;
        }
        if (found) {
            refuse(header_->number,
                   "has both '" + header_->fields[*found] + "' and '" + header_->fields[c] + "'; one of them must go");
        }
        found = c;
    }
    return found;
}

std::optional<std::size_t> CsvTable::columnNamed(std::string_view heading) const
{
    return columnWhere([heading](const std::string& other) { return other == heading; });
}

std::vector<std::size_t> CsvTable::columnsNamed(const std::vector<std::string_view>& headings) const
{
    std::vector<std::size_t> columns;
    for (const std::string_view heading : headings) {
        if (const std::optional<std::size_t> column = columnNamed(heading)) {
            columns.push_back(*column);
        }
    }
    if (!columns.empty() && columns.size() < headings.size()) {
        std::string all;
        for (const std::string_view heading : headings) {
            all += (all.empty() ? "" : ", ") + std::string(heading);
        }
        refuse(header_->number, "must have all of the headings " + all + ", or none");
    }
    return columns;
}

double CsvTable::number(const Row& row, std::size_t column, std::string_view what) const
{
    if (column >= row.fields.size() || row.fields[column].empty()) {
        refuse(row.number, "has no " + std::string(what) + gap_);
    }
    const std::string& field = row.fields[column];
    double value = 0.0;
    const char* end = field.data() + field.size();
    const auto [stop, error] = std::from_chars(field.data() + (field[0] == '+' ? 1 : 0), end, value);
    if (error != std::errc() || stop != end || !std::isfinite(value)) {
        refuse(row.number, std::string(what) + " is '" + field.substr(0, 40) + "'; it must be a finite number");
    }
    return value;
}

double CsvTable::number(const Row& row, std::size_t column) const
{
    return number(row, column, header_->fields[column]);
}

Vec3 CsvTable::vector(const Row& row, const std::vector<std::size_t>& columns) const
{
    return {number(row, columns[0]), number(row, columns[1]), number(row, columns[2])};
}

void CsvTable::refuse(std::size_t row, const std::string& what) const
{
    throw Error(ErrorCode::InvalidInput, name_ + ": row " + std::to_string(row) + ": " + what);
}

void CsvTable::refuse(const std::string& what) const
{
    throw Error(ErrorCode::InvalidInput, name_ + ": " + what);
}

std::string readTable(const std::filesystem::path& path)
{
    constexpr std::size_t kMaxBytes = std::size_t{1} << 28U;
    std::string text;
    readFile(path, [&] {
        const Bytes bytes = readBytes(path, kMaxBytes, [](std::byte) { return true; });
        text.assign(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    });
    return text;
}

}  // namespace droplet
