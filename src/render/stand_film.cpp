// SPDX-License-Identifier: GPL-3.0-or-later
#include "render/stand_film.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "render/triangle_grid.h"
#include "require.h"

namespace droplet {
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
        require(first[t] + gridValues(divisions[t]) <= film.size(), "options.stand_water.first", first[t],
                "inside film");
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
    const GridValue film = onGrid(water_.film.data() + water_.first[meeting.triangle], n, meeting);
    const float here = std::max(film.here, 0.0F);
    if (film.along_u == 0.0F && film.along_v == 0.0F) {
        return {here, meeting.normal};
    }
    // Gradient of the film's thickness along the triangle.
    const auto& [a, b, c] = stand_.triangles[meeting.triangle];
    const Vec3 p = stand_.vertices[b] - stand_.vertices[a];
    const Vec3 q = stand_.vertices[c] - stand_.vertices[a];
    const Vec3 across = cross(p, q);
    const double rise = n / std::max(dot(across, across), 1e-300);
    const Vec3 slope =
        rise * cross(static_cast<double>(film.along_u) * q - static_cast<double>(film.along_v) * p, across);
    constexpr double kSteepest = 0.5;
    const double steep = length(slope);
    const double limit = steep > kSteepest ? kSteepest / steep : 1.0;
    return {here, unit(meeting.normal - toFloats(limit * slope))};
}

}  // namespace droplet
