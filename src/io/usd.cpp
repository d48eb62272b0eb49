// SPDX-License-Identifier: GPL-3.0-or-later
// Pixar, "OpenUSD": UsdGeomMesh, UsdGeomPrimvar, "UsdPreviewSurface Specification" (2.6), "Usdz File Format
// Specification" (1.3); PKWARE, ".ZIP File Format Specification" (6.3).
#include "droplet/io/usd.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <ostream>
#include <streambuf>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "droplet/error.h"
#include "droplet/printable.h"
#include "droplet/units.h"
#include "droplet/version.h"
#include "io/axes.h"
#include "io/byte_stream.h"
#include "io/dry_surface.h"
#include "io/part_groups.h"
#include "io/preview_opacity.h"
#include "io/welded_vertices.h"

namespace droplet {
namespace {

using Point = std::array<float, 3>;

constexpr std::string_view kLayer = "droplet.usda";
constexpr std::string_view kPicture = "picture.png";
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

Point pointOf(Vec3 vector)
{
    const Vec3 up = yUp(vector);
    return {toFloat(up.x), toFloat(up.y), toFloat(up.z)};
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

/// Material of some parts of a mesh.
struct Binding {
    PrimName material;
    std::vector<std::size_t> parts;  ///< empty: all
};

/// Mesh of a file.
struct MeshPrim {
    PrimName name;
    std::vector<Binding> bindings;       ///< at least one; together all parts
    std::optional<FileDroplet> droplet;  ///< figures of the mesh
};

/// Writer of a mesh with its welded points.
class MeshWriter {
public:
    MeshWriter(const Surface& surface, ByteStream& bytes)
        : surface_(surface), bytes_(bytes), welded_(weldVertices(surface))
    {
    }

    void write(const MeshPrim& mesh)
    {
        beginPrim(bytes_, "    ", "Mesh", mesh.name.prim, {kBindsMaterial, displayName(mesh.name)});
        bytes_.text("        float3[] extent = ");
        writeExtent();
        attribute("int[] faceVertexCounts", surface_.triangles.size(), [](std::size_t) { return std::uint32_t{3}; });
        attribute("int[] faceVertexIndices", corners(), [&](std::size_t i) { return welded_.number[vertexAt(i)]; });
        // Subsets go before it; readers that do not know them show it.
        bytes_.text("\n        rel material:binding = <" + pathOf(mesh.bindings.front()) +
                    ">\n        uniform token orientation = \"rightHanded\"");
        attribute("point3f[] points", welded_.first.size(),
                  [&](std::size_t i) { return pointOf(surface_.positions[welded_.first[i]]); });
        if (!surface_.contact_angle.empty()) {
            attribute("float[] primvars:contact_angle", welded_.first.size(), [&](std::size_t i) {
                return toFloat(static_cast<double>(surface_.contact_angle[welded_.first[i]]) / kDegree);
            });
            interpolate("vertex");
        }
        attribute("normal3f[] primvars:normals", surface_.normals.size(),
                  [&](std::size_t i) { return pointOf(surface_.normals[i]); });
        interpolate("faceVarying");
        attribute("int[] primvars:normals:indices", corners(), [&](std::size_t i) { return vertexAt(i); });
        writeTexture();
        bytes_.text("\n        uniform token subdivisionScheme = \"none\"\n");
        if (mesh.droplet) {
            writeFigures(*mesh.droplet);
        }
        if (mesh.bindings.size() > 1) {
            writeSubsets(mesh.bindings);
        }
        bytes_.text("    }\n");
    }

private:
    [[nodiscard]] std::size_t corners() const { return 3 * surface_.triangles.size(); }
    [[nodiscard]] std::uint32_t vertexAt(std::size_t corner) const
    {
        return surface_.triangles[corner / 3][corner % 3];
    }

    static std::string pathOf(const Binding& binding) { return std::string(kRoot) + binding.material.prim; }

    template <typename ValueOf>
    void attribute(std::string_view declaration, std::size_t count, const ValueOf& value_of)
    {
        bytes_.text("\n        ");
        bytes_.text(declaration);
        bytes_.text(" = ");
        writeList(bytes_, count, value_of);
    }

    void interpolate(std::string_view kind)
    {
        bytes_.text(" (\n            interpolation = \"");
        bytes_.text(kind);
        bytes_.text("\"\n        )");
    }

    void writeExtent()
    {
        Point low = pointOf(surface_.positions.front());
        Point high = low;
        for (const Vec3& position : surface_.positions) {
            const Point point = pointOf(position);
            for (std::size_t k = 0; k < point.size(); ++k) {
                low[k] = std::min(low[k], point[k]);
                high[k] = std::max(high[k], point[k]);
            }
        }
        writeList(bytes_, 2, [&](std::size_t i) { return i == 0 ? low : high; });
    }

    /// Blender and Omniverse show attributes of this namespace as a prim's own.
    void writeFigures(const FileDroplet& droplet)
    {
        for (const auto& [name, value] :
             {std::pair("contact_angle_deg", droplet.contact_angle / kDegree),
              std::pair("height_max_m", droplet.height_max), std::pair("pressure_pa", droplet.pressure),
              std::pair("volume_m3", droplet.volume)}) {
            bytes_.text(std::string("        custom double userProperties:") + name + " = ");
            bytes_.digits(value);
            bytes_.u8('\n');
        }
    }

    void writeSubsets(const std::vector<Binding>& bindings)
    {
        bytes_.text("        uniform token subsetFamily:materialBind:familyType = \"partition\"\n");
        for (const Binding& binding : bindings) {
            beginPrim(bytes_, "        ", "GeomSubset", binding.material.prim,
                      {kBindsMaterial, displayName(binding.material)});
            bytes_.text(
                "            uniform token elementType = \"face\"\n"
                "            uniform token familyName = \"materialBind\"\n"
                "            int[] indices = ");
            std::vector<std::uint32_t> faces;
            for (const std::size_t k : binding.parts) {
                const SurfacePart& part = surface_.parts[k];
                for (std::size_t t = 0; t < part.triangles; ++t) {
                    faces.push_back(static_cast<std::uint32_t>(part.first_triangle + t));
                }
            }
            writeList(bytes_, faces.size(), [&](std::size_t i) { return faces[i]; });
            bytes_.text("\n            rel material:binding = <" + pathOf(binding) + ">\n        }\n");
        }
    }

    /// Copies of a vertex have one place in the mask, but not where a surface that leans out was spread.
    void writeTexture()
    {
        const auto texture = [&](std::size_t i) {
            const Vec2 uv = fromBelow(surface_.uvs[i]);
            return std::array{toFloat(uv.x), toFloat(uv.y)};
        };
        bool is_shared = true;
        for (std::size_t i = 0; i < surface_.uvs.size(); ++i) {
            is_shared = is_shared && surface_.uvs[i] == surface_.uvs[surface_.weld[i]];
        }
        constexpr std::string_view kDeclaration = "texCoord2f[] primvars:st";
        if (is_shared) {
            attribute(kDeclaration, welded_.first.size(), [&](std::size_t i) { return texture(welded_.first[i]); });
            interpolate("vertex");
        } else {
            attribute(kDeclaration, surface_.uvs.size(), texture);
            interpolate("faceVarying");
            attribute("int[] primvars:st:indices", corners(), [&](std::size_t i) { return vertexAt(i); });
        }
    }

    const Surface& surface_;
    ByteStream& bytes_;
    WeldedVertices welded_;
};

/// @param has_picture  whether the colours of the picture multiply that of the look
void writeMaterial(const Look& look, const PrimName& name, bool has_picture, ByteStream& bytes)
{
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
    } else {
        bytes.text(" = ");
        write(bytes, colour);
        bytes.u8('\n');
    }
    input("float inputs:ior", look.ior);
    input("float inputs:metallic", look.metallic);
    input("float inputs:opacity", previewOpacity(look));
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
    bytes.text("    }\n");
}

/// Writes meshes and materials; see writeUsda.
std::uint64_t writeLayer(const Surface& surface, std::ostream& out, const UsdOptions& options)
{
    validateUnlessDry(surface);
    constexpr std::size_t kMaxIndices = std::numeric_limits<std::int32_t>::max();
    if (surface.triangles.size() > kMaxIndices / 3 || surface.positions.size() > kMaxIndices) {
        throw Error(ErrorCode::InvalidArgument, "surface has " + std::to_string(surface.triangles.size()) +
                                                    " triangles and " + std::to_string(surface.positions.size()) +
                                                    " vertices; USD allows at most 2147483647 corners");
    }
    const std::vector<PartGroup> groups = groupParts(surface, {options.material, options.nodes, options.droplets});
    const bool is_each = options.nodes == Nodes::Each;
    std::vector<std::string> names;
    for (std::size_t i = 0; i < (is_each ? groups.size() : 1); ++i) {
        names.push_back(is_each ? groups[i].droplet->name : "surface");
    }
    const std::size_t meshes = names.size();
    std::vector<Look> looks;
    std::vector<std::size_t> look_of;  // of every group
    for (const PartGroup& group : groups) {
        look_of.push_back(static_cast<std::size_t>(std::find(looks.begin(), looks.end(), group.look) - looks.begin()));
        if (look_of.back() == looks.size()) {
            looks.push_back(group.look);
        }
    }
    if (looks.empty()) {
        looks.push_back(lookOf(options.material));
    }
    for (const Look& look : looks) {
        names.push_back(look.name);
    }
    const std::vector<PrimName> prims = primNames(names);

    ByteStream bytes(out);
    bytes.text(std::string("#usda 1.0\n(\n    defaultPrim = \"droplet\"\n    doc = \"droplet-shape ") + kVersion +
               "\"\n    metersPerUnit = 1\n    upAxis = \"Y\"\n)\n");
    beginPrim(bytes, "", "Xform", "droplet", {"kind = \"component\""});
    std::vector<Binding> bindings;
    for (std::size_t i = 0; i < groups.size(); ++i) {
        const PrimName& material = prims[meshes + look_of[i]];
        if (is_each) {
            const Surface own = extract(surface, groups[i].parts);
            MeshWriter(own, bytes).write({prims[i], {{material, {}}}, groups[i].droplet});
        } else {
            bindings.push_back({material, groups[i].parts});
        }
    }
    if (!bindings.empty()) {
        MeshWriter(surface, bytes).write({prims[0], bindings, {}});
    }
    for (std::size_t i = 0; i < looks.size(); ++i) {
        writeMaterial(looks[i], prims[meshes + i], !options.texture.empty(), bytes);
    }
    bytes.text("}\n");
    return bytes.finish();
}

/// Stream that keeps only the length and the checksum of its bytes.
class Checksum : public std::streambuf {
public:
    [[nodiscard]] std::uint32_t crc() const { return static_cast<std::uint32_t>(crc_); }

protected:
    std::streamsize xsputn(const char* bytes, std::streamsize count) override
    {
        crc_ = crc32_z(crc_, reinterpret_cast<const Bytef*>(bytes), static_cast<std::size_t>(count));
        return count;
    }

private:
    uLong crc_ = crc32_z(0, nullptr, 0);
};

/// File of a package.
struct ZipEntry {
    std::string_view name;
    std::function<std::uint64_t(std::ostream&)> write;
    std::uint64_t begin = 0;    ///< of its header
    std::uint64_t padding = 0;  ///< bytes of the extra field, which aligns the data
    std::uint64_t length = 0;
    std::uint32_t crc = 0;
};

constexpr std::uint64_t kHeader = 30;
constexpr std::uint64_t kDirectoryEntry = 46;
constexpr std::uint64_t kDirectoryEnd = 22;

/// Measures the files and places them one after another.
/// @return  where the directory begins
std::uint64_t place(std::vector<ZipEntry>& entries)
{
    constexpr std::uint64_t kAlignment = 64;
    constexpr std::uint64_t kSmallestField = 4;
    std::uint64_t end = 0;
    for (ZipEntry& entry : entries) {
        Checksum checksum;
        std::ostream counted(&checksum);
        entry.length = entry.write(counted);
        entry.crc = checksum.crc();
        entry.begin = end;
        const std::uint64_t names_end = end + kHeader + entry.name.size() + kSmallestField;
        entry.padding = kSmallestField + (kAlignment - names_end % kAlignment) % kAlignment;
        end += kHeader + entry.name.size() + entry.padding + entry.length;
    }
    return end;
}

/// Fields that both headers of a zip's file share: version 1.0, no flags, stored, 1980-01-01, checksum and length
/// twice.
void writeZipFields(ByteStream& zip, const ZipEntry& entry)
{
    zip.u16(10, 0, 0, 0, 0x21);
    zip.u32(entry.crc, entry.length, entry.length);
    zip.u16(entry.name.size());
}

}  // namespace

std::uint64_t writeUsda(const Surface& surface, std::ostream& out, const UsdOptions& options)
{
    if (!options.texture.empty()) {
        throw Error(ErrorCode::InvalidArgument, "options.texture has " + std::to_string(options.texture.size()) +
                                                    " bytes; it must be empty, because only USDZ holds pictures");
    }
    return writeLayer(surface, out, options);
}

// The text is written twice, so that it is never in memory as a whole: its length and checksum stand before it.
std::uint64_t writeUsdz(const Surface& surface, std::ostream& out, const UsdOptions& options)
{
    std::vector<ZipEntry> entries{{kLayer, [&](std::ostream& layer) { return writeLayer(surface, layer, options); }}};
    if (!options.texture.empty()) {
        entries.push_back({kPicture, [&](std::ostream& picture) {
                               ByteStream bytes(picture);
                               bytes.text(options.texture);
                               return bytes.finish();
                           }});
    }
    const std::uint64_t directory_begin = place(entries);
    std::uint64_t directory_bytes = 0;
    for (const ZipEntry& entry : entries) {
        directory_bytes += kDirectoryEntry + entry.name.size();
    }
    const std::uint64_t size = directory_begin + directory_bytes + kDirectoryEnd;
    if (size > std::numeric_limits<std::uint32_t>::max()) {
        throw Error(ErrorCode::InvalidArgument, "surface with " + std::to_string(surface.triangles.size()) +
                                                    " triangles would make a USDZ file of " + std::to_string(size) +
                                                    " bytes; it must stay below 4 GiB");
    }
    for (const ZipEntry& entry : entries) {
        ByteStream header(out);
        header.text("PK\x03\x04");
        writeZipFields(header, entry);
        header.u16(entry.padding);
        header.text(entry.name);
        header.u16(0x1986, entry.padding - 4);  // the field's name in OpenUSD's own packages
        header.text(std::string(entry.padding - 4, '\0'));
        header.finish();
        entry.write(out);
    }
    ByteStream directory(out);
    for (const ZipEntry& entry : entries) {
        directory.text("PK\x01\x02");
        directory.u16(10);
        writeZipFields(directory, entry);
        directory.u16(0, 0, 0, 0);  // no extra field, no comment, first disk, no attributes
        directory.u32(0, entry.begin);
        directory.text(entry.name);
    }
    directory.text("PK\x05\x06");
    directory.u16(0, 0, entries.size(), entries.size());
    directory.u32(directory_bytes, directory_begin);
    directory.u16(0);
    directory.finish();
    return size;
}

}  // namespace droplet
