// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/scene/format.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "entry_named.h"

namespace droplet {
namespace {

constexpr std::array<std::pair<Format, const char*>, 8> kFormats = {{
    {Format::Glb, "glb"},
    {Format::Gltf, "gltf"},
    {Format::Obj, "obj"},
    {Format::Ply, "ply"},
    {Format::Stl, "stl"},
    {Format::Usda, "usda"},
    {Format::Usdz, "usdz"},
    {Format::ThreeMf, "3mf"},
}};

}  // namespace

Format formatNamed(std::string_view name)
{
    std::string wanted(name.substr(!name.empty() && name.front() == '.' ? 1 : 0));
    std::transform(wanted.begin(), wanted.end(), wanted.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return valueNamed(kFormats, wanted, "format");
}

const char* name(Format format)
{
    return nameOf(kFormats, format, "format");
}

bool isAnimated(Format format)
{
    return format == Format::Glb || format == Format::Gltf || format == Format::Usda || format == Format::Usdz;
}

bool hasQuads(Format format)
{
    return format == Format::Obj || format == Format::Ply || format == Format::Usda || format == Format::Usdz;
}

}  // namespace droplet
