// SPDX-License-Identifier: GPL-3.0-or-later
// Khronos Group, "glTF 2.0 Specification" (2021), and its extensions KHR_materials_transmission, KHR_materials_ior and
// KHR_materials_volume.
#include "droplet/io/gltf.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <ostream>
#include <sstream>
#include <streambuf>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "droplet/error.h"
#include "droplet/units.h"
#include "io/byte_stream.h"
#include "io/compressed_gltf.h"
#include "io/dry_surface.h"
#include "io/gltf_model.h"
#include "io/part_groups.h"

namespace droplet {
namespace {

// Upper bound of the JSON's length without the buffer, for each piece of the surface: fewer than 60 numbers and names
// of fewer than 60 characters.
constexpr std::uint64_t kJsonBound = 4096;

/// Part of a surface that becomes a primitive.
struct Piece {
    const Surface* surface = nullptr;
    Look look;
    std::optional<FileDroplet> droplet;  ///< with Nodes::Each
};

/// Pieces of a surface; copies are made only where there are several.
struct Pieces {
    std::vector<Surface> copies;
    std::vector<Piece> all;
};

const std::vector<RefillState>& statesOf(const Surface& surface)
{
    static const std::vector<RefillState> none;
    return surface.refill ? surface.refill->states : none;
}

// Position 3, normal 3, uv 2, contact angle 1, changes of position and normal 6 in every state of a refill.
std::uint64_t vertexBytes(const Surface& surface)
{
    const std::uint64_t states = surface.refill ? surface.refill->states.size() : 0;
    return ((surface.contact_angle.empty() ? 8U : 9U) + 6U * states) * sizeof(float);
}

bool wideIndices(const Surface& surface)
{
    return surface.positions.size() >= kVerticesBeyond16Bit;
}

void checkFileSize(const Surface& surface, const GltfOptions& options)
{
    const std::uint64_t index_bytes = wideIndices(surface) ? 4 : 2;
    const std::uint64_t buffer = vertexBytes(surface) * surface.positions.size() +
                                 3 * index_bytes * surface.triangles.size() + options.texture.size();
    const std::uint64_t pieces = std::max<std::uint64_t>(1, options.droplets.size());
    const std::uint64_t file = pieces * kJsonBound + (options.binary ? buffer : (buffer + 2) / 3 * 4);
    if (file >= kGltfFileLimit) {
        throw Error(ErrorCode::InvalidArgument, "surface with " + std::to_string(surface.triangles.size()) +
                                                    " triangles would make a glTF file of " + std::to_string(file) +
                                                    " bytes; it must stay below 2 GiB");
    }
}

void checkCompression(const Surface& surface, const GltfOptions& options)
{
    if (options.compression != Compression::None && (!options.binary || surface.refill)) {
        throw Error(ErrorCode::InvalidArgument,
                    std::string("options.compression = ") + name(options.compression) + " needs " +
                        (options.binary ? "a surface without a refill: its changes are floats" : "a GLB"));
    }
}

// Checks the range of floats before the first byte is written. Bounds cover positions; normals are unit vectors.
void checkFloats(const Surface& surface)
{
    for (const RefillState& state : statesOf(surface)) {
        for (const Vec3& normal : state.normals) {
            toFloat(normal.x);
            toFloat(normal.y);
            toFloat(normal.z);
        }
    }
    for (const Vec2& uv : surface.uvs) {
        toFloat(uv.x);
        toFloat(uv.y);
    }
}

// targetNames is a common convention of viewers (section 3.7.2.2, implementation note).
tinygltf::Value refillExtras(const Refill& refill)
{
    using tinygltf::Value;
    const Value range(Value::Array{Value(refill.min), Value(refill.max)});
    if (refill.states.size() == 1 && refill.states.front().fill == 2.0) {
        return Value(
            Value::Object{{"targetNames", Value(Value::Array{Value(std::string("volume"))})}, {"fill_range", range}});
    }
    Value::Array names;
    Value::Array fills;
    for (const RefillState& state : refill.states) {
        names.emplace_back("volume_" + numberText(state.fill, 3));
        fills.emplace_back(state.fill);
    }
    return Value(Value::Object{{"targetNames", Value(names)}, {"fills", Value(fills)}, {"fill_range", range}});
}

Pieces piecesOf(const Surface& surface, const GltfOptions& options)
{
    const std::vector<PartGroup> groups = groupParts(surface, {options.material, options.nodes, options.droplets});
    Pieces pieces;
    pieces.copies.reserve(groups.size());
    for (const PartGroup& group : groups) {
        pieces.all.push_back(
            {groups.size() == 1 ? &surface : &pieces.copies.emplace_back(extract(surface, group.parts)), group.look,
             group.droplet});
    }
    return pieces;
}

tinygltf::Primitive addPrimitive(tinygltf::Model& model, const Piece& piece, bool closed)
{
    const Surface& surface = *piece.surface;
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.material = addMaterial(model, piece.look, surface.mean_height, closed);
    const std::size_t vertices = surface.positions.size();
    primitive.attributes["POSITION"] = addVertexArray(model, TINYGLTF_TYPE_VEC3, vertices);
    addBounds(model.accessors.back(), surface.positions);
    primitive.attributes["NORMAL"] = addVertexArray(model, TINYGLTF_TYPE_VEC3, vertices);
    primitive.attributes["TEXCOORD_0"] = addVertexArray(model, TINYGLTF_TYPE_VEC2, vertices);
    if (!surface.contact_angle.empty()) {
        primitive.attributes["_CONTACT_ANGLE"] = addVertexArray(model, TINYGLTF_TYPE_SCALAR, vertices);
    }
    for (const RefillState& state : statesOf(surface)) {
        std::map<std::string, int>& target = primitive.targets.emplace_back();
        target["POSITION"] = addVertexArray(model, TINYGLTF_TYPE_VEC3, vertices);
        addBounds(model.accessors.back(), state.positions);
        target["NORMAL"] = addVertexArray(model, TINYGLTF_TYPE_VEC3, vertices);
    }
    primitive.indices = addIndices(model, surface.triangles.size(), vertices);
    return primitive;
}

tinygltf::Value figuresOf(const FileDroplet& droplet)
{
    using tinygltf::Value;
    return Value(Value::Object{{"volume_m3", Value(droplet.volume)},
                               {"contact_angle_deg", Value(droplet.contact_angle / kDegree)},
                               {"height_max_m", Value(droplet.height_max)},
                               {"pressure_pa", Value(droplet.pressure)}});
}

/// Adds a mesh of primitives, and its node, to a model and its scene.
/// @param droplet  name and figures of the node; empty: of all droplets
void addNode(tinygltf::Model& model, std::vector<tinygltf::Primitive> primitives, const Surface& surface,
             const std::optional<FileDroplet>& droplet)
{
    tinygltf::Mesh mesh;
    mesh.name = droplet ? droplet->name : "droplet";
    mesh.primitives = std::move(primitives);
    if (surface.refill) {
        mesh.weights.assign(surface.refill->states.size(), 0.0);
        mesh.extras = refillExtras(*surface.refill);
    }
    tinygltf::Node node;
    node.name = mesh.name;
    node.mesh = static_cast<int>(model.meshes.size());
    if (droplet) {
        node.extras = figuresOf(*droplet);
    }
    model.meshes.push_back(std::move(mesh));
    model.scenes.front().nodes.push_back(static_cast<int>(model.nodes.size()));
    model.nodes.push_back(std::move(node));
}

tinygltf::Model makeModel(const Surface& surface, const Pieces& pieces, const GltfOptions& options)
{
    tinygltf::Model model = makeEmptyModel();
    tinygltf::Scene& scene = model.scenes.emplace_back();
    model.defaultScene = 0;
    if (pieces.all.empty()) {
        scene.name = "nothing";
        return model;
    }
    std::vector<tinygltf::Primitive> primitives;
    for (const Piece& piece : pieces.all) {
        primitives.push_back(addPrimitive(model, piece, options.closed));
        if (piece.droplet) {
            addNode(model, std::exchange(primitives, {}), *piece.surface, piece.droplet);
        }
    }
    if (!primitives.empty()) {
        addNode(model, std::move(primitives), surface, {});
    }
    if (!options.texture.empty()) {
        const int texture = addTexture(model, "picture", options.texture.size(),
                                       {TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR, TINYGLTF_TEXTURE_FILTER_LINEAR});
        for (tinygltf::Material& material : model.materials) {
            material.pbrMetallicRoughness.baseColorTexture.index = texture;
        }
    }
    return model;
}

// Positions are rounded to half an ulp of float: for a 20 mm droplet 0.5 nm, a ten-thousandth of an edge of the finest
// mesh that fits into a file. If rounding merges vertices the mesh stays closed, since faces use indices and welded
// copies round alike. Normals are stored, so degenerate triangles need none.
void writePiece(const Surface& surface, ByteStream& bytes)
{
    writeVectors(surface.positions, bytes);
    writeVectors(surface.normals, bytes);
    for (const Vec2& uv : surface.uvs) {  // both glTF and masks have their origin at the upper left
        bytes.f32(uv.x, uv.y);
    }
    for (const float angle : surface.contact_angle) {
        bytes.f32(angle / kDegree);
    }
    for (const RefillState& state : statesOf(surface)) {
        writeVectors(state.positions, bytes);
        writeVectors(state.normals, bytes);
    }
    writeIndices(surface.triangles, surface.positions.size(), bytes);
}

void writeBuffer(const Pieces& pieces, const std::string& texture, ByteStream& bytes)
{
    bool is_whole = true;  // the writer of the file fills the end of the buffer
    for (const Piece& piece : pieces.all) {
        if (!is_whole) {
            bytes.u16(0);
        }
        is_whole = wideIndices(*piece.surface) || piece.surface->triangles.size() % 2 == 0;
        writePiece(*piece.surface, bytes);
    }
    if (!pieces.all.empty() && !texture.empty()) {
        if (!is_whole) {
            bytes.u16(0);
        }
        bytes.text(texture);
    }
}

// Base64 encoder: S. Josefsson, RFC 4648 (2006), section 4.
class Base64Buffer : public std::streambuf {
public:
    explicit Base64Buffer(ByteStream& text) : text_(text) {}

