// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/surface/onto.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "droplet/error.h"
#include "support/objects.h"
#include "support/surfaces.h"

namespace droplet {
namespace {

using ::testing::HasSubstr;
using testing::kExtent;
using testing::meshOf;
using testing::roundDroplet;
using testing::Sheet;
using testing::together;

const OntoOptions kPicture{.extent = {kExtent, kExtent}};

/// Point in the picture's plane at a uv.
Vec2 flatOf(Vec2 uv)
{
    return {(uv.x - 0.5) * kExtent, (0.5 - uv.y) * kExtent};
}

/// Object that is the picture's plane.
Sheet plane()
{
    return {.columns = 3, .rows = 2, .place = [](Vec2 uv) { return Vec3{flatOf(uv).x, flatOf(uv).y, 0.0}; }};
}

double turned(Vec3 a, Vec3 b)
{
    return std::atan2(length(cross(a, b)), dot(a, b));
}

/// Whether every triangle faces in the direction of its vertices' normals.
bool windsOutward(const Surface& surface)
{
    return std::all_of(surface.triangles.begin(), surface.triangles.end(), [&](const Triangle& t) {
        const Vec3 a = surface.vertices[t[0]];
        const Vec3 normal = cross(surface.vertices[t[1]] - a, surface.vertices[t[2]] - a);
        return std::all_of(t.begin(), t.end(), [&](std::uint32_t v) { return dot(normal, surface.normals[v]) > 0.0; });
    });
}

/// Volume enclosed by a closed surface, from all coordinates.
double volume(const Surface& surface)
{
    EXPECT_TRUE(isClosed(surface));
    return enclosedVolume(surface);
}

void expectRefused(const Surface& droplets, const TexturedMesh& object, const OntoOptions& options, ErrorCode code,
                   const std::string& words)
{
    try {
        (void)placeOnto(droplets, object, options);
        ADD_FAILURE() << "placed";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), code);
        EXPECT_THAT(error.what(), HasSubstr(words));
    }
}

TEST(Onto, ThePicturesPlaneChangesNothing)
{
    Surface droplets = together(roundDroplet({.inner = 1e-3, .outer = 3e-3, .centre = {-5e-3, 2e-3}}),
                                roundDroplet({.outer = 2e-3, .centre = {6e-3, -6e-3}}));
    droplets.mean_height = 0.5e-3;
    const OntoResult result = placeOnto(droplets, meshOf(plane()), kPicture);
    const Surface& surface = result.surface;
    ASSERT_NO_THROW(surface.validate());
    ASSERT_EQ(surface.vertices.size(), droplets.vertices.size());
    for (std::size_t v = 0; v < surface.vertices.size(); ++v) {
        EXPECT_LT(length(surface.vertices[v] - droplets.vertices[v]), 1e-16);
        EXPECT_LT(length(surface.normals[v] - droplets.normals[v]), 1e-13);
        EXPECT_EQ(surface.uvs[v], droplets.uvs[v]);
    }
    EXPECT_EQ(surface.triangles, droplets.triangles);
    EXPECT_EQ(surface.weld, droplets.weld);
    EXPECT_EQ(result.report.laid, 2U);
    EXPECT_NEAR(result.report.min_scale, 1.0, 1e-12);
    EXPECT_NEAR(result.report.max_scale, 1.0, 1e-12);
    EXPECT_THAT(result.report.warnings, ::testing::IsEmpty());
}

