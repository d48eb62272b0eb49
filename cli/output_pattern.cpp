// SPDX-License-Identifier: GPL-3.0-or-later
#include "output_pattern.h"

#include <cstddef>
#include <string_view>

namespace cli {

std::string fillPattern(const Given& pattern, const PatternValues& values, const std::string& allowed)
{
    const auto refuse_pattern = [&] { refuse(pattern, "a path with " + allowed + "; {{ and }} stand for braces"); };
    std::string text;
    for (std::size_t i = 0; i < pattern.text.size(); ++i) {
        const char c = pattern.text[i];
        if (c != '{' && c != '}') {
            text += c;
            continue;
        }
        if (i + 1 < pattern.text.size() && pattern.text[i + 1] == c) {
            text += c;
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
        i = end;
    }
    return text;
}

}  // namespace cli
