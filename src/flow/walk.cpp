// SPDX-License-Identifier: GPL-3.0-or-later
// P. Fournier, A. Habibi, P. Poulin, "Simulating the flow of liquid droplets", Graphics Interface 1998, sections 2.1 to
// 2.3. Departures: a droplet that both sides of a concave edge press against it runs along the edge, where the paper's
// would cross it without end; one in the air lands again.
#include "flow/walk.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "flow/following.h"
#include "flow/leg_means.h"

namespace droplet {
namespace {

// Crossings come no nearer to a corner than this share of the side, so that they have one neighbour.
constexpr double kCornerShare = 1e-12;
// A hop over a concave edge lower than this share of the droplet's width is none.
constexpr double kLowestHop = 1e-3;
// Velocities across a side less than this share of the whole are rounding.
constexpr double kRounding = 1e-13;
// Friction of hysteresis keeps its direction until the velocity has turned from it by a degree: tangent and cosine.
constexpr double kCone = 0.017455;
constexpr double kStraight = 0.99984;
// A velocity less than this share of what it was, and gained since, is 0.
constexpr double kStop = 1e-9;
// On uneven ground a droplet that moves less than this share of its width in a second rests: dry friction would turn
// with it to and fro without end.
constexpr double kCreep = 0.05;
// One so slow that the push turns it within this time [s] goes where it is pushed, for the same reason.
constexpr double kTurnsAtOnce = 1e-3;
// So many events within so short a time [s] are without end.
constexpr int kMaxEventsAtOnce = 1000;
constexpr double kOnce = 1e-6;

class Walk {
public:
    Walk(const WalkField& field, const WalkForces& forces, FlowDroplet& droplet)
        : field_(field),
          faces_(field.surface.faces),
          landing_(field.landing),
          ground_(field.ground),
          pinning_(field.pinning),
          f_(forces),
          drive_(forces.acceleration + forces.wind),
          d_(droplet),
          time_(droplet.leg.begin)
    {
    }

    /// Records the path from now on.
    void record(std::vector<FlowTrack>* tracks, double from)
    {
        tracks_ = tracks;
        if (tracks_ != nullptr) {
            track_time_ = std::max(from, d_.leg.begin);
            track_begin_ = d_.leg.placeAt(track_time_);
        }
    }

    WalkCounts until(double end)
    {
        int at_once = 0;
        double begin = time_;
        while (time_ < end) {
            if (!advance(end)) {
                break;
            }
            ++at_once;
            if (time_ > begin + kOnce) {
                at_once = 0;
                begin = time_;
            }
            if (at_once > kMaxEventsAtOnce) {
                stop(d_.leg.placeAt(time_));
                ++counts_.stuck;
                break;
            }
        }
        if (d_.contact == FlowContact::Face || d_.contact == FlowContact::Edge) {
            endTrack(d_.leg.placeAt(end), end);
        }
        return counts_;
    }

    void redirect(double time)
    {
        time_ = time;
        const Vec3 place = d_.leg.placeAt(time);
        Vec3 velocity = d_.leg.velocityAt(time);
        if (d_.contact != FlowContact::Air && creeps(velocity)) {
            velocity = {};
        }
        switch (d_.contact) {
            case FlowContact::Face:
            case FlowContact::Still:
                enter(d_.face, time, place, velocity);
                break;
            case FlowContact::Edge:
                if (isValley(d_.face, d_.side)) {
                    move(place, velocity, true);
                } else {
                    enter(d_.face, time, place, velocity);
                }
                break;
            case FlowContact::Air:
                d_.leg = {time, place, velocity, f_.fall, 0.0};
                break;
        }
    }

    void enter(std::uint32_t face, double time, Vec3 place, Vec3 velocity)
    {
        time_ = time;
        const Vec3& normal = faces_[face].normal;
        const Vec3 along = velocity - dot(velocity, normal) * normal;
        if (d_.contact != FlowContact::Air && face != d_.face) {
            endTrack(place, time);
        }
        if (d_.contact == FlowContact::Air) {
            track_begin_ = place;
            track_time_ = time;
        }
        d_.face = face;
        if (dot(f_.acceleration, normal) > f_.adhesion) {
            launch(place, along);
            return;
        }
        d_.contact = FlowContact::Face;
        move(place, along, true);
    }

private:
    using Face = FlowSurface::Face;

    /// What a face does to the droplet; the same during a walk.
    struct Footing {
        std::uint32_t face = FlowSurface::kNone;
        Grip grip;
        Vec3 push;  // along the face, less what roughness takes [m/s²]
    };

