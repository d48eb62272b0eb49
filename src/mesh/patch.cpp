// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/mesh/patch.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "droplet/error.h"
#include "mesh/band.h"
#include "mesh/curve.h"
#include "mesh/lattice_core.h"
#include "mesh/rim_sampling.h"
#include "mesh/smoothing.h"
#include "union_find.h"

namespace droplet {
namespace {

constexpr double kMaxGap = 0.05;      // distance of an old rim vertex from the new rim, relative to an edge
constexpr double kMaxSagitta = 0.06;  // distance of an old edge from the new rim, relative to it; new edges: 0.044
constexpr double kMaxDetour = 1.3;    // length of the rim between two vertices, relative to their distance
constexpr double kFar = 2.5;          // distance from changes of the rim, in edges
constexpr double kMaxOffset = 0.02;   // mean distance of the whole rim from the new one, relative to an edge
constexpr double kFinest = 0.07;      // relative to the loops' own detail, as in triangulate.cpp
constexpr std::size_t kMinPiece = 8;  // smaller connected pieces of triangles are not kept
constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

std::uint64_t keyOf(std::uint32_t a, std::uint32_t b)
{
    return std::uint64_t{a} << 32U | b;
}

/// Things in square cells, found by points near them.
template <typename Thing>
class Cells {
public:
    explicit Cells(double size) : size_(size) {}

    void add(Vec2 p, const Thing& thing)
    {
        std::vector<Thing>& there = cells_[key(column(p.x), column(p.y))];
        if (there.empty() || !(there.back() == thing)) {
            there.push_back(thing);
        }
    }

    /// Calls visit(thing) for all things in the cell of a point and the cells around it, until it returns true.
    template <typename Visit>
    bool around(Vec2 p, const Visit& visit) const
    {
        for (std::int64_t y = column(p.y) - 1; y <= column(p.y) + 1; ++y) {
            for (std::int64_t x = column(p.x) - 1; x <= column(p.x) + 1; ++x) {
                const auto cell = cells_.find(key(x, y));
                if (cell != cells_.end() && std::any_of(cell->second.begin(), cell->second.end(), visit)) {
                    return true;
                }
            }
        }
        return false;
    }

private:
    [[nodiscard]] std::int64_t column(double x) const { return std::llround(std::floor(x / size_)); }
    static std::uint64_t key(std::int64_t x, std::int64_t y)
    {
        return (static_cast<std::uint64_t>(y) << 32U) ^ (static_cast<std::uint64_t>(x) & 0xffffffffU);
    }

    double size_;
    std::unordered_map<std::uint64_t, std::vector<Thing>> cells_;
};

/// Place on one of a footprint's loops, by the length along it.
struct Place {
    std::size_t loop = 0;
    double arc = 0.0;
};

/// Loops of a footprint, found by points near them.
class NewRim {
public:
    NewRim(const Footprint& footprint, double edge) : cells_(edge)
    {
        loops_.push_back(&footprint.rim);
        for (const Loop& hole : footprint.holes) {
            loops_.push_back(&hole);
        }
        for (std::size_t k = 0; k < loops_.size(); ++k) {
            curves_.emplace_back(loops_[k]->points);
            for (std::size_t i = 0; i < loops_[k]->points.size(); ++i) {
                const Vec2 from = loops_[k]->points[i];
                const Vec2 along = end(k, i) - from;
                const auto steps = static_cast<std::size_t>(std::ceil(2.0 * length(along) / edge)) + 1;
                for (std::size_t s = 0; s <= steps; ++s) {
                    cells_.add(from + (static_cast<double>(s) / static_cast<double>(steps)) * along, {k, i});
                }
            }
        }
    }

    [[nodiscard]] std::size_t size() const { return loops_.size(); }
    [[nodiscard]] const Curve& curve(std::size_t k) const { return curves_[k]; }

