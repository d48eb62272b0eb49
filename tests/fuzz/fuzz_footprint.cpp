// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "droplet/domain/domain.h"
#include "droplet/error.h"
#include "droplet/mesh/triangulate.h"
#include "fuzz/targets.h"

namespace droplet {
namespace {

/// Input: first byte: width; second: use of levels, edges and threshold; the rest: pixels, row by row.
Mask maskFrom(std::span<const std::byte> bytes, bool hard)
{
    constexpr int kMaxPixels = 40;  // per side; larger masks find no further errors
    Mask mask;
    mask.width = 1 + std::to_integer<int>(bytes[0]) % kMaxPixels;
    const std::size_t pixels =
        std::min<std::size_t>(bytes.size() - 2, static_cast<std::size_t>(mask.width) * kMaxPixels);
    mask.height =
        static_cast<int>((pixels + static_cast<std::size_t>(mask.width) - 1) / static_cast<std::size_t>(mask.width));
    for (std::size_t i = 0; i < static_cast<std::size_t>(mask.width) * static_cast<std::size_t>(mask.height); ++i) {
        const int level = i < pixels ? std::to_integer<int>(bytes[i + 2]) : 0;
        mask.coverage.push_back(static_cast<std::uint16_t>(hard ? (level % 2) * 65535 : level * 257));
    }
    return mask;
}

}  // namespace

void fuzzFootprint(std::span<const std::byte> bytes)
{
    if (bytes.size() < 3) {
        return;
    }
    const int mode = std::to_integer<int>(bytes[1]);
    const Mask mask = maskFrom(bytes, (mode & 1) != 0);
    TraceOptions options;
    options.pixel_size = 1e-4;
    options.threshold = (mode & 2) != 0 ? 0.5 : 0.3;
    options.speck_size = (mode & 4) != 0 ? 0.0 : 3.0;
    Outline outline;
    try {
        outline = trace(mask, options);
    } catch (const Error& error) {
        if (error.code() != ErrorCode::InvalidInput) {
            throw;
        }
        return;  // no liquid, or only specks
    }
    const Domain domain = split(outline);
    TriangulateOptions mesh_options;
    mesh_options.triangles = (mode & 8) != 0 ? 3000 : 300;
    for (const PlanarMesh& mesh : triangulate(domain, mesh_options)) {
        mesh.validate();
        if (!(area(mesh) > 0.0) || !std::isfinite(area(mesh))) {
            throw std::logic_error("a mesh without area");
        }
    }
}

}  // namespace droplet
