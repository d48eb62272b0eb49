// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/windshield_view/view.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>

#include "drawing/tone.h"
#include "droplet/error.h"
#include "droplet/windshield_view/glass_maps.h"
#include "windshield_view/backdrop.h"
#include "windshield_view/still_map.h"

namespace droplet {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kFlat = std::numeric_limits<double>::infinity();

Picture filled(int width, int height, std::array<std::uint8_t, 3> upper, std::array<std::uint8_t, 3> lower)
{
    Picture picture{width, height, {}};
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const auto& colour = 2 * y < height ? upper : lower;
            picture.rgb.insert(picture.rgb.end(), colour.begin(), colour.end());
        }
    }
    return picture;
}

/// Picture with a different colour at every place.
Picture slanted(int width, int height)
{
    Picture picture{width, height, {}};
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            for (const int level : {255 * x / width, 255 * y / height, (7 * x + 3 * y) % 256}) {
                picture.rgb.push_back(static_cast<std::uint8_t>(level));
            }
        }
    }
    return picture;
}

WindshieldParameters heavyRain()
{
    WindshieldParameters parameters;
    parameters.glass = Glass(Glass::Cylinder{.width = 0.3, .height = 0.25, .radius = 5.0});
    parameters.rainfall = 100.0 * kMillimetrePerHour;
    parameters.vehicle = constantSpeed(17.0);
    parameters.forces.wetting.hysteresis = 0.2;
    parameters.wipers = tandemWipers(parameters.glass, 1.2);
    parameters.splashes = true;
    return parameters;
}

WindshieldState rained(const WindshieldParameters& parameters, int steps)
{
    WindshieldState state = startWindshield(parameters);
    for (int k = 0; k < steps; ++k) {
        state = step(std::move(state), parameters, 1.0 / 60.0);
    }
    return state;
}

ViewOptions small()
{
    ViewOptions options;
    options.width = 160;
    options.height = 90;
    options.eye_distance = 0.2;
    return options;
}

/// One droplet on an upright flat glass, straight ahead.
WindshieldState oneDroplet(const WindshieldParameters& parameters, double volume)
{
    WindshieldState state = startWindshield(parameters);
    RunningDroplet droplet;
    droplet.id = 1;
    droplet.position = {0.5 * parameters.glass.width(), 0.5 * parameters.glass.height()};
    droplet.volume = volume;
    state.droplets.push_back(droplet);
    return state;
}

TEST(View, RingsOfSplashesHideTheirDroplets)
{
    WindshieldParameters parameters;
    parameters.glass = Glass(Glass::Cylinder{.width = 0.6, .height = 0.4, .radius = kFlat, .slope = 90.0 * kDegree});
    WindshieldState state = oneDroplet(parameters, kPi / 6.0 * 27e-9);
    ViewOptions options = small();
    options.eye_distance = 0.1;
    DriversView view(parameters.glass, options);
    view.setBackground(slanted(options.width, options.height));
    view.show(state);
    const Layer droplet = view.layer();
    Splash splash = splashOf(3e-3, 12.0, parameters.forces.liquid).value();
    splash.position = state.droplets.front().position;
    state.splashes = {splash};
    state.time = 0.2 * splash.lifetime;
    view.show(state);
    const Layer ringed = view.layer();
    const SplashRing ring = ringOf(splash, state.time).value();
    std::size_t rims = 0;
    for (int y = 0; y < options.height; ++y) {
        for (int x = 0; x < options.width; ++x) {
            const Vec2 place = view.onGlass(x, y).value();
            const double far = length(place - splash.position);
            const std::size_t alpha = 4 * static_cast<std::size_t>(y * options.width + x) + 3;
            constexpr double kPixel = 0.6e-3;  // and a little more
            if (far > ring.radius + 2.0 * ring.half_width + kPixel) {
                EXPECT_EQ(ringed.rgba[alpha], 0);
            } else if (std::abs(far - ring.radius) < 0.1 * ring.half_width) {
                ++rims;
                EXPECT_GT(ringed.rgba[alpha], 100);
            } else if (far < ring.radius - 2.0 * ring.half_width - kPixel) {
                EXPECT_NEAR(ringed.rgba[alpha], 0.2 * droplet.rgba[alpha], 1.0);
            }
        }
    }
    EXPECT_GT(rims, 4U);
    state.time = splash.lifetime;
    view.show(state);
    EXPECT_EQ(view.layer().rgba, droplet.rgba) << "then the droplet is there alone";
}

TEST(View, PixelsSeeTheGlassWhereTheirRaysMeetIt)
{
    // On upright flat glass, a tangent is a length over the distance.
    const Glass glass(Glass::Cylinder{.width = 0.6, .height = 0.4, .radius = kFlat, .slope = 90.0 * kDegree});
    ViewOptions options;
    options.width = 64;
    options.height = 48;
    options.eye_distance = 0.3;
    const DriversView view(glass, options);
    const double pixel = 2.0 * std::tan(22.5 * kDegree) * options.eye_distance / options.width;
    for (const auto& [x, y] : {std::pair(0, 0), std::pair(63, 47), std::pair(31, 24), std::pair(50, 3)}) {
        const auto place = view.onGlass(x, y);
        ASSERT_TRUE(place);
        EXPECT_NEAR(place->x, 0.3 + pixel * (x + 0.5 - 32.0), 1e-6);
        EXPECT_NEAR(place->y, 0.2 - pixel * (y + 0.5 - 24.0), 1e-6);
    }
    EXPECT_FALSE(view.onGlass(-1, 0));
    EXPECT_FALSE(view.onGlass(0, 48));
}

TEST(View, RaysMeetTheCurvedGlass)
{
    const Glass glass;
    const DriversView view(glass, {.width = 128, .height = 72});
    const auto ahead = glass.place({0.5 * glass.width(), 0.5 * glass.height()});
    const Vec3 eye = ahead->point - Vec3{0.0, 0.5, 0.0};
    const double pixel = 2.0 * std::tan(22.5 * kDegree) / 128;
    for (int y = 0; y < 72; y += 7) {
        for (int x = 0; x < 128; x += 9) {
            const auto place = view.onGlass(x, y);
            ASSERT_TRUE(place);
            const Vec3 seen = glass.place(*place)->point - eye;
            // 10 µm: a thirtieth of a pixel of a frame 1280 wide.
            EXPECT_NEAR(seen.x / seen.y, pixel * (x + 0.5 - 64.0), 2e-5);
            EXPECT_NEAR(seen.z / seen.y, pixel * (36.0 - y - 0.5), 2e-5);
        }
    }
}

TEST(View, DryGlassShowsThePictureThroughThePane)
{
    ViewOptions options = small();
    options.glass_colour = {1.0, 1.0, 1.0};
    const WindshieldParameters parameters = heavyRain();
    DriversView view(parameters.glass, options);
    const Picture behind = slanted(160, 90);
    view.setBackground(behind);
    view.show(startWindshield(parameters));
    EXPECT_EQ(view.frame(), behind);
    const Layer layer = view.layer();
    EXPECT_TRUE(std::all_of(layer.rgba.begin(), layer.rgba.end(), [](std::uint8_t level) { return level == 0; }));
}

