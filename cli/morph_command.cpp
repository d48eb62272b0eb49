// SPDX-License-Identifier: GPL-3.0-or-later
#include "morph_command.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <span>
#include <sstream>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "animate_command.h"
#include "droplet/error.h"
#include "droplet/liquid2d_io/read_scene.h"
#include "droplet/mask/mask.h"
#include "droplet/morph/morph.h"
#include "droplet/outline/outline.h"
#include "film.h"
#include "frames.h"
#include "morph_options.h"
#include "progress_display.h"
#include "run_command.h"
#include "video_writer.h"

namespace cli {
namespace {

using droplet::Error;
using droplet::ErrorCode;
using droplet::LiquidShape;
using droplet::Mask;
using droplet::Outline;
using droplet::Region;
using droplet::Vec2;

/// Part of the window's sides that a fitted drawing fills.
constexpr double kFitted = 0.8;
/// Width of the window without a picture that gives it [px].
constexpr int kDefaultWidth = 1024;

bool isDrawing(const std::string& path)
{
    const std::string extension = std::filesystem::path(path).extension().string();
    return extension == ".svg" || extension == ".svgz";
}

/// SVG of a text, in bold letters, which librsvg sets with the system's fonts.
std::string svgOf(const std::string& text, const std::string& font)
{
    const auto escaped = [](const std::string& raw) {
        std::string out;
        for (const char c : raw) {
            const std::string_view special = c == '&'   ? "&amp;"
                                             : c == '<' ? "&lt;"
                                             : c == '>' ? "&gt;"
                                             : c == '"' ? "&quot;"
                                                        : "";
            out += special.empty() ? std::string(1, c) : std::string(special);
        }
        return out;
    };
    // Letters of a font are hardly wider than their height.
    const std::size_t width = 100 * (text.size() + 2);
    return fmt::format(
        R"(<svg xmlns="http://www.w3.org/2000/svg" width="{}" height="200"><text x="50%" y="130" font-size="100" )"
        R"(font-weight="bold" text-anchor="middle" font-family="{}">{}</text></svg>)",
        width, escaped(font), escaped(text));
}

/// Footprints in one window.
struct Footprints {
    std::vector<Region> regions;
    Vec2 size;      ///< of the window [m]
    int width = 0;  ///< of the window [px]
};

/// Region of an outline, fitted into the middle of a window.
Region fitted(const Outline& outline, Vec2 window)
{
    Region region = regionOf(outline);
    Vec2 lower = region.loops.front().front();
    Vec2 upper = lower;
    for (const std::vector<Vec2>& loop : region.loops) {
        for (const Vec2 p : loop) {
            lower = {std::min(lower.x, p.x), std::min(lower.y, p.y)};
            upper = {std::max(upper.x, p.x), std::max(upper.y, p.y)};
        }
    }
    const double scale = kFitted * std::min(window.x / (upper.x - lower.x), window.y / (upper.y - lower.y));
    for (std::vector<Vec2>& loop : region.loops) {
        for (Vec2& p : loop) {
            p = 0.5 * window + scale * (p - 0.5 * (lower + upper));
        }
    }
    return region;
}

Footprints readFootprints(const MorphCommandOptions& options)
{
    const FootprintOptions& reading = options.animation.footprint;
    Footprints all;
    std::vector<std::optional<Outline>> drawings;
    std::string first;
    int height = 0;
    droplet::MaskOptions mask_options = reading.mask;
    mask_options.allow_dry = false;
    droplet::TraceOptions trace = reading.trace;
    trace.allow_dry = false;
    const auto outline_of = [&](const Mask& mask, const std::string& name) {
        try {
            return droplet::trace(mask, trace);
        } catch (const Error& error) {
            throw Error(error.code(), name + ": " + error.what());
        }
    };
    if (options.text) {
        const std::string svg = svgOf(*options.text, options.font);
        // A text has no colours or levels that options could choose.
        const Mask mask = forOption("--text", [&] { return droplet::decodeMask(std::as_bytes(std::span(svg)), {}); });
        drawings.emplace_back(outline_of(mask, "--text"));
    }
    for (const std::string& input : options.inputs) {
        const Mask mask = droplet::readMask(input, mask_options);
        if (isDrawing(input)) {
            drawings.emplace_back(outline_of(mask, input));
            continue;
        }
        const Outline outline = outline_of(mask, input);
        if (first.empty()) {
            first = input;
            all.size = outline.extent;
            all.width = mask.width;
            height = mask.height;
        } else if (mask.width != all.width || mask.height != height) {
            throw Error(ErrorCode::InvalidInput,
                        fmt::format("{}: has {} x {} pixels, {} has {} x {}; all pictures must have one size", input,
                                    mask.width, mask.height, first, all.width, height));
        }
        drawings.emplace_back();
        all.regions.resize(drawings.size());
        all.regions.back() = regionOf(outline, 0.5 * outline.extent);
    }
    if (first.empty()) {
        all.width = kDefaultWidth;
        all.size = {trace.width, 0.5 * trace.width};
    }
    all.regions.resize(drawings.size());
    for (std::size_t k = 0; k < drawings.size(); ++k) {
        if (drawings[k]) {
            all.regions[k] = fitted(*drawings[k], all.size);
        }
    }
    return all;
}

/// Run that can be resumed, if every frame has a mask or drawing. The flow is simulated again, and not drawn.
std::optional<ResumableRun> resumableRun(const MorphCommandOptions& options)
{
    return options.files ? std::optional(ResumableRun{"morph",
                                                      fingerprintOf(options.animation, options.inputs),
                                                      options.frames,
                                                      options.animation.frames_per_second.value_or(24.0),
                                                      {*options.files}})
                         : std::nullopt;
}

/// Lets the liquid flow, and writes its frames.
class Morph {
public:
    Morph(const MorphCommandOptions& options, ProgressDisplay& progress)
        : options_(options),
          progress_(progress),
          footprints_(readFootprints(options)),
          film_(options.frames, options.animation.run.files, progress, resumableRun(options))
    {
        view_.size = footprints_.size;
        view_.width = options.width.value_or(footprints_.width);
        view_.height = std::max(static_cast<int>(std::lround(view_.width * view_.size.y / view_.size.x)), 1);
        if (options.kind == MorphOutput::Video) {
            const double rate = options.animation.frames_per_second.value_or(24.0);
            const VideoFrames frames = evenSides({view_.width, view_.height, rate});
            view_.width = frames.width;
            view_.height = frames.height;
            video_ = std::make_unique<VideoWriter>(triedVideo(options.output, frames, options.encoding));
        }
    }