    /// Nearest place within a distance, which is at most half an edge.
    [[nodiscard]] std::optional<Place> nearest(Vec2 p, double max) const
    {
        std::optional<Place> found;
        cells_.around(p, [&](const std::pair<std::size_t, std::size_t>& piece) {
            const auto [k, i] = piece;
            const Vec2 from = loops_[k]->points[i];
            const Vec2 along = end(k, i) - from;
            const double t = std::clamp(dot(p - from, along) / dot(along, along), 0.0, 1.0);
            const double away = length(p - (from + t * along));
            if (away <= max) {
                max = away;
                found = Place{k, curves_[k].arc(i) + t * length(along)};
            }
            return false;
        });
        return found;
    }

    /// Whether a chord may replace the rim between two places.
    [[nodiscard]] bool fits(Vec2 a, Vec2 b, const Place& from, const Place& to) const
    {
        const Vec2 chord = b - a;
        const double size = length(chord);
        const Curve& along = curves_[from.loop];
        const double way = along.wrapped(to.arc - from.arc);
        if (from.loop != to.loop || way > kMaxDetour * size || way * kMaxDetour < size) {
            return false;
        }
        for (std::size_t i = along.pieceAt(from.arc), n = 0; n < along.size(); ++n) {
            i = (i + 1) % along.size();
            if (along.wrapped(along.arc(i) - from.arc) >= way) {
                break;
            }
            const Vec2 p = loops_[from.loop]->points[i];
            const bool at_end = std::min(length(p - a), length(p - b)) < kMaxGap * size;
            if (std::abs(cross(chord, p - a)) > kMaxSagitta * size * size ||
                (loops_[from.loop]->corner[i] != 0 && !at_end)) {
                return false;
            }
        }
        return true;
    }

    /// Whether a place is a corner.
    [[nodiscard]] bool isCorner(const Place& place) const
    {
        const Curve& along = curves_[place.loop];
        const std::size_t i = along.pieceAt(place.arc);
        const double near = 1e-9 * along.length();
        const std::size_t next = (i + 1) % along.size();
        return (loops_[place.loop]->corner[i] != 0 && along.wrapped(place.arc) - along.arc(i) < near) ||
               (loops_[place.loop]->corner[next] != 0 && along.arc(i + 1) - along.wrapped(place.arc) < near);
    }

    /// Whether the loops enclose a point, by the even-odd rule.
    [[nodiscard]] bool encloses(Vec2 p) const
    {
        bool inside = false;
        for (std::size_t k = 0; k < loops_.size(); ++k) {
            for (std::size_t i = 0; i < loops_[k]->points.size(); ++i) {
                const Vec2 a = loops_[k]->points[i];
                const Vec2 b = end(k, i);
                if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) {
                    inside = !inside;
                }
            }
        }
        return inside;
    }

private:
    [[nodiscard]] Vec2 end(std::size_t k, std::size_t i) const
    {
        const std::vector<Vec2>& points = loops_[k]->points;
        return points[i + 1 < points.size() ? i + 1 : 0];
    }

    std::vector<const Loop*> loops_;
    std::vector<Curve> curves_;
    Cells<std::pair<std::size_t, std::size_t>> cells_;
};

/// Old rim edge along which the new rim runs.
struct FittingEdge {
    std::uint32_t from = 0;
    std::uint32_t to = 0;
    double begin = 0.0;  ///< place of `from`, as a length along the loop
    double way = 0.0;
};

class Patching {
public:
    Patching(const std::vector<const PlanarMesh*>& before, const Footprint& footprint, double edge)
        : rim_(footprint, edge), edge_(edge), sampler_(footprint, 1.5 * edge), footprint_area_(area(footprint))
    {
        for (const PlanarMesh* mesh : before) {
            const auto first = static_cast<std::uint32_t>(points_.size());
            points_.insert(points_.end(), mesh->vertices.begin(), mesh->vertices.end());
            next_.resize(points_.size(), kNone);
            for (std::size_t k = 0; k < mesh->loopCount(); ++k) {
                for (std::uint32_t v = mesh->loop_starts[k]; v < mesh->loop_starts[k + 1]; ++v) {
                    next_[first + v] = first + nextOnRim(*mesh, k, v);
                }
            }
            for (const Triangle& t : mesh->triangles) {
                triangles_.push_back({first + t[0], first + t[1], first + t[2]});
            }
        }
        old_ = points_.size();
    }

