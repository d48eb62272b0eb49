// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/scene/compression.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "droplet/error.h"
#include "droplet/io/gltf.h"
#include "droplet/io/object.h"
#include "droplet/io/read_surface.h"
#include "droplet/units.h"
#include "support/command.h"
#include "support/surfaces.h"

namespace droplet {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using testing::roundDroplet;

constexpr double kSteps = 65535.0;

std::string written(const Surface& surface, const GltfOptions& options)
{
    std::ostringstream out;
    const std::uint64_t bytes = writeGltf(surface, out, options);
    EXPECT_EQ(bytes, out.str().size());
    return out.str();
}

json jsonOf(const std::string& glb)
{
    std::uint32_t length = 0;
    std::memcpy(&length, glb.data() + 12, sizeof length);
    return json::parse(glb.substr(20, length));
}

/// The GLB with another JSON, in which the text has the same length.
std::string replaced(std::string glb, const std::string& from, const std::string& to)
{
    EXPECT_EQ(from.size(), to.size());
    const std::size_t at = glb.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return glb.replace(at, from.size(), to);
}

class CompressedGltf : public ::testing::TestWithParam<Compression> {
protected:
    [[nodiscard]] Surface read(const std::string& glb) const
    {
        testing::writeFile(scratch_.path() / "droplet.glb", glb);
        return readSurface(scratch_.path() / "droplet.glb").surface;
    }

    void expectRefused(const std::string& glb, const std::string& words) const
    {
        try {
            (void)read(glb);
            ADD_FAILURE() << "read; should say: " << words;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::InvalidInput);
            EXPECT_THAT(error.what(), HasSubstr(words));
        }
    }

    testing::ScratchDirectory scratch_;
};

INSTANTIATE_TEST_SUITE_P(EveryKind, CompressedGltf, ::testing::Values(Compression::Quantize, Compression::Meshopt),
                         [](const auto& kind) { return name(kind.param); });

// Meshopt orders vertices anew, so they are found by their texture coordinates and side.
TEST_P(CompressedGltf, ReadsBackWithinTheStatedError)
{
    const Surface surface =
        testing::withContactAngles(roundDroplet({.inner = 1e-3, .rings = 8, .segments = 60, .centre = {1e-3, -2e-3}}));
    const Surface found = read(written(surface, {.compression = GetParam()}));
    const CompressionError error = compressionError(surface, GetParam());
    EXPECT_LT(error.position, std::sqrt(3.0) / 2.0 * 8e-3 / kSteps);
    EXPECT_LT(error.normal, (GetParam() == Compression::Quantize ? 0.005 : 0.1) * kDegree);
    ASSERT_EQ(found.vertices.size(), surface.vertices.size());
    const auto same = [&](std::size_t i) {
        std::size_t nearest = 0;
        double least = 1.0;
        for (std::size_t k = 0; k < found.vertices.size(); ++k) {
            const double distance = std::hypot(found.uvs[k].x - surface.uvs[i].x, found.uvs[k].y - surface.uvs[i].y);
            if (distance < least && (found.normals[k].z > 0.0) == (surface.normals[i].z > 0.0)) {
                nearest = k;
                least = distance;
            }
        }
        return nearest;
    };
    double largest = 0.0;
    double largest_angle = 0.0;
    for (std::size_t i = 0; i < surface.vertices.size(); ++i) {
        const std::size_t at = same(i);
        largest = std::max(largest, length(found.vertices[at] - surface.vertices[i]));
        const Vec3 normal = found.normals[at];
        largest_angle = std::max(
            largest_angle, std::atan2(length(cross(normal, surface.normals[i])), dot(normal, surface.normals[i])));
        EXPECT_NEAR(found.contact_angle[at], surface.contact_angle[i], 1e-6);
        EXPECT_NEAR(found.uvs[at].x, surface.uvs[i].x, 0.51 / kSteps);
        EXPECT_NEAR(found.uvs[at].y, surface.uvs[i].y, 0.51 / kSteps);
    }
    EXPECT_NEAR(largest, error.position, 1e-3 * error.position);
    EXPECT_NEAR(largest_angle, error.normal, 1e-3 * error.normal);
}

