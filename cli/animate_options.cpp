// SPDX-License-Identifier: GPL-3.0-or-later
#include "animate_options.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "common_options.h"
#include "droplet/error.h"
#include "files.h"
#include "preview.h"
#include "shape_options.h"
#include "value_list.h"
#include "video_writer.h"

namespace cli {
namespace {

const CommandText& commandText()
{
    static const CommandText text{
        "droplet-shape animate", "make animated droplets from frames or a video", "[OPTIONS] INPUT... OUTPUT",
        std::string(kUnitsText) +
            "\n"
            "Examples:\n"
            "  droplet-shape animate frames/%04d.png closing.glb --volume 30uL\n"
            "  droplet-shape animate rain.mp4 rain.glb --volume-mode track\n"
            "  droplet-shape animate frames/ 'rain-%04d.obj'\n"
            "  droplet-shape animate frames/ 'rain.zip/%04d.obj' --lod 10k,2k\n"
            "  droplet-shape animate logo.svg logo.glb --reveal left --frames 72\n"
            "  droplet-shape animate logo.svg logo.glb --drips 7 --material honey\n"
            "  ffmpeg -i rain.mp4 -f image2pipe -c:v png - | droplet-shape animate - rain.glb\n"
            "\n"
            "Exit codes:\n"
            "  0 done; 1 internal error; 2 usage; 3 input unreadable or without liquid;\n"
            "  4 output cannot be written; 5 no such droplet exists in the first frame;\n"
            "  6 done, but some frames have no droplet and show the one before"};
    return text;
}

/// Reads the path of the frames' files. A zip archive is a folder of them: `frames.zip` is `frames.zip/%04d.glb`.
/// @return the path, with its placeholder
std::string readFiles(AnimateOptions& options)
{
    constexpr const char* kZip = ".zip";
    const bool is_archive = lowerExtension(options.output) == kZip;
    std::string path = options.output + (is_archive ? "/%04d.glb" : "");
    options.files = NumberedPath::of(path, "OUTPUT");
    const std::string folder =
        std::filesystem::path(options.files ? options.files->at(0) : path).parent_path().string();
    if (lowerExtension(folder) == kZip) {
        options.archive = folder;
    }
    return path;
}

void readOutput(const CommandLine& line, AnimateOptions& options)
{
    const std::string subject = "OUTPUT";
    const std::string path = readFiles(options);
    const std::string extension = std::filesystem::path(path).extension().string();
    const std::string named = subject + " '" + options.output + "'";
    if (options.output == kStandardStream) {
        return;
    }
    if (extension.empty()) {
        refuse(named + " has no extension that gives the format; an animation is a .glb, .gltf, .usda or .usdz");
    }
    options.format = forOption(named, [&] { return droplet::formatNamed(extension); });
    if (!options.files && (options.archive || !droplet::isAnimated(options.format))) {
        refuse(named +
               " must be a .glb, .gltf, .usda or .usdz with the animation, or have a placeholder for the frame's "
               "number, as in out/%04d" +
               extension);
    }
    if (line.value("--lod") && !options.files) {
        refuse("--lod needs a file for every frame as OUTPUT, such as out/%04d.glb: levels are not animated");
    }
    readLevels(line, path, options.format, options.settings);
    options.compression = readCompression(line, options.format);
    warnOfFormat(line, options.format, false, options.settings);
    if (line.value("--fps") && options.files && (!options.preview || options.preview_files)) {
        options.settings.warnings.push_back("--fps has no effect: every frame has a file of its own");
    }
}

/// Reads --preview and its options.
void readSequencePreview(const CommandLine& line, AnimateOptions& options)
{
    PreviewOptions preview;
    readView(line, preview);
    const auto path = line.value("--preview");
    if (!path) {
        for (const char* option : {"--view", "--camera", "--look-at", "--preview-size"}) {
            if (line.value(option)) {
                options.settings.warnings.push_back(std::string(option) + " has no effect without --preview");
            }
        }
        return;
    }
    preview.path = path->text;
    options.preview_files = NumberedPath::of(preview.path, "--preview");
    if (options.preview_files ? std::filesystem::path(preview.path).extension() != ".png" : !isVideo(preview.path)) {
        refuse(*path, "pictures such as out/%04d.png, or a video: .mp4, .mkv, .mov, .webm");
    }
    if (!options.preview_files) {
        requireEvenSides("--preview-size", preview.width, preview.height);
    }
    options.preview = preview;
}

droplet::RevealSource revealSource(const Given& given)
{
    const char* const allowed =
        "left, right, top, bottom, middle, or a place in the picture such as 0.1,0.5: shares of its width and height, "
        "from 0 to 1, from the top left";
    if (given.text.find(',') == std::string::npos) {
        try {
            return droplet::revealFromNamed(given.text);
        } catch (const droplet::Error&) {
            refuse(given, allowed);
        }
    }
    const std::vector<double> place = numbers(given, {0.0, 1.0, allowed});
    if (place.size() != 2) {
        refuse(given, allowed);
    }
    return droplet::Vec2{place[0], place[1]};
}

/// Reads what becomes of the footprint of one picture.
void readMotion(const CommandLine& line, const std::optional<droplet::DripOptions>& drips,
                const std::optional<Feed>& feed, AnimateOptions& options)
{
    const auto source = line.value("--reveal");
    if (line.value("--seed") && !drips) {
        refuse("--seed needs --drips");
    }
    if (line.value("--slow") && !feed) {
        refuse("--slow needs --feed");
    }
    if (!source && !drips && !feed) {
        if (line.value("--frames")) {
            refuse("--frames needs --reveal, --drips or --feed; without them, the frames are those of INPUT");
        }
        return;
    }
    options.motion = source  ? FootprintMotion(revealSource(*source))
                     : drips ? FootprintMotion(*drips)
                             : FootprintMotion(*feed);
    if (options.inputs.size() > 1 || isStream(options.inputs.front()) || !isPicture(options.inputs.front())) {
        refuse(source  ? "--reveal takes one picture as INPUT, into whose footprint liquid flows"
               : drips ? "--drips takes one picture as INPUT, from whose footprint liquid drips"
                       : "--feed takes one picture as INPUT, into whose droplets liquid flows");
    }
    if (feed) {
        options.volume_mode = droplet::VolumeMode::Track;
    } else if (!line.value("--volume-mode")) {
        options.volume_mode = droplet::VolumeMode::Fill;
    }
}

void readSequence(const CommandLine& line, AnimateOptions& options)
{
    droplet::Fill& fill = options.settings.droplet.solve.fill;
    if (options.volume_mode == droplet::VolumeMode::Total) {
        if (line.value("--fill") && fill.sharing == droplet::FillSharing::Each) {
            refuse(
                "--fill each and --volume-mode total exclude each other: the total volume is shared by all droplets");
        }
        fill.sharing = droplet::FillSharing::Total;
    }
    if (options.settings.onto) {
        refuse("--onto cannot be used for a sequence");
    }
    if (options.settings.hysteresis) {
        options.settings.warnings.push_back("--advancing and --receding have no effect on a sequence");
    }
}

}  // namespace

void declareAnimation(CommandLine& line, AnimateOptions& options)
{
    using droplet::VolumeMode;
    line.add("Sequence", "--volume-mode",
             "Volume that stays the same: total, of all droplets together at one pressure; track, of every droplet, "
             "through merging and splitting; fill, none, every frame has the --contact-angle, --volume or --height",
             into(options.volume_mode,
                  {{"total", VolumeMode::Total}, {"track", VolumeMode::Track}, {"fill", VolumeMode::Fill}}));
    line.add("Sequence", "--fps", "RATE", "Frames per second [24, or the video's]",
             into(options.frames_per_second, NumberRange{1e-3, 1e3, "a number from 0.001 to 1000"}));
    line.add("Sequence", "--contact-sheet", "FILE",
             "Write a PNG of up to 60 frames side by side, seen by one camera; - is standard output");
    line.add("Picture", "--preview", "FILE",
             "Write rendered pictures: out/%04d.png, one for every frame, or a .mp4, .mkv, .mov or .webm video, which "
             "needs ffmpeg");
    declareView(line);
    declareVideoEncoding(line, "Picture");
    declareFootprint(line, options.footprint);
    declareLiquid(line, options.settings);
    declareGround(line, options.settings);
    declareSurface(line, options.settings);
    declareLevels(line, "out/0001-lod1.obj. Every frame needs a file");
    declareCompression(line, "Surface");
    declareHtml(line);
    line.add("Run", "--json", "FILE", "Write a report; - is standard output", into(options.json));
    line.addFlag("Run", "--resume", "Continue an interrupted run of the same options", options.resume);
    declareRun(line);
    line.exclude({"--resume", "--no-clobber"});
}

void readAnimation(const CommandLine& line, AnimateOptions& options)
{
    readFootprint(line, options.footprint);
    options.footprint.mask.allow_dry = true;
    options.footprint.trace.allow_dry = true;
    readDroplet(line, options.settings);
    options.run = readRun(line);
    options.html = readHtml(line);
    if (const auto sheet = line.value("--contact-sheet")) {
        requireRenderer("--contact-sheet");
        if (sheet->text != kStandardStream && std::filesystem::path(sheet->text).extension() != ".png") {
            refuse(*sheet, "a file that ends in .png, or -");
        }
        options.contact_sheet = sheet->text;
    }
    readSequence(line, options);
    readSequencePreview(line, options);
    readOutput(line, options);
    options.fingerprint = optionsOfFrames(line, options.output,
                                          {"--verbose", "--html", "--contact-sheet", "--preview", "--preview-size",
                                           "--view", "--camera", "--look-at", "--codec", "--quality"});
}

std::variant<AnimateOptions, std::string> parseAnimate(int argc, const char* const* argv)
{
    CommandLine line(commandText());
    line.addArguments("FILES",
                      "INPUT... is the frames: a pattern such as frames/%04d.png, several pictures, a folder, a "
                      "video, which needs ffmpeg, or -, PNG, PGM or PPM pictures on standard input. OUTPUT is a .glb, "
                      ".gltf, .usda or .usdz that plays, or a pattern for one file per frame "
                      "such as out/%04d.glb, .gltf, .obj, .ply, .stl, .usda, .usdz or .3mf; or a .zip of these "
                      "files, such as frames.zip or frames.zip/%04d.obj");
    AnimateOptions options;
    declareAnimation(line, options);
    line.add(
        "Sequence", "--reveal", "left|right|top|bottom|middle|X,Y",
        "Let liquid flow into the footprint of one picture, from a side, from its middle or from a place (shares of "
        "width and height, from the top left), along its strokes, at the same contact angle; --volume-mode is fill "
        "then");
    std::optional<int> drips;
    droplet::DripOptions dripping;
    line.add(
        "Sequence", "--drips", "N",
        "Let liquid drip from up to N lower edges of one picture's footprint, as paint runs down a wall, at the same "
        "contact angle; --volume-mode is fill then",
        into(drips, CountRange{1, 1000, "1000"}));
    line.add("Sequence", "--seed", "N", "Random seed of --drips", seedInto(dripping.seed));
    std::optional<double> inflow;
    Feed feed;
    line.add("Sequence", "--feed", "VOLUME",
             "Let so much liquid flow into the droplets of one picture per second, under a ceiling (--tilt 180deg): a "
             "droplet that grows too heavy sheds a drop, which falls",
             into(inflow, Range{droplet::Dimension::Volume, 1e-15, 1e-3, "from 1e-6uL to 1L"}));
    line.add("Sequence", "--slow", "NUMBER", "Slow motion of --feed: seconds of the film for a second",
             into(feed.slow, NumberRange{1e-3, 1e6, "a number from 0.001 to 1000000"}));
    line.exclude({"--reveal", "--drips"});
    line.exclude({"--reveal", "--feed"});
    line.exclude({"--drips", "--feed"});
    line.exclude({"--volume-mode", "--feed"});
    line.add("Sequence", "--frames", "N", "Number of frames of --reveal, --drips and --feed, up to 100k",
             into(options.frames, {1, 100'000, "100k"}));
    line.parse(argc, argv);
    if (const auto text = requestedText(line)) {
        return *text;
    }
    const std::vector<Given> files = line.values("FILES");
    if (files.size() < 2) {
        refuse(std::string(files.empty() ? "INPUT" : "OUTPUT") + " is missing; usage: " + commandText().name + " " +
               commandText().usage);
    }
    line.read();
    for (std::size_t i = 0; i + 1 < files.size(); ++i) {
        options.inputs.push_back(files[i].text);
    }
    if (options.inputs.size() > 1 && std::any_of(options.inputs.begin(), options.inputs.end(), isStream)) {
        refuse("INPUT: - must stand alone: all frames are on standard input");
    }
    options.output = files.back().text;
    dripping.count = drips.value_or(dripping.count);
    feed.inflow = inflow.value_or(0.0);
    readMotion(line, drips ? std::optional(dripping) : std::nullopt, inflow ? std::optional(feed) : std::nullopt,
               options);
    readAnimation(line, options);
    if (options.resume && (!options.hasFiles() || isStream(options.inputs.front()))) {
        refuse("--resume needs a file for every frame as OUTPUT, such as out/%04d.glb, and INPUT in files");
    }
    const VideoEncoding encoding = readVideoEncoding(line, options.hasVideo(), "--preview");
    if (options.hasVideo()) {
        options.preview->encoding = encoding;
    }
    return options;
}

}  // namespace cli
