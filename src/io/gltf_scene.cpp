// SPDX-License-Identifier: GPL-3.0-or-later
// Khronos Group, "glTF 2.0 Specification" (2021), sections 3.5 to 3.7 and 4.
//
// tinygltf's reader would not do for files of strangers: of a GLB whose last chunk is cut it (2.7) reads eight bytes
// past the end, and it fetches every image that a file names before anyone can say no.
#include "io/gltf_scene.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "droplet/units.h"
#include "file_bytes.h"
#include "io/axes.h"
#include "io/vertex_normals.h"

namespace droplet {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kMostTriangles = std::size_t{1} << 26;  // a small file can show one mesh any number of times

std::uint32_t word(std::span<const std::byte> bytes, std::size_t at, std::size_t count = 4)
{
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < count; ++i) {
        value |= std::to_integer<std::uint32_t>(bytes[at + i]) << (8 * i);
    }
    return value;
}

std::string_view textOf(std::span<const std::byte> bytes)
{
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// S. Josefsson, RFC 4648 (2006), section 4.
Bytes decodeBase64(std::string_view text)
{
    Bytes bytes;
    std::uint32_t group = 0;
    unsigned bits = 0;
    while (!text.empty() && text.back() == '=') {
        text.remove_suffix(1);
    }
    for (const char c : text) {
        constexpr std::string_view kSigns = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        const std::size_t value = kSigns.find(c);
        if (value == std::string_view::npos) {
            throw Damage("a buffer's base64 holds other characters");
        }
        group = group << 6 | static_cast<std::uint32_t>(value);
        bits += 6;
        if (bits >= 8) {
            bits -= 8;
            bytes.push_back(static_cast<std::byte>(group >> bits & 0xff));
        }
    }
    return bytes;
}

std::string percentDecoded(std::string_view uri)
{
    std::string text;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        constexpr std::string_view kDigits = "0123456789abcdef";
        const auto digit = [&](std::size_t at) {
            return at < uri.size() ? kDigits.find(static_cast<char>(uri[at] | 0x20)) : std::string_view::npos;
        };
        if (uri[i] == '%' && digit(i + 1) < 16 && digit(i + 2) < 16) {
            text += static_cast<char>(16 * digit(i + 1) + digit(i + 2));
            i += 2;
        } else {
            text += uri[i];
        }
    }
    return text;
}

// ------------------------------------------------------------------------------------------------------- JSON

const Json* find(const Json& object, const char* key)
{
    if (!object.is_object()) {
        throw Damage(std::string("what should hold \"") + key + "\" is no object");
    }
    const auto found = object.find(key);
    return found == object.end() ? nullptr : &*found;
}

std::size_t whole(const Json& value, const char* key)
{
    constexpr double kExact = 9007199254740992.0;  // 2⁵³: whole doubles up to there are exact
    const double number = value.is_number() ? value.get<double>() : -1.0;
    if (!(number >= 0.0 && number <= kExact && std::floor(number) == number)) {
        throw Damage(std::string("\"") + key + "\" is no index or count");
    }
    return static_cast<std::size_t>(number);
}

std::optional<std::size_t> findWhole(const Json& object, const char* key)
{
    const Json* const value = find(object, key);
    return value == nullptr ? std::nullopt : std::optional(whole(*value, key));
}

std::size_t needWhole(const Json& object, const char* key)
{
    const std::optional<std::size_t> value = findWhole(object, key);
    if (!value) {
        throw Damage(std::string("\"") + key + "\" is missing");
    }
    return *value;
}

std::vector<std::size_t> findWholes(const Json& object, const char* key)
{
    std::vector<std::size_t> values;
    if (const Json* const list = find(object, key)) {
        for (const Json& value : *list) {
            values.push_back(whole(value, key));
        }
    }
    return values;
}