    void finish()
    {
        if (filled_ > 0) {
            const int missing = 3 - filled_;
            group_ <<= 8 * missing;
            text_.u8(sign(18), sign(12), missing == 1 ? sign(6) : '=', '=');
        }
    }

protected:
    std::streamsize xsputn(const char* bytes, std::streamsize count) override
    {
        for (std::streamsize i = 0; i < count; ++i) {
            group_ = group_ << 8 | static_cast<unsigned char>(bytes[i]);
            if (++filled_ == 3) {
                text_.u8(sign(18), sign(12), sign(6), sign(0));
                filled_ = 0;
            }
        }
        return count;
    }

private:
    [[nodiscard]] char sign(int shift) const
    {
        constexpr const char* kSigns = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        return kSigns[group_ >> shift & 63U];
    }

    ByteStream& text_;
    std::uint32_t group_ = 0;
    int filled_ = 0;
};

void writeText(const Pieces& pieces, const tinygltf::Model& model, const std::string& texture, ByteStream& bytes)
{
    nlohmann::json json = jsonOf(model);
    if (pieces.all.empty()) {
        bytes.text(json.dump(2) + "\n");
        return;
    }
    const std::string uri = "data:application/octet-stream;base64,";
    json["buffers"][0]["uri"] = uri;
    const std::string text = json.dump(2);
    const std::size_t buffer_begin = text.find(uri) + uri.size();
    bytes.text(std::string_view(text).substr(0, buffer_begin));
    Base64Buffer base64(bytes);
    std::ostream encoded(&base64);
    ByteStream buffer(encoded);
    writeBuffer(pieces, texture, buffer);
    buffer.finish();
    base64.finish();
    bytes.text(std::string_view(text).substr(buffer_begin));
    bytes.text("\n");
}

}  // namespace

std::uint64_t writeGltf(const Surface& surface, std::ostream& out, const GltfOptions& options)
{
    checkCompression(surface, options);
    checkFileSize(surface, options);
    validateUnlessDry(surface);
    checkFloats(surface);
    const Pieces pieces = piecesOf(surface, options);
    const tinygltf::Model model = makeModel(surface, pieces, options);
    if (options.compression != Compression::None && !isDry(surface)) {
        std::ostringstream buffer;
        ByteStream bytes(buffer);
        writeBuffer(pieces, options.texture, bytes);
        bytes.finish();
        return writeCompressed(out, jsonOf(model), buffer.str(), options.compression);
    }
    if (options.binary) {
        return writeBinary(out, model, [&](ByteStream& bytes) { writeBuffer(pieces, options.texture, bytes); });
    }
    ByteStream bytes(out);
    writeText(pieces, model, options.texture, bytes);
    return bytes.finish();
}

}  // namespace droplet
