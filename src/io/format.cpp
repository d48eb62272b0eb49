// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "droplet/error.h"
#include "droplet/io/gltf.h"
#include "droplet/io/mesh_files.h"
#include "droplet/io/output.h"
#include "droplet/io/usd.h"
#include "io/dry_surface.h"

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

[[noreturn]] void refuse(Format format)
{
    throw Error(ErrorCode::InvalidArgument, "format = " + std::to_string(static_cast<int>(format)) + " is unknown");
}

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
    refuse(format);
}

std::uint64_t writeSurface(const Surface& surface, std::ostream& out, Format format, const WriteOptions& options)
{
    switch (format) {
        case Format::Glb:
        case Format::Gltf: {
            const bool closed = options.closed ? *options.closed : isDry(surface) || isClosed(surface);
            return writeGltf(surface, out,
                             {format == Format::Glb, options.material, closed, options.nodes, options.droplets,
                              options.texture, format == Format::Glb ? options.compression : Compression::None});
        }
        case Format::Obj:
            return writeObj(surface, out,
                            {options.unit, options.material, options.material_file, looksOf(options.droplets)});
        case Format::Ply:
            return writePly(surface, out);
        case Format::Stl:
            return writeStl(surface, out, options.unit);
        case Format::Usda:
            return writeUsda(surface, out, {options.material, options.nodes, options.droplets});
        case Format::Usdz:
            return writeUsdz(surface, out, {options.material, options.nodes, options.droplets, options.texture});
    }
    refuse(format);
}

}  // namespace droplet
