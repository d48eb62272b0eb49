// SPDX-License-Identifier: GPL-3.0-or-later
//
// In the droplet's frame a point (x, y, z) of the flat droplet becomes (x', y', z + H + c (1 - r²)): (x', y') is (x, y)
// moved with the rim in its direction, by a share that grows from the middle to the rim. H is the harmonic function
// with the rim's heights, in the unit disc to which the droplet's surface is mapped: r is the distance from its middle.
// For small slopes the equation of Young and Laplace is linear: surfaces of one pressure over two rims differ by a
// harmonic function, those of two pressures over one rim by 1 - r². So liquid is smooth, even over ground with edges;
// its base alone has these. Where the ground would come out of the liquid, it is just covered. The volume is linear in
// c but for that, so that secants give the c with which it stays. A droplet that would have to become too tall, as on a
// narrow ridge, becomes wider.
#include "flow_io/seat.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "droplet/units.h"
#include "unit_vector.h"

namespace droplet {
namespace {

// Experiments for the constants: docs/method/flow.md, "Droplets on the object".
constexpr double kReach = 1.0;     // of the ground above and below the droplet's plane, over its mean radius
constexpr double kSteepest = 2.5;  // rise of the ground that a droplet follows, over the way
constexpr double kLeastWay = 0.8;  // to which a rim is drawn back, over its distance from the middle
constexpr double kMostTall = 2.5;  // factor on heights
constexpr double kMostStep = 0.5;  // of the ground from the plane through middle and rim, over the mean radius
constexpr int kWaySteps = 12;      // along the way from the middle to the rim

struct Local {
    Vec2 level;
    double height = 0.0;
};

Local toLocal(const DropletFrame& frame, Vec3 place)
{
    const Vec3 d = place - frame.place;
    return {{dot(d, frame.ahead), dot(d, frame.left)}, dot(d, frame.normal)};
}

/// The ground below a droplet, in its frame.
class Ground {
public:
    Ground(const FlowTerrain& terrain, const DropletFrame& frame, double size)
        : terrain_(terrain), frame_(frame), size_(size)
    {
    }

    /// Height over the droplet's plane; none where no ground that faces the droplet is in reach.
    [[nodiscard]] std::optional<double> at(Vec2 p) const
    {
        constexpr double kFrom = 1.5;
        const Vec3 origin = toSpace({p, kFrom * size_});
        const auto hit = terrain_.firstAlong(origin, -1.0 * frame_.normal);
        if (!hit || dot(terrain_.surface().faces[hit->face].normal, frame_.normal) <= 0.0) {
            return std::nullopt;
        }
        const double height = dot(hit->place - frame_.place, frame_.normal);
        return std::abs(height) <= kReach * size_ ? std::optional(height) : std::nullopt;
    }

    [[nodiscard]] Local nearest(Vec2 p) const { return toLocal(frame_, terrain_.nearest(toSpace({p, 0.0})).place); }

    [[nodiscard]] Vec3 toSpace(const Local& p) const
    {
        return frame_.place + p.level.x * frame_.ahead + p.level.y * frame_.left + p.height * frame_.normal;
    }

    [[nodiscard]] double size() const { return size_; }

    /// Share of the way to a point over which the ground goes on without a step.
    [[nodiscard]] double wayTo(Vec2 p) const
    {
        const double step = length(p) / kWaySteps;
        double before = at({}).value_or(0.0);
        for (int i = 1; i <= kWaySteps; ++i) {
            const double share = static_cast<double>(i) / kWaySteps;
            const auto height = at(share * p);
            if (!height || std::abs(*height - before) > kSteepest * step) {
                return edgeBetween(p, {share - 1.0 / kWaySteps, share}, before);
            }
            before = *height;
        }
        return 1.0;
    }

private:
    /// Where the ground ends between two shares of a way.
    [[nodiscard]] double edgeBetween(Vec2 p, std::array<double, 2> shares, double height) const
    {
        constexpr int kHalvings = 8;
        for (int i = 0; i < kHalvings; ++i) {
            const double middle = 0.5 * (shares[0] + shares[1]);
            const auto there = at(middle * p);
            const double way = (middle - shares[0]) * length(p);
            if (there && std::abs(*there - height) <= kSteepest * way) {
                shares[0] = middle;
                height = *there;
            } else {
                shares[1] = middle;
            }
        }
        return shares[0];
    }

