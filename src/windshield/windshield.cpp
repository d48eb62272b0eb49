// SPDX-License-Identifier: GPL-3.0-or-later
//
// The thesis, chapter 3: forces (3.2)–(3.5) by wind/forces.h, noise on the gravity along the windshield (3.2), merging
// (3.1.4) and the Lotus effect (3.1.5); small droplets stand still (3.2.2). Departures:
//
// - Droplets merge whenever they touch, of whatever sizes: the thesis has a threshold on the difference of their
// masses,
//   which keeps equal ones apart. The larger one absorbs; water and momentum are kept.
// - Still droplets are single droplets in cells, not the texels of a picture: what a running droplet wipes away it has
//   afterwards, and rain renews them.
// - Steps are exact for constant forces along a line, and friction is implicit, so that droplets at rest do not jitter.
#include "droplet/windshield/windshield.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <span>
#include <string>
#include <utility>

#include "droplet/error.h"
#include "windshield/random.h"
#include "windshield/still_droplets.h"
#include "windshield/wipers.h"

namespace droplet {
namespace {

constexpr double kPi = std::numbers::pi;

/// Of the cells that bring droplets and tracks together that may touch: few droplets in a cell, few cells to a track
/// [m].
constexpr double kContactCell = 8e-3;

/// Droplets a thread takes at a time.
constexpr std::size_t kShare = 128;

/// Still droplets take 213 bytes for every 16 mm²: at most 1.33 GB.
constexpr double kMostArea = 100.0;  // [m²]

void require(bool holds, const char* field, double value, const char* constraint)
{
    if (!holds) {
        throw Error(ErrorCode::InvalidArgument,
                    std::string(field) + " is " + std::to_string(value) + "; it must be " + constraint);
    }
}

double sphere(double diameter)
{
    return kPi / 6.0 * diameter * diameter * diameter;
}

/// Without the care for the ends of double's range, where nothing here comes, that std::hypot takes.
double sizeOf(Vec2 a)
{
    return std::sqrt(dot(a, a));
}

/// Calls work(share, begin, end) for shares of [0, count), in parallel if there are several.
template <class Work>
void forShares(std::size_t count, const Work& work)
{
    const std::size_t shares = (count + kShare - 1) / kShare;
    if (shares <= 1) {
        work(std::size_t{0}, std::size_t{0}, count);
        return;
    }
    tbb::parallel_for(std::size_t{0}, shares,
                      [&](std::size_t k) { work(k, k * kShare, std::min(count, (k + 1) * kShare)); });
}

/// How all caps of one contact angle relate to the cap of 1 m³.
class CapScale {
public:
    explicit CapScale(double contact_angle)
        : unit_(capOf(1.0, contact_angle)), wide_(contact_angle > 0.5 * kPi), reach_(reach(unit_))
    {
    }

