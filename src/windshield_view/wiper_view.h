// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "droplet/windshield/wipers.h"
#include "windshield_view/bead.h"
#include "windshield_view/view_context.h"

namespace droplet {

/// Wiper that a ray meets at one moment.
struct WiperMet {
    float cover = 0.0F;  ///< share of the pixel that blade or arm covers
    float shine = 0.0F;  ///< its light over that of the cabin
    WaterMet pushed;     ///< water ahead of the blade
};

/// Visible wipers: blades and arms, the water that they push, and the water that they leave. The film that they leave
/// breaks up into streaks and vanishes within a second. Where a blade has turned, a wedge of water remains for a while,
/// unless another blade passes there. The water balance counts all of this as wiped.
///
/// Shapes and sizes are chosen by eye, after blades and arms of cars.
class WiperView {
public:
    /// @param scene  must outlive this
    explicit WiperView(const ViewContext& scene) : scene_(scene) {}

    /// Moves the wipers to a time [s].
    void update(double time);

    /// Whether wipers may be visible in a tile (upper bound).
    [[nodiscard]] bool reach(std::size_t tile) const { return !tiles_.empty() && tiles_[tile].in_field; }
    /// Whether blades or arms, or the water that they push, may be visible in a tile (upper bound).
    [[nodiscard]] bool reachNow(std::size_t tile) const { return !tiles_.empty() && tiles_[tile].at_blade; }
    /// Number of moments at which blades are drawn while the shutter is open.
    [[nodiscard]] int moments() const { return moments_; }

    /// Pixel of a tile.
    struct TilePixel {
        std::size_t tile = 0;
        std::size_t pixel = 0;
    };
    /// Water that a wiper has left: films and wedges.
    /// @param place  where the pixel's middle is on the glass [m]
    /// @param pixel  size of a pixel's image on the glass [m]
    [[nodiscard]] WaterMet waterLeft(TilePixel at, Vec2f place, float pixel) const;
    /// Wiper at a place and moment.
    /// @param moment  0 … moments() − 1
    [[nodiscard]] WiperMet at(Vec2f place, float pixel, int moment) const;

private:
    /// Blade at a moment.
    struct Blade {
        Vec2f along;           ///< unit direction from the pivot
        float forward = 0.0F;  ///< 1: its angle grows; −1: it shrinks; 0: at rest
        float pushed = 0.0F;   ///< amount of pushed water, 0 … 1
    };
    /// Level of a film and its slopes: a random field over the way of a blade and along it, which repeats. It is
    /// sampled once, as are the functions of age and level.
    class FilmField {
    public:
        FilmField();
        /// Level, its slope along the blade's motion, and along the blade [1/m].
        /// @param along   [m], more than -1e6
        /// @param across  [m]
        [[nodiscard]] Float4 at(float along, float across) const;

        struct Age {
            float broken = 0.0F;     ///< level below which the glass is bare
            float thickness = 0.0F;  ///< slope of the film over that of its level [m]
        };
        /// @param share  age over the film's lifetime, 0 to 1
        [[nodiscard]] Age ofAge(float share) const { return ages_[index(share)]; }
        /// How much steeper rims are at a level above the bare one.
        [[nodiscard]] float rimOf(float level) const { return rims_[index(level)]; }

    private:
        static constexpr std::size_t kSteps = 1024;
        static std::size_t index(float share)
        {
            return static_cast<std::size_t>(std::clamp(share * kSteps, 0.0F, static_cast<float>(kSteps - 1)));
        }

        std::vector<Float4> samples_;
        std::array<Age, kSteps> ages_;
        std::array<float, kSteps> rims_;
    };
    /// Water where a blade has turned.
    struct Wedge {
        bool is_there = false;
        Vec2f ahead;           ///< unit; where the blade was going
        float drained = 0.0F;  ///< share of its lifetime
        std::uint32_t seed = 0;
    };
    /// Wiper at the present time.
    struct WiperState {
        Wiper wiper;
        double since = 0.0;         ///< time since the begin of its period [s]
        std::uint32_t stroke = 0;   ///< number of the stroke
        std::vector<Blade> blades;  ///< blade at each moment
        Wedge wedge;
        std::array<Vec2f, 3> film_shifts;  ///< in the field, of the last way before this stroke and of its two ways [m]
    };

    [[nodiscard]] static Blade bladeAt(const Wiper& wiper, double time);
    /// What a pixel's place says of the film there, once for the view.
    struct FilmPlace {
        float there = -1.0F;  ///< when the blade passes on its way there [s after its start]; below 0: never
        float along = 0.0F;   ///< along the way of the blade's outer end [m]
    };
    void placeFilms();
    [[nodiscard]] static FilmPlace filmPlaceOf(const Wiper& wiper, Vec2f from);
    [[nodiscard]] WaterMet film(const WiperState& one, const FilmPlace& place, Vec2f from, float pixel) const;
    [[nodiscard]] static Wedge wedgeOf(const WiperState& one);
    [[nodiscard]] static WaterMet wedge(const WiperState& one, Vec2f from, float pixel);
    /// Whether a place is in the field of another wiper.
    [[nodiscard]] bool isInOtherField(const WiperState& own, Vec2f place) const;

    const ViewContext& scene_;
    std::vector<WiperState> states_;
    std::optional<FilmField> film_;
    std::vector<std::vector<FilmPlace>> film_places_;  ///< for each wiper: of every pixel, tile by tile
    struct TileReach {
        bool in_field = false;
        bool at_blade = false;  ///< at any moment
    };
    std::vector<TileReach> tiles_;
    int moments_ = 1;
};

}  // namespace droplet
