// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/render/render.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <xmmintrin.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "drawing/tone.h"
#include "droplet/error.h"
#include "droplet/units.h"
#include "render/camera.h"
#include "render/ray_tracer.h"
#include "support/surfaces.h"

namespace droplet {
namespace {

using testing::kExtent;
using testing::roundDroplet;

constexpr std::array kViews = {View::ThreeQuarter, View::Top, View::Side};

RenderOptions small(View view = View::ThreeQuarter)
{
    RenderOptions options;
    options.width = 64;
    options.height = 48;
    options.view = view;
    options.lighting = Lighting::Uniform;
    options.extent = {kExtent, kExtent};
    return options;
}

Look ofIndex(double ior)
{
    Look look = lookOf(Material::Water);
    look.ior = ior;
    return look;
}

// Red grows to the right and green downward, in linear light; blue is the same everywhere.
Picture slopes()
{
    constexpr int kSide = 128;
    Picture picture{kSide, kSide, {}};
    const auto level = [](int i) {
        return static_cast<std::uint8_t>(
            std::lrint(255.0F * toDisplay(0.1F + 0.8F * (static_cast<float>(i) + 0.5F) / kSide)));
    };
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
            picture.rgb.insert(picture.rgb.end(), {level(x), level(y), 128});
        }
    }
    return picture;
}

// Level of slopes() at a uv of one axis.
double levelAt(double uv)
{
    return static_cast<double>(255.0F * toDisplay(static_cast<float>(0.1 + 0.8 * uv)));
}

std::array<int, 3> pixelAt(const Picture& picture, int x, int y)
{
    const auto at =
        3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) + static_cast<std::size_t>(x));
    return {picture.rgb[at], picture.rgb[at + 1], picture.rgb[at + 2]};
}

// Upper side of a level film, far wider than the field of view.
Surface film(double height, double half_side)
{
    Surface surface;
    for (const auto& [x, y] : {std::pair{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}}) {
        surface.vertices.push_back({x * half_side, y * half_side, height});
        surface.normals.push_back({0.0, 0.0, 1.0});
        surface.uvs.push_back({0.5 + x * half_side / kExtent, 0.5 - y * half_side / kExtent});
        surface.weld.push_back(static_cast<std::uint32_t>(surface.weld.size()));
    }
    surface.triangles = {{0, 1, 2}, {0, 2, 3}};
    surface.mean_height = height;
    return surface;
}

// White furnace: if everything around is equally bright, refraction and reflection must neither add nor lose light.
TEST(Render, ClearDropletIsInvisibleInAWhiteFurnace)
{
    const std::vector<Surface> surfaces = {
        roundDroplet({.height = 0.5e-3, .rings = 6, .segments = 32}),
        roundDroplet({.height = 6e-3, .rings = 12, .segments = 32}),
        roundDroplet({.inner = 2e-3, .height = 1e-3, .rings = 6, .segments = 32}),
        roundDroplet({.height = 1e-3, .rings = 6, .segments = 32, .open = true}),
    };
    for (const Surface& surface : surfaces) {
        for (const View view : kViews) {
            for (const double ior : {1.0, 1.333, 2.4}) {
                RenderOptions options = small(view);
                options.look = ofIndex(ior);
                EXPECT_THAT(render(surface, options).rgb, ::testing::Each(::testing::Ge(254)))
                    << ior << ' ' << static_cast<int>(view);
            }
        }
    }
}

// Facets and films share light out otherwise, but lose none: so does white metal.
TEST(Render, RoughAndFilmedLooksAreInvisibleInAWhiteFurnace)
{
    const Surface surface = roundDroplet({.height = 3e-3, .rings = 12, .segments = 32});
    Look filmed = ofIndex(1.47);
    filmed.film = ThinFilm{2.0, 380e-9};
    Look silver = lookOf(Material::Gold);
    silver.colour = {1.0, 1.0, 1.0};
    std::vector<Look> looks{filmed, silver, lookOf(Material::Frosted)};
    for (const double roughness : {0.1, 0.3, 0.9}) {
        looks.push_back(ofIndex(1.333));
        looks.back().roughness = roughness;
    }
    for (const Look& look : looks) {
        for (const View view : kViews) {
            RenderOptions options = small(view);
            options.look = look;
            EXPECT_THAT(render(surface, options).rgb, ::testing::Each(::testing::Ge(254)))
                << look.name << ' ' << look.roughness << ' ' << static_cast<int>(view);
        }
    }
}

