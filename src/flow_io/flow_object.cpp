// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/flow_io/flow_object.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <sstream>
#include <utility>

#include "droplet/error.h"
#include "droplet/io/read_surface.h"
#include "file_bytes.h"
#include "flow/following.h"
#include "flow_io/box_of.h"
#include "io/file_mesh.h"
#include "io/object_mesh.h"
#include "number_text.h"
#include "render/take_looks.h"
#include "require.h"
#include "unit_vector.h"

namespace droplet {
namespace {

ObjectMotion motionOf(const FileMotion& from)
{
    ObjectMotion motion;
    motion.pivot = from.pivot;
    for (const FileMotion::Key& key : from.keys) {
        motion.keys.push_back({key.time, {key.place, key.turn.axis, key.turn.real}});
    }
    return motion;
}

/// How an object is read, and what was learned of its file.
struct Reading {
    std::optional<FileSampling> sampling = {};
    double factor = 1.0;  ///< on the file's lengths
    std::vector<std::uint32_t> fans = {};
    std::vector<std::uint32_t> weld = {};
    std::vector<std::vector<Vec3>> shapes = {};  ///< of an animation that is sampled [m]
};

FlowObject readObject(const std::filesystem::path& path, const ObjectOptions& options, Reading& reading)
{
    ObjectMesh read = readObjectMesh(path, options,
                                     {.uvs = true,
                                      .weights = options.weights,
                                      .creases = true,
                                      .looks = true,
                                      .motion = true,
                                      .sampling = reading.sampling});
    FileMesh& mesh = read.mesh;
    const std::string name = shown(path);
    reading.factor = read.factor;
    reading.fans = std::move(mesh.fans);
    reading.weld = std::move(mesh.weld);
    reading.shapes = std::move(mesh.shapes);
    for (std::vector<Vec3>& shape : reading.shapes) {
        std::transform(shape.begin(), shape.end(), shape.begin(), [&](Vec3 p) { return reading.factor * p; });
    }
    FlowObject object;
    if (mesh.ignores_animation) {
        object.warnings.push_back(name + " has an animation that is not a motion of the whole object; it is ignored");
    }
    if (mesh.animation_names.size() > 1 && !reading.sampling->animation) {
        object.warnings.push_back(fmt::format("{} has {} animations, of which the first that moves it is used: {}",
                                              name, mesh.animation_names.size(),
                                              fmt::join(mesh.animation_names, ", ")));
    }
    if (mesh.deforms) {
        object.warnings.push_back(name + " has skins or morph targets; they are ignored, and the rest pose is read");
    }
    if (mesh.lacks_uv) {
        object.warnings.push_back(name + " has triangles without uv; pictures have their first pixel there");
    }
    TakenLooks taken = takeLooks(mesh, name, object.warnings);
    object.looks = std::move(taken.looks);
    object.images = std::move(taken.images);
    object.vertices = std::move(mesh.vertices);
    object.normals = std::move(mesh.normals);
    object.uvs = std::move(mesh.uvs);
    object.weights = std::move(mesh.weights);
    object.colours = std::move(mesh.colours);
    object.triangles = std::move(mesh.triangles);
    object.materials = std::move(mesh.materials);
    object.material_names = std::move(mesh.material_names);
    if (mesh.motion) {
        object.motion = motionOf(*mesh.motion);
    }
    return object;
}

}  // namespace

void faceAs(const FlowSurface& surface, FlowObject& object)
{
    std::vector<std::optional<Vec3>> normals(object.triangles.size());  // of the faces; empty: there is none
    for (const FlowSurface::Face& face : surface.faces) {
        normals[face.source] = face.normal;
    }
    std::vector<double> agrees(object.vertices.size());  // areas whose normals a vertex's agrees with, less the others
    for (std::size_t t = 0; t < object.triangles.size(); ++t) {
        Triangle triangle = object.triangles[t];
        const Vec3 a = object.vertices[triangle[0]];
        const Vec3 facet = cross(object.vertices[triangle[1]] - a, object.vertices[triangle[2]] - a);
        const Vec3 normal = normals[t].value_or(facet);
        if (dot(facet, normal) < 0.0) {
            std::swap(triangle[1], triangle[2]);
        }
        for (const std::uint32_t v : triangle) {
            agrees[v] += normals[t] ? std::copysign(length(facet), dot(object.normals[v], normal)) : 0.0;
        }
        object.triangles[t] = triangle;
    }
    for (std::size_t v = 0; v < agrees.size(); ++v) {
        object.normals[v] = agrees[v] < 0.0 ? -1.0 * object.normals[v] : object.normals[v];
    }
}

Vec3 sizeOf(const FlowObject& object)
{
    const ViewBox box = boxOf(object.vertices);
    return box.high - box.low;
}

FlowObject readFlowObject(const std::filesystem::path& path, const ObjectOptions& options)
{
    Reading reading;
    return readObject(path, options, reading);
}

DeformingObject readDeformingObject(const std::vector<std::string>& paths, const ObjectOptions& options)
{
    require(!paths.empty(), "number of paths", paths.size(), "at least 1");
    Reading reading;
    DeformingObject all{readObject(paths.front(), options, reading), {}};
    const FlowObject& object = all.object;
    all.vertices.push_back(object.vertices);
    for (std::size_t k = 1; k < paths.size(); ++k) {
        const FileMesh mesh = readFileMesh(paths[k], {.fans = reading.fans, .y_up = isYUp(paths[k], options)});
        if (mesh.triangles.size() != object.triangles.size()) {
            throw Error(
                ErrorCode::InvalidInput,
                fmt::format("{} has {} triangles, but {} has {}; all meshes must have the same triangles",
                            shown(paths[k]), mesh.triangles.size(), shown(paths.front()), object.triangles.size()));
        }
        // Files may join corners to vertices otherwise, by their normals; places tell which are the same.
        std::vector<std::optional<Vec3>> places(object.vertices.size());
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
            for (std::size_t c = 0; c < 3; ++c) {
                const Vec3 place = reading.factor * mesh.vertices[mesh.triangles[t][c]];
                std::optional<Vec3>& known = places[reading.weld[object.triangles[t][c]]];
                if (known && !(*known == place)) {
                    throw Error(
                        ErrorCode::InvalidInput,
                        fmt::format("{} has other triangles than {}: corner {} of triangle {} of {} is not "
                                    "where that of the triangles beside it is",
                                    shown(paths[k]), shown(paths.front()), c + 1, t + 1, mesh.triangles.size()));
                }
                known = place;
            }
        }
        std::vector<Vec3>& vertices = all.vertices.emplace_back(object.vertices);
        for (std::size_t v = 0; v < vertices.size(); ++v) {
            vertices[v] = places[reading.weld[v]].value_or(vertices[v]);  // no triangle has the vertex otherwise
        }
    }
    return all;
}