    [[nodiscard]] CapSize cap(double volume) const
    {
        const double s = std::cbrt(volume);
        return {volume, s * unit_.radius, s * unit_.contact_radius, s * unit_.height, s * s * unit_.frontal_area};
    }
    /// Half the width seen from above: caps of more than 90° bulge over their rims.
    [[nodiscard]] double reach(const CapSize& cap) const { return wide_ ? cap.radius : cap.contact_radius; }
    [[nodiscard]] double reach(double volume) const { return reach_ * std::cbrt(volume); }
    [[nodiscard]] double reach() const { return reach_; }

private:
    CapSize unit_;
    bool wide_ = false;
    double reach_ = 0.0;
};

/// The pushes on one droplet [m/s²].
Vec2 pushOn(std::uint64_t id, double time, const Fluctuation& fluctuation, std::uint64_t seed)
{
    if (fluctuation.acceleration == 0.0) {
        return {};
    }
    const RandomStream chance(seed, Chance::Fluctuation, id);
    const double since = time / fluctuation.interval + chance.uniform(0);
    const double begun = std::floor(since);
    const double passed = since - begun;
    const auto number = static_cast<std::uint64_t>(begun);
    const auto push = [&](std::uint64_t k) {
        // Both components from one draw, of variance 1 each.
        const std::uint64_t bits = chance.bits(k + 1);
        const auto component = [](std::uint64_t half) {
            return std::numbers::sqrt3 * (static_cast<double>(half) * 0x1p-31 - 1.0);
        };
        return Vec2{component(bits >> 32U), component(bits & 0xFFFFFFFFU)};
    };
    const double b = passed * passed * (3.0 - 2.0 * passed);
    const double a = 1.0 - b;
    return (fluctuation.acceleration / std::sqrt(a * a + b * b)) * (a * push(number) + b * push(number + 1));
}

struct Moved {
    Vec2 way;
    Vec2 velocity;
};

/// m dv/dt = F − F_k v/|v| − c v for dt with constant F: exact along a line, friction against the velocity at the end;
/// what would turn around within dt stops, and starts again in the next step if friction does not hold it.
Moved moved(const DropletForces& forces, Vec2 driving, Vec2 velocity, double dt)
{
    const bool at_rest = velocity == Vec2{};
    if (at_rest && sizeOf(driving) <= forces.retention) {
        return {};
    }
    const double m = forces.mass;
    const double x = forces.viscous * dt / m;
    const double decay = std::exp(-x);
    // ∫ e^(−x s) ds and ∫∫ of it over [0, 1].
    const double once = x > 0.0 ? -std::expm1(-x) / x : 1.0;
    const double twice =
        x > 0.02 ? (1.0 - once) / x : 0.5 - x / 6.0 * (1.0 - x / 4.0 * (1.0 - x / 5.0 * (1.0 - x / 6.0)));
    const Vec2 free = decay * velocity + (once * dt / m) * driving;
    const double speed = sizeOf(free);
    const double loss = once * dt / m * forces.sliding_friction;
    if (speed <= loss) {
        // When it stops, as if its speed fell evenly.
        const double begins = sizeOf(velocity);
        const double share = begins > 0.0 ? begins / (begins + (loss - speed)) : 0.0;
        return {(0.5 * share * dt) * velocity, {}};
    }
    const Vec2 net = driving - (forces.sliding_friction / speed) * free;
    return {(once * dt) * velocity + (twice * dt * dt / m) * net, (1.0 - loss / speed) * free};
}

/// One step of one state; its functions are called in their order.
class Step {
public:
    Step(WindshieldState& state, const WindshieldParameters& parameters, double dt)
        : s_(state),
          p_(parameters),
          dt_(dt),
          caps_(parameters.forces.wetting.contact_angle),
          rules_{caps_.reach(), sphere(parameters.still_diameter)},
          most_still_reach_(rules_.greatestReach()),
          most_push_(std::sqrt(12.0) * (1.0 + 1e-12) * parameters.fluctuation.acceleration)
    {
    }

    void run()
    {
        rain();
        move();
        bringTogether();
        drizzle();
        merge();
        sweep();
        shed();
        wipe();
        leave();
        s_.time += dt_;
    }

private:
    /// A piece of a track and whose water it gathers.
    struct Piece {
        std::uint32_t owner = 0;
        Vec2 from;
        Vec2 to;
        double reach = 0.0;
    };
    struct Hit {
        std::uint32_t owner = 0;
        StillSlot still;
    };

    /// Raindrops of the time from now to dt later.
    void rain()
    {
        before_rain_ = s_.droplets.size();
        const RainImpacts impacts{raindropSizes(p_.rainfall), p_.raindrops, p_.vehicle.speedAt(s_.time + 0.5 * dt_)};
        const double bound = impacts.bound();
        if (!(bound > 0.0)) {
            return;
        }
        const RaindropSampler sampler(impacts);
        double expected = bound * p_.glass.width() * p_.glass.height() * dt_;
        while (s_.until_raindrop < expected) {
            expected -= s_.until_raindrop;
            const RandomStream chance(p_.seed, Chance::Raindrop, s_.next_raindrop++);
            s_.until_raindrop = chance.exponential(0);
            const Vec2 position{p_.glass.width() * chance.uniform(1), p_.glass.height() * chance.uniform(2)};
            const std::optional<GlassPlace> place = p_.glass.place(position);
            if (!place) {
                continue;
            }
            const double diameter = sampler.diameter(chance.uniform(3), chance.uniform(4));
            if (chance.uniform(5) >= impacts.kept(diameter, {place->normal.z, place->normal.y})) {
                continue;
            }
            const double volume = sphere(diameter);
            s_.rained.add(volume);
            ++s_.counts.raindrops;
            if (volume >= rules_.greatest) {
                s_.droplets.push_back({s_.next_id++, position, {}, volume, 0.0, 0});
            } else {
                drizzle_.push_back({position, volume});
            }
        }
        s_.until_raindrop -= expected;
    }

