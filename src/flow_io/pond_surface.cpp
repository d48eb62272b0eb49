// SPDX-License-Identifier: GPL-3.0-or-later
//
// The ground's triangles are cut at the level; what is below it is the base, and the loops of its open edges are the
// rim. The level is the triangulation of these loops. A dome over it is the linear capillary surface with that rim, u −
// λ² Δu = const, scaled to its volume: as a puddle's, it is flat but for some capillary lengths λ along the rim.
// A puddle with a front is cut where its height falls to the floor, on finer triangles. Its rim is then on the floor in
// front and on the walls beside it, and the same surface spans it.
#include "flow_io/pond_surface.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "droplet/error.h"
#include "droplet/mesh/triangulate.h"
#include "surface/open_edges.h"
#include "unit_vector.h"

namespace droplet {
namespace {

using Key = std::array<double, 6>;

Key keyOf(Vec3 a, Vec3 b)
{
    return {a.x, a.y, a.z, b.x, b.y, b.z};
}

/// The ground below the liquid.
class Base {
public:
    Base(std::span<const FlowSurface::Face> ground, const Pond& pond) : pond_(pond)
    {
        const std::uint32_t parts = pond.front ? partsFor(ground, *pond.front) : 1;
        for (std::size_t k = 0; k < ground.size(); ++k) {
            divide(ground[k], k, parts);
        }
    }

    std::vector<Vec3> vertices;
    std::vector<Triangle> triangles;
    std::vector<double> depths;  ///< of the liquid over the vertices [m]
    std::vector<bool> is_rim;    ///< whether the liquid's surface ends at a vertex of an open edge

    /// Volume between the ground and a level, negative where the ground is over it [m³].
    [[nodiscard]] double below(double level) const
    {
        return sum([&](std::uint32_t v) { return level - dot(pond_.up, vertices[v]); });
    }

    /// Volume between the ground and the liquid's surface without a dome [m³].
    [[nodiscard]] double held() const
    {
        return sum([&](std::uint32_t v) { return depths[v]; });
    }

private:
    /// Place on the ground.
    struct Corner {
        Vec3 place;
        double over = 0.0;  ///< its height over the liquid [m]
    };
    using Corners = std::array<Corner, 3>;

    /// Integral over the base, as seen from above.
    template <typename Depth>
    [[nodiscard]] double sum(const Depth& depth) const
    {
        double volume = 0.0;
        for (const auto& [a, b, c] : triangles) {
            const Vec3 area = 0.5 * cross(vertices[b] - vertices[a], vertices[c] - vertices[a]);
            volume -= dot(area, pond_.up) * (depth(a) + depth(b) + depth(c)) / 3.0;
        }
        return volume;
    }

    [[nodiscard]] Corner at(Vec3 place, double liquid) const { return {place, dot(pond_.up, place) - liquid}; }

    std::uint32_t vertexAt(const Key& key, Vec3 place, double depth)
    {
        const bool on_rim = !(depth > 0.0);
        const auto [at, is_new] = numbers_.try_emplace(key, static_cast<std::uint32_t>(vertices.size()));
        if (is_new) {
            // Crossings near a corner may be one place.
            const bool on_level = on_rim && !pond_.front;
            const Vec3 p = on_level ? place - (dot(pond_.up, place) - pond_.level) * pond_.up : place;
            at->second = places_.try_emplace({p.x, p.y, p.z}, at->second).first->second;
            if (at->second == vertices.size()) {
                vertices.push_back(p);
                depths.push_back(depth);
                is_rim.push_back(on_rim || pond_.front.has_value());
            }
        }
        return at->second;
    }

    /// Where an edge passes the liquid's surface: the same from both sides.
    std::uint32_t crossing(const Corner& below, const Corner& above)
    {
        const double share = below.over / (below.over - above.over);
        return vertexAt(keyOf(below.place, above.place), below.place + share * (above.place - below.place), 0.0);
    }

    /// Number of parts of every edge, so that triangles follow the front; one for all, so that neighbours agree.
    static std::uint32_t partsFor(std::span<const FlowSurface::Face> ground, const PondFront& front)
    {
        constexpr double kEdge = 0.125;  // over the way to the front: a chord misses 0.2 % of it
        constexpr double kMostTriangles = 50'000.0;
        double longest = 0.0;
        for (const FlowSurface::Face& face : ground) {
            for (std::size_t c = 0; c < 3; ++c) {
                longest = std::max(longest, length(face.corners[(c + 1) % 3] - face.corners[c]));
            }
        }
        const double most = std::sqrt(kMostTriangles / static_cast<double>(ground.size()));
        return static_cast<std::uint32_t>(std::max(std::min(std::ceil(longest / (kEdge * front.way)), most), 1.0));
    }