template <std::size_t Count>
std::optional<std::array<double, Count>> findNumbers(const Json& object, const char* key)
{
    const Json* const list = find(object, key);
    if (list == nullptr) {
        return std::nullopt;
    }
    std::array<double, Count> numbers{};
    const bool sound = list->is_array() && list->size() == Count &&
                       std::all_of(list->begin(), list->end(), [](const Json& n) { return n.is_number(); });
    if (!sound) {
        throw Damage(std::string("\"") + key + "\" is not " + std::to_string(Count) + " numbers");
    }
    std::transform(list->begin(), list->end(), numbers.begin(), [](const Json& n) { return n.get<double>(); });
    return numbers;
}

std::string findText(const Json& object, const char* key)
{
    const Json* const value = find(object, key);
    return value != nullptr && value->is_string() ? value->get<std::string>() : std::string();
}

std::size_t sizeOf(const Json& root, const char* list)
{
    const Json* const all = find(root, list);
    return all != nullptr && all->is_array() ? all->size() : 0;
}

const Json& entry(const Json& root, const char* list, std::size_t index)
{
    if (index >= sizeOf(root, list)) {
        throw Damage(std::string(list) + "[" + std::to_string(index) + "] does not exist");
    }
    return root[list][index];
}

// -------------------------------------------------------------------------------------------------- the file

/// A file's description and its buffers.
struct File {
    explicit File(const std::filesystem::path& path);

    Json json;
    std::vector<Bytes> buffers;
};

Bytes bufferBytes(const Json& buffer, std::size_t index, std::span<const std::byte> chunk,
                  const std::filesystem::path& folder)
{
    const std::size_t length = needWhole(buffer, "byteLength");
    const std::string name = "buffers[" + std::to_string(index) + "]";
    const std::string uri = findText(buffer, "uri");
    Bytes bytes;
    if (uri.empty()) {
        bytes.assign(chunk.begin(), chunk.begin() + static_cast<std::ptrdiff_t>(std::min(length, chunk.size())));
    } else if (uri.starts_with("data:")) {
        const std::size_t comma = uri.find(";base64,");
        if (comma == std::string::npos) {
            throw Damage(name + " is embedded, but not as base64");
        }
        bytes = decodeBase64(std::string_view(uri).substr(comma + std::string_view(";base64,").size()));
    } else {
        const std::filesystem::path beside = percentDecoded(uri);
        if (beside.is_absolute() || uri.find("://") != std::string::npos) {
            throw Damage(name + " is not beside the file: " + uri);
        }
        try {
            std::error_code none;
            if (std::filesystem::exists(folder / beside, none) &&
                !std::filesystem::is_regular_file(folder / beside, none)) {
                throw Damage("no regular file");
            }
            bytes = readBytes(folder / beside, length, [](std::byte) { return true; });
        } catch (const Damage& damage) {
            throw Damage(name + ", " + uri + ": " + damage.what());
        }
    }
    if (bytes.size() < length) {
        throw Damage(name + " holds " + std::to_string(bytes.size()) + " bytes of " + std::to_string(length));
    }
    bytes.resize(length);
    return bytes;
}

File::File(const std::filesystem::path& path)
{
    const Bytes bytes =
        readBytes(path, std::numeric_limits<std::uint32_t>::max(),  // as many as a GLB can say it has
                  [](std::byte first) {
                      return std::string_view("g{ \t\r\n\xef").find(static_cast<char>(first)) != std::string_view::npos;
                  });
    std::span<const std::byte> text = bytes;
    std::span<const std::byte> chunk;
    if (textOf(bytes).starts_with("glTF")) {
        constexpr std::uint32_t kJson = 0x4E4F534A;
        constexpr std::uint32_t kBin = 0x004E4942;
        constexpr std::size_t kHeader = 12;
        constexpr std::size_t kChunkHeader = 8;
        if (bytes.size() < kHeader + kChunkHeader || word(bytes, 4) != 2 || word(bytes, 8) > bytes.size()) {
            throw Damage("it is cut short, or no GLB of version 2");
        }
        std::span<const std::byte> rest =
            std::span(bytes).subspan(kHeader, word(bytes, 8) - std::min<std::size_t>(kHeader, word(bytes, 8)));
        const auto next = [&rest](std::uint32_t kind) {
            if (rest.size() < kChunkHeader || word(rest, 4) != kind || word(rest, 0) > rest.size() - kChunkHeader) {
                throw Damage("a chunk of the GLB is cut short or out of order");
            }
            const std::span<const std::byte> content = rest.subspan(kChunkHeader, word(rest, 0));
            rest = rest.subspan(kChunkHeader + content.size());
            return content;
        };
        text = next(kJson);
        if (!rest.empty()) {
            chunk = next(kBin);
        }
    }
    constexpr bool kThrow = false;
    json = Json::parse(textOf(text), nullptr, kThrow);
    if (!json.is_object()) {
        throw Damage("it is no glTF: its JSON is damaged or cut short");
    }
    for (const char* const required : {"KHR_draco_mesh_compression", "EXT_meshopt_compression"}) {
        const Json* const list = find(json, "extensionsRequired");
        if (list != nullptr && std::find(list->begin(), list->end(), required) != list->end()) {
            throw Damage(std::string("its meshes are compressed, which is not read: ") + required);
        }
    }
    for (std::size_t i = 0; i < sizeOf(json, "buffers"); ++i) {
        buffers.push_back(bufferBytes(entry(json, "buffers", i), i, i == 0 ? chunk : std::span<const std::byte>(),
                                      path.parent_path()));
    }
}

