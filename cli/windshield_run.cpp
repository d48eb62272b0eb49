// SPDX-License-Identifier: GPL-3.0-or-later
#include "windshield_run.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "checkpoint.h"
#include "droplet/wind_io/droplet_scene.h"
#include "droplet/wind_io/droplet_table.h"
#include "droplet/windshield/state_bytes.h"
#include "droplet_report.h"
#include "files.h"
#include "option_values.h"
#include "stage_clock.h"
#include "windshield_files.h"
#include "windshield_frames.h"
#include "windshield_plan.h"

namespace cli {
namespace {

constexpr const char* kCommand = "windshield";

class WindshieldRun {
public:
    WindshieldRun(const WindshieldOptions& options, ProgressDisplay& progress);

    droplet::WindshieldReport execute();

private:
    /// Simulates the warm-up, or resumes an interrupted run.
    void begin();
    /// Resumes from the checkpoint, if that is possible.
    /// @return whether the state is now that of the checkpoint; otherwise the run starts from the first frame
    bool resume();
    /// Simulates one time step.
    void advance();
    void recordBalance();
    /// Moves the car by one frame.
    void travel();
    /// Simulates and draws all remaining frames.
    void run();
    void finish();

    const WindshieldOptions& options_;
    ProgressDisplay& progress_;
    StageClock clock_;
    WindshieldPlan plan_;
    WindshieldFrames frames_;
    std::optional<CheckpointFile> checkpoint_;  ///< if every frame has a file
    std::optional<droplet::DropletTable> table_;
    std::optional<droplet::DropletScene> scene_;
    droplet::WindshieldState state_;
    std::size_t done_ = 0;          ///< number of simulated frames
    std::size_t drawn_before_ = 0;  ///< number of frames drawn by an interrupted run
    std::size_t travelled_frames_ = 0;
    double travelled_ = 0.0;  ///< distance since the first frame [m]
    droplet::WindshieldReport report_;
};

WindshieldRun::WindshieldRun(const WindshieldOptions& options, ProgressDisplay& progress)
    : options_(options), progress_(progress), plan_(planOf(options)), frames_(options, plan_.parameters)
{
    if (options_.files) {
        checkpoint_.emplace(ResumableRun{kCommand, fingerprintOf(options_), plan_.frames, options_.frames_per_second,
                                         withMaps(*options_.files, options_.maps, kMapNames), options_.output_options});
    }
    report_.preset = options_.preset;
    report_.drive_cycle = options_.drive_cycle;
    report_.surface = options_.surface;
    report_.background = options_.background;
    report_.environment = options_.environment;
    report_.output = options_.output;
    report_.parameters = plan_.parameters;
    report_.view = frames_.view();
    report_.frames_per_second = options_.frames_per_second;
    report_.warm_up = options_.warm_up;
    report_.step = plan_.step;
    report_.frames = plan_.frames;
    if (options_.maps && !options_.are_maps_exr) {
        report_.map_thickness = options_.map.full_thickness;
    }
    report_.warnings = plan_.warnings;
}

droplet::WindshieldReport WindshieldRun::execute()
{
    begin();
    std::vector<OutputFile> files;
    if (options_.droplets) {
        files.push_back({*options_.droplets, {}});
    }
    if (!options_.files) {
        files.push_back({options_.output, {}});
    }
    if (options_.droplets) {
        // Rows are written at once, so the table is open during the whole run.
        files.front().write = [&](std::ostream& out) {
            const bool is_json = std::filesystem::path(*options_.droplets).extension() == ".json";
            table_.emplace(out, is_json ? droplet::TableFormat::Json : droplet::TableFormat::Csv, report_.view.shape);
            run();
            table_->finish();
        };
    } else {
        run();
    }
    if (!options_.files) {
        files.back().write = [&](std::ostream& out) { frames_.write(out); };
    }
    if (options_.model) {
        files.push_back({*options_.model, [&](std::ostream& out) { scene_->write(out, options_.model_file); }});
    }
    if (options_.json) {
        files.push_back({*options_.json, [&](std::ostream& out) {
                             finish();
                             writeWindshieldReport(out, report_);
                         }});
    }
    writeTogether(files, options_.output_options);
    if (checkpoint_) {
        checkpoint_->end();
    }
    finish();
    return std::move(report_);
}

void WindshieldRun::begin()
{
    state_ = startWindshield(plan_.parameters);
    if (options_.model) {
        droplet::DropletSceneOptions scene;
        scene.frames_per_second = options_.frames_per_second;
        scene.shape = report_.view.shape;
        scene.animation = options_.model_animation;
        scene_.emplace(plan_.parameters.glass, scene);
    }
    frames_.begin();
    if (checkpoint_ && resume()) {
        return;
    }
    const auto steps = static_cast<std::size_t>(std::llround(options_.warm_up / plan_.step));
    for (std::size_t k = 0; k < steps; ++k) {
        advance();
    }
}

bool WindshieldRun::resume()
{
    const auto checkpoint = checkpoint_->begin(options_.resume);
    if (!checkpoint) {
        return false;
    }
    drawn_before_ = checkpoint->frames;
    // Tables and models need every frame to be simulated again, and so do missing files.
    if (options_.droplets || options_.model || !checkpoint_->run().hasFrames(drawn_before_)) {
        return false;
    }
    state_ = droplet::stateFromBytes((*checkpoint)["windshield"], checkpoint_->path());
    report_.balance = rowsFromBytes<droplet::BalanceRow>((*checkpoint)["balance"]);
    done_ = checkpoint->frames;
    for (std::size_t k = 1; k < done_; ++k) {
        travel();
    }
    frames_.skip(done_);
    return true;
}

void WindshieldRun::advance()
{
    // Steps add up to full seconds, except for rounding.
    const auto second = [&] { return std::floor(state_.time + 1e-6); };
    const double before = second();
    state_ = droplet::step(std::move(state_), plan_.parameters, plan_.step);
    if (second() > before) {
        recordBalance();
    }
}

void WindshieldRun::recordBalance()
{
    report_.balance.push_back(balanceRow(state_, plan_.parameters.vehicle.speedAt(state_.time)));
}

void WindshieldRun::travel()
{
    ++travelled_frames_;
    const double time = options_.warm_up + static_cast<double>(travelled_frames_) / options_.frames_per_second;
    travelled_ += plan_.parameters.vehicle.speedAt(time) / options_.frames_per_second;
}

void WindshieldRun::run()
{
    for (; done_ < plan_.frames; ++done_) {
        if (done_ > 0) {
            for (std::size_t k = 0; k < plan_.steps; ++k) {
                advance();
            }
            travel();
        }
        if (table_) {
            table_->add(done_ + 1, state_,
                        options_.moving_only ? droplet::DropletRows::Moving : droplet::DropletRows::All);
        }
        if (scene_) {
            scene_->add(state_);
        }
        if (done_ >= drawn_before_ || !checkpoint_->run().hasFrame(done_ + 1)) {
            frames_.draw(state_, done_ + 1, done_ + 1 == plan_.frames,
                         {travelled_, plan_.parameters.vehicle.speedAt(state_.time)});
        } else {
            frames_.skip(1);
        }
        if (checkpoint_ && done_ + 1 > drawn_before_ && checkpoint_->isDue(done_ + 1)) {
            frames_.wait();
            checkpoint_->write(
                {done_ + 1, {{"balance", bytesOfRows(report_.balance)}, {"windshield", bytesOf(state_)}}});
        }
        progress_.reportFrame(done_ + 1, plan_.frames);
    }
    frames_.wait();
    if (report_.balance.empty() || report_.balance.back().time != state_.time) {
        recordBalance();
    }
    report_.counts = state_.counts;
}

void WindshieldRun::finish()
{
    report_.time_total = clock_.total();
    report_.peak_memory = peakMemory();
}

}  // namespace

droplet::WindshieldReport simulateWindshield(const WindshieldOptions& options, ProgressDisplay& progress)
{
    return WindshieldRun(options, progress).execute();
}

}  // namespace cli
