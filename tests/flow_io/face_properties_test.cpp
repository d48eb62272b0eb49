// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/flow_io/face_properties.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "droplet/error.h"
#include "droplet/flow/dew.h"
#include "droplet/flow/flow.h"
#include "droplet/flow/scatter.h"
#include "droplet/flow_io/flow_points.h"
#include "droplet/units.h"

namespace droplet {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Unit square of two triangles, the second one of which winds the other way, and has another material.
FlowObject square()
{
    FlowObject object;
    object.vertices = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 1.0, 0.0}, {0.0, 1.0, 0.0}};
    object.normals.assign(4, {0.0, 0.0, 1.0});
    object.uvs = {{0.0, 1.0}, {1.0, 1.0}, {1.0, 0.0}, {0.0, 0.0}};
    object.triangles = {{0, 1, 2}, {0, 3, 2}};
    object.materials = {0, 1};
    object.material_names = {"glass", "rust"};
    return object;
}

/// White where x > y, counted from the top left.
HeightMap half(int size)
{
    HeightMap picture{size, size, {}, false};
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            picture.levels.push_back(x >= size - y ? 1.0F : 0.0F);
        }
    }
    return picture;
}

TEST(FaceProperties, TakesMeansOfPicturesOverTriangles)
{
    const FlowObject object = square();
    const FlowSurface surface = flowSurface(object.vertices, object.triangles);
    EXPECT_EQ(surface.report.turned, 1U);
    ASSERT_EQ(surface.faces[0].source, 0U);
    // The lower right half of the picture is the first triangle.
    const std::vector<double> means = meansOverFaces(half(512), object, surface);
    EXPECT_NEAR(means[0], 1.0, 0.02);
    EXPECT_NEAR(means[1], 0.0, 0.02);
    HeightMap grey{1, 1, {0.25F}, false};
    const FaceProperties ground =
        faceProperties(object, surface,
                       {.roughness_picture = grey, .max_roughness = 2e-4, .friction_picture = grey, .max_friction = 8});
    EXPECT_THAT(ground.roughness, ElementsAre(Vec2{5e-5, 5e-5}, Vec2{5e-5, 5e-5}));
    EXPECT_THAT(ground.friction, ElementsAre(2.0, 2.0));
    EXPECT_THAT(ground.hysteresis, IsEmpty());
    // A picture repeats, and levels are limited.
    FlowObject far = object;
    for (Vec2& uv : far.uvs) {
        uv = uv + Vec2{-3.0, 7.0};
    }
    EXPECT_EQ(meansOverFaces(half(64), far, surface), meansOverFaces(half(64), object, surface));
    EXPECT_THAT(meansOverFaces({1, 1, {7.0F}, true}, object, surface), ElementsAre(1.0, 1.0));
}

TEST(FaceProperties, MaterialsHaveContactAngles)
{
    const FlowObject object = square();
    FlowSurface surface = flowSurface(object.vertices, object.triangles);
    FacePropertyOptions options;
    options.contact_angle = 80.0 * kDegree;
    options.materials["rust"].contact_angle = 30.0 * kDegree;
    FlowParameters parameters;
    parameters.ground = faceProperties(object, surface, options);
    EXPECT_THAT(parameters.ground.contact_angle, ElementsAre(80.0 * kDegree, 30.0 * kDegree));
    EXPECT_THAT(parameters.ground.hysteresis, IsEmpty());
    options.materials["rust"].contact_angle = 180.0 * kDegree;
    EXPECT_THROW(faceProperties(object, surface, options), Error);

    // Droplets are as wide as the caps with these angles, and are drawn so.
    const FlowTerrain terrain(std::move(surface));
    parameters.merges = false;
    constexpr double kVolume = 1e-10;  // hardly flattened by its weight
    FlowState state = startFlow(terrain, parameters, {{{0.7, 0.3, 0.0}, kVolume, {}}, {{0.3, 0.7, 0.0}, kVolume, {}}});
    state = advanceFlow(std::move(state), terrain, parameters, 0.1);
    const std::vector<FlowSample> samples = sampleFlow(state, terrain, parameters);
    const DropletBodies bodies(BodyShape::Capillary, parameters.forces, parameters.ground.contact_angle);
    const auto points = flowPoints(samples, terrain, bodies, parameters.gravity);
    ASSERT_EQ(points.size(), 2U);
    EXPECT_NEAR(points[0].radius / capOf(kVolume, 80.0 * kDegree).contact_radius, 1.0, 0.01);
    EXPECT_NEAR(points[1].radius / capOf(kVolume, 30.0 * kDegree).contact_radius, 1.0, 0.01);
}