    Vec3 pushWithoutRoughness(std::uint32_t face) const
    {
        const Vec3& normal = faces_[face].normal;
        return drive_ - dot(drive_, normal) * normal;
    }

    const Footing& footingOn(std::uint32_t face) const
    {
        if (footings_[0].face == face) {
            return footings_[0];
        }
        std::swap(footings_[0], footings_[1]);
        if (footings_[0].face == face) {
            return footings_[0];
        }
        Footing& footing = footings_[0];
        footing = {face, ground_.at(face, d_.id, f_.height), pushWithoutRoughness(face)};
        const Vec2 smoothness = footing.grip.smoothness;
        if (smoothness.x == smoothness.y) {
            footing.push = smoothness.x * footing.push;  // F ← F (1 − k_r)
        } else {
            const Vec3 edge = faces_[face].corners[1] - faces_[face].corners[0];
            const Vec3 x = (1.0 / length(edge)) * edge;
            const Vec3 along = dot(footing.push, x) * x;
            footing.push = smoothness.x * along + smoothness.y * (footing.push - along);
        }
        return footing;
    }

    Vec3 pushOn(std::uint32_t face) const
    {
        const Vec3 push = ground_.isUniform() ? pushWithoutRoughness(face) : footingOn(face).push;
        if (!hold_) {
            return push;
        }
        // And to where the droplet is held less.
        const Vec3& normal = faces_[face].normal;
        const double grip = ground_.isUniform() ? 1.0 : footingOn(face).grip.retention;
        return push + (grip * f_.sliding) * (aside_ - dot(aside_, normal) * normal);
    }

    Vec3 pushHere() const { return d_.contact == FlowContact::Edge ? pushAlong() : pushOn(d_.face); }

    Grip gripHere() const { return ground_.isUniform() ? Grip{} : footingOn(d_.face).grip; }

    /// Ends the piece of the path over the present face.
    void endTrack(Vec3 place, double time)
    {
        if (tracks_ != nullptr && place != track_begin_) {
            const double taken = time - track_time_;
            const double speed = taken > 0.0 ? length(place - track_begin_) / taken : 0.0;
            tracks_->push_back({d_.id, d_.face, track_begin_, place, f_.contact_width, time, speed});
            track_begin_ = place;
            track_time_ = time;
        }
    }

    /// Begins a leg; at rest if hysteresis holds the droplet.
    /// @param keeps_heading  whether the heading of the last leg still serves
    void move(Vec3 place, Vec3 velocity, bool keeps_heading)
    {
        const Grip grip = gripHere();
        Vec3 push = pushHere();
        if (f_.retention > 0.0 || f_.sliding > 0.0) {
            if (hold_ && !keeps_heading && d_.contact == FlowContact::Face) {
                velocity = turned(velocity, push);
            }
            const bool is_at_rest = velocity == Vec3{};
            if (pinning_ != nullptr && is_at_rest) {
                hold_.reset();
                push = pushHere();
            }
            const double pushed = length(push);
            if (pinning_ != nullptr && !hold_ && (!is_at_rest || pushed > 0.0)) {
                pin(place, is_at_rest ? (1.0 / pushed) * push : (1.0 / length(velocity)) * velocity);
                push = pushHere();
            }
            const double hold = grip.retention * (hold_ ? hold_->along : 1.0);
            if (is_at_rest && (pushed <= hold * std::max(f_.retention, f_.sliding) || hangs(place))) {
                stop(place);
                return;
            }
            const Vec3 direction = is_at_rest ? push : velocity;
            const double size = length(direction);
            if (!keeps_heading || dot(d_.heading, direction) < kStraight * size) {
                d_.heading = (1.0 / size) * direction;
            }
            const Vec3& normal = faces_[d_.face].normal;
            const Vec3 on = d_.heading - dot(d_.heading, normal) * normal;  // the last face may have been another
            d_.heading = (1.0 / length(on)) * on;
            push = push - (hold * f_.sliding) * d_.heading;
        }
        d_.leg = {time_, place, velocity, push, grip.friction * f_.decay};
    }

    [[nodiscard]] bool creeps(Vec3 velocity) const
    {
        return pinning_ != nullptr && length(velocity) < kCreep * f_.contact_width;
    }

