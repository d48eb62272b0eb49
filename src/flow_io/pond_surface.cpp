// SPDX-License-Identifier: GPL-3.0-or-later
//
// The ground's triangles are cut at the level; what is below it is the base, and the loops of its open edges are the
// rim. The level is the triangulation of these loops. A dome over it is the linear capillary surface with that rim, u −
// λ² Δu = const, scaled to its volume: as a puddle's, it is flat but for some capillary lengths λ along the rim.
#include "flow_io/pond_surface.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>

#include "droplet/error.h"
#include "droplet/mesh/triangulate.h"

namespace droplet {
namespace {

using Edge = std::array<std::uint32_t, 2>;
using Key = std::array<double, 6>;

Key keyOf(Vec3 a, Vec3 b)
{
    return {a.x, a.y, a.z, b.x, b.y, b.z};
}

/// The ground below the level.
class Base {
public:
    Base(std::span<const FlowSurface::Face> ground, const Pond& pond) : up_(pond.up), level_(pond.level)
    {
        for (const FlowSurface::Face& face : ground) {
            add(face);
        }
    }

    std::vector<Vec3> vertices;
    std::vector<Triangle> triangles;
    std::vector<bool> is_level;  ///< whether a vertex is on the level

private:
    [[nodiscard]] double heightOf(Vec3 p) const { return dot(up_, p) - level_; }

    std::uint32_t vertexAt(const Key& key, Vec3 place, bool on_level)
    {
        const auto [at, is_new] = numbers_.try_emplace(key, static_cast<std::uint32_t>(vertices.size()));
        if (is_new) {
            // Crossings near a corner may be one place.
            const Vec3 p = on_level ? place - heightOf(place) * up_ : place;
            at->second = places_.try_emplace({p.x, p.y, p.z}, at->second).first->second;
            if (at->second == vertices.size()) {
                vertices.push_back(p);
                is_level.push_back(on_level);
            }
        }
        return at->second;
    }

    /// Where an edge passes the level: the same from both sides.
    std::uint32_t crossing(Vec3 below, Vec3 above)
    {
        const double low = heightOf(below);
        return vertexAt(keyOf(below, above), below + low / (low - heightOf(above)) * (above - below), true);
    }

