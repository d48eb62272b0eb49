// SPDX-License-Identifier: GPL-3.0-or-later
// Files of many droplets at rest: what instances, nodes and one mesh show is the same.
#include "droplet/flow_io/dew_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <numeric>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "droplet/drawing/picture.h"
#include "droplet/error.h"
#include "droplet/flow/dew.h"
#include "droplet/flow_io/flow_object.h"
#include "flow_io/object_faces.h"
#include "support/command.h"
#include "support/objects.h"
#include "support/paths.h"

namespace droplet {
namespace {

using ::testing::HasSubstr;
using testing::runProgram;

/// Ball of 2 cm with edges of 15°.
FlowObject ball()
{
    const TexturedMesh mesh = testing::ball(24, [](Vec3) { return 0.02; });
    FlowObject object;
    object.vertices = mesh.vertices;
    object.normals = mesh.normals;
    object.uvs = mesh.uvs;
    object.triangles = mesh.triangles;
    return object;
}

struct Wet {
    FlowObject object = ball();
    FlowTerrain terrain{flowSurface(object.vertices, object.triangles)};
    DewOptions options;
    DropletBodies bodies{BodyShape::Capillary};
    DewDroplets dew = dewDroplets(terrain, options);
    DewModel model{terrain, dew.samples, bodies, options.gravity};

