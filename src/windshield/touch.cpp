// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/windshield/touch.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "droplet/error.h"
#include "require.h"
#include "wind/random.h"
#include "windshield/cap_scale.h"
#include "windshield/mist_cells.h"
#include "windshield/runoff_cells.h"
#include "windshield/segment.h"
#include "windshield/still_droplets.h"

namespace droplet {
namespace {

void requirePlace(const char* name, Vec2 place)
{
    require(std::isfinite(place.x) && std::isfinite(place.y), name, length(place), "finite");
}

/// Takes what lies in a stroke, from the air, too.
/// @return  its volume [m³]
double takeWater(WindshieldState& state, const MistStroke& stroke)
{
    const Segment middle(stroke.from, stroke.to);
    const auto meets = [&](Vec2 place) { return middle.squaredDistance(place) <= stroke.reach * stroke.reach; };
    double taken = takeMist(state.mist, stroke) + takeRunoff(state.film, stroke);
    const auto take_from = [&](auto& droplets) {
        std::erase_if(droplets, [&](const auto& droplet) {
            const bool met = meets(droplet.position);
            taken += met ? droplet.volume : 0.0;
            return met;
        });
    };
    take_from(state.droplets);
    take_from(state.arriving);
    StillCells& still = StillCells::of(state.still);
    StillRemoval removal(still);
    visitNear(still, stroke.from, stroke.to, stroke.reach, [&](StillSlot slot) {
        if (meets(at(still, slot).position)) {
            taken += removal.take(slot);
        }
    });
    removal.close();
    return taken;
}

}  // namespace

void Spray::validate() const
{
    requirePlace("spray.middle", middle);
    require(radius > 0.0 && std::isfinite(radius), "spray.radius", radius, "finite and more than 0 m");
    require(volume >= 0.0 && volume <= 1e-3, "spray.volume", volume, "from 0 to 0.001 m3");
}

void FingerStroke::validate() const
{
    requirePlace("stroke.from", from);
    requirePlace("stroke.to", to);
    require(width >= 1e-3 && width <= 0.2, "stroke.width", width, "from 0.001 to 0.2 m");
}

WindshieldState sprayed(WindshieldState state, const WindshieldParameters& parameters, const Spray& spray)
{
    parameters.validate();
    spray.validate();
    constexpr double kSmallest = 0.3e-3;  // diameters [m]
    constexpr double kLargest = 2e-3;
    const RandomStream random(parameters.seed, RandomPurpose::Spray, state.next_touch++);
    double rest = spray.volume;
    for (std::uint64_t k = 0; rest > 0.0; k += 3) {
        // A volume for each size alike is a density of d⁻³, whose distribution has this inverse.
        const double square = 1.0 / (kSmallest * kSmallest) -
                              random.uniform(k) * (1.0 / (kSmallest * kSmallest) - 1.0 / (kLargest * kLargest));
        const double diameter = 1.0 / std::sqrt(square);
        const double volume = std::min(rest, std::numbers::pi / 6.0 * diameter * diameter * diameter);
        const double away = 0.5 * spray.radius * std::sqrt(-2.0 * std::log1p(-random.uniform(k + 1)));
        const double angle = 2.0 * std::numbers::pi * random.uniform(k + 2);
        state.arriving.push_back({spray.middle + away * Vec2{std::cos(angle), std::sin(angle)}, volume});
        rest -= volume;
    }
    state.sprayed.add(spray.volume);
    return state;
}

WindshieldState stroked(WindshieldState state, const WindshieldParameters& parameters, const FingerStroke& stroke)
{
    parameters.validate();
    stroke.validate();
    const double half = 0.5 * stroke.width;
    const double water = takeWater(state, {stroke.from, stroke.to, half});
    if (!(water > 0.0)) {
        return state;
    }
    // Beads stand a few millimetres apart, as they do on a mirror; those too small to be seen are one.
    constexpr double kSpacing = 5e-3;
    constexpr double kAhead = 1.0 / 3.0;
    constexpr double kLeast = 5e-12;  // 0.2 mm across [m³]
    const CapScale caps(parameters.forces.wetting.contact_angle);
    const RandomStream random(parameters.seed, RandomPurpose::Finger, state.next_touch++);
    const double distance = length(stroke.to - stroke.from);
    const Vec2 along = distance > 0.0 ? (1.0 / distance) * (stroke.to - stroke.from) : Vec2{0.0, -1.0};
    const Vec2 aside{-along.y, along.x};
    const auto beads = static_cast<std::size_t>(
        std::min({std::floor(2.0 * distance / kSpacing + random.uniform(0)), (1.0 - kAhead) * water / kLeast, 1e5}));
    double rest = water;
    for (std::uint64_t k = 0; k < beads; ++k) {
        const std::uint64_t first = 4 * k + 1;
        const double volume =
            (1.0 - kAhead) * water / static_cast<double>(beads) * (0.25 + 1.5 * random.uniform(first));
        const double left = std::min(volume, 0.9 * rest);
        const double side = random.uniform(first + 1) < 0.5 ? -1.0 : 1.0;
        // Beside the finger's path, so that its next stroke does not take it.
        const double away = half + caps.reach(left) * (0.2 + 0.8 * random.uniform(first + 2));
        state.arriving.push_back(
            {stroke.from + distance * random.uniform(first + 3) * along + side * away * aside, left});
        rest -= left;
    }
    state.arriving.push_back({stroke.to + (half + 0.2 * caps.reach(rest)) * along, rest});
    return state;
}

}  // namespace droplet
