// SPDX-License-Identifier: GPL-3.0-or-later
// Wavefront, "Object Files (.obj)", Advanced Visualizer Manual, appendix B1; G. Turk, "The PLY Polygon File Format"
// (1994); 3D Systems, "StereoLithography Interface Specification" (1989).
//
// OpenMesh's writers are not used: its OBJ has no separate normal indices, its PLY names texture coordinates u, v and
// has global options, its STL prints on stderr, and all drop triangles that half-edges cannot represent.
#include "droplet/io/mesh_files.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <ostream>
#include <string>
#include <string_view>

#include "axes.h"
#include "byte_stream.h"
#include "droplet/error.h"
#include "droplet/printable.h"
#include "droplet/units.h"
#include "droplet/version.h"
#include "io/dry_surface.h"
#include "io/length_unit.h"
#include "require.h"
#include "scene/faces.h"
#include "scene/preview_opacity.h"
#include "scene/welded_vertices.h"
#include "unit_vector.h"

namespace droplet {
namespace {

constexpr int kSignificantDigits = 9;  // enough to distinguish any two floats
constexpr std::size_t kStlHeaderBytes = 80;

template <class... Numbers>
void writeLine(ByteStream& bytes, std::string_view key, Numbers... values)
{
    const auto write = [&](double value) {
        bytes.u8(' ');
        bytes.digits(value, std::chars_format::general, kSignificantDigits);
    };
    bytes.text(key);
    (write(values), ...);
    bytes.u8('\n');
}

void writeVec3(ByteStream& bytes, Vec3 a)
{
    bytes.f32(a.x, a.y, a.z);
}

// Unit normal by a triangle's winding; zero without an area, which readers replace.
Vec3 facetNormal(Vec3 a, Vec3 b, Vec3 c)
{
    return unit(cross(b - a, c - a));
}

/// Refuses a name that OBJ and MTL cannot hold. They have no escapes: a line break would end the name and begin a line
/// of its own.
void requireName(const char* field, const std::string& name)
{
    if (!isPrintable(name)) {
        refuseValue(field, "'" + printable(name) + "'", "UTF-8 without control characters");
    }
}

std::string signature()
{
    return std::string("droplet-shape ") + kVersion;
}

}  // namespace

std::uint64_t writeObj(const Surface& surface, std::ostream& out, const ObjOptions& options)
{
    validateUnlessDry(surface);
    const std::vector<Look> looks = options.material_file ? options.looks : std::vector<Look>{};
    if (!looks.empty() && !isDry(surface) &&
        (surface.parts.empty() || std::any_of(surface.parts.begin(), surface.parts.end(),
                                              [&](const SurfacePart& part) { return part.droplet >= looks.size(); }))) {
        throw Error(ErrorCode::InvalidArgument, "options.looks has " + std::to_string(looks.size()) +
                                                    " entries; the surface must have parts, for these droplets alone");
    }
    if (options.material_file) {
        requireName("options.material_file", *options.material_file);
    }
    for (const Look& look : looks) {
        requireName("options.looks' name", look.name);
    }
    const NamedUnit& unit = namedUnit(options.unit);
    const WeldedVertices welded = weldVertices(surface.weld);
    ByteStream bytes(out);
    bytes.text("# " + signature() + "\n# unit: " + std::string(unit.name) + ", up: +Y, front: +Z\n");
    if (options.material_file) {
        bytes.text("mtllib " + *options.material_file + "\n");
        if (looks.empty()) {
            bytes.text("usemtl " + lookOf(options.material).name + "\n");
        }
    }
    bytes.text("o droplet\n");
    for (const std::uint32_t i : welded.first) {
        const Vec3 at = yUp((1.0 / unit.metres) * surface.vertices[i]);
        writeLine(bytes, "v", at.x, at.y, at.z);
    }
    for (const Vec2& uv : surface.uvs) {
        const Vec2 texture = fromBelow(uv);
        writeLine(bytes, "vt", texture.x, texture.y);
    }
    for (const Vec3& normal : surface.normals) {
        const Vec3 up = yUp(normal);
        writeLine(bytes, "vn", up.x, up.y, up.z);
    }
    auto part = surface.parts.begin();
    forEachFace(surface.triangles, quadrilaterals(surface),
                [&](std::size_t triangle, std::initializer_list<std::uint32_t> corners) {
                    if (!looks.empty() && part != surface.parts.end() && part->first_triangle == triangle) {
                        bytes.text("usemtl " + looks[part->droplet].name + "\n");
                        ++part;
                    }
                    bytes.u8('f');
                    for (const std::uint32_t vertex : corners) {
                        const std::uint64_t own = vertex + std::uint64_t{1};
                        bytes.u8(' ');
                        bytes.digits(welded.number[vertex] + std::uint64_t{1});
                        bytes.u8('/');
                        bytes.digits(own);
                        bytes.u8('/');
                        bytes.digits(own);
                    }
                    bytes.u8('\n');
                });
    return bytes.finish();
}

namespace {

void writeLook(const Look& look, ByteStream& bytes)
{
    constexpr double kGloss = 1000.0;
    const bool clear = look.transmission > 0.0;
    const double mirror = (look.ior - 1.0) * (look.ior - 1.0) / ((look.ior + 1.0) * (look.ior + 1.0));
    const auto colour = [](const char* key, Vec3 c) { return fmt::format("{} {:g} {:g} {:g}\n", key, c.x, c.y, c.z); };
    const Vec3 specular = look.metallic > 0.0 ? look.colour : mirror * Vec3{1.0, 1.0, 1.0};
    bytes.text("newmtl " + look.name + "\n" + colour("Ka", {}) + colour("Kd", look.colour) + colour("Ks", specular));
    if (clear) {
        bytes.text(colour("Tf", look.colour));
    }
    bytes.text(fmt::format("Ns {:g}\nNi {:g}\nd {:g}\nillum {}\nPr {:g}\nPm {:g}\n", kGloss * (1.0 - look.roughness),
                           look.ior, previewOpacity(look),
                           clear                 ? 7
                           : look.metallic > 0.0 ? 3
                                                 : 2,
                           look.roughness, look.metallic));
}

}  // namespace

std::uint64_t writeMtl(Material material, std::ostream& out)
{
    return writeMtl({lookOf(material)}, out);
}

std::uint64_t writeMtl(const std::vector<Look>& looks, std::ostream& out)
{
    for (const Look& look : looks) {
        requireName("look.name", look.name);
    }
    ByteStream bytes(out);
    bytes.text("# " + signature() + "\n");
    for (auto look = looks.begin(); look != looks.end(); ++look) {
        if (std::none_of(looks.begin(), look, [&](const Look& earlier) { return earlier.name == look->name; })) {
            writeLook(*look, bytes);
        }
    }
    return bytes.finish();
}

std::uint64_t writePly(const Surface& surface, std::ostream& out)
{
    validateUnlessDry(surface);
    const WeldedVertices welded = weldVertices(surface.weld);
    if (welded.first.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) {
        throw Error(ErrorCode::InvalidArgument,
                    "surface has " + std::to_string(welded.first.size()) + " vertices; PLY allows at most 2147483647");
    }
    ByteStream bytes(out);
    bytes.text("ply\nformat binary_little_endian 1.0\ncomment " + signature() +
               "\ncomment unit: metre, up: z\n"
               "element vertex " +
               std::to_string(welded.first.size()) +
               "\nproperty float x\nproperty float y\nproperty float z\n"
               "property float nx\nproperty float ny\nproperty float nz\n"
               "property float s\nproperty float t\n" +
               (surface.contact_angle.empty() ? "" : "property float contact_angle\n") + "element face " +
               std::to_string(surface.triangles.size() - quadrilaterals(surface).size()) +
               "\nproperty list uchar int vertex_indices\nend_header\n");
    for (const std::uint32_t i : welded.first) {
        writeVec3(bytes, surface.vertices[i]);
        writeVec3(bytes, surface.normals[i]);
        const Vec2 texture = fromBelow(surface.uvs[i]);
        bytes.f32(texture.x, texture.y);
        if (!surface.contact_angle.empty()) {
            bytes.f32(surface.contact_angle[i] / kDegree);
        }
    }
    forEachFace(surface.triangles, quadrilaterals(surface),
                [&](std::size_t /*triangle*/, std::initializer_list<std::uint32_t> corners) {
                    bytes.u8(static_cast<std::uint8_t>(corners.size()));
                    for (const std::uint32_t vertex : corners) {
                        bytes.u32(welded.number[vertex]);
                    }
                });
    return bytes.finish();
}

std::uint64_t writeStl(const Surface& surface, std::ostream& out, LengthUnit unit)
{
    validateUnlessDry(surface);
    if (surface.triangles.size() > std::numeric_limits<std::uint32_t>::max()) {
        throw Error(ErrorCode::InvalidArgument, "surface has " + std::to_string(surface.triangles.size()) +
                                                    " triangles; STL allows at most 4294967295");
    }
    ByteStream bytes(out);
    const NamedUnit& named = namedUnit(unit);
    const auto scaled = [&](std::uint32_t vertex) { return (1.0 / named.metres) * surface.vertices[vertex]; };
    std::string header =
        signature() + ", " + std::string(named.name) + "s, z up";  // must not begin with "solid", which marks text
    header.resize(kStlHeaderBytes, ' ');
    bytes.text(header);
    bytes.u32(surface.triangles.size());
    for (const auto& [a, b, c] : surface.triangles) {
        const Vec3 at_a = scaled(a);
        const Vec3 at_b = scaled(b);
        const Vec3 at_c = scaled(c);
        writeVec3(bytes, facetNormal(at_a, at_b, at_c));
        writeVec3(bytes, at_a);
        writeVec3(bytes, at_b);
        writeVec3(bytes, at_c);
        bytes.u16(0);  // no attribute
    }
    return bytes.finish();
}

}  // namespace droplet