TEST(View, DropletsTurnTheSceneUpsideDown)
{
    WindshieldParameters parameters;
    parameters.glass = Glass(Glass::Cylinder{.width = 0.2, .height = 0.2, .radius = kFlat, .slope = 90.0 * kDegree});
    ViewOptions options;
    options.width = 160;
    options.height = 160;
    options.eye_distance = 0.01;
    options.shape.contact_angle = 90.0 * kDegree;
    DriversView view(parameters.glass, options);
    view.setBackground(filled(160, 160, {255, 0, 0}, {0, 0, 255}));
    view.show(oneDroplet(parameters, 20e-9));
    const Layer layer = view.layer();
    const auto at = [&](int x, int y) { return layer.rgba.data() + 4 * (160 * y + x); };
    const double radius = runningShape(20e-9, 0.0, options.shape).contact_radius;
    const int pixels = static_cast<int>(radius / (2.0 * 0.01 * std::tan(22.5 * kDegree) / 160));
    ASSERT_GT(pixels, 20);
    const int third = pixels / 3;
    EXPECT_EQ(at(80, 80)[3], 255);
    EXPECT_GT(at(80, 80 - third)[2], 150) << "blue, of below, above the middle";
    EXPECT_LT(at(80, 80 - third)[0], 60);
    EXPECT_GT(at(80, 80 + third)[0], 150);
    EXPECT_LT(at(80, 80 + third)[2], 60);
}

TEST(View, RunningDropletsAreLongerAlongTheirMotion)
{
    WindshieldParameters parameters;
    parameters.glass = Glass(Glass::Cylinder{.width = 0.2, .height = 0.2, .radius = kFlat, .slope = 90.0 * kDegree});
    ViewOptions options;
    options.width = 200;
    options.height = 200;
    options.eye_distance = 0.03;
    DriversView view(parameters.glass, options);
    WindshieldState state = oneDroplet(parameters, 20e-9);
    const auto extents = [&] {
        view.show(state);
        const Layer layer = view.layer();
        int left = 200;
        int right = 0;
        int top = 200;
        int bottom = 0;
        for (int y = 0; y < 200; ++y) {
            for (int x = 0; x < 200; ++x) {
                if (layer.rgba[static_cast<std::size_t>(4 * (200 * y + x) + 3)] > 127) {
                    left = std::min(left, x);
                    right = std::max(right, x);
                    top = std::min(top, y);
                    bottom = std::max(bottom, y);
                }
            }
        }
        return std::pair(right - left + 1, bottom - top + 1);
    };
    const double pixel = 2.0 * 0.03 * std::tan(22.5 * kDegree) / 200;
    const auto rest = extents();
    EXPECT_NEAR(rest.first, rest.second, 1);
    EXPECT_NEAR(rest.first * pixel, 2.0 * runningShape(20e-9, 0.0, options.shape).contact_radius, 1.5 * pixel);
    state.droplets[0].velocity = {0.0, 1.0};
    const auto climbing = extents();
    const RunningShape shape = runningShape(20e-9, 1.0, options.shape);
    EXPECT_NEAR(climbing.first * pixel, 2.0 * shape.contact_radius, 1.5 * pixel);
    EXPECT_NEAR(climbing.second * pixel, 2.0 * (shape.contact_radius + shape.half_length), 1.5 * pixel);
    state.droplets[0].velocity = {1.0, 0.0};
    EXPECT_EQ(extents(), std::pair(climbing.second, climbing.first));
}

/// Wipers on dry glass, in front of a uniformly bright picture.
class VisibleWipers : public ::testing::Test {
protected:
    VisibleWipers()
    {
        parameters_.wipers = tandemWipers(parameters_.glass, 1.5);
        options_.width = 320;
        options_.height = 180;
        options_.eye_distance = 1.2;
        options_.wipers = parameters_.wipers;
        state_ = startWindshield(parameters_);
    }

    void look(double time, double shutter_time = 0.0)
    {
        options_.shutter_time = shutter_time;
        view_.emplace(parameters_.glass, options_);
        view_->setBackground(slanted(320, 180));
        state_.time = time;
        view_->show(state_);
        layer_ = view_->layer();
    }

    /// Alpha at a place on the glass, relative to a wiper's pivot.
    [[nodiscard]] int alphaAt(const Wiper& wiper, double radius, double angle) const
    {
        const Vec2 place = wiper.pivot + radius * Vec2{std::cos(angle), std::sin(angle)};
        double nearest = 1.0;
        int alpha = 0;
        for (int y = 0; y < 180; ++y) {
            for (int x = 0; x < 320; ++x) {
                const auto here = view_->onGlass(x, y);
                if (here && length(*here - place) < nearest) {
                    nearest = length(*here - place);
                    alpha = layer_.rgba[static_cast<std::size_t>(4 * (320 * y + x) + 3)];
                }
            }
        }
        EXPECT_LT(nearest, 0.004) << "the place is in view";
        return alpha;
    }

    /// Number of covered pixels in a part of a wiper's field.
    [[nodiscard]] int covered(const Wiper& wiper, double from, double to) const
    {
        int count = 0;
        for (int y = 0; y < 180; ++y) {
            for (int x = 0; x < 320; ++x) {
                const auto here = view_->onGlass(x, y);
                if (here) {
                    const Vec2 way = *here - wiper.pivot;
                    const double angle = std::atan2(way.y, way.x);
                    const bool is_in =
                        length(way) > wiper.inner && length(way) < wiper.outer && angle > from && angle < to;
                    count += is_in && layer_.rgba[static_cast<std::size_t>(4 * (320 * y + x) + 3)] > 0 ? 1 : 0;
                }
            }
        }
        return count;
    }

    WindshieldParameters parameters_;
    ViewOptions options_;
    WindshieldState state_;
    std::optional<DriversView> view_;
    Layer layer_;
};

TEST_F(VisibleWipers, BladesAreWhereTheyWipe)
{
    const Wiper wiper = parameters_.wipers[1];
    options_.wipers = {wiper};
    for (const double time : {0.25, 0.4, 0.8, 1.75}) {
        look(time);
        const double angle = wiper.angleAt(time);
        EXPECT_EQ(alphaAt(wiper, 0.45, angle), 255) << time;
        // The glass ahead of the blade and of the pushed water is still dry.
        const bool goes_up = time < 0.6 || time > 1.5;
        if (time < 0.6) {
            EXPECT_EQ(covered(wiper, angle + 0.1, wiper.last), 0) << time;
        }
        // Behind the blade a film in streaks covers a part of the glass.
        const double sign = goes_up ? -1.0 : 1.0;
        const double near = angle + sign * 0.04;
        const double far = angle + sign * 0.3;
        const int wet = covered(wiper, std::min(near, far), std::max(near, far));
        EXPECT_GT(wet, 300) << time;
    }
    look(1.495);
    EXPECT_EQ(covered(wiper, 2.1, 2.35), 0) << "the film is gone where the blade passed 0.76 s ago";
    EXPECT_EQ(view_->frame(), over(layer_, view_->bare()));
}

