// SPDX-License-Identifier: GPL-3.0-or-later
// Pixar, "OpenUSD": UsdGeomMesh, UsdGeomPointInstancer, UsdGeomPrimvar, "UsdPreviewSurface Specification" (2.6), "Usdz
// File Format Specification" (1.3).
#include "scene/write_usd.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <ostream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "byte_stream.h"
#include "droplet/error.h"
#include "droplet/printable.h"
#include "droplet/version.h"
#include "droplet/zip.h"
#include "scene/faces.h"
#include "scene/preview_opacity.h"
#include "scene/welded_vertices.h"

namespace droplet {
namespace {

constexpr const char* kLayer = "droplet.usda";
constexpr const char* kPicture = "picture.png";
constexpr std::string_view kRoot = "/droplet/";

/// Name of a prim, and the name that it stands for.
struct PrimName {
    std::string prim;
    std::string display;
};

constexpr bool isDigit(char c)
{
    return c >= '0' && c <= '9';
}

constexpr bool isLetter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

/// Names of sibling prims: identifiers, each once.
std::vector<PrimName> primNames(const std::vector<std::string>& names)
{
    std::vector<PrimName> prims;
    const auto is_taken = [&](const std::string& prim) {
        return std::any_of(prims.begin(), prims.end(), [&](const PrimName& other) { return other.prim == prim; });
    };
    for (const std::string& name : names) {
        std::string prim = name.empty() || isDigit(name.front()) ? "_" + name : name;
        std::replace_if(
            prim.begin(), prim.end(), [](char c) { return !isLetter(c) && !isDigit(c); }, '_');
        const std::string first = prim;
        for (std::size_t k = 2; is_taken(prim); ++k) {
            prim = first + "_" + std::to_string(k);
        }
        prims.push_back({prim, name});
    }
    return prims;
}

/// Metadata with the name that a prim stands for, unless it is the prim's own.
std::string displayName(const PrimName& name)
{
    if (name.display == name.prim) {
        return {};
    }
    std::string text = "displayName = \"";
    for (const char c : printable(name.display)) {
        text += c == '"' || c == '\\' ? std::string{'\\', c} : std::string(1, c);
    }
    return text + "\"";
}

/// Begins a prim, with its metadata, if there are any, up to its opening brace.
void beginPrim(ByteStream& bytes, const std::string& indent, const std::string& type, const std::string& name,
               const std::vector<std::string>& metadata)
{
    bytes.text("\n" + indent + "def " + type + " \"" + name + "\"");
    bool has_metadata = false;
    for (const std::string& entry : metadata) {
        if (!entry.empty()) {
            bytes.text(has_metadata ? "" : " (\n");
            bytes.text(indent);
            bytes.text("    ");
            bytes.text(entry);
            bytes.u8('\n');
            has_metadata = true;
        }
    }
    bytes.text((has_metadata ? indent + ")\n" : "\n") + indent + "{\n");
}

template <std::size_t Size>
void write(ByteStream& bytes, const std::array<float, Size>& numbers)
{
    for (std::size_t k = 0; k < Size; ++k) {
        bytes.text(k == 0 ? "(" : ", ");
        bytes.digits(numbers[k]);
    }
    bytes.u8(')');
}

void write(ByteStream& bytes, float number)
{
    bytes.digits(number);
}

void write(ByteStream& bytes, std::uint32_t number)
{
    bytes.digits(number);
}

void write(ByteStream& bytes, std::int64_t number)
{
    bytes.digits(number);
}

/// Writes a list of as many values, each by its index.
template <typename ValueOf>
void writeList(ByteStream& bytes, std::size_t count, const ValueOf& value_of)
{
    bytes.u8('[');
    for (std::size_t i = 0; i < count; ++i) {
        if (i > 0) {
            bytes.text(", ");
        }
        write(bytes, value_of(i));
    }
    bytes.u8(']');
}

constexpr const char* kBindsMaterial = "prepend apiSchemas = [\"MaterialBindingAPI\"]";

/// Vertices of a mesh in one list.
SceneGeometry joined(const SceneMesh& mesh)
{
    SceneGeometry all;
    const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
    for (const SceneGeometry& one : mesh.geometries) {
        const auto first = static_cast<std::uint32_t>(all.vertices.size());
        append(all.vertices, one.vertices);
        append(all.normals, one.normals);
        append(all.uvs, one.uvs);
        append(all.colours, one.colours);
        append(all.angles, one.angles);
        all.targets.resize(one.targets.size());
        for (std::size_t k = 0; k < one.targets.size(); ++k) {
            append(all.targets[k].vertices, one.targets[k].vertices);
            append(all.targets[k].normals, one.targets[k].normals);
        }
        for (std::uint32_t v = 0; v < one.vertices.size(); ++v) {
            all.weld.push_back(first + (one.weld.empty() ? v : one.weld[v]));
        }
        for (const auto& [material, triangles, quads] : one.parts) {
            ScenePart& part = all.parts.emplace_back();
            part.material = material;
            part.quads = quads;
            for (const auto& [a, b, c] : triangles) {
                part.triangles.push_back({first + a, first + b, first + c});
            }
        }
    }
    return all;
}

/// Time in frames. Keys at frames are exact.
double timeCode(float seconds, double frames_per_second)
{
    constexpr double kParts = 1000.0;
    return std::round(kParts * static_cast<double>(seconds) * frames_per_second) / kParts;
}

Float3 unit(const Float3& n)
{
    const float size = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    return {n[0] / size, n[1] / size, n[2] / size};
}

/// Samples of an attribute over time.
struct Samples {
    std::vector<double> codes;
    std::vector<std::size_t> keys;  ///< key of the track whose value a sample has
};

Samples samplesOf(const SceneTrack& track, const Scene& scene)
{
    constexpr double kBefore = 1e-3;  // the step of time codes
    const std::vector<float>& times = scene.times[track.times];
    const auto width = static_cast<std::ptrdiff_t>(track.values.size() / times.size());
    const auto is_same = [&](std::size_t a, std::size_t b) {
        const auto at = [&](std::size_t key) {
            return track.values.begin() + static_cast<std::ptrdiff_t>(key) * width;
        };
        return std::equal(at(a), at(a) + width, at(b));
    };
    Samples samples;
    for (std::size_t key = 0; key < times.size(); ++key) {
        const double code = timeCode(times[key], scene.frames_per_second);
        if (track.steps && key > 0) {
            if (is_same(key - 1, key)) {
                continue;
            }
            if (code - kBefore > samples.codes.back()) {
                samples.codes.push_back(code - kBefore);
                samples.keys.push_back(key - 1);
            }
        }
        samples.codes.push_back(code);
        samples.keys.push_back(key);
    }
    return samples;
}

/// Writes samples; write_key writes the value of a key.
template <class WriteKey>
void writeSamples(ByteStream& bytes, const std::string& indent, const Samples& samples, const WriteKey& write_key)
{
    bytes.text(".timeSamples = {");
    for (std::size_t i = 0; i < samples.codes.size(); ++i) {
        bytes.text(i == 0 ? "\n" : ",\n");
        bytes.text(indent);
        bytes.text("    ");
        bytes.digits(samples.codes[i]);
        bytes.text(": ");
        write_key(samples.keys[i]);
    }
    bytes.text("\n" + indent + "}");
}

/// Writer of a mesh with its welded points.
class MeshWriter {
public:
    /// Where a mesh stands in the file.
    struct Place {
        std::string indent;
        PrimName name;
        std::vector<std::string> material_paths;  ///< of every material of the scene
    };

