// SPDX-License-Identifier: GPL-3.0-or-later
// All stages together: exact shapes, balances of forces, relations between runs.
#include "droplet/droplet.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numbers>
#include <span>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "droplet/colours/colour_domain.h"
#include "droplet/error.h"
#include "droplet/io/output.h"
#include "droplet/units.h"
#include "shape/recovered_normals.h"
#include "support/colour_pictures.h"
#include "support/heights.h"
#include "support/masks.h"
#include "support/sound.h"

namespace droplet {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using testing::disc;
using ::testing::ElementsAre;
using testing::expectSound;
using testing::hardMask;
using ::testing::HasSubstr;
using testing::heightsOf;
using testing::Inside;
using ::testing::IsEmpty;
using testing::rectangle;
using testing::smoothMask;

constexpr double kPi = std::numbers::pi;

/// A ring, an inclined bar and a small disc on 96 × 72 pixels, without any symmetry.
Inside scene(double scale = 1.0)
{
    const Inside outer = disc(scale * Vec2{34.0, 38.0}, scale * 25.0);
    const Inside hole = disc(scale * Vec2{28.0, 42.0}, scale * 8.0);
    const Inside bar = rectangle(scale * Vec2{76.0, 22.0}, scale * Vec2{13.0, 8.0}, 0.4);
    const Inside small = disc(scale * Vec2{78.0, 56.0}, scale * 7.0);
    return [=](Vec2 p) { return (outer(p) && !hole(p)) || bar(p) || small(p); };
}

Mask sceneMask(int scale = 1)
{
    return smoothMask(96 * scale, 72 * scale, scene(scale));
}

/// Options for most tests: few triangles, no gravity, pixels of a fifth of a millimetre.
DropletOptions plain()
{
    DropletOptions options;
    options.trace.pixel_size = 0.2 * kMillimetre;
    options.mesh.triangles = 6000;
    options.solve.gravity = 0.0;
    options.solve.model = Model::Linear;
    return options;
}

DropletOptions filled(FillBy by, double amount, FillSharing sharing)
{
    DropletOptions options = plain();
    options.solve.gravity = kStandardGravity;
    options.solve.fill = {by, amount, sharing};
    return options;
}

std::vector<double> heights(const Droplet& droplet)
{
    std::vector<double> all;
    for (const CapillarySurface& field : droplet.solution.droplets) {
        const std::vector<double> own = heightsOf(field);
        all.insert(all.end(), own.begin(), own.end());
    }
    return all;
}

std::string glb(const Droplet& droplet)
{
    std::ostringstream out;
    writeSurface(droplet.surface, out, Format::Glb);
    return out.str();
}

std::vector<double> scaled(double factor, std::vector<double> values)
{
    for (double& v : values) {
        v *= factor;
    }
    return values;
}

void expectRelative(double found, double wanted, double tolerance, const char* what)
{
    EXPECT_NEAR(found / wanted, 1.0, tolerance) << what;
}

// A disc's shape is known in closed form.

TEST(Droplet, DiscIsTheParaboloidOfItsContactAngle)
{
    constexpr double kRadius = 40.0;  // [px]
    const DropletOptions options = plain();
    const Droplet droplet = makeDroplet(smoothMask(96, 90, disc({46.3, 44.9}, kRadius)), options);
    const double radius = kRadius * *options.trace.pixel_size;
    const double slope = std::tan(40.0 * kDegree);
    // With 256 levels of coverage the rim is exact to a few 1/1000 px, 1e-4 of the radius. 6000 triangles have h/R =
    // 1/31, and the volume of linear elements is too small by about h²/R² = 1e-3.
    EXPECT_THAT(droplet.warnings, IsEmpty());
    expectSound(droplet);
    expectRelative(droplet.total.footprint_area, kPi * radius * radius, 5e-4, "area");
    expectRelative(droplet.total.rim_length, 2.0 * kPi * radius, 5e-4, "rim length");
    expectRelative(droplet.total.volume, kPi * std::pow(radius, 3) * slope / 4.0, 2e-3, "volume");
    expectRelative(droplet.total.height_max, radius * slope / 2.0, 2e-3, "height");
    expectRelative(droplet.solution.droplets[0].pressure, 2.0 * 0.0728 * slope / radius, 2e-3, "pressure");
    const double paraboloid =
        kPi * radius * radius * (2.0 / 3.0) * (std::pow(1.0 + slope * slope, 1.5) - 1.0) / (slope * slope);
    expectRelative(droplet.total.liquid_area, paraboloid, 2e-3, "area of the liquid's surface");
    expectRelative(droplet.total.surface_energy, 0.0728 * paraboloid, 2e-3, "energy");
    EXPECT_EQ(droplet.total.gravity_energy, 0.0);
}

TEST(Droplet, DiscUnderGravityIsTheBesselShape)
{
    constexpr double kRadius = 40.0;
    DropletOptions options = plain();
    const double radius = kRadius * *options.trace.pixel_size;
    // k = R √(ρg/σ) = 2.
    options.solve.liquid = {"test", 0.05, 1000.0};
    options.solve.gravity = 4.0 * 0.05 / (1000.0 * radius * radius);
    options.solve.fill = {FillBy::Volume, 5.0 * kMicrolitre, FillSharing::Each};
    const Droplet droplet = makeDroplet(smoothMask(96, 90, disc({46.3, 44.9}, kRadius)), options);
    expectSound(droplet);
    expectRelative(droplet.total.height_max * radius * radius / droplet.total.volume, 0.591198, 2e-3, "apex");
    expectRelative(droplet.solution.droplets[0].pressure * std::pow(radius, 4) / (0.05 * droplet.total.volume),
                   4.212881, 2e-3, "pressure");
}

TEST(Droplet, QuadrilateralsHaveTheShapeOfTriangles)
{
    constexpr double kRadius = 40.0;  // [px]
    DropletOptions options = plain();
    options.solve.model = Model::Exact;
    options.mesh.triangles = 20000;
    options.mesh.quads = true;
    const Droplet droplet = makeDroplet(smoothMask(96, 90, disc({46.3, 44.9}, kRadius)), options);
    expectSound(droplet);
    const double faces = static_cast<double>(droplet.surface.triangles.size());
    const auto quads = static_cast<double>(quadrilaterals(droplet.surface).size());
    EXPECT_GT(quads, 0.9 * (faces - quads));
    // Without gravity the liquid is a cap of the ball with its angle. 0.1 % of the height is a few times the error of
    // linear elements, h²/R².
    const double angle = 40.0 * kDegree;
    const double rim = std::sqrt(droplet.total.footprint_area / kPi);
    const double ball = rim / std::sin(angle);
    const double height = ball * (1.0 - std::cos(angle));
    Vec3 middle;
    const CapillarySurface& surface = droplet.solution.droplets[0];
    for (std::uint32_t v = 0; v < surface.rimVertexCount(); ++v) {
        middle = middle + (1.0 / surface.rimVertexCount()) * surface.vertices[v];
    }
    middle.z = -ball * std::cos(angle);
    for (const Vec3& vertex : surface.vertices) {
        EXPECT_NEAR(length(vertex - middle), ball, 1e-3 * height);
    }
    // The same liquid in triangles.
    options.mesh.quads = false;
    const Droplet triangles = makeDroplet(smoothMask(96, 90, disc({46.3, 44.9}, kRadius)), options);
    EXPECT_TRUE(quadrilaterals(triangles.surface).empty());
    expectRelative(droplet.total.height_max, triangles.total.height_max, 1e-3, "height");
    expectRelative(droplet.total.volume, triangles.total.volume, 1e-3, "volume");
}

TEST(Droplet, OutlineGivesTheSameDropletAsItsMask)
{
    const Mask mask = sceneMask();
    std::ostringstream from_mask;
    std::ostringstream from_outline;
    writeSurface(makeDroplet(mask, plain()).surface, from_mask, Format::Glb);
    std::vector<Stage> stages;
    const Droplet drop = makeDroplet(trace(mask, plain().trace), plain(),
                                     [&](Stage stage, double /*share*/) { stages.push_back(stage); });
    writeSurface(drop.surface, from_outline, Format::Glb);
    EXPECT_TRUE(from_mask.str() == from_outline.str());
    EXPECT_THAT(stages, ElementsAre(Stage::Triangulate, Stage::Assemble, Stage::Solve, Stage::Loft));
}

TEST(Droplet, ConvergesAsTheMaskGetsFiner)
{
    // The same scene on ever finer masks and meshes. The area is known; the volume is that of the finest one.
    const double radii = 25.0 * 25.0 - 8.0 * 8.0 + 7.0 * 7.0;
    const double pixel = 0.2 * kMillimetre;
    const double exact = (kPi * radii + 4.0 * 13.0 * 8.0) * pixel * pixel;
    std::vector<double> area_errors;
    std::vector<double> volumes;
    for (const int scale : {1, 2, 4}) {
        DropletOptions options = plain();
        options.trace.pixel_size = pixel / scale;
        options.mesh.triangles = 2000 * static_cast<std::size_t>(scale * scale);
        const Droplet droplet = makeDroplet(sceneMask(scale), options);
        expectSound(droplet);
        area_errors.push_back(std::abs(droplet.total.footprint_area / exact - 1.0));
        volumes.push_back(droplet.total.volume);
    }
    EXPECT_LT(area_errors[0], 1e-3);
    EXPECT_LT(area_errors[2], 3e-4);
    EXPECT_LT(std::abs(volumes[2] - volumes[1]), 0.5 * std::abs(volumes[1] - volumes[0]));
    EXPECT_LT(std::abs(volumes[2] / volumes[1] - 1.0), 3e-3);
}

TEST(Droplet, MasksWithHardEdgesGiveSimilarDroplets)
{
    const Droplet smooth = makeDroplet(sceneMask(2), plain());
    const Droplet hard = makeDroplet(hardMask(192, 144, scene(2.0)), plain());
    EXPECT_TRUE(smooth.outline.anti_aliased);
    EXPECT_FALSE(hard.outline.anti_aliased);
    expectSound(hard);
    ASSERT_EQ(hard.figures.size(), 3U);
    // A hard rim is exact to a fraction of a pixel; radii are at least 14 pixels.
    expectRelative(hard.total.footprint_area, smooth.total.footprint_area, 1e-2, "area");
    expectRelative(hard.total.volume, smooth.total.volume, 2e-2, "volume");
}

TEST(Droplet, ThresholdSetsTheLevelOfTheRim)
{
    // Coverage falls linearly from the middle to 0 at 40 px, so level t is a circle with a radius of (1 − t) · 40 px.
    Mask mask;
    mask.width = 91;
    mask.height = 91;
    for (int y = 0; y < 91; ++y) {
        for (int x = 0; x < 91; ++x) {
            const double level = 1.0 - std::hypot(x - 45.0, y - 45.0) / 40.0;
            mask.coverage.push_back(static_cast<std::uint16_t>(std::lround(65535.0 * std::max(0.0, level))));
        }
    }
    for (const double threshold : {0.25, 0.5, 0.7}) {
        SCOPED_TRACE(threshold);
        DropletOptions options = plain();
        options.mesh.triangles = 2000;
        options.trace.threshold = threshold;
        const Droplet droplet = makeDroplet(mask, options);
        const double radius = (1.0 - threshold) * 40.0 * *options.trace.pixel_size;
        expectRelative(droplet.total.footprint_area, kPi * radius * radius, 5e-3, "area");
    }
}

// Amount of liquid.

struct Sharing {
    FillSharing sharing;
    const char* name;
};

class FillTest : public ::testing::TestWithParam<Sharing> {
protected:
    [[nodiscard]] static bool each() { return GetParam().sharing == FillSharing::Each; }
};

TEST_P(FillTest, VolumeIsMet)
{
    const double wanted = 20.0 * kMicrolitre;
    const Droplet droplet = makeDroplet(sceneMask(), filled(FillBy::Volume, wanted, GetParam().sharing));
    expectSound(droplet);
    ASSERT_EQ(droplet.figures.size(), 3U);
    for (const ShapeFigures& figures : droplet.figures) {
        if (each()) {
            expectRelative(figures.volume, wanted, 1e-10, "volume");
        }
    }
    expectRelative(droplet.total.volume, each() ? 3.0 * wanted : wanted, 1e-10, "total volume");
    expectRelative(enclosedVolume(droplet.surface), each() ? 3.0 * wanted : wanted, 1e-10, "enclosed volume");
}

TEST_P(FillTest, HeightIsMet)
{
    const double wanted = 0.8 * kMillimetre;
    const Droplet droplet = makeDroplet(sceneMask(), filled(FillBy::Height, wanted, GetParam().sharing));
    expectSound(droplet);
    for (const ShapeFigures& figures : droplet.figures) {
        if (each()) {
            expectRelative(figures.height_max, wanted, 1e-12, "height");
        } else {
            EXPECT_LE(figures.height_max, wanted * (1.0 + 1e-12));
        }
    }
    expectRelative(droplet.total.height_max, wanted, 1e-12, "largest height");
    double top = 0.0;
    for (const Vec3& p : droplet.surface.vertices) {
        top = std::max(top, p.z);
    }
    EXPECT_EQ(top, droplet.total.height_max);
}

TEST_P(FillTest, ContactAngleIsMet)
{
    const double wanted = 33.0 * kDegree;
    const Droplet droplet = makeDroplet(sceneMask(), filled(FillBy::ContactAngle, wanted, GetParam().sharing));
    expectSound(droplet);
    for (const ShapeFigures& figures : droplet.figures) {
        if (each()) {
            EXPECT_NEAR(figures.contact_angle.mean, wanted, 1e-9);
        }
        EXPECT_LE(figures.contact_angle.min, figures.contact_angle.mean);
        EXPECT_LE(figures.contact_angle.mean, figures.contact_angle.max);
    }
    EXPECT_NEAR(droplet.total.contact_angle.mean, wanted, 1e-9);
}

TEST_P(FillTest, OnlyAReservoirSharesItsPressure)
{
    const Droplet droplet = makeDroplet(sceneMask(), filled(FillBy::ContactAngle, 30.0 * kDegree, GetParam().sharing));
    const std::vector<CapillarySurface>& fields = droplet.solution.droplets;
    ASSERT_EQ(fields.size(), 3U);
    EXPECT_EQ(fields[0].pressure == fields[1].pressure && fields[1].pressure == fields[2].pressure, !each());
}

INSTANTIATE_TEST_SUITE_P(Fill, FillTest,
                         ::testing::Values(Sharing{FillSharing::Each, "Each"}, Sharing{FillSharing::Total, "Total"}),
                         [](const auto& info) { return std::string(info.param.name); });

TEST(Droplet, OneDropletIsItsOwnReservoir)
{
    const Mask mask = smoothMask(64, 64, disc({31.0, 33.0}, 24.0));
    for (const auto& [by, amount] :
         {std::pair{FillBy::Volume, 10.0 * kMicrolitre}, std::pair{FillBy::Height, 1.0 * kMillimetre},
          std::pair{FillBy::ContactAngle, 35.0 * kDegree}}) {
        const Droplet each = makeDroplet(mask, filled(by, amount, FillSharing::Each));
        const Droplet total = makeDroplet(mask, filled(by, amount, FillSharing::Total));
        EXPECT_EQ(glb(each), glb(total));
        EXPECT_EQ(each.solution.droplets[0].pressure, total.solution.droplets[0].pressure);
    }
}

TEST(Droplet, HeightsAreProportionalToTheVolume)
{
    const double volume = 7.0 * kMicrolitre;
    const Droplet once = makeDroplet(sceneMask(), filled(FillBy::Volume, volume, FillSharing::Total));
    const Droplet twice = makeDroplet(sceneMask(), filled(FillBy::Volume, 2.0 * volume, FillSharing::Total));
    EXPECT_EQ(heights(twice), scaled(2.0, heights(once)));
    EXPECT_EQ(twice.solution.droplets[0].pressure, 2.0 * once.solution.droplets[0].pressure);
}

// Physics.

TEST(Droplet, PressureBalancesTheWeightAndThePullOfTheRim)
{
    for (const double gravity : {0.0, kStandardGravity, 100.0}) {
        SCOPED_TRACE(gravity);
        DropletOptions options = plain();
        options.solve.gravity = gravity;
        const Droplet droplet = makeDroplet(sceneMask(), options);
        const Liquid& liquid = options.solve.liquid;
        for (std::size_t k = 0; k < droplet.meshes.size(); ++k) {
            const PlanarMesh& mesh = droplet.meshes[k];
            const CapillarySurface& field = droplet.solution.droplets[k];
            const std::vector<double> slopes = rimSlopes(field, {});
            double pull = 0.0;
            for (std::size_t loop = 0; loop < mesh.loopCount(); ++loop) {
                for (std::uint32_t v = mesh.loop_starts[loop]; v < mesh.loop_starts[loop + 1]; ++v) {
                    const std::uint32_t next = nextOnRim(mesh, loop, v);
                    const double edge = length(mesh.vertices[next] - mesh.vertices[v]);
                    pull += 0.5 * edge * (slopes[v] + slopes[next]);
                }
            }
            const double weight = liquid.density * gravity * droplet.figures[k].volume;
            // Exact on any mesh: this is the sum of the equations of all vertices, including the rim.
            expectRelative(liquid.surface_tension * pull + weight, field.pressure * area(mesh), 1e-10, "force");
        }
    }
}

TEST(Droplet, PressureTimesVolumeIsTwiceTheLinearEnergy)
{
    DropletOptions options = plain();
    options.solve.gravity = 50.0;
    const Droplet droplet = makeDroplet(sceneMask(), options);
    for (std::size_t k = 0; k < droplet.meshes.size(); ++k) {
        const PlanarMesh& mesh = droplet.meshes[k];
        const std::vector<double> u = heightsOf(droplet.solution.droplets[k]);
        double stretching = 0.0;  // ∫|∇u|²
        for (const auto& [a, b, c] : mesh.triangles) {
            // Gradient: sum of heights times opposite edges, turned by 90°, divided by twice the area.
            const Vec2 turned = u[a] * (mesh.vertices[c] - mesh.vertices[b]) +
                                u[b] * (mesh.vertices[a] - mesh.vertices[c]) +
                                u[c] * (mesh.vertices[b] - mesh.vertices[a]);
            stretching += 0.5 * dot(turned, turned) / doubleArea(mesh, {a, b, c});
        }
        // Product of the equations with the solution: exact on any mesh.
        expectRelative(options.solve.liquid.surface_tension * stretching + 2.0 * droplet.figures[k].gravity_energy,
                       droplet.solution.droplets[k].pressure * droplet.figures[k].volume, 1e-10, "energy");
    }
}

TEST(Droplet, GravityFlattens)
{
    double last_height = 1.0;
    double last_pressure = 0.0;
    for (const double gravity : {0.0, 5.0, 10.0, 20.0, 40.0}) {
        DropletOptions options = filled(FillBy::Volume, 100.0 * kMicrolitre, FillSharing::Each);
        options.solve.gravity = gravity;
        const Droplet droplet = makeDroplet(smoothMask(96, 90, disc({46.3, 44.9}, 40.0)), options);
        EXPECT_LT(droplet.total.height_max, last_height);
        EXPECT_GT(droplet.solution.droplets[0].pressure, last_pressure);
        EXPECT_GT(droplet.total.surface_energy, 0.0728 * droplet.total.footprint_area);
        EXPECT_EQ(droplet.total.gravity_energy > 0.0, gravity > 0.0);
        last_height = droplet.total.height_max;
        last_pressure = droplet.solution.droplets[0].pressure;
    }
}

TEST(Droplet, SurfaceTensionRaises)
{
    double last = 0.0;
    for (const double sigma : {0.01, 0.03, 0.1, 0.5}) {
        DropletOptions options = filled(FillBy::Volume, 100.0 * kMicrolitre, FillSharing::Each);
        options.solve.liquid.surface_tension = sigma;
        const Droplet droplet = makeDroplet(smoothMask(96, 90, disc({46.3, 44.9}, 40.0)), options);
        EXPECT_GT(droplet.total.height_max, last);
        last = droplet.total.height_max;
    }
}

TEST(Droplet, OnlyTheRatioOfWeightToTensionShapes)
{
    DropletOptions options = filled(FillBy::Volume, 20.0 * kMicrolitre, FillSharing::Each);
    const Droplet once = makeDroplet(sceneMask(), options);
    options.solve.liquid.surface_tension *= 4.0;
    options.solve.liquid.density *= 4.0;
    const Droplet more = makeDroplet(sceneMask(), options);
    // Exact in binary, including the square roots of a factorisation.
    EXPECT_EQ(heights(more), heights(once));
    EXPECT_EQ(more.solution.droplets[2].pressure, 4.0 * once.solution.droplets[2].pressure);
    EXPECT_EQ(more.total.surface_energy, 4.0 * once.total.surface_energy);
    EXPECT_EQ(more.total.gravity_energy, 4.0 * once.total.gravity_energy);
}

TEST(Droplet, WithoutGravityShapesScale)
{
    DropletOptions options = plain();
    const Droplet once = makeDroplet(sceneMask(), options);
    *options.trace.pixel_size *= 4.0;
    const Droplet large = makeDroplet(sceneMask(), options);
    // Powers of two are exact in binary, and no stage uses an absolute length.
    EXPECT_EQ(heights(large), scaled(4.0, heights(once)));
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_EQ(large.solution.droplets[k].pressure, once.solution.droplets[k].pressure / 4.0);
        EXPECT_EQ(large.figures[k].volume, 64.0 * once.figures[k].volume);
        EXPECT_EQ(large.figures[k].footprint_area, 16.0 * once.figures[k].footprint_area);
        EXPECT_EQ(large.figures[k].contact_angle.max, once.figures[k].contact_angle.max);
        EXPECT_EQ(large.figures[k].slope_max, once.figures[k].slope_max);
    }
    // Other factors round; at worst a few edges of the triangulation flip.
    options.trace.pixel_size = 3.7 * *plain().trace.pixel_size;
    const Droplet odd = makeDroplet(sceneMask(), options);
    expectRelative(odd.total.volume, std::pow(3.7, 3) * once.total.volume, 1e-4, "volume");
    expectRelative(odd.total.height_max, 3.7 * once.total.height_max, 1e-4, "height");
    expectRelative(odd.solution.droplets[0].pressure, once.solution.droplets[0].pressure / 3.7, 1e-4, "pressure");
}