// If the object is moved, turned and scaled, so is the droplet.
TEST(Onto, FollowsTheObjectsPositionRotationAndSize)
{
    const Surface droplet = roundDroplet({.centre = {1e-3, 2e-3}});
    constexpr double kSize = 2.5;
    const auto turn = [](Vec3 a) {  // by 70° around (1, 2, 2)/3: formula of Rodrigues
        const Vec3 axis = (1.0 / 3.0) * Vec3{1, 2, 2};
        const double angle = 70.0 * std::numbers::pi / 180.0;
        return std::cos(angle) * a + std::sin(angle) * cross(axis, a) + (1.0 - std::cos(angle)) * dot(axis, a) * axis;
    };
    const Vec3 shift{0.3, -0.1, 0.2};
    Sheet sheet = plane();
    sheet.place = [&](Vec2 uv) { return shift + kSize * turn({flatOf(uv).x, flatOf(uv).y, 0.0}); };
    sheet.normal = [&](Vec2) { return turn({0, 0, 1}); };
    const OntoResult result = placeOnto(droplet, meshOf(sheet), kPicture);
    for (std::size_t v = 0; v < droplet.vertices.size(); ++v) {
        EXPECT_LT(length(result.surface.vertices[v] - (shift + kSize * turn(droplet.vertices[v]))), 1e-14);
        EXPECT_LT(length(result.surface.normals[v] - turn(droplet.normals[v])), 1e-12);
    }
    EXPECT_NEAR(result.report.min_scale, kSize, 1e-12);
    EXPECT_NEAR(result.surface.mean_height / (kSize * droplet.mean_height), 1.0, 0.05);  // for a polygon, not a disc
    EXPECT_NEAR(volume(result.surface) / (kSize * kSize * kSize * enclosedVolume(droplet)), 1.0, 1e-12);
    ASSERT_EQ(result.report.warnings.size(), 1U);
    EXPECT_THAT(result.report.warnings[0], HasSubstr("2.5 times as large"));
}

// Can of radius R around y, with the middle of the picture on top: x runs around, y along the can. The exact map is
// known.
constexpr double kCan = 8e-3;

Sheet can(std::uint32_t columns, double radius = kCan)
{
    return {.columns = columns,
            .rows = 1,
            .place =
                [=](Vec2 uv) {
                    const Vec2 p = flatOf(uv);
                    return Vec3{radius * std::sin(p.x / radius), p.y, radius * std::cos(p.x / radius)};
                },
            .normal =
                [=](Vec2 uv) {
                    const Vec2 p = flatOf(uv);
                    return Vec3{std::sin(p.x / radius), 0.0, std::cos(p.x / radius)};
                }};
}

// Errors of positions and normals fall with the square of the facets' size; the base lies on the facets. Measured
// errors of positions with 10, 20, 40 facets: 2.1e-5, 5.3e-6, 1.3e-6 m.
TEST(Onto, FollowsACanToSecondOrder)
{
    const Surface droplet = roundDroplet({.outer = 7e-3, .height = 1.5e-3, .rings = 16, .segments = 48});
    double place_before = 1.0;
    double normal_before = 1.0;
    for (const std::uint32_t columns : {10U, 20U, 40U}) {
        SCOPED_TRACE(columns);
        const OntoResult result = placeOnto(droplet, meshOf(can(columns)), kPicture);
        const Surface& surface = result.surface;
        const double facet = kExtent / columns;
        double place = 0.0;
        double normal = 0.0;
        for (std::size_t v = 0; v < droplet.vertices.size(); ++v) {
            const Vec3 p = droplet.vertices[v];
            const Vec3 n = droplet.normals[v];
            const double c = std::cos(p.x / kCan);
            const double s = std::sin(p.x / kCan);
            place = std::max(place, length(surface.vertices[v] - Vec3{(kCan + p.z) * s, p.y, (kCan + p.z) * c}));
            // Around the can the layer at height z is longer by 1 + z/R, so slopes are smaller.
            const double around = n.x / (1.0 + p.z / kCan);
            const Vec3 exact = Vec3{c * around + s * n.z, n.y, c * n.z - s * around};
            normal = std::max(normal, turned(surface.normals[v], exact));
            if (p.z == 0.0) {
                const double radius = std::hypot(surface.vertices[v].x, surface.vertices[v].z);
                EXPECT_LE(radius, kCan * (1.0 + 1e-12));
                EXPECT_GE(radius, kCan * std::cos(0.5 * facet / kCan) * (1.0 - 1e-12));
            }
            if (n == Vec3{0, 0, -1}) {
                EXPECT_LT(turned(surface.normals[v], Vec3{-s, 0.0, -c}), 0.1 * facet / kCan);
            }
        }
        EXPECT_LT(place, place_before / 3.5);
        EXPECT_LT(normal, normal_before / (columns == 10 ? 1.0 : 3.0));
        place_before = place;
        normal_before = normal;
        EXPECT_TRUE(windsOutward(surface));
        EXPECT_THAT(result.report.warnings, ::testing::IsEmpty());
    }
}

