// SPDX-License-Identifier: GPL-3.0-or-later
#include "liquid2d_run.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <functional>
#include <iostream>
#include <iterator>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "content_hash.h"
#include "droplet/error.h"
#include "droplet/expression/blend.h"
#include "droplet/liquid2d/fluid.h"
#include "droplet/liquid2d_io/fluid_presets.h"
#include "droplet/liquid2d_io/liquid_drawing.h"
#include "droplet/liquid2d_io/liquid_lottie.h"
#include "droplet/liquid2d_io/particle_usda.h"
#include "droplet/liquid2d_io/read_scene.h"
#include "droplet/liquid2d_io/write_particles.h"
#include "droplet/mask/mask.h"
#include "droplet/outline/outline.h"
#include "droplet_report.h"
#include "film.h"
#include "option_values.h"
#include "stage_clock.h"
#include "this_process.h"
#include "video_writer.h"

namespace cli {
namespace {

using droplet::Error;
using droplet::ErrorCode;
using droplet::FluidScene;
using droplet::ParticleFrame;
using droplet::Vec2;

/// Whether the scene is a file, not a preset.
bool isSceneFile(const Liquid2dOptions& options)
{
    return std::filesystem::path(options.scene).extension() == ".toml";
}

droplet::FluidPreset presetOf(const Liquid2dOptions& options)
{
    return forOption("--scene", [&] { return droplet::fluidPresetNamed(options.scene); });
}

/// Frames of the simulation that the film is made of.
struct FilmSpan {
    std::size_t begin = 0;   ///< before the film
    std::size_t frames = 1;  ///< of the film
    std::size_t fade = 0;    ///< last ones of the film, which turn into those before it
};

FilmSpan spanOf(const Liquid2dOptions& options)
{
    const auto frames_in = [&](double seconds) {
        return static_cast<std::size_t>(std::llround(seconds * options.frames_per_second));
    };
    FilmSpan span{frames_in(options.begin.value_or(options.loop)), 1, frames_in(options.loop)};
    if (options.particles) {
        const std::size_t files = options.particle_files ? options.particle_files->numbers().size() : 1;
        if (files > 0 && files <= span.begin) {
            refuse(fmt::format("--begin: the film begins after {} frames, and there are {} of --particles", span.begin,
                               files));
        }
        span.frames = std::max<std::size_t>(files, span.begin + 1) - span.begin;
    } else {
        constexpr double kDuration = 4.0;  // of a scene from a file [s]
        span.frames = std::max<std::size_t>(frames_in(options.duration       ? *options.duration
                                                      : isSceneFile(options) ? kDuration
                                                                             : presetOf(options).duration),
                                            1);
    }
    if (span.fade > span.frames) {
        refuse(fmt::format("--loop: a fade of {} frames is longer than the film of {}", span.fade, span.frames));
    }
    return span;
}

/// Place of a wall between two others.
droplet::Region between(droplet::Region from, const droplet::Region& to, double weight)
{
    for (std::size_t loop = 0; loop < from.loops.size(); ++loop) {
        for (std::size_t k = 0; k < from.loops[loop].size(); ++k) {
            Vec2& p = from.loops[loop][k];
            p = p + weight * (to.loops[loop][k] - p);
        }
    }
    return from;
}

/// Files of every frame, the drawings first; none if the run cannot be resumed.
std::vector<NumberedPath> resumableFrames(const Liquid2dOptions& options)
{
    std::vector<NumberedPath> frames;
    for (const std::optional<NumberedPath>* files : {&options.files, &options.mask_files, &options.cache_files}) {
        if (*files && !(options.masks && !options.mask_files) && !options.cache_file) {
            frames.push_back(**files);
        }
    }
    return frames;
}

/// Frames of particles, one after another.
class ParticleSource {
public:
    virtual ~ParticleSource() = default;
    /// Next frame.
    virtual ParticleFrame next() = 0;
    /// Whether all liquid has left, and none will come.
    [[nodiscard]] virtual bool isLost() const { return false; }
    /// Steps that the first frame of a simulation takes, about.
    [[nodiscard]] virtual double stepsPerFrame() const { return 0.0; }
    [[nodiscard]] virtual Vec2 size() const = 0;
    /// Visible walls at the time of the last frame.
    [[nodiscard]] virtual std::vector<droplet::Region> walls() const { return {}; }
    [[nodiscard]] virtual std::uint64_t steps() const { return 0; }
    [[nodiscard]] virtual std::uint64_t removed() const { return 0; }
    [[nodiscard]] virtual std::uint64_t blocked() const { return 0; }
    /// State after the last frame, for a checkpoint.
    [[nodiscard]] virtual std::string bytes() const { return {}; }
    virtual void restore(std::string_view bytes, const std::string& name, std::size_t frames) = 0;
};

/// Particles of a simulated scene.
class SimulatedParticles : public ParticleSource {
public:
    explicit SimulatedParticles(const Liquid2dOptions& options) : fps_(options.frames_per_second)
    {
        droplet::FluidOptions fluid_options;
        fluid_options.solver = options.solver;
        scene_ = isSceneFile(options) ? droplet::readFluidScene(options.scene) : presetOf(options).scene;
        if (options.gravity) {
            scene_.gravity = {0.0, -*options.gravity};
        }
        scene_.surface_tension = options.surface_tension.value_or(scene_.surface_tension);
        if (options.walls) {
            addWalls(*options.walls);
        }
        state_ = droplet::startFluid(scene_);
        if (options.particle_count) {
            if (state_.position.empty()) {
                refuse("--particle-count needs a scene with liquid at the start");
            }
            scene_.max_particles = std::max<std::size_t>(scene_.max_particles, 2 * *options.particle_count);
            scene_.spacing *=
                std::sqrt(static_cast<double>(state_.position.size()) / static_cast<double>(*options.particle_count));
            state_ = droplet::startFluid(scene_);
        }
        if (options.walls) {
            droplet::checkEmitters(scene_);
        }
        stepper_.emplace(scene_, std::move(fluid_options));
    }

