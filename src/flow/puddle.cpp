// SPDX-License-Identifier: GPL-3.0-or-later
//
// On a floor a puddle is as thick as capillarity holds it, and a disc. Where walls are in the way of the disc, the
// same thickness covers the places with the shortest ways over the floor: in a trench the puddle becomes a strip, in
// the corner of a tray a sector. The way at its front follows from the volume. When it is longer than all ways, the
// floor is covered, and the level rises as in any hollow: volume, level and area go on without a jump.
//
// Ways are found from corner to corner, as by fast marching (R. Kimmel, J. Sethian, PNAS 95 (1998) 8431). In a triangle
// with two known ways, their circles meet in a virtual source, and the way to the third corner is the distance from it
// (M. Novotni, R. Klein, WSCG 2002): exact on a flat floor as far as the middle sees it.
#include "flow/puddle.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <numeric>
#include <queue>
#include <unordered_map>
#include <utility>
#include <vector>

#include "droplet/flow/flow_terrain.h"
#include "flow/flooded_part.h"
#include "wind/random.h"

namespace droplet {
namespace {

// Of a normal's parts.
constexpr double kRounding = 1e-9;
// Walls that take more than this share of the disc from a droplet are in its way. Chords of a circle with edges of a
// fifth of its radius take 1 %.
constexpr double kBlocked = 0.05;
// Edges of the triangles over which volumes are summed up, over the radius of the disc.
constexpr double kEdge = 0.2;
constexpr std::uint32_t kMostParts = 12;
// Puddles with more faces are not followed.
constexpr std::size_t kMostFaces = 200'000;

/// Height of a puddle.
/// @param level     of it
/// @param floor     height of the ground below it
/// @param bend      width along its front in which it falls to the floor: a parabola
/// @param to_front  way from a place to the front, negative beyond it
double heightAt(double level, double floor, double bend, double to_front)
{
    const double thick = level - floor;
    const double share = std::clamp(1.0 - to_front / bend, 0.0, 1.0);
    return to_front >= 0.0 ? level - thick * share * share : floor + 2.0 * thick / bend * to_front;
}

/// Width of the bend with which a disc has the volume of the liquid: of its parabola, 1 − 2x/3 + x²/6 is the mean
/// thickness over the largest, where x is the bend over the radius. A puddle's edge has at least the area of a quarter
/// of a circle.
double bendOf(const RestingLiquid& liquid, double thick)
{
    const double flat = flatArea(liquid);
    const double missing = std::clamp(1.0 - liquid.volume / (flat * thick), 0.0, 2.0 / 3.0);
    const double bend = (2.0 - std::sqrt(4.0 - 6.0 * missing)) * std::sqrt(flat / std::numbers::pi);
    return std::max(bend, 3.0 * (1.0 - std::numbers::pi / 4.0) * thick);
}

/// Length; without the care for the ends of the range that takes a fifth of the time.
double sizeOf(Vec2 v)
{
    return std::sqrt(dot(v, v));
}

struct HashOfPlace {
    std::size_t operator()(const std::array<double, 3>& place) const
    {
        std::uint64_t hash = 0;
        for (const double part : place) {
            hash = mix(hash + std::bit_cast<std::uint64_t>(part + 0.0));  // −0 is 0
        }
        return static_cast<std::size_t>(hash);
    }
};

/// Spreads over faces in the order of their ways.
class Spread {
public:
    Spread(const FlowSurface& surface, Vec3 up, const RestingLiquid& liquid)
        : faces_(surface.faces),
          up_(up),
          liquid_(liquid),
          flat_(flatArea(liquid)),
          radius_(std::sqrt(flat_ / std::numbers::pi)),
          floor_(dot(up, liquid.place)),
          thick_(thicknessOf(liquid)),
          level_(floor_ + thick_),
          bend_(bendOf(liquid, thick_))
    {
        const Vec3 across = cross(up, std::abs(up.x) < 0.9 ? Vec3{1.0, 0.0, 0.0} : Vec3{0.0, 1.0, 0.0});
        left_ = (1.0 / length(across)) * across;
        ahead_ = cross(left_, up_);
        middle_ = seen(liquid.place);
    }