// A layer of thickness z on a cylinder has the volume ∫(z + z²/2R): πa²(h/2 + h²/6R) under a paraboloid. Measured
// errors: 1.5, 0.4, 0.1 %.
TEST(Onto, DropletOnACanHasItsVolume)
{
    constexpr double kRadius = 7e-3;
    constexpr double kHeight = 1.5e-3;
    const double exact = std::numbers::pi * kRadius * kRadius * (kHeight / 2.0 + kHeight * kHeight / (6.0 * kCan));
    double before = 1.0;
    for (const std::uint32_t rings : {8U, 16U, 32U}) {
        const Surface droplet =
            roundDroplet({.outer = kRadius, .height = kHeight, .rings = rings, .segments = 4 * rings});
        const Surface surface = placeOnto(droplet, meshOf(can(5 * rings)), kPicture).surface;
        const double error = std::abs(volume(surface) / exact - 1.0);
        EXPECT_LT(error, before / (rings == 8 ? 1.0 : 3.5));
        before = error;
        const Topology t = topology(surface);
        EXPECT_TRUE(t.closed);
        EXPECT_EQ(t.euler, 2);
        EXPECT_EQ(t.components, 1U);
    }
    EXPECT_LT(before, 1.5e-3);
}

// Between its vertices the base leaves the object: an edge of length ℓ by at most ℓθ/4, where facets meet at an angle
// θ.
TEST(Onto, BaseLeavesTheObjectOnlyAtItsEdges)
{
    constexpr std::uint32_t kColumns = 10;
    constexpr double kTurn = kExtent / kColumns / kCan;  // angle between facets
    const Surface droplet = roundDroplet({.outer = 7e-3, .rings = 16, .segments = 48});
    const Surface surface = placeOnto(droplet, meshOf(can(kColumns)), kPicture).surface;
    double worst = 0.0;
    for (const Triangle& t : surface.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = t[k];
            const std::uint32_t b = t[(k + 1) % 3];
            if (droplet.vertices[a].z != 0.0 || droplet.vertices[b].z != 0.0) {
                continue;
            }
            const double edge = length(surface.vertices[b] - surface.vertices[a]);
            for (const double share : {0.0, 0.25, 0.5, 0.75}) {
                const Vec3 p = (1.0 - share) * surface.vertices[a] + share * surface.vertices[b];
                const double facet = (std::floor(std::atan2(p.x, p.z) / kTurn) + 0.5) * kTurn;
                const double below = kCan * std::cos(0.5 * kTurn) - (p.x * std::sin(facet) + p.z * std::cos(facet));
                EXPECT_GT(below, -1e-15);
                EXPECT_LT(below, share == 0.0 ? 1e-15 : 0.25 * edge * kTurn);
                worst = std::max(worst, below);
            }
        }
    }
    EXPECT_GT(worst, 0.1e-3 * kTurn);  // there are such edges
}

TEST(Onto, TurnedTextureTurnsTheDroplet)
{
    const Surface droplet = roundDroplet({.outer = 2e-3, .centre = {5e-3, 1e-3}});
    Sheet sheet = plane();  // x of the picture runs along y in space
    sheet.place = [](Vec2 uv) { return Vec3{-flatOf(uv).y, flatOf(uv).x, 0.0}; };
    const OntoResult result = placeOnto(droplet, meshOf(sheet), kPicture);
    for (std::size_t v = 0; v < droplet.vertices.size(); ++v) {
        const Vec3 p = droplet.vertices[v];
        EXPECT_LT(length(result.surface.vertices[v] - Vec3{-p.y, p.x, p.z}), 1e-16);
    }
    EXPECT_EQ(result.report.mirrored, 0U);
}

