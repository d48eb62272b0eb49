// SPDX-License-Identifier: GPL-3.0-or-later
#include "animate_command.h"

#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <iomanip>
#include <iostream>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <utility>

#include "content_hash.h"
#include "droplet/error.h"
#include "droplet/io/animation.h"
#include "droplet/render/contact_sheet.h"
#include "droplet/render/render.h"
#include "droplet/sequence/dripping.h"
#include "droplet/sequence/sequence_report.h"
#include "droplet/units.h"
#include "droplet_report.h"
#include "files.h"
#include "film.h"
#include "html_page.h"
#include "mask_shape.h"
#include "progress_display.h"
#include "run_command.h"
#include "shape_command.h"
#include "stage_clock.h"
#include "surface_files.h"
#include "surroundings.h"
#include "terminal.h"
#include "this_process.h"
#include "video_writer.h"

namespace cli {
namespace {

using droplet::Error;
using droplet::ErrorCode;
using droplet::Frame;
using droplet::Stage;

/// Short form of a list, such as `3-7, 9`. After eight parts, the rest is only counted.
std::string compactList(const std::vector<std::size_t>& numbers)
{
    constexpr std::size_t kMaxParts = 8;
    std::string text;
    std::size_t parts = 0;
    for (std::size_t i = 0; i < numbers.size(); ++parts) {
        if (parts == kMaxParts) {
            return text + fmt::format(" and {} more", numbers.size() - i);
        }
        std::size_t last = i;
        while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1) {
            ++last;
        }
        text += parts == 0 ? "" : ", ";
        text += last == i ? fmt::format("{}", numbers[i]) : fmt::format("{}-{}", numbers[i], numbers[last]);
        i = last + 1;
    }
    return text;
}

/// Patterns of the files of every frame: its own, and those of its levels of detail.
std::vector<NumberedPath> patternsOf(const AnimateOptions& options)
{
    std::vector<NumberedPath> patterns{*options.files};
    for (const std::string& level : levelPaths(options.files->text(), options.format, options.settings.levels.size())) {
        patterns.push_back(*NumberedPath::of(level, "OUTPUT"));
    }
    return patterns;
}

/// Run that can be resumed, if every frame has a file, and the frames are in files.
std::optional<ResumableRun> resumableRun(const AnimateOptions& options, const Frames& frames)
{
    if (!options.hasFiles() || options.fingerprint.empty()) {
        return std::nullopt;
    }
    const std::vector<std::size_t> numbers = frames.numbers();
    return ResumableRun{"animate",
                        options.fingerprint,
                        frames.count().value_or(std::numeric_limits<std::size_t>::max()),
                        options.frames_per_second.value_or(droplet::SequenceReport{}.frames_per_second),
                        patternsOf(options),
                        numbers.empty() ? 1 : numbers.front()};
}

std::string joined(const auto& lines)
{
    return fmt::format("{}\n", fmt::join(lines, "\n"));
}

std::vector<std::string> linesOf(const std::string& text)
{
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) {
        if (!line.empty()) {
            lines.push_back(line);
        }
    }
    return lines;
}

/// Makes the droplets of all frames, their files and the report.
class Sequence {
public:
    Sequence(const AnimateOptions& options, Frames& frames, ProgressDisplay& display)
        : options_(options),
          frames_(frames),
          count_(frames.count()),
          display_(display),
          film_({}, options.run.files, display, resumableRun(options, frames)),
          around_(readSurroundings(options.settings))
    {
        report_.inputs = options.inputs;
        report_.output = options.output;
        report_.format = options.format;
        report_.volume_mode = options.volume_mode;
        report_.frames_per_second =
            options.frames_per_second.value_or(frames.framesPerSecond().value_or(report_.frames_per_second));
        report_.warnings = options.settings.warnings;
        if (options.hasVideo()) {
            const PreviewOptions& preview = *options.preview;
            video_ =
                triedVideo(preview.path, {preview.width, preview.height, report_.frames_per_second}, preview.encoding);
        }
        if (!options.files || options.html) {
            animation_.emplace(droplet::AnimationOptions{.frames_per_second = report_.frames_per_second,
                                                         .material = options.settings.material,
                                                         .closed = !options.settings.droplet.open,
                                                         .frames = frames.count()});
        }
    }

