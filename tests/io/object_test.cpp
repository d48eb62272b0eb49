// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/io/object.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <numbers>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "droplet/error.h"
#include "droplet/io/gltf.h"
#include "droplet/surface/onto.h"
#include "support/command.h"
#include "support/gltf_draft.h"
#include "support/paths.h"
#include "support/surfaces.h"

namespace droplet {
namespace {

using testing::Draft;
using testing::floats;
using testing::glb;
using ::testing::HasSubstr;
using testing::littleEndian;
using testing::writeFile;

/// Two triangles in glTF's plane y = 0, with normals and uv: accessors 0, 1, 2.
Draft square()
{
    Draft draft;
    draft.addFloats({0, 0, 0, 1, 0, 0, 1, 0, 2, 0, 0, 2}, "VEC3");
    draft.addFloats({0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0}, "VEC3");
    draft.addFloats({0, 0, 0.5F, 0, 0.5F, 1, 0, 1}, "VEC2");
    return draft;
}

const std::string kSquare = R"("attributes":{"POSITION":0,"NORMAL":1,"TEXCOORD_0":2})";

std::string scene(const std::string& primitive, const std::string& node = "")
{
    return R"("meshes":[{"name":"lid","primitives":[{)" + primitive + R"(}]}],"nodes":[{"mesh":0)" + node +
           R"(}],"scenes":[{"nodes":[0]}])";
}

class Object : public ::testing::Test {
protected:
    [[nodiscard]] TexturedMesh read(const std::string& bytes) const
    {
        writeFile(path(), bytes);
        TexturedMesh mesh = readObject(path());
        EXPECT_NO_THROW(mesh.validate());
        return mesh;
    }

    void expectRefused(const std::string& bytes, const std::string& words) const
    {
        writeFile(path(), bytes);
        expectFileRefused(path(), words);
    }

    static void expectFileRefused(const std::filesystem::path& file, const std::string& words)
    {
        try {
            (void)readObject(file);
            ADD_FAILURE() << "read; should say: " << words;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::InvalidInput);
            EXPECT_THAT(error.what(), HasSubstr(words));
            EXPECT_THAT(error.what(), HasSubstr(file.string()));
            EXPECT_THAT(error.what(), ::testing::Not(HasSubstr("\n")));
        }
    }

    [[nodiscard]] std::filesystem::path path(const std::string& name = "object.glb") const
    {
        return scratch_.path() / name;
    }

private:
    testing::ScratchDirectory scratch_;
};

const std::string kIndices = R"(,"indices":3)";
const std::vector<Triangle> kTwo = {{0, 3, 2}, {0, 2, 1}};

Draft indexedSquare()
{
    Draft draft = square();
    draft.add(littleEndian(0x00020300, 4) + littleEndian(0x0102, 2), 5121, "SCALAR", 6);
    return draft;
}

// A square of one polygon, 2 mm by 4 mm in the plane y = 0, and a material that has no file.
constexpr const char* kObjSquare = R"(mtllib nowhere.mtl
v 0 0 0
v 2 0 0
v 2 0 4
v 0 0 4
vt 0 1
vt 0.5 1
vt 0.5 0
vt 0 0
usemtl paint
f 1/1 4/4 3/3 2/2
)";

