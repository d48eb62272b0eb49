// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/flow_io/flow_object.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include "droplet/drawing/picture.h"
#include "droplet/error.h"
#include "support/command.h"
#include "support/gltf_draft.h"

namespace droplet {
namespace {

using ::testing::AllOf;
using testing::Draft;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using testing::writeFile;

void expectNear(Vec3 a, Vec3 b, double tolerance = 1e-6)
{
    EXPECT_NEAR(a.x, b.x, tolerance);
    EXPECT_NEAR(a.y, b.y, tolerance);
    EXPECT_NEAR(a.z, b.z, tolerance);
}

Vec3 worldOf(const ObjectMotion& motion, double time, Vec3 point)
{
    const ObjectPose pose = motion.at(time);
    return pose.place + pose.toWorld(point);
}

class FlowObjectFile : public ::testing::Test {
protected:
    [[nodiscard]] FlowObject read(const std::string& name, const std::string& bytes,
                                  const ObjectOptions& options = {}) const
    {
        writeFile(scratch_.path() / name, bytes);
        FlowObject object = readFlowObject(scratch_.path() / name, options);
        EXPECT_EQ(object.normals.size(), object.vertices.size());
        EXPECT_TRUE(object.uvs.empty() || object.uvs.size() == object.vertices.size());
        EXPECT_TRUE(object.materials.empty() || object.materials.size() == object.triangles.size());
        object.motion.validate();
        return object;
    }

    void expectRefused(const std::string& name, const std::string& bytes, const std::string& words,
                       const ObjectOptions& options = {}) const
    {
        writeFile(scratch_.path() / name, bytes);
        try {
            (void)readFlowObject(scratch_.path() / name, options);
            ADD_FAILURE() << "read; should say: " << words;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::InvalidInput) << error.what();
            EXPECT_THAT(error.what(), AllOf(HasSubstr(name), HasSubstr(words), Not(HasSubstr("\n"))));
        }
    }

    [[nodiscard]] const std::filesystem::path& folder() const { return scratch_.path(); }

private:
    testing::ScratchDirectory scratch_;
};

const std::string kObj = R"(mtllib ignored.mtl
v 0 0 0
v 1000 0 0
v 1000 2000 0
v 0 2000 0
vt 0 0
vt 1 0
vt 1 1
vt 0 1
vn 0 0 1
usemtl Wet Glass
f 1/1/1 2/2/1 3/3/1 4/4/1
usemtl rough
f 1/2/1 2/1/1 4/4/1
)";

// Two strips, of three triangles and of one; the first turns where it repeats a vertex.
TEST_F(FlowObjectFile, PlyHasStrips)
{
    const std::string vertices =
        "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\n";
    const std::string places = "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n1 2 0\n";
    const std::string list = "\nproperty list int int vertex_indices\nend_header\n";
    const FlowObject faces =
        read("faces.ply", vertices + "element face 4" + list + places + "3 0 1 2\n3 2 1 3\n3 2 3 4\n3 4 3 5\n");
    const FlowObject strips =
        read("strips.ply", vertices + "element tristrips 1" + list + places + "10 0 1 2 3 4 -1 4 3 5 5\n");
    EXPECT_EQ(strips.vertices, faces.vertices);
    EXPECT_EQ(strips.triangles, faces.triangles);
    expectRefused("bad.ply", vertices + "element tristrips 1" + list + places + "4 0 1 2 6\n", "vertex 6 of 6");
    expectRefused("bad.ply", vertices + "element tristrips 1" + list + places + "4 0 1 2 -2\n", "not valid");
}

TEST_F(FlowObjectFile, ObjHasUvMaterialsAndPolygons)
{
    const FlowObject object = read("wall.obj", kObj);
    EXPECT_THAT(object.triangles, ::testing::SizeIs(3));
    EXPECT_THAT(object.material_names, ElementsAre("Wet Glass", "rough"));
    EXPECT_THAT(object.materials, ElementsAre(0, 0, 1));
    EXPECT_THAT(object.warnings, ElementsAre(HasSubstr("ignored.mtl is not a file beside it")));
    // Four corners, and two of them again with another uv. Millimetres, y up; v counts from below.
    ASSERT_THAT(object.vertices, ::testing::SizeIs(6));
    EXPECT_EQ(object.vertices[2], (Vec3{1.0, 0.0, 2.0}));
    EXPECT_EQ(object.uvs[2], (Vec2{1.0, 0.0}));
    EXPECT_EQ(object.uvs[1], (Vec2{1.0, 1.0}));
    EXPECT_EQ(object.normals[0], (Vec3{0.0, -1.0, 0.0}));
}

TEST_F(FlowObjectFile, ObjHasTheLooksOfItsMaterialLibrary)
{
    EXPECT_THAT(read("wall.obj", kObj).looks, IsEmpty()) << "without the library";
    writeFile(folder() / "ignored.mtl",
              "newmtl Wet Glass\nKd 0.1 0.2 0.3\nd 0.25\nNi 1.52\nNs 0\nnewmtl other\nKd 1 0 0\nnewmtl rough\nKd 0.5\n"
              "Pr 0.9\nPm 1\nmap_Kd ../secret.png\n");
    const FlowObject object = read("wall.obj", kObj);
    ASSERT_THAT(object.looks, ::testing::SizeIs(2));
    EXPECT_EQ(object.looks[0].look.colour, (Vec3{0.1, 0.2, 0.3}));
    EXPECT_EQ(object.looks[0].opacity, 0.25);
    EXPECT_EQ(object.looks[0].look.ior, 1.52);
    EXPECT_EQ(object.looks[0].look.roughness, 1.0);
    EXPECT_EQ(object.looks[0].look.metallic, 0.0);
    EXPECT_EQ(object.looks[1].look.colour, (Vec3{0.5, 0.5, 0.5}));
    EXPECT_EQ(object.looks[1].look.roughness, 0.9);
    EXPECT_EQ(object.looks[1].look.metallic, 1.0);
    EXPECT_FALSE(object.looks[1].colours);
    EXPECT_THAT(object.warnings, ElementsAre(HasSubstr("without a texture: ../secret.png is not a file beside it")));
    std::ostringstream png;
    writePng(Picture{1, 1, {255, 0, 0}}, png);
    writeFile(folder() / "red one.png", png.str());
    writeFile(folder() / "broken.png", "no picture");
    writeFile(folder() / "ignored.mtl",
              "newmtl rough\r\nmap_Kd red one.png\r\nnewmtl Wet Glass\r\nmap_Kd broken.png\r\n");
    const FlowObject painted = read("wall.obj", kObj);
    ASSERT_TRUE(painted.looks[1].colours);
    EXPECT_EQ(painted.looks[1].colours->rgb, (std::vector<std::uint8_t>{255, 0, 0}));
    EXPECT_EQ(painted.images[1].colours, png.str());
    EXPECT_EQ(painted.images[0].colours, "");
    EXPECT_THAT(painted.warnings, ElementsAre(HasSubstr("without a texture: broken.png: not an image")));
}

