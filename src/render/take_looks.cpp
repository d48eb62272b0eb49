// SPDX-License-Identifier: GPL-3.0-or-later
#include "render/take_looks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <sstream>
#include <utility>

#include "drawing/tone.h"
#include "droplet/error.h"
#include "file_bytes.h"
#include "io/file_material.h"

namespace droplet {
namespace {

/// Takes a texture's picture, and its bytes where files can have them. What cannot be shown is a warning.
/// @param name      of the object's file
/// @param warnings  get a line
std::optional<Layer> takeTexture(const FileTexture& texture, const std::string& name, std::string& bytes,
                                 std::vector<std::string>& warnings)
{
    std::optional<Layer> picture;
    std::string fault = texture.fault.empty() ? "" : texture.name + " " + texture.fault;
    if (!texture.image.empty()) {
        try {
            picture = decodeLayer(texture.image);
            const std::string_view image(reinterpret_cast<const char*>(texture.image.data()), texture.image.size());
            if (image.starts_with("\x89PNG") || image.starts_with("\xff\xd8")) {
                bytes = image;
            }
        } catch (const Error& error) {
            fault = texture.name + ": " + error.what();
        }
    }
    if (!fault.empty()) {
        warnings.push_back(picture ? name + ": " + fault : name + " is shown without a texture: " + fault);
    }
    return picture;
}

constexpr std::size_t kAlpha = 3;  // channel of a layer

bool hasAlpha(const Layer& layer)
{
    bool has_alpha = false;
    for (std::size_t i = kAlpha; i < layer.rgba.size(); i += kAlpha + 1) {
        has_alpha = has_alpha || layer.rgba[i] < 255;
    }
    return has_alpha;
}

/// Colours of a layer, or its alpha as grey.
std::optional<Picture> pictureOf(const std::optional<Layer>& layer, bool of_alpha = false)
{
    if (!layer) {
        return std::nullopt;
    }
    Picture picture{layer->width, layer->height, {}};
    for (std::size_t i = 0; i < layer->rgba.size(); i += kAlpha + 1) {
        for (std::size_t c = 0; c < kAlpha; ++c) {
            picture.rgb.push_back(layer->rgba[i + (of_alpha ? kAlpha : c)]);
        }
    }
    return picture;
}

/// Colours with the alpha of another layer, or with the mean of its channels if it has none, as large as the larger.
/// @param colours  empty: white
Layer withAlpha(const std::optional<Layer>& colours, const Layer& alpha)
{
    const bool is_grey = !hasAlpha(alpha);
    const Layer& large = colours && colours->width > alpha.width ? *colours : alpha;
    Layer both{large.width, large.height, {}};
    const auto pixel_of = [&](const Layer& layer, int x, int y) {
        const auto scaled = [](int at, int from, int to) {
            return static_cast<std::size_t>(static_cast<std::int64_t>(at) * to / from);
        };
        return layer.rgba.begin() +
               static_cast<std::ptrdiff_t>(
                   (kAlpha + 1) * (scaled(y, both.height, layer.height) * static_cast<std::size_t>(layer.width) +
                                   scaled(x, both.width, layer.width)));
    };
    for (int y = 0; y < both.height; ++y) {
        for (int x = 0; x < both.width; ++x) {
            for (std::ptrdiff_t c = 0; c < static_cast<std::ptrdiff_t>(kAlpha); ++c) {
                both.rgba.push_back(colours ? pixel_of(*colours, x, y)[c] : std::uint8_t{255});
            }
            const auto from = pixel_of(alpha, x, y);
            both.rgba.push_back(is_grey ? static_cast<std::uint8_t>((from[0] + from[1] + from[2] + 1) / 3)
                                        : from[static_cast<std::ptrdiff_t>(kAlpha)]);
        }
    }
    return both;
}

/// Whether a picture is of directions: its colours differ, and are bluish on average. Heights are grey.
bool hasDirections(const Picture& picture)
{
    std::array<double, 3> sum{};
    for (std::size_t i = 0; i < picture.rgb.size(); ++i) {
        sum[i % 3] += picture.rgb[i];
    }
    return sum[2] > 1.2 * std::max(sum[0], sum[1]);
}

/// Thickness of matter for viewers, for each material: that of a plate with its volume and area [m].
std::vector<double> platesOf(const FileMesh& mesh)
{
    std::vector<double> volumes(mesh.looks.size());
    std::vector<double> areas(mesh.looks.size());
    for (std::size_t i = 0; !mesh.looks.empty() && i < mesh.materials.size(); ++i) {
        const auto [a, b, c] = mesh.triangles[i];
        const Vec3 p = mesh.vertices[a] - mesh.vertices[0];
        const Vec3 q = mesh.vertices[b] - mesh.vertices[0];
        const Vec3 r = mesh.vertices[c] - mesh.vertices[0];
        volumes[mesh.materials[i]] += dot(p, cross(q, r)) / 6.0;
        areas[mesh.materials[i]] += 0.5 * length(cross(q - p, r - p));
    }
    std::vector<double> plates;
    for (std::size_t m = 0; m < volumes.size(); ++m) {
        constexpr double kOfNothing = 1e-3;
        const double plate = 2.0 * std::abs(volumes[m]) / areas[m];
        plates.push_back(plate > 0.0 && std::isfinite(plate) ? plate : kOfNothing);
    }
    return plates;
}

/// @param plate  thickness where the file does not tell it [m]
/// @param name  of the object's file
void takeLook(const FileMaterial& material, double plate, const std::string& name, TakenLooks& taken,
              std::vector<std::string>& warnings)
{
    LookImages& images = taken.images.emplace_back();
    images.blends = material.blends;
    images.cutoff = material.cutoff;
    StandLook& look = taken.looks.emplace_back(
        StandLook{.look = material.look,
                  .opacity = material.opacity,
                  .thickness = material.refracts ? std::optional(material.thickness.value_or(plate)) : std::nullopt,
                  .absorption = material.absorption,
                  .relief = material.relief,
                  .glow = material.glow});
    std::optional<Layer> colours = takeTexture(material.colours, name, images.colours, warnings);
    look.normals = pictureOf(takeTexture(material.normals, name, images.normals, warnings));
    look.finish = pictureOf(takeTexture(material.finish, name, images.finish, warnings));
    look.glows = pictureOf(takeTexture(material.glows, name, images.glows, warnings));
    std::string encoded;
    const std::optional<Layer> coverage = takeTexture(material.coverage, name, encoded, warnings);
    if (coverage) {
        colours = withAlpha(colours, *coverage);
        std::ostringstream png;
        writePng(*colours, png);
        images.colours = std::move(png).str();
        images.blends = true;
    }
    if (colours && (images.blends || images.cutoff) && hasAlpha(*colours)) {
        look.coverage = pictureOf(colours, true);
        look.cutoff = images.cutoff;
    }
    look.colours = pictureOf(colours);
    // A look has one place for all of its pictures.
    std::optional<TexturePlace> place;
    for (const auto& [texture, is_shown] : {std::pair{&material.colours, !material.colours.image.empty()},
                                            {&material.normals, look.normals.has_value()},
                                            {&material.finish, look.finish.has_value()},
                                            {&material.glows, look.glows.has_value()},
                                            {&material.coverage, coverage.has_value()}}) {
        if (is_shown && place && !(*place == texture->place)) {
            warnings.push_back(name + ": " + texture->name + " is shown at the place of another texture");
        }
        place = is_shown && !place ? texture->place : place;
    }
    look.place = place.value_or(TexturePlace());
    if (look.normals && !hasDirections(*look.normals)) {
        warnings.push_back(name + " is shown without " + material.normals.name +
                           ", which has heights instead of directions");
        look.normals.reset();
        images.normals.clear();
    }
}

/// Makes colours of vertices linear. Where no material is known they are seen on white ones.
void giveColoursLooks(FileMesh& mesh)
{
    const auto light = [](double level) { return static_cast<double>(toLinear(static_cast<float>(level))); };
    for (Vec3& colour : mesh.colours) {
        colour = mesh.colours_are_levels ? Vec3{light(colour.x), light(colour.y), light(colour.z)} : colour;
    }
    mesh.colours_are_levels = false;
    if (mesh.colours.empty() || !mesh.looks.empty()) {
        return;
    }
    if (mesh.materials.empty()) {
        mesh.materials.resize(mesh.triangles.size());
        mesh.material_names = {"object"};
    }
    FileMaterial white = plainMaterial();
    white.look.colour = {1.0, 1.0, 1.0};
    mesh.looks.assign(mesh.material_names.size(), white);
}

}  // namespace

TakenLooks takeLooks(FileMesh& mesh, const std::string& name, std::vector<std::string>& warnings)
{
    giveColoursLooks(mesh);
    for (const std::string& fault : mesh.look_faults) {
        warnings.push_back(fmt::format("{} is shown without all of its materials: {}", name, fault));
    }
    const std::vector<double> plates = platesOf(mesh);
    TakenLooks taken;
    for (std::size_t m = 0; m < mesh.looks.size(); ++m) {
        takeLook(mesh.looks[m], plates[m], name, taken, warnings);
    }
    return taken;
}

}  // namespace droplet