TEST_P(CompressedGltf, KeepsTheMeshWatertight)
{
    for (const std::uint32_t rings : {4U, 200U}) {
        const Surface surface =
            testing::together(roundDroplet({.inner = 1e-3, .rings = rings, .segments = 200}),
                              roundDroplet({.rings = rings, .segments = 200, .centre = {9e-3, 0.0}}));
        const Surface found = read(written(surface, {.compression = GetParam()}));
        EXPECT_EQ(found.triangles.size(), surface.triangles.size());
        const Topology expected = topology(surface);
        const Topology is = topology(found);
        EXPECT_TRUE(is.closed);
        EXPECT_EQ(is.euler, expected.euler);
        EXPECT_EQ(is.components, expected.components);
        EXPECT_NEAR(enclosedVolume(found), enclosedVolume(surface), 1e-4 * enclosedVolume(surface));
    }
}

TEST_P(CompressedGltf, RequiresItsExtensionsAndIsSmaller)
{
    const Surface surface = roundDroplet({.rings = 20, .segments = 100});
    const std::string glb = written(surface, {.compression = GetParam()});
    EXPECT_EQ(written(surface, {.compression = GetParam()}), glb);
    const json required = jsonOf(glb).at("extensionsRequired");
    EXPECT_EQ(required, GetParam() == Compression::Quantize
                            ? json({"KHR_mesh_quantization"})
                            : json({"KHR_mesh_quantization", "EXT_meshopt_compression"}));
    const double plain = static_cast<double>(written(surface, {}).size());
    EXPECT_LT(static_cast<double>(glb.size()), (GetParam() == Compression::Quantize ? 0.8 : 0.4) * plain);
    EXPECT_FALSE(jsonOf(written(surface, {})).contains("extensionsRequired"));
}

// The node's scale also applies to the thickness; the distance of attenuation is in metres.
TEST_P(CompressedGltf, KeepsTheMaterial)
{
    const json plain = jsonOf(written(roundDroplet(), {.material = Material::Ink}))["materials"][0]["extensions"];
    const json file = jsonOf(written(roundDroplet(), {.material = Material::Ink, .compression = GetParam()}));
    const json& found = file["materials"][0]["extensions"];
    const double scale = file["nodes"][0]["scale"][0];
    EXPECT_NEAR(scale, 8e-3, 1e-8);
    EXPECT_DOUBLE_EQ(found["KHR_materials_volume"]["thicknessFactor"].get<double>() * scale,
                     plain["KHR_materials_volume"]["thicknessFactor"]);
    EXPECT_EQ(found["KHR_materials_volume"]["attenuationDistance"],
              plain["KHR_materials_volume"]["attenuationDistance"]);
    EXPECT_EQ(found["KHR_materials_ior"], plain["KHR_materials_ior"]);
}

TEST_P(CompressedGltf, KeepsTextureCoordinatesBeyondThePicture)
{
    Surface surface = roundDroplet();
    for (Vec2& uv : surface.uvs) {
        uv = {3.0 * uv.x - 1.0, uv.y};
    }
    const Surface found = read(written(surface, {.compression = GetParam()}));
    const auto range = [](const Surface& of) {
        const auto [low, high] =
            std::minmax_element(of.uvs.begin(), of.uvs.end(), [](const Vec2& a, const Vec2& b) { return a.x < b.x; });
        return std::pair(static_cast<float>(low->x), static_cast<float>(high->x));
    };
    EXPECT_EQ(range(found), range(surface));
}

Surface pairOfDroplets()
{
    return testing::withContactAngles(testing::pairOfDroplets());
}

GltfOptions redAndWater(Nodes nodes, Compression compression)
{
    Look red = lookOf(Material::Ink);
    red.name = "red";
    return {.nodes = nodes,
            .droplets = {{"red_1", red, 4e-9, 0.5, 2e-3, 70.0},
                         {"droplet_2", lookOf(Material::Water), 1e-9, 0.25, 1e-3, 40.0}},
            .texture = "any bytes of a picture",
            .compression = compression};
}