TEST(Render, FurnaceHoldsOnCurvedGround)
{
    const BaseSurface sphere = BaseSurface::sphere(30e-3);
    Surface surface = roundDroplet({.height = 1e-3, .rings = 12, .segments = 48});
    for (Vec3& p : surface.vertices) {
        p.z += sphere.at({p.x, p.y}).height;
    }
    RenderOptions options = small();
    options.stand = groundMesh(sphere, {kExtent, kExtent});
    EXPECT_THAT(render(surface, options).rgb, ::testing::Each(::testing::Ge(254)));
    options.stand.reset();
    EXPECT_THAT(render(surface, options).rgb, ::testing::Each(::testing::Ge(254)));
}

// From above, through a droplet that bends no light, the picture of the ground lies where uv says.
TEST(Render, GroundPictureLiesWhereUvSays)
{
    const Surface surface = roundDroplet({.height = 1e-3, .rings = 6, .segments = 32, .centre = {2e-3, -1e-3}});
    const RayTracer scene(surface, small());
    for (const View view : {View::Top, View::ThreeQuarter}) {
        for (const double azimuth : {0.0, 0.7}) {
            RenderOptions options = small(view);
            options.azimuth = azimuth;
            options.look = ofIndex(1.0);
            options.ground = slopes();
            const Picture picture = render(surface, options);
            const Camera camera(scene.shown(), scene, options);
            int compared = 0;
            for (int y = 0; y < options.height; ++y) {
                for (int x = 0; x < options.width; ++x) {
                    const Vec2 uv =
                        scene.dry(camera.ray(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F)).uv;
                    if (std::min(uv.x, uv.y) > 0.02 && std::max(uv.x, uv.y) < 0.98) {
                        ASSERT_NEAR(pixelAt(picture, x, y)[0], levelAt(uv.x), 1.6) << x << ' ' << y;
                        ASSERT_NEAR(pixelAt(picture, x, y)[1], levelAt(uv.y), 1.6) << x << ' ' << y;
                        ASSERT_EQ(pixelAt(picture, x, y)[2], 128);
                        ++compared;
                    }
                }
            }
            EXPECT_GT(compared, 1000);
        }
    }
}

