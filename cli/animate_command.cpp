// SPDX-License-Identifier: GPL-3.0-or-later
#include "animate_command.h"

#include <fmt/core.h>
#include <tbb/global_control.h>

#include <filesystem>
#include <iomanip>
#include <iostream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <utility>

#include "animate_options.h"
#include "droplet/error.h"
#include "droplet/io/animation.h"
#include "droplet/picture/contact_sheet.h"
#include "droplet/picture/render.h"
#include "droplet/sequence/sequence_report.h"
#include "droplet/units.h"
#include "droplet_report.h"
#include "files.h"
#include "frames.h"
#include "progress_display.h"
#include "shape_command.h"
#include "stage_clock.h"
#include "surface_files.h"
#include "surroundings.h"
#include "terminal.h"

namespace cli {
namespace {

using droplet::Error;
using droplet::ErrorCode;
using droplet::Frame;
using droplet::Stage;

/// What is known to fail fails before any work is done.
void check(const AnimateOptions& options, const Frames& frames)
{
    std::vector<NamedFile> inputs;
    for (const std::string& file : frames.files()) {
        inputs.push_back({"INPUT", file});
    }
    if (options.run.config) {
        inputs.push_back({"--config", *options.run.config});
    }
    if (options.settings.ground.path) {
        inputs.push_back({"--surface", *options.settings.ground.path});
    }
    std::vector<NamedFile> outputs;
    if (options.files) {
        // A video's frames are counted only as they come; the first stands for them.
        const std::vector<std::size_t> numbers = frames.numbers();
        for (const std::size_t number : numbers.empty() ? std::vector<std::size_t>{1} : numbers) {
            outputs.push_back({"OUTPUT", options.files->at(number)});
            if (const auto material = materialFile(outputs.back().path, options.format)) {
                outputs.push_back({"OUTPUT's material", *material});
            }
        }
    } else {
        outputs.push_back({"OUTPUT", options.output});
    }
    if (options.contact_sheet) {
        outputs.push_back({"--contact-sheet", *options.contact_sheet});
    }
    if (options.json) {
        outputs.push_back({"--json", *options.json});
    }
    checkFiles(inputs, outputs, options.run.files);
}

/// The sequence on its way to files and report.
class Sequence {
public:
    Sequence(const AnimateOptions& options, Frames& frames, const droplet::Progress& progress)
        : options_(options), frames_(frames), progress_(progress), around_(readSurroundings(options.settings))
    {
        report_.inputs = options.inputs;
        report_.output = options.output;
        report_.format = options.format;
        report_.volume_mode = options.volume_mode;
        report_.frames_per_second =
            options.frames_per_second.value_or(frames.framesPerSecond().value_or(report_.frames_per_second));
        report_.warnings = options.settings.warnings;
        if (!options.files) {
            animation_.emplace(droplet::AnimationOptions{.frames_per_second = report_.frames_per_second,
                                                         .material = options.settings.material,
                                                         .closed = !options.settings.droplet.open,
                                                         .frames = frames.count()});
        }
    }

    droplet::SequenceReport make()
    {
        progress_(Stage::Read);
        while (const auto picture = frames_.next(options_.footprint.mask)) {
            try {
                add(*picture);
            } catch (const Error& error) {
                if (error.code() == ErrorCode::InvalidInput || error.code() == ErrorCode::NoSuchDroplet) {
                    throw Error(error.code(), picture->name + ": " + error.what());
                }
                throw;
            }
            progress_(Stage::Read);
        }
        progress_(Stage::Write);
        save();
        return std::move(report_);
    }

private:
    void begin(const FramePicture& picture)
    {
        const droplet::Mask& mask = picture.mask;
        sequence_.volume_mode = options_.volume_mode;
        sequence_.droplet = options_.settings.droplet;
        sequence_.droplet.trace = options_.footprint.trace;
        if (mask.physical_width && !options_.footprint.sized) {
            sequence_.droplet.trace.width = *mask.physical_width;
        }
        const double pixel = droplet::pixelSize(mask, sequence_.droplet.trace);
        sequence_.droplet.solve.ground =
            groundOf(options_.settings, around_, {pixel * mask.width, pixel * mask.height});
        channel_ = mask.channel;
        inverted_ = mask.inverted;
        report_.width_px = mask.width;
        report_.height_px = mask.height;
        report_.pixel_size = pixel;
        report_.physics = sequence_.droplet.solve;
        report_.ground = options_.settings.ground;
    }

