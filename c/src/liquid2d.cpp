// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "droplet/error.h"
#include "droplet/expression/expression.h"
#include "droplet/liquid2d/fluid.h"
#include "droplet/liquid2d/touch.h"
#include "droplet/liquid2d_io/fluid_presets.h"
#include "droplet/liquid2d_io/liquid_drawing.h"
#include "droplet/liquid2d_io/liquid_lottie.h"
#include "entry_named.h"
#include "guarded.h"
#include "require.h"

using binding::guarded;
using binding::required;
using droplet::FluidScene;
using droplet::Vec2;

struct DropletLiquid2d {
    FluidScene scene;
    std::optional<droplet::FluidStepper> stepper;  ///< of the scene as it is; none after a change
    droplet::FluidState state;
    droplet::ExpressionOptions options;
    droplet::ExpressionState memory;  ///< of the surface
    droplet::LiquidShape shape;       ///< that was drawn last
    std::vector<droplet::Region> walls;
    std::vector<DropletOutline> outlines;
    std::vector<float> points;
    std::optional<droplet::LiquidLottie> recording;
    std::string text;  ///< that was written last
};

namespace {

/// Particles that may be poured, over those at the start.
constexpr std::size_t kMost = 3;

struct Parameter {
    std::string name;
    double low;
    double high;
    double (*get)(const FluidScene&);
    void (*set)(FluidScene&, double);
};

const std::vector<Parameter>& parameters()
{
    static const std::vector<Parameter> list{
        {"gravity", -100.0, 100.0, [](const FluidScene& scene) { return -scene.gravity.y; },
         [](FluidScene& scene, double value) {
             scene.gravity = {0.0, -value};
         }},
        {"surface-tension", 0.0, 100.0, [](const FluidScene& scene) { return scene.surface_tension; },
         [](FluidScene& scene, double value) { scene.surface_tension = value; }},
        {"viscosity", 0.0, 1.0, [](const FluidScene& scene) { return scene.viscosity.value_or(0.0); },
         [](FluidScene& scene, double value) { scene.viscosity = value; }},
    };
    return list;
}

droplet::ExpressionOptions optionsOf(std::string_view style)
{
    return droplet::expressionOf(droplet::liquidStyleNamed(style));
}

/// The presets, and an empty basin.
const std::vector<droplet::FluidPreset>& presets()
{
    static const std::vector<droplet::FluidPreset> list = [] {
        std::vector<droplet::FluidPreset> all = droplet::fluidPresets();
        droplet::FluidPreset basin = droplet::fluidPresetNamed("splash");
        basin.name = "basin";
        basin.scene.liquid.clear();
        all.push_back(std::move(basin));
        return all;
    }();
    return list;
}

droplet::FluidState stateAtStart(const FluidScene& scene)
{
    return scene.liquid.empty() && scene.emitters.empty() ? droplet::FluidState{} : droplet::startFluid(scene);
}

/// Area that a scene's particles fill [m²].
double filledArea(const FluidScene& scene)
{
    double area = static_cast<double>(stateAtStart(scene).position.size()) * scene.spacing * scene.spacing;
    for (const droplet::Emitter& emitter : scene.emitters) {
        area += length(emitter.velocity) * emitter.width * (emitter.end - emitter.begin);
    }
    return area > 0.0 ? area : 0.5 * scene.size.x * scene.size.y;
}

/// Brings shape and walls up to the state.
void draw(DropletLiquid2d& liquid)
{
    if (liquid.memory.frames > 0 && !(liquid.state.time > liquid.shape.time)) {
        return;
    }
    const droplet::ParticleFrame frame = frameOf(liquid.state, liquid.scene);
    liquid.memory = droplet::advanceExpression(std::move(liquid.memory), frame, liquid.options);
    liquid.shape = droplet::liquidShape(liquid.memory, frame, liquid.options);
    liquid.memory = droplet::remember(std::move(liquid.memory), liquid.shape);
    liquid.shape.time = liquid.state.time;
    liquid.walls = droplet::visibleWalls(liquid.scene, liquid.state.time);
}

std::uint32_t numberOf(const std::optional<droplet::Colour>& colour)
{
    return colour ? std::uint32_t{(*colour)[0]} << 16U | std::uint32_t{(*colour)[1]} << 8U | (*colour)[2]
                  : DROPLET_NO_COLOUR;
}

void add(DropletLiquid2d& liquid, DropletLiquidLayer layer, const std::vector<Vec2>& points)
{
    liquid.outlines.push_back({layer, static_cast<std::uint32_t>(points.size())});
    for (const Vec2 point : points) {
        liquid.points.push_back(static_cast<float>(point.x));
        liquid.points.push_back(static_cast<float>(point.y));
    }
}

const droplet::LiquidLook& lookNamed(const char* name)
{
    return droplet::liquidLookNamed(name != nullptr ? name : "flat");
}

droplet::LiquidView viewOf(const DropletLiquid2d& liquid, int width)
{
    droplet::requireWithin("width", width, 16, 16384);
    const Vec2 size = liquid.scene.size;
    return {size, width, std::max(static_cast<int>(std::lround(width * size.y / size.x)), 1)};
}

droplet::LiquidLottie& recordingOf(DropletLiquid2d& liquid)
{
    droplet::require(liquid.recording.has_value(), "liquid", "without an animation", "after droplet_liquid2d_record()");
    return *liquid.recording;
}

}  // namespace