    droplet::SequenceReport make()
    {
        film_.write(
            options_.archive,
            [this](std::ostream* archive) {
                if (archive != nullptr) {
                    film_.beginArchive(*archive);
                }
                run();
            },
            files());
        finish();
        return std::move(report_);
    }

private:
    void run()
    {
        film_.make(resume(), {[this](std::size_t number) { return frame(number); }, [this] { return state(); }});
        if (report_.dry() == report_.frames.size()) {
            throw Error(
                ErrorCode::InvalidInput,
                fmt::format(
                    "{}: no liquid in {}", options_.inputs.front(),
                    report_.frames.size() == 1 ? "it" : fmt::format("any of {} frames", report_.frames.size())));
        }
        warnOfDisagreement();
        warnOfFlatFrames();
        if (!level_warning_.empty()) {
            report_.warnings.push_back(level_warning_);
        }
        progress_(Stage::Write, 0.0);
        if (options_.preview_files) {
            writePreviewPictures();
        }
    }

    /// Goes on from a checkpoint, if that is possible.
    /// @return number of frames before
    std::size_t resume()
    {
        const auto checkpoint = film_.begin(options_.resume);
        // Pictures of all frames, and a page, need every surface, and missing files need theirs.
        if (!checkpoint || options_.preview || options_.contact_sheet || options_.html ||
            !film_.hasFrames(checkpoint->frames)) {
            return 0;
        }
        const std::string& path = film_.checkpointPath();
        for (std::size_t k = 0; k < checkpoint->frames; ++k) {
            const auto picture = frames_.next(options_.footprint.mask);
            if (!picture) {
                refuse("--resume: " + std::to_string(checkpoint->frames) + " frames exist already, but this run has " +
                       std::to_string(k));
            }
            take(*picture);
        }
        frame_ = std::make_shared<const Frame>(droplet::frameFromBytes((*checkpoint)["frame"], path));
        report_.frames = droplet::frameReportsFromBytes((*checkpoint)["reports"], path);
        report_.bytes = std::stoull((*checkpoint)["bytes"]);
        level_warning_ = (*checkpoint)["level warning"];
        report_.warnings = linesOf((*checkpoint)["warnings"]);
        report_.severe_warnings = std::stoull((*checkpoint)["severe warnings"]);
        const std::vector<std::string> warned = linesOf((*checkpoint)["warned"]);
        warned_ = {warned.begin(), warned.end()};
        return checkpoint->frames;
    }

    [[nodiscard]] Blobs state() const
    {
        return {{"frame", bytesOf(*frame_)},
                {"reports", bytesOf(report_.frames)},
                {"bytes", std::to_string(report_.bytes)},
                {"level warning", level_warning_},
                {"warnings", joined(report_.warnings)},
                {"severe warnings", std::to_string(report_.severe_warnings)},
                {"warned", joined(warned_)}};
    }

    std::optional<std::function<void()>> frame(std::size_t number)
    {
        display_.restart(count_ ? fmt::format("frame {} of {}", std::min(number, *count_), *count_)
                                : fmt::format("frame {}", number));
        progress_(Stage::Read, 0.0);
        const auto picture = frames_.next(options_.footprint.mask);
        if (!picture) {
            return std::nullopt;
        }
        try {
            return add(*picture);
        } catch (const Error& error) {
            if (error.code() == ErrorCode::InvalidInput || error.code() == ErrorCode::NoSuchDroplet) {
                throw Error(error.code(), picture->name + ": " + error.what());
            }
            throw;
        }
    }

    /// Notes what a picture tells of itself. The first one begins the sequence.
    void take(const FramePicture& picture)
    {
        if (report_.width_px == 0) {
            sequence_ = beginSequence(picture.mask, options_, around_, report_);
        }
        if (picture.disagrees) {
            disagreeing_.push_back(picture.number);
        }
        if (const auto warning = drawingWarning(picture.mask)) {
            warn(picture.name, *warning, false);
        }
    }

