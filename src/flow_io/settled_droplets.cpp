// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow_io/settled_droplets.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <utility>

#include "droplet/flow_io/droplet_surfaces.h"
#include "flow_io/seat.h"

namespace droplet {
namespace {

constexpr double kSkirt = 0.08;  // depth of the extended rim, over the droplet's mean radius

using Edge = std::array<std::uint32_t, 2>;

/// Edges of an open mesh's rim, in the direction of their triangles.
std::vector<Edge> rimOf(std::span<const Triangle> triangles)
{
    std::map<Edge, int> sides;
    for (const Triangle& t : triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            ++sides[{t[k], t[(k + 1) % 3]}];
        }
    }
    std::vector<Edge> rim;
    for (const auto& [edge, count] : sides) {
        if (!sides.contains({edge[1], edge[0]})) {
            rim.push_back(edge);
        }
    }
    return rim;
}

/// Base of a droplet.
DropletBase baseOf(const DropletFrame& frame, const FlatDroplet& droplet)
{
    DropletBase base;
    Vec2 low{1e300, 1e300};
    Vec2 high{-1e300, -1e300};
    for (std::size_t v = 0; v < droplet.vertices.size(); ++v) {
        const Vec3 d = droplet.vertices[v] - frame.place;
        base.height = std::max(base.height, dot(d, frame.normal));
        if (v < droplet.rim) {
            const Vec2 p{dot(d, frame.ahead), dot(d, frame.left)};
            low = {std::min(low.x, p.x), std::min(low.y, p.y)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y)};
        }
    }
    const Vec2 middle = 0.5 * (low + high);
    base.place = frame.place + middle.x * frame.ahead + middle.y * frame.left;
    base.ahead = frame.ahead;
    base.normal = frame.normal;
    base.half_length = 0.5 * (high.x - low.x);
    base.half_width = 0.5 * (high.y - low.y);
    return base;
}

}  // namespace

SettledDroplets settled(const FlowTerrain& terrain, std::span<const FlowSample> samples, const Surface& droplets,
                        const std::vector<bool>& is_shown)
{
    SettledDroplets made;
    std::vector<std::size_t> shown;
    for (std::size_t d = 0; d < samples.size(); ++d) {
        if (is_shown[d]) {
            shown.push_back(d);
        }
    }
    made.surface.mean_height = droplets.mean_height;
    if (shown.empty()) {
        return made;
    }
    const std::size_t vertex_count = droplets.vertices.size() / samples.size();
    const std::size_t triangles = droplets.triangles.size() / samples.size();
    const std::span<const Triangle> one = std::span(droplets.triangles).first(triangles);
    const std::vector<Edge> rim = rimOf(one);
    std::vector<std::uint32_t> rim_vertices;
    std::vector<std::uint32_t> lowered(vertex_count);  // copies of them below the rim
    for (const Edge& edge : rim) {
        lowered[edge[0]] = static_cast<std::uint32_t>(vertex_count + rim_vertices.size());
        rim_vertices.push_back(edge[0]);
    }
    const std::size_t all = vertex_count + rim_vertices.size();
    Surface& surface = made.surface;
    surface.vertices.resize(all * shown.size());
    surface.normals.resize(surface.vertices.size());
    surface.uvs.resize(surface.vertices.size());
    surface.weld.resize(surface.vertices.size());
    std::iota(surface.weld.begin(), surface.weld.end(), std::uint32_t{0});
    std::vector<DropletBase> bases(shown.size());
    tbb::parallel_for(std::size_t{0}, shown.size(), [&](std::size_t i) {
        const FlowSample& sample = samples[shown[i]];
        const std::size_t from = shown[i] * vertex_count;
        const std::span<Vec3> vertices = std::span(surface.vertices).subspan(i * all, all);
        const std::span<Vec3> normals = std::span(surface.normals).subspan(i * all, all);
        std::copy_n(droplets.vertices.begin() + static_cast<std::ptrdiff_t>(from), vertex_count, vertices.begin());
        std::copy_n(droplets.normals.begin() + static_cast<std::ptrdiff_t>(from), vertex_count, normals.begin());
        double depth = 0.0;
        const DropletFrame frame = frameOf(sample, {});
        if (sample.contact != FlowContact::Air) {
            const FlatDroplet flat{vertices.first(vertex_count), normals.first(vertex_count), one, rim_vertices.size()};
            const double height = baseOf(frame, flat).height;
            seat(terrain, frame, flat);
            bases[i] = baseOf(frame, flat);
            bases[i].height = height;
            depth = kSkirt * std::sqrt(bases[i].half_length * bases[i].half_width);
        }
        for (std::size_t k = 0; k < rim_vertices.size(); ++k) {
            vertices[vertex_count + k] = vertices[rim_vertices[k]] - depth * frame.normal;
            normals[vertex_count + k] = normals[rim_vertices[k]];
        }
    });
    for (std::size_t i = 0; i < shown.size(); ++i) {
        const auto first = static_cast<std::uint32_t>(i * all);
        const auto from = static_cast<std::uint32_t>(shown[i] * vertex_count);
        for (const auto& [a, b, c] : std::span(droplets.triangles).subspan(shown[i] * triangles, triangles)) {
            surface.triangles.push_back({first + a - from, first + b - from, first + c - from});
        }
        if (samples[shown[i]].contact == FlowContact::Air) {
            continue;
        }
        made.bases.push_back(bases[i]);
        for (const Edge& edge : rim) {
            const std::uint32_t a = first + edge[0];
            const std::uint32_t b = first + edge[1];
            const std::uint32_t c = first + lowered[edge[0]];
            const std::uint32_t d = first + lowered[edge[1]];
            surface.triangles.push_back({b, a, c});
            surface.triangles.push_back({b, c, d});
        }
    }
    return made;
}

}  // namespace droplet
