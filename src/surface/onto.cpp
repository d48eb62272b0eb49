// SPDX-License-Identifier: GPL-3.0-or-later
// Thesis, section 4.2.5: droplets solved as if the ground were nearly level, then mapped onto the object "like texture
// mapping". Normals go with the cofactors of the map's derivative (J. F. Blinn, "Simulation of wrinkled surfaces",
// 1978, is the case of a thin layer).
#include "droplet/surface/onto.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

#include "blocks.h"
#include "droplet/error.h"
#include "number_text.h"

namespace droplet {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// Points this near a triangle, in extents of the picture, count as on it: float uvs are no closer.
constexpr double kHair = 1e-7;

Vec3 unitOr(Vec3 a, Vec3 otherwise)
{
    const double size = length(a);
    return size > 0.0 && std::isfinite(size) ? (1.0 / size) * a : otherwise;
}

// R. E. Tarjan, J. van Leeuwen, "Worst-case analysis of set union algorithms" (1984): path halving; a set's name is its
// smallest member.
class Sets {
public:
    explicit Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0U); }

    std::uint32_t nameOf(std::uint32_t a)
    {
        while (parent_[a] != a) {
            a = parent_[a] = parent_[parent_[a]];
        }
        return a;
    }
    void join(std::uint32_t a, std::uint32_t b)
    {
        a = nameOf(a);
        b = nameOf(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }

private:
    std::vector<std::uint32_t> parent_;
};

/// Numbers equal keys alike, in ascending order; returns how many there are.
template <class Key>
std::uint32_t numberEqual(const std::vector<Key>& keys, std::vector<std::uint32_t>& numbers)
{
    std::vector<std::uint32_t> order(keys.size());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return keys[a] < keys[b]; });
    numbers.resize(keys.size());
    std::uint32_t count = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
        count += i == 0 || keys[order[i - 1]] < keys[order[i]] ? 1 : 0;
        numbers[order[i]] = count - 1;
    }
    return count;
}

/// A triangle of the object, in the picture's plane and in space.
struct Facet {
    std::array<Vec2, 3> flat;                ///< in the picture's plane [m]
    std::array<std::uint32_t, 3> corners{};  ///< of its chart
    std::uint32_t chart = 0;
    double twice_flat = 0.0;  ///< signed doubled area in the plane
};

/// What a chart's vertex knows of the object around it.
struct Corner {
    Vec3 place;
    Vec3 normal;
    double scale = 0.0;            ///< length on the object per length in the picture
    std::array<Vec3, 2> along;     ///< ∂X/∂x, ∂X/∂y, x and y in the picture's plane
    std::array<Vec3, 2> swelling;  ///< the same of scale · normal: how a layer grows with its height
};

/// Derivatives along x and y of what is linear on a triangle.
std::array<Vec3, 2> derivatives(const Facet& facet, const std::array<Vec3, 3>& values)
{
    const Vec2 p = facet.flat[1] - facet.flat[0];
    const Vec2 q = facet.flat[2] - facet.flat[0];
    const Vec3 a = values[1] - values[0];
    const Vec3 b = values[2] - values[0];
    const double inverse = 1.0 / facet.twice_flat;
    return {inverse * (q.y * a - p.y * b), inverse * (p.x * b - q.x * a)};
}

/// Boxes of triangles, halved by their centres until few are left: for a point, the triangles that may hold it.
class Boxes {
public:
    Boxes() = default;
    Boxes(const std::vector<Facet>& facets, double hair) : order_(facets.size()), centres_(facets.size())
    {
        std::iota(order_.begin(), order_.end(), 0U);
        for (std::size_t i = 0; i < facets.size(); ++i) {
            centres_[i] = facets[i].flat[0] + facets[i].flat[1] + facets[i].flat[2];
        }
        build(facets, hair, 0, static_cast<std::uint32_t>(facets.size()));
    }