std::string pngOf(std::vector<std::uint8_t> rgb)
{
    std::ostringstream png;
    writePng(Picture{1, 1, std::move(rgb)}, png);
    return png.str();
}

// As several programs write them.
TEST_F(FlowObjectFile, ObjFindsTexturesHoweverTheyAreNamed)
{
    writeFile(folder() / "a b.png", pngOf({255, 0, 0}));
    for (const char* const line :
         {"map_Kd a b.png", "map_Kd \"a b.png\"", "map_Kd a b.png # red", "map_Kd \"a b.png\" # red",
          "map_Kd -clamp on -bm 0.5 a b.png", "map_Kd -s 1 1 1 -o 0 0 -mm 0 1 a b.png", "map_Kd /home/else/a b.png",
          "map_Kd C:\\Users\\else\\a b.png", "map_Kd ../a b.png", "map_Kd /home/else/textures/../a b.png"}) {
        writeFile(folder() / "ignored.mtl", std::string("\xef\xbb\xbfnewmtl rough\n") + line + "\nnewmtl Wet Glass\n");
        const FlowObject object = read("wall.obj", kObj);
        ASSERT_TRUE(object.looks.at(1).colours) << line;
        const bool changes = std::string(line).find("-mm") != std::string::npos;
        EXPECT_THAT(object.warnings, ::testing::SizeIs(changes ? 1 : 0)) << line;
    }
    std::filesystem::create_directory(folder() / "textures");
    writeFile(folder() / "textures" / "deep.png", pngOf({0, 255, 0}));
    writeFile(folder() / "ignored.mtl", "newmtl rough\nmap_Kd D:\\else\\textures\\deep.png\nnewmtl Wet Glass\n");
    EXPECT_TRUE(read("wall.obj", kObj).looks.at(1).colours) << "the end of a path";
    writeFile(folder() / "empty.png", "");
    writeFile(folder() / "ignored.mtl",
              "newmtl rough\nmap_Kd -s 2 4 1 -o 0.5 0.25 a b.png\nnewmtl Wet Glass\nmap_Kd empty.png\n");
    const FlowObject tiled = read("wall.obj", kObj);
    EXPECT_THAT(tiled.warnings, ElementsAre(HasSubstr("empty.png is empty")));
    // v counts from below: the file's (0.5, 0.25) is at (1.5, 1.25) in the picture, which repeats.
    const Vec2 at = tiled.looks.at(1).place.at({0.5, 0.75});
    EXPECT_NEAR(at.x, 1.5, 1e-12);
    EXPECT_NEAR(1.0 - at.y, 1.25, 1e-12);
}

TEST_F(FlowObjectFile, ObjLibrariesAreReadHoweverTheyAreWritten)
{
    writeFile(folder() / "red.png", pngOf({255, 0, 0}));
    for (const char* const library : {"newmtl rough # old\nmap_kd red.png\n", "newmtl rough\rmap_Kd red.png\r",
                                      "newmtl  rough\t\nmap_KD red.png"}) {
        writeFile(folder() / "ignored.mtl", library);
        EXPECT_TRUE(read("wall.obj", kObj).looks.at(1).colours) << library;
    }
    writeFile(folder() / "ignored.mtl", std::string("\xff\xfen\0e\0w\0", 8));
    EXPECT_THAT(read("wall.obj", kObj).warnings, ElementsAre(HasSubstr("ignored.mtl is not text in UTF-8")));
}

TEST_F(FlowObjectFile, ObjHasSeveralLibrariesAndTellsWhatTheyLack)
{
    writeFile(folder() / "one.mtl", "newmtl rough\nKd 1 0 0\n");
    writeFile(folder() / "two.mtl", "newmtl Wet Glass\nKd 0 1 0\n");
    const std::string faces = kObj.substr(kObj.find('\n') + 1);
    const FlowObject both = read("wall.obj", "mtllib one.mtl two.mtl\n" + faces);
    ASSERT_THAT(both.looks, ::testing::SizeIs(2));
    EXPECT_EQ(both.looks[0].look.colour, (Vec3{0.0, 1.0, 0.0}));
    EXPECT_EQ(both.looks[1].look.colour, (Vec3{1.0, 0.0, 0.0}));
    EXPECT_THAT(both.warnings, IsEmpty());
    EXPECT_THAT(read("wall.obj", "mtllib one.mtl\n" + faces).warnings, ElementsAre(HasSubstr("lacks Wet Glass")));
    EXPECT_THAT(read("wall.obj", "mtllib one.mtl three.mtl\nmtllib two.mtl\n" + faces).warnings,
                ElementsAre(HasSubstr("three.mtl is not a file")));
}

TEST_F(FlowObjectFile, ObjHasMatterThatRefractsAndDirections)
{
    writeFile(folder() / "blue.png", pngOf({128, 128, 255}));
    writeFile(folder() / "grey.png", pngOf({128, 128, 128}));
    writeFile(folder() / "ignored.mtl",
              "newmtl Wet Glass\nKd 0 0 0\nTf 0.9 0.8 0.7\nillum 7\nNi 1.5\nmap_Bump -bm 0.25 blue.png\n"
              "newmtl rough\nd 0.5\nillum 4\nbump grey.png\n");
    const FlowObject object = read("wall.obj", kObj);
    ASSERT_THAT(object.looks, ::testing::SizeIs(2));
    EXPECT_TRUE(object.looks[0].thickness);
    EXPECT_EQ(object.looks[0].look.transmission, 1.0);
    EXPECT_EQ(object.looks[0].look.colour, (Vec3{0.9, 0.8, 0.7}));
    EXPECT_TRUE(object.looks[0].normals);
    EXPECT_EQ(object.looks[0].relief, 0.25);
    EXPECT_FALSE(object.looks[1].thickness);
    EXPECT_FALSE(object.looks[1].normals);
    EXPECT_THAT(object.warnings, ElementsAre(HasSubstr("without grey.png, which has heights")));
}