    Puddle run()
    {
        Puddle made;
        begin();
        if (!march(radius_) || !isBlocked()) {
            return made;
        }
        made.is_blocked = true;
        double low = 0.0;
        double missing = liquid_.volume;
        double high = radius_;
        double beyond = 0.0;  // what the way `high` holds too much
        for (;;) {
            if (!march(high)) {
                return {};
            }
            beyond = spreadTo(high).volume - liquid_.volume;
            if (beyond >= 0.0) {
                break;
            }
            if (queue_.empty() && high > farthest() + bend_) {
                return made;  // it covers all of the floor
            }
            constexpr double kStep = 1.25;
            low = high;
            missing = -beyond;
            high *= kStep;
        }
        constexpr double kExact = 1e-9;
        constexpr int kMostSteps = 60;
        int kept = 0;  // side that has been kept: -1 low, 1 high (the Illinois rule of regula falsi)
        for (int k = 0; k < kMostSteps && high - low > kExact * radius_ && beyond > kExact * liquid_.volume; ++k) {
            const double middle = low + (high - low) * missing / (missing + beyond);
            const double more = spreadTo(middle).volume - liquid_.volume;
            if (more >= 0.0) {
                high = middle;
                beyond = more;
                missing *= kept == -1 ? 0.5 : 1.0;
                kept = -1;
            } else {
                low = middle;
                missing = -more;
                beyond *= kept == 1 ? 0.5 : 1.0;
                kept = 1;
            }
        }
        made.pond = pondTo(high);
        return made;
    }

private:
    /// Corner of faces.
    struct Node {
        Vec2 place;  ///< seen from above
        double height = 0.0;
        double way = std::numeric_limits<double>::infinity();
        bool is_known = false;             ///< no shorter way will be found
        std::vector<std::uint32_t> faces;  ///< numbers in reached_
    };
    /// Face that the puddle may wet.
    struct Reached {
        std::uint32_t face = 0;
        std::array<std::uint32_t, 3> nodes = {};
        double area = 0.0;  ///< seen from above
    };
    /// Number of a node, by its way.
    using Entry = std::pair<double, std::uint32_t>;
    /// Corners of the triangles that a face is divided into.
    struct Parts {
        std::uint32_t count = 0;  ///< of an edge
        double area = 0.0;        ///< of one, seen from above
        std::vector<double> ways;
        std::vector<double> heights;
    };

    [[nodiscard]] Vec2 seen(Vec3 p) const { return {dot(ahead_, p), dot(left_, p)}; }

    std::uint32_t nodeAt(Vec3 p)
    {
        const auto [at, is_new] =
            numbers_.try_emplace(std::array<double, 3>{p.x, p.y, p.z}, static_cast<std::uint32_t>(nodes_.size()));
        if (is_new) {
            nodes_.push_back({seen(p), dot(up_, p), std::numeric_limits<double>::infinity(), false, {}});
        }
        return at->second;
    }

    /// Adds a face, once.
    void reach(std::uint32_t face)
    {
        const auto number = static_cast<std::uint32_t>(reached_.size());
        if (!reached_at_.try_emplace(face, number).second) {
            return;
        }
        Reached reached{face, {}, dot(faces_[face].normal, up_) * areaOf(faces_[face])};
        for (std::size_t k = 0; k < 3; ++k) {
            reached.nodes[k] = nodeAt(faces_[face].corners[k]);
            nodes_[reached.nodes[k]].faces.push_back(number);
        }
        reached_.push_back(reached);
        parts_.emplace_back();
    }

    void begin()
    {
        reach(liquid_.face);
        for (const std::uint32_t node : reached_.front().nodes) {
            shorten(node, sizeOf(nodes_[node].place - middle_));
        }
    }

    void shorten(std::uint32_t node, double way)
    {
        if (!nodes_[node].is_known && way < nodes_[node].way) {
            nodes_[node].way = way;
            queue_.emplace(way, node);
        }
    }

    /// Whether ways go on from a corner: not from the top of a wall.
    [[nodiscard]] bool leadsOn(const Node& node) const { return node.is_known && node.height < level_; }