    /// @param weights  track of its targets; null: none
    MeshWriter(const Scene& scene, const SceneMesh& mesh, const SceneTrack* weights, ByteStream& bytes)
        : scene_(scene),
          geometry_(joined(mesh)),
          weights_(weights),
          bytes_(bytes),
          welded_(weldVertices(geometry_.weld))
    {
        for (const ScenePart& part : geometry_.parts) {
            forEachFace(part.triangles, part.quads, [&](std::size_t /*triangle*/, const auto& corners) {
                corners_.insert(corners_.end(), corners);
                counts_.push_back(static_cast<std::uint32_t>(corners.size()));
            });
        }
    }

    /// Writes the prim up to the end of its own attributes.
    void begin(const Place& place)
    {
        indent_ = place.indent + "    ";
        beginPrim(bytes_, place.indent, "Mesh", place.name.prim, {kBindsMaterial, displayName(place.name)});
        const bool is_double_sided =
            std::all_of(geometry_.parts.begin(), geometry_.parts.end(),
                        [&](const ScenePart& part) { return scene_.materials[part.material].both_sides; });
        if (is_double_sided) {
            bytes_.text(indent_ + "uniform bool doubleSided = 1\n");
        }
        bytes_.text(indent_ + "float3[] extent");
        overTime(&SceneGeometry::vertices, &SceneTarget::vertices,
                 [&](const Vectors& vertices) { writeExtent(vertices); });
        attribute("int[] faceVertexCounts", counts_.size(), [&](std::size_t i) { return counts_[i]; });
        attribute("int[] faceVertexIndices", corners_.size(),
                  [&](std::size_t i) { return welded_.number[corners_[i]]; });
        // Subsets go before it; readers that do not know them show it.
        bytes_.text("\n" + indent_ + "rel material:binding = <" +
                    place.material_paths[geometry_.parts.front().material] + ">\n" + indent_ +
                    "uniform token orientation = \"rightHanded\"\n" + indent_ + "point3f[] points");
        overTime(&SceneGeometry::vertices, &SceneTarget::vertices, [&](const Vectors& vertices) {
            writeList(bytes_, welded_.first.size(), [&](std::size_t i) { return vertices[welded_.first[i]]; });
        });
        if (!geometry_.angles.empty()) {
            attribute("float[] primvars:contact_angle", welded_.first.size(),
                      [&](std::size_t i) { return geometry_.angles[welded_.first[i]]; });
            interpolate("vertex");
        }
        bytes_.text("\n" + indent_ + "normal3f[] primvars:normals");
        const auto write_normals = [&](const Vectors& normals) {
            writeList(bytes_, normals.size(), [&](std::size_t i) { return weights_ ? unit(normals[i]) : normals[i]; });
        };
        if (weights_) {
            bytes_.text(" (\n" + indent_ + "    interpolation = \"faceVarying\"\n" + indent_ + ")\n" + indent_ +
                        "normal3f[] primvars:normals");
            overTime(&SceneGeometry::normals, &SceneTarget::normals, write_normals);
        } else {
            overTime(&SceneGeometry::normals, &SceneTarget::normals, write_normals);
            interpolate("faceVarying");
        }
        attribute("int[] primvars:normals:indices", corners_.size(), [&](std::size_t i) { return corners_[i]; });
        if (!geometry_.uvs.empty()) {
            writeTexture();
        }
        if (!geometry_.colours.empty()) {
            const std::vector<Float3> colours = coloursOfVertices();
            attribute("color3f[] primvars:displayColor", colours.size(), [&](std::size_t i) { return colours[i]; });
            interpolate("faceVarying");
            attribute("int[] primvars:displayColor:indices", corners_.size(),
                      [&](std::size_t i) { return corners_[i]; });
        }
        bytes_.text("\n" + indent_ + "uniform token subdivisionScheme = \"none\"\n");
        if (weights_) {
            writeVelocities();
        }
    }

