// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
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
    [[nodiscard]] bool reach(std::size_t tile) const { return hasWaterLeft(tile) || reachNow(tile); }
    /// Whether water that wipers have left may be visible in a tile (upper bound).
    [[nodiscard]] bool hasWaterLeft(std::size_t tile) const { return !tiles_.empty() && tiles_[tile].has_water_left; }
    /// Whether blades or arms, or the water that they push, may be visible in a tile (upper bound).
    [[nodiscard]] bool reachNow(std::size_t tile) const { return !tiles_.empty() && tiles_[tile].at_blade; }
    /// Number of moments at which blades are drawn while the shutter is open.
    [[nodiscard]] int moments() const { return moments_; }

    /// Water that wipers have left in the pixels of a tile: films and wedges.
    struct WaterLeft {
        std::array<float, kTilePixels> cover;  ///< as WaterMet, also what follows
        std::array<float, kTilePixels> slope_x;
        std::array<float, kTilePixels> slope_y;
        std::array<std::uint8_t, kTilePixels> is_bead;

        [[nodiscard]] WaterMet at(std::size_t pixel) const
        {
            return {cover[pixel], {slope_x[pixel], slope_y[pixel]}, is_bead[pixel] != 0};
        }
    };
    void waterLeft(std::size_t tile, WaterLeft& left) const;
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
        /// Level, its slope along the blade's motion, along the blade, and the steepest [1/m].
        /// @param along   [m], more than -1e6
        /// @param across  [m]
        [[nodiscard]] Float4 at(float along, float across) const;

        struct Age {
            float broken = 0.0F;     ///< level below which the glass is bare
            float thickness = 0.0F;  ///< slope of the film over that of its level [m]
        };
        /// @param step  age over the film's lifetime, in steps
        [[nodiscard]] const Age& ofAge(std::int32_t step) const { return ages_[static_cast<std::size_t>(step)]; }
        /// Age at which a level is bare, or a little more, over the film's lifetime.
        [[nodiscard]] static float dryAge(float level);
        /// How much steeper rims are at a level above the bare one.
        /// @param step  the level in steps
        [[nodiscard]] float rimOf(std::int32_t step) const { return rims_[static_cast<std::size_t>(step)]; }
        /// Step of a share from 0 to 1; beyond it, the nearest.
        static std::int32_t stepOf(float share)
        {
            return static_cast<std::int32_t>(std::min(std::max(share * kSteps, 0.0F), static_cast<float>(kSteps - 1)));
        }

    private:
        static constexpr std::size_t kSteps = 1024;

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
    /// Field of a film in the pixels of a tile, as FilmField::at().
    struct FieldPixels {
        std::array<float, kTilePixels> level;  ///< below 0: no film
        std::array<float, kTilePixels> along;
        std::array<float, kTilePixels> across;
        std::array<float, kTilePixels> steepest;

        void set(std::size_t pixel, const Float4& field)
        {
            level[pixel] = field[0];
            along[pixel] = field[1];
            across[pixel] = field[2];
            steepest[pixel] = field[3];
        }
    };
    /// Film of a wiper in the pixels of a tile. A way of the blade gives a pixel a part of the field until the next
    /// way.
    struct FilmPixels {
        std::array<float, kTilePixels> there;  ///< as FilmPlace
        std::array<float, kTilePixels> along;
        float first = 0.0F;                     ///< least time `there` of the pixels that the blade passes
        float last = -1.0F;                     ///< largest one; below 0: it passes none
        bool is_wet = false;                    ///< now (upper bound)
        std::optional<std::uint32_t> way = {};  ///< last one over all pixels, if the film has been wet since then
        FieldPixels field;                      ///< of that way
        float lasts = 0.0F;                     ///< time until all of that film has dried, or a little more [s]
    };
    /// Last way of a blade over a place.
    struct Passed {
        std::uint32_t way = 0;  ///< 0: back in the stroke before; 1: there in this one; 2: back
        float age = 0.0F;       ///< time since then [s]
    };
    void updateTile(std::size_t number);
    void placeFilms();
    [[nodiscard]] static FilmPlace filmPlaceOf(const Wiper& wiper, Vec2f from);
    [[nodiscard]] static Passed passed(const WiperState& one, float there);
    /// Takes the film of a tile to the present time.
    void renew(const WiperState& one, FilmPixels& film, std::size_t tile) const;
    /// @param way  way(pixel) is the last one over a pixel, as Passed::way
    template <typename Way>
    void setField(const WiperState& one, const FilmPixels& film, std::size_t tile, const Way& way,
                  FieldPixels& field) const;
    /// Adds a film where it covers more than what is there.
    void addFilm(const WiperState& one, const FilmPixels& film, std::size_t tile, WaterLeft& left) const;
    void addWedges(std::size_t tile, WaterLeft& left) const;
    [[nodiscard]] static Wedge wedgeOf(const WiperState& one);
    /// Whether a wedge may be visible in a tile (upper bound).
    [[nodiscard]] static bool reachWedge(const WiperState& one, const ViewTile& tile);
    [[nodiscard]] static WaterMet wedge(const WiperState& one, Vec2f from, float pixel);
    /// Whether a place is in the field of another wiper.
    [[nodiscard]] bool isInOtherField(const WiperState& own, Vec2f place) const;

    const ViewContext& scene_;
    std::vector<WiperState> states_;
    std::optional<FilmField> film_;
    std::vector<std::vector<std::unique_ptr<FilmPixels>>> films_;  ///< for each wiper: of every tile in its field
    struct TileReach {
        bool has_water_left = false;
        bool at_blade = false;  ///< at any moment
    };
    std::vector<TileReach> tiles_;
    int moments_ = 1;
};

}  // namespace droplet