    /// Makes the droplets of a frame.
    /// @return what writes and keeps them
    std::function<void()> add(const FramePicture& picture)
    {
        take(picture);
        progress_(Stage::Trace, 0.0);
        droplet::Outline outline = droplet::trace(picture.mask, sequence_.droplet.trace);
        if (!outline.loops.empty()) {
            refuseTooShortEdge(coveredArea(outline), sequence_.droplet);
        }
        frame_ = std::make_shared<const Frame>(next(std::move(outline)));
        droplet::FrameReport report = reportOf(*frame_, sequence_);
        report.input = picture.name;
        if (report.held) {
            warn(picture.name, frame_->held + "; the droplets of the frame before are shown instead", true);
        }
        for (std::size_t i = 0; i < frame_->droplet.warnings.size(); ++i) {
            warn(picture.name, frame_->droplet.warnings[i], i < frame_->droplet.severe_warnings);
        }
        // Files of leading frames without liquid are written with the first frame that has some, so that a sequence
        // without liquid writes nothing.
        std::vector<std::string> dry_files;
        bool is_written = false;
        if (options_.files) {
            report.output = options_.files->at(picture.number);
            const bool is_first_wet = report_.dry() == report_.frames.size();
            is_written = !is_first_wet || !frame_->droplets.empty();
            for (const droplet::FrameReport& earlier : report_.frames) {
                if (is_first_wet && is_written) {
                    dry_files.push_back(*earlier.output);
                }
            }
        }
        report_.frames.push_back(report);
        return [this, frame = frame_, report = std::move(report), number = report_.frames.size(),
                picture_number = picture.number, dry_files = std::move(dry_files), is_written] {
            // The surface lives as long as the frame.
            const std::shared_ptr<const droplet::Surface> surface(frame, &frame->droplet.surface);
            for (const std::string& file : dry_files) {
                writeFrame(file, std::make_shared<const droplet::Surface>(), report.closed);
            }
            if (is_written && film_.isWritten(number)) {
                std::error_code failure;
                report_.bytes += std::filesystem::file_size(*report.output, failure);
            } else if (is_written) {
                writeFrame(*report.output, surface, report.closed);
            }
            keep(*frame, report, number, picture_number);
        };
    }

    /// Makes the droplets of the next frame.
    Frame next(droplet::Outline outline)
    {
        if (!frame_) {
            return firstFrame(std::move(outline), sequence_, progress_);
        }
        const Feed* const feed = options_.motion ? std::get_if<Feed>(&*options_.motion) : nullptr;
        if (feed == nullptr) {
            return nextFrame(*frame_, std::move(outline), sequence_, progress_);
        }
        const droplet::DrippingOptions dripping{.inflow = feed->inflow,
                                                .time_step = 1.0 / (report_.frames_per_second * feed->slow),
                                                .way = std::max(outline.extent.x, outline.extent.y)};
        return nextDripping(*frame_, outline, sequence_, dripping, progress_);
    }

    void writeFrame(const std::string& path, const std::shared_ptr<const droplet::Surface>& surface, bool closed)
    {
        const auto levels =
            std::make_shared<const Levels>(makeLevels(*surface, options_.settings, path, options_.format));
        if (level_warning_.empty() && !levels->warnings.empty()) {
            level_warning_ = path + ": " + levels->warnings.front();
        }
        std::vector<OutputFile> files = surfaceFiles(*surface,
                                                     {path,
                                                      options_.format,
                                                      {.material = options_.settings.material,
                                                       .closed = closed,
                                                       .unit = options_.settings.unit,
                                                       .compression = options_.compression,
                                                       .levels = levels->surfaces}},
                                                     bytes_);
        // The first one is that of the surface. Surface and levels have to live until all are written.
        files.front().write = [this, surface, levels, write = std::move(files.front().write)](std::ostream& out) {
            write(out);
            report_.bytes += bytes_;
        };
        if (!options_.archive) {
            film_.save(std::move(files));
            return;
        }
        for (OutputFile& file : files) {
            file.path = std::filesystem::path(file.path).filename().string();
        }
        film_.pack(std::move(files));
    }