    /// Writes the faces of every material, if there are several, and ends the prim.
    void end(const Place& place, const std::vector<PrimName>& material_names)
    {
        std::vector<std::size_t> materials;
        for (const ScenePart& part : geometry_.parts) {
            if (std::find(materials.begin(), materials.end(), part.material) == materials.end()) {
                materials.push_back(part.material);
            }
        }
        if (materials.size() > 1) {
            bytes_.text(indent_ + "uniform token subsetFamily:materialBind:familyType = \"partition\"\n");
            for (const std::size_t material : materials) {
                writeSubset(material, material_names[material], place.material_paths[material]);
            }
        }
        bytes_.text(place.indent + "}\n");
    }

private:
    template <typename ValueOf>
    void attribute(std::string_view declaration, std::size_t count, const ValueOf& value_of)
    {
        bytes_.text("\n" + indent_);
        bytes_.text(declaration);
        bytes_.text(" = ");
        writeList(bytes_, count, value_of);
    }

    using Vectors = std::vector<Float3>;

    /// Writes a value of the vertices or normals, or its samples where weights change.
    template <class WriteValue>
    void overTime(Vectors SceneGeometry::*base, Vectors SceneTarget::*change, const WriteValue& write_value)
    {
        if (!weights_) {
            bytes_.text(" = ");
            write_value(geometry_.*base);
            return;
        }
        writeSamples(bytes_, indent_, samplesOf(*weights_, scene_),
                     [&](std::size_t key) { write_value(vectorsAt(key, base, change)); });
    }

    /// Writes what points move by until their next sample [m/s]. From the last one they go on: there, other triangles
    /// take their place, and renderers blur that frame by its velocities alone.
    void writeVelocities()
    {
        const std::vector<float>& times = scene_.times[weights_->times];
        bytes_.text(indent_ + "vector3f[] velocities");
        writeSamples(bytes_, indent_, samplesOf(*weights_, scene_), [&](std::size_t key) {
            const std::size_t from = std::min(key, times.size() - 2);
            const Vectors before = vectorsAt(from, &SceneGeometry::vertices, &SceneTarget::vertices);
            const Vectors after = vectorsAt(from + 1, &SceneGeometry::vertices, &SceneTarget::vertices);
            const float duration = times[from + 1] - times[from];
            writeList(bytes_, welded_.first.size(), [&](std::size_t i) {
                const std::size_t v = welded_.first[i];
                Float3 velocity{};
                for (std::size_t k = 0; k < velocity.size(); ++k) {
                    velocity[k] = (after[v][k] - before[v][k]) / duration;
                }
                return velocity;
            });
        });
        bytes_.u8('\n');
    }

    /// Positions or normals at a key of the weights.
    [[nodiscard]] Vectors vectorsAt(std::size_t key, Vectors SceneGeometry::*base, Vectors SceneTarget::*change) const
    {
        Vectors vectors = geometry_.*base;
        const std::size_t targets = geometry_.targets.size();
        for (std::size_t k = 0; k < targets; ++k) {
            const float weight = weights_->values[key * targets + k];
            const Vectors& changes = geometry_.targets[k].*change;
            for (std::size_t v = 0; weight != 0.0F && v < vectors.size(); ++v) {
                for (std::size_t i = 0; i < 3; ++i) {
                    vectors[v][i] += weight * changes[v][i];
                }
            }
        }
        return vectors;
    }

    void interpolate(std::string_view kind)
    {
        bytes_.text(" (\n" + indent_ + "    interpolation = \"");
        bytes_.text(kind);
        bytes_.text("\"\n" + indent_ + ")");
    }

    void writeExtent(const Vectors& vertices)
    {
        Float3 low = vertices.front();
        Float3 high = low;
        for (const Float3& point : vertices) {
            for (std::size_t k = 0; k < point.size(); ++k) {
                low[k] = std::min(low[k], point[k]);
                high[k] = std::max(high[k], point[k]);
            }
        }
        writeList(bytes_, 2, [&](std::size_t i) { return i == 0 ? low : high; });
    }