    void move()
    {
        const std::size_t count = s_.droplets.size();
        from_.resize(count);
        to_.resize(count);
        reach_.resize(count);
        owner_.resize(count);
        std::iota(owner_.begin(), owner_.end(), 0U);
        grown_.assign(before_rain_, 0);
        grown_.resize(count, 1);  // raindrops may land on still droplets
        const double speed = p_.vehicle.speedAt(s_.time + 0.5 * dt_);
        forShares(count, [&](std::size_t, std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                moveOne(i, speed);
            }
        });
    }

    void moveOne(std::size_t i, double speed)
    {
        RunningDroplet& d = s_.droplets[i];
        from_[i] = d.position;
        reach_[i] = caps_.reach(d.volume);
        if (const std::optional<GlassPlace> place = p_.glass.place(d.position)) {
            const DropletForces forces = forcesOn(p_.forces, caps_.cap(d.volume));
            Vec2 wind = windAlong(*place, speed, p_.wind);
            if (p_.relative_wind) {
                wind = wind - d.velocity;
            }
            const Vec2 push =
                gravityAlong(*place, p_.forces.gravity) + pushOn(d.id, s_.time + 0.5 * dt_, p_.fluctuation, p_.seed);
            const Vec2 driving = forces.mass * push + (forces.drag * sizeOf(wind)) * wind;
            const Moved result = moved(forces, driving, d.velocity, dt_);
            d.position = d.position + result.way;
            d.velocity = result.velocity;
        }
        to_[i] = d.position;
    }

    /// Which tracks come through which cells, tracks in their order.
    void bringTogether()
    {
        const Cells cells = contactCells();
        // Raindrops that land beside a track touch it, too.
        const double more = most_still_reach_;
        tracks_of_cell_.assign(cells.count() + 1, 0);
        std::vector<std::pair<std::uint32_t, std::uint32_t>> comes;  // a cell and what comes through it
        comes.reserve(2 * from_.size());
        for (std::uint32_t i = 0; i < from_.size(); ++i) {
            cells.visitAround(from_[i], to_[i], reach_[i] + more, [&](std::size_t first, std::size_t last) {
                for (std::size_t cell = first; cell <= last; ++cell) {
                    comes.emplace_back(static_cast<std::uint32_t>(cell), i);
                    ++tracks_of_cell_[cell];
                }
            });
        }
        std::inclusive_scan(tracks_of_cell_.begin(), tracks_of_cell_.end(), tracks_of_cell_.begin());
        tracks_.resize(comes.size());
        // Filled from behind, each cell's end comes to be its beginning.
        for (std::size_t k = comes.size(); k-- > 0;) {
            tracks_[--tracks_of_cell_[comes[k].first]] = comes[k].second;
        }
    }

    /// Small raindrops, and what they make with still droplets, join the first track they touch.
    void drizzle()
    {
        for (StillDroplet drop : drizzle_) {
            bool stands = false;
            while (!stands && drop.volume < rules_.greatest) {
                if (const std::optional<std::uint32_t> track = trackAt(drop)) {
                    take(*track, drop.volume);
                    stands = true;
                } else {
                    stands = !joinsStill(drop);
                }
            }
            if (!stands) {
                grow(drop);
            }
        }
    }

