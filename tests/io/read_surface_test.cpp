// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/io/read_surface.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "droplet/compare/compare.h"
#include "droplet/error.h"
#include "droplet/io/output.h"
#include "droplet/units.h"
#include "support/command.h"
#include "support/surfaces.h"

namespace droplet {
namespace {

using ::testing::HasSubstr;
using testing::roundDroplet;
using testing::writeFile;

class ReadSurfaceTest : public ::testing::Test {
protected:
    [[nodiscard]] std::filesystem::path path(const std::string& name) const { return scratch_.path() / name; }

    [[nodiscard]] Surface read(const std::string& name, const std::string& bytes) const
    {
        writeFile(path(name), bytes);
        const ReadSurface found = readSurface(path(name));
        EXPECT_NO_THROW(found.surface.validate());
        EXPECT_THAT(found.warnings, ::testing::IsEmpty());
        return found.surface;
    }

    void expectRefused(const std::string& name, const std::string& bytes, const std::string& words) const
    {
        writeFile(path(name), bytes);
        try {
            (void)readSurface(path(name));
            ADD_FAILURE() << "read; should say: " << words;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::InvalidInput);
            EXPECT_THAT(error.what(), HasSubstr(words));
            EXPECT_THAT(error.what(), HasSubstr(path(name).string()));
            EXPECT_THAT(error.what(), ::testing::Not(HasSubstr("\n")));
        }
    }