TEST_F(VisibleWipers, GlassAheadOfTheFirstStrokeIsDry)
{
    Wiper wiper = parameters_.wipers[1];
    wiper.period = wiper.stroke;  // so that a stroke before it would have ended just now
    options_.wipers = {wiper};
    for (const double time : {0.1, 0.15, 0.2, 0.25}) {
        look(time);
        const double angle = wiper.angleAt(time);
        EXPECT_GT(covered(wiper, wiper.first, angle + 0.1), 100) << time;
        EXPECT_EQ(covered(wiper, angle + 0.1, wiper.last), 0) << time;
    }
}

TEST_F(VisibleWipers, TheWedgeOfPushedWaterLiesOnlyAtThePillar)
{
    // The eye sees both turning points.
    options_.eye_distance = 1.8;
    const Wiper& left = parameters_.wipers[0];
    const Wiper& right = parameters_.wipers[1];
    look(0.75);
    EXPECT_GT(alphaAt(left, 0.5, left.last + 0.0125), 0) << "where the left blade has turned";
    const int beside_other = covered(right, right.last + 0.012, right.last + 0.04);
    look(1.45);
    EXPECT_EQ(alphaAt(left, 0.5, left.last + 0.0125), 0) << "it has run off";
    options_.wipers = {right};
    look(0.75);
    const int alone = covered(right, right.last + 0.012, right.last + 0.04);
    EXPECT_GT(alone, 20);
    EXPECT_LT(beside_other, alone / 4) << "the left blade wipes there";
}

TEST_F(VisibleWipers, FramesDoNotDependOnThoseBefore)
{
    DriversView kept(parameters_.glass, options_);
    kept.setBackground(slanted(320, 180));
    for (const double time : {0.1, 0.3, 0.35, 0.9, 0.65, 1.7, 2.9, 3.1, 3.15}) {
        state_.time = time;
        DriversView fresh(parameters_.glass, options_);
        fresh.setBackground(slanted(320, 180));
        fresh.show(state_);
        kept.show(state_);
        EXPECT_EQ(kept.frame(), fresh.frame()) << time;
        EXPECT_EQ(kept.frame(), over(kept.layer(), kept.bare())) << time;
    }
}

TEST_F(VisibleWipers, BladesAreBlurredWhileTheShutterIsOpen)
{
    const Wiper& wiper = parameters_.wipers[1];
    const double angle = wiper.angleAt(0.3);
    look(0.3);
    EXPECT_EQ(alphaAt(wiper, 0.5, angle), 255);
    EXPECT_EQ(alphaAt(wiper, 0.5, angle + 0.08), 0);
    look(0.3, 1.0 / 30.0);
    const int blurred = alphaAt(wiper, 0.5, angle + 0.05);
    EXPECT_GT(blurred, 0);
    EXPECT_LT(blurred, 128);
    EXPECT_NE(view_->frame(), view_->bare());
}

/// Panorama of 24 by 12 fields of 15 degrees, each with its own colour.
Environment fields()
{
    Environment environment{48, 24, {}};
    for (int y = 0; y < 24; ++y) {
        for (int x = 0; x < 48; ++x) {
            environment.radiance.push_back({0.02F * static_cast<float>(1 + x / 2),
                                            0.05F * static_cast<float>(1 + y / 2),
                                            0.3F * static_cast<float>((x / 2 + y / 2) % 3)});
        }
    }
    return environment;
}

/// Colour of the field in a direction: x right, y ahead, z up.
std::array<float, 3> fieldAt(const Environment& environment, Vec3 direction)
{
    const double longitude = std::atan2(direction.x, direction.y) / kDegree;
    const double latitude = std::asin(direction.z / length(direction)) / kDegree;
    const int column = static_cast<int>((longitude + 180.0) / 7.5);
    const int row = static_cast<int>((90.0 - latitude) / 7.5);
    return environment.radiance[static_cast<std::size_t>(48 * row + column)];
}

TEST(View, RaysBeyondThePictureShowThePanorama)
{
    const Environment environment = fields();
    const float half = std::tan(20.0F * static_cast<float>(kDegree));
    Backdrop backdrop(64, 64, half, half);
    const Picture red = filled(64, 64, {255, 0, 0}, {255, 0, 0});
    backdrop.setPicture(red, Highlights(red, 1.0F, 0.0));
    // Turned by a right angle: the picture's middle is to the right of the car.
    for (const bool is_turned : {false, true}) {
        const PictureFrame frame =
            is_turned ? PictureFrame{{0.0F, -1.0F, 0.0F}, {1.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 1.0F}} : PictureFrame{};
        for (const bool is_all : {false, true}) {
            backdrop.setEnvironment(environment, frame, 2.0F, is_all);
            for (double longitude = -172.5; longitude < 180.0; longitude += 15.0) {
                for (double latitude = -82.5; latitude < 90.0; latitude += 15.0) {
                    const double level = std::cos(latitude * kDegree);
                    const Vec3 direction{level * std::sin(longitude * kDegree), level * std::cos(longitude * kDegree),
                                         std::sin(latitude * kDegree)};
                    const bool is_in_picture = direction.y > 0.0 && std::abs(direction.x) < 0.364 * direction.y &&
                                               std::abs(direction.z) < 0.364 * direction.y;
                    const Vec3f own = toFloats(direction);
                    const Vec3f in_car = frame.toCar(own);
                    const auto field = fieldAt(environment, {in_car.x, in_car.y, in_car.z});
                    const Float4 seen = backdrop.at(backdrop.placeOf(own, 0));
                    const Float4 pixel = backdrop.at(backdrop.pixelAt(backdrop.placeOf(own, 0)));
                    for (int c = 0; c < 3; ++c) {
                        const float expected = is_in_picture && !is_all ? (c == 0 ? 1.0F : 0.0F)
                                                                        : 2.0F * field[static_cast<std::size_t>(c)];
                        EXPECT_NEAR(seen[c], expected, 1e-3F) << longitude << " " << latitude;
                        EXPECT_NEAR(pixel[c], expected, 1e-3F) << longitude << " " << latitude;
                    }
                }
            }
        }
    }
}