TEST_F(Object, IsReadFromObjAndPly)
{
    writeFile(path("a.obj"), kObjSquare);
    const TexturedMesh mesh = readObject(path("a.obj"));
    EXPECT_NO_THROW(mesh.validate());
    EXPECT_EQ(mesh.vertices, (std::vector<Vec3>{{0, 0, 0}, {0, -4e-3, 0}, {2e-3, -4e-3, 0}, {2e-3, 0, 0}}));
    EXPECT_EQ(mesh.normals, (std::vector<Vec3>(4, {0, 0, 1})));
    EXPECT_EQ(mesh.uvs, (std::vector<Vec2>{{0, 0}, {0, 1}, {0.5, 1}, {0.5, 0}}));
    EXPECT_EQ(mesh.triangles.size(), 2U);
    EXPECT_EQ(readObject(path("a.obj"), {.scale = 1000.0}).vertices[2], (Vec3{2, -4, 0}));
    EXPECT_EQ(readObject(path("a.obj"), {.size = 1.0}).vertices[2], (Vec3{0.5, -1, 0}));
    EXPECT_EQ(readObject(path("a.obj"), {.up = UpAxis::Z}).vertices[2], (Vec3{2e-3, 0, 4e-3}));
    EXPECT_THROW((void)readObject(path("a.obj"), {.scale = -1.0}), Error);

    writeFile(path("a.ply"),
              "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
              "property float s\nproperty float t\nelement face 1\nproperty list uchar int vertex_indices\n"
              "end_header\n0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2\n");
    const TexturedMesh triangle = readObject(path("a.ply"));
    EXPECT_EQ(triangle.vertices, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
    EXPECT_EQ(triangle.uvs, (std::vector<Vec2>{{0, 1}, {1, 1}, {0, 0}}));
}

TEST_F(Object, WithoutUvIsRefusedInAllFormats)
{
    writeFile(path("a.obj"), "v 0 0 0\nv 1 0 0\nv 0 0 1\nvt 0 0\nf 1/1 3/1 2\n");
    expectFileRefused(path("a.obj"), "line 5 has a face without texture coordinates (uv)");
    writeFile(path("a.ply"),
              "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
              "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    expectFileRefused(path("a.ply"), "it is without texture coordinates (uv)");
    writeFile(path("a.obj"), "v 0 0 z\n");
    expectFileRefused(path("a.obj"), "line 1 has \"z\"");
}

TEST_F(Object, IsTurnedToZUp)
{
    const TexturedMesh mesh = read(indexedSquare().file(scene(kSquare + kIndices)));
    EXPECT_EQ(mesh.vertices, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, -2, 0}, {0, -2, 0}}));
    EXPECT_EQ(mesh.normals, (std::vector<Vec3>(4, {0, 0, 1})));
    EXPECT_EQ(mesh.uvs, (std::vector<Vec2>{{0, 0}, {0.5, 0}, {0.5, 1}, {0, 1}}));
    EXPECT_EQ(mesh.triangles, kTwo);
}

TEST_F(Object, ReadsBackWhatTheWriterWrites)
{
    const Surface surface = testing::roundDroplet({.inner = 1e-3, .centre = {2e-3, -3e-3}});
    for (const bool binary : {true, false}) {
        std::ostringstream out;
        (void)writeGltf(surface, out, {.binary = binary});
        const TexturedMesh mesh = read(out.str());
        ASSERT_EQ(mesh.vertices.size(), surface.vertices.size());
        for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
            EXPECT_LT(length(mesh.vertices[v] - surface.vertices[v]), 1e-9);
            EXPECT_LT(length(mesh.normals[v] - surface.normals[v]), 1e-6);
            EXPECT_LT(length(mesh.uvs[v] - surface.uvs[v]), 1e-6);
        }
        EXPECT_EQ(mesh.triangles, surface.triangles);
    }
}

/// Avatars are .vrm files, which are .glb files.
TEST_F(Object, OfAnotherExtensionIsAGlbIfItBeginsAsOne)
{
    const Surface surface = testing::roundDroplet({.inner = 1e-3, .centre = {2e-3, -3e-3}});
    std::ostringstream out;
    (void)writeGltf(surface, out);
    const auto named = [&](const char* extension) {
        return std::filesystem::path(path()).replace_extension(extension);
    };
    writeFile(named(".vrm"), out.str());
    EXPECT_EQ(readObject(named(".vrm")).triangles, surface.triangles);
    writeFile(named(".txt"), "glTF is a format");
    EXPECT_THROW((void)readObject(named(".txt")), Error);
    writeFile(named(".txt"), "gl");
    EXPECT_THROW((void)readObject(named(".txt")), Error);
    // Nobody writes to it: who opens it waits for ever.
    const std::filesystem::path pipe = named(".pipe");
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    EXPECT_THROW((void)readObject(pipe), Error);
    std::filesystem::remove(pipe);
}

