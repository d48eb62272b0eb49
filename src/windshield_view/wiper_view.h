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
#include "windshield_view/film_optics.h"
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
    [[nodiscard]] bool reachNow(std::size_t tile) const { return !tiles_.empty() && tiles_[tile].blades != 0; }
    [[nodiscard]] bool reachNow(std::size_t tile, int moment) const
    {
        return !tiles_.empty() && (tiles_[tile].blades >> moment & 1U) != 0;
    }
    /// Number of moments at which blades are drawn while the shutter is open.
    [[nodiscard]] int moments() const { return moments_; }

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
    /// sampled once.
    class FilmField {
    public:
        FilmField();
        /// Level, its slope along the blade's motion, along the blade [1/m], and a number without meaning.
        /// @param along   [m], more than -1e6
        /// @param across  [m]
        [[nodiscard]] Float4 at(float along, float across) const;

    private:
        std::vector<Float4> samples_;
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
    /// Film of a wiper in the pixels of a tile. A way of the blade gives a pixel a part of the field until the next
    /// way. What is read for every frame is small.
    struct FilmPixels {
        std::array<float, kTilePixels> there;  ///< as FilmPlace
        std::array<float, kTilePixels> along;
        std::array<std::uint32_t, kTilePixels> ways;    ///< last one over each pixel
        std::array<std::uint16_t, kTilePixels> levels;  ///< of the field, in 1/kLevel
        std::array<std::uint16_t, kTilePixels>
            steepnesses;                                 ///< steepest slope of the level, in 1/kSteepness of a pixel
        std::array<std::int16_t, kTilePixels> shifts_x;  ///< shift of the picture behind for a unit slope ...
        std::array<std::int16_t, kTilePixels> shifts_y;  ///< ... over that of the level, in kShift px/m
        FilmOptics optics;

        static constexpr float kLevel = 65535.0F;
        static constexpr float kSteepness = 16384.0F;
        static constexpr float kShift = 50.0F;  // for the steepest rims 0.005 px
    };
    /// Film of a wiper in a tile.
    struct TileFilm {
        std::unique_ptr<FilmPixels> pixels;  ///< none: the blade never passes
        float first = 0.0F;                  ///< least time `there` of the pixels that the blade passes
        float last = -1.0F;                  ///< largest one; below 0: it passes none
        std::optional<std::uint32_t> way;    ///< last one, if it is the same for all pixels
        float lasts = 0.0F;                  ///< time until all films of `way` have dried [s]
        bool is_wet = false;                 ///< now (upper bound)
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
    void renew(const WiperState& one, TileFilm& film, std::size_t tile) const;
    /// Takes the film of each pixel of a tile to a way.
    void renew(const WiperState& one, FilmPixels& film, std::size_t tile,
               const std::array<std::uint32_t, kTilePixels>& ways) const;
    /// Adds a film where it covers more than what is there.
    /// @param is_first  nothing is there; what `left` has is of another tile
    void addFilm(const WiperState& one, const TileFilm& in_tile, bool is_first, WaterLeft& left) const;
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
    std::vector<std::vector<TileFilm>> films_;  ///< for each wiper: of every tile
    struct TileReach {
        bool has_water_left = false;
        std::uint64_t blades = 0;  ///< a bit for each moment, of which there are at most 64
    };
    std::vector<TileReach> tiles_;
    int moments_ = 1;
};

}  // namespace droplet
