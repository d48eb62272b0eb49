// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/windshield/windshield.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "droplet/error.h"
#include "droplet/surface/textured_mesh.h"
#include "droplet/windshield/balance.h"
#include "droplet/windshield/glass.h"
#include "droplet/windshield/presets.h"
#include "droplet/windshield/touch.h"
#include "droplet/windshield_view/windshield_maps.h"
#include "guarded.h"

using binding::guarded;
using binding::required;
using droplet::Error;
using droplet::ErrorCode;
using droplet::Vec2;
using droplet::Vec3;

struct DropletWindshield {
    droplet::WindshieldParameters parameters;
    droplet::WindshieldState state;
    double speed = 0.0;         ///< wanted [m/s]; the vehicle's comes nearer to it with every step
    double wiper_period = 0.0;  ///< wanted [s]; 0: none
    std::optional<droplet::WindshieldMaps> maps;
    double drawn_angle = 0.0;  ///< contact angle of the maps [rad]
    bool is_blank = true;      ///< whether nothing has been drawn on the maps
    std::vector<DropletTile> tiles;
    std::vector<std::uint8_t> mist;
    std::vector<std::uint8_t> runoff;
    std::vector<DropletCorner> corners;  ///< of the glass's triangles
};

namespace {

/// Largest acceleration of the car: full braking on a dry road is about 1 g [m/s²].
constexpr double kMaxAcceleration = 12.0;

/// Blades that never start again: their stroke ends, and the next one is beyond the end of time.
constexpr double kOneStroke = 1e9;  // period [s]

bool hasBegun(const DropletWindshield& windshield)
{
    return windshield.state.time > 0.0;
}

void requireNotBegun(const DropletWindshield& windshield, std::string_view name)
{
    if (hasBegun(windshield)) {
        throw Error(ErrorCode::InvalidArgument, fmt::format("{} must be set before the first step", name));
    }
}

/// Time at which wipers of a new period start, and whether they are between strokes now.
struct WiperStart {
    double time = 0.0;
    bool rests = true;
};

WiperStart nextStart(const DropletWindshield& windshield)
{
    const double now = windshield.state.time;
    if (windshield.parameters.wipers.empty()) {
        return {now, true};
    }
    const droplet::Wiper& wiper = windshield.parameters.wipers.front();
    const double since = now - wiper.start;
    const double phase = since - wiper.period * std::floor(since / wiper.period);
    return phase < wiper.stroke ? WiperStart{now - phase, false} : WiperStart{now, true};
}

void setWipers(DropletWindshield& windshield, double period)
{
    if (!(period == 0.0 || (period >= 1.2 && period <= 60.0))) {
        throw Error(ErrorCode::InvalidArgument,
                    fmt::format("wiper-period is {} s; it must be 0 or from 1.2 to 60 s", period));
    }
    const WiperStart start = nextStart(windshield);
    std::vector<droplet::Wiper>& wipers = windshield.parameters.wipers;
    windshield.wiper_period = period;
    if (period == 0.0 && start.rests) {
        wipers.clear();
        return;
    }
    wipers = droplet::tandemWipers(windshield.parameters.glass, period == 0.0 ? kOneStroke : period);
    for (droplet::Wiper& wiper : wipers) {
        wiper.start = start.time;
    }
}

/// Parameter of a windshield, by its name.
struct Parameter {
    std::string_view name;
    double low = 0.0;
    double high = 0.0;
    bool before_the_first_step = false;
    std::function<double(const DropletWindshield&)> get;
    std::function<void(DropletWindshield&, double)> set;
};

/// Parameter that is one number of the library's.
template <typename Place>
Parameter number(std::string_view name, double low, double high, const Place& place)
{
    return {name,
            low,
            high,
            false,
            [place](const DropletWindshield& windshield) { return place(windshield.parameters); },
            [place](DropletWindshield& windshield, double value) { place(windshield.parameters) = value; }};
}

/// Gives a windshield another glass, before the first step.
/// @throws droplet::Error  InvalidArgument: it is too large; nothing has changed
void setGlass(DropletWindshield& windshield, droplet::Glass glass)
{
    droplet::WindshieldParameters parameters = windshield.parameters;
    parameters.glass = std::move(glass);
    droplet::WindshieldState state = droplet::startWindshield(parameters);
    // The places of all water belong to the size of the glass.
    state.arriving = std::move(windshield.state.arriving);
    state.sprayed = windshield.state.sprayed;
    windshield.state = std::move(state);
    windshield.parameters = std::move(parameters);
    windshield.maps.reset();
    setWipers(windshield, windshield.wiper_period);
}

/// The cylinder of the glass.
/// @throws droplet::Error  InvalidArgument: the glass is a mesh
droplet::Glass::Cylinder cylinderOf(const DropletWindshield& windshield, std::string_view name)
{
    const auto cylinder = windshield.parameters.glass.cylinder();
    if (!cylinder) {
        throw Error(ErrorCode::InvalidArgument, fmt::format("{}: the glass is a mesh, which has its own", name));
    }
    return *cylinder;
}

/// Number of a glass that is a cylinder's.
Parameter ofGlass(std::string_view name, double low, double high, double droplet::Glass::Cylinder::*member)
{
    return {name,
            low,
            high,
            true,
            [name, member](const DropletWindshield& windshield) { return cylinderOf(windshield, name).*member; },
            [name, member](DropletWindshield& windshield, double value) {
                droplet::Glass::Cylinder cylinder = cylinderOf(windshield, name);
                cylinder.*member = value;
                setGlass(windshield, droplet::Glass(cylinder));
            }};
}

const std::vector<Parameter>& parameters()
{
    constexpr double kAny = std::numeric_limits<double>::max();
    using droplet::kDegree;
    using droplet::kMillimetrePerHour;
    static const std::vector<Parameter> list{
        {"speed", 0.0, 150.0, false, [](const DropletWindshield& windshield) { return windshield.speed; },
         [](DropletWindshield& windshield, double value) {
             windshield.speed = value;
             if (!hasBegun(windshield)) {
                 windshield.parameters.vehicle = droplet::constantSpeed(value);
             }
         }},
        number(
            "rain", 0.0, 1000.0 * kMillimetrePerHour, [](auto& p) -> auto& { return p.rainfall; }),
        number(
            "noise", 0.0, 1000.0, [](auto& p) -> auto& { return p.fluctuation.acceleration; }),
        {"wiper-period", 0.0, 60.0, false, [](const DropletWindshield& windshield) { return windshield.wiper_period; },
         setWipers},
        {"seed", 0.0, 0x1p53, true,
         [](const DropletWindshield& windshield) { return static_cast<double>(windshield.parameters.seed); },
         [](DropletWindshield& windshield, double value) {
             windshield.parameters.seed = static_cast<std::uint64_t>(value);
         }},
        number(
            "gravity", 0.0, 1000.0, [](auto& p) -> auto& { return p.forces.gravity; }),
        number(
            "contact-angle", kDegree, 179.0 * kDegree, [](auto& p) -> auto& { return p.forces.wetting.contact_angle; }),
        number(
            "hysteresis", 0.0, 2.0, [](auto& p) -> auto& { return p.forces.wetting.hysteresis; }),
        number(
            "kinetic-fraction", 0.0, 1.0, [](auto& p) -> auto& { return p.forces.wetting.kinetic_fraction; }),
        number(
            "viscosity-factor", 0.0, kAny, [](auto& p) -> auto& { return p.forces.wetting.viscosity_factor; }),
        number(
            "film", 0.0, 1e-3, [](auto& p) -> auto& { return p.streaks.film; }),
        number(
            "still-diameter", 1.1e-4, 2e-3, [](auto& p) -> auto& { return p.still_diameter; }),
        number(
            "runoff", 0.0, 10.0, [](auto& p) -> auto& { return p.runoff; }),
        number(
            "mist", 0.0, 1e-6, [](auto& p) -> auto& { return p.mist; }),
        {"splashes", 0.0, 1.0, false,
         [](const DropletWindshield& windshield) { return windshield.parameters.splashes ? 1.0 : 0.0; },
         [](DropletWindshield& windshield, double value) { windshield.parameters.splashes = value > 0.0; }},
        ofGlass("glass-width", 0.05, 5.0, &droplet::Glass::Cylinder::width),
        ofGlass("glass-height", 0.05, 5.0, &droplet::Glass::Cylinder::height),
        ofGlass("glass-radius", 0.1, 1e6, &droplet::Glass::Cylinder::radius),
        ofGlass("slope", 0.0, 90.0 * kDegree, &droplet::Glass::Cylinder::slope),
    };
    return list;
}

const Parameter& parameterNamed(std::string_view name)
{
    std::string all;
    for (const Parameter& parameter : parameters()) {
        if (parameter.name == name) {
            return parameter;
        }
        all += all.empty() ? "" : ", ";
        all += parameter.name;
    }
    throw Error(ErrorCode::InvalidArgument, fmt::format("name: '{}' is none of {}", name, all));
}

/// Speed of the vehicle in a step: from what it is towards what is wanted.
droplet::DriveCycle driveTowards(const DropletWindshield& windshield, double dt)
{
    const double now = windshield.state.time;
    const double speed = windshield.parameters.vehicle.speedAt(now);
    const double change = std::clamp(windshield.speed - speed, -kMaxAcceleration * dt, kMaxAcceleration * dt);
    return change == 0.0 ? droplet::constantSpeed(speed)
                         : droplet::DriveCycle{{now, now + dt}, {speed, speed + change}};
}

/// Maps of a width and of the contact angle; new ones of bare glass if they are others.
void layOutMaps(DropletWindshield& windshield, std::int32_t width)
{
    const double angle = windshield.parameters.forces.wetting.contact_angle;
    if (windshield.maps && windshield.maps->width() == width && windshield.drawn_angle == angle) {
        return;
    }
    droplet::WindshieldMapOptions options{.width = width};
    options.shape.contact_angle = angle;
    windshield.maps.emplace(windshield.parameters.glass, options);
    windshield.drawn_angle = angle;
    windshield.is_blank = true;
}

std::vector<DropletTile> tilesOver(const droplet::WindshieldMaps& maps)
{
    constexpr int kTile = droplet::WindshieldMaps::kTile;
    std::vector<DropletTile> tiles;
    for (int y = 0; y < maps.height(); y += kTile) {
        for (int x = 0; x < maps.width(); x += kTile) {
            tiles.push_back({x, y, std::min(kTile, maps.width() - x), std::min(kTile, maps.height() - y)});
        }
    }
    return tiles;
}

void put(const Vec3& vector, double (&place)[3])  // NOLINT(modernize-avoid-c-arrays): of a structure of C
{
    place[0] = vector.x;
    place[1] = vector.y;
    place[2] = vector.z;
}

void put(const droplet::GlassPlace& from, DropletPlace& place)
{
    put(from.point, place.point);
    put(from.normal, place.normal);
    put(from.across, place.across);
    put(from.up, place.up);
}

/// Puts cells of the glass into a map.
/// @param water   has `thickness`, of every cell, empty if there is none
/// @param levels  for a unit of the thickness
template <typename Water>
void putMap(const Water& water, double levels, const DropletWindshield& windshield, std::vector<std::uint8_t>& pixels,
            DropletMistMap& map)
{
    const droplet::Glass& glass = windshield.parameters.glass;
    if (water.thickness.empty()) {
        pixels.assign(1, 0);
        map = {pixels.data(), 1, 1, 1.0, 1.0};
        return;
    }
    pixels.resize(water.thickness.size());
    const auto scale = static_cast<float>(levels);
    for (std::size_t row = 0; row < water.rows; ++row) {
        const auto* const from = water.thickness.data() + row * water.columns;
        std::uint8_t* const to = pixels.data() + (water.rows - 1 - row) * water.columns;
        for (std::size_t k = 0; k < water.columns; ++k) {
            to[k] = static_cast<std::uint8_t>(std::min(scale * static_cast<float>(from[k]) + 0.5F, 255.0F));
        }
    }
    map = {pixels.data(), static_cast<int32_t>(water.columns), static_cast<int32_t>(water.rows),
           water.columns * water.cell / glass.width(), water.rows * water.cell / glass.height()};
}

droplet::TexturedMesh objectOf(const DropletMesh& mesh)
{
    droplet::TexturedMesh object;
    const auto vectors = [&](const float* numbers) {
        std::vector<Vec3> list(mesh.vertices);
        for (std::size_t k = 0; k < list.size(); ++k) {
            list[k] = {numbers[3 * k], numbers[3 * k + 1], numbers[3 * k + 2]};
        }
        return list;
    };
    object.vertices = vectors(required("mesh.positions", mesh.positions));
    object.normals = vectors(required("mesh.normals", mesh.normals));
    const float* const uvs = required("mesh.uvs", mesh.uvs);
    for (std::size_t k = 0; k < mesh.vertices; ++k) {
        object.uvs.push_back({uvs[2 * k], uvs[2 * k + 1]});
    }
    const std::uint32_t* const indices = required("mesh.indices", mesh.indices);
    for (std::size_t k = 0; k < mesh.triangles; ++k) {
        object.triangles.push_back({indices[3 * k], indices[3 * k + 1], indices[3 * k + 2]});
    }
    return object;
}

}  // namespace