    const FlowTerrain& terrain_;
    const DropletFrame& frame_;
    double size_;
};

/// Frame whose normal is the mean of the ground's below a droplet, so that it sits on both sides of an edge alike.
/// Below places beyond an edge, the nearest ground is on its other side.
DropletFrame leaning(const FlowTerrain& terrain, DropletFrame frame, double size)
{
    constexpr std::size_t kAround = 12;
    constexpr double kAway = 0.75;
    constexpr double kBelow = 0.35;
    constexpr double kNearlyOne = 1.0 - 1e-12;
    Vec3 sum = static_cast<double>(kAround) / 3.0 * frame.normal;
    for (std::size_t k = 0; k < kAround; ++k) {
        const double angle = 2.0 * std::numbers::pi * static_cast<double>(k) / kAround;
        const Vec3 place = frame.place + size * (kAway * std::cos(angle) * frame.ahead +
                                                 kAway * std::sin(angle) * frame.left - kBelow * frame.normal);
        const FlowTerrain::Point point = terrain.nearest(place);
        const Vec3 normal = terrain.surface().faces[point.face].normal;
        // What is far belongs to another part of the object, and a thin part has a back.
        if (length(point.place - place) <= size && dot(normal, frame.normal) > -0.5) {
            sum = sum + normal;
        }
    }
    const Vec3 normal = (1.0 / length(sum)) * sum;
    if (dot(normal, frame.normal) > kNearlyOne) {
        return frame;
    }
    frame.normal = normal;
    const Vec3 ahead = frame.ahead - dot(frame.ahead, normal) * normal;
    if (length(ahead) > 0.1) {
        frame.ahead = (1.0 / length(ahead)) * ahead;
        frame.left = cross(normal, frame.ahead);
    } else {
        const Vec3 left = frame.left - dot(frame.left, normal) * normal;
        frame.left = (1.0 / length(left)) * left;
        frame.ahead = cross(frame.left, normal);
    }
    return frame;
}

/// The rim of a droplet, and where it goes.
class Rim {
public:
    Rim(const Ground& ground, std::vector<Vec2> flat) : flat_(std::move(flat)), seated_(flat_.size())
    {
        const std::size_t count = flat_.size();
        bool is_even = true;
        for (std::size_t k = 0; k < count; ++k) {
            const auto height = ground.at(flat_[k]);
            is_even = is_even && height && std::abs(*height) <= kSteepest * length(flat_[k]);
            seated_[k] = {flat_[k], height.value_or(0.0)};
        }
        for (std::size_t k = 0; k < count && is_even; ++k) {
            const std::size_t next = (k + 1) % count;
            is_even = std::abs(seated_[next].height - seated_[k].height) <= kSteepest * length(flat_[next] - flat_[k]);
        }
        if (!is_even) {
            drawBack(ground);
        }
        sortAngles();
    }

    [[nodiscard]] const Local& seated(std::size_t k) const { return seated_[k]; }

    /// Draws points back to where they are as far from the middle, in space, as on a plane: a contact line does not go
    /// farther on ground that bends.
    void keepDistances(const Ground& ground)
    {
        constexpr double kSlope = 0.1;  // changes a distance by 0.5 %
        constexpr int kTries = 3;
        for (std::size_t k = 0; k < flat_.size(); ++k) {
            const double way = length(flat_[k]);
            Local& point = seated_[k];
            for (int i = 0; i < kTries && std::abs(point.height) > kSlope * way; ++i) {
                const Vec2 level = std::min(way / std::hypot(length(point.level), point.height), 1.0) * point.level;
                const auto height = ground.at(level);
                if (!height) {
                    break;
                }
                point = {level, *height};
            }
        }
    }

    struct Place {
        double share = 0.0;   ///< of the way from the middle to the rim
        double way = 0.0;     ///< from the middle to the rim
        double turn = 0.0;    ///< around the rim, as the numbers of its vertices grow [rad]
        Vec2 moved;           ///< the rim's way along the plane
        double height = 0.0;  ///< of the seated rim
    };

