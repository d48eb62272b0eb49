// SPDX-License-Identifier: GPL-3.0-or-later
// P. Fournier, A. Habibi, P. Poulin, "Simulating the flow of liquid droplets", Graphics Interface 1998, section 2.
// Departures: droplets merge in steps of their own, where the paper's merge at frames; what their streaks do to the
// next ones they do not do to themselves; streaks hold liquid, which the paper's do not.
#include "droplet/flow/flow.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <numbers>
#include <span>
#include <unordered_map>
#include <utility>

#include "blocks.h"
#include "droplet/error.h"
#include "droplet/flow/flow_shapes.h"
#include "flow/break_up.h"
#include "flow/flow_forces.h"
#include "flow/flow_terrain_content.h"
#include "flow/following.h"
#include "flow/hollow.h"
#include "flow/joined_faces.h"
#include "flow/ponds.h"
#include "flow/touching.h"
#include "flow/walk.h"
#include "number_text.h"
#include "require.h"
#include "union_find.h"
#include "wind/random.h"

namespace droplet {
namespace {

// Droplets in a block of work for one thread.
constexpr std::size_t kDropletsPerBlock = 64;
// Dew grows once in so many steps.
constexpr std::uint64_t kStepsOfDew = 12;
// A new droplet of dew is so much smaller than the distance to the next.
constexpr double kNucleusShare = 0.05;
// A droplet is gone when it is so many diameters of the object away.
constexpr double kAway = 2.0;

using Pair = std::pair<std::uint32_t, std::uint32_t>;

/// Walks droplets through one step.
class Step {
public:
    Step(const FlowTerrain& terrain, const FlowParameters& parameters, FlowState& state)
        : c_(terrain.content()),
          terrain_(terrain),
          p_(parameters),
          s_(state),
          pinning_(parameters.pinning, RandomStream(parameters.seed, RandomPurpose::Pinning, 0).bits(0)),
          begin_(timeOf(state.steps))
    {
        update();
    }

    /// Puts a droplet where it starts, at the begin of the present step.
    void start(const FlowStart& start)
    {
        FlowDroplet droplet;
        droplet.id = s_.next_id++;
        droplet.volume = start.volume;
        droplet.has_grown = true;
        droplet.born = begin_;
        droplet.leg = {begin_, start.place, start.velocity, {}, 0.0};
        const FlowTerrain::Point point = terrain_.nearest(start.place);
        droplet.face = point.face;
        const WalkForces forces = forcesOf(droplet);
        if (length(point.place - start.place) <= 0.5 * forces.contact_width) {
            putOnFace(walkField(), forces, droplet, point.face, {begin_, point.place, start.velocity, {}, 0.0});
        } else {
            const GroundMotion::Drift drift = c_.motion.driftOf(droplet.face, begin_);
            droplet.leg = {begin_, start.place - drift.way, start.velocity - drift.velocity, forces.fall, 0.0};
        }
        s_.released.add(droplet.volume);
        ++s_.counts.released;
        s_.droplets.push_back(droplet);
        forces_.push_back(forces);
    }

    /// Takes over droplets and trails from another shape of the surface, at the begin of the present step. Those on a
    /// face follow it. Those in the air go on as they do in space, unless the ground has met them.
    void follow(const FlowTerrain& from)
    {
        const std::vector<FlowSurface::Face>& before = from.surface().faces;
        const std::vector<FlowSurface::Face>& now = c_.surface.faces;
        const bool has_moved = moves() || !from.motion().rests();
        const WalkField field = walkField();
        forBlocks(
            s_.droplets.size(),
            [&](std::size_t first, std::size_t last) {
                for (std::size_t i = first; i < last; ++i) {
                    FlowDroplet& d = s_.droplets[i];
                    const FlowSurface::Face& was = before[d.face];
                    const FlowSurface::Face& is = now[d.face];
                    if (d.contact == FlowContact::Air) {
                        followInAir(from, d, forces_[i]);
                    } else if (has_moved || was.corners != is.corners) {
                        const Vec3 velocity = turnedWith(was, is, d.leg.velocityAt(begin_));
                        d.leg = {begin_, followed(was, is, d.leg.placeAt(begin_)), velocity, {}, 0.0};
                        d.heading = turnedWith(was, is, d.heading);
                        d.has_grown = true;  // neighbours may have come nearer
                        forces_[i] = forcesOf(d);
                        redirect(field, forces_[i], d, begin_);
                    }
                }
            },
            kDropletsPerBlock);
        for (FlowState::Trail& trail : s_.trails) {
            trail.place = followed(before[trail.face], now[trail.face], trail.place);
        }
    }

    void run()
    {
        arrive();
        if (moves()) {
            redirectAll();
        }
        move(timeOf(s_.steps + 1), true);
        if (p_.merges) {
            merge();
        }
        if (p_.wets) {
            wet();
        }
        if (p_.streaks.film > 0.0) {
            leaveFilm();
        }
        dry();
        if (p_.condensation && s_.steps % kStepsOfDew == kStepsOfDew - 1) {
            grow();
        }
        runOver();
        leave();
        s_.tracks.insert(s_.tracks.end(), tracks_.begin(), tracks_.end());
        ++s_.steps;
        begin_ = timeOf(s_.steps);
        update();
    }

    /// Moves all droplets to a time in the step that begins, without their meetings.
    void moveWithin(double until)
    {
        if (moves()) {
            redirectAll();
        }
        move(until, false);
    }

private:
    [[nodiscard]] double timeOf(std::uint64_t steps) const { return static_cast<double>(steps) * p_.step; }
    [[nodiscard]] double end() const { return timeOf(s_.steps + 1); }

