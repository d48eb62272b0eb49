// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "droplet/flow/flow.h"
#include "droplet/flow/flow_surface.h"
#include "droplet/flow/flow_terrain.h"
#include "droplet/mesh/planar_mesh.h"
#include "droplet/vector.h"

namespace droplet {

/// Shapes of a surface that deforms, one for every frame of a film: its faces and their neighbours stay, their corners
/// move.
///
/// Shape k is that of the surface at the time k / frames_per_second. Droplets run over it in the steps whose middle is
/// nearer to this time than to that of another shape; then they follow their faces to the next one. Makes a terrain
/// when it is asked for, and remembers the last ones; so it serves one thread at a time.
class FlowShapes {
public:
    /// A surface with one shape at all times.
    explicit FlowShapes(FlowSurface surface);
    /// A surface that deforms.
    /// @param surface            of the first shape, made of `triangles` with flowSurface() and refined()
    /// @param triangles          of the mesh, which name vertices
    /// @param vertices           of the mesh in every shape [m]; at least one shape, all of one size
    /// @param frames_per_second  > 0
    /// @throws Error  InvalidArgument if a size differs; InvalidInput if a triangle of the surface has no area in a
    ///                shape
    FlowShapes(FlowSurface surface, std::vector<Triangle> triangles, std::vector<std::vector<Vec3>> vertices,
               double frames_per_second);

    /// Number of shapes.
    [[nodiscard]] std::size_t count() const { return vertices_.empty() ? 1 : vertices_.size(); }
    /// The first shape.
    [[nodiscard]] const FlowTerrain& first() const { return *first_; }
    /// A shape.
    /// @param shape  < count()
    [[nodiscard]] std::shared_ptr<const FlowTerrain> at(std::size_t shape);
    /// A face in a shape. Many threads may call it at once.
    /// @param shape  < count()
    /// @param face   number in FlowSurface::faces
    [[nodiscard]] FlowSurface::Face faceAt(std::size_t shape, std::uint32_t face) const;
    /// Vertices of the mesh in a shape, if it deforms [m].
    /// @param shape  < count()
    [[nodiscard]] const std::vector<Vec3>& vertices(std::size_t shape) const { return vertices_[shape]; }
    /// Shape over which droplets run in a step.
    /// @param step     number of the step
    /// @param seconds  FlowParameters::step [s]
    [[nodiscard]] std::size_t ofStep(std::uint64_t step, double seconds) const;
    /// Shape that the samples of a state are on.
    /// @param state    made with these shapes
    /// @param seconds  FlowParameters::step [s]
    [[nodiscard]] std::size_t of(const FlowState& state, double seconds) const;

private:
    [[nodiscard]] std::vector<std::array<Vec3, 3>> cornersAt(std::size_t shape) const;
    [[nodiscard]] GroundMotion motionAt(std::size_t shape) const;

    std::vector<Triangle> triangles_;
    std::vector<std::vector<Vec3>> vertices_;  // empty: there is one shape
    double frames_per_second_ = 0.0;
    std::vector<std::array<std::array<double, 3>, 3>> weights_;  // of the mesh's corners, for the corners of each face
    std::shared_ptr<const FlowSurface> rest_;                    // of the first shape
    std::shared_ptr<const FlowTerrain> first_;
    std::vector<std::pair<std::size_t, std::shared_ptr<const FlowTerrain>>> last_;
};

/// Advances a state as advanceFlow() does on one terrain. Between shapes, droplets that touch the surface keep their
/// place on their face and their velocity turns with it; in steps they feel the acceleration of the ground. Droplets in
/// the air keep their way in space.
///
/// Guarantees: those of advanceFlow(); of shapes that are all the same, it gives the same bytes.
/// @param state       made with shapes.first() and the same parameters
/// @param shapes      of the surface
/// @param parameters  of the simulation; its motion rests, and its step is at most the time between shapes
/// @param until       [s], ≥ state.time
/// @return            its tracks are on the first shape
/// @throws Error      InvalidArgument
FlowState advanceFlow(FlowState state, FlowShapes& shapes, const FlowParameters& parameters, double until);

/// All droplets at the state's time, on the shape FlowShapes::of(), in the order of their ids. Velocities are those
/// along the surface, and in the air those in space.
/// @param state       as advanceFlow() left it
/// @param shapes      of the surface
/// @param parameters  of the simulation
std::vector<FlowSample> sampleFlow(const FlowState& state, FlowShapes& shapes, const FlowParameters& parameters);

}  // namespace droplet
