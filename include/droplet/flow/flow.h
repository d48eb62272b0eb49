// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "droplet/compensated_sum.h"
#include "droplet/flow/flow_droplet.h"
#include "droplet/flow/flow_parameters.h"
#include "droplet/flow/flow_terrain.h"
#include "droplet/flow/pond.h"
#include "droplet/vector.h"

namespace droplet {

/// Event counters since the start.
struct FlowCounts {
    std::uint64_t released = 0;   ///< droplets that sources made
    std::uint64_t crossings = 0;  ///< edges that droplets crossed
    std::uint64_t launches = 0;   ///< droplets that left the surface into the air
    std::uint64_t landings = 0;   ///< droplets that met the surface again
    std::uint64_t merged = 0;     ///< droplets that others absorbed
    std::uint64_t beads = 0;      ///< beads that streaks broke up into
    std::uint64_t left = 0;       ///< droplets that fell away from the object
    std::uint64_t dried = 0;      ///< droplets that dried up
    std::uint64_t stuck = 0;      ///< droplets stopped, as they met events without end at one time
    std::uint64_t raindrops = 0;  ///< of those released, raindrops
    std::uint64_t overflows = 0;  ///< times that liquid ran over the brim of a hollow
    std::uint64_t behind = 0;     ///< raindrops that met the back of an open sheet, and are lost
    double behind_volume = 0.0;   ///< of these, which is not in FlowBalance::released [m³]

    friend bool operator==(const FlowCounts&, const FlowCounts&) = default;  ///< Compares all members.
};

/// Liquid since the start [m³].
struct FlowBalance {
    double released = 0.0;  ///< by all sources
    double running = 0.0;   ///< in droplets that move over the surface
    double still = 0.0;     ///< in droplets at rest
    double airborne = 0.0;  ///< in droplets in the air
    double streaks = 0.0;   ///< in streaks
    double left = 0.0;      ///< fallen away
    double dried = 0.0;     ///< evaporated

    /// Relative error: (released − all others) / released; 0 before any release.
    [[nodiscard]] double residual() const;
};

/// Path of a droplet over one face within a step; those of all steps of the last call of advanceFlow are kept.
struct FlowTrack {
    std::uint64_t id = 0;    ///< of the droplet
    std::uint32_t face = 0;  ///< number in FlowSurface::faces
    Vec3 from;               ///< [m]
    Vec3 to;                 ///< [m]
    double width = 0.0;      ///< diameter of the droplet's contact circle [m]
    double time = 0.0;       ///< at `to` [s]
    double speed = 0.0;      ///< mean [m/s]
};

/// Complete state of droplets on a surface. Made by startFlow, advanceFlow and flowStateFromBytes. The droplets are
/// those at the last whole step; sampleFlow tells where they are at `time`.
struct FlowState {
    /// Traces of liquid on a face.
    struct Wetness {
        Vec2 dryness = {1.0, 1.0};  ///< factors on the roughness along the face's first edge and across it, 0 … 1
        Vec2 before = {1.0, 1.0};   ///< the same before the last droplet came: its own streak does not carry it
        std::uint64_t id = 0;       ///< of the last droplet; 0: none
        double time = 0.0;          ///< when it was last on the face [s]
    };
    /// What an emitter has done.
    struct Emission {
        double pending = 0.0;        ///< volume gathered for the next droplet [m³]
        std::uint64_t released = 0;  ///< number of droplets
    };
    /// Film on a piece of a droplet's way, as long as the beads' spacing, that becomes one bead.
    struct Trail {
        std::uint64_t id = 0;    ///< of the droplet
        double volume = 0.0;     ///< [m³]
        double drying = 0.0;     ///< volume that evaporates in a second [m³/s]
        double length = 0.0;     ///< [m]
        double spacing = 0.0;    ///< length at which it ends, of beads at random distances [m]
        double until = 0.0;      ///< when it breaks up, at the earliest [s]
        std::uint32_t face = 0;  ///< of its middle
        Vec3 place;              ///< its middle, or up to half a rivulet beside it [m]

