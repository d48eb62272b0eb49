// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "droplet/mesh/planar_mesh.h"
#include "droplet/vector.h"
#include "io/file_material.h"
#include "rotation.h"

namespace droplet {

/// Motion of a rigid object from a file: a point p at rest is at place + turn p.
struct FileMotion {
    struct Key {
        double time = 0.0;  ///< [s]
        Vec3 place;
        Rotation turn;
    };
    Vec3 pivot;             ///< it moves along a line from key to key
    std::vector<Key> keys;  ///< times that do not descend; two keys at one time are a jump
};

/// All triangles of a file.
///
/// Invariants: there is a triangle, its indices are in range; numbers are finite; arrays of vertices have one length.
struct FileMesh {
    std::vector<Vec3> vertices;               ///< in metres
    std::vector<Vec3> normals;                ///< unit
    std::vector<Vec2> uvs;                    ///< (0,0) top left; 0 for vertices without uv; empty: none has uv
    std::vector<float> contact_angles;        ///< [rad]; 0 for vertices without one; may be empty
    std::vector<double> weights;              ///< 0 … 1, if asked for and any vertex has one; or empty
    std::vector<Vec3> colours;                ///< 0 … 1, if looks are asked for and any vertex has one; or empty
    std::vector<Triangle> triangles;          ///< indices of vertices
    std::vector<std::uint32_t> weld;          ///< index of the first vertex at the same place
    std::vector<std::uint32_t> materials;     ///< of every triangle, in material_names; empty: none has one
    std::vector<std::string> material_names;  ///< "": no name
    std::vector<FileMaterial> looks;          ///< of every material name, if asked for and any is known; or empty
    std::vector<std::string> look_faults;     ///< why looks are not as the file wants them, one line each
    std::vector<std::uint32_t> fans;          ///< corner that each polygon of more than three is a fan about
    std::optional<FileMotion> motion;
    std::vector<std::vector<Vec3>> shapes;     ///< vertices in each frame, if an animation that deforms is sampled
    std::optional<double> deformation_end;     ///< time of the last key of this animation [s]
    std::vector<std::string> animation_names;  ///< of all animations, if one is sampled
    bool deforms = false;                      ///< the file has skins or morph targets, which are ignored
    bool ignores_animation = false;            ///< the file has an animation that `motion` does not hold
    bool lacks_uv = false;                     ///< some triangles have no uv, but others have
    bool colours_are_levels = false;           ///< sRGB levels; false: linear light
};

/// Frames at which an animation is sampled, from time 0 on.
struct FileSampling {
    double frames_per_second = 30.0;            ///< > 0
    std::optional<std::size_t> frames = {};     ///< empty: all up to the last key
    std::optional<std::string> animation = {};  ///< name; empty: the first that moves triangles

    /// Number of frames of an animation.
    /// @param end  time of the last key [s]
    [[nodiscard]] std::size_t framesUntil(double end) const
    {
        constexpr double kRounding = 1e-6;  // of a frame
        return static_cast<std::size_t>(std::max(std::floor(end * frames_per_second + kRounding), 0.0)) + 1;
    }
};

struct FileMeshOptions {
    bool uvs = false;       ///< read the texture coordinates of OBJ and PLY
    bool needs_uv = false;  ///< with `uvs`: reject triangles without them as damage
    bool weights = false;   ///< read the vertices' weights: attribute _WEIGHT of glTF, or red of COLOR_0;
                            ///< property weight of PLY, or red
    bool creases = false;   ///< divide vertices without a normal, and all of STL, at creases; see
                            ///< divideAtCreases. Otherwise those at one place share a normal, and STL has
                            ///< its facets'
    bool looks = false;     ///< read materials and their images, and the vertices' colours: COLOR_0 of glTF, unless it
                            ///< is read as weights; red, green and blue of PLY; six numbers of a vertex of OBJ
    bool motion = false;    ///< read the animation of the node of a glTF scene that carries all meshes
    std::optional<FileSampling> sampling = {};  ///< sample an animation of glTF that deforms the mesh: nodes that move
                                                ///< apart, scales, skins, morph targets
    std::vector<std::uint32_t> fans = {};  ///< FileMesh::fans of another shape of the mesh, which polygons are divided
                                           ///< as; of other polygons than the mesh has, it has no effect
    std::optional<bool> y_up = {};         ///< the file's y axis points up; empty: in OBJ; ignored for glTF
};

/// Fills in the normals that vertices lack (0), and makes all of unit length.
/// @param mesh     its other invariants hold
/// @param creases  FileMeshOptions::creases
void completeNormals(FileMesh& mesh, bool creases);

/// Reads .glb, .gltf, .obj, .ply or .stl. OBJ and STL are in millimetres, unless a comment of this library states
/// another unit.
/// @throws Error InvalidArgument for an unknown extension; InvalidInput, naming the file: it cannot be read, is
///               damaged, has no triangles, numbers that are not finite, or more than 2²⁶ triangles
FileMesh readFileMesh(const std::filesystem::path& path, const FileMeshOptions& options = {});

}  // namespace droplet