// Turned, mirrored and shifted masks.

Mask rearranged(const Mask& mask, bool transpose, bool flip_x, bool flip_y)
{
    Mask result = mask;
    if (transpose) {
        std::swap(result.width, result.height);
    }
    for (int y = 0; y < result.height; ++y) {
        for (int x = 0; x < result.width; ++x) {
            const int fx = flip_x ? result.width - 1 - x : x;
            const int fy = flip_y ? result.height - 1 - y : y;
            result.coverage[static_cast<std::size_t>(y) * static_cast<std::size_t>(result.width) +
                            static_cast<std::size_t>(x)] = transpose ? mask.at(fy, fx) : mask.at(fx, fy);
        }
    }
    return result;
}

/// Droplets by area, because turning a mask changes their order.
std::vector<std::size_t> byArea(const Droplet& droplet)
{
    std::vector<std::size_t> order(droplet.figures.size());
    for (std::size_t k = 0; k < order.size(); ++k) {
        order[k] = k;
    }
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return droplet.figures[a].footprint_area < droplet.figures[b].footprint_area;
    });
    return order;
}

struct Turn {
    const char* name;
    bool transpose;
    bool flip_x;
    bool flip_y;
};

class TurnTest : public ::testing::TestWithParam<Turn> {};

TEST_P(TurnTest, ChangesNoFigure)
{
    const Turn& turn = GetParam();
    DropletOptions options = plain();
    options.solve.gravity = kStandardGravity;
    options.mesh.triangles = 20'000;
    const Droplet upright = makeDroplet(sceneMask(), options);
    const Droplet turned = makeDroplet(rearranged(sceneMask(), turn.transpose, turn.flip_x, turn.flip_y), options);
    expectSound(turned);
    const std::vector<std::size_t> a = byArea(upright);
    const std::vector<std::size_t> b = byArea(turned);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k) {
        SCOPED_TRACE(k);
        const ShapeFigures& was = upright.figures[a[k]];
        const ShapeFigures& is = turned.figures[b[k]];
        // The tip of a corner depends on the start of tracing, by 0.01 px here; the bar's rim is 84 px long.
        expectRelative(is.footprint_area, was.footprint_area, 5e-4, "area");
        expectRelative(is.rim_length, was.rim_length, 1e-3, "rim length");
        // The lattice has another position. Heights, read at vertices, have errors up to
        // (edge / half width)² = (0.5 px / 8 px)² = 4e-3; integrals have smaller ones.
        expectRelative(is.height_max, was.height_max, 4e-3, "height");
        expectRelative(is.volume, was.volume, 2e-3, "volume");
        expectRelative(is.surface_energy, was.surface_energy, 1e-3, "surface energy");
        expectRelative(is.gravity_energy, was.gravity_energy, 4e-3, "gravity energy");
        const double pressure = upright.solution.droplets[a[k]].pressure;
        expectRelative(turned.solution.droplets[b[k]].pressure, pressure, 2e-3, "pressure");
        EXPECT_NEAR(is.contact_angle.mean, was.contact_angle.mean, 1e-9);
    }
}