    /// Whether liquid may stand on a face. It does not flow down over an edge: that is a brim.
    [[nodiscard]] bool mayWet(std::uint32_t face) const
    {
        if (face == FlowSurface::kNone || dot(faces_[face].normal, up_) < -kRounding) {
            return false;
        }
        const auto& [a, b, c] = faces_[face].corners;
        return std::min({dot(up_, a), dot(up_, b), dot(up_, c)}) > floor_ - thick_;
    }

    /// Finds all ways up to a length, from short to long.
    /// @return  false if there are too many faces
    bool march(double limit)
    {
        while (!queue_.empty() && queue_.top().first <= limit) {
            const std::uint32_t node = queue_.top().second;
            queue_.pop();
            if (nodes_[node].is_known) {
                continue;
            }
            nodes_[node].is_known = true;
            is_divided_ = false;
            if (leadsOn(nodes_[node])) {
                leave(node);
            }
            if (reached_.size() > kMostFaces) {
                return false;
            }
        }
        return true;
    }

    /// Goes on from a node over all faces around it.
    void leave(std::uint32_t node)
    {
        for (std::size_t i = 0; i < nodes_[node].faces.size(); ++i) {  // there will be more
            const Reached face = reached_[nodes_[node].faces[i]];
            const auto at =
                static_cast<std::size_t>(std::find(face.nodes.begin(), face.nodes.end(), node) - face.nodes.begin());
            for (const std::size_t side : {at, (at + 2) % 3}) {
                if (const std::uint32_t next = faces_[face.face].neighbour[side]; mayWet(next)) {
                    reach(next);
                }
            }
            const std::uint32_t b = face.nodes[(at + 1) % 3];
            const std::uint32_t c = face.nodes[(at + 2) % 3];
            for (const auto& [to, other] : {std::pair{b, c}, {c, b}}) {
                const double way = nodes_[node].way;
                shorten(to, way + sizeOf(nodes_[to].place - nodes_[node].place));
                if (leadsOn(nodes_[other])) {
                    const double across = wayAcross(nodes_[node], nodes_[other], nodes_[to].place);
                    // Ways come from known corners to later ones.
                    shorten(to, across >= way ? across : std::numeric_limits<double>::infinity());
                }
            }
        }
    }

    /// Both places with the ways of two corners.
    [[nodiscard]] static std::array<Vec2, 2> sourcesOf(const Node& a, const Node& b)
    {
        const Vec2 edge = b.place - a.place;
        const double size = sizeOf(edge);
        const double along = (a.way * a.way - b.way * b.way + size * size) / (2.0 * size);
        const double off = std::sqrt(std::max(a.way * a.way - along * along, 0.0));
        const Vec2 foot = a.place + (along / size) * edge;
        const Vec2 aside = (off / size) * Vec2{-edge.y, edge.x};
        return {foot + aside, foot - aside};
    }

    /// Way to a place from the virtual source beyond an edge, if it sees it through the edge.
    [[nodiscard]] double wayAcross(const Node& a, const Node& b, Vec2 place) const
    {
        const Vec2 edge = b.place - a.place;
        const double size = sizeOf(edge);
        if (!(size > kRounding * radius_)) {
            return std::numeric_limits<double>::infinity();
        }
        const auto side = [&](Vec2 p) { return (edge.x * (p.y - a.place.y) - edge.y * (p.x - a.place.x)) / size; };
        const double here = side(place);
        const auto [one, other] = sourcesOf(a, b);
        const Vec2 source = side(one) * here <= 0.0 ? one : other;
        const double there = side(source);
        const double gap = std::abs(here) + std::abs(there);
        const double share = gap > 0.0 ? std::abs(there) / gap : 1.0;
        const Vec2 passed = source + share * (place - source);
        const double along = dot(passed - a.place, edge) / size;
        const bool sees = along >= -kRounding * radius_ && along <= size + kRounding * radius_;
        return sees ? sizeOf(place - source) : std::numeric_limits<double>::infinity();
    }