    /// Field, forces and ground for the step that begins.
    void update()
    {
        if (forces_.empty() || moves() || !p_.ground.contact_angle.empty()) {
            field_ = fieldAt(p_, begin_);
            forces_.resize(s_.droplets.size());
            forBlocks(
                forces_.size(),
                [&](std::size_t first, std::size_t last) {
                    for (std::size_t i = first; i < last; ++i) {
                        forces_[i] = forcesOf(s_.droplets[i]);
                    }
                },
                kDropletsPerBlock);
        }
    }

    [[nodiscard]] WalkForces forcesOf(const FlowDroplet& droplet) const
    {
        WalkForces forces = forcesOn(p_, field_, droplet, p_.motion.rests() ? std::nullopt : std::optional(begin_));
        if (!c_.motion.rests()) {
            forces.acceleration = forces.acceleration + c_.feltOn(droplet, begin_);
            forces.fall = forces.fall - c_.motion.driftOf(droplet.face, begin_).acceleration;
        }
        return forces;
    }

    /// Whether the ground has accelerations, which differ from step to step.
    [[nodiscard]] bool moves() const { return !p_.motion.rests() || !c_.motion.rests(); }

    /// In the air a droplet's place and velocity are less by what the nearest face drifts, so that it meets the ground
    /// where both are in space.
    void followInAir(const FlowTerrain& from, FlowDroplet& d, WalkForces& forces)
    {
        const Vec3 place = d.leg.placeAt(begin_);
        const GroundMotion::Drift drifted = from.motion().driftOf(d.face, begin_);
        const FlowTerrain::Point ground = from.nearest(place);
        const FlowSurface::Face& was = from.surface().faces[ground.face];
        const FlowSurface::Face& is = c_.surface.faces[ground.face];
        if (c_.motion.rests() && from.motion().rests() && was.corners == is.corners) {
            return;
        }
        d.face = ground.face;
        const GroundMotion::Drift drift = c_.motion.driftOf(d.face, begin_);
        const Vec3 to = place + drifted.way - drift.way;
        const Vec3 velocity = d.leg.velocityAt(begin_) + drifted.velocity - drift.velocity;
        d.leg = {begin_, to, velocity, {}, 0.0};
        forces = forcesOf(d);
        d.leg.push = forces.fall;
        // Seen from the ground it came from there: the ground may have swept over it.
        const Vec3 away = followed(was, is, ground.place) + turnedWith(was, is, place - ground.place);
        if (const auto hit = c_.landing.next({0.0, away, to - away, {}, 0.0}, d.face, 0.0, 1.0)) {
            putOnFace(walkField(), forces, d, hit->face, {begin_, hit->place, velocity, {}, 0.0});
        }
    }

    /// A place on a face, in the shape of the surface that pinning belongs to.
    [[nodiscard]] Vec3 atRest(std::uint32_t face, Vec3 place) const
    {
        return c_.rest ? followed(c_.surface.faces[face], c_.rest->faces[face], place) : place;
    }

    [[nodiscard]] WalkField walkField() const
    {
        WalkFaces ground;
        const bool has_ground =
            !(p_.ground.roughness.empty() && p_.ground.friction.empty() && p_.ground.hysteresis.empty());
        ground.faces = has_ground ? &p_.ground : nullptr;
        ground.roughness = p_.roughness;
        if (p_.wets) {
            ground.wetness = s_.wetness;
            ground.dry_before = dryBefore();
            ground.wet_is_slippery = p_.model == FlowModel::Capillary;
        }
        return {c_.surface,
                c_.landing,
                ground,
                isPinned() ? &pinning_ : nullptr,
                c_.motion.rests() ? nullptr : &c_.motion,
                c_.rest.get()};
    }

    [[nodiscard]] bool isPinned() const { return p_.model == FlowModel::Capillary && !pinning_.isEven(); }

    [[nodiscard]] double dryBefore() const
    {
        return p_.drying ? begin_ - *p_.drying : -std::numeric_limits<double>::infinity();
    }

    void redirectAll()
    {
        const WalkField field = walkField();
        forBlocks(
            s_.droplets.size(),
            [&](std::size_t first, std::size_t last) {
                for (std::size_t i = first; i < last; ++i) {
                    redirect(field, forces_[i], s_.droplets[i], begin_);
                }
            },
            kDropletsPerBlock);
    }

    /// Walks and tracks of a block of droplets.
    struct Walked {
        std::vector<FlowTrack> tracks;
        std::vector<Vec2> shares;  // of the faces that the tracks wet
        WalkCounts counts;
    };

    void move(double until, bool records)
    {
        const WalkField field = walkField();
        const std::size_t count = s_.droplets.size();
        from_.resize(count);
        const std::vector<Walked> blocks = mapBlocks<Walked>(
            count,
            [&](std::size_t first, std::size_t last) {
                Walked walked;
                for (std::size_t i = first; i < last; ++i) {
                    FlowDroplet& d = s_.droplets[i];
                    from_[i] = d.leg.placeAt(std::max(begin_, d.leg.begin));
                    if (d.contact == FlowContact::Still) {
                        continue;
                    }
                    const WalkCounts c = walk(field, forces_[i], d, until, records ? &walked.tracks : nullptr, begin_);
                    for (std::size_t t = walked.shares.size(); p_.wets && t < walked.tracks.size(); ++t) {
                        walked.shares.push_back(wetShare(walked.tracks[t]));
                    }
                    walked.counts.crossings += c.crossings;
                    walked.counts.launches += c.launches;
                    walked.counts.landings += c.landings;
                    walked.counts.stuck += c.stuck;
                }
                return walked;
            },
            kDropletsPerBlock);
        tracks_.clear();
        shares_.clear();
        for (const Walked& block : blocks) {
            shares_.insert(shares_.end(), block.shares.begin(), block.shares.end());
            tracks_.insert(tracks_.end(), block.tracks.begin(), block.tracks.end());
            s_.counts.crossings += block.counts.crossings;
            s_.counts.launches += block.counts.launches;
            s_.counts.landings += block.counts.landings;
            s_.counts.stuck += block.counts.stuck;
        }
    }