DropletCode droplet_liquid2d_new(const DropletLiquid2dScene* scene, DropletLiquid2d** made)
{
    return guarded([&] {
        required("scene", scene);
        required("made", made);
        const droplet::FluidPreset& preset =
            droplet::entryNamed(presets(), scene->preset != nullptr ? scene->preset : "splash", "preset");
        if (scene->particles < 100 || scene->particles > 1000000) {
            droplet::refuseValue("particles", scene->particles, "from 100 to 1e6");
        }
        auto liquid = std::make_unique<DropletLiquid2d>();
        liquid->options = optionsOf(scene->style != nullptr ? scene->style : preset.style);
        liquid->scene = preset.scene;
        liquid->scene.spacing = std::sqrt(filledArea(preset.scene) / static_cast<double>(scene->particles));
        liquid->scene.max_particles = kMost * static_cast<std::size_t>(scene->particles);
        liquid->state = stateAtStart(liquid->scene);
        *made = liquid.release();
    });
}

void droplet_liquid2d_delete(DropletLiquid2d* liquid)
{
    delete liquid;
}

DropletCode droplet_liquid2d_set(DropletLiquid2d* liquid, const char* name, double value)
{
    return guarded([&] {
        required("liquid", liquid);
        const Parameter& parameter = droplet::entryNamed(parameters(), required("name", name), "name");
        if (!(value >= parameter.low && value <= parameter.high)) {
            droplet::refuseValue(parameter.name, value, fmt::format("from {} to {}", parameter.low, parameter.high));
        }
        parameter.set(liquid->scene, value);
        liquid->stepper.reset();
    });
}

DropletCode droplet_liquid2d_get(const DropletLiquid2d* liquid, const char* name, double* value)
{
    return guarded([&] {
        required("value", value);
        *value =
            droplet::entryNamed(parameters(), required("name", name), "name").get(required("liquid", liquid)->scene);
    });
}

DropletCode droplet_liquid2d_style(DropletLiquid2d* liquid, const char* style)
{
    return guarded([&] {
        required("liquid", liquid);
        liquid->options = optionsOf(required("style", style));
        liquid->memory = {};
    });
}

DropletCode droplet_liquid2d_advance(DropletLiquid2d* liquid, double seconds)
{
    return guarded([&] {
        required("liquid", liquid);
        droplet::require(seconds > 0.0 && std::isfinite(seconds), "seconds", seconds, "finite and more than 0");
        if (!liquid->stepper) {
            liquid->stepper.emplace(liquid->scene);
        }
        liquid->state = liquid->stepper->advance(liquid->state, liquid->state.time + seconds);
    });
}

DropletCode droplet_liquid2d_pour(DropletLiquid2d* liquid, const DropletPour* pour)
{
    return guarded([&] {
        required("liquid", liquid);
        required("pour", pour);
        liquid->state =
            droplet::poured(liquid->state, liquid->scene,
                            {.middle = {pour->x, pour->y}, .radius = pour->radius, .velocity = {pour->vx, pour->vy}});
    });
}

