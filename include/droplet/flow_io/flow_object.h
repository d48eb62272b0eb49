// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "droplet/flow/flow_surface.h"
#include "droplet/flow/object_motion.h"
#include "droplet/io/object.h"
#include "droplet/mesh/planar_mesh.h"
#include "droplet/render/object_stand.h"
#include "droplet/render/stand_look.h"
#include "droplet/vector.h"

namespace droplet {

/// Object that droplets run over.
///
/// Invariants: numbers are finite; indices are in range; arrays of vertices have one length, but uvs may be empty.
struct FlowObject {
    std::vector<Vec3> vertices;       ///< vertices [m], z up
    std::vector<Vec3> normals;        ///< one per vertex, unit, outward
    std::vector<Vec2> uvs;            ///< one per vertex, (0,0) top left of the texture; or empty
    std::vector<double> weights;      ///< of every vertex, 0 … 1, if asked for and the file has them; or empty
    std::vector<Vec3> colours;        ///< one per vertex, linear, 0 … 1, which multiply those of the looks; or empty
    std::vector<Triangle> triangles;  ///< indices of vertices
    std::vector<std::uint32_t> materials;     ///< index of every triangle's material in material_names; or empty
    std::vector<std::string> material_names;  ///< from the file
    std::vector<StandLook> looks;             ///< of every material; or empty: the object is plain
    std::vector<LookImages> images;           ///< of every look
    ObjectMotion motion;                      ///< from the animation of the object's node, if the file has one
    std::vector<std::string> warnings;        ///< one line each
};

/// Object that deforms.
struct DeformingObject {
    FlowObject object;                        ///< in the first shape
    std::vector<std::vector<Vec3>> vertices;  ///< its vertices in every shape [m]
};

/// Turns triangles and normals of an object to the side to which the faces of its surface look.
/// @param surface  of the object
/// @param object   the surface's mesh
void faceAs(const FlowSurface& surface, FlowObject& object);

/// Edges of the box around an object's vertices [m].
Vec3 sizeOf(const FlowObject& object);

/// Reads an object: .glb, .gltf, .obj, .ply, .stl, with texture coordinates or without.
/// @throws Error InvalidArgument for an unknown extension; InvalidInput, naming the file: it cannot be read, is
///               damaged, has no triangle with an area, numbers that are not finite, or is too small or too large to
///               compute with
FlowObject readFlowObject(const std::filesystem::path& path, const ObjectOptions& options = {});

/// Reads the shapes of an object, a file for each. Their triangles are the same; only the first file's normals,
/// texture coordinates and materials count, and its size for ObjectOptions::size.
/// @param paths   at least one
/// @param options  of all
/// @throws Error  as readFlowObject(); InvalidInput, naming the file, if its triangles are not those of the first
DeformingObject readDeformingObject(const std::vector<std::string>& paths, const ObjectOptions& options = {});

/// Frames of a film at which an animated object is read, from time 0 on.
struct ObjectSampling {
    double frames_per_second = 30.0;            ///< > 0
    std::optional<std::size_t> frames = {};     ///< number of shapes; empty: all up to the animation's last key
    std::optional<std::string> animation = {};  ///< name; empty: the first that moves the object
};

/// Reads an object with the shapes that an animation of its file gives it: nodes that move apart, scales, skins, morph
/// targets. An animation that moves the object as a whole stays FlowObject::motion, and the object has one shape.
///
/// Shapes are exact at the frames. After its last key an animation that ends as it begins, to a thousandth of the
/// object's size, is repeated; any other leaves the object as it is. The object's size for ObjectOptions::size is
/// that at time 0.
/// @param path      .glb or .gltf; other files have no animation
/// @param sampling  frames
/// @param options   of the object
/// @throws Error    as readFlowObject(); InvalidInput if there is no animation of this name
DeformingObject readAnimatedObject(const std::filesystem::path& path, const ObjectSampling& sampling,
                                   const ObjectOptions& options = {});

/// Number of frames up to the last key of the animation that deforms an object; empty if none does.
/// @param path      of the object
/// @param sampling  its `frames` are ignored
/// @throws Error    as readAnimatedObject()
std::optional<std::size_t> deformingFrames(const std::filesystem::path& path, const ObjectSampling& sampling);

/// An object in another shape. Its normals turn as the triangles around them do.
/// @param object    the object
/// @param vertices  as many as it has
FlowObject inShape(FlowObject object, const std::vector<Vec3>& vertices);

}  // namespace droplet