    // ---- sources

    void arrive()
    {
        for (std::size_t e = 0; e < p_.emitters.size(); ++e) {
            const FlowEmitter& emitter = p_.emitters[e];
            FlowState::Emission& emission = s_.emissions[e];
            emission.pending += emitter.rate * p_.step;
            for (;;) {
                const RandomStream random(p_.seed, RandomPurpose::Emission,
                                          (std::uint64_t{e} << 40U) + emission.released);
                const double volume = emitter.volumes.at(random.uniform(0), random.uniform(1));
                if (emission.pending < volume) {
                    break;
                }
                emission.pending -= volume;
                ++emission.released;
                start({emitter.place, volume, {}});
            }
        }
        if (p_.rain && p_.rain->rainfall > 0.0) {
            rain();
        }
        if (p_.condensation && s_.steps % kStepsOfDew == 0) {
            nucleate();
        }
    }

    void rain()
    {
        const FlowRain& rain = *p_.rain;
        const RainImpacts impacts{
            raindropSizes(rain.rainfall), {std::max(rain.small_diameter, rain.raindrops.min), rain.raindrops.max}, 0.0};
        const double radius = 0.5 * terrain_.diameter();
        const double rate = impacts.bound() * std::numbers::pi * radius * radius;
        if (!(rate > 0.0)) {
            return;
        }
        const RaindropSampler sampler(impacts);
        const Vec3 from = (1.0 / length(rain.from)) * rain.from;
        const Vec3 any = std::abs(from.z) < 0.9 ? Vec3{0.0, 0.0, 1.0} : Vec3{1.0, 0.0, 0.0};
        const Vec3 across = (1.0 / length(cross(any, from))) * cross(any, from);
        const Vec3 beyond = cross(from, across);
        s_.until_raindrop -= rate * p_.step;
        while (s_.until_raindrop <= 0.0) {
            const RandomStream random(p_.seed, RandomPurpose::Raindrop, s_.next_raindrop++);
            s_.until_raindrop += random.exponential(0);
            const double diameter = sampler.diameter(random.uniform(1), random.uniform(2));
            const double out = radius * std::sqrt(random.uniform(3));
            const double turn = 2.0 * std::numbers::pi * random.uniform(4);
            const Vec3 origin =
                c_.middle() + 2.0 * radius * from + (out * std::cos(turn)) * across + (out * std::sin(turn)) * beyond;
            const auto point = terrain_.firstAlong(origin, -1.0 * from);
            const double volume = std::numbers::pi / 6.0 * diameter * diameter * diameter;
            if (point && dot(c_.surface.faces[point->face].normal, from) > 0.0) {
                start({point->place, volume, {}});
                ++s_.counts.raindrops;
            } else if (point) {
                ++s_.counts.behind;
                s_.counts.behind_volume += volume;
            }
        }
    }

    void nucleate()
    {
        const double spacing = p_.condensation->spacing;
        const double room = terrain_.area() / (spacing * spacing) - static_cast<double>(s_.droplets.size());
        const double seconds = static_cast<double>(kStepsOfDew) * p_.step;
        s_.until_nucleus -= std::max(room, 0.0) * seconds;  // a dry surface is covered within about a second
        while (s_.until_nucleus <= 0.0) {
            const RandomStream random(p_.seed, RandomPurpose::Nucleus, s_.next_nucleus++);
            s_.until_nucleus += random.exponential(0);
            const FlowTerrain::Point point = terrain_.pointAt(random.uniform(1), random.uniform(2));
            // As wide as that from above, beyond 90° at its equator.
            const double angle = p_.contactAngleOn(point.face);
            const double contact = kNucleusShare * spacing * std::sin(std::max(angle, 0.5 * std::numbers::pi));
            start({point.place, capVolume(contact, angle), {}});
        }
    }

    // ---- meetings

    [[nodiscard]] const Vec3& normalOf(const FlowDroplet& droplet) const
    {
        return c_.surface.faces[droplet.face].normal;
    }

    /// Whether droplets on two sides of a sharp edge touch. The way over a convex edge is longer than the straight one:
    /// it is measured over both planes, unfolded. The edge of a thin sheet is two edges, so its sides stay apart.
    [[nodiscard]] bool meetOverEdge(const FlowDroplet& a, const FlowDroplet& b, Vec3 apart, double reach) const
    {
        const Vec3 edge = cross(normalOf(a), normalOf(b));
        const double sine = length(edge);
        const double from_a = dot(normalOf(b), apart);  // over the sine, the distance to the edge
        const double from_b = -dot(normalOf(a), apart);
        if (from_a <= 0.0 && from_b <= 0.0) {
            return true;  // they stand before each other in a corner
        }
        return std::hypot(std::max(from_a, 0.0) + std::max(from_b, 0.0), dot(edge, apart)) < reach * sine;
    }