TEST(Onto, QuadrilateralsStayAlsoOnMirroredCharts)
{
    Surface droplet = testing::asOnePart(roundDroplet({.outer = 2e-3, .centre = {5e-3, 1e-3}}));
    joinTriangles(droplet);
    ASSERT_GT(droplet.parts[0].quads, 0U);
    for (const bool is_mirrored : {false, true}) {
        Sheet sheet = plane();
        if (is_mirrored) {
            sheet.place = [](Vec2 uv) { return Vec3{-flatOf(uv).x, flatOf(uv).y, 0.0}; };
            sheet.turned = true;
        }
        const Surface laid = placeOnto(droplet, meshOf(sheet), kPicture).surface;
        EXPECT_NO_THROW(laid.validate());
        EXPECT_TRUE(windsOutward(laid));
        ASSERT_EQ(laid.parts.size(), 1U);
        EXPECT_EQ(laid.parts[0].quads, droplet.parts[0].quads);
    }
}

TEST(Onto, TrianglesOnMirroredChartsAreReportedAndWindOutward)
{
    const Surface droplet = roundDroplet({.outer = 2e-3, .centre = {5e-3, 1e-3}});
    Sheet sheet = plane();
    sheet.place = [](Vec2 uv) { return Vec3{-flatOf(uv).x, flatOf(uv).y, 0.0}; };
    sheet.turned = true;
    const OntoResult result = placeOnto(droplet, meshOf(sheet), kPicture);
    EXPECT_EQ(result.report.mirrored, 1U);
    EXPECT_EQ(result.report.flipped_charts, 1U);
    EXPECT_THAT(result.report.warnings, ::testing::ElementsAre(HasSubstr("mirrored")));
    EXPECT_NEAR(volume(result.surface) / enclosedVolume(droplet), 1.0, 1e-12);
    EXPECT_TRUE(windsOutward(result.surface));
    for (std::size_t v = 0; v < droplet.vertices.size(); ++v) {
        const Vec3 n = droplet.normals[v];
        EXPECT_LT(length(result.surface.normals[v] - Vec3{-n.x, n.y, n.z}), 1e-12);
    }
}

// The droplet rises in the direction of the object's normals; the winding of triangles does not matter.
TEST(Onto, NormalsDefineTheOutside)
{
    const Surface droplet = roundDroplet({.outer = 2e-3});
    Sheet sheet = plane();
    sheet.normal = [](Vec2) { return Vec3{0.0, 0.0, -1.0}; };
    for (const bool turned_triangles : {false, true}) {
        sheet.turned = turned_triangles;
        const OntoResult result = placeOnto(droplet, meshOf(sheet), kPicture);
        EXPECT_EQ(result.report.mirrored, 1U);  // from below, the picture is mirrored
        EXPECT_GT(volume(result.surface), 0.0);
        EXPECT_TRUE(windsOutward(result.surface));
        EXPECT_LT(result.surface.vertices[0].z, -0.5e-3);
    }
}

TEST(Onto, TheFirstOfOverlappingChartsIsUsedAndReported)
{
    const Surface droplet = roundDroplet({.outer = 2e-3});
    Sheet upper = plane();
    upper.columns = 5;
    upper.place = [](Vec2 uv) { return Vec3{flatOf(uv).x, flatOf(uv).y, 1.0}; };
    const TexturedMesh a = meshOf(plane());
    const TexturedMesh b = meshOf(upper);
    const OntoResult below = placeOnto(droplet, together(a, b), kPicture);
    const OntoResult above = placeOnto(droplet, together(b, a), kPicture);
    EXPECT_LT(below.surface.vertices[0].z, 0.1);
    EXPECT_GT(above.surface.vertices[0].z, 0.9);
    for (const OntoResult* result : {&below, &above}) {
        EXPECT_EQ(result->report.overlapping_charts, 1U);
        EXPECT_EQ(result->report.laid, 1U);
        EXPECT_THAT(result->report.warnings, ::testing::ElementsAre(HasSubstr("overlap")));
    }
}