// -------------------------------------------------------------------------------------------------- accessors

/// Component types as glTF numbers them.
enum Component : std::size_t { I8 = 5120, U8 = 5121, I16 = 5122, U16 = 5123, U32 = 5125, F32 = 5126 };

/// Numbers in a buffer, bounds checked when made.
class Column {
public:
    Column(const File& file, std::size_t accessor_index, std::string_view type)
    {
        const std::string name = "accessors[" + std::to_string(accessor_index) + "]";
        const Json& accessor = entry(file.json, "accessors", accessor_index);
        if (find(accessor, "sparse") != nullptr) {
            throw Damage(name + " is sparse, which is not read");
        }
        if (findText(accessor, "type") != type) {
            throw Damage(name + " should hold " + std::string(type));
        }
        const std::optional<std::size_t> view_index = findWhole(accessor, "bufferView");
        if (!view_index) {
            throw Damage(name + " has no data, or compressed data");
        }
        kind_ = needWhole(accessor, "componentType");
        count_ = needWhole(accessor, "count");
        const Json* const normalised = find(accessor, "normalized");
        normalised_ = normalised != nullptr && *normalised == true;
        constexpr std::array<std::size_t, 7> kBytes = {1, 1, 2, 2, 0, 4, 4};
        const std::size_t own = kind_ >= I8 && kind_ <= F32 ? kBytes[kind_ - I8] : 0;
        if (own == 0) {
            throw Damage(name + " has components of no known type");
        }
        width_ = type == "SCALAR" ? 1 : type == "VEC2" ? 2 : 3;
        component_bytes_ = own;

        const Json& view = entry(file.json, "bufferViews", *view_index);
        const std::size_t buffer_index = needWhole(view, "buffer");
        if (buffer_index >= file.buffers.size()) {
            throw Damage("buffers[" + std::to_string(buffer_index) + "] does not exist");
        }
        const std::span<const std::byte> buffer = file.buffers[buffer_index];
        const std::size_t begin = findWhole(view, "byteOffset").value_or(0);
        const std::size_t length = needWhole(view, "byteLength");
        const std::size_t offset = findWhole(accessor, "byteOffset").value_or(0);
        stride_ = findWhole(view, "byteStride").value_or(0);
        const std::size_t element = width_ * own;
        if (stride_ == 0) {
            stride_ = element;
        }
        const bool inside = begin <= buffer.size() && length <= buffer.size() - begin && offset <= length;
        if (!inside || stride_ < element ||
            (count_ > 0 && (length - offset < element || count_ - 1 > (length - offset - element) / stride_))) {
            throw Damage(name + " reaches beyond its buffer");
        }
        bytes_ = buffer.subspan(begin + offset, length - offset);
    }

    [[nodiscard]] std::size_t size() const { return count_; }
    [[nodiscard]] std::size_t kind() const { return kind_; }
    [[nodiscard]] bool normalised() const { return normalised_; }