    void merge()
    {
        const std::size_t count = s_.droplets.size();
        std::vector<MovingBall> balls(count);
        for (std::size_t i = 0; i < count; ++i) {
            FlowDroplet& d = s_.droplets[i];
            if (d.contact != FlowContact::Air) {
                balls[i] = {from_[i], d.leg.placeAt(end()), 0.5 * forces_[i].contact_width,
                            d.has_grown || d.contact != FlowContact::Still || d.leg.begin > begin_};
                d.has_grown = false;
            }
        }
        // A pond is asked about every raindrop that falls into it, so its search goes on from one to the next.
        std::vector<std::unique_ptr<JoinedFaces>> joined_faces(count);
        std::array<std::mutex, 64> searching;  // of every 64th droplet
        const auto are_joined = [&](std::uint32_t i, std::uint32_t to, double reach) {
            const std::uint32_t from = s_.droplets[i].face;
            const auto& neighbours = c_.surface.faces[from].neighbour;
            if (from == to || std::find(neighbours.begin(), neighbours.end(), to) != neighbours.end()) {
                return true;  // a droplet's own face is near it
            }
            const std::lock_guard<std::mutex> lock(searching[i % searching.size()]);
            if (!joined_faces[i]) {
                joined_faces[i] = std::make_unique<JoinedFaces>(c_.surface, from, balls[i].to);
            }
            return joined_faces[i]->has(to, reach);
        };
        const std::vector<Pair> joined = connectingPairs(balls, [&](std::uint32_t i, std::uint32_t j) {
            const FlowDroplet& a = s_.droplets[i];
            const FlowDroplet& b = s_.droplets[j];
            const Vec3 apart = balls[j].to - balls[i].to;
            return (dot(normalOf(a), normalOf(b)) > 0.0 ||
                    meetOverEdge(a, b, apart, balls[i].reach + balls[j].reach)) &&
                   are_joined(i, b.face, length(apart) * (1.0 + 1e-9));
        });
        UnionFind sets(count);
        std::vector<std::uint32_t> members;
        for (const auto& [i, j] : joined) {
            sets.join(i, j);
            members.push_back(i);
            members.push_back(j);
        }
        joinPonds(balls, sets, members);
        std::sort(members.begin(), members.end());
        members.erase(std::unique(members.begin(), members.end()), members.end());
        std::vector<Pair> grouped;
        grouped.reserve(members.size());
        for (const std::uint32_t i : members) {
            grouped.emplace_back(sets.find(i), i);
        }
        std::sort(grouped.begin(), grouped.end());
        for (auto first = grouped.begin(); first != grouped.end();) {
            const auto last =
                std::find_if(first, grouped.end(), [&](const Pair& m) { return m.first != first->first; });
            mergeGroup({first, last});
            first = last;
        }
    }

    /// The largest of a group takes up the others; of equal ones, the first.
    void mergeGroup(std::span<const Pair> members)
    {
        std::uint32_t largest = members.front().second;
        double volume = 0.0;
        double drying = 0.0;
        Vec3 moment;
        Vec3 momentum;
        for (const auto& [first, i] : members) {
            const FlowDroplet& d = s_.droplets[i];
            volume += d.volume;
            drying += d.drying;
            moment = moment + d.volume * d.leg.placeAt(end());
            momentum = momentum + d.volume * d.leg.velocityAt(end());
            if (d.volume > s_.droplets[largest].volume) {
                largest = i;
            }
        }
        for (const auto& [first, i] : members) {
            if (i != largest) {
                s_.droplets[i].volume = 0.0;
                ++s_.counts.merged;
            }
        }
        FlowDroplet& d = s_.droplets[largest];
        const Vec3 place = d.leg.placeAt(end());
        d.volume = volume;
        d.drying = d.drying > 0.0 ? drying : 0.0;
        d.has_grown = true;
        const auto [face, centre] = pointBeside(d.face, place, (1.0 / volume) * moment - place);
        forces_[largest] = forcesOf(d);
        putOnFace(walkField(), forces_[largest], d, face, {end(), centre, (1.0 / volume) * momentum, {}, 0.0});
    }

    /// Goes straight over the surface; stays if that leads off it.
    [[nodiscard]] FlowTerrain::Point pointBeside(std::uint32_t face, Vec3 place, Vec3 way) const
    {
        FlowDroplet probe;
        WalkForces free;
        free.adhesion = std::numeric_limits<double>::infinity();
        const WalkField field{c_.surface, c_.landing};
        putOnFace(field, free, probe, face, {0.0, place, way, {}, 0.0});
        walk(field, free, probe, 1.0);
        return probe.contact == FlowContact::Face ? FlowTerrain::Point{probe.face, probe.leg.placeAt(1.0)}
                                                  : FlowTerrain::Point{face, place};
    }

    // ---- streaks

    /// Shares of a face that a streak covers, for roughness along its first edge and across it: w l/A |cos θ|, w l/A
    /// |sin θ|.
    [[nodiscard]] Vec2 wetShare(const FlowTrack& track) const
    {
        const FlowSurface::Face& face = c_.surface.faces[track.face];
        const Vec3 edge = face.corners[1] - face.corners[0];
        const Vec3 way = track.to - track.from;
        const double along = std::abs(dot(way, edge)) / length(edge);  // l |cos θ|
        const double across = std::sqrt(std::max(dot(way, way) - along * along, 0.0));
        const double width_over_area = track.width / areaOf(face);
        return {std::min(1.0, width_over_area * along), std::min(1.0, width_over_area * across)};
    }

    /// Streaks smooth the faces: k_rx ← k_rx (1 − share), k_ry alike.
    void wet()
    {
        const double dry_before = dryBefore();
        for (std::size_t t = 0; t < tracks_.size(); ++t) {
            const FlowTrack& track = tracks_[t];
            FlowState::Wetness& w = s_.wetness[track.face];
            if (w.id != track.id || w.time < dry_before) {
                w.before = w.id == 0 || w.time < dry_before ? Vec2{1.0, 1.0} : w.dryness;
                w.dryness = w.before;
                w.id = track.id;
            }
            w.dryness.x *= 1.0 - shares_[t].x;
            w.dryness.y *= 1.0 - shares_[t].y;
            w.time = track.time;
        }
    }