    [[nodiscard]] std::optional<std::uint32_t> trackAt(const StillDroplet& drop) const
    {
        const double reach = rules_.reachOf(drop.volume);
        const std::size_t cell = contactCells().number(drop.position);
        for (std::uint32_t k = tracks_of_cell_[cell]; k < tracks_of_cell_[cell + 1]; ++k) {
            const std::uint32_t i = tracks_[k];
            const double touching = reach + reach_[i];
            if (Way(from_[i], to_[i]).squaredDistance(drop.position) <= touching * touching) {
                return i;
            }
        }
        return std::nullopt;
    }

    /// Puts it among the still ones; returns whether it is, joined with another, off the glass again.
    bool joinsStill(StillDroplet& drop)
    {
        const std::optional<StillDroplet> more = settle(s_.still, drop, rules_);
        drop = more.value_or(drop);
        return more.has_value();
    }

    /// What stood still is enough to run.
    void grow(const StillDroplet& drop)
    {
        owner_.push_back(static_cast<std::uint32_t>(s_.droplets.size()));
        s_.droplets.push_back({s_.next_id++, drop.position, {}, drop.volume, 0.0, 0});
        from_.push_back(drop.position);
        to_.push_back(drop.position);
        reach_.push_back(caps_.reach(drop.volume));
        grown_.push_back(1);
        ++s_.counts.grown;
    }

    /// A running droplet takes up water that was at rest: momentum is kept.
    void take(std::uint32_t i, double volume)
    {
        RunningDroplet& d = s_.droplets[i];
        d.velocity = (d.volume / (d.volume + volume)) * d.velocity;
        d.volume += volume;
        s_.merged.add(volume);
        grown_[i] = 1;
    }

    /// Droplets that come to touch within the step become one, however many there are: the largest, of equals the
    /// first.
    void merge()
    {
        const std::size_t count = contactCells().count();
        for (std::size_t cell = 0; cell < count; ++cell) {
            for (std::uint32_t a = tracks_of_cell_[cell]; a + 1 < tracks_of_cell_[cell + 1]; ++a) {
                for (std::uint32_t b = a + 1; b < tracks_of_cell_[cell + 1]; ++b) {
                    if (meet(tracks_[a], tracks_[b])) {
                        join(tracks_[a], tracks_[b]);
                    }
                }
            }
        }
        if (joined_.empty()) {
            return;
        }
        std::sort(joined_.begin(), joined_.end());
        joined_.erase(std::unique(joined_.begin(), joined_.end()), joined_.end());
        std::vector<std::pair<std::uint32_t, std::uint32_t>> members;  // by the first of them
        members.reserve(joined_.size());
        for (const std::uint32_t i : joined_) {
            members.emplace_back(rootOf(i), i);
        }
        std::sort(members.begin(), members.end());
        for (std::size_t begin = 0; begin < members.size();) {
            std::size_t end = begin;
            while (end < members.size() && members[end].first == members[begin].first) {
                ++end;
            }
            absorb(members.data() + begin, members.data() + end);
            begin = end;
        }
    }

    /// Whether the distance of two that move evenly from their beginnings to their ends falls to where they touch.
    [[nodiscard]] bool meet(std::uint32_t a, std::uint32_t b) const
    {
        const double touching = reach_[a] + reach_[b];
        return Way(from_[a] - from_[b], to_[a] - to_[b]).squaredDistance({}) <= touching * touching;
    }

    // R. E. Tarjan, J. van Leeuwen, "Worst-case analysis of set union algorithms" (1984): path halving; a set's name is
    // its first member.
    std::uint32_t rootOf(std::uint32_t i)
    {
        while (owner_[i] != i) {
            i = owner_[i] = owner_[owner_[i]];
        }
        return i;
    }

    void join(std::uint32_t a, std::uint32_t b)
    {
        joined_.push_back(a);
        joined_.push_back(b);
        a = rootOf(a);
        b = rootOf(b);
        owner_[std::max(a, b)] = std::min(a, b);
    }

    using Member = std::pair<std::uint32_t, std::uint32_t>;