    template <class Visit>
    void visit(Vec2 p, const Visit& visit_facet) const
    {
        for (std::uint32_t n = 0; n < nodes_.size();) {
            const Node& node = nodes_[n];
            const bool inside = p.x >= node.low.x && p.x <= node.high.x && p.y >= node.low.y && p.y <= node.high.y;
            for (std::uint32_t i = node.begin; inside && i < node.end; ++i) {
                visit_facet(order_[i]);
            }
            n = inside ? n + 1 : node.skip;
        }
    }

private:
    static constexpr std::uint32_t kLeaf = 4;  // triangles

    /// In depth-first order: a node is followed by its children; `skip` is the next that is none of them.
    struct Node {
        Vec2 low;
        Vec2 high;
        std::uint32_t begin = 0;  ///< of a leaf's triangles; none otherwise
        std::uint32_t end = 0;
        std::uint32_t skip = 0;
    };

    void build(const std::vector<Facet>& facets, double hair, std::uint32_t begin, std::uint32_t end)
    {
        const std::size_t self = nodes_.size();
        Node node;
        node.low = node.high = facets[order_[begin]].flat[0];
        Vec2 first = centres_[order_[begin]];
        Vec2 last = first;
        const auto widen = [](Vec2& low, Vec2& high, Vec2 p) {
            low = {std::min(low.x, p.x), std::min(low.y, p.y)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y)};
        };
        for (std::uint32_t i = begin; i < end; ++i) {
            widen(first, last, centres_[order_[i]]);
            for (const Vec2 p : facets[order_[i]].flat) {
                widen(node.low, node.high, p);
            }
        }
        node.low = node.low - Vec2{hair, hair};
        node.high = node.high + Vec2{hair, hair};
        nodes_.push_back(node);
        if (end - begin <= kLeaf) {
            nodes_[self].begin = begin;
            nodes_[self].end = end;
        } else {
            const bool by_x = last.x - first.x >= last.y - first.y;
            const auto key = [&](std::uint32_t i) { return by_x ? centres_[i].x : centres_[i].y; };
            const std::uint32_t middle = begin + (end - begin) / 2;
            const auto at = [this](std::uint32_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
            std::nth_element(at(begin), at(middle), at(end), [&](std::uint32_t a, std::uint32_t b) {
                return std::pair(key(a), a) < std::pair(key(b), b);
            });
            build(facets, hair, begin, middle);
            build(facets, hair, middle, end);
        }
        nodes_[self].skip = static_cast<std::uint32_t>(nodes_.size());
    }

    std::vector<std::uint32_t> order_;
    std::vector<Vec2> centres_;
    std::vector<Node> nodes_;
};

/// A point of the picture on a chart.
struct Hit {
    std::uint32_t vertex = 0;  ///< of the droplets
    std::uint32_t chart = 0;
    std::uint32_t facet = 0;
    double depth = 0.0;  ///< how far inside the triangle, negative within a hair of it [m]
};

/// The object as the picture sees it.
struct Atlas {
    std::vector<Facet> facets;
    std::vector<Corner> corners;
    std::vector<double> facing;  ///< of every chart: 1, or −1 where it shows the picture mirrored
    Boxes boxes;
    double hair = 0.0;  ///< [m]

    /// The charts at a point, in order; on each the triangle it lies deepest in, of equals the first.
    [[nodiscard]] std::vector<Hit> at(Vec2 p) const
    {
        std::vector<Hit> hits;
        boxes.visit(p, [&](std::uint32_t f) {
            const Facet& facet = facets[f];
            double depth = std::numeric_limits<double>::infinity();
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec2 a = facet.flat[k];
                const Vec2 side = facet.flat[(k + 1) % 3] - a;
                depth = std::min(depth, std::copysign(1.0, facet.twice_flat) * cross(side, p - a) / length(side));
            }
            if (!(depth >= -hair)) {
                return;
            }
            const auto same =
                std::find_if(hits.begin(), hits.end(), [&](const Hit& h) { return h.chart == facet.chart; });
            if (same == hits.end()) {
                hits.push_back({0, facet.chart, f, depth});
            } else if (depth > same->depth || (depth == same->depth && f < same->facet)) {
                *same = {0, facet.chart, f, depth};
            }
        });
        std::sort(hits.begin(), hits.end(), [](const Hit& a, const Hit& b) { return a.chart < b.chart; });
        return hits;
    }
};