// The object ends at uv.x = 0.6, as by the alpha of its texture. A droplet that lies over the end in part is left out,
// and so is one beyond it; where another chart is there below the hole, a droplet lies on that.
TEST(Onto, NoDropletLiesWhereTheObjectIsCutOut)
{
    const Surface kept = roundDroplet({.outer = 2e-3, .centre = {-5e-3, 0.0}});
    const Surface partly = roundDroplet({.outer = 2e-3, .centre = {0.1 * kExtent + 1e-3, 5e-3}});
    const Surface beyond = roundDroplet({.outer = 2e-3, .centre = {6e-3, -5e-3}});
    const TexturedMesh object = meshOf(plane());
    OntoOptions cut = kPicture;
    cut.is_there = [&](std::uint32_t triangle, Vec2 uv) { return triangle >= object.triangles.size() || uv.x < 0.6; };
    const OntoResult result = placeOnto(together(together(beyond, partly), kept), object, cut);
    EXPECT_EQ(result.report.laid, 1U);
    EXPECT_EQ(result.report.cut_out, 2U);
    EXPECT_EQ(result.report.outside, 0U);
    EXPECT_EQ(result.surface.vertices.size(), kept.vertices.size());
    EXPECT_THAT(result.report.warnings, ::testing::ElementsAre(HasSubstr("2 droplets left out: over a place that the "
                                                                         "alpha of the object's texture cuts out")));
    expectRefused(beyond, object, cut, ErrorCode::NoSuchDroplet, "1 over a place that the alpha of its texture cuts");

    Sheet below = plane();
    below.columns = 5;
    below.place = [](Vec2 uv) { return Vec3{flatOf(uv).x, flatOf(uv).y, -1.0}; };
    const OntoResult second = placeOnto(beyond, together(object, meshOf(below)), cut);
    EXPECT_EQ(second.report.laid, 1U);
    EXPECT_LT(second.surface.vertices[0].z, -0.9);
}

// A leaf whose back has the positions and uv of its front, triangle by triangle: normals must not cancel.
TEST(Onto, ALeafsBackDoesNotDisturbItsFront)
{
    const Surface droplet = roundDroplet({.outer = 2e-3});
    Sheet back = plane();
    back.turned = true;
    back.normal = [](Vec2) { return Vec3{0.0, 0.0, -1.0}; };
    TexturedMesh leaf = together(meshOf(plane()), meshOf(back));
    const std::size_t half = leaf.triangles.size() / 2;
    std::vector<Triangle> woven;
    for (std::size_t t = 0; t < half; ++t) {
        woven.push_back(leaf.triangles[t]);
        woven.push_back(leaf.triangles[half + t]);
    }
    leaf.triangles = woven;
    const OntoResult result = placeOnto(droplet, leaf, kPicture);
    for (std::size_t v = 0; v < droplet.vertices.size(); ++v) {
        EXPECT_LT(length(result.surface.vertices[v] - droplet.vertices[v]), 1e-16);
        EXPECT_LT(length(result.surface.normals[v] - droplet.normals[v]), 1e-12);
    }
    EXPECT_EQ(result.report.overlapping_charts, 1U);
    EXPECT_EQ(result.report.mirrored, 0U);
}

/// Two halves of the picture's plane that share no edge in space.
TexturedMesh halves()
{
    Sheet left = plane();
    left.uv_end.x = 0.5;
    Sheet right = plane();
    right.uv_begin.x = 0.5;
    right.place = [](Vec2 uv) { return Vec3{flatOf(uv).x, flatOf(uv).y, 1.0}; };
    return together(meshOf(left), meshOf(right));
}

