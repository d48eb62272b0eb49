// SPDX-License-Identifier: GPL-3.0-or-later
//
// The thesis, chapter 3: forces (3.2)–(3.5) by wind/forces.h, noise on the gravity along the windshield (3.2), merging
// (3.1.4) and the Lotus effect (3.1.5); small droplets stand still (3.2.2). Departures:
//
// - Droplets of all sizes merge when they touch. The thesis has a threshold on the difference of their masses, which
//   keeps equal ones apart. The larger one absorbs the other; water and momentum are conserved.
// - Still droplets are single droplets in cells, not texels of a picture. A running droplet absorbs the water that it
//   sweeps, and rain renews it.
// - Steps are exact for constant forces along a line. Friction is implicit, so droplets at rest do not jitter.
#include "droplet/windshield/windshield.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "blocks.h"
#include "droplet/error.h"
#include "droplet/wind/tunnel.h"
#include "require.h"
#include "union_find.h"
#include "wind/random.h"
#include "windshield/cap_scale.h"
#include "windshield/mist_cells.h"
#include "windshield/motion.h"
#include "windshield/runoff_cells.h"
#include "windshield/still_droplets.h"
#include "windshield/sweep.h"
#include "windshield/swept.h"
#include "windshield/tracks.h"

namespace droplet {
namespace {

double sphereVolume(double diameter)
{
    return std::numbers::pi / 6.0 * diameter * diameter * diameter;
}

/// One step of one state; run() calls the other functions in their order.
class Step {
public:
    Step(WindshieldState& state, const WindshieldParameters& parameters, double dt)
        : s_(state),
          still_(StillCells::of(state.still)),
          p_(parameters),
          dt_(dt),
          caps_(parameters.forces.wetting.contact_angle),
          rules_{caps_.reach(), sphereVolume(parameters.still_diameter)}
    {
    }

    void run()
    {
        rain();
        move();
        const TrackCells cells(tracks_, {p_.glass.width(), p_.glass.height()});
        drizzle(cells);
        merge(cells);
        gatherMist();
        sweepStill();
        breakUp(cells);
        wipe();
        removeBeyondEdges();
        s_.time += dt_;
    }

private:
    using Pair = std::pair<std::uint32_t, std::uint32_t>;

    /// Adds the drops that arrive within dt.
    void rain()
    {
        before_rain_ = s_.droplets.size();
        std::erase_if(s_.splashes, [this](const Splash& one) { return !lasts(one); });
        arrive();
        const RainImpacts impacts{raindropSizes(p_.rainfall), p_.raindrops, p_.vehicle.speedAt(s_.time + 0.5 * dt_)};
        const double bound = impacts.bound();
        if (!(bound > 0.0)) {
            return;
        }
        const RaindropSampler sampler(impacts);
        const double wetted = p_.runoff > 0.0 ? wettedShare(impacts) : 0.0;
        const double expected_in_step = bound * p_.glass.width() * p_.glass.height() * dt_;
        double expected = expected_in_step;
        while (s_.until_raindrop < expected) {
            expected -= s_.until_raindrop;
            const RandomStream random(p_.seed, RandomPurpose::Raindrop, s_.next_raindrop++);
            s_.until_raindrop = random.exponential(0);
            const Vec2 position{p_.glass.width() * random.uniform(1), p_.glass.height() * random.uniform(2)};
            const std::optional<GlassPlace> place = p_.glass.place(position);
            if (!place) {
                continue;
            }
            const double diameter = sampler.diameter(random.uniform(3), random.uniform(4));
            if (random.uniform(5) >= impacts.kept(diameter, {place->normal.z, place->normal.y})) {
                continue;
            }
            if (p_.splashes) {
                splash(diameter, impactSpeed(impacts, diameter, *place), position,
                       s_.time + dt_ * (1.0 - expected / expected_in_step));
            }
            const double volume = sphereVolume(diameter);
            s_.rained.add(volume);
            ++s_.counts.raindrops;
            const bool may_run = volume >= rules_.max;
            if (p_.runoff > 0.0 &&
                (thicknessAt(s_.film, position) > kWetFilm || (may_run && random.uniform(6) < wetted))) {
                layOut(s_.film, {p_.glass.width(), p_.glass.height()});
                const auto made = splashOf(diameter, impactSpeed(impacts, diameter, *place), p_.forces.liquid);
                pour(s_.film, position, made ? made->radius : 0.0, volume);
            } else if (may_run) {
                s_.droplets.push_back({s_.next_id++, position, {}, volume, 0.0, 0});
            } else {
                drizzle_.push_back({position, volume});
            }
        }
        s_.until_raindrop -= expected;
    }