    ParticleFrame next() override
    {
        const double time = static_cast<double>(done_) / fps_;
        if (time > state_.time) {
            state_ = stepper_->advance(std::move(state_), time);
        }
        ++done_;
        return frameOf(state_, scene_);
    }
    [[nodiscard]] bool isLost() const override
    {
        const bool may_come = std::any_of(scene_.emitters.begin(), scene_.emitters.end(),
                                          [&](const auto& emitter) { return emitter.end > state_.time; });
        return state_.position.empty() && state_.counts.removed > 0 && !may_come;
    }
    [[nodiscard]] double stepsPerFrame() const override { return 1.0 / (fps_ * stepper_->longestStep(state_)); }
    [[nodiscard]] Vec2 size() const override { return scene_.size; }
    [[nodiscard]] std::vector<droplet::Region> walls() const override
    {
        return droplet::visibleWalls(scene_, state_.time);
    }
    [[nodiscard]] std::uint64_t steps() const override { return state_.counts.steps; }
    [[nodiscard]] std::uint64_t removed() const override { return state_.counts.removed; }
    [[nodiscard]] std::uint64_t blocked() const override { return state_.counts.blocked; }
    [[nodiscard]] std::string bytes() const override { return bytesOf(state_); }
    void restore(std::string_view bytes, const std::string& name, std::size_t frames) override
    {
        state_ = droplet::fluidStateFromBytes(bytes, name);
        done_ = frames;
    }

private:
    void addWalls(const std::string& path)
    {
        droplet::TraceOptions trace;
        trace.width = scene_.size.x;
        const droplet::Outline outline = droplet::trace(droplet::readMask(path), trace);
        // The mask stands on the lower edge of the window.
        scene_.walls.push_back(
            {droplet::regionOf(outline, {0.5 * scene_.size.x, 0.5 * outline.extent.y}), std::nullopt, true});
    }