/// Facets with areas in space and in the plane, charts not yet known. A facet's corners are the object's vertices.
std::vector<Facet> facetsOf(const TexturedMesh& object, Vec2 extent)
{
    std::vector<Facet> facets;
    for (const Triangle& t : object.triangles) {
        Facet facet;
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec2 uv = object.uvs[t[k]];
            facet.flat[k] = {(uv.x - 0.5) * extent.x, (0.5 - uv.y) * extent.y};
            facet.corners[k] = t[k];
        }
        facet.twice_flat = cross(facet.flat[1] - facet.flat[0], facet.flat[2] - facet.flat[0]);
        const Vec3 a = object.positions[t[0]];
        const double twice = length(cross(object.positions[t[1]] - a, object.positions[t[2]] - a));
        if (std::isnormal(facet.twice_flat) && std::isnormal(twice) && std::isnormal(1.0 / facet.twice_flat)) {
            facets.push_back(facet);
        }
    }
    return facets;
}

/// 1 where a triangle shows the picture as it is, seen from outside; −1 where mirrored.
double facingOf(const TexturedMesh& object, const Facet& facet)
{
    const auto [i, j, k] = facet.corners;
    const Vec3 a = object.positions[i];
    const Vec3 normal = cross(object.positions[j] - a, object.positions[k] - a);
    const double out = dot(normal, object.normals[i] + object.normals[j] + object.normals[k]);
    return std::copysign(1.0, facet.twice_flat) * (out < 0.0 ? -1.0 : 1.0);
}

/// Joins facets across edges that are one in space and in uv, where both face the same way; returns every chart's
/// facing.
std::vector<double> joinCharts(const TexturedMesh& object, std::vector<Facet>& facets)
{
    std::vector<std::array<double, 5>> keys;
    for (std::size_t v = 0; v < object.positions.size(); ++v) {
        const Vec3 p = object.positions[v];
        keys.push_back({p.x, p.y, p.z, object.uvs[v].x, object.uvs[v].y});
    }
    std::vector<std::uint32_t> welded;
    numberEqual(keys, welded);

    struct Edge {
        std::uint32_t low;
        std::uint32_t high;
        bool mirrored;
        std::uint32_t facet;
    };
    std::vector<Edge> edges;
    std::vector<double> facing(facets.size());
    for (std::uint32_t f = 0; f < facets.size(); ++f) {
        facing[f] = facingOf(object, facets[f]);
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = welded[facets[f].corners[k]];
            const std::uint32_t b = welded[facets[f].corners[(k + 1) % 3]];
            edges.push_back({std::min(a, b), std::max(a, b), facing[f] < 0.0, f});
        }
    }
    const auto key = [](const Edge& e) { return std::tuple(e.low, e.high, e.mirrored); };
    std::sort(edges.begin(), edges.end(),
              [&](const Edge& a, const Edge& b) { return std::pair(key(a), a.facet) < std::pair(key(b), b.facet); });
    Sets sets(facets.size());
    for (std::size_t i = 1; i < edges.size(); ++i) {
        if (key(edges[i]) == key(edges[i - 1])) {
            sets.join(edges[i].facet, edges[i - 1].facet);
        }
    }
    std::vector<std::uint32_t> number(facets.size(), kNone);
    std::vector<double> chart_facing;
    for (std::uint32_t f = 0; f < facets.size(); ++f) {
        const std::uint32_t name = sets.nameOf(f);
        if (name == f) {
            number[f] = static_cast<std::uint32_t>(chart_facing.size());
            chart_facing.push_back(facing[f]);
        }
        facets[f].chart = number[name];
    }
    // From here on corners are those of the charts: one for every place in space and uv.
    std::vector<std::array<std::uint32_t, 2>> corner_keys;
    for (const Facet& facet : facets) {
        for (const std::uint32_t v : facet.corners) {
            corner_keys.push_back({facet.chart, welded[v]});
        }
    }
    std::vector<std::uint32_t> corner;
    numberEqual(corner_keys, corner);
    for (std::size_t f = 0; f < facets.size(); ++f) {
        std::copy_n(corner.begin() + static_cast<std::ptrdiff_t>(3 * f), 3, facets[f].corners.begin());
    }
    return chart_facing;
}