TEST_F(Object, IndicesHaveAnyWidthOrAreLeftOut)
{
    const std::vector<std::uint32_t> corners = {0, 3, 2, 0, 2, 1};
    for (const auto& [component, bytes] : {std::pair{5121, 1}, {5123, 2}, {5125, 4}}) {
        Draft draft = square();
        std::string indices;
        for (const std::uint32_t corner : corners) {
            indices += littleEndian(corner, static_cast<std::size_t>(bytes));
        }
        draft.add(indices, component, "SCALAR", 6);
        EXPECT_EQ(read(draft.file(scene(kSquare + kIndices))).triangles, kTwo);
    }
    EXPECT_EQ(read(square().file(scene(kSquare))).triangles, (std::vector<Triangle>{{0, 1, 2}}));
}

// Section 3.7.2.1 of the specification.
TEST_F(Object, StripsAndFansAreTriangles)
{
    EXPECT_EQ(read(square().file(scene(kSquare + R"(,"mode":5)"))).triangles,
              (std::vector<Triangle>{{0, 1, 2}, {1, 3, 2}}));
    EXPECT_EQ(read(square().file(scene(kSquare + R"(,"mode":6)"))).triangles,
              (std::vector<Triangle>{{1, 2, 0}, {2, 3, 0}}));
    expectRefused(square().file(scene(kSquare + R"(,"mode":1)")), "no triangles");
}

TEST_F(Object, UvMayBeNormalisedIntegers)
{
    for (const auto& [component, bytes, largest] : {std::tuple{5121, 1, 255U}, {5123, 2, 65535U}}) {
        Draft draft = square();
        std::string uv;
        for (const std::uint32_t value : {0U, 0U, largest, 0U, largest, largest / 5, 0U, largest}) {
            uv += littleEndian(value, static_cast<std::size_t>(bytes));
        }
        draft.add(uv, component, "VEC2", 4, R"(,"normalized":true)");
        const TexturedMesh mesh = read(draft.file(scene(R"("attributes":{"POSITION":0,"NORMAL":1,"TEXCOORD_0":3})")));
        EXPECT_EQ(mesh.uvs, (std::vector<Vec2>{{0, 0}, {1, 0}, {1, 0.2}, {0, 1}}));
    }
}

TEST_F(Object, InterleavedAttributesAreRead)
{
    const std::string buffer = floats({0, 0, 0, 7, 8, 1, 0, 0, 9, 10, 1, 0, 2, 11, 12});
    const std::string json =
        R"({"meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1}}]}],"nodes":[{"mesh":0}],)"
        R"("accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":3},)"
        R"({"bufferView":0,"byteOffset":12,"componentType":5126,"type":"VEC2","count":3}],)"
        R"("bufferViews":[{"buffer":0,"byteLength":60,"byteStride":20}],"buffers":[{"byteLength":60}]})";
    const TexturedMesh mesh = read(glb(json, buffer));
    EXPECT_EQ(mesh.vertices, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, -2, 0}}));
    EXPECT_EQ(mesh.uvs, (std::vector<Vec2>{{7, 8}, {9, 10}, {11, 12}}));
}

