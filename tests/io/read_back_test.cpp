// SPDX-License-Identifier: GPL-3.0-or-later
// Every format, read back by an independent library.
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <cmath>
#include <cstring>
#include <map>
#include <set>
#include <sstream>
#include <streambuf>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "droplet/io/output.h"
#include "droplet/surface/surface.h"
#include "support/surfaces.h"

namespace droplet {
namespace {

using testing::roundDroplet;

struct Convention {
    Format format;
    double unit;  // [m]
    bool y_up;
    bool has_normals_and_uvs;
};

class ReadBack : public ::testing::TestWithParam<Convention> {
protected:
    void read(const Surface& surface)
    {
        std::ostringstream out;
        writeSurface(surface, out, GetParam().format);
        ASSERT_TRUE(out.good());
        const std::string bytes = out.str();
        const aiScene* scene = importer.ReadFileFromMemory(bytes.data(), bytes.size(), 0, name(GetParam().format));
        ASSERT_NE(scene, nullptr) << importer.GetErrorString();
        ASSERT_EQ(scene->mNumMeshes, 1U);
        mesh = scene->mMeshes[0];
        ASSERT_TRUE(mesh->HasPositions());
        ASSERT_TRUE(mesh->HasFaces());
    }

    // Converts the file's unit and axes to metres, z up.
    [[nodiscard]] static Vec3 turnedBack(const aiVector3D& a)
    {
        return GetParam().y_up ? Vec3{a.x, -static_cast<double>(a.z), a.y} : Vec3{a.x, a.y, a.z};
    }
    [[nodiscard]] Vec3 position(unsigned vertex) const { return GetParam().unit * turnedBack(mesh->mVertices[vertex]); }
    [[nodiscard]] Vec3 corner(unsigned triangle, unsigned k) const
    {
        return position(mesh->mFaces[triangle].mIndices[k]);
    }

    [[nodiscard]] double volume() const
    {
        double six_volumes = 0.0;
        for (unsigned t = 0; t < mesh->mNumFaces; ++t) {
            six_volumes += dot(corner(t, 0), cross(corner(t, 1), corner(t, 2)));
        }
        return six_volumes / 6.0;
    }

