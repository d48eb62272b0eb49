// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "droplet/units.h"
#include "droplet/vector.h"
#include "droplet/wind/forces.h"
#include "droplet/windshield/drive_cycle.h"
#include "droplet/windshield/glass.h"
#include "droplet/windshield/rain.h"

namespace droplet {

/// A droplet large enough to run, whether it does or rests: a spherical cap by its volume and the contact angle.
struct RunningDroplet {
    std::uint64_t id = 0;     ///< never used again; its random numbers hang on it
    Vec2 position;            ///< of its middle, on the rolled out glass (Glass) [m]
    Vec2 velocity;            ///< [m/s]; exactly 0 at rest
    double volume = 0.0;      ///< [m³], > 0
    double since_bead = 0.0;  ///< way since it last left water behind [m]
    std::uint64_t beads = 0;  ///< how often it did

    friend bool operator==(const RunningDroplet&, const RunningDroplet&) = default;
};

/// A droplet of less water than a raindrop of WindshieldParameters::still_diameter: it never moves.
struct StillDroplet {
    Vec2 position;        ///< [m]
    double volume = 0.0;  ///< [m³], > 0

    friend bool operator==(const StillDroplet&, const StillDroplet&) = default;
};

/// The still droplets, in square cells of the rolled out glass: cell (column, row) is number row · columns + column and
/// holds at most kMost of them, in an order that is a matter of history. Memory is bounded by the glass's area.
struct StillDroplets {
    static constexpr std::size_t kMost = 8;  ///< what lands in a full cell joins the nearest there

    double cell = 0.0;  ///< their width [m]
    std::uint32_t columns = 0;
    std::uint32_t rows = 0;
    std::vector<StillDroplet> slots;       ///< kMost for each cell, those in use first
    std::vector<std::uint16_t> places;     ///< for each slot in use: where in its cell, in 256ths: column + 256 · row
    std::vector<std::uint8_t> counts;      ///< of those in use, for each cell
    std::vector<std::uint32_t> revisions;  ///< for each cell: raised with everything that changes in it

    [[nodiscard]] std::span<const StillDroplet> droplets(std::size_t number) const
    {
        return {slots.data() + number * kMost, counts[number]};
    }
    /// Puts one into a cell that has room and holds its position.
    void put(std::size_t number, const StillDroplet& droplet);
    /// How many there are.
    [[nodiscard]] std::size_t count() const;

    friend bool operator==(const StillDroplets&, const StillDroplets&) = default;
};

/// A sum of many small terms that forgets none (A. Neumaier, "Rundungsfehleranalyse einiger Verfahren zur Summation
/// endlicher Summen", ZAMM 54 (1974) 39).
struct CarriedSum {
    double sum = 0.0;
    double carry = 0.0;

    void add(double term);
    [[nodiscard]] double value() const { return sum + carry; }

    friend bool operator==(const CarriedSum&, const CarriedSum&) = default;
};

/// Where the water went since the start [m³].
struct WaterBalance {
    double rained = 0.0;
    double on_glass_still = 0.0;
    double on_glass_running = 0.0;
    double left = 0.0;   ///< over the edges
    double wiped = 0.0;  ///< by wipers
    double merged =
        0.0;  ///< a flow within the glass: taken up by running droplets, from still ones, rain, and each other
    double swept = 0.0;  ///< of that, from still droplets along tracks: the Lotus effect
    double shed = 0.0;   ///< a flow within the glass: left behind as streaks

    /// rained − (on glass + left + wiped), relative to rained; 0 before any rain.
    [[nodiscard]] double residual() const;
};

/// The way of a running droplet in the last step: it swept all within `radius` of it.
struct TrackPiece {
    std::uint64_t id = 0;
    Vec2 from;  ///< [m]
    Vec2 to;
    double radius = 0.0;  ///< half its width, seen from above [m]

    friend bool operator==(const TrackPiece&, const TrackPiece&) = default;
};

/// How many of what happened since the start.
struct WindshieldCounts {
    std::uint64_t raindrops = 0;  ///< that met the glass
    std::uint64_t merged = 0;     ///< running droplets taken up by others
    std::uint64_t swept = 0;      ///< still droplets taken up by running ones
    std::uint64_t grown = 0;      ///< still droplets that became running ones
    std::uint64_t left = 0;       ///< running droplets that left over the edges
    std::uint64_t wiped = 0;      ///< droplets of both kinds

    friend bool operator==(const WindshieldCounts&, const WindshieldCounts&) = default;
};

/// All there is to know to go on. Plain values; made by startWindshield, step and stateFromBytes.
struct WindshieldState {
    double time = 0.0;                     ///< [s]
    std::vector<RunningDroplet> droplets;  ///< in the order of their ids
    StillDroplets still;                   ///< all others
    std::vector<TrackPiece> tracks;        ///< of the last step, of droplets that moved, in the order of ids
    std::uint64_t next_id = 1;             ///< of a running droplet
    std::uint64_t next_raindrop = 0;       ///< number of the raindrop that comes next
    double until_raindrop = 0.0;           ///< until then, in raindrops expected
    CarriedSum rained;                     ///< [m³], as are these
    CarriedSum left;
    CarriedSum wiped;
    CarriedSum merged;
    CarriedSum swept;
    CarriedSum shed;
    WindshieldCounts counts;

