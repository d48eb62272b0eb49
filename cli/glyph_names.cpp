// SPDX-License-Identifier: GPL-3.0-or-later
#include "glyph_names.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <set>
#include <string_view>

namespace cli {
namespace {

constexpr std::size_t kLongest = 100;  // file systems allow 255 bytes; extensions and numbers are added

bool isCapital(char c)
{
    return c >= 'A' && c <= 'Z';
}

bool isPlain(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-' || c == '.' || c == '_';
}

std::string lowered(std::string text)
{
    std::transform(text.begin(), text.end(), text.begin(),
                   [](char c) { return isCapital(c) ? static_cast<char>(c - 'A' + 'a') : c; });
    return text;
}

/// Whether a name is a device in Windows, with any extension.
bool isDevice(const std::string& name)
{
    const std::string stem = lowered(name.substr(0, name.find('.')));
    constexpr std::array<std::string_view, 4> kDevices{"aux", "con", "nul", "prn"};
    const bool numbered = stem.size() == 4 && (stem.rfind("com", 0) == 0 || stem.rfind("lpt", 0) == 0) &&
                          stem[3] >= '0' && stem[3] <= '9';
    return numbered || std::find(kDevices.begin(), kDevices.end(), stem) != kDevices.end();
}

}  // namespace

std::string safeName(const std::string& name)
{
    std::string safe;
    for (const char c : name) {
        if (isCapital(c)) {
            safe += c;
            safe += '_';
        } else {
            safe += isPlain(c) ? c : '_';
        }
    }
    if (safe.empty() || safe.front() == '.') {
        safe = "_" + (safe.empty() ? safe : safe.substr(1));
    }
    if (isDevice(safe)) {
        safe = "_" + safe;
    }
    return safe.substr(0, kLongest);
}

std::vector<std::string> fileNames(const droplet::Font& font)
{
    std::vector<std::string> names;
    std::set<std::string> taken;
    const std::size_t count = font.glyphCount();
    names.reserve(count);
    for (std::size_t glyph = 0; glyph < count; ++glyph) {
        names.push_back(safeName(font.nameOf(static_cast<droplet::GlyphId>(glyph))));
    }
    // The first glyphs of all names come before the others, so that no added number takes another glyph's name.
    std::vector<std::size_t> doubles;
    for (std::size_t glyph = 0; glyph < count; ++glyph) {
        if (!taken.insert(lowered(names[glyph])).second) {
            doubles.push_back(glyph);
        }
    }
    for (const std::size_t glyph : doubles) {
        do {
            names[glyph] += "-" + std::to_string(glyph);
        } while (!taken.insert(lowered(names[glyph])).second);
    }
    return names;
}

}  // namespace cli