    /// Speed of a raindrop perpendicular to the glass [m/s].
    static double impactSpeed(const RainImpacts& impacts, double diameter, const GlassPlace& place)
    {
        return terminalSpeed(diameter) * place.normal.z + impacts.speed * place.normal.y;
    }

    /// Share of the middle of the glass that raindrops have wetted within the lifetime of a film, where they splashed:
    /// circles that lie anywhere cover 1 − exp(−their area per area).
    double wettedShare(const RainImpacts& impacts) const
    {
        const std::optional<GlassPlace> middle = p_.glass.place({0.5 * p_.glass.width(), 0.5 * p_.glass.height()});
        const Exposure exposure = middle ? Exposure{middle->normal.z, middle->normal.y} : Exposure{};
        constexpr int kSizes = 32;
        const double each = p_.raindrops.max / kSizes;
        double area = 0.0;
        for (int k = 0; k < kSizes; ++k) {
            const double diameter = each * (k + 0.5);
            const double speed = terminalSpeed(diameter) * exposure.upward + impacts.speed * exposure.forward;
            if (const std::optional<Splash> made = splashOf(diameter, speed, p_.forces.liquid)) {
                area += each * impacts.density(diameter, exposure) * std::numbers::pi * made->radius * made->radius;
            }
        }
        return 1.0 - std::exp(-area * p_.runoff);
    }

    /// Adds the splash of a raindrop if its ring lasts beyond this step.
    void splash(double diameter, double speed, Vec2 position, double time)
    {
        if (std::optional<Splash> made = splashOf(diameter, speed, p_.forces.liquid)) {
            made->position = position;
            made->time = time;
            if (lasts(*made)) {
                s_.splashes.push_back(*made);
            }
        }
    }

    /// Whether a ring is there at the end of this step.
    bool lasts(const Splash& splash) const { return s_.time + dt_ < splash.time + splash.lifetime; }

    /// Adds the water of sprayers and fingers.
    void arrive()
    {
        for (const StillDroplet& drop : s_.arriving) {
            if (!p_.glass.holds(drop.position)) {
                s_.left.add(drop.volume);
            } else if (drop.volume >= rules_.max) {
                s_.droplets.push_back({s_.next_id++, drop.position, {}, drop.volume, 0.0, 0});
            } else {
                drizzle_.push_back(drop);
            }
        }
        s_.arriving.clear();
    }

    void move()
    {
        const std::size_t count = s_.droplets.size();
        tracks_.resize(count);
        owner_.resize(count);
        wind_.resize(count);
        std::iota(owner_.begin(), owner_.end(), 0U);
        grown_.assign(before_rain_, 0);
        grown_.resize(count, 1);  // raindrops may land on still droplets
        const double acceleration = p_.vehicle.meanAcceleration(s_.time, s_.time + dt_);
        speed_ = p_.vehicle.speedAt(s_.time + 0.5 * dt_);
        const double resting = restingVolume(acceleration);
        forBlocks(
            count,
            [&](std::size_t begin, std::size_t end) {
                for (std::size_t i = begin; i < end; ++i) {
                    moveOne(i, acceleration, resting);
                }
            },
            kDropletsPerBlock);
        moved_to_ = tracks_.to;
    }