    void writeSubset(std::size_t material, const PrimName& name, const std::string& path)
    {
        beginPrim(bytes_, indent_, "GeomSubset", name.prim, {kBindsMaterial, displayName(name)});
        bytes_.text(indent_ + "    uniform token elementType = \"face\"\n" + indent_ +
                    "    uniform token familyName = \"materialBind\"\n" + indent_ + "    int[] indices = ");
        std::vector<std::uint32_t> faces;
        std::uint32_t face = 0;
        for (const ScenePart& part : geometry_.parts) {
            for (std::size_t n = part.quads.size(); n < part.triangles.size(); ++n, ++face) {
                if (part.material == material) {
                    faces.push_back(face);
                }
            }
        }
        writeList(bytes_, faces.size(), [&](std::size_t i) { return faces[i]; });
        bytes_.text("\n" + indent_ + "    rel material:binding = <" + path + ">\n" + indent_ + "}\n");
    }

    /// Copies of a vertex have one place in the mask, but not where a surface that leans out was spread. The origin is
    /// at the lower left.
    void writeTexture()
    {
        const auto texture = [&](std::size_t i) {
            return Float2{geometry_.uvs[i][0], static_cast<float>(1.0 - static_cast<double>(geometry_.uvs[i][1]))};
        };
        bool is_shared = true;
        for (std::size_t i = 0; i < geometry_.uvs.size(); ++i) {
            is_shared = is_shared && geometry_.uvs[i] == geometry_.uvs[geometry_.weld[i]];
        }
        constexpr std::string_view kDeclaration = "texCoord2f[] primvars:st";
        if (is_shared) {
            attribute(kDeclaration, welded_.first.size(), [&](std::size_t i) { return texture(welded_.first[i]); });
            interpolate("vertex");
        } else {
            attribute(kDeclaration, geometry_.uvs.size(), texture);
            interpolate("faceVarying");
            attribute("int[] primvars:st:indices", corners_.size(), [&](std::size_t i) { return corners_[i]; });
        }
    }

    /// Colours of vertices times those of their materials, which a shader cannot multiply.
    [[nodiscard]] std::vector<Float3> coloursOfVertices() const
    {
        std::vector<Float3> colours = geometry_.colours;
        for (const ScenePart& part : geometry_.parts) {
            const Vec3 factor = scene_.materials[part.material].look.colour;
            for (const Triangle& triangle : part.triangles) {
                for (const std::uint32_t v : triangle) {
                    const Vec3 own = vectorOf(geometry_.colours[v]);
                    colours[v] = {toFloat(factor.x * own.x), toFloat(factor.y * own.y), toFloat(factor.z * own.z)};
                }
            }
        }
        return colours;
    }

    const Scene& scene_;
    SceneGeometry geometry_;
    const SceneTrack* weights_;
    ByteStream& bytes_;
    std::string indent_;
    WeldedVertices welded_;
    std::vector<std::uint32_t> corners_;  ///< of all faces: vertices
    std::vector<std::uint32_t> counts_;   ///< of corners, for every face
};

/// What gives a material its colour.
enum class Coloured { ByLook, ByPicture, ByVertices };

/// @param coloured  a picture's colours multiply that of the look; vertices have colours times that of the look
void writeMaterial(const SceneMaterial& material, const PrimName& name, Coloured coloured, ByteStream& bytes)
{
    const bool has_picture = coloured == Coloured::ByPicture;
    const Look& look = material.look;
    const std::string path = std::string(kRoot) + name.prim;
    const std::array colour{toFloat(look.colour.x), toFloat(look.colour.y), toFloat(look.colour.z)};
    const auto input = [&](const char* declaration, double value) {
        bytes.text(std::string("            ") + declaration + " = ");
        bytes.digits(toFloat(value));
        bytes.u8('\n');
    };
    beginPrim(bytes, "    ", "Material", name.prim, {displayName(name)});
    bytes.text("        token outputs:surface.connect = <" + path + "/preview.outputs:surface>\n");
    beginPrim(bytes, "        ", "Shader", "preview", {});
    bytes.text("            uniform token info:id = \"UsdPreviewSurface\"\n            color3f inputs:diffuseColor");
    if (has_picture) {
        bytes.text(".connect = <" + path + "/picture.outputs:rgb>\n");
    } else if (coloured == Coloured::ByVertices) {
        bytes.text(".connect = <" + path + "/colours.outputs:result>\n");
    } else {
        bytes.text(" = ");
        write(bytes, colour);
        bytes.u8('\n');
    }
    const auto [red, green, blue] = material.glow;
    if (red + green + blue > 0.0 && material.glow_image.empty()) {
        bytes.text("            color3f inputs:emissiveColor = ");
        write(bytes, std::array{toFloat(red), toFloat(green), toFloat(blue)});
        bytes.u8('\n');
    }
    input("float inputs:ior", look.ior);
    input("float inputs:metallic", look.metallic);
    input("float inputs:opacity", material.opacity * previewOpacity(look));
    input("float inputs:roughness", look.roughness);
    bytes.text("            token outputs:surface\n        }\n");
    if (has_picture) {
        beginPrim(bytes, "        ", "Shader", "picture", {});
        bytes.text("            uniform token info:id = \"UsdUVTexture\"\n            asset inputs:file = @" +
                   std::string(kPicture) + "@\n            float4 inputs:scale = ");
        write(bytes, std::array{colour[0], colour[1], colour[2], 1.0F});
        bytes.text(
            "\n            token inputs:sourceColorSpace = \"sRGB\"\n"
            "            float2 inputs:st.connect = <" +
            path +
            "/st.outputs:result>\n            token inputs:wrapS = \"clamp\"\n"
            "            token inputs:wrapT = \"clamp\"\n            float3 outputs:rgb\n        }\n");
        beginPrim(bytes, "        ", "Shader", "st", {});
        bytes.text(
            "            uniform token info:id = \"UsdPrimvarReader_float2\"\n"
            "            string inputs:varname = \"st\"\n            float2 outputs:result\n        }\n");
    }
    if (coloured == Coloured::ByVertices) {
        beginPrim(bytes, "        ", "Shader", "colours", {});
        bytes.text(
            "            uniform token info:id = \"UsdPrimvarReader_float3\"\n"
            "            string inputs:varname = \"displayColor\"\n            float3 outputs:result\n        }\n");
    }
    bytes.text("    }\n");
}

/// Writer of a scene's prims.
class LayerWriter {
public:
    LayerWriter(const Scene& scene, ByteStream& bytes) : scene_(scene), bytes_(bytes), tracks_(scene.nodes.size())
    {
        for (const SceneTrack& track : scene.tracks) {
            tracks_[track.node].push_back(&track);
        }
        class_of_.resize(scene.nodes.size());
        for (std::size_t k = 0; k < scene.crowds.size(); ++k) {
            const SceneCrowd& crowd = scene.crowds[k];
            std::map<std::size_t, std::size_t> numbers;  // of the classes of its shapes
            for (std::size_t i = 0; i < crowd.nodes.size(); ++i) {
                const auto [number, is_new] = numbers.try_emplace(crowd.shapeOf(i), classes_.size());
                if (is_new) {
                    classes_.push_back({k, crowd.shapeOf(i)});
                }
                class_of_[crowd.nodes[i]] = number->second;
            }
        }
        nameAll();
    }