    [[nodiscard]] std::optional<std::size_t> indexOf(std::uint64_t id) const
    {
        const auto found = std::lower_bound(s_.droplets.begin(), s_.droplets.end(), id,
                                            [](const FlowDroplet& d, std::uint64_t sought) { return d.id < sought; });
        return found != s_.droplets.end() && found->id == id && found->volume > 0.0
                   ? std::optional(static_cast<std::size_t>(found - s_.droplets.begin()))
                   : std::nullopt;
    }

    void leaveFilm()
    {
        std::unordered_map<std::uint64_t, std::size_t> last;  // trail of every droplet
        for (std::size_t k = 0; k < s_.trails.size(); ++k) {
            last[s_.trails[k].id] = k;
        }
        for (const FlowTrack& track : tracks_) {
            const auto i = indexOf(track.id);
            if (!i) {
                continue;
            }
            FlowDroplet& d = s_.droplets[*i];
            const double way = length(track.to - track.from);
            // Where the ground holds the droplet more, it keeps more of it.
            const double film = p_.streaks.film * (isPinned() ? pinning_.at(atRest(track.face, track.to)) : 1.0);
            const double volume = std::min(film * track.width * way, 0.5 * d.volume);
            auto at = last.find(track.id);
            if (at == last.end() || s_.trails[at->second].isWhole()) {
                last[track.id] = s_.trails.size();
                at = last.find(track.id);
                const RandomStream random(p_.seed, RandomPurpose::Bead, track.id);
                constexpr double kLeast = 0.4;  // of the mean spacing; the rest is as random as can be
                const double spacing =
                    p_.streaks.spacing * (kLeast + (1.0 - kLeast) * random.exponential(2 * s_.steps));
                s_.trails.push_back({track.id, 0.0, 0.0, 0.0, spacing, 0.0, track.face, track.from});
            }
            FlowState::Trail& trail = s_.trails[at->second];
            if (trail.length < 0.5 * trail.spacing) {
                place(trail, track);
            }
            trail.volume += volume;
            trail.length += way;
            trail.drying += p_.drying ? volume / *p_.drying : 0.0;
            d.volume -= volume;
            forces_[*i] = forcesOf(d);
        }
        const WalkField field = walkField();
        for (const FlowTrack& track : tracks_) {
            const auto i = indexOf(track.id);
            if (i && s_.droplets[*i].leg.begin < end()) {
                redirect(field, forces_[*i], s_.droplets[*i], end());
            }
        }
        breakUp();
    }

    /// Puts the middle of a trail at the end of a track, somewhat beside it.
    void place(FlowState::Trail& trail, const FlowTrack& track) const
    {
        constexpr double kAside = 0.15;  // of the droplet's width: within its rivulet
        const RandomStream random(p_.seed, RandomPurpose::Bead, track.id);
        const double aside = kAside * track.width * (2.0 * random.uniform(2 * s_.steps + 1) - 1.0);
        const Vec3 across = cross(c_.surface.faces[track.face].normal, track.to - track.from);
        const auto [face, beside] =
            pointBeside(track.face, track.to, (aside / std::max(length(across), 1e-300)) * across);
        trail.face = face;
        trail.place = beside;
        trail.until = track.time + (track.speed > 0.0 ? kBreakUpWay * track.width / track.speed : 0.0);
    }

    /// Trails that their droplets have left behind become beads.
    void breakUp()
    {
        begin_ = end();
        std::vector<FlowState::Trail> kept;
        for (const FlowState::Trail& trail : s_.trails) {
            const auto i = indexOf(trail.id);
            const double radius = contactRadius(p_, trail.face, std::max(trail.volume, p_.small_volume));
            const bool is_left = !i || length(s_.droplets[*i].leg.placeAt(begin_) - trail.place) >
                                           0.5 * forces_[*i].contact_width + radius;
            if (!is_left || (i && (!trail.isWhole() || begin_ < trail.until))) {
                kept.push_back(trail);
            } else if (trail.volume < p_.small_volume) {
                s_.dried.add(trail.volume);
            } else {
                FlowDroplet bead;
                bead.id = s_.next_id++;
                bead.volume = trail.volume;
                bead.drying = trail.drying;
                bead.has_grown = true;
                bead.born = begin_;
                bead.face = trail.face;
                bead.leg = {begin_, trail.place, {}, {}, 0.0};
                const WalkForces forces = forcesOf(bead);
                putOnFace(walkField(), forces, bead, trail.face, {begin_, trail.place, {}, {}, 0.0});
                s_.droplets.push_back(bead);
                forces_.push_back(forces);
                ++s_.counts.beads;
            }
        }
        s_.trails = std::move(kept);
        begin_ = timeOf(s_.steps);
    }

    void dry()
    {
        for (FlowState::Trail& trail : s_.trails) {
            const double volume = std::min(trail.drying * p_.step, trail.volume);
            trail.volume -= volume;
            s_.dried.add(volume);
        }
        for (std::size_t i = 0; i < s_.droplets.size(); ++i) {
            FlowDroplet& d = s_.droplets[i];
            if (d.drying <= 0.0 || d.volume <= 0.0) {
                continue;
            }
            const double left = d.volume - d.drying * p_.step;
            const double volume = left > p_.small_volume ? d.drying * p_.step : d.volume;
            s_.dried.add(volume);
            d.volume = left > p_.small_volume ? left : 0.0;
            if (d.volume > 0.0) {
                forces_[i] = forcesOf(d);
            } else {
                ++s_.counts.dried;
            }
        }
    }