TEST(Onto, DropletsBesideOrAcrossChartsAreLeftOut)
{
    const Surface left = roundDroplet({.outer = 2e-3, .centre = {-5e-3, 0}});
    const Surface middle = roundDroplet({.outer = 2e-3, .centre = {1e-3, 0}});
    const Surface right = roundDroplet({.outer = 2e-3, .centre = {5e-3, 0}});
    const Surface off = roundDroplet({.outer = 2e-3, .centre = {0, 9e-3}});
    const OntoResult result = placeOnto(together(together(middle, left), together(off, right)), halves(), kPicture);
    EXPECT_EQ(result.report.laid, 2U);
    EXPECT_EQ(result.report.across, 1U);
    EXPECT_EQ(result.report.outside, 1U);
    EXPECT_EQ(topology(result.surface).components, 2U);
    EXPECT_EQ(result.surface.vertices.size(), left.vertices.size() + right.vertices.size());
    EXPECT_LT(length(result.surface.vertices[0] - left.vertices[0]), 1e-16);
    EXPECT_NEAR(result.surface.vertices.back().z, 1.0, 1e-12);
    EXPECT_NEAR(volume(result.surface) / (2.0 * enclosedVolume(left)), 1.0, 1e-9);
    EXPECT_THAT(result.report.warnings,
                ::testing::ElementsAre(HasSubstr("not completely on a chart"), HasSubstr("across a seam")));

    expectRefused(together(middle, off), halves(), kPicture, ErrorCode::NoSuchDroplet, "none of 2 droplets");
}

// Round-off must not matter at the border of the picture and the chart, and on edges between triangles.
TEST(Onto, EdgesBelongToTheChart)
{
    const double radius = 0.5 * kExtent;
    const OntoResult result = placeOnto(roundDroplet({.outer = radius}), meshOf(plane()), kPicture);
    EXPECT_EQ(result.report.laid, 1U);
    for (const double centre : {-radius / 2, radius / 2}) {
        const Surface touching = roundDroplet({.outer = radius / 2, .centre = {centre, 0}});
        EXPECT_EQ(placeOnto(touching, halves(), kPicture).report.laid, 1U);
    }
}

// Blender's grids repeat corners whose uv differs in the last bits.
TEST(Onto, LastBitsOfUvAreNoSeam)
{
    const auto laid = [](double apart) {
        Sheet left = plane();
        left.uv_end.x = 0.5;
        Sheet right = plane();
        right.uv_begin.x = 0.5;
        TexturedMesh object = meshOf(left);
        const std::size_t first = object.vertices.size();
        object = together(std::move(object), meshOf(right));
        for (std::size_t v = first; v < object.uvs.size(); ++v) {
            if (object.uvs[v].x == 0.5) {
                object.uvs[v] = {0.5 + apart, object.uvs[v].y - 0.7 * apart};
            }
        }
        const Surface beside = roundDroplet({.outer = 2e-3, .centre = {5e-3, 0}});
        return placeOnto(together(roundDroplet({.outer = 2e-3}), beside), object, kPicture).report.laid;
    };
    EXPECT_EQ(laid(0.0), 2U);
    EXPECT_EQ(laid(3e-8), 2U);
    EXPECT_EQ(laid(-3e-7), 2U);
    EXPECT_EQ(laid(1e-4), 1U);
}

// x is stretched by 1 + 4u, in facets. Heights must follow √(1 + 4u) without steps at the facets.
// Measured errors: 1.6e-3, 4.3e-4, 1.1e-4; the stretch of single facets has an error of 2 % with 32 columns.
TEST(Onto, HeightsFollowTheLocalStretchSmoothly)
{
    const Surface droplet = roundDroplet({.outer = 5e-3, .rings = 20, .segments = 60});
    double before = 1.0;
    for (const std::uint32_t columns : {8U, 16U, 32U}) {
        Sheet sheet = plane();
        sheet.columns = columns;
        sheet.rows = columns;
        sheet.place = [](Vec2 uv) { return Vec3{kExtent * (uv.x + 2.0 * uv.x * uv.x), flatOf(uv).y, 0.0}; };
        const Surface surface = placeOnto(droplet, meshOf(sheet), kPicture).surface;
        double worst = 0.0;
        for (std::size_t v = 0; v < droplet.vertices.size(); ++v) {
            const double z = droplet.vertices[v].z;
            if (z > 0.0) {
                worst = std::max(worst,
                                 std::abs(surface.vertices[v].z / z / std::sqrt(1.0 + 4.0 * droplet.uvs[v].x) - 1.0));
            }
        }
        EXPECT_LT(worst, before / (columns == 8 ? 1.0 : 3.5)) << columns;
        before = worst;
    }
    EXPECT_LT(before, 1e-3);
}

