// SPDX-License-Identifier: GPL-3.0-or-later
#include <ostream>
#include <string>

#include "droplet/error.h"
#include "droplet/io/gltf.h"
#include "droplet/io/mesh_files.h"
#include "droplet/io/output.h"
#include "droplet/io/three_mf.h"
#include "droplet/io/usd.h"
#include "io/dry_surface.h"

namespace droplet {
std::uint64_t writeSurface(const Surface& surface, std::ostream& out, Format format, const WriteOptions& options)
{
    switch (format) {
        case Format::Glb:
        case Format::Gltf: {
            const bool closed = options.closed ? *options.closed : isDry(surface) || isClosed(surface);
            return writeGltf(
                surface, out,
                {format == Format::Glb, options.material, closed, options.nodes, options.droplets, options.texture,
                 format == Format::Glb ? options.compression : Compression::None, options.levels});
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
        case Format::ThreeMf:
            return writeThreeMf(surface, out, {options.material, options.nodes, options.droplets});
    }
    throw Error(ErrorCode::InvalidArgument, "format = " + std::to_string(static_cast<int>(format)) + " is unknown");
}

}  // namespace droplet