    /// Dew condenses on the ground around droplets at rest, and they take it up.
    void grow()
    {
        const double margin = 0.5 * p_.condensation->spacing;
        const auto catchment = [&](std::size_t i) {
            const double radius = 0.5 * forces_[i].contact_width + margin;
            return s_.droplets[i].volume > 0.0 && s_.droplets[i].contact == FlowContact::Still ? radius * radius : 0.0;
        };
        double sum = 0.0;
        for (std::size_t i = 0; i < s_.droplets.size(); ++i) {
            sum += catchment(i);
        }
        // Where droplets are few, most of the surface is too far from any of them.
        const double share = 1.0 / std::max(sum, terrain_.area() / std::numbers::pi);
        const double volume = p_.condensation->rate * terrain_.area() * static_cast<double>(kStepsOfDew) * p_.step;
        const WalkField field = walkField();
        for (std::size_t i = 0; i < s_.droplets.size(); ++i) {
            const double gain = catchment(i) * share * volume;
            if (gain > 0.0) {
                FlowDroplet& d = s_.droplets[i];
                d.volume += gain;
                d.has_grown = true;
                s_.released.add(gain);
                forces_[i] = forcesOf(d);
                redirect(field, forces_[i], d, end());
            }
        }
    }

    // ---- hollows

    /// Field for what lies at the end of the step.
    [[nodiscard]] PondField pondField() const { return {c_, p_, field_, end()}; }

    /// Ponds take up what they cover, and one another where both stand over the edge between them.
    void joinPonds(std::span<const MovingBall> balls, UnionFind& sets, std::vector<std::uint32_t>& members)
    {
        const std::size_t count = s_.droplets.size();
        const PondField field = pondField();
        std::vector<Pair> on_faces;  // faces of droplets, with their indices
        for (std::uint32_t i = 0; i < count; ++i) {
            if (s_.droplets[i].contact != FlowContact::Air && s_.droplets[i].volume > 0.0) {
                on_faces.emplace_back(s_.droplets[i].face, i);
            }
        }
        // Most often one drop after another falls into the only pond there is.
        if (std::all_of(on_faces.begin(), on_faces.end(),
                        [&](const Pair& one) { return sets.find(one.second) == sets.find(on_faces.front().second); })) {
            return;
        }
        std::sort(on_faces.begin(), on_faces.end());
        using Ponds = std::vector<std::pair<std::uint32_t, FilledHollow>>;
        const auto blocks = mapBlocks<Ponds>(
            on_faces.size(),
            [&](std::size_t first, std::size_t last) {
                Ponds found;
                for (std::size_t k = first; k < last; ++k) {
                    const std::uint32_t i = on_faces[k].second;
                    if (auto filled = pondOf(field, s_.droplets[i], {balls[i].to, balls[i].reach})) {
                        found.emplace_back(i, *std::move(filled));
                    }
                }
                return found;
            },
            kDropletsPerBlock);
        const auto join = [&](std::uint32_t i, std::uint32_t j) {
            if (i != j) {
                sets.join(i, j);
                members.push_back(i);
                members.push_back(j);
            }
        };
        std::vector<Pair> full;  // faces beyond the brims of ponds that stand over them, with these ponds
        for (const Ponds& block : blocks) {
            for (const auto& [i, filled] : block) {
                if (filled.beyond) {
                    full.emplace_back(*filled.beyond, i);
                }
            }
        }
        for (const Ponds& block : blocks) {
            for (const auto& [i, filled] : block) {
                const Pond& pond = filled.pond;
                const auto first = std::lower_bound(on_faces.begin(), on_faces.end(), Pair(pond.faces.front(), 0));
                for (auto at = first; at != on_faces.end() && at->first <= pond.faces.back(); ++at) {
                    const auto& [face, j] = *at;
                    if (covers(pond, face, s_.droplets[j].leg.placeAt(end()))) {
                        join(i, j);
                    }
                }
                for (const auto& [face, j] : full) {
                    if (pond.dome > 0.0 && wets(pond, face)) {
                        join(i, j);
                    }
                }
            }
        }
    }

    static bool covers(const Pond& pond, std::uint32_t face, Vec3 place)
    {
        const auto at = std::lower_bound(pond.faces.begin(), pond.faces.end(), face);
        return at != pond.faces.end() && *at == face &&
               dot(pond.up, place) < pond.heightOver(static_cast<std::size_t>(at - pond.faces.begin()), place);
    }

    static bool wets(const Pond& pond, std::uint32_t face)
    {
        return std::binary_search(pond.faces.begin(), pond.faces.end(), face);
    }

    /// Where liquid runs over, for droplets at rest and those that have grown in the step.
    [[nodiscard]] std::vector<std::pair<std::size_t, Brim>> brims()
    {
        const double gravity = length(field_.gravity);
        if (!(gravity > 0.0)) {
            return {};
        }
        const Vec3 up = (-1.0 / gravity) * field_.gravity;
        const PondField field = pondField();
        using Brims = std::vector<std::pair<std::size_t, Brim>>;
        const auto blocks = mapBlocks<Brims>(
            s_.droplets.size(),
            [&](std::size_t first, std::size_t last) {
                Brims found;
                for (std::size_t i = first; i < last; ++i) {
                    FlowDroplet& d = s_.droplets[i];
                    const bool may_lie = d.contact == FlowContact::Still || d.has_grown;
                    if (d.contact == FlowContact::Air || !may_lie || !(d.volume > 0.0)) {
                        continue;
                    }
                    const RestingLiquid liquid = restingLiquid(field, d, standingOf(field, d));
                    if (d.volume <= d.held && length(liquid.place - d.held_at) <= liquid.radius && !moves()) {
                        continue;
                    }
                    const Hollow hollow = hollowAround(c_.surface, up, liquid);
                    d.held = hollow.held;
                    d.held_at = liquid.place;
                    if (hollow.brim) {
                        found.emplace_back(i, *hollow.brim);
                    }
                }
                return found;
            },
            kDropletsPerBlock);
        Brims all;
        for (const Brims& block : blocks) {
            all.insert(all.end(), block.begin(), block.end());
        }
        return all;
    }