TEST(View, PanoramaIsTheWholeBackgroundWithoutAPicture)
{
    const Environment environment = fields();
    ViewOptions options = small();
    options.glass_colour = {1.0, 1.0, 1.0};
    options.field_of_view = 90.0 * kDegree;
    const WindshieldParameters parameters = heavyRain();
    DriversView view(parameters.glass, options);
    view.setEnvironment(environment);
    const double pixel = 2.0 / options.width;
    for (const auto& [longitude, latitude] : {std::pair(7.5, 7.5), {-37.5, -7.5}, {22.5, 22.5}, {37.5, -22.5}}) {
        const double right = std::tan(longitude * kDegree);
        const double up = std::tan(latitude * kDegree) * std::hypot(1.0, right);
        const auto x = static_cast<std::size_t>(80.0 + right / pixel);
        const auto y = static_cast<std::size_t>(45.0 - up / pixel);
        const auto field = fieldAt(environment, {right, 1.0, up});
        for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_NEAR(view.bare().rgb[3 * (160 * y + x) + c], encoded(field[c]), 1) << longitude << " " << latitude;
        }
    }
    // Droplets do not depend on earlier pictures.
    const WindshieldState state = rained(parameters, 60);
    view.show(state);
    const Picture around = view.frame();
    EXPECT_NE(around, view.bare());
    DriversView other(parameters.glass, options);
    other.setBackground(slanted(160, 90));
    other.show(state);
    const Layer mirrored = other.layer();
    other.setEnvironment(environment);
    other.show(state);
    EXPECT_NE(other.layer(), mirrored);
    view.setBackground(slanted(160, 90));
    view.show(state);
    EXPECT_EQ(view.layer(), other.layer());
    EXPECT_THROW(view.setEnvironment({}), Error);
}

TEST(View, PointsOfLightOutOfFocusBecomeDiscs)
{
    for (const double pixels : {9.0, 41.0, 90.0}) {  // the last two are computed on smaller pictures
        ViewOptions options;
        options.width = 320;
        options.height = 180;
        options.glass_colour = {1.0, 1.0, 1.0};
        options.highlight_boost = 0.0;
        const double pixel = 2.0 * std::tan(0.5 * options.field_of_view) / options.width;
        options.background_blur = 2.0 * std::atan(0.5 * pixels * pixel);
        options.exposure = std::min(std::log2(0.5 * pixels * pixels), 8.0);
        Picture behind = filled(320, 180, {0, 0, 0}, {0, 0, 0});
        const int x0 = 160;
        const int y0 = 90;
        std::fill_n(behind.rgb.begin() + 3 * (y0 * 320 + x0), 3, std::uint8_t{255});
        DriversView view(Glass(), options);
        view.setBackground(behind);
        const auto light = [&](int x, int y) {
            return static_cast<double>(displayLevels()[view.bare().rgb[static_cast<std::size_t>(3 * (y * 320 + x))]]);
        };
        double sum = 0.0;
        double xx = 0.0;
        double yy = 0.0;
        for (int y = 0; y < 180; ++y) {
            for (int x = 0; x < 320; ++x) {
                sum += light(x, y);
                xx += light(x, y) * (x - x0) * (x - x0);
                yy += light(x, y) * (y - y0) * (y - y0);
            }
        }
        EXPECT_NEAR(sum / std::exp2(options.exposure), 1.0, 0.02) << "light is kept";
        EXPECT_NEAR(4.0 * std::sqrt(xx / sum), pixels, 0.02 * pixels + 0.5) << "a disc's variance is r^2 / 4";
        EXPECT_NEAR(4.0 * std::sqrt(yy / sum), pixels, 0.02 * pixels + 0.5);
        // The disc is uniform and round: a box would reach into its corners.
        const int within = static_cast<int>(0.3 * pixels);
        const int beyond = static_cast<int>(0.45 * pixels) + 1;
        EXPECT_NEAR(light(x0 + within, y0) / light(x0, y0), 1.0, 0.03);
        EXPECT_NEAR(light(x0, y0) * 0.25 * kPi * pixels * pixels / sum, 1.0, 0.05);
        EXPECT_LT(light(x0 + beyond, y0 + beyond), 0.05 * light(x0, y0));
    }
}

TEST(View, DropletsStaySharpInFrontOfABlurredBackground)
{
    const WindshieldParameters parameters = heavyRain();
    ViewOptions options = small();
    const auto seen = [&] {
        DriversView view(parameters.glass, options);
        view.setBackground(slanted(160, 90));
        view.show(rained(parameters, 60));
        return std::pair(view.layer(), view.bare());
    };
    const auto sharp = seen();
    options.background_blur = 3.0 * kDegree;
    const auto blurred = seen();
    EXPECT_EQ(sharp.first, blurred.first);
    EXPECT_NE(sharp.second, blurred.second);
}

/// Near upright flat glass, with a droplet that climbs in the middle.
class Shutter : public ::testing::Test {
protected:
    Shutter()
    {
        parameters_.glass =
            Glass(Glass::Cylinder{.width = 0.2, .height = 0.2, .radius = kFlat, .slope = 90.0 * kDegree});
        options_.width = 200;
        options_.height = 200;
        options_.eye_distance = 0.06;
        options_.samples = 1;
        state_ = oneDroplet(parameters_, 8e-9);
        state_.droplets[0].velocity = {0.0, 1.2};
    }

    [[nodiscard]] double pixel() const { return 2.0 * 0.06 * std::tan(22.5 * kDegree) / 200; }

    /// Frame and layer.
    [[nodiscard]] std::pair<Picture, Layer> seen(const WindshieldState& state, double shutter_time) const
    {
        ViewOptions options = options_;
        options.shutter_time = shutter_time;
        DriversView view(parameters_.glass, options);
        view.setBackground(slanted(200, 200));
        view.show(state);
        return {view.frame(), view.layer()};
    }

    WindshieldParameters parameters_;
    ViewOptions options_;
    WindshieldState state_;
};

TEST_F(Shutter, TheFrameIsTheMeanOfItsMoments)
{
    constexpr double kOpen = 0.02;
    constexpr int kMoments = 96;
    std::vector<double> mean(3 * 200 * 200, 0.0);
    for (int k = 0; k < kMoments; ++k) {
        WindshieldState there = state_;
        there.droplets[0].position.y += kOpen * ((k + 0.5) / kMoments - 0.5) * 1.2;
        const Picture frame = seen(there, 0.0).first;
        for (std::size_t i = 0; i < mean.size(); ++i) {
            mean[i] += static_cast<double>(displayLevels()[frame.rgb[i]]) / kMoments;
        }
    }
    const Picture blurred = seen(state_, kOpen).first;
    const Picture sharp = seen(state_, 0.0).first;
    double sum = 0.0;
    double expected = 0.0;
    double squared = 0.0;
    double squared_sharp = 0.0;
    for (std::size_t i = 0; i < mean.size(); ++i) {
        const auto light = static_cast<double>(displayLevels()[blurred.rgb[i]]);
        sum += light;
        expected += mean[i];
        squared += std::pow(light - mean[i], 2);
        squared_sharp += std::pow(static_cast<double>(displayLevels()[sharp.rgb[i]]) - mean[i], 2);
    }
    EXPECT_NEAR(sum / expected, 1.0, 2e-4) << "light is kept";
    EXPECT_LT(squared, 0.01 * squared_sharp) << "everywhere";
}

