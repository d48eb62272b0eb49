// SPDX-License-Identifier: GPL-3.0-or-later
// Sections that reports on droplets on objects have.
#pragma once

#include <string>

#include "axes.h"
#include "droplet/flow/flow_surface.h"
#include "droplet/vector.h"
#include "io/report_sections.h"

namespace droplet {

/// Vector with +Y up, without −0.
inline ReportJson vectorOf(Vec3 v)
{
    const Vec3 up = yUp(v);
    return {up.x + 0.0, up.y, up.z};
}

/// @param size  edges of the box around the object, z up [m]
inline ReportJson objectSection(const std::string& path, const FlowSurfaceReport& surface, Vec3 size)
{
    return {{"path", path},
            {"triangles", surface.triangles},
            {"without_area", surface.without_area},
            {"duplicates", surface.duplicates},
            {"turned", surface.turned},
            {"boundary_edges", surface.boundary_edges},
            {"parts", surface.parts},
            {"size_m", {size.x, size.z, size.y}}};
}

}  // namespace droplet