    /// What is too much for a hollow leaves it, a droplet as wide as twice the height of a puddle at a time or, in a
    /// flood, all that it does not hold; a hollow that holds next to nothing lets all of it go.
    void runOver()
    {
        const WalkField field = walkField();
        for (const auto& [i, brim] : brims()) {
            FlowDroplet over = s_.droplets[i];
            over.has_grown = true;
            const double most = capVolume(restingLiquid(pondField(), over, {}).puddle, p_.contactAngleOn(over.face));
            const double volume = std::max(std::min(over.volume - brim.capacity, most), over.volume - brim.held);
            double gap = 0.0;  // to what stays
            if (over.volume - volume >= p_.small_volume) {
                FlowDroplet& stays = s_.droplets[i];
                over.id = s_.next_id++;
                over.born = end();
                over.volume = volume;
                over.drying = stays.drying * volume / stays.volume;
                stays.drying -= over.drying;
                stays.volume -= volume;
                stays.has_grown = true;
                forces_[i] = forcesOf(stays);
                redirect(field, forces_[i], stays, end());  // and asked again in the next step
                gap = 0.5 * forces_[i].contact_width - length(brim.place - stays.leg.placeAt(end()));
            }
            const WalkForces forces = forcesOf(over);
            const double radius = 0.5 * forces.contact_width;
            // Past the brim, and so far that what stays does not take it back as it grows.
            const Vec3 way = (2.0 * radius + std::max(gap, 0.0)) * brim.ahead;
            if (brim.is_open) {
                over.contact = FlowContact::Air;
                over.face = brim.face;
                over.leg = {end(), brim.place + way, {}, forces.fall, 0.0};
            } else {
                const auto [face, place] = pointBeside(brim.face, brim.place, way);
                putOnFace(field, forces, over, face, {end(), place, {}, {}, 0.0});
            }
            ++s_.counts.overflows;
            if (over.id == s_.droplets[i].id) {
                s_.droplets[i] = over;
                forces_[i] = forces;
            } else {
                s_.droplets.push_back(over);
                forces_.push_back(forces);
            }
        }
    }

    /// Removes droplets that have fallen away, and those without liquid.
    void leave()
    {
        const double away = kAway * terrain_.diameter();
        const auto is_away = [&](Vec3 p) {
            return p.x < c_.low.x - away || p.x > c_.high.x + away || p.y < c_.low.y - away || p.y > c_.high.y + away ||
                   p.z < c_.low.z - away || p.z > c_.high.z + away;
        };
        std::size_t kept = 0;
        for (std::size_t i = 0; i < s_.droplets.size(); ++i) {
            const FlowDroplet& d = s_.droplets[i];
            if (d.volume > 0.0 && d.contact == FlowContact::Air && is_away(d.leg.placeAt(end()))) {
                s_.left.add(d.volume);
                ++s_.counts.left;
            } else if (d.volume > 0.0) {
                s_.droplets[kept] = d;
                forces_[kept] = forces_[i];
                ++kept;
            }
        }
        s_.droplets.resize(kept);
        forces_.resize(kept);
    }