DropletCode droplet_windshield_new(const char* preset, DropletWindshield** made)
{
    return guarded([&] {
        required("made", made);
        auto windshield = std::make_unique<DropletWindshield>();
        windshield->parameters = droplet::windshieldPresetNamed(preset != nullptr ? preset : "figure-3.12").parameters;
        windshield->speed = windshield->parameters.vehicle.speedAt(0.0);
        windshield->state = droplet::startWindshield(windshield->parameters);
        *made = windshield.release();
    });
}

void droplet_windshield_delete(DropletWindshield* windshield)
{
    delete windshield;
}

DropletCode droplet_windshield_set(DropletWindshield* windshield, const char* name, double value)
{
    return guarded([&] {
        required("windshield", windshield);
        const Parameter& parameter = parameterNamed(required("name", name));
        if (!(value >= parameter.low && value <= parameter.high)) {
            throw Error(ErrorCode::InvalidArgument, fmt::format("{} is {}; it must be from {} to {}", parameter.name,
                                                                value, parameter.low, parameter.high));
        }
        if (parameter.before_the_first_step) {
            requireNotBegun(*windshield, parameter.name);
        }
        parameter.set(*windshield, value);
    });
}

DropletCode droplet_windshield_get(const DropletWindshield* windshield, const char* name, double* value)
{
    return guarded([&] {
        *required("value", value) = parameterNamed(required("name", name)).get(*required("windshield", windshield));
    });
}

