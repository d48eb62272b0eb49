// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "droplet/liquid.h"
#include "droplet/vector.h"
#include "droplet/windshield/droplets.h"
#include "droplet/windshield/runoff.h"
#include "windshield/cells.h"
#include "windshield/mist_cells.h"
#include "windshield/still_droplets.h"
#include "windshield/sweep.h"

namespace droplet {

/// Thickness from which on raindrops join a film [m].
inline constexpr double kWetFilm = 15e-6;
/// Thickness from which on a film takes the droplets that it meets [m].
inline constexpr double kDeepFilm = 90e-6;

/// Lays out the cells, those of still droplets, if there are none.
/// @param size  of the unrolled glass [m]
void layOut(Runoff& film, Vec2 size);

/// Thickness at a position [m]; 0 without a film.
double thicknessAt(const Runoff& film, Vec2 position);

/// Spreads water evenly over the cells of a disc, at least over one.
/// @param volume  [m³], all of which the film takes
void pour(Runoff& film, Vec2 middle, double radius, double volume);

/// Takes the water that a blade passes over.
/// @return  its volume [m³]
double takeRunoff(Runoff& film, const Sweep& blade);

/// Takes the water within half the width of a finger's stroke.
/// @return  its volume [m³]
double takeRunoff(Runoff& film, const MistStroke& stroke);

/// What pushes a film at a position, along the glass [m/s²]; empty: there is no glass.
using FilmPush = std::function<std::optional<Vec2>(Vec2 position)>;

/// Moves the film for a time. Where there is no glass, all its water leaves.
/// @return  volume that has left the glass [m³]
double flow(Runoff& film, const Liquid& liquid, double dt, const FilmPush& push_at);

/// Breaks up parts of the film that hardly move.
/// @param share  of those that have a still droplet's water in a cell or less, 0 … 1; the thicker ones are fewer
/// @return       droplets with their water
std::vector<StillDroplet> breakUp(Runoff& film, double share, std::uint64_t seed);

}  // namespace droplet