    testing::ScratchDirectory scratch_;
};

std::string written(const Surface& surface, Format format)
{
    std::ostringstream out;
    writeSurface(surface, out, format);
    return out.str();
}

TEST_F(ReadSurfaceTest, EveryFormatHoldsTheSurfaceThatWasWritten)
{
    for (const Surface& surface :
         {roundDroplet({.centre = {1e-3, 2e-3}}), roundDroplet({.inner = 1e-3, .open = true})}) {
        for (const Format format : {Format::Glb, Format::Gltf, Format::Obj, Format::Ply, Format::Stl}) {
            const Surface found = read(std::string("droplet.") + name(format), written(surface, format));
            const Comparison between = compare(surface, found);
            // Tolerance: floats, or nine digits in millimetres: half a unit in the last place of 5 mm.
            EXPECT_LT(between.symmetric.upper, 1e-9) << name(format);
            EXPECT_TRUE(between.same_topology) << name(format);
            EXPECT_EQ(found.triangles.size(), surface.triangles.size());
            EXPECT_NEAR(between.b.volume, between.a.volume, 1e-6 * between.a.volume) << name(format);
            if (format != Format::Ply && format != Format::Stl) {
                EXPECT_LT(between.normals.largest, 1e-3) << name(format);
            }
        }
    }
}

TEST_F(ReadSurfaceTest, NormalsOfPlyAreTheLiquids)
{
    const Surface surface = roundDroplet({.open = true});
    EXPECT_LT(compare(surface, read("open.ply", written(surface, Format::Ply))).normals.largest, 1e-3);
}

TEST_F(ReadSurfaceTest, NormalsOfStlAreTheFacets)
{
    const Surface found = read("droplet.stl", written(roundDroplet(), Format::Stl));
    for (const Triangle& t : found.triangles) {
        const Vec3 a = found.vertices[t[0]];
        const Vec3 facet = cross(found.vertices[t[1]] - a, found.vertices[t[2]] - a);
        for (const std::uint32_t v : t) {
            EXPECT_NEAR(dot(found.normals[v], facet), length(facet), 1e-12 * length(facet));
        }
    }
}

TEST_F(ReadSurfaceTest, ReadsContactAnglesIfPresent)
{
    const Surface surface = testing::withContactAngles(roundDroplet());
    for (const Format format : {Format::Glb, Format::Ply}) {
        const Surface found = read(std::string("angles.") + name(format), written(surface, format));
        const Comparison between = compare(surface, found);
        ASSERT_TRUE(between.b.contact_angle) << name(format);
        EXPECT_NEAR(between.b.contact_angle->min, between.a.contact_angle->min, 1e-6);
        EXPECT_NEAR(between.b.contact_angle->mean, between.a.contact_angle->mean, 1e-6);
        EXPECT_NEAR(between.b.contact_angle->max, between.a.contact_angle->max, 1e-6);
    }
    EXPECT_TRUE(read("angles.obj", written(surface, Format::Obj)).contact_angle.empty());
    EXPECT_TRUE(read("none.glb", written(roundDroplet(), Format::Glb)).contact_angle.empty());
}

const std::string kTetrahedron = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";

TEST_F(ReadSurfaceTest, ObjInEveryNotation)
{
    const Surface plain = read("plain.obj", kTetrahedron + "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
    EXPECT_EQ(plain.vertices.size(), 4U);
    EXPECT_TRUE(topology(plain).closed);
    EXPECT_NEAR(enclosedVolume(plain), 1e-9 / 6.0, 1e-22);
    // The file is y up: the third vertex is on top.
    EXPECT_EQ(plain.vertices[1], (Vec3{0.0, 0.0, 1e-3}));
    // Negative indices, with textures and normals, comments, groups, blanks, carriage returns, plus signs.
    const std::string other =
        "# a tetrahedron\r\no t\r\n" + kTetrahedron +
        "vt 0 0\nvn 0 0 +1\ng a\n\n  f -4/1/1  -2/1/1 -3/1/1 # one\nf 1//1 2//1 4//1\r\nf 1/1 4/1 "
        "3/1\nusemtl none\nf 2 3 4";
    EXPECT_LE(compare(plain, read("other.obj", other)).symmetric.upper, 1e-17);
    const Surface with = read("other.obj", other);
    EXPECT_TRUE(topology(with).closed);
    EXPECT_EQ((std::count(with.normals.begin(), with.normals.end(), Vec3{0.0, -1.0, 0.0})), 4) << "z of y up is −y";
}

TEST_F(ReadSurfaceTest, QuadrilateralsAreReadAsTheHalvesThatWereJoined)
{
    Surface surface = testing::asOnePart(roundDroplet({.inner = 1e-3}));
    joinTriangles(surface);
    ASSERT_GT(surface.parts[0].quads, 0U);
    for (const Format format : {Format::Obj, Format::Ply}) {
        const Surface found = read(std::string("quads.") + name(format), written(surface, format));
        ASSERT_EQ(found.triangles.size(), surface.triangles.size());
        for (std::size_t t = 0; t < found.triangles.size(); ++t) {
            for (std::size_t k = 0; k < 3; ++k) {
                EXPECT_LT(length(found.vertices[found.triangles[t][k]] - surface.vertices[surface.triangles[t][k]]),
                          1e-9);
            }
        }
        EXPECT_TRUE(topology(found).closed);
    }
}

TEST_F(ReadSurfaceTest, PlyAndStlAsText)
{
    const std::string ply =
        "ply\nformat ascii 1.0\ncomment none\nelement vertex 4\nproperty double x\nproperty list "
        "uchar int more\nproperty float y\nproperty float z\nelement edge 1\nproperty int a\nelement "
        "face 2\nproperty list uchar uint vertex_index\nproperty uchar red\nend_header\n"
        "0 2 7 8 0 0\n1 0 0 0\n1 0 1 0\n0 0 1 0.5\n9\n3 0 1 2 255\n3 0 2 3 255\n";
    const Surface square = read("square.ply", ply);
    EXPECT_EQ(square.vertices[3], (Vec3{0.0, 1.0, 0.5}));
    EXPECT_EQ(square.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
    EXPECT_GT(square.normals[1].z, 0.99);
    const std::string facet =
        "facet normal 0 0 0\nouter loop\nvertex 0 0 0\n vertex 1e3 0 0\nvertex 0 1e3 0\nendloop\n";
    const Surface one = read("one.stl", "solid one\n" + facet + "endfacet\nendsolid one\n");
    EXPECT_EQ(one.vertices[1], (Vec3{1.0, 0.0, 0.0}));
    EXPECT_EQ(one.normals[0], (Vec3{0.0, 0.0, 1.0}));
    const auto with = [&](const std::string& number) {
        std::string text = "solid one\n" + facet + "endfacet\nendsolid one\n";
        return text.replace(text.find("1e3"), 3, number);
    };
    EXPECT_EQ(read("exact.stl", with("0.1234567890123456")).vertices[1].x, kMillimetre * 0.1234567890123456);
    expectRefused("nan.stl", with("nan"), "not STL");
    expectRefused("word.stl", with("one"), "not STL");
    expectRefused("quad.stl", with("1 0 0\nvertex 1 1 0\nvertex 1"), "not STL");
    expectRefused("cut.stl", "solid one\n" + facet, "cut short");
    expectRefused("empty.stl", "solid one\nendsolid one\n", "no triangles");
    for (std::size_t length = 0; length + 8 < ply.size(); ++length) {
        writeFile(path("cut.ply"), ply.substr(0, length));
        EXPECT_THROW((void)readSurface(path("cut.ply")), Error) << length;
    }
}

TEST_F(ReadSurfaceTest, FilesCutAnywhereAreRefused)
{
    const Surface surface = roundDroplet({.rings = 1, .segments = 3});
    for (const Format format : {Format::Ply, Format::Stl, Format::Glb}) {
        const std::string bytes = written(surface, format);
        for (std::size_t length = 0; length < bytes.size(); length += format == Format::Glb ? 7 : 1) {
            writeFile(path("cut"), "");
            const std::filesystem::path file = path(std::string("cut.") + name(format));
            writeFile(file, bytes.substr(0, length));
            EXPECT_THROW((void)readSurface(file), Error) << name(format) << " cut to " << length;
        }
    }
}

TEST_F(ReadSurfaceTest, DamageIsNamed)
{
    expectRefused("two.obj", kTetrahedron + "f 1 2\n", "line 5 has a face with fewer than three corners");
    expectRefused("index.obj", kTetrahedron + "f 1 2 5\n", "names \"5\" of 4");
    expectRefused("zero.obj", kTetrahedron + "f 0 1 2\n", "names \"0\" of 4");
    expectRefused("back.obj", kTetrahedron + "f -5 1 2\n", "names \"-5\" of 4");
    expectRefused("word.obj", "v 0 zero 0\n", "line 1 has \"zero\" where a number should be");
    expectRefused("nan.obj", "v 0 nan 0\n", "where a number should be");
    expectRefused("short.obj", "v 0 0\n", "where a number should be");
    expectRefused("empty.obj", "", "no triangles");
    expectRefused("points.obj", kTetrahedron, "no triangles");
    expectRefused("far.obj", "v 1e308 0 0\nv -1e308 0 0\nv 1e308 1e308 1e308\nf 1 2 3\nv inf 0 0", "number");
    const std::string header =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty "
        "float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
    expectRefused("line.ply", header + "0 0 0\n1 0 0\n0 1 0\n2 0 1\n", "2 corners; it must have at least three");
    expectRefused("quad.ply", header + "0 0 0\n1 0 0\n0 1 0\n4 0 1 2 3\n", "3");
    expectRefused("index.ply", header + "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "names vertex 3 of 3");
    expectRefused("minus.ply", header + "0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n", "count or index");
    expectRefused("big.ply", "ply\nformat binary_big_endian 1.0\nend_header\n", "binary_big_endian");
    expectRefused("type.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty quad x\n", "quad");
    expectRefused("count.ply",
                  "ply\nformat ascii 1.0\nelement vertex 99999999999999\nproperty float x\nproperty float "
                  "y\nproperty float z\nend_header\n",
                  "cut short");
    expectRefused("no.ply", "plyers\n", "ply");
    expectRefused("x.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n1\n", "x, y and z");
    std::string stl = written(roundDroplet(), Format::Stl);
    stl.replace(84 + 12, 4, std::string("\0\0\xc0\x7f", 4));
    expectRefused("nan.stl", stl, "not finite");
    expectRefused("more.stl", written(roundDroplet(), Format::Stl) + "x",
                  "bytes, which do not match its number of triangles");
    expectRefused("text.glb", "text", "");
    std::filesystem::create_directory(path("folder.obj"));
    EXPECT_THROW((void)readSurface(path("folder.obj")), Error);
    EXPECT_THROW((void)readSurface(path("missing.obj")), Error);
    try {
        (void)readSurface(path("droplet.xyz"));
        ADD_FAILURE();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::InvalidArgument);
        EXPECT_THAT(error.what(), HasSubstr("xyz"));
    }
}

TEST_F(ReadSurfaceTest, ReadsTheRestPoseOfAnimatedFiles)
{
    std::string gltf = written(roundDroplet(), Format::Gltf);
    const std::string mark = "\"attributes\"";
    gltf.insert(gltf.find(mark), "\"targets\":[{\"POSITION\":0}],");
    writeFile(path("moves.gltf"), gltf);
    const ReadSurface found = readSurface(path("moves.gltf"));
    EXPECT_THAT(found.warnings, ::testing::ElementsAre(HasSubstr("the rest pose is read")));
    EXPECT_LT(compare(roundDroplet(), found.surface).symmetric.upper, 1e-9);
}

}  // namespace
}  // namespace droplet