TEST(FaceProperties, HasPropertiesOfMaterials)
{
    const FlowObject object = square();
    const FlowSurface surface = flowSurface(object.vertices, object.triangles);
    const FaceProperties ground =
        faceProperties(object, surface,
                       {.friction_picture = HeightMap{1, 1, {0.5F}, false},
                        .roughness = 1e-5,
                        .materials = {{"rust", {.roughness = 3e-4, .friction = 4.0}}, {"glass", {.hysteresis = 0.5}}}});
    EXPECT_THAT(ground.roughness, ElementsAre(Vec2{1e-5, 1e-5}, Vec2{3e-4, 3e-4}));
    EXPECT_THAT(ground.friction, ElementsAre(0.5, 4.0));
    EXPECT_THAT(ground.hysteresis, ElementsAre(0.5, 1.0));
    const FaceProperties none = faceProperties(object, surface, {});
    EXPECT_THAT(none.roughness, IsEmpty());
    EXPECT_THAT(none.friction, IsEmpty());
}

TEST(FaceProperties, NamesWhatIsWrong)
{
    FlowObject object = square();
    const FlowSurface surface = flowSurface(object.vertices, object.triangles);
    const auto refusal_of = [&](const FacePropertyOptions& options) -> std::string {
        try {
            (void)faceProperties(object, surface, options);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::InvalidArgument);
            return error.what();
        }
        return "no refusal";
    };
    EXPECT_THAT(refusal_of({.materials = {{"wood", {}}}}), HasSubstr("wood, must be one of the object's: glass, rust"));
    EXPECT_THAT(refusal_of({.materials = {{"rust", {.friction = -1.0}}}}), HasSubstr("friction of rust is -1"));
    EXPECT_THAT(refusal_of({.max_roughness = -1.0}), HasSubstr("max_roughness"));
    object.material_names.clear();
    object.materials.clear();
    EXPECT_THAT(refusal_of({.materials = {{"wood", {}}}}), HasSubstr("has no materials"));
    object.uvs.clear();
    EXPECT_THAT(refusal_of({.roughness_picture = half(4)}), HasSubstr("unwrap"));
}

