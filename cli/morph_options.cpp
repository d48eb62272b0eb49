// SPDX-License-Identifier: GPL-3.0-or-later
#include "morph_options.h"

#include <filesystem>
#include <set>
#include <utility>

#include "common_options.h"
#include "droplet_options.h"
#include "files.h"
#include "option_values.h"
#include "value_list.h"
#include "video_writer.h"

namespace cli {
namespace {

const CommandText& commandText()
{
    static const CommandText text{"droplet-shape morph", "let liquid flow from one footprint to the next",
                                  "[OPTIONS] INPUT... OUTPUT",
                                  std::string(kUnitsText) +
                                      "\n"
                                      "Examples:\n"
                                      "  droplet-shape morph word.png logo.png closing.glb --frames 120\n"
                                      "  droplet-shape morph --text Water logo.svg water.glb --material ink\n"
                                      "  droplet-shape morph a.png b.png c.png 'masks/%04d.png'\n"
                                      "  droplet-shape morph a.png b.png - | droplet-shape animate - out.glb\n"
                                      "\n"
                                      "Exit codes:\n"
                                      "  0 done; 1 internal error; 2 usage; 3 input unreadable or without liquid;\n"
                                      "  4 output cannot be written; 5 no such droplet exists in the first frame;\n"
                                      "  6 done, but some frames have no droplet and show the one before"};
    return text;
}

void declare(CommandLine& line, MorphCommandOptions& options)
{
    line.addArguments("FILES",
                      "INPUT... is the footprints: pictures of one size, or SVG files, which are fitted into them. "
                      "OUTPUT is a .glb that plays, or droplets of all frames such as out/%04d.glb, .obj, .ply, "
                      ".stl, .usdz or .3mf, or frames.zip/%04d.glb in an archive; masks such as out/%04d.png; - for "
                      "masks on standard output; drawings such as "
                      "out/%04d.svg; or a video of drawings, .mp4, .mkv, .mov or .webm, which needs ffmpeg");
    constexpr const char* kMorph = "Flow";
    line.add(kMorph, "--text", "TEXT", "First footprint, before those of the pictures", into(options.text));
    line.add(kMorph, "--font-family,--font", "FAMILY", "Font of the text, by the name that the system knows",
             into(options.font));
    line.add(kMorph, "--frames", "N", "Number of frames of the whole, up to 100k",
             into(options.frames, {1, 100'000, "100k"}));
    line.add(kMorph, "--particle-count", "N", "Number of particles of the liquid, 1k to 200k",
             into(options.particles, {1000, 200'000, "200k"}));
    line.add(kMorph, "--rounding", "NUMBER", "How fast surface tension rounds the liquid on its way, 0 to 10",
             into(options.rounding, {0.0, 10.0, "a number from 0 to 10"}));
    line.add(kMorph, "--mask-width", "N",
             "Width of masks and drawings in pixels, up to 16384 [that of the first picture, or 1024]",
             into(options.width, CountRange{16, 16384, "16384"}));
    line.add(kMorph, "--look", "flat|comic|ink|night", "Colours and lines of drawings [flat]");
    declareVideoAlpha(line, kMorph);
    declareAnimation(line, options.animation);
}

void readKind(const CommandLine& line, MorphCommandOptions& options)
{
    const std::string extension = std::filesystem::path(options.output).extension().string();
    if (isStream(options.output)) {
        options.kind = MorphOutput::MaskStream;
    } else if (extension == ".png" || extension == ".svg") {
        options.kind = extension == ".png" ? MorphOutput::Masks : MorphOutput::Drawings;
        options.files = NumberedPath::of(options.output, "OUTPUT");
        if (!options.files) {
            refuse({options.output, "OUTPUT"}, "a file for every frame, such as out/%04d" + extension);
        }
    } else if (isVideo(options.output)) {
        options.kind = MorphOutput::Video;
    }
    if (options.kind == MorphOutput::Model) {
        return;
    }
    // The options of droplets would have no effect; those of reading pictures and of the run have.
    const std::set<std::string> used{"--text",       "--font-family", "--frames",  "--particle-count", "--rounding",
                                     "--mask-width", "--look",        "--quality", "--codec",          "--alpha",
                                     "--width",      "--pixel-size",  "--channel", "--threshold",      "--invert",
                                     "--segment",    "--colour",      "--smooth",  "--keep",           "--fill-holes",
                                     "--speck-size", "--fps",         "--threads", "--quiet",          "--no-clobber",
                                     "--config",     "--progress",    "--verbose", "--resume"};
    for (const auto& [name, value] : line.given()) {
        if (used.count(name) == 0) {
            refuse(name + " needs droplets as OUTPUT, such as out.glb");
        }
    }
}

}  // namespace

std::variant<MorphCommandOptions, std::string> parseMorph(int argc, const char* const* argv)
{
    CommandLine line(commandText());
    MorphCommandOptions options;
    declare(line, options);
    line.parse(argc, argv);
    if (const auto text = requestedText(line)) {
        return *text;
    }
    line.read();
    const std::vector<Given> files = line.values("FILES");
    if (options.text && options.text->empty()) {
        refuse(*line.value("--text"), "a text that is not empty");
    }
    if (line.value("--font-family") && !options.text) {
        refuse("--font-family needs --text");
    }
    const std::size_t needed = options.text ? 1 : 2;
    if (files.size() < needed + 1) {
        refuse(std::string(files.empty() ? "INPUT" : "OUTPUT") + " is missing, or there are fewer than two footprints" +
               "; usage: " + commandText().name + " " + commandText().usage);
    }
    options.output = files.back().text;
    for (std::size_t k = 0; k + 1 < files.size(); ++k) {
        if (isStream(files[k].text)) {
            refuse(files[k], "a picture in a file");
        }
        options.inputs.push_back(files[k].text);
    }
    readKind(line, options);
    const std::string model = options.kind == MorphOutput::Model ? options.output : "frames.glb";
    options.animation.inputs = {kStandardStream};
    options.animation.output = model;
    readAnimation(line, options.animation);
    if (options.animation.resume && !options.files && !options.animation.hasFiles()) {
        refuse("--resume needs a file for every frame as OUTPUT, such as out/%04d.svg");
    }
    const std::size_t transitions = options.inputs.size() + (options.text ? 1 : 0) - 1;
    if (options.frames < 2 * transitions + 1) {
        refuse("--frames: " + std::to_string(transitions) +
               (transitions == 1 ? " transition needs" : " transitions need") + " at least " +
               std::to_string(2 * transitions + 1) + " frames");
    }
    const auto look = line.value("--look");
    options.look = forOption("--look", [&] { return droplet::liquidLookNamed(look ? look->text : "flat"); });
    if (look && options.kind != MorphOutput::Drawings && options.kind != MorphOutput::Video) {
        refuse("--look needs drawings as OUTPUT, such as out/%04d.svg or out.mp4");
    }
    const bool is_video = options.kind == MorphOutput::Video;
    options.encoding = readVideoEncoding(line, is_video || options.animation.hasVideo(), "OUTPUT or --preview");
    if (options.animation.hasVideo()) {
        options.animation.preview->encoding = options.encoding;
    }
    if (line.flag("--alpha")) {
        if (!is_video) {
            refuse("--alpha needs a video of drawings as OUTPUT");
        }
        keepAlpha(options.encoding, options.output, "--alpha");
    }
    return options;
}

}  // namespace cli
