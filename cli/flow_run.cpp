// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow_run.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "checkpoint.h"
#include "droplet/body/droplet_body.h"
#include "droplet/flow_io/droplet_surfaces.h"
#include "droplet/flow_io/flow_animation.h"
#include "droplet/flow_io/flow_painter.h"
#include "droplet/flow_io/flow_table.h"
#include "droplet/flow_io/streak_ribbons.h"
#include "droplet/flow_io/wet_maps.h"
#include "droplet_report.h"
#include "files.h"
#include "flow_files.h"
#include "flow_plan.h"
#include "option_values.h"
#include "stage_clock.h"
#include "surface_files.h"
#include "video_writer.h"

namespace cli {
namespace {

constexpr const char* kCommand = "flow";

class FlowRun {
public:
    FlowRun(const FlowOptions& options, ProgressDisplay& progress);

    droplet::FlowReport execute();

private:
    /// Resumes from the checkpoint, if that is possible; otherwise the run starts from the first frame.
    void resume();
    /// Simulates and writes all remaining frames.
    void run();
    /// Saves the state after a frame.
    void saveCheckpoint() const;
    /// Advances the state, with a row of the balance at every full second.
    void advance(double until);
    /// Whether a picture of every frame is drawn, or of the last one.
    [[nodiscard]] bool isPicture() const;
    void preparePainter();
    /// A video's options, after they were tried.
    [[nodiscard]] VideoWriterOptions videoAt(const std::string& path) const;
    [[nodiscard]] droplet::Picture picture(const std::vector<droplet::FlowSample>& samples, double azimuth);
    /// Files of the preview, which are drawn when they are written.
    std::vector<OutputFile> previewOutputs();
    /// Draws a frame, and writes it unless it is the picture of the last one.
    void draw(const std::vector<droplet::FlowSample>& samples, std::size_t number);
    void writeMaps(const std::vector<droplet::FlowSample>& samples, std::size_t number);
    /// Writes the droplets of a frame.
    void writeMesh(const std::vector<droplet::FlowSample>& samples, std::size_t number) const;
    [[nodiscard]] droplet::Vec3 gravityAt(double time) const;
    void finish();