    friend bool operator==(const WindshieldState&, const WindshieldState&) = default;
};

/// Random pushes along the glass from a vehicle that shakes (thesis 3.2: noise on the gravity along the windshield).
/// Each droplet has its own: uniform values at times `interval` apart, its phase its own, with a smooth passage between
/// them that keeps their variance; a function of seed, droplet and time alone.
struct Fluctuation {
    double acceleration = 0.5;  ///< root mean square of each component [m/s²], ≥ 0; never beyond √6 of it
    double interval = 0.1;      ///< [s], > 0

    /// @throws Error InvalidArgument
    void validate() const;
};

/// What running droplets leave behind: a film as wide as they are, which breaks up into still droplets.
struct Streaks {
    double film = 0.0;      ///< its thickness [m], ≥ 0; 0: none. Water-repellent glass stays dry
    double spacing = 4e-3;  ///< mean distance of the droplets it becomes [m], > 0

    /// @throws Error InvalidArgument
    void validate() const;
};

/// A blade that sweeps back and forth about a pivot: its angle goes as a cosine from `first` to `last` and back in
/// `stroke`, then rests at `first` for what is left of `period`. It takes all water it passes over off the glass:
/// wiped.
struct Wiper {
    Vec2 pivot{0.7, -0.05};          ///< on the rolled out glass, or beside it [m]
    double inner = 0.1;              ///< where the blade begins, from the pivot [m], ≥ 0
    double outer = 0.7;              ///< and ends [m], > inner
    double first = 175.0 * kDegree;  ///< from the glass's x, towards its y [rad]
    double last = 5.0 * kDegree;     ///< [rad]; differs from first, by at most 2π
    double stroke = 1.2;             ///< there and back [s], > 0
    double period = 1.2;             ///< [s], ≥ stroke
    double start = 0.0;              ///< when it first leaves `first` [s]; at rest before

    /// Its angle at a time [rad].
    [[nodiscard]] double angleAt(double time) const;

    /// @throws Error InvalidArgument
    void validate() const;
};

/// Two blades in tandem, as most cars have them, that between them reach most of the glass.
/// @param period  of both [s], ≥ 1.2: they take 1.2 s there and back
std::vector<Wiper> tandemWipers(const Glass& glass, double period);

struct WindshieldParameters {
    Glass glass;
    WindAlongGlass wind = WindAlongGlass::Turned;
    ForceModel forces;
    DriveCycle vehicle = constantSpeed(11.3);
    double rainfall = 5.0 * kMillimetrePerHour;  ///< [m/s], ≥ 0
    RaindropRange raindrops;
    double still_diameter = 1e-3;  ///< raindrops of less make still droplets (thesis 3.1.5) [m], > 0, at most 2 mm
    bool relative_wind = false;    ///< drag by the wind relative to the moving droplet, instead of to the glass
    Fluctuation fluctuation;
    Streaks streaks;
    std::vector<Wiper> wipers;
    std::uint64_t seed = 1;

    /// Guarantees: returns only when every field is in its documented range.
    /// @throws Error InvalidArgument
    void validate() const;
};

/// Dry glass at time 0.
/// @throws Error InvalidArgument
WindshieldState startWindshield(const WindshieldParameters& parameters);

/// Goes on by dt: rain arrives (Poisson), running droplets are moved by the forces (wind/forces.h), take up still ones
/// along their way and merge where they touch, then wipers pass and what is beyond the edges has left.
///
/// Guarantees: the same bytes from the same arguments, at any number of threads; water is kept (balanceOf); droplets in
/// the order of their ids; a droplet whose forces are within the retention limit stays exactly where it is.
/// @param state  of these parameters
/// @param dt     [s], > 0, finite; what happens between two droplets within it happens at its end: 1/30 s or less
/// @throws Error InvalidArgument
WindshieldState step(WindshieldState state, const WindshieldParameters& parameters, double dt);

/// Where the water is, summed up anew.
WaterBalance balanceOf(const WindshieldState& state);

/// The whole state, exactly; and back again.
/// @throws Error InvalidInput, naming `name`, where it is no such state or cut off
std::string bytesOf(const WindshieldState& state);
WindshieldState stateFromBytes(std::string_view bytes, const std::string& name);

/// A setting of the thesis's figures.
struct WindshieldPreset {
    std::string name;         ///< "figure-3.10"
    std::string description;  ///< what the thesis says of it, in a line
    WindshieldParameters parameters;
};

/// Figures 3.10, 3.11 and 3.12: 11.3 m/s with hysteresis 0.5, 11.3 m/s with 0.05, 15 m/s with 0.5.
const std::vector<WindshieldPreset>& windshieldPresets();

/// @throws Error InvalidArgument, listing the names known
const WindshieldPreset& windshieldPresetNamed(std::string_view name);

}  // namespace droplet