INSTANTIATE_TEST_SUITE_P(Mask, TurnTest,
                         ::testing::Values(Turn{"Mirrored", false, true, false}, Turn{"UpsideDown", false, false, true},
                                           Turn{"HalfTurned", false, true, true},
                                           Turn{"Transposed", true, false, false},
                                           Turn{"TurnedLeft", true, true, false},
                                           Turn{"TurnedRight", true, false, true}),
                         [](const auto& info) { return std::string(info.param.name); });

TEST(Droplet, PositionInTheImageDoesNotMatter)
{
    // Ten dry pixels on the left and the top move the scene on the lattice.
    Mask wide;
    wide.width = 106;
    wide.height = 82;
    const Mask mask = sceneMask();
    for (int y = 0; y < wide.height; ++y) {
        for (int x = 0; x < wide.width; ++x) {
            wide.coverage.push_back(x < 10 || y < 10 ? std::uint16_t{0} : mask.at(x - 10, y - 10));
        }
    }
    const Droplet here = makeDroplet(mask, plain());
    const Droplet there = makeDroplet(wide, plain());
    EXPECT_NEAR(there.meshes[0].vertices[0].x - here.meshes[0].vertices[0].x, 1.0 * kMillimetre, 1e-9);
    EXPECT_NEAR(there.meshes[0].vertices[0].y - here.meshes[0].vertices[0].y, -1.0 * kMillimetre, 1e-9);
    expectRelative(there.total.footprint_area, here.total.footprint_area, 1e-4, "area");
    expectRelative(there.total.volume, here.total.volume, 1e-3, "volume");
}

