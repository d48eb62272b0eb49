// SPDX-License-Identifier: GPL-3.0-or-later
// Wavefront, "Object Files (.obj)", Advanced Visualizer Manual, appendix B1; G. Turk, "The PLY Polygon File Format"
// (1994); 3D Systems, "StereoLithography Interface Specification" (1989).
//
// OpenMesh's writers would not do: OBJ knows no normal indices of its own, PLY names texture coordinates u, v and keeps
// its options in a global, STL prints on stderr; all drop triangles its half-edges cannot hold.
#include "droplet/io/mesh_files.h"

#include <array>
#include <charconv>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "droplet/error.h"
#include "droplet/units.h"
#include "droplet/version.h"
#include "io/axes.h"
#include "io/little_endian.h"

namespace droplet {
namespace {

constexpr int kSignificantDigits = 9;                 // as many as tell any two floats apart
constexpr std::size_t kChunk = std::size_t{1} << 16;  // bytes gathered before the stream is bothered
constexpr std::size_t kStlHeaderBytes = 80;

Vec3 millimetres(Vec3 a)
{
    return (1.0 / kMillimetre) * a;
}

// Texture origin from the upper to the lower left.
Vec2 fromBelow(Vec2 uv)
{
    return {uv.x, 1.0 - uv.y};
}

// Passes on what was gathered once it is worth it.
class Chunks {
public:
    explicit Chunks(std::ostream& out) : out_(out) { bytes_.reserve(2 * kChunk); }

    std::string& bytes()
    {
        if (bytes_.size() >= kChunk) {
            passOn();
        }
        return bytes_;
    }

    void finish()
    {
        passOn();
        out_.flush();
    }

private:
    void passOn()
    {
        out_.write(bytes_.data(), static_cast<std::streamsize>(bytes_.size()));
        bytes_.clear();
    }

    std::ostream& out_;
    std::string bytes_;
};

void appendText(std::string& text, double value)
{
    std::array<char, 32> digits{};  // sign, 9 digits, point, exponent of three digits
    const auto result = std::to_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::general,
                                      kSignificantDigits);
    text.append(digits.data(), result.ptr);
}

void appendLine(std::string& text, std::string_view key, std::initializer_list<double> values)
{
    text += key;
    for (const double value : values) {
        text += ' ';
        appendText(text, value);
    }
    text += '\n';
}

void appendVec3(std::string& bytes, Vec3 a)
{
    appendFloat(bytes, a.x);
    appendFloat(bytes, a.y);
    appendFloat(bytes, a.z);
}

// Number of every welded vertex in order of first appearance, for each vertex of the surface.
struct Welded {
    std::vector<std::uint32_t> first;   // vertex of the surface that stands for a welded one
    std::vector<std::uint32_t> number;  // welded vertex for each vertex of the surface
};

Welded weldVertices(const Surface& surface)
{
    Welded welded;
    welded.number.resize(surface.weld.size());
    for (std::uint32_t i = 0; i < surface.weld.size(); ++i) {
        if (surface.weld[i] == i) {
            welded.number[i] = static_cast<std::uint32_t>(welded.first.size());
            welded.first.push_back(i);
        } else {
            welded.number[i] = welded.number[surface.weld[i]];
        }
    }
    return welded;
}

// Half the area vector of a triangle's winding; zero, which readers replace by their own, where there is no area.
Vec3 facetNormal(Vec3 a, Vec3 b, Vec3 c)
{
    const Vec3 normal = cross(b - a, c - a);
    const double size = length(normal);
    return size > 0.0 ? (1.0 / size) * normal : Vec3{};
}

std::string signature()
{
    return std::string("droplet-shape ") + kVersion;
}

}  // namespace