    /// Rim in the direction of a point.
    [[nodiscard]] Place towards(Vec2 p) const
    {
        const std::size_t count = flat_.size();
        const double angle = std::atan2(p.y, p.x);
        const auto after = std::upper_bound(angles_.begin(), angles_.end(), angle) - angles_.begin();
        const std::size_t b = (static_cast<std::size_t>(after) + first_) % count;
        const std::size_t a = (b + count - 1) % count;
        // The rim from a to b is met at u: p × (a + u (b − a)) = 0.
        const double from = cross(p, flat_[a]);
        const double to = cross(p, flat_[b]);
        const double u = from != to ? std::clamp(from / (from - to), 0.0, 1.0) : 0.0;
        const Vec2 met = (1.0 - u) * flat_[a] + u * flat_[b];
        const Vec2 end = (1.0 - u) * seated_[a].level + u * seated_[b].level;
        const double way = length(met);
        return {way > 0.0 ? length(p) / way : 0.0, way,
                2.0 * std::numbers::pi * (static_cast<double>(a) + u) / static_cast<double>(count), end - met,
                (1.0 - u) * seated_[a].height + u * seated_[b].height};
    }

private:
    void sortAngles()
    {
        for (const Vec2 p : flat_) {
            angles_.push_back(std::atan2(p.y, p.x));
        }
        first_ = static_cast<std::size_t>(std::min_element(angles_.begin(), angles_.end()) - angles_.begin());
        std::rotate(angles_.begin(), angles_.begin() + static_cast<std::ptrdiff_t>(first_), angles_.end());
    }

    /// Draws the rim back to where the ground ends, without teeth.
    void drawBack(const Ground& ground)
    {
        constexpr double kTooth = 0.12;  // that a way may exceed its neighbour's
        const std::size_t count = flat_.size();
        std::vector<double> ways;
        for (const Vec2 p : flat_) {
            ways.push_back(ground.wayTo(p));
        }
        for (std::size_t k = 0; k < 2 * count; ++k) {
            ways[(k + 1) % count] = std::min(ways[(k + 1) % count], ways[k % count] + kTooth);
        }
        for (std::size_t k = 2 * count; k-- > 0;) {
            ways[k % count] = std::min(ways[k % count], ways[(k + 1) % count] + kTooth);
        }
        for (std::size_t k = 0; k < count; ++k) {
            const Vec2 end = std::max(ways[k], kLeastWay) * flat_[k];
            const auto height = ground.at(end);
            seated_[k] = ways[k] >= kLeastWay && height ? Local{end, *height} : ground.nearest(end);
        }
    }

    std::vector<Vec2> flat_;
    std::vector<Local> seated_;
    std::vector<double> angles_;  ///< ascending, from vertex first_ on
    std::size_t first_ = 0;
};

/// Where the ground is below a point of the flat droplet.
Local groundBelow(const Ground& ground, const Rim& rim, Vec2 p)
{
    const Rim::Place place = rim.towards(p);
    const double share = std::min(place.share, 1.0);  // liquid over the rim goes with the rim
    const Vec2 level = p + share * place.moved;
    if (share == 1.0) {
        return {level, place.height};
    }
    // A step of the ground under the droplet stays under it.
    const double expected = share * place.height;
    const auto height = ground.at(level);
    return {level, height && std::abs(*height - expected) <= kMostStep * ground.size() ? *height : expected};
}

/// A smooth sheet through a rim: a plane, and harmonics of the rim's heights over it.
class Sheet {
public:
    Sheet(const Rim& rim, std::size_t count) : harmonics_(count / 2 + 1)
    {
        Vec2 middle;
        const double share = 1.0 / static_cast<double>(count);
        for (std::size_t k = 0; k < count; ++k) {
            middle = middle + share * rim.seated(k).level;
            height_ += share * rim.seated(k).height;
        }
        middle_ = middle;
        double xx = 0.0;
        double xy = 0.0;
        double yy = 0.0;
        Vec2 moment;
        for (std::size_t k = 0; k < count; ++k) {
            const Vec2 d = rim.seated(k).level - middle;
            xx += d.x * d.x;
            xy += d.x * d.y;
            yy += d.y * d.y;
            moment = moment + (rim.seated(k).height - height_) * d;
        }
        const double determinant = xx * yy - xy * xy;
        constexpr double kThin = 1e-9;  // a rim on a line
        if (determinant > kThin * (xx + yy) * (xx + yy)) {
            slope_ = (1.0 / determinant) * Vec2{yy * moment.x - xy * moment.y, xx * moment.y - xy * moment.x};
        }
        for (std::size_t k = 0; k < count; ++k) {
            const double rest = share * (rim.seated(k).height - planeAt(rim.seated(k).level));
            const Vec2 turn = directionOf(2.0 * std::numbers::pi * static_cast<double>(k) * share);
            Vec2 power{1.0, 0.0};
            for (std::size_t m = 0; m < harmonics_.size(); ++m) {
                harmonics_[m] = harmonics_[m] + (m == 0 || 2 * m == count ? rest : 2.0 * rest) * power;
                power = product(power, turn);
            }
        }
    }

