// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/flow_io/flow_points.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <ostream>
#include <string>

#include "byte_stream.h"
#include "droplet/flow_io/droplet_surfaces.h"
#include "droplet/version.h"
#include "flow_io/unit_bodies.h"

namespace droplet {

std::vector<FlowPoint> flowPoints(std::span<const FlowSample> samples, const FlowTerrain& terrain,
                                  const DropletBodies& bodies, Vec3 gravity)
{
    std::vector<FlowPoint> points;
    points.reserve(samples.size());
    for (const FlowSample& sample : samples) {
        const DropletFrame frame = frameOf(sample, gravity);
        FlowPoint point{sample.id,
                        sample.place,
                        sample.velocity,
                        sample.volume,
                        0.0,
                        1.0,
                        {frame.ahead, frame.left, frame.normal},
                        sample.age,
                        {}};
        if (sample.contact == FlowContact::Air) {
            point.radius = std::cbrt(0.75 * sample.volume / std::numbers::pi);
        } else {
            const Vec2 half = halfSizes(bodies, conditionsOf(sample, gravity));
            point.radius = half.y;
            point.elongation = half.x / half.y;
            point.face = terrain.surface().faces[*sample.face].source;
        }
        points.push_back(point);
    }
    return points;
}

std::array<double, 4> rotationOf(const FlowPoint& point)
{
    Eigen::Matrix3d turned;
    for (int k = 0; k < 3; ++k) {
        const Vec3& axis = point.axes[static_cast<std::size_t>(k)];
        turned.col(k) = Eigen::Vector3d(axis.x, axis.y, axis.z);
    }
    const Eigen::Quaterniond turn(turned);
    const double sign = turn.w() < 0.0 ? -1.0 : 1.0;
    return {sign * turn.x() + 0.0, sign * turn.y() + 0.0, sign * turn.z() + 0.0, sign * turn.w()};
}

std::uint64_t writePointsAsPly(std::span<const FlowPoint> points, std::ostream& out)
{
    ByteStream bytes(out);
    std::string head = std::string("ply\nformat binary_little_endian 1.0\ncomment droplet-shape ") + kVersion +
                       "\nelement vertex " + std::to_string(points.size()) + "\n";
    for (const char* const name :
         {"x", "y", "z", "nx", "ny", "nz", "velocity_x", "velocity_y", "velocity_z", "rotation_x", "rotation_y",
          "rotation_z", "rotation_w", "radius", "elongation", "volume", "age"}) {
        head += std::string("property float ") + name + "\n";
    }
    bytes.text(head + "property uint id\nproperty int face\nend_header\n");
    for (const FlowPoint& point : points) {
        for (const Vec3& v : {point.place, point.axes[2], point.velocity}) {
            bytes.f32(v.x, v.y, v.z);
        }
        const auto [x, y, z, w] = rotationOf(point);
        bytes.f32(x, y, z, w, point.radius, point.elongation, point.volume, point.age);
        constexpr auto kNone = std::numeric_limits<std::uint32_t>::max();  // −1
        bytes.u32(static_cast<std::uint32_t>(point.id), point.face.value_or(kNone));
    }
    return bytes.finish();
}

}  // namespace droplet