    FluidScene scene_;
    droplet::FluidState state_;
    std::optional<droplet::FluidStepper> stepper_;
    double fps_;
    std::size_t done_ = 0;
};

/// Particles from files of another program.
class FileParticles : public ParticleSource {
public:
    explicit FileParticles(const Liquid2dOptions& options)
        : fps_(options.frames_per_second), reading_(options.particle_reading)
    {
        if (options.particle_files) {
            for (const auto& [number, path] : options.particle_files->existing()) {
                paths_.push_back(path);
            }
        } else {
            paths_.push_back(*options.particles);
        }
        // The window shows all particles of all frames.
        Vec2 lower{1e300, 1e300};
        Vec2 upper{-1e300, -1e300};
        double spacing = 0.0;
        for (const std::string& path : paths_) {
            const ParticleFrame frame = droplet::readParticles(path, reading_).frame;
            reading_.spacing = reading_.spacing.value_or(frame.spacing);
            spacing = frame.spacing;
            addIds(frame.id);
            for (const Vec2 x : frame.position) {
                lower = {std::min(lower.x, x.x), std::min(lower.y, x.y)};
                upper = {std::max(upper.x, x.x), std::max(upper.y, x.y)};
            }
        }
        if (!(upper.x >= lower.x)) {
            throw Error(ErrorCode::InvalidInput, *options.particles + ": has no particles");
        }
        const double margin = std::max(0.05 * std::max(upper.x - lower.x, upper.y - lower.y), 4.0 * spacing);
        origin_ = lower - Vec2{margin, margin};
        size_ = upper - lower + Vec2{2.0 * margin, 2.0 * margin};
    }

    ParticleFrame next() override
    {
        droplet::ParticleFile file = droplet::readParticles(paths_[done_], reading_);
        ParticleFrame frame = std::move(file.frame);
        frame.time = static_cast<double>(done_) / fps_;
        for (Vec2& x : frame.position) {
            x = x - origin_;
        }
        for (std::uint32_t& id : frame.id) {
            id = static_cast<std::uint32_t>(std::lower_bound(ids_.begin(), ids_.end(), id) - ids_.begin());
        }
        if (!file.has_velocity && last_) {
            frame = droplet::fillVelocities(*last_, std::move(frame));
        }
        last_ = frame;
        ++done_;
        return frame;
    }
    [[nodiscard]] Vec2 size() const override { return size_; }
    void restore(std::string_view /*bytes*/, const std::string& /*name*/, std::size_t frames) override
    {
        done_ = frames - 1;
        next();
    }

private:
    void addIds(std::vector<std::uint32_t> ids)
    {
        std::sort(ids.begin(), ids.end());
        std::vector<std::uint32_t> all;
        std::set_union(ids_.begin(), ids_.end(), ids.begin(), ids.end(), std::back_inserter(all));
        ids_ = std::move(all);
    }

    double fps_;
    droplet::ParticleFileOptions reading_;
    std::vector<std::uint32_t> ids_;  ///< of all frames, ascending; their memory must not grow with the largest
    std::vector<std::string> paths_;
    Vec2 origin_;
    Vec2 size_;
    std::optional<ParticleFrame> last_;
    std::size_t done_ = 0;
};

std::unique_ptr<ParticleSource> sourceOf(const Liquid2dOptions& options)
{
    if (options.particles) {
        return std::make_unique<FileParticles>(options);
    }
    return std::make_unique<SimulatedParticles>(options);
}

/// Run that can be resumed, if every frame has a file.
std::optional<ResumableRun> resumableRun(const Liquid2dOptions& options, std::size_t frames)
{
    const std::vector<NumberedPath> files = resumableFrames(options);
    if (files.empty()) {
        return std::nullopt;
    }
    return ResumableRun{"liquid2d",
                        fingerprintOf({options.fingerprint, options.walls ? hashOfFile(*options.walls) : "",
                                       isSceneFile(options) ? hashOfFile(options.scene) : ""}),
                        frames, options.frames_per_second, files};
}

class LiquidRun {
public:
    LiquidRun(const Liquid2dOptions& options, ProgressDisplay& progress)
        : options_(options),
          progress_(progress),
          span_(spanOf(options)),
          source_(sourceOf(options)),
          film_(span_.frames, options.run.files, progress, resumableRun(options, span_.frames))
    {
        view_.size = source_->size();
        view_.width = options.width;
        view_.height = std::max(static_cast<int>(std::lround(options.width * view_.size.y / view_.size.x)), 1);
        if (options.kind == LiquidOutput::Video) {
            const VideoFrames frames = evenSides({view_.width, view_.height, options.frames_per_second});
            view_.width = frames.width;
            view_.height = frames.height;
        }
        if (view_.height > 32767) {
            refuse(fmt::format("--frame-width: at {} pixels the drawing is {} pixels high; at most 32767 are allowed",
                               view_.width, view_.height));
        }
        report_.scene = options.particles ? std::nullopt : std::optional(options.scene);
        report_.particles = options.particles;
        report_.output = options.output;
        report_.masks = options.masks;
        report_.style = options.style;
        report_.options = options.controls;
        report_.size = view_.size;
        report_.frames_per_second = options.frames_per_second;
    }