    RunEnd make()
    {
        std::vector<OutputFile> files;
        if (video_) {
            files.push_back({options_.output, [&](std::ostream& out) { video_->finish(out); }});
        }
        film_.write(
            {}, [this](std::ostream* /*table*/) { run(); }, files);
        return options_.kind == MorphOutput::Model ? makeDroplets()
                                                   : RunEnd{fmt::format("{} frames\n", options_.frames)};
    }

private:
    void run()
    {
        (void)film_.begin(options_.animation.resume);
        const droplet::MorphOptions flow{footprints_.size, options_.frames, options_.particles, options_.rounding};
        droplet::morph(footprints_.regions, flow, [&](std::size_t frame, const LiquidShape& shape) {
            film_.add(frame + 1, [this, number = frame + 1, shape] {
                if (!film_.isWritten(number)) {
                    draw(number, shape);
                }
            });
        });
    }

    void draw(std::size_t number, const LiquidShape& shape)
    {
        const auto write_mask = [this, shape](std::ostream& out) {
            writePng(liquidMask(shape, view_), out, droplet::PngEffort::Fast);
        };
        const std::vector<Region> none;
        switch (options_.kind) {
            case MorphOutput::Model:
                write_mask(masks_);
                break;
            case MorphOutput::MaskStream:
                write_mask(std::cout);
                std::cout.flush();
                if (!std::cout) {
                    throw Error(ErrorCode::OutputFailed, "OUTPUT: standard output cannot be written");
                }
                break;
            case MorphOutput::Masks:
                film_.save({{options_.files->at(number), write_mask}});
                break;
            case MorphOutput::Drawings:
                film_.save({{options_.files->at(number), [this, shape](std::ostream& out) {
                                 writeLiquidSvg({shape, {}}, view_, options_.look, out);
                             }}});
                break;
            case MorphOutput::Video:
                video_->add(liquidLayer({shape, none}, view_, options_.look));
                break;
        }
    }

    /// Makes droplets of the masks.
    RunEnd makeDroplets()
    {
        // The masks are coverage as it is; all choices of how to read pictures have been made.
        AnimateOptions animation = options_.animation;
        animation.footprint = {};
        animation.footprint.mask.channel = droplet::Channel::Luma;
        animation.footprint.mask.allow_dry = true;
        animation.footprint.trace.allow_dry = true;
        animation.footprint.trace.width = footprints_.size.x;
        animation.footprint.sized = true;
        animation.fingerprint = fingerprintOf(animation, options_.inputs);
        Frames frames(masks_, "morph");
        return makeAnimation(animation, frames, progress_);
    }

    const MorphCommandOptions& options_;
    ProgressDisplay& progress_;
    Footprints footprints_;
    Film film_;
    droplet::LiquidView view_;
    std::unique_ptr<VideoWriter> video_;
    std::stringstream masks_;  ///< for droplets
};

/// All files that a run reads and writes.
RunFiles filesOf(const MorphCommandOptions& options)
{
    const FrameNumbers numbers{1, options.frames};
    RunFiles files;
    if (options.kind == MorphOutput::Model) {
        files = filesOf(options.animation, numbers);
    } else {
        files.reads("--config", options.animation.run.config);
        if (options.files) {
            files.writesFrames("OUTPUT", *options.files, numbers);
            files.writes("OUTPUT's checkpoint", checkpointPath(*options.files));
        } else {
            files.writes("OUTPUT", options.output);
        }
    }
    for (const std::string& input : options.inputs) {
        files.reads("INPUT", input);
    }
    return files;
}

}  // namespace

int runMorph(int argc, const char* const* argv)
{
    const auto parsed = parseMorph(argc, argv);
    if (const auto* text = std::get_if<std::string>(&parsed)) {
        print(*text);
        return 0;
    }
    const auto& options = std::get<MorphCommandOptions>(parsed);
    return checkAndRun(options.animation.run, filesOf(options),
                       [&](ProgressDisplay& progress) { return Morph(options, progress).make(); });
}

}  // namespace cli