    /// Place of a face with the weights i, j and the rest of its corners; on its edges the same from both sides.
    static Vec3 placeOn(const FlowSurface::Face& face, std::array<std::uint32_t, 3> weights, std::uint32_t parts)
    {
        const auto share = [&](std::size_t k) { return static_cast<double>(weights[k]) / parts; };
        for (std::size_t k = 0; k < 3; ++k) {
            if (weights[k] == parts) {
                return face.corners[k];
            }
        }
        for (std::size_t k = 0; k < 3; ++k) {
            if (weights[k] == 0) {
                std::size_t from = (k + 1) % 3;
                std::size_t to = (k + 2) % 3;
                const Vec3 a = face.corners[from];
                const Vec3 b = face.corners[to];
                if (std::tie(b.x, b.y, b.z) < std::tie(a.x, a.y, a.z)) {
                    std::swap(from, to);
                }
                return face.corners[from] + share(to) * (face.corners[to] - face.corners[from]);
            }
        }
        return share(0) * face.corners[0] + share(1) * face.corners[1] + share(2) * face.corners[2];
    }

    /// Divides a face, whose number in Pond::faces is k.
    void divide(const FlowSurface::Face& face, std::size_t k, std::uint32_t parts)
    {
        const auto corner = [&](std::uint32_t i, std::uint32_t j) {
            const Vec3 place = placeOn(face, {parts - i - j, i, j}, parts);
            // Ways to an edge may differ a little between its two faces.
            const double liquid =
                liquid_.try_emplace({place.x, place.y, place.z}, pond_.heightOver(k, place)).first->second;
            return at(place, liquid);
        };
        for (std::uint32_t i = 0; i < parts; ++i) {
            for (std::uint32_t j = 0; i + j < parts; ++j) {
                add({corner(i, j), corner(i + 1, j), corner(i, j + 1)});
                if (i + j + 1 < parts) {
                    add({corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)});
                }
            }
        }
    }

    void add(const Corners& corners)
    {
        std::vector<std::uint32_t> polygon;
        for (std::size_t k = 0; k < 3; ++k) {
            const Corner& a = corners[k];
            const Corner& b = corners[(k + 1) % 3];
            if (a.over <= 0.0) {
                polygon.push_back(vertexAt(keyOf(a.place, a.place), a.place, -a.over));
            }
            if (a.over < 0.0 && b.over > 0.0) {
                polygon.push_back(crossing(a, b));
            } else if (a.over > 0.0 && b.over < 0.0) {
                polygon.push_back(crossing(b, a));
            }
        }
        for (std::size_t k = 2; k < polygon.size(); ++k) {
            const Triangle t{polygon[0], polygon[k], polygon[k - 1]};  // seen from the ground
            if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) {
                triangles.push_back(t);
            }
        }
    }

    const Pond& pond_;
    std::map<Key, std::uint32_t> numbers_;
    std::map<std::array<double, 3>, std::uint32_t> places_;
    std::map<std::array<double, 3>, double> liquid_;  ///< heights, by place
};