    static Vec3 turned(Vec3 velocity, Vec3 push)
    {
        const double size = length(push);
        if (!(length(velocity) < kTurnsAtOnce * size)) {
            return velocity;
        }
        return (std::max(dot(velocity, push), 0.0) / (size * size)) * push;
    }

    /// What holds the droplet where it is, on its way ahead.
    void pin(Vec3 place, Vec3 ahead)
    {
        const Vec3 left = droplet::cross(faces_[d_.face].normal, ahead);
        ContactFront front{place, 0.5 * f_.contact_width, ahead, left};
        if (field_.rest != nullptr) {
            const Face& from = faces_[d_.face];
            const Face& to = field_.rest->faces[d_.face];
            front = {followed(from, to, place), front.radius, turnedWith(from, to, ahead), turnedWith(from, to, left)};
        }
        hold_ = pinning_->over(front);
        aside_ = hold_->aside * left;
    }

    /// When the velocity has turned away from the heading, or is 0; [s] after the leg's begin.
    std::optional<double> endOfHeading() const
    {
        if (f_.sliding == 0.0) {
            return std::nullopt;
        }
        const Vec3 across = droplet::cross(faces_[d_.face].normal, d_.heading);
        std::optional<double> first;
        for (const double side : {-1.0, 1.0}) {
            // The velocity is within the heading's cone as long as its parts along both of these are positive.
            const Vec3 inward = kCone * d_.heading + side * across;
            const auto time =
                Coordinate{0.0, dot(d_.leg.velocity, inward), dot(d_.leg.push, inward), d_.leg.decay}.turns();
            if (time && (!first || *time < *first)) {
                first = time;
            }
        }
        return first;
    }

    /// Turns the friction to where the velocity has turned.
    void turn()
    {
        const Vec3 place = d_.leg.placeAt(time_);
        Vec3 velocity = d_.leg.velocityAt(time_);
        if (creeps(velocity) ||
            length(velocity) <= kStop * (length(d_.leg.velocity) + length(d_.leg.push) * (time_ - d_.leg.begin))) {
            velocity = {};
        }
        move(place, velocity, false);
    }

    /// Ends the leg where its heading does, if that is within a time of its begin.
    bool turnsWithin(double time)
    {
        const auto turned = endOfHeading();
        if (!turned || *turned >= time) {
            return false;
        }
        time_ = d_.leg.begin + *turned;
        turn();
        return true;
    }

    bool advance(double end)
    {
        switch (d_.contact) {
            case FlowContact::Face:
                return advanceOnFace(end);
            case FlowContact::Edge:
                return advanceAlongEdge(end);
            case FlowContact::Air:
                return advanceInAir(end);
            case FlowContact::Still:
                break;
        }
        return false;
    }

    /// The path's distance from a line or plane through `at`, from now on.
    Coordinate coordinate(Vec3 at, Vec3 direction) const
    {
        return {dot(d_.leg.place - at, direction), dot(d_.leg.velocity, direction), dot(d_.leg.push, direction),
                d_.leg.decay};
    }

    bool advanceOnFace(double end)
    {
        const Face& face = faces_[d_.face];
        const double least = kRounding * length(d_.leg.velocity);
        double until = end - d_.leg.begin;
        LegMeans mean = legMeans(d_.leg.decay * until);
        struct Exit {
            Coordinate inside;
            double guess = 0.0;
            std::size_t side = 0;
        };
        std::array<Exit, 3> exits;
        std::size_t count = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            Coordinate s = coordinate(face.corners[k], face.inward[k]);
            s.place = std::max(s.place, 0.0);
            if (std::abs(s.velocity) < least) {
                s.velocity = 0.0;
            }
            // Where it is pushed outward and inside in the end, it was inside before.
            if (s.push > 0.0 ? s.velocity < 0.0 : placeAfter(s, until, mean) < 0.0) {
                exits[count++] = {s, s.velocity < 0.0 ? -s.place / s.velocity : until, k};
            }
        }
        // The first exit comes first, mostly; then the others need no search.
        std::sort(exits.begin(), exits.begin() + static_cast<std::ptrdiff_t>(count),
                  [](const Exit& a, const Exit& b) { return a.guess < b.guess; });
        std::optional<double> first;
        std::size_t side = 0;
        for (std::size_t k = 0; k < count; ++k) {
            const auto time = firstBelowZero(exits[k].inside, until, mean);
            if (time && (!first || *time < *first || (*time == *first && exits[k].side < side))) {
                first = time;
                side = exits[k].side;
                if (k + 1 < count) {
                    until = *time;
                    mean = legMeans(d_.leg.decay * until);
                }
            }
        }
        if (turnsWithin(first.value_or(end - d_.leg.begin))) {
            return true;
        }
        if (!first) {
            return false;
        }
        time_ = d_.leg.begin + *first;
        cross(side);
        return true;
    }

