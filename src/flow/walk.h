// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "droplet/flow/flow.h"
#include "droplet/flow/flow_droplet.h"
#include "droplet/flow/flow_parameters.h"
#include "droplet/flow/flow_surface.h"
#include "droplet/vector.h"
#include "flow/landing.h"
#include "flow/pinning.h"

namespace droplet {

/// What acts on one droplet, as far as it is its own.
struct WalkForces {
    Vec3 acceleration;           ///< of gravity [m/s²]
    Vec3 wind;                   ///< of the wind; acts along the surface alone [m/s²]
    Vec3 fall;                   ///< acceleration in the air [m/s²]
    double decay = 0.0;          ///< viscous friction over mass, |k_f|/m [1/s], ≥ 0
    double height = 1.0;         ///< h_d, of the droplet [m], > 0
    double retention = 0.0;      ///< acceleration up to which hysteresis holds a droplet at rest [m/s²], ≥ 0
    double sliding = 0.0;        ///< part of it that still acts while it moves, against its velocity [m/s²], ≥ 0
    double adhesion = 0.0;       ///< normal acceleration up to which it adheres, D π r²/m [m/s²], ≥ 0
    double edge = 0.0;           ///< acceleration up to which an open edge holds it at rest [m/s²], ≥ 0
    double contact_width = 0.0;  ///< diameter of its contact circle [m], > 0
};

/// What a face does to a droplet.
struct Grip {
    Vec2 smoothness = {1.0, 1.0};  ///< 1 − k_r: what roughness leaves of the force, along the first edge and across it
    double friction = 1.0;         ///< factor on viscous friction
    double retention = 1.0;        ///< factor on hysteresis
};

/// State of all faces at the begin of a step. By default they are smooth and dry.
struct WalkFaces {
    const FaceProperties* faces = nullptr;  ///< properties that differ from face to face
    double roughness = 0.0;                 ///< height of bumps where `faces` has none [m]
    std::span<const FlowState::Wetness> wetness;
    double dry_before = 0.0;       ///< faces that were wet before this time only are dry [s]
    bool wet_is_slippery = false;  ///< streaks lower hysteresis as they do roughness

    [[nodiscard]] bool isUniform() const { return faces == nullptr && roughness == 0.0 && !wet_is_slippery; }

    /// @param id      of the droplet; its own streak does not count
    /// @param height  of the droplet [m]
    [[nodiscard]] Grip at(std::uint32_t face, std::uint64_t id, double height) const
    {
        Grip grip;
        const Vec2 dryness = drynessFor(face, id);
        const Vec2 bump =
            faces != nullptr && !faces->roughness.empty() ? faces->roughness[face] : Vec2{roughness, roughness};
        // k_r = min(h_b / h_d, 1)
        grip.smoothness = {1.0 - dryness.x * std::min(bump.x / height, 1.0),
                           1.0 - dryness.y * std::min(bump.y / height, 1.0)};
        if (faces != nullptr) {
            grip.friction = faces->friction.empty() ? 1.0 : faces->friction[face];
            grip.retention = faces->hysteresis.empty() ? 1.0 : faces->hysteresis[face];
        }
        if (wet_is_slippery) {
            grip.retention *= 0.5 * (dryness.x + dryness.y);
        }
        return grip;
    }

private:
    [[nodiscard]] Vec2 drynessFor(std::uint32_t face, std::uint64_t id) const
    {
        if (wetness.empty() || wetness[face].id == 0 || wetness[face].time < dry_before) {
            return {1.0, 1.0};
        }
        return wetness[face].id == id ? wetness[face].before : wetness[face].dryness;
    }
};

/// Where droplets walk.
struct WalkField {
    const FlowSurface& surface;
    const Landing& landing;  ///< of the same surface
    WalkFaces ground = {};
    const PinningField* pinning = nullptr;  ///< null: hysteresis is even
    const GroundMotion* motion = nullptr;   ///< of the surface; null: it rests
    const FlowSurface* rest = nullptr;      ///< the surface in the shape that pinning belongs to; null: this one
};

/// Events of walking.
struct WalkCounts {
    std::uint64_t crossings = 0;  ///< of edges
    std::uint64_t launches = 0;   ///< from the surface into the air
    std::uint64_t landings = 0;
    std::uint64_t stuck = 0;  ///< droplets that were stopped, as they met events without end at one time
};

/// Moves a droplet along the surface, and through the air, until a time. The path depends on neither that time nor how
/// often the function is called, as long as the field is the same and without pinning. With pinning, what holds the
/// droplet is found anew in each call, for where it is then.
///
/// @param droplet  its leg began at `until` or before
/// @param until    [s]
/// @param tracks   if not null, receives the path's pieces, one for every face
/// @param from     where the first piece begins in time [s], ≥ the leg's begin
WalkCounts walk(const WalkField& field, const WalkForces& forces, FlowDroplet& droplet, double until,
                std::vector<FlowTrack>* tracks = nullptr, double from = 0.0);

/// Puts a droplet onto a face, at rest or moving; its velocity loses what is normal to the face.
/// @param begin  when, where and how fast it begins; of a path only these count
void putOnFace(const WalkField& field, const WalkForces& forces, FlowDroplet& droplet, std::uint32_t face,
               const Leg& begin);

/// Begins the droplet's path anew where it is, under forces that have changed.
void redirect(const WalkField& field, const WalkForces& forces, FlowDroplet& droplet, double time);

}  // namespace droplet
