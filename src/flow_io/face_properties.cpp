// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/flow_io/face_properties.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "droplet/error.h"
#include "flow_io/object_faces.h"
#include "require.h"

namespace droplet {
namespace {

void requireUv(const FlowObject& object, const char* what)
{
    if (object.uvs.empty()) {
        throw Error(ErrorCode::InvalidArgument, std::string(what) +
                                                    " needs an object with texture coordinates (uv), "
                                                    "but this one has none: unwrap it, and save it "
                                                    "with them");
    }
}

/// Pixel at a coordinate of a uv.
int pixelAt(double coordinate, int count)
{
    return std::min(static_cast<int>((coordinate - std::floor(coordinate)) * count), count - 1);
}

/// Mean over a triangle's parts, which are about as large as pixels: it is divided n times along every side.
/// @param level  of a pixel, 0 … 1
template <typename Raster, typename Level>
double meanOver(const Raster& picture, const std::array<Vec2, 3>& uvs, const Level& level)
{
    const auto level_at = [&](Vec2 uv) -> double {
        return level(pixelAt(uv.x, picture.width), pixelAt(uv.y, picture.height));
    };
    constexpr double kMaxParts = 64.0;
    double longest = 1.0;  // [px]
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec2 side = uvs[(k + 1) % 3] - uvs[k];
        longest = std::max(longest, std::hypot(side.x * picture.width, side.y * picture.height));
    }
    const int n = static_cast<int>(std::ceil(std::min(longest, kMaxParts)));
    const Vec2 p = (1.0 / n) * (uvs[1] - uvs[0]);
    const Vec2 q = (1.0 / n) * (uvs[2] - uvs[0]);
    double sum = 0.0;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n - i; ++j) {
            const Vec2 corner = uvs[0] + static_cast<double>(i) * p + static_cast<double>(j) * q;
            sum += level_at(corner + (1.0 / 3.0) * (p + q));
            if (i + j + 1 < n) {
                sum += level_at(corner + (2.0 / 3.0) * (p + q));
            }
        }
    }
    return sum / (static_cast<double>(n) * n);
}

/// Texture coordinates of a face's corners.
std::array<Vec2, 3> uvsOf(const FlowObject& object, const FlowSurface::Face& face)
{
    const auto weights = cornerWeights(object, face);
    std::array<Vec2, 3> corners;
    std::transform(weights.begin(), weights.end(), corners.begin(),
                   [&](const std::array<double, 3>& w) { return mixed(object.uvs, object.triangles[face.source], w); });
    return corners;
}

/// Whether the look of a face cuts all of it out.
bool isCutOut(const FlowObject& object, const FlowSurface::Face& face)
{
    const StandLook& look = object.looks[object.materials[face.source]];
    if (!look.coverage) {
        return false;
    }
    std::array<Vec2, 3> uvs = uvsOf(object, face);
    std::transform(uvs.begin(), uvs.end(), uvs.begin(), [&](Vec2 uv) { return look.place.at(uv); });
    return meanOver(*look.coverage, uvs, [&](int x, int y) { return look.isThere(x, y) ? 1.0 : 0.0; }) == 0.0;
}

/// Values of faces that materials replace.
template <typename Value>
void replace(std::vector<Value>& values, const FlowSurface& surface, const FlowObject& object,
             const std::vector<std::optional<Value>>& of_materials, Value otherwise)
{
    const auto has_value = [](const std::optional<Value>& value) { return value.has_value(); };
    if (std::none_of(of_materials.begin(), of_materials.end(), has_value)) {
        return;
    }
    values.resize(surface.faces.size(), otherwise);
    for (std::size_t f = 0; f < values.size(); ++f) {
        if (const std::optional<Value>& value = of_materials[object.materials[surface.faces[f].source]]) {
            values[f] = *value;
        }
    }
}

void requireAtLeastZero(const std::string& field, const std::optional<double>& value)
{
    if (value && !(*value >= 0.0 && std::isfinite(*value))) {
        refuseValue(field, *value, "finite and at least 0");
    }
}

void validate(const FacePropertyOptions& options, const FlowObject& object)
{
    requireAtLeastZero("roughness", options.roughness);
    requireAtLeastZero("max_roughness", options.max_roughness);
    requireAtLeastZero("max_friction", options.max_friction);
    for (const auto& [name, ground] : options.materials) {
        requireAtLeastZero("roughness of " + name, ground.roughness);
        requireAtLeastZero("friction of " + name, ground.friction);
        requireAtLeastZero("hysteresis of " + name, ground.hysteresis);
        if (ground.contact_angle) {
            Wetting wetting;
            wetting.contact_angle = *ground.contact_angle;
            wetting.validate();
        }
        if (object.material_names.empty()) {
            refuseValue("material", name, "left out, because the object has no materials");
        }
        if (std::find(object.material_names.begin(), object.material_names.end(), name) ==
            object.material_names.end()) {
            std::string known;
            for (const std::string& other : object.material_names) {
                known += known.empty() ? "one of the object's: " : ", ";
                known += other.empty() ? "\"\"" : other;
            }
            refuseValue("material", name, known);
        }
    }
}

}  // namespace

