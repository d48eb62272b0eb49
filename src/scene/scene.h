// SPDX-License-Identifier: GPL-3.0-or-later
// What a file of meshes shows, whatever its format: metres, seconds, +Y up.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "droplet/mesh/planar_mesh.h"
#include "droplet/surface/material.h"
#include "droplet/surface/texture_place.h"
#include "droplet/vector.h"

namespace droplet {

using Float2 = std::array<float, 2>;
using Float3 = std::array<float, 3>;
using Float4 = std::array<float, 4>;

/// Look of triangles.
struct SceneMaterial {
    Look look;
    /// Thickness of the matter under a closed surface, for viewers that do not measure it [m] > 0; empty: no inside.
    std::optional<double> thickness = {};
    std::optional<Attenuation> absorption = {};  ///< in matter with an inside; empty: by the look
    double opacity = 1.0;                        ///< below 1: what lies behind shines through
    bool blends = false;                         ///< the alpha of `image` lets it shine through as well
    std::optional<double> cutoff = {};           ///< below this alpha of `image` there is nothing
    bool both_sides = false;                     ///< whether triangles are also seen from behind
    /// PNG or JPEG over the texture coordinates, repeated; in glTF alone. Empty: none.
    std::string image = {};         ///< multiplies the colour
    std::string normal_image = {};  ///< directions in tangent space
    double relief = 1.0;            ///< factor on their parts along the surface
    std::string finish_image = {};  ///< green multiplies the roughness, blue the metal
    Vec3 glow = {};                 ///< light of its own, >= 0; 1 is as bright as white in full light
    std::string glow_image = {};    ///< multiplies it
    TexturePlace place = {};        ///< of the images
};

/// Material of a liquid.
/// @param thickness  under a closed surface [m]; 0: no inside
SceneMaterial liquidMaterial(const Look& look, double thickness);

/// Material without transmission, seen from both sides.
SceneMaterial opaqueMaterial(const std::string& name, double roughness);

/// Triangles of one material.
struct ScenePart {
    std::size_t material = 0;  ///< index
    std::vector<Triangle> triangles;
    /// Indices, ascending, of triangles (a, b, c) that are followed by (a, c, d): USD shows both as abcd.
    std::vector<std::uint32_t> quads = {};
};

/// Change of all vertices, by a weight.
struct SceneTarget {
    std::vector<Float3> vertices;  ///< [m]
    std::vector<Float3> normals;
};

/// Vertices and the triangles between them. All arrays of vertices have one length, unless they are empty.
struct SceneGeometry {
    std::vector<Float3> vertices;           ///< [m]
    std::vector<Float3> normals;            ///< unit vectors
    std::vector<Float2> uvs = {};           ///< origin at the upper left; or empty
    std::vector<Float3> colours = {};       ///< linear, 0 … 1, multiply those of the materials; or empty
    std::vector<float> angles = {};         ///< contact angles [degrees]; or empty
    std::vector<std::uint32_t> weld = {};   ///< smallest index of a vertex at the same place; empty: every vertex alone
    std::vector<SceneTarget> targets = {};  ///< one for each name of the mesh
    std::vector<ScenePart> parts = {};
};

/// Number, count or list of numbers that a file states beside a mesh or node.
using SceneProperty = std::pair<std::string, std::variant<int, double, std::vector<double>>>;

struct SceneMesh {
    std::string name;
    std::vector<SceneGeometry> geometries = {};
    std::vector<std::string> targets = {};  ///< names
    std::vector<SceneProperty> properties = {};
};

/// Place in the scene. It moves what it carries: scale, then rotation, then translation.
struct SceneNode {
    std::string name = {};
    std::optional<std::size_t> mesh = {};
    std::vector<std::size_t> children = {};
    std::array<double, 3> translation = {0.0, 0.0, 0.0};    ///< [m]
    std::array<double, 4> rotation = {0.0, 0.0, 0.0, 1.0};  ///< quaternion, x first, w last
    std::array<double, 3> scale = {1.0, 1.0, 1.0};
    std::vector<SceneProperty> properties = {};
    std::vector<std::size_t> levels =
        {};  ///< nodes that take its place from afar, the nearest first; no parent has them
};

/// Vertices in place of a mesh's own.
struct SceneShape {
    std::vector<Float3> vertices;  ///< [m]
    std::vector<Float3> normals;
};

/// Many copies of a small mesh, each moved by a node of its own: droplets.
struct SceneCrowd {
    std::size_t mesh = 0;                 ///< with one geometry, without targets
    std::vector<std::size_t> nodes;       ///< one for each copy, without mesh and children
    std::size_t parent = 0;               ///< node above all of them
    std::vector<SceneShape> shapes = {};  ///< of copies, besides the mesh's own
    std::vector<std::size_t> shape_of =
        {};  ///< of each copy: 0 is the mesh's, k the one of shapes[k - 1]; empty: all 0