/// Prism about the y axis, of unit radius and height, without normals.
std::string prism(int sides)
{
    std::ostringstream obj;
    for (int k = 0; k < sides; ++k) {
        const double turn = 2.0 * std::numbers::pi * k / sides;
        for (const double y : {0.0, 1.0}) {
            obj << "v " << 1000.0 * std::cos(turn) << ' ' << 1000.0 * y << ' ' << 1000.0 * std::sin(turn) << '\n';
        }
    }
    std::string lid = "f";
    std::string ground = "f";
    for (int k = 0; k < sides; ++k) {
        const int next = (k + 1) % sides;
        obj << "f " << 2 * k + 1 << ' ' << 2 * k + 2 << ' ' << 2 * next + 2 << ' ' << 2 * next + 1 << '\n';
        lid = "f " + std::to_string(2 * k + 2) + lid.substr(1);
        ground += " " + std::to_string(2 * k + 1);
    }
    return obj.str() + lid + "\n" + ground + "\n";
}

// Of a fine prism the side is round and the lids are flat; of a coarse one all faces are flat.
TEST_F(FlowObjectFile, NormalsThatAFileLacksHaveCreases)
{
    const auto expectNormals = [](const FlowObject& object, const auto& wanted) {
        for (const Triangle& triangle : object.triangles) {
            const Vec3 a = object.vertices[triangle[0]];
            const Vec3 facet = cross(object.vertices[triangle[1]] - a, object.vertices[triangle[2]] - a);
            for (const std::uint32_t v : triangle) {
                expectNear(object.normals[v], wanted(object.vertices[v], (1.0 / length(facet)) * facet), 1e-5);
            }
        }
    };
    const auto flat = [](Vec3 /*place*/, Vec3 facet) { return facet; };
    const auto round = [](Vec3 place, Vec3 facet) {
        return std::abs(facet.z) > 0.5 ? facet : Vec3{place.x, place.y, 0.0};
    };
    expectNormals(read("four.obj", prism(4)), flat);
    expectNormals(read("six.obj", prism(6)), flat);
    const FlowObject seven = read("seven.obj", prism(7));
    expectNormals(seven, round);
    EXPECT_THAT(seven.vertices, ::testing::SizeIs(28)) << "one for each side of the rims";
    EXPECT_THAT(
        read("with.obj", "vn 0 1 0\nv 0 0 0\nv 1000 0 0\nv 0 0 1000\nv 0 1000 0\nf 1//1 2//1 3//1\nf 1//1 2//1 4//1\n")
            .normals,
        ::testing::Each(Vec3{0.0, 0.0, 1.0}))
        << "given normals stay";
}

TEST_F(FlowObjectFile, FacesThatRepeatOthersChangeNoNormals)
{
    const FlowObject once = read("once.obj", prism(12));
    std::string twice = prism(12);
    const std::string faces = twice.substr(twice.find("f "));
    const FlowObject object = read("twice.obj", twice + faces);
    for (std::size_t t = 0; t < once.triangles.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            expectNear(object.normals[object.triangles[t][k]], once.normals[once.triangles[t][k]], 1e-12);
        }
    }
}