/// Heights of a dome over a mesh, given on its rim.
/// @param integral  of the heights over the mesh [m³]
std::vector<double> domeOver(const PlanarMesh& mesh, double bending, double integral, std::vector<double> heights)
{
    const std::uint32_t rim = mesh.rimVertexCount();
    const auto inner = static_cast<Eigen::Index>(mesh.vertices.size() - rim);
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::VectorXd share = Eigen::VectorXd::Zero(inner);  // of the area, that a vertex stands for
    Eigen::VectorXd pull = Eigen::VectorXd::Zero(inner);   // of the rim
    for (const Triangle& t : mesh.triangles) {
        const double area = 0.5 * doubleArea(mesh, t);
        if (!(area > 0.0)) {
            continue;
        }
        for (std::size_t i = 0; i < 3; ++i) {
            if (t[i] < rim) {
                integral -= area / 3.0 * heights[t[i]];
                continue;
            }
            share[t[i] - rim] += area / 3.0;
            const Vec2 a = mesh.vertices[t[(i + 2) % 3]] - mesh.vertices[t[(i + 1) % 3]];
            for (std::size_t j = 0; j < 3; ++j) {
                const Vec2 b = mesh.vertices[t[(j + 2) % 3]] - mesh.vertices[t[(j + 1) % 3]];
                const double tension = bending * bending * dot(a, b) / (4.0 * area);
                if (t[j] >= rim) {
                    const double mass = i == j ? area / 3.0 : 0.0;
                    entries.emplace_back(t[i] - rim, t[j] - rim, tension + mass);
                } else {
                    pull[t[i] - rim] -= tension * heights[t[j]];
                }
            }
        }
    }
    heights.resize(mesh.vertices.size());
    Eigen::SparseMatrix<double> matrix(inner, inner);
    matrix.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(matrix);
    if (inner == 0 || factor.info() != Eigen::Success) {
        return heights;
    }
    const Eigen::VectorXd solved = factor.solve(share);
    const Eigen::VectorXd by_rim = factor.solve(pull);
    const double held = solved.dot(share);
    const double rest = integral - by_rim.dot(share);
    for (Eigen::Index i = 0; i < inner && held > 0.0; ++i) {
        heights[static_cast<std::size_t>(i) + rim] = by_rim[i] + rest / held * solved[i];
    }
    return heights;
}

/// The liquid's surface.
struct Level {
    std::vector<std::uint32_t> rim;    ///< vertices of the base, in the order of the first vertices
    std::vector<std::uint32_t> after;  ///< for each of them, the next one
    std::vector<Vec3> vertices;
    std::vector<Triangle> triangles;

    /// Whether it ends where the base does; without triangles it does not.
    [[nodiscard]] bool meets(const std::vector<DirectedEdge>& open) const
    {
        std::vector<DirectedEdge> own;
        for (const auto& [from, to] : openEdges(triangles)) {
            if (from >= rim.size() || to >= rim.size()) {
                return false;
            }
            own.push_back({rim[to], rim[from]});
        }
        std::sort(own.begin(), own.end());
        return own == open;
    }
};

/// Shadow of the base on the level, for a rim that is no set of simple loops.
Level projected(const Base& base, const std::vector<DirectedEdge>& open, const Pond& pond)
{
    Level level;
    std::vector<bool> meets(base.vertices.size());  // whether the base ends there
    for (const auto& [from, to] : open) {
        meets[from] = base.is_rim[from];
    }
    double scale = 1.0;
    if (pond.front) {
        const double held = base.held();
        scale = held > 0.0 ? pond.front->volume / held : 0.0;
    }
    for (std::uint32_t v = 0; v < base.vertices.size(); ++v) {
        const double depth = meets[v] ? 0.0 : base.depths[v];
        level.vertices.push_back(base.vertices[v] + scale * depth * pond.up);
        level.rim.push_back(v);
        level.after.push_back(v);
    }
    for (const auto& [a, b, c] : base.triangles) {
        level.triangles.push_back({a, c, b});
    }
    return level;
}

/// Triangulation of the loops of the rim, with the dome.
Level levelOver(const Base& base, const std::vector<DirectedEdge>& open, const Pond& pond)
{
    const Vec3 any = std::abs(pond.up.x) < 0.9 ? Vec3{1.0, 0.0, 0.0} : Vec3{0.0, 1.0, 0.0};
    const Vec3 across = cross(pond.up, any);
    const Vec3 left = (1.0 / length(across)) * across;
    const Vec3 ahead = cross(left, pond.up);
    const Vec3 origin = pond.level * pond.up;
    Level level;
    PlanarMesh outline;
    for (const std::vector<std::uint32_t>& loop : loopsOf(open)) {
        const auto first = static_cast<std::uint32_t>(level.rim.size());
        outline.loop_starts.push_back(first);
        for (const std::uint32_t v : loop) {
            const Vec3 p = base.vertices[v] - origin;
            outline.vertices.push_back({dot(ahead, p), dot(left, p)});
            level.rim.push_back(v);
            level.after.push_back(static_cast<std::uint32_t>(level.rim.size()));
        }
        level.after.back() = first;
    }
    if (level.rim.empty()) {
        return level;
    }
    outline.loop_starts.push_back(static_cast<std::uint32_t>(level.rim.size()));
    // Some triangles across the bend along the rim, and across a small pond; of a large one, not too many.
    constexpr double kAcrossBend = 2.0;
    constexpr double kLeastAcross = 12.0;
    constexpr double kMostAcross = 40.0;
    const bool is_bent = pond.dome > 0.0 || pond.front;
    const double size = std::sqrt(pond.area);
    const double edge = std::max(std::min(pond.bending / kAcrossBend, size / kLeastAcross), size / kMostAcross);
    PlanarMesh mesh;
    try {
        mesh = cover(outline, is_bent ? std::optional(edge) : std::nullopt);
    } catch (const Error&) {  // loops touch or cross
        return level;
    }
    std::vector<double> heights(level.rim.size());  // over the level
    double dome = pond.dome;
    if (pond.front) {
        for (std::size_t v = 0; v < level.rim.size(); ++v) {
            heights[v] = dot(pond.up, base.vertices[level.rim[v]]) - pond.level;
        }
        dome = pond.front->volume - base.below(pond.level);
    }
    if (is_bent) {
        heights = domeOver(mesh, pond.bending, dome, std::move(heights));
    }
    heights.resize(mesh.vertices.size());
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
        const Vec2 p = mesh.vertices[v];
        level.vertices.push_back(origin + p.x * ahead + p.y * left + heights[v] * pond.up);
    }
    for (std::size_t v = 0; v < level.rim.size(); ++v) {
        if (base.is_rim[level.rim[v]]) {
            level.vertices[v] = base.vertices[level.rim[v]];
        }
    }
    level.triangles = mesh.triangles;
    return level;
}

