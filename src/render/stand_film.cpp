// SPDX-License-Identifier: GPL-3.0-or-later
#include "render/stand_film.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "require.h"

namespace droplet {
namespace {

// Number of values of a triangle's grid.
std::size_t valuesOf(std::size_t divisions)
{
    return divisions == 0 ? 0 : (divisions + 1) * (divisions + 2) / 2;
}

}  // namespace

void StandWater::validate(std::size_t triangles) const
{
    for (const DropletBase& base : bases) {
        const auto is_size = [](double size) { return size > 0.0 && std::isfinite(size); };
        const bool is_valid = is_size(base.half_length) && is_size(base.half_width) && is_size(base.height) &&
                              std::isfinite(length(base.place)) && std::abs(length(base.ahead) - 1.0) < 1e-6 &&
                              std::abs(length(base.normal) - 1.0) < 1e-6;
        require(is_valid, "options.stand_water.bases", base.half_length, "ellipses with sizes above 0");
    }
    require(divisions.empty() || divisions.size() == triangles, "options.stand_water.divisions", divisions.size(),
            "as many as the stand's triangles");
    require(divisions.size() == first.size(), "options.stand_water.first", first.size(), "as many as divisions");
    for (std::size_t t = 0; t < divisions.size(); ++t) {
        require(first[t] + valuesOf(divisions[t]) <= film.size(), "options.stand_water.first", first[t], "inside film");
    }
    for (const float value : film) {
        require(value >= 0.0F && std::isfinite(value), "options.stand_water.film", value, "at least 0 m");
    }
}

StandFilm::Here StandFilm::at(const Meeting& meeting) const
{
    if (water_.divisions.empty() || water_.divisions[meeting.triangle] == 0) {
        return {0.0F, meeting.normal};
    }
    const int n = water_.divisions[meeting.triangle];
    const float u = std::clamp(meeting.u, 0.0F, 1.0F) * static_cast<float>(n);
    const float v = std::clamp(meeting.v, 0.0F, 1.0F) * static_cast<float>(n);
    const int j = std::min(static_cast<int>(v), n - 1);
    const int i = std::clamp(static_cast<int>(u), 0, n - 1 - j);
    const float* const values = water_.film.data() + water_.first[meeting.triangle];
    const auto value = [&](int column, int row) { return values[row * (n + 1) - row * (row - 1) / 2 + column]; };
    const float fu = u - static_cast<float>(i);
    const float fv = v - static_cast<float>(j);
    // A cell is cut into two triangles; the grid's last cells have one.
    float here = 0.0F;
    float along_u = 0.0F;
    float along_v = 0.0F;
    if (fu + fv <= 1.0F || i + j + 2 > n) {
        along_u = value(i + 1, j) - value(i, j);
        along_v = value(i, j + 1) - value(i, j);
        here = value(i, j) + fu * along_u + fv * along_v;
    } else {
        along_u = value(i + 1, j + 1) - value(i, j + 1);
        along_v = value(i + 1, j + 1) - value(i + 1, j);
        here = value(i + 1, j + 1) - (1.0F - fu) * along_u - (1.0F - fv) * along_v;
    }
    here = std::max(here, 0.0F);
    if (along_u == 0.0F && along_v == 0.0F) {
        return {here, meeting.normal};
    }
    // Gradient of the film's thickness along the triangle.
    const auto& [a, b, c] = stand_.triangles[meeting.triangle];
    const Vec3 p = stand_.vertices[b] - stand_.vertices[a];
    const Vec3 q = stand_.vertices[c] - stand_.vertices[a];
    const Vec3 across = cross(p, q);
    const double rise = n / std::max(dot(across, across), 1e-300);
    const Vec3 slope = rise * cross(static_cast<double>(along_u) * q - static_cast<double>(along_v) * p, across);
    constexpr double kSteepest = 0.5;
    const double steep = length(slope);
    const double limit = steep > kSteepest ? kSteepest / steep : 1.0;
    return {here, unit(meeting.normal - toFloats(limit * slope))};
}

}  // namespace droplet