    /// From where ways to a face are straight lines: the source that fits its longest edge and the third corner.
    [[nodiscard]] Vec2 sourceOf(const Reached& face) const
    {
        if (face.face == liquid_.face) {
            return middle_;
        }
        std::size_t longest = 0;
        const auto size = [&](std::size_t k) {
            return sizeOf(nodes_[face.nodes[(k + 2) % 3]].place - nodes_[face.nodes[(k + 1) % 3]].place);
        };
        for (std::size_t k = 1; k < 3; ++k) {
            longest = size(k) > size(longest) ? k : longest;
        }
        const Node& c = nodes_[face.nodes[longest]];
        const auto [one, other] =
            sourcesOf(nodes_[face.nodes[(longest + 1) % 3]], nodes_[face.nodes[(longest + 2) % 3]]);
        const auto miss = [&](Vec2 source) { return std::abs(sizeOf(c.place - source) - c.way); };
        return miss(one) <= miss(other) ? one : other;
    }

    /// Whether all ways to a face are known.
    [[nodiscard]] bool isKnown(const Reached& face) const
    {
        return std::all_of(face.nodes.begin(), face.nodes.end(),
                           [&](std::uint32_t node) { return std::isfinite(nodes_[node].way); });
    }

    /// Divides the faces.
    void divide()
    {
        if (is_divided_) {
            return;
        }
        is_divided_ = true;
        for (std::size_t k = 0; k < reached_.size(); ++k) {
            const Reached& face = reached_[k];
            if (!isKnown(face)) {
                continue;
            }
            const Vec2 source = sourceOf(face);
            std::array<Vec2, 3> corners;
            std::array<double, 3> heights{};
            double longest = 0.0;
            for (std::size_t c = 0; c < 3; ++c) {
                corners[c] = nodes_[face.nodes[c]].place;
                heights[c] = nodes_[face.nodes[c]].height;
            }
            for (std::size_t c = 0; c < 3; ++c) {
                longest = std::max(longest, sizeOf(corners[(c + 1) % 3] - corners[c]));
            }
            const auto n = static_cast<std::uint32_t>(
                std::clamp(std::ceil(longest / (kEdge * radius_)), 1.0, static_cast<double>(kMostParts)));
            Parts& parts = parts_[k];
            parts = {n, face.area / (static_cast<double>(n) * n), {}, {}};
            for (std::uint32_t i = 0; i <= n; ++i) {
                for (std::uint32_t j = 0; i + j <= n; ++j) {
                    const double u = static_cast<double>(i) / n;
                    const double v = static_cast<double>(j) / n;
                    const Vec2 place = (1.0 - u - v) * corners[0] + u * corners[1] + v * corners[2];
                    parts.ways.push_back(sizeOf(place - source));
                    parts.heights.push_back((1.0 - u - v) * heights[0] + u * heights[1] + v * heights[2]);
                }
            }
        }
    }

    /// Sum over the parts of all faces of what is below 0.
    /// @param over  height of the ground over the liquid, by way and height
    template <typename Over>
    Flooded sumOf(const Over& over)
    {
        divide();
        Flooded sum;
        std::vector<double> heights;
        for (const Parts& parts : parts_) {
            if (parts.area <= 0.0) {
                continue;
            }
            heights.clear();
            for (std::size_t v = 0; v < parts.ways.size(); ++v) {
                heights.push_back(over(parts.ways[v], parts.heights[v]));
            }
            const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
                std::array<double, 3> h{heights[a], heights[b], heights[c]};
                std::sort(h.begin(), h.end());
                const Flooded part = floodedPart(h, parts.area, 0.0);
                sum.area += part.area;
                sum.volume += part.volume;
            };
            std::size_t row = 0;
            for (std::uint32_t i = 0; i < parts.count; ++i) {
                const std::size_t next = row + parts.count - i + 1;
                for (std::uint32_t j = 0; i + j < parts.count; ++j) {
                    add(row + j, next + j, row + j + 1);
                    if (i + j + 1 < parts.count) {
                        add(row + j + 1, next + j, next + j + 1);
                    }
                }
                row = next;
            }
        }
        return sum;
    }