    /// Volume below which no droplet at rest begins to move in this step, wherever it is and however it is shaken [m³].
    /// What drives it over what holds it grows with its volume.
    double restingVolume(double acceleration) const
    {
        if (p_.forces.wetting.sliding_angle) {
            return 0.0;
        }
        const double peak = 2.0 * std::numbers::sqrt3 * p_.fluctuation.acceleration;  // √6 of each component
        const double pushed = p_.forces.gravity + std::abs(acceleration) + peak;
        double low = 0.0;  // cube root [m]
        double high = 0.1;
        constexpr int kHalvings = 40;
        for (int k = 0; k < kHalvings; ++k) {
            const double middle = 0.5 * (low + high);
            const DropletForces forces = forcesOn(p_.forces, caps_.cap(middle * middle * middle));
            constexpr double kSafe = 1.0 - 1e-9;
            (forces.mass * pushed + forces.drag * speed_ * speed_ < kSafe * forces.retention ? low : high) = middle;
        }
        return low * low * low;
    }

    void moveOne(std::size_t i, double acceleration, double resting)
    {
        RunningDroplet& d = s_.droplets[i];
        tracks_.from[i] = d.position;
        const CapSize cap = caps_.cap(d.volume);
        tracks_.reach[i] = caps_.reach(cap);
        if (d.velocity == Vec2{} && d.volume < resting) {
            tracks_.to[i] = d.position;
            wind_[i].reset();
            return;
        }
        wind_[i] = Vec2{};
        if (const std::optional<GlassPlace> place = p_.glass.place(d.position)) {
            const DropletForces forces = forcesOn(p_.forces, cap);
            wind_[i] = windAlong(*place, speed_, p_.wind);
            const Vec2 wind = p_.relative_wind ? *wind_[i] - d.velocity : *wind_[i];
            const Vec2 push = gravityAlong(*place, p_.forces.gravity) + inertiaAlong(*place, acceleration) +
                              fluctuationOf(d.id, s_.time + 0.5 * dt_, p_.fluctuation, p_.seed);
            const Vec2 driving = forces.mass * push + (forces.drag * sizeOf(wind)) * wind;
            const MotionStep result = advance(forces, driving, d.velocity, dt_);
            d.position = d.position + result.displacement;
            d.velocity = result.velocity;
        }
        tracks_.to[i] = d.position;
    }

    /// Wind along the glass at a droplet's place before the step; none beside the glass.
    Vec2 windOn(std::size_t i) const
    {
        if (wind_[i]) {
            return *wind_[i];
        }
        const std::optional<GlassPlace> place = p_.glass.place(tracks_.from[i]);
        return place ? windAlong(*place, speed_, p_.wind) : Vec2{};
    }

    /// Adds small raindrops: each joins the first track that it touches, else still droplets that it touches.
    void drizzle(const TrackCells& cells)
    {
        for (StillDroplet drop : drizzle_) {
            bool is_placed = false;
            while (!is_placed && drop.volume < rules_.max) {
                if (const std::optional<std::uint32_t> track =
                        cells.touchedBy(drop.position, rules_.reachOf(drop.volume))) {
                    absorb(*track, drop.volume);
                    is_placed = true;
                } else {
                    is_placed = !joinStill(drop);
                }
            }
            if (!is_placed) {
                startRunning(drop);
            }
        }
    }

    /// Places a still droplet, or joins it with one that is removed from the glass; returns whether it was joined.
    bool joinStill(StillDroplet& drop)
    {
        const std::optional<StillDroplet> joined = placeOrJoin(still_, drop, rules_);
        drop = joined.value_or(drop);
        return joined.has_value();
    }

    /// Turns a still droplet, which has grown large enough, into a running one.
    void startRunning(const StillDroplet& drop)
    {
        addRunning(drop.position, {}, drop.volume);
        ++s_.counts.grown;
    }

