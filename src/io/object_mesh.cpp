// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/object_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

#include "droplet/error.h"
#include "droplet/io/read_surface.h"
#include "file_bytes.h"
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

/// @return  factor on the file's lengths
double resize(FileMesh& mesh, const ObjectOptions& options, const std::string& name)
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
        for (FileMaterial& material : mesh.looks) {
            if (material.thickness) {
                *material.thickness *= factor;
            }
            if (material.absorption) {
                material.absorption->distance *= factor;
            }
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
    return factor;
}

}  // namespace

bool isYUp(const std::filesystem::path& path, const ObjectOptions& options)
{
    return options.up.value_or(readableFormat(path) == Format::Ply ? UpAxis::Z : UpAxis::Y) == UpAxis::Y;
}

ObjectMesh readObjectMesh(const std::filesystem::path& path, const ObjectOptions& options, FileMeshOptions parts)
{
    const auto is_positive = [](double value) { return value > 0.0 && std::isfinite(value); };
    if (options.scale) {
        require(is_positive(*options.scale), "scale", *options.scale, "finite and more than 0");
    }
    if (options.size) {
        require(is_positive(*options.size), "size", *options.size, "finite and more than 0 m");
        require(!options.scale, "size", *options.size, "left out if there is a scale");
    }
    parts.y_up = isYUp(path, options);
    ObjectMesh object{readFileMesh(path, parts)};
    object.factor = resize(object.mesh, options, shown(path));
    return object;
}

}  // namespace droplet
