// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/windshield/state_bytes.h"

#include <cstdint>
#include <limits>

#include "exact_bytes.h"
#include "windshield/still_droplets.h"

namespace droplet {
namespace {

constexpr std::string_view kHead = "droplet-shape windshield 4\n";

/// Writes or reads all members of a state except the lists.
template <class Archive, class State>
void scalars(Archive& archive, State& s)
{
    archive.all(s.time, s.next_id, s.next_raindrop, s.next_touch, s.until_raindrop, s.rained, s.sprayed, s.condensed,
                s.left, s.wiped, s.merged, s.swept, s.shed, s.counts.raindrops, s.counts.merged, s.counts.swept,
                s.counts.grown, s.counts.torn, s.counts.left, s.counts.wiped);
}

}  // namespace

std::string bytesOf(const WindshieldState& state)
{
    ExactWriter out(kHead);
    scalars(out, state);
    out.put(std::uint64_t{state.droplets.size()});
    for (const RunningDroplet& d : state.droplets) {
        out.all(d.id, d.position, d.velocity, d.volume, d.since_bead, d.beads);
    }
    out.put(std::uint64_t{state.tracks.size()});
    for (const TrackPiece& t : state.tracks) {
        out.all(t.id, t.from, t.to, t.radius);
    }
    out.put(std::uint64_t{state.arriving.size()});
    for (const StillDroplet& d : state.arriving) {
        out.all(d.position, d.volume);
    }
    out.put(std::uint64_t{state.splashes.size()});
    for (const Splash& one : state.splashes) {
        out.all(one.position, one.time, one.diameter, one.speed, one.radius, one.lifetime);
    }
    out.put(std::uint64_t{state.mist.thickness.size()});
    out.all(state.mist.cell, std::uint64_t{state.mist.columns}, std::uint64_t{state.mist.rows});
    for (const float height : state.mist.thickness) {
        out.put(double{height});
    }
    out.put(std::uint64_t{state.film.thickness.size()});
    out.all(state.film.cell, std::uint64_t{state.film.columns}, std::uint64_t{state.film.rows}, state.film.rest,
            state.film.next_break, state.film.drift);
    for (const std::int32_t thickness : state.film.thickness) {
        out.put(static_cast<std::uint64_t>(thickness));
    }
    const StillCells& still = StillCells::of(state.still);
    out.all(still.cell, std::uint64_t{still.columns}, std::uint64_t{still.rows});
    // Each cell begins with its revision and its number of droplets, in one value.
    for (std::size_t cell = 0; cell < still.counts.size(); ++cell) {
        out.put(std::uint64_t{still.revisions[cell]} << 8U | still.counts[cell]);
        for (const StillDroplet& d : still.droplets(cell)) {
            out.all(d.position, d.volume);
        }
    }
    return out.release();
}

WindshieldState stateFromBytes(std::string_view bytes, const std::string& name)
{
    ExactReader in(bytes, kHead, name);
    WindshieldState state;
    scalars(in, state);
    in.require(state.until_raindrop >= 0.0 && state.time >= 0.0);
    state.droplets.resize(in.count(64));
    std::uint64_t previous_id = 0;
    for (RunningDroplet& d : state.droplets) {
        in.all(d.id, d.position, d.velocity, d.volume, d.since_bead, d.beads);
        in.require(d.volume > 0.0 && d.id > previous_id && d.id < state.next_id);
        previous_id = d.id;
    }
    state.tracks.resize(in.count(48));
    for (TrackPiece& t : state.tracks) {
        in.all(t.id, t.from, t.to, t.radius);
    }
    std::uint64_t columns = 0;
    std::uint64_t rows = 0;
    constexpr std::uint64_t kMax = std::numeric_limits<std::uint32_t>::max();
    state.arriving.resize(in.count(24));
    for (StillDroplet& d : state.arriving) {
        in.all(d.position, d.volume);
        in.require(d.volume > 0.0);
    }
    state.splashes.resize(in.count(56));
    for (Splash& one : state.splashes) {
        in.all(one.position, one.time, one.diameter, one.speed, one.radius, one.lifetime);
        in.require(one.diameter > 0.0 && one.radius > 0.0 && one.lifetime > 0.0);
    }
    std::uint64_t cells_of_mist = 0;
    in.all(cells_of_mist, state.mist.cell, columns, rows);
    in.require(columns <= kMax && rows <= kMax && columns * rows == cells_of_mist &&
               cells_of_mist <= bytes.size() / 8 && (state.mist.cell > 0.0 || cells_of_mist == 0));
    state.mist.columns = static_cast<std::uint32_t>(columns);
    state.mist.rows = static_cast<std::uint32_t>(rows);
    state.mist.thickness.resize(cells_of_mist);
    for (float& height : state.mist.thickness) {
        double value = 0.0;
        in.get(value);
        in.require(value >= 0.0 && value <= 1.0);
        height = static_cast<float>(value);
    }
    std::uint64_t cells_of_film = 0;
    in.all(cells_of_film, state.film.cell, columns, rows, state.film.rest, state.film.next_break, state.film.drift);
    in.require(columns <= kMax && rows <= kMax && columns * rows == cells_of_film &&
               cells_of_film <= bytes.size() / 8 && (state.film.cell > 0.0 || cells_of_film == 0) &&
               state.film.rest >= 0.0 && state.film.rest <= 1.0);
    state.film.columns = static_cast<std::uint32_t>(columns);
    state.film.rows = static_cast<std::uint32_t>(rows);
    state.film.thickness.resize(cells_of_film);
    for (std::int32_t& thickness : state.film.thickness) {
        std::uint64_t value = 0;
        in.get(value);
        in.require(value <= std::numeric_limits<std::int32_t>::max());
        thickness = static_cast<std::int32_t>(value);
    }
    StillCells& still = StillCells::of(state.still);
    in.all(still.cell, columns, rows);
    in.require(still.cell > 0.0 && columns <= kMax && rows <= kMax && columns * rows <= bytes.size() / 8);
    still.columns = static_cast<std::uint32_t>(columns);
    still.rows = static_cast<std::uint32_t>(rows);
    const auto cells = static_cast<std::size_t>(columns * rows);
    still.counts.resize(cells);
    still.revisions.resize(cells);
    still.slots.resize(cells * StillCells::kMax);
    still.places.resize(still.slots.size());
    for (std::size_t cell = 0; cell < cells; ++cell) {
        std::uint64_t both = 0;
        in.get(both);
        in.require((both & 0xFFU) <= StillCells::kMax && both >> 8U <= kMax);
        for (std::uint64_t k = 0; k < (both & 0xFFU); ++k) {
            StillDroplet d;
            in.all(d.position, d.volume);
            in.require(d.volume > 0.0);
            still.put(cell, d);
        }
        still.revisions[cell] = static_cast<std::uint32_t>(both >> 8U);
    }
    in.require(in.ended());
    return state;
}

}  // namespace droplet
