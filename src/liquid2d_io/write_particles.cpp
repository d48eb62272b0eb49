// SPDX-License-Identifier: GPL-3.0-or-later
// "VTK XML formats", docs.vtk.org; classic Houdini geometry: Houdini 11 reference, "bgeo file format"; G. Turk, "The
// PLY polygon file format".
#include "droplet/liquid2d_io/write_particles.h"

#include <fmt/core.h>

#include <bit>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "byte_stream.h"
#include "droplet/io/base64.h"
#include "droplet/version.h"
#include "liquid2d_io/raw_particles.h"

namespace droplet {
namespace {

std::uint64_t writeCsv(const ParticleFrame& frame, std::ostream& out)
{
    const bool has_density = !frame.density.empty();
    ByteStream bytes(out);
    bytes.text("id,x_m,y_m,z_m,velocity_x_m_per_s,velocity_y_m_per_s,velocity_z_m_per_s,radius_m");
    bytes.text(has_density ? ",density\n" : "\n");
    for (std::size_t i = 0; i < frame.position.size(); ++i) {
        bytes.digits(frame.id[i]);
        for (const double number : {frame.position[i].x, frame.position[i].y, 0.0, frame.velocity[i].x,
                                    frame.velocity[i].y, 0.0, 0.5 * frame.spacing}) {
            bytes.text(",");
            bytes.digits(number);
        }
        if (has_density) {
            bytes.text(",");
            bytes.digits(frame.density[i]);
        }
        bytes.text("\n");
    }
    return bytes.finish();
}

/// Words of four bytes, in an order.
std::string wordsOf(const std::vector<std::uint32_t>& words, std::endian order)
{
    std::string bytes;
    bytes.reserve(4 * words.size());
    for (const std::uint32_t word : words) {
        for (unsigned k = 0; k < 4; ++k) {
            const unsigned shift = order == std::endian::little ? 8 * k : 24 - 8 * k;
            bytes += static_cast<char>(word >> shift & 0xFFU);
        }
    }
    return bytes;
}

std::uint32_t floatBits(double value)
{
    return std::bit_cast<std::uint32_t>(toFloat(value));
}

std::uint64_t writeVtp(const ParticleFrame& frame, std::ostream& out)
{
    const std::size_t count = frame.position.size();
    ByteStream bytes(out);
    const auto array = [&](const char* name, const char* type, int components,
                           const std::function<void(std::size_t, std::vector<std::uint32_t>&)>& put) {
        std::vector<std::uint32_t> words{0};  // before the data: their length
        for (std::size_t i = 0; i < count; ++i) {
            put(i, words);
        }
        words[0] = static_cast<std::uint32_t>(4 * (words.size() - 1));
        bytes.text(
            fmt::format("        <DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"binary\">", type,
                        name, components));
        bytes.text(base64(wordsOf(words, std::endian::little)));
        bytes.text("</DataArray>\n");
    };
    bytes.text(
        fmt::format("<?xml version=\"1.0\"?>\n<!-- droplet-shape {} -->\n"
                    "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt32\">\n"
                    "  <PolyData>\n    <FieldData>\n"
                    "      <DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">",
                    kVersion));
    bytes.digits(frame.time);
    bytes.text(
        fmt::format("</DataArray>\n    </FieldData>\n"
                    "    <Piece NumberOfPoints=\"{0}\" NumberOfVerts=\"{0}\" NumberOfLines=\"0\" "
                    "NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n      <PointData>\n",
                    count));
    array("velocity", "Float32", 3, [&](std::size_t i, auto& words) {
        words.insert(words.end(), {floatBits(frame.velocity[i].x), floatBits(frame.velocity[i].y), 0U});
    });
    array("id", "UInt32", 1, [&](std::size_t i, auto& words) { words.push_back(frame.id[i]); });
    array("radius", "Float32", 1, [&](std::size_t, auto& words) { words.push_back(floatBits(0.5 * frame.spacing)); });
    if (!frame.density.empty()) {
        array("density", "Float32", 1,
              [&](std::size_t i, auto& words) { words.push_back(floatBits(frame.density[i])); });
    }
    bytes.text("      </PointData>\n      <Points>\n");
    array("Points", "Float32", 3, [&](std::size_t i, auto& words) {
        words.insert(words.end(), {floatBits(frame.position[i].x), floatBits(frame.position[i].y), 0U});
    });
    bytes.text("      </Points>\n      <Verts>\n");
    array("connectivity", "Int32", 1,
          [](std::size_t i, auto& words) { words.push_back(static_cast<std::uint32_t>(i)); });
    array("offsets", "Int32", 1,
          [](std::size_t i, auto& words) { words.push_back(static_cast<std::uint32_t>(i + 1)); });
    bytes.text("      </Verts>\n    </Piece>\n  </PolyData>\n</VTKFile>\n");
    return bytes.finish();
}

std::uint64_t writeBgeo(const ParticleFrame& frame, std::ostream& out)
{
    const bool has_density = !frame.density.empty();
    ByteStream bytes(out);
    const auto words = [&](const std::vector<std::uint32_t>& all) { bytes.text(wordsOf(all, std::endian::big)); };
    const auto count = static_cast<std::uint32_t>(frame.position.size());
    bytes.text("BgeoV");
    words({5, count, 0, 0, 0, has_density ? 4U : 3U, 0, 0, 0});
    // Names of attributes, numbers of components, types, and default values.
    constexpr std::uint32_t kFloat = 0;
    constexpr std::uint32_t kInteger = 1;
    constexpr std::uint32_t kVector = 5;
    const auto attribute = [&](std::string_view name, unsigned components, std::uint32_t type) {
        const auto two = [](std::size_t number) {
            return std::string{static_cast<char>(number >> 8U & 0xFFU), static_cast<char>(number & 0xFFU)};
        };
        bytes.text(two(name.size()));
        bytes.text(name);
        bytes.text(two(components));
        words({type});
        words(std::vector<std::uint32_t>(components, 0));
    };
    attribute("v", 3, kVector);
    attribute("id", 1, kInteger);
    attribute("pscale", 1, kFloat);
    if (has_density) {
        attribute("density", 1, kFloat);
    }
    for (std::size_t i = 0; i < frame.position.size(); ++i) {
        const Vec2 x = frame.position[i];
        const Vec2 v = frame.velocity[i];
        words({floatBits(x.x), floatBits(x.y), 0, floatBits(1.0), floatBits(v.x), floatBits(v.y), 0, frame.id[i],
               floatBits(0.5 * frame.spacing)});
        if (has_density) {
            words({floatBits(frame.density[i])});
        }
    }
    // No attributes of the whole, and the end.
    bytes.u8(0x00, 0xff);
    return bytes.finish();
}

std::uint64_t writePly(const ParticleFrame& frame, std::ostream& out)
{
    const bool has_density = !frame.density.empty();
    ByteStream bytes(out);
    std::string head =
        fmt::format("ply\nformat binary_little_endian 1.0\ncomment droplet-shape {}\nelement vertex {}\n", kVersion,
                    frame.position.size());
    for (const char* const name : {"x", "y", "z", "velocity_x", "velocity_y", "velocity_z", "radius"}) {
        head += fmt::format("property float {}\n", name);
    }
    bytes.text(head + (has_density ? "property float density\n" : "") + "property uint id\nend_header\n");
    for (std::size_t i = 0; i < frame.position.size(); ++i) {
        const Vec2 x = frame.position[i];
        const Vec2 v = frame.velocity[i];
        bytes.f32(x.x, x.y, 0.0, v.x, v.y, 0.0, 0.5 * frame.spacing);
        if (has_density) {
            bytes.f32(frame.density[i]);
        }
        bytes.u32(frame.id[i]);
    }
    return bytes.finish();
}

}  // namespace

std::optional<ParticleFormat> particleFormatOf(const std::filesystem::path& path)
{
    const std::string extension = lowerCase(path.extension().string());
    return extension == ".csv"    ? std::optional(ParticleFormat::Csv)
           : extension == ".vtp"  ? std::optional(ParticleFormat::Vtp)
           : extension == ".bgeo" ? std::optional(ParticleFormat::Bgeo)
           : extension == ".ply"  ? std::optional(ParticleFormat::Ply)
                                  : std::nullopt;
}

std::uint64_t writeParticles(const ParticleFrame& frame, std::ostream& out, ParticleFormat format)
{
    switch (format) {
        case ParticleFormat::Csv:
            return writeCsv(frame, out);
        case ParticleFormat::Vtp:
            return writeVtp(frame, out);
        case ParticleFormat::Bgeo:
            return writeBgeo(frame, out);
        case ParticleFormat::Ply:
            break;
    }
    return writePly(frame, out);
}

}  // namespace droplet