// Closed parts face outward in files, too, but not the inner side of something hollow.
TEST_F(FlowObjectFile, FacesAsItsSurface)
{
    const auto volumes = [](const FlowObject& object) {
        std::array<double, 2> sum{};  // of the outer and the inner box
        for (const auto& [a, b, c] : object.triangles) {
            const Vec3 p = object.vertices[a];
            sum.at(std::abs(p.x) > 0.7 ? 0 : 1) += dot(p, cross(object.vertices[b], object.vertices[c])) / 6.0;
            const Vec3 facet = cross(object.vertices[b] - p, object.vertices[c] - p);
            EXPECT_GT(dot(object.normals[a] + object.normals[b] + object.normals[c], facet), 0.0);
        }
        return sum;
    };
    const auto box = [](double half, bool is_inward, int first) {
        std::ostringstream obj;
        for (int k = 0; k < 8; ++k) {
            obj << "v " << (k & 1 ? half : -half) << ' ' << (k & 2 ? half : -half) << ' ' << (k & 4 ? half : -half)
                << '\n';
        }
        for (const auto& [a, b, c, d] :
             {std::array{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
            std::array<int, 4> corners{a, b, c, d};
            if (is_inward) {
                std::reverse(corners.begin(), corners.end());
            }
            obj << 'f';
            for (const int corner : corners) {
                obj << ' ' << first + corner + 1;
            }
            obj << '\n';
        }
        return obj.str();
    };
    const auto faced = [&](const std::string& text) {
        FlowObject object = read("box.obj", text, {.scale = 1000.0});
        faceAs(flowSurface(object.vertices, object.triangles), object);
        return volumes(object);
    };
    EXPECT_NEAR(faced(box(1.0, true, 0))[0], 8.0, 1e-9);
    const auto hollow = faced(box(1.0, false, 0) + box(0.5, true, 8));
    EXPECT_NEAR(hollow[0], 8.0, 1e-9);
    EXPECT_NEAR(hollow[1], -1.0, 1e-9) << "a cavity";
    const auto beside = faced(box(0.5, true, 0));
    EXPECT_NEAR(beside[1], 1.0, 1e-9);
}

// STL repeats corners and has the normals of its facets.
TEST_F(FlowObjectFile, StlIsRoundWhereItHasNoCreases)
{
    std::ostringstream stl;
    stl << "solid ball\n";
    const auto point = [&](int ring, int k) {
        const double tilt = std::numbers::pi * ring / 8;
        const double turn = std::numbers::pi * (k % 16) / 8;
        const double radius = ring % 8 == 0 ? 0.0 : std::sin(tilt);
        stl << "vertex " << radius * std::cos(turn) << ' ' << radius * std::sin(turn) << ' ' << std::cos(tilt) << '\n';
    };
    for (int ring = 0; ring < 8; ++ring) {
        for (int k = 0; k < 16; ++k) {
            for (const bool lower : {false, true}) {
                if (ring == (lower ? 7 : 0)) {
                    continue;
                }
                stl << "facet normal 0 0 0\nouter loop\n";
                point(ring, k);
                lower ? point(ring + 1, k) : point(ring + 1, k + 1);
                lower ? point(ring + 1, k + 1) : point(ring, k + 1);
                stl << "endloop\nendfacet\n";
            }
        }
    }
    stl << "endsolid ball\n";
    const FlowObject object = read("ball.stl", stl.str(), {.up = UpAxis::Z});
    for (std::size_t v = 0; v < object.vertices.size(); ++v) {
        EXPECT_GT(dot(object.normals[v], object.vertices[v]), 0.99 * length(object.vertices[v]));
    }
}

TEST_F(FlowObjectFile, HasScaleSizeAndUpAxis)
{
    EXPECT_EQ(read("wall.obj", kObj, {.scale = 3.0}).vertices[2], (Vec3{3.0, 0.0, 6.0}));
    expectNear(read("wall.obj", kObj, {.size = 0.2}).vertices[2], {0.1, 0.0, 0.2}, 1e-15);
    EXPECT_EQ(read("wall.obj", kObj, {.up = UpAxis::Z}).vertices[2], (Vec3{1.0, 2.0, 0.0}));
    const std::string stl =
        "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
        "endfacet\nendsolid a\n";
    EXPECT_EQ(read("a.stl", stl).vertices[2], (Vec3{0.0, 0.0, 1e-3}));
    EXPECT_EQ(read("a.stl", stl, {.up = UpAxis::Z}).vertices[2], (Vec3{0.0, 1e-3, 0.0}));
    const std::string ply =
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
        "property float z\nproperty float s\nproperty float t\nelement face 1\n"
        "property list uchar int vertex_indices\nend_header\n"
        "0 0 0 0 0\n1 0 0 1 0\n1 1 0 1 1\n0 1 0 0 1\n4 0 1 2 3\n";
    const FlowObject quad = read("a.ply", ply);
    EXPECT_EQ(quad.vertices[2], (Vec3{1.0, 1.0, 0.0}));
    EXPECT_EQ(quad.uvs[2], (Vec2{1.0, 0.0}));
    EXPECT_THAT(quad.triangles, ::testing::SizeIs(2));
    EXPECT_EQ(read("a.ply", ply, {.up = UpAxis::Y}).vertices[2], (Vec3{1.0, 0.0, 1.0}));
    EXPECT_THROW((void)read("a.ply", ply, {.scale = 0.0}), Error);
    EXPECT_THROW((void)read("a.ply", ply, {.size = -1.0}), Error);
    EXPECT_THROW((void)read("a.ply", ply, {.scale = 1.0, .size = 1.0}), Error);
}

TEST_F(FlowObjectFile, DividesAConcaveFaceInside)
{
    // An arrow head whose third corner points inwards.
    const FlowObject arrow = read("a.obj", "v 0 0 0\nv 200 0 0\nv 50 50 0\nv 0 200 0\nf 1 2 3 4\nf 2 3 4 1\n");
    double area = 0.0;
    for (const auto& [a, b, c] : arrow.triangles) {
        const Vec3 facet = cross(arrow.vertices[b] - arrow.vertices[a], arrow.vertices[c] - arrow.vertices[a]);
        EXPECT_LT(facet.y, 0.0);
        area += 0.5 * length(facet);
    }
    EXPECT_NEAR(area, 2 * 0.5 * (0.2 * 0.05 + 0.2 * 0.05), 1e-15);
}

TEST_F(FlowObjectFile, RefusesWhatDropletsCannotRunOver)
{
    expectRefused("a.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", "no triangle with an area");
    expectRefused("a.obj", "v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n", "is 0 m long");
    expectRefused("a.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\n", "no triangles");
    expectRefused("a.obj", "v 0 0 0\nv 1e-27 0 0\nv 0 1e-27 0\nf 1 2 3\n", "is 1e-30 m long, must be from 1e-06 m");
    expectRefused("a.obj", "v 0 0 0\nv 1e30 0 0\nv 0 1e30 0\nf 1 2 3\n", "is 1e+27 m long");
    expectRefused("a.obj", "v 1e308 0 0\nv -1e308 0 0\nv 0 1e308 0\nf 1 2 3\n", "long");
    expectRefused("a.obj", "v 1e308 0 0\nv -1.7e308 0 0\nv 0 1e308 0\nf 1 2 3\n", "cannot become 1 m", {.size = 1.0});
    expectRefused("a.obj", "v 0 0 0\nv 0 0 0\nv 0 0 0\nf 1 2 3\n", "is 0 m long, which cannot become 1 m",
                  {.size = 1.0});
    expectRefused("a.obj", "v 1e12 0 0\nv 1.000000000001e12 0 0\nv 1e12 1 0\nf 1 2 3\n", "away from its origin");
    expectRefused("a.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "\"nan\"");
    expectRefused("a.ply",
                  "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
                  "property float z\nend_header\n0 0 0\n",
                  "no triangles");
    EXPECT_EQ(read("a.obj", "v 0 0 0\nv 1e-27 0 0\nv 0 1e-27 0\nf 1 2 3\n", {.size = 1.0}).vertices[1].x, 1.0);
    try {
        (void)readFlowObject("thing.xyz");
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::InvalidArgument);
    }
}

// ------------------------------------------------------------------------------------------------------- glTF

/// A triangle of 1 m: accessors 0 and, with uv, 1.
Draft triangle()
{
    Draft draft;
    draft.addFloats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
    draft.addFloats({0, 0, 1, 0, 0, 0.25F}, "VEC2");
    return draft;
}

TEST_F(FlowObjectFile, GltfHasTheLooksOfItsMaterials)
{
    std::ostringstream png;
    writePng(Picture{1, 1, {0, 0, 255}}, png);
    Draft draft = triangle();
    const std::size_t view = draft.add(png.str(), 5121, "SCALAR", png.str().size());
    writeFile(folder() / "a b.png", png.str());
    const auto with = [&](const std::string& materials, const std::string& images) {
        return read(
            "looks.glb",
            draft.file(R"("scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":)"
                       R"({"POSITION":0},"material":0}]}],"materials":[)" +
                       materials + R"(],"textures":[{"source":0}],"images":[)" + images + "]"));
    };
    const std::string textured = R"({"name":"a","pbrMetallicRoughness":{"baseColorTexture":{"index":0}}})";
    const FlowObject plain =
        with(R"({"name":"a","alphaMode":"BLEND","pbrMetallicRoughness":{"baseColorFactor":[0.1,0.2,0.3,0.4],)"
             R"("metallicFactor":0.5,"roughnessFactor":0.25},"extensions":{"KHR_materials_transmission":)"
             R"({"transmissionFactor":0.75},"KHR_materials_ior":{"ior":1.3}}})",
             "{}");
    ASSERT_THAT(plain.looks, ::testing::SizeIs(1));
    EXPECT_EQ(plain.looks[0].look.colour, (Vec3{0.1, 0.2, 0.3}));
    EXPECT_EQ(plain.looks[0].opacity, 0.4);
    EXPECT_EQ(plain.looks[0].look.metallic, 0.5);
    EXPECT_EQ(plain.looks[0].look.roughness, 0.25);
    EXPECT_EQ(plain.looks[0].look.transmission, 0.75);
    EXPECT_EQ(plain.looks[0].look.ior, 1.3);
    for (const std::string& image : {R"({"mimeType":"image/png","bufferView":)" + std::to_string(view) + "}",
                                     std::string(R"({"uri":"a%20b.png"})")}) {
        const FlowObject object = with(textured, image);
        ASSERT_TRUE(object.looks.at(0).colours) << image;
        EXPECT_EQ(object.looks[0].colours->rgb, (std::vector<std::uint8_t>{0, 0, 255}));
        EXPECT_EQ(object.images[0].colours, png.str());
        EXPECT_THAT(object.warnings, IsEmpty());
    }
    for (const char* const image : {R"({"uri":"/etc/passwd"})", R"({"uri":"../x.png"})", R"({"bufferView":99})",
                                    R"({"uri":"data:image/png;base64,AAAA"})", R"({"uri":"looks.glb"})"}) {
        const FlowObject object = with(textured, image);
        EXPECT_FALSE(object.looks.at(0).colours) << image;
        EXPECT_THAT(object.warnings, ElementsAre(HasSubstr("without a texture: "))) << image;
    }
    EXPECT_THAT(with(R"({"name":"a","pbrMetallicRoughness":7})", "{}").looks, ::testing::SizeIs(1));
    const std::string image = R"({"uri":"a%20b.png"})";
    const FlowObject full = with(
        R"({"name":"a","normalTexture":{"index":0,"scale":0.5},"pbrMetallicRoughness":{"metallicRoughnessTexture":)"
        R"({"index":0}},"extensions":{"KHR_materials_volume":{"thicknessFactor":0.01,"attenuationDistance":0.02,)"
        R"("attenuationColor":[0.5,0.6,0.7]}}})",
        image);
    ASSERT_THAT(full.looks, ::testing::SizeIs(1));
    EXPECT_TRUE(full.looks[0].normals);
    EXPECT_EQ(full.looks[0].relief, 0.5);
    EXPECT_TRUE(full.looks[0].finish);
    EXPECT_EQ(full.images[0].normals, png.str());
    EXPECT_EQ(full.images[0].finish, png.str());
    EXPECT_EQ(full.looks[0].thickness, 0.01);
    ASSERT_TRUE(full.looks[0].absorption);
    EXPECT_EQ(full.looks[0].absorption->distance, 0.02);
    EXPECT_EQ(full.looks[0].absorption->colour, (Vec3{0.5, 0.6, 0.7}));
    const FlowObject moved = with(
        R"({"name":"a","pbrMetallicRoughness":{"baseColorTexture":{"index":0,"extensions":{"KHR_texture_transform":)"
        R"({"scale":[2,3],"offset":[0.25,0.5],"rotation":1.5707963267948966}}}}})",
        image);
    // Khronos' example: offset + rotation · scale · uv, counter-clockwise as seen with v down.
    const Vec2 at = moved.looks.at(0).place.at({0.5, 0.25});
    EXPECT_NEAR(at.x, 0.25 + 0.75, 1e-12);
    EXPECT_NEAR(at.y, 0.5 - 1.0, 1e-12);
    const FlowObject leaf = with(
        R"({"name":"a","alphaMode":"MASK","alphaCutoff":0.25,"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}})",
        image);
    EXPECT_EQ(leaf.images.at(0).cutoff, 0.25);
    EXPECT_FALSE(leaf.looks.at(0).coverage) << "the picture is opaque";
    EXPECT_THAT(leaf.warnings, IsEmpty());
    EXPECT_THAT(
        with(R"({"name":"a","pbrMetallicRoughness":{"baseColorTexture":{"index":0,"texCoord":1}}})", image).warnings,
        ElementsAre(HasSubstr("a b.png is shown over TEXCOORD_0")));
}

