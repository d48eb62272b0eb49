// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow_options.h"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <string_view>

#include "command_line.h"
#include "common_options.h"
#include "droplet/error.h"
#include "droplet/units.h"
#include "files.h"
#include "force_options.h"
#include "liquid_options.h"
#include "map_options.h"
#include "object_options.h"
#include "object_reading.h"
#include "option_values.h"
#include "shape_options.h"
#include "value_list.h"
#include "video_writer.h"

namespace cli {
namespace {

using droplet::Dimension;
using droplet::Vec3;

constexpr Range kVolume{Dimension::Volume, 1e-13, 1e-3, "from 0.1nL to 1L"};
constexpr Range kRadius{Dimension::Length, 1e-5, 0.1, "from 0.01mm to 100mm"};
constexpr Range kRain{Dimension::Rainfall, 0.0, 1000.0 * droplet::kMillimetrePerHour, "from 0mm/h to 1000mm/h"};
constexpr Range kBump{Dimension::Length, 0.0, 0.1, "from 0mm to 100mm"};
constexpr Range kFilm{Dimension::Length, 0.0, 1e-3, "from 0mm to 1mm"};
constexpr Range kSpacing{Dimension::Length, 1e-4, 1.0, "from 0.1mm to 1m"};
constexpr Range kTime{Dimension::Duration, 1e-3, 86400.0, "from 1ms to 24h"};
constexpr Range kPlace{Dimension::Length, -1e3, 1e3, "from -1000m to 1000m"};
constexpr Range kSpeed{Dimension::Speed, -150.0, 150.0, "from -150m/s to 150m/s"};
constexpr Range kTurn{Dimension::Angle, -1e4, 1e4,
                      "an angle per s, min or h, such as 30deg/s, from -1e4rad/s to 1e4rad/s"};

const CommandText& commandText()
{
    static const CommandText text{"droplet-shape flow", "let droplets run over a mesh", "[OPTIONS] OBJECT OUTPUT",
                                  "Quantities carry a unit:\n"
                                  "  lengths nm um mm cm m in; volumes nL uL mL L mm3 cm3 m3; rainfall mm/h in/h;\n"
                                  "  durations ms s min h; angles deg rad; surface tension mN/m N/m dyn/cm;\n"
                                  "  density kg/m3 g/cm3 g/mL; acceleration m/s2 mm/s2 g; viscosity mPa.s Pa.s\n"
                                  "Vectors x,y,z are in the frame of the object's file, +Y up, in metres or metres\n"
                                  "per second unless they carry a unit.\n"
                                  "\n"
                                  "Examples:\n"
                                  "  droplet-shape flow bottle.glb wet.glb --drops 200 --time 5s\n"
                                  "  droplet-shape flow car.stl 'rain-%04d.obj' --object-size 45cm --rain 25mm/h\n"
                                  "  droplet-shape flow --preset bottle bottle.glb\n"
                                  "  droplet-shape flow leaf.glb wet.glb --start drops.csv --droplets out.csv\n"
                                  "\n"
                                  "Exit codes:\n"
                                  "  0 done; 1 internal error; 2 usage; 3 input unreadable, or no place for\n"
                                  "  droplets; 4 output cannot be written"};
    return text;
}

void declare(CommandLine& line, FlowOptions& options)
{
    droplet::FlowParameters& parameters = options.parameters;
    line.addArgument(
        "OBJECT",
        "Mesh to run over: .glb, .gltf, .obj, .ply or .stl; OBJ and STL in millimetres. Or a mesh for every "
        "frame of an object that deforms, walk/%04d.obj, with the same triangles; an animated .glb deforms as it says");
    line.addArgument(
        "OUTPUT",
        "Animation of object and droplets, .glb, .gltf, .usda or .usdz; meshes of the droplets in every frame, such as "
        "out/%04d.obj, .glb, .ply, .stl or .usda; pictures, out/%04d.png; a .png of the last frame; or a video, "
        ".mp4, .mkv, .mov or .webm, which needs ffmpeg");
    constexpr const char* kObject = "Object";
    line.add(kObject, "--preset", wordsOf(droplet::flowPresets(), &droplet::FlowPreset::name).c_str(),
             "Named scene with its own object and droplets, instead of OBJECT; other options change it");
    declareReading(line, kObject, options.reading);
    line.add(kObject, "--floor",
             "What catches the water below an object that rests: a plate or a dish, with the material floor",
             into(options.floor, {{"plate", droplet::Floor::Plate}, {"dish", droplet::Floor::Dish}}));
    line.add(kObject, "--spin", "ANGLE/s", "Turn the object, such as 30deg/s");
    line.add(kObject, "--spin-axis", "X,Y,Z", "Axis through the origin that --spin turns it about [0,1,0]");
    line.add(kObject, "--motion", "FILE",
             "Move the object: CSV with the columns time_s, x_m, y_m, z_m and a quaternion rotation_x, rotation_y, "
             "rotation_z, rotation_w",
             into(options.motion));
    line.exclude({"--spin", "--motion"});
    line.add(kObject, "--object-animation", "NAME",
             "Animation of the object's file that moves or deforms it [the first]", into(options.animation));
    line.addFlag(kObject, "--no-animation", "Ignore the animation of the object's file");
    line.exclude({"--object-animation", "--no-animation"});
    line.exclude({"--object-animation", "--spin"});
    line.exclude({"--object-animation", "--motion"});
    constexpr const char* kSources = "Droplets";
    line.add(kSources, "--drops", "N", "Scatter droplets over the object at the start",
             into(options.drops, {0, 1'000'000, "1M"}));
    line.add(kSources, "--volume", "VOLUME", "Volume of scattered and emitted droplets, the median",
             into(options.volumes.median, kVolume));
    line.add(kSources, "--radius", "LENGTH", "Contact radius instead of --volume", within(kRadius));
    line.exclude({"--volume", "--radius"});
    line.add(kSources, "--volume-spread", "NUMBER",
             "Spread of the volumes: standard deviation of their logarithm, 0 to 3",
             into(options.volumes.spread, {0.0, 3.0, "a number from 0 to 3"}));
    line.add(kSources, "--from", "X,Y,Z",
             "Direction that rain comes from; --drops then wet only what it can reach [for --rain 0,1,0]");
    line.add(kSources, "--mask", "FILE", "Mask over the object's texture coordinates: --drops start on it",
             into(options.mask));
    line.addFlag(kSources, "--vertex-weights",
                 "--drops start where the vertices have weights: _WEIGHT or the red of COLOR_0 of glTF, weight or red "
                 "of PLY");
    line.exclude({"--mask", "--vertex-weights"});
    line.add(kSources, "--start", "FILE",
             "Droplets at the start: CSV with the columns x_m, y_m, z_m, volume_m3 and, if they move, "
             "velocity_x_m_per_s, velocity_y_m_per_s, velocity_z_m_per_s",
             into(options.start));
    line.addList(kSources, "--emitter", "X,Y,Z,RATE", "Release droplets at a place, such as 0,0.1,0,50uL/s");
    line.add(kSources, "--rain", "RAINFALL", "Rain, with the drop sizes of Marshall and Palmer [0mm/h]", within(kRain));
    line.add(kSources, "--condensation", "RAINFALL", "Dew: growth of the water's mean thickness, such as 5mm/h [0mm/h]",
             within(kRain));
    line.add(kSources, "--dew-spacing", "LENGTH", "Mean distance of new droplets of dew on a dry surface [3mm]",
             within(kSpacing));
    constexpr const char* kMotion = "Motion";
    line.add(
        kMotion, "--retention,--model",
        "What holds droplets: capillary is contact angle hysteresis, paper is roughness alone",
        into(parameters.model, {{"capillary", droplet::FlowModel::Capillary}, {"paper", droplet::FlowModel::Paper}}));
    line.add(kMotion, "--hysteresis", "NUMBER",
             "Contact angle hysteresis: cosine of the receding minus cosine of the advancing angle",
             into(parameters.forces.wetting.hysteresis, {0.0, 2.0, "a number from 0 to 2"}));
    declarePinning(line, kMotion, parameters.pinning);
    line.add(kMotion, "--friction", "F", "Viscous friction in kg/s instead of --viscosity-factor", within(0.0, 1e3));
    line.add(kMotion, "--roughness", "LENGTH",
             "Height of the surface's bumps; those of a droplet's height hold it [0mm]", within(kBump));
    line.add(kMotion, "--roughness-map", "FILE",
             "Picture over the object's texture coordinates: black is smooth, white has bumps of --roughness",
             into(options.roughness_map));
    line.add(kMotion, "--friction-map", "FILE",
             "Picture over the object's texture coordinates: black is without viscous friction, white has all of it",
             into(options.friction_map));
    line.addList(kMotion, "--ground", "NAME:VALUES",
                 "Properties of a material of the object: roughness, contact-angle, and factors on friction and "
                 "hysteresis, such as Glass:contact-angle=30deg,hysteresis=0.5");
    line.add(kMotion, "--adhesion", "P", "Pressure in Pa that holds droplets to the surface [by surface tension]",
             within(0.0, 1e12));
    line.add(kMotion, "--gravity-direction", "X,Y,Z", "Direction of gravity [0,-1,0]");
    line.add(kMotion, "--wind-velocity,--wind", "X,Y,Z", "Wind, which pushes droplets along the surface [0,0,0]");
    line.addFlag(kMotion, "--no-merge", "Droplets that touch stay apart");
    line.addFlag(kMotion, "--no-wetting", "Streaks do not smooth the surface for the next droplets");
    line.add(kMotion, "--film", "LENGTH", "Thickness of the film that droplets leave behind; it becomes beads",
             into(parameters.streaks.film, kFilm));
    line.add(kMotion, "--bead-spacing", "LENGTH", "Distance of these beads",
             into(parameters.streaks.spacing, kSpacing));
    line.add(kMotion, "--drying", "DURATION", "Time after which streaks and beads are dry [never]",
             into(parameters.drying, kTime));
    declareForces(line, parameters.forces);
    constexpr const char* kTimes = "Time";
    line.add(kTimes, "--time", "DURATION",
             "Time to show [5s, or all meshes or the animation of an object that deforms]",
             into(options.duration, kTime));
    line.add(kTimes, "--fps", "RATE", "Frames per second; they do not change the paths",
             into(options.frames_per_second, kFrameRate));
    line.add(kTimes, "--seed", "N", "Random seed", seedInto(parameters.seed));
    constexpr const char* kOut = "Output";
    line.add(kOut, "--shape",
             "Shape of the droplets: capillary has least energy, springs is the paper's, capsule a cut capsule",
             into(options.shape, {{"capillary", droplet::BodyShape::Capillary},
                                  {"springs", droplet::BodyShape::Springs},
                                  {"capsule", droplet::BodyShape::Capsule}}));
    line.add(kOut, "--deformation", "NUMBER",
             "Small-scale deformation of droplets that move slowly: standard deviation of their outline, over its "
             "distance from the middle, 0 to 0.3; in pictures, textures and meshes of every frame",
             into(options.deformation, {0.0, 0.3, "a number from 0 to 0.3"}));
    declareMaterial(line, kOut, "Look of the droplets [by liquid]");
    line.add("Picture", "--preview", "FILE",
             "Write a rendered picture of the last frame beside meshes, as PNG; - is standard output");
    declareView(line);
    declareEnvironment(line);
    declareTurntable(line);
    declareCompression(line, kOut);
    line.add(kOut, "--streaks", "FILE",
             "Write the streaks at the end as a mesh, .glb, .obj, .ply or .stl, or those of every frame, such as "
             "wet/%04d.obj; an animation then has them too, as they grow");
    line.add(kOut, "--maps", "PATH",
             "Textures of the water in the object's uv, such as maps/%05d.png or .exr: four files per frame, -normal, "
             "-thickness, -age and -wet, which tells where the age counts");
    line.add(kOut, "--map-width", "N", "Width and height of the textures in pixels",
             into(options.map_width, {16, 8192, "8192"}));
    line.add(kOut, "--map-thickness", "LENGTH", "Thickness of the water that is white in a PNG",
             into(options.full_thickness, kMapThickness));
    line.add(kOut, "--map-age", "DURATION", "Greatest age in the textures, white in a PNG",
             into(options.full_age, kTime));
    line.add(
        kOut, "--droplets", "FILE",
        "Write a table of all droplets in every frame, .csv or .json, points over time with droplets as instances, "
        ".usda or .usdz, or a PLY of points for each frame, such as points/%04d.ply");
    declareHtml(line, kOut, "plays droplets and streaks");
    line.add(kOut, "--json", "FILE", "Write a report, with the liquid's balance every second; - is standard output",
             into(options.json));
    constexpr const char* kRun = "Run";
    line.addFlag(kRun, "--resume", "Continue an interrupted run of the same options", options.resume);
    line.addFlag(kRun, "--no-clobber", "Do not replace existing files");
    declareFrameProgress(line, kRun);
    declareCommon(line, kRun, "time = \"5s\"");
    line.exclude({"--resume", "--no-clobber"});
}

std::optional<std::string> text(const CommandLine& line, const char* option)
{
    const auto given = line.value(option);
    return given ? std::optional(given->text) : std::nullopt;
}

/// Reads a value of several parts. Whatever is wrong with one of them, the message shows all, and their form.
template <typename Function>
auto inForm(const Given& given, const char* form, Function function)
{
    try {
        return function();
    } catch (const droplet::Error&) {
        refuse(given, form);
    }
}

/// A quantity per second, minute or hour.
double rate(const Given& given, const Range& range)
{
    const std::size_t slash = given.text.rfind('/');
    const std::string per = slash == std::string::npos ? "" : given.text.substr(slash + 1);
    const double seconds = per == "s" ? 1.0 : per == "min" ? 60.0 : per == "h" ? 3600.0 : 0.0;
    if (seconds == 0.0) {
        refuse(given, range.allowed);
    }
    return quantity({given.text.substr(0, slash), given.subject}, range) / seconds;
}

/// A number, or a number with its only unit.
double inUnit(const Given& given, std::string_view unit, const NumberRange& range)
{
    Given bare = given;
    if (bare.text.ends_with(unit)) {
        bare.text.resize(bare.text.size() - unit.size());
    }
    if (!finiteNumber(bare.text)) {
        refuse(given, range.allowed);
    }
    return number(bare, range);
}

void readObject(const CommandLine& line, FlowOptions& options)
{
    if (!options.preset) {
        options.object = line.argument("OBJECT");
        options.shapes = NumberedPath::of(*options.object, "OBJECT");
    }
    if (options.shapes) {
        for (const char* option : {"--spin", "--motion"}) {
            if (line.value(option)) {
                refuse(
                    fmt::format("{} turns an object that keeps its shape; meshes for every frame such as '{}' must "
                                "hold the motion",
                                option, *options.object));
            }
        }
        for (const char* option : {"--object-animation", "--no-animation"}) {
            if (line.value(option) || line.flag(option)) {
                refuse(fmt::format("{} needs one mesh as OBJECT, not one for every frame such as '{}'", option,
                                   *options.object));
            }
        }
    }
    const auto spin = line.value("--spin");
    const auto axis = line.value("--spin-axis");
    if (axis && !spin) {
        refuse("--spin-axis needs --spin");
    }
    if (spin) {
        options.parameters.motion.keys.clear();
        const double turn = inForm(*spin, kTurn.allowed, [&] { return rate(*spin, kTurn); });
        options.parameters.motion.spin = turn * (axis ? direction(*axis) : Vec3{0.0, 0.0, 1.0});
    }
    options.keeps_animation = !options.preset && !line.flag("--no-animation") && !spin && !options.motion;
}

void readSources(const CommandLine& line, FlowOptions& options)
{
    droplet::FlowParameters& parameters = options.parameters;
    if (const auto radius = line.value("--radius")) {
        options.volumes.median =
            droplet::capVolume(quantity(*radius, kRadius), parameters.forces.wetting.contact_angle);
    }
    if (const auto from = line.value("--from")) {
        options.from = direction(*from);
    }
    options.reading.weights = line.flag("--vertex-weights");
    if ((options.mask || options.reading.weights) && options.drops == 0) {
        refuse(std::string(options.mask ? "--mask" : "--vertex-weights") + " needs --drops");
    }
    for (const Given& emitter : line.values("--emitter")) {
        constexpr Range kRate{Dimension::Volume, 0.0, 1e-2,
                              "X,Y,Z,RATE such as 0,0.1,0,50uL/s: a place from -1000m to 1000m, and a rate from 0uL/s "
                              "to 10L/s"};
        parameters.emitters.push_back(inForm(emitter, kRate.allowed, [&] {
            const std::size_t comma = std::min(emitter.text.rfind(','), emitter.text.size() - 1);
            const Vec3 place = vector({emitter.text.substr(0, comma), emitter.subject}, kPlace);
            const double amount = rate({emitter.text.substr(comma + 1), emitter.subject}, kRate);
            return droplet::FlowEmitter{place, amount, options.volumes};
        }));
    }
    if (const auto rain = line.value("--rain")) {
        droplet::FlowRain falling;
        falling.rainfall = quantity(*rain, kRain);
        falling.from = options.from.value_or(falling.from);
        parameters.rain = falling.rainfall > 0.0 ? std::optional(falling) : std::nullopt;
    }
    if (const auto dew = line.value("--condensation")) {
        droplet::FlowCondensation condensation;
        condensation.rate = quantity(*dew, kRain);
        if (const auto spacing = line.value("--dew-spacing")) {
            condensation.spacing = quantity(*spacing, kSpacing);
        }
        parameters.condensation = condensation.rate > 0.0 ? std::optional(condensation) : std::nullopt;
    } else if (line.value("--dew-spacing")) {
        refuse("--dew-spacing needs --condensation");
    }
    if (options.from && options.drops == 0 && !line.value("--rain")) {
        refuse("--from needs --drops or --rain");
    }
    options.has_source = options.preset || options.drops > 0 || options.start || !parameters.emitters.empty() ||
                         parameters.rain || parameters.condensation;
    if (!options.has_source) {
        const char* const none = line.value("--rain")           ? "--rain 0mm/h brings no droplets; "
                                 : line.value("--condensation") ? "--condensation 0mm/h brings no droplets; "
                                                                : "no droplets are asked for; ";
        refuse(std::string(none) + "give --preset, --drops, --start, --emitter, --rain or --condensation");
    }
}

/// Reads a material's properties, NAME:roughness=L,contact-angle=A,friction=F,hysteresis=F.
void readMaterial(const Given& given, FlowOptions& options)
{
    constexpr const char* kAllowed = "a name and values such as Glass:contact-angle=30deg,hysteresis=0.5";
    const std::size_t colon = given.text.rfind(':');
    if (colon == std::string::npos || colon == 0) {
        refuse(given, kAllowed);
    }
    droplet::MaterialProperties ground;
    for (const Given& part : partsOf({given.text.substr(colon + 1), given.subject})) {
        const std::size_t equals = part.text.find('=');
        const std::string key = part.text.substr(0, equals);
        const Given value{equals == std::string::npos ? "" : part.text.substr(equals + 1), given.subject};
        if (key == "roughness") {
            ground.roughness = plainOr(value, kBump);
        } else if (key == "contact-angle") {
            ground.contact_angle = quantity(value, kContactAngle);
        } else if (key == "friction") {
            ground.friction = number(value, {0.0, 1e6, "a factor from 0 to 1e6"});
        } else if (key == "hysteresis") {
            ground.hysteresis = number(value, {0.0, 1e6, "a factor from 0 to 1e6"});
        } else {
            refuse(given, kAllowed);
        }
    }
    options.materials[given.text.substr(0, colon)] = ground;
}

void readMotion(const CommandLine& line, FlowOptions& options)
{
    droplet::FlowParameters& parameters = options.parameters;
    readForces(line, parameters.forces);
    if (const auto friction = line.value("--friction")) {
        parameters.friction = inUnit(*friction, "kg/s", {0.0, 1e3, "a number from 0 to 1000, in kg/s"});
    }
    if (const auto roughness = line.value("--roughness")) {
        parameters.roughness = plainOr(*roughness, kBump);
    }
    if (options.roughness_map && !line.value("--roughness")) {
        refuse("--roughness-map needs --roughness, the height of the bumps where the picture is white");
    }
    for (const Given& material : line.values("--ground")) {
        readMaterial(material, options);
    }
    if (const auto adhesion = line.value("--adhesion")) {
        parameters.adhesion = inUnit(*adhesion, "Pa", {0.0, 1e12, "a number from 0 to 1e12, in Pa"});
    }
    const auto down = line.value("--gravity-direction");
    parameters.gravity = parameters.forces.gravity * (down ? direction(*down) : Vec3{0.0, 0.0, -1.0});
    if (const auto wind = line.value("--wind-velocity")) {
        parameters.wind = vector(*wind, kSpeed);
    }
    parameters.merges = parameters.merges && !line.flag("--no-merge");
    parameters.wets = parameters.wets && !line.flag("--no-wetting");
}

/// OUTPUT; with a preset it is the only argument.
std::string outputOf(const CommandLine& line, const FlowOptions& options)
{
    if (!options.preset) {
        return line.argument("OUTPUT");
    }
    if (!line.values("OUTPUT").empty()) {
        refuse("--preset has its own object; give OUTPUT alone, not '" + line.argument("OBJECT") + "'");
    }
    if (line.values("OBJECT").empty()) {
        return line.argument("OUTPUT");
    }
    return line.argument("OBJECT");
}

/// Refuses options that a preset leaves without effect.
void readPreset(const CommandLine& line, FlowOptions& options)
{
    const auto preset = line.value("--preset");
    if (!preset) {
        return;
    }
    options.preset = forOption("--preset", [&] { return droplet::flowPresetNamed(preset->text); });
    options.parameters = options.preset->parameters;
    for (const char* option : {"--scale", "--object-size", "--up", "--object-animation", "--no-animation"}) {
        if (line.value(option) || line.flag(option)) {
            refuse(std::string(option) + " needs OBJECT, not --preset");
        }
    }
}

/// --preview and --turntable.
void readFlowPreview(const CommandLine& line, FlowOptions& options, bool is_picture)
{
    options.has_preview = readPreviewFile(line, options.view);
    if (!options.has_preview && options.view.turns) {
        refuse("--turntable needs --preview");
    }
    if (options.has_preview && is_picture) {
        refuse("--preview is for meshes, but OUTPUT '" + options.output + "' shows pictures already");
    }
}

constexpr const char* kMapPath = "a path such as maps/%05d.png or .exr";

void readOutputs(const CommandLine& line, FlowOptions& options)
{
    options.output = outputOf(line, options);
    const Given output{options.output, "OUTPUT"};
    options.files = NumberedPath::of(options.output, "OUTPUT");
    const std::string extension = std::filesystem::path(options.output).extension().string();
    const bool is_mesh =
        std::set<std::string>{".glb", ".gltf", ".obj", ".ply", ".stl", ".usda", ".usdz"}.contains(extension);
    const std::optional<droplet::Format> format =
        is_mesh ? std::optional(droplet::formatNamed(extension)) : std::nullopt;
    if (options.files && is_mesh) {
        options.kind = FlowOutput::Meshes;
    } else if (options.files && extension == ".png") {
        options.kind = FlowOutput::Pictures;
    } else if (format && droplet::isAnimated(*format)) {
        options.kind = FlowOutput::Animation;
    } else if (!options.files && extension == ".png") {
        options.kind = FlowOutput::Picture;
    } else if (!options.files && isVideo(options.output)) {
        options.kind = FlowOutput::Video;
    } else {
        refuse(output,
               "a .glb, .gltf, .usda or .usdz; a .png; a .mp4, .mkv, .mov or .webm; or a file for every frame such as "
               "out/%04d.png, .glb, .gltf, .obj, .ply, .stl, .usda or .usdz");
    }
    if (format) {
        options.file = {*format, readCompression(line, *format)};
    } else if (line.value("--compress")) {
        refuse("--compress needs a .glb as OUTPUT, not '" + options.output + "'");
    }
    const bool is_picture = options.kind != FlowOutput::Animation && options.kind != FlowOutput::Meshes;
    readFlowPreview(line, options, is_picture);
    for (const char* option : {"--view", "--camera", "--look-at", "--environment", "--preview-size"}) {
        if (line.value(option) && !is_picture && !options.has_preview) {
            refuse(std::string(option) + " needs --preview, or pictures or a video as OUTPUT, not '" + options.output +
                   "'");
        }
    }
    if (options.preset) {
        options.view.camera = options.preset->camera;
    }
    if (line.value("--view")) {
        options.view.camera.reset();
    }
    options.view.sees_below = true;
    readView(line, options.view);
    options.view.environment = text(line, "--environment");
    const bool is_video = options.kind == FlowOutput::Video || (options.has_preview && isVideo(options.view.path));
    options.encoding = readVideoEncoding(line, is_video, "OUTPUT or --preview, not '" + options.output + "'");
    if (is_video) {
        requireEvenSides("--preview-size", options.view.width, options.view.height);
    }
    if (const auto material = line.value("--material")) {
        options.material = forOption("--material", [&] { return droplet::materialNamed(material->text); });
    }
    const auto ending_in = [&](const char* option, const std::set<std::string>& allowed, const char* words) {
        const auto given = line.value(option);
        if (given && !allowed.contains(std::filesystem::path(given->text).extension().string())) {
            refuse(*given, words);
        }
        return text(line, option);
    };
    options.streaks = ending_in("--streaks", {".glb", ".gltf", ".obj", ".ply", ".stl"},
                                "a file that ends in .glb, .gltf, .obj, .ply or .stl");
    if (options.streaks) {
        options.streak_files = NumberedPath::of(*options.streaks, "--streaks");
    }
    if (const auto maps = line.value("--maps")) {
        options.maps = NumberedPath::of(maps->text, "--maps");
        if (!options.maps) {
            refuse(*maps, kMapPath);
        }
    }
    options.are_maps_exr = areMapsExr(line, {"--map-width", "--map-thickness", "--map-age"}, kMapPath);
    if (options.deformation > 0.0 && options.kind == FlowOutput::Animation && !options.has_preview && !options.maps) {
        refuse("--deformation is for pictures, textures and meshes of every frame; an animation such as '" +
               options.output + "' does not have it");
    }
    options.droplets = ending_in("--droplets", {".csv", ".json", ".usda", ".usdz", ".ply"},
                                 "a file that ends in .csv, .json, .usda or .usdz, or files such as points/%04d.ply");
    if (options.droplets && (options.droplets->ends_with(".usda") || options.droplets->ends_with(".usdz"))) {
        options.usd_points = droplet::formatNamed(std::filesystem::path(*options.droplets).extension().string());
        if (NumberedPath::of(*options.droplets, "--droplets")) {
            refuse(*line.value("--droplets"), "one file for all frames, such as points.usda");
        }
    }
    if (options.droplets && options.droplets->ends_with(".ply")) {
        options.point_files = NumberedPath::of(*options.droplets, "--droplets");
        if (!options.point_files) {
            refuse(*line.value("--droplets"), "files such as points/%04d.ply, one for each frame");
        }
    }
    options.html = readHtml(line);
    if (options.resume && !options.files) {
        refuse("--resume needs a file for every frame as OUTPUT, such as out/%04d.obj, not '" + options.output + "'");
    }
}

}  // namespace

std::variant<FlowOptions, std::string> parseFlow(int argc, const char* const* argv)
{
    CommandLine line(commandText());
    FlowOptions options;
    declare(line, options);
    line.parse(argc, argv);
    if (const auto text = requestedText(line)) {
        return *text;
    }
    readPreset(line, options);
    line.read();
    readMotion(line, options);
    readObject(line, options);
    readSources(line, options);
    readOutputs(line, options);
    options.run = readRun(line);
    options.fingerprint = optionsOfFrames(line, options.output, {"--droplets", "--html"});
    return options;
}

}  // namespace cli