DropletCode droplet_liquid2d_stir(DropletLiquid2d* liquid, const DropletStir* stir)
{
    return guarded([&] {
        required("liquid", liquid);
        required("stir", stir);
        liquid->state = droplet::stirred(liquid->state, {.from = {stir->from_x, stir->from_y},
                                                         .to = {stir->to_x, stir->to_y},
                                                         .radius = stir->radius,
                                                         .seconds = stir->seconds});
    });
}

DropletCode droplet_liquid2d_figures(const DropletLiquid2d* liquid, DropletLiquid2dFigures* figures)
{
    return guarded([&] {
        required("liquid", liquid);
        const droplet::FluidState& state = liquid->state;
        double sum = 0.0;
        for (const Vec2 velocity : state.velocity) {
            sum += length(velocity);
        }
        const std::size_t count = state.position.size();
        *required("figures", figures) = {.time = state.time,
                                         .width = liquid->scene.size.x,
                                         .height = liquid->scene.size.y,
                                         .spacing = liquid->scene.spacing,
                                         .mean_speed = count > 0 ? sum / static_cast<double>(count) : 0.0,
                                         .particles = count};
    });
}

DropletCode droplet_liquid2d_outlines(DropletLiquid2d* liquid, DropletOutlines* outlines)
{
    return guarded([&] {
        required("liquid", liquid);
        required("outlines", outlines);
        draw(*liquid);
        liquid->outlines.clear();
        liquid->points.clear();
        for (const auto& [layer, loops] :
             {std::pair{DROPLET_LIQUID, &liquid->shape.liquid}, std::pair{DROPLET_DROPLETS, &liquid->shape.droplets},
              std::pair{DROPLET_FOAM, &liquid->shape.foam}}) {
            for (const droplet::Loop& loop : *loops) {
                add(*liquid, layer, loop.points);
            }
        }
        for (const droplet::Region& wall : liquid->walls) {
            for (const std::vector<Vec2>& loop : wall.loops) {
                add(*liquid, DROPLET_WALL, loop);
            }
        }
        *outlines = {liquid->outlines.data(), liquid->outlines.size(), liquid->points.data()};
    });
}

DropletCode droplet_liquid2d_look(const char* name, DropletLiquidLook* look)
{
    return guarded([&] {
        required("look", look);
        const droplet::LiquidLook& of = droplet::liquidLookNamed(required("name", name));
        *look = {.water = numberOf(of.water),
                 .droplet = numberOf(of.droplet),
                 .foam = numberOf(of.foam),
                 .line = numberOf(of.line),
                 .wall = numberOf(of.wall),
                 .background = numberOf(of.background),
                 .line_width = of.line_width};
    });
}

DropletCode droplet_liquid2d_svg(DropletLiquid2d* liquid, const char* look, int32_t width, const char** svg)
{
    return guarded([&] {
        required("liquid", liquid);
        required("svg", svg);
        std::ostringstream out;
        droplet::writeLiquidSvg({liquid->shape, liquid->walls}, viewOf(*liquid, width), lookNamed(look), out);
        liquid->text = out.str();
        *svg = liquid->text.c_str();
    });
}

DropletCode droplet_liquid2d_record(DropletLiquid2d* liquid, const char* look, int32_t width, double frames_per_second)
{
    return guarded([&] {
        required("liquid", liquid);
        droplet::require(frames_per_second >= 1.0 && frames_per_second <= 1000.0, "frames_per_second",
                         frames_per_second, "from 1 to 1000");
        liquid->recording.emplace(viewOf(*liquid, width), lookNamed(look), frames_per_second);
    });
}

DropletCode droplet_liquid2d_keep(DropletLiquid2d* liquid)
{
    return guarded([&] {
        required("liquid", liquid);
        recordingOf(*liquid).add({liquid->shape, liquid->walls});
    });
}

DropletCode droplet_liquid2d_lottie(DropletLiquid2d* liquid, const char** lottie)
{
    return guarded([&] {
        required("liquid", liquid);
        required("lottie", lottie);
        std::ostringstream out;
        recordingOf(*liquid).write(out);
        liquid->text = out.str();
        *lottie = liquid->text.c_str();
    });
}
