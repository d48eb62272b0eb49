// SPDX-License-Identifier: GPL-3.0-or-later
// P. Fournier, A. Habibi, P. Poulin, "Simulating the flow of liquid droplets", Graphics Interface 1998, section 2: the
// neighbourhood graph.
#include "droplet/flow/flow_surface.h"

#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <numeric>
#include <tuple>
#include <utility>

#include "droplet/error.h"
#include "flow/flow_face.h"
#include "surface/half_edges.h"
#include "union_find.h"

namespace droplet {
namespace {

/// Triangles of the mesh with corners at the same place joined, without what droplets cannot stand on.
struct Soup {
    std::vector<Vec3> vertices;
    std::vector<Triangle> triangles;
    std::vector<std::uint32_t> source;
};

double areaOf(const std::array<Vec3, 3>& t)
{
    return 0.5 * length(cross(t[1] - t[0], t[2] - t[0]));
}

Soup soupOf(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles, FlowSurfaceReport& report)
{
    std::vector<std::uint32_t> order(vertices.size());
    std::iota(order.begin(), order.end(), 0U);
    const auto key = [&](std::uint32_t i) { return std::tie(vertices[i].x, vertices[i].y, vertices[i].z); };
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
    Soup soup;
    std::vector<std::uint32_t> place(vertices.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        if (i == 0 || key(order[i - 1]) != key(order[i])) {
            soup.vertices.push_back(vertices[order[i]]);
        }
        place[order[i]] = static_cast<std::uint32_t>(soup.vertices.size() - 1);
    }
    std::vector<std::pair<Triangle, std::uint32_t>> sorted;
    report.triangles = triangles.size();
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        const Triangle joined{place[triangles[t][0]], place[triangles[t][1]], place[triangles[t][2]]};
        const std::array corners{soup.vertices[joined[0]], soup.vertices[joined[1]], soup.vertices[joined[2]]};
        const double longest = std::max(
            {length(corners[1] - corners[0]), length(corners[2] - corners[1]), length(corners[0] - corners[2])});
        // Thinner than the rounding of its corners: it has no direction.
        if (!(areaOf(corners) > 1e-12 * longest * longest)) {
            ++report.without_area;
            continue;
        }
        Triangle ascending = joined;
        std::sort(ascending.begin(), ascending.end());
        sorted.emplace_back(ascending, t);
        soup.triangles.push_back(joined);
        soup.source.push_back(t);
    }
    std::sort(sorted.begin(), sorted.end());
    std::vector<bool> repeated(triangles.size(), false);
    for (std::size_t i = 1; i < sorted.size(); ++i) {
        repeated[sorted[i].second] = sorted[i].first == sorted[i - 1].first;
    }
    std::size_t kept = 0;
    for (std::size_t i = 0; i < soup.triangles.size(); ++i) {
        if (repeated[soup.source[i]]) {
            ++report.duplicates;
            continue;
        }
        soup.triangles[kept] = soup.triangles[i];
        soup.source[kept++] = soup.source[i];
    }
    soup.triangles.resize(kept);
    soup.source.resize(kept);
    return soup;
}

/// Turns triangles so that neighbours agree; a vertex where parts touch is doubled.
void orient(Soup& soup)
{
    using Kernel = CGAL::Simple_cartesian<double>;
    std::vector<Kernel::Point_3> points;
    points.reserve(soup.vertices.size());
    for (const Vec3 p : soup.vertices) {
        points.emplace_back(p.x, p.y, p.z);
    }
    std::vector<std::array<std::size_t, 3>> polygons;
    polygons.reserve(soup.triangles.size());
    for (const auto& [a, b, c] : soup.triangles) {
        polygons.push_back({a, b, c});
    }
    CGAL::Polygon_mesh_processing::orient_polygon_soup(points, polygons);
    soup.vertices.resize(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        soup.vertices[i] = {points[i].x(), points[i].y(), points[i].z()};
    }
    for (std::size_t t = 0; t < polygons.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            soup.triangles[t][k] = static_cast<std::uint32_t>(polygons[t][k]);
        }
    }
}

/// Solid angle of a triangle (A. van Oosterom, J. Strackee, IEEE Trans. Biomed. Eng. 30 (1983) 125).
double solidAngle(const Soup& soup, std::uint32_t t, Vec3 from)
{
    const Vec3 a = soup.vertices[soup.triangles[t][0]] - from;
    const Vec3 b = soup.vertices[soup.triangles[t][1]] - from;
    const Vec3 c = soup.vertices[soup.triangles[t][2]] - from;
    const double la = length(a);
    const double lb = length(b);
    const double lc = length(c);
    return 2.0 * std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
}

/// Closed parts that were inside out in the mesh and lie in another closed part: the inner sides of hollow things.
/// @param volume  of a part as it was in the mesh, times any factor; 0 if it is not closed
std::vector<bool> cavitiesOf(const Soup& soup, UnionFind& joined, const std::function<double(std::uint32_t)>& volume)
{
    std::vector<bool> is_cavity(soup.triangles.size());
    std::vector<std::uint32_t> closed;
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
        if (joined.find(t) == t && volume(t) != 0.0) {
            closed.push_back(t);
        }
    }
    constexpr std::size_t kMaxParts = 64;  // pairs of parts are compared
    if (closed.size() < 2 || closed.size() > kMaxParts) {
        return is_cavity;
    }
    for (const std::uint32_t inner : closed) {
        if (volume(inner) > 0.0) {
            continue;
        }
        const Vec3 place = soup.vertices[soup.triangles[inner][0]];
        std::map<std::uint32_t, double> angles;  // solid angles of the parts that face outward, as seen from there
        for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
            const std::uint32_t part = joined.find(t);
            if (part != inner && volume(part) > 0.0) {
                angles[part] += solidAngle(soup, t, place);
            }
        }
        is_cavity[inner] = std::any_of(angles.begin(), angles.end(), [](const auto& entry) {
            return std::abs(entry.second) > 2.0 * std::numbers::pi;
        });
    }
    return is_cavity;
}