TEST_F(Object, BuffersMayLieBesideTheFile)
{
    const Draft draft = indexedSquare();
    writeFile(path("its data.bin"), draft.buffer());
    writeFile(path("object.gltf"), draft.json(scene(kSquare + kIndices), "its%20data.bin"));
    EXPECT_EQ(readObject(path("object.gltf")).triangles, kTwo);

    std::filesystem::remove(path("its data.bin"));
    expectFileRefused(path("object.gltf"), "its%20data.bin: No such file");
    writeFile(path("its data.bin"), draft.buffer().substr(1));
    expectFileRefused(path("object.gltf"), "bytes of");
    for (const char* const elsewhere : {"/etc/passwd", "https://example.org/a.bin"}) {
        writeFile(path("object.gltf"), draft.json(scene(kSquare + kIndices), elsewhere));
        expectFileRefused(path("object.gltf"), "must be a file beside");
    }
    writeFile(path("object.gltf"), draft.json(scene(kSquare + kIndices), "data:text/plain,abc"));
    expectFileRefused(path("object.gltf"), "base64");
    writeFile(path("object.gltf"), draft.json(scene(kSquare + kIndices), "data:;base64,!!!!"));
    expectFileRefused(path("object.gltf"), "base64");
}

// A node with translation, rotation and scale, inside one with a matrix, equals moving every vertex by hand.
TEST_F(Object, NodesMoveTheirMeshes)
{
    const std::string half = std::to_string(std::sqrt(0.5));
    const std::string nodes =
        R"("meshes":[{"primitives":[{)" + kSquare + kIndices +
        R"(}]}],"nodes":[)"
        R"({"mesh":0,"translation":[1,2,3],"rotation":[)" +
        half + ",0,0," + half +
        R"(],"scale":[2,3,5]},)"
        R"({"children":[0],"matrix":[0,1,0,0, -1,0,0,0, 0,0,1,0, 10,20,30,1]}],"scenes":[{"nodes":[]},{"nodes":[1]}],"scene":1)";
    const TexturedMesh mesh = read(indexedSquare().file(nodes));
    const std::vector<Vec3> flat = {{0, 0, 0}, {1, 0, 0}, {1, 0, 2}, {0, 0, 2}};
    for (std::size_t v = 0; v < 4; ++v) {
        const Vec3 scaled{2 * flat[v].x, 3 * flat[v].y, 5 * flat[v].z};
        const Vec3 rolled{scaled.x, -scaled.z, scaled.y};  // 90° about x
        const Vec3 moved = rolled + Vec3{1, 2, 3};
        const Vec3 outer = Vec3{-moved.y, moved.x, moved.z} + Vec3{10, 20, 30};
        EXPECT_LT(length(mesh.vertices[v] - Vec3{outer.x, -outer.z, outer.y}), 1e-5);
        EXPECT_LT(length(mesh.normals[v] - Vec3{0, -1, 0}), 1e-6);  // +Y, rolled to +Z of glTF
    }
    EXPECT_EQ(mesh.triangles, kTwo);
}

// Normals of an unevenly scaled slope, and the winding of a mirrored one.
TEST_F(Object, NormalsAndWindingFollowMirrorsAndUnevenScales)
{
    Draft draft;
    draft.addFloats({0, 0, 0, 1, 1, 0, 0, 0, -1}, "VEC3");  // a slope of 45°, rising along x
    const auto n = static_cast<float>(std::sqrt(0.5));
    draft.addFloats({-n, n, 0, -n, n, 0, -n, n, 0}, "VEC3");
    draft.addFloats({0, 0, 1, 0, 0, 1}, "VEC2");
    for (const double x : {2.0, -2.0}) {
        const TexturedMesh mesh = read(draft.file(scene(kSquare, R"(,"scale":[)" + std::to_string(x) + R"(,1,1])")));
        const Vec3 a = mesh.vertices[mesh.triangles[0][0]];
        const Vec3 normal = cross(mesh.vertices[mesh.triangles[0][1]] - a, mesh.vertices[mesh.triangles[0][2]] - a);
        EXPECT_LT(length(cross(mesh.normals[0], normal)), 1e-6);
        EXPECT_GT(dot(mesh.normals[0], normal), 0.0);
        EXPECT_GT(mesh.normals[0].z, 0.0);
    }
}

