// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/io/mesh_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
#include <locale>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "droplet/error.h"
#include "droplet/io/output.h"
#include "droplet/io/read_surface.h"
#include "droplet/version.h"
#include "support/command.h"
#include "support/surfaces.h"

namespace droplet {
namespace {

using ::testing::HasSubstr;
using testing::RoundDroplet;
using testing::roundDroplet;

using Writer = std::uint64_t (*)(const Surface&, std::ostream&);

std::uint64_t writeObjInMillimetres(const Surface& surface, std::ostream& out)
{
    return writeObj(surface, out);
}

std::uint64_t writeStlInMillimetres(const Surface& surface, std::ostream& out)
{
    return writeStl(surface, out);
}

std::string written(Writer writer, const Surface& surface)
{
    std::ostringstream out;
    const std::uint64_t bytes = writer(surface, out);
    EXPECT_TRUE(out.good());
    EXPECT_EQ(bytes, out.str().size());
    return out.str();
}

template <class Number>
Number at(const std::string& bytes, std::size_t offset)
{
    Number number;
    std::memcpy(&number, bytes.data() + offset, sizeof number);
    return number;
}

std::size_t places(const Surface& surface)
{
    std::size_t count = 0;
    for (std::uint32_t i = 0; i < surface.weld.size(); ++i) {
        count += surface.weld[i] == i ? 1U : 0U;
    }
    return count;
}

// Lines of an OBJ, by keyword.
std::map<std::string, std::vector<std::string>> linesOf(const std::string& obj)
{
    std::map<std::string, std::vector<std::string>> lines;
    std::istringstream in(obj);
    for (std::string line; std::getline(in, line);) {
        const std::size_t space = line.find(' ');
        lines[line.substr(0, space)].push_back(line.substr(space + 1));
    }
    return lines;
}

std::vector<double> numbersIn(const std::string& line)
{
    std::istringstream in(line);
    std::vector<double> numbers;
    for (double number = 0.0; in >> number;) {
        numbers.push_back(number);
    }
    return numbers;
}

TEST(Obj, SaysItsUnitAndAxis)
{
    const std::string obj = written(writeObjInMillimetres, roundDroplet());
    EXPECT_EQ(obj.substr(0, obj.find('\n')), std::string("# droplet-shape ") + kVersion);
    EXPECT_THAT(obj.substr(0, 200), HasSubstr("# unit: millimetre, up: +Y, front: +Z\n"));
}

TEST(Obj, WeldsPositionsAndKeepsNormalsApart)
{
    const Surface surface = roundDroplet({.inner = 1e-3, .centre = {1e-3, 2e-3}});
    auto lines = linesOf(written(writeObjInMillimetres, surface));
    ASSERT_EQ(lines["v"].size(), places(surface));
    ASSERT_LT(lines["v"].size(), surface.vertices.size());
    ASSERT_EQ(lines["vt"].size(), surface.vertices.size());
    ASSERT_EQ(lines["vn"].size(), surface.vertices.size());
    ASSERT_EQ(lines["f"].size(), surface.triangles.size());
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
        std::istringstream face(lines["f"][t]);
        for (const std::uint32_t vertex : surface.triangles[t]) {
            std::size_t position = 0;
            std::size_t texture = 0;
            std::size_t normal = 0;
            char slash = 0;
            face >> position >> slash >> texture >> slash >> normal;
            ASSERT_TRUE(face);
            const Vec3 place = surface.vertices[vertex];
            const std::vector<double> v = numbersIn(lines["v"].at(position - 1));
            ASSERT_EQ(v.size(), 3U);
            EXPECT_NEAR(v[0], 1e3 * place.x, 5e-9 * std::abs(v[0]));
            EXPECT_NEAR(v[1], 1e3 * place.z, 5e-9 * std::abs(v[1]));
            EXPECT_NEAR(v[2], -1e3 * place.y, 5e-9 * std::abs(v[2]));
            const std::vector<double> vt = numbersIn(lines["vt"].at(texture - 1));
            ASSERT_EQ(vt.size(), 2U);
            EXPECT_NEAR(vt[0], surface.uvs[vertex].x, 5e-9);
            EXPECT_NEAR(vt[1], 1.0 - surface.uvs[vertex].y, 5e-9);
            const std::vector<double> vn = numbersIn(lines["vn"].at(normal - 1));
            ASSERT_EQ(vn.size(), 3U);
            EXPECT_NEAR(vn[0], surface.normals[vertex].x, 5e-9);
            EXPECT_NEAR(vn[1], surface.normals[vertex].z, 5e-9);
            EXPECT_NEAR(vn[2], -surface.normals[vertex].y, 5e-9);
        }
        std::string rest;
        EXPECT_FALSE(face >> rest);
    }
}

TEST(Obj, HasNineSignificantDigits)
{
    Surface surface = roundDroplet();
    surface.vertices[1].x = 1.0 / 3.0;
    surface.vertices[1].y = -2e-8 / 3.0;
    const std::string obj = written(writeObjInMillimetres, surface);
    EXPECT_THAT(obj, HasSubstr("\nv 333.333333 "));
    EXPECT_THAT(obj, HasSubstr(" 6.66666667e-06\n"));
}

TEST(Obj, WritesNoNegativeZero)
{
    EXPECT_THAT(written(writeObjInMillimetres, roundDroplet()), ::testing::Not(HasSubstr(" -0\n")));
}

// Locale with a decimal comma and points between thousands, as in German.
class CommaForPoint : public std::numpunct<char> {
protected:
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
};

TEST(Obj, DoesNotDependOnTheLocale)
{
    const Surface surface = roundDroplet({.rings = 20, .segments = 80});
    const std::string expected = written(writeObjInMillimetres, surface);
    const std::locale before = std::locale::global(std::locale(std::locale::classic(), new CommaForPoint));
    std::string found;
    {
        std::ostringstream out;  // uses the global locale
        writeObj(surface, out);
        found = out.str();
    }
    std::locale::global(before);
    EXPECT_EQ(found, expected);
}

TEST(Ply, IsBinaryLittleEndianWithNamedProperties)
{
    const Surface surface = roundDroplet();
    const std::string ply = written(writePly, surface);
    const std::string header = "ply\nformat binary_little_endian 1.0\ncomment droplet-shape " + std::string(kVersion) +
                               "\ncomment unit: metre, up: z\nelement vertex " + std::to_string(places(surface)) +
                               "\nproperty float x\nproperty float y\nproperty float z\nproperty float nx\n"
                               "property float ny\nproperty float nz\nproperty float s\nproperty float t\n"
                               "element face " +
                               std::to_string(surface.triangles.size()) +
                               "\nproperty list uchar int vertex_indices\nend_header\n";
    ASSERT_EQ(ply.substr(0, header.size()), header);
    EXPECT_EQ(ply.size(), header.size() + 32 * places(surface) + 13 * surface.triangles.size());
}

TEST(Ply, HoldsContactAnglesInDegrees)
{
    const Surface surface = testing::withContactAngles(roundDroplet());
    const std::string ply = written(writePly, surface);
    EXPECT_THAT(ply, HasSubstr("property float t\nproperty float contact_angle\nelement face"));
    const std::string without = written(writePly, roundDroplet());
    EXPECT_EQ(ply.size(), without.size() + std::string("property float contact_angle\n").size() + 4 * places(surface));
    std::size_t offset = ply.find("end_header\n") + 11;
    for (std::uint32_t v = 0; v < surface.weld.size(); ++v) {
        if (surface.weld[v] == v) {
            const double degrees = surface.contact_angle[v] * 180.0 / 3.14159265358979323846;
            EXPECT_EQ(at<float>(ply, offset + 32), static_cast<float>(degrees));
            offset += 36;
        }
    }
    // The other formats have no contact angles.
    EXPECT_EQ(written(writeObjInMillimetres, surface), written(writeObjInMillimetres, roundDroplet()));
    EXPECT_EQ(written(writeStlInMillimetres, surface), written(writeStlInMillimetres, roundDroplet()));
}

TEST(Ply, TheRimHasTheLiquidsNormal)
{
    const Surface surface = roundDroplet();
    const std::string ply = written(writePly, surface);
    std::size_t offset = ply.find("end_header\n") + 11;
    std::size_t on_rim = 0;
    for (std::size_t i = 0; i < places(surface); ++i, offset += 32) {
        const float radius = std::hypot(at<float>(ply, offset), at<float>(ply, offset + 4));
        if (radius > 3.999e-3F) {
            ++on_rim;
            EXPECT_GT(at<float>(ply, offset + 20), 0.5F);  // the base's would be −1
        }
    }
    EXPECT_EQ(on_rim, RoundDroplet{}.segments);
}

TEST(Ply, HoldsTheSurfaceAsFloats)
{
    const Surface surface = roundDroplet({.centre = {1e-3, 2e-3}});
    const std::string ply = written(writePly, surface);
    const std::size_t vertices = ply.find("end_header\n") + 11;
    const std::size_t faces = vertices + 32 * places(surface);
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
        const std::size_t face = faces + 13 * t;
        ASSERT_EQ(at<unsigned char>(ply, face), 3);
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t own = surface.triangles[t][k];
            const std::uint32_t vertex = surface.weld[own];
            const std::size_t v = vertices + 32 * static_cast<std::size_t>(at<std::int32_t>(ply, face + 1 + 4 * k));
            ASSERT_LT(v, faces);
            EXPECT_EQ(at<float>(ply, v), static_cast<float>(surface.vertices[own].x));
            EXPECT_EQ(at<float>(ply, v + 4), static_cast<float>(surface.vertices[own].y));
            EXPECT_EQ(at<float>(ply, v + 8), static_cast<float>(surface.vertices[own].z));
            EXPECT_EQ(at<float>(ply, v + 12), static_cast<float>(surface.normals[vertex].x));
            EXPECT_EQ(at<float>(ply, v + 16), static_cast<float>(surface.normals[vertex].y));
            EXPECT_EQ(at<float>(ply, v + 20), static_cast<float>(surface.normals[vertex].z));
            EXPECT_EQ(at<float>(ply, v + 24), static_cast<float>(surface.uvs[own].x));
            EXPECT_EQ(at<float>(ply, v + 28), static_cast<float>(1.0 - surface.uvs[own].y));
        }
    }
}