    void add(const FlowSurface::Face& face)
    {
        std::vector<std::uint32_t> polygon;
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 a = face.corners[k];
            const Vec3 b = face.corners[(k + 1) % 3];
            const bool has_a = heightOf(a) <= 0.0;
            const bool has_b = heightOf(b) <= 0.0;
            if (has_a) {
                polygon.push_back(vertexAt(keyOf(a, a), a, heightOf(a) == 0.0));
            }
            if (has_a && heightOf(a) < 0.0 && !has_b) {
                polygon.push_back(crossing(a, b));
            } else if (!has_a && has_b && heightOf(b) < 0.0) {
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

    Vec3 up_;
    double level_;
    std::map<Key, std::uint32_t> numbers_;
    std::map<std::array<double, 3>, std::uint32_t> places_;
};

/// Edges without a neighbour, in the direction of their triangles.
std::vector<Edge> openEdges(const std::vector<Triangle>& triangles)
{
    std::map<Edge, int> sides;
    for (const Triangle& t : triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            ++sides[{t[k], t[(k + 1) % 3]}];
        }
    }
    std::vector<Edge> open;
    for (const auto& [edge, count] : sides) {
        if (!sides.contains({edge[1], edge[0]})) {
            open.push_back(edge);
        }
    }
    return open;
}

/// Loops of edges, against their direction: as the triangles on the other side have them.
std::vector<std::vector<std::uint32_t>> loopsOf(const std::vector<Edge>& edges)
{
    std::multimap<std::uint32_t, std::uint32_t> next;
    for (const auto& [from, to] : edges) {
        next.emplace(to, from);
    }
    std::vector<std::vector<std::uint32_t>> loops;
    while (!next.empty()) {
        std::vector<std::uint32_t> loop{next.begin()->first};
        for (auto at = next.begin(); at != next.end(); at = next.find(loop.back())) {
            const std::uint32_t to = at->second;
            next.erase(at);
            // Loops that touch in a vertex are several.
            if (const auto met = std::find(loop.begin(), loop.end(), to); met != loop.end()) {
                loops.emplace_back(met, loop.end());
                loop.erase(met + 1, loop.end());
                if (loop.size() == 1) {
                    break;
                }
            } else {
                loop.push_back(to);
            }
        }
    }
    return loops;
}

/// Heights of a dome of a volume over a mesh, 0 on its rim.
std::vector<double> domeOver(const PlanarMesh& mesh, double bending, double volume)
{
    const std::uint32_t rim = mesh.rimVertexCount();
    const auto inner = static_cast<Eigen::Index>(mesh.vertices.size() - rim);
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::VectorXd share = Eigen::VectorXd::Zero(inner);  // of the area, that a vertex stands for
    for (const Triangle& t : mesh.triangles) {
        const double area = 0.5 * doubleArea(mesh, t);
        if (!(area > 0.0)) {
            continue;
        }
        for (std::size_t i = 0; i < 3; ++i) {
            if (t[i] < rim) {
                continue;
            }
            share[t[i] - rim] += area / 3.0;
            const Vec2 a = mesh.vertices[t[(i + 2) % 3]] - mesh.vertices[t[(i + 1) % 3]];
            for (std::size_t j = 0; j < 3; ++j) {
                if (t[j] >= rim) {
                    const Vec2 b = mesh.vertices[t[(j + 2) % 3]] - mesh.vertices[t[(j + 1) % 3]];
                    const double mass = i == j ? area / 3.0 : 0.0;
                    entries.emplace_back(t[i] - rim, t[j] - rim, bending * bending * dot(a, b) / (4.0 * area) + mass);
                }
            }
        }
    }
    std::vector<double> heights(mesh.vertices.size());
    Eigen::SparseMatrix<double> matrix(inner, inner);
    matrix.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(matrix);
    if (inner == 0 || factor.info() != Eigen::Success) {
        return heights;
    }
    const Eigen::VectorXd solved = factor.solve(share);
    const double held = solved.dot(share);
    for (Eigen::Index i = 0; i < inner && held > 0.0; ++i) {
        heights[static_cast<std::size_t>(i) + rim] = volume / held * solved[i];
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
    [[nodiscard]] bool meets(const std::vector<Edge>& open) const
    {
        std::vector<Edge> own;
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
Level projected(const Base& base, const Pond& pond)
{
    Level level;
    for (std::uint32_t v = 0; v < base.vertices.size(); ++v) {
        const Vec3 p = base.vertices[v];
        level.vertices.push_back(p + (pond.level - dot(pond.up, p)) * pond.up);
        level.rim.push_back(v);
        level.after.push_back(v);
    }
    for (const auto& [a, b, c] : base.triangles) {
        level.triangles.push_back({a, c, b});
    }
    return level;
}

/// Triangulation of the loops of the rim, with the dome.
Level levelOver(const Base& base, const std::vector<Edge>& open, const Pond& pond)
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
    const double size = std::sqrt(pond.area);
    const double edge = std::max(std::min(pond.bending / kAcrossBend, size / kLeastAcross), size / kMostAcross);
    PlanarMesh mesh;
    try {
        mesh = cover(outline, pond.dome > 0.0 ? std::optional(edge) : std::nullopt);
    } catch (const Error&) {  // loops touch or cross
        return level;
    }
    const std::vector<double> heights =
        pond.dome > 0.0 ? domeOver(mesh, pond.bending, pond.dome) : std::vector<double>(mesh.vertices.size());
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
        const Vec2 p = mesh.vertices[v];
        level.vertices.push_back(origin + p.x * ahead + p.y * left + heights[v] * pond.up);
    }
    for (std::size_t v = 0; v < level.rim.size(); ++v) {
        if (base.is_level[level.rim[v]]) {
            level.vertices[v] = base.vertices[level.rim[v]];
        }
    }
    level.triangles = mesh.triangles;
    return level;
}

Vec3 unit(Vec3 v, Vec3 otherwise)
{
    const double size = length(v);
    return size > 0.0 ? (1.0 / size) * v : otherwise;
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
    const std::vector<Edge> open = openEdges(base.triangles);
    Level level = levelOver(base, open, pond);
    if (!level.meets(open)) {
        level = projected(base, pond);
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
        made.weld.push_back(is_open[v] && base.is_level[v] ? above[v] : first + v);
    }
    for (const auto& [a, b, c] : base.triangles) {
        made.triangles.push_back({first + a, first + b, first + c});
    }
    // Where the ground ends below the level, the liquid has a wall.
    for (const auto& [from, to] : open) {
        if (!base.is_level[from]) {
            made.triangles.push_back({first + to, first + from, above[from]});
        }
        if (!base.is_level[to]) {
            made.triangles.push_back({first + to, above[from], above[to]});
        }
    }
    return made;
}

}  // namespace droplet