// Cube whose faces have their own vertices. Diagonals cut the faces, so a mean over triangles would be tilted.
TEST_F(Object, MissingNormalsAreWeightedByAngles)
{
    Draft draft;
    std::vector<float> vertices;
    std::vector<float> uvs;
    std::string indices;
    for (int axis = 0; axis < 3; ++axis) {
        for (const int side : {-1, 1}) {
            for (int corner = 0; corner < 4; ++corner) {
                std::array<float, 3> p{};
                p[static_cast<std::size_t>(axis)] = static_cast<float>(side);
                p[static_cast<std::size_t>(axis + 1) % 3] = (corner == 1 || corner == 2) ? 1.0F : -1.0F;
                p[static_cast<std::size_t>(axis + 2) % 3] = corner >= 2 ? 1.0F : -1.0F;
                vertices.insert(vertices.end(), p.begin(), p.end());
                uvs.insert(uvs.end(), {0.0F, 0.0F});
            }
            const auto first = static_cast<std::uint32_t>(vertices.size() / 3 - 4);
            for (const std::uint32_t k :
                 side > 0 ? std::array{0U, 1U, 2U, 0U, 2U, 3U} : std::array{0U, 2U, 1U, 0U, 3U, 2U}) {
                indices += littleEndian(first + k, 2);
            }
        }
    }
    draft.addFloats(vertices, "VEC3");
    draft.addFloats(uvs, "VEC2");
    draft.add(indices, 5123, "SCALAR", 36);
    const TexturedMesh mesh = read(draft.file(scene(R"("attributes":{"POSITION":0,"TEXCOORD_0":1},"indices":2)")));
    for (std::size_t v = 0; v < 24; ++v) {
        EXPECT_LT(length(mesh.normals[v] - (1.0 / std::numbers::sqrt3) * mesh.vertices[v]), 1e-12);
    }
}

// The can in data/ has the size that its generator states, outward normals, and a texture as wide as its circumference.
TEST_F(Object, TheCanInDataIsUnwrappedInTrueProportion)
{
    const TexturedMesh mesh = readObject(testing::inSource("data/can.glb"));
    double radius = 0.0;
    double top = 0.0;
    double bottom = 1.0;
    for (const Vec3 p : mesh.vertices) {
        radius = std::max(radius, std::hypot(p.x, p.y));
        top = std::max(top, p.z);
        bottom = std::min(bottom, p.z);
    }
    EXPECT_NEAR(radius, 33e-3, 1e-8);
    EXPECT_EQ(bottom, 0.0);
    const double lean = 50.0 * std::numbers::pi / 180.0;
    EXPECT_NEAR(top, 98e-3 + 7e-3 * std::sin(lean) / (1.0 - std::cos(lean)), 1e-8);
    for (const Triangle& t : mesh.triangles) {
        const Vec3 a = mesh.vertices[t[0]];
        const Vec3 normal = cross(mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a);
        for (const std::uint32_t v : t) {
            EXPECT_GT(dot(normal, mesh.normals[v]), 0.9 * length(normal));
        }
    }
    EXPECT_NEAR(metresPerUv(mesh) / (2.0 * std::numbers::pi * 33e-3), 1.0, 1e-3);  // the can has 64 chords
}

TEST_F(Object, RefusesUnusableMeshes)
{
    expectRefused(indexedSquare().file(scene(R"("attributes":{"POSITION":0,"NORMAL":1})" + kIndices)),
                  "mesh \"lid\" has no texture coordinates");
    expectRefused(
        indexedSquare().file(R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"nodes":[{"mesh":0}])"),
        "mesh 0 has no texture coordinates");
    expectRefused(indexedSquare().file(R"("scenes":[{"nodes":[]}])"), "no triangles");
    expectRefused(indexedSquare().file(R"("nodes":[])"), "no triangles");
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        Draft draft;
        draft.addFloats({0, 0, 0, 1, 0, bad, 1, 0, 2}, "VEC3");
        draft.addFloats({0, 0, 1, 0, 1, 1}, "VEC2");
        expectRefused(draft.file(scene(R"("attributes":{"POSITION":0,"TEXCOORD_0":1})")), "not finite");
        Draft uv;
        uv.addFloats({0, 0, 0, 1, 0, 0, 1, 0, 2}, "VEC3");
        uv.addFloats({0, 0, 1, 0, bad, 1}, "VEC2");
        expectRefused(uv.file(scene(R"("attributes":{"POSITION":0,"TEXCOORD_0":1})")), "not finite");
    }
}

