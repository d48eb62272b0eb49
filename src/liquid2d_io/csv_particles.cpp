// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/core.h>

#include <array>

#include "csv_table.h"
#include "liquid2d_io/raw_particles.h"

namespace droplet {
namespace {

using Columns = std::array<std::optional<std::size_t>, 3>;

/// Columns of a vector; the first pattern of which at least two columns exist. `{}` stands for the axis.
Columns vectorColumns(const CsvTable& table, const std::vector<std::pair<std::string, std::string_view>>& patterns)
{
    for (const auto& [pattern, axes] : patterns) {
        Columns columns;
        int found = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            std::string heading = pattern;
            heading.replace(heading.find('*'), 1, 1, axes[k]);
            columns.at(k) = table.columnWhere([&](const std::string& other) { return lowerCase(other) == heading; });
            found += columns.at(k) ? 1 : 0;
        }
        if (found >= 2) {
            return columns;
        }
    }
    return {};
}

std::optional<std::size_t> numberColumn(const CsvTable& table, ParticleRole role)
{
    return table.columnWhere([role](const std::string& heading) { return roleOf(heading, 1) == role; });
}

}  // namespace

RawParticles readCsvParticles(std::string_view bytes, const std::string& name)
{
    const CsvTable table(bytes, name);
    const Columns place = vectorColumns(table, {{"*", "xyz"}, {"*_m", "xyz"}, {"points:*", "012"}});
    if (!place[0] && !place[1]) {
        table.refuse(
            "is no particle file: it needs a header row with columns x and y, x_m and y_m, or Points:0 and "
            "Points:1, or a VTK, VTP or classic BGEO file");
    }
    if (table.rows().size() > kMaxParticles) {
        table.refuse(fmt::format("has {} particles, which is more than {}", table.rows().size(), kMaxParticles));
    }
    const Columns speed = vectorColumns(table, {{"v*", "xyz"},
                                                {"velocity_*_m_per_s", "xyz"},
                                                {"velocity_*", "xyz"},
                                                {"velocity:*", "012"},
                                                {"vel:*", "012"},
                                                {"v:*", "012"}});
    const std::optional<std::size_t> id = numberColumn(table, ParticleRole::Id);
    const std::optional<std::size_t> density = numberColumn(table, ParticleRole::Density);
    RawParticles particles;
    for (const CsvTable::Row& row : table.rows()) {
        const auto number = [&](std::optional<std::size_t> column) {
            return column ? table.number(row, *column) : 0.0;
        };
        particles.position.push_back({number(place[0]), number(place[1]), number(place[2])});
        if (speed[0] || speed[1]) {
            particles.velocity.push_back({number(speed[0]), number(speed[1]), number(speed[2])});
        }
        if (id) {
            particles.id.push_back(number(id));
        }
        if (density) {
            particles.density.push_back(number(density));
        }
    }
    return particles;
}

}  // namespace droplet