    [[nodiscard]] std::uint32_t whole(std::size_t i, std::size_t k = 0) const
    {
        return word(bytes_, i * stride_ + k * component_bytes_, component_bytes_);
    }

    /// Section 3.11 of the specification says what normalised integers stand for.
    [[nodiscard]] double number(std::size_t i, std::size_t k) const
    {
        const std::uint32_t bits = whole(i, k);
        const auto scaled = [this](double value, double largest) {
            return normalised_ ? std::max(value / largest, -1.0) : value;
        };
        switch (kind_) {
            case F32:
                return static_cast<double>(std::bit_cast<float>(bits));
            case I8:
                return scaled(static_cast<std::int8_t>(bits), 127.0);
            case U8:
                return scaled(bits, 255.0);
            case I16:
                return scaled(static_cast<std::int16_t>(bits), 32767.0);
            case U16:
                return scaled(bits, 65535.0);
            default:
                return bits;
        }
    }

    [[nodiscard]] Vec2 vec2(std::size_t i) const { return {number(i, 0), number(i, 1)}; }
    [[nodiscard]] Vec3 vec3(std::size_t i) const { return {number(i, 0), number(i, 1), number(i, 2)}; }

private:
    std::span<const std::byte> bytes_;
    std::size_t stride_ = 0;
    std::size_t count_ = 0;
    std::size_t width_ = 0;
    std::size_t component_bytes_ = 0;
    std::size_t kind_ = 0;
    bool normalised_ = false;
};

// ------------------------------------------------------------------------------------------------- the scene

/// An affine map: images of the unit vectors, and of the origin.
struct Placement {
    Vec3 x{1.0, 0.0, 0.0};
    Vec3 y{0.0, 1.0, 0.0};
    Vec3 z{0.0, 0.0, 1.0};
    Vec3 origin;

    [[nodiscard]] Vec3 direction(Vec3 a) const { return a.x * x + a.y * y + a.z * z; }
    [[nodiscard]] Vec3 place(Vec3 a) const { return origin + direction(a); }
    [[nodiscard]] Placement of(const Placement& inner) const
    {
        return {direction(inner.x), direction(inner.y), direction(inner.z), place(inner.origin)};
    }
    [[nodiscard]] bool mirrors() const { return dot(cross(x, y), z) < 0.0; }
    /// Normals turn by the cofactors.
    [[nodiscard]] Vec3 normal(Vec3 a) const
    {
        return (mirrors() ? -1.0 : 1.0) * (a.x * cross(y, z) + a.y * cross(z, x) + a.z * cross(x, y));
    }
};

/// Section 3.5.3: a matrix by columns, or scale, then rotation, then translation.
Placement placementOf(const Json& node)
{
    if (const auto m = findNumbers<16>(node, "matrix")) {
        const auto column = [&m](std::size_t k) { return Vec3{(*m)[4 * k], (*m)[4 * k + 1], (*m)[4 * k + 2]}; };
        return {column(0), column(1), column(2), column(3)};
    }
    const auto t = findNumbers<3>(node, "translation").value_or(std::array{0.0, 0.0, 0.0});
    const auto s = findNumbers<3>(node, "scale").value_or(std::array{1.0, 1.0, 1.0});
    const auto q = findNumbers<4>(node, "rotation").value_or(std::array{0.0, 0.0, 0.0, 1.0});
    const double size = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (!(size > 0.0)) {
        throw Damage("a node's rotation is no quaternion");
    }
    const auto [x, y, z, w] = std::array{q[0] / size, q[1] / size, q[2] / size, q[3] / size};
    return {s[0] * Vec3{1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)},
            s[1] * Vec3{2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)},
            s[2] * Vec3{2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)},
            {t[0], t[1], t[2]}};
}