TEST_F(Shutter, DropletsAreAsLongAsTheirMotion)
{
    const auto extents = [&](double shutter_time) {
        const Layer layer = seen(state_, shutter_time).second;
        int left = 200;
        int right = 0;
        int top = 200;
        int bottom = 0;
        for (int y = 0; y < 200; ++y) {
            for (int x = 0; x < 200; ++x) {
                if (layer.rgba[static_cast<std::size_t>(4 * (200 * y + x) + 3)] > 0) {
                    left = std::min(left, x);
                    right = std::max(right, x);
                    top = std::min(top, y);
                    bottom = std::max(bottom, y);
                }
            }
        }
        return std::array{right - left, bottom - top, bottom + top};
    };
    const auto sharp = extents(0.0);
    for (const double shutter_time : {1e-3, 5e-3, 0.02}) {
        const auto blurred = extents(shutter_time);
        EXPECT_NEAR(blurred[0], sharp[0], 1);
        EXPECT_NEAR(blurred[1] - sharp[1], 1.2 * shutter_time / pixel(), 2.0) << shutter_time;
        EXPECT_NEAR(blurred[2], sharp[2], 2) << "half before, half after";
    }
}

TEST_F(Shutter, ObjectsAtRestStaySharp)
{
    WindshieldState state = state_;
    RunningDroplet resting = state.droplets[0];
    resting.id = 2;
    resting.velocity = {};
    resting.position.x += 0.012;
    state.droplets.push_back(resting);
    const Picture sharp = seen(state, 0.0).first;
    const Picture blurred = seen(state, 0.02).first;
    const double reach = runningShape(8e-9, 1.2, options_.shape).silhouette();
    const int column = 100 + static_cast<int>(std::ceil(reach / pixel())) + 2;
    bool is_blurred = false;
    for (int y = 0; y < 200; ++y) {
        const auto row = sharp.rgb.begin() + 600 * y;
        const auto other = blurred.rgb.begin() + 600 * y;
        EXPECT_TRUE(std::equal(row + 3 * column, row + 600, other + 3 * column)) << y;
        is_blurred = is_blurred || !std::equal(row, row + 3 * column, other);
    }
    EXPECT_TRUE(is_blurred);
    // If nothing moves, the frame is that of an instant.
    state.droplets[0].velocity = {};
    EXPECT_EQ(seen(state, 0.02), seen(state, 0.0));
}

TEST_F(Shutter, TheRoadIsBlurredAlongItsWay)
{
    ViewOptions options;
    options.width = 320;
    options.height = 180;
    const DefaultBackground road(options);
    EXPECT_EQ(road.at(7.0, 0.0), road.at(7.0));
    constexpr double kPassed = 1.5;
    constexpr int kMoments = 24;
    // Film averages light, so its response, 1 - e^(-1.15 x), is inverted first.
    const auto light = [](const Picture& picture, std::size_t i) {
        return -std::log(1.0 - std::min(static_cast<double>(displayLevels()[picture.rgb[i]]), 0.95)) / 1.15;
    };
    const Picture blurred = road.at(7.0, kPassed);
    std::vector<double> mean(blurred.rgb.size(), 0.0);
    for (int k = 0; k < kMoments; ++k) {
        const Picture one = road.at(7.0 + kPassed * ((k + 0.5) / kMoments - 0.5));
        for (std::size_t i = 0; i < mean.size(); ++i) {
            mean[i] += light(one, i) / kMoments;
        }
    }
    const Picture sharp = road.at(7.0);
    double sum = 0.0;
    double off = 0.0;
    double off_sharp = 0.0;
    for (std::size_t i = 0; i < mean.size(); ++i) {
        sum += light(blurred, i);
        off += std::pow(light(blurred, i) - mean[i], 2);
        off_sharp += std::pow(light(sharp, i) - mean[i], 2);
    }
    EXPECT_NEAR(sum / std::accumulate(mean.begin(), mean.end(), 0.0), 1.0, 0.003);
    EXPECT_LT(off, 0.2 * off_sharp);
}

TEST(View, LayerOverTheBarePictureIsTheFrame)
{
    const WindshieldParameters parameters = heavyRain();
    for (const int samples : {1, 2, 3}) {
        ViewOptions options = small();
        options.samples = samples;
        DriversView view(parameters.glass, options);
        view.setBackground(slanted(160, 90));
        view.show(rained(parameters, 60));
        EXPECT_NE(view.frame(), view.bare());
        EXPECT_EQ(over(view.layer(), view.bare()), view.frame());
    }
}

TEST(View, ManyUpdatesEqualOneUpdate)
{
    const WindshieldParameters parameters = heavyRain();
    const Picture behind = slanted(160, 90);
    DriversView followed(parameters.glass, small());
    followed.setBackground(behind);
    WindshieldState state = startWindshield(parameters);
    for (int k = 0; k < 90; ++k) {
        state = step(std::move(state), parameters, 1.0 / 60.0);
        followed.show(state);
    }
    EXPECT_GT(state.counts.swept, 0U);
    EXPECT_GT(state.counts.wiped, 0U);
    DriversView anew(parameters.glass, small());
    anew.show(state);
    anew.setBackground(behind);
    EXPECT_EQ(followed.layer(), anew.layer());
    // Unchanged cells are not drawn again.
    const std::size_t drawn = followed.cellsDrawn();
    followed.show(state);
    EXPECT_EQ(followed.cellsDrawn(), drawn);
}

TEST(StillMapOf, ManyUpdatesEqualAMapFromScratch)
{
    const WindshieldParameters parameters = heavyRain();
    const MapWindow window{{0.05, 0.03}, {0.21, 0.19}, 1.7e-4};
    StillMap followed(window, 1.7);
    WindshieldState state = startWindshield(parameters);
    for (int k = 0; k < 80; ++k) {
        state = step(std::move(state), parameters, 1.0 / 60.0);
        if (k % 3 == 0) {
            followed.update(StillCells::of(state.still));
        }
    }
    followed.update(StillCells::of(state.still));
    StillMap scratch(window, 1.7);
    scratch.update(StillCells::of(state.still));
    EXPECT_EQ(followed.texels(), scratch.texels());
    EXPECT_TRUE(std::any_of(scratch.texels().begin(), scratch.texels().end(), [](Texel t) { return !t.empty(); }));
}

TEST(StillMapOf, HasTheWaterOfItsDroplets)
{
    WindshieldParameters parameters;
    parameters.glass = Glass(Glass::Cylinder{.width = 0.1, .height = 0.1});
    WindshieldState state = startWindshield(parameters);
    StillCells& still = StillCells::of(state.still);
    const auto cell = static_cast<std::size_t>(0.05 / still.cell);
    const double volume = 0.4e-9;
    still.put(cell * still.columns + cell, {{0.0501, 0.0503}, volume});
    // Midpoints, and a rim with linear coverage, give at least first order.
    double coarse_error = 0.0;
    for (const auto& [texel, angle] : {std::pair(4e-5, 90.0), {2e-5, 90.0}, {2e-5, 140.0}, {2e-5, 60.0}}) {
        StillMap map({{0.04, 0.04}, {0.06, 0.06}, texel}, angle * kDegree);
        map.update(still);
        double sum = 0.0;
        for (const Texel& one : map.texels()) {
            sum += one.thickness() * texel * texel * one.cover() / 255.0;
        }
        const double error = std::abs(sum / volume - 1.0);
        EXPECT_LT(error, 0.02);
        if (angle == 90.0 && coarse_error > 0.0) {
            EXPECT_LT(error, std::max(0.6 * coarse_error, 1e-3));
        }
        coarse_error = error;
    }
}