    const FlowOptions& options_;
    ProgressDisplay& progress_;
    StageClock clock_;
    FlowPlan plan_;
    droplet::DropletBodies bodies_;
    droplet::Material material_;
    std::optional<droplet::FlowAnimation> animation_;
    std::optional<droplet::FlowPainter> painter_;
    std::optional<droplet::WetMapper> mapper_;
    std::unique_ptr<VideoWriter> video_;
    droplet::Picture picture_;                ///< of the last frame
    std::vector<droplet::FlowSample> shown_;  ///< droplets of the preview
    std::optional<droplet::FlowTable> table_;
    droplet::StreakRibbons ribbons_;
    droplet::Surface streaks_;  ///< at the end
    droplet::FlowState state_;
    std::optional<CheckpointFile> checkpoint_;  ///< if every frame has a file
    std::size_t done_ = 0;
    droplet::FlowReport report_;
};

droplet::Format formatOf(const std::string& path)
{
    return droplet::formatNamed(std::filesystem::path(path).extension().string().substr(1));
}

/// Turns a surface to the axes of the object's file, for formats that are written z up.
void turnToFile(droplet::Surface& surface, droplet::Format format, const droplet::FlowObjectOptions& reading)
{
    const bool is_z_up_file = format == droplet::Format::Ply || format == droplet::Format::Stl;
    if (!is_z_up_file || reading.up == droplet::UpAxis::Z) {
        return;
    }
    const auto turn = [](droplet::Vec3& v) { v = {v.x, v.z, 0.0 - v.y}; };
    std::for_each(surface.positions.begin(), surface.positions.end(), turn);
    std::for_each(surface.normals.begin(), surface.normals.end(), turn);
}

droplet::StreakRibbonOptions ribbonOptions(const droplet::FlowParameters& parameters)
{
    droplet::StreakRibbonOptions options;
    options.drying = parameters.drying;
    return options;
}

FlowRun::FlowRun(const FlowOptions& options, ProgressDisplay& progress)
    : options_(options),
      progress_(progress),
      plan_(planOf(options)),
      bodies_(options.shape, plan_.parameters.forces),
      material_(options.material.value_or(droplet::materialOf(plan_.parameters.forces.liquid))),
      ribbons_(ribbonOptions(plan_.parameters))
{
    state_ = droplet::startFlow(plan_.scene, plan_.parameters, plan_.starts);
    if (options_.kind == FlowOutput::Animation) {
        droplet::FlowAnimationOptions animation;
        animation.frames_per_second = options_.frames_per_second;
        animation.material = material_;
        animation.gravity = plan_.parameters.gravity;
        animation.motion = plan_.parameters.motion;
        animation_.emplace(plan_.object, bodies_, animation);
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
        maps.drying = plan_.parameters.drying;
        if (plan_.parameters.streaks.film > 0.0) {
            maps.film = plan_.parameters.streaks.film;
        }
        mapper_ = forOption("--maps", [&] { return droplet::WetMapper(plan_.object, plan_.scene, maps); });
    }
    report_.input = nameOfObject(options_);
    report_.surface = plan_.scene.surface().report;
    droplet::Vec3 low = plan_.object.positions.front();
    droplet::Vec3 high = low;
    for (const droplet::Vec3& p : plan_.object.positions) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    report_.size = high - low;
    report_.output = options_.output;
    if (options_.preset) {
        report_.preset = options_.preset->name;
    }
    report_.start = options_.start;
    report_.parameters = plan_.parameters;
    report_.shape = options_.shape;
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
    painter.render.width = options_.view.width;
    painter.render.height = options_.view.height;
    painter.render.view = options_.view.view;
    painter.render.camera = options_.view.camera;
    painter.render.fit_all_azimuths = options_.view.turns.has_value();
    painter.render.look = droplet::lookOf(material_);
    const double end = static_cast<double>(plan_.frames - 1) / options_.frames_per_second;
    painter.render.framed = framedOver(plan_.object, plan_.parameters.motion, end);
    painter.drying = plan_.parameters.drying;
    painter_.emplace(plan_.object, plan_.scene, painter);
}

droplet::FlowReport FlowRun::execute()
{
    if (options_.files) {
        checkpoint_.emplace(ResumableRun{kCommand, flowFingerprint(options_), plan_.frames, options_.frames_per_second,
                                         withMaps(*options_.files, options_.maps, kFlowMaps), options_.output_options});
        resume();
    }
    if (options_.kind == FlowOutput::Video) {
        video_ = std::make_unique<VideoWriter>(videoAt(options_.output));
    }
    std::vector<OutputFile> previews;
    if (options_.has_preview) {
        previews = previewOutputs();
    }
    std::vector<OutputFile> files;
    if (options_.droplets) {
        files.push_back({*options_.droplets, [&](std::ostream& out) {
                             const bool is_json = std::filesystem::path(*options_.droplets).extension() == ".json";
                             table_.emplace(out, is_json ? droplet::TableFormat::Json : droplet::TableFormat::Csv);
                             run();
                             table_->finish();
                         }});
    } else {
        run();
    }
    if (animation_) {
        files.push_back({options_.output, [&](std::ostream& out) { animation_->write(out, options_.file); }});
    }
    if (options_.kind == FlowOutput::Picture) {
        files.push_back({options_.output, [&](std::ostream& out) { droplet::writePng(picture_, out); }});
    } else if (video_) {
        files.push_back({options_.output, [&](std::ostream& out) { video_->finish(out); }});
    }
    files.insert(files.end(), previews.begin(), previews.end());
    std::uint64_t bytes = 0;
    if (options_.streaks) {
        SurfaceTarget target{*options_.streaks, formatOf(*options_.streaks), {}};
        target.options.material = material_;
        for (OutputFile& file : surfaceFiles(streaks_, target, bytes)) {
            files.push_back(std::move(file));
        }
    }
    if (options_.json) {
        files.push_back({*options_.json, [&](std::ostream& out) {
                             finish();
                             writeFlowReport(out, report_);
                         }});
    }
    writeTogether(files, options_.output_options);
    if (checkpoint_) {
        checkpoint_->end();
    }
    finish();
    return std::move(report_);
}

void FlowRun::resume()
{
    const auto checkpoint = checkpoint_->begin(options_.resume);
    if (!checkpoint) {
        return;
    }
    // Tables and streaks need every frame to be simulated again, and so do missing files. The camera sees all that an
    // object that moves will reach in --time.
    const bool has_same_camera =
        !painter_ || plan_.parameters.motion.rests() || (*checkpoint)["planned frames"] == std::to_string(plan_.frames);
    if (options_.droplets || options_.streaks || !has_same_camera ||
        !checkpoint_->run().hasFrames(checkpoint->frames)) {
        return;
    }
    const std::string& path = checkpoint_->path();
    if (painter_) {
        painter_->restore((*checkpoint)["wet picture"], path);
    }
    if (mapper_) {
        mapper_->restore((*checkpoint)["wet maps"], path);
    }
    state_ = droplet::flowStateFromBytes((*checkpoint)["flow"], plan_.scene.surface().faces.size(), path);
    report_.balance = rowsFromBytes<droplet::FlowBalanceRow>((*checkpoint)["balance"]);
    done_ = checkpoint->frames;
}

void FlowRun::run()
{
    for (; done_ < plan_.frames; ++done_) {
        advance(static_cast<double>(done_) / options_.frames_per_second);
        const std::vector<droplet::FlowSample> samples = droplet::sampleFlow(state_, plan_.scene, plan_.parameters);
        if (table_) {
            table_->add(done_ + 1, state_.time, samples, plan_.scene.surface());
        }
        if (animation_) {
            animation_->add(state_.time, samples);
        }
        if (options_.kind == FlowOutput::Meshes) {
            writeMesh(samples, done_ + 1);
        } else if (isPicture() && (options_.kind != FlowOutput::Picture || done_ + 1 == plan_.frames)) {
            draw(samples, done_ + 1);
        }
        if (mapper_) {
            writeMaps(samples, done_ + 1);
        }
        if (checkpoint_ && checkpoint_->isDue(done_ + 1)) {
            saveCheckpoint();
        }
        progress_.reportFrame(done_ + 1, plan_.frames);
    }
    if (options_.has_preview) {
        shown_ = droplet::sampleFlow(state_, plan_.scene, plan_.parameters);
    }
    if (report_.balance.empty() || report_.balance.back().time != state_.time) {
        report_.balance.push_back(flowBalanceRow(state_));
    }
    report_.counts = state_.counts;
    report_.time = state_.time;
    if (options_.streaks) {
        streaks_ = ribbons_.surface(state_.time);
        if (animation_) {
            animation_->setStreaks(streaks_);
        }
        turnToFile(streaks_, formatOf(*options_.streaks), options_.reading);
    }
}

void FlowRun::saveCheckpoint() const
{
    Checkpoint checkpoint{done_ + 1,
                          {{"balance", bytesOfRows(report_.balance)},
                           {"flow", droplet::bytesOf(state_)},
                           {"planned frames", std::to_string(plan_.frames)}}};
    if (painter_) {
        checkpoint.state["wet picture"] = painter_->bytes();
    }
    if (mapper_) {
        checkpoint.state["wet maps"] = mapper_->bytes();
    }
    checkpoint_->write(checkpoint);
}

void FlowRun::advance(double until)
{
    const auto move_to = [&](double time) {
        state_ = droplet::advanceFlow(std::move(state_), plan_.scene, plan_.parameters, time);
        if (options_.streaks) {
            ribbons_.add(state_.tracks, plan_.scene.surface());
        }
        if (painter_) {
            painter_->add(state_.tracks);
        }
        if (mapper_) {
            mapper_->add(state_.tracks);
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

VideoWriterOptions FlowRun::videoAt(const std::string& path) const
{
    return triedVideo(path, {options_.view.width, options_.view.height, options_.frames_per_second}, options_.encoding);
}

droplet::Picture FlowRun::picture(const std::vector<droplet::FlowSample>& samples, double azimuth)
{
    const droplet::FlowMoment moment{state_.time, plan_.parameters.motion.at(state_.time), azimuth};
    return painter_->picture(moment, samples, droplet::dropletSurfaces(samples, bodies_, gravityAt(state_.time)));
}

std::vector<OutputFile> FlowRun::previewOutputs()
{
    const std::size_t turns = options_.view.turns.value_or(1);
    if (isVideo(options_.view.path)) {
        return {{options_.view.path, [this, turns, options = videoAt(options_.view.path)](std::ostream& out) {
                     VideoWriter video(options);
                     for (std::size_t k = 0; k < turns; ++k) {
                         video.add(picture(shown_, turnOf(options_.view, k)));
                         progress_.reportDrawn(k + 1, turns);
                     }
                     video.finish(out);
                 }}};
    }
    std::vector<OutputFile> files;
    for (const std::string& path : previewPaths(options_.view)) {
        files.push_back({path, [this, turns, k = files.size()](std::ostream& out) {
                             droplet::writePng(picture(shown_, turnOf(options_.view, k)), out);
                             progress_.reportDrawn(k + 1, turns);
                         }});
    }
    return files;
}

void FlowRun::draw(const std::vector<droplet::FlowSample>& samples, std::size_t number)
{
    picture_ = picture(samples, 0.0);
    if (video_) {
        video_->add(picture_);
    } else if (options_.files) {
        droplet::writeAtomically(
            options_.files->at(number),
            [&](std::ostream& out) { droplet::writePng(picture_, out, droplet::PngEffort::Fast); },
            options_.output_options);
    }
}

void FlowRun::writeMaps(const std::vector<droplet::FlowSample>& samples, std::size_t number)
{
    const droplet::Surface surface = droplet::dropletSurfaces(samples, bodies_, gravityAt(state_.time));
    const auto write = [&](std::size_t map, const auto& writer) {
        droplet::writeAtomically(options_.maps->beside(kFlowMaps[map]).at(number), writer, options_.output_options);
    };
    if (options_.are_maps_exr) {
        const droplet::WetFloatMaps maps = mapper_->floatMaps(state_.time, samples, surface);
        const std::array<const droplet::FloatPicture*, kFlowMaps.size()> all{&maps.normal, &maps.thickness, &maps.age,
                                                                             &maps.wet};
        for (std::size_t k = 0; k < all.size(); ++k) {
            write(k, [&](std::ostream& out) { writeExr(*all[k], out); });
        }
        return;
    }
    const droplet::WetMaps maps = mapper_->maps(state_.time, samples, surface);
    const std::array<const droplet::DeepPicture*, kFlowMaps.size()> all{&maps.normal, &maps.thickness, &maps.age,
                                                                        &maps.wet};
    for (std::size_t k = 0; k < all.size(); ++k) {
        write(k, [&](std::ostream& out) { writePng(*all[k], out, droplet::PngEffort::Fast); });
    }
}

void FlowRun::writeMesh(const std::vector<droplet::FlowSample>& samples, std::size_t number) const
{
    droplet::Surface surface =
        droplet::withBases(droplet::dropletSurfaces(samples, bodies_, gravityAt(state_.time)), bodies_);
    SurfaceTarget target{options_.files->at(number), options_.file.format, {}};
    target.options.material = material_;
    target.options.compression = options_.file.compression;
    turnToFile(surface, target.format, options_.reading);
    std::uint64_t bytes = 0;
    writeTogether(surfaceFiles(surface, target, bytes), options_.output_options);
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