    void add(const FramePicture& picture)
    {
        if (report_.frames.empty()) {
            begin(picture);
        } else if ((picture.mask.channel != channel_ || picture.mask.inverted != inverted_) && !told_channel_) {
            told_channel_ = true;
            report_.warnings.push_back(picture.name +
                                       " is read by another channel or the other way round than the "
                                       "first frame; --channel settles it");
        }
        progress_(Stage::Trace);
        droplet::Outline outline = droplet::trace(picture.mask, sequence_.droplet.trace);
        refuseTooShortEdge(coveredArea(outline), sequence_.droplet);
        frame_ = frame_ ? nextFrame(*frame_, std::move(outline), sequence_, progress_)
                        : firstFrame(std::move(outline), sequence_, progress_);
        droplet::FrameReport report = reportOf(*frame_, sequence_);
        report.input = picture.name;
        for (std::size_t i = 0; i < frame_->droplet.warnings.size(); ++i) {
            warn(picture.name, frame_->droplet.warnings[i], i < frame_->droplet.grave_warnings);
        }
        if (options_.files) {
            progress_(Stage::Write);
            report.output = options_.files->at(picture.number);
            std::uint64_t bytes = 0;
            writeTogether(
                surfaceFiles(
                    frame_->droplet.surface,
                    {*report.output,
                     options_.format,
                     {.material = options_.settings.material, .closed = report.closed, .unit = options_.settings.unit}},
                    bytes),
                options_.run.files);
            report_.bytes += bytes;
        } else {
            animation_->add(frame_->droplet.surface, frame_->continues);
        }
        if (options_.contact_sheet) {
            photograph(report);
        }
        report_.frames.push_back(std::move(report));
    }

    /// So many of a sequence's frames are enough to see how it goes.
    static constexpr std::size_t kMostTiles = 60;

    /// Whether a frame is on the sheet; of a video, that is settled in the end.
    [[nodiscard]] static bool isChosen(std::size_t frame, std::size_t count)
    {
        return count <= kMostTiles || frame * kMostTiles / count != (frame + 1) * kMostTiles / count;
    }

    void photograph(const droplet::FrameReport& report)
    {
        const std::size_t number = report_.frames.size();
        if (!isChosen(number, frames_.count().value_or(0))) {
            return;
        }
        constexpr int kWidth = 320;
        constexpr int kHeight = 240;
        droplet::RenderOptions render;
        render.width = kWidth;
        render.height = kHeight;
        render.look = droplet::lookOf(options_.settings.material);
        render.extent = frame_->droplet.domain.extent;
        if (!sequence_.droplet.solve.ground.flat()) {
            render.stand = droplet::groundMesh(sequence_.droplet.solve.ground, render.extent);
            render.frames_stand = false;
        }
        const std::string what = report.pressure ? fmt::format("{:.3g} Pa", *report.pressure)
                                                 : fmt::format("{} droplets", report.droplets.size());
        tiles_.push_back({droplet::render(frame_->droplet.surface, render),
                          fmt::format("frame {}: {}, {:.3g} mm high", number + 1, what,
                                      report.total.height_max / droplet::kMillimetre)});
    }

    [[nodiscard]] droplet::Picture sheet()
    {
        std::vector<droplet::Tile> chosen;
        for (std::size_t k = 0; k < tiles_.size(); ++k) {
            if (isChosen(k, tiles_.size())) {
                chosen.push_back(std::move(tiles_[k]));
            }
        }
        return droplet::contactSheet(chosen);
    }

    /// Frames tend to have the same to complain of; once is enough.
    void warn(const std::string& name, const std::string& warning, bool is_grave)
    {
        const std::string kind = warning.substr(0, warning.find_first_of("0123456789"));
        if (told_.insert(kind).second) {
            report_.warnings.insert(is_grave ? report_.warnings.begin() : report_.warnings.end(),
                                    name + ": " + warning);
            report_.grave_warnings += is_grave ? 1 : 0;
        }
    }

    void save()
    {
        std::vector<OutputFile> files;
        if (!options_.files) {
            files.push_back({options_.output, [&](std::ostream& out) { report_.bytes = animation_->write(out); }});
        }
        if (options_.contact_sheet) {
            files.push_back({*options_.contact_sheet, [&](std::ostream& out) { droplet::writePng(sheet(), out); }});
        }
        if (options_.json) {
            files.push_back({*options_.json, [&](std::ostream& out) {
                                 finish();
                                 writeSequenceReport(out, report_);
                             }});
        }
        writeTogether(files, options_.run.files);
        finish();
    }