std::vector<std::size_t> rootsOf(const Json& root)
{
    if (sizeOf(root, "scenes") > 0) {
        return findWholes(entry(root, "scenes", findWhole(root, "scene").value_or(0)), "nodes");
    }
    std::vector<bool> child(sizeOf(root, "nodes"), false);
    for (std::size_t i = 0; i < child.size(); ++i) {
        for (const std::size_t c : findWholes(entry(root, "nodes", i), "children")) {
            if (c < child.size()) {
                child[c] = true;
            }
        }
    }
    std::vector<std::size_t> roots;
    for (std::size_t i = 0; i < child.size(); ++i) {
        if (!child[i]) {
            roots.push_back(i);
        }
    }
    return roots;
}

/// Section 3.7.2.1: triangles, strips and fans, by the mode of a primitive; none for points and lines.
std::vector<Triangle> trianglesOf(std::size_t mode, const std::vector<std::uint32_t>& index)
{
    constexpr std::size_t kTriangles = 4;
    constexpr std::size_t kStrip = 5;
    constexpr std::size_t kFan = 6;
    std::vector<Triangle> triangles;
    const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
        const Triangle t = {index[a], index[b], index[c]};
        if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) {
            triangles.push_back(t);
        }
    };
    for (std::size_t i = 0; mode == kTriangles && i + 2 < index.size(); i += 3) {
        add(i, i + 1, i + 2);
    }
    for (std::size_t i = 0; mode == kStrip && i + 2 < index.size(); ++i) {
        add(i, i + 1 + i % 2, i + 2 - i % 2);
    }
    for (std::size_t i = 1; mode == kFan && i + 1 < index.size(); ++i) {
        add(i, i + 1, 0);
    }
    return triangles;
}

class Scene {
public:
    Scene(const File& file, const SceneOptions& options) : file_(file), options_(options)
    {
        const Json& root = file.json;
        struct Visit {
            std::size_t node;
            Placement parent;
        };
        std::vector<Visit> open;
        const auto visit_later = [&open](std::vector<std::size_t> nodes, const Placement& parent) {
            std::reverse(nodes.begin(), nodes.end());  // a stack: the first comes first
            for (const std::size_t node : nodes) {
                open.push_back({node, parent});
            }
        };
        visit_later(rootsOf(root), {});
        mesh_.moves = sizeOf(root, "animations") > 0;
        std::vector<bool> seen(sizeOf(root, "nodes"), false);
        while (!open.empty()) {
            const Visit visit = open.back();
            open.pop_back();
            const Json& node = entry(root, "nodes", visit.node);
            if (seen[visit.node]) {
                throw Damage("nodes[" + std::to_string(visit.node) + "] has two parents");
            }
            seen[visit.node] = true;
            const Placement placement = visit.parent.of(placementOf(node));
            mesh_.moves = mesh_.moves || find(node, "skin") != nullptr;
            if (const std::optional<std::size_t> mesh = findWhole(node, "mesh")) {
                addMesh(*mesh, placement);
            }
            visit_later(findWholes(node, "children"), placement);
        }
        if (mesh_.triangles.empty()) {
            throw Damage("its scene has no triangles");
        }
        fillNormals(mesh_.positions, mesh_.triangles, mesh_.normals);
        for (std::size_t v = 0; v < mesh_.positions.size(); ++v) {
            mesh_.positions[v] = zUp(mesh_.positions[v]);
            mesh_.normals[v] = zUp(mesh_.normals[v]);
        }
    }

    [[nodiscard]] SceneMesh take() { return std::move(mesh_); }

private:
    void addMesh(std::size_t mesh_index, const Placement& placement)
    {
        const Json& mesh = entry(file_.json, "meshes", mesh_index);
        for (std::size_t i = 0; i < sizeOf(mesh, "primitives"); ++i) {
            const Json& primitive = entry(mesh, "primitives", i);
            constexpr std::size_t kTriangles = 4;
            const std::size_t mode = findWhole(primitive, "mode").value_or(kTriangles);
            if (mode >= kTriangles) {
                const std::string name = findText(mesh, "name");
                addPrimitive(primitive, mode, placement,
                             "mesh " + (name.empty() ? std::to_string(mesh_index) : "\"" + name + "\""));
            }
        }
    }