    void write()
    {
        bytes_.text(std::string("#usda 1.0\n(\n    defaultPrim = \"droplet\"\n    doc = \"droplet-shape ") + kVersion +
                    "\"\n");
        const bool is_animated = !scene_.tracks.empty() || scene_.points;
        if (is_animated) {
            double end = scene_.points ? static_cast<double>(scene_.points->frames.size() - 1) : 0.0;
            for (const std::vector<float>& times : scene_.times) {
                end = std::max(end, timeCode(times.back(), scene_.frames_per_second));
            }
            bytes_.text("    endTimeCode = ");
            bytes_.digits(end);
            bytes_.text("\n    framesPerSecond = ");
            bytes_.digits(scene_.frames_per_second);
            bytes_.u8('\n');
        }
        bytes_.text("    metersPerUnit = 1\n");
        if (is_animated) {
            bytes_.text("    startTimeCode = 0\n    timeCodesPerSecond = ");
            bytes_.digits(scene_.frames_per_second);
            bytes_.u8('\n');
        }
        bytes_.text("    upAxis = \"Y\"\n)\n");
        beginPrim(bytes_, "", "Xform", "droplet", {"kind = \"component\""});
        const std::vector<std::size_t> shown = shownOf(scene_.roots);
        for (std::size_t i = 0; i < shown.size(); ++i) {
            writeNode(shown[i], root_names_[i], "    ");
        }
        if (scene_.points) {
            writePoints(*scene_.points, root_names_.back());
        }
        for (std::size_t k = 0; k < classes_.size(); ++k) {
            writeClass(k);
        }
        for (const std::size_t i : written_materials_) {
            const bool has_picture = scene_.picture && i >= scene_.picture->first_material;
            const Coloured coloured = has_picture       ? Coloured::ByPicture
                                      : has_colours_[i] ? Coloured::ByVertices
                                                        : Coloured::ByLook;
            writeMaterial(scene_.materials[i], material_names_[i], coloured, bytes_);
        }
        bytes_.text("}\n");
    }

private:
    /// A mesh that copies refer to.
    struct Class {
        std::size_t crowd = 0;  ///< index
        std::size_t shape = 0;  ///< as in SceneCrowd::shape_of
    };

