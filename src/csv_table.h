// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "droplet/vector.h"

namespace droplet {

/// Rows of numbers from CSV text (RFC 4180, except line breaks within quotes). Errors name the file and the row.
class CsvTable {
public:
    struct Row {
        std::size_t number = 0;           ///< in the file, from 1
        std::vector<std::string> fields;  ///< without quotes and blanks around them
    };

    /// Splits a text into rows; empty lines at its end are ignored.
    /// @param text   UTF-8, with or without a byte order mark; lines end in LF or CRLF
    /// @param name   name of the file for error messages
    /// @param gap    what an empty line between rows or an empty cell means, for error messages; or empty
    /// @throws Error InvalidInput, as all functions do: a row has more cells than the header, or a line is empty
    CsvTable(std::string_view text, std::string name, std::string_view gap = {});

    /// First row that is not empty; empty if there is none.
    [[nodiscard]] const std::optional<Row>& header() const { return header_; }
    /// All rows below the header.
    [[nodiscard]] const std::vector<Row>& rows() const { return rows_; }
    /// The column whose heading satisfies a condition; two such columns are refused.
    [[nodiscard]] std::optional<std::size_t> columnWhere(const std::function<bool(const std::string&)>& is_it) const;
    /// The column with exactly this heading; two such columns are refused.
    [[nodiscard]] std::optional<std::size_t> columnNamed(std::string_view heading) const;
    /// Columns with these headings: all or none.
    /// @return  empty if there is none of them
    [[nodiscard]] std::vector<std::size_t> columnsNamed(const std::vector<std::string_view>& headings) const;
    /// Number in a cell; errors name it `what`.
    [[nodiscard]] double number(const Row& row, std::size_t column, std::string_view what) const;
    /// Number in a cell; errors name it as its heading does.
    [[nodiscard]] double number(const Row& row, std::size_t column) const;
    /// Numbers in the first three of some columns.
    [[nodiscard]] Vec3 vector(const Row& row, const std::vector<std::size_t>& columns) const;
    /// Throws an error about a row.
    [[noreturn]] void refuse(std::size_t row, const std::string& what) const;
    /// Throws an error about the file.
    [[noreturn]] void refuse(const std::string& what) const;

private:
    std::string name_;
    std::string gap_;  ///< with a colon before it
    std::optional<Row> header_;
    std::vector<Row> rows_;
};

/// Text of a CSV file.
/// @throws Error InvalidInput if it cannot be read
std::string readTable(const std::filesystem::path& path);

}  // namespace droplet