    /// Shape of a copy.
    [[nodiscard]] std::size_t shapeOf(std::size_t copy) const { return shape_of.empty() ? 0 : shape_of[copy]; }
};

/// Copies of a mesh that stay where they are.
struct SceneInstances {
    std::size_t mesh = 0;              ///< with one geometry, without targets; of no node
    std::size_t parent = 0;            ///< node above all copies
    std::vector<Float3> translations;  ///< [m]
    std::vector<Float4> rotations;     ///< quaternions, x first, w last
    std::vector<Float3> scales;
};

/// Copies of the meshes of ScenePoints in a frame. All arrays have one length.
struct ScenePointFrame {
    std::vector<std::int64_t> ids;           ///< each once
    std::vector<std::uint32_t> meshes;       ///< indices of ScenePoints::meshes
    std::vector<Float3> translations;        ///< [m]
    std::vector<Float3> velocities;          ///< [m/s]
    std::vector<Float4> rotations;           ///< quaternions, x first, w last
    std::vector<Float3> angular_velocities;  ///< about the axes of the scene [degrees/s]
    std::vector<Float3> scales;
    std::vector<std::vector<float>> values;  ///< one list for each of ScenePoints::values
};

/// Points that come, move and go, each with a copy of one of a few meshes.
struct ScenePoints {
    std::string name;
    std::vector<std::size_t> meshes;      ///< indices of Scene::meshes, of no node
    std::vector<std::string> values;      ///< names of the further numbers of a point
    std::vector<ScenePointFrame> frames;  ///< from time 0 on; at least one
};

/// What a track changes.
enum class SceneChange { Translation, Rotation, Scale, Weights };

/// Values of a node over time.
struct SceneTrack {
    std::size_t node = 0;
    SceneChange change = SceneChange::Translation;
    bool steps = false;              ///< values hold until the next key; otherwise they change evenly
    std::size_t times = 0;           ///< index of Scene::times
    std::vector<float> values = {};  ///< 3 for each key, 4 for a rotation, or one for each target
    bool is_coarse = false;          ///< of rotations: 2^-15 is exact enough
};

/// Picture over the texture coordinates.
struct ScenePicture {
    std::string name;
    std::string png;        ///< bytes of the file
    bool is_colour = true;  ///< whether it multiplies the colours of materials; otherwise it is data, not smoothed
    std::size_t first_material = 0;  ///< of those: index; all that follow are, too
};

struct Scene {
    std::vector<SceneMaterial> materials = {};
    std::vector<SceneMesh> meshes = {};
    std::vector<SceneNode> nodes = {};
    std::vector<std::size_t> roots = {};  ///< nodes without a parent
    std::vector<SceneCrowd> crowds = {};
    std::vector<SceneInstances> instances = {};
    std::optional<ScenePoints> points = {};  ///< in USD alone
    /// Whether glTF has instances by EXT_mesh_gpu_instancing; otherwise each one is a node.
    bool gpu_instancing = false;
    std::vector<std::size_t> corners = {};  ///< nodes at corners of a box that holds the crowds at all times
    std::optional<ScenePicture> picture = {};
    std::string animation = {};                  ///< name
    double frames_per_second = 24.0;             ///< > 0
    std::vector<std::vector<float>> times = {};  ///< of keys, ascending [s]
    std::vector<SceneTrack> tracks = {};

    /// Adds a node.
    /// @param parent  index; empty: a root
    /// @return        its index
    std::size_t addNode(SceneNode node, std::optional<std::size_t> parent = {});
    /// Adds a mesh; returns its index.
    std::size_t addMesh(SceneMesh mesh);
    /// Adds a material; returns its index.
    std::size_t addMaterial(SceneMaterial material);
    /// Makes crowds of all instances, each copy with a node.
    void spreadInstances();
    /// Adds times of keys; returns their index.
    std::size_t addTimes(std::vector<float> keys);
};

/// Vectors, z up, as a scene's numbers.
/// @throws Error InvalidArgument beyond float's range
std::vector<Float3> sceneVectors(const std::vector<Vec3>& vectors);
/// @throws Error InvalidArgument beyond float's range
Float3 sceneVector(Vec3 vector);
/// A scene's numbers, still y up.
Vec3 vectorOf(const Float3& numbers);
/// @throws Error InvalidArgument beyond float's range
std::vector<Float2> sceneCoordinates(const std::vector<Vec2>& uvs);

}  // namespace droplet