    void absorb(const Member* begin, const Member* end)
    {
        std::uint32_t largest = begin->second;
        double volume = 0.0;
        Vec2 moment;
        Vec2 momentum;
        for (const Member* m = begin; m != end; ++m) {
            const RunningDroplet& d = s_.droplets[m->second];
            volume += d.volume;
            moment = moment + d.volume * d.position;
            momentum = momentum + d.volume * d.velocity;
            if (d.volume > s_.droplets[largest].volume) {
                largest = m->second;
            }
        }
        for (const Member* m = begin; m != end; ++m) {
            owner_[m->second] = largest;
            if (m->second != largest) {
                s_.merged.add(s_.droplets[m->second].volume);
                s_.droplets[m->second].volume = 0.0;
                ++s_.counts.merged;
            }
        }
        RunningDroplet& d = s_.droplets[largest];
        d.volume = volume;
        d.position = (1.0 / volume) * moment;
        d.velocity = (1.0 / volume) * momentum;
        grown_[largest] = 1;
    }

    /// The Lotus effect: what stands still in the way of a running droplet goes with it. What a growing one comes to
    /// touch goes with it, too: at once, until there is nothing more, if it rests; in the next step, if it moves on.
    void sweep()
    {
        std::vector<Piece> pieces;
        for (std::uint32_t i = 0; i < s_.droplets.size(); ++i) {
            RunningDroplet& d = s_.droplets[i];
            if (d.volume > 0.0) {
                if (grown_[i] != 0) {
                    reach_[i] = caps_.reach(d.volume);
                }
                to_[i] = d.position;
            }
            if (d.volume > 0.0 ? grown_[i] != 0 || from_[i] != to_[i] : from_[i] != to_[i]) {
                pieces.push_back({owner_[i], from_[i], to_[i], reach_[i]});
            }
        }
        gather(std::move(pieces));
    }

    void gather(std::vector<Piece> pieces)
    {
        Taking taking(s_.still);
        while (!pieces.empty()) {
            std::vector<std::vector<Hit>> hits((pieces.size() + kShare - 1) / kShare);
            forShares(pieces.size(), [&](std::size_t share, std::size_t begin, std::size_t end) {
                find({pieces.data() + begin, end - begin}, hits[share]);
            });
            std::vector<std::uint32_t> grown;
            for (const std::vector<Hit>& share : hits) {
                for (const Hit& hit : share) {
                    if (const double volume = taking.take(hit.still); volume > 0.0) {
                        take(hit.owner, volume);
                        s_.swept.add(volume);
                        ++s_.counts.swept;
                        if (s_.droplets[hit.owner].velocity == Vec2{}) {
                            grown.push_back(hit.owner);
                        }
                    }
                }
            }
            std::sort(grown.begin(), grown.end());
            grown.erase(std::unique(grown.begin(), grown.end()), grown.end());
            pieces.clear();
            for (const std::uint32_t i : grown) {
                const RunningDroplet& d = s_.droplets[i];
                reach_[i] = caps_.reach(d.volume);
                pieces.push_back({i, d.position, d.position, reach_[i]});
            }
        }
        taking.close();
    }

    /// Still droplets that touch pieces of tracks.
    void find(std::span<const Piece> pieces, std::vector<Hit>& hits) const
    {
        struct Candidate {
            const Piece* piece = nullptr;
            StillSlot slot;
        };
        // Memory is asked for all that may touch before the first is looked at: to wait for each would take most of
        // the time.
        std::vector<Candidate> candidates;
        candidates.reserve(4 * pieces.size());
        for (const Piece& piece : pieces) {
            visitNear(s_.still, piece.from, piece.to, piece.reach + most_still_reach_, [&](StillSlot slot) {
                __builtin_prefetch(&at(s_.still, slot));
                candidates.push_back({&piece, slot});
            });
        }
        for (const auto& [piece, slot] : candidates) {
            const StillDroplet& d = at(s_.still, slot);
            const double squared = Way(piece->from, piece->to).squaredDistance(d.position);
            // The root, which costs most, only where it matters.
            if (d.volume > 0.0 &&
                (squared <= piece->reach * piece->reach || touches(squared, piece->reach, d.volume))) {
                hits.push_back({piece->owner, slot});
            }
        }
    }

