// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/flow_io/flow_object.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "droplet/error.h"
#include "droplet/io/read_surface.h"
#include "file_bytes.h"
#include "io/file_mesh.h"
#include "number_text.h"
#include "require.h"

namespace droplet {
namespace {

// Lengths that droplets, floats of the files that are written, and differences of places can be computed with.
constexpr double kMinSize = 1e-6;
constexpr double kMaxSize = 1e6;
constexpr double kMinFileSize = 1e-60;  // its fourth power is a number
constexpr double kMaxDistance = 1e6;    // from the origin, over the size

struct Extent {
    double size = 0.0;      ///< longest edge of the box around all triangles
    double distance = 0.0;  ///< largest coordinate
};

Extent extentOf(const FileMesh& mesh)
{
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    Extent extent;
    for (double Vec3::*const axis : {&Vec3::x, &Vec3::y, &Vec3::z}) {
        double low = kInfinity;
        double high = -kInfinity;
        for (const Triangle& triangle : mesh.triangles) {
            for (const std::uint32_t v : triangle) {
                low = std::min(low, mesh.vertices[v].*axis);
                high = std::max(high, mesh.vertices[v].*axis);
            }
        }
        extent.size = std::max(extent.size, high - low);
        extent.distance = std::max({extent.distance, std::abs(low), std::abs(high)});
    }
    return extent;
}

/// Whether a triangle has a direction: it is thicker than the rounding of its corners.
bool hasArea(const FileMesh& mesh)
{
    return std::any_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const Triangle& t) {
        const Vec3 a = mesh.vertices[t[1]] - mesh.vertices[t[0]];
        const Vec3 b = mesh.vertices[t[2]] - mesh.vertices[t[0]];
        const double longest = std::max({dot(a, a), dot(b, b), dot(b - a, b - a)});
        constexpr double kThin = 2e-12;
        return length(cross(a, b)) > kThin * longest;
    });
}

void resize(FileMesh& mesh, const FlowObjectOptions& options, const std::string& name)
{
    const auto refuse = [&](const std::string& what) { throw Error(ErrorCode::InvalidInput, name + " " + what); };
    Extent extent = extentOf(mesh);
    double factor = options.scale.value_or(1.0);
    if (options.size) {
        factor = *options.size / extent.size;
        if (!(extent.size >= kMinFileSize && extent.size <= 1.0 / kMinFileSize)) {
            refuse("is " + numberText(extent.size) + " m long, which cannot become " + numberText(*options.size) +
                   " m");
        }
    }
    extent.size *= factor;
    extent.distance *= factor;
    if (!(extent.size >= kMinSize && extent.size <= kMaxSize)) {
        refuse("is " + numberText(extent.size) + " m long, must be from " + numberText(kMinSize) + " m to " +
               numberText(kMaxSize) + " m; give it another scale or size");
    }
    if (!(extent.distance <= kMaxDistance * extent.size)) {
        refuse("is " + numberText(extent.distance) + " m away from its origin, must be at most " +
               numberText(kMaxDistance) + " times its size of " + numberText(extent.size) + " m; move it");
    }
    if (factor != 1.0) {
        for (Vec3& p : mesh.vertices) {
            p = factor * p;
        }
    }
    if (!hasArea(mesh)) {
        refuse("has no triangle with an area");
    }
    if (mesh.motion) {
        mesh.motion->pivot = factor * mesh.motion->pivot;
        for (FileMotion::Key& key : mesh.motion->keys) {
            key.place = factor * key.place;
        }
    }
}

ObjectMotion motionOf(const FileMotion& from)
{
    ObjectMotion motion;
    motion.pivot = from.pivot;
    for (const FileMotion::Key& key : from.keys) {
        motion.keys.push_back({key.time, {key.place, key.turn.axis, key.turn.real}});
    }
    return motion;
}

/// Look of a file's material; an image that cannot be read is left out, with a warning.
StandLook lookOf(const FileMaterial& material, const std::string& name, std::vector<std::string>& warnings)
{
    StandLook look{material.look, material.opacity, {}};
    std::string fault = material.image_fault;
    if (!material.image.empty()) {
        try {
            look.colours = decodePicture(material.image);
        } catch (const Error& error) {
            fault = std::string("an image: ") + error.what();
        }
    }
    if (!fault.empty()) {
        warnings.push_back(name + " is shown without a texture: " + fault);
    }
    return look;
}

}  // namespace

FlowObject readFlowObject(const std::filesystem::path& path, const FlowObjectOptions& options)
{
    const auto is_positive = [](double value) { return value > 0.0 && std::isfinite(value); };
    if (options.scale) {
        require(is_positive(*options.scale), "scale", *options.scale, "finite and more than 0");
    }
    if (options.size) {
        require(is_positive(*options.size), "size", *options.size, "finite and more than 0 m");
        require(!options.scale, "size", *options.size, "left out if there is a scale");
    }
    const bool is_ply = readableFormat(path) == Format::Ply;
    FileMesh mesh = readFileMesh(path, {.uvs = true,
                                        .polygons = true,
                                        .looks = true,
                                        .motion = true,
                                        .y_up = options.up.value_or(is_ply ? UpAxis::Z : UpAxis::Y) == UpAxis::Y});
    const std::string name = shown(path);
    resize(mesh, options, name);
    FlowObject object;
    if (mesh.ignores_animation) {
        object.warnings.push_back(name + " has an animation that is not a motion of the whole object; it is ignored");
    }
    if (mesh.deforms) {
        object.warnings.push_back(name + " has skins or morph targets; they are ignored, and the rest pose is read");
    }
    if (mesh.lacks_uv) {
        object.warnings.push_back(name + " has triangles without uv; pictures have their first pixel there");
    }
    object.vertices = std::move(mesh.vertices);
    object.normals = std::move(mesh.normals);
    object.uvs = std::move(mesh.uvs);
    object.triangles = std::move(mesh.triangles);
    object.materials = std::move(mesh.materials);
    object.material_names = std::move(mesh.material_names);
    for (const FileMaterial& material : mesh.looks) {
        const std::string_view image(reinterpret_cast<const char*>(material.image.data()), material.image.size());
        const bool fits_files = image.starts_with("\x89PNG") || image.starts_with("\xff\xd8");
        object.looks.push_back(lookOf(material, name, object.warnings));
        object.images.emplace_back(fits_files && object.looks.back().colours ? image : std::string_view{});
    }
    if (mesh.motion) {
        object.motion = motionOf(*mesh.motion);
    }
    return object;
}

}  // namespace droplet
