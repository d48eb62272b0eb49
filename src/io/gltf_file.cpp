// SPDX-License-Identifier: GPL-3.0-or-later
// Khronos Group, "glTF 2.0 Specification" (2021), sections 3.5, 3.6 and 4.
//
// tinygltf (2.7) loads the file, after checks that it does not make itself. Without them it reads eight bytes past the
// end of a GLB whose last chunk is cut short; it loads every image that a file names; it treats values of a wrong type
// as missing and truncates numbers to 32 bits; it follows nested extras to any depth; it looks for buffers in the
// working directory.
#include "io/gltf_file.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <deque>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "file_bytes.h"
#include "io/meshopt_views.h"

namespace droplet {
namespace {

using Json = nlohmann::json;

std::string_view textOf(std::span<const std::byte> bytes)
{
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// ----------------------------------------------------------------------------------------------- the container

struct Container {
    std::string_view json;
    std::span<const std::byte> chunk;  ///< binary chunk of a GLB
};

/// Splits a GLB into chunks (section 4.4).
Container containerOf(std::span<const std::byte> bytes)
{
    constexpr std::uint32_t kJson = 0x4E4F534A;
    constexpr std::uint32_t kBin = 0x004E4942;
    constexpr std::size_t kHeader = 12;
    constexpr std::size_t kChunkHeader = 8;
    if (!textOf(bytes).starts_with("glTF")) {
        return {textOf(bytes), {}};
    }
    const auto word = [](std::span<const std::byte> from, std::size_t at) {
        std::uint32_t value = 0;
        for (std::size_t i = 0; i < 4; ++i) {
            value |= std::to_integer<std::uint32_t>(from[at + i]) << (8 * i);
        }
        return value;
    };
    if (bytes.size() < kHeader || word(bytes, 4) != 2 || word(bytes, 8) > bytes.size() || word(bytes, 8) < kHeader) {
        throw Damage("it is cut short or not a GLB of version 2");
    }
    std::span<const std::byte> rest = bytes.subspan(kHeader, word(bytes, 8) - kHeader);
    const auto next = [&](std::uint32_t kind) {
        if (rest.size() < kChunkHeader || word(rest, 4) != kind || word(rest, 0) > rest.size() - kChunkHeader) {
            throw Damage("a chunk of the GLB is cut short or out of order");
        }
        const std::span<const std::byte> content = rest.subspan(kChunkHeader, word(rest, 0));
        rest = rest.subspan(kChunkHeader + content.size());
        return content;
    };
    const std::string_view json = textOf(next(kJson));
    return {json, rest.empty() ? rest : next(kBin)};
}

// ------------------------------------------------------------------------------------------------ the checks

/// Parses JSON without extras, and without extensions unless they are wanted.
Json parsed(std::string_view text, bool with_extensions = false)
{
    constexpr int kDeepest = 64;  // glTF needs 7; extras have no limit
    const auto keep = [with_extensions](int depth, Json::parse_event_t event, const Json& value) {
        if (depth > kDeepest) {
            throw Damage("its JSON is nested more than " + std::to_string(kDeepest) + " deep");
        }
        return event != Json::parse_event_t::key || (value != "extras" && (with_extensions || value != "extensions"));
    };
    constexpr bool kThrow = false;
    Json root = Json::parse(text, keep, kThrow);
    if (!root.is_object()) {
        throw Damage("it is not glTF: its JSON is damaged or cut short");
    }
    return root;
}

enum class Number { Index, Indices, Size };

/// Checks that a number, if present, is an integer that tinygltf reads unchanged; 1.0 becomes 1.
void checkWhole(Json& object, const char* key, Number kind)
{
    const auto found = object.find(key);
    if (found == object.end()) {
        return;
    }
    constexpr double kExact = 9007199254740992.0;  // 2⁵³: integers up to it are exact doubles
    const double max = kind == Number::Size ? kExact : std::numeric_limits<int>::max();
    const auto check = [&](Json& value) {
        const double number = value.is_number() ? value.get<double>() : -1.0;
        if (!(number >= 0.0 && number <= max && std::floor(number) == number)) {
            throw Damage(std::string("\"") + key + "\" is not a valid index or count");
        }
        value = static_cast<std::uint64_t>(number);
    };
    if (kind != Number::Indices) {
        check(*found);
    } else if (found->is_array()) {
        std::for_each(found->begin(), found->end(), check);
    } else {
        throw Damage(std::string("\"") + key + "\" is not a list");
    }
}

void checkNumbers(const Json& object, const char* key, std::size_t count)
{
    const auto found = object.find(key);
    if (found != object.end() &&
        !(found->is_array() && found->size() == count &&
          std::all_of(found->begin(), found->end(), [](const Json& n) { return n.is_number(); }))) {
        throw Damage(std::string("\"") + key + "\" must be a list of " + std::to_string(count) + " numbers");
    }
}

/// Calls `check` for every object of a list, if the list exists.
template <typename Check>
void forObjects(Json& parent, const char* list, const Check& check)
{
    const auto found = parent.find(list);
    if (found == parent.end()) {
        return;
    }
    for (Json& object : *found) {
        if (!found->is_array() || !object.is_object()) {
            throw Damage(std::string("\"") + list + "\" is not a list of objects");
        }
        check(object);
    }
}

void checkIndices(Json& attributes)
{
    for (const auto& attribute : attributes.items()) {
        checkWhole(attributes, attribute.key().c_str(), Number::Index);
    }
}

void checkSparse(Json& sparse)
{
    for (const char* const part : {"indices", "values"}) {
        const auto found = sparse.find(part);  // end() of anything but an object
        if (found == sparse.end() || !found->is_object() || !found->contains("bufferView")) {
            throw Damage(std::string("an accessor is sparse without ") + part);
        }
        for (const char* const key : {"bufferView", "byteOffset", "componentType"}) {
            checkWhole(*found, key, Number::Index);
        }
    }
    checkWhole(sparse, "count", Number::Index);
}

/// Checks types and ranges of the values that tinygltf does not check.
void checkValues(Json& root)
{
    struct Rule {
        const char* list;
        const char* key;
        Number kind;
    };
    constexpr std::array<Rule, 13> kRules = {{{"scenes", "nodes", Number::Indices},
                                              {"nodes", "mesh", Number::Index},
                                              {"nodes", "skin", Number::Index},
                                              {"nodes", "children", Number::Indices},
                                              {"accessors", "bufferView", Number::Index},
                                              {"accessors", "componentType", Number::Index},
                                              {"accessors", "byteOffset", Number::Size},
                                              {"accessors", "count", Number::Size},
                                              {"bufferViews", "buffer", Number::Index},
                                              {"bufferViews", "byteOffset", Number::Size},
                                              {"bufferViews", "byteLength", Number::Size},
                                              {"bufferViews", "byteStride", Number::Size},
                                              {"buffers", "byteLength", Number::Size}}};
    for (const Rule& rule : kRules) {
        forObjects(root, rule.list, [&](Json& object) { checkWhole(object, rule.key, rule.kind); });
    }
    checkWhole(root, "scene", Number::Index);
    forObjects(root, "accessors", [](Json& accessor) {
        if (const auto sparse = accessor.find("sparse"); sparse != accessor.end()) {
            checkSparse(*sparse);
        }
    });
    forObjects(root, "nodes", [](Json& node) {
        checkNumbers(node, "matrix", 16);
        checkNumbers(node, "translation", 3);
        checkNumbers(node, "rotation", 4);
        checkNumbers(node, "scale", 3);
    });
    forObjects(root, "meshes", [](Json& mesh) {
        forObjects(mesh, "primitives", [](Json& primitive) {
            checkWhole(primitive, "mode", Number::Index);
            checkWhole(primitive, "indices", Number::Index);
            checkWhole(primitive, "material", Number::Index);
            const auto attributes = primitive.find("attributes");
            if (attributes != primitive.end() && attributes->is_object()) {
                checkIndices(*attributes);
            }
            forObjects(primitive, "targets", checkIndices);
        });
    });
}

// ----------------------------------------------------------------------------- materials, animations and skins

/// Member of an object in a list, or of an object; null if there is none.
const Json& memberOf(const Json& parent, const char* key)
{
    static const Json none;
    const auto found = parent.find(key);  // end() of anything but an object
    return found == parent.end() ? none : *found;
}

std::string textOf(const Json& value, const char* otherwise)
{
    return value.is_string() ? value.get<std::string>() : otherwise;
}

std::optional<int> indexOf(const Json& value)
{
    const double number = value.is_number() ? value.get<double>() : -1.0;
    return number >= 0.0 && number <= std::numeric_limits<int>::max() && std::floor(number) == number
               ? std::optional(static_cast<int>(number))
               : std::nullopt;
}

std::vector<std::string> materialNamesOf(const Json& root)
{
    std::vector<std::string> names;
    for (const Json& material : memberOf(root, "materials")) {
        names.push_back(textOf(memberOf(material, "name"), ""));
    }
    return names;
}

/// Place of a texture's image: a file, or a view of a buffer.
struct ReadTexture {
    std::string uri;
    std::optional<int> view;
    TexturePlace place;
    std::string ignored;  ///< what of the texture is not read; or empty
};

struct ReadMaterial {
    FileMaterial material;
    ReadTexture colours;
    ReadTexture normals;
    ReadTexture finish;
    ReadTexture glows;
};

ReadTexture textureOf(const Json& root, const Json& from)
{
    const auto element = [](const Json& list, const Json& index) -> const Json& {
        static const Json none;
        const auto at = indexOf(index);
        return at && list.is_array() && static_cast<std::size_t>(*at) < list.size()
                   ? list[static_cast<std::size_t>(*at)]
                   : none;
    };
    const Json& texture = element(memberOf(root, "textures"), memberOf(from, "index"));
    const Json& image = element(memberOf(root, "images"), memberOf(texture, "source"));
    ReadTexture read{textOf(memberOf(image, "uri"), ""), indexOf(memberOf(image, "bufferView")), {}, ""};
    const Json& transform = memberOf(memberOf(from, "extensions"), "KHR_texture_transform");
    const auto number = [](const Json& value, double otherwise) {
        return value.is_number() && std::isfinite(value.get<double>()) ? value.get<double>() : otherwise;
    };
    const auto pair = [&](const char* key, double otherwise) {
        const Json& values = memberOf(transform, key);
        return values.is_array() && values.size() == 2
                   ? Vec2{number(values[0], otherwise), number(values[1], otherwise)}
                   : Vec2{otherwise, otherwise};
    };
    read.place = {pair("offset", 0.0), number(memberOf(transform, "rotation"), 0.0), pair("scale", 1.0)};
    const int set = indexOf(memberOf(transform, "texCoord")).value_or(indexOf(memberOf(from, "texCoord")).value_or(0));
    if (set != 0) {
        read.ignored = "is shown over TEXCOORD_0, not its own";
    }
    return read;
}

/// Metallic-roughness materials, KHR_materials_transmission, KHR_materials_volume, KHR_materials_ior and
/// KHR_materials_emissive_strength. What is not as specified is left out.
std::vector<ReadMaterial> materialsOf(const Json& root)
{
    std::vector<ReadMaterial> materials;
    const auto share = [](const Json& value, double otherwise) {
        return value.is_number() ? std::clamp(value.get<double>(), 0.0, 1.0) : otherwise;
    };
    const auto positive = [](const Json& value) {
        return value.is_number() && value.get<double>() > 0.0 && std::isfinite(value.get<double>())
                   ? std::optional(value.get<double>())
                   : std::nullopt;
    };
    for (const Json& from : memberOf(root, "materials")) {
        ReadMaterial& read = materials.emplace_back();
        FileMaterial& material = read.material;
        Look& look = material.look;
        const Json& surface = memberOf(from, "pbrMetallicRoughness");
        const Json& colour = memberOf(surface, "baseColorFactor");
        const auto channel = [&](std::size_t k) {
            return colour.is_array() && colour.size() == 4 ? share(colour[k], 1.0) : 1.0;
        };
        look.colour = {channel(0), channel(1), channel(2)};
        look.metallic = share(memberOf(surface, "metallicFactor"), 1.0);
        look.roughness = share(memberOf(surface, "roughnessFactor"), 1.0);
        const std::string alpha = textOf(memberOf(from, "alphaMode"), "OPAQUE");
        if (alpha == "BLEND") {
            material.opacity = channel(3);
            material.blends = true;
        } else if (alpha == "MASK") {
            material.cutoff = share(memberOf(from, "alphaCutoff"), 0.5);
        }
        const Json& extensions = memberOf(from, "extensions");
        look.transmission =
            share(memberOf(memberOf(extensions, "KHR_materials_transmission"), "transmissionFactor"), 0.0);
        const Json& ior = memberOf(memberOf(extensions, "KHR_materials_ior"), "ior");
        look.ior = ior.is_number() && ior.get<double>() >= 1.0 && ior.get<double>() <= 4.0 ? ior.get<double>() : 1.5;
        const Json& volume = memberOf(extensions, "KHR_materials_volume");
        material.thickness = positive(memberOf(volume, "thicknessFactor"));
        material.refracts = material.thickness.has_value();
        const Json& tint = memberOf(volume, "attenuationColor");
        const auto distance = positive(memberOf(volume, "attenuationDistance"));
        if (material.thickness && distance && tint.is_array() && tint.size() == 3) {
            constexpr double kDark = 1e-3;  // black would be absorbed over no distance
            const auto passes = [&](std::size_t k) { return std::max(share(tint[k], 1.0), kDark); };
            material.absorption = Attenuation{{passes(0), passes(1), passes(2)}, *distance};
        }
        const Json& glow = memberOf(from, "emissiveFactor");
        if (glow.is_array() && glow.size() == 3) {
            const Json& strength =
                memberOf(memberOf(extensions, "KHR_materials_emissive_strength"), "emissiveStrength");
            const double factor = std::min(positive(strength).value_or(strength == 0 ? 0.0 : 1.0), kMaxGlow);
            material.glow = factor * Vec3{share(glow[0], 0.0), share(glow[1], 0.0), share(glow[2], 0.0)};
        }
        read.glows = textureOf(root, memberOf(from, "emissiveTexture"));
        read.colours = textureOf(root, memberOf(surface, "baseColorTexture"));
        read.finish = textureOf(root, memberOf(surface, "metallicRoughnessTexture"));
        const Json& normals = memberOf(from, "normalTexture");
        read.normals = textureOf(root, normals);
        const Json& scale = memberOf(normals, "scale");
        material.relief = scale.is_number() && std::isfinite(scale.get<double>()) ? scale.get<double>() : 1.0;
    }
    return materials;
}

/// Text of a URI in which %20 is a space.
std::string unescaped(std::string_view uri)
{
    std::string text;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        const std::string_view code = uri.substr(i + 1, 2);
        unsigned value = 0;
        if (uri[i] == '%' && code.size() == 2 &&
            std::from_chars(code.data(), code.data() + 2, value, 16).ptr == code.data() + 2) {
            text.push_back(static_cast<char>(value));
            i += 2;
        } else {
            text.push_back(uri[i]);
        }
    }
    return text;
}

FileTexture withImage(const ReadTexture& read, const tinygltf::Model& model, const std::filesystem::path& folder)
{
    FileTexture texture;
    if (read.view) {
        const auto view = static_cast<std::size_t>(*read.view);
        texture.name = "the image in bufferView " + std::to_string(view);
        const tinygltf::BufferView* const part = view < model.bufferViews.size() ? &model.bufferViews[view] : nullptr;
        const auto buffer = part != nullptr ? static_cast<std::size_t>(part->buffer) : model.buffers.size();
        if (buffer < model.buffers.size() && part->byteOffset <= model.buffers[buffer].data.size() &&
            part->byteLength <= model.buffers[buffer].data.size() - part->byteOffset) {
            const auto bytes = std::as_bytes(std::span(model.buffers[buffer].data));
            const auto image = bytes.subspan(part->byteOffset, part->byteLength);
            texture.image.assign(image.begin(), image.end());
        } else {
            texture.fault = "is outside of its buffer";
        }
    } else if (read.uri.starts_with("data:")) {
        texture.name = "an embedded image";
        std::vector<unsigned char> decoded;
        std::string type;
        if (tinygltf::DecodeDataURI(&decoded, type, read.uri, 0, false)) {
            const auto image = std::as_bytes(std::span(decoded));
            texture.image.assign(image.begin(), image.end());
        } else {
            texture.fault = "is not base64";
        }
    } else if (!read.uri.empty()) {
        texture = readTextureBeside(folder, unescaped(read.uri));
    }
    texture.place = read.place;
    if (texture.fault.empty()) {
        texture.fault = read.ignored;
    }
    return texture;
}

std::vector<FileMaterial> withImages(std::vector<ReadMaterial> all, const tinygltf::Model& model,
                                     const std::filesystem::path& folder)
{
    std::vector<FileMaterial> materials;
    for (ReadMaterial& read : all) {
        FileMaterial& material = materials.emplace_back(std::move(read.material));
        material.colours = withImage(read.colours, model, folder);
        material.normals = withImage(read.normals, model, folder);
        material.finish = withImage(read.finish, model, folder);
        material.glows = withImage(read.glows, model, folder);
    }
    return materials;
}

/// Channels that are damaged have no node: not all readers need them.
std::vector<GltfAnimation> animationsOf(const Json& root)
{
    std::vector<GltfAnimation> animations;
    for (const Json& from : memberOf(root, "animations")) {
        const Json& samplers = memberOf(from, "samplers");
        GltfAnimation& animation = animations.emplace_back();
        animation.name = textOf(memberOf(from, "name"), "");
        for (const Json& part : memberOf(from, "channels")) {
            GltfChannel& channel = animation.channels.emplace_back();
            const Json& target = memberOf(part, "target");
            const std::optional<int> sampler = indexOf(memberOf(part, "sampler"));
            if (const auto node = indexOf(memberOf(target, "node"));
                node && sampler && samplers.is_array() && static_cast<std::size_t>(*sampler) < samplers.size()) {
                const Json& values = samplers[static_cast<std::size_t>(*sampler)];
                channel.node = static_cast<std::size_t>(*node);
                channel.path = textOf(memberOf(target, "path"), "");
                channel.interpolation = textOf(memberOf(values, "interpolation"), "LINEAR");
                channel.times = indexOf(memberOf(values, "input")).value_or(-1);
                channel.values = indexOf(memberOf(values, "output")).value_or(-1);
            }
        }
    }
    return animations;
}

/// Joints that are damaged are too large: not all readers need them. tinygltf wants matrices, which a skin may lack.
std::vector<GltfSkin> skinsOf(const Json& root)
{
    std::vector<GltfSkin> skins;
    for (const Json& from : memberOf(root, "skins")) {
        GltfSkin& skin = skins.emplace_back();
        skin.matrices = indexOf(memberOf(from, "inverseBindMatrices")).value_or(-1);
        for (const Json& joint : memberOf(from, "joints")) {
            skin.joints.push_back(static_cast<std::size_t>(indexOf(joint).value_or(std::numeric_limits<int>::max())));
        }
    }
    return skins;
}

// ----------------------------------------------------------------------------------------------- the buffers

/// Buffer that is not embedded.
struct Source {
    std::string name;
    std::size_t length = 0;
    std::span<const std::byte> chunk;  ///< empty: the buffer is a file
};

/// Buffers in the order in which tinygltf loads them.
using Sources = std::deque<Source>;

/// Converts buffers to the form that tinygltf accepts: base64 with its media type and exactly the stated length.
Sources sourcesOf(Json& root, std::span<const std::byte> chunk)
{
    Sources sources;
    std::size_t index = 0;
    forObjects(root, "buffers", [&](Json& buffer) {
        const std::string name = "buffers[" + std::to_string(index) + "]";
        const std::size_t length = buffer.value("byteLength", std::size_t{0});
        const std::string uri = buffer.value("uri", std::string());
        if (uri.starts_with("data:")) {
            constexpr std::string_view kMark = ";base64,";
            const std::size_t mark = uri.find(kMark);
            if (mark == std::string::npos) {
                throw Damage(name + " is embedded, but not as base64");
            }
            const std::size_t max = length / 3 * 4 + (length % 3 > 0 ? length % 3 + 1 : 0);
            buffer["uri"] = "data:application/octet-stream;base64," + uri.substr(mark + kMark.size(), max);
        } else if (uri.empty()) {
            if (index > 0 || chunk.size() < length || length == 0) {
                throw Damage(name + " holds " + std::to_string(index > 0 ? 0 : chunk.size()) + " bytes of " +
                             std::to_string(length));
            }
            buffer["uri"] = "chunk";
            sources.push_back({name, length, chunk.first(length)});
        } else if (uri.starts_with('/') || uri.find("://") != std::string::npos) {
            throw Damage(name + " must be a file beside the glTF file, not " + uri);
        } else {
            sources.push_back({name + ", " + uri, length, {}});
        }
        ++index;
    });
    return sources;
}

bool readSource(std::vector<unsigned char>* to, std::string* /*error*/, const std::string& path, void* user)
{
    auto& sources = *static_cast<Sources*>(user);
    const Source source = std::move(sources.front());
    sources.pop_front();
    Bytes bytes;
    std::span<const std::byte> content = source.chunk;
    if (content.empty()) {
        try {
            std::error_code none;
            if (std::filesystem::exists(path, none) && !std::filesystem::is_regular_file(path, none)) {
                throw Damage("it is not a regular file");
            }
            bytes = readBytes(path, source.length, [](std::byte) { return true; });
        } catch (const Damage& damage) {
            throw Damage(source.name + ": " + damage.what());
        }
        content = bytes;
    }
    if (content.size() < source.length) {
        throw Damage(source.name + " holds " + std::to_string(content.size()) + " bytes of " +
                     std::to_string(source.length));
    }
    to->resize(content.size());
    std::memcpy(to->data(), content.data(), content.size());
    return true;
}

/// tinygltf's reading of files. From version 2.9 on it asks for their sizes, too, and wants all functions.
template <typename Callbacks>
Callbacks callbacksFor(Sources& sources)
{
    Callbacks callbacks{};
    callbacks.FileExists = [](const std::string&, void*) { return true; };
    callbacks.ExpandFilePath = [](const std::string& name, void*) { return name; };
    callbacks.ReadWholeFile = readSource;
    callbacks.WriteWholeFile = [](std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
        return false;
    };
    if constexpr (requires { callbacks.GetFileSizeInBytes; }) {
        callbacks.GetFileSizeInBytes = [](std::size_t* size, std::string*, const std::string&, void*) {
            *size = 0;  // readSource() knows it
            return true;
        };
    }
    callbacks.user_data = &sources;
    return callbacks;
}

}  // namespace

GltfFile readGltfFile(const std::filesystem::path& path, bool reads_materials)
{
    const Bytes bytes =
        readBytes(path, std::numeric_limits<std::uint32_t>::max(),  // largest size that a GLB can state
                  [](std::byte first) {
                      return std::string_view("g{ \t\r\n\xef").find(static_cast<char>(first)) != std::string_view::npos;
                  });
    const Container container = containerOf(bytes);
    Json root = parsed(container.json);
    for (const char* const required : {"KHR_draco_mesh_compression", "KHR_meshopt_compression"}) {
        const auto list = root.find("extensionsRequired");
        if (list != root.end() && std::find(list->begin(), list->end(), required) != list->end()) {
            throw Damage(std::string("its meshes are compressed, which is not supported: ") + required);
        }
    }
    std::vector<MeshoptView> meshopt_views;
    if (container.json.find("EXT_meshopt_compression") != std::string_view::npos) {
        meshopt_views = findMeshoptViews(root, parsed(container.json, true));
    }
    checkValues(root);
    Sources sources = sourcesOf(root, container.chunk);
    GltfFile file;
    file.material_names = materialNamesOf(root);
    file.animations = animationsOf(root);
    file.skins = skinsOf(root);
    std::vector<ReadMaterial> materials;
    if (reads_materials) {
        const bool is_extended = container.json.find("\"KHR_") != std::string_view::npos;
        materials = materialsOf(is_extended ? parsed(container.json, true) : root);
    }
    Json kept = Json::object();
    for (const char* const key : {"scene", "scenes", "nodes", "meshes", "accessors", "bufferViews", "buffers"}) {
        if (const auto found = root.find(key); found != root.end()) {
            kept[key] = std::move(*found);
        }
    }
    const std::string text = kept.dump();
    if (text.size() > std::numeric_limits<unsigned>::max()) {
        throw Damage("its JSON is longer than 4 GiB");
    }
    tinygltf::TinyGLTF loader;
    loader.SetFsCallbacks(callbacksFor<tinygltf::FsCallbacks>(sources));
    std::string error;
    std::string warning;
    const std::string folder = path.has_parent_path() ? path.parent_path().string() : ".";
    const bool loaded = loader.LoadASCIIFromString(&file.model, &error, &warning, text.data(),
                                                   static_cast<unsigned>(text.size()), folder, tinygltf::NO_REQUIRE);
    if (!loaded || !error.empty()) {
        // If it cannot decode a buffer, its message contains the whole text.
        constexpr std::size_t kLongest = 100;
        throw Damage("it is not glTF 2.0: " + error.substr(0, std::min(error.find('\n'), kLongest)));
    }
    decodeMeshoptViews(file.model, meshopt_views);
    file.materials = withImages(std::move(materials), file.model, folder);
    return file;
}

}  // namespace droplet