DropletCode droplet_windshield_surface(DropletWindshield* windshield, const DropletMesh* mesh)
{
    return guarded([&] {
        required("windshield", windshield);
        const droplet::TexturedMesh object = objectOf(*required("mesh", mesh));
        requireNotBegun(*windshield, "mesh");
        setGlass(*windshield, droplet::Glass(object, {}));
    });
}

DropletCode droplet_windshield_advance(DropletWindshield* windshield, double seconds)
{
    return guarded([&] {
        required("windshield", windshield);
        if (!(seconds > 0.0 && std::isfinite(seconds))) {
            throw Error(ErrorCode::InvalidArgument,
                        fmt::format("seconds is {}; it must be finite and more than 0", seconds));
        }
        windshield->parameters.vehicle = driveTowards(*windshield, seconds);
        windshield->parameters.validate();  // before the state is given away
        windshield->state = droplet::step(std::move(windshield->state), windshield->parameters, seconds);
        if (windshield->wiper_period == 0.0 && !windshield->parameters.wipers.empty() && nextStart(*windshield).rests) {
            windshield->parameters.wipers.clear();
        }
    });
}

DropletCode droplet_windshield_spray(DropletWindshield* windshield, const DropletSpray* spray)
{
    return guarded([&] {
        required("windshield", windshield);
        required("spray", spray);
        const droplet::Spray wanted{{spray->x, spray->y}, spray->radius, spray->volume};
        wanted.validate();
        windshield->state = droplet::sprayed(std::move(windshield->state), windshield->parameters, wanted);
    });
}