// A square of 10 cm whose picture shows a disc: droplets are on it alone, and fall at its edge.
TEST(FaceProperties, SurfacesEndWhereThePictureIsCutOut)
{
    constexpr double kSide = 0.1;
    constexpr double kRadius = 0.3;  // of the disc, in uv
    constexpr double kEdge = 0.004;  // longest of a face [m]
    FlowObject object = square();
    for (Vec3& p : object.vertices) {
        p = kSide * p;
    }
    const auto from_middle = [&](Vec3 p) { return std::hypot(p.x / kSide - 0.5, p.y / kSide - 0.5); };
    constexpr int kPixels = 256;
    Picture disc{kPixels, kPixels, {}};
    for (int y = 0; y < kPixels; ++y) {
        for (int x = 0; x < kPixels; ++x) {
            const bool is_in = std::hypot((x + 0.5) / kPixels - 0.5, (y + 0.5) / kPixels - 0.5) < kRadius;
            disc.rgb.insert(disc.rgb.end(), 3, is_in ? std::uint8_t{255} : std::uint8_t{51});
        }
    }
    object.looks.assign(2, StandLook{});
    const FlowSurface all = refined(flowSurface(object.vertices, object.triangles), kEdge);
    EXPECT_FALSE(hasHoles(object));
    EXPECT_EQ(withoutHoles(all, object).faces.size(), all.faces.size());
    for (StandLook& look : object.looks) {
        look.coverage = disc;
    }
    EXPECT_TRUE(hasHoles(object));
    EXPECT_EQ(withoutHoles(all, object).faces.size(), all.faces.size()) << "a little is there everywhere";
    for (StandLook& look : object.looks) {
        look.cutoff = 0.5;
    }
    const FlowSurface left = withoutHoles(all, object);
    double area = 0.0;
    for (std::uint32_t f = 0; f < left.faces.size(); ++f) {
        const FlowSurface::Face& face = left.faces[f];
        area += areaOf(face);
        EXPECT_LT(from_middle(face.corners[0]), kRadius + 1.5 * kEdge / kSide);
        for (const std::uint32_t neighbour : face.neighbour) {
            EXPECT_TRUE(neighbour == FlowSurface::kNone || std::count(left.faces[neighbour].neighbour.begin(),
                                                                      left.faces[neighbour].neighbour.end(), f) == 1);
        }
    }
    const double disc_area = std::numbers::pi * kRadius * kRadius * kSide * kSide;
    EXPECT_GT(area, disc_area);
    EXPECT_LT(area, disc_area * std::pow(1.0 + kEdge / (kSide * kRadius), 2));

    const FlowTerrain terrain(left);
    DewOptions dew;
    dew.smallest = 1e-3;
    dew.largest = 2e-3;
    const std::vector<FlowSample> drops = dewDroplets(terrain, dew).samples;
    EXPECT_GT(drops.size(), 100U);
    for (const FlowSample& sample : drops) {
        EXPECT_LT(from_middle(sample.place), kRadius + kEdge / kSide);
    }
    FlowParameters tilted;
    tilted.gravity = kStandardGravity * Vec3{0.8, 0.0, -0.6};
    FlowState state = startFlow(terrain, tilted, {FlowStart{{0.05, 0.05, 0.0}, 60e-9, {}}});
    constexpr int kSteps = 200;
    double last = 0.0;  // x on the ground
    bool falls = false;
    for (int k = 1; k <= kSteps && !falls; ++k) {
        state = advanceFlow(std::move(state), terrain, tilted, 0.01 * k);
        const std::vector<FlowSample> samples = sampleFlow(state, terrain, tilted);
        falls = samples.empty() || samples.front().contact == FlowContact::Air;
        last = falls ? last : samples.front().place.x;
    }
    EXPECT_TRUE(falls);
    EXPECT_NEAR(last, (0.5 + kRadius) * kSide, 0.01) << "at the edge of the disc, 2 cm before that of the square";

    std::fill(disc.rgb.begin(), disc.rgb.end(), std::uint8_t{0});
    object.looks.assign(2, StandLook{});
    for (StandLook& look : object.looks) {
        look.coverage = disc;
    }
    EXPECT_THROW((void)withoutHoles(all, object), Error) << "nothing is left";
}

TEST(FaceProperties, ScattersDropletsOverAMask)
{
    const FlowObject object = square();
    const FlowTerrain scene(flowSurface(object.vertices, object.triangles));
    Mask mask;
    mask.width = 2;
    mask.height = 4;
    mask.coverage = {0, 0, 0, 65535, 0, 0, 0, 0};  // right, second row from above
    ScatterOptions options{.count = 100};
    options.coverage = coverageOver(mask, object, scene.surface());
    for (const FlowStart& start : scatterDroplets(scene, options)) {
        EXPECT_GE(start.place.x, 0.5);
        EXPECT_GE(start.place.y, 0.5);
        EXPECT_LE(start.place.y, 0.75);
    }
    FlowObject bare = object;
    bare.uvs.clear();
    EXPECT_THROW((void)coverageOver(mask, bare, scene.surface()), Error);
}

}  // namespace
}  // namespace droplet