TEST_F(FlowObjectFile, GltfHasLightAlphaAndColours)
{
    std::ostringstream png;
    writePng(Layer{2, 1, {255, 0, 0, 255, 0, 255, 0, 51}}, png);
    writeFile(folder() / "holes.png", png.str());
    Draft draft = triangle();
    const std::size_t floats = draft.addFloats({0.5F, 0.25F, 0.0F, 1.0F, 1.0F, 1.0F, 0.0F, 2.0F, 1.0F}, "VEC3");
    const std::size_t bytes = draft.add(std::string("\xff\x00\x33\x80\xff\xff\xff\xff\x00\x00\x00\xff", 12), 5121,
                                        "VEC4", 3, R"(,"normalized":true)");
    const auto with = [&](const std::string& material, const std::string& attributes,
                          const ObjectOptions& options = {}) {
        const std::string list = material.empty() ? "" : R"("materials":[)" + material + R"(],)";
        return read(
            "looks.glb",
            draft.file(R"("scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":)"
                       R"({"POSITION":0)" +
                       attributes + "}" + (material.empty() ? "" : R"(,"material":0)") + "}]}]," + list +
                       R"("textures":[{"source":0}],"images":[{"uri":"holes.png"}])"),
            options);
    };
    const FlowObject lamp = with(R"({"emissiveFactor":[1,0.5,0],"emissiveTexture":{"index":0},"extensions":)"
                                 R"({"KHR_materials_emissive_strength":{"emissiveStrength":4}}})",
                                 "");
    ASSERT_EQ(lamp.looks.size(), 1U);
    EXPECT_EQ(lamp.looks[0].glow, (Vec3{4.0, 2.0, 0.0}));
    ASSERT_TRUE(lamp.looks[0].glows);
    EXPECT_EQ(lamp.looks[0].glows->rgb, (std::vector<std::uint8_t>{255, 0, 0, 0, 255, 0}));
    EXPECT_EQ(lamp.images[0].glows, png.str());
    EXPECT_EQ(with(R"({"emissiveFactor":[1,0.5,0]})", "").looks.at(0).glow, (Vec3{1.0, 0.5, 0.0}));
    EXPECT_EQ(with(R"({"emissiveFactor":[1]})", "").looks.at(0).glow, Vec3{});
    EXPECT_EQ(with(R"({"emissiveFactor":[1,1,1],"extensions":{"KHR_materials_emissive_strength":)"
                   R"({"emissiveStrength":0}}})",
                   "")
                  .looks.at(0)
                  .glow,
              Vec3{});

    const std::string base = R"("pbrMetallicRoughness":{"baseColorTexture":{"index":0}}})";
    const FlowObject opaque = with("{" + base, "");
    EXPECT_FALSE(opaque.looks.at(0).coverage);
    EXPECT_EQ(opaque.looks[0].colours->rgb, (std::vector<std::uint8_t>{255, 0, 0, 0, 255, 0}))
        << "not mixed with white";
    for (const char* const mode : {"BLEND", "MASK"}) {
        const FlowObject leaf = with(R"({"alphaMode":")" + std::string(mode) + "\"," + base, "");
        ASSERT_TRUE(leaf.looks.at(0).coverage) << mode;
        EXPECT_EQ(leaf.looks[0].coverage->rgb, (std::vector<std::uint8_t>{255, 255, 255, 51, 51, 51}));
        EXPECT_EQ(leaf.looks[0].cutoff.has_value(), mode == std::string("MASK"));
        EXPECT_THAT(leaf.warnings, IsEmpty());
    }

    const std::string colour = R"(,"COLOR_0":)";
    const FlowObject linear = with("{}", colour + std::to_string(floats));
    EXPECT_THAT(linear.colours, ElementsAre(Vec3{0.5, 0.25, 0.0}, Vec3{1.0, 1.0, 1.0}, Vec3{0.0, 1.0, 1.0}));
    const FlowObject coded = with("", colour + std::to_string(bytes));
    EXPECT_THAT(coded.colours, ElementsAre(Vec3{1.0, 0.0, 0.2}, Vec3{1.0, 1.0, 1.0}, Vec3{}));
    ASSERT_EQ(coded.looks.size(), 1U) << "colours are seen without a material, too";
    EXPECT_EQ(coded.looks[0].look.colour, (Vec3{1.0, 1.0, 1.0}));
    EXPECT_THAT(coded.materials, ElementsAre(0));
    const FlowObject weighted = with("{}", colour + std::to_string(floats), {.weights = true});
    EXPECT_THAT(weighted.colours, IsEmpty()) << "they are weights";
    EXPECT_THAT(weighted.weights, ElementsAre(0.5, 1.0, 0.0));
    EXPECT_THAT(with("{}", "").colours, IsEmpty());
}