DropletCode droplet_windshield_finger(DropletWindshield* windshield, const DropletStroke* stroke)
{
    return guarded([&] {
        required("windshield", windshield);
        required("stroke", stroke);
        const droplet::FingerStroke wanted{
            {stroke->from_x, stroke->from_y}, {stroke->to_x, stroke->to_y}, stroke->width};
        wanted.validate();
        windshield->state = droplet::stroked(std::move(windshield->state), windshield->parameters, wanted);
    });
}

DropletCode droplet_windshield_figures(const DropletWindshield* windshield, DropletWindshieldFigures* figures)
{
    return guarded([&] {
        required("windshield", windshield);
        required("figures", figures);
        const droplet::WindshieldState& state = windshield->state;
        *figures = {.time = state.time,
                    .speed = windshield->parameters.vehicle.speedAt(state.time),
                    .width = windshield->parameters.glass.width(),
                    .height = windshield->parameters.glass.height(),
                    .running = state.droplets.size(),
                    .still = state.still.count(),
                    .raindrops = state.counts.raindrops};
    });
}

DropletCode droplet_windshield_water(const DropletWindshield* windshield, DropletWater* water)
{
    return guarded([&] {
        required("windshield", windshield);
        const droplet::WaterBalance balance = balanceOf(windshield->state);
        *required("water", water) = {
            balance.on_glass_mist + balance.on_glass_film + balance.on_glass_still + balance.on_glass_running,
            balance.residual()};
    });
}

size_t droplet_windshield_running(const DropletWindshield* windshield, DropletRunning* droplets, size_t room)
{
    const double angle = windshield->parameters.forces.wetting.contact_angle;
    const double unit = droplet::capOf(1.0, angle).contact_radius;
    const std::vector<droplet::RunningDroplet>& all = windshield->state.droplets;
    for (std::size_t k = 0; k < std::min(room, all.size()); ++k) {
        const droplet::RunningDroplet& d = all[k];
        droplets[k] = {
            d.id, d.position.x, d.position.y, d.velocity.x, d.velocity.y, d.volume, unit * std::cbrt(d.volume)};
    }
    return all.size();
}