    void cross(std::size_t side)
    {
        ++counts_.crossings;
        const std::uint32_t from = d_.face;
        const Face& face = faces_[from];
        const Vec3 a = face.corners[side];
        const Vec3 edge = face.corners[(side + 1) % 3] - a;
        const double passed = time_ - d_.leg.begin;
        const LegMeans mean = legMeans(d_.leg.decay * passed);
        const double share = dot(placeAfter(d_.leg, passed, mean) - a, edge) / dot(edge, edge);
        const Vec3 place = a + std::clamp(share, kCornerShare, 1.0 - kCornerShare) * edge;
        const Vec3 velocity = velocityAfter(d_.leg, passed, mean);
        const std::uint32_t to = face.neighbour[side];
        if (to == FlowSurface::kNone) {
            if (edgeHolds(side, velocity)) {
                stop(place);
            } else {
                launch(place, velocity);
            }
            return;
        }
        const Face& next = faces_[to];
        const std::size_t next_side = sideTo(next, from);
        const Vec3 along = (dot(velocity, edge) / dot(edge, edge)) * edge;
        const double outward = std::max(-dot(velocity, face.inward[side]), 0.0);
        const double rise = dot(face.normal, next.inward[next_side]);  // of the next face over this one's plane
        const double cosine = dot(face.normal, next.normal);
        const double onward = rise > 0.0 ? outward * std::max(cosine, 0.0) : outward;
        const double push_next = dot(pushOn(to), next.inward[next_side]);
        const double push_back = dot(pushOn(from), face.inward[side]);
        if (rise < 0.0 && leavesAt(face, next, side, outward, cosine)) {
            launch(place, velocity);
            return;
        }
        // Inelastic at concave edges; at convex ones the speed stays. Where both faces press against the edge, at a
        // concave one or below an object, the hops become smaller without end.
        const bool enters = push_next < 0.0 && push_back <= 0.0
                                ? onward * onward > 2.0 * kLowestHop * f_.contact_width * -push_next
                                : onward > 0.0 || push_next >= 0.0 || push_back < 0.0;
        if (enters) {
            enter(to, time_, place, along + onward * next.inward[next_side]);
        } else if (push_back > 0.0) {
            enter(from, time_, place, along);
        } else {
            runAlong(from, side, place, along);
        }
    }

    /// Whether an open edge holds a droplet: one that comes to it needs the work that the edge does over the droplet's
    /// radius.
    [[nodiscard]] bool edgeHolds(std::size_t side, Vec3 velocity) const
    {
        const Vec3 outward = -1.0 * faces_[d_.face].inward[side];
        const double speed = std::max(dot(velocity, outward), 0.0);
        const double rest = f_.edge - dot(pushOn(d_.face), outward);
        return rest >= 0.0 && speed * speed <= rest * f_.contact_width;
    }

    /// Whether a droplet at rest hangs at an open edge.
    [[nodiscard]] bool hangs(Vec3 place) const
    {
        constexpr double kAtEdge = 1e-9;  // of the droplet's width
        const Face& face = faces_[d_.face];
        for (std::size_t k = 0; k < 3; ++k) {
            if (face.neighbour[k] == FlowSurface::kNone &&
                dot(place - face.corners[k], face.inward[k]) <= kAtEdge * f_.contact_width && edgeHolds(k, {})) {
                return dot(pushOn(d_.face), face.inward[k]) < 0.0;
            }
        }
        return false;
    }

    /// Whether adhesion fails where the path bends away: v²/R, with the bend spread over the faces or the droplet.
    bool leavesAt(const Face& face, const Face& next, std::size_t side, double outward, double cosine) const
    {
        const auto height = [&](const Face& of, std::size_t k) {
            return dot(of.corners[(k + 2) % 3] - of.corners[k], of.inward[k]);
        };
        const double spread = std::min(
            0.5 * (height(face, side) + height(next, sideTo(next, static_cast<std::uint32_t>(&face - faces_.data())))),
            f_.contact_width);
        const Vec3 sum = face.normal + next.normal;
        const double size = length(sum);
        const double lift = size > 0.0 ? dot(f_.acceleration, sum) / size : 0.0;
        const double bend = outward * outward / spread;
        // An angle is at most π/2 times its chord, which is quicker.
        if (bend * 1.5708 * length(face.normal - next.normal) + lift <= f_.adhesion) {
            return false;
        }
        const double angle = std::acos(std::clamp(cosine, -1.0, 1.0));
        return bend * angle + lift > f_.adhesion;
    }

