// SPDX-License-Identifier: GPL-3.0-or-later
// H. Edelsbrunner, J. Harer, "Computational Topology" (2010), section II: a complex of triangles is a 2-manifold if the
// triangles around every vertex form a ring or, on the boundary, a chain.
//
// OpenMesh's half-edges, which are used for triangles from outside, give the same result. For a million triangles they
// would take 250 ms and 65 MB; the fans of vertices take 11 ms and 14 MB on two cores.
#include "droplet/surface/surface.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>

#include "droplet/error.h"
#include "number_text.h"
#include "union_find.h"

namespace droplet {
namespace {

constexpr double kUnitTolerance = 1e-6;  // far above double round-off, far below float32 and visible shading

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t kGrain = 4096;  // vertices or triangles per task: 50 µs of work, far above its overhead

[[noreturn]] void refuse(const std::string& field, std::size_t index, const std::string& constraint)
{
    throw Error(ErrorCode::InvalidArgument, "surface." + field + "[" + std::to_string(index) + "] " + constraint);
}

bool finite(Vec2 a)
{
    return std::isfinite(a.x) && std::isfinite(a.y);
}
bool finite(Vec3 a)
{
    return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

// First index below `count` for which the predicate holds, or `count`.
template <class Predicate>
std::size_t firstOf(std::size_t count, const Predicate& holds)
{
    using Range = tbb::blocked_range<std::size_t>;
    return tbb::parallel_deterministic_reduce(
        Range(0, count, kGrain), count,
        [&](const Range& range, std::size_t found) {
            for (std::size_t i = range.begin(); i < std::min(range.end(), found); ++i) {
                if (holds(i)) {
                    return i;
                }
            }
            return found;
        },
        [](std::size_t a, std::size_t b) { return std::min(a, b); });
}

// Triangle at one of its vertices v: it winds (v, from, to).
struct Wedge {
    std::uint32_t from;
    std::uint32_t to;
};

// Triangles around every vertex, with copies welded: a list of corners per vertex. Corner 3t + k is vertex k of
// triangle t.
class Corners {
public:
    explicit Corners(const Surface& surface)
        : surface_(surface), first_(surface.vertices.size(), kNone), next_(3 * surface.triangles.size())
    {
        if (surface.triangles.size() > kNone / 3) {
            throw Error(ErrorCode::InvalidArgument, "surface has " + std::to_string(surface.triangles.size()) +
                                                        " triangles; up to " + std::to_string(kNone / 3) +
                                                        " can be examined");
        }
        std::uint32_t corner = 0;
        for (const Triangle& triangle : surface.triangles) {
            for (const std::uint32_t vertex : triangle) {
                next_[corner] = std::exchange(first_[surface.weld[vertex]], corner);
                ++corner;
            }
        }
    }

    [[nodiscard]] std::uint32_t vertexCount() const { return static_cast<std::uint32_t>(first_.size()); }

    void wedgesAt(std::uint32_t vertex, std::vector<Wedge>& wedges) const
    {
        wedges.clear();
        for (std::uint32_t corner = first_[vertex]; corner != kNone; corner = next_[corner]) {
            const Triangle& triangle = surface_.triangles[corner / 3];
            const std::uint32_t k = corner % 3;
            wedges.push_back({surface_.weld[triangle[(k + 1) % 3]], surface_.weld[triangle[(k + 2) % 3]]});
        }
    }

private:
    const Surface& surface_;
    std::vector<std::uint32_t> first_;
    std::vector<std::uint32_t> next_;
};

// Wedges around a vertex: in a manifold one ring or, on the boundary, one chain.
enum class Kind { Unused, Ring, Chain, NotManifold };

// Wedges around a vertex in their order: `to` of one is `from` of the next.
class Fan {
public:
    Kind read(const Corners& corners, std::uint32_t vertex)
    {
        corners.wedgesAt(vertex, wedges_);
        if (wedges_.empty()) {
            return Kind::Unused;
        }
        const bool degenerate = std::any_of(wedges_.begin(), wedges_.end(), [vertex](const Wedge& wedge) {
            return wedge.from == vertex || wedge.to == vertex || wedge.from == wedge.to;
        });
        if (degenerate) {
            return Kind::NotManifold;
        }
        return isSmallRing() ? Kind::Ring : readSorted();
    }

    /// Next vertex on the boundary after that of a chain.
    [[nodiscard]] std::uint32_t boundaryNext() const { return wedges_[first_].from; }

private:
    // Almost every vertex has a ring of about six wedges, and a linear search is faster than sorting. Each step goes to
    // the first wedge that fits. A walk that returns after as many steps as there are wedges has visited each once; so
    // no two have the same `from`, because only the first of these would be visited.
    [[nodiscard]] bool isSmallRing() const
    {
        constexpr std::size_t kSmall = 12;
        const std::size_t count = wedges_.size();
        std::size_t at = 0;
        for (std::size_t steps = 1; count <= kSmall && steps <= count; ++steps) {
            const std::uint32_t to = wedges_[at].to;
            for (at = 0; at < count && wedges_[at].from != to;) {
                ++at;
            }
            if (at == 0 || at == count) {
                return at == 0 && steps == count;
            }
        }
        return false;
    }

    // Every `from` and every `to` must occur once, and all wedges must form one ring or chain.
    Kind readSorted()
    {
        const auto by_from = [](const Wedge& a, const Wedge& b) { return a.from < b.from; };
        std::sort(wedges_.begin(), wedges_.end(), by_from);
        const std::size_t count = wedges_.size();
        follower_.assign(count, count);
        followed_.assign(count, false);
        std::size_t links = 0;
        for (std::size_t i = 0; i < count; ++i) {
            if (i > 0 && wedges_[i].from == wedges_[i - 1].from) {
                return Kind::NotManifold;  // two triangles have the edge in the same direction
            }
            const auto next = std::lower_bound(wedges_.begin(), wedges_.end(), Wedge{wedges_[i].to, 0}, by_from);
            if (next == wedges_.end() || next->from != wedges_[i].to) {
                continue;
            }
            follower_[i] = static_cast<std::size_t>(next - wedges_.begin());
            if (followed_[follower_[i]]) {
                return Kind::NotManifold;
            }
            followed_[follower_[i]] = true;
            ++links;
        }
        const bool ring = links == count;
        first_ =
            ring ? 0
                 : static_cast<std::size_t>(std::find(followed_.begin(), followed_.end(), false) - followed_.begin());
        std::size_t walked = 1;
        for (std::size_t i = follower_[first_]; i != count && i != first_; i = follower_[i]) {
            ++walked;
        }
        if (walked < count) {
            return Kind::NotManifold;
        }
        return ring ? Kind::Ring : Kind::Chain;
    }

    std::vector<Wedge> wedges_;
    std::vector<std::size_t> follower_;  // next wedge of each, or the number of wedges
    std::vector<bool> followed_;
    std::size_t first_ = 0;  // first wedge of a chain
};

// Totals over all fans.
struct Census {
    bool manifold = true;
    std::size_t vertices = 0;           // vertices of triangles
    std::size_t boundary_vertices = 0;  // equal to the number of boundary edges

    friend Census operator+(const Census& a, const Census& b)
    {
        return {a.manifold && b.manifold, a.vertices + b.vertices, a.boundary_vertices + b.boundary_vertices};
    }
};

Census countFans(const Corners& corners, std::vector<std::uint32_t>& boundary_next)
{
    using Range = tbb::blocked_range<std::uint32_t>;
    boundary_next.assign(corners.vertexCount(), kNone);
    return tbb::parallel_deterministic_reduce(
        Range(0, corners.vertexCount(), kGrain), Census{},
        [&](const Range& range, Census census) {
            Fan fan;
            for (std::uint32_t v = range.begin(); v < range.end() && census.manifold; ++v) {
                const Kind kind = fan.read(corners, v);
                census.manifold = kind != Kind::NotManifold;
                census.vertices += kind == Kind::Unused ? 0 : 1;
                if (kind == Kind::Chain) {
                    ++census.boundary_vertices;
                    boundary_next[v] = fan.boundaryNext();
                }
            }
            return census;
        },
        std::plus<>());
}

// Each boundary vertex has one predecessor and one successor, so a walk ends where it began.
std::size_t countLoops(std::vector<std::uint32_t> next)
{
    std::size_t count = 0;
    for (std::uint32_t start : next) {
        count += start == kNone ? 0 : 1;
        for (std::uint32_t v = start; v != kNone;) {
            v = std::exchange(next[v], kNone);
        }
    }
    return count;
}

// Number of times a triangle joins two separate sets of vertices.
std::size_t countJoins(const Surface& surface)
{
    UnionFind sets(surface.weld);
    std::size_t joins = 0;
    for (const auto& [a, b, c] : surface.triangles) {
        joins += sets.join(a, b) ? 1 : 0;
        joins += sets.join(b, c) ? 1 : 0;
    }
    return joins;
}

void checkRefill(const Surface& surface)
{
    const Refill& refill = *surface.refill;
    const std::size_t count = surface.vertices.size();
    if (!(refill.min >= 0.0 && refill.min <= 1.0 && refill.max >= 1.0 && refill.min < refill.max &&
          std::isfinite(refill.max))) {
        throw Error(ErrorCode::InvalidArgument, "surface.refill from " + numberText(refill.min) + " to " +
                                                    numberText(refill.max) +
                                                    " must be a range that contains 1, from 0 or more");
    }
    if (refill.states.empty()) {
        throw Error(ErrorCode::InvalidArgument, "surface.refill has no states; there must be one at least");
    }
    double before = -1.0;
    for (const RefillState& state : refill.states) {
        if (!(state.fill > before && state.fill != 1.0 && std::isfinite(state.fill))) {
            throw Error(ErrorCode::InvalidArgument, "surface.refill has a state of fill " + numberText(state.fill) +
                                                        "; fills must ascend from 0 or more, without 1, and be finite");
        }
        before = state.fill;
        if (state.vertices.size() != count || state.normals.size() != count) {
            throw Error(ErrorCode::InvalidArgument,
                        "surface has " + std::to_string(count) + " vertices, and a refill of " +
                            std::to_string(state.vertices.size()) + " vertices and " +
                            std::to_string(state.normals.size()) + " normals; there must be equally many");
        }
        const std::size_t i = firstOf(count, [&](std::size_t v) {
            return !finite(state.vertices[v]) || !finite(state.normals[v]) ||
                   state.vertices[surface.weld[v]] != state.vertices[v];
        });
        if (i < count) {
            refuse("refill.vertices", i, "must be finite, as its normal, and equal for all copies of a vertex");
        }
    }
}

void checkParts(const Surface& surface)
{
    std::size_t vertex = 0;
    std::size_t triangle = 0;
    for (std::size_t k = 0; k < surface.parts.size(); ++k) {
        const SurfacePart& part = surface.parts[k];
        if (part.first_vertex != vertex || part.first_triangle != triangle || part.triangles == 0 ||
            part.vertices > surface.vertices.size() - vertex || part.triangles > surface.triangles.size() - triangle) {
            refuse("parts", k, "must follow the part before it, with at least one triangle, within the surface");
        }
        if (!(part.volume >= 0.0 && part.area > 0.0 && std::isfinite(part.volume) && std::isfinite(part.area))) {
            refuse("parts", k, "must have a finite volume that is not negative, and a positive area");
        }
        vertex += part.vertices;
        triangle += part.triangles;
        const auto outside = [&](std::uint32_t v) { return v < part.first_vertex || v >= vertex; };
        const std::size_t t = firstOf(part.triangles, [&](std::size_t i) {
            const auto& [a, b, c] = surface.triangles[part.first_triangle + i];
            return outside(a) || outside(b) || outside(c);
        });
        const std::size_t v =
            firstOf(part.vertices, [&](std::size_t i) { return outside(surface.weld[part.first_vertex + i]); });
        if (t < part.triangles || v < part.vertices) {
            refuse("parts", k, "must not share vertices with another part");
        }
        const std::size_t q = part.quads > part.triangles / 2 ? 0 : firstOf(part.quads, [&](std::size_t i) {
            const Triangle& one = surface.triangles[part.first_triangle + 2 * i];
            const Triangle& other = surface.triangles[part.first_triangle + 2 * i + 1];
            return one[0] != other[0] || one[2] != other[1];
        });
        if (q < part.quads) {
            refuse("parts", k, "must begin with the halves (a, b, c) and (a, c, d) of its quadrilaterals");
        }
    }
    if (!surface.parts.empty() && (vertex != surface.vertices.size() || triangle != surface.triangles.size())) {
        refuse("parts", surface.parts.size() - 1, "must end at the last vertex and triangle");
    }
}

}  // namespace

void Surface::validate() const
{
    const std::size_t count = vertices.size();
    if (triangles.empty()) {
        throw Error(ErrorCode::InvalidArgument, "surface.triangles is empty; there must be at least one");
    }
    if (normals.size() != count || uvs.size() != count || weld.size() != count) {
        throw Error(ErrorCode::InvalidArgument,
                    "surface has " + std::to_string(count) + " vertices, " + std::to_string(normals.size()) +
                        " normals, " + std::to_string(uvs.size()) + " uvs, " + std::to_string(weld.size()) +
                        " weld entries; there must be equally many");
    }
    if (!contact_angle.empty() && contact_angle.size() != count) {
        throw Error(ErrorCode::InvalidArgument, "surface has " + std::to_string(count) + " vertices, " +
                                                    std::to_string(contact_angle.size()) +
                                                    " contact angles; there must be none or equally many");
    }
    if (!std::isfinite(mean_height) || mean_height < 0.0) {
        throw Error(ErrorCode::InvalidArgument,
                    "surface.mean_height = " + numberText(mean_height) + " must be finite and not negative");
    }
    const auto unit = [](Vec3 normal) { return std::abs(length(normal) - 1.0) <= kUnitTolerance; };
    const auto first_place = [&](std::size_t i) {
        return weld[i] <= i && weld[weld[i]] == weld[i] && vertices[weld[i]] == vertices[i];
    };
    const std::size_t angle =
        firstOf(contact_angle.size(), [&](std::size_t v) { return !std::isfinite(contact_angle[v]); });
    if (angle < contact_angle.size()) {
        refuse("contact_angle", angle, "must be finite");
    }
    const std::size_t i = firstOf(count, [&](std::size_t v) {
        return !finite(vertices[v]) || !unit(normals[v]) || !finite(uvs[v]) || !first_place(v);
    });
    if (i < count) {
        if (!finite(vertices[i])) {
            refuse("vertices", i, "must be finite");
        }
        if (!unit(normals[i])) {
            refuse("normals", i, "must have length 1");
        }
        if (!finite(uvs[i])) {
            refuse("uvs", i, "must be finite");
        }
        refuse("weld", i, "= " + std::to_string(weld[i]) + " must be the first vertex at the same place");
    }
    if (refill) {
        checkRefill(*this);
    }
    const auto last = [&](std::size_t t) { return std::max({triangles[t][0], triangles[t][1], triangles[t][2]}); };
    const std::size_t t = firstOf(triangles.size(), [&](std::size_t triangle) { return last(triangle) >= count; });
    if (t < triangles.size()) {
        refuse("triangles", t, "names vertex " + std::to_string(last(t)) + " of " + std::to_string(count));
    }
    checkParts(*this);
}

Surface extract(const Surface& surface, const std::vector<std::size_t>& which)
{
    if (which.empty()) {
        throw Error(ErrorCode::InvalidArgument, "which is empty; there must be at least one part");
    }
    Surface result;
    result.texture_map = surface.texture_map;
    if (surface.refill) {
        result.refill = Refill{surface.refill->min, surface.refill->max, {}};
        for (const RefillState& state : surface.refill->states) {
            result.refill->states.push_back({state.fill, {}, {}});
        }
    }
    double volume = 0.0;
    double area = 0.0;
    for (const std::size_t k : which) {
        if (k >= surface.parts.size()) {
            throw Error(ErrorCode::InvalidArgument,
                        "which names part " + std::to_string(k) + " of " + std::to_string(surface.parts.size()));
        }
        SurfacePart part = surface.parts[k];
        const auto copy = [&part](auto& to, const auto& from) {
            const auto begin = from.begin() + static_cast<std::ptrdiff_t>(part.first_vertex);
            to.insert(to.end(), begin, begin + static_cast<std::ptrdiff_t>(part.vertices));
        };
        const std::size_t first = result.vertices.size();
        const auto renamed = [&](std::uint32_t v) { return static_cast<std::uint32_t>(v - part.first_vertex + first); };
        copy(result.vertices, surface.vertices);
        copy(result.normals, surface.normals);
        copy(result.uvs, surface.uvs);
        if (!surface.contact_angle.empty()) {
            copy(result.contact_angle, surface.contact_angle);
        }
        for (std::size_t i = 0; surface.refill && i < surface.refill->states.size(); ++i) {
            copy(result.refill->states[i].vertices, surface.refill->states[i].vertices);
            copy(result.refill->states[i].normals, surface.refill->states[i].normals);
        }
        for (std::size_t v = 0; v < part.vertices; ++v) {
            result.weld.push_back(renamed(surface.weld[part.first_vertex + v]));
        }
        const std::size_t first_triangle = result.triangles.size();
        for (std::size_t t = 0; t < part.triangles; ++t) {
            const auto& [a, b, c] = surface.triangles[part.first_triangle + t];
            result.triangles.push_back({renamed(a), renamed(b), renamed(c)});
        }
        part.first_vertex = first;
        part.first_triangle = first_triangle;
        result.parts.push_back(part);
        volume += part.volume;
        area += part.area;
    }
    result.mean_height = volume / area;
    return result;
}

std::vector<std::uint32_t> quadrilaterals(const Surface& surface)
{
    std::vector<std::uint32_t> first;
    for (const SurfacePart& part : surface.parts) {
        for (std::size_t q = 0; q < part.quads; ++q) {
            first.push_back(static_cast<std::uint32_t>(part.first_triangle + 2 * q));
        }
    }
    return first;
}

std::vector<double> stateWeights(const Refill& refill, double fill)
{
    // Fill 1 is a state without a change, and without a weight.
    std::vector<double> fills;
    for (const RefillState& state : refill.states) {
        fills.push_back(state.fill);
    }
    const auto full = std::lower_bound(fills.begin(), fills.end(), 1.0) - fills.begin();
    fills.insert(fills.begin() + full, 1.0);
    const auto above =
        static_cast<std::size_t>(std::upper_bound(fills.begin() + 1, fills.end() - 1, fill) - fills.begin());
    const double part = (fill - fills[above - 1]) / (fills[above] - fills[above - 1]);
    std::vector<double> weights(fills.size(), 0.0);
    weights[above - 1] = 1.0 - part;
    weights[above] = part;
    weights.erase(weights.begin() + full);
    return weights;
}

Surface refilled(const Surface& surface, double fill)
{
    surface.validate();
    if (!surface.refill) {
        throw Error(ErrorCode::InvalidArgument, "surface.refill is empty; there must be one");
    }
    if (!(fill >= surface.refill->min && fill <= surface.refill->max)) {
        throw Error(ErrorCode::InvalidArgument, "fill " + numberText(fill) + " must be from " +
                                                    numberText(surface.refill->min) + " to " +
                                                    numberText(surface.refill->max));
    }
    const std::vector<double> weights = stateWeights(*surface.refill, fill);
    Surface result = surface;
    result.refill.reset();
    result.contact_angle.clear();
    result.mean_height *= fill;
    for (SurfacePart& part : result.parts) {
        part.volume *= fill;
    }
    for (std::size_t v = 0; v < result.vertices.size(); ++v) {
        Vec3 normal = result.normals[v];
        for (std::size_t k = 0; k < weights.size(); ++k) {
            result.vertices[v] = result.vertices[v] + weights[k] * surface.refill->states[k].vertices[v];
            normal = normal + weights[k] * surface.refill->states[k].normals[v];
        }
        result.normals[v] = (1.0 / length(normal)) * normal;
    }
    return result;
}

bool isClosed(const Surface& surface)
{
    surface.validate();
    std::vector<std::uint32_t> boundary_next;
    const Census census = countFans(Corners(surface), boundary_next);
    return census.manifold && census.boundary_vertices == 0;
}

Topology topology(const Surface& surface)
{
    surface.validate();
    std::vector<std::uint32_t> boundary_next;
    const Census census = countFans(Corners(surface), boundary_next);
    Topology result;
    result.manifold = census.manifold;
    if (!result.manifold) {
        return result;
    }
    const std::size_t edges = (3 * surface.triangles.size() + census.boundary_vertices) / 2;
    result.closed = census.boundary_vertices == 0;
    result.euler = static_cast<long>(census.vertices + surface.triangles.size()) - static_cast<long>(edges);
    result.components = census.vertices - countJoins(surface);
    result.boundary_loops = countLoops(std::move(boundary_next));
    return result;
}

double enclosedVolume(const Surface& surface)
{
    // ∫ div(0, 0, z) dV: sum of signed areas in the plane times mean heights.
    double volume = 0.0;
    for (const auto& [ia, ib, ic] : surface.triangles) {
        const Vec3 a = surface.vertices[ia];
        const Vec3 b = surface.vertices[ib];
        const Vec3 c = surface.vertices[ic];
        const double double_area = cross(Vec2{b.x - a.x, b.y - a.y}, Vec2{c.x - a.x, c.y - a.y});
        volume += double_area * (a.z + b.z + c.z) / 6.0;
    }
    return volume;
}

}  // namespace droplet