TEST(Droplet, OtherDropletsDoNotMatter)
{
    const Droplet both = makeDroplet(sceneMask(), plain());
    DropletOptions options = plain();
    // Droplets share the mesh size, so it is given as a length.
    options.mesh.edge = 0.2 * kMillimetre;
    const Droplet all = makeDroplet(sceneMask(), options);
    const Inside bar = rectangle({76.0, 22.0}, {13.0, 8.0}, 0.4);
    const Droplet alone = makeDroplet(smoothMask(96, 72, bar), options);
    ASSERT_EQ(alone.figures.size(), 1U);
    const std::size_t k = byArea(all)[1];
    EXPECT_EQ(all.meshes[k].vertices, alone.meshes[0].vertices);
    EXPECT_EQ(heightsOf(all.solution.droplets[k]), heightsOf(alone.solution.droplets[0]));
    expectRelative(both.figures[byArea(both)[1]].volume, alone.figures[0].volume, 1e-2, "volume at another mesh size");
}

// Surface.

TEST(Droplet, ClosedAndOpenSurfacesHaveTheTopologyOfTheirRims)
{
    DropletOptions options = plain();
    expectSound(makeDroplet(sceneMask(), options));
    options.open = true;
    const Droplet open = makeDroplet(sceneMask(), options);
    expectSound(open, true);
    // A ring, a bar, a disc: 0 + 1 + 1; four rims.
    EXPECT_EQ(topology(open.surface).euler, 2);
    EXPECT_EQ(topology(open.surface).boundary_loops, 4U);
    EXPECT_EQ(topology(makeDroplet(sceneMask(), plain()).surface).euler, 4);
}

TEST(Droplet, TextureCoordinatesLeadBackToLiquidPixels)
{
    const Mask mask = sceneMask();
    const Droplet droplet = makeDroplet(mask, plain());
    // The rim itself may lie slightly beyond the edge of a pixel.
    const auto wet = [&](Vec2 uv, Vec2 aside) {
        const int x = static_cast<int>(uv.x * mask.width + aside.x);
        const int y = static_cast<int>(uv.y * mask.height + aside.y);
        return x >= 0 && x < mask.width && y >= 0 && y < mask.height && mask.at(x, y) > 0;
    };
    std::size_t dry = 0;
    for (const Vec2 uv : droplet.surface.uvs) {
        dry += wet(uv, {-0.05, -0.05}) || wet(uv, {0.05, -0.05}) || wet(uv, {-0.05, 0.05}) || wet(uv, {0.05, 0.05}) ? 0
                                                                                                                    : 1;
    }
    EXPECT_EQ(dry, 0U);
}

TEST(Droplet, TopOfTheImageIsAtPositiveY)
{
    // A small disc in the upper left quarter.
    const Droplet droplet = makeDroplet(smoothMask(64, 64, disc({16.0, 12.0}, 8.0)), plain());
    for (std::size_t v = 0; v < droplet.surface.vertices.size(); ++v) {
        EXPECT_LT(droplet.surface.vertices[v].x, 0.0);
        EXPECT_GT(droplet.surface.vertices[v].y, 0.0);
        EXPECT_LT(droplet.surface.uvs[v].x, 0.5);
        EXPECT_LT(droplet.surface.uvs[v].y, 0.5);
    }
}

TEST(Droplet, NormalsAreThoseOfTheShape)
{
    constexpr double kRadius = 40.0;
    const DropletOptions options = plain();
    const Droplet droplet = makeDroplet(smoothMask(90, 90, disc({45.0, 45.0}, kRadius)), options);
    const double radius = kRadius * *options.trace.pixel_size;
    const double curvature = std::tan(40.0 * kDegree) / radius;  // u = (R² − r²) · curvature / 2
    double worst = 0.0;
    for (std::size_t v = 0; v < droplet.surface.vertices.size(); ++v) {
        const Vec3 n = droplet.surface.normals[v];
        if (n.z < 0.0) {
            EXPECT_EQ(n, (Vec3{0.0, 0.0, -1.0}));
            EXPECT_EQ(droplet.surface.vertices[v].z, 0.0);
            continue;
        }
        const Vec3 upward{curvature * droplet.surface.vertices[v].x, curvature * droplet.surface.vertices[v].y, 1.0};
        worst = std::max(worst, std::acos(std::min(1.0, dot(n, upward) / length(upward))));
    }
    EXPECT_LT(worst, 2.0 * kDegree);
}

// Warnings and errors.

