// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow_io/settled_droplets.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>

#include "droplet/flow_io/droplet_surfaces.h"
#include "flow_io/pond_surface.h"
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

/// A droplet or pond, open at the ground.
struct Part {
    std::vector<Vec3> vertices;
    std::vector<Vec3> normals;
    std::vector<Triangle> triangles;
    std::optional<DropletBase> base;  ///< of a droplet on the ground
};

std::ptrdiff_t toDifference(std::size_t count)
{
    return static_cast<std::ptrdiff_t>(count);
}

/// Way into the ground below all points of a rim to half its thickness; 0 at a sheet, which has none.
/// @param down  unit
/// @param most  longest way
double wayInto(const FlowTerrain& terrain, const Part& part, const std::vector<Edge>& rim, Vec3 down, double most)
{
    constexpr double kOff =
        0.02;  // begin of a ray off the ground, over the longest way: rims are on it but for rounding
    double way = most;
    for (const auto& [from, to] : rim) {
        const auto top = terrain.firstAlong(part.vertices[from] - kOff * most * down, down);
        if (!top) {
            continue;  // the rim is beside the ground
        }
        const auto bottom = terrain.firstAlong(top->place + kOff * most * down, down);
        if (bottom && bottom->face == top->face) {
            continue;  // the object is too large for its numbers
        }
        const bool is_inside = bottom && dot(terrain.surface().faces[bottom->face].normal, down) > 0.0;
        way = std::min(way, is_inside ? 0.5 * length(bottom->place - top->place) : 0.0);
    }
    return way;
}

/// Extends a rim into the ground, if it has a thickness.
/// @param up  from the end to the rim
void extend(const FlowTerrain& terrain, Part& part, const std::vector<Edge>& rim, Vec3 up)
{
    const double most = length(up);
    if (!(most > 0.0)) {
        return;
    }
    const double way = wayInto(terrain, part, rim, (-1.0 / most) * up, most);
    if (!(way > 0.0)) {
        return;
    }
    up = (way / most) * up;
    std::map<std::uint32_t, std::uint32_t> lowered;
    for (const Edge& edge : rim) {
        lowered.emplace(edge[0], static_cast<std::uint32_t>(part.vertices.size()));
        part.vertices.push_back(part.vertices[edge[0]] - up);
        part.normals.push_back(part.normals[edge[0]]);
    }
    for (const auto& [a, b] : rim) {
        part.triangles.push_back({b, a, lowered.at(a)});
        part.triangles.push_back({b, lowered.at(a), lowered.at(b)});
    }
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
    std::vector<Part> parts(shown.size());
    tbb::parallel_for(std::size_t{0}, shown.size(), [&](std::size_t i) {
        const FlowSample& sample = samples[shown[i]];
        Part& part = parts[i];
        if (sample.pond) {
            const PondSurface pond = pondSurface(terrain.surface(), *sample.pond);
            part.vertices.assign(pond.vertices.begin(), pond.vertices.begin() + toDifference(pond.level_vertices));
            part.normals.assign(pond.normals.begin(), pond.normals.begin() + toDifference(pond.level_vertices));
            part.triangles.assign(pond.triangles.begin(), pond.triangles.begin() + toDifference(pond.level_triangles));
            std::vector<Edge> edges;
            for (std::uint32_t v = 0; v < pond.after.size(); ++v) {
                if (pond.after[v] != v) {
                    edges.push_back({v, pond.after[v]});
                }
            }
            extend(terrain, part, edges, kSkirt * std::sqrt(sample.pond->area / std::numbers::pi) * sample.pond->up);
            return;
        }
        const auto from = toDifference(shown[i] * vertex_count);
        part.vertices.assign(droplets.vertices.begin() + from,
                             droplets.vertices.begin() + from + toDifference(vertex_count));
        part.normals.assign(droplets.normals.begin() + from,
                            droplets.normals.begin() + from + toDifference(vertex_count));
        part.triangles.assign(one.begin(), one.end());
        if (sample.contact == FlowContact::Air) {
            return;
        }
        const DropletFrame frame = frameOf(sample, {});
        const FlatDroplet flat{part.vertices, part.normals, one, rim.size()};
        const double height = baseOf(frame, flat).height;
        seat(terrain, frame, flat);
        part.base = baseOf(frame, flat);
        part.base->height = height;
        extend(terrain, part, rim, kSkirt * std::sqrt(part.base->half_length * part.base->half_width) * frame.normal);
    });
    Surface& surface = made.surface;
    for (const Part& part : parts) {
        const auto first = static_cast<std::uint32_t>(surface.vertices.size());
        surface.vertices.insert(surface.vertices.end(), part.vertices.begin(), part.vertices.end());
        surface.normals.insert(surface.normals.end(), part.normals.begin(), part.normals.end());
        for (const auto& [a, b, c] : part.triangles) {
            surface.triangles.push_back({first + a, first + b, first + c});
        }
        if (part.base) {
            made.bases.push_back(*part.base);
        }
    }
    surface.uvs.resize(surface.vertices.size());
    surface.weld.resize(surface.vertices.size());
    std::iota(surface.weld.begin(), surface.weld.end(), std::uint32_t{0});
    return made;
}

}  // namespace droplet
