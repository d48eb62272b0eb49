// SPDX-License-Identifier: GPL-3.0-or-later
//
// TOML 1.0 (toml.io), the part without tables and arrays. CLI11's own reader takes less care than a file of settings
// needs: it skips lines of one or two characters, cuts strings at a '#' and takes a key without value for true.
#include "config_file.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <string_view>
#include <system_error>

#include "droplet/error.h"

namespace cli {
namespace {

constexpr std::string_view kBlanks = " \t\r";

std::string_view trimmed(std::string_view text)
{
    const auto first = text.find_first_not_of(kBlanks);
    if (first == std::string_view::npos) {
        return {};
    }
    return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

bool isNumber(std::string_view text)
{
    double number = 0.0;
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
    return failure == std::errc{} && end == text.data() + text.size() && std::isfinite(number);
}

/// Reads one line after another; knows where it is, for messages.
class LineReader {
public:
    explicit LineReader(std::string path) : path_(std::move(path)) {}

    void read(std::string_view line, std::vector<ConfigEntry>& entries)
    {
        ++line_;
        line = trimmed(line);
        if (line.empty() || line.front() == '#') {
            return;
        }
        if (line.front() == '[') {
            refuse("tables are not known here, only 'key = value'");
        }
        const auto equals = line.find('=');
        if (equals == std::string_view::npos) {
            refuse("'" + std::string(line) + "' is not of the form 'key = value'");
        }
        const std::string key(trimmed(line.substr(0, equals)));
        const auto same_key = [&](const ConfigEntry& entry) { return entry.key == key; };
        if (std::any_of(entries.begin(), entries.end(), same_key)) {
            refuse("key '" + key + "' is given twice");
        }
        entries.push_back({key, value(key, trimmed(line.substr(equals + 1))), line_});
    }

private:
    [[noreturn]] void refuse(const std::string& reason) const
    {
        throw droplet::Error(droplet::ErrorCode::InvalidArgument,
                             "--config: " + path_ + ":" + std::to_string(line_) + ": " + reason);
    }

    std::string value(const std::string& key, std::string_view text) const
    {
        if (!text.empty() && (text.front() == '"' || text.front() == '\'')) {
            return quotedString(key, text);
        }
        std::string bare(trimmed(text.substr(0, text.find('#'))));
        if (bare != "true" && bare != "false" && !isNumber(bare)) {
            refuse("value '" + bare + "' of key '" + key + "' must be a number, true, false or text in quotes, as in " +
                   key + " = \"" + (bare.empty() ? "..." : bare) + "\"");
        }
        return bare;
    }

    /// A basic string "…" with escapes, or a literal string '…' without.
    std::string quotedString(const std::string& key, std::string_view text) const
    {
        const char quote = text.front();
        std::string result;
        std::size_t i = 1;
        for (; i < text.size() && text[i] != quote; ++i) {
            if (quote == '"' && text[i] == '\\') {
                ++i;
                constexpr std::string_view kEscapes = "\"\\tn";
                constexpr std::string_view kMeanings = "\"\\\t\n";
                const auto escape = i < text.size() ? kEscapes.find(text[i]) : std::string_view::npos;
                if (escape == std::string_view::npos) {
                    refuse("value of key '" + key + "' holds an escape other than \\\" \\\\ \\t \\n");
                }
                result += kMeanings[escape];
            } else {
                result += text[i];
            }
        }
        if (i >= text.size()) {
            refuse("value of key '" + key + "' lacks its closing quote");
        }
        const std::string_view rest = trimmed(text.substr(i + 1));
        if (!rest.empty() && rest.front() != '#') {
            refuse("'" + std::string(rest) + "' stands after the value of key '" + key + "'");
        }
        return result;
    }

    std::string path_;
    int line_ = 0;
};

}  // namespace

std::vector<ConfigEntry> readConfig(const std::string& path)
{
    std::ifstream file(path);
    std::vector<ConfigEntry> entries;
    LineReader reader(path);
    for (std::string line; std::getline(file, line);) {
        reader.read(line, entries);
    }
    // A directory opens and fails at the first read; a missing file fails at once.
    if (!file.eof()) {
        throw droplet::Error(droplet::ErrorCode::InvalidArgument,
                             "--config: " + path + " cannot be read: " + std::strerror(errno));
    }
    return entries;
}

}  // namespace cli
