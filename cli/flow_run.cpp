// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow_run.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <ostream>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "droplet/body/droplet_body.h"
#include "droplet/flow_io/droplet_surfaces.h"
#include "droplet/flow_io/flow_animation.h"
#include "droplet/flow_io/flow_painter.h"
#include "droplet/flow_io/flow_table.h"
#include "droplet/flow_io/streak_ribbons.h"
#include "droplet/flow_io/wet_maps.h"
#include "droplet_report.h"
#include "files.h"
#include "film.h"
#include "flow_files.h"
#include "flow_plan.h"
#include "html_page.h"
#include "object_options.h"
#include "option_values.h"
#include "stage_clock.h"
#include "surface_files.h"
#include "this_process.h"
#include "video_writer.h"

namespace cli {
namespace {

/// Droplets at the time of a frame, and what they have wetted since the frame before.
struct Moment {
    std::size_t number = 0;  ///< of the frame
    double time = 0.0;       ///< [s]
    std::vector<droplet::FlowSample> samples;
    std::vector<std::vector<droplet::FlowTrack>> tracks = {};  ///< of every advance
    droplet::Surface streaks = {};                             ///< if every frame has a file of them
    std::size_t shape = 0;                                     ///< of the object
    std::shared_ptr<const droplet::FlowTerrain> terrain = {};  ///< of this shape
};

/// Run that can be resumed, if every frame has a file.
std::optional<ResumableRun> resumableRun(const FlowOptions& options, std::size_t frames)
{
    return options.files
               ? std::optional(ResumableRun{"flow", flowFingerprint(options), frames, options.frames_per_second,
                                            withMaps(*options.files, options.maps, kFlowMaps)})
               : std::nullopt;
}

class FlowRun {
public:
    FlowRun(const FlowOptions& options, ProgressDisplay& progress);

    droplet::FlowReport execute();

private:
    /// Resumes from the checkpoint, if that is possible; otherwise the run starts from the first frame.
    void resume();
    /// Droplets at the state's time.
    [[nodiscard]] Moment momentOf(std::size_t number);
    /// Shows the object of a moment in pictures and maps, if it deforms.
    void showShape(const Moment& moment);
    /// Simulates a frame.
    /// @return what draws it
    std::function<void()> frame(std::size_t number);
    /// Makes all remaining frames.
    void run(std::ostream* table);
    /// State after a frame, for a checkpoint.
    [[nodiscard]] Blobs state() const;
    /// Advances the state, with a row of the balance at every full second.
    void advance(double until);
    /// Whether a picture of every frame is drawn, or of the last one.
    [[nodiscard]] bool isPicture() const;
    void preparePainter();
    /// A video's options, after they were tried.
    [[nodiscard]] VideoWriterOptions videoAt(const std::string& path) const;
    [[nodiscard]] droplet::Picture picture(const Moment& moment, double azimuth);
    /// Files of the preview, which are drawn when they are written.
    std::vector<OutputFile> previewOutputs();
    /// Droplets of a moment, without bases.
    [[nodiscard]] std::vector<droplet::FlowPoint> pointsOf(const Moment& moment) const;
    [[nodiscard]] droplet::DropletShapes shapesOf(const Moment& moment) const;
    [[nodiscard]] droplet::Surface dropletsOf(const Moment& moment) const;
    /// Wets the object, and writes the files of a frame.
    void draw(const Moment& moment);
    /// Draws a frame, and writes it unless it is the picture of the last one.
    void drawPicture(const Moment& moment);
    void writeMaps(const Moment& moment);
    /// Writes a surface in the axes of the object's file.
    void writeSurface(droplet::Surface surface, const std::string& path, droplet::Compression compression) const;
    /// Lets the animation show streaks as they grow.
    void showStreaks();
    void writeHtml(std::ostream& out);
    /// Warns of droplets that are shown smaller than they are.
    void warnOfLostVolume();
    /// Writes the droplets of a frame.
    void writeMesh(const Moment& moment) const;
    [[nodiscard]] droplet::Vec3 gravityAt(double time) const;
    void finish();