// On a plane stretched in one direction the map is affine, and normals and contact angles are known.
TEST(Onto, AnisotropicStretchTiltsNormals)
{
    Surface droplet = roundDroplet({.outer = 4e-3});
    droplet.contact_angle.assign(droplet.vertices.size(), 0.0F);
    const std::size_t rim = droplet.vertices.size() / 2 - 1;
    droplet.contact_angle[rim] = 0.4F;
    Sheet sheet = plane();
    sheet.place = [](Vec2 uv) { return Vec3{2.25 * flatOf(uv).x, flatOf(uv).y, 0.0}; };
    const Surface surface = placeOnto(droplet, meshOf(sheet), kPicture).surface;
    for (std::size_t v = 0; v < droplet.vertices.size(); ++v) {
        const Vec3 p = droplet.vertices[v];
        const Vec3 n = droplet.normals[v];
        EXPECT_LT(length(surface.vertices[v] - Vec3{2.25 * p.x, p.y, 1.5 * p.z}), 1e-15);
        const Vec3 cofactors{1.5 * n.x, 2.25 * 1.5 * n.y, 2.25 * n.z};
        EXPECT_LT(turned(surface.normals[v], cofactors), 1e-12);
        const double angle = v == rim ? std::acos(cofactors.z / length(cofactors)) : 0.0;
        EXPECT_NEAR(surface.contact_angle[v], angle, 1e-6);
    }
}

// Facets of a can with flat normals: vertices are separate, but have one position in space and uv.
TEST(Onto, FacetedNormalsAreSmoothed)
{
    const Surface droplet = roundDroplet({.outer = 5e-3});
    const TexturedMesh smooth = meshOf(can(40));
    TexturedMesh faceted;
    for (const Triangle& t : smooth.triangles) {
        const Vec3 a = smooth.vertices[t[0]];
        const Vec3 normal = cross(smooth.vertices[t[1]] - a, smooth.vertices[t[2]] - a);
        const auto first = static_cast<std::uint32_t>(faceted.vertices.size());
        for (const std::uint32_t v : t) {
            faceted.vertices.push_back(smooth.vertices[v]);
            faceted.normals.push_back((1.0 / length(normal)) * normal);
            faceted.uvs.push_back(smooth.uvs[v]);
        }
        faceted.triangles.push_back({first, first + 1, first + 2});
    }
    const OntoResult result = placeOnto(droplet, faceted, kPicture);
    const Surface wanted = placeOnto(droplet, smooth, kPicture).surface;
    EXPECT_EQ(result.report.laid, 1U);
    const double facet_angle = kExtent / 40 / kCan;
    for (std::size_t v = 0; v < droplet.vertices.size(); ++v) {
        EXPECT_LT(turned(result.surface.normals[v], wanted.normals[v]), 0.3 * facet_angle);
    }
}

TEST(Onto, DropletsThatWouldFoldAreLeftOut)
{
    // Inside a tube the layer shrinks by 1 − z/R, so it folds if the droplet is higher than the tube's radius.
    constexpr double kTube = 4e-3;
    Sheet tube = can(80, kTube);
    tube.place = [](Vec2 uv) {
        const Vec2 p = flatOf(uv);
        return Vec3{kTube * std::sin(p.x / kTube), p.y, -kTube * std::cos(p.x / kTube)};
    };
    tube.normal = [](Vec2 uv) { return Vec3{-std::sin(flatOf(uv).x / kTube), 0.0, std::cos(flatOf(uv).x / kTube)}; };
    const Surface low = roundDroplet({.outer = 2e-3, .height = 1e-3, .centre = {-3e-3, 0}});
    const Surface high = roundDroplet({.outer = 2e-3, .height = 4.5e-3, .centre = {3e-3, 0}});
    const OntoResult result = placeOnto(together(low, high), meshOf(tube), kPicture);
    EXPECT_EQ(result.report.laid, 1U);
    EXPECT_EQ(result.report.folded, 1U);
    EXPECT_THAT(result.report.warnings, ::testing::ElementsAre(HasSubstr("hollow")));
    expectRefused(high, meshOf(tube), kPicture, ErrorCode::NoSuchDroplet, "1 too high");
}