        [[nodiscard]] bool isWhole() const { return length >= spacing; }  ///< Whether a new one follows.
    };

    double time = 0.0;                  ///< [s]
    std::uint64_t steps = 0;            ///< whole steps (FlowParameters::step) since the start; steps × step ≤ time
    std::vector<FlowDroplet> droplets;  ///< in the order of their ids
    std::vector<Wetness> wetness;       ///< of every face
    std::vector<Trail> trails;          ///< in the order of their begin
    std::vector<FlowTrack> tracks;      ///< of the last advanceFlow; not part of the saved state
    std::uint64_t next_id = 1;          ///< of the next droplet
    std::uint64_t next_raindrop = 0;    ///< number of the next raindrop
    std::uint64_t next_nucleus = 0;     ///< number of the next droplet of dew
    double until_raindrop = 0.0;        ///< expected number of raindrops until the next one arrives
    double until_nucleus = 0.0;         ///< the same for dew
    std::vector<Emission> emissions;    ///< of every emitter
    CompensatedSum released;            ///< FlowBalance::released [m³]
    CompensatedSum left;                ///< FlowBalance::left [m³]
    CompensatedSum dried;               ///< FlowBalance::dried [m³]
    FlowCounts counts;                  ///< event counters
};

/// Droplets at time 0.
///
/// @param terrain     surface
/// @param parameters  of the simulation
/// @param starts      droplets that are there from the beginning
/// @throws Error      InvalidArgument if a parameter is out of its range, or a droplet is larger than the object
FlowState startFlow(const FlowTerrain& terrain, const FlowParameters& parameters, const std::vector<FlowStart>& starts);

/// Advances the state to a time.
///
/// Between events the path is a closed formula (Leg). Droplets arrive, merge, wet the surface and dry at multiples of
/// FlowParameters::step, however often this function is called.
///
/// Guarantees: calls for any series of times that ends at `until` give the same bytes (but for `tracks`), with any
/// number of threads; liquid is conserved (balanceOf); droplets are in the order of their ids.
/// @param state       made with the same terrain and parameters
/// @param terrain     surface
/// @param parameters  of the simulation
/// @param until       [s], ≥ state.time
/// @throws Error      InvalidArgument
FlowState advanceFlow(FlowState state, const FlowTerrain& terrain, const FlowParameters& parameters, double until);

/// A droplet at one time.
struct FlowSample {
    std::uint64_t id = 0;                    ///< of the droplet
    FlowContact contact = FlowContact::Air;  ///< what it touches
    std::optional<std::uint32_t> face;       ///< number in FlowSurface::faces; empty in the air
    Vec3 place;           ///< its point on the surface, or its centre in the air, in the object's frame [m]
    Vec3 velocity;        ///< in the object's frame [m/s]
    Vec3 normal;          ///< of the surface, unit; in the air, of the face that it left
    double volume = 0.0;  ///< [m³]
    double age = 0.0;     ///< time since it was released, or became a bead [s]
    std::optional<double> contact_angle;  ///< on its face [rad]; empty: that of the force model
    std::optional<Pond> pond = {};        ///< if it fills a hollow
};

/// All droplets at the state's time, in the order of their ids.
/// @param state       as advanceFlow() left it
/// @param terrain     surface
/// @param parameters  of the simulation
std::vector<FlowSample> sampleFlow(const FlowState& state, const FlowTerrain& terrain,
                                   const FlowParameters& parameters);

/// Where the liquid is at the state's time.
FlowBalance balanceOf(const FlowState& state);

/// Exact bytes of a complete state but for its tracks.
std::string bytesOf(const FlowState& state);

/// State from its bytes.
/// @param bytes   of bytesOf()
/// @param faces   of the surface
/// @param name    of the source, for messages
/// @throws Error  InvalidInput if the bytes are damaged, cut off or not a state
FlowState flowStateFromBytes(std::string_view bytes, std::size_t faces, const std::string& name);

}  // namespace droplet