TEST(Droplet, WarnsOfSlopesTooSteepForTheModel)
{
    const Mask mask = smoothMask(64, 64, disc({32.0, 32.0}, 24.0));
    DropletOptions options = plain();
    options.mesh.triangles = 2000;
    for (const double angle : {20.0, 47.0, 50.3}) {
        options.solve.fill.amount = angle * kDegree;
        EXPECT_THAT(makeDroplet(mask, options).warnings, IsEmpty()) << angle;
    }
    for (const double angle : {53.0, 80.0}) {
        options.solve.fill.amount = angle * kDegree;
        EXPECT_THAT(makeDroplet(mask, options).warnings,
                    ElementsAre(AllOf(HasSubstr("too steep"), HasSubstr("use the exact model"))))
            << angle;
    }
    const ShapeFigures total = makeDroplet(mask, options).total;
    EXPECT_GT(total.linear_area, 1.2 * total.liquid_area);
    options.solve.model = Model::Exact;
    EXPECT_THAT(makeDroplet(mask, options).warnings, IsEmpty());
}

/// White noise: 60 % of the pixels are liquid.
Mask noiseMask(std::uint32_t seed)
{
    return hardMask(64, 64, [&](Vec2) {
        seed = seed * 1664525U + 1013904223U;
        return (seed >> 16U) % 100U < 60U;
    });
}

// Recovered angles fall to -1 degree at some vertices of these rims.
TEST(Droplet, HasNoNegativeAngleIfItIsAboveTheGround)
{
    for (const std::uint32_t seed : {9U, 11U}) {
        DropletOptions options = plain();
        options.solve.gravity = kStandardGravity;
        options.solve.fill.amount = 15.0 * kDegree;
        const Droplet droplet = makeDroplet(noiseMask(seed), options);
        const std::vector<double> all = heights(droplet);
        ASSERT_GE(*std::min_element(all.begin(), all.end()), 0.0);
        EXPECT_GE(droplet.total.contact_angle.min, 0.0);
        for (const ShapeFigures& figures : droplet.figures) {
            EXPECT_NEAR(figures.contact_angle.mean / kDegree, 15.0, 1e-6);
        }
        for (const CapillarySurface& field : droplet.solution.droplets) {
            EXPECT_GE(*std::min_element(field.contact_angle.begin(), field.contact_angle.end()), 0.0);
        }
    }
}

TEST(Droplet, WarnsOfImpossibleHeights)
{
    DropletOptions options = plain();
    options.solve.gravity = 9.81;
    const Mask mask = smoothMask(220, 220, disc({110, 110}, 100));  // seven capillary lengths to the rim
    for (const Model model : {Model::Linear, Model::Exact}) {
        options.solve.model = model;
        options.solve.fill = {FillBy::ContactAngle, 40.0 * kDegree, FillSharing::Each};
        const Droplet puddle = makeDroplet(mask, options);
        const double length = *capillaryLength(options.solve.liquid, options.solve.gravity);
        ASSERT_TRUE(puddle.total.height_bound);
        EXPECT_NEAR(*puddle.total.height_bound, 2.0 * length * std::sin(20.0 * kDegree), 1e-9 * length);
        EXPECT_EQ(puddle.severe_warnings, 0U) << ::testing::PrintToString(puddle.warnings);
    }
    options.solve.model = Model::Linear;
    options.solve.fill = {FillBy::Height, 30.0 * kMillimetre, FillSharing::Each};
    const Droplet tower = makeDroplet(mask, options);
    ASSERT_EQ(tower.severe_warnings, 1U);
    EXPECT_THAT(tower.warnings.front(), HasSubstr("30 mm high, but a puddle of this liquid"));

    // Without weight nothing limits the height; on a slope liquid collects at the lower end.
    options.solve.gravity = 0.0;
    EXPECT_FALSE(makeDroplet(mask, options).total.height_bound);
    options.solve.gravity = 9.81;
    options.solve.tilt = 10.0 * kDegree;
    const Droplet inclined = makeDroplet(mask, options);
    EXPECT_FALSE(inclined.total.height_bound);
    EXPECT_EQ(inclined.severe_warnings, 0U);
}

/// Two discs whose rims are 1.2 mm apart.
Mask nearDiscs()
{
    return smoothMask(400, 220, [](Vec2 p) { return disc({100, 110}, 95)(p) || disc({296, 110}, 95)(p); });
}

TEST(Droplet, NamesNeighboursThatWouldTouch)
{
    DropletOptions options = plain();
    options.solve.gravity = 0.0;
    options.solve.model = Model::Auto;
    options.mesh.triangles = 1'000;
    options.solve.fill = {FillBy::ContactAngle, 110.0 * kDegree, FillSharing::Each};
    try {
        (void)makeDroplet(nearDiscs(), options);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::NoSuchDroplet);
        const std::string message = error.what();
        EXPECT_THAT(message, HasSubstr("droplets 1 and 2 would touch at x "));
        const auto at = message.find("up to a mean contact angle of ");
        ASSERT_NE(at, std::string::npos) << message;
        EXPECT_NEAR(std::stod(message.substr(at + 30)), 104.0, 1.5);  // see below
    }
    // Where the work does not suffice to find that angle, none is named.
    DropletOptions short_of_work = options;
    short_of_work.solve.max_work = 1e5;
    try {
        (void)makeDroplet(nearDiscs(), short_of_work);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::NoSuchDroplet);
        EXPECT_THAT(error.what(), ::testing::EndsWith("ask for less"));
    }
    // Where nobody asked for that much, they get less, and one line says so.
    options.allow_less = true;
    const Droplet less = makeDroplet(nearDiscs(), options);
    EXPECT_TRUE(isClosed(less.surface));
    // Caps of 104° touch: 19 mm (1/sin θ − 1) = 0.6 mm.
    EXPECT_LT(less.total.contact_angle.mean, 105.0 * kDegree);
    EXPECT_GT(less.total.contact_angle.mean, 100.0 * kDegree);
    EXPECT_THAT(less.warnings,
                ElementsAre(HasSubstr("does not exist on 2 of 2 footprints; the largest that was found was taken")));
}

/// Two discs at one pressure, one larger: it takes the liquid.
TEST(Droplet, SharesLiquidThatHangsOverItsRim)
{
    const Mask mask = smoothMask(400, 220, [](Vec2 p) { return disc({100, 110}, 95)(p) || disc({320, 110}, 60)(p); });
    DropletOptions options = plain();
    options.solve.gravity = 0.0;
    options.solve.model = Model::Auto;
    options.mesh.triangles = 1'000;
    const double radius = 95.0 * 0.2 * kMillimetre;
    options.solve.fill = {FillBy::Volume, 0.85 * 4.0 / 3.0 * std::numbers::pi * std::pow(radius, 3.0) * 0.75,
                          FillSharing::Total};
    const Droplet shared = makeDroplet(mask, options);
    ASSERT_EQ(shared.solution.droplets.size(), 2U);
    ASSERT_FALSE(shared.solution.droplets[0].isHeightField() || shared.solution.droplets[1].isHeightField());
    EXPECT_TRUE(isClosed(shared.surface));
    EXPECT_NEAR(shared.total.volume, options.solve.fill.amount, 1e-9 * options.solve.fill.amount);
    EXPECT_EQ(shared.solution.droplets[0].pressure, shared.solution.droplets[1].pressure);
    EXPECT_GT(shared.figures[0].contact_angle.mean, 90.0 * kDegree);
    EXPECT_LT(shared.figures[1].contact_angle.mean, 90.0 * kDegree);
    // Puddles beyond 90° lean out over the gap between them.
    options.solve.gravity = kStandardGravity;
    options.solve.fill = {FillBy::ContactAngle, 150.0 * kDegree, FillSharing::Total};
    try {
        (void)makeDroplet(nearDiscs(), options);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::NoSuchDroplet);
        EXPECT_THAT(error.what(), HasSubstr("at one pressure the liquid would touch itself at x "));
    }
}

