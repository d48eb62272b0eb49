// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/render/stand_water.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "droplet/error.h"
#include "droplet/render/render.h"
#include "render/base_light.h"
#include "render/stand_film.h"

namespace droplet {
namespace {

TexturedMesh plate()
{
    TexturedMesh mesh;
    mesh.vertices = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}};
    mesh.normals.assign(3, {0.0, 0.0, 1.0});
    mesh.uvs = {{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}};
    mesh.triangles = {{0, 1, 2}};
    return mesh;
}

TEST(StandWater, FilmIsLinearBetweenItsValues)
{
    const TexturedMesh mesh = plate();
    StandWater water;
    water.divisions = {4};
    water.first = {0};
    for (int j = 0; j <= 4; ++j) {
        for (int i = 0; i + j <= 4; ++i) {
            water.film.push_back(0.01F * static_cast<float>(i) + 0.005F * static_cast<float>(j));
        }
    }
    EXPECT_NO_THROW(water.validate(1));
    const StandFilm film(water, mesh);
    for (const auto& [u, v] : {std::pair{0.1F, 0.2F}, {0.7F, 0.25F}, {0.3F, 0.4F}, {0.0F, 1.0F}, {1.0F, 0.0F}}) {
        Meeting meeting;
        meeting.u = u;
        meeting.v = v;
        meeting.normal = {0.0F, 0.0F, 1.0F};
        const StandFilm::Here here = film.at(meeting);
        EXPECT_NEAR(here.thickness, 0.04F * u + 0.02F * v, 1e-6F);
        // The film rises by 0.04 along x, by 0.02 along y.
        EXPECT_NEAR(here.normal.x / here.normal.z, -0.04F, 1e-6F);
        EXPECT_NEAR(here.normal.y / here.normal.z, -0.02F, 1e-6F);
    }
    water.film.pop_back();
    EXPECT_THROW(water.validate(1), Error);
    EXPECT_THROW(water.validate(2), Error);
}

TEST(StandWater, DropletsGatherLightAndCastShadows)
{
    RenderOptions options;
    options.stand = plate();
    const RayTracer scene({}, options);
    Light light;
    light.irradiance = {3.0F, 3.0F, 3.0F};
    light.beams = {{unit({1.0F, 0.0F, 1.0F}), 1.0F}};
    const DropletBase base{{0.3, 0.3, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}, 0.02, 0.02, 0.01};
    const BaseLight lit(scene, lookOf(Material::Water), 0.005, {base}, {light});
    const float open = 3.0F / 3.14159265F;
    const auto at = [&](double x, double y) {
        return lit.at(scene.toScene({0.3 + x, 0.3 + y, 0.0}), {0.0F, 0.0F, 1.0F}, grey(open)).y / open;
    };
    EXPECT_FLOAT_EQ(at(0.1, 0.0), 1.0F);
    float brightest = 0.0F;
    float darkest = 2.0F;
    double mean = 0.0;
    constexpr int kHalf = 40;
    for (int i = -kHalf; i <= kHalf; ++i) {
        for (int j = -kHalf; j <= kHalf; ++j) {
            const float here = at(1e-3 * i, 1e-3 * j);
            brightest = std::max(brightest, here);
            darkest = std::min(darkest, here);
            mean += static_cast<double>(here) / std::pow(2 * kHalf + 1, 2);
            EXPECT_NEAR(here, at(1e-3 * i, -1e-3 * j), 0.1F) << "light from +x";
        }
    }
    EXPECT_GT(brightest, 1.3F);
    EXPECT_LT(darkest, 0.3F);
    EXPECT_LT(mean, 1.0) << "some light is reflected";
    EXPECT_GT(mean, 0.9);
    // The light is gathered on the side away from the lamp; the shadow lies at the rim there.
    EXPECT_GT(at(-6e-3, 0.0), at(6e-3, 0.0) + 0.1F);
    EXPECT_LT(at(-18e-3, 0.0), 0.4F);
    EXPECT_GT(at(18e-3, 0.0), 0.9F);
}

}  // namespace
}  // namespace droplet
