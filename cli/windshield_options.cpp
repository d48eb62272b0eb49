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
#include "option_values.h"
#include "value_list.h"
#include "video_writer.h"

namespace cli {
namespace {

using droplet::Dimension;
using droplet::kDegree;

constexpr Range kRain{Dimension::Rainfall, 0.0, 1000.0 * droplet::kMillimetrePerHour, "from 0mm/h to 1000mm/h"};
constexpr Range kSpeed{Dimension::Speed, 0.0, 150.0, "from 0m/s to 150m/s"};
constexpr Range kStill{Dimension::Length, 1.1e-4, 2e-3, "from 0.11mm to 2mm"};
constexpr Range kSide{Dimension::Length, 0.05, 5.0, "from 50mm to 5m"};
constexpr Range kRadius{Dimension::Length, 0.1, 1e6, "from 0.1m to 1e6m"};
constexpr Range kSlope{Dimension::Angle, 0.0, 90.0 * kDegree, "from 0deg to 90deg"};
constexpr Range kNoise{Dimension::Acceleration, 0.0, 1e3, "from 0m/s2 to 1000m/s2"};
constexpr Range kFilm{Dimension::Length, 0.0, 1e-3, "from 0mm to 1mm"};
constexpr Range kTime{Dimension::Duration, 1e-3, 86400.0, "from 1ms to 24h"};
constexpr Range kWarmUp{Dimension::Duration, 0.0, 86400.0, "from 0s to 24h"};
constexpr Range kPeriod{Dimension::Duration, 1.2, 60.0, "from 1.2s to 60s"};
constexpr Range kView{Dimension::Angle, kDegree, 150.0 * kDegree, "from 1deg to 150deg"};
constexpr Range kBlur{Dimension::Angle, 0.0, 20.0 * kDegree, "from 0deg to 20deg"};
constexpr Range kPlace{Dimension::Length, -100.0, 100.0, "from -100m to 100m each"};
constexpr Range kMapThickness{Dimension::Length, 1e-6, 1.0, "from 1um to 1m"};
constexpr Range kEye{Dimension::Length, 0.01, 100.0, "from 10mm to 100m"};

const CommandText& commandText()
{
    static const CommandText text{"droplet-shape windshield", "show rain on a moving car's windshield",
                                  "[OPTIONS] OUTPUT",
                                  "Quantities carry a unit:\n"
                                  "  rainfall mm/h in/h; speed mm/s m/s km/h mph; durations ms s min h;\n"
                                  "  lengths nm um mm cm m in; angles deg rad; surface tension mN/m N/m dyn/cm;\n"
                                  "  density kg/m3 g/cm3 g/mL; acceleration m/s2 mm/s2 g; viscosity mPa.s Pa.s\n"
                                  "\n"
                                  "Examples:\n"
                                  "  droplet-shape windshield rain.mp4 --rain 25mm/h --speed 50km/h\n"
                                  "  droplet-shape windshield 'rain-%05d.png' --background road.mp4 --layer\n"
                                  "  droplet-shape windshield still.png --preset figure-3.12 --time 30s\n"
                                  "\n"
                                  "Exit codes:\n"
                                  "  0 done; 1 internal error; 2 usage; 3 input unreadable;\n"
                                  "  4 output cannot be written"};
    return text;
}

void declare(CommandLine& line)
{
    line.addArgument("OUTPUT",
                     "Frames, such as out/%05d.png; a video, .mp4, .mkv, .mov or .webm, which needs ffmpeg; or a .png "
                     "of the last frame");
    constexpr const char* kCar = "Car and rain";
    line.add(kCar, "--preset", "figure-3.10|figure-3.11|figure-3.12",
             "Named set of default values, of the thesis [figure-3.12]");
    line.add(kCar, "--rain", "RAINFALL", "Rainfall, with the drop sizes of Marshall and Palmer [5mm/h]");
    line.add(kCar, "--speed", "SPEED", "Speed of the car in still air [by preset]");
    line.add(kCar, "--drive-cycle", "FILE",
             "Speed over time: CSV with the columns time_s and speed_m_per_s or speed_km_per_h");
    line.exclude({"--speed", "--drive-cycle"});
    line.add(kCar, "--wind-model,--wind", "turned|projected",
             "Wind along the glass: turned keeps all of its speed, projected only the part along the glass [turned]");
    line.add(kCar, "--noise", "ACCELERATION", "Root mean square of the car's vibration [0.5m/s2]");
    line.add(kCar, "--wiper-period,--wiper", "DURATION", "At least 1.2s; without it there are no wipers");
    line.add(kCar, "--seed", "N", "Random seed [1]");
    constexpr const char* kGlass = "Glass";
    line.add(kGlass, "--glass-width", "LENGTH", "Width of the glass, along its bend [1.4m]");
    line.add(kGlass, "--glass-height", "LENGTH", "Height of the glass, along its slope [0.8m]");
    line.add(kGlass, "--glass-radius,--radius", "LENGTH", "Radius of the glass's bend across the car [5m]");
    line.add(kGlass, "--slope", "ANGLE", "Slope of the glass, from horizontal [45deg]");
    line.add(kGlass, "--surface", "FILE",
             "Mesh instead of that glass: .glb or .gltf, its front +Z, normals outward, with texture coordinates that "
             "roll it out flat");
    constexpr const char* kDroplets = "Droplets";
    line.add(kDroplets, "--hysteresis", "NUMBER",
             "Contact angle hysteresis: cosine of the receding minus cosine of the advancing angle [by preset]");
    line.add(kDroplets, "--still-diameter", "LENGTH", "Raindrops smaller than this never move [1mm]");
    line.add(kDroplets, "--film", "LENGTH", "Thickness of the film that running droplets leave behind [0mm]");
    declareForces(line);
    line.add(kDroplets, "--shape", "capillary|capsule",
             "Shape of running droplets: capillary has least energy and a tail; capsule is the thesis' "
             "[capillary, with --preset capsule]");
    constexpr const char* kTimes = "Time";
    line.add(kTimes, "--time", "DURATION", "Time to show; with --drive-cycle the cycle's own [10s]");
    line.add(kTimes, "--warm-up", "DURATION", "Time of rain before the first frame [10s]");
    line.add(kTimes, "--fps", "RATE", "Frames per second [30]");
    constexpr const char* kLooks = "View";
    line.add(kLooks, "--background", "FILE",
             "Picture or video behind the glass; a video needs ffmpeg, plays at its own speed and repeats [an evening "
             "road]");
    line.addFlag(kLooks, "--fit", "Scale the background to cover the frame and crop the rest");
    line.add(kLooks, "--environment", "FILE",
             "Panorama around the car, its middle straight ahead: .hdr, .exr, .png or .jpg; without --background it is "
             "the whole background");
    line.add(kLooks, "--background-blur", "ANGLE",
             "Diameter of the disc that a distant point of light becomes, up to 20deg; droplets stay sharp [0deg]");
    line.add(kLooks, "--frame-size,--size", "SIZE",
             "Width and height of the frame in pixels [the background's, or 1280x720]");
    line.add(kLooks, "--field-of-view", "ANGLE", "Angle of view across the frame's width [45deg]");
    line.add(kLooks, "--eye-distance", "LENGTH", "Distance of the eye from the glass [0.5m]");
    line.add(kLooks, "--eye", "PLACE",
             "Position of the eye relative to the middle of the glass: right, ahead and up, such as 0.3m,-0.6m,0.1m; "
             "it is behind the glass");
    line.add(
        kLooks, "--look-at", "PLACE",
        "Point in the middle of the frame, relative to the middle of the glass: right, ahead and up [straight ahead]");
    line.add(kLooks, "--samples", "N", "Rays per pixel in each direction, 1 to 4 [2]");
    line.add(kLooks, "--exposure", "STOPS", "Exposure of the frame: 1 is twice the light, -1 half [0]");
    line.add(
        kLooks, "--highlight-boost", "NUMBER",
        "How much brighter lamps are than the background shows them: up to 1 + this, 0 to 4 [3, by daylight less]");
    line.add(kLooks, "--shutter", "OPEN",
             "Motion blur: part of a frame's time that the shutter is open, such as 180deg or 0.5 [0]");
    line.addFlag(kLooks, "--layer", "Write only the droplets, with alpha: pictures, or a .webm, .mkv or .mov");
    declareVideoEncoding(line, kLooks);
    constexpr const char* kOut = "Beside the frames";
    line.add(kOut, "--maps", "PATH",
             "Textures of the whole glass, such as maps/%05d.png or .exr: three files per frame, -normal, -thickness "
             "and -velocity");
    line.add(kOut, "--map-width", "N", "Width of the textures in pixels [2048]");
    line.add(kOut, "--map-thickness", "LENGTH", "Thickness of the water that is white in a PNG [5mm]");
    line.add(kOut, "--droplets", "FILE", "Write a table of all running droplets in every frame: .csv or .json");
    line.addFlag(kOut, "--moving-only", "Leave droplets at rest out of the table");
    line.add(kOut, "--animation,--model", "FILE", "Write the droplets as an animated .glb, .gltf, .usda or .usdz");
    line.add(
        kOut, "--animation-method,--model-animation", "nodes|texture",
        "Form of the animation: nodes plays in every viewer; texture needs a shader and takes one draw call [nodes]");
    declareCompression(line, kOut);
    line.add(kOut, "--json", "FILE", "Write a report, with the water's balance every second; - is standard output");
    constexpr const char* kRun = "Run";
    line.addFlag(kRun, "--resume", "Continue an interrupted run of the same options");
    line.addFlag(kRun, "--no-clobber", "Do not replace existing files");
    declareFrameProgress(line, kRun);
    declareCommon(line, kRun, "rain = \"5mm/h\"");
    line.exclude({"--eye", "--eye-distance"});
    line.exclude({"--resume", "--no-clobber"});
}

/// Reads an option into `value`, if it is given.
void readQuantity(const CommandLine& line, const char* option, const Range& range, double& value)
{
    if (const auto given = line.value(option)) {
        value = quantity(*given, range);
    }
}

std::optional<std::string> text(const CommandLine& line, const char* option)
{
    const auto given = line.value(option);
    return given ? std::optional(given->text) : std::nullopt;
}

void readCar(const CommandLine& line, WindshieldOptions& options)
{
    droplet::WindshieldParameters& parameters = options.parameters;
    if (const auto preset = line.value("--preset")) {
        options.preset = preset->text;
    }
    parameters = forOption("--preset", [&] { return droplet::windshieldPresetNamed(options.preset).parameters; });
    readQuantity(line, "--rain", kRain, parameters.rainfall);
    if (const auto speed = line.value("--speed")) {
        parameters.vehicle = droplet::constantSpeed(quantity(*speed, kSpeed));
    }
    options.drive_cycle = text(line, "--drive-cycle");
    if (const auto wind = line.value("--wind-model")) {
        parameters.wind = choice<droplet::WindAlongGlass>(
            *wind, {{"turned", droplet::WindAlongGlass::Turned}, {"projected", droplet::WindAlongGlass::Projected}});
    }
    readQuantity(line, "--noise", kNoise, parameters.fluctuation.acceleration);
    if (const auto wiper = line.value("--wiper-period")) {
        options.wiper = quantity(*wiper, kPeriod);
    }
    if (const auto seed = line.value("--seed")) {
        const char* const end = seed->text.data() + seed->text.size();
        const auto [stop, failure] = std::from_chars(seed->text.data(), end, parameters.seed);
        if (failure != std::errc{} || stop != end) {
            refuse(*seed, "a whole number from 0 to 18446744073709551615");
        }
    }
}

void readGlass(const CommandLine& line, WindshieldOptions& options)
{
    options.surface = text(line, "--surface");
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
    readQuantity(line, "--glass-width", kSide, options.cylinder.width);
    readQuantity(line, "--glass-height", kSide, options.cylinder.height);
    readQuantity(line, "--glass-radius", kRadius, options.cylinder.radius);
    readQuantity(line, "--slope", kSlope, options.cylinder.slope);
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
    forces = readForces(line, forces);
    if (const auto hysteresis = line.value("--hysteresis")) {
        forces.wetting.hysteresis = number(*hysteresis, {0.0, 2.0, "a number from 0 to 2"});
        forces.wetting.sliding_angle.reset();
    }
    readQuantity(line, "--still-diameter", kStill, options.parameters.still_diameter);
    readQuantity(line, "--film", kFilm, options.parameters.streaks.film);
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
    options.background = text(line, "--background");
    options.environment = text(line, "--environment");
    options.fit = line.flag("--fit");
    if (const auto size = line.value("--frame-size")) {
        readSize(*size, options.view);
        options.sized = true;
    }
    if (options.fit && !options.background) {
        refuse("--fit needs a --background");
    }
    readQuantity(line, "--background-blur", kBlur, options.view.background_blur);
    readQuantity(line, "--field-of-view", kView, options.view.field_of_view);
    readQuantity(line, "--eye-distance", kEye, options.view.eye_distance);
    options.view.eye = readPosition(line, "--eye");
    options.view.look_at = readPosition(line, "--look-at");
    if (const auto samples = line.value("--samples")) {
        options.view.samples = static_cast<int>(count(*samples, 4, "4"));
    }
    if (const auto exposure = line.value("--exposure")) {
        options.view.exposure = number(*exposure, {-8.0, 8.0, "a number from -8 to 8"});
    }
    if (const auto boost = line.value("--highlight-boost")) {
        options.view.highlight_boost = number(*boost, {0.0, 4.0, "a number from 0 to 4"});
    }
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
    options.layer = line.flag("--layer");
    if (const auto width = line.value("--map-width")) {
        options.map.width = static_cast<int>(count(*width, 8192, "8192"));
        if (options.map.width < 16) {
            refuse(*width, "a whole number from 16 to 8192");
        }
    }
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
        const std::string extension = std::filesystem::path(maps->text).extension().string();
        if (extension != ".png" && extension != ".exr") {
            refuse(*maps, "a path that ends in .png or .exr");
        }
        options.are_maps_exr = extension == ".exr";
    }
    for (const char* option : {"--map-width", "--map-thickness"}) {
        if (line.value(option) && !options.maps) {
            refuse(std::string(option) + " needs --maps");
        }
    }
    if (line.value("--map-thickness") && options.are_maps_exr) {
        refuse("--map-thickness needs --maps with .png: .exr has metres");
    }
    readQuantity(line, "--map-thickness", kMapThickness, options.map.full_thickness);
    if (const auto droplets = line.value("--droplets")) {
        const std::string extension = std::filesystem::path(droplets->text).extension().string();
        if (extension != ".csv" && extension != ".json") {
            refuse(*droplets, "a file that ends in .csv or .json");
        }
        options.droplets = droplets->text;
    }
    options.moving_only = line.flag("--moving-only");
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
    if (const auto animation = line.value("--animation-method")) {
        options.model_animation = choice<droplet::AnimationMethod>(
            *animation, {{"nodes", droplet::AnimationMethod::Nodes}, {"texture", droplet::AnimationMethod::Texture}});
        if (!options.model) {
            refuse("--animation-method needs --animation");
        }
        if (options.model_animation == droplet::AnimationMethod::Texture &&
            options.model_file.format != droplet::Format::Glb && options.model_file.format != droplet::Format::Gltf) {
            refuse("--animation-method texture needs a .glb or .gltf: USD has no shader that places the droplets");
        }
    }
    options.json = text(line, "--json");
    options.resume = line.flag("--resume");
    if (options.resume && !options.files) {
        refuse("--resume needs frames as OUTPUT, such as out/%05d.png, not '" + options.output + "'");
    }
}

}  // namespace

std::variant<WindshieldOptions, std::string> parseWindshield(int argc, const char* const* argv)
{
    CommandLine line(commandText());
    declare(line);
    line.parse(argc, argv);
    if (const auto text = requestedText(line)) {
        return *text;
    }
    WindshieldOptions options;
    readCar(line, options);
    readGlass(line, options);
    readDroplets(line, options);
    readView(line, options);
    readOutputs(line, options);
    if (const auto duration = line.value("--time")) {
        options.duration = quantity(*duration, kTime);
    }
    readQuantity(line, "--warm-up", kWarmUp, options.warm_up);
    if (const auto rate = line.value("--fps")) {
        options.frames_per_second = number(*rate, {1.0, 1000.0, "a number from 1 to 1000"});
    }
    readShutter(line, options);
    options.run = readRun(line);
    options.fingerprint = optionsOfFrames(
        line, options.output, {"--droplets", "--animation", "--moving-only", "--animation-method", "--compress"});
    return options;
}

}  // namespace cli
