// SPDX-License-Identifier: GPL-3.0-or-later
#include "output_pattern.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <string_view>
#include <vector>

#include "path_separators.h"

namespace cli {

namespace {

/// Refuses a filled pattern whose placeholders lead out of the folder that the pattern names.
/// @param filled  whether a byte of `text` comes from a placeholder
void refuseEscape(const Given& pattern, const std::string& text, const std::vector<bool>& filled)
{
    using Path = std::filesystem::path;
    bool leaves = Path(text).has_root_path() && !Path(pattern.text).has_root_path();
    for (std::size_t begin = 0; begin < text.size() && !leaves;) {
        const std::size_t end = std::min(text.find_first_of(kPathSeparators.data(), begin), text.size());
        const auto part = filled.begin() + static_cast<std::ptrdiff_t>(begin);
        leaves = text.compare(begin, end - begin, "..") == 0 && (part[0] || part[1]);
        begin = end + 1;
    }
    if (leaves) {
        refuse(pattern.subject + ": '" + pattern.text + "' would become '" + text +
               "', outside of its folder; use another placeholder");
    }
}

}  // namespace

std::string fillPattern(const Given& pattern, const PatternValues& values, const std::string& allowed)
{
    const auto refuse_pattern = [&] { refuse(pattern, "a path with " + allowed + "; {{ and }} stand for braces"); };
    std::string text;
    std::vector<bool> filled;  // whether a byte comes from a placeholder
    for (std::size_t i = 0; i < pattern.text.size(); ++i) {
        const char c = pattern.text[i];
        if (c != '{' && c != '}') {
            text += c;
            filled.push_back(false);
            continue;
        }
        if (i + 1 < pattern.text.size() && pattern.text[i + 1] == c) {
            text += c;
            filled.push_back(false);
            ++i;
            continue;
        }
        const auto end = pattern.text.find('}', i);
        if (c == '}' || end == std::string::npos) {
            refuse_pattern();
        }
        const auto value = values.find(std::string_view(pattern.text).substr(i + 1, end - i - 1));
        if (value == values.end()) {
            refuse_pattern();
        }
        text += value->second;
        filled.resize(text.size(), true);
        i = end;
    }
    refuseEscape(pattern, text, filled);
    return text;
}

}  // namespace cli