/// Two equal puddles at one pressure stay equal while their pressure rises with the volume. Beyond, one takes the
/// liquid of the other, up to 180° along its rim, where it would roll away.
TEST(Droplet, SharedAmountEndsWhereARimDoesNotHoldIt)
{
    const double radius = 5.0 * kMillimetre;
    const Mask mask = smoothMask(320, 120, [](Vec2 p) { return disc({60, 60}, 50)(p) || disc({260, 60}, 50)(p); });
    DropletOptions options = plain();
    options.trace.pixel_size = radius / 50.0;
    options.solve.model = Model::Auto;
    options.solve.gravity = kStandardGravity;
    options.mesh.triangles = 3'000;
    options.solve.fill = {FillBy::Volume, 800.0 * kMicrolitre, FillSharing::Total};
    const Droplet shared = makeDroplet(mask, options);
    EXPECT_NEAR(shared.figures[0].volume / shared.figures[1].volume, 1.0, 0.01);
    EXPECT_NEAR(shared.total.contact_angle.mean, 153.7 * kDegree, 1.0 * kDegree);
    options.solve.fill.amount = 1000.0 * kMicrolitre;
    try {
        (void)makeDroplet(mask, options);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::NoSuchDroplet);
        EXPECT_THAT(error.what(), HasSubstr("at one pressure a rim does not hold its droplet: with 9"));
    }
}

/// At one pressure, beyond two hemispheres, one of two equal caps takes the liquid of the other: they are the two parts
/// of one sphere. An amount that was asked for is that, or refused; the linear model does not stand in.
TEST(Droplet, SharedAmountIsSolvedOrRefused)
{
    const double radius = 50.0 * 0.2 * kMillimetre;
    const Mask mask = smoothMask(240, 120, [](Vec2 p) { return disc({60, 60}, 50)(p) || disc({180, 60}, 50)(p); });
    DropletOptions options = plain();
    options.solve.gravity = 0.0;
    options.solve.model = Model::Auto;
    options.mesh.triangles = 1'000;
    options.solve.fill = {FillBy::Volume, 1.012 * 4.0 / 3.0 * kPi * std::pow(radius, 3.0), FillSharing::Total};
    try {
        const Droplet shared = makeDroplet(mask, options);
        const double sphere = std::cbrt(0.75 / kPi * options.solve.fill.amount);
        EXPECT_NEAR(shared.solution.droplets[0].pressure * sphere / (2.0 * options.solve.liquid.surface_tension), 1.0,
                    0.01);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::NoSuchDroplet);
        EXPECT_THAT(error.what(), HasSubstr("no stable droplet was found"));
    }
}

/// On a slope, one pressure leaves a footprint far uphill without liquid.
TEST(Droplet, RefusesOrLeavesOutADropletWithoutLiquid)
{
    const Mask mask = smoothMask(80, 200, [](Vec2 p) { return disc({40, 30}, 25)(p) || disc({40, 165}, 25)(p); });
    DropletOptions options = filled(FillBy::ContactAngle, 2.0 * kDegree, FillSharing::Total);
    options.mesh.triangles = 600;
    options.solve.tilt = 45.0 * kDegree;
    for (const Model model : {Model::Linear, Model::Auto}) {
        options.solve.model = model;
        options.solve.no_penetration = false;
        try {
            (void)makeDroplet(mask, options);
            ADD_FAILURE();
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::NoSuchDroplet);
            EXPECT_THAT(error.what(), HasSubstr("droplet 1 of 2: with so little liquid the ground stands above it"));
        }
        options.solve.no_penetration = true;
        const Droplet lower = makeDroplet(mask, options);
        ASSERT_EQ(lower.surface.parts.size(), 1U);
        EXPECT_EQ(lower.surface.parts.front().droplet, 1U);
        EXPECT_EQ(lower.figures[0].volume, 0.0);
        EXPECT_GT(lower.figures[1].volume, 0.0);
        EXPECT_THAT(lower.warnings, Contains(HasSubstr("1 of 2 footprints is dry and left out")));
    }
}

/// On a ball, a bead closes with a base on the ball.
TEST(Droplet, HangsOverItsRimOnABall)
{
    const Mask mask = smoothMask(128, 128, disc({64.0, 64.0}, 40.0));
    DropletOptions options = plain();
    options.mesh.triangles = 1'500;
    options.solve.model = Model::Auto;
    options.solve.ground = BaseSurface::sphere(30.0 * kMillimetre);
    options.solve.fill = {FillBy::ContactAngle, 110.0 * kDegree, FillSharing::Each};
    const Droplet bead = makeDroplet(mask, options);
    ASSERT_EQ(bead.solution.droplets.size(), 1U);
    EXPECT_FALSE(bead.solution.droplets[0].isHeightField());
    EXPECT_TRUE(isClosed(bead.surface));
    EXPECT_NO_THROW(bead.surface.validate());
    EXPECT_NEAR(bead.total.contact_angle.mean, 110.0 * kDegree, 1e-6);
    EXPECT_NEAR(enclosedVolume(bead.surface), bead.total.volume, 1e-9 * bead.total.volume);
    EXPECT_GT(bead.total.overhang, 0.0);
    EXPECT_EQ(bead.total.depth_max, 0.0);
}

TEST(Droplet, RefusesDropletsThatDoNotExist)
{
    const Mask mask = smoothMask(256, 256, disc({128.0, 128.0}, 100.0));
    DropletOptions options = plain();
    options.mesh.triangles = 5'000;
    options.solve.gravity = 0.0;
    options.solve.model = Model::Exact;
    const double radius = 100.0 * 0.2 * kMillimetre;
    const double max = 2.0 / 3.0 * std::numbers::pi * radius * radius * radius;
    options.solve.fill = {FillBy::Volume, 1.2 * max, FillSharing::Each};
    const Droplet bead = makeDroplet(mask, options);
    EXPECT_TRUE(isClosed(bead.surface));
    EXPECT_NO_THROW(bead.surface.validate());
    ASSERT_EQ(bead.solution.droplets.size(), 1U);
    EXPECT_FALSE(bead.solution.droplets[0].isHeightField());
    EXPECT_GT(bead.total.contact_angle.mean, 0.5 * std::numbers::pi);
    // One droplet does not share its liquid.
    options.solve.fill.sharing = FillSharing::Total;
    EXPECT_EQ(makeDroplet(mask, options).surface.vertices, bead.surface.vertices);
    options.solve.fill = {FillBy::Volume, 0.9 * max, FillSharing::Each};
    EXPECT_EQ(makeDroplet(mask, options).solution.report.termination, Termination::Converged);
    options.solve.gravity = -300.0;
    try {
        (void)makeDroplet(mask, options);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::NoSuchDroplet);
        EXPECT_THAT(error.what(), HasSubstr("at most 14."));  // 3.8317²
    }
}

TEST(Droplet, DiscsHoldCapsUpToTheUprightOne)
{
    constexpr double kRadius = 50.0;  // [px]
    DropletOptions options = plain();
    options.solve.model = Model::Exact;
    for (const double degrees : {85.0, 89.2, 90.0, 95.0}) {
        options.solve.fill = {FillBy::ContactAngle, degrees * kDegree, FillSharing::Each};
        const Droplet droplet = makeDroplet(smoothMask(128, 128, disc({64.0, 64.0}, kRadius)), options);
        const double radius = kRadius * *options.trace.pixel_size;
        const double height = radius * std::tan(0.5 * degrees * kDegree);
        expectRelative(droplet.total.volume, kPi * height * (3.0 * radius * radius + height * height) / 6.0, 1e-2,
                       "volume");
        expectRelative(droplet.total.height_max, height, 5e-3, "height");
    }
}

// Refusals say what does not hold the liquid any more, and how much it does hold.
TEST(Droplet, RefusalsNameReasonAndLimit)
{
    const double radius = 10.0 * kMillimetre;
    const auto refusal = [&](SolveOptions solve) {
        DropletOptions options;
        options.trace.pixel_size = radius / 50.0;
        options.mesh.triangles = 2'000;
        options.solve = std::move(solve);
        options.solve.fill = {FillBy::Volume, 5e3 * kMicrolitre, FillSharing::Each};
        options.solve.model = Model::Auto;
        try {
            (void)makeDroplet(smoothMask(128, 128, disc({64.0, 64.0}, 50.0)), options);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::NoSuchDroplet);
            return std::string(error.what());
        }
        return std::string();
    };
    // Bond number 6: pendant drops of Bashforth and Adams' equation detach at 1.0970 radius³.
    const double weight = 6.0 * 0.0728 / (998.2 * radius * radius);
    const std::string pendant = refusal({.gravity = -weight});
    EXPECT_THAT(pendant, HasSubstr("gravity pulls a droplet of more than 1"));
    const double limit = std::stod(pendant.substr(pendant.find("than ") + 5));
    EXPECT_NEAR(limit * kMicrolitre / (1.0970 * radius * radius * radius), 1.0, 0.01);
    EXPECT_THAT(refusal({.tilt = 90.0 * kDegree}), HasSubstr("gravity pulls more over the rim"));
    EXPECT_THAT(refusal({.tilt = 90.0 * kDegree, .no_penetration = true}),
                HasSubstr("gravity pulls more over the rim"));
}