    const FlowTerrain::Content& c_;
    const FlowTerrain& terrain_;
    const FlowParameters& p_;
    FlowState& s_;
    PinningField pinning_;
    double begin_;  // of the step [s]
    FlowField field_;
    std::vector<WalkForces> forces_;  // on every droplet
    std::vector<Vec3> from_;          // places at the begin of the step
    std::vector<FlowTrack> tracks_;   // of the step
    std::vector<Vec2> shares_;        // of the faces that they wet
};

void requireFits(double volume, const FlowTerrain& terrain, const FlowParameters& parameters)
{
    const double width = 2.0 * capOf(volume, parameters.forces.wetting.contact_angle).contact_radius;
    if (!(width < terrain.diameter())) {
        refuseValue(
            "a droplet's volume", numberText(volume) + " m3",
            "smaller: it is " + numberText(width) + " m wide, and the object " + numberText(terrain.diameter()) + " m");
    }
}

}  // namespace

double FlowBalance::residual() const
{
    CompensatedSum difference;
    for (const double term : {released, -running, -still, -airborne, -streaks, -left, -dried}) {
        difference.add(term);
    }
    return released > 0.0 ? difference.value() / released : 0.0;
}

FlowState startFlow(const FlowTerrain& terrain, const FlowParameters& parameters, const std::vector<FlowStart>& starts)
{
    parameters.validate(terrain.surface().faces.size());
    for (const FlowEmitter& emitter : parameters.emitters) {
        requireFits(emitter.volumes.median, terrain, parameters);
        if (terrain.isInside(emitter.place)) {
            throw Error(ErrorCode::InvalidArgument, "emitter.place is inside the object, must be outside or on it");
        }
    }
    FlowState state;
    state.wetness.resize(terrain.surface().faces.size());
    state.emissions.resize(parameters.emitters.size());
    Step step(terrain, parameters, state);
    for (const FlowStart& start : starts) {
        require(start.volume > 0.0 && std::isfinite(start.volume), "start.volume", start.volume,
                "finite and more than 0 m3");
        requireFits(start.volume, terrain, parameters);
        step.start(start);
    }
    return state;
}

FlowState advanceFlow(FlowState state, const FlowTerrain& terrain, const FlowParameters& parameters, double until)
{
    require(until >= state.time && std::isfinite(until), "until", until, "finite and not before the state's time");
    state.tracks.clear();
    Step step(terrain, parameters, state);
    // Rounding must not cost the last step.
    const double whole = until * (1.0 + 1e-12);
    while (static_cast<double>(state.steps + 1) * parameters.step <= whole) {
        step.run();
    }
    state.time = until;
    return state;
}

std::vector<FlowSample> sampleFlow(const FlowState& state, const FlowTerrain& terrain, const FlowParameters& parameters)
{
    const double grid = static_cast<double>(state.steps) * parameters.step;
    FlowState between;
    const FlowState* shown = &state;
    double time = grid;
    if (state.time > grid * (1.0 + 1e-12)) {
        between = state;
        Step(terrain, parameters, between).moveWithin(state.time);
        shown = &between;
        time = state.time;
    }
    const PondField field{terrain.content(), parameters, fieldAt(parameters, time), time};
    std::vector<std::optional<Pond>> ponds(shown->droplets.size());
    forBlocks(
        ponds.size(),
        [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) {
                const FlowDroplet& d = shown->droplets[i];
                if (auto filled = pondOf(field, d, standingOf(field, d))) {
                    ponds[i] = std::move(filled->pond);
                }
            }
        },
        kDropletsPerBlock);
    std::vector<FlowSample> samples;
    samples.reserve(shown->droplets.size());
    for (std::size_t i = 0; i < shown->droplets.size(); ++i) {
        const FlowDroplet& d = shown->droplets[i];
        const bool is_airborne = d.contact == FlowContact::Air;
        const GroundMotion::Drift drift = is_airborne ? terrain.motion().driftOf(d.face, time) : GroundMotion::Drift();
        samples.push_back(
            {d.id, d.contact, is_airborne ? std::nullopt : std::optional(d.face), d.leg.placeAt(time) + drift.way,
             d.leg.velocityAt(time) + drift.velocity, terrain.surface().faces[d.face].normal, d.volume, time - d.born,
             parameters.ground.contact_angle.empty() ? std::nullopt : std::optional(parameters.contactAngleOn(d.face)),
             std::move(ponds[i])});
    }
    return samples;
}

FlowState advanceFlow(FlowState state, FlowShapes& shapes, const FlowParameters& parameters, double until)
{
    if (shapes.count() == 1) {
        return advanceFlow(std::move(state), shapes.first(), parameters, until);
    }
    require(until >= state.time && std::isfinite(until), "until", until, "finite and not before the state's time");
    require(parameters.motion.rests(), "motion", "", "at rest: the shapes of the surface have its motion");
    const double seconds = parameters.step;
    const double whole = until * (1.0 + 1e-12);
    const auto has_step = [&] { return static_cast<double>(state.steps + 1) * seconds <= whole; };
    std::vector<FlowTrack> tracks;
    std::size_t shape = state.steps == 0 ? 0 : shapes.ofStep(state.steps - 1, seconds);
    while (has_step()) {
        const std::size_t next = shapes.ofStep(state.steps, seconds);
        const std::shared_ptr<const FlowTerrain> terrain = shapes.at(next);
        state.tracks.clear();
        Step step(*terrain, parameters, state);
        if (next != shape) {
            step.follow(*shapes.at(shape));
            shape = next;
        }
        while (has_step() && shapes.ofStep(state.steps, seconds) == shape) {
            step.run();
        }
        for (FlowTrack track : state.tracks) {
            const FlowSurface::Face& from = terrain->surface().faces[track.face];
            const FlowSurface::Face& to = shapes.first().surface().faces[track.face];
            if (from.corners != to.corners) {
                const double stretch = stretchOf(from, to);
                track.from = followed(from, to, track.from);
                track.to = followed(from, to, track.to);
                track.width *= stretch;
                track.speed *= stretch;
            }
            tracks.push_back(track);
        }
    }
    state.tracks = std::move(tracks);
    state.time = until;
    return state;
}

std::vector<FlowSample> sampleFlow(const FlowState& state, FlowShapes& shapes, const FlowParameters& parameters)
{
    const std::size_t shape = shapes.of(state, parameters.step);
    const std::size_t last = state.steps == 0 ? 0 : shapes.ofStep(state.steps - 1, parameters.step);
    if (shape == last) {
        return sampleFlow(state, *shapes.at(shape), parameters);
    }
    FlowState followed = state;
    const std::shared_ptr<const FlowTerrain> terrain = shapes.at(shape);
    Step(*terrain, parameters, followed).follow(*shapes.at(last));
    return sampleFlow(followed, *terrain, parameters);
}

FlowBalance balanceOf(const FlowState& state)
{
    CompensatedSum running;
    CompensatedSum still;
    CompensatedSum airborne;
    CompensatedSum streaks;
    for (const FlowDroplet& d : state.droplets) {
        (d.contact == FlowContact::Air ? airborne : d.contact == FlowContact::Still ? still : running).add(d.volume);
    }
    for (const FlowState::Trail& trail : state.trails) {
        streaks.add(trail.volume);
    }
    return {state.released.value(), running.value(),    still.value(),      airborne.value(),
            streaks.value(),        state.left.value(), state.dried.value()};
}

}  // namespace droplet