    void addPrimitive(const Json& primitive, std::size_t mode, const Placement& placement, const std::string& name)
    {
        const Json* const attributes = find(primitive, "attributes");
        if (attributes == nullptr) {
            throw Damage(name + " has no attributes");
        }
        mesh_.moves = mesh_.moves || sizeOf(primitive, "targets") > 0;
        const Column positions(file_, needWhole(*attributes, "POSITION"), "VEC3");
        const std::optional<std::size_t> uv_index = findWhole(*attributes, "TEXCOORD_0");
        if (!uv_index && options_.needs_uv) {
            throw Damage(name + " has no texture coordinates (uv) to lay droplets by; unwrap it first");
        }
        const std::optional<Column> uvs = uv_index ? std::optional(Column(file_, *uv_index, "VEC2")) : std::nullopt;
        const std::optional<std::size_t> normal_index = findWhole(*attributes, "NORMAL");
        const std::optional<Column> normals =
            normal_index ? std::optional(Column(file_, *normal_index, "VEC3")) : std::nullopt;
        const std::optional<std::size_t> angle_index = findWhole(*attributes, "_CONTACT_ANGLE");
        const std::optional<Column> angles =
            angle_index ? std::optional(Column(file_, *angle_index, "SCALAR")) : std::nullopt;
        const std::size_t count = positions.size();
        const auto fits = [count](const std::optional<Column>& column) { return !column || column->size() == count; };
        if (!fits(uvs) || !fits(normals) || !fits(angles)) {
            throw Damage(name + " has attributes of different lengths");
        }
        const std::vector<Triangle> triangles = trianglesOf(mode, indicesOf(primitive, count, name));
        if (triangles.empty()) {
            return;
        }
        if (triangles.size() > kMostTriangles - mesh_.triangles.size() ||
            count > 3 * kMostTriangles - mesh_.positions.size()) {
            throw Damage("it has more than " + std::to_string(kMostTriangles) + " triangles");
        }
        const auto first = static_cast<std::uint32_t>(mesh_.positions.size());
        for (std::size_t v = 0; v < count; ++v) {
            const Vec3 p = placement.place(positions.vec3(v));
            const Vec3 n = normals ? placement.normal(normals->vec3(v)) : Vec3{};
            const Vec2 uv = uvs ? uvs->vec2(v) : Vec2{};
            const double angle = angles ? angles->number(v, 0) : 0.0;
            if (!std::isfinite(p.x + p.y + p.z + n.x + n.y + n.z + uv.x + uv.y + angle)) {
                throw Damage(name + " holds numbers that are not finite");
            }
            mesh_.positions.push_back(p);
            mesh_.normals.push_back(n);
            mesh_.uvs.push_back(uv);
            mesh_.contact_angles.push_back(static_cast<float>(kDegree * angle));
        }
        for (const Triangle& t : triangles) {
            mesh_.triangles.push_back(placement.mirrors() ? Triangle{first + t[0], first + t[2], first + t[1]}
                                                          : Triangle{first + t[0], first + t[1], first + t[2]});
        }
    }

    [[nodiscard]] std::vector<std::uint32_t> indicesOf(const Json& primitive, std::size_t count,
                                                       const std::string& name) const
    {
        const std::optional<std::size_t> accessor = findWhole(primitive, "indices");
        if (!accessor) {
            std::vector<std::uint32_t> all(count);
            std::iota(all.begin(), all.end(), 0U);
            return all;
        }
        const Column column(file_, *accessor, "SCALAR");
        if (column.kind() != U8 && column.kind() != U16 && column.kind() != U32) {
            throw Damage(name + " has indices that are no unsigned integers");
        }
        std::vector<std::uint32_t> indices(column.size());
        for (std::size_t i = 0; i < indices.size(); ++i) {
            indices[i] = column.whole(i);
            if (indices[i] >= count) {
                throw Damage(name + " names vertex " + std::to_string(indices[i]) + " of " + std::to_string(count));
            }
        }
        return indices;
    }

    const File& file_;
    const SceneOptions& options_;
    SceneMesh mesh_;
};

}  // namespace

SceneMesh readScene(const std::filesystem::path& path, const SceneOptions& options)
{
    const File file(path);
    return Scene(file, options).take();
}

}  // namespace droplet