/// Means of the normals of the triangles around vertices, by area.
std::vector<Vec3> normalsOf(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles, Vec3 otherwise)
{
    std::vector<Vec3> normals(vertices.size());
    for (const auto& [a, b, c] : triangles) {
        const Vec3 area = cross(vertices[b] - vertices[a], vertices[c] - vertices[a]);
        for (const std::uint32_t v : {a, b, c}) {
            normals[v] = normals[v] + area;
        }
    }
    for (Vec3& normal : normals) {
        normal = unit(normal, otherwise);
    }
    return normals;
}

}  // namespace

PondSurface pondSurface(const FlowSurface& surface, const Pond& pond)
{
    std::vector<FlowSurface::Face> ground;
    for (const std::uint32_t face : pond.faces) {
        ground.push_back(surface.faces[face]);
    }
    return pondSurface(ground, pond);
}

PondSurface pondSurface(std::span<const FlowSurface::Face> ground, const Pond& pond)
{
    const Base base(ground, pond);
    const std::vector<DirectedEdge> open = openEdges(base.triangles);
    Level level = levelOver(base, open, pond);
    if (!level.meets(open)) {
        level = projected(base, open, pond);
    }

    PondSurface made;
    const auto rim = static_cast<std::uint32_t>(level.rim.size());
    std::vector<std::uint32_t> above(base.vertices.size());  // rim vertices over those of the base
    for (std::uint32_t k = rim; k-- > 0;) {
        above[level.rim[k]] = k;
    }
    made.vertices = std::move(level.vertices);
    made.triangles = std::move(level.triangles);
    made.after = std::move(level.after);
    made.normals = normalsOf(made.vertices, made.triangles, pond.up);
    made.level_vertices = made.vertices.size();
    made.level_triangles = made.triangles.size();
    for (std::uint32_t v = 0; v < made.level_vertices; ++v) {
        made.weld.push_back(v < rim ? above[level.rim[v]] : v);
    }
    const auto first = static_cast<std::uint32_t>(made.level_vertices);
    const std::vector<Vec3> normals = normalsOf(base.vertices, base.triangles, -1.0 * pond.up);
    std::vector<bool> is_open(base.vertices.size());
    for (const auto& [from, to] : open) {
        is_open[from] = true;
    }
    for (std::uint32_t v = 0; v < base.vertices.size(); ++v) {
        made.vertices.push_back(base.vertices[v]);
        made.normals.push_back(normals[v]);
        made.weld.push_back(is_open[v] && base.is_rim[v] ? above[v] : first + v);
    }
    for (const auto& [a, b, c] : base.triangles) {
        made.triangles.push_back({first + a, first + b, first + c});
    }
    // Where the ground ends below the level, the liquid has a wall.
    for (const auto& [from, to] : open) {
        if (!base.is_rim[from]) {
            made.triangles.push_back({first + to, first + from, above[from]});
        }
        if (!base.is_rim[to]) {
            made.triangles.push_back({first + to, above[from], above[to]});
        }
    }
    return made;
}

}  // namespace droplet
