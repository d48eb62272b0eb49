// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "droplet/mesh/planar_mesh.h"
#include "droplet/vector.h"

namespace droplet {

/// Change of a surface from fill 1 to another fill.
struct RefillState {
    double fill = 2.0;           ///< not 1
    std::vector<Vec3> vertices;  ///< change of every position [m]; 0 on rim and base
    std::vector<Vec3> normals;   ///< change of every normal; their sum need not have unit length
};

/// Change of a surface with the amount of liquid. Between neighbouring states, of which fill 1 is one, it is affine in
/// the fill; beyond the last one it goes on as between the last two.
struct Refill {
    double min = 0.0;                 ///< smallest fill, 0 … 1
    double max = 2.0;                 ///< largest fill, at least 1
    std::vector<RefillState> states;  ///< by ascending fill; one is enough where the model is affine in the volume
};

/// Weights of a refill's states at a fill.
/// @return  one per state, of which at most two are not 0
std::vector<double> stateWeights(const Refill& refill, double fill);

/// How the texture coordinates of a surface were found.
enum class TextureMap {
    Projection,  ///< the place below in the picture; nothing leans out over its rim
    Flat,        ///< a surface that leans out is spread over its footprint; every point of the picture occurs once
    Folded,      ///< the place above or below, although something leans out: there the picture repeats
};

/// Vertices and triangles of one droplet in a surface.
struct SurfacePart {
    std::size_t droplet = 0;         ///< number of the droplet, from 0
    std::size_t first_vertex = 0;    ///< index
    std::size_t vertices = 0;        ///< number; triangles of the part have no others
    std::size_t first_triangle = 0;  ///< index
    std::size_t triangles = 0;       ///< number, at least 1
    std::size_t quads = 0;  ///< number of quadrilaterals abcd, whose halves (a, b, c) and (a, c, d) are the first
                            ///< 2 quads of these triangles; files that hold quadrilaterals have them so
    double volume = 0.0;    ///< of the liquid [m³], ≥ 0
    double area = 0.0;      ///< wet area of the footprint [m²], > 0
};

/// Surface of all droplets in space, ready to be written.
///
/// Invariants: all arrays of vertices have one length, but contact_angle may be empty; triangles wind outward; normals
/// have unit length. A vertex that needs two normals, such as on the rim, is stored twice; `weld` maps both copies to
/// the first.
struct Surface {
    std::vector<Vec3> vertices;        ///< vertices [m], z up, the plane at z = 0
    std::vector<Vec3> normals;         ///< one per vertex, unit length, outward
    std::vector<Vec2> uvs;             ///< mask coordinates: (0,0) top left of the image, (1,1) bottom right
    std::vector<float> contact_angle;  ///< at the liquid's vertices on the rim [rad]; 0 at others
    std::vector<Triangle> triangles;   ///< indices of vertices
    std::vector<std::uint32_t> weld;   ///< smallest index of a vertex at the same place; weld[i] ≤ i
    TextureMap texture_map = TextureMap::Projection;  ///< the last in its order of all droplets
    double mean_height = 0.0;                         ///< volume divided by the wet area of the footprint [m], ≥ 0
    std::optional<Refill> refill;                     ///< for a surface that can be filled and drained
    std::vector<SurfacePart> parts;  ///< droplets that have liquid, one after another without gaps; empty if unknown

    /// Checks all invariants that need no topology: there is a triangle, lengths of arrays match, indices are in range,
    /// numbers are finite, normals have unit length to 1e-6, welded copies have one position and one change of it, and
    /// parts, if there are any, cover all vertices and triangles, and their quadrilaterals have halves as stated.
    /// @throws Error InvalidArgument
    void validate() const;
};

/// Copies droplets out of a surface, with their refill.
/// @param surface  valid, with parts
/// @param which    indices of its parts, at least one
/// @return         surface with the parts in that order
/// @throws Error   InvalidArgument
Surface extract(const Surface& surface, const std::vector<std::size_t>& which);

/// Lists the quadrilaterals of a surface.
/// @param surface  valid
/// @return         index of the first half of each, ascending; the other half follows it
std::vector<std::uint32_t> quadrilaterals(const Surface& surface);

/// Joins the triangles of every part to quadrilaterals, two and two, where all corners are between 30° and 150°.
/// Triangles change their order, not their winding.
/// @param surface  valid; without parts it stays as it is
void joinTriangles(Surface& surface);

/// Makes the surface at another fill, as a viewer shows it with the weights of its states.
/// @param surface  valid, with a refill
/// @param fill     from min to max of the refill
/// @return         surface without a refill, and without contact angles, because they are not affine
/// @throws Error   InvalidArgument
Surface refilled(const Surface& surface, double fill);

/// Topology of a surface, with copies of a vertex welded. All numbers are 0 unless it is a manifold.
struct Topology {
    bool manifold = false;           ///< every edge has at most two triangles, wound alike, and every vertex one fan
    bool closed = false;             ///< manifold without a boundary edge
    long euler = 0;                  ///< V − E + F over all components
    std::size_t components = 0;      ///< connected parts
    std::size_t boundary_loops = 0;  ///< closed loops of boundary edges
};

/// Examines the triangles around every vertex.
/// @throws Error InvalidArgument: an invalid surface, or more than 1 431 655 765 triangles
Topology topology(const Surface& surface);

/// Tells whether a surface is a manifold without boundary, faster than topology().
/// @throws Error InvalidArgument as topology
bool isClosed(const Surface& surface);

/// Measures the volume inside a closed surface, by the divergence theorem on z [m³]. For an open surface this is the
/// volume between it and z = 0.
double enclosedVolume(const Surface& surface);

}  // namespace droplet