TEST(Onto, TrianglesWithoutAreaAreIgnored)
{
    TexturedMesh object = meshOf(plane());
    object.triangles.insert(object.triangles.begin(), {0, 1, 1});
    object.triangles.insert(object.triangles.begin(), {0, 1, 2});  // in line
    EXPECT_EQ(placeOnto(roundDroplet(), object, kPicture).report.laid, 1U);
    object.triangles = {{0, 1, 2}};
    expectRefused(roundDroplet(), object, kPicture, ErrorCode::InvalidInput, "area");
    EXPECT_THROW((void)metresPerUv(object), Error);
}

// A droplet of many vertices, with one and several threads.
TEST(Onto, SameBitsAtAnyNumberOfThreads)
{
    const Surface droplet = roundDroplet({.outer = 8e-3, .rings = 100, .segments = 200});
    const auto placed = [&] { return placeOnto(droplet, meshOf(can(50)), kPicture).surface; };
    const Surface parallel = placed();
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const Surface sequential = placed();
    EXPECT_EQ(parallel.vertices, sequential.vertices);
    EXPECT_EQ(parallel.normals, sequential.normals);
    EXPECT_EQ(parallel.triangles, sequential.triangles);
}

TEST(Onto, MetresPerUvMatchTheObject)
{
    EXPECT_NEAR(metresPerUv(meshOf(plane())), kExtent, 1e-15);
    Sheet oblong = plane();
    oblong.place = [](Vec2 uv) { return Vec3{4.0 * uv.x, 9.0 * uv.y, 0.0}; };
    EXPECT_NEAR(metresPerUv(meshOf(oblong)), 6.0, 1e-12);
    // A picture with that aspect and √a times that width has scale 1.
    const double width = metresPerUv(meshOf(oblong)) * std::sqrt(4.0 / 9.0);
    Surface droplet = roundDroplet();
    EXPECT_NEAR(placeOnto(droplet, meshOf(oblong), {.extent = {width, width * 9.0 / 4.0}}).report.max_scale, 1.0,
                1e-12);
    // A lid with less area, unwrapped small, does not change the median.
    Sheet lid = plane();
    lid.uv_end = {0.01, 0.01};
    lid.place = [](Vec2 uv) { return Vec3{300.0 * uv.x, 300.0 * uv.y, 5.0}; };
    EXPECT_NEAR(metresPerUv(together(meshOf(oblong), meshOf(lid))), 6.0, 1e-12);
}

TEST(Onto, RefusesBrokenArguments)
{
    const Surface droplet = roundDroplet();
    const TexturedMesh sound = meshOf(plane());
    expectRefused(droplet, sound, {.extent = {0.0, 1.0}}, ErrorCode::InvalidArgument, "extent");
    expectRefused({}, sound, kPicture, ErrorCode::InvalidArgument, "surface.triangles");
    expectRefused(droplet, {}, kPicture, ErrorCode::InvalidArgument, "object.triangles");
    TexturedMesh broken = sound;
    broken.uvs[3].x = std::nan("");
    expectRefused(droplet, broken, kPicture, ErrorCode::InvalidArgument, "object.uvs[3]");
    broken = sound;
    broken.triangles[2][1] = 1000;
    expectRefused(droplet, broken, kPicture, ErrorCode::InvalidArgument, "object.triangles[2]");
    broken = sound;
    broken.normals[1] = {0, 0, 0.5};
    expectRefused(droplet, broken, kPicture, ErrorCode::InvalidArgument, "object.normals[1]");
    broken = sound;
    broken.vertices.pop_back();
    expectRefused(droplet, broken, kPicture, ErrorCode::InvalidArgument, "equally many");
}

}  // namespace
}  // namespace droplet
