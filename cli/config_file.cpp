// SPDX-License-Identifier: GPL-3.0-or-later
//
// toml++ replaces CLI11's own reader, which skips lines of one or two characters, cuts strings at a '#' and reads a key
// without a value as true.
#include "config_file.h"

#include <fmt/core.h>
#include <toml++/toml.h>

#include <algorithm>

#include "droplet/error.h"
#include "text_lines.h"

namespace cli {
namespace {

/// Lines of the file, for error messages.
class Lines {
public:
    explicit Lines(const std::string& path) : path_(path)
    {
        for (const std::string& line : readLines("--config", path)) {
            lines_.push_back(line.substr(0, line.find_last_not_of(" \t\r") + 1));
        }
    }

    [[nodiscard]] std::string text() const
    {
        std::string all;
        for (const std::string& line : lines_) {
            all += line + "\n";
        }
        return all;
    }

    [[noreturn]] void refuse(std::size_t line, const std::string& reason) const
    {
        const std::string quoted = line > 0 && line <= lines_.size() ? "'" + lines_[line - 1] + "' " : "the end ";
        throw droplet::Error(droplet::ErrorCode::InvalidArgument,
                             fmt::format("--config: {}:{}: {}{}", path_, line, quoted, reason));
    }

private:
    std::string path_;
    std::vector<std::string> lines_;
};

std::string textOf(const toml::node& value)
{
    if (value.is_string()) {
        return *value.value<std::string>();
    }
    if (value.is_boolean()) {
        return fmt::format("{}", *value.value<bool>());
    }
    return fmt::format("{}", *value.value<double>());
}

}  // namespace

std::vector<ConfigEntry> readConfig(const std::string& path)
{
    const Lines lines(path);
    std::vector<ConfigEntry> entries;
    try {
        for (const auto& [key, value] : toml::parse(lines.text())) {
            const std::size_t line = value.source().begin.line;
            if (value.is_table()) {
                lines.refuse(line, "begins a table; only 'key = value' is allowed");
            }
            if (!value.is_string() && !value.is_boolean() && !value.is_number()) {
                lines.refuse(line, "must have a number, true, false or text in quotes as value");
            }
            entries.push_back({std::string(key.str()), textOf(value), static_cast<int>(line)});
        }
    } catch (const toml::parse_error& error) {
        const std::string description(error.description());  // "Error while parsing string: unknown escape sequence"
        const auto colon = description.find(": ");
        lines.refuse(error.source().begin.line,
                     "is not TOML: " + (colon == std::string::npos ? description : description.substr(colon + 2)) +
                         "; lines are of the form 'key = value', with text in quotes: width = \"8cm\"");
    }
    std::sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) { return a.line < b.line; });
    return entries;
}

}  // namespace cli