TEST(Stl, IsBinaryInMillimetresWithTheWindingsNormals)
{
    const Surface surface = roundDroplet({.centre = {1e-3, 2e-3}});
    const std::string stl = written(writeStlInMillimetres, surface);
    ASSERT_EQ(stl.size(), 84 + 50 * surface.triangles.size());
    EXPECT_NE(stl.substr(0, 5), "solid");
    EXPECT_THAT(stl.substr(0, 80), HasSubstr("millimetres, z up"));
    EXPECT_EQ(stl.substr(0, 80).find('\0'), std::string::npos);
    ASSERT_EQ(at<std::uint32_t>(stl, 80), surface.triangles.size());
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
        const std::size_t facet = 84 + 50 * t;
        std::array<Vec3, 3> corners;
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 place = surface.vertices[surface.triangles[t][k]];
            const std::size_t v = facet + 12 + 12 * k;
            corners[k] = {at<float>(stl, v), at<float>(stl, v + 4), at<float>(stl, v + 8)};
            EXPECT_EQ(at<float>(stl, v), static_cast<float>(1e3 * place.x));
            EXPECT_EQ(at<float>(stl, v + 4), static_cast<float>(1e3 * place.y));
            EXPECT_EQ(at<float>(stl, v + 8), static_cast<float>(1e3 * place.z));
        }
        const Vec3 area = cross(corners[1] - corners[0], corners[2] - corners[0]);
        const Vec3 normal{at<float>(stl, facet), at<float>(stl, facet + 4), at<float>(stl, facet + 8)};
        EXPECT_NEAR(length(normal), 1.0, 1e-6);
        EXPECT_NEAR(dot(normal, area) / length(area), 1.0, 1e-5);
        EXPECT_EQ(at<std::uint16_t>(stl, facet + 48), 0);
    }
}

