// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/scene/format.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "droplet/error.h"

namespace droplet {
namespace {

constexpr std::array<std::pair<Format, const char*>, 7> kFormats = {{
    {Format::Glb, "glb"},
    {Format::Gltf, "gltf"},
    {Format::Obj, "obj"},
    {Format::Ply, "ply"},
    {Format::Stl, "stl"},
    {Format::Usda, "usda"},
    {Format::Usdz, "usdz"},
}};

}  // namespace

Format formatNamed(std::string_view name)
{
    std::string wanted(name.substr(!name.empty() && name.front() == '.' ? 1 : 0));
    std::transform(wanted.begin(), wanted.end(), wanted.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    std::string known;
    for (const auto& [format, known_name] : kFormats) {
        if (wanted == known_name) {
            return format;
        }
        known += std::string(" ") + known_name;
    }
    throw Error(ErrorCode::InvalidArgument, "format \"" + std::string(name) + "\" is unknown; known are" + known);
}

const char* name(Format format)
{
    for (const auto& [known, known_name] : kFormats) {
        if (known == format) {
            return known_name;
        }
    }
    throw Error(ErrorCode::InvalidArgument, "format = " + std::to_string(static_cast<int>(format)) + " is unknown");
}

bool isAnimated(Format format)
{
    return format == Format::Glb || format == Format::Gltf || format == Format::Usda || format == Format::Usdz;
}

}  // namespace droplet