TEST(View, SameBytesAtAnyNumberOfThreads)
{
    const WindshieldParameters parameters = heavyRain();
    const WindshieldState state = rained(parameters, 50);
    const auto seen = [&](std::size_t threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        DriversView view(parameters.glass, small());
        view.setBackground(slanted(160, 90));
        view.show(state);
        const GlassMaps maps = glassMaps(parameters.glass, state, {.width = 200});
        return std::tuple(view.frame(), view.layer(), maps.normal, maps.thickness, maps.velocity);
    };
    EXPECT_EQ(seen(1), seen(2));
    EXPECT_EQ(seen(1), seen(4));
}

TEST(View, LotusTracksAreBare)
{
    WindshieldParameters parameters = heavyRain();
    parameters.wipers.clear();
    parameters.fluctuation.acceleration = 0.0;
    WindshieldState state = rained(parameters, 60);
    state.droplets.clear();
    const Glass& glass = parameters.glass;
    DriversView view(glass, small());
    const auto wet = [&] {
        view.show(state);
        const Layer layer = view.layer();
        std::size_t covered = 0;
        for (std::size_t i = 3; i < layer.rgba.size(); i += 4) {
            covered += layer.rgba[i] > 0 ? 1 : 0;
        }
        return covered;
    };
    const std::size_t before = wet();
    ASSERT_GT(before, 100U);
    RunningDroplet large;
    large.id = state.next_id++;
    large.position = {0.5 * glass.width(), 0.02};
    large.volume = 100e-9;
    state.droplets.push_back(large);
    parameters.rainfall = 0.0;
    for (int k = 0; k < 60; ++k) {
        state = step(std::move(state), parameters, 1.0 / 60.0);
    }
    ASSERT_GT(state.counts.swept, 20U) << "it has run up the glass";
    state.droplets.clear();
    EXPECT_LT(wet(), before);
}

// A bright sky is also blue in droplets: neither highlights nor light brighter than white change their hue.
TEST(View, DropletsKeepTheHueOfTheBackground)
{
    const WindshieldParameters parameters = heavyRain();
    const WindshieldState state = rained(parameters, 60);
    const std::array<std::uint8_t, 3> sky{115, 165, 252};
    const auto light = [](std::uint8_t level) { return static_cast<double>(displayLevels()[level]); };
    for (const auto& boost : {std::optional<double>(), std::optional(0.0), std::optional(1.0), std::optional(4.0)}) {
        ViewOptions options = small();
        options.glass_colour = {1.0, 1.0, 1.0};
        options.highlight_boost = boost;
        DriversView view(parameters.glass, options);
        view.setBackground(filled(160, 90, sky, sky));
        view.show(state);
        const Layer layer = view.layer();
        std::size_t bright = 0;
        double max = 0.0;
        for (std::size_t i = 0; i < layer.rgba.size(); i += 4) {
            const std::uint8_t* const at = &layer.rgba[i];
            max = std::max(max, light(at[2]));
            if (at[3] > 200 && at[2] > 120) {
                EXPECT_NEAR(light(at[0]) / light(at[2]), light(sky[0]) / light(sky[2]), 0.02);
                EXPECT_NEAR(light(at[1]) / light(at[2]), light(sky[1]) / light(sky[2]), 0.02);
                ++bright;
            }
        }
        EXPECT_GT(bright, 20U);
        if (!boost) {
            EXPECT_LE(max, light(sky[2])) << "by day droplets are no brighter than what they show";
        }
    }
}

TEST(View, LampsByNightAreBrighterThanTheirPixels)
{
    const WindshieldParameters parameters = heavyRain();
    const WindshieldState state = rained(parameters, 60);
    Picture night = filled(160, 90, {12, 14, 20}, {8, 8, 8});
    for (const int x : {40, 41, 42, 43, 120, 121, 122, 123}) {
        for (const int y : {30, 31, 32, 33}) {
            std::copy_n(std::array<std::uint8_t, 3>{255, 190, 90}.data(), 3,
                        &night.rgb[3U * (160U * static_cast<unsigned>(y) + static_cast<unsigned>(x))]);
        }
    }
    const auto brightness = [&](std::optional<double> boost) {
        ViewOptions options = small();
        options.highlight_boost = boost;
        DriversView view(parameters.glass, options);
        view.setBackground(night);
        view.show(state);
        const Layer layer = view.layer();
        return std::accumulate(layer.rgba.begin(), layer.rgba.end(), 0.0);
    };
    EXPECT_GT(brightness(3.0), brightness(0.0));
    EXPECT_EQ(brightness({}), brightness(3.0));
}

TEST(View, AStopDoublesTheLight)
{
    const WindshieldParameters parameters = heavyRain();
    const WindshieldState state = rained(parameters, 40);
    const auto light = [&](double exposure) {
        ViewOptions options = small();
        options.exposure = exposure;
        DriversView view(parameters.glass, options);
        view.setBackground(filled(160, 90, {70, 90, 120}, {60, 50, 40}));
        view.show(state);
        double sum = 0.0;
        for (const std::uint8_t level : view.frame().rgb) {
            sum += static_cast<double>(displayLevels()[level]);
        }
        return sum;
    };
    EXPECT_NEAR(light(1.0) / light(0.0), 2.0, 0.03);
    EXPECT_NEAR(light(-1.0) / light(0.0), 0.5, 0.02);
    EXPECT_THROW(light(9.0), Error);
}

TEST(View, TheEyeFollowsItsOptions)
{
    WindshieldParameters parameters;
    parameters.glass = Glass(Glass::Cylinder{.width = 0.6, .height = 0.4, .radius = kFlat, .slope = 90.0 * kDegree});
    ViewOptions options;
    options.width = 200;
    options.height = 100;
    options.eye = Vec3{0.05, -0.3, 0.02};
    const double pixel = 2.0 * std::tan(22.5 * kDegree) * 0.3 / options.width;
    const auto place = DriversView(parameters.glass, options).onGlass(10, 70);
    ASSERT_TRUE(place);
    EXPECT_NEAR(place->x, 0.3 + 0.05 + pixel * (10.5 - 100.0), 1e-6);
    EXPECT_NEAR(place->y, 0.2 + 0.02 - pixel * (70.5 - 50.0), 1e-6);
    // An eye that looks at a droplet has it, and its place on the glass, in the middle of the frame.
    WindshieldState state = oneDroplet(parameters, 20e-9);
    state.droplets[0].position = {0.43, 0.27};
    options.look_at = Vec3{0.13, 0.0, 0.07};
    DriversView view(parameters.glass, options);
    const auto left = view.onGlass(99, 50);
    const auto right = view.onGlass(100, 49);
    ASSERT_TRUE(left && right);
    EXPECT_NEAR(0.5 * (left->x + right->x), 0.43, 1e-4);
    EXPECT_NEAR(0.5 * (left->y + right->y), 0.27, 1e-4);
    view.setBackground(filled(200, 100, {200, 200, 200}, {50, 50, 50}));
    view.show(state);
    const Layer layer = view.layer();
    Vec2 sum;
    double weight = 0.0;
    for (int y = 0; y < 100; ++y) {
        for (int x = 0; x < 200; ++x) {
            const double alpha = layer.rgba[static_cast<std::size_t>(4 * (200 * y + x) + 3)];
            sum = sum + alpha * Vec2{x + 0.5, y + 0.5};
            weight += alpha;
        }
    }
    ASSERT_GT(weight, 0.0);
    EXPECT_NEAR(sum.x / weight, 100.0, 0.5);
    EXPECT_NEAR(sum.y / weight, 50.0, 0.5);
    options.look_at = Vec3{0.0, -1.0, 0.0};
    EXPECT_THROW(DriversView(parameters.glass, options), Error);
    options.look_at = {};
    options.eye = Vec3{0.0, 0.3, 0.0};
    EXPECT_THROW(DriversView(parameters.glass, options), Error);
}