    Assimp::Importer importer;
    const aiMesh* mesh = nullptr;
};

INSTANTIATE_TEST_SUITE_P(
    EveryFormat, ReadBack,
    ::testing::Values(Convention{Format::Glb, 1.0, true, true}, Convention{Format::Gltf, 1.0, true, true},
                      Convention{Format::Obj, 1e-3, true, true}, Convention{Format::Ply, 1.0, false, true},
                      Convention{Format::Stl, 1e-3, false, false}, Convention{Format::ThreeMf, 1e-3, false, false}),
    [](const auto& run) { return std::string(name(run.param.format)); });

TEST_P(ReadBack, TheVolumeIsThatOfThePyramid)
{
    // One ring of triangles is a pyramid over a regular polygon, whose volume has a formula.
    ASSERT_NO_FATAL_FAILURE(read(roundDroplet({.outer = 3e-3, .height = 2e-3, .rings = 1, .segments = 7})));
    EXPECT_EQ(mesh->mNumFaces, 14U);
    EXPECT_NEAR(volume() / (testing::polygonArea(3e-3, 7) * 2e-3 / 3.0), 1.0, 1e-6);
}

TEST_P(ReadBack, TheVolumeOfARingIsTheSurfaces)
{
    const Surface surface = roundDroplet({.inner = 1e-3, .centre = {2e-3, -4e-3}});
    ASSERT_NO_FATAL_FAILURE(read(surface));
    EXPECT_EQ(mesh->mNumFaces, surface.triangles.size());
    EXPECT_NEAR(volume() / enclosedVolume(surface), 1.0, 1e-5);
}

TEST_P(ReadBack, EveryTriangleStandsWhereItStood)
{
    const Surface surface = roundDroplet({.inner = 1e-3, .centre = {2e-3, -4e-3}});
    ASSERT_NO_FATAL_FAILURE(read(surface));
    ASSERT_EQ(mesh->mNumFaces, surface.triangles.size());
    for (unsigned t = 0; t < mesh->mNumFaces; ++t) {
        ASSERT_EQ(mesh->mFaces[t].mNumIndices, 3U);
        for (unsigned k = 0; k < 3; ++k) {
            EXPECT_LT(length(corner(t, k) - surface.vertices[surface.triangles[t][k]]), 1e-9);
        }
    }
}

TEST_P(ReadBack, QuadrilateralsAreFacesOfFourCornersWhereTheyCanBe)
{
    Surface surface = testing::asOnePart(roundDroplet({.inner = 1e-3, .centre = {2e-3, -4e-3}}));
    joinTriangles(surface);
    surface.parts[0].quads -= 3;  // some triangles are left
    ASSERT_NO_FATAL_FAILURE(read(surface));
    const std::size_t quads = hasQuads(GetParam().format) ? surface.parts[0].quads : 0;
    ASSERT_EQ(mesh->mNumFaces, surface.triangles.size() - quads);
    std::size_t t = 0;
    for (unsigned f = 0; f < mesh->mNumFaces; ++f) {
        ASSERT_EQ(mesh->mFaces[f].mNumIndices, f < quads ? 4U : 3U);
        for (unsigned k = 0; k < 3; ++k) {
            EXPECT_LT(length(corner(f, k) - surface.vertices[surface.triangles[t][k]]), 1e-9);
        }
        if (f < quads) {
            EXPECT_LT(length(corner(f, 3) - surface.vertices[surface.triangles[++t][2]]), 1e-9);
        }
        ++t;
    }
    EXPECT_EQ(t, surface.triangles.size());
}

TEST_P(ReadBack, ARefillIsAMorphTargetInGltfOnly)
{
    const Surface surface = testing::withRefill(roundDroplet({.centre = {2e-3, -4e-3}}));
    ASSERT_NO_FATAL_FAILURE(read(surface));
    EXPECT_NEAR(volume() / enclosedVolume(surface), 1.0, 1e-5);
    if (GetParam().format != Format::Glb && GetParam().format != Format::Gltf) {
        EXPECT_EQ(mesh->mNumAnimMeshes, 0U);
        return;
    }
    ASSERT_EQ(mesh->mNumAnimMeshes, 1U);
    const aiAnimMesh& target = *mesh->mAnimMeshes[0];  // positions at weight 1, which is a fill of 2
    EXPECT_STREQ(target.mName.C_Str(), "volume");
    ASSERT_EQ(target.mNumVertices, surface.vertices.size());
    const Surface twice = refilled(surface, 2.0);
    for (unsigned v = 0; v < target.mNumVertices; ++v) {
        EXPECT_LT(length(turnedBack(target.mVertices[v]) - twice.vertices[v]), 1e-9);
    }
}

TEST_P(ReadBack, NormalsAndTextureCoordinatesBelongToTheirCorners)
{
    const Surface surface = roundDroplet({.centre = {2e-3, -4e-3}});
    ASSERT_NO_FATAL_FAILURE(read(surface));
    ASSERT_EQ(mesh->HasTextureCoords(0), GetParam().has_normals_and_uvs);
    if (!GetParam().has_normals_and_uvs) {
        return;
    }
    ASSERT_TRUE(mesh->HasNormals());
    const bool crisp = GetParam().format != Format::Ply;
    for (unsigned t = 0; t < mesh->mNumFaces; ++t) {
        for (unsigned k = 0; k < 3; ++k) {
            const unsigned read_vertex = mesh->mFaces[t].mIndices[k];
            const std::uint32_t vertex = surface.triangles[t][k];
            const Vec3 normal = surface.normals[crisp ? vertex : surface.weld[vertex]];
            EXPECT_LT(length(turnedBack(mesh->mNormals[read_vertex]) - normal), 1e-6);
            // Assimp flips glTF's v, so that every format has its origin at the bottom.
            const aiVector3D uv = mesh->mTextureCoords[0][read_vertex];
            EXPECT_NEAR(uv.x, surface.uvs[vertex].x, 1e-6);
            EXPECT_NEAR(uv.y, 1.0 - surface.uvs[vertex].y, 1e-6);
        }
    }
}

TEST_P(ReadBack, WeldedByPlaceItIsClosedWithTheRightEulerNumber)
{
    for (const double inner : {0.0, 1e-3}) {
        ASSERT_NO_FATAL_FAILURE(read(roundDroplet({.inner = inner})));
        std::map<std::tuple<double, double, double>, std::uint32_t> places;
        std::multiset<std::pair<std::uint32_t, std::uint32_t>> edges;
        for (unsigned t = 0; t < mesh->mNumFaces; ++t) {
            Triangle triangle{};
            for (unsigned k = 0; k < 3; ++k) {
                const Vec3 at = corner(t, k);
                const auto next = static_cast<std::uint32_t>(places.size());
                triangle[k] = places.emplace(std::tuple(at.x, at.y, at.z), next).first->second;
            }
            for (unsigned k = 0; k < 3; ++k) {
                edges.emplace(triangle[k], triangle[(k + 1) % 3]);
            }
        }
        for (const auto& [from, to] : edges) {
            ASSERT_EQ(edges.count({from, to}), 1U);
            ASSERT_EQ(edges.count({to, from}), 1U);
        }
        const auto euler = static_cast<long>(places.size() + mesh->mNumFaces) - static_cast<long>(edges.size() / 2);
        EXPECT_EQ(euler, inner > 0.0 ? 0 : 2);
    }
}

// Stream buffer with limited room. Like a file it has a buffer, so it fails only when that is written out.
class SmallDisk : public std::streambuf {
public:
    explicit SmallDisk(std::size_t bytes) : left_(bytes) { setp(buffer_.begin(), buffer_.end()); }

protected:
    int_type overflow(int_type c) override
    {
        if (sync() != 0) {
            return traits_type::eof();
        }
        sputc(traits_type::to_char_type(c));
        return c;
    }

    int sync() override
    {
        const auto wanted = static_cast<std::size_t>(pptr() - pbase());
        setp(buffer_.begin(), buffer_.end());
        if (wanted > left_) {
            return -1;
        }
        left_ -= wanted;
        return 0;
    }

private:
    std::size_t left_;
    std::array<char, 4096> buffer_{};
};

TEST_P(ReadBack, TheStreamIsLeftFailedUnlessItTookEveryByte)
{
    const Surface surface = roundDroplet();
    std::ostringstream whole;
    writeSurface(surface, whole, GetParam().format);
    const std::size_t size = whole.str().size();
    for (const std::size_t room : {std::size_t{0}, std::size_t{1}, size / 2, size - 1}) {
        SmallDisk disk(room);
        std::ostream out(&disk);
        writeSurface(surface, out, GetParam().format);
        EXPECT_TRUE(out.fail()) << room << " of " << size;
    }
    SmallDisk disk(size);
    std::ostream out(&disk);
    writeSurface(surface, out, GetParam().format);
    EXPECT_TRUE(out.good());
}

}  // namespace
}  // namespace droplet