DropletCode droplet_windshield_place(const DropletWindshield* windshield, double x, double y, DropletPlace* place)
{
    return guarded([&] {
        required("windshield", windshield);
        required("place", place);
        const auto found = windshield->parameters.glass.place({x, y});
        if (!found) {
            throw Error(ErrorCode::InvalidArgument, fmt::format("x, y: there is no glass at {}, {}", x, y));
        }
        put(*found, *place);
    });
}

DropletCode droplet_windshield_triangles(DropletWindshield* windshield, DropletTriangles* triangles)
{
    return guarded([&] {
        std::vector<DropletCorner>& corners = required("windshield", windshield)->corners;
        required("triangles", triangles);
        corners.clear();
        for (const droplet::GlassTriangle& triangle : windshield->parameters.glass.triangles()) {
            for (std::size_t k = 0; k < 3; ++k) {
                DropletCorner& corner = corners.emplace_back();
                corner.x = triangle.positions[k].x;
                corner.y = triangle.positions[k].y;
                put(triangle.places[k], corner.place);
            }
        }
        *triangles = {corners.data(), corners.size() / 3};
    });
}

size_t droplet_windshield_blades(const DropletWindshield* windshield, DropletBlade* blades, size_t room)
{
    const std::vector<droplet::Wiper>& wipers = windshield->parameters.wipers;
    for (std::size_t k = 0; k < std::min(room, wipers.size()); ++k) {
        const droplet::Wiper& wiper = wipers[k];
        const double angle = wiper.angleAt(windshield->state.time);
        const Vec2 along{std::cos(angle), std::sin(angle)};
        const Vec2 inner = wiper.pivot + wiper.inner * along;
        const Vec2 outer = wiper.pivot + wiper.outer * along;
        blades[k] = {inner.x, inner.y, outer.x, outer.y, wiper.pivot.x, wiper.pivot.y, wiper.first, wiper.last};
    }
    return wipers.size();
}

DropletCode droplet_windshield_map_height(DropletWindshield* windshield, int32_t width, int32_t* height)
{
    return guarded([&] {
        required("height", height);
        layOutMaps(*required("windshield", windshield), width);
        *height = windshield->maps->height();
    });
}

DropletCode droplet_windshield_draw(DropletWindshield* windshield, int32_t width, uint16_t* pixels, DropletTiles* tiles)
{
    return guarded([&] {
        required("windshield", windshield);
        required("pixels", pixels);
        required("tiles", tiles);
        layOutMaps(*windshield, width);
        droplet::WindshieldMaps& maps = *windshield->maps;
        const std::span<std::uint16_t> all(
            pixels, std::size_t{4} * static_cast<std::size_t>(width) * static_cast<std::size_t>(maps.height()));
        const bool is_first = std::exchange(windshield->is_blank, false);
        if (is_first) {
            std::fill(all.begin(), all.end(), std::uint16_t{0});
        }
        const std::vector<droplet::MapTile>& changed = maps.update(windshield->state, all);
        if (is_first) {
            windshield->tiles = tilesOver(maps);
        } else {
            windshield->tiles.clear();
            for (const droplet::MapTile& tile : changed) {
                windshield->tiles.push_back({tile.x, tile.y, tile.width, tile.height});
            }
        }
        *tiles = {windshield->tiles.data(), windshield->tiles.size()};
    });
}

DropletCode droplet_windshield_mist(DropletWindshield* windshield, DropletMistMap* map)
{
    return guarded([&] {
        required("windshield", windshield);
        constexpr double kLevels = 255.0 / droplet::kDenseMist;
        putMap(windshield->state.mist, kLevels, *windshield, windshield->mist, *required("map", map));
    });
}

DropletCode droplet_windshield_runoff(DropletWindshield* windshield, DropletMistMap* map)
{
    return guarded([&] {
        required("windshield", windshield);
        constexpr double kLevels = droplet::Runoff::kThickness / DROPLET_RUNOFF_LEVEL;
        putMap(windshield->state.film, kLevels, *windshield, windshield->runoff, *required("map", map));
    });
}

DropletCode droplet_windshield_runoff_drift(const DropletWindshield* windshield, double drift[2])
{
    return guarded([&] {
        required("windshield", windshield);
        required("drift", drift);
        drift[0] = windshield->state.film.drift.x;
        drift[1] = windshield->state.film.drift.y;
    });
}
