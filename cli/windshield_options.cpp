// SPDX-License-Identifier: GPL-3.0-or-later
#include "windshield_options.h"

#include <charconv>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <set>

#include "command_line.h"
#include "common_options.h"
#include "droplet/units.h"
#include "droplet/windshield/presets.h"
#include "files.h"
#include "force_options.h"
#include "map_options.h"
#include "option_values.h"
#include "value_list.h"
#include "video_writer.h"
#include "windshield_live.h"

namespace cli {
namespace {

using droplet::Dimension;
using droplet::kDegree;

constexpr Range kRain{Dimension::Rainfall, 0.0, 1000.0 * droplet::kMillimetrePerHour, "from 0mm/h to 1000mm/h"};
constexpr Range kMist{Dimension::Rainfall, 0.0, 3.6 * droplet::kMillimetrePerHour, "from 0mm/h to 3.6mm/h"};
constexpr Range kSpeed{Dimension::Speed, 0.0, 150.0, "from 0m/s to 150m/s"};
constexpr Range kStill{Dimension::Length, 1.1e-4, 2e-3, "from 0.11mm to 2mm"};
constexpr Range kSide{Dimension::Length, 0.05, 5.0, "from 50mm to 5m"};
constexpr Range kRadius{Dimension::Length, 0.1, 1e6, "from 0.1m to 1e6m"};
constexpr Range kSlope{Dimension::Angle, 0.0, 90.0 * kDegree, "from 0deg to 90deg"};
constexpr Range kNoise{Dimension::Acceleration, 0.0, 1e3, "from 0m/s2 to 1000m/s2"};
constexpr Range kFilm{Dimension::Length, 0.0, 1e-3, "from 0mm to 1mm"};
constexpr Range kRunoff{Dimension::Duration, 0.0, 10.0, "from 0s to 10s"};
constexpr Range kTime{Dimension::Duration, 1e-3, 86400.0, "from 1ms to 24h"};
constexpr Range kWarmUp{Dimension::Duration, 0.0, 86400.0, "from 0s to 24h"};
constexpr Range kPeriod{Dimension::Duration, 1.2, 60.0, "from 1.2s to 60s"};
constexpr Range kView{Dimension::Angle, kDegree, 150.0 * kDegree, "from 1deg to 150deg"};
constexpr Range kBlur{Dimension::Angle, 0.0, 20.0 * kDegree, "from 0deg to 20deg"};
constexpr Range kPlace{Dimension::Length, -100.0, 100.0, "from -100m to 100m each"};
constexpr Range kEye{Dimension::Length, 0.01, 100.0, "from 10mm to 100m"};

const CommandText& commandText()
{
    static const CommandText text{"droplet-shape windshield", "show rain on a moving car's windshield",
                                  "[OPTIONS] OUTPUT | --live FILE",
                                  "Quantities carry a unit:\n"
                                  "  rainfall mm/h in/h; speed mm/s m/s km/h mph; durations ms s min h;\n"
                                  "  lengths nm um mm cm m in; angles deg rad; surface tension mN/m N/m dyn/cm;\n"
                                  "  density kg/m3 g/cm3 g/mL; acceleration m/s2 mm/s2 g; viscosity mPa.s Pa.s\n"
                                  "\n"
                                  "Examples:\n"
                                  "  droplet-shape windshield rain.mp4 --rain 25mm/h --speed 50km/h\n"
                                  "  droplet-shape windshield 'rain-%05d.png' --background road.mp4 --layer\n"
                                  "  droplet-shape windshield still.png --preset figure-3.12 --time 30s\n"
                                  "  droplet-shape windshield --live rain.html --rain 25mm/h\n"
                                  "\n"
                                  "Exit codes:\n"
                                  "  0 done; 1 internal error; 2 usage; 3 input unreadable;\n"
                                  "  4 output cannot be written"};
    return text;
}

void declare(CommandLine& line, WindshieldOptions& options)
{
    line.addArgument("OUTPUT",
                     "Frames, such as out/%05d.png; a video, .mp4, .mkv, .mov or .webm, which needs ffmpeg; or a .png "
                     "of the last frame");
    constexpr const char* kCar = "Car and rain";
    line.add(
        kCar, "--preset", "figure-3.10|figure-3.11|figure-3.12",
        "Named set of values, of the thesis, with its capsules for droplets; without it those of figure-3.12, with "
        "capillary droplets",
        withoutDefault(into(options.preset)));
    line.add(kCar, "--rain", "RAINFALL", "Rainfall, with the drop sizes of Marshall and Palmer",
             into(options.parameters.rainfall, kRain));
    line.add(kCar, "--mist", "RAINFALL",
             "Mist with --live: growth of its thickness, such as 0.7mm/h, which makes it dense in 51s",
             into(options.parameters.mist, kMist));
    line.add(kCar, "--speed", "SPEED", "Speed of the car in still air [by preset]", within(kSpeed));
    line.add(kCar, "--drive-cycle", "FILE",
             "Speed over time: CSV with the columns time_s and speed_m_per_s or speed_km_per_h",
             into(options.drive_cycle));
    line.exclude({"--speed", "--drive-cycle"});
    line.add(kCar, "--wind-model,--wind",
             "Wind along the glass: turned keeps all of its speed, projected only the part along the glass",
             into(options.parameters.wind,
                  {{"turned", droplet::WindAlongGlass::Turned}, {"projected", droplet::WindAlongGlass::Projected}}));
    line.add(kCar, "--noise", "ACCELERATION", "Root mean square of the car's vibration",
             into(options.parameters.fluctuation.acceleration, kNoise));
    line.add(kCar, "--wiper-period,--wiper", "DURATION", "At least 1.2s; without it there are no wipers",
             into(options.wiper, kPeriod));
    line.addFlag(kCar, "--splashes", "Show rings where large raindrops hit, for some milliseconds",
                 options.parameters.splashes);
    line.add(kCar, "--seed", "N", "Random seed", seedInto(options.parameters.seed));
    constexpr const char* kGlass = "Glass";
    line.add(kGlass, "--glass-width", "LENGTH", "Width of the glass, along its bend",
             into(options.cylinder.width, kSide));
    line.add(kGlass, "--glass-height", "LENGTH", "Height of the glass, along its slope",
             into(options.cylinder.height, kSide));
    line.add(kGlass, "--glass-radius,--radius", "LENGTH", "Radius of the glass's bend across the car",
             into(options.cylinder.radius, kRadius));
    line.add(kGlass, "--slope", "ANGLE", "Slope of the glass, from horizontal", into(options.cylinder.slope, kSlope));
    line.add(kGlass, "--surface", "FILE",
             "Mesh instead of that glass: .glb or .gltf, its front +Z, normals outward, with texture coordinates that "
             "roll it out flat",
             into(options.surface));
    constexpr const char* kDroplets = "Droplets";
    line.add(kDroplets, "--hysteresis", "NUMBER",
             "Contact angle hysteresis: cosine of the receding minus cosine of the advancing angle [by preset]",
             within(0.0, 2.0));
    line.add(kDroplets, "--still-diameter", "LENGTH", "Raindrops smaller than this never move",
             into(options.parameters.still_diameter, kStill));
    line.add(kDroplets, "--film", "LENGTH", "Thickness of the film that running droplets leave behind",
             into(options.parameters.streaks.film, kFilm));
    line.add(kDroplets, "--runoff", "DURATION",
             "Time after which the film of heavy rain, which runs off in sheets and rivulets, breaks up without more "
             "rain; 0s: "
             "there is none, as on water-repellent glass [1s, with --preset 0s]",
             within(kRunoff));
    declareForces(line, options.parameters.forces);
    line.add(kDroplets, "--shape", "capillary|capsule",
             "Shape of running droplets: capillary has least energy and a tail; capsule is the thesis' "
             "[capillary, with --preset capsule]");
    constexpr const char* kTimes = "Time";
    line.add(kTimes, "--time", "DURATION", "Time to show; with --drive-cycle the cycle's own [10s]",
             into(options.duration, kTime));
    line.add(kTimes, "--warm-up", "DURATION", "Time of rain before the first frame", into(options.warm_up, kWarmUp));
    line.add(kTimes, "--fps", "RATE", "Frames per second", into(options.frames_per_second, kFrameRate));
    constexpr const char* kLooks = "View";
    line.add(kLooks, "--background", "FILE",
             "Picture or video behind the glass; a video needs ffmpeg, plays at its own speed and repeats [an evening "
             "road]",
             into(options.background));
    line.addFlag(kLooks, "--fit", "Scale the background to cover the frame and crop the rest", options.fit);
    line.add(kLooks, "--environment", "FILE",
             "Panorama around the car, its middle straight ahead: .hdr, .exr, .png or .jpg; without --background it is "
             "the whole background",
             into(options.environment));
    line.add(kLooks, "--background-blur", "ANGLE",
             "Diameter of the disc that a distant point of light becomes, up to 20deg; droplets stay sharp",
             into(options.view.background_blur, kBlur));
    line.add(kLooks, "--frame-size,--size", "SIZE",
             "Width and height of the frame in pixels [the background's, or 1280x720]");
    line.add(kLooks, "--field-of-view", "ANGLE", "Angle of view across the frame's width",
             into(options.view.field_of_view, kView));
    line.add(kLooks, "--eye-distance", "LENGTH", "Distance of the eye from the glass",
             into(options.view.eye_distance, kEye));
    line.add(kLooks, "--eye", "PLACE",
             "Position of the eye relative to the middle of the glass: right, ahead and up, such as 0.3m,-0.6m,0.1m; "
             "it is behind the glass");
    line.add(
        kLooks, "--look-at", "PLACE",
        "Point in the middle of the frame, relative to the middle of the glass: right, ahead and up [straight ahead]");
    line.add(kLooks, "--samples", "N", "Rays per pixel in each direction, 1 to 4",
             into(options.view.samples, {1, 4, "4"}));
    line.add(kLooks, "--exposure", "STOPS", "Exposure of the frame: 1 is twice the light, -1 half",
             into(options.view.exposure, {-8.0, 8.0, "a number from -8 to 8"}));
    line.add(kLooks, "--highlight-boost", "NUMBER",
             "How much brighter lamps are than the background shows them: up to 1 + this, 0 to 4 [3, by daylight less]",
             into(options.view.highlight_boost, NumberRange{0.0, 4.0, "a number from 0 to 4"}));
    line.add(kLooks, "--shutter", "OPEN",
             "Motion blur: part of a frame's time that the shutter is open, such as 180deg or 0.5 [0]",
             within(0.0, 1.0));
    line.addFlag(kLooks, "--layer", "Write only the droplets, with alpha: pictures, or a .webm, .mkv or .mov",
                 options.layer);
    declareVideoEncoding(line, kLooks);
    constexpr const char* kOut = "Beside the frames";
    line.add(kOut, "--maps", "PATH",
             "Textures of the whole glass, such as maps/%05d.png or .exr: three files per frame, -normal, -thickness "
             "and -velocity");
    line.add(kOut, "--map-width", "N", "Width of the textures in pixels", into(options.map.width, {16, 8192, "8192"}));
    line.add(kOut, "--map-thickness", "LENGTH", "Thickness of the water that is white in a PNG",
             into(options.map.full_thickness, kMapThickness));
    line.add(kOut, "--droplets", "FILE", "Write a table of all running droplets in every frame: .csv or .json");
    line.addFlag(kOut, "--moving-only", "Leave droplets at rest out of the table", options.moving_only);
    line.add(kOut, "--animation,--model", "FILE", "Write the droplets as an animated .glb, .gltf, .usda or .usdz");
    line.add(kOut, "--animation-method,--model-animation",
             "Form of the animation: nodes plays in every viewer; texture needs a shader and takes one draw call",
             into(options.model_animation,
                  {{"nodes", droplet::AnimationMethod::Nodes}, {"texture", droplet::AnimationMethod::Texture}}));
    declareCompression(line, kOut);
    line.add(kOut, "--live", "FILE",
             "Instead of OUTPUT, write a page, .html, that shows the rain as it falls, with controls and without a "
             "server; most options are where it begins");
    line.add(kOut, "--json", "FILE", "Write a report, with the water's balance every second; - is standard output",
             into(options.json));
    constexpr const char* kRun = "Run";
    line.addFlag(kRun, "--resume", "Continue an interrupted run of the same options", options.resume);
    line.addFlag(kRun, "--no-clobber", "Do not replace existing files");
    declareFrameProgress(line, kRun);
    declareCommon(line, kRun, "rain = \"5mm/h\"");
    line.exclude({"--eye", "--eye-distance"});
    line.exclude({"--resume", "--no-clobber"});
}

/// Reads the preset, which the other options change.
void readPreset(const CommandLine& line, WindshieldOptions& options)
{
    const std::string preset = line.value("--preset").value_or(Given{options.preset, ""}).text;
    options.parameters = forOption("--preset", [&] { return droplet::windshieldPresetNamed(preset).parameters; });
}

void readCar(const CommandLine& line, WindshieldOptions& options)
{
    if (const auto speed = line.value("--speed")) {
        options.parameters.vehicle = droplet::constantSpeed(quantity(*speed, kSpeed));
    }
}

void readGlass(const CommandLine& line, WindshieldOptions& options)
{
    for (const char* option : {"--glass-width", "--glass-height", "--glass-radius", "--slope"}) {
        if (options.surface && line.value(option)) {
            refuse(std::string("--surface and ") + option + " exclude each other: the surface has its own");
        }
    }
    if (options.surface) {
        const std::string extension = std::filesystem::path(*options.surface).extension().string();
        if (extension != ".glb" && extension != ".gltf") {
            refuse(*line.value("--surface"), "a file that ends in .glb or .gltf");
        }
    }
    if (!options.surface) {
        if (options.cylinder.width > std::numbers::pi * options.cylinder.radius) {
            refuse("--glass-width must be at most pi times --glass-radius: the glass can bend by half a turn at most");
        }
        options.parameters.glass = droplet::Glass(options.cylinder);
    }
}

void readDroplets(const CommandLine& line, WindshieldOptions& options)
{
    droplet::ForceModel& forces = options.parameters.forces;
    readForces(line, forces);
    constexpr double kRunoffLasts = 1.0;  // [s]
    options.parameters.runoff = line.value("--preset") ? 0.0 : kRunoffLasts;
    if (const auto runoff = line.value("--runoff")) {
        options.parameters.runoff = quantity(*runoff, kRunoff);
    }
    if (const auto hysteresis = line.value("--hysteresis")) {
        forces.wetting.hysteresis = number(*hysteresis, {0.0, 2.0, "a number from 0 to 2"});
        forces.wetting.sliding_angle.reset();
    }
}

/// Reads a position relative to the middle of the glass.
std::optional<droplet::Vec3> readPosition(const CommandLine& line, const char* option)
{
    const auto given = line.value(option);
    if (!given) {
        return std::nullopt;
    }
    const std::vector<double> parts = quantities(*given, kPlace);
    if (parts.size() != 3) {
        refuse(*given, "three lengths: to the right, ahead and up");
    }
    return droplet::Vec3{parts[0], parts[1], parts[2]};
}

void readSize(const Given& given, droplet::ViewOptions& view)
{
    const char* const end = given.text.data() + given.text.size();
    const auto [cross, failure] = std::from_chars(given.text.data(), end, view.width);
    const bool is_whole = failure == std::errc{} && cross != end && *cross == 'x';
    const auto [stop, second] = is_whole ? std::from_chars(cross + 1, end, view.height)
                                         : std::from_chars_result{end, std::errc::invalid_argument};
    constexpr int kMin = 16;
    constexpr int kMax = 8192;
    if (!is_whole || second != std::errc{} || stop != end || view.width < kMin || view.width > kMax ||
        view.height < kMin || view.height > kMax) {
        refuse(given, "WIDTHxHEIGHT, each from 16 to 8192");
    }
}

void readView(const CommandLine& line, WindshieldOptions& options)
{
    if (const auto size = line.value("--frame-size")) {
        readSize(*size, options.view);
        options.sized = true;
    }
    if (options.fit && !options.background) {
        refuse("--fit needs a --background");
    }
    options.view.eye = readPosition(line, "--eye");
    options.view.look_at = readPosition(line, "--look-at");
    options.view.shape.contact_angle = options.parameters.forces.wetting.contact_angle;
    options.view.forces = options.parameters.forces;
    options.view.body = line.value("--preset") ? droplet::BodyShape::Capsule : droplet::BodyShape::Capillary;
    if (const auto shape = line.value("--shape")) {
        options.view.body = choice<droplet::BodyShape>(
            *shape, {{"capillary", droplet::BodyShape::Capillary}, {"capsule", droplet::BodyShape::Capsule}});
    }
    options.map.body = options.view.body;
    options.map.shape = options.view.shape;
    options.map.forces = options.view.forces;
}

/// Reads the time for which the shutter is open in each frame.
void readShutter(const CommandLine& line, WindshieldOptions& options)
{
    const auto given = line.value("--shutter");
    if (!given) {
        return;
    }
    constexpr const char* kAllowed = "from 0deg to 360deg, or a number from 0 to 1";
    double share = 0.0;
    if (const auto plain = finiteNumber(given->text)) {
        share = *plain;
    } else {
        share = quantity(*given, {Dimension::Angle, 0.0, 360.0 * kDegree, kAllowed}) / (360.0 * kDegree);
    }
    if (share < 0.0 || share > 1.0) {
        refuse(*given, kAllowed);
    }
    options.view.shutter_time = share / options.frames_per_second;
}

/// Reads --live, which OUTPUT and all files beside it exclude.
void readLive(const CommandLine& line, WindshieldOptions& options)
{
    const Given page = *line.value("--live");
    checkLive(line);
    if (!isStream(page.text) && lowerExtension(page.text) != ".html") {
        refuse(page, "a file that ends in .html");
    }
    options.live = LivePage{page.text, {}};
    for (const auto& [name, value] : line.given()) {
        options.live->given.insert(name);
    }
}

void readOutputs(const CommandLine& line, WindshieldOptions& options)
{
    options.output = line.argument("OUTPUT");
    const Given output{options.output, "OUTPUT"};
    options.files = NumberedPath::of(options.output, "OUTPUT");
    options.is_video = !options.files && isVideo(options.output);
    if (!options.is_video && std::filesystem::path(options.output).extension() != ".png") {
        refuse(output, "frames such as out/%05d.png, a .mp4, .mkv, .mov or .webm, or a .png");
    }
    options.encoding = readVideoEncoding(line, options.is_video, "OUTPUT, not '" + options.output + "'");
    if (options.layer && options.is_video) {
        keepAlpha(options.encoding, options.output, "--layer");
    }
    if (const auto maps = line.value("--maps")) {
        options.maps = NumberedPath::of(maps->text, "--maps");
        if (!options.maps) {
            refuse(*maps, "a path with one %d or %04d, for the number, in the file's name");
        }
    }
    options.are_maps_exr = areMapsExr(line, {"--map-width", "--map-thickness"}, "a path that ends in .png or .exr");
    if (const auto droplets = line.value("--droplets")) {
        const std::string extension = std::filesystem::path(droplets->text).extension().string();
        if (extension != ".csv" && extension != ".json") {
            refuse(*droplets, "a file that ends in .csv or .json");
        }
        options.droplets = droplets->text;
    }
    if (options.moving_only && !options.droplets) {
        refuse("--moving-only needs --droplets");
    }
    if (const auto model = line.value("--animation")) {
        const std::string extension = std::filesystem::path(model->text).extension().string();
        if (!std::set<std::string>{".glb", ".gltf", ".usda", ".usdz"}.contains(extension)) {
            refuse(*model, "a file that ends in .glb, .gltf, .usda or .usdz");
        }
        options.model = model->text;
        options.model_file.format = droplet::formatNamed(extension);
        options.model_file.compression = readCompression(line, options.model_file.format);
    } else if (line.value("--compress")) {
        refuse("--compress needs --animation");
    }
    if (line.value("--animation-method") && !options.model) {
        refuse("--animation-method needs --animation");
    }
    if (options.model_animation == droplet::AnimationMethod::Texture &&
        options.model_file.format != droplet::Format::Glb && options.model_file.format != droplet::Format::Gltf) {
        refuse("--animation-method texture needs a .glb or .gltf: USD has no shader that places the droplets");
    }
    if (options.resume && !options.files) {
        refuse("--resume needs frames as OUTPUT, such as out/%05d.png, not '" + options.output + "'");
    }
}

}  // namespace

std::variant<WindshieldOptions, std::string> parseWindshield(int argc, const char* const* argv)
{
    CommandLine line(commandText());
    WindshieldOptions options;
    options.parameters = droplet::windshieldPresetNamed(options.preset).parameters;
    declare(line, options);
    line.parse(argc, argv);
    if (const auto text = requestedText(line)) {
        return *text;
    }
    readPreset(line, options);
    line.read();
    readCar(line, options);
    readGlass(line, options);
    readDroplets(line, options);
    readView(line, options);
    options.run = readRun(line);
    if (line.value("--live")) {
        readLive(line, options);
        return options;
    }
    if (line.value("--mist")) {
        refuse("--mist needs --live: frames do not show mist");
    }
    readOutputs(line, options);
    readShutter(line, options);
    options.fingerprint = optionsOfFrames(
        line, options.output, {"--droplets", "--animation", "--moving-only", "--animation-method", "--compress"});
    return options;
}

}  // namespace cli