/// Angles of a facet in the picture's plane, which sum up alike on either side of a vertex however it is cut.
std::array<double, 3> anglesOf(const Facet& facet)
{
    std::array<double, 3> angles{};
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec2 a = facet.flat[(k + 1) % 3] - facet.flat[k];
        const Vec2 b = facet.flat[(k + 2) % 3] - facet.flat[k];
        angles[k] = std::atan2(std::abs(cross(a, b)), dot(a, b));
    }
    return angles;
}

/// Means over the facets around every corner, weighted by their angles there.
std::vector<Corner> cornersOf(const TexturedMesh& object, const std::vector<Facet>& facets,
                              const std::vector<std::array<std::uint32_t, 3>>& vertices)
{
    std::uint32_t count = 0;
    for (const Facet& facet : facets) {
        count = std::max({count, facet.corners[0] + 1, facet.corners[1] + 1, facet.corners[2] + 1});
    }
    std::vector<Corner> corners(count);
    std::vector<double> weights(count, 0.0);
    const auto add = [](std::array<Vec3, 2>& sum, double weight, const std::array<Vec3, 2>& value) {
        sum = {sum[0] + weight * value[0], sum[1] + weight * value[1]};
    };
    for (std::size_t f = 0; f < facets.size(); ++f) {
        const Facet& facet = facets[f];
        const std::array<double, 3> angles = anglesOf(facet);
        std::array<Vec3, 3> places;
        for (std::size_t k = 0; k < 3; ++k) {
            places[k] = object.positions[vertices[f][k]];
        }
        const double stretch = length(cross(places[1] - places[0], places[2] - places[0])) / std::abs(facet.twice_flat);
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t c = facet.corners[k];
            corners[c].place = places[k];
            corners[c].normal = corners[c].normal + angles[k] * object.normals[vertices[f][k]];
            corners[c].scale += angles[k] * stretch;
            add(corners[c].along, angles[k], derivatives(facet, places));
            weights[c] += angles[k];
        }
    }
    for (std::size_t f = 0; f < facets.size(); ++f) {
        for (std::size_t k = 0; k < 3; ++k) {
            // Opposite normals leave none: the first will do.
            Corner& corner = corners[facets[f].corners[k]];
            corner.normal = unitOr(corner.normal, object.normals[vertices[f][k]]);
        }
    }
    for (std::size_t c = 0; c < count; ++c) {
        corners[c].scale = std::sqrt(corners[c].scale / weights[c]);
        corners[c].along = {(1.0 / weights[c]) * corners[c].along[0], (1.0 / weights[c]) * corners[c].along[1]};
    }
    for (const Facet& facet : facets) {
        const std::array<double, 3> angles = anglesOf(facet);
        std::array<Vec3, 3> heights;
        for (std::size_t k = 0; k < 3; ++k) {
            const Corner& corner = corners[facet.corners[k]];
            heights[k] = corner.scale * corner.normal;
        }
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t c = facet.corners[k];
            add(corners[c].swelling, angles[k] / weights[c], derivatives(facet, heights));
        }
    }
    return corners;
}