TEST_F(FlowObjectFile, ObjAndPlyHaveColoursOfVertices)
{
    // sRGB's level 188 is half the light.
    const std::string faces = "f 1 2 3\nf 1 3 4\n";
    const FlowObject obj = read("a.obj", "v 0 0 0 1 0 0\nv 1 0 0\nv 1 1 0 0.7353570 0.5 2\nv 0 1 0 0.5\n" + faces);
    ASSERT_EQ(obj.colours.size(), 4U);
    expectNear(obj.colours[0], {1.0, 0.0, 0.0});
    expectNear(obj.colours[1], {1.0, 1.0, 1.0});
    expectNear(obj.colours[2], {0.5, 0.2140411, 1.0}, 1e-5);
    expectNear(obj.colours[3], {1.0, 1.0, 1.0});
    ASSERT_EQ(obj.looks.size(), 1U);
    EXPECT_THAT(read("a.obj", "v 0 0 0 1\nv 1 0 0 1\nv 1 1 0 1\nv 0 1 0 1\n" + faces).colours, IsEmpty()) << "weights";
    const auto ply = [&](const std::string& type, const std::string& levels, const ObjectOptions& options) {
        return read("a.ply",
                    "ply\nformat ascii 1.0\nelement vertex 3\nproperty uchar x\nproperty uchar y\nproperty uchar z\n"
                    "property " +
                        type + " red\nproperty " + type + " green\nproperty " + type +
                        " blue\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0 " + levels +
                        "\n1 0 0 " + levels + "\n0 1 0 " + levels + "\n3 0 1 2\n",
                    options);
    };
    for (const FlowObject& object : {ply("uchar", "255 188 0", {}), ply("float", "1 0.7353570 0", {})}) {
        ASSERT_EQ(object.colours.size(), 3U);
        expectNear(object.colours[2], {1.0, 0.5, 0.0}, 5e-3);
        EXPECT_EQ(object.vertices[1], (Vec3{1.0, 0.0, 0.0})) << "places in bytes are not levels";
    }
    EXPECT_THAT(ply("uchar", "255 188 0", {.weights = true}).colours, IsEmpty());
    EXPECT_THAT(ply("uchar", "255 188 0", {.weights = true}).weights, ElementsAre(1.0, 1.0, 1.0));
}

TEST_F(FlowObjectFile, ObjHasOpacityMapsAndLight)
{
    writeFile(folder() / "colours.png", pngOf({10, 20, 30}));
    std::ostringstream holes;
    writePng(Picture{2, 2, {255, 255, 255, 0, 0, 0, 30, 60, 90, 255, 255, 255}}, holes);
    writeFile(folder() / "holes.png", holes.str());
    std::ostringstream alpha;
    writePng(Layer{1, 1, {255, 255, 255, 77}}, alpha);
    writeFile(folder() / "alpha.png", alpha.str());
    writeFile(folder() / "ignored.mtl",
              "newmtl rough\nmap_Kd colours.png\nmap_d holes.png\nmap_Ke alpha.png\n"
              "newmtl Wet Glass\nmap_D alpha.png\nKe 2 1 0\nmap_Ke colours.png\n");
    const FlowObject object = read("wall.obj", kObj);
    EXPECT_THAT(object.warnings, IsEmpty());
    ASSERT_EQ(object.looks.size(), 2U);
    const StandLook& rough = object.looks[1];
    ASSERT_TRUE(rough.coverage);
    EXPECT_EQ(rough.coverage->rgb, (std::vector<std::uint8_t>{255, 255, 255, 0, 0, 0, 60, 60, 60, 255, 255, 255}));
    EXPECT_FALSE(rough.cutoff);
    EXPECT_EQ(rough.glow, (Vec3{1.0, 1.0, 1.0})) << "a map alone";
    // Files of glTF have one picture of both, as large as the larger.
    EXPECT_TRUE(object.images[1].blends);
    const Layer both = decodeLayer(std::as_bytes(std::span(object.images[1].colours)));
    EXPECT_EQ(both.width, 2);
    EXPECT_EQ(both.rgba, (std::vector<std::uint8_t>{10, 20, 30, 255, 10, 20, 30, 0, 10, 20, 30, 60, 10, 20, 30, 255}));
    const StandLook& glass = object.looks[0];
    ASSERT_TRUE(glass.coverage) << "its own alpha";
    EXPECT_EQ(glass.coverage->rgb, (std::vector<std::uint8_t>{77, 77, 77}));
    EXPECT_EQ(glass.glow, (Vec3{2.0, 1.0, 0.0}));
    ASSERT_TRUE(glass.glows);
    EXPECT_EQ(glass.glows->rgb, (std::vector<std::uint8_t>{10, 20, 30}));
    writeFile(folder() / "ignored.mtl", "newmtl rough\nmap_d -s 2 2 1 holes.png\nmap_Kd colours.png\nmap_d none.png\n");
    EXPECT_FALSE(read("wall.obj", kObj).looks[1].coverage);
}