// The test computes every pixel by the laws of Snell and Fresnel and the light scattered below a film.
TEST(Render, FilmShiftsAndDimsTheGroundExactly)
{
    constexpr double kHeight = 1.5e-3;
    constexpr double kIndex = 1.5;
    const Surface surface = film(kHeight, 9e-3);
    const RayTracer scene(surface, small());
    RenderOptions options = small();
    options.look = ofIndex(kIndex);
    options.ground = slopes();
    const Picture picture = render(surface, options);
    const Camera camera(scene.shown(), scene, options);
    const double returned = 1.0 - (1.0 - diffuseReflectance(kIndex)) / (kIndex * kIndex);
    int compared = 0;
    for (int y = 0; y < options.height; ++y) {
        for (int x = 0; x < options.width; ++x) {
            const RayF ray = camera.ray(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
            const double cosine = static_cast<double>(-ray.direction.z);
            const double sine = std::sqrt(1.0 - cosine * cosine);
            const double inner_sine = sine / kIndex;
            const double inner_cosine = std::sqrt(1.0 - inner_sine * inner_sine);
            const double top = kHeight / scene.scale();
            const double down = (static_cast<double>(ray.origin.z) - top) / cosine;
            // Follows the ray to the film, then the refracted ray to the ground.
            const double shift = top * inner_sine / inner_cosine / sine;
            const Vec3f place = ray.origin + static_cast<float>(down) * ray.direction;
            const Vec2 at{static_cast<double>(place.x), static_cast<double>(place.y)};
            const Vec2 ahead{static_cast<double>(ray.direction.x), static_cast<double>(ray.direction.y)};
            const Vec2 landed = at + shift * ahead;
            const double edge = 8.5e-3 / scene.scale();
            if (std::max({std::abs(at.x), std::abs(at.y), std::abs(landed.x), std::abs(landed.y)}) > edge) {
                continue;
            }
            const Vec2 uv = scene.uvOnPlane({static_cast<float>(landed.x), static_cast<float>(landed.y), 0.0F});
            const double across = (cosine - kIndex * inner_cosine) / (cosine + kIndex * inner_cosine);
            const double along = (inner_cosine - kIndex * cosine) / (inner_cosine + kIndex * cosine);
            const double reflected = 0.5 * (across * across + along * along);
            const double matter = 0.1 + 0.8 * uv.x;
            const double light = reflected + (1.0 - reflected) * matter * (1.0 - returned) / (1.0 - returned * matter);
            ASSERT_NEAR(pixelAt(picture, x, y)[0], static_cast<double>(255.0F * toDisplay(static_cast<float>(light))),
                        1.6)
                << x << ' ' << y;
            ++compared;
        }
    }
    EXPECT_GT(compared, 1000);
}

TEST(Render, PictureOfAMirrorImageIsTheMirroredPicture)
{
    // Ground and droplet are symmetric.
    RenderOptions options = small(View::Top);
    options.ground = slopes();
    for (std::size_t i = 0; i < options.ground->rgb.size(); i += 3) {
        options.ground->rgb[i] = 90;
    }
    const Picture picture = render(roundDroplet({.height = 2e-3, .rings = 16, .segments = 64}), options);
    double sum = 0.0;
    for (int y = 0; y < options.height; ++y) {
        for (int x = 0; x < options.width; ++x) {
            const int difference = pixelAt(picture, x, y)[1] - pixelAt(picture, options.width - 1 - x, y)[1];
            sum += std::abs(difference);
            EXPECT_LE(std::abs(difference), 20);  // pixels on an edge, whose samples are not mirrored
        }
    }
    EXPECT_LT(sum / (options.width * options.height), 0.5);
}

TEST(Render, GivesTheSameBytesWithAnyNumberOfThreads)
{
    const Surface surface = roundDroplet({.height = 2e-3, .rings = 10, .segments = 48});
    for (const Material material : materials()) {
        RenderOptions options = small();
        options.lighting = Lighting::Studio;
        options.look = lookOf(material);
        const auto made = [&](std::size_t threads) {
            const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
            return render(surface, options);
        };
        const Picture one = made(1);
        EXPECT_EQ(one, made(2));
        EXPECT_EQ(one, made(4));
    }
}

TEST(Render, LeavesFloatingPointModesAlone)
{
    const unsigned before = _mm_getcsr();
    render(roundDroplet(), small());
    constexpr unsigned kFlags = 0x3fU;  // sticky status flags, not control bits
    EXPECT_EQ(_mm_getcsr() & ~kFlags, before & ~kFlags);
}

TEST(Render, WaterShowsHighlightsAndShadows)
{
    RenderOptions options = small();
    options.lighting = Lighting::Studio;
    options.width = 160;
    options.height = 120;
    options.extent = {kExtent, kExtent};
    options.ground = Picture{1, 1, {128, 128, 128}};
    const auto extremes = [&](const Surface& surface) {
        const Picture picture = render(surface, options);
        int darkest = 255;
        int brightest = 0;
        for (std::size_t i = 1; i < picture.rgb.size(); i += 3) {
            darkest = std::min<int>(darkest, picture.rgb[i]);
            brightest = std::max<int>(brightest, picture.rgb[i]);
        }
        return std::pair(darkest, brightest);
    };
    const auto [darkest, brightest] = extremes(roundDroplet({.height = 2e-3, .rings = 24, .segments = 96}));
    EXPECT_GT(brightest, 235);
    options.look = ofIndex(1.0);
    const auto [plain_darkest, plain_brightest] = extremes(roundDroplet({.height = 2e-3, .rings = 24, .segments = 96}));
    EXPECT_LT(plain_brightest, 200);
    EXPECT_LT(darkest, plain_darkest - 20);
}

// A cut-out over another picture: transparent far away, dark shadow, clear water, opaque metal.
TEST(RenderCutOut, IsTheDropletAndItsShadow)
{
    RenderOptions options = small(View::Top);
    options.lighting = Lighting::Studio;
    const Surface surface = roundDroplet({.height = 2e-3, .rings = 24, .segments = 96});
    const Layer water = renderCutOut(surface, options);
    water.validate();
    const auto pixel = [&](const Layer& layer, int x, int y) {
        return layer.rgba.begin() + 4 * (static_cast<std::ptrdiff_t>(y) * layer.width + x);
    };
    EXPECT_EQ(pixel(water, 1, 1)[3], 0);
    EXPECT_LT(pixel(water, options.width / 2, options.height / 2)[3], 100) << "clear where it gathers light";
    const Picture paper{water.width, water.height,
                        std::vector<std::uint8_t>(3 * static_cast<std::size_t>(water.width * water.height), 255)};
    const Picture seen = over(water, paper);
    EXPECT_LT(*std::min_element(seen.rgb.begin(), seen.rgb.end()), 180) << "its rim and shadow";
    options.look = lookOf(Material::Mercury);
    EXPECT_EQ(pixel(renderCutOut(surface, options), options.width / 2, options.height / 2)[3], 255);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    options.look = lookOf(Material::Water);
    EXPECT_TRUE(renderCutOut(surface, options) == water);
}

// Even light from all directions is the white furnace, in any unit; light from one side casts a shadow on the other.
TEST(Environment, ShinesInPlaceOfTheStudio)
{
    RenderOptions options = small(View::Top);
    options.lighting = Lighting::Studio;
    const Surface surface = roundDroplet({.height = 2e-3, .rings = 24, .segments = 96});
    const auto lit = [&](float left, float right, float unit) {
        Environment environment{8, 4, {}};
        for (int i = 0; i < 32; ++i) {
            const float light = unit * (i % 8 < 4 ? left : right);
            environment.radiance.push_back({light, light, light});
        }
        options.environment = environment;
        return renderCutOut(surface, options);
    };
    EXPECT_TRUE(lit(1.0F, 1.0F, 1.0F) == lit(1.0F, 1.0F, 64.0F));
    const auto shadow = [&](const Layer& layer) {  // right side minus left side
        long sum = 0;
        for (int y = 0; y < layer.height; ++y) {
            for (int x = 0; x < layer.width; ++x) {
                const int alpha = layer.rgba[4 * static_cast<std::size_t>(y * layer.width + x) + 3];
                sum += x < layer.width / 4 ? -alpha : x >= 3 * layer.width / 4 ? alpha : 0;
            }
        }
        return sum;
    };
    EXPECT_GT(shadow(lit(1.0F, 0.0F, 1.0F)), shadow(lit(0.0F, 1.0F, 1.0F)));
    options.environment = Environment{2, 1, {{0.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 0.0F}}};
    EXPECT_THROW(render(surface, options), Error);
}

TEST(Camera, StandsInTheGivenDirection)
{
    RenderOptions options = small();
    const Picture usual = render(roundDroplet(), options);
    options.view = View::Top;
    options.camera = CameraPlace{-79.0 * kDegree, 48.0 * kDegree};
    EXPECT_TRUE(render(roundDroplet(), options) == usual);
    options.camera->elevation = 91.0 * kDegree;
    EXPECT_THROW(render(roundDroplet(), options), Error);
}

// The droplet fills half of a box of twice its size.
TEST(Render, FramesAGivenBox)
{
    const auto columns = [&](const RenderOptions& options) {
        const Layer layer = renderCutOut(roundDroplet({.height = 2e-3, .rings = 24, .segments = 96}), options);
        std::vector<bool> found(static_cast<std::size_t>(layer.width));
        for (std::size_t i = 0; i < layer.rgba.size(); i += 4) {
            found[i / 4 % found.size()] = found[i / 4 % found.size()] || layer.rgba[i + 3] > 5;
        }
        return static_cast<double>(std::count(found.begin(), found.end(), true));
    };
    RenderOptions options = small(View::Top);
    options.look = lookOf(Material::Plain);
    const double whole = columns(options);
    double reach = 0.0;
    for (const Vec3& p : roundDroplet().vertices) {
        reach = std::max(reach, p.x);
    }
    options.framed = ViewBox{{-2.0 * reach, -2.0 * reach, 0.0}, {2.0 * reach, 2.0 * reach, 2e-3}};
    EXPECT_NEAR(columns(options) / whole, 0.5, 0.06);
}

// In every view the droplet is in the picture and fills it up to the margin.
TEST(Camera, FramesEverything)
{
    const RayTracer scene(roundDroplet({.height = 3e-3, .centre = {3e-3, 1e-3}}), RenderOptions{});
    for (const View view : kViews) {
        for (const auto& [width, height] : {std::pair{640, 480}, {200, 600}, {900, 100}}) {
            RenderOptions options = small(view);
            options.width = width;
            options.height = height;
            const Camera camera(scene.shown(), scene, options, width / 10);
            Vec2 low{1e9, 1e9};
            Vec2 high{-1e9, -1e9};
            for (const Vec3f& p : scene.shown()) {
                const Vec2 at = camera.seen(p);
                low = {std::min(low.x, at.x), std::min(low.y, at.y)};
                high = {std::max(high.x, at.x), std::max(high.y, at.y)};
            }
            EXPECT_GT(std::min(low.x, low.y), 0.0);
            EXPECT_LT(high.x, 0.9 * width);
            EXPECT_LT(high.y, height);
            EXPECT_NEAR(std::max((high.x - low.x) / (0.9 * width), (high.y - low.y) / height), 0.86, 0.01);
        }
    }
}

TEST(Camera, LooksAtAPointFromADistance)
{
    const RayTracer scene(roundDroplet({.height = 3e-3, .centre = {3e-3, 1e-3}}), RenderOptions{});
    RenderOptions options = small(View::Side);
    const Vec3 rim = {4e-3, 1e-3, 0.0};
    options.look_at = rim;
    const Camera fitted(scene.shown(), scene, options);
    const Vec2 middle = fitted.seen(scene.toScene(rim));
    EXPECT_NEAR(middle.x, 0.5 * options.width, 0.01);
    EXPECT_NEAR(middle.y, 0.5 * options.height, 0.01);
    for (const Vec3f& p : scene.shown()) {
        EXPECT_GT(std::min(fitted.seen(p).x, fitted.seen(p).y), 0.0) << "all is in the picture";
        EXPECT_LT(fitted.seen(p).x, options.width);
        EXPECT_LT(fitted.seen(p).y, options.height);
    }
    // What lies at the point, across the picture, is smaller by the distance.
    const auto size = [&](double distance) {
        options.distance = distance;
        const Camera camera(scene.shown(), scene, options);
        return camera.seen(scene.toScene(rim + Vec3{0.0, 0.0, 1e-5})).y - camera.seen(scene.toScene(rim)).y;
    };
    EXPECT_NEAR(size(0.05) / size(0.1), 2.0, 0.02);
    options.distance = 0.0;
    EXPECT_THROW(options.validate(), Error);
    options.distance.reset();
    options.camera = CameraPlace{0.0, -0.5};
    EXPECT_THROW(render(roundDroplet({.height = 3e-3}), options), Error) << "below the ground";
}

TEST(Camera, FramesATurntableForAllTurns)
{
    const RayTracer scene(roundDroplet({.height = 3e-3, .centre = {3e-3, 1e-3}}), RenderOptions{});
    RenderOptions options = small(View::Side);
    options.fit_all_azimuths = true;
    const Vec2 top = Camera(scene.shown(), scene, options).seen({0.0F, 0.0F, 0.5F});
    for (const double azimuth : {0.5, 2.0, 4.5}) {
        options.azimuth = azimuth;
        const Camera camera(scene.shown(), scene, options);
        EXPECT_NEAR(camera.seen({0.0F, 0.0F, 0.5F}).x, top.x, 0.01);
        EXPECT_NEAR(camera.seen({0.0F, 0.0F, 0.5F}).y, top.y, 0.01);
        for (const Vec3f& p : scene.shown()) {
            EXPECT_GT(std::min(camera.seen(p).x, camera.seen(p).y), 0.0);
            EXPECT_LT(camera.seen(p).x, options.width);
            EXPECT_LT(camera.seen(p).y, options.height);
        }
    }
}

// A counter-clockwise turn by three quarters moves a point from the right to the front.
TEST(Camera, DependsOnlyOnTheFramedBox)
{
    for (const View view : kViews) {
        RenderOptions options = small(view);
        options.ground = slopes();
        const Surface wide = roundDroplet({.outer = 4e-3, .height = 1.5e-3});
        const Surface narrow = roundDroplet({.outer = 1e-3, .height = 0.5e-3});
        options.framed = around(narrow, around(wide));
        const std::array pictures{render(wide, options), render(narrow, options), render(Surface{}, options)};
        for (const Picture& picture : pictures) {
            for (const int y : {0, options.height - 1}) {
                EXPECT_EQ(pixelAt(picture, 0, y), pixelAt(pictures[0], 0, y));
                EXPECT_EQ(pixelAt(picture, options.width - 1, y), pixelAt(pictures[0], options.width - 1, y));
            }
        }
        const auto differing = [&](const Picture& a, const Picture& b) {
            int count = 0;
            for (std::size_t i = 0; i < a.rgb.size(); ++i) {
                count += a.rgb[i] != b.rgb[i] ? 1 : 0;
            }
            return count;
        };
        EXPECT_GT(differing(pictures[0], pictures[2]), differing(pictures[1], pictures[2])) << "it is larger";
        EXPECT_GT(differing(pictures[1], pictures[2]), 0);
        options.framed.reset();
        EXPECT_NE(pixelAt(render(narrow, options), 0, 0), pixelAt(pictures[1], 0, 0)) << "it is nearer then";
    }
    EXPECT_FALSE(around(Surface{}));
    RenderOptions options = small();
    options.framed = ViewBox{{1.0, 0.0, 0.0}, {0.0, 1.0, 1.0}};
    EXPECT_THROW(render(roundDroplet(), options), Error);
}

TEST(Camera, TurnsTheDropletCounterClockwise)
{
    const RayTracer scene(roundDroplet(), RenderOptions{});
    RenderOptions options = small(View::Top);
    options.azimuth = 90.0 * kDegree;
    const Camera camera(scene.shown(), scene, options);
    EXPECT_NEAR(camera.seen({0.5F, 0.0F, 0.0F}).x, 32.0, 0.01);
    EXPECT_LT(camera.seen({0.5F, 0.0F, 0.0F}).y, 20.0);
}

TEST(Render, ShowsTheColoursOfPaint)
{
    const Surface surface = roundDroplet({.height = 1e-3, .rings = 6, .segments = 32});
    RenderOptions options = small(View::Top);
    Paint paint;
    paint.values.assign(surface.vertices.size(), 0.25);
    paint.scale = {{0.0, 0.2, 1.0}, {1.0, 0.2, 0.0}};
    options.paint = paint;
    EXPECT_THAT(pixelAt(render(surface, options), 32, 24), ::testing::ElementsAre(64, 51, 191));
    paint.share.assign(surface.vertices.size(), 0.0);
    options.paint = paint;
    const auto plain = pixelAt(render(surface, options), 32, 24);
    EXPECT_NEAR(plain[0], plain[2], 8);
}

TEST(Render, RefusesInvalidOptions)
{
    const Surface surface = roundDroplet();
    const auto refused = [&](const auto& change, const std::string& words) {
        RenderOptions options = small();
        change(options);
        try {
            render(surface, options);
            ADD_FAILURE() << words;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::InvalidArgument);
            EXPECT_THAT(error.what(), ::testing::HasSubstr(words));
        }
    };
    constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();
    refused([](RenderOptions& o) { o.width = 0; }, "options.width is 0");
    refused([](RenderOptions& o) { o.height = 8193; }, "options.height is 8193");
    refused([](RenderOptions& o) { o.samples = 3; }, "options.samples is 3");
    refused([](RenderOptions& o) { o.samples = 257; }, "options.samples is 257");
    refused([](RenderOptions& o) { o.azimuth = kNoNumber; }, "options.azimuth");
    refused([](RenderOptions& o) { o.look.ior = 0.9; }, "options.look.ior");
    refused([](RenderOptions& o) { o.look.ior = kNoNumber; }, "options.look.ior");
    refused([](RenderOptions& o) { o.extent.x = -1.0; }, "options.extent");
    refused([](RenderOptions& o) { o.ground = slopes(), o.extent = {}; }, "options.extent");
    refused([](RenderOptions& o) { o.colour_map = slopes(), o.extent = {}; }, "options.extent");
    refused([](RenderOptions& o) { o.ground = Picture{}; }, "picture");
    refused([](RenderOptions& o) { o.colour_map = Picture{}; }, "picture");
    refused([](RenderOptions& o) { o.stand = TexturedMesh{}; }, "");
    refused([](RenderOptions& o) { o.paint = Paint{}; }, "paint.values");
    EXPECT_THROW(render(Surface{}, small()), Error);
    EXPECT_THROW(viewNamed("below"), Error);
    EXPECT_THROW(groundMesh(BaseSurface(), {1.0, 1.0}), Error);
    EXPECT_EQ(viewNamed("side"), View::Side);
}