    [[nodiscard]] std::string file(const DewFile& form) const
    {
        std::ostringstream out;
        const std::uint64_t bytes = model.write(object, out, form);
        EXPECT_EQ(bytes, out.str().size());
        return out.str();
    }
};

const Wet& wet()
{
    static const Wet made;
    return made;
}

nlohmann::json jsonOf(const std::string& glb)
{
    std::uint32_t length = 0;
    std::memcpy(&length, glb.data() + 12, 4);
    return nlohmann::json::parse(glb.substr(20, length));
}

TEST(DewModel, DropletsAreClosedHaveTheirVolumesAndSit)
{
    const Surface surface = wet().model.surface();
    surface.validate();
    EXPECT_TRUE(isClosed(surface));
    const std::size_t shown = wet().model.shown().size();
    EXPECT_EQ(topology(surface).components, shown);
    EXPECT_GE(static_cast<double>(shown), 0.97 * static_cast<double>(wet().dew.samples.size())) << "few are left out";
    double volume = 0.0;
    for (const std::size_t i : wet().model.shown()) {
        volume += wet().dew.samples[i].volume;
    }
    EXPECT_NEAR(enclosedVolume(surface) / volume, 1.0, 0.01);
    // The weld of a rim has two vertices: those lie on the object.
    std::vector<int> count(surface.vertices.size());
    for (const std::uint32_t first : surface.weld) {
        ++count[first];
    }
    std::vector<double> gaps;
    for (std::size_t v = 0; v < surface.vertices.size(); ++v) {
        if (count[v] == 2) {
            gaps.push_back(length(surface.vertices[v] - wet().terrain.nearest(surface.vertices[v]).place));
        }
    }
    ASSERT_GT(gaps.size(), 8 * shown - 1);
    std::sort(gaps.begin(), gaps.end());
    EXPECT_LE(gaps[gaps.size() * 99 / 100], 0.05 * wet().options.largest);
    EXPECT_LE(gaps[gaps.size() / 2], 0.05 * wet().options.smallest);
}

TEST(DewModel, EveryFormShowsAllDroplets)
{
    const std::size_t shown = wet().model.shown().size();
    const nlohmann::json gpu = jsonOf(wet().file({.instancing = Instancing::Gpu}));
    EXPECT_THAT(gpu.at("extensionsRequired"), ::testing::Contains("EXT_mesh_gpu_instancing"));
    std::size_t instances = 0;
    std::size_t bent = 0;
    for (const auto& node : gpu.at("nodes")) {
        if (node.contains("extensions")) {
            const auto& attributes = node.at("extensions").at("EXT_mesh_gpu_instancing").at("attributes");
            for (const auto& accessor : attributes) {
                EXPECT_EQ(gpu.at("accessors").at(accessor.get<std::size_t>()).at("count"),
                          gpu.at("accessors").at(attributes.at("SCALE").get<std::size_t>()).at("count"));
            }
            instances +=
                gpu.at("accessors").at(attributes.at("SCALE").get<std::size_t>()).at("count").get<std::size_t>();
        } else {
            bent += node.value("name", "") == "droplets on bends" ? 1U : 0U;
        }
    }
    EXPECT_GT(instances, 0U);
    EXPECT_LT(instances, shown) << "those on edges have meshes of their own";
    EXPECT_EQ(bent, 1U);
    const nlohmann::json nodes = jsonOf(wet().file({.instancing = Instancing::Nodes}));
    EXPECT_FALSE(nodes.contains("extensionsRequired"));
    EXPECT_EQ(nodes.at("nodes").size(), instances + 2) << "a node for each, the object, and those on bends";
    const nlohmann::json none = jsonOf(wet().file({}));
    EXPECT_EQ(none.at("nodes").size(), 2U);
    const nlohmann::json alone = jsonOf(wet().file({.has_object = false}));
    EXPECT_EQ(alone.at("meshes").size(), 1U);
}

TEST(DewModel, DropletsOnGentleBendsShareMeshes)
{
    const nlohmann::json gpu = jsonOf(wet().file({.instancing = Instancing::Gpu}));
    std::size_t instances = 0;
    for (const auto& node : gpu.at("nodes")) {
        if (node.contains("extensions")) {
            const auto& attributes = node.at("extensions").at("EXT_mesh_gpu_instancing").at("attributes");
            instances +=
                gpu.at("accessors").at(attributes.at("SCALE").get<std::size_t>()).at("count").get<std::size_t>();
        }
    }
    EXPECT_GT(static_cast<double>(instances), 0.88 * static_cast<double>(wet().model.shown().size()));
}

TEST(DewModel, MeshesOfTheSameTrianglesHaveOneArrayOfThem)
{
    const nlohmann::json gpu = jsonOf(wet().file({.instancing = Instancing::Gpu, .has_object = false}));
    std::map<std::size_t, std::set<std::size_t>> arrays;  // of shared meshes, by the number of vertices
    for (const auto& mesh : gpu.at("meshes")) {
        for (const auto& primitive : mesh.at("primitives")) {
            const auto indices = primitive.at("indices").get<std::size_t>();
            EXPECT_EQ(gpu.at("accessors").at(indices).at("componentType"), 5123) << "16 bits";
            const auto vertices = primitive.at("attributes").at("POSITION").get<std::size_t>();
            if (mesh.at("name") == "droplets") {
                arrays[gpu.at("accessors").at(vertices).at("count").get<std::size_t>()].insert(indices);
            }
        }
    }
    EXPECT_LT(arrays.size(), gpu.at("meshes").size());
    for (const auto& [vertices, indices] : arrays) {
        EXPECT_EQ(indices.size(), 1U) << vertices;
    }
}

TEST(DewModel, OneMeshHasOnePart)
{
    const nlohmann::json none = jsonOf(wet().file({.instancing = Instancing::None, .has_object = false}));
    ASSERT_EQ(none.at("meshes").size(), 1U);
    EXPECT_EQ(none.at("meshes").front().at("primitives").size(), 1U);
}

TEST(DewModel, PassesTheValidator)
{
    const testing::ScratchDirectory scratch;
    std::vector<std::string> command{"node", testing::kValidator};
    for (const Instancing instancing : {Instancing::None, Instancing::Nodes, Instancing::Gpu}) {
        for (const Compression compression : {Compression::None, Compression::Quantize, Compression::Meshopt}) {
            const std::string path =
                (scratch.path() / (std::to_string(static_cast<int>(instancing)) + name(compression) + ".glb")).string();
            testing::writeFile(path, wet().file({.file = {.compression = compression}, .instancing = instancing}));
            command.push_back(path);
        }
    }
    const auto verdict = runProgram(command);
    EXPECT_EQ(verdict.exit_code, 0) << verdict.output << verdict.error;
}

/// The ball, in two colours, with light of its own from a picture.
FlowObject glowingBall()
{
    FlowObject object = ball();
    for (const Vec3 p : object.vertices) {
        object.colours.push_back({p.z > 0.0 ? 0.75 : 0.25, 0.5, 0.0});
    }
    StandLook look;
    look.look.transmission = 0.0;
    look.look.colour = {0.5, 1.0, 1.0};
    look.glow = {3.0, 1.5, 0.0};
    object.materials.assign(object.triangles.size(), 0);
    object.material_names = {"lamp"};
    object.looks = {look};
    std::ostringstream png;
    writePng(Picture{1, 1, {255, 128, 0}}, png);
    object.images.resize(1);
    object.images[0].glows = png.str();
    return object;
}

// Pictures take colours from 0 to 1 alone: neither 1 + 1e-16 nor -1e-16.
TEST(DewModel, FacesHaveColoursBetweenTheirCorners)
{
    for (const double side : {0.1, 0.37, 1.7}) {
        FlowObject object;
        object.vertices = {{0.0, 0.0, 0.0}, {side, 0.1 * side, 0.0}, {0.8 * side, side, 0.0}, {0.0, 0.7 * side, 0.0}};
        object.normals.assign(4, {0.0, 0.0, 1.0});
        object.triangles = {{0, 1, 2}, {0, 2, 3}};
        object.colours = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}, {1.0, 1.0, 1.0}};
        const FlowObject faces = onFaces(object, refined(flowSurface(object.vertices, object.triangles), 0.03 * side));
        ASSERT_GT(faces.colours.size(), 3000U);
        for (const Vec3& colour : faces.colours) {
            ASSERT_GE(std::min({colour.x, colour.y, colour.z}), 0.0);
            ASSERT_LE(std::max({colour.x, colour.y, colour.z}), 1.0);
        }
    }
}

