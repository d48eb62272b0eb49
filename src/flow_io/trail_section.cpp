// SPDX-License-Identifier: GPL-3.0-or-later
// What a droplet leaves on ground that it wets partly: its rear contact line recedes along the sides to a rivulet,
// which keeps the liquid and so is higher. It drains as a film on a wall does: h = √(ν l/(g t)) after a long time (H.
// Jeffreys, Math. Proc. Camb. Phil. Soc. 26 (1930) 204). Dirt holds its sides unevenly, and necks break first. Widths
// of rivulets, lengths of tails and gaps are estimates from photographs of rain on windows.
#include "flow_io/trail_section.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "droplet/liquid.h"
#include "flow/break_up.h"
#include "require.h"
#include "wind/random_field.h"

namespace droplet {
namespace {

constexpr double kRivulet = 0.38;  // width of a rivulet over the droplet's
constexpr double kGather = 0.8;    // way over which the film draws together, over the droplet's width
constexpr double kUneven = 0.45;   // change of a rivulet's width by dirt
constexpr double kPatch = 1.1;     // length of its change, over the droplet's width
constexpr double kNeck = 0.9;      // length of pieces that it breaks into
constexpr double kSteep = 0.6;     // softness of their ends
constexpr double kDrains = 10.0;   // length that it drains over, over the droplet's width
constexpr double kUnbroken = 2.0;  // way until it begins to break up, over the droplet's width
constexpr std::uint64_t kSeedOfNecks = 1;

double smoothstep(double low, double high, double x)
{
    const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

}  // namespace

void TrailFilm::validate() const
{
    require(thickness >= 0.0 && std::isfinite(thickness), "film.thickness", thickness, "finite and at least 0 m");
    require(!drying || (*drying > 0.0 && std::isfinite(*drying)), "film.drying", drying.value_or(0.0),
            "finite and more than 0 s");
    require(kinematic_viscosity > 0.0 && std::isfinite(kinematic_viscosity), "film.kinematic_viscosity",
            kinematic_viscosity, "finite and more than 0 m2/s");
}

double TrailSection::at(double distance) const
{
    const double share = half_width > 0.0 ? distance / half_width : 1.0;
    return std::max(height * (1.0 - share * share), 0.0);
}

TrailSection trailSection(const TrailFilm& film, const Passage& passage, Vec3 place, double age)
{
    const double way = passage.speed * age / passage.width;
    const double gathered = std::exp(-way / kGather);
    const double narrow = kRivulet + (1.0 - kRivulet) * gathered;
    const Vec3 at = (1.0 / passage.width) * place;
    const double uneven = 1.0 + kUneven * (1.0 - gathered) * smoothRandom((1.0 / kPatch) * at, 0);
    // What is left of it: places whose random number, from −1 to 1, is above a level that rises.
    constexpr double kNothingBroken = -1.0 - kSteep;
    const double highest = film.becomes_beads ? 1.0 : 0.15;
    const double level = kNothingBroken + (highest - kNothingBroken) * smoothstep(kUnbroken, kBreakUpWay, way);
    const double left = level > kNothingBroken
                            ? smoothstep(level, level + kSteep, smoothRandom((1.0 / kNeck) * at, kSeedOfNecks))
                            : 1.0;
    if (left <= 0.0) {
        return {};
    }
    TrailSection section;
    const double share = uneven * std::sqrt(left * (2.0 - left));  // pieces have round ends
    section.half_width = 0.5 * passage.width * narrow * share;
    // Its cross-section is ⅔ of height by width, and keeps the film's; where it is narrower its slopes are the same.
    section.height = 1.5 * film.thickness / narrow * share;
    const double drains = kDrains * passage.width * film.kinematic_viscosity /
                          (kStandardGravity * std::max(section.height * section.height, 1e-18));
    section.height /= std::sqrt(1.0 + age / drains);
    if (film.drying) {
        section.height *= std::max(1.0 - age / *film.drying, 0.0);
    }
    return section.height > 0.0 ? section : TrailSection{};
}

double settledAge(const TrailFilm& film, const Passage& passage)
{
    const double way = film.becomes_beads ? kUnbroken : kBreakUpWay;
    return passage.speed > 0.0 ? way * passage.width / passage.speed : 0.0;
}

double lifetime(const TrailFilm& film, const Passage& passage)
{
    constexpr double kForever = std::numeric_limits<double>::infinity();
    const double beads =
        film.becomes_beads && passage.speed > 0.0 ? kBreakUpWay * passage.width / passage.speed : kForever;
    return std::min(beads, film.drying.value_or(kForever));
}

}  // namespace droplet