TEST_F(FlowObjectFile, GltfHasWeights)
{
    const auto with = [&](const std::string& name, const std::vector<float>& values, const std::string& kind) {
        Draft draft = triangle();
        const std::size_t weights = draft.addFloats(values, kind);
        return read(
            "weights.glb",
            draft.file(R"("scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":)"
                       R"({"POSITION":0,")" +
                       name + "\":" + std::to_string(weights) + "}}]}]"),
            {.weights = true});
    };
    EXPECT_THAT(with("_WEIGHT", {0.0F, 0.5F, 2.0F}, "SCALAR").weights, ElementsAre(0.0, 0.5, 1.0));
    EXPECT_THAT(with("COLOR_0", {1.0F, 0.0F, 0.0F, 0.25F, 1.0F, 1.0F, 0.0F, 1.0F, 1.0F}, "VEC3").weights,
                ElementsAre(1.0, 0.25, 0.0));
    EXPECT_THAT(with("_OTHER", {0.0F, 0.5F, 1.0F}, "SCALAR").weights, IsEmpty());
}

std::string animationOf(const std::string& channels, const std::string& samplers)
{
    return R"("animations":[{"channels":[)" + channels + R"(],"samplers":[)" + samplers + "]}]";
}

std::string channelOf(int sampler, int node, const std::string& path)
{
    return R"({"sampler":)" + std::to_string(sampler) + R"(,"target":{"node":)" + std::to_string(node) +
           R"(,"path":")" + path + "\"}}";
}

std::string samplerOf(std::size_t times, std::size_t values, const std::string& interpolation = "LINEAR")
{
    return R"({"input":)" + std::to_string(times) + R"(,"output":)" + std::to_string(values) + R"(,"interpolation":")" +
           interpolation + "\"}";
}

const std::string kMesh = R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"scenes":[{"nodes":[0]}],)";

TEST_F(FlowObjectFile, GltfHasUvAndMaterialsOfItsPrimitives)
{
    const FlowObject object =
        read("a.glb", triangle().file(R"("materials":[{"name":"glass"},{}],"meshes":[{"primitives":[)"
                                      R"({"attributes":{"POSITION":0,"TEXCOORD_0":1},"material":1},)"
                                      R"({"attributes":{"POSITION":0},"material":0},{"attributes":{"POSITION":0}}]}],)"
                                      R"("nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}])"));
    EXPECT_THAT(object.material_names, ElementsAre("glass", "", ""));
    EXPECT_THAT(object.materials, ElementsAre(1, 0, 2));
    EXPECT_EQ(object.uvs[2], (Vec2{0.0, 0.25}));
    EXPECT_EQ(object.vertices[2], (Vec3{0.0, 0.0, 1.0}));
    EXPECT_THAT(object.warnings, ElementsAre(HasSubstr("without uv")));
    EXPECT_TRUE(object.motion.rests());
}

TEST_F(FlowObjectFile, GltfAnimationOfTheNodeBecomesMotion)
{
    // The node stands at (2, 0, 0) and turns about its own y axis, z in the library, by a quarter each second. Its
    // parent enlarges twofold and turns by half about x.
    Draft draft = triangle();
    const auto root = static_cast<float>(std::numbers::sqrt2 / 2.0);
    const std::size_t times = draft.addFloats({0, 1, 2}, "SCALAR");
    const std::size_t turns = draft.addFloats({0, 0, 0, 1, 0, root, 0, root, 0, 1, 0, 0}, "VEC4");
    const FlowObject object = read(
        "a.glb", draft.file(kMesh +
                            R"("nodes":[{"children":[1],"scale":[2,2,2],"rotation":[1,0,0,0],"translation":[0,0,10]},)"
                            R"({"mesh":0,"translation":[2,0,0]}],)" +
                            animationOf(channelOf(0, 1, "rotation"), samplerOf(times, turns))));
    EXPECT_THAT(object.warnings, IsEmpty());
    EXPECT_FALSE(object.motion.rests());
    // At rest the file's (2, 0, 0) is at (4, 0, 10), and (3, 0, 0) at (6, 0, 10).
    expectNear(object.vertices[1], {6.0, -10.0, 0.0});
    expectNear(object.motion.pivot, {4.0, -10.0, 0.0});
    for (const double time : {-1.0, 0.0, 0.5, 1.25, 2.0, 7.0}) {
        const double angle = 0.5 * std::numbers::pi * std::clamp(time, 0.0, 2.0);
        // About −y of the file, since the parent turns the axis over.
        expectNear(worldOf(object.motion, time, object.vertices[1]),
                   {4.0 + 2.0 * std::cos(angle), -10.0 - 2.0 * std::sin(angle), 0.0});
        expectNear(worldOf(object.motion, time, object.vertices[0]), object.vertices[0]);
    }
    // A scale moves keys and object alike.
    const FlowObject small = readFlowObject(folder() / "a.glb", {.scale = 0.1});
    expectNear(worldOf(small.motion, 1.25, small.vertices[1]), 0.1 * worldOf(object.motion, 1.25, object.vertices[1]));
}

TEST_F(FlowObjectFile, GltfStepsJumpAndCurvesAreSampled)
{
    Draft draft = triangle();
    const std::size_t times = draft.addFloats({1, 2, 3}, "SCALAR");
    const std::size_t places = draft.addFloats({0, 0, 0, 0, 5, 0, 0, 7, 0}, "VEC3");
    const std::string nodes = R"("nodes":[{"mesh":0}],)";
    const FlowObject step =
        read("a.glb",
             draft.file(kMesh + nodes + animationOf(channelOf(0, 0, "translation"), samplerOf(times, places, "STEP"))));
    expectNear(step.motion.at(1.999).place, {});
    expectNear(step.motion.at(2.0).place, {0.0, 0.0, 5.0});
    expectNear(step.motion.at(2.999).place, {0.0, 0.0, 5.0});
    expectNear(step.motion.at(3.0).place, {0.0, 0.0, 7.0});
    // Tangents of 0: the curve is 3 t² − 2 t³.
    const std::size_t two = draft.addFloats({0, 2}, "SCALAR");
    const std::size_t curve = draft.addFloats({0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0}, "VEC3");
    const FlowObject smooth = read(
        "a.glb",
        draft.file(kMesh + nodes + animationOf(channelOf(0, 0, "translation"), samplerOf(two, curve, "CUBICSPLINE"))));
    for (const double time : {0.0, 0.3, 1.0, 1.5, 2.0}) {
        const double t = 0.5 * time;
        EXPECT_NEAR(smooth.motion.at(time).place.x, t * t * (3.0 - 2.0 * t), 3e-3) << time;
    }
    EXPECT_NEAR(smooth.motion.at(0.5).place.x, 0.15625, 1e-7);
}