Atlas atlasOf(const TexturedMesh& object, Vec2 extent)
{
    Atlas atlas;
    atlas.facets = facetsOf(object, extent);
    if (atlas.facets.empty()) {
        throw Error(ErrorCode::InvalidInput, "the object has no triangle with an area both in space and in uv");
    }
    std::vector<std::array<std::uint32_t, 3>> vertices;
    for (const Facet& facet : atlas.facets) {
        vertices.push_back(facet.corners);
    }
    atlas.facing = joinCharts(object, atlas.facets);
    atlas.corners = cornersOf(object, atlas.facets, vertices);
    atlas.hair = kHair * std::max(extent.x, extent.y);
    atlas.boxes = Boxes(atlas.facets, atlas.hair);
    return atlas;
}

/// A vertex of a droplet on the object.
struct Laid {
    Vec3 position;
    Vec3 normal;
    Vec3 ground_normal;
    double scale = 0.0;
    double swept = 0.0;  ///< volume per volume of the map there, negative where mirrored
};

Laid lay(const Atlas& atlas, const Facet& facet, Vec2 p, double z, Vec3 normal)
{
    std::array<double, 3> share{};
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec2 a = facet.flat[(k + 1) % 3];
        share[k] = cross(facet.flat[(k + 2) % 3] - a, p - a) / facet.twice_flat;
    }
    Vec3 place;
    Vec3 up;
    std::array<Vec3, 2> along;
    std::array<Vec3, 2> swelling;
    Laid laid;
    for (std::size_t k = 0; k < 3; ++k) {
        const Corner& corner = atlas.corners[facet.corners[k]];
        place = place + share[k] * corner.place;
        up = up + share[k] * corner.normal;
        laid.scale += share[k] * corner.scale;
        for (std::size_t i = 0; i < 2; ++i) {
            along[i] = along[i] + share[k] * corner.along[i];
            swelling[i] = swelling[i] + share[k] * corner.swelling[i];
        }
    }
    up = unitOr(up, atlas.corners[facet.corners[0]].normal);
    const Vec3 rise = laid.scale * up;
    // Averaged facets at a chart's end are its chords: what they lean is no slope of the object.
    const auto tangent = [&](std::size_t i) {
        const Vec3 level = along[i] - dot(along[i], up) * up;
        return level + z * swelling[i];
    };
    const Vec3 a = tangent(0);
    const Vec3 b = tangent(1);
    laid.swept = dot(cross(a, b), rise);
    laid.position = z == 0.0 ? place : place + z * rise;
    const Vec3 turned = normal.x * cross(b, rise) + normal.y * cross(rise, a) + normal.z * cross(a, b);
    laid.normal = unitOr(std::copysign(1.0, laid.swept) * turned, std::copysign(1.0, normal.z) * up);
    laid.ground_normal = up;
    return laid;
}

/// Why a droplet is not laid, or on which chart.
enum class Fate { Laid, Outside, Across, Folded };

struct Placing {
    Fate fate = Fate::Laid;
    std::uint32_t chart = 0;
};

/// The droplets of a surface: for every vertex the number of its own, kNone for vertices of no triangle.
std::uint32_t numberDroplets(const Surface& surface, std::vector<std::uint32_t>& droplet)
{
    Sets sets(surface.positions.size());
    for (std::uint32_t v = 0; v < surface.weld.size(); ++v) {
        sets.join(v, surface.weld[v]);
    }
    for (const Triangle& t : surface.triangles) {
        sets.join(t[0], t[1]);
        sets.join(t[1], t[2]);
    }
    std::vector<std::uint32_t> number(surface.positions.size(), kNone);
    std::uint32_t count = 0;
    for (const Triangle& t : surface.triangles) {
        std::uint32_t& own = number[sets.nameOf(t[0])];
        own = own == kNone ? count++ : own;
    }
    droplet.resize(surface.positions.size());
    for (std::uint32_t v = 0; v < droplet.size(); ++v) {
        droplet[v] = number[sets.nameOf(v)];
    }
    return count;
}

/// Where every vertex lies: hits of vertex v are [starts[v], starts[v+1]), by ascending chart.
struct Hits {
    std::vector<Hit> all;
    std::vector<std::size_t> starts;