// On a wall a height field with no_penetration ends at 62 uL, where it is upright downhill. What a ball of 40 mm leaves
// dry in its upper half, it leaves dry, too.
TEST(Droplet, HangsOverItsRimOnAWallThatItLeavesDry)
{
    const double radius = 10.0 * kMillimetre;
    const Mask mask = smoothMask(128, 128, disc({64.0, 64.0}, 50.0));
    for (const BaseSurface& ground : {BaseSurface(), BaseSurface::sphere(40.0 * kMillimetre)}) {
        SCOPED_TRACE(ground.flat() ? "flat" : "ball");
        DropletOptions options;
        options.trace.pixel_size = radius / 50.0;
        options.mesh.triangles = 4'000;
        options.solve.model = Model::Auto;
        options.solve.tilt = 90.0 * kDegree;
        options.solve.fill = {FillBy::Volume, 100.0 * kMicrolitre, FillSharing::Each};
        options.solve.ground = ground;
        options.solve.no_penetration = true;
        const Droplet droplet = makeDroplet(mask, options);
        EXPECT_NEAR(droplet.total.volume / options.solve.fill.amount, 1.0, 1e-9);
        EXPECT_GT(droplet.total.contact_angle.max, 95.0 * kDegree);
        EXPECT_GT(droplet.total.dry_area, 0.3 * droplet.total.footprint_area);
        EXPECT_GE(droplet.total.depth_max, 0.0);
        // The mesh is the liquid alone: closed, with a base under it.
        EXPECT_TRUE(isClosed(droplet.surface));
        EXPECT_NO_THROW(droplet.surface.validate());
        EXPECT_NEAR(enclosedVolume(droplet.surface) / droplet.total.volume, 1.0, ground.flat() ? 1e-6 : 6e-4);
        const SurfacePart& part = droplet.surface.parts.front();
        EXPECT_EQ(part.triangles, droplet.surface.triangles.size());
        EXPECT_NEAR(part.area, droplet.total.footprint_area - droplet.total.dry_area, 1e-12);
        double base = 0.0;
        for (const Triangle& t : droplet.surface.triangles) {
            const auto& p = droplet.surface.vertices;
            if (std::all_of(t.begin(), t.end(), [&](std::uint32_t v) {
                    return std::abs(p[v].z - ground.at({p[v].x, p[v].y}).height) < 1e-12;
                })) {
                base += 0.5 * std::abs(cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]).z);
            }
        }
        EXPECT_NEAR(base / part.area, 1.0, 0.02) << "no liquid without thickness";
    }
}

// The liquid on a ball at 90 degrees is the same on finer triangles.
TEST(Droplet, HangsOverCurvedGroundThatItLeavesDryOnAnyMesh)
{
    std::vector<Droplet> droplets;
    for (const std::size_t triangles : {2'000U, 8'000U}) {
        DropletOptions options;
        options.trace.pixel_size = 0.2 * kMillimetre;
        options.mesh.triangles = triangles;
        options.solve.model = Model::Auto;
        options.solve.tilt = 90.0 * kDegree;
        options.solve.ground = BaseSurface::sphere(40.0 * kMillimetre);
        options.solve.no_penetration = true;
        options.solve.fill = {FillBy::Volume, 100.0 * kMicrolitre, FillSharing::Each};
        droplets.push_back(makeDroplet(smoothMask(128, 128, disc({64.0, 64.0}, 50.0)), options));
    }
    const auto ratio = [&](auto of) { return of(droplets[0].total) / of(droplets[1].total); };
    EXPECT_NEAR(ratio([](const ShapeFigures& f) { return f.height_max; }), 1.0, 0.01);
    EXPECT_NEAR(ratio([](const ShapeFigures& f) { return f.contact_angle.mean; }), 1.0, 0.01);
    EXPECT_NEAR(ratio([](const ShapeFigures& f) { return f.dry_area; }), 1.0, 0.02);
}