TEST(Stl, AFacetWithoutAreaHasNoNormal)
{
    const Surface line = testing::soup({{0, 1, 1}}, 2);
    const std::string stl = written(writeStlInMillimetres, line);
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_EQ(at<float>(stl, 84 + 4 * k), 0.0F);
    }
}

// Our reader restores the size for every unit.
TEST(MeshFiles, StateTheirUnit)
{
    const testing::ScratchDirectory scratch;
    const Surface surface = roundDroplet();
    const auto width = [](const Surface& of) {
        double max = 0.0;
        for (const Vec3& p : of.vertices) {
            max = std::max(max, p.x);
        }
        return max;
    };
    for (const auto& [unit, metres] :
         {std::pair{LengthUnit::Millimetre, 1e-3}, {LengthUnit::Centimetre, 1e-2}, {LengthUnit::Metre, 1.0}}) {
        for (const Format format : {Format::Obj, Format::Stl}) {
            const auto path = scratch.path() / (std::string("a.") + name(format));
            std::ostringstream out;
            writeSurface(surface, out, format, {.unit = unit});
            if (format == Format::Obj) {
                double max = 0.0;
                auto lines = linesOf(out.str());
                for (const std::string& line : lines["v"]) {
                    max = std::max(max, std::stod(line));
                }
                EXPECT_NEAR(max * metres / width(surface), 1.0, 1e-6);
            }
            testing::writeFile(path, out.str());
            EXPECT_NEAR(width(readSurface(path).surface) / width(surface), 1.0, 1e-6) << path << " " << metres;
        }
    }
}