// The nodes stay as they are, apart from their scale and place, and all vertices are within the stated error.
TEST_P(CompressedGltf, KeepsLooksNodesAndThePicture)
{
    const Surface surface = pairOfDroplets();
    for (const Nodes nodes : {Nodes::One, Nodes::Each}) {
        const std::string glb = written(surface, redAndWater(nodes, GetParam()));
        const json plain = jsonOf(written(surface, redAndWater(nodes, Compression::None)));
        const json file = jsonOf(glb);
        ASSERT_EQ(file["nodes"].size(), nodes == Nodes::Each ? 2U : 1U);
        for (std::size_t k = 0; k < file["nodes"].size(); ++k) {
            EXPECT_EQ(file["nodes"][k]["name"], plain["nodes"][k]["name"]);
            EXPECT_EQ(file["nodes"][k]["mesh"], plain["nodes"][k]["mesh"]);
            EXPECT_EQ(file["nodes"][k].value("extras", json()), plain["nodes"][k].value("extras", json()));
            EXPECT_EQ(file["nodes"][k]["scale"], file["nodes"][0]["scale"]);
            EXPECT_EQ(file["nodes"][k]["translation"], file["nodes"][0]["translation"]);
            ASSERT_EQ(file["meshes"][k]["primitives"].size(), nodes == Nodes::Each ? 1U : 2U);
        }
        ASSERT_EQ(file["materials"].size(), 2U);
        for (std::size_t k = 0; k < 2; ++k) {
            EXPECT_EQ(file["materials"][k]["name"], plain["materials"][k]["name"]);
            EXPECT_EQ(file["materials"][k]["pbrMetallicRoughness"], plain["materials"][k]["pbrMetallicRoughness"]);
            const auto thickness = [&](const json& of) {
                return of["materials"][k]["extensions"]["KHR_materials_volume"]["thicknessFactor"].get<double>();
            };
            EXPECT_DOUBLE_EQ(thickness(file) * file["nodes"][0]["scale"][0].get<double>(), thickness(plain));
        }
        const json& view = file["bufferViews"][file["images"][0]["bufferView"].get<std::size_t>()];
        EXPECT_EQ(view["buffer"], 0);
        EXPECT_EQ(glb.substr(glb.find("BIN") + 4 + view["byteOffset"].get<std::size_t>(), view["byteLength"]),
                  "any bytes of a picture");
        const Surface found = read(glb);
        EXPECT_EQ(found.triangles.size(), surface.triangles.size());
        EXPECT_EQ(topology(found).components, 2U);
        EXPECT_TRUE(isClosed(found));
        EXPECT_NEAR(enclosedVolume(found), enclosedVolume(surface), 1e-4 * enclosedVolume(surface));
        const CompressionError error = compressionError(surface, GetParam());
        double largest = 0.0;
        for (const Vec3& expected : surface.vertices) {
            double least = 1.0;
            for (const Vec3& place : found.vertices) {
                least = std::min(least, length(place - expected));
            }
            largest = std::max(largest, least);
        }
        EXPECT_NEAR(largest, error.position, 1e-3 * error.position);
    }
}

// Droplets that touch, as those by colour do, share the places of their vertices.
TEST_P(CompressedGltf, KeepsSharedVerticesTogether)
{
    Surface surface = testing::together(roundDroplet(), roundDroplet({.inner = 4e-3, .outer = 7e-3}));
    const auto vertices = static_cast<std::size_t>(roundDroplet().vertices.size());
    const std::size_t triangles = roundDroplet().triangles.size();
    surface.parts = {{0, 0, vertices, 0, triangles, 0, 1e-9, 1e-6},
                     {1, vertices, surface.vertices.size() - vertices, triangles, surface.triangles.size() - triangles,
                      0, 1e-9, 1e-6}};
    const auto shared = [](const Surface& of) {
        std::set<std::array<double, 3>> places;
        std::set<std::array<double, 3>> rims;
        for (const Vec3& p : of.vertices) {
            places.insert({p.x, p.y, p.z});
            if (std::abs(std::hypot(p.x, p.y) - 4e-3) < 1e-6) {
                rims.insert({p.x, p.y, p.z});
            }
        }
        return std::pair(places.size(), rims.size());
    };
    ASSERT_EQ(shared(surface).second, 12U);
    for (const Nodes nodes : {Nodes::One, Nodes::Each}) {
        EXPECT_EQ(shared(read(written(surface, redAndWater(nodes, GetParam())))), shared(surface));
    }
}

TEST_P(CompressedGltf, IsAnObjectToLayDropletsOn)
{
    testing::writeFile(scratch_.path() / "cap.glb", written(roundDroplet(), {.compression = GetParam()}));
    const TexturedMesh mesh = readObject(scratch_.path() / "cap.glb");
    EXPECT_EQ(mesh.triangles.size(), roundDroplet().triangles.size());
    for (const Nodes nodes : {Nodes::One, Nodes::Each}) {
        testing::writeFile(scratch_.path() / "pair.glb", written(pairOfDroplets(), redAndWater(nodes, GetParam())));
        EXPECT_EQ(readObject(scratch_.path() / "pair.glb").triangles.size(), pairOfDroplets().triangles.size());
    }
}

