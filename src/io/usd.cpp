// SPDX-License-Identifier: GPL-3.0-or-later
// Pixar, "OpenUSD": UsdGeomMesh, UsdGeomPrimvar, "UsdPreviewSurface Specification" (2.6), "Usdz File Format
// Specification" (1.3); PKWARE, ".ZIP File Format Specification" (6.3).
#include "droplet/io/usd.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <ostream>
#include <streambuf>
#include <string>
#include <string_view>
#include <vector>

#include "droplet/error.h"
#include "droplet/units.h"
#include "droplet/version.h"
#include "io/axes.h"
#include "io/byte_stream.h"
#include "io/dry_surface.h"
#include "io/preview_opacity.h"
#include "io/welded_vertices.h"

namespace droplet {
namespace {

using Point = std::array<float, 3>;

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

/// Mesh with its welded points.
class MeshWriter {
public:
    MeshWriter(const Surface& surface, ByteStream& bytes)
        : surface_(surface), bytes_(bytes), welded_(weldVertices(surface))
    {
    }

    void write(const std::string& material)
    {
        bytes_.text(
            "\n    def Mesh \"surface\" (\n        prepend apiSchemas = [\"MaterialBindingAPI\"]\n    )\n    {\n"
            "        float3[] extent = ");
        writeExtent();
        attribute("int[] faceVertexCounts", surface_.triangles.size(), [](std::size_t) { return std::uint32_t{3}; });
        attribute("int[] faceVertexIndices", corners(), [&](std::size_t i) { return welded_.number[vertexAt(i)]; });
        bytes_.text("\n        rel material:binding = </droplet/" + material +
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
        bytes_.text("\n        uniform token subdivisionScheme = \"none\"\n    }\n");
    }

private:
    [[nodiscard]] std::size_t corners() const { return 3 * surface_.triangles.size(); }
    [[nodiscard]] std::uint32_t vertexAt(std::size_t corner) const
    {
        return surface_.triangles[corner / 3][corner % 3];
    }

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

void writeMaterial(const Look& look, ByteStream& bytes)
{
    const std::string path = std::string("/droplet/") + look.name;
    const auto input = [&](const char* declaration, double value) {
        bytes.text(std::string("            ") + declaration + " = ");
        bytes.digits(toFloat(value));
        bytes.u8('\n');
    };
    bytes.text(std::string("\n    def Material \"") + look.name +
               "\"\n    {\n        token outputs:surface.connect = <" + path +
               "/preview.outputs:surface>\n\n        def Shader \"preview\"\n        {\n" +
               "            uniform token info:id = \"UsdPreviewSurface\"\n            color3f inputs:diffuseColor = ");
    write(bytes, std::array{toFloat(look.colour.x), toFloat(look.colour.y), toFloat(look.colour.z)});
    bytes.u8('\n');
    input("float inputs:ior", look.ior);
    input("float inputs:metallic", look.metallic);
    input("float inputs:opacity", previewOpacity(look));
    input("float inputs:roughness", look.roughness);
    bytes.text("            token outputs:surface\n        }\n    }\n");
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

/// Fields that both headers of a zip's file share: version 1.0, no flags, stored, 1980-01-01, checksum and length
/// twice.
void writeZipFields(ByteStream& zip, std::uint32_t crc, std::uint64_t length, std::string_view name)
{
    zip.u16(10, 0, 0, 0, 0x21);
    zip.u32(crc, length, length);
    zip.u16(name.size());
}

}  // namespace

std::uint64_t writeUsda(const Surface& surface, std::ostream& out, Material material)
{
    validateUnlessDry(surface);
    constexpr std::size_t kMaxIndices = std::numeric_limits<std::int32_t>::max();
    if (surface.triangles.size() > kMaxIndices / 3 || surface.positions.size() > kMaxIndices) {
        throw Error(ErrorCode::InvalidArgument, "surface has " + std::to_string(surface.triangles.size()) +
                                                    " triangles and " + std::to_string(surface.positions.size()) +
                                                    " vertices; USD allows at most 2147483647 corners");
    }
    const Look look = lookOf(material);
    ByteStream bytes(out);
    bytes.text(std::string("#usda 1.0\n(\n    defaultPrim = \"droplet\"\n    doc = \"droplet-shape ") + kVersion +
               "\"\n    metersPerUnit = 1\n    upAxis = \"Y\"\n)\n\n"
               "def Xform \"droplet\" (\n    kind = \"component\"\n)\n{");
    if (!isDry(surface)) {
        MeshWriter(surface, bytes).write(look.name);
    }
    writeMaterial(look, bytes);
    bytes.text("}\n");
    return bytes.finish();
}

// The text is written twice, so that it is never in memory as a whole: its length and checksum stand before it.
std::uint64_t writeUsdz(const Surface& surface, std::ostream& out, Material material)
{
    constexpr std::string_view kName = "droplet.usda";
    constexpr std::size_t kHeader = 30;
    constexpr std::size_t kEntry = 46;
    constexpr std::size_t kEnd = 22;
    constexpr std::size_t kAlignment = 64;
    // The header is padded by an extra field, which has four bytes of its own.
    constexpr std::size_t kPadding = kAlignment - (kHeader + kName.size()) % kAlignment;
    static_assert(kPadding >= 4);
    Checksum checksum;
    std::ostream counted(&checksum);
    const std::uint64_t length = writeUsda(surface, counted, material);
    const std::uint64_t entry_begin = kHeader + kName.size() + kPadding + length;
    const std::uint64_t size = entry_begin + kEntry + kName.size() + kEnd;
    if (size > std::numeric_limits<std::uint32_t>::max()) {
        throw Error(ErrorCode::InvalidArgument, "surface with " + std::to_string(surface.triangles.size()) +
                                                    " triangles would make a USDZ file of " + std::to_string(size) +
                                                    " bytes; it must stay below 4 GiB");
    }
    ByteStream zip(out);
    zip.text("PK\x03\x04");
    writeZipFields(zip, checksum.crc(), length, kName);
    zip.u16(kPadding);
    zip.text(kName);
    zip.u16(0x1986, kPadding - 4);  // the field's name in OpenUSD's own packages
    zip.text(std::string(kPadding - 4, '\0'));
    zip.finish();
    writeUsda(surface, out, material);
    ByteStream directory(out);
    directory.text("PK\x01\x02");
    directory.u16(10);
    writeZipFields(directory, checksum.crc(), length, kName);
    directory.u16(0, 0, 0, 0);  // no extra field, no comment, first disk, no attributes
    directory.u32(0, 0);        // no attributes; the file begins at 0
    directory.text(kName);
    directory.text("PK\x05\x06");
    directory.u16(0, 0, 1, 1);
    directory.u32(kEntry + kName.size(), entry_begin);
    directory.u16(0);
    directory.finish();
    return size;
}

}  // namespace droplet