// A sphere smaller than the image has ground only in the middle.
TEST(GroundMesh, EndsWhereTheGroundDoes)
{
    const TexturedMesh mesh = groundMesh(BaseSurface::sphere(4e-3), {kExtent, kExtent});
    mesh.validate();
    for (const Vec3& p : mesh.vertices) {
        EXPECT_NEAR(length(p - Vec3{0.0, 0.0, -4e-3}), 4e-3, 1e-9);
    }
}

// Through a film that bends no light, white ground has the colours of the map.
TEST(Render, ColourMapTintsTheLightThatPasses)
{
    const Surface surface = film(1e-3, 9e-3);
    const RayTracer scene(surface, small());
    for (const View view : {View::Top, View::ThreeQuarter}) {
        RenderOptions options = small(view);
        options.look = ofIndex(1.0);
        options.colour_map = slopes();
        const Picture picture = render(surface, options);
        const Camera camera(scene.shown(), scene, options);
        int compared = 0;
        for (int y = 0; y < options.height; ++y) {
            for (int x = 0; x < options.width; ++x) {
                const Meeting meeting =
                    scene.fromAir(camera.ray(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F));
                const auto edge = static_cast<float>(8.5e-3 / scene.scale());
                if (meeting.what == Meeting::What::Liquid &&
                    std::max(std::abs(meeting.place.x), std::abs(meeting.place.y)) < edge) {
                    ASSERT_NEAR(pixelAt(picture, x, y)[0], levelAt(meeting.uv.x), 1.6) << x << ' ' << y;
                    ASSERT_NEAR(pixelAt(picture, x, y)[1], levelAt(meeting.uv.y), 1.6) << x << ' ' << y;
                    ASSERT_EQ(pixelAt(picture, x, y)[2], 128);
                    ++compared;
                }
            }
        }
        EXPECT_GT(compared, 500);
    }
}

