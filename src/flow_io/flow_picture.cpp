// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/flow_io/flow_picture.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "droplet/flow_io/droplet_surfaces.h"

namespace droplet {
namespace {

// The frame reaches so much of the object's size beyond it.
constexpr double kMargin = 0.05;
// The rim of a droplet is drawn so much of its radius below the tangent plane, so that it is under a curved surface.
constexpr double kBelow = 0.25;

/// Moves the rims of droplets below the surface.
void sinkRims(Surface& surface, std::span<const FlowSample> samples, const DropletBodies& bodies)
{
    const std::size_t rim = bodies.rimVertices();
    for (std::size_t i = 0; i < samples.size(); ++i) {
        if (samples[i].contact == FlowContact::Air) {
            continue;
        }
        const std::size_t first = i * bodies.vertices();
        const double width = length(surface.positions[first] - surface.positions[first + rim / 2]);
        for (std::size_t k = first; k < first + rim; ++k) {
            surface.positions[k] = surface.positions[k] - (0.5 * kBelow * width) * samples[i].normal;
        }
    }
}

}  // namespace

FlowView::FlowView(const FlowObject& object, const DropletBodies& bodies) : bodies_(bodies)
{
    stand_.positions = object.positions;
    stand_.normals = object.normals;
    stand_.uvs = object.uvs;
    stand_.uvs.resize(object.positions.size());
    stand_.triangles = object.triangles;
    Vec3 low = object.positions.front();
    Vec3 high = low;
    for (const Vec3& p : object.positions) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    const double margin = kMargin * std::max({high.x - low.x, high.y - low.y, high.z - low.z});
    const Vec3 around{margin, margin, margin};
    box_ = {low - around, high + around};
}

Picture FlowView::draw(std::span<const FlowSample> samples, const FlowPictureOptions& options) const
{
    std::vector<FlowSample> shown;
    for (const FlowSample& sample : samples) {
        const Vec3& p = sample.place;
        if (p.x > box_.low.x && p.x < box_.high.x && p.y > box_.low.y && p.y < box_.high.y && p.z > box_.low.z &&
            p.z < box_.high.z) {
            shown.push_back(sample);
        }
    }
    Surface surface = dropletSurfaces(shown, bodies_, options.gravity);
    sinkRims(surface, shown, bodies_);
    RenderOptions render = options.render;
    render.stand = stand_;
    render.shows_whole_stand = true;
    render.framed = around(surface, box_);
    return droplet::render(surface, render);
}

}  // namespace droplet