    /// Adds a running droplet with an empty track.
    void addRunning(Vec2 position, Vec2 velocity, double volume)
    {
        owner_.push_back(static_cast<std::uint32_t>(s_.droplets.size()));
        s_.droplets.push_back({s_.next_id++, position, velocity, volume, 0.0, 0});
        tracks_.add(position, position, caps_.reach(volume));
        grown_.push_back(1);
    }

    /// Adds water that was at rest to a running droplet; momentum is conserved.
    void absorb(std::uint32_t i, double volume)
    {
        RunningDroplet& d = s_.droplets[i];
        d.velocity = (d.volume / (d.volume + volume)) * d.velocity;
        d.volume += volume;
        s_.merged.add(volume);
        grown_[i] = 1;
    }

    /// Merges each group of droplets that touch within the step into its largest one; of equal ones, into the first.
    void merge(const TrackCells& cells)
    {
        const std::vector<Pair> touching = cells.touchingPairs();
        UnionFind sets(owner_);
        for (const auto& [a, b] : touching) {
            sets.join(a, b);
        }
        std::vector<Pair> members;  // first member of a group, and a member
        members.reserve(2 * touching.size());
        for (const auto& [a, b] : touching) {
            members.emplace_back(sets.find(a), a);
            members.emplace_back(sets.find(b), b);
        }
        std::sort(members.begin(), members.end());
        members.erase(std::unique(members.begin(), members.end()), members.end());
        for (auto begin = members.begin(); begin != members.end();) {
            const auto end = std::find_if(begin, members.end(), [&](const Pair& m) { return m.first != begin->first; });
            mergeGroup({&*begin, static_cast<std::size_t>(end - begin)});
            begin = end;
        }
    }

    void mergeGroup(std::span<const Pair> members)
    {
        std::uint32_t largest = members.front().second;
        double volume = 0.0;
        Vec2 moment;
        Vec2 momentum;
        for (const auto& [first, i] : members) {
            const RunningDroplet& d = s_.droplets[i];
            volume += d.volume;
            moment = moment + d.volume * d.position;
            momentum = momentum + d.volume * d.velocity;
            if (d.volume > s_.droplets[largest].volume) {
                largest = i;
            }
        }
        for (const auto& [first, i] : members) {
            owner_[i] = largest;
            if (i != largest) {
                s_.merged.add(s_.droplets[i].volume);
                s_.droplets[i].volume = 0.0;
                ++s_.counts.merged;
            }
        }
        RunningDroplet& d = s_.droplets[largest];
        d.volume = volume;
        d.position = (1.0 / volume) * moment;
        d.velocity = (1.0 / volume) * momentum;
        grown_[largest] = 1;
    }

    /// Mist condenses, and droplets that move take it along.
    void gatherMist()
    {
        if (p_.mist > 0.0) {
            s_.condensed.add(growMist(s_.mist, {p_.glass.width(), p_.glass.height()}, p_.mist * dt_));
        }
        if (s_.mist.thickness.empty()) {
            return;
        }
        for (std::uint32_t i = 0; i < moved_to_.size(); ++i) {
            if (tracks_.from[i] != moved_to_[i]) {
                if (const double taken = takeMist(s_.mist, {tracks_.from[i], moved_to_[i], tracks_.reach[i]});
                    taken > 0.0) {
                    absorb(owner_[i], taken);
                }
            }
        }
    }