DeformingObject readAnimatedObject(const std::filesystem::path& path, const ObjectSampling& sampling,
                                   const ObjectOptions& options)
{
    Reading reading;
    reading.sampling = FileSampling{sampling.frames_per_second, sampling.frames, sampling.animation};
    DeformingObject all{readObject(path, options, reading), std::move(reading.shapes)};
    if (all.vertices.empty()) {
        all.vertices.push_back(all.object.vertices);
    }
    return all;
}

std::optional<std::size_t> deformingFrames(const std::filesystem::path& path, const ObjectSampling& sampling)
{
    const Format format = readableFormat(path);
    if (format != Format::Glb && format != Format::Gltf) {
        return std::nullopt;
    }
    const FileSampling none{sampling.frames_per_second, 0, sampling.animation};
    const FileMesh mesh = readFileMesh(path, {.sampling = none});
    return mesh.deformation_end ? std::optional(none.framesUntil(*mesh.deformation_end)) : std::nullopt;
}

FlowObject inShape(FlowObject object, const std::vector<Vec3>& vertices)
{
    if (vertices == object.vertices) {
        return object;
    }
    std::vector<Vec3> normals(vertices.size());
    for (const Triangle& triangle : object.triangles) {
        const auto face_of = [&](const std::vector<Vec3>& places) {
            FlowSurface::Face face;
            face.corners = {places[triangle[0]], places[triangle[1]], places[triangle[2]]};
            face.normal = cross(face.corners[1] - face.corners[0], face.corners[2] - face.corners[0]);
            return face;
        };
        FlowSurface::Face from = face_of(object.vertices);
        FlowSurface::Face to = face_of(vertices);
        const double area = length(to.normal);
        if (!(area > 0.0 && length(from.normal) > 0.0)) {
            continue;
        }
        from.normal = (1.0 / length(from.normal)) * from.normal;
        to.normal = (1.0 / area) * to.normal;
        for (const std::uint32_t v : triangle) {
            normals[v] = normals[v] + area * turnedWith(from, to, object.normals[v]);
        }
    }
    for (std::size_t v = 0; v < normals.size(); ++v) {
        object.normals[v] = unit(normals[v], object.normals[v]);
    }
    object.vertices = vertices;
    return object;
}

}  // namespace droplet
