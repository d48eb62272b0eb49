// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/io/usd.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <locale>
#include <sstream>
#include <string>
#include <vector>

#include "droplet/error.h"
#include "droplet/units.h"
#include "support/surfaces.h"

namespace droplet {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using testing::roundDroplet;
using ::testing::StartsWith;

using Writer = std::uint64_t (*)(const Surface&, std::ostream&, Material);

std::string written(Writer write, const Surface& surface, Material material = Material::Water)
{
    std::ostringstream out;
    const std::uint64_t bytes = write(surface, out, material);
    EXPECT_TRUE(out.good());
    EXPECT_EQ(bytes, out.str().size());
    return out.str();
}

/// Numbers of a list, without its brackets; those of tuples one after another.
std::vector<float> listOf(const std::string& usda, const std::string& declaration)
{
    const std::string begin = "        " + declaration + " = [";
    const std::size_t at = usda.find(begin);
    EXPECT_NE(at, std::string::npos) << declaration;
    const std::size_t first = at + begin.size();
    std::string text = usda.substr(first, usda.find(']', first) - first);
    for (char& c : text) {
        c = c == '(' || c == ')' || c == ',' ? ' ' : c;
    }
    std::istringstream in(text);
    std::vector<float> numbers;
    for (float number = 0.0F; in >> number;) {
        numbers.push_back(number);
    }
    EXPECT_TRUE(in.eof()) << declaration;
    return numbers;
}

/// Text after the list, up to the end of its metadata.
std::string interpolationOf(const std::string& usda, const std::string& declaration)
{
    const std::size_t end = usda.find(']', usda.find("        " + declaration + " = [") + declaration.size() + 12);
    const std::string rest = usda.substr(end, 60);
    return rest.find("interpolation") == std::string::npos
               ? ""
               : rest.substr(rest.find('"') + 1, rest.rfind('"') - rest.find('"') - 1);
}

float nearestFloat(double value)
{
    return static_cast<float>(value);
}

template <class Number>
Number at(const std::string& bytes, std::size_t offset)
{
    Number number;
    std::memcpy(&number, bytes.data() + offset, sizeof number);
    return number;
}

TEST(Usda, StatesUnitAxisAndDefaultPrim)
{
    const std::string usda = written(writeUsda, roundDroplet());
    EXPECT_THAT(usda, StartsWith("#usda 1.0\n(\n    defaultPrim = \"droplet\"\n"));
    const std::string header = usda.substr(0, usda.find("\n)\n"));
    EXPECT_THAT(header, HasSubstr("\n    metersPerUnit = 1\n    upAxis = \"Y\""));
    EXPECT_THAT(usda, HasSubstr("\ndef Xform \"droplet\" ("));
    EXPECT_THAT(usda, HasSubstr("token orientation = \"rightHanded\""));
    EXPECT_THAT(usda, HasSubstr("token subdivisionScheme = \"none\""));
}

TEST(Usda, WeldsPointsAndKeepsNormalsApart)
{
    const Surface surface = testing::withContactAngles(roundDroplet({.inner = 1e-3, .centre = {1e-3, 2e-3}}));
    const std::string usda = written(writeUsda, surface);
    const auto counts = listOf(usda, "int[] faceVertexCounts");
    const auto corners = listOf(usda, "int[] faceVertexIndices");
    const auto points = listOf(usda, "point3f[] points");
    const auto normals = listOf(usda, "normal3f[] primvars:normals");
    const auto normal_indices = listOf(usda, "int[] primvars:normals:indices");
    const auto textures = listOf(usda, "texCoord2f[] primvars:st");
    const auto angles = listOf(usda, "float[] primvars:contact_angle");
    EXPECT_EQ(counts, std::vector<float>(surface.triangles.size(), 3.0F));
    ASSERT_EQ(corners.size(), 3 * surface.triangles.size());
    ASSERT_EQ(normal_indices.size(), corners.size());
    ASSERT_LT(points.size(), 3 * surface.positions.size());
    EXPECT_EQ(textures.size(), points.size() / 3 * 2);
    EXPECT_EQ(angles.size(), points.size() / 3);
    EXPECT_EQ(interpolationOf(usda, "normal3f[] primvars:normals"), "faceVarying");
    EXPECT_EQ(interpolationOf(usda, "texCoord2f[] primvars:st"), "vertex");
    EXPECT_EQ(interpolationOf(usda, "float[] primvars:contact_angle"), "vertex");
    std::size_t angles_seen = 0;
    for (std::size_t c = 0; c < corners.size(); ++c) {
        const std::uint32_t vertex = surface.triangles[c / 3][c % 3];
        const auto point = static_cast<std::size_t>(corners[c]);
        ASSERT_LT(3 * point, points.size());
        EXPECT_EQ(points[3 * point], nearestFloat(surface.positions[vertex].x));
        EXPECT_EQ(points[3 * point + 1], nearestFloat(surface.positions[vertex].z));
        EXPECT_EQ(points[3 * point + 2], nearestFloat(0.0 - surface.positions[vertex].y));
        const auto normal = static_cast<std::size_t>(normal_indices[c]);
        ASSERT_LT(3 * normal, normals.size());
        EXPECT_EQ(normals[3 * normal + 1], nearestFloat(surface.normals[vertex].z));
        EXPECT_EQ(textures[2 * point], nearestFloat(surface.uvs[vertex].x));
        EXPECT_EQ(textures[2 * point + 1], nearestFloat(1.0 - surface.uvs[vertex].y));
        if (const float angle = surface.contact_angle[vertex]; angle != 0.0F) {
            EXPECT_EQ(angles[point], nearestFloat(static_cast<double>(angle) / kDegree));
            ++angles_seen;
        }
    }
    EXPECT_GT(angles_seen, 0U);
    const auto extent = listOf(usda, "float3[] extent");
    ASSERT_EQ(extent.size(), 6U);
    for (std::size_t i = 0; i < points.size(); ++i) {
        EXPECT_GE(points[i], extent[i % 3]);
        EXPECT_LE(points[i], extent[3 + i % 3]);
    }
}

// A surface that leans out is spread over its footprint, so copies on the rim may differ.
TEST(Usda, GivesCornersTheirOwnTextureWhereCopiesDiffer)
{
    Surface surface = roundDroplet();
    for (std::uint32_t i = 0; i < surface.weld.size(); ++i) {
        if (surface.weld[i] != i) {
            surface.uvs[i].x += 0.125;
        }
    }
    const std::string usda = written(writeUsda, surface);
    EXPECT_EQ(interpolationOf(usda, "texCoord2f[] primvars:st"), "faceVarying");
    const auto textures = listOf(usda, "texCoord2f[] primvars:st");
    const auto indices = listOf(usda, "int[] primvars:st:indices");
    ASSERT_EQ(indices.size(), 3 * surface.triangles.size());
    for (std::size_t c = 0; c < indices.size(); ++c) {
        EXPECT_EQ(textures[2 * static_cast<std::size_t>(indices[c])],
                  nearestFloat(surface.uvs[surface.triangles[c / 3][c % 3]].x));
    }
}

TEST(Usda, BindsTheMaterial)
{
    const std::string ink = written(writeUsda, roundDroplet(), Material::Ink);
    EXPECT_THAT(ink, HasSubstr("rel material:binding = </droplet/ink>"));
    EXPECT_THAT(ink, HasSubstr("def Material \"ink\""));
    EXPECT_THAT(ink, HasSubstr("outputs:surface.connect = </droplet/ink/preview.outputs:surface>"));
    EXPECT_THAT(ink, HasSubstr("color3f inputs:diffuseColor = (0.03, 0.06, 0.35)\n"));
    EXPECT_THAT(ink, HasSubstr("float inputs:ior = 1.333\n"));
    EXPECT_THAT(ink, HasSubstr("float inputs:opacity = 0.35\n"));
    const std::string mercury = written(writeUsda, roundDroplet(), Material::Mercury);
    EXPECT_THAT(mercury, HasSubstr("float inputs:metallic = 1\n"));
    EXPECT_THAT(mercury, HasSubstr("float inputs:opacity = 1\n"));
    EXPECT_THAT(mercury, HasSubstr("float inputs:roughness = 0.02\n"));
}

TEST(Usda, ASurfaceWithoutLiquidHasNoMesh)
{
    const std::string usda = written(writeUsda, {});
    EXPECT_THAT(usda, HasSubstr("def Xform \"droplet\""));
    EXPECT_THAT(usda, Not(HasSubstr("Mesh")));
}

TEST(Usd, DoesNotDependOnTheLocale)
{
    struct Comma : std::numpunct<char> {
        char do_decimal_point() const override { return ','; }
        char do_thousands_sep() const override { return '.'; }
        std::string do_grouping() const override { return "\3"; }
    };
    for (const Writer write : {writeUsda, writeUsdz}) {
        const std::string expected = written(write, roundDroplet());
        const std::locale before = std::locale::global(std::locale(std::locale::classic(), new Comma));
        const std::string bytes = written(write, roundDroplet());
        std::locale::global(before);
        EXPECT_EQ(bytes, expected);
    }
}

TEST(Usd, RefusesInvalidSurfaces)
{
    Surface surface = roundDroplet();
    surface.positions[3].x = std::numeric_limits<double>::quiet_NaN();
    Surface far = roundDroplet();
    far.positions[0].z = 1e39;
    for (const Writer write : {writeUsda, writeUsdz}) {
        for (const Surface& wrong : {surface, far}) {
            std::ostringstream out;
            EXPECT_THROW(write(wrong, out, Material::Water), Error);
        }
    }
}

TEST(Usd, LeavesAFullStreamFailed)
{
    struct Full : std::streambuf {};
    for (const Writer write : {writeUsda, writeUsdz}) {
        Full full;
        std::ostream out(&full);
        write(roundDroplet(), out, Material::Water);
        EXPECT_FALSE(out.good());
    }
}

// Offsets of a zip's headers: PKWARE's specification, sections 4.3.7, 4.3.12 and 4.3.16.
TEST(Usdz, IsAnAlignedZipWithoutCompression)
{
    const std::string usda = written(writeUsda, roundDroplet());
    const std::string zip = written(writeUsdz, roundDroplet());
    const auto crc = static_cast<std::uint32_t>(
        crc32(0, reinterpret_cast<const Bytef*>(usda.data()), static_cast<uInt>(usda.size())));
    const std::size_t begin = 30U + at<std::uint16_t>(zip, 26) + at<std::uint16_t>(zip, 28);
    EXPECT_EQ(begin % 64, 0U);
    EXPECT_EQ(zip.substr(begin, usda.size()), usda);
    EXPECT_EQ(zip.substr(30, at<std::uint16_t>(zip, 26)), "droplet.usda");
    const std::size_t end = zip.size() - 22;
    EXPECT_EQ(at<std::uint32_t>(zip, end), 0x06054b50U);
    EXPECT_EQ(at<std::uint16_t>(zip, end + 10), 1);
    const std::size_t entry = at<std::uint32_t>(zip, end + 16);
    EXPECT_EQ(entry, begin + usda.size());
    EXPECT_EQ(at<std::uint32_t>(zip, end + 12), end - entry);
    EXPECT_EQ(zip.substr(entry + 46, 12), "droplet.usda");
    EXPECT_EQ(at<std::uint32_t>(zip, entry), 0x02014b50U);
    EXPECT_EQ(at<std::uint32_t>(zip, entry + 42), 0U);
    EXPECT_EQ(at<std::uint32_t>(zip, 0), 0x04034b50U);
    for (const std::size_t fields : {std::size_t{4}, entry + 6}) {
        EXPECT_EQ(at<std::uint16_t>(zip, fields + 2), 0);  // flags
        EXPECT_EQ(at<std::uint16_t>(zip, fields + 4), 0);  // stored
        EXPECT_EQ(at<std::uint32_t>(zip, fields + 10), crc);
        EXPECT_EQ(at<std::uint32_t>(zip, fields + 14), usda.size());
        EXPECT_EQ(at<std::uint32_t>(zip, fields + 18), usda.size());
    }
}

}  // namespace
}  // namespace droplet