    static std::size_t sideTo(const Face& face, std::uint32_t neighbour)
    {
        return face.neighbour[0] == neighbour ? 0 : face.neighbour[1] == neighbour ? 1 : 2;
    }

    void runAlong(std::uint32_t face, std::size_t side, Vec3 place, Vec3 velocity)
    {
        if (face != d_.face) {
            endTrack(place, time_);
        }
        d_.contact = FlowContact::Edge;
        d_.face = face;
        d_.side = static_cast<std::uint32_t>(side);
        move(place, velocity, false);
    }

    Vec3 pushAlong() const
    {
        const Face& face = faces_[d_.face];
        const Vec3 edge = face.corners[(d_.side + 1) % 3] - face.corners[d_.side];
        return (dot(pushOn(d_.face), edge) / dot(edge, edge)) * edge;
    }

    bool advanceAlongEdge(double end)
    {
        const Face& face = faces_[d_.face];
        std::optional<double> first;
        std::size_t corner = 0;
        for (const std::size_t k : {std::size_t{d_.side}, (std::size_t{d_.side} + 1) % 3}) {
            const std::size_t other = k == d_.side ? (k + 1) % 3 : d_.side;
            const Vec3 edge = face.corners[other] - face.corners[k];
            Coordinate s = coordinate(face.corners[k], (1.0 / length(edge)) * edge);
            s.place = std::max(s.place, 0.0);
            const auto time = s.fallsBelowZero(0.0, first ? *first : end - d_.leg.begin);
            if (time && (!first || *time < *first)) {
                first = time;
                corner = k;
            }
        }
        if (turnsWithin(first.value_or(end - d_.leg.begin))) {
            return true;
        }
        if (!first) {
            return false;
        }
        time_ = d_.leg.begin + *first;
        passCorner(corner);
        return true;
    }

    /// A face around a corner.
    struct Spoke {
        std::uint32_t face = 0;
        std::size_t corner = 0;
    };

    /// From the end of a concave edge onto a face or along another edge, whichever keeps most of the velocity; without
    /// a velocity, whichever the force has most of. In a pit, where the force leads nowhere, small hops end.
    void passCorner(std::size_t corner)
    {
        const Vec3 place = faces_[d_.face].corners[corner];
        const Vec3 velocity = d_.leg.velocityAt(time_);
        const std::vector<Spoke> fan = fanAround(d_.face, corner);
        const std::optional<Way> downward = wayOf(fan, place, drive_);
        const double hop = 2.0 * kLowestHop * f_.contact_width * length(drive_);
        if (dot(velocity, velocity) > (downward ? 0.0 : hop)) {
            if (const auto way = wayOf(fan, place, velocity)) {
                take(*way, place, velocity);
                return;
            }
        }
        if (is_open_) {
            launch(place, velocity);
        } else if (downward) {
            take(*downward, place, {});
        } else {
            stop(place);
        }
    }

    /// A way on from a corner: over a face, or along the edge from its corner to the next.
    struct Way {
        std::uint32_t face = 0;
        std::size_t corner = 0;
        bool is_edge = false;
    };

    std::optional<Way> wayOf(const std::vector<Spoke>& fan, Vec3 place, Vec3 direction) const
    {
        std::optional<Way> best;
        double largest = 0.0;
        for (const Spoke& spoke : fan) {
            const Face& face = faces_[spoke.face];
            const Vec3 on = direction - dot(direction, face.normal) * face.normal;
            const std::size_t before = (spoke.corner + 2) % 3;
            if (dot(on, face.inward[spoke.corner]) >= 0.0 && dot(on, face.inward[before]) >= 0.0 &&
                length(on) > largest) {
                largest = length(on);
                best = {spoke.face, spoke.corner, false};
            }
            const Vec3 edge = face.corners[(spoke.corner + 1) % 3] - place;
            const double share = dot(direction, edge) / length(edge);
            if (share > largest && isValley(spoke.face, spoke.corner)) {
                largest = share;
                best = {spoke.face, spoke.corner, true};
            }
        }
        return best;
    }

