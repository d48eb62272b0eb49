// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/liquid2d_io/fluid_presets.h"

#include "entry_named.h"

namespace droplet {
namespace {

constexpr double kThickness = 0.2;  // of walls around the window [m]
// Spacings give about 20 000 particles, at the end if they come from an emitter.

/// Floor and sides around a window, higher than it.
Wall tank(Vec2 size)
{
    const double top = size.y + 0.5;
    return {.region = {{{{-kThickness, top},
                         {-kThickness, -kThickness},
                         {size.x + kThickness, -kThickness},
                         {size.x + kThickness, top},
                         {size.x, top},
                         {size.x, 0.0},
                         {0.0, 0.0},
                         {0.0, top}}}},
            .motion = {}};
}

FluidPreset splash()
{
    FluidPreset preset{.name = "splash",
                       .what = "a droplet falls into a still pool",
                       .scene = {},
                       .duration = 3.0,
                       .style = "cartoon"};
    preset.scene.spacing = 0.012;
    preset.scene.walls = {tank(preset.scene.size)};
    preset.scene.liquid = {{.region = rectangle({0.0, 0.0}, {4.0, 0.7})},
                           {.region = circle({2.0, 1.4}, 0.22), .velocity = {0.0, -3.0}, .rings = true}};
    return preset;
}

FluidPreset wave()
{
    FluidPreset preset{.name = "wave",
                       .what = "a wall pushes waves onto a beach, where they break",
                       .scene = {},
                       .duration = 8.0,
                       .style = "wave"};
    FluidScene& scene = preset.scene;
    scene.size = {6.0, 2.0};
    scene.spacing = 0.01;
    scene.margin = 1.5;
    const double front = 0.5;  // of the wall at rest
    scene.walls = {{.region = rectangle({-1.2, -0.3}, {6.3, 0.0}), .motion = {}},
                   {.region = {{{{2.8, -0.1}, {5.6, 1.0}, {6.3, 1.0}, {6.3, -0.1}}}}, .motion = {}},
                   {.region = rectangle({6.0, 0.9}, {6.3, 2.5}), .motion = {}},
                   {.region = rectangle({front - 0.5, -0.05}, {front, 1.9}),
                    .motion = WallMotion{.amplitude = {0.35, 0.0}, .period = 1.7}}};
    scene.liquid = {{.region = rectangle({front + 0.01, 0.0}, {4.7, 0.62})}};
    return preset;
}

FluidPreset dam()
{
    FluidPreset preset{.name = "dam",
                       .what = "a column of water, twice as high as wide, collapses and meets the other wall",
                       .scene = {},
                       .duration = 3.0,
                       .style = "cartoon"};
    FluidScene& scene = preset.scene;
    scene.size = {3.2, 1.8};
    scene.spacing = 0.006;
    scene.walls = {tank(scene.size)};
    scene.liquid = {{.region = rectangle({0.0, 0.0}, {0.6, 1.2})}};
    return preset;
}

FluidPreset pour()
{
    FluidPreset preset{.name = "pour",
                       .what = "a jet meets a ball and fills a bowl",
                       .scene = {},
                       .duration = 5.0,
                       .style = "cartoon"};
    FluidScene& scene = preset.scene;
    scene.size = {3.2, 2.4};
    scene.spacing = 0.007;
    const double middle = 1.6;
    // Outer side from the left rim, then the inner side back.
    const std::vector<Vec2> bowl{{middle - 0.9, 1.3}, {middle - 0.6, 0.1},  {middle + 0.6, 0.1},  {middle + 0.9, 1.3},
                                 {middle + 0.8, 1.3}, {middle + 0.52, 0.2}, {middle - 0.52, 0.2}, {middle - 0.8, 1.3}};
    scene.walls = {{.region = {{bowl}}, .motion = {}},
                   {.region = circle({middle, 0.75}, 0.14), .motion = {}},
                   {.region = rectangle({-0.5, -0.2}, {3.7, 0.1}), .motion = {}}};
    scene.emitters = {{.position = {middle - 0.04, 2.3}, .velocity = {0.0, -2.0}, .width = 0.16, .end = 3.2}};
    return preset;
}

}  // namespace

const std::vector<FluidPreset>& fluidPresets()
{
    static const std::vector<FluidPreset> presets{splash(), wave(), dam(), pour()};
    return presets;
}

const FluidPreset& fluidPresetNamed(std::string_view name)
{
    return entryNamed(fluidPresets(), name, "scene");
}

}  // namespace droplet