    /// The Lotus effect: a running droplet absorbs still droplets on its way. It grows, and then absorbs those that it
    /// touches now: if it rests, at once and until there are none; if it moves, in the next step.
    void sweepStill()
    {
        std::vector<SweptPiece> pieces;
        for (std::uint32_t i = 0; i < s_.droplets.size(); ++i) {
            RunningDroplet& d = s_.droplets[i];
            if (d.volume > 0.0) {
                if (grown_[i] != 0) {
                    tracks_.reach[i] = caps_.reach(d.volume);
                }
                tracks_.to[i] = d.position;
            }
            if (tracks_.from[i] != tracks_.to[i] || (d.volume > 0.0 && grown_[i] != 0)) {
                pieces.push_back({owner_[i], tracks_.from[i], tracks_.to[i], tracks_.reach[i]});
            }
        }
        absorbSwept(std::move(pieces));
    }

    void absorbSwept(std::vector<SweptPiece> pieces)
    {
        StillRemoval removal(still_);
        while (!pieces.empty()) {
            std::vector<std::uint32_t> grown;
            for (const SweptDroplet& swept : sweptBy(pieces, still_, rules_)) {
                if (const double volume = removal.take(swept.still); volume > 0.0) {
                    absorb(swept.owner, volume);
                    s_.swept.add(volume);
                    ++s_.counts.swept;
                    if (s_.droplets[swept.owner].velocity == Vec2{}) {
                        grown.push_back(swept.owner);
                    }
                }
            }
            std::sort(grown.begin(), grown.end());
            grown.erase(std::unique(grown.begin(), grown.end()), grown.end());
            pieces.clear();
            for (const std::uint32_t i : grown) {
                const RunningDroplet& d = s_.droplets[i];
                tracks_.reach[i] = caps_.reach(d.volume);
                pieces.push_back({i, d.position, d.position, tracks_.reach[i]});
            }
        }
        removal.close();
    }

    /// Splits droplets after all have moved and merged: the wind tears some, others leave streaks behind.
    void breakUp(const TrackCells& cells)
    {
        const std::size_t count = s_.droplets.size();
        tearOff(cells);
        for (std::size_t i = 0; p_.streaks.film > 0.0 && i < count; ++i) {
            if (s_.droplets[i].volume > 0.0 && tracks_.from[i] != tracks_.to[i]) {
                leaveStreak(i);
            }
        }
        runOff();
        std::vector<SweptPiece> pieces;
        for (std::size_t i = count; i < s_.droplets.size(); ++i) {
            pieces.push_back({static_cast<std::uint32_t>(i), tracks_.to[i], tracks_.to[i], tracks_.reach[i]});
        }
        absorbSwept(std::move(pieces));
    }

    /// The film takes droplets where it is deep, runs off, and breaks up where it is thin.
    void runOff()
    {
        if (s_.film.thickness.empty()) {
            return;
        }
        for (std::size_t i = 0; i < s_.droplets.size(); ++i) {
            RunningDroplet& d = s_.droplets[i];
            if (d.volume > 0.0 && p_.glass.holds(d.position) && thicknessAt(s_.film, d.position) > kDeepFilm) {
                pour(s_.film, d.position, tracks_.reach[i], d.volume);
                d.volume = 0.0;
            }
        }
        StillRemoval removal(still_);
        constexpr double kDeep = kDeepFilm / Runoff::kThickness;
        for (std::size_t cell = 0; cell < s_.film.thickness.size(); ++cell) {
            if (still_.counts[cell] > 0 && s_.film.thickness[cell] > kDeep) {
                for (std::uint8_t k = 0; k < still_.counts[cell]; ++k) {
                    const Vec2 position = still_.droplets(cell)[k].position;
                    pour(s_.film, position, 0.0, removal.take({cell, k}));
                }
            }
        }
        removal.close();
        const double acceleration = p_.vehicle.meanAcceleration(s_.time, s_.time + dt_);
        // As a droplet that is as high as the film: its drag is that of a layer with the thesis' profile.
        constexpr double kThinnestLayer = 1e-3;  // [m]
        const Air& air = p_.forces.air;
        const double drag = 0.5 * air.density * air.drag_coefficient /
                            (p_.forces.liquid.density * std::max(air.boundary_layer, kThinnestLayer));
        s_.left.add(flow(s_.film, p_.forces.liquid, dt_, [&](Vec2 position) -> std::optional<Vec2> {
            const std::optional<GlassPlace> place = p_.glass.place(position);
            if (!place) {
                return std::nullopt;
            }
            const Vec2 wind = windAlong(*place, speed_, p_.wind);
            return gravityAlong(*place, p_.forces.gravity) + inertiaAlong(*place, acceleration) +
                   (drag * sizeOf(wind)) * wind;
        }));
        const double share = p_.runoff > dt_ ? dt_ / p_.runoff : 1.0;
        for (StillDroplet drop : droplet::breakUp(s_.film, share, p_.seed)) {
            while (drop.volume < rules_.max && joinStill(drop)) {
            }
            if (drop.volume >= rules_.max) {
                startRunning(drop);
            }
        }
    }