    /// Names what lies directly below the default prim: nodes, points, classes, materials. Equal looks share one.
    void nameAll()
    {
        std::vector<std::string> names;
        for (const std::size_t node : shownOf(scene_.roots)) {
            names.push_back(scene_.nodes[node].name);
        }
        if (scene_.points) {
            names.push_back(scene_.points->name);
        }
        const std::size_t nodes = names.size();
        for (const Class& one : classes_) {
            names.push_back(scene_.meshes[scene_.crowds[one.crowd].mesh].name);
        }
        has_colours_.resize(scene_.materials.size());
        for (const SceneMesh& mesh : scene_.meshes) {
            for (const SceneGeometry& geometry : mesh.geometries) {
                for (const ScenePart& part : geometry.parts) {
                    has_colours_[part.material] = has_colours_[part.material] || !geometry.colours.empty();
                }
            }
        }
        std::vector<std::size_t> same(scene_.materials.size());
        for (std::size_t i = 0; i < same.size(); ++i) {
            same[i] = i;
            for (const std::size_t k : written_materials_) {
                const SceneMaterial& one = scene_.materials[k];
                const SceneMaterial& other = scene_.materials[i];
                if (one.look == other.look && one.opacity == other.opacity && one.glow == other.glow &&
                    one.glow_image == other.glow_image && has_colours_[k] == has_colours_[i]) {
                    same[i] = k;
                }
            }
            if (same[i] == i) {
                written_materials_.push_back(i);
                names.push_back(scene_.materials[i].look.name);
            }
        }
        const std::vector<PrimName> prims = primNames(names);
        root_names_.assign(prims.begin(), prims.begin() + static_cast<std::ptrdiff_t>(nodes));
        material_names_.resize(same.size());
        for (std::size_t k = 0; k < written_materials_.size(); ++k) {
            material_names_[written_materials_[k]] = prims[nodes + classes_.size() + k];
        }
        for (std::size_t i = 0; i < same.size(); ++i) {
            material_names_[i] = material_names_[same[i]];
            material_paths_.push_back(std::string(kRoot) + material_names_[i].prim);
        }
        for (std::size_t k = 0; k < classes_.size(); ++k) {
            class_names_.push_back(prims[nodes + k]);
        }
    }

    /// Nodes that show something, or carry such.
    [[nodiscard]] std::vector<std::size_t> shownOf(const std::vector<std::size_t>& nodes) const
    {
        std::vector<std::size_t> shown;
        std::copy_if(nodes.begin(), nodes.end(), std::back_inserter(shown), [this](std::size_t node) {
            return scene_.nodes[node].mesh || class_of_[node] || !shownOf(scene_.nodes[node].children).empty();
        });
        return shown;
    }

    [[nodiscard]] const SceneTrack* trackOf(std::size_t node, SceneChange change) const
    {
        const auto found = std::find_if(tracks_[node].begin(), tracks_[node].end(),
                                        [&](const SceneTrack* track) { return track->change == change; });
        return found == tracks_[node].end() ? nullptr : *found;
    }

    void writeNode(std::size_t index, const PrimName& name, const std::string& indent)
    {
        const SceneNode& node = scene_.nodes[index];
        const std::vector<std::size_t> children = shownOf(node.children);
        if (node.mesh && children.empty()) {
            writeMesh(index, name, indent, true);
            return;
        }
        if (class_of_[index]) {
            beginPrim(bytes_, indent, "Xform", name.prim,
                      {"instanceable = true",
                       "prepend references = <" + std::string(kRoot) + class_names_[*class_of_[index]].prim + ">"});
        } else {
            beginPrim(bytes_, indent, "Xform", name.prim, {displayName(name)});
        }
        writeTransform(index, indent + "    ");
        writeProperties(node, indent + "    ");
        std::vector<std::string> names;
        for (const std::size_t child : children) {
            const SceneNode& one = scene_.nodes[child];
            names.push_back(one.name.empty() ? "droplet_" + std::to_string(names.size() + 1) : one.name);
        }
        if (node.mesh) {
            names.push_back(scene_.meshes[*node.mesh].name);
        }
        const std::vector<PrimName> prims = primNames(names);
        if (node.mesh) {
            writeMesh(index, prims.back(), indent + "    ", false);
        }
        for (std::size_t i = 0; i < children.size(); ++i) {
            writeNode(children[i], prims[i], indent + "    ");
        }
        bytes_.text(indent + "}\n");
    }

    /// @param is_node  whether the mesh's prim stands for its node, too
    void writeMesh(std::size_t index, const PrimName& name, const std::string& indent, bool is_node)
    {
        const SceneNode& node = scene_.nodes[index];
        const MeshWriter::Place place{indent, name, material_paths_};
        MeshWriter writer(scene_, scene_.meshes[*node.mesh], trackOf(index, SceneChange::Weights), bytes_);
        writer.begin(place);
        if (is_node) {
            writeProperties(node, indent + "    ");
            writeTransform(index, indent + "    ");
        }
        writer.end(place, material_names_);
    }

    /// Writes the mesh of some of a crowd's copies, which refer to it.
    void writeClass(std::size_t number)
    {
        const std::string indent = "    ";
        const PrimName& name = class_names_[number];
        const auto& [index, shape] = classes_[number];
        const SceneCrowd& crowd = scene_.crowds[index];
        SceneMesh mesh = scene_.meshes[crowd.mesh];
        if (shape > 0) {
            mesh.geometries.front().vertices = crowd.shapes[shape - 1].vertices;
            mesh.geometries.front().normals = crowd.shapes[shape - 1].normals;
        }
        bytes_.text("\n" + indent + "class Xform \"" + name.prim + "\"\n" + indent + "{\n");
        const MeshWriter::Place place{indent + "    ", {"surface", "surface"}, material_paths_};
        MeshWriter writer(scene_, mesh, nullptr, bytes_);
        writer.begin(place);
        writer.end(place, material_names_);
        bytes_.text(indent + "}\n");
    }