/// The error that is stated for a refill is that of its worst state. Its changes have the place of their base.
TEST_P(CompressedGltf, CompressesARefill)
{
    const Surface surface = testing::withRefill(roundDroplet({.rings = 20, .segments = 100}));
    const std::string glb = written(surface, {.compression = GetParam()});
    EXPECT_LT(static_cast<double>(glb.size()), 0.8 * static_cast<double>(written(surface, {}).size()));
    const json file = jsonOf(glb);
    const json& primitive = file["meshes"][0]["primitives"][0];
    ASSERT_EQ(primitive["targets"].size(), 1U);
    const auto accessorOf = [&](const json& index) { return file["accessors"][index.get<std::size_t>()]; };
    const json change = accessorOf(primitive["targets"][0]["POSITION"]);
    EXPECT_EQ(change["componentType"], 5122);
    EXPECT_EQ(change["normalized"], true);
    const double side = file["nodes"][0]["scale"][0];
    double highest = 0.0;
    for (const Vec3& p : surface.refill->states[0].vertices) {
        highest = std::max(highest, p.z);
    }
    EXPECT_NEAR(side * change["max"][1].get<double>() / 32767.0, highest, side / 65534.0);
    Surface still = surface;
    still.refill.reset();
    EXPECT_GT(compressionError(surface, GetParam()).position, compressionError(still, GetParam()).position);
    EXPECT_LT(compressionError(surface, GetParam()).position, 3.0 * 0.87 * side / kSteps);
}

// A change that is longer than the droplet is stored, too.
TEST_P(CompressedGltf, HoldsChangesBeyondTheBox)
{
    Surface surface = testing::withRefill(roundDroplet());
    for (Vec3& change : surface.refill->states[0].vertices) {
        change = 20.0 * change;
    }
    const json file = jsonOf(written(surface, {.compression = GetParam()}));
    const double side = file["nodes"][0]["scale"][0];
    const json& index = file["meshes"][0]["primitives"][0]["targets"][0]["POSITION"];
    EXPECT_EQ(file["accessors"][index.get<std::size_t>()]["max"][1], 32767);
    double highest = 0.0;
    for (const Vec3& p : surface.refill->states[0].vertices) {
        highest = std::max(highest, p.z);
    }
    EXPECT_NEAR(side, highest, 1e-9);
}

TEST_P(CompressedGltf, RefusesText)
{
    std::ostringstream out;
    EXPECT_THROW(writeGltf(roundDroplet(), out, {.binary = false, .compression = GetParam()}), Error);
    EXPECT_TRUE(out.str().empty());
    EXPECT_EQ(written({}, {.compression = GetParam()}), written({}, {}));
}

TEST(CompressionError, IsZeroWithoutCompression)
{
    const CompressionError error = compressionError(roundDroplet(), Compression::None);
    EXPECT_EQ(error.position, 0.0);
    EXPECT_EQ(error.normal, 0.0);
}

class MeshoptGltf : public CompressedGltf {};

INSTANTIATE_TEST_SUITE_P(Meshopt, MeshoptGltf, ::testing::Values(Compression::Meshopt));

TEST_P(MeshoptGltf, RefusesDamagedData)
{
    const std::string glb = written(roundDroplet(), {.compression = GetParam()});
    const json file = jsonOf(glb);
    const std::size_t chunk = glb.find("BIN") + 4;
    for (const json& view : file["bufferViews"]) {
        const json& extension = view["extensions"]["EXT_meshopt_compression"];
        std::string damaged = glb;
        damaged[chunk + extension["byteOffset"].get<std::size_t>()] = '\x11';  // the codec's version
        expectRefused(damaged, "the decoder refuses them");
    }
    expectRefused(replaced(glb, "\"TRIANGLES\"", "\"TRIANGELS\""), "mode \"TRIANGELS\"");
    expectRefused(replaced(glb, "\"OCTAHEDRAL\"", "\"QUATERNIUM\""), "filter QUATERNIUM");
    const std::string count = "\"count\":" + file["accessors"][0]["count"].dump() + ",\"mode\"";
    expectRefused(replaced(glb, count, "\"count\":-1,\"mode\""), "\"count\" is not a valid index or count");
    expectRefused(replaced(glb, count, "\"count\":1e,\"mode\""), "JSON");
    expectRefused(replaced(glb, "\"buffer\":0,\"byteLength\"", "\"buffer\":7,\"byteLength\""), "buffers[7]");
}

}  // namespace
}  // namespace droplet