    /// Splits droplets that are too high for the wind. What is left stays where the droplet itself would be, even if
    /// it has merged in this step; the parts are scattered downwind, each in the next free place or beyond the edge.
    /// No part is too small to run; water and momentum are conserved.
    void tearOff(const TrackCells& cells)
    {
        std::vector<Torn> torn;
        double fastest = 0.0;  // squared; no wind along the glass is faster than the car
        for (std::size_t i = 0; i < wind_.size(); ++i) {
            const Vec2 velocity = s_.droplets[i].velocity;
            const double most = std::abs(speed_) + (velocity == Vec2{} ? 0.0 : sizeOf(velocity));
            fastest = std::max(fastest, most * most);
        }
        constexpr double kSafe = 1.0 - 1e-9;
        const double least = kSafe * stableVolume(std::sqrt(fastest));
        for (std::uint32_t i = 0; i < wind_.size(); ++i) {
            if (s_.droplets[i].volume > least && windOn(i) != Vec2{}) {
                if (Torn one = tornFrom(i); !one.parts.empty()) {
                    // A merger moved it to the centre of a group that does not last.
                    s_.droplets[i].position = moved_to_[i];
                    torn.push_back(std::move(one));
                }
            }
        }
        if (torn.empty()) {
            return;
        }
        // Droplets that are not where their tracks have them, or are larger.
        Tracks changed;
        for (std::size_t i = 0; i < s_.droplets.size(); ++i) {
            if (const RunningDroplet& d = s_.droplets[i]; d.volume > 0.0 && grown_[i] != 0) {
                changed.add(d.position, d.position, caps_.reach(d.volume));
            }
        }
        for (const Torn& one : torn) {
            placeParts(one, cells, changed);
        }
    }

    struct Torn {
        std::uint32_t droplet = 0;
        Vec2 wind;                  // relative to the droplet
        std::vector<double> parts;  // their volumes, one at least; the droplet keeps the rest
    };

    /// Largest volume that a wind along the glass does not tear off [m³].
    double stableVolume(double wind) const
    {
        return caps_.volumeOfHeight(tearOffHeight(p_.forces, wind, p_.tear_off_weber));
    }

    /// Parts that the wind tears from a droplet; none if it is not too high.
    Torn tornFrom(std::uint32_t i) const
    {
        // Parts have half of the largest volume that is stable, to all of it.
        constexpr double kSmallest = 0.5;
        const RunningDroplet& d = s_.droplets[i];
        Torn torn{i, windOn(i) - d.velocity, {}};
        const double stable = stableVolume(sizeOf(torn.wind));
        const RandomStream random(p_.seed, RandomPurpose::TornPart, d.id);
        // An id may be torn more than once.
        const std::uint64_t first = mix(s_.next_id);
        double rest = d.volume;
        while (rest > stable) {
            const double least = std::max(rules_.max, kSmallest * stable);
            const double most = std::min(std::max(stable, rules_.max), rest - rules_.max);
            if (most < least) {
                break;
            }
            torn.parts.push_back(least + (most - least) * random.uniform(first + torn.parts.size()));
            rest -= torn.parts.back();
        }
        return torn;
    }

