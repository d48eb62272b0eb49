// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "droplet/windshield/runoff.h"
#include "windshield_view/film_optics.h"
#include "windshield_view/runoff_relief.h"
#include "windshield_view/view_context.h"

namespace droplet {

/// Film of heavy rain: sheets and rivulets, with the relief of RunoffRelief.
class RunoffView {
public:
    /// @param scene  must outlive this
    explicit RunoffView(const ViewContext& scene) : scene_(scene) {}

    /// Takes the film to the present.
    void update(const Runoff& film);

    /// Whether the film may be visible in a tile (upper bound).
    [[nodiscard]] bool reach(std::size_t tile) const { return !reach_.empty() && reach_[tile] != 0; }
    /// Adds the film where it covers more than what is there.
    void add(std::size_t tile, WaterLeft& left) const;

private:
    [[nodiscard]] Float4 thicknessAt(Vec2f place) const;

    const ViewContext& scene_;
    float cell_ = 0.0F;
    float per_metre_ = 0.0F;
    int columns_ = 0;
    int rows_ = 0;
    std::optional<RunoffRelief> relief_;
    std::vector<float> thickness_;  ///< [m], with a border of two cells as thick as those at the edge
    std::vector<std::uint8_t> reach_;
    std::vector<std::optional<FilmOptics>> optics_;
};

}  // namespace droplet