    const FlowOptions& options_;
    ProgressDisplay& progress_;
    StageClock clock_;
    FlowPlan plan_;
    Film film_;
    droplet::DropletBodies bodies_;
    droplet::Material material_;
    std::optional<droplet::FlowAnimation> animation_;
    std::optional<droplet::FlowPainter> painter_;
    std::optional<droplet::WetMapper> mapper_;
    std::unique_ptr<VideoWriter> video_;
    droplet::Picture picture_;  ///< of the last frame
    Moment shown_;              ///< of the preview
    std::optional<droplet::FlowTable> table_;
    std::vector<std::vector<droplet::FlowPoint>> points_;  ///< of every frame, if one file has them all
    droplet::StreakRibbons ribbons_;
    droplet::Surface streaks_;  ///< at the end
    droplet::FlowState state_;
    std::vector<std::vector<droplet::FlowTrack>> tracks_;  ///< since the last frame, if something is wetted
    std::size_t done_ = 0;                                 ///< number of frames that an interrupted run simulated
    droplet::FlowReport report_;
};

droplet::Format formatOf(const std::string& path)
{
    return droplet::formatNamed(std::filesystem::path(path).extension().string().substr(1));
}

/// Contact angles of the object's materials, without repeats.
std::vector<double> anglesOf(const droplet::FlowParameters& parameters)
{
    std::vector<double> angles = parameters.ground.contact_angle;
    std::sort(angles.begin(), angles.end());
    angles.erase(std::unique(angles.begin(), angles.end()), angles.end());
    return angles;
}

droplet::TrailFilm filmOf(const droplet::FlowParameters& parameters)
{
    droplet::TrailFilm film;
    film.becomes_beads = parameters.streaks.film > 0.0;
    if (film.becomes_beads) {
        film.thickness = parameters.streaks.film;
    }
    film.drying = parameters.drying;
    film.kinematic_viscosity = droplet::kWaterViscosity / parameters.forces.liquid.density;
    return film;
}

FlowRun::FlowRun(const FlowOptions& options, ProgressDisplay& progress)
    : options_(options),
      progress_(progress),
      plan_(planOf(options)),
      film_(plan_.frames, options.run.files, progress, resumableRun(options, plan_.frames)),
      bodies_(options.shape, plan_.parameters.forces, anglesOf(plan_.parameters)),
      material_(options.material.value_or(droplet::materialOf(plan_.parameters.forces.liquid))),
      ribbons_(filmOf(plan_.parameters))
{
    state_ = droplet::startFlow(plan_.terrain(), plan_.parameters, plan_.starts);
    if (options_.kind == FlowOutput::Animation || options_.html) {
        droplet::FlowAnimationOptions animation;
        animation.frames_per_second = options_.frames_per_second;
        animation.material = material_;
        animation.gravity = plan_.parameters.gravity;
        animation.motion = plan_.parameters.motion;
        animation_.emplace(plan_.object, plan_.shapes, bodies_, animation);
    }
    if (isPicture() || options_.has_preview) {
        preparePainter();
    }
    if (options_.maps) {
        droplet::WetMapOptions maps;
        maps.width = options_.map_width;
        maps.height = options_.map_width;
        maps.full_thickness = options_.full_thickness;
        maps.full_age = options_.full_age;
        maps.film = filmOf(plan_.parameters);
        mapper_ = forOption("--maps", [&] { return droplet::WetMapper(plan_.object, plan_.terrain(), maps); });
    }
    report_.input = nameOfObject(options_);
    report_.surface = plan_.terrain().surface().report;
    report_.size = plan_.size;
    report_.output = options_.output;
    if (options_.preset) {
        report_.preset = options_.preset->name;
    }
    report_.start = options_.start;
    report_.parameters = plan_.parameters;
    report_.shape = options_.shape;
    report_.deformation = options_.deformation;
    report_.frames_per_second = options_.frames_per_second;
    report_.frames = plan_.frames;
    if (options_.maps && !options_.are_maps_exr) {
        report_.map_scale = {options_.full_thickness, options_.full_age};
    }
    report_.warnings = plan_.warnings;
}

bool FlowRun::isPicture() const
{
    return options_.kind != FlowOutput::Animation && options_.kind != FlowOutput::Meshes;
}

void FlowRun::preparePainter()
{
    droplet::FlowPainterOptions painter;
    aim(options_.view, painter.render);
    if (options_.view.environment) {
        painter.render.environment = droplet::readEnvironment(*options_.view.environment);
    }
    painter.render.fit_all_azimuths = options_.view.turns.has_value();
    painter.render.look = droplet::lookOf(material_);
    const double end = static_cast<double>(plan_.frames - 1) / options_.frames_per_second;
    painter.render.framed =
        plan_.shapes.count() > 1 ? framedOver(plan_.shapes) : framedOver(plan_.object, plan_.parameters.motion, end);
    painter.film = filmOf(plan_.parameters);
    painter_.emplace(plan_.object, plan_.terrain(), painter);
}

droplet::FlowReport FlowRun::execute()
{
    resume();
    if (options_.kind == FlowOutput::Video) {
        video_ = std::make_unique<VideoWriter>(videoAt(options_.output));
    }
    const std::vector<OutputFile> previews = options_.has_preview ? previewOutputs() : std::vector<OutputFile>{};
    std::vector<OutputFile> files;
    if (options_.kind == FlowOutput::Animation) {
        files.push_back({options_.output, [&](std::ostream& out) { animation_->write(out, options_.file); }});
    }
    if (options_.kind == FlowOutput::Picture) {
        files.push_back({options_.output, [&](std::ostream& out) { droplet::writePng(picture_, out); }});
    } else if (video_) {
        files.push_back({options_.output, [&](std::ostream& out) { video_->finish(out); }});
    }
    files.insert(files.end(), previews.begin(), previews.end());
    std::uint64_t bytes = 0;
    if (options_.streaks && !options_.streak_files) {
        SurfaceTarget target{*options_.streaks, formatOf(*options_.streaks), {}};
        target.options.material = material_;
        for (OutputFile& file : surfaceFiles(streaks_, target, bytes)) {
            files.push_back(std::move(file));
        }
    }
    if (options_.usd_points) {
        files.push_back({*options_.droplets, [&](std::ostream& out) {
                             const droplet::UsdPointsOptions usd{options_.frames_per_second, material_,
                                                                 droplet::length(plan_.parameters.gravity)};
                             droplet::writePointsAsUsd(points_, bodies_, usd, out, *options_.usd_points);
                         }});
    }
    if (options_.html) {
        files.push_back({*options_.html, [&](std::ostream& out) { writeHtml(out); }});
    }
    if (options_.json) {
        files.push_back({*options_.json, [&](std::ostream& out) {
                             finish();
                             writeFlowReport(out, report_);
                         }});
    }
    film_.write(
        options_.point_files || options_.usd_points ? std::nullopt : options_.droplets,
        [&](std::ostream* table) { run(table); }, files);
    finish();
    return std::move(report_);
}

void FlowRun::resume()
{
    const auto checkpoint = film_.begin(options_.resume);
    if (!checkpoint) {
        return;
    }
    // Tables, pages and streaks need every frame to be simulated again, and so do missing files. The camera sees all
    // that an object that moves will reach in --time.
    const bool has_one_camera = plan_.parameters.motion.rests() && plan_.shapes.count() == 1;
    const bool has_same_camera =
        !painter_ || has_one_camera || (*checkpoint)["planned frames"] == std::to_string(plan_.frames);
    if (!has_same_camera) {
        film_.writeAgain();
    }
    if (options_.droplets || options_.streaks || options_.html || !has_same_camera ||
        !film_.hasFrames(checkpoint->frames)) {
        return;
    }
    const std::string& path = film_.checkpointPath();
    if (painter_) {
        painter_->restore((*checkpoint)["wet picture"], path);
    }
    if (mapper_) {
        mapper_->restore((*checkpoint)["wet maps"], path);
    }
    state_ = droplet::flowStateFromBytes((*checkpoint)["flow"], plan_.terrain().surface().faces.size(), path);
    report_.balance = rowsFromBytes<droplet::FlowBalanceRow>((*checkpoint)["balance"]);
    done_ = checkpoint->frames;
}

Moment FlowRun::momentOf(std::size_t number)
{
    const std::size_t shape = plan_.shapes.of(state_, plan_.parameters.step);
    return {.number = number,
            .time = state_.time,
            .samples = droplet::sampleFlow(state_, plan_.shapes, plan_.parameters),
            .shape = shape,
            .terrain = plan_.shapes.at(shape)};
}

void FlowRun::showShape(const Moment& moment)
{
    if (plan_.shapes.count() == 1 || !(painter_ || mapper_)) {
        return;
    }
    const droplet::FlowObject object = inShape(plan_.object, plan_.shapes.vertices(moment.shape));
    if (painter_) {
        painter_->reshape(object, *moment.terrain);
    }
    if (mapper_) {
        mapper_->reshape(object, *moment.terrain);
    }
}

std::function<void()> FlowRun::frame(std::size_t number)
{
    advance(static_cast<double>(number - 1) / options_.frames_per_second);
    Moment moment = momentOf(number);
    moment.tracks = std::exchange(tracks_, {});
    if (table_) {
        table_->add(number, moment.time, pointsOf(moment));
    }
    if (options_.usd_points) {
        points_.push_back(pointsOf(moment));
    }
    if (animation_) {
        animation_->add(moment.time, moment.samples, moment.shape);
    }
    if (options_.streak_files) {
        moment.streaks = ribbons_.mesh(state_.time, &moment.terrain->surface()).surface;
    }
    return [this, moment = std::move(moment)] { draw(moment); };
}

void FlowRun::run(std::ostream* table)
{
    if (table != nullptr) {
        const bool is_json = std::filesystem::path(*options_.droplets).extension() == ".json";
        table_.emplace(*table, is_json ? droplet::TableFormat::Json : droplet::TableFormat::Csv);
    }
    film_.make(done_, {[this](std::size_t number) { return frame(number); }, [this] { return state(); }});
    if (table_) {
        table_->finish();
    }
    if (options_.has_preview) {
        shown_ = momentOf(plan_.frames);
        showShape(shown_);
    }
    if (report_.balance.empty() || report_.balance.back().time != state_.time) {
        report_.balance.push_back(flowBalanceRow(state_));
    }
    warnOfLostVolume();
    report_.counts = state_.counts;
    report_.time = state_.time;
    if (options_.streaks) {
        const std::size_t shape = plan_.shapes.of(state_, plan_.parameters.step);
        streaks_ = ribbons_.mesh(state_.time, &plan_.shapes.at(shape)->surface()).surface;
        if (options_.kind == FlowOutput::Animation) {
            showStreaks();
        }
        turnToFile(streaks_, formatOf(*options_.streaks), options_.reading);
    }
}

void FlowRun::showStreaks()
{
    animation_->setStreaks(ribbons_.growing(1.0 / options_.frames_per_second));
}

void FlowRun::writeHtml(std::ostream& out)
{
    showStreaks();
    const bool has_name = !isStream(*options_.html) && !options_.files;
    writeHtmlPage(out, {std::filesystem::path(has_name ? options_.output : report_.input).stem().string(),
                        [&](std::ostream& model) { animation_->write(model); },
                        [&](std::ostream& report) { writeFlowReport(report, report_); }});
}

void FlowRun::warnOfLostVolume()
{
    constexpr std::size_t kAtOnce = 1000;  // whose meshes are in memory
    const Moment end = momentOf(plan_.frames);
    const std::vector<droplet::FlowSample>& samples = end.samples;
    std::size_t count = 0;
    for (std::size_t first = 0; first < samples.size(); first += kAtOnce) {
        const auto some = std::span(samples).subspan(first, std::min(kAtOnce, samples.size() - first));
        const std::vector<double> volumes = droplet::seatedDroplets(*end.terrain, some, shapesOf(end)).volumes;
        for (std::size_t i = 0; i < some.size(); ++i) {
            count += volumes[i] < 0.99 * some[i].volume ? 1U : 0U;
        }
    }
    if (count > 0) {
        report_.warnings.push_back(fmt::format(
            "{}: {} of {} droplets at the end sit where the object ends, or bends more than they can follow, and are "
            "shown with less than 99 % of their volume; smaller droplets keep it",
            report_.input, count, samples.size()));
    }
}

Blobs FlowRun::state() const
{
    Blobs state{{"balance", bytesOfRows(report_.balance)},
                {"flow", droplet::bytesOf(state_)},
                {"planned frames", std::to_string(plan_.frames)}};
    if (painter_) {
        state["wet picture"] = painter_->bytes();
    }
    if (mapper_) {
        state["wet maps"] = mapper_->bytes();
    }
    return state;
}

void FlowRun::advance(double until)
{
    const auto move_to = [&](double time) {
        state_ = droplet::advanceFlow(std::move(state_), plan_.shapes, plan_.parameters, time);
        if (options_.streaks || options_.html) {
            ribbons_.add(state_.tracks, plan_.terrain().surface());
            if (!animation_) {
                ribbons_.forgetDry(state_.time);
            }
        }
        if (painter_ || mapper_) {
            tracks_.push_back(std::move(state_.tracks));
        }
    };
    double second = std::floor(state_.time) + 1.0;
    while (second <= until) {
        move_to(second);
        report_.balance.push_back(flowBalanceRow(state_));
        second += 1.0;
    }
    if (until > state_.time) {
        move_to(until);
    }
}

std::vector<droplet::FlowPoint> FlowRun::pointsOf(const Moment& moment) const
{
    return droplet::flowPoints(moment.samples, plan_.terrain(), bodies_, gravityAt(moment.time));
}

void FlowRun::draw(const Moment& moment)
{
    for (const std::vector<droplet::FlowTrack>& tracks : moment.tracks) {
        if (painter_) {
            painter_->add(tracks);
        }
        if (mapper_) {
            mapper_->add(tracks);
        }
    }
    if (options_.point_files) {
        std::vector<droplet::FlowPoint> points = pointsOf(moment);
        turnToFile(points, options_.reading);
        droplet::writeAtomically(
            options_.point_files->at(moment.number), [&](std::ostream& out) { droplet::writePointsAsPly(points, out); },
            options_.run.files);
    }
    if (options_.streak_files) {
        writeSurface(moment.streaks, options_.streak_files->at(moment.number), droplet::Compression::None);
    }
    if (film_.isWritten(moment.number)) {
        return;
    }
    if (options_.kind != FlowOutput::Picture || options_.maps || moment.number == plan_.frames) {
        showShape(moment);
    }
    if (options_.kind == FlowOutput::Meshes) {
        writeMesh(moment);
    } else if (isPicture() && (options_.kind != FlowOutput::Picture || moment.number == plan_.frames)) {
        drawPicture(moment);
    }
    if (mapper_) {
        writeMaps(moment);
    }
}

VideoWriterOptions FlowRun::videoAt(const std::string& path) const
{
    return triedVideo(path, {options_.view.width, options_.view.height, options_.frames_per_second}, options_.encoding);
}

droplet::DropletShapes FlowRun::shapesOf(const Moment& moment) const
{
    const droplet::FlowParameters& parameters = plan_.parameters;
    return {bodies_,
            gravityAt(moment.time),
            {options_.deformation, parameters.pinning.length, parameters.seed, moment.terrain.get()}};
}

droplet::Surface FlowRun::dropletsOf(const Moment& moment) const
{
    return droplet::dropletSurfaces(moment.samples, shapesOf(moment));
}

droplet::Picture FlowRun::picture(const Moment& moment, double azimuth)
{
    const droplet::FlowMoment seen{moment.time, plan_.parameters.motion.at(moment.time), azimuth};
    return painter_->picture(seen, moment.samples, dropletsOf(moment));
}

std::vector<OutputFile> FlowRun::previewOutputs()
{
    checkVideo(options_.view);
    return previewFiles(options_.view, options_.frames_per_second, [this](std::size_t index) {
        droplet::Picture drawn = picture(shown_, turnOf(options_.view, index));
        progress_.reportDrawn(index + 1, options_.view.turns.value_or(1));
        return drawn;
    });
}

void FlowRun::drawPicture(const Moment& moment)
{
    picture_ = picture(moment, 0.0);
    if (video_) {
        video_->add(picture_);
    } else if (options_.files) {
        film_.save({{options_.files->at(moment.number), [picture = std::move(picture_)](std::ostream& out) {
                         droplet::writePng(picture, out, droplet::PngEffort::Fast);
                     }}});
    }
}

void FlowRun::writeMaps(const Moment& moment)
{
    const droplet::Surface surface = dropletsOf(moment);
    const auto write = [&](std::size_t map, const auto& writer) {
        droplet::writeAtomically(options_.maps->beside(kFlowMaps[map]).at(moment.number), writer, options_.run.files);
    };
    if (options_.are_maps_exr) {
        const droplet::WetFloatMaps maps = mapper_->floatMaps(moment.time, moment.samples, surface);
        const std::array<const droplet::FloatPicture*, kFlowMaps.size()> all{&maps.normal, &maps.thickness, &maps.age,
                                                                             &maps.wet};
        for (std::size_t k = 0; k < all.size(); ++k) {
            write(k, [&](std::ostream& out) { writeExr(*all[k], out); });
        }
        return;
    }
    const droplet::WetMaps maps = mapper_->maps(moment.time, moment.samples, surface);
    const std::array<const droplet::DeepPicture*, kFlowMaps.size()> all{&maps.normal, &maps.thickness, &maps.age,
                                                                        &maps.wet};
    for (std::size_t k = 0; k < all.size(); ++k) {
        write(k, [&](std::ostream& out) { writePng(*all[k], out, droplet::PngEffort::Fast); });
    }
}

void FlowRun::writeMesh(const Moment& moment) const
{
    writeSurface(droplet::seatedDroplets(*moment.terrain, moment.samples, shapesOf(moment)).surface,
                 options_.files->at(moment.number), options_.file.compression);
}

void FlowRun::writeSurface(droplet::Surface surface, const std::string& path, droplet::Compression compression) const
{
    SurfaceTarget target{path, formatOf(path), {}};
    target.options.material = material_;
    target.options.compression = compression;
    turnToFile(surface, target.format, options_.reading);
    std::uint64_t bytes = 0;
    writeTogether(surfaceFiles(surface, target, bytes), options_.run.files);
}

droplet::Vec3 FlowRun::gravityAt(double time) const
{
    const droplet::FlowParameters& parameters = plan_.parameters;
    return parameters.motion.rests() ? parameters.gravity : parameters.motion.at(time).toObject(parameters.gravity);
}

void FlowRun::finish()
{
    report_.time_total = clock_.total();
    report_.peak_memory = peakMemory();
}

}  // namespace

droplet::FlowReport simulateFlow(const FlowOptions& options, ProgressDisplay& progress)
{
    return FlowRun(options, progress).execute();
}

}  // namespace cli
