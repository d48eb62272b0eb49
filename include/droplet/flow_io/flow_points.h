// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <iosfwd>
#include <optional>
#include <span>
#include <vector>

#include "droplet/body/droplet_body.h"
#include "droplet/flow/flow.h"
#include "droplet/flow/flow_terrain.h"
#include "droplet/scene/format.h"
#include "droplet/surface/material.h"
#include "droplet/units.h"
#include "droplet/vector.h"

namespace droplet {

/// A droplet as a point with what instances of a unit droplet need.
struct FlowPoint {
    std::uint64_t id = 0;               ///< of the droplet
    Vec3 place;                         ///< on the surface, or the centre in the air [m]
    Vec3 velocity;                      ///< with that of ground that deforms [m/s]
    double volume = 0.0;                ///< [m³]
    double radius = 0.0;                ///< half the width, from above, or of the ball in the air; of a pond, that of a
                                        ///< circle with the area of its level [m]
    double elongation = 1.0;            ///< length over width, ≥ 1 for most
    std::array<Vec3, 3> axes;           ///< ahead, to the left, and the ground's normal; unit
    double age = 0.0;                   ///< [s]
    std::optional<std::uint32_t> face;  ///< number of the triangle in the object's mesh; empty in the air
};

/// Points of droplets, in the order of the samples, in the object's frame.
/// @param samples  of sampleFlow()
/// @param terrain  below them
/// @param bodies   their shapes
/// @param gravity  in the object's frame [m/s²]
std::vector<FlowPoint> flowPoints(std::span<const FlowSample> samples, const FlowTerrain& terrain,
                                  const DropletBodies& bodies, Vec3 gravity);

/// Writes points as PLY, binary: x, y, z, the normal nx, ny, nz, velocity_x, velocity_y, velocity_z, the quaternion
/// rotation_x, rotation_y, rotation_z, rotation_w that turns x ahead and z to the normal, radius, elongation, volume,
/// age, all as floats in SI units, and id and face as integers, face −1 in the air, ids modulo 2³².
/// The stream is in a failed state if a write failed.
/// @param points  in the axes of the file
/// @param out     takes the bytes
/// @return        number of bytes
std::uint64_t writePointsAsPly(std::span<const FlowPoint> points, std::ostream& out);

/// Options of writePointsAsUsd().
struct UsdPointsOptions {
    double frames_per_second = 30.0;      ///< > 0
    Material material = Material::Water;  ///< of the prototypes
    double gravity = kStandardGravity;    ///< that shapes the prototypes [m/s²] ≥ 0

    /// Checks all fields.
    /// @throws Error InvalidArgument if a field is out of its range
    void validate() const;
};

/// Writes points over time as USD, metres and +Y up: a PointInstancer `/droplet/droplets` with a time sample for every
/// frame from 0 on.
///
/// Its prototypes are three droplets: at rest, on the way, whose +X is ahead, and in the air; +Y is off the ground.
/// `scales` stretch them to the length, width and volume of each droplet, so their volume times the three factors is
/// `volume`. `ids` are those of the points modulo 2⁶⁴, signed. `velocities` are in m/s and `angularVelocities`, which
/// lead to the next frame, in degrees/s; primvars are age, elongation, radius and volume, in SI units.
///
/// Guarantees: the same points give the same bytes; the stream is in a failed state if a write failed.
/// @param frames   points of every frame, z up; at least one frame
/// @param bodies   shapes of the droplets
/// @param options  frame rate, look, gravity
/// @param out      takes the bytes
/// @param format   Usda or Usdz
/// @return         number of bytes
/// @throws Error InvalidArgument if an option is out of its range, there is no frame, the format is another one, a
///               number does not fit into a float, or a package would reach 4 GiB
std::uint64_t writePointsAsUsd(std::span<const std::vector<FlowPoint>> frames, const DropletBodies& bodies,
                               const UsdPointsOptions& options, std::ostream& out, Format format);

/// A quaternion (x, y, z, w) that turns the x, y and z axes to a point's axes; w ≥ 0.
std::array<double, 4> rotationOf(const FlowPoint& point);

}  // namespace droplet