    droplet::LiquidReport execute()
    {
        resume();
        if (options_.kind == LiquidOutput::Video) {
            video_ = std::make_unique<VideoWriter>(triedVideo(
                *options_.output, {view_.width, view_.height, options_.frames_per_second}, options_.encoding));
        }
        if (options_.kind == LiquidOutput::Lottie) {
            lottie_.emplace(view_, options_.look, options_.frames_per_second);
        }
        if (options_.cache_file) {
            particles_.emplace(options_.frames_per_second);
        }
        warnOfFewParticles();
        warnOfShortSteps();
        std::vector<OutputFile> files;
        if (video_) {
            files.push_back({*options_.output, [&](std::ostream& out) { video_->finish(out); }});
        } else if (lottie_) {
            files.push_back({*options_.output, [&](std::ostream& out) { lottie_->write(out); }});
        } else if (options_.kind == LiquidOutput::Drawing) {
            files.push_back({*options_.output, [&](std::ostream& out) { write(*shown_, *options_.output, out); }});
        }
        if (particles_) {
            files.push_back({*options_.cache_file, [&](std::ostream& out) { particles_->write(out); }});
        }
        if (options_.json) {
            files.push_back({*options_.json, [&](std::ostream& out) {
                                 finish();
                                 writeLiquidReport(out, report_);
                             }});
        }
        film_.write(
            {}, [&](std::ostream* /*table*/) { run(); }, files);
        finish();
        return std::move(report_);
    }

private:
    /// What of a frame is drawn.
    struct Drawing {
        droplet::LiquidShape shape;
        std::vector<droplet::Region> walls;
    };

    void resume()
    {
        const auto checkpoint = film_.begin(options_.resume);
        // Drawings that are held, or that the end turns into, are not in the checkpoint.
        if (!checkpoint || !film_.hasFrames(checkpoint->frames) || isHeld(checkpoint->frames + 1) || span_.fade > 0) {
            return;
        }
        const std::string& path = film_.checkpointPath();
        source_->restore((*checkpoint)["particles"], path, span_.begin + checkpoint->frames);
        surface_ = droplet::expressionFromBytes((*checkpoint)["surface"], path);
        report_.frames = rowsFromBytes<droplet::LiquidFrameRow>((*checkpoint)["rows"]);
    }

    [[nodiscard]] Blobs state() const
    {
        return {{"particles", source_->bytes()}, {"rows", bytesOfRows(report_.frames)}, {"surface", bytesOf(surface_)}};
    }

    void warn(const std::string& warning)
    {
        report_.warnings.push_back(warning);
        if (options_.run.verbosity != Verbosity::Quiet) {
            progress_.warn(warning);
        }
    }

    /// Tells of liquid that is lost in a frame; it is an error if nothing is left to see.
    void tellLoss(std::size_t number, double time)
    {
        const std::string said = fmt::format(
            "from frame {} on, at {:.4g} s, there is no liquid: all {} particles have left the window and its "
            "margin; give them walls, or a shorter time",
            number, time, source_->removed());
        if (number <= 2 || options_.kind == LiquidOutput::Drawing) {
            throw Error(ErrorCode::NoSuchDroplet, said);
        }
        warn(said);
    }

    /// Tells of a liquid that is only a few particles wide.
    void warnOfFewParticles()
    {
        // Of a splash with 50 a disc floats in the air; with 100 the basin's lower corners stay empty, with 500 hardly.
        constexpr std::size_t kFew = 200;
        if (options_.particle_count && *options_.particle_count < kFew) {
            warn(fmt::format(
                "--particle-count: {} particles are too few: liquid keeps off walls and floats in the air; give {} or "
                "more",
                *options_.particle_count, kFew));
        }
    }

