// SPDX-License-Identifier: GPL-3.0-or-later
#include "windshield_run.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "droplet/wind_io/droplet_table.h"
#include "droplet/wind_io/windshield_animation.h"
#include "droplet/windshield/state_bytes.h"
#include "droplet_report.h"
#include "film.h"
#include "option_values.h"
#include "stage_clock.h"
#include "this_process.h"
#include "windshield_files.h"
#include "windshield_frames.h"
#include "windshield_plan.h"

namespace cli {
namespace {

/// Run that can be resumed, if every frame has a file.
std::optional<ResumableRun> resumableRun(const WindshieldOptions& options, std::size_t frames)
{
    return options.files
               ? std::optional(ResumableRun{"windshield", fingerprintOf(options), frames, options.frames_per_second,
                                            withMaps(*options.files, options.maps, kMapNames)})
               : std::nullopt;
}

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
    /// Simulates a frame.
    /// @return what draws it
    std::function<void()> frame(std::size_t number);
    /// Makes all remaining frames.
    void run(std::ostream* table);
    /// Warns if most of the water is in no table or animation.
    void warnOfFilm();
    void finish();

    const WindshieldOptions& options_;
    StageClock clock_;
    WindshieldPlan plan_;
    Film film_;
    WindshieldFrames frames_;
    std::optional<droplet::DropletTable> table_;
    std::optional<droplet::WindshieldAnimation> scene_;
    droplet::WindshieldState state_;
    std::size_t done_ = 0;  ///< number of frames that an interrupted run simulated
    std::size_t travelled_frames_ = 0;
    double travelled_ = 0.0;  ///< distance since the first frame [m]
    droplet::WindshieldReport report_;
};

WindshieldRun::WindshieldRun(const WindshieldOptions& options, ProgressDisplay& progress)
    : options_(options),
      plan_(planOf(options)),
      film_(plan_.frames, options.run.files, progress, resumableRun(options, plan_.frames)),
      frames_(options, plan_.parameters, film_)
{
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
    if (!options_.files) {
        files.push_back({options_.output, [&](std::ostream& out) { frames_.write(out); }});
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
    film_.write(
        options_.droplets, [&](std::ostream* table) { run(table); }, files);
    finish();
    return std::move(report_);
}

void WindshieldRun::begin()
{
    state_ = startWindshield(plan_.parameters);
    if (options_.model) {
        droplet::WindshieldAnimationOptions scene;
        scene.frames_per_second = options_.frames_per_second;
        scene.shape = report_.view.shape;
        scene.animation = options_.model_animation;
        scene_.emplace(plan_.parameters.glass, scene);
    }
    frames_.begin();
    if (resume()) {
        return;
    }
    const auto steps = static_cast<std::size_t>(std::llround(options_.warm_up / plan_.step));
    for (std::size_t k = 0; k < steps; ++k) {
        advance();
    }
}

bool WindshieldRun::resume()
{
    const auto checkpoint = film_.begin(options_.resume);
    // Tables and models need every frame to be simulated again, and so do missing files.
    if (!checkpoint || options_.droplets || options_.model || !film_.hasFrames(checkpoint->frames)) {
        return false;
    }
    state_ = droplet::stateFromBytes((*checkpoint)["windshield"], film_.checkpointPath());
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

std::function<void()> WindshieldRun::frame(std::size_t number)
{
    if (number > 1) {
        for (std::size_t k = 0; k < plan_.steps; ++k) {
            advance();
        }
        travel();
    }
    if (table_) {
        table_->add(number, state_, options_.moving_only ? droplet::DropletRows::Moving : droplet::DropletRows::All);
    }
    if (scene_) {
        scene_->add(state_);
    }
    if (film_.isWritten(number)) {
        return [this] { frames_.skip(1); };
    }
    return [this, number, state = state_, car = CarState{travelled_, plan_.parameters.vehicle.speedAt(state_.time)}] {
        frames_.draw(state, number, number == plan_.frames, car);
    };
}

void WindshieldRun::run(std::ostream* table)
{
    if (table != nullptr) {
        const bool is_json = std::filesystem::path(*options_.droplets).extension() == ".json";
        table_.emplace(*table, is_json ? droplet::TableFormat::Json : droplet::TableFormat::Csv, report_.view.shape);
    }
    film_.make(done_, {[this](std::size_t number) { return frame(number); },
                       [this] {
                           return Blobs{{"balance", bytesOfRows(report_.balance)}, {"windshield", bytesOf(state_)}};
                       }});
    if (table_) {
        table_->finish();
    }
    if (report_.balance.empty() || report_.balance.back().time != state_.time) {
        recordBalance();
    }
    report_.counts = state_.counts;
    warnOfFilm();
}

void WindshieldRun::warnOfFilm()
{
    const droplet::WaterBalance& water = report_.balance.back().balance;
    const double on_glass = water.on_glass_still + water.on_glass_film + water.on_glass_running;
    constexpr double kMuch = 0.5;  // a film with less of the water is beside many droplets
    if (water.on_glass_film <= kMuch * on_glass || (!options_.model && !options_.droplets)) {
        return;
    }
    const std::string lacking = std::string(options_.droplets ? "--droplets" : "") +
                                (options_.droplets && options_.model ? ", " : "") +
                                (options_.model ? "--animation" : "");
    report_.warnings.push_back(fmt::format(
        "{}: {:.0f} % of the water on the glass is in the film of heavy rain, which is in pictures and --maps alone; "
        "--runoff 0s leaves it in droplets",
        lacking, 100.0 * water.on_glass_film / on_glass));
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
