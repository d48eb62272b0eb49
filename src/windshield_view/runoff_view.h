// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "droplet/windshield/runoff.h"
#include "windshield_view/film_optics.h"
#include "windshield_view/smooth_noise.h"
#include "windshield_view/view_context.h"

namespace droplet {

/// Film of heavy rain: sheets with irregular rims, rivulets, and waves that run over them. rain.glsl draws the same.
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
    /// Value and its slopes along the glass's x and y.
    struct Sloped {
        float value = 0.0F;
        Vec2f slope;
    };
    [[nodiscard]] Sloped thicknessAt(Vec2f place) const;
    [[nodiscard]] Sloped distanceFromRim(Vec2f place, const Sloped& thickness) const;
    [[nodiscard]] Sloped wavesAt(Vec2f place) const;

    const ViewContext& scene_;
    float cell_ = 0.0F;
    int columns_ = 0;
    int rows_ = 0;
    Vec2f long_run_;  ///< of the waves, in their lengths
    Vec2f short_run_;
    std::vector<float> thickness_;  ///< [m], with a border of two cells as thick as those at the edge
    std::optional<SmoothNoise> noise_;
    std::vector<std::uint8_t> reach_;
    std::vector<std::optional<FilmOptics>> optics_;
};

}  // namespace droplet