    /// Keeps a frame for the files of the whole run.
    void keep(const Frame& frame, const droplet::FrameReport& report, std::size_t number, std::size_t picture_number)
    {
        if (animation_ && frame.droplets.empty()) {
            animation_->addDry();
        } else if (animation_) {
            animation_->add(frame.droplet.surface, frame.continues);
        }
        if (options_.contact_sheet || options_.preview) {
            const auto surface = std::make_shared<const droplet::Surface>(frame.droplet.surface);
            bounds_ = droplet::around(*surface, bounds_);
            if (options_.preview) {
                preview_frames_.push_back({surface, picture_number});
            }
            if (options_.contact_sheet) {
                keepForSheet(report, number - 1, surface);
            }
        }
    }

    /// Maximum number of frames on the contact sheet.
    static constexpr std::size_t kMaxTiles = 60;

    /// Whether a frame, of `count`, is on the sheet.
    [[nodiscard]] static bool isChosen(std::size_t frame, std::size_t count)
    {
        return count <= kMaxTiles || frame * kMaxTiles / count != (frame + 1) * kMaxTiles / count;
    }

    /// Keeps a frame's surface until all frames are known, because they share one camera. If the number of frames is
    /// unknown, at most twice the sheet's number is kept, evenly spaced.
    /// @param number  number of frames before
    void keepForSheet(const droplet::FrameReport& report, std::size_t number,
                      const std::shared_ptr<const droplet::Surface>& surface)
    {
        const std::size_t count = count_.value_or(0);
        if (!isChosen(number, count) || number % sheet_step_ != 0) {
            return;
        }
        std::string caption = fmt::format("frame {}: ", number + 1);
        if (report.droplets.empty()) {
            caption += "no liquid";
        } else {
            caption += report.pressure ? fmt::format("{:.3g} Pa", *report.pressure)
                                       : fmt::format("{} droplets", report.droplets.size());
            caption += fmt::format(", {:.3g} mm high", report.total.height_max / droplet::kMillimetre);
        }
        sheet_frames_.push_back({surface, std::move(caption)});
        if (count == 0 && sheet_frames_.size() == 2 * kMaxTiles) {
            for (std::size_t k = 0; k < kMaxTiles; ++k) {
                sheet_frames_[k] = std::move(sheet_frames_[2 * k]);
            }
            sheet_frames_.resize(kMaxTiles);
            sheet_step_ *= 2;
        }
    }

    /// Camera that shows all frames.
    [[nodiscard]] droplet::RenderOptions cameraOf(const PreviewOptions& preview) const
    {
        droplet::RenderOptions render;
        aim(preview, render);
        render.look = droplet::lookOf(options_.settings.material);
        render.extent = frame_->droplet.domain.extent;
        render.framed = bounds_;
        if (!sequence_.droplet.solve.ground.flat()) {
            render.stand = droplet::groundMesh(sequence_.droplet.solve.ground, render.extent);
            render.shows_whole_stand = false;
        }
        return render;
    }

    /// Draws a picture for the preview or the sheet.
    [[nodiscard]] droplet::Picture draw(const droplet::Surface& surface, const droplet::RenderOptions& render)
    {
        droplet::Picture picture = droplet::render(surface, render);
        display_.reportDrawn(++drawn_, preview_frames_.size() + std::min(sheet_frames_.size(), kMaxTiles));
        return picture;
    }

    void writePreviewPictures()
    {
        const droplet::RenderOptions render = cameraOf(*options_.preview);
        for (const PreviewFrame& frame : preview_frames_) {
            auto picture = std::make_shared<const droplet::Picture>(draw(*frame.surface, render));
            film_.save({{options_.preview_files->at(frame.number),
                         [picture = std::move(picture)](std::ostream& out) { droplet::writePng(*picture, out); }}});
        }
    }

    void writePreviewVideo(std::ostream& out)
    {
        const PreviewOptions& preview = *options_.preview;
        const droplet::RenderOptions render = cameraOf(preview);
        VideoWriter video(*video_);
        for (const PreviewFrame& frame : preview_frames_) {
            video.add(draw(*frame.surface, render));
        }
        video.finish(out);
    }

    [[nodiscard]] droplet::Picture sheet()
    {
        PreviewOptions tile;
        tile.width = 320;
        tile.height = 240;
        const droplet::RenderOptions render = cameraOf(tile);
        std::vector<droplet::Tile> tiles;
        for (std::size_t k = 0; k < sheet_frames_.size(); ++k) {
            if (isChosen(k, sheet_frames_.size())) {
                tiles.push_back({draw(*sheet_frames_[k].surface, render), sheet_frames_[k].caption});
            }
        }
        return droplet::contactSheet(tiles);
    }