TEST(MeshFiles, ObjMaterialsHaveTheirProperties)
{
    const auto mtl = [](Material material) {
        std::ostringstream out;
        const std::uint64_t bytes = writeMtl(material, out);
        EXPECT_EQ(bytes, out.str().size());
        return out.str();
    };
    EXPECT_THAT(mtl(Material::Water),
                ::testing::AllOf(HasSubstr("newmtl water\n"), HasSubstr("\nNi 1.333\n"), HasSubstr("\nillum 7\n"),
                                 HasSubstr("\nd 0.35\n"), HasSubstr("\nTf 1 1 1\n")));
    EXPECT_THAT(mtl(Material::Honey), ::testing::AllOf(HasSubstr("\nKd 0.9 0.5 0.1\n"), HasSubstr("\nNi 1.489\n")));
    EXPECT_THAT(mtl(Material::Mercury),
                ::testing::AllOf(HasSubstr("\nd 1\n"), HasSubstr("\nPm 1\n"), ::testing::Not(HasSubstr("Tf"))));
    std::ostringstream out;
    writeObj(roundDroplet(), out, {.material = Material::Ink, .material_file = "drop.mtl"});
    EXPECT_THAT(out.str().substr(0, 200), HasSubstr("\nmtllib drop.mtl\nusemtl ink\n"));
}

TEST(MeshFiles, NamesAreLinesOfText)
{
    std::ostringstream out;
    for (const char* name : {"a\nf 1 2 3.mtl", "a\xff.mtl", "a\tb.mtl"}) {
        EXPECT_THROW(writeObj(roundDroplet(), out, {.material_file = name}), Error) << name;
    }
    Look look = lookOf(Material::Ink);
    look.name = "ink\nnewmtl water";
    EXPECT_THROW(writeMtl({look}, out), Error);
    EXPECT_EQ(out.str(), "");
    writeObj(roundDroplet(), out, {.material_file = "größer b.mtl"});
    EXPECT_THAT(out.str().substr(0, 200), HasSubstr("\nmtllib größer b.mtl\n"));
}