    void finish()
    {
        report_.time_total = clock_.total();
        report_.peak_memory = peakMemory();
    }

    const AnimateOptions& options_;
    Frames& frames_;
    const droplet::Progress& progress_;
    StageClock clock_;
    Surroundings around_;
    droplet::SequenceOptions sequence_;
    std::optional<droplet::Animation> animation_;
    std::optional<Frame> frame_;
    droplet::Channel channel_ = droplet::Channel::Luma;
    bool inverted_ = false;
    bool told_channel_ = false;
    std::set<std::string> told_;
    std::vector<droplet::Tile> tiles_;
    droplet::SequenceReport report_;
};

std::string inMicrolitres(double volume)
{
    return fmt::format("{:.4g} uL", volume / droplet::kMicrolitre);
}

std::string summaryOf(const droplet::SequenceReport& report, bool verbose)
{
    std::ostringstream text;
    const std::size_t count = report.frames.size();
    const auto& first = report.frames.front();
    const auto& last = report.frames.back();
    if (verbose) {
        for (const droplet::FrameReport& frame : report.frames) {
            text << frame.input << ": " << frame.droplets.size()
                 << (frame.droplets.size() == 1 ? " droplet, " : " droplets, ") << inMicrolitres(frame.total.volume)
                 << ", " << std::setprecision(4) << frame.total.height_max / droplet::kMillimetre << " mm high"
                 << (frame.continues ? ", continues" : "") << "\n";
        }
    }
    text << count << (count == 1 ? " frame, " : " frames, ") << inMicrolitres(first.total.volume);
    if (report.volume_mode == droplet::VolumeMode::Track) {
        double gained = 0.0;
        double lost = 0.0;
        for (const droplet::FrameReport& frame : report.frames) {
            gained += frame.volume_gained;
            lost += frame.volume_lost;
        }
        text << " at first, " << inMicrolitres(last.total.volume) << " at last, " << inMicrolitres(gained) << " came, "
             << inMicrolitres(lost) << " went";
    }
    if (count > 1) {
        text << "; vertices kept in " << report.kept() << " of " << count - 1 << " steps";
    }
    text << "\n" << report.output << ": " << report.bytes << " bytes\n";
    return text.str();
}

void tell(const droplet::SequenceReport& report, const RunOptions& run)
{
    if (run.verbosity == Verbosity::Quiet) {
        tellGraveIfQuiet(report.warnings, report.grave_warnings, run);
        return;
    }
    if (run.progress == ProgressMode::Json) {
        for (const std::string& warning : report.warnings) {
            std::cerr << nlohmann::json{{"warning", warning}}.dump(-1, ' ', false,
                                                                   nlohmann::json::error_handler_t::replace)
                      << "\n";
        }
        return;
    }
    std::cerr << summaryOf(report, run.verbosity == Verbosity::Verbose);
    for (const std::string& warning : report.warnings) {
        std::cerr << paint("warning: ", Colour::Yellow) << oneLine(warning) << "\n";
    }
    std::cerr << std::flush;
}

}  // namespace

int runAnimate(int argc, const char* const* argv)
{
    const auto parsed = parseAnimate(argc, argv);
    if (const auto* text = std::get_if<std::string>(&parsed)) {
        print(*text);
        return 0;
    }
    const auto& options = std::get<AnimateOptions>(parsed);
    Frames frames(options.inputs);
    check(options, frames);
    std::optional<tbb::global_control> threads;
    if (options.run.threads) {
        threads.emplace(tbb::global_control::max_allowed_parallelism, *options.run.threads);
    }
    ProgressDisplay progress(options.run.verbosity == Verbosity::Quiet && options.run.progress == ProgressMode::Auto
                                 ? ProgressMode::None
                                 : options.run.progress);
    const droplet::Progress begin = [&](Stage stage) {
        if (stage == Stage::Read) {
            progress.restart();  // the next frame
        }
        progress.begin(stage);
    };
    const droplet::SequenceReport report = Sequence(options, frames, begin).make();
    progress.finish();
    tell(report, options.run);
    return 0;
}

}  // namespace cli