    /// Adds a warning, unless an earlier frame had the same kind of warning.
    void warn(const std::string& name, const std::string& warning, bool is_grave)
    {
        const std::string kind = warning.substr(0, warning.find_first_of("0123456789"));
        if (warned_.insert(kind).second) {
            report_.warnings.insert(is_grave ? report_.warnings.begin() : report_.warnings.end(),
                                    name + ": " + warning);
            report_.severe_warnings += is_grave ? 1 : 0;
        }
    }

    void warnOfDisagreement()
    {
        if (disagreeing_.empty()) {
            return;
        }
        const Frames::Decision& decided = *frames_.decision();
        const bool dark = (decided.levels.liquid < decided.levels.dry) != options_.footprint.mask.invert;
        report_.warnings.push_back(fmt::format(
            "{} {} by {} would be read differently; {} read like {}, by {} with {} as liquid; give --channel or "
            "--invert to change this",
            disagreeing_.size() == 1 ? "frame" : "frames", compactList(disagreeing_),
            disagreeing_.size() == 1 ? "itself" : "themselves", disagreeing_.size() == 1 ? "it is" : "they are",
            decided.name, decided.levels.channel == droplet::Channel::Alpha ? "alpha" : "luma",
            decided.levels.channel == droplet::Channel::Alpha ? (dark ? "transparent" : "opaque")
                                                              : (dark ? "dark" : "bright")));
    }

    /// One amount in a footprint that grows becomes a film, which few want.
    void warnOfFlatFrames()
    {
        constexpr double kFlat = 0.1;  // of the first frame's height
        const auto has_liquid = [](const droplet::FrameReport& frame) { return !frame.droplets.empty(); };
        const auto first = std::find_if(report_.frames.begin(), report_.frames.end(), has_liquid);
        const auto is_flat = [&](const droplet::FrameReport& frame) {
            return has_liquid(frame) && frame.total.height_max < kFlat * first->total.height_max;
        };
        const auto flat = std::find_if(first, report_.frames.end(), is_flat);
        if (report_.volume_mode == droplet::VolumeMode::Total && flat != report_.frames.end()) {
            report_.warnings.push_back(
                fmt::format("{}: the liquid is {:.2g} mm high, {:.2g} mm in {}, because all frames share one amount; "
                            "--volume-mode fill gives every frame an amount of its own",
                            flat->input, flat->total.height_max / droplet::kMillimetre,
                            first->total.height_max / droplet::kMillimetre, first->input));
        }
    }

    /// Files of the whole run.
    std::vector<OutputFile> files()
    {
        std::vector<OutputFile> files;
        if (options_.hasVideo()) {
            files.push_back({options_.preview->path, [this](std::ostream& out) { writePreviewVideo(out); }});
        }
        if (!options_.files) {
            files.push_back({options_.output, [this](std::ostream& out) {
                                 report_.bytes = animation_->write(out, {options_.format, options_.compression});
                             }});
        }
        if (options_.contact_sheet) {
            files.push_back({*options_.contact_sheet, [this](std::ostream& out) { droplet::writePng(sheet(), out); }});
        }
        if (options_.html) {
            files.push_back({*options_.html, [this](std::ostream& out) { writeHtml(out); }});
        }
        if (options_.json) {
            files.push_back({*options_.json, [this](std::ostream& out) {
                                 finish();
                                 writeSequenceReport(out, report_);
                             }});
        }
        return files;
    }

    void writeHtml(std::ostream& out)
    {
        const bool has_name = !isStream(*options_.html) && !options_.files;
        writeHtmlPage(out, {std::filesystem::path(has_name ? options_.output : options_.inputs.front()).stem().string(),
                            [&](std::ostream& model) { animation_->write(model); },
                            [&](std::ostream& report) { writeSequenceReport(report, report_); }});
    }

    void finish()
    {
        if (options_.archive) {
            report_.bytes = film_.archiveBytes();
        }
        report_.time_total = clock_.total();
        report_.peak_memory = peakMemory();
    }

