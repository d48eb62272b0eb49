// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/surface/plate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "droplet/droplet.h"
#include "droplet/error.h"
#include "droplet/mesh/triangulate.h"
#include "droplet/shape/solve.h"
#include "droplet/surface/loft.h"
#include "droplet/units.h"
#include "support/domains.h"
#include "support/zoo.h"

namespace droplet {
namespace {

using testing::domainOf;
using testing::ellipseLoop;
using ::testing::HasSubstr;

std::vector<CapillarySurface> solved(const Domain& domain, double height)
{
    SolveOptions options;
    options.fill = {FillBy::Height, height, FillSharing::Each};
    return solve(triangulate(domain, {.triangles = 2500, .edge = {}}), options).droplets;
}

/// Area of the plate around a surface, by its definition; corners have 8 edges.
double plateArea(const Surface& liquid, double margin)
{
    const auto size = [&](double Vec3::*axis) {
        const auto [min, max] = std::minmax_element(liquid.vertices.begin(), liquid.vertices.end(),
                                                    [&](const Vec3& a, const Vec3& b) { return a.*axis < b.*axis; });
        return (*max).*axis - (*min).*axis;
    };
    const double width = size(&Vec3::x);
    const double height = size(&Vec3::y);
    return width * height + 2.0 * margin * (width + height) +
           4.0 * 8.0 * 0.5 * margin * margin * std::sin(std::numbers::pi / 16.0);
}

// However many droplets there are, and whatever holes they have, the solid is a ball with bumps.
TEST(Plate, MakesOneBallOfAllDroplets)
{
    for (const auto& [name, domain] : testing::zoo()) {
        SCOPED_TRACE(name);
        const std::vector<CapillarySurface> surfaces = solved(domain, 1e-3);
        const Surface open = loft(surfaces, {.open = true, .extent = domain.extent});
        const double thickness = 0.05 * domain.extent.x;
        const Surface solid = onPlate(surfaces, {thickness, domain.extent});
        ASSERT_NO_THROW(solid.validate());
        const Topology t = topology(solid);
        EXPECT_TRUE(t.closed);
        EXPECT_EQ(t.components, 1U);
        EXPECT_EQ(t.euler, 2);
        const double plate = thickness * plateArea(open, 2.0 * thickness);
        EXPECT_NEAR(enclosedVolume(solid), enclosedVolume(open) + plate, 1e-9 * plate);
        EXPECT_TRUE(std::equal(open.triangles.begin(), open.triangles.end(), solid.triangles.begin()));
        EXPECT_TRUE(std::equal(open.vertices.begin(), open.vertices.end(), solid.vertices.begin()));
        ASSERT_EQ(solid.parts.size(), 1U);
        for (std::size_t i = open.triangles.size(); i < solid.triangles.size(); ++i) {
            const auto& [a, b, c] = solid.triangles[i];
            const Vec3 across = cross(solid.vertices[b] - solid.vertices[a], solid.vertices[c] - solid.vertices[a]);
            ASSERT_GT(length(across), 0.0);
            for (const std::uint32_t v : {a, b, c}) {
                ASSERT_GT(dot(across, solid.normals[v]), 0.99 * length(across)) << "triangle " << i;
            }
        }
    }
}

// As a part of its own, it changes nothing of the droplets.
TEST(Plate, CanBeABodyBelowDroplets)
{
    for (const auto& [name, domain] : testing::zoo()) {
        SCOPED_TRACE(name);
        const std::vector<CapillarySurface> surfaces = solved(domain, 1e-3);
        const Surface droplets = loft(surfaces, {.extent = domain.extent});
        const double thickness = 0.05 * domain.extent.x;
        const Surface both = withPlate(droplets, 7, {thickness, domain.extent});
        ASSERT_NO_THROW(both.validate());
        const Topology before = topology(droplets);
        const Topology after = topology(both);
        EXPECT_TRUE(after.closed);
        EXPECT_EQ(after.components, before.components + 1);
        EXPECT_EQ(after.euler, before.euler + 2);
        EXPECT_EQ(both.parts.back().droplet, 7U);
        const double plate = thickness * plateArea(droplets, 2.0 * thickness);
        EXPECT_NEAR(enclosedVolume(extract(both, {both.parts.size() - 1})), plate, 1e-9 * plate);
        EXPECT_TRUE(std::equal(droplets.triangles.begin(), droplets.triangles.end(), both.triangles.begin()));
        EXPECT_TRUE(std::equal(droplets.vertices.begin(), droplets.vertices.end(), both.vertices.begin()));
        EXPECT_EQ(both.parts.back().first_vertex, droplets.vertices.size());
    }
}

// A sheet leans out over its rim; the plate is wider than that.
TEST(Plate, CarriesWhatLeansOut)
{
    DropletOptions options;
    options.mesh.triangles = 2000;
    options.solve.fill = {FillBy::ContactAngle, 120.0 * kDegree, FillSharing::Each};
    const Droplet droplet = makeDroplet(domainOf(ellipseLoop(1e-3, 1e-3)), options);
    ASSERT_FALSE(droplet.solution.droplets.front().isHeightField());
    const Surface solid = onPlate(droplet.solution.droplets, {0.1e-3, droplet.domain.extent});
    EXPECT_TRUE(topology(solid).closed);
    double liquid = 0.0;
    double plate = 0.0;
    for (const Vec3& p : solid.vertices) {
        (p.z > 0.0 ? liquid : plate) = std::max(p.z > 0.0 ? liquid : plate, p.x);
    }
    EXPECT_GT(liquid, 1.05e-3);
    EXPECT_NEAR(plate, liquid + 0.2e-3, 1e-12);
}

TEST(Plate, RefusesWhatCannotLieOnIt)
{
    const Domain domain = domainOf(ellipseLoop(1, 1));
    std::vector<CapillarySurface> surfaces = solved(domain, 0.1);
    EXPECT_THROW(onPlate(surfaces, {0.0, {2, 2}}), Error);
    EXPECT_THROW(onPlate(surfaces, {0.1, {0, 2}}), Error);
    EXPECT_THROW(withPlate(loft(surfaces, {.extent = {2, 2}}), 1, {0.0, {2, 2}}), Error);
    EXPECT_THROW(withPlate(Surface(), 0, {0.1, {2, 2}}), Error);
    surfaces.push_back(surfaces.front());  // their rims are the same
    EXPECT_THROW(onPlate(surfaces, {0.1, {2, 2}}), Error);
    for (Vec3& p : surfaces.front().vertices) {
        p.z += 0.1;
    }
    surfaces.pop_back();
    EXPECT_THROW(onPlate(surfaces, {0.1, {2, 2}}), Error);
}

PlanarMesh rectangle(double width, double height)
{
    return {{{0, 0}, {width, 0}, {width, height}, {0, height}}, {}, {0, 4}, {}};
}

TEST(Plate, WarnsOfWhatAPrinterLoses)
{
    // Strokes 2 mm wide and 0.5 mm high; then one too low, and one too narrow.
    const PlanarMesh wide = rectangle(10e-3, 2e-3);
    const PlanarMesh narrow = rectangle(10e-3, 0.35e-3);
    ShapeFigures good;
    good.volume = 1e-9;
    good.height_max = 0.5e-3;
    ShapeFigures low = good;
    low.height_max = 0.1e-3;
    const auto of = [](const std::vector<PlanarMesh>& footprints, const std::vector<ShapeFigures>& droplets,
                       double thickness) {
        return printWarning(footprints, droplets, {thickness, {20e-3, 10e-3}}).value_or("");
    };
    EXPECT_EQ(of({wide}, {good}, 1e-3), "");
    EXPECT_EQ(of({wide}, {good}, 4.9e-3), "");
    EXPECT_THAT(of({wide}, {good}, 5.1e-3), HasSubstr("wider than the picture of 20 mm"));
    EXPECT_THAT(of({wide}, {good}, 0.3e-3), HasSubstr("the plate is 0.3 mm thick"));
    EXPECT_THAT(of({wide, wide}, {good, low}, 1e-3), HasSubstr("1 of 2 droplets is lower"));
    EXPECT_THAT(of({wide, narrow, narrow}, {good, good, good}, 1e-3),
                HasSubstr("2 of 3 droplets are narrower than a nozzle of 0.4 mm on 7 mm²"));
    EXPECT_THAT(of({narrow, wide}, {low, good}, 0.3e-3),
                HasSubstr("; 1 of 2 droplets is lower than a layer of 0.2 mm; 1"));
}

}  // namespace
}  // namespace droplet