    /// Places the parts of a torn droplet downwind of it.
    /// @param cells  droplets before any was torn
    /// @param other  places of those that have changed since, and of parts
    void placeParts(const Torn& torn, const TrackCells& cells, Tracks& other)
    {
        // A part lies up to so far aside, over its distance downwind.
        constexpr double kSpread = 0.6;
        const auto is_free = [&](Vec2 place, double reach) {
            for (std::size_t k = 0; k < other.count(); ++k) {
                if (sizeOf(other.to[k] - place) <= other.reach[k] + reach) {
                    return false;
                }
            }
            return !cells.hasNear(place, reach, [&](std::uint32_t i) {
                const RunningDroplet& d = s_.droplets[i];
                const Vec2 apart = d.position - place;
                const double touching = tracks_.reach[i] + reach;
                return d.volume > 0.0 && grown_[i] == 0 && dot(apart, apart) <= touching * touching;
            });
        };
        RunningDroplet& whole = s_.droplets[torn.droplet];
        const Vec2 velocity = whole.velocity;
        const Vec2 downwind = (1.0 / sizeOf(torn.wind)) * torn.wind;
        const Vec2 aside{-downwind.y, downwind.x};
        for (const double part : torn.parts) {
            whole.volume -= part;
        }
        Vec2 place = whole.position;
        for (const double part : torn.parts) {
            const RandomStream random(p_.seed, RandomPurpose::TornPart, s_.next_id);
            const double reach = caps_.reach(part);
            const double slant = kSpread * (2.0 * random.uniform(0) - 1.0);
            const Vec2 onward = (reach * (1.0 + random.uniform(1))) * (downwind + slant * aside);
            place = place + onward;
            while (p_.glass.holds(place) && !(p_.glass.holds(place + onward) && is_free(place, reach))) {
                place = place + onward;
            }
            addRunning(place, velocity, part);
            other.add(place, place, reach);
            ++s_.counts.torn;
        }
    }

    /// Leaves the film behind a moving droplet, as still droplets at random distances along the track and beside its
    /// middle.
    void leaveStreak(std::size_t i)
    {
        constexpr double kBeadSpread = 0.4;  // of half the track's width
        const double distance = sizeOf(tracks_.to[i] - tracks_.from[i]);
        const Vec2 direction = (1.0 / distance) * (tracks_.to[i] - tracks_.from[i]);
        const RandomStream random(p_.seed, RandomPurpose::Bead, s_.droplets[i].id);
        double at = -s_.droplets[i].since_bead;  // position of the last bead along the track
        while (true) {
            RunningDroplet& d = s_.droplets[i];
            const double spacing = p_.streaks.spacing * (0.5 + random.uniform(d.beads));
            if (at + spacing > distance) {
                break;
            }
            at += spacing;
            ++d.beads;
            // A bead is too small to run, and the droplet stays large enough to run.
            const double bead = std::min(p_.streaks.film * 2.0 * tracks_.reach[i] * spacing, 0.5 * rules_.max);
            const double behind =
                1.05 * (tracks_.reach[i] + rules_.reachOf(bead));  // far enough that they do not touch
            const double aside = kBeadSpread * tracks_.reach[i] * (2.0 * random.uniform(~d.beads) - 1.0);
            const Vec2 place = tracks_.from[i] + (at - behind) * direction + aside * Vec2{-direction.y, direction.x};
            if (d.volume - bead >= rules_.max && p_.glass.holds(place)) {
                d.volume -= bead;
                s_.shed.add(bead);
                StillDroplet left{place, bead};
                while (left.volume < rules_.max && joinStill(left)) {
                }
                if (left.volume >= rules_.max) {
                    startRunning(left);
                }
            }
        }
        s_.droplets[i].since_bead = distance - at;
    }