    [[nodiscard]] std::span<const Hit> at(std::size_t v) const
    {
        return std::span(all).subspan(starts[v], starts[v + 1] - starts[v]);
    }
    [[nodiscard]] const Hit* on(std::size_t v, std::uint32_t chart) const
    {
        const std::span<const Hit> hits = at(v);
        const auto found = std::find_if(hits.begin(), hits.end(), [&](const Hit& h) { return h.chart == chart; });
        return found == hits.end() ? nullptr : &*found;
    }
};

Hits findHits(const Surface& surface, const Atlas& atlas, const std::vector<Vec2>& flat)
{
    Hits hits;
    hits.starts.assign(flat.size() + 1, 0);
    for (const std::vector<Hit>&block :
         mapBlocks<std::vector<Hit>>(flat.size(), [&](std::size_t begin, std::size_t end) {
             std::vector<Hit> found;
             for (std::size_t v = begin; v < end; ++v) {
                 for (Hit hit : atlas.at(flat[surface.weld[v]])) {
                     hit.vertex = static_cast<std::uint32_t>(v);
                     found.push_back(hit);
                 }
             }
             return found;
         })) {
        for (const Hit& hit : block) {
            ++hits.starts[hit.vertex + 1];
        }
        hits.all.insert(hits.all.end(), block.begin(), block.end());
    }
    std::partial_sum(hits.starts.begin(), hits.starts.end(), hits.starts.begin());
    return hits;
}

/// For every droplet the first chart that has all its vertices.
std::vector<Placing> placeDroplets(const Hits& hits, const std::vector<std::uint32_t>& droplet, std::uint32_t count)
{
    std::vector<Placing> placings(count);
    std::vector<std::optional<std::vector<std::uint32_t>>> common(count);
    for (std::size_t v = 0; v < droplet.size(); ++v) {
        if (droplet[v] == kNone) {
            continue;
        }
        Placing& placing = placings[droplet[v]];
        auto& charts = common[droplet[v]];
        if (hits.at(v).empty()) {
            placing.fate = Fate::Outside;
        } else if (!charts) {
            charts.emplace();
            for (const Hit& hit : hits.at(v)) {
                charts->push_back(hit.chart);
            }
        } else {
            std::erase_if(*charts, [&](std::uint32_t chart) { return hits.on(v, chart) == nullptr; });
        }
    }
    for (std::uint32_t d = 0; d < count; ++d) {
        if (placings[d].fate == Fate::Outside) {
            continue;
        }
        if (common[d]->empty()) {
            placings[d].fate = Fate::Across;
        } else {
            placings[d].chart = common[d]->front();
        }
    }
    return placings;
}

std::string rounded(double value)
{
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.3g", value);
    return text.data();
}

std::string counted(std::size_t count, const std::string& one)
{
    return std::to_string(count) + " " + one + (count == 1 ? "" : "s");
}

void addWarnings(OntoReport& report)
{
    const auto left_out = [&](std::size_t count, const std::string& why) {
        if (count > 0) {
            report.warnings.push_back(counted(count, "droplet") + " left out: " + why);
        }
    };
    left_out(report.outside, "not wholly on a chart of the object's uv");
    left_out(report.across, "across a seam between charts of the object's uv");
    left_out(report.folded, "thicker than the object's hollow there is wide");
    if (report.mirrored > 0) {
        report.warnings.push_back(counted(report.mirrored, "droplet") + " mirrored, on " +
                                  counted(report.flipped_charts, "flipped chart") + " of the object's uv");
    }
    if (report.overlapping_charts > 0) {
        report.warnings.push_back(counted(report.overlapping_charts, "chart") +
                                  " of the object's uv overlap others with droplets; the first in the file has them");
    }
    constexpr double kNoticeable = 1.5;
    if (report.most_scale > kNoticeable || report.least_scale < 1.0 / kNoticeable) {
        report.warnings.push_back("the object is " + rounded(report.least_scale) + " to " + rounded(report.most_scale) +
                                  " times as large as the picture; gravity acted at the picture's size");
    }
}