    const AnimateOptions& options_;
    Frames& frames_;
    std::optional<std::size_t> count_;  ///< of the frames, if it is known beforehand
    ProgressDisplay& display_;
    const droplet::Progress progress_ = [this](Stage stage, double share) { display_.begin(stage, share); };
    Film film_;
    StageClock clock_;
    Surroundings around_;
    droplet::SequenceOptions sequence_;
    std::optional<VideoWriterOptions> video_;  ///< of the preview
    std::optional<droplet::Animation> animation_;
    std::shared_ptr<const Frame> frame_;    ///< the last one
    std::uint64_t bytes_ = 0;               ///< of the file that is written
    std::vector<std::size_t> disagreeing_;  ///< numbers of frames
    std::set<std::string> warned_;          ///< kinds of warnings so far
    std::string level_warning_;             ///< of the first frame whose levels have too many triangles, or empty
    struct SheetFrame {
        std::shared_ptr<const droplet::Surface> surface;
        std::string caption;
    };
    struct PreviewFrame {
        std::shared_ptr<const droplet::Surface> surface;
        std::size_t number = 0;
    };
    std::optional<droplet::ViewBox> bounds_;  ///< box around the droplets of all frames
    std::vector<PreviewFrame> preview_frames_;
    std::vector<SheetFrame> sheet_frames_;
    std::size_t sheet_step_ = 1;  ///< distance of the frames that are kept for the sheet
    std::size_t drawn_ = 0;       ///< number of drawn pictures of preview and sheet
    droplet::SequenceReport report_;
};

std::string inMicrolitres(double volume)
{
    return fmt::format("{:.4g} uL", volume / droplet::kMicrolitre);
}

/// @param levels  patterns of the files of levels of detail
std::string summaryOf(const droplet::SequenceReport& report, const std::vector<std::string>& levels, bool verbose)
{
    std::ostringstream text;
    const std::size_t count = report.frames.size();
    const auto& first = report.frames.front();
    const auto& last = report.frames.back();
    if (verbose) {
        for (const droplet::FrameReport& frame : report.frames) {
            text << oneLine(frame.input) << ": " << frame.droplets.size()
                 << (frame.droplets.size() == 1 ? " droplet, " : " droplets, ") << inMicrolitres(frame.total.volume)
                 << ", " << std::setprecision(4) << frame.total.height_max / droplet::kMillimetre << " mm high"
                 << (frame.held        ? ", held"
                     : frame.continues ? ", continues"
                                       : "")
                 << "\n";
        }
    }
    text << count << (count == 1 ? " frame, " : " frames, ");
    if (report.dry() > 0) {
        text << report.dry() << " without liquid, ";
    }
    std::vector<std::size_t> held;
    for (std::size_t i = 0; i < count; ++i) {
        if (report.frames[i].held) {
            held.push_back(i + 1);
        }
    }
    if (!held.empty()) {
        text << held.size() << " held at the frame before (" << compactList(held) << "), ";
    }
    const auto wet = std::find_if(report.frames.begin(), report.frames.end(),
                                  [](const droplet::FrameReport& frame) { return !frame.droplets.empty(); });
    text << inMicrolitres(report.volume_mode == droplet::VolumeMode::Total ? wet->total.volume : first.total.volume);
    if (report.volume_mode == droplet::VolumeMode::Fill) {
        text << " in the first frame, " << inMicrolitres(last.total.volume) << " in the last";
    } else if (report.volume_mode == droplet::VolumeMode::Track) {
        double gained = 0.0;
        double lost = 0.0;
        for (const droplet::FrameReport& frame : report.frames) {
            gained += frame.volume_gained;
            lost += frame.volume_lost;
        }
        text << " in the first frame, " << inMicrolitres(last.total.volume) << " in the last, " << inMicrolitres(gained)
             << " gained, " << inMicrolitres(lost) << " lost";
    }
    if (last.drops_shed > 0) {
        text << "; " << last.drops_shed << (last.drops_shed == 1 ? " drop" : " drops") << " fell";
    }
    if (count > 1) {
        text << "; vertices kept in " << report.kept() << " of " << count - 1 << " steps";
    }
    text << "\n" << oneLine(report.output) << ": " << report.bytes << " bytes\n";
    for (const std::string& level : levels) {
        text << oneLine(level) << "\n";
    }
    return text.str();
}

}  // namespace