    [[nodiscard]] bool touches(double squared, double reach, double still_volume) const
    {
        const double touching = reach + rules_.reachOf(still_volume);
        return squared <= touching * touching;
    }

    /// Streaks: droplets that move leave a film behind, as still droplets at random distances.
    void shed()
    {
        if (p_.streaks.film == 0.0) {
            return;
        }
        const std::size_t count = s_.droplets.size();
        for (std::size_t i = 0; i < count; ++i) {
            if (s_.droplets[i].volume > 0.0 && from_[i] != to_[i]) {
                shedOne(i);
            }
        }
        std::vector<Piece> pieces;
        for (std::size_t i = count; i < s_.droplets.size(); ++i) {
            pieces.push_back({static_cast<std::uint32_t>(i), to_[i], to_[i], reach_[i]});
        }
        gather(std::move(pieces));
    }

    void shedOne(std::size_t i)
    {
        const double way = sizeOf(to_[i] - from_[i]);
        const Vec2 direction = (1.0 / way) * (to_[i] - from_[i]);
        const RandomStream chance(p_.seed, Chance::Bead, s_.droplets[i].id);
        double at = -s_.droplets[i].since_bead;  // of the last bead, from the beginning of the way
        while (true) {
            RunningDroplet& d = s_.droplets[i];
            const double spacing = p_.streaks.spacing * (0.5 + chance.uniform(d.beads));
            if (at + spacing > way) {
                break;
            }
            at += spacing;
            ++d.beads;
            // Never so much that the bead itself would run, nor that the droplet would no longer.
            const double bead = std::min(p_.streaks.film * 2.0 * reach_[i] * spacing, 0.5 * rules_.greatest);
            const double behind = 1.05 * (reach_[i] + rules_.reachOf(bead));  // where it is not touched at once
            const Vec2 place = from_[i] + (at - behind) * direction;
            if (d.volume - bead >= rules_.greatest && p_.glass.holds(place)) {
                d.volume -= bead;
                s_.shed.add(bead);
                StillDroplet laid{place, bead};
                while (laid.volume < rules_.greatest && joinsStill(laid)) {
                }
                if (laid.volume >= rules_.greatest) {
                    grow(laid);
                }
            }
        }
        s_.droplets[i].since_bead = way - at;
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
                if (d.volume > 0.0 && blade->meets(from_[i], d.position)) {
                    s_.wiped.add(d.volume);
                    ++s_.counts.wiped;
                    d.volume = 0.0;
                }
            }
            Taking taking(s_.still);
            blade->visitCells(cellsOf(s_.still), [&](std::size_t first, std::size_t last) {
                for (std::size_t cell = first; cell <= last; ++cell) {
                    const auto here = s_.still.droplets(cell);
                    for (std::size_t k = 0; k < here.size(); ++k) {
                        if (blade->covers(here[k].position)) {
                            s_.wiped.add(taking.take({cell, static_cast<std::uint8_t>(k)}));
                            ++s_.counts.wiped;
                        }
                    }
                }
            });
            taking.close();
        }
    }

    void leave()
    {
        s_.tracks.clear();
        std::size_t kept = 0;
        for (std::size_t i = 0; i < s_.droplets.size(); ++i) {
            RunningDroplet& d = s_.droplets[i];
            if (from_[i] != to_[i]) {
                s_.tracks.push_back({d.id, from_[i], to_[i], reach_[i]});
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

    [[nodiscard]] Cells contactCells() const
    {
        return Cells::over({p_.glass.width(), p_.glass.height()}, kContactCell);
    }

    WindshieldState& s_;
    const WindshieldParameters& p_;
    double dt_;
    CapScale caps_;
    StillRules rules_;
    double most_still_reach_ = 0.0;      // half the width of the largest still droplet [m]
    double most_push_ = 0.0;             // √6 of the root mean square, in both directions [m/s²]
    std::vector<StillDroplet> drizzle_;  // small raindrops of this step
    std::size_t before_rain_ = 0;        // how many running droplets there were
    // Of every running droplet, in their order:
    std::vector<Vec2> from_;
    std::vector<Vec2> to_;
    std::vector<double> reach_;
    std::vector<std::uint32_t> owner_;  // who has its water
    std::vector<std::uint8_t> grown_;
    std::vector<std::uint32_t> tracks_of_cell_;
    std::vector<std::uint32_t> tracks_;
    std::vector<std::uint32_t> joined_;
};

}  // namespace

void CarriedSum::add(double term)
{
    const double total = sum + term;
    carry += std::abs(sum) >= std::abs(term) ? (sum - total) + term : (term - total) + sum;
    sum = total;
}

double WaterBalance::residual() const
{
    CarriedSum difference;
    for (const double term : {rained, -on_glass_still, -on_glass_running, -left, -wiped}) {
        difference.add(term);
    }
    return rained > 0.0 ? difference.value() / rained : 0.0;
}

void Fluctuation::validate() const
{
    require(acceleration >= 0.0 && std::isfinite(acceleration), "fluctuation.acceleration", acceleration,
            "finite and at least 0 m/s2");
    require(interval > 0.0 && std::isfinite(interval), "fluctuation.interval", interval, "finite and more than 0 s");
}

void Streaks::validate() const
{
    require(film >= 0.0 && std::isfinite(film), "streaks.film", film, "finite and at least 0 m");
    require(spacing >= 1e-4 && std::isfinite(spacing), "streaks.spacing", spacing, "finite and at least 1e-4 m");
}

void WindshieldParameters::validate() const
{
    const double area = glass.width() * glass.height();
    require(area <= kMostArea, "the glass's area", area, "at most 100 m2");
    forces.validate();
    vehicle.validate();
    require(rainfall >= 0.0 && rainfall <= 1000.0 * kMillimetrePerHour, "rainfall", rainfall / kMillimetrePerHour,
            "from 0 to 1000 mm/h");
    raindrops.validate();
    require(still_diameter > 0.0 && still_diameter <= 2e-3, "still_diameter", still_diameter,
            "more than 0 and at most 0.002 m");
    fluctuation.validate();
    streaks.validate();
    for (const Wiper& wiper : wipers) {
        wiper.validate();
    }
}

WindshieldState startWindshield(const WindshieldParameters& parameters)
{
    parameters.validate();
    WindshieldState state;
    state.still = noStillDroplets({parameters.glass.width(), parameters.glass.height()});
    return state;
}

WindshieldState step(WindshieldState state, const WindshieldParameters& parameters, double dt)
{
    parameters.validate();
    require(dt > 0.0 && std::isfinite(dt), "dt", dt, "finite and more than 0 s");
    const Cells cells = Cells::over({parameters.glass.width(), parameters.glass.height()}, kStillCell);
    if (state.still.columns != cells.columns || state.still.rows != cells.rows || state.still.cell != cells.width) {
        throw Error(ErrorCode::InvalidArgument, "state is of a glass of " + std::to_string(state.still.columns) +
                                                    " x " + std::to_string(state.still.rows) + " cells; this one has " +
                                                    std::to_string(cells.columns) + " x " + std::to_string(cells.rows));
    }
    Step(state, parameters, dt).run();
    return state;
}

WaterBalance balanceOf(const WindshieldState& state)
{
    CarriedSum still;
    for (std::size_t cell = 0; cell < state.still.counts.size(); ++cell) {
        for (const StillDroplet& d : state.still.droplets(cell)) {
            still.add(d.volume);
        }
    }
    CarriedSum running;
    for (const RunningDroplet& d : state.droplets) {
        running.add(d.volume);
    }
    return {state.rained.value(), still.value(),        running.value(),     state.left.value(),
            state.wiped.value(),  state.merged.value(), state.swept.value(), state.shed.value()};
}

}  // namespace droplet