void checkAnyLaid(const OntoReport& report, std::size_t count)
{
    if (report.laid == 0) {
        throw Error(ErrorCode::NoSuchDroplet, "none of " + counted(count, "droplet") +
                                                  " can be laid on the object: " + std::to_string(report.outside) +
                                                  " not wholly on a chart of its uv, " + std::to_string(report.across) +
                                                  " across a seam, " + std::to_string(report.folded) +
                                                  " thicker than a hollow is wide");
    }
}

/// Charts that hold vertices of droplets laid elsewhere, and flipped ones that have droplets.
void countCharts(const Atlas& atlas, const Hits& hits, const std::vector<std::uint32_t>& droplet,
                 const std::vector<Placing>& placings, OntoReport& report)
{
    std::vector<bool> overlapping(atlas.facing.size(), false);
    std::vector<bool> flipped(atlas.facing.size(), false);
    for (const Hit& hit : hits.all) {
        const std::uint32_t own = droplet[hit.vertex];
        const bool met = own != kNone && placings[own].fate == Fate::Laid;
        if (met && placings[own].chart != hit.chart && hit.depth > atlas.hair) {
            overlapping[hit.chart] = true;
        }
    }
    for (const Placing& placing : placings) {
        switch (placing.fate) {
            case Fate::Laid:
                ++report.laid;
                if (atlas.facing[placing.chart] < 0.0) {
                    ++report.mirrored;
                    flipped[placing.chart] = true;
                }
                break;
            case Fate::Outside:
                ++report.outside;
                break;
            case Fate::Across:
                ++report.across;
                break;
            case Fate::Folded:
                ++report.folded;
                break;
        }
    }
    report.overlapping_charts = static_cast<std::size_t>(std::count(overlapping.begin(), overlapping.end(), true));
    report.flipped_charts = static_cast<std::size_t>(std::count(flipped.begin(), flipped.end(), true));
}

/// Volume over footprint, both as stretched.
double meanHeight(const Surface& droplets, const std::vector<Laid>& laid, const std::vector<bool>& kept)
{
    double volume = 0.0;
    double area = 0.0;
    for (const auto& [a, b, c] : droplets.triangles) {
        const Vec3 p = droplets.positions[a];
        const Vec3 q = droplets.positions[b] - p;
        const Vec3 r = droplets.positions[c] - p;
        const double flat = cross(Vec2{q.x, q.y}, Vec2{r.x, r.y});
        if (kept[a] && flat > 0.0) {
            const double s = (laid[a].scale + laid[b].scale + laid[c].scale) / 3.0;
            const double z = (p.z + droplets.positions[b].z + droplets.positions[c].z) / 3.0;
            volume += flat * s * s * s * z;
            area += flat * s * s;
        }
    }
    return area > 0.0 ? std::max(0.0, volume / area) : 0.0;
}

}  // namespace

void OntoOptions::validate() const
{
    if (!(extent.x > 0.0 && extent.y > 0.0 && std::isfinite(extent.x) && std::isfinite(extent.y))) {
        throw Error(ErrorCode::InvalidArgument,
                    "extent " + numberText(extent.x) + " m × " + numberText(extent.y) + " m must be positive");
    }
}