TEST(View, RejectsInvalidArguments)
{
    const Glass glass;
    EXPECT_THROW(DriversView(glass, {.width = 8}), Error);
    EXPECT_THROW(DriversView(glass, {.field_of_view = 3.2}), Error);
    EXPECT_THROW(DriversView(glass, {.eye_distance = 0.0}), Error);
    EXPECT_THROW(DriversView(glass, {.aim = Vec2{9.0, 9.0}}), Error);
    EXPECT_THROW(DriversView(glass, {.ior = 3.0}), Error);
    EXPECT_THROW(DriversView(glass, {.samples = 5}), Error);
    EXPECT_THROW(DriversView(glass, {.glass_colour = {1.1, 1.0, 1.0}}), Error);
    DriversView view(glass, small());
    EXPECT_THROW(view.setBackground(filled(90, 160, {0, 0, 0}, {0, 0, 0})), Error);
}

TEST(GlassMapsOf, AddUpToTheWaterOnTheGlass)
{
    WindshieldParameters parameters = heavyRain();
    parameters.wipers.clear();
    parameters.splashes = false;  // glass without water is bare
    // Torn droplets lie close together: with a smaller contact angle they would overlap.
    parameters.tear_off_weber = std::numeric_limits<double>::infinity();
    const WindshieldState state = rained(parameters, 20);
    GlassMapOptions options;
    const WaterBalance all = balanceOf(state);
    const auto share = [&] {
        const GlassMaps held = glassMaps(parameters.glass, state, options);
        const double area = parameters.glass.width() * parameters.glass.height();
        double water = 0.0;
        for (const std::uint16_t level : held.thickness.levels) {
            water +=
                level / 65535.0 * options.full_thickness * area / static_cast<double>(held.thickness.levels.size());
        }
        return water / (all.on_glass_still + all.on_glass_running);
    };
    // This holds at any width and contact angle.
    for (const int width : {16, 33, 64, 200, 1024, 3000}) {
        options.width = width;
        EXPECT_NEAR(share(), 1.0, 0.005) << width;
    }
    for (const double angle : {150.0, 120.0, 60.0}) {
        options.width = 256;
        options.shape.contact_angle = angle * kDegree;
        EXPECT_NEAR(share(), 1.0, 0.005) << angle;
    }
    options.width = 1000;
    options.shape.contact_angle = 90.0 * kDegree;
    const GlassMaps maps = glassMaps(parameters.glass, state, options);
    for (std::size_t i = 0; i < maps.thickness.levels.size(); i += 7) {
        const auto value = [&](std::size_t c) { return maps.normal.levels[3 * i + c] / 65535.0 * 2.0 - 1.0; };
        EXPECT_NEAR(value(0) * value(0) + value(1) * value(1) + value(2) * value(2), 1.0, 2e-4);
        if (maps.thickness.levels[i] == 0 && maps.velocity.levels[3 * i + 2] == 0) {
            EXPECT_NEAR(value(2), 1.0, 1e-3);
        }
    }
}

// The film displaces the picture where it is, and nowhere else.
TEST(View, FilmsOfRainBendWhatLiesBehindThem)
{
    const Glass glass;
    WindshieldState state = startWindshield({});
    ViewOptions options;
    options.width = 320;
    options.height = 180;
    DriversView view(glass, options);
    view.setBackground(defaultBackground(options));
    view.show(state);
    const Picture dry = view.frame();
    state.film.cell = 4e-3;
    state.film.columns = 350;
    state.film.rows = 200;
    state.film.thickness.assign(std::size_t{350} * 200, 0);
    for (std::size_t row = 0; row < 200; ++row) {
        std::fill_n(state.film.thickness.begin() + static_cast<std::ptrdiff_t>(350 * row), 170, 15'000'000);  // 0.15 mm
    }
    view.show(state);
    const Picture wet = view.frame();
    int changed_left = 0;
    int changed_right = 0;
    for (int y = 0; y < options.height; ++y) {
        for (int x = 0; x < options.width; ++x) {
            const std::size_t k = 3 * (static_cast<std::size_t>(y) * 320 + static_cast<std::size_t>(x));
            const std::optional<Vec2> place = view.onGlass(x, y);
            const bool differs = !std::equal(&wet.rgb[k], &wet.rgb[k] + 3, &dry.rgb[k]);
            if (place && place->x < 170 * 4e-3 - 8e-3) {
                changed_left += differs ? 1 : 0;
            } else if (!place || place->x > 170 * 4e-3 + 8e-3) {
                changed_right += differs ? 1 : 0;
            }
        }
    }
    EXPECT_GT(changed_left, options.width * options.height / 4);
    EXPECT_EQ(changed_right, 0);
    state.film = Runoff();
    view.show(state);
    EXPECT_EQ(view.frame().rgb, dry.rgb);
}

TEST(GlassMapsOf, FloatMapsMatchIntegerMaps)
{
    WindshieldParameters parameters = heavyRain();
    parameters.wipers.clear();
    const WindshieldState state = rained(parameters, 40);
    const GlassMapOptions options{.width = 300};
    const GlassFloatMaps floats = glassFloatMaps(parameters.glass, state, options);
    const GlassMaps levels = glassMaps(parameters.glass, state, options);
    ASSERT_EQ(floats.thickness.values.size(), levels.thickness.levels.size());
    double water = 0.0;
    for (std::size_t i = 0; i < floats.thickness.values.size(); ++i) {
        const auto thickness = static_cast<double>(floats.thickness.values[i]);
        water += thickness;
        // Rounding errors move to the next pixel.
        EXPECT_NEAR(std::min(thickness, 5e-3), levels.thickness.levels[i] / 65535.0 * 5e-3, 1.6e-7);
        for (std::size_t c = 3 * i; c < 3 * i + 3; ++c) {
            EXPECT_NEAR(static_cast<double>(floats.normal.values[c]), levels.normal.levels[c] / 32767.5 - 1.0, 2e-5);
        }
        for (std::size_t c = 3 * i; c < 3 * i + 2; ++c) {
            const auto speed = std::clamp(static_cast<double>(floats.velocity.values[c]), -2.0, 2.0);
            EXPECT_NEAR(speed, 2.0 * (levels.velocity.levels[c] / 32767.5 - 1.0), 4e-5);
        }
    }
    const WaterBalance all = balanceOf(state);
    water *= parameters.glass.width() * parameters.glass.height() / static_cast<double>(levels.thickness.levels.size());
    EXPECT_NEAR(water / (all.on_glass_still + all.on_glass_running), 1.0, 0.005);
}