void writeObj(const Surface& surface, std::ostream& out)
{
    surface.validate();
    const Welded welded = weldVertices(surface);
    Chunks chunks(out);
    chunks.bytes() += "# " + signature() + "\n# unit: millimetre, up: +Y, front: +Z\no droplet\n";
    for (const std::uint32_t i : welded.first) {
        const Vec3 at = yUp(millimetres(surface.positions[i]));
        appendLine(chunks.bytes(), "v", {at.x, at.y, at.z});
    }
    for (const Vec2& uv : surface.uvs) {
        const Vec2 texture = fromBelow(uv);
        appendLine(chunks.bytes(), "vt", {texture.x, texture.y});
    }
    for (const Vec3& normal : surface.normals) {
        const Vec3 up = yUp(normal);
        appendLine(chunks.bytes(), "vn", {up.x, up.y, up.z});
    }
    for (const Triangle& triangle : surface.triangles) {
        std::string& text = chunks.bytes();
        text += 'f';
        for (const std::uint32_t vertex : triangle) {
            const std::string own = std::to_string(vertex + std::uint64_t{1});
            text += ' ';
            text += std::to_string(welded.number[vertex] + std::uint64_t{1});
            text += '/';
            text += own;
            text += '/';
            text += own;
        }
        text += '\n';
    }
    chunks.finish();
}

void writePly(const Surface& surface, std::ostream& out)
{
    surface.validate();
    const Welded welded = weldVertices(surface);
    if (welded.first.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) {
        throw Error(ErrorCode::InvalidArgument,
                    "surface has " + std::to_string(welded.first.size()) + " places; PLY indices reach 2147483647");
    }
    Chunks chunks(out);
    chunks.bytes() += "ply\nformat binary_little_endian 1.0\ncomment " + signature() +
                      "\ncomment unit: metre, up: z\n"
                      "element vertex " +
                      std::to_string(welded.first.size()) +
                      "\nproperty float x\nproperty float y\nproperty float z\n"
                      "property float nx\nproperty float ny\nproperty float nz\n"
                      "property float s\nproperty float t\n"
                      "element face " +
                      std::to_string(surface.triangles.size()) +
                      "\nproperty list uchar int vertex_indices\nend_header\n";
    for (const std::uint32_t i : welded.first) {
        std::string& bytes = chunks.bytes();
        appendVec3(bytes, surface.positions[i]);
        appendVec3(bytes, surface.normals[i]);
        const Vec2 texture = fromBelow(surface.uvs[i]);
        appendFloat(bytes, texture.x);
        appendFloat(bytes, texture.y);
    }
    for (const Triangle& triangle : surface.triangles) {
        std::string& bytes = chunks.bytes();
        bytes.push_back(3);
        for (const std::uint32_t vertex : triangle) {
            appendU32(bytes, welded.number[vertex]);
        }
    }
    chunks.finish();
}

void writeStl(const Surface& surface, std::ostream& out)
{
    surface.validate();
    if (surface.triangles.size() > std::numeric_limits<std::uint32_t>::max()) {
        throw Error(ErrorCode::InvalidArgument, "surface has " + std::to_string(surface.triangles.size()) +
                                                    " triangles; STL counts up to 4294967295");
    }
    Chunks chunks(out);
    std::string header = signature() + ", millimetres, z up";  // must not begin with "solid", the mark of text
    header.resize(kStlHeaderBytes, ' ');
    chunks.bytes() += header;
    appendU32(chunks.bytes(), static_cast<std::uint32_t>(surface.triangles.size()));
    for (const auto& [a, b, c] : surface.triangles) {
        std::string& bytes = chunks.bytes();
        const Vec3 at_a = millimetres(surface.positions[a]);
        const Vec3 at_b = millimetres(surface.positions[b]);
        const Vec3 at_c = millimetres(surface.positions[c]);
        appendVec3(bytes, facetNormal(at_a, at_b, at_c));
        appendVec3(bytes, at_a);
        appendVec3(bytes, at_b);
        appendVec3(bytes, at_c);
        appendU16(bytes, 0);  // no attribute
    }
    chunks.finish();
}

}  // namespace droplet