TEST(Render, WhiteColourMapChangesNothing)
{
    for (const Material material : materials()) {
        RenderOptions options = small();
        options.lighting = Lighting::Studio;
        options.look = lookOf(material);
        const Picture without = render(roundDroplet(), options);
        options.colour_map = Picture{1, 1, {255, 255, 255}};
        EXPECT_EQ(render(roundDroplet(), options), without);
        options.colour_map = Picture{1, 1, {255, 0, 0}};
        EXPECT_NE(render(roundDroplet(), options), without);
    }
}

// The lamps' light is tinted, too: on white ground the shadow of a clear droplet takes the colour.
TEST(Render, ColourMapTintsTheShadow)
{
    RenderOptions options = small();
    options.lighting = Lighting::Studio;
    options.ground = Picture{1, 1, {255, 255, 255}};
    options.colour_map = Picture{1, 1, {255, 0, 0}};
    const Layer layer = renderCutOut(roundDroplet({.height = 3e-3, .rings = 8, .segments = 32}), options);
    std::size_t red = 0;
    for (std::size_t i = 0; i < layer.rgba.size(); i += 4) {
        red += layer.rgba[i + 3] > 20 && layer.rgba[i] > layer.rgba[i + 1] + 100 ? 1 : 0;
    }
    EXPECT_GT(red, 50U);
}