    void wipe()
    {
        for (const Wiper& wiper : p_.wipers) {
            const std::optional<Sweep> blade = Sweep::of(wiper, s_.time, s_.time + dt_);
            if (!blade) {
                continue;
            }
            for (std::size_t i = 0; i < s_.droplets.size(); ++i) {
                RunningDroplet& d = s_.droplets[i];
                if (d.volume > 0.0 && blade->meets(tracks_.from[i], d.position)) {
                    s_.wiped.add(d.volume);
                    ++s_.counts.wiped;
                    d.volume = 0.0;
                }
            }
            std::erase_if(s_.splashes, [&](const Splash& one) { return blade->covers(one.position); });
            s_.wiped.add(takeMist(s_.mist, *blade));
            s_.wiped.add(takeRunoff(s_.film, *blade));
            StillRemoval removal(still_);
            blade->visitCells(still_.grid(), [&](std::size_t first, std::size_t last) {
                for (std::size_t cell = first; cell <= last; ++cell) {
                    const auto here = still_.droplets(cell);
                    for (std::size_t k = 0; k < here.size(); ++k) {
                        if (blade->covers(here[k].position)) {
                            s_.wiped.add(removal.take({cell, static_cast<std::uint8_t>(k)}));
                            ++s_.counts.wiped;
                        }
                    }
                }
            });
            removal.close();
        }
    }

    void removeBeyondEdges()
    {
        s_.tracks.clear();
        std::size_t kept = 0;
        for (std::size_t i = 0; i < s_.droplets.size(); ++i) {
            RunningDroplet& d = s_.droplets[i];
            if (tracks_.from[i] != tracks_.to[i]) {
                s_.tracks.push_back({d.id, tracks_.from[i], tracks_.to[i], tracks_.reach[i]});
            }
            if (d.volume > 0.0 && !p_.glass.holds(d.position)) {
                s_.left.add(d.volume);
                ++s_.counts.left;
                d.volume = 0.0;
            }
            if (d.volume > 0.0) {
                s_.droplets[kept++] = d;
            }
        }
        s_.droplets.resize(kept);
    }

    WindshieldState& s_;
    StillCells& still_;
    const WindshieldParameters& p_;
    double dt_;
    double speed_ = 0.0;  // of the car
    CapScale caps_;
    StillRules rules_;
    std::vector<StillDroplet> drizzle_;  // small raindrops of this step
    std::size_t before_rain_ = 0;        // number of running droplets before the rain
    // One entry for each running droplet, in their order:
    Tracks tracks_;
    std::vector<Vec2> moved_to_;             // its place after it moved, before it merged
    std::vector<std::optional<Vec2>> wind_;  // wind along the glass at its place before the step, if it was needed
    std::vector<std::uint32_t> owner_;       // droplet that has its water
    std::vector<std::uint8_t> grown_;
};

}  // namespace

WindshieldState startWindshield(const WindshieldParameters& parameters)
{
    parameters.validate();
    WindshieldState state;
    StillCells::of(state.still) = StillCells::over({parameters.glass.width(), parameters.glass.height()});
    return state;
}

WindshieldState step(WindshieldState state, const WindshieldParameters& parameters, double dt)
{
    parameters.validate();
    require(dt > 0.0 && std::isfinite(dt), "dt", dt, "finite and more than 0 s");
    const Cells cells = Cells::over({parameters.glass.width(), parameters.glass.height()}, kStillCell);
    const Cells own = StillCells::of(state.still).grid();
    if (own.columns != cells.columns || own.rows != cells.rows || own.width != cells.width) {
        throw Error(ErrorCode::InvalidArgument, "state belongs to a glass of " + std::to_string(own.columns) + " x " +
                                                    std::to_string(own.rows) + " cells; this one has " +
                                                    std::to_string(cells.columns) + " x " + std::to_string(cells.rows));
    }
    Step(state, parameters, dt).run();
    return state;
}

}  // namespace droplet