    /// Writes points as an instancer with the meshes below it, and a sample for every frame. Velocities, not the
    /// samples around, tell where a point is between frames, since the next frame may have others.
    void writePoints(const ScenePoints& points, const PrimName& name)
    {
        const std::string indent = "        ";
        Samples frames;
        for (std::size_t k = 0; k < points.frames.size(); ++k) {
            frames.codes.push_back(static_cast<double>(k));
            frames.keys.push_back(k);
        }
        const auto samples = [&](const std::string& declaration, const auto& list_of) {
            bytes_.text(indent + declaration);
            writeSamples(bytes_, indent, frames, [&](std::size_t key) {
                const auto& list = list_of(points.frames[key]);
                writeList(bytes_, list.size(), [&](std::size_t i) { return list[i]; });
            });
            bytes_.u8('\n');
        };
        beginPrim(bytes_, "    ", "PointInstancer", name.prim, {displayName(name)});
        samples("vector3f[] angularVelocities", std::mem_fn(&ScenePointFrame::angular_velocities));
        writeExtent(points, indent);
        samples("int64[] ids", std::mem_fn(&ScenePointFrame::ids));
        samples("quath[] orientations", [](const ScenePointFrame& frame) { return orientations(frame.rotations); });
        samples("point3f[] positions", std::mem_fn(&ScenePointFrame::translations));
        for (std::size_t v = 0; v < points.values.size(); ++v) {
            const std::string declaration = "float[] primvars:" + points.values[v];
            bytes_.text(indent + declaration);
            bytes_.text(" (\n            interpolation = \"vertex\"\n        )\n");
            samples(
                declaration, [v](const ScenePointFrame& frame) -> const auto& { return frame.values[v]; });
        }
        samples("int[] protoIndices", std::mem_fn(&ScenePointFrame::meshes));
        std::vector<std::string> mesh_names;
        for (const std::size_t mesh : points.meshes) {
            mesh_names.push_back(scene_.meshes[mesh].name);
        }
        const std::vector<PrimName> prims = primNames(mesh_names);
        bytes_.text(indent + "rel prototypes = [");
        for (std::size_t i = 0; i < prims.size(); ++i) {
            bytes_.text(i == 0 ? "<" : ", <");
            bytes_.text(std::string(kRoot) + name.prim + "/Prototypes/" + prims[i].prim + ">");
        }
        bytes_.text("]\n");
        samples("float3[] scales", std::mem_fn(&ScenePointFrame::scales));
        samples("vector3f[] velocities", std::mem_fn(&ScenePointFrame::velocities));
        beginPrim(bytes_, indent, "Scope", "Prototypes", {});
        for (std::size_t i = 0; i < prims.size(); ++i) {
            const MeshWriter::Place place{indent + "    ", prims[i], material_paths_};
            MeshWriter writer(scene_, scene_.meshes[points.meshes[i]], nullptr, bytes_);
            writer.begin(place);
            writer.end(place, material_names_);
        }
        bytes_.text(indent + "}\n    }\n");
    }

    /// Quaternions with the real part first. They are of half precision, so more digits would be lost.
    static std::vector<Float4> orientations(const std::vector<Float4>& rotations)
    {
        constexpr float kParts = 1e4F;
        std::vector<Float4> all;
        all.reserve(rotations.size());
        for (const auto& [x, y, z, w] : rotations) {
            Float4& turn = all.emplace_back(Float4{w, x, y, z});
            for (float& part : turn) {
                part = std::round(kParts * part) / kParts + 0.0F;
            }
        }
        return all;
    }

    /// Writes a box that holds all copies at all times, unless there are none.
    void writeExtent(const ScenePoints& points, const std::string& indent)
    {
        std::vector<float> radii;
        for (const std::size_t mesh : points.meshes) {
            float radius = 0.0F;
            for (const SceneGeometry& geometry : scene_.meshes[mesh].geometries) {
                for (const Float3& p : geometry.vertices) {
                    radius = std::max(radius, std::hypot(p[0], p[1], p[2]));
                }
            }
            radii.push_back(radius);
        }
        std::array<Float3, 2> box{};
        bool is_empty = true;
        for (const ScenePointFrame& frame : points.frames) {
            for (std::size_t i = 0; i < frame.ids.size(); ++i) {
                const Float3& scale = frame.scales[i];
                const float reach = radii[frame.meshes[i]] * std::max({scale[0], scale[1], scale[2]});
                for (std::size_t k = 0; k < 3; ++k) {
                    const float at = frame.translations[i][k];
                    box[0][k] = is_empty ? at - reach : std::min(box[0][k], at - reach);
                    box[1][k] = is_empty ? at + reach : std::max(box[1][k], at + reach);
                }
                is_empty = false;
            }
        }
        if (!is_empty) {
            bytes_.text(indent + "float3[] extent = ");
            writeList(bytes_, box.size(), [&](std::size_t i) { return box[i]; });
            bytes_.u8('\n');
        }
    }