    /// @param level   of the place, moved with the rim
    /// @param radius  of its image in the unit disc
    [[nodiscard]] double at(Vec2 level, const Rim::Place& place, double radius) const
    {
        double height = planeAt(level);
        const Vec2 turn = radius * directionOf(place.turn);
        Vec2 power{1.0, 0.0};
        for (const Vec2 harmonic : harmonics_) {
            height += dot(harmonic, power);
            power = product(power, turn);
        }
        return height;
    }

private:
    static Vec2 directionOf(double angle) { return {std::cos(angle), std::sin(angle)}; }

    /// Of complex numbers.
    static Vec2 product(Vec2 a, Vec2 b) { return {a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x}; }

    [[nodiscard]] double planeAt(Vec2 level) const { return height_ + dot(slope_, level - middle_); }

    Vec2 middle_;
    double height_ = 0.0;
    Vec2 slope_;
    std::vector<Vec2> harmonics_;  ///< of the cosine and of the sine
};

/// Distance from the middle of the unit disc to which a cap is mapped conformally, where its rim is the disc's. On a
/// sphere it is the ratio of tangents of half the angles from the top, which distances to both ends of the rim give.
/// @param height  of the cap there
double radiusInDisc(const Rim::Place& place, double height)
{
    const double high = place.way > 0.0 ? height / place.way : 0.0;
    const double sum = std::hypot(1.0 - place.share, high) + std::hypot(1.0 + place.share, high);
    return std::min(4.0 * place.share / (sum * sum), 1.0);
}

/// Sums of the normals of the triangles around each vertex, not of unit length.
std::vector<Vec3> facing(std::span<const Vec3> vertices, std::span<const Triangle> triangles)
{
    std::vector<Vec3> sums(vertices.size());
    for (const auto& [a, b, c] : triangles) {
        const Vec3 area = cross(vertices[b] - vertices[a], vertices[c] - vertices[a]);
        for (const std::uint32_t v : {a, b, c}) {
            sums[v] = sums[v] + area;
        }
    }
    return sums;
}

/// What a rim encloses.
struct Base {
    double area = 0.0;
    Vec2 middle;
};

Base baseOf(const Rim& rim, std::size_t count)
{
    Vec2 sum;
    double area = 0.0;
    for (std::size_t k = 0; k < count; ++k) {
        const Vec2 a = rim.seated(k).level;
        const Vec2 b = rim.seated((k + 1) % count).level;
        sum = sum + cross(a, b) * (a + b);
        area += 0.5 * cross(a, b);
    }
    return {area, area != 0.0 ? (1.0 / (6.0 * area)) * sum : Vec2{}};
}

/// Leans a droplet, and moves one whose rim is drawn back on one side, as at the edge of a leaf, to the other side, as
/// long as its base grows: otherwise its liquid would stand as a fin on what is left of its base.
DropletFrame inward(const FlowTerrain& terrain, const DropletFrame& frame, const std::vector<Vec2>& rim_points,
                    double size)
{
    constexpr int kMoves = 3;
    constexpr double kAside = 0.08;  // of the mean radius: less is no matter
    DropletFrame at = frame;
    DropletFrame best = frame;
    double largest = 0.0;
    for (int k = 0; k <= kMoves; ++k) {
        const DropletFrame leant = leaning(terrain, at, size);
        const Ground ground(terrain, leant, size);
        const Base base = baseOf(Rim(ground, rim_points), rim_points.size());
        if (std::abs(base.area) <= largest) {
            break;
        }
        best = leant;
        largest = std::abs(base.area);
        const auto height = ground.at(base.middle);
        if (length(base.middle) <= kAside * size || !height) {
            break;
        }
        at.place = ground.toSpace({base.middle, *height});
    }
    return best;
}

/// A droplet on flat ground.
struct Shape {
    const std::vector<Local>& flat;  ///< its vertices, those of the rim first
    const std::vector<Vec2>& rim;
    std::span<const Triangle> triangles;
    Vec3 origin;  ///< of volumes
    double volume = 0.0;
};

/// What is below a droplet.
struct Seating {
    std::vector<Local> below;    ///< each vertex without its height
    std::vector<double> ground;  ///< height of the ground there
    std::vector<double> gain;    ///< change of the vertex's height when that of the top changes by all of it
    std::vector<Vec3> base;
    double of_base = 0.0;  ///< volume over the base, up to the origin of volumes
};

Seating seatingOf(const Ground& ground, const Shape& shape, const Rim& rim)
{
    const std::size_t count = shape.rim.size();
    const Sheet sheet(rim, count);
    double top = 0.0;
    for (const Local& p : shape.flat) {
        top = std::max(top, p.height);
    }
    Seating made;
    for (std::size_t v = 0; v < shape.flat.size(); ++v) {
        const Local& flat = shape.flat[v];
        Local below = v < count ? rim.seated(v) : groundBelow(ground, rim, flat.level);
        double radius = 1.0;
        made.ground.push_back(below.height);
        if (v >= count) {
            const Rim::Place place = rim.towards(flat.level);
            radius = radiusInDisc(place, flat.height);
            below.height = sheet.at(below.level, place, radius);
        }
        made.below.push_back(below);
        made.gain.push_back(top * (1.0 - radius * radius));
    }
    for (std::size_t ring = 0; ring <= kBaseRings; ++ring) {
        const double share = 1.0 - static_cast<double>(ring) / (1 + kBaseRings);
        for (std::size_t k = 0; k < count; ++k) {
            made.base.push_back(
                ground.toSpace(ring == 0 ? rim.seated(k) : groundBelow(ground, rim, share * shape.rim[k])));
        }
    }
    made.base.push_back(ground.toSpace(groundBelow(ground, rim, {})));
    made.of_base = volumeUnder(made.base, baseTriangles(count), shape.origin);
    return made;
}

/// Vertices of a seated droplet.
/// @param factor  on the height of its top
std::vector<Vec3> placed(const Ground& ground, const Shape& shape, const Seating& seating, double factor)
{
    constexpr double kLeastDeep = 0.25;  // of liquid over ground that would come out of it, over its flat height
    std::vector<Vec3> vertices;
    for (std::size_t v = 0; v < shape.flat.size(); ++v) {
        const Local& below = seating.below[v];
        const double flat = shape.flat[v].height;
        const double top =
            std::max(below.height + flat + (factor - 1.0) * seating.gain[v], seating.ground[v] + kLeastDeep * flat);
        vertices.push_back(ground.toSpace({below.level, v < shape.rim.size() ? below.height : top}));
    }
    return vertices;
}

/// Factor on the height of a droplet's top with which it has its volume.
double factorOf(const Ground& ground, const Shape& shape, const Seating& seating)
{
    constexpr int kSecants = 6;
    constexpr double kExact = 1e-9;  // of the volume
    const auto excess = [&](double factor) {
        return volumeUnder(placed(ground, shape, seating, factor), shape.triangles, shape.origin) + seating.of_base -
               shape.volume;
    };
    std::array<double, 2> factors{0.5, 1.0};
    std::array<double, 2> over{excess(factors[0]), excess(factors[1])};
    for (int k = 0; k < kSecants && std::abs(over[1]) > kExact * shape.volume && over[0] != over[1]; ++k) {
        const double next = factors[1] - over[1] * (factors[1] - factors[0]) / (over[1] - over[0]);
        factors = {factors[1], std::clamp(next, 0.0, kMostTall)};
        over = {over[1], excess(factors[1])};
    }
    return factors[1];
}

double halfWidth(const DropletFrame& frame, const FlatDroplet& droplet, Vec3 across)
{
    double low = 0.0;
    double high = 0.0;
    for (const Vec3 p : droplet.vertices.first(droplet.rim)) {
        const double at = dot(p - frame.place, across);
        low = std::min(low, at);
        high = std::max(high, at);
    }
    return 0.5 * (high - low);
}

/// A long droplet over an edge, as one that runs off a plate, would stand off on both sides as a spindle. There surface
/// tension has made it round: the more, the more it leans.
void roundOverEdge(const FlowTerrain& terrain, const DropletFrame& frame, FlatDroplet droplet)
{
    // Edges of 30° between facets of a round object lean it by 15° at most; edges of 90°, by 45°.
    constexpr double kBend = 15.0 * kDegree;
    constexpr double kEdge = 40.0 * kDegree;
    const double length = halfWidth(frame, droplet, frame.ahead);
    const double width = halfWidth(frame, droplet, frame.left);
    if (!(length > width) || !(width > 0.0)) {
        return;
    }
    const Vec3 leant = leaning(terrain, frame, std::sqrt(length * width)).normal;
    const double lean = std::acos(std::clamp(dot(leant, frame.normal), -1.0, 1.0));
    const double share = std::clamp((lean - kBend) / (kEdge - kBend), 0.0, 1.0);
    if (share <= 0.0) {
        return;
    }
    const double across = std::pow(length / width, 0.5 * share);
    const auto scaled = [&](Vec3 v, double ahead, double left) {
        const double a = dot(v, frame.ahead);
        const double l = dot(v, frame.left);
        return v + (ahead - 1.0) * a * frame.ahead + (left - 1.0) * l * frame.left;
    };
    for (Vec3& p : droplet.vertices) {
        p = frame.place + scaled(p - frame.place, 1.0 / across, across);
    }
    for (Vec3& n : droplet.normals) {
        n = unit(scaled(n, across, 1.0 / across));
    }
}

}  // namespace

double volumeUnder(std::span<const Vec3> vertices, std::span<const Triangle> triangles, Vec3 origin)
{
    double volume = 0.0;
    for (const auto& [a, b, c] : triangles) {
        volume += dot(vertices[a] - origin, cross(vertices[b] - origin, vertices[c] - origin)) / 6.0;
    }
    return volume;
}

std::vector<Triangle> baseTriangles(std::size_t rim)
{
    std::vector<Triangle> triangles;
    const auto number = [&](std::size_t ring, std::size_t k) {
        return static_cast<std::uint32_t>(ring * rim + k % rim);
    };
    const auto middle = static_cast<std::uint32_t>((1 + kBaseRings) * rim);
    for (std::size_t k = 0; k < rim; ++k) {
        for (std::size_t ring = 0; ring < kBaseRings; ++ring) {
            triangles.push_back({number(ring, k), number(ring + 1, k + 1), number(ring, k + 1)});
            triangles.push_back({number(ring, k), number(ring + 1, k), number(ring + 1, k + 1)});
        }
        triangles.push_back({number(kBaseRings, k), middle, number(kBaseRings, k + 1)});
    }
    return triangles;
}

namespace {

/// Seats a droplet.
/// @param is_last  whether it is seated although it loses volume
/// @return         its base; or nothing, and the droplet as it was, if it would lose volume
std::optional<std::vector<Vec3>> seatAsItIs(const FlowTerrain& terrain, const DropletFrame& frame, FlatDroplet droplet,
                                            bool is_last)
{
    std::vector<Local> flat;
    for (const Vec3 p : droplet.vertices) {
        flat.push_back(toLocal(frame, p));
    }
    for (std::size_t k = 0; k < droplet.rim; ++k) {
        flat[k].height = 0.0;  // but for rounding
    }
    std::vector<Vec2> rim_points;
    double area = 0.0;
    for (std::size_t k = 0; k < droplet.rim; ++k) {
        rim_points.push_back(flat[k].level);
        area += 0.5 * cross(flat[k].level, flat[(k + 1) % droplet.rim].level);
    }
    const double size = std::sqrt(std::abs(area) / std::numbers::pi);
    const double volume = volumeUnder(droplet.vertices, droplet.triangles, frame.place);
    const Shape shape{flat, rim_points, droplet.triangles, frame.place, volume};
    const DropletFrame leant = inward(terrain, frame, rim_points, size);
    const auto turned = [&](Vec3 v) {
        return dot(v, frame.ahead) * leant.ahead + dot(v, frame.left) * leant.left +
               dot(v, frame.normal) * leant.normal;
    };
    const Ground ground(terrain, leant, size);
    Rim seated_rim(ground, rim_points);
    seated_rim.keepDistances(ground);
    const Seating seating = seatingOf(ground, shape, seated_rim);

    const double factor = factorOf(ground, shape, seating);
    if (factor >= kMostTall && !is_last) {
        return std::nullopt;
    }
    const std::vector<Vec3> before = facing(droplet.vertices, droplet.triangles);
    const std::vector<Vec3> seated = placed(ground, shape, seating, factor);
    std::copy(seated.begin(), seated.end(), droplet.vertices.begin());
    const std::vector<Vec3> after = facing(droplet.vertices, droplet.triangles);
    for (std::size_t v = 0; v < flat.size(); ++v) {
        droplet.normals[v] = unit(turned(droplet.normals[v] - unit(before[v])) + unit(after[v]));
    }
    return seating.base;
}

/// Makes a droplet wider, and flatter by as much.
void widen(const DropletFrame& frame, FlatDroplet droplet, double factor)
{
    const double height = 1.0 / (factor * factor);
    for (Vec3& p : droplet.vertices) {
        const Vec3 d = p - frame.place;
        const double up = dot(d, frame.normal);
        p = frame.place + factor * (d - up * frame.normal) + height * up * frame.normal;
    }
    for (Vec3& n : droplet.normals) {
        const double up = dot(n, frame.normal);
        n = unit((1.0 / factor) * (n - up * frame.normal) + (up / height) * frame.normal);
    }
}

}  // namespace

std::vector<Vec3> seat(const FlowTerrain& terrain, const DropletFrame& frame, FlatDroplet droplet)
{
    roundOverEdge(terrain, frame, droplet);
    if (auto base = seatAsItIs(terrain, frame, droplet, false)) {
        return *std::move(base);
    }
    // In a narrow place liquid goes on along it: a wider droplet finds more of a base there. It is no wider than it has
    // to be, so that one that runs changes steadily.
    constexpr double kStep = 0.15;
    constexpr int kSteps = 5;
    constexpr int kHalvings = 4;
    const std::vector<Vec3> vertices(droplet.vertices.begin(), droplet.vertices.end());
    const std::vector<Vec3> normals(droplet.normals.begin(), droplet.normals.end());
    const auto seat_wider = [&](double width, bool is_last) {
        std::copy(vertices.begin(), vertices.end(), droplet.vertices.begin());
        std::copy(normals.begin(), normals.end(), droplet.normals.begin());
        widen(frame, droplet, width);
        return seatAsItIs(terrain, frame, droplet, is_last);
    };
    for (int step = 1; step <= kSteps; ++step) {
        if (!seat_wider(1.0 + kStep * step, false)) {
            continue;
        }
        double low = 1.0 + kStep * (step - 1);
        double high = low + kStep;
        for (int k = 0; k < kHalvings; ++k) {
            const double middle = 0.5 * (low + high);
            (seat_wider(middle, false) ? high : low) = middle;
        }
        return *seat_wider(high, true);
    }
    return *seat_wider(1.0, true);
}

}  // namespace droplet