    [[nodiscard]] bool isBlocked()
    {
        const bool has_wall = std::any_of(nodes_.begin(), nodes_.end(), [&](const Node& node) {
            return node.height >= level_ && node.way < radius_;
        });
        if (!has_wall) {
            return false;
        }
        const Flooded disc = sumOf([&](double way, double height) { return std::max(way - radius_, height - level_); });
        return disc.area < (1.0 - kBlocked) * flat_;
    }

    Flooded spreadTo(double way)
    {
        return sumOf([&](double there, double height) {
            return std::max(height, floor_) - heightAt(level_, floor_, bend_, way - there);
        });
    }

    /// Longest way.
    [[nodiscard]] double farthest() const
    {
        double way = 0.0;
        for (const Node& node : nodes_) {
            way = std::isfinite(node.way) ? std::max(way, node.way) : way;
        }
        return way;
    }

    [[nodiscard]] std::optional<Pond> pondTo(double way)
    {
        Pond pond;
        pond.up = up_;
        pond.level = level_;
        pond.area = spreadTo(way).area;
        pond.bending = liquid_.puddle / (2.0 * std::sin(0.5 * liquid_.contact_angle));
        // The faces of a corner may differ a little about its way; all of them are needed to end at the front.
        constexpr double kDiffer = 0.02;
        const double beyond = way + kDiffer * radius_;
        PondFront front{way, bend_, floor_, liquid_.volume, {}};
        std::vector<std::uint32_t> order(reached_.size());
        std::iota(order.begin(), order.end(), std::uint32_t{0});
        std::sort(order.begin(), order.end(),
                  [&](std::uint32_t a, std::uint32_t b) { return reached_[a].face < reached_[b].face; });
        for (const std::uint32_t number : order) {
            const Reached& reached = reached_[number];
            const Parts& parts = parts_[number];
            bool is_wet = false;
            for (std::size_t v = 0; v < parts.ways.size(); ++v) {
                is_wet = is_wet ||
                         std::max(parts.heights[v], floor_) < heightAt(level_, floor_, bend_, beyond - parts.ways[v]);
            }
            if (is_wet) {
                const Vec2 source = sourceOf(reached);
                pond.faces.push_back(reached.face);
                front.sources.push_back(source.x * ahead_ + source.y * left_);
            }
        }
        pond.front = std::move(front);
        return pond.area > 0.0 ? std::optional(std::move(pond)) : std::nullopt;
    }

    const std::vector<FlowSurface::Face>& faces_;
    Vec3 up_;
    const RestingLiquid& liquid_;
    double flat_;    ///< area on flat ground [m²]
    double radius_;  ///< of a disc of this area [m]
    double floor_;
    double thick_;  ///< on flat ground [m]
    double level_;
    double bend_;
    Vec3 ahead_;
    Vec3 left_;
    Vec2 middle_;
    std::unordered_map<std::array<double, 3>, std::uint32_t, HashOfPlace> numbers_;  ///< of nodes, by place
    std::vector<Node> nodes_;
    std::unordered_map<std::uint32_t, std::uint32_t> reached_at_;  ///< numbers in reached_, by face
    std::vector<Reached> reached_;
    std::vector<Parts> parts_;  ///< of reached_
    bool is_divided_ = false;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
};

}  // namespace

double thicknessOf(const RestingLiquid& liquid)
{
    return std::min(liquid.radius * std::tan(0.5 * liquid.contact_angle), liquid.puddle);
}

double flatArea(const RestingLiquid& liquid)
{
    return std::max(liquid.volume / liquid.puddle, std::numbers::pi * liquid.radius * liquid.radius);
}

Puddle puddleAround(const FlowSurface& surface, Vec3 up, const RestingLiquid& liquid)
{
    return Spread(surface, up, liquid).run();
}

double Pond::heightOver(std::size_t k, Vec3 place) const
{
    if (!front) {
        return level;
    }
    const Vec3 from = place - front->sources[k];
    return heightAt(level, front->floor, front->bend, front->way - length(from - dot(from, up) * up));
}

}  // namespace droplet