    void take(const Way& way, Vec3 place, Vec3 velocity)
    {
        if (way.is_edge) {
            const Vec3 edge = faces_[way.face].corners[(way.corner + 1) % 3] - place;
            runAlong(way.face, way.corner, place, (dot(velocity, edge) / dot(edge, edge)) * edge);
        } else {
            enter(way.face, time_, place, velocity);
        }
    }

    std::vector<Spoke> fanAround(std::uint32_t start, std::size_t corner)
    {
        std::vector<Spoke> fan{{start, corner}};
        is_open_ = false;
        for (const bool forward : {true, false}) {
            Spoke at = fan.front();
            for (;;) {
                const std::size_t side = forward ? (at.corner + 2) % 3 : at.corner;
                const std::uint32_t next = faces_[at.face].neighbour[side];
                if (next == start) {
                    return fan;
                }
                if (next == FlowSurface::kNone) {
                    is_open_ = true;
                    break;
                }
                const std::size_t beside = sideTo(faces_[next], at.face);
                at = {next, forward ? beside : (beside + 1) % 3};
                fan.push_back(at);
            }
        }
        return fan;
    }

    /// Whether both faces of an edge press a droplet against it.
    bool isValley(std::uint32_t from, std::size_t side) const
    {
        const Face& face = faces_[from];
        const std::uint32_t to = face.neighbour[side];
        if (to == FlowSurface::kNone) {
            return false;
        }
        const std::size_t beyond = sideTo(faces_[to], from);
        const double push_from = dot(pushOn(from), face.inward[side]);
        const double push_to = dot(pushOn(to), faces_[to].inward[beyond]);
        return push_from <= 0.0 && push_to <= 0.0 && push_from + push_to < 0.0;
    }

    void launch(Vec3 place, Vec3 velocity)
    {
        ++counts_.launches;
        if (d_.contact != FlowContact::Air) {
            endTrack(place, time_);
        }
        d_.contact = FlowContact::Air;
        d_.leg = {time_, place, velocity, f_.fall, 0.0};
    }

    bool advanceInAir(double end)
    {
        const auto hit = landing_.next(d_.leg, d_.face, time_, end);
        if (!hit) {
            return false;
        }
        ++counts_.landings;
        Vec3 velocity = d_.leg.velocityAt(hit->time);
        if (field_.motion != nullptr) {  // it was over ground that moves otherwise
            velocity = velocity + field_.motion->driftOf(d_.face, hit->time).velocity -
                       field_.motion->driftOf(hit->face, hit->time).velocity;
        }
        enter(hit->face, hit->time, hit->place, velocity);
        return true;
    }

    void stop(Vec3 place)
    {
        d_.contact = FlowContact::Still;
        d_.leg = {time_, place, {}, {}, 0.0};
    }

    const WalkField& field_;
    const std::vector<Face>& faces_;
    const Landing& landing_;
    const WalkFaces& ground_;
    const PinningField* pinning_;
    std::optional<PinningHold> hold_;  // of the walk
    Vec3 aside_;                       // the direction of its part aside
    const WalkForces& f_;
    Vec3 drive_;  // acceleration along the surface, before roughness
    FlowDroplet& d_;
    double time_;
    mutable std::array<Footing, 2> footings_;  // those asked for last
    bool is_open_ = false;                     // the last fan
    std::vector<FlowTrack>* tracks_ = nullptr;
    Vec3 track_begin_;
    double track_time_ = 0.0;  // at its begin
    WalkCounts counts_;
};

}  // namespace

WalkCounts walk(const WalkField& field, const WalkForces& forces, FlowDroplet& droplet, double until,
                std::vector<FlowTrack>* tracks, double from)
{
    Walk walk(field, forces, droplet);
    const bool runs = droplet.contact == FlowContact::Face || droplet.contact == FlowContact::Edge;
    if (field.pinning != nullptr && runs && droplet.leg.begin < from) {
        walk.redirect(from);
    }
    walk.record(tracks, from);
    return walk.until(until);
}

void putOnFace(const WalkField& field, const WalkForces& forces, FlowDroplet& droplet, std::uint32_t face,
               const Leg& begin)
{
    droplet.contact = FlowContact::Face;
    droplet.face = face;
    Walk(field, forces, droplet).enter(face, begin.begin, begin.place, begin.velocity);
}

void redirect(const WalkField& field, const WalkForces& forces, FlowDroplet& droplet, double time)
{
    Walk(field, forces, droplet).redirect(time);
}

}  // namespace droplet