// Triangles on dry ground are chords of the ball, and those of the base are others: the liquid does not depend on
// either. Chords of the dry 86 % would hold 30 uL at 1000 triangles.
TEST(Droplet, MostlyDryBallHasTheSameLiquidOnEveryMesh)
{
    const Mask square =
        hardMask(128, 128, [](Vec2 p) { return std::max(std::abs(p.x - 64.0), std::abs(p.y - 64.0)) < 50.0; });
    std::vector<double> heights;
    std::vector<double> angles;
    for (const double triangles : {1'000.0, 4'000.0, 16'000.0}) {
        SCOPED_TRACE(triangles);
        DropletOptions options;
        options.trace.pixel_size = 0.32 * kMillimetre;
        options.mesh.triangles = static_cast<std::size_t>(triangles);
        options.solve.model = Model::Auto;
        options.solve.tilt = 60.0 * kDegree;
        options.solve.ground = BaseSurface::sphere(25.0 * kMillimetre);
        options.solve.no_penetration = true;
        options.solve.fill = {FillBy::Volume, 65.0 * kMicrolitre, FillSharing::Each};
        const Droplet droplet = makeDroplet(square, options);
        EXPECT_NEAR(droplet.total.volume / options.solve.fill.amount, 1.0, 1e-9);
        EXPECT_GT(droplet.total.dry_area, 0.8 * droplet.total.footprint_area);
        // The base's triangles are chords, too.
        EXPECT_NEAR(enclosedVolume(droplet.surface) / droplet.total.volume, 1.0, 13.0 / triangles);
        EXPECT_GT(static_cast<double>(droplet.solution.droplets.front().triangles.size()), 0.9 * triangles)
            << "small triangles settle";
        heights.push_back(droplet.total.height_max);
        angles.push_back(droplet.total.contact_angle.mean);
    }
    EXPECT_NEAR(heights[0] / heights[2], 1.0, 0.05);
    EXPECT_NEAR(heights[1] / heights[2], 1.0, 0.015);
    EXPECT_NEAR(angles[1] / angles[2], 1.0, 0.03);
}

// By default no droplet is higher than a puddle, nor the linear model's, whatever it lies on. The ground of a bowl may
// be as much deeper as its rim is higher.
TEST(Droplet, IsNoHigherThanAPuddleOnTiltedBalls)
{
    const Mask mask = smoothMask(128, 128, disc({64.0, 64.0}, 50.0));
    for (const double radius : {10.0, 25.0, -10.0}) {
        SCOPED_TRACE(radius);
        DropletOptions options;
        options.trace.pixel_size = 0.125 * kMillimetre;
        options.mesh.triangles = 2'000;
        options.solve.tilt = 60.0 * kDegree;
        options.solve.ground = BaseSurface::sphere(radius * kMillimetre);
        options.solve.model = Model::Auto;
        options.solve.fill.below_puddle = true;
        options.allow_less = true;
        const Droplet droplet = makeDroplet(mask, options);
        const double disc_radius = 6.25 * kMillimetre;
        const double deep = radius > 0.0 ? 0.0
                                         : -radius * kMillimetre -
                                               std::sqrt(std::pow(radius * kMillimetre, 2) - std::pow(disc_radius, 2));
        EXPECT_LT(droplet.total.height_max, 1.001 * (puddleHeight(options.solve, 40.0 * kDegree, 1.0) + deep));
        EXPECT_GT(droplet.total.contact_angle.mean, 20.0 * kDegree);
        EXPECT_FALSE(droplet.solution.droplets.front().isHeightField());
        EXPECT_LT(droplet.total.depth_max, 1e-9);
    }
}

// The slope of a ball adds to the contact angle: a height field over the plane is too low by 26 % with 1000 triangles.
// The volume is that of the axisymmetric Young-Laplace equation, integrated with another program.
TEST(Droplet, LiquidOnASteepBallHasItsVolumeOnCoarseTriangles)
{
    const Mask mask = smoothMask(200, 200, disc({100.0, 100.0}, 90.0));
    for (const std::size_t triangles : {1'000U, 8'000U}) {
        SCOPED_TRACE(triangles);
        DropletOptions options;
        options.trace.pixel_size = 0.1 * kMillimetre;
        options.mesh.triangles = triangles;
        options.solve.model = Model::Auto;
        options.solve.ground = BaseSurface::sphere(15.0 * kMillimetre);
        const Droplet droplet = makeDroplet(mask, options);
        EXPECT_NEAR(droplet.total.contact_angle.mean, 40.0 * kDegree, 1e-6);
        EXPECT_NEAR(droplet.total.volume / (202.5 * kMicrolitre), 1.0, 0.004);
    }
}

// Under a ceiling the linear model has droplets of any angle, and of any height. The largest angle of real ones is the
// one that a refusal names.
TEST(Droplet, HangsUnderACeilingWithTheLargestAngleThatExists)
{
    const Mask mask = smoothMask(200, 200, disc({100.0, 100.0}, 90.0));
    DropletOptions options;
    options.trace.pixel_size = 0.1 * kMillimetre;
    options.mesh.triangles = 4'000;
    options.solve.model = Model::Auto;
    options.solve.tilt = 180.0 * kDegree;
    options.solve.fill.below_puddle = true;
    options.allow_less = true;
    const Droplet most = makeDroplet(mask, options);
    EXPECT_EQ(most.limits.front(), FillLimit::Existence);
    EXPECT_GT(most.total.contact_angle.mean, 6.5 * kDegree);
    EXPECT_LT(most.total.height_max, 4.0 * kMillimetre);
    options.allow_less = false;
    options.solve.fill = {FillBy::ContactAngle, 8.0 * kDegree, FillSharing::Each};
    try {
        makeDroplet(mask, options);
        ADD_FAILURE() << "8 degrees exist";
    } catch (const Error& error) {
        const std::string message = error.what();
        const std::size_t at = message.find("at most ");
        ASSERT_NE(at, std::string::npos) << message;
        EXPECT_NEAR(std::stod(message.substr(at + 8)), most.total.contact_angle.mean / kDegree, 0.3)
            << message;  // the path has steps
    }
    options.solve.fill = {FillBy::Volume, most.total.volume, FillSharing::Each};
    EXPECT_NEAR(makeDroplet(mask, options).total.contact_angle.mean, most.total.contact_angle.mean, 0.05 * kDegree);
}

TEST(Droplet, WarnsOfATriangleCountOutOfReach)
{
    DropletOptions options = plain();
    options.mesh.triangles = 3;
    options.solve.fill.amount = 10.0 * kDegree;
    const Droplet droplet = makeDroplet(sceneMask(), options);
    expectSound(droplet);
    EXPECT_THAT(droplet.warnings, ElementsAre(HasSubstr("not the 3 asked for")));
    options.mesh.edge = 10.0;  // a length sets no count
    EXPECT_THAT(makeDroplet(sceneMask(), options).warnings, IsEmpty());
}

TEST(Droplet, ReportsEveryStageInOrder)
{
    std::vector<Stage> stages;
    makeDroplet(sceneMask(), plain(), [&](Stage stage, double /*share*/) { stages.push_back(stage); });
    EXPECT_THAT(stages, ElementsAre(Stage::Trace, Stage::Triangulate, Stage::Assemble, Stage::Solve, Stage::Loft));
}

// Two discs whose liquid hangs over: their shares rise together, and the shape is that of a run without a callback.
TEST(Droplet, ReportsHowMuchOfTheLiquidIsThere)
{
    const Inside one = disc({30.0, 32.0}, 20.0);
    const Inside other = disc({96.0, 32.0}, 20.0);
    const Mask mask = smoothMask(128, 64, [&](Vec2 p) { return one(p) || other(p); });
    DropletOptions options = plain();
    options.mesh.triangles = 1'000;
    options.solve.model = Model::Exact;
    options.solve.fill.amount = 110.0 * kDegree;
    std::vector<double> shares;
    const Droplet droplet = makeDroplet(mask, options, [&](Stage stage, double share) {
        if (share > 0.0) {
            EXPECT_EQ(stage, Stage::Solve);
            shares.push_back(share);
        }
    });
    EXPECT_GE(shares.size(), 3U);
    for (std::size_t k = 1; k < shares.size(); ++k) {
        EXPECT_GT(shares[k], shares[k - 1]);
    }
    EXPECT_EQ(shares.back(), 1.0);
    EXPECT_EQ(makeDroplet(mask, options).surface.vertices, droplet.surface.vertices);
}

TEST(Droplet, RefusesBadOptionsBeforeAnyWork)
{
    const auto refused = [](const DropletOptions& options) {
        bool began = false;
        try {
            makeDroplet(sceneMask(), options, [&](Stage, double) { began = true; });
        } catch (const Error& error) {
            return !began && error.code() == ErrorCode::InvalidArgument;
        }
        return false;
    };
    DropletOptions options = plain();
    options.trace.threshold = 1.0;
    EXPECT_TRUE(refused(options));
    options = plain();
    options.mesh.edge = 0.0;
    EXPECT_TRUE(refused(options));
    options = plain();
    options.solve.fill.amount = kPi / 2.0;
    EXPECT_TRUE(refused(options));
    EXPECT_FALSE(refused(plain()));
}

// The same input gives the same bytes.

TEST(Droplet, IsTheSameEveryTimeAtAnyNumberOfThreads)
{
    const Mask mask = hardMask(192, 144, scene(2.0));
    const std::string bytes = glb(makeDroplet(mask, plain()));
    EXPECT_TRUE(bytes == glb(makeDroplet(mask, plain())));
    for (const std::size_t threads : {1U, 2U, 5U}) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        EXPECT_TRUE(bytes == glb(makeDroplet(mask, plain()))) << threads;
    }
}

// The rims of neighbours have the points of their common boundary, bit for bit; so their meshes meet without a gap.
TEST(DropletsByColour, MeetAtCommonVertices)
{
    const std::string picture = testing::pie(120, 50.0);
    ColourTraceOptions tracing;
    tracing.edge = 0.3e-3;
    const ColourDomain traced = traceColours(decodeColours(std::as_bytes(std::span(picture))), tracing);
    DropletOptions options;
    options.mesh.edge = tracing.edge;
    const Droplet droplet = makeDroplet(traced.domain, options);
    ASSERT_EQ(droplet.meshes.size(), 3U);
    std::map<std::pair<double, double>, std::size_t> points;
    for (const Footprint& footprint : traced.domain.droplets) {
        for (const Vec2 p : footprint.rim.points) {
            ++points[{p.x, p.y}];
        }
    }
    std::map<std::pair<double, double>, std::size_t> vertices;
    for (const PlanarMesh& mesh : droplet.meshes) {
        for (std::uint32_t v = 0; v < mesh.rimVertexCount(); ++v) {
            ++vertices[{mesh.vertices[v].x, mesh.vertices[v].y}];
        }
    }
    std::size_t shared = 0;
    for (const auto& [point, count] : points) {
        if (count > 1) {
            EXPECT_EQ(vertices[point], count);
            ++shared;
        }
    }
    EXPECT_GT(shared, 60U) << "three radii of 8 mm";
    double meshed = 0.0;
    double wanted = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
        meshed += area(droplet.meshes[k]);
        wanted += area(traced.domain.droplets[k]);
    }
    EXPECT_NEAR(meshed, wanted, 1e-5 * wanted);
    EXPECT_TRUE(isClosed(droplet.surface));
    EXPECT_EQ(topology(droplet.surface).components, 3U);
}

}  // namespace
}  // namespace droplet