/// A part that is closed faces outward, unless it is a cavity; any other as most of its area did in the mesh.
void faceOutward(Soup& soup, const std::vector<bool>& was_turned, FlowSurfaceReport& report)
{
    const HalfEdges half_edges = halfEdges(soup.vertices, soup.triangles);
    UnionFind joined = joinedAcrossEdges(half_edges, soup.triangles);
    struct Part {
        double volume = 0.0;  // six times it
        double turned = 0.0;  // area that was turned, less area that was not
        bool is_closed = true;
    };
    std::vector<Part> parts(soup.triangles.size());
    std::vector<std::uint8_t> open_sides(soup.triangles.size(), 3);
    const auto& mesh = half_edges.mesh;
    for (const auto h : mesh.halfedges()) {
        if (mesh.face_handle(h).is_valid() && mesh.opposite_face_handle(h).is_valid()) {
            --open_sides[half_edges.triangles[static_cast<std::size_t>(mesh.face_handle(h).idx())]];
        }
    }
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
        const auto& [a, b, c] = soup.triangles[t];
        const Vec3 facet = cross(soup.vertices[b] - soup.vertices[a], soup.vertices[c] - soup.vertices[a]);
        Part& part = parts[joined.find(t)];
        part.volume += dot(soup.vertices[a], facet);
        part.turned += was_turned[t] ? length(facet) : -length(facet);
        part.is_closed = part.is_closed && open_sides[t] == 0;
    }
    const std::vector<bool> is_cavity = cavitiesOf(soup, joined, [&](std::uint32_t part) {
        return parts[part].is_closed ? parts[part].volume * (parts[part].turned > 0.0 ? -1.0 : 1.0) : 0.0;
    });
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
        const std::uint32_t root = joined.find(t);
        report.parts += root == t ? 1 : 0;
        const bool turns =
            parts[root].is_closed && !is_cavity[root] ? parts[root].volume < 0.0 : parts[root].turned > 0.0;
        if (turns) {
            std::swap(soup.triangles[t][1], soup.triangles[t][2]);
        }
        // Of a part that was mostly right, single triangles are turned; else it was inside out.
        const bool is_turned = was_turned[t] != turns;
        report.turned += is_turned ? 1 : 0;
        report.inside_out += is_turned && parts[root].is_closed && turns == (parts[root].turned <= 0.0) ? 1 : 0;
    }
}

/// Whether a triangle's winding is another than before; where vertices were doubled, by their places.
bool isTurned(const Soup& soup, const Triangle& before, const Triangle& after)
{
    const auto is_same = [&](std::uint32_t a, std::uint32_t b) { return soup.vertices[a] == soup.vertices[b]; };
    for (std::size_t k = 0; k < 3; ++k) {
        if (is_same(before[0], after[k])) {
            return !is_same(before[1], after[(k + 1) % 3]);
        }
    }
    return false;
}

FlowSurface::Face faceOf(const Soup& soup, std::size_t t)
{
    FlowSurface::Face face;
    const auto& [a, b, c] = soup.triangles[t];
    setCorners(face, {soup.vertices[a], soup.vertices[b], soup.vertices[c]});
    face.neighbour.fill(FlowSurface::kNone);
    face.source = soup.source[t];
    return face;
}

}  // namespace

FlowSurface flowSurface(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles)
{
    FlowSurface surface;
    Soup soup = soupOf(vertices, triangles, surface.report);
    if (soup.triangles.empty()) {
        throw Error(ErrorCode::InvalidInput, "the mesh has no triangle with an area");
    }
    const std::vector<Triangle> before = soup.triangles;
    orient(soup);
    std::vector<bool> was_turned(before.size());
    for (std::size_t t = 0; t < before.size(); ++t) {
        was_turned[t] = isTurned(soup, before[t], soup.triangles[t]);
    }
    faceOutward(soup, was_turned, surface.report);
    const HalfEdges half_edges = halfEdges(soup.vertices, soup.triangles);
    const auto& mesh = half_edges.mesh;
    for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
        surface.faces.push_back(faceOf(soup, t));
    }
    for (const auto h : mesh.halfedges()) {
        const auto inside = mesh.face_handle(h);
        if (!inside.is_valid()) {
            continue;
        }
        const std::uint32_t t = half_edges.triangles[static_cast<std::size_t>(inside.idx())];
        FlowSurface::Face& face = surface.faces[t];
        const auto from = mesh.point(mesh.from_vertex_handle(h));
        std::size_t k = 0;
        while (!(face.corners[k] == Vec3{from[0], from[1], from[2]})) {
            ++k;
        }
        const auto beyond = mesh.opposite_face_handle(h);
        if (beyond.is_valid()) {
            face.neighbour[k] = half_edges.triangles[static_cast<std::size_t>(beyond.idx())];
        } else {
            ++surface.report.boundary_edges;
        }
    }
    return surface;
}

}  // namespace droplet