    /// Tells of a simulation without end before it begins.
    void warnOfShortSteps()
    {
        constexpr double kMany = 2000.0;
        if (const double steps = source_->stepsPerFrame(); steps > kMany) {
            warn(fmt::format(
                "a frame takes about {:.2g} steps, so the run takes very long: gravity, speeds or forces are "
                "large for the spacing of the particles",
                steps));
        }
    }

    void run()
    {
        if (report_.frames.empty()) {
            begin();
        }
        film_.make(report_.frames.size(),
                   {[this](std::size_t number) { return frame(number); }, [this] { return state(); }});
        report_.removed = source_->removed();
        if (source_->blocked() > 0) {
            warn(
                fmt::format("emitters kept {} particles, because a closed vessel was full; give it an opening or more "
                            "room",
                            source_->blocked()));
        }
    }

    /// Makes what is before the film.
    void begin()
    {
        for (std::size_t left = span_.begin; left > 0; --left) {
            const ParticleFrame particles = source_->next();
            if (!shown_ || left % static_cast<std::size_t>(options_.hold) == 0) {
                shown_ = drawingOf(particles, source_->walls());
            }
            if (left <= span_.fade) {
                before_.push_back(shown_);
            }
        }
    }

    /// Drawing of the next particles.
    std::shared_ptr<const Drawing> drawingOf(const ParticleFrame& particles, std::vector<droplet::Region> walls)
    {
        surface_ = advanceExpression(std::move(surface_), particles, options_.controls);
        Drawing drawing{liquidShape(surface_, particles, options_.controls), std::move(walls)};
        surface_ = remember(std::move(surface_), drawing.shape);
        return std::make_shared<const Drawing>(std::move(drawing));
    }

    /// Drawing of a frame of the film; the last ones turn into those before it.
    [[nodiscard]] std::shared_ptr<const Drawing> faded(std::size_t number, std::shared_ptr<const Drawing> drawing) const
    {
        const std::size_t first = span_.frames - span_.fade + 1;
        if (number < first) {
            return drawing;
        }
        const double t = static_cast<double>(number - first + 1) / static_cast<double>(span_.fade + 1);
        droplet::BlendOptions blend;
        blend.weight = t * t * (3.0 - 2.0 * t);
        blend.spacing = report_.spacing;
        blend.resolution = options_.controls.resolution;
        blend.min_area = options_.controls.min_area;
        const Drawing& before = *before_[number - first];
        Drawing fading{blended(drawing->shape, before.shape, blend), {}};
        for (std::size_t k = 0; k < drawing->walls.size(); ++k) {
            fading.walls.push_back(between(drawing->walls[k], before.walls[k], blend.weight));
        }
        return std::make_shared<const Drawing>(std::move(fading));
    }

    std::function<void()> frame(std::size_t number)
    {
        ParticleFrame particles = source_->next();
        if (source_->isLost() && !std::exchange(is_lost_, true)) {
            tellLoss(number, particles.time);
        }
        return [this, number, particles = std::move(particles), walls = source_->walls(),
                steps = source_->steps()]() mutable { draw(number, particles, std::move(walls), steps); };
    }

    void draw(std::size_t number, const ParticleFrame& particles, std::vector<droplet::Region> walls,
              std::uint64_t steps)
    {
        report_.spacing = particles.spacing;
        if (isHeld(number)) {
            report_.frames.push_back(report_.frames.back());
            report_.frames.back().time = particles.time;
            if (!film_.isWritten(number)) {
                save(number, particles);
            }
            return;
        }
        shown_ = faded(number, drawingOf(particles, std::move(walls)));
        const droplet::LiquidShape& shape = shown_->shape;
        report_.frames.push_back(
            {particles.time, particles.position.size(), steps,
             static_cast<double>(particles.position.size()) * particles.spacing * particles.spacing, shape.area(),
             shape.liquid.size(), shape.foam.size(), shape.droplets.size()});
        if (!film_.isWritten(number)) {
            save(number, particles);
        }
    }

    /// Whether a frame has the drawing of the one before.
    [[nodiscard]] bool isHeld(std::size_t number) const
    {
        return (number - 1) % static_cast<std::size_t>(options_.hold) != 0;
    }