    /// Blender and Omniverse show attributes of this namespace as a prim's own.
    void writeProperties(const SceneNode& node, const std::string& indent)
    {
        for (const auto& [name, value] : node.properties) {
            if (const double* const number = std::get_if<double>(&value)) {
                bytes_.text(indent);
                bytes_.text("custom double userProperties:");
                bytes_.text(name);
                bytes_.text(" = ");
                bytes_.digits(*number);
                bytes_.u8('\n');
            }
        }
    }

    void writeTransform(std::size_t index, const std::string& indent)
    {
        const SceneNode& node = scene_.nodes[index];
        std::string order;
        const auto operation = [&](SceneChange change, const char* type, const char* name, const auto& rest,
                                   const auto& neutral, const auto& write_value) {
            const SceneTrack* const track = trackOf(index, change);
            if (!track && rest == neutral) {
                return;
            }
            order += std::string(order.empty() ? "" : ", ") + "\"xformOp:" + name + "\"";
            bytes_.text(indent + type + " xformOp:" + name);
            if (track) {
                writeSamples(bytes_, indent, samplesOf(*track, scene_), [&](std::size_t key) {
                    write_value([&](std::size_t k) { return track->values[key * rest.size() + k]; });
                });
            } else {
                bytes_.text(" = ");
                write_value([&](std::size_t k) { return static_cast<float>(rest[k]); });
            }
            bytes_.u8('\n');
        };
        const auto vector = [&](const auto& at) { droplet::write(bytes_, Float3{at(0), at(1), at(2)}); };
        const auto quaternion = [&](const auto& at) { droplet::write(bytes_, Float4{at(3), at(0), at(1), at(2)}); };
        const SceneNode neutral;
        operation(SceneChange::Translation, "double3", "translate", node.translation, neutral.translation, vector);
        operation(SceneChange::Rotation, "quatf", "orient", node.rotation, neutral.rotation, quaternion);
        operation(SceneChange::Scale, "float3", "scale", node.scale, neutral.scale, vector);
        if (!order.empty()) {
            bytes_.text(indent + "uniform token[] xformOpOrder = [" + order + "]\n");
        }
    }

    const Scene& scene_;
    ByteStream& bytes_;
    std::vector<std::vector<const SceneTrack*>> tracks_;  ///< of every node
    std::vector<Class> classes_;
    std::vector<std::optional<std::size_t>> class_of_;  ///< of every node
    std::vector<PrimName> root_names_;                  ///< of nodes, then of the points
    std::vector<PrimName> class_names_;
    std::vector<bool> has_colours_;  ///< of every material: its vertices have colours
    std::vector<PrimName> material_names_;
    std::vector<std::string> material_paths_;
    std::vector<std::size_t> written_materials_;
};

void checkCorners(const Scene& scene)
{
    constexpr std::size_t kMaxIndices = std::numeric_limits<std::int32_t>::max();
    for (const SceneMesh& mesh : scene.meshes) {
        std::size_t triangles = 0;
        std::size_t vertices = 0;
        for (const SceneGeometry& geometry : mesh.geometries) {
            vertices += geometry.vertices.size();
            for (const ScenePart& part : geometry.parts) {
                triangles += part.triangles.size();
            }
        }
        if (triangles > kMaxIndices / 3 || vertices > kMaxIndices) {
            throw Error(ErrorCode::InvalidArgument, "surface has " + std::to_string(triangles) + " triangles and " +
                                                        std::to_string(vertices) +
                                                        " vertices; USD allows at most 2147483647 corners");
        }
    }
}

std::uint64_t writeLayer(const Scene& scene, std::ostream& out)
{
    ByteStream bytes(out);
    LayerWriter(scene, bytes).write();
    return bytes.finish();
}

/// Writes a package.
std::uint64_t writePackage(const Scene& scene, std::ostream& out)
{
    std::vector<ZipEntry> files{{kLayer, [&](std::ostream& layer) { return writeLayer(scene, layer); }}};
    if (scene.picture) {
        files.push_back({kPicture, [&](std::ostream& picture) {
                             ByteStream bytes(picture);
                             bytes.text(scene.picture->png);
                             return bytes.finish();
                         }});
    }
    return writeZip(files, out, {.alignment = 64, .kind = "USDZ"});
}

}  // namespace

std::uint64_t writeUsd(const Scene& scene, std::ostream& out, const AnimatedFile& file)
{
    if (file.compression != Compression::None) {
        throw Error(ErrorCode::InvalidArgument,
                    std::string("options.compression = ") + name(file.compression) + " needs a GLB");
    }
    if (scene.picture && !scene.picture->is_colour) {
        throw Error(ErrorCode::InvalidArgument, "droplets in a texture need glTF: USD has no shader that places them");
    }
    checkCorners(scene);
    if (file.format == Format::Usda && scene.picture) {
        throw Error(ErrorCode::InvalidArgument, "options.texture has " + std::to_string(scene.picture->png.size()) +
                                                    " bytes; it must be empty, because only USDZ holds pictures");
    }
    return file.format == Format::Usdz ? writePackage(scene, out) : writeLayer(scene, out);
}

}  // namespace droplet