// A droplet smaller than a texel looks like smooth glass, not like the normal at the texel's middle.
TEST(GlassMapsOf, NormalsAreMeansOverTheirTexels)
{
    WindshieldParameters parameters;
    parameters.glass = Glass(Glass::Cylinder{.width = 0.1, .height = 0.05});
    WindshieldState state = startWindshield(parameters);
    RunningDroplet droplet;
    droplet.volume = 1e-9;
    // The droplet is in the middle of a texel of 10 mm, or beside it: then the texel's middle lies on its slope.
    for (const double x : {0.035, 0.0355}) {
        state.droplets = {droplet};
        state.droplets[0].position = {x, 0.025};
        const GlassMaps coarse = glassMaps(parameters.glass, state, {.width = 16});
        for (std::size_t i = 0; i < coarse.normal.levels.size(); i += 3) {
            EXPECT_NEAR(coarse.normal.levels[i], 32768, 400);
            EXPECT_GT(coarse.normal.levels[i + 2], 65500);
        }
        // The mean of finer texels is the coarser texel.
        const GlassMaps fine = glassMaps(parameters.glass, state, {.width = 64});
        const auto water = [](const GlassMaps& maps) {
            return std::accumulate(maps.thickness.levels.begin(), maps.thickness.levels.end(), 0.0);
        };
        EXPECT_NEAR(water(fine) / 16.0, water(coarse), 0.01 * water(coarse));
    }
}

TEST(GlassMapsOf, ShowPositionAndVelocityOfADroplet)
{
    WindshieldParameters parameters;
    parameters.glass = Glass(Glass::Cylinder{.width = 0.1, .height = 0.05});
    WindshieldState state = startWindshield(parameters);
    RunningDroplet droplet;
    droplet.position = {0.02, 0.04};  // to the left of the middle, and above it
    droplet.velocity = {-0.5, 1.0};
    droplet.volume = 20e-9;
    state.droplets.push_back(droplet);
    const GlassMaps maps = glassMaps(parameters.glass, state, {.width = 200, .full_speed = 2.0});
    ASSERT_EQ(maps.normal.height, 100);
    const std::size_t middle = 20 * 200 + 40;
    const RunningShape shape = runningShape(20e-9, std::hypot(0.5, 1.0), ShapeOptions());
    EXPECT_NEAR(maps.thickness.levels[middle] / 65535.0 * 5e-3, shape.height(), 0.1e-3);
    EXPECT_NEAR(maps.velocity.levels[3 * middle], 65535 * 0.5 * (1.0 - 0.25), 1.0);
    EXPECT_NEAR(maps.velocity.levels[3 * middle + 1], 65535 * 0.5 * (1.0 + 0.5), 1.0);
    EXPECT_EQ(maps.velocity.levels[3 * middle + 2], 65535);
    // The normal of its right side points right, that of its upper side up.
    EXPECT_GT(maps.normal.levels[3 * (middle + 2)], 33000);
    EXPECT_LT(maps.normal.levels[3 * (middle - 3)], 32500);
    EXPECT_GT(maps.normal.levels[3 * (middle - 2 * 200) + 1], 33000);
    const std::size_t corner = 199;
    EXPECT_EQ(maps.thickness.levels[corner], 0);
    EXPECT_EQ(maps.normal.levels[3 * corner + 2], 65535);
    EXPECT_THROW(glassMaps(parameters.glass, state, {.width = 1}), Error);
    EXPECT_THROW(glassMaps(parameters.glass, state, {.full_speed = 0.0}), Error);
}

TEST(View, DefaultBackgroundChangesOnlyWithTheWay)
{
    const Picture here = defaultBackground(small());
    EXPECT_EQ(here.width, small().width);
    EXPECT_EQ(here.height, small().height);
    EXPECT_EQ(here, defaultBackground(small()));
    EXPECT_NE(here, defaultBackground(small(), 3.0));
    EXPECT_THROW(defaultBackground({.width = 0}), Error);
    EXPECT_THROW(defaultBackground(small(), std::nan("")), Error);
}

TEST(DefaultBackgroundOf, OnlyLightsAndDashesMove)
{
    ViewOptions options;
    options.width = 640;
    options.height = 360;
    const DefaultBackground road(options);
    const Picture here = road.at(0.0);
    EXPECT_EQ(here, defaultBackground(options));
    EXPECT_EQ(here, road.at(0.0)) << "nothing of one picture is left in the next";
    const Picture there = road.at(7.0);
    EXPECT_EQ(there, defaultBackground(options, 7.0));
    // Lights and dashes lie in a quarter of the picture; sky, verges and continuous lines do not change.
    std::size_t changed = 0;
    for (std::size_t i = 0; i < here.rgb.size(); i += 3) {
        changed += std::equal(&here.rgb[i], &here.rgb[i] + 3, &there.rgb[i]) ? 0 : 1;
    }
    EXPECT_GT(changed, here.rgb.size() / 3 / 100);
    EXPECT_LT(changed, here.rgb.size() / 3 / 4);
    const auto sample = [&](double travelled) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
        return road.at(travelled);
    };
    EXPECT_EQ(there, sample(7.0));
}

// The lens blurs lines in all directions, as it does lights.
TEST(DefaultBackgroundOf, LinesAlongTheRoadAreSoft)
{
    ViewOptions options;
    options.width = 1280;
    options.height = 720;
    const Picture road = defaultBackground(options);
    const auto level = [&](int x, int y) { return int{road.rgb[static_cast<std::size_t>(3 * (1280 * y + x) + 2)]}; };
    // 1.75 m to the right and 5.25 m to the left of an eye 1.2 m over the road, below all lights.
    for (const double across : {1.75, -5.25}) {
        double steepest = 0.0;
        double brightest = 0.0;
        for (int y = 460; y < 680; ++y) {
            const int x = static_cast<int>(639.5 + across / 1.2 * (y + 0.5 - 360.0));
            for (int j = y - 18; x > 40 && x < 1240 && j < y + 18; ++j) {
                steepest = std::max(steepest, std::hypot(level(x, j + 1) - level(x, j), level(x + 1, j) - level(x, j)));
                brightest = std::max(brightest, 1.0 * level(x, y) - level(x, y + 18));
            }
        }
        EXPECT_GT(brightest, 10.0) << across;
        EXPECT_LT(steepest, 6.0) << across;
    }
}

}  // namespace
}  // namespace droplet