TEST(MeshFiles, ObjDropletsHaveTheirMaterials)
{
    ObjOptions options;
    options.material_file = "drop.mtl";
    options.looks = {lookOf(Material::Ink), lookOf(Material::Honey)};
    std::ostringstream out;
    const Surface surface = testing::pairOfDroplets();
    writeObj(surface, out, options);
    const std::string text = out.str();
    const std::size_t honey = text.find("usemtl honey\nf ");
    const std::size_t ink = text.find("usemtl ink\nf ");
    ASSERT_NE(ink, std::string::npos);
    ASSERT_LT(honey, ink) << "the first part of the surface is the second droplet";
    const std::string first = text.substr(honey, ink - honey);
    EXPECT_EQ(std::count(first.begin(), first.end(), '\n'),
              static_cast<std::ptrdiff_t>(surface.parts[0].triangles) + 1);
    std::ostringstream mtl;
    writeMtl({options.looks[0], options.looks[1], options.looks[0]}, mtl);
    EXPECT_THAT(mtl.str(), ::testing::AllOf(HasSubstr("newmtl ink\n"), HasSubstr("newmtl honey\n")));
    EXPECT_EQ(mtl.str().find("newmtl ink"), mtl.str().rfind("newmtl ink"));
    // So do their quadrilaterals.
    Surface joined = surface;
    joinTriangles(joined);
    std::ostringstream quads;
    writeObj(joined, quads, options);
    const std::string faces = quads.str();
    const std::size_t second = faces.find("usemtl ink\nf ");
    ASSERT_NE(second, std::string::npos);
    const std::string before = faces.substr(faces.find("usemtl honey\nf "), second - faces.find("usemtl honey\nf "));
    EXPECT_EQ(std::count(before.begin(), before.end(), '\n'),
              static_cast<std::ptrdiff_t>(joined.parts[0].triangles - joined.parts[0].quads) + 1);
    options.looks.pop_back();
    EXPECT_THROW(writeObj(surface, out, options), Error);
}

struct Named {
    const char* name;
    Writer writer;
};

class MeshFile : public ::testing::TestWithParam<Named> {};

INSTANTIATE_TEST_SUITE_P(Every, MeshFile,
                         ::testing::Values(Named{"Obj", writeObjInMillimetres}, Named{"Ply", writePly},
                                           Named{"Stl", writeStlInMillimetres}),
                         [](const auto& run) { return run.param.name; });

TEST_P(MeshFile, TheSameSurfaceGivesTheSameBytes)
{
    EXPECT_EQ(written(GetParam().writer, roundDroplet()), written(GetParam().writer, roundDroplet()));
}

TEST_P(MeshFile, RefusesNumbersThatAreNotFinite)
{
    const std::vector<std::function<void(Surface&)>> spoils = {
        [](Surface& s) { s.vertices[3].z = std::numeric_limits<double>::quiet_NaN(); },
        [](Surface& s) { s.normals[3].x = std::numeric_limits<double>::infinity(); },
        [](Surface& s) { s.uvs[3].y = std::numeric_limits<double>::quiet_NaN(); },
    };
    for (const auto& spoil : spoils) {
        Surface surface = roundDroplet();
        spoil(surface);
        std::ostringstream out;
        EXPECT_THROW(GetParam().writer(surface, out), Error);
        EXPECT_EQ(out.str(), "");
    }
}

TEST_P(MeshFile, WritesAllTrianglesOfNonManifolds)
{
    // Three triangles share an edge, and one is repeated: half-edges would drop some.
    const Surface surface = testing::soup({{0, 1, 2}, {1, 0, 3}, {0, 1, 4}, {0, 1, 4}}, 5);
    const std::string bytes = written(GetParam().writer, surface);
    const std::string name = GetParam().name;
    if (name == "Obj") {
        EXPECT_EQ(linesOf(bytes)["f"].size(), 4U);
    } else if (name == "Ply") {
        EXPECT_THAT(bytes, HasSubstr("element face 4\n"));
    } else {
        EXPECT_EQ(at<std::uint32_t>(bytes, 80), 4U);
    }
}

}  // namespace
}  // namespace droplet
