// SPDX-License-Identifier: GPL-3.0-or-later
// Katsushika Hokusai, The Great Wave off Kanagawa: crests end in few large claws, and each of these in smaller ones. A
// claw belongs to a particle at the crest, so it goes with the liquid; it grows while its particle is fast and its
// surface moves outwards, and shrinks after that. Of claws that come near to one another, the one of lower rank
// shrinks.
#include "claws.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "liquid2d/bounds.h"
#include "liquid2d/cell_grid.h"
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

/// Length below which a claw is not drawn, in spacings: it would be hardly wider than a cell, and no claw but a nick.
constexpr double kLeast = 3.0;

/// Time over which a claw's direction is averaged [s].
constexpr double kAveraged = 0.1;

/// Radius around a root within which a crest is told from the face below it, in spacings: much longer than the depth of
/// the root below the surface, and no more than a claw. Share of liquid there up to which claws are whole, and from
/// which on there are none. Half a spacing below a plane it is 0.535, below a hollow with a radius of 20 spacings
/// 0.586.
constexpr double kBentRadius = 12.0;
constexpr double kCrest = 0.54;
constexpr double kFace = 0.58;

/// Share of liquid around places.
class LiquidAround {
public:
    explicit LiquidAround(const ParticleFrame& frame)
        : position_(frame.position),
          spacing_(frame.spacing),
          reach_(kBentRadius * frame.spacing),
          cells_(boundsOf(frame.position).lower, boundsOf(frame.position).upper, reach_)
    {
        order_ = cells_.sort(frame.position);
    }

    /// The nearer liquid counts more, so that no particle makes the share jump; 1 in bulk liquid.
    [[nodiscard]] double share(Vec2 place) const
    {
        const int column = cells_.column(place.x);
        const int row = cells_.row(place.y);
        double sum = 0.0;
        for (int r = row - 1; r <= row + 1; ++r) {
            const auto [first, last] = cells_.range(r, column - 1, column + 1);
            for (std::uint32_t k = first; k < last; ++k) {
                const Vec2 away = place - position_[order_[k]];
                sum += std::max(1.0 - dot(away, away) / (reach_ * reach_), 0.0);
            }
        }
        return sum * spacing_ * spacing_ / (0.5 * std::numbers::pi * reach_ * reach_);
    }

private:
    const std::vector<Vec2>& position_;
    double spacing_;
    double reach_;
    CellGrid cells_;
    std::vector<std::uint32_t> order_;
};

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
    if (roots.empty()) {
        return claws;
    }
    const OtherLiquid others(frame, state.group);
    const LiquidAround around(frame);
    for (const Root& root : roots) {
        double room = 1.0;
        for (const Root& other : taken) {
            const double apart = length(root.place - other.place) / (kApart * 0.5 * (root.length + other.length));
            room = std::min(room, 1.0 - other.grown * (1.0 - smoothRamp(apart, 0.8, 1.2)));
        }
        Root grown = root;
        grown.grown = root.grown * room * (1.0 - smoothRamp(around.share(root.place), kCrest, kFace));
        if (grown.grown > 0.0) {
            // A claw whose outer half meets liquid is none: on the face of a wave it would lie in the liquid, and its
            // tip and hollow would be nicks.
            const std::vector<Vec2> spine = clawAt(root, grown.grown).finger.spine;
            double free = 1.0;
            for (std::size_t k = kPoints / 2; k < spine.size(); ++k) {
                const double away = others.distance(root.place + spine[k], [](std::uint32_t) { return true; });
                free = std::min(free, smoothRamp(away / frame.spacing, kBlocked, kFree));
            }
            grown.grown *= free;
        }
        if (grown.grown * root.length > kLeast * frame.spacing) {
            claws.push_back(clawAt(root, grown.grown));
        }
        if (grown.grown > 0.0) {
            taken.push_back(grown);
        }
    }
    return claws;
}

}  // namespace droplet