/// Part of a sphere on a disc, closed; it hangs over its rim if the contact angle is over a right angle.
Surface capOfAngle(double angle)
{
    constexpr std::uint32_t kRings = 32;
    constexpr std::uint32_t kAround = 64;
    constexpr double kRadius = 3e-3;
    Surface surface;
    const auto add = [&](const Vec3& position, const Vec3& normal) {
        surface.vertices.push_back(position);
        surface.normals.push_back(normal);
        surface.weld.push_back(static_cast<std::uint32_t>(surface.weld.size()));
    };
    for (std::uint32_t ring = 0; ring <= kRings; ++ring) {
        const double tilt = angle * ring / kRings;
        for (std::uint32_t k = 0; k < kAround; ++k) {
            const double turn = 2.0 * std::numbers::pi * k / kAround;
            const Vec3 normal{std::sin(tilt) * std::cos(turn), std::sin(tilt) * std::sin(turn), std::cos(tilt)};
            const double z = ring == kRings ? 0.0 : kRadius * (normal.z - std::cos(angle));
            add({kRadius * normal.x, kRadius * normal.y, z}, normal);
            const std::uint32_t a = ring * kAround + k;
            const std::uint32_t b = ring * kAround + (k + 1) % kAround;
            if (ring < kRings) {
                surface.triangles.push_back({a, a + kAround, b + kAround});
                if (ring > 0) {
                    surface.triangles.push_back({a, b + kAround, b});
                }
            }
        }
    }
    const std::uint32_t rim = kRings * kAround;
    const std::uint32_t base = rim + kAround;
    for (std::uint32_t k = 0; k < kAround; ++k) {
        add(surface.vertices[rim + k], {0.0, 0.0, -1.0});
        surface.weld.back() = rim + k;
        surface.triangles.push_back({base + kAround, base + (k + 1) % kAround, base + k});
    }
    add({}, {0.0, 0.0, -1.0});
    surface.uvs.resize(surface.vertices.size());
    surface.mean_height = 1e-3;
    return surface;
}