droplet::SequenceOptions beginSequence(const droplet::Mask& mask, const AnimateOptions& options,
                                       const Surroundings& around, droplet::SequenceReport& report)
{
    droplet::SequenceOptions sequence;
    sequence.volume_mode = options.volume_mode;
    sequence.hold = true;
    sequence.droplet = options.settings.droplet;
    sequence.droplet.trace = options.footprint.trace;
    if (mask.physical_width && !options.footprint.sized) {
        sequence.droplet.trace.width = *mask.physical_width;
    }
    const double pixel = droplet::pixelSize(mask, sequence.droplet.trace);
    sequence.droplet.solve.ground = groundOf(options.settings, around, {pixel * mask.width, pixel * mask.height});
    report.width_px = mask.width;
    report.height_px = mask.height;
    report.pixel_size = pixel;
    report.physics = sequence.droplet.solve;
    report.ground = options.settings.ground;
    return sequence;
}

std::string fingerprintOf(const AnimateOptions& options, const std::vector<std::string>& files)
{
    std::vector<std::string> parts{options.fingerprint};
    for (const std::string& file : files) {
        parts.push_back(hashOfFile(file));
    }
    RunFiles settings;
    addSettings(settings, options.settings, {});
    for (const NamedFile& file : settings.read) {
        parts.push_back(hashOfFile(file.path));
    }
    return fingerprintOf(parts);
}

RunFiles filesOf(const AnimateOptions& options, const FrameNumbers& numbers)
{
    RunFiles files;
    addSettings(files, options.settings, options.run);
    if (options.hasFiles()) {
        for (const NumberedPath& pattern : patternsOf(options)) {
            files.writesFrames(pattern.text() == options.output ? "OUTPUT" : "OUTPUT's level", pattern, numbers);
        }
        files.writes("OUTPUT's checkpoint", checkpointPath(*options.files));
    } else {
        files.writes("OUTPUT", options.archive.value_or(options.output));
    }
    if (const auto material = options.hasFiles() ? materialFile(options.output, options.format) : std::nullopt) {
        files.writesFrames("OUTPUT's material", *NumberedPath::of(*material, "OUTPUT"), numbers);
    }
    if (options.preview_files) {
        files.writesFrames("--preview", *options.preview_files, numbers);
    } else if (options.preview) {
        files.writes("--preview", options.preview->path);
    }
    files.writes("--contact-sheet", options.contact_sheet);
    files.writes("--html", options.html);
    files.writes("--json", options.json);
    return files;
}

RunEnd makeAnimation(const AnimateOptions& options, Frames& frames, ProgressDisplay& progress)
{
    const droplet::SequenceReport report = Sequence(options, frames, progress).make();
    const std::vector<std::string> levels = levelPaths(options.files ? options.files->text() : options.output,
                                                       options.format, options.settings.levels.size());
    return {summaryOf(report, levels, options.run.verbosity == Verbosity::Verbose), report.warnings,
            report.severe_warnings, report.held() > 0};
}

int runAnimate(int argc, const char* const* argv)
{
    const auto parsed = parseAnimate(argc, argv);
    if (const auto* text = std::get_if<std::string>(&parsed)) {
        print(*text);
        return 0;
    }
    AnimateOptions options = std::get<AnimateOptions>(parsed);
    Frames frames =
        options.motion ? Frames(options.inputs.front(), *options.motion, options.frames) : Frames(options.inputs);
    const bool is_resumable = options.hasFiles() && !isStream(options.inputs.front());
    options.fingerprint = is_resumable ? fingerprintOf(options, frames.files()) : "";
    const std::vector<std::size_t> numbers = frames.numbers();
    RunFiles files = filesOf(options, numbers.empty() ? FrameNumbers{} : FrameNumbers{numbers.front(), numbers.back()});
    for (const std::string& file : frames.files()) {
        files.reads("INPUT", file);
    }
    return checkAndRun(options.run, files,
                       [&](ProgressDisplay& progress) { return makeAnimation(options, frames, progress); });
}

}  // namespace cli