TEST(DewModel, FilesKeepTheObjectsLightAndColours)
{
    const testing::ScratchDirectory scratch;
    const FlowObject object = glowingBall();
    std::vector<std::string> command{"node", testing::kValidator};
    for (const Compression compression : {Compression::None, Compression::Quantize, Compression::Meshopt}) {
        std::ostringstream out;
        const DewModel nothing(wet().terrain, {}, wet().bodies, wet().options.gravity);
        nothing.write(object, out, {.file = {.compression = compression}});
        command.push_back((scratch.path() / (std::string(name(compression)) + ".glb")).string());
        testing::writeFile(command.back(), out.str());
        const FlowObject again = readFlowObject(command.back());
        EXPECT_THAT(again.warnings, ::testing::IsEmpty());
        ASSERT_EQ(again.looks.size(), 1U);
        EXPECT_NEAR(length(again.looks[0].glow - object.looks[0].glow), 0.0, 1e-12);
        EXPECT_EQ(again.images[0].glows, object.images[0].glows);
        EXPECT_TRUE(again.looks[0].glows);
        EXPECT_EQ(again.looks[0].look.colour, object.looks[0].look.colour);
        ASSERT_EQ(again.colours.size(), again.vertices.size());
        for (std::size_t v = 0; v < again.vertices.size(); ++v) {
            if (std::abs(again.vertices[v].z) > 1e-3) {
                EXPECT_EQ(again.colours[v], (Vec3{again.vertices[v].z > 0.0 ? 0.75 : 0.25, 0.5, 0.0}));
            }
        }
    }
    const auto verdict = runProgram(command);
    EXPECT_EQ(verdict.exit_code, 0) << verdict.output << verdict.error;
}

TEST(DewModel, UsdHasTheObjectsLightAndColours)
{
    const DewModel nothing(wet().terrain, {}, wet().bodies, wet().options.gravity);
    FlowObject object = glowingBall();
    const auto written = [&] {
        std::ostringstream out;
        nothing.write(object, out, {.file = {.format = Format::Usda}, .instancing = Instancing::Nodes});
        return out.str();
    };
    // The shader cannot multiply: colours are those of the vertices times that of the material.
    const std::string with_picture = written();
    EXPECT_THAT(with_picture, HasSubstr("inputs:diffuseColor.connect = </droplet/lamp/colours.outputs:result>"));
    EXPECT_THAT(with_picture, HasSubstr("(0.375, 0.5, 0)"));
    EXPECT_THAT(with_picture, ::testing::Not(HasSubstr("(0.75, 0.5, 0)")));
    EXPECT_THAT(with_picture, ::testing::Not(HasSubstr("emissiveColor")))
        << "the picture may be black nearly everywhere";
    object.images[0].glows.clear();
    object.colours.clear();
    const std::string without = written();
    EXPECT_THAT(without, HasSubstr("color3f inputs:emissiveColor = (3, 1.5, 0)"));
    EXPECT_THAT(without, ::testing::Not(HasSubstr("displayColor")));
}

TEST(DewModel, DetailIsInTheNumberOfTriangles)
{
    const auto triangles = [](DewDetail detail) {
        const DewModel model(wet().terrain, wet().dew.samples, wet().bodies, wet().options.gravity, detail);
        const Surface surface = model.surface();
        EXPECT_TRUE(isClosed(surface));
        return surface.triangles.size() / model.shown().size();
    };
    EXPECT_EQ(triangles(DewDetail::Low), 64U);
    EXPECT_GT(triangles(DewDetail::Medium), 64U);
    EXPECT_GT(triangles(DewDetail::High), 1.5 * static_cast<double>(triangles(DewDetail::Medium)));
}

TEST(DewModel, UsdHasACopyForEachDroplet)
{
    const std::string text = wet().file({.file = {.format = Format::Usda}, .instancing = Instancing::Nodes});
    std::size_t copies = 0;
    for (std::size_t at = 0; (at = text.find("instanceable = true", at)) != std::string::npos; ++at) {
        ++copies;
    }
    EXPECT_EQ(copies + 2, jsonOf(wet().file({.instancing = Instancing::Nodes})).at("nodes").size());
    std::ostringstream out;
    EXPECT_THROW(
        wet().model.write(wet().object, out, {.file = {.format = Format::Usda}, .instancing = Instancing::Gpu}), Error);
}

TEST(DewModel, IsTheSameWithAnyNumberOfThreads)
{
    const std::string many = wet().file({.instancing = Instancing::Gpu});
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const DewModel again(wet().terrain, wet().dew.samples, wet().bodies, wet().options.gravity);
    std::ostringstream out;
    again.write(wet().object, out, {.instancing = Instancing::Gpu});
    EXPECT_EQ(out.str(), many);
}

TEST(DewModel, WithoutDropletsThereIsTheObjectAlone)
{
    const DewModel nothing(wet().terrain, {}, wet().bodies, wet().options.gravity);
    EXPECT_TRUE(nothing.surface().vertices.empty());
    std::ostringstream out;
    nothing.write(wet().object, out, {.instancing = Instancing::Gpu});
    EXPECT_EQ(jsonOf(out.str()).at("nodes").size(), 1U);
}

}  // namespace
}  // namespace droplet