TEST_F(Object, RefusesUnsupportedData)
{
    Draft sparse = indexedSquare();
    sparse.add(floats({0, 0, 0, 0, 0, 0, 0, 0}), 5126, "VEC2", 4, R"(,"sparse":{"count":1})");
    expectRefused(sparse.file(scene(R"("attributes":{"POSITION":0,"TEXCOORD_0":4})")), "sparse");
    expectRefused(
        indexedSquare().file(scene(kSquare + kIndices) + R"(,"extensionsRequired":["KHR_draco_mesh_compression"])"),
        "compressed");
    const std::string one =
        R"({"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":0}}]}],)";
    expectRefused(glb(one + R"("accessors":[{"componentType":5126,"type":"VEC3","count":3}]})", ""), "no data");
}

TEST_F(Object, RefusesDamagedFiles)
{
    expectFileRefused(path("missing.glb"), "No such file");
    std::filesystem::create_directory(path("folder.glb"));
    expectFileRefused(path("folder.glb"), "directory");
    std::filesystem::create_symlink("/dev/zero", path("zero.glb"));
    expectFileRefused(path("zero.glb"), "not glTF");
    EXPECT_THROW((void)readObject(path("object.fbx")), Error);
    expectRefused("", "not glTF");
    expectRefused("solid teapot\n", "not glTF");
    expectRefused("{\"nodes\":", "not glTF");
    expectRefused("[]", "not glTF");
    expectRefused("glTF", "cut short");
    const std::string whole = indexedSquare().file(scene(kSquare + kIndices));
    expectRefused(whole.substr(0, whole.size() - 4), "cut short");
    std::string chunk = whole;  // the last chunk claims four bytes more than the file has
    const std::size_t at = chunk.find(std::string("BIN\0", 4)) - 4;
    chunk[at] = static_cast<char>(chunk[at] + 4);
    expectRefused(chunk, "cut short");
    Draft far = square();
    far.add(littleEndian(0x040100, 3), 5121, "SCALAR", 3);
    expectRefused(far.file(scene(kSquare + kIndices)), "names vertex 4 of 4");
    Draft beyond = square();
    beyond.add(littleEndian(0x020100, 3), 5121, "SCALAR", 4);
    expectRefused(beyond.file(scene(kSquare + kIndices)), "accessors[3] reaches beyond its buffer");
    Draft endless = square();
    endless.add(littleEndian(0x020100, 3), 5121, "SCALAR", std::size_t{1} << 52);
    expectRefused(endless.file(scene(kSquare + kIndices)), "accessors[3] reaches beyond its buffer");
    expectRefused(square().file(scene(R"("attributes":{"POSITION":0,"NORMAL":1,"TEXCOORD_0":9})")), "accessors[9]");
    expectRefused(square().file(scene(R"("attributes":{"POSITION":0,"NORMAL":-1,"TEXCOORD_0":2})")), "NORMAL");
    expectRefused(square().file(scene(R"("attributes":{"POSITION":2,"TEXCOORD_0":2})")), "VEC3");
    expectRefused(square().file(scene(kSquare, R"(,"children":[0])")), "two parents");
    expectRefused(square().file(scene(kSquare, R"(,"rotation":[0,0,0,0])")), "quaternion");
    expectRefused(square().file(scene(kSquare, R"(,"scale":[1,"a",1])")), "scale");
    expectRefused(square().file(scene(kSquare, R"(,"scale":[1e999,1,1])")), "");
}