std::vector<double> meansOverFaces(const HeightMap& picture, const FlowObject& object, const FlowSurface& surface)
{
    requireUv(object, "a picture of the ground");
    std::vector<double> means;
    means.reserve(surface.faces.size());
    for (const FlowSurface::Face& face : surface.faces) {
        means.push_back(meanOver(picture, uvsOf(object, face), [&](int x, int y) {
            return std::clamp(static_cast<double>(picture.at(x, y)), 0.0, 1.0);
        }));
    }
    return means;
}

bool hasHoles(const FlowObject& object)
{
    return !object.uvs.empty() && !object.materials.empty() &&
           std::any_of(object.looks.begin(), object.looks.end(),
                       [](const StandLook& look) { return look.coverage.has_value(); });
}

FlowSurface withoutHoles(const FlowSurface& surface, const FlowObject& object)
{
    if (!hasHoles(object)) {
        return surface;
    }
    FlowSurface result;
    result.report = surface.report;
    std::vector<std::uint32_t> numbers(surface.faces.size(), FlowSurface::kNone);
    for (std::size_t f = 0; f < surface.faces.size(); ++f) {
        const FlowSurface::Face& face = surface.faces[f];
        if (!isCutOut(object, face)) {
            numbers[f] = static_cast<std::uint32_t>(result.faces.size());
            result.faces.push_back(face);
        }
    }
    if (result.faces.empty()) {
        throw Error(ErrorCode::InvalidInput, "the alpha of its pictures cuts out the whole object");
    }
    for (FlowSurface::Face& face : result.faces) {
        for (std::uint32_t& neighbour : face.neighbour) {
            neighbour = neighbour == FlowSurface::kNone ? neighbour : numbers[neighbour];
        }
    }
    return result;
}

FaceProperties faceProperties(const FlowObject& object, const FlowSurface& surface, const FacePropertyOptions& options)
{
    validate(options, object);
    FaceProperties ground;
    if (options.roughness_picture) {
        for (const double mean : meansOverFaces(*options.roughness_picture, object, surface)) {
            ground.roughness.push_back({options.max_roughness * mean, options.max_roughness * mean});
        }
    }
    if (options.friction_picture) {
        ground.friction = meansOverFaces(*options.friction_picture, object, surface);
        for (double& factor : ground.friction) {
            factor *= options.max_friction;
        }
    }
    std::vector<std::optional<Vec2>> roughness(object.material_names.size());
    std::vector<std::optional<double>> friction(object.material_names.size());
    std::vector<std::optional<double>> hysteresis(object.material_names.size());
    std::vector<std::optional<double>> contact_angle(object.material_names.size());
    for (std::size_t m = 0; m < object.material_names.size(); ++m) {
        if (const auto found = options.materials.find(object.material_names[m]); found != options.materials.end()) {
            if (const std::optional<double>& height = found->second.roughness) {
                roughness[m] = Vec2{*height, *height};
            }
            friction[m] = found->second.friction;
            hysteresis[m] = found->second.hysteresis;
            contact_angle[m] = found->second.contact_angle;
        }
    }
    replace(ground.roughness, surface, object, roughness, Vec2{options.roughness, options.roughness});
    replace(ground.friction, surface, object, friction, 1.0);
    replace(ground.hysteresis, surface, object, hysteresis, 1.0);
    replace(ground.contact_angle, surface, object, contact_angle, options.contact_angle);
    return ground;
}

std::function<double(const FlowTerrain::Point&)> coverageOver(const Mask& mask, const FlowObject& object,
                                                              const FlowSurface& surface)
{
    requireUv(object, "a mask");
    return [&](const FlowTerrain::Point& point) {
        const Triangle& triangle = object.triangles[surface.faces[point.face].source];
        const Vec2 uv = mixed(object.uvs, triangle, weightsAt(object, triangle, point.place));
        constexpr double kCovered = 65535.0;
        return mask.at(pixelAt(uv.x, mask.width), pixelAt(uv.y, mask.height)) / kCovered;
    };
}

std::function<double(const FlowTerrain::Point&)> weightsOver(const FlowObject& object, const FlowSurface& surface)
{
    if (object.weights.empty()) {
        throw Error(
            ErrorCode::InvalidArgument,
            "the object has no weights: glTF has them as _WEIGHT or in the red of COLOR_0, PLY as weight or red");
    }
    return [&](const FlowTerrain::Point& point) {
        const Triangle& triangle = object.triangles[surface.faces[point.face].source];
        return mixed(object.weights, triangle, weightsAt(object, triangle, point.place));
    };
}

}  // namespace droplet