TEST_F(FlowObjectFile, GltfMotionOfAPartIsIgnoredWithAWarning)
{
    Draft draft = triangle();
    const std::size_t times = draft.addFloats({0, 1}, "SCALAR");
    const std::size_t places = draft.addFloats({0, 0, 0, 0, 5, 0}, "VEC3");
    const std::size_t bad_times = draft.addFloats({1, 1}, "SCALAR");
    const std::size_t turns = draft.addFloats({0, 0, 0, 1, 0, 1, 0, 0}, "VEC4");
    const std::string move = samplerOf(times, places);
    const auto ignored = [&](const std::string& nodes, const std::string& channels, const std::string& samplers) {
        return read("a.glb", draft.file(kMesh + R"("nodes":[)" + nodes + "]," + animationOf(channels, samplers)));
    };
    const std::string two = R"({"children":[1,2]},{"mesh":0},{"mesh":0})";
    for (const FlowObject& object :
         {ignored(two, channelOf(0, 1, "translation"), move), ignored(two, channelOf(0, 7, "translation"), move),
          ignored(two, channelOf(0, 0, "scale"), move),
          ignored(two, R"({"sampler":0,"target":{"path":"pointer"}})", move),
          ignored(R"({"mesh":0,"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]})", channelOf(0, 0, "translation"), move),
          ignored(R"({"children":[1],"scale":[1,2,1]},{"mesh":0})", channelOf(0, 1, "rotation"),
                  samplerOf(times, turns))}) {
        EXPECT_TRUE(object.motion.rests());
        EXPECT_THAT(object.warnings, ElementsAre(HasSubstr("animation")));
    }
    // The parent moves all; the part in it is ignored.
    const FlowObject whole = ignored(two, channelOf(0, 0, "translation") + "," + channelOf(0, 1, "translation"), move);
    expectNear(whole.motion.at(0.5).place, {0.0, 0.0, 2.5});
    EXPECT_THAT(whole.warnings, ElementsAre(HasSubstr("animation")));
    const std::string one = R"("nodes":[{"mesh":0}],)";
    expectRefused("a.glb",
                  draft.file(kMesh + one + animationOf(channelOf(0, 0, "translation"), samplerOf(bad_times, places))),
                  "do not ascend");
    expectRefused("a.glb",
                  draft.file(kMesh + one + animationOf(channelOf(0, 0, "translation"), samplerOf(times, turns))),
                  "should hold VEC3");
    expectRefused("a.glb", draft.file(kMesh + one + animationOf(channelOf(0, 0, "translation"), samplerOf(99, places))),
                  "accessors[99]");
}

TEST(FlowObject, DeformsByFilesWithTheSameTriangles)
{
    const testing::ScratchDirectory scratch;
    const auto file = [&](const std::string& name, const std::string& text) {
        const std::string path = (scratch.path() / name).string();
        writeFile(path, text);
        return path;
    };
    const std::string faces = "f 1//1 2//1 3//1 4//1\nf 3//1 2//1 5//1\n";
    const std::string first = file("1.obj", "v 0 0 0\nv 10 0 0\nv 10 10 0\nv 0 10 0\nv 20 5 0\nvn 0 0 1\n" + faces);
    // The quad has a corner that points inward, by which alone it would be divided otherwise; normals are others.
    const std::string second = file("2.obj",
                                    "v 0 0 0\nv 2 9 0\nv 10 10 0\nv 0 10 0\nv 20 5 4\nvn 0 0 1\nvn 1 0 0\n"
                                    "f 1//1 2//2 3//1 4//1\nf 3//2 2//1 5//1\n");
    const DeformingObject read = readDeformingObject({first, second}, {.size = 0.2});
    ASSERT_EQ(read.vertices.size(), 2U);
    EXPECT_EQ(read.vertices[0], read.object.vertices);
    ASSERT_EQ(read.vertices[1].size(), read.object.vertices.size());
    for (std::size_t v = 0; v < read.object.vertices.size(); ++v) {
        const Vec3 was = read.vertices[0][v];
        const Vec3 is = was.x > 0.15                   ? Vec3{0.2, -0.04, 0.05}
                        : was.x > 0.05 && was.z < 0.05 ? Vec3{0.02, 0.0, 0.09}
                                                       : was;
        expectNear(read.vertices[1][v], is, 1e-12);
    }
    const auto message_of = [&](const std::string& other) {
        try {
            readDeformingObject({first, file("3.obj", other)});
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_THAT(message_of("v 0 0 0\nv 10 0 0\nv 10 10 0\nf 1 2 3\n"),
                AllOf(HasSubstr("3.obj has 1 triangles, but"), HasSubstr("1.obj has 3;")));
    EXPECT_THAT(message_of("v 0 0 0\nv 10 0 0\nv 10 10 0\nv 0 10 0\nv 20 5 0\nf 1 2 3 4\nf 2 3 5\n"),
                AllOf(HasSubstr("3.obj has other triangles than"), HasSubstr("of 3")));
}

TEST(FlowObject, NormalsTurnWithTheTriangles)
{
    FlowObject object;
    object.vertices = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}};
    object.triangles = {{0, 1, 2}};
    const double half = std::sqrt(0.5);
    object.normals = {{0.0, 0.0, 1.0}, {half, 0.0, half}, {0.0, 0.0, 1.0}};
    const FlowObject same = inShape(object, object.vertices);
    EXPECT_EQ(same.normals, object.normals);
    // A quarter turn about x, and twice the size.
    const FlowObject turned = inShape(object, {{1.0, 0.0, 0.0}, {3.0, 0.0, 0.0}, {1.0, 0.0, 2.0}});
    expectNear(turned.normals[0], {0.0, -1.0, 0.0}, 1e-12);
    expectNear(turned.normals[1], {half, -half, 0.0}, 1e-12);
}

}  // namespace
}  // namespace droplet