// tinygltf alone would overlook these errors, load other files, or recurse without limit.
TEST_F(Object, ChecksTheFileBeforeTinygltfReadsIt)
{
    const std::string square_scene = scene(kSquare + kIndices);
    const auto changed = [&](const std::string& what, const std::string& to) {
        std::string json = indexedSquare().json(square_scene);
        json.replace(json.find(what), what.size(), to);
        return glb(json, indexedSquare().buffer());
    };
    EXPECT_EQ(read(changed("\"mesh\":0", "\"mesh\":0.0")).triangles, kTwo);
    expectRefused(changed("\"mesh\":0", "\"mesh\":0.5"), "\"mesh\" is not a valid index");
    expectRefused(changed("\"mesh\":0", "\"mesh\":4294967296"), "\"mesh\" is not a valid index");
    expectRefused(changed("\"mesh\":0", "\"mesh\":0,\"children\":0"), "\"children\" is not a list");
    expectRefused(changed("\"byteOffset\":0", "\"byteOffset\":-4"), "\"byteOffset\" is not a valid index or count");
    expectRefused(changed("\"buffers\":[{\"byteLength\":", "\"buffers\":[{\"byteLength\":0,\"was\":"), "bytes of 0");
    expectRefused(changed("\"buffers\"", "\"buffer\""), "buffers[0] does not exist");
    const std::string nested = std::string(100000, '[') + std::string(100000, ']');
    expectRefused(changed("\"asset\"", "\"extras\":" + nested + ",\"asset\""), "nested more than 64 deep");
    EXPECT_EQ(read(changed("\"asset\"", R"("extras":{"a":[{}]},"images":[{"uri":"nowhere.png"},5],"asset")")).triangles,
              kTwo);
}

TEST_F(Object, BuffersMayBeLongerThanStated)
{
    const Draft draft = indexedSquare();
    writeFile(path("data.bin"), draft.buffer() + "more");
    writeFile(path("object.gltf"), draft.json(scene(kSquare + kIndices), "data.bin"));
    EXPECT_EQ(readObject(path("object.gltf")).triangles, kTwo);
    const std::string a = R"({"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"nodes":[{"mesh":0}],)"
                          R"("accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":3}],)"
                          R"("bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":")";
    // The data is 36 zero bytes and three more.
    for (const char* const kind : {"data:;base64,", "data:application/x-any;charset=none;base64,"}) {
        expectRefused(a + kind + std::string(52, 'A') + "\"}]}", "no texture coordinates");
        expectRefused(a + kind + std::string(47, 'A') + "\"}]}", "Failed to decode");
    }
}

// Files cut at any place or with any byte changed are read as valid or refused.
TEST_F(Object, ReadsDamagedFilesAsValidOrRefusesThem)
{
    const std::string whole = indexedSquare().file(scene(kSquare + kIndices, R"(,"translation":[1,2,3])"));
    std::size_t refused = 0;
    const auto survive = [&](const std::string& bytes) {
        std::filesystem::remove(path());  // file systems flush overwritten files
        writeFile(path(), bytes);
        try {
            const TexturedMesh mesh = readObject(path());
            EXPECT_NO_THROW(mesh.validate());
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::InvalidInput);
            ++refused;
        }
    };
    for (std::size_t size = 0; size < whole.size(); ++size) {
        survive(whole.substr(0, size));
    }
    EXPECT_EQ(refused, whole.size());
    for (std::size_t at = 0; at < whole.size(); ++at) {
        for (const int change : {0x01, 0x02, 0x10, 0x80, 0xff}) {
            std::string bytes = whole;
            bytes[at] = static_cast<char>(bytes[at] ^ change);
            survive(bytes);
        }
        std::string text = whole;  // a changed digit is another index, count or offset
        text[at] = '9';
        survive(text);
    }
}

}  // namespace
}  // namespace droplet
