// SPDX-License-Identifier: GPL-3.0-or-later
//
// Fields that are chosen by eye: where a film's rims are when it is thin, and the waves that run over it.
//
// A film's thickness, and all that follows from it, is a Float4: a value, its slopes along the glass's x and y, and a
// number without meaning.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "droplet/vector.h"
#include "windshield_view/glass_frame.h"
#include "windshield_view/smooth_noise.h"

namespace droplet {

/// What the film of heavy rain has that is finer than its cells: irregular rims where it is thin, and waves that run
/// over it. rain.glsl draws the same.
class RunoffRelief {
    /// Random fields of which the relief consists.
    enum Field : std::size_t { CoarseRim, FineRim, LongWaves, ShortWaves, FieldCount };

public:
    /// @param drift  way that the waves have run [m]
    explicit RunoffRelief(Vec2 drift);

    /// Surface of a film within a pixel.
    struct Surface {
        float cover = 0.0F;  ///< share of the pixel that the film covers; 0 or less: none
        Float4 relief{};     ///< its slopes along the glass's x and y are those of the surface
    };
    /// @param film     thickness without waves [m]
    /// @param pixel    width of the pixel [m]
    /// @param covered  share of the pixel that other water covers; a film that covers no more has no slope
    [[nodiscard]] Surface at(Vec2f place, const Float4& film, float pixel, float covered = 0.0F) const;

    // The same for the pixels of a raster, for which columns are computed once.

    /// Place along x.
    using Column = std::array<SmoothNoise::Place, FieldCount>;
    [[nodiscard]] Column columnOf(float x) const;
    /// Places with one y.
    class Row {
    public:
        Row(const RunoffRelief& relief, float y);

        /// As RunoffRelief::at(), up to rounding.
        [[nodiscard]] Surface at(const Column& column, const Float4& film, float pixel) const;

    private:
        std::array<SmoothNoise::Row, FieldCount> fields_;
    };

private:
    /// Units of the fields per metre; waves are longer up the glass, which a driver sees shortened.
    static constexpr std::array<Vec2f, FieldCount> kPerMetre{Vec2f{1.0F / 5e-3F, 1.0F / 5e-3F},
                                                             {1.0F / 1.7e-3F, 1.0F / 1.7e-3F},
                                                             {1.0F / 5e-3F, 1.0F / 10e-3F},
                                                             {1.0F / 2.9e-3F, 1.0F / 4.8e-3F}};
    static constexpr float kWaves = 0.8F;  ///< height of waves over the thickness
    /// Their heights: of rims over the width of a rim, of waves over the thickness.
    static constexpr std::array<float, FieldCount> kHeights{0.9F, 0.5F, kWaves, 0.6F * kWaves};

    /// Factors of a field and of its slopes in its units.
    static constexpr Float4 factorsOf(Field field)
    {
        return Float4{kHeights[field], kHeights[field] * kPerMetre[field].x, kHeights[field] * kPerMetre[field].y,
                      0.0F};
    }
    /// @param value_of  value of a field at the place, times its factors
    template <typename ValueOf>
    static Surface surface(const Float4& film, float pixel, float covered, const ValueOf& value_of);
    [[nodiscard]] SmoothNoise::Row rowOf(Field field, float y) const
    {
        return {*noise_, kPerMetre[field].y * y - shifts_[field].y, factorsOf(field)};
    }

    const SmoothNoise* noise_;
    std::array<Vec2f, FieldCount> shifts_{};  ///< that the fields have run, in their units
};

// Below, all is inlined: small structures of floats that are returned pass through memory.

template <typename ValueOf>
[[gnu::always_inline]] inline RunoffRelief::Surface RunoffRelief::surface(const Float4& film, float pixel,
                                                                          float covered, const ValueOf& value_of)
{
    constexpr float kThinnest = 2e-6F;              // [m]
    constexpr float kWhole = 110e-6F;               // so thick a film has no rims [m]
    constexpr float kPerThickness = 1.0F / 50e-6F;  // over the thickness where rims are
    constexpr float kRounded = 0.8F;                // distance from the rim where the film is flat
    const float thickness = film[0];
    if (thickness < kThinnest) {
        return {};
    }
    // Distance from the rim.
    const Float4 rim = thickness < kWhole ? float4(kPerThickness) * film + value_of(CoarseRim) + value_of(FineRim) -
                                                Float4{1.25F, 0.0F, 0.0F, 0.0F}
                                          : Float4{1.0F, 0.0F, 0.0F, 0.0F};
    const float wide = std::max(std::sqrt(rim[1] * rim[1] + rim[2] * rim[2]) * pixel, 0.05F);
    const float cover = std::min(rim[0] / wide, 1.0F);
    if (!(cover > covered)) {
        return {cover, float4(0.0F)};
    }
    const Float4 high = value_of(LongWaves) + value_of(ShortWaves) + Float4{1.0F - 0.8F * kWaves, 0.0F, 0.0F, 0.0F};
    const float t = std::min(rim[0] * (1.0F / kRounded), 1.0F);
    const float rounded = t * t * (3.0F - 2.0F * t);
    const float by_rim = 6.0F * t * (1.0F - t) / kRounded;
    // Slopes of the product of `high`, `rounded` and the thickness.
    return {cover, float4(high[0] * rounded) * film + float4(thickness * rounded) * high +
                       float4(thickness * high[0] * by_rim) * rim};
}

[[gnu::always_inline]] inline RunoffRelief::Surface RunoffRelief::at(Vec2f place, const Float4& film, float pixel,
                                                                     float covered) const
{
    return surface(film, pixel, covered, [&](Field field) {
        return factorsOf(field) * noise_->at(kPerMetre[field].x * place.x - shifts_[field].x,
                                             kPerMetre[field].y * place.y - shifts_[field].y);
    });
}

inline RunoffRelief::Column RunoffRelief::columnOf(float x) const
{
    Column column;
    for (std::size_t field = 0; field < FieldCount; ++field) {
        column[field] = SmoothNoise::placeOf(kPerMetre[field].x * x - shifts_[field].x);
    }
    return column;
}

inline RunoffRelief::Row::Row(const RunoffRelief& relief, float y)
    : fields_{relief.rowOf(CoarseRim, y), relief.rowOf(FineRim, y), relief.rowOf(LongWaves, y),
              relief.rowOf(ShortWaves, y)}
{
}

[[gnu::always_inline]] inline RunoffRelief::Surface RunoffRelief::Row::at(const Column& column, const Float4& film,
                                                                          float pixel) const
{
    return surface(film, pixel, 0.0F, [&](Field field) { return fields_[field].at(column[field]); });
}

}  // namespace droplet