    std::optional<PatchedMesh> make()
    {
        findFittingEdges();
        if (!placeRim()) {
            return std::nullopt;
        }
        chooseTriangles();
        if (!cutCavity()) {
            return std::nullopt;
        }
        return assemble();
    }

private:
    [[nodiscard]] Vec2 at(std::uint32_t v) const { return points_[v]; }

    void findFittingEdges()
    {
        fitting_.resize(rim_.size());
        changed_.assign(old_, 0);
        std::vector<std::optional<Place>> places(old_);
        for (std::uint32_t v = 0; v < old_; ++v) {
            if (next_[v] != kNone) {
                places[v] = rim_.nearest(at(v), kMaxGap * std::min(edge_, length(at(next_[v]) - at(v))));
            }
        }
        for (std::uint32_t v = 0; v < old_; ++v) {
            const std::uint32_t w = next_[v];
            if (w == kNone) {
                continue;
            }
            if (places[v] && places[w] && rim_.fits(at(v), at(w), *places[v], *places[w])) {
                const Curve& curve = rim_.curve(places[v]->loop);
                fitting_[places[v]->loop].push_back(
                    {v, w, curve.wrapped(places[v]->arc), curve.wrapped(places[w]->arc - places[v]->arc)});
            } else {
                changed_[v] = changed_[w] = 1;
            }
        }
    }

    /// Vertex of a newly sampled rim.
    struct Fresh {
        Vec2 point;
        double arc = 0.0;
        double spacing = 0.0;
        bool corner = false;
    };

    /// Places the vertices of the new rim: old ones where it runs along them, new ones elsewhere.
    bool placeRim()
    {
        const std::vector<RimPolygon> polygons = sampler_.sample(edge_);
        for (std::size_t k = 0; k < rim_.size(); ++k) {
            std::vector<Fresh> fresh;
            const RimPolygon& polygon = polygons[k];
            for (std::size_t i = 0; i < polygon.size(); ++i) {
                const double spacing =
                    std::min(length(polygon[(i + 1) % polygon.size()] - polygon[i]),
                             length(polygon[(i + polygon.size() - 1) % polygon.size()] - polygon[i]));
                const std::optional<Place> place = rim_.nearest(polygon[i], 0.5 * edge_);
                if (!place || place->loop != k) {
                    return false;
                }
                fresh.push_back({polygon[i], place->arc, spacing, rim_.isCorner(*place)});
            }
            if (!placeLoop(k, fresh)) {
                return false;
            }
        }
        return true;
    }