    void save(std::size_t number, const ParticleFrame& particles)
    {
        if (video_) {
            video_->add(liquidLayer({shown_->shape, shown_->walls}, view_, options_.look));
        } else if (lottie_) {
            lottie_->add({shown_->shape, shown_->walls});
        }
        if (particles_) {
            particles_->add(particles);
        }
        std::vector<OutputFile> files;
        if (options_.files) {
            const std::string path = options_.files->at(number);
            files.push_back({path, [this, path, drawing = shown_](std::ostream& out) { write(*drawing, path, out); }});
        }
        const auto write_mask = [this, drawing = shown_](std::ostream& out) {
            writePng(liquidMask(drawing->shape, view_), out, droplet::PngEffort::Fast);
        };
        if (options_.mask_files) {
            files.push_back({options_.mask_files->at(number), write_mask});
        } else if (options_.masks) {
            write_mask(std::cout);
            std::cout.flush();
            if (!std::cout) {
                throw Error(ErrorCode::OutputFailed, "--masks: standard output cannot be written");
            }
        }
        if (options_.cache_files) {
            const std::string path = options_.cache_files->at(number);
            files.push_back({path, [path, particles](std::ostream& out) {
                                 writeParticles(particles, out, *droplet::particleFormatOf(path));
                             }});
        }
        if (!files.empty()) {
            film_.save(std::move(files));
        }
    }

    void write(const Drawing& drawing, const std::string& path, std::ostream& out) const
    {
        if (std::filesystem::path(path).extension() == ".svg") {
            writeLiquidSvg({drawing.shape, drawing.walls}, view_, options_.look, out);
            return;
        }
        writePng(liquidLayer({drawing.shape, drawing.walls}, view_, options_.look), out, droplet::PngEffort::Fast);
    }

    void finish()
    {
        report_.time_total = clock_.total();
        report_.peak_memory = peakMemory();
    }

    const Liquid2dOptions& options_;
    ProgressDisplay& progress_;
    StageClock clock_;
    FilmSpan span_;
    std::unique_ptr<ParticleSource> source_;
    Film film_;
    droplet::LiquidView view_;
    bool is_lost_ = false;  ///< whether the loss of all liquid was told
    droplet::ExpressionState surface_;
    std::shared_ptr<const Drawing> shown_;                ///< the last frame
    std::vector<std::shared_ptr<const Drawing>> before_;  ///< those before the film that its end turns into
    std::unique_ptr<VideoWriter> video_;
    std::optional<droplet::LiquidLottie> lottie_;
    std::optional<droplet::ParticleUsda> particles_;  ///< over time
    droplet::LiquidReport report_;
};

}  // namespace

RunFiles filesOf(const Liquid2dOptions& options)
{
    RunFiles files;
    files.reads("--config", options.run.config);
    files.reads("--walls", options.walls);
    if (options.particle_files) {
        for (const std::size_t number : options.particle_files->numbers()) {
            files.reads("--particles", options.particle_files->at(number));
        }
    } else if (options.particles) {
        files.reads("--particles", options.particles);
    } else if (isSceneFile(options)) {
        files.reads("--scene", options.scene);
        for (const std::filesystem::path& mask : droplet::masksOfScene(options.scene)) {
            files.reads("a mask of --scene", mask.string());
        }
    }
    const FrameNumbers numbers{1, spanOf(options).frames};
    if (options.files) {
        files.writesFrames("OUTPUT", *options.files, numbers);
    } else {
        files.writes("OUTPUT", options.output);
    }
    if (options.mask_files) {
        files.writesFrames("--masks", *options.mask_files, numbers);
    } else {
        files.writes("--masks", options.masks);
    }
    if (options.cache_files) {
        files.writesFrames("--particle-cache", *options.cache_files, numbers);
    }
    files.writes("--particle-cache", options.cache_file);
    if (const std::vector<NumberedPath> frames = resumableFrames(options); !frames.empty()) {
        files.writes("the checkpoint", checkpointPath(frames.front()));
    }
    files.writes("--json", options.json);
    return files;
}

droplet::LiquidReport drawLiquid2d(const Liquid2dOptions& options, ProgressDisplay& progress)
{
    return LiquidRun(options, progress).execute();
}

}  // namespace cli
