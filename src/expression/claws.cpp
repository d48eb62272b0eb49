// SPDX-License-Identifier: GPL-3.0-or-later
// Katsushika Hokusai, The Great Wave off Kanagawa: crests end in few large claws, and each of these in smaller ones. A
// claw belongs to a particle at the crest, so it goes with the liquid; it grows while its particle is fast and its
// surface moves outwards, and shrinks after that. Of claws that come near to one another, the one of lower rank
// shrinks.
#include "claws.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "other_liquid.h"
#include "surface_kernel.h"

namespace droplet {
namespace {

/// Points of a claw's spine.
constexpr int kPoints = 16;

/// Turn of a claw from its root to its tip [rad].
constexpr double kTurn = 2.1;

/// Half of the width at the root, over the length.
constexpr double kRoot = 0.17;

/// Exponent of the taper.
constexpr double kTaper = 1.1;

/// Distance of the roots of two claws, over the mean of their lengths.
constexpr double kApart = 0.62;

/// Length of the small claws over that of the large ones.
constexpr double kSmall = 0.45;

/// Distance of a tip from liquid at which there is no claw, and from which on it is whole, in spacings.
constexpr double kBlocked = 0.8;
constexpr double kFree = 2.2;

/// Growth below which a claw is not drawn: it would be thinner than a cell.
constexpr double kLeast = 0.2;

/// Time over which a claw's direction is averaged [s].
constexpr double kAveraged = 0.1;

/// Rank of a particle, spread evenly over the ids.
std::uint32_t rankOf(std::uint32_t id)
{
    return id * 2654435769U;
}

struct Root {
    Vec2 place;
    Vec2 forward;
    double length = 0.0;  ///< when fully grown
    double grown = 0.0;   ///< in [0, 1]
    std::uint32_t rank = 0;
};

Vec2 rotated(Vec2 a, double angle)
{
    return {a.x * std::cos(angle) - a.y * std::sin(angle), a.x * std::sin(angle) + a.y * std::cos(angle)};
}

Claw clawAt(const Root& root, double grown)
{
    Claw claw;
    const double size = root.length * grown;
    // Waves that run to the right curl clockwise.
    const double turn = (root.forward.x > 0.0 ? -1.0 : 1.0) * kTurn;
    Vec2 direction = rotated(root.forward, -0.35 * turn);
    Vec2 place;
    claw.finger.spine = {place};
    const double step = size / (kPoints - 1);
    for (int k = 1; k < kPoints; ++k) {
        place = place + step * direction;
        claw.finger.spine.push_back(place);
        direction = rotated(direction, turn / (kPoints - 1));
    }
    claw.finger.ellipse.centre = root.place;
    claw.finger.shape.head = kRoot * size;
    claw.finger.shape.length = size;
    claw.finger.shape.exponent = kTaper;
    claw.finger.shape.tangent = kRoot;
    claw.finger.is_near = true;
    // Under the arch.
    const Vec2 middle = claw.finger.spine[kPoints / 2];
    claw.hollow = root.place + 0.5 * (middle + place) + 0.12 * size * rotated(root.forward, turn);
    claw.hollow_radius = 0.2 * size;
    return claw;
}

}  // namespace

std::vector<Claw> clawsOf(const ExpressionState& state, const ParticleFrame& frame, const ExpressionOptions& options)
{
    std::vector<Claw> claws;
    if (!(options.claws > 0.0)) {
        return claws;
    }
    std::size_t back = 0;
    while (back + 1 < state.past.size() && frame.time - state.past[back].time < kAveraged) {
        ++back;
    }
    std::vector<Root> roots;
    for (std::size_t i = 0; i < frame.position.size(); ++i) {
        const std::uint32_t id = frame.id[i];
        if (!(state.curl[id] > 0.0) || id >= state.past[back].position.size()) {
            continue;
        }
        const Vec2 way = frame.position[i] - state.past[back].position[id];
        if (!(length(way) > 0.0)) {
            continue;
        }
        const std::uint32_t rank = rankOf(id);
        const double size = options.claws * frame.spacing * (rank % 3 == 0 ? 1.0 : kSmall);
        roots.push_back({frame.position[i], (1.0 / length(way)) * way, size, state.curl[id], rank});
    }
    // Large ones first.
    std::sort(roots.begin(), roots.end(), [](const Root& a, const Root& b) {
        return a.length != b.length ? a.length > b.length : a.rank < b.rank;
    });
    std::vector<Root> taken;
    std::optional<OtherLiquid> others;
    if (!roots.empty()) {
        others.emplace(frame, state.group);
    }
    for (const Root& root : roots) {
        double room = 1.0;
        for (const Root& other : taken) {
            const double apart = length(root.place - other.place) / (kApart * 0.5 * (root.length + other.length));
            room = std::min(room, 1.0 - other.grown * (1.0 - smoothRamp(apart, 0.8, 1.2)));
        }
        Root grown = root;
        grown.grown = root.grown * room;
        if (grown.grown > 0.0) {
            // A claw whose tip meets liquid is none.
            const Claw claw = clawAt(root, grown.grown);
            const Vec2 tip = root.place + claw.finger.spine.back();
            grown.grown *=
                smoothRamp(others->distance(tip, [](std::uint32_t) { return true; }) / frame.spacing, kBlocked, kFree);
        }
        if (grown.grown > kLeast) {
            claws.push_back(clawAt(root, grown.grown));
        }
        if (grown.grown > 0.0) {
            taken.push_back(grown);
        }
    }
    return claws;
}

}  // namespace droplet