    bool placeLoop(std::size_t k, const std::vector<Fresh>& fresh)
    {
        const Curve& curve = rim_.curve(k);
        std::vector<FittingEdge>& edges = fitting_[k];
        std::sort(edges.begin(), edges.end(),
                  [](const FittingEdge& a, const FittingEdge& b) { return a.begin < b.begin; });
        std::vector<std::uint32_t>& loop = loops_.emplace_back();
        if (edges.empty()) {
            for (const Fresh& vertex : fresh) {
                loop.push_back(add(vertex.point));
            }
            return loop.size() >= 3;
        }
        double around = 0.0;
        bool skip_first = false;
        for (std::size_t e = 0; e < edges.size(); ++e) {
            const FittingEdge& edge = edges[e];
            const FittingEdge& following = edges[(e + 1) % edges.size()];
            if (!std::exchange(skip_first, false)) {
                loop.push_back(edge.from);
            }
            around += edge.way;
            if (following.from == edge.to) {
                continue;
            }
            const double end = edge.begin + edge.way;
            const double gap = curve.wrapped(following.begin - end);
            around += gap;
            std::vector<std::pair<double, const Fresh*>> between;
            bool crowds_last = false;
            for (const Fresh& vertex : fresh) {
                const double ahead = curve.wrapped(vertex.arc - end);
                const double margin = 0.5 * vertex.spacing;
                if (ahead > gap || (!vertex.corner && (ahead < margin || gap - ahead < margin))) {
                    continue;
                }
                crowds_last = crowds_last || ahead < margin;
                skip_first = skip_first || gap - ahead < margin;
                between.emplace_back(ahead, &vertex);
            }
            if (!crowds_last) {
                loop.push_back(edge.to);
            }
            std::sort(between.begin(), between.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
            for (const auto& [ahead, vertex] : between) {
                loop.push_back(add(vertex->point));
            }
        }
        if (skip_first) {
            loop.erase(loop.begin());
        }
        return loop.size() >= 3 && std::abs(around / curve.length() - 1.0) < 1e-6;
    }

    std::uint32_t add(Vec2 p)
    {
        points_.push_back(p);
        return static_cast<std::uint32_t>(points_.size()) - 1;
    }

    void chooseTriangles()
    {
        // Triangles stay if they are far from old rims that vanished and new rims that appeared.
        const double far = kFar * edge_;
        Cells<Vec2> seeds(far);
        for (std::uint32_t v = 0; v < points_.size(); ++v) {
            if (v >= old_ || changed_[v] != 0) {
                seeds.add(at(v), at(v));
            }
        }
        std::vector<std::uint8_t> stays(old_);
        for (std::uint32_t v = 0; v < old_; ++v) {
            stays[v] = seeds.around(at(v), [&](Vec2 seed) { return length(seed - at(v)) < far; }) ? 0 : 1;
        }
        std::erase_if(triangles_,
                      [&](const Triangle& t) { return stays[t[0]] == 0 || stays[t[1]] == 0 || stays[t[2]] == 0; });
        while (removePinches()) {
        }
        // A connected piece is wholly wet or wholly dry now, because no changed rim is near it.
        UnionFind pieces(old_);
        for (const Triangle& t : triangles_) {
            pieces.join(t[0], t[1]);
            pieces.join(t[0], t[2]);
        }
        std::unordered_map<std::size_t, std::size_t> sizes;
        std::unordered_map<std::size_t, bool> wet;
        for (const Triangle& t : triangles_) {
            const std::size_t piece = pieces.find(t[0]);
            if (++sizes[piece] == 1) {
                wet[piece] = rim_.encloses((1.0 / 3.0) * (at(t[0]) + at(t[1]) + at(t[2])));
            }
        }
        std::erase_if(triangles_, [&](const Triangle& t) {
            const std::size_t piece = pieces.find(t[0]);
            return sizes[piece] < kMinPiece || !wet[piece];
        });
    }

    /// Directed edges that border the triangles that stay.
    [[nodiscard]] std::vector<std::pair<std::uint32_t, std::uint32_t>> borders() const
    {
        std::unordered_set<std::uint64_t> all;
        for (const Triangle& t : triangles_) {
            for (std::size_t k = 0; k < 3; ++k) {
                all.insert(keyOf(t[k], t[(k + 1) % 3]));
            }
        }
        std::vector<std::pair<std::uint32_t, std::uint32_t>> found;
        for (const Triangle& t : triangles_) {
            for (std::size_t k = 0; k < 3; ++k) {
                if (!all.contains(keyOf(t[(k + 1) % 3], t[k]))) {
                    found.emplace_back(t[k], t[(k + 1) % 3]);
                }
            }
        }
        return found;
    }

    /// Removes triangles around vertices where they touch one another, or the rim, only at a point.
    bool removePinches()
    {
        constexpr std::uint8_t kRemove = 2;
        std::vector<std::uint8_t> border_count(old_, 0);  // number of borders that begin at a vertex, up to kRemove
        std::vector<std::uint8_t> along_rim(old_, 0);
        const std::vector<std::pair<std::uint32_t, std::uint32_t>> all = borders();
        for (const auto& [a, b] : all) {
            border_count[a] = static_cast<std::uint8_t>(std::min<int>(border_count[a] + 1, kRemove));
            if (next_[a] == b) {
                along_rim[a] = along_rim[b] = 1;
            }
        }
        bool found = false;
        for (const auto& [a, b] : all) {
            if (next_[a] != kNone && along_rim[a] == 0) {
                border_count[a] = kRemove;  // the triangles touch the rim only there
            }
            found = found || border_count[a] == kRemove;
        }
        if (found) {
            std::erase_if(triangles_, [&](const Triangle& t) {
                return border_count[t[0]] == kRemove || border_count[t[1]] == kRemove || border_count[t[2]] == kRemove;
            });
        }
        return found;
    }

    /// Finds the cavity to fill.
    bool cutCavity()
    {
        if (triangles_.empty()) {
            return false;
        }
        std::vector<std::uint8_t> at_seam(points_.size(), 0);
        for (const Triangle& t : triangles_) {
            at_seam[t[0]] = at_seam[t[1]] = at_seam[t[2]] = 1;
        }
        cavity_next_.assign(points_.size(), kNone);
        std::vector<std::uint8_t> rim_stays(old_, 0);
        std::size_t unmatched = 0;
        bool is_simple = true;
        const auto connect = [&](std::uint32_t from, std::uint32_t to) {
            is_simple = is_simple && cavity_next_[from] == kNone;
            cavity_next_[from] = to;
        };
        for (const auto& [a, b] : borders()) {
            if (next_[a] == b) {
                rim_stays[a] = 1;
                ++unmatched;
            } else {
                connect(b, a);
            }
        }
        on_rim_.assign(points_.size(), 0);
        for (const std::vector<std::uint32_t>& loop : loops_) {
            for (std::size_t i = 0; i < loop.size(); ++i) {
                const std::uint32_t v = loop[i];
                const std::uint32_t w = loop[(i + 1) % loop.size()];
                is_simple = is_simple && on_rim_[v] == 0;
                on_rim_[v] = 1;
                if (v < old_ && rim_stays[v] != 0 && next_[v] == w) {
                    --unmatched;
                } else {
                    connect(v, w);
                }
            }
        }
        if (!is_simple || unmatched != 0) {
            return false;
        }
        std::vector<std::uint8_t> seen(points_.size(), 0);
        for (std::uint32_t v = 0; v < points_.size(); ++v) {
            if (cavity_next_[v] == kNone || seen[v] != 0) {
                continue;
            }
            cavity_.polygons.emplace_back();
            cavity_.on_rim.emplace_back();
            cavity_.at_seam.emplace_back();
            std::uint32_t w = v;
            for (; w != kNone && seen[w] == 0; w = cavity_next_[w]) {
                seen[w] = 1;
                cavity_ids_.push_back(w);
                cavity_.polygons.back().push_back(at(w));
                cavity_.on_rim.back().push_back(on_rim_[w]);
                cavity_.at_seam.back().push_back(at_seam[w]);
            }
            if (w != v || cavity_.polygons.back().size() < 3) {
                return false;
            }
        }
        return true;
    }

    std::optional<PatchedMesh> assemble()
    {
        Filling filling;
        if (!cavity_.polygons.empty()) {
            filling = fill(cavity_, gradedPoints(cavity_.polygons, edge_, 1), kFinest * sampler_.finest());
        }
        std::vector<std::uint32_t> edge_of(points_.size(), kNone);  // edge of the cavity that begins at a vertex
        std::vector<const std::vector<std::uint32_t>*> splits;
        for (const auto& polygon : filling.splits) {
            for (const std::vector<std::uint32_t>& edge : polygon) {
                edge_of[cavity_ids_[splits.size()]] = static_cast<std::uint32_t>(splits.size());
                splits.push_back(&edge);
            }
        }
        PatchedMesh patched;
        PlanarMesh& mesh = patched.mesh;
        std::vector<std::uint32_t> number(points_.size(), kNone);
        std::vector<std::uint32_t> number_of_new(filling.points.size(), kNone);
        const auto append = [&](std::uint32_t& into, Vec2 p) {
            into = static_cast<std::uint32_t>(mesh.vertices.size());
            mesh.vertices.push_back(p);
        };
        mesh.loop_starts.push_back(0);
        for (const std::vector<std::uint32_t>& loop : loops_) {
            for (const std::uint32_t v : loop) {
                append(number[v], at(v));
                patched.kept += v < old_ ? 1 : 0;
                if (edge_of[v] != kNone) {
                    for (const std::uint32_t split : *splits[edge_of[v]]) {
                        append(number_of_new[split], filling.points[split]);
                    }
                }
            }
            mesh.loop_starts.push_back(static_cast<std::uint32_t>(mesh.vertices.size()));
        }
        for (std::size_t i = 0; i < filling.points.size(); ++i) {
            if (number_of_new[i] == kNone) {
                append(number_of_new[i], filling.points[i]);
            }
        }
        const std::size_t first_old = mesh.vertices.size();
        for (const Triangle& t : triangles_) {
            for (const std::uint32_t v : t) {
                if (number[v] == kNone) {
                    append(number[v], at(v));
                    ++patched.kept;
                }
            }
        }
        const auto given = static_cast<std::uint32_t>(cavity_ids_.size());
        for (const Triangle& t : filling.triangles) {
            Triangle& made = mesh.triangles.emplace_back();
            for (std::size_t k = 0; k < 3; ++k) {
                made[k] = t[k] < given ? number[cavity_ids_[t[k]]] : number_of_new[t[k] - given];
            }
        }
        for (const Triangle& t : triangles_) {
            mesh.triangles.push_back({number[t[0]], number[t[1]], number[t[2]]});
        }
        smooth(mesh, {mesh.rimVertexCount(), first_old, filling.triangles.size()});
        mesh.validate();
        double enclosed = 0.0;
        for (std::size_t k = 0; k < mesh.loopCount(); ++k) {
            for (std::uint32_t v = mesh.loop_starts[k]; v < mesh.loop_starts[k + 1]; ++v) {
                enclosed += 0.5 * cross(mesh.vertices[v], mesh.vertices[nextOnRim(mesh, k, v)]);
            }
        }
        const double covered = area(mesh);
        if (std::abs(covered - enclosed) > 1e-9 * covered ||
            std::abs(covered - footprint_area_) > kMaxOffset * edge_ * rimLength(mesh)) {
            return std::nullopt;
        }
        return patched;
    }

    NewRim rim_;
    double edge_;
    RimSampler sampler_;
    double footprint_area_;
    std::vector<Vec2> points_;         ///< old points, then new rim points
    std::size_t old_ = 0;              ///< number of old points
    std::vector<std::uint32_t> next_;  ///< next vertex along old rims; kNone inside
    std::vector<Triangle> triangles_;  ///< triangles that stay
    std::vector<std::vector<FittingEdge>> fitting_;
    std::vector<std::uint8_t> changed_;  ///< 1 at ends of old rim edges that do not fit
    std::vector<std::vector<std::uint32_t>> loops_;
    std::vector<std::uint8_t> on_rim_;
    std::vector<std::uint32_t> cavity_next_;  ///< next vertex around the cavity, which is on the left
    Cavity cavity_;
    std::vector<std::uint32_t> cavity_ids_;  ///< its vertices, polygon by polygon
};

}  // namespace

std::optional<PatchedMesh> patch(const std::vector<const PlanarMesh*>& before, const Footprint& footprint, double edge)
{
    try {
        return Patching(before, footprint, edge).make();
    } catch (const Error&) {
        return std::nullopt;  // loops that meet, or a mesh that breaks its invariants
    }
}

}  // namespace droplet
