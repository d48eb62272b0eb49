// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numbers>

#include "droplet/surface/textured_mesh.h"

namespace droplet::testing {

/// Sheet of rows and columns; each cell has two triangles.
struct Sheet {
    std::uint32_t columns = 1;
    std::uint32_t rows = 1;
    Vec2 uv_begin{0.0, 0.0};
    Vec2 uv_end{1.0, 1.0};
    std::function<Vec3(Vec2)> place;  ///< position of a uv in space
    std::function<Vec3(Vec2)> normal = [](Vec2) { return Vec3{0.0, 0.0, 1.0}; };
    bool turned = false;  ///< reverse the winding
};

/// With turned = false triangles wind counter-clockwise as the picture is seen.
inline TexturedMesh meshOf(const Sheet& sheet)
{
    TexturedMesh mesh;
    for (std::uint32_t j = 0; j <= sheet.rows; ++j) {
        for (std::uint32_t i = 0; i <= sheet.columns; ++i) {
            const double s = static_cast<double>(i) / sheet.columns;
            const double t = static_cast<double>(j) / sheet.rows;
            const Vec2 uv{(1.0 - s) * sheet.uv_begin.x + s * sheet.uv_end.x,
                          (1.0 - t) * sheet.uv_begin.y + t * sheet.uv_end.y};
            mesh.vertices.push_back(sheet.place(uv));
            mesh.normals.push_back(sheet.normal(uv));
            mesh.uvs.push_back(uv);
        }
    }
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        mesh.triangles.push_back(sheet.turned ? Triangle{a, c, b} : Triangle{a, b, c});
    };
    const std::uint32_t width = sheet.columns + 1;
    for (std::uint32_t j = 0; j < sheet.rows; ++j) {
        for (std::uint32_t i = 0; i < sheet.columns; ++i) {
            const std::uint32_t v = j * width + i;
            add(v, v + width, v + width + 1);
            add(v, v + width + 1, v + 1);
        }
    }
    return mesh;
}

/// Ball of so many meridians and half as many circles of latitude, open by a thousandth of a turn at its poles.
/// @param radius  of a direction [m]
inline TexturedMesh ball(std::uint32_t around, const std::function<double(Vec3)>& radius)
{
    Sheet sheet;
    sheet.columns = around;
    sheet.rows = around / 2;
    sheet.normal = [](Vec2 uv) {
        const double turn = 2.0 * std::numbers::pi * uv.x;
        const double tilt = std::numbers::pi * std::clamp(uv.y, 1e-3, 1.0 - 1e-3);
        return Vec3{std::sin(tilt) * std::cos(turn), std::sin(tilt) * std::sin(turn), std::cos(tilt)};
    };
    sheet.place = [&](Vec2 uv) { return radius(sheet.normal(uv)) * sheet.normal(uv); };
    return meshOf(sheet);
}

/// Union of two objects, the first one's triangles first.
inline TexturedMesh together(TexturedMesh a, const TexturedMesh& b)
{
    const auto offset = static_cast<std::uint32_t>(a.vertices.size());
    a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
    a.normals.insert(a.normals.end(), b.normals.begin(), b.normals.end());
    a.uvs.insert(a.uvs.end(), b.uvs.begin(), b.uvs.end());
    for (const auto& [i, j, k] : b.triangles) {
        a.triangles.push_back({i + offset, j + offset, k + offset});
    }
    return a;
}

}  // namespace droplet::testing