// Rays that leave the liquid below its overhang see the ground; they were taken for reflections, as dark polygons.
TEST(Render, CutOutIsTransparentBelowAnOverhang)
{
    RenderOptions options = small(View::Top);
    const Layer layer = renderCutOut(capOfAngle(130.0 * kDegree), options);
    const Picture white{layer.width, layer.height, std::vector<std::uint8_t>(layer.rgba.size() / 4 * 3, 255)};
    const Picture seen = over(layer, white);
    EXPECT_GT(*std::min_element(seen.rgb.begin(), seen.rgb.end()), 230);
}

TEST(Render, EveryDropletHasItsLook)
{
    RenderOptions options = small(View::Top);
    options.lighting = Lighting::Studio;
    options.extent = {kExtent, kExtent};
    options.ground = Picture{1, 1, {255, 255, 255}};
    const Picture alike = render(testing::pairOfDroplets(), options);
    options.looks = {options.look, options.look};
    EXPECT_EQ(render(testing::pairOfDroplets(), options), alike);
    for (const std::size_t red : {0U, 1U}) {
        options.looks = {lookOf(Material::Water), lookOf(Material::Water)};
        options.looks[red].colour = {1.0, 0.01, 0.01};
        options.looks[red].tinted = true;
        const Picture picture = render(testing::pairOfDroplets(), options);
        std::array<double, 2> redness{};
        for (int y = 0; y < picture.height; ++y) {
            for (int x = 0; x < picture.width; ++x) {
                // What the lamps and the ground have of red is in both pictures.
                const auto pixel = pixelAt(picture, x, y);
                const auto clear = pixelAt(alike, x, y);
                redness[2 * x < picture.width ? 1 : 0] += (pixel[0] - pixel[1]) - (clear[0] - clear[1]);
            }
        }
        EXPECT_GT(redness[red], 20.0 * std::abs(redness[1 - red]));
    }
    options.looks.pop_back();
    EXPECT_THROW(render(testing::pairOfDroplets(), options), Error);
    options.looks = {lookOf(Material::Water)};
    EXPECT_THROW(render(roundDroplet(), options), Error) << "it has no parts";
}

}  // namespace
}  // namespace droplet
