// SPDX-License-Identifier: GPL-3.0-or-later
#include "liquid2d_options.h"

#include <filesystem>

#include "command_line.h"
#include "common_options.h"
#include "droplet/liquid2d_io/fluid_presets.h"
#include "droplet/liquid2d_io/write_particles.h"
#include "droplet/units.h"
#include "files.h"
#include "option_values.h"
#include "value_list.h"
#include "video_writer.h"

namespace cli {
namespace {

using droplet::Dimension;

constexpr Range kTime{Dimension::Duration, 1e-3, 3600.0, "from 1ms to 1h"};
constexpr Range kTail{Dimension::Duration, 0.0, 60.0, "from 0s to 60s"};
constexpr Range kGravity{Dimension::Acceleration, 0.0, 1e4, "from 0m/s2 to 10000m/s2"};
constexpr Range kTension{Dimension::SurfaceTension, 0.0, 1e6, "from 0N/m to 1e6N/m"};
constexpr Range kSpacing{Dimension::Length, 1e-6, 1e3, "from 1um to 1000m"};

const CommandText& commandText()
{
    static const CommandText text{"droplet-shape liquid2d", "draw an animation of liquid in the plane",
                                  "[OPTIONS] [OUTPUT]",
                                  "Quantities carry a unit:\n"
                                  "  lengths um mm cm m in; durations ms s min h; acceleration m/s2 mm/s2 g;\n"
                                  "  surface tension mN/m N/m dyn/cm\n"
                                  "\n"
                                  "Examples:\n"
                                  "  droplet-shape liquid2d --scene splash 'out/%04d.svg'\n"
                                  "  droplet-shape liquid2d --scene wave --particle-count 20k wave.mp4\n"
                                  "  droplet-shape liquid2d --scene dam --look flat dam.json\n"
                                  "  droplet-shape liquid2d --particles 'sim/%04d.vtp' --style wave 'out/%04d.png'\n"
                                  "  droplet-shape liquid2d --scene dam --masks - | droplet-shape animate - out.glb\n"
                                  "\n"
                                  "Exit codes:\n"
                                  "  0 done; 1 internal error; 2 usage; 3 input unreadable; 4 output cannot be\n"
                                  "  written; 5 the liquid is lost"};
    return text;
}

void declare(CommandLine& line, Liquid2dOptions& options)
{
    line.addArgument(
        "OUTPUT",
        "Drawings of all frames, such as out/%04d.svg or out/%04d.png; an .svg or .png of the last frame; "
        "a .json with all frames as a Lottie animation, for web pages, apps and animation programs; or a "
        "video, .mp4, .mkv, .mov or .webm, which needs ffmpeg; may be left out with --masks or --particle-cache");
    constexpr const char* kLiquid = "Liquid";
    line.add(kLiquid, "--scene", (wordsOf(droplet::fluidPresets(), &droplet::FluidPreset::name) + "|FILE.toml").c_str(),
             "Scene to simulate", into(options.scene));
    line.add(kLiquid, "--particle-count", "N", "Number of particles at the start, up to 1M [the scene's]",
             into(options.particle_count, CountRange{1, 1'000'000, "1M"}));
    line.add(kLiquid, "--walls", "FILE", "Further walls: a mask, drawn over the width of the window",
             into(options.walls));
    line.add(kLiquid, "--gravity", "ACCELERATION", "Gravity instead of the scene's, downwards",
             into(options.gravity, kGravity));
    line.add(kLiquid, "--surface-tension", "TENSION", "Surface tension instead of the scene's",
             into(options.surface_tension, kTension));
    line.add(
        kLiquid, "--solver", "Method that finds the pressure: a grid, or particles alone by divergence-free SPH",
        into(options.solver, {{"grid", droplet::PressureSolver::Grid}, {"dfsph", droplet::PressureSolver::Dfsph}}));
    line.add(kLiquid, "--particles", "PATH",
             "Particles of another simulation, such as sim/%04d.vtp or a single file, instead of a scene: .csv, .vtk, "
             ".vtp, .vtu or .bgeo");
    line.add(kLiquid, "--particle-scale", "NUMBER", "Length of the unit of these files in metres",
             into(options.particle_reading.scale, {1e-9, 1e9, "a number from 1e-9 to 1e9"}));
    line.add(kLiquid, "--plane", "Axes of these files that become x and y",
             into(options.particle_reading.plane,
                  {{"xy", "xy"}, {"xz", "xz"}, {"yz", "yz"}, {"zx", "zx"}, {"zy", "zy"}, {"yx", "yx"}}));
    line.add(kLiquid, "--spacing", "LENGTH", "Distance of their particles at rest [median distance of neighbours]",
             into(options.particle_reading.spacing, kSpacing));
    line.exclude({"--scene", "--particles"});
    constexpr const char* kTimes = "Time";
    line.add(kTimes, "--time", "DURATION", "Time to show [the scene's]", into(options.duration, kTime));
    line.add(kTimes, "--begin", "DURATION", "Time of the simulation at which the film begins [0s, or --loop]",
             into(options.begin, kTail));
    line.add(
        kTimes, "--loop", "DURATION",
        "Makes the film a loop: in its last part, of this length, drawings turn into those before --begin, so that "
        "the first frame goes on from the last",
        into(options.loop, kTail));
    line.add(kTimes, "--fps", "RATE", "Frames per second", into(options.frames_per_second, kFrameRate));
    line.add(kTimes, "--hold", "N", "Frames that a drawing stays, up to 24: 2 draws on twos",
             into(options.hold, {1, 24, "24"}));
    constexpr const char* kSurface = "Surface";
    line.add(
        kSurface, "--style", "realistic|cartoon|wave|paper",
        "Starting point of these controls: cartoon has tails; wave has claws at crests, too, and paper hollows them "
        "[the scene's, or cartoon]");
    droplet::ExpressionOptions& controls = options.controls;
    line.add(kSurface, "--tail", "DURATION", "Time whose way the tail of a droplet in flight shows [by style]",
             into(controls.tail_length, kTail));
    line.add(kSurface, "--tail-slope", "NUMBER", "Taper of tails, from 0.2, thick, to 1.2, thin",
             into(controls.tail_slope, {0.2, 1.2, "a number from 0.2 to 1.2"}));
    line.add(kSurface, "--max-tail", "NUMBER", "Maximum length of a tail, in radii of its droplet",
             into(controls.max_tail, {0.0, 100.0, "a number from 0 to 100"}));
    line.add(kSurface, "--claws", "NUMBER", "Length of claws at crests, in distances of particles, 0 to 100 [by style]",
             into(controls.claws, {0.0, 100.0, "a number from 0 to 100"}));
    line.add(kSurface, "--air", "NUMBER",
             "Rate at which air enters crests, in areas of a particle per second [by style]",
             into(controls.air, {0.0, 1e6, "a number from 0 to 1e6"}));
    line.add(kSurface, "--release", "NUMBER", "Rate at which slow liquid releases air [by style]",
             into(controls.release, {0.0, 1e6, "a number from 0 to 1e6"}));
    line.add(kSurface, "--max-air", "NUMBER", "Maximum air of a particle, in its areas [by style]",
             into(controls.max_air, {0.0, 1000.0, "a number from 0 to 1000"}));
    line.add(kSurface, "--eraser-share", "NUMBER", "Share of particles that may hold air, 0 to 1",
             into(controls.eraser_share, {0.0, 1.0, "a number from 0 to 1"}));
    line.addFlag(kSurface, "--no-crest-gate", "Air enters anywhere at the surface, as in the paper");
    line.add(kSurface, "--smoothing", "NUMBER", "Smoothness of the surface, 0 to 2",
             into(controls.smoothing, {0.0, 2.0, "a number from 0 to 2"}));
    line.add(kSurface, "--fairing", "NUMBER", "Smoothing of wrinkles of a few particles, 0 to 10 [2.5, realistic 1]",
             into(controls.fairing, {0.0, 10.0, "a number from 0 to 10"}));
    line.add(kSurface, "--resolution", "NUMBER",
             "Grid of the surface, in distances of particles, 0.2 to 1 [0.4, realistic 0.5]",
             into(controls.resolution, {0.2, 1.0, "a number from 0.2 to 1"}));
    constexpr const char* kOut = "Output";
    line.add(kOut, "--frame-width,--width", "N", "Width of drawings and masks in pixels, up to 16384",
             into(options.width, {16, 16384, "16384"}));
    line.add(kOut, "--look", wordsOf(droplet::liquidLooks(), &droplet::LiquidLook::name).c_str(),
             "Colours and lines [comic; flat for realistic]");
    line.add(kOut, "--line-width", "NUMBER", "Width of outlines, in thousandths of the drawing's width",
             within(0.0, 50.0));
    line.add(kOut, "--least-droplet", "NUMBER",
             "Diameter of the smallest droplet that is drawn, in thousandths of the drawing's width [2]",
             within(0.0, 50.0));
    line.add(kOut, "--masks", "PATH",
             "Masks of all frames, such as masks/%04d.png; - writes them to standard output, for animate");
    line.add(
        kOut, "--particle-cache", "PATH",
        "Particles of all frames, such as cache/%04d.bgeo: .bgeo, .vtp, .ply or .csv; or a .usda with all of them, "
        "as points over time");
    declareVideoEncoding(line, kOut);
    declareVideoAlpha(line, kOut);
    line.add(kOut, "--json", "FILE", "Write a report; - is standard output", into(options.json));
    constexpr const char* kRun = "Run";
    line.addFlag(kRun, "--resume", "Continue an interrupted run of the same options", options.resume);
    line.addFlag(kRun, "--no-clobber", "Do not replace existing files");
    declareFrameProgress(line, kRun);
    declareCommon(line, kRun, "time = \"5s\"");
    line.exclude({"--resume", "--no-clobber"});
}

void readLiquid(const CommandLine& line, Liquid2dOptions& options)
{
    if (const auto particles = line.value("--particles")) {
        options.particles = particles->text;
        options.particle_files = NumberedPath::of(particles->text, "--particles");
        for (const char* option :
             {"--particle-count", "--walls", "--gravity", "--surface-tension", "--solver", "--time"}) {
            if (line.value(option)) {
                refuse(std::string(option) + " needs --scene, not --particles");
            }
        }
    } else {
        for (const char* option : {"--particle-scale", "--plane", "--spacing"}) {
            if (line.value(option)) {
                refuse(std::string(option) + " needs --particles");
            }
        }
    }
}

/// Reads --style, whose controls the other options change.
void readStyle(const CommandLine& line, Liquid2dOptions& options)
{
    if (!line.value("--particles")) {
        const std::string scene = line.value("--scene").value_or(Given{options.scene, ""}).text;
        for (const droplet::FluidPreset& preset : droplet::fluidPresets()) {
            options.style = preset.name == scene ? preset.style : options.style;
        }
    }
    const Given style = line.value("--style").value_or(Given{options.style, "--style"});
    options.style = style.text;
    options.controls =
        droplet::expressionOf(forOption("--style", [&] { return droplet::liquidStyleNamed(style.text); }));
}

void readTimes(const CommandLine& line, Liquid2dOptions& options)
{
    const auto loop = line.value("--loop");
    if (!loop) {
        return;
    }
    if (options.begin.value_or(options.loop) < options.loop) {
        refuse(*loop, "no longer than --begin: what it fades to is before the film");
    }
    if (options.loop > 0.0 && line.value("--particle-cache")) {
        refuse("--loop fades drawings, not particles: --particle-cache cannot be a loop");
    }
}

void readLook(const CommandLine& line, Liquid2dOptions& options)
{
    options.controls.crest_gate = !line.flag("--no-crest-gate");
    const auto look = line.value("--look");
    options.look = forOption("--look", [&] {
        return droplet::liquidLookNamed(look ? look->text : options.style == "realistic" ? "flat" : "comic");
    });
    if (const auto width = line.value("--line-width")) {
        options.look.line_width = number(*width, {0.0, 50.0, "a number from 0 to 50"});
    }
    if (const auto least = line.value("--least-droplet")) {
        options.look.least_droplet = number(*least, {0.0, 50.0, "a number from 0 to 50"});
    }
}

void readOutputs(const CommandLine& line, Liquid2dOptions& options)
{
    if (const auto masks = line.value("--masks")) {
        options.masks = masks->text;
        if (!isStream(masks->text)) {
            options.mask_files = NumberedPath::of(masks->text, "--masks");
            if (!options.mask_files || std::filesystem::path(masks->text).extension() != ".png") {
                refuse(*masks, "a path such as masks/%04d.png, or -");
            }
        }
    }
    if (const auto cache = line.value("--particle-cache")) {
        options.cache_files = NumberedPath::of(cache->text, "--particle-cache");
        if (!options.cache_files && std::filesystem::path(cache->text).extension() == ".usda") {
            options.cache_file = cache->text;
        } else if (!options.cache_files || !droplet::particleFormatOf(cache->text)) {
            refuse(*cache, "a path such as cache/%04d.bgeo, .vtp, .ply or .csv, or a .usda");
        }
    }
    if (!line.values("OUTPUT").empty() || !(options.masks || options.cache_files || options.cache_file)) {
        options.output = line.argument("OUTPUT");
        options.files = NumberedPath::of(*options.output, "OUTPUT");
        const std::string extension = std::filesystem::path(*options.output).extension().string();
        const bool is_drawing = extension == ".svg" || extension == ".png";
        if (is_drawing) {
            options.kind = options.files ? LiquidOutput::Drawings : LiquidOutput::Drawing;
        } else if (!options.files && isVideo(*options.output)) {
            options.kind = LiquidOutput::Video;
        } else if (!options.files && extension == ".json") {
            options.kind = LiquidOutput::Lottie;
        } else {
            refuse({*options.output, "OUTPUT"},
                   "a file for every frame such as out/%04d.svg or .png; a single .svg or .png; a .json with a Lottie "
                   "animation; or a .mp4, .mkv, .mov or .webm");
        }
    }
    if (const auto width = line.value("--frame-width");
        width && options.kind == LiquidOutput::Video && options.width % 2 != 0) {
        refuse(*width, "even, as a video's frame must have even sides");
    }
    options.encoding = readVideoEncoding(line, options.kind == LiquidOutput::Video, "OUTPUT");
    if (line.flag("--alpha")) {
        if (options.kind != LiquidOutput::Video) {
            refuse("--alpha needs a video as OUTPUT; pictures keep their transparency without it");
        }
        keepAlpha(options.encoding, *options.output, "--alpha");
    }
    const bool has_files = options.kind == LiquidOutput::Drawings ||
                           (options.kind == LiquidOutput::None && (options.mask_files || options.cache_files));
    if (options.resume && (!has_files || (options.masks && !options.mask_files) || options.cache_file)) {
        refuse("--resume needs a file for every frame, such as out/%04d.svg, and no masks on standard output");
    }
}

}  // namespace

std::variant<Liquid2dOptions, std::string> parseLiquid2d(int argc, const char* const* argv)
{
    CommandLine line(commandText());
    Liquid2dOptions options;
    options.controls = droplet::expressionOf(droplet::LiquidStyle::Cartoon);
    declare(line, options);
    line.parse(argc, argv);
    if (const auto text = requestedText(line)) {
        return *text;
    }
    readStyle(line, options);
    line.read();
    readLiquid(line, options);
    readLook(line, options);
    readOutputs(line, options);
    readTimes(line, options);
    options.run = readRun(line);
    options.fingerprint = optionsOfFrames(line, options.output.value_or(""));
    return options;
}

}  // namespace cli