OntoResult layOnto(const Surface& droplets, const TexturedMesh& object, const OntoOptions& options)
{
    options.validate();
    droplets.validate();
    object.validate();
    const Atlas atlas = atlasOf(object, options.extent);
    const std::size_t count = droplets.positions.size();
    std::vector<Vec2> flat(count);
    for (std::size_t v = 0; v < count; ++v) {
        const Vec2 uv = droplets.uvs[v];
        flat[v] = {(uv.x - 0.5) * options.extent.x, (0.5 - uv.y) * options.extent.y};
    }
    std::vector<std::uint32_t> droplet;
    const std::uint32_t droplet_count = numberDroplets(droplets, droplet);
    const Hits hits = findHits(droplets, atlas, flat);
    std::vector<Placing> placings = placeDroplets(hits, droplet, droplet_count);

    const auto is_laid = [&](std::size_t v) { return droplet[v] != kNone && placings[droplet[v]].fate == Fate::Laid; };
    std::vector<Laid> laid(count);
    forBlocks(count, [&](std::size_t begin, std::size_t end) {
        for (std::size_t v = begin; v < end; ++v) {
            if (is_laid(v)) {
                const Hit& hit = *hits.on(v, placings[droplet[v]].chart);
                const std::uint32_t first = droplets.weld[v];  // copies must come to the same place, bit by bit
                laid[v] =
                    lay(atlas, atlas.facets[hit.facet], flat[first], droplets.positions[first].z, droplets.normals[v]);
            }
        }
    });
    for (std::size_t v = 0; v < count; ++v) {
        if (is_laid(v) && !(laid[v].swept * atlas.facing[placings[droplet[v]].chart] > 0.0)) {
            placings[droplet[v]].fate = Fate::Folded;
        }
    }

    OntoResult result;
    OntoReport& report = result.report;
    countCharts(atlas, hits, droplet, placings, report);
    checkAnyLaid(report, droplet_count);
    Surface& surface = result.surface;
    std::vector<std::uint32_t> renamed(count, kNone);
    std::vector<bool> kept(count, false);
    report.least_scale = std::numeric_limits<double>::infinity();
    for (std::size_t v = 0; v < count; ++v) {
        if (!is_laid(v)) {
            continue;
        }
        kept[v] = true;
        renamed[v] = static_cast<std::uint32_t>(surface.positions.size());
        surface.positions.push_back(laid[v].position);
        surface.normals.push_back(laid[v].normal);
        surface.uvs.push_back(droplets.uvs[v]);
        surface.weld.push_back(renamed[droplets.weld[v]]);
        if (!droplets.contact_angle.empty()) {
            const double angle = std::acos(std::clamp(dot(laid[v].normal, laid[v].ground_normal), -1.0, 1.0));
            surface.contact_angle.push_back(droplets.contact_angle[v] > 0.0F ? static_cast<float>(angle) : 0.0F);
        }
        report.least_scale = std::min(report.least_scale, laid[v].scale);
        report.most_scale = std::max(report.most_scale, laid[v].scale);
    }
    for (const auto& [a, b, c] : droplets.triangles) {
        if (kept[a]) {
            const bool mirrored = atlas.facing[placings[droplet[a]].chart] < 0.0;
            surface.triangles.push_back(mirrored ? Triangle{renamed[a], renamed[c], renamed[b]}
                                                 : Triangle{renamed[a], renamed[b], renamed[c]});
        }
    }
    surface.mean_height = meanHeight(droplets, laid, kept);
    addWarnings(report);
    return result;
}

double metresPerUv(const TexturedMesh& object)
{
    object.validate();
    struct Stretch {
        double length;
        double area;
    };
    std::vector<Stretch> stretches;
    double whole = 0.0;
    for (const Facet& facet : facetsOf(object, {1.0, 1.0})) {
        const auto [i, j, k] = facet.corners;
        const Vec3 a = object.positions[i];
        const double area = length(cross(object.positions[j] - a, object.positions[k] - a));
        stretches.push_back({std::sqrt(area / std::abs(facet.twice_flat)), area});
        whole += area;
    }
    if (stretches.empty()) {
        throw Error(ErrorCode::InvalidInput, "the object has no triangle with an area both in space and in uv");
    }
    std::sort(stretches.begin(), stretches.end(), [](const Stretch& a, const Stretch& b) {
        return std::pair(a.length, a.area) < std::pair(b.length, b.area);
    });
    double below = 0.0;
    for (const Stretch& stretch : stretches) {
        below += stretch.area;
        if (below >= 0.5 * whole) {
            return stretch.length;
        }
    }
    return stretches.back().length;
}

}  // namespace droplet
