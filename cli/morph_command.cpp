// SPDX-License-Identifier: GPL-3.0-or-later
#include "morph_command.h"

#include <fmt/core.h>
#include <tbb/global_control.h>

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
#include "droplet/footprint/mask.h"
#include "droplet/footprint/outline.h"
#include "droplet/liquid2d_io/read_scene.h"
#include "droplet/morph/morph.h"
#include "files.h"
#include "frames.h"
#include "morph_options.h"
#include "progress_display.h"
#include "shape_command.h"
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

/// Where the frames go.
class MorphFiles {
public:
    MorphFiles(const MorphCommandOptions& options, const droplet::LiquidView& view) : options_(options), view_(view)
    {
        if (options.kind == MorphOutput::Video) {
            video_ = std::make_unique<VideoWriter>(triedVideo(
                options.output, {view.width, view.height, options.animation.frames_per_second.value_or(24.0)},
                options.encoding));
        }
    }

    void add(std::size_t frame, const LiquidShape& shape)
    {
        const auto write_mask = [&](std::ostream& out) {
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
                droplet::writeAtomically(options_.files->at(frame + 1), write_mask, options_.animation.run.files);
                break;
            case MorphOutput::Drawings:
                droplet::writeAtomically(
                    options_.files->at(frame + 1),
                    [&](std::ostream& out) {
                        writeLiquidSvg({shape, none}, view_, options_.look, out);
                    },
                    options_.animation.run.files);
                break;
            case MorphOutput::Video:
                video_->add(liquidLayer({shape, none}, view_, options_.look));
                break;
        }
    }

    void finish()
    {
        if (video_) {
            writeTogether({{options_.output, [&](std::ostream& out) { video_->finish(out); }}},
                          options_.animation.run.files);
        }
    }

    std::istream& masks() { return masks_; }

private:
    const MorphCommandOptions& options_;
    const droplet::LiquidView& view_;
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
    const RunOptions& run = options.animation.run;
    checkFiles(filesOf(options), run.files);
    std::optional<tbb::global_control> threads;
    if (run.threads) {
        threads.emplace(tbb::global_control::max_allowed_parallelism, *run.threads);
    }
    const Footprints footprints = readFootprints(options);
    droplet::LiquidView view;
    view.size = footprints.size;
    view.width = options.width.value_or(footprints.width);
    view.height = std::max(static_cast<int>(std::lround(view.width * view.size.y / view.size.x)), 1);
    if (options.kind == MorphOutput::Video) {
        // Encoders need even sides.
        view.width += view.width % 2;
        view.height += view.height % 2;
    }
    MorphFiles files(options, view);
    const droplet::MorphOptions flow{footprints.size, options.frames, options.particles, options.rounding};
    ProgressDisplay progress(
        run.verbosity == Verbosity::Quiet && run.progress == ProgressMode::Auto ? ProgressMode::None : run.progress);
    droplet::morph(footprints.regions, flow, [&](std::size_t frame, const LiquidShape& shape) {
        files.add(frame, shape);
        progress.reportFrame(frame + 1, options.frames);
    });
    files.finish();
    progress.finish();
    if (options.kind != MorphOutput::Model) {
        if (run.verbosity != Verbosity::Quiet && run.progress != ProgressMode::Json) {
            std::cerr << fmt::format("{} frames\n", options.frames);
        }
        return 0;
    }
    // The masks are coverage as it is; all choices of how to read pictures have been made.
    AnimateOptions animation = options.animation;
    animation.footprint = {};
    animation.footprint.mask.channel = droplet::Channel::Luma;
    animation.footprint.mask.allow_dry = true;
    animation.footprint.trace.allow_dry = true;
    animation.footprint.trace.width = footprints.size.x;
    animation.footprint.sized = true;
    animation.run.threads.reset();
    Frames frames(files.masks(), "morph");
    makeAnimation(animation, frames);
    return 0;
}

}  // namespace cli
