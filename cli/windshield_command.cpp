// SPDX-License-Identifier: GPL-3.0-or-later
#include "windshield_command.h"

#include <tbb/global_control.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <memory>
#include <sstream>
#include <utility>

#include "background.h"
#include "checkpoint.h"
#include "content_hash.h"
#include "droplet/error.h"
#include "droplet/io/object.h"
#include "droplet/units.h"
#include "droplet/wind_io/droplet_scene.h"
#include "droplet/wind_io/droplet_table.h"
#include "droplet/wind_io/read_drive_cycle.h"
#include "droplet/wind_io/windshield_report.h"
#include "droplet_report.h"
#include "files.h"
#include "option_values.h"
#include "stage_clock.h"
#include "terminal.h"
#include "video_writer.h"
#include "windshield_options.h"

namespace cli {
namespace {

using droplet::Error;
using droplet::ErrorCode;

constexpr const char* kMaps[] = {"normal", "thickness", "velocity"};

std::string beforeExtension(std::string path, const char* map)
{
    return path.insert(path.size() - std::string(".png").size(), std::string("-") + map);
}

/// Where a map of a frame goes: `maps/00001-normal.png`.
std::string mapPath(const NumberedPath& maps, std::size_t number, const char* map)
{
    return beforeExtension(maps.at(number), map);
}

/// The same with the number's place left open.
std::string mapPattern(const NumberedPath& maps, const char* map)
{
    return beforeExtension(maps.text(), map);
}

std::string checkpointPath(const NumberedPath& files)
{
    return std::filesystem::path(files.with("checkpoint")).replace_extension(".state").string();
}

/// What is known to fail fails before any work is done.
void check(const WindshieldOptions& options)
{
    std::vector<NamedFile> inputs;
    const auto input = [&](const char* name, const std::optional<std::string>& path) {
        if (path) {
            inputs.push_back({name, *path});
        }
    };
    input("--background", options.background);
    input("--drive-cycle", options.drive_cycle);
    input("--surface", options.surface);
    input("--config", options.config);
    std::vector<NamedFile> outputs{{"OUTPUT", options.files ? options.files->at(1) : options.output}};
    if (options.maps) {
        for (const char* map : kMaps) {
            outputs.push_back({"--maps", mapPath(*options.maps, 1, map)});
        }
    }
    if (options.files) {
        outputs.push_back({"OUTPUT's checkpoint", checkpointPath(*options.files)});
    }
    const auto output = [&](const char* name, const std::optional<std::string>& path) {
        if (path) {
            outputs.push_back({name, *path});
        }
    };
    output("--droplets", options.droplets);
    output("--model", options.model);
    output("--json", options.json);
    checkFiles(inputs, outputs, options.output_options);
}

/// A drive cycle that begins at 0, held to what the options are held to.
/// @param whole  all of it is to be played
droplet::DriveCycle driveCycleFrom(const std::string& path, bool whole)
{
    droplet::DriveCycle cycle = droplet::readDriveCycle(path);
    const auto refuse_file = [&](const std::string& words) {
        throw Error(ErrorCode::InvalidInput, path + ": " + words);
    };
    constexpr double kFastest = 150.0;  // as of --speed
    const double fastest = *std::max_element(cycle.speeds.begin(), cycle.speeds.end());
    if (fastest > kFastest) {
        std::ostringstream words;
        words << "goes at " << fastest << " m/s; a car may go at 150 m/s at most";
        refuse_file(words.str());
    }
    const double first = cycle.times.front();
    for (double& time : cycle.times) {
        time -= first;
    }
    constexpr double kLongest = 86400.0;  // as of --time
    if (whole && cycle.times.back() > kLongest) {
        refuse_file("lasts longer than 24h: --time tells how much of it to play");
    }
    return cycle;
}

class Windshield {
public:
    explicit Windshield(const WindshieldOptions& options) : options_(options), parameters_(options.parameters)
    {
        if (options_.drive_cycle) {
            parameters_.vehicle = driveCycleFrom(*options_.drive_cycle, !options_.duration);
        }
        if (options_.surface) {
            const droplet::TexturedMesh object = droplet::readObject(*options_.surface);
            parameters_.glass = forOption(*options_.surface, [&] { return droplet::Glass(object, {}); });
            constexpr double kBent = 0.02;
            if (parameters_.glass.mostStretch() > 1.0 + kBent || parameters_.glass.leastStretch() < 1.0 - kBent) {
                std::ostringstream words;
                words << *options_.surface << ": rolled out by its uv, lengths are " << std::setprecision(3)
                      << parameters_.glass.leastStretch() << " to " << parameters_.glass.mostStretch()
                      << " times what they are on the rolled out glass";
                report_.warnings.push_back(words.str());
            }
        }
        if (options_.wiper) {
            parameters_.wipers = droplet::tandemWipers(parameters_.glass, *options_.wiper);
        }
        duration_ = options_.duration.value_or(options_.drive_cycle ? parameters_.vehicle.times.back() : 10.0);
        // The cycle begins with the first frame.
        for (double& time : parameters_.vehicle.times) {
            time += options_.warm_up;
        }
        forGlass([&] { parameters_.validate(); });
        requireRain();
        if (options_.is_video) {
            codec_ = options_.codec.value_or(codecFor(options_.output));
            checkCodec(codec_, options_.output);
        }
        BackgroundOptions behind;
        behind.path = options_.background;
        if (options_.sized) {
            behind.width = options_.view.width;
            behind.height = options_.view.height;
        }
        behind.fit = options_.fit;
        behind.field_of_view = options_.view.field_of_view;
        background_ = std::make_unique<Background>(behind);
        droplet::ViewOptions view = options_.view;
        view.width = background_->width();
        view.height = background_->height();
        if (options_.is_video && (view.width % 2 != 0 || view.height % 2 != 0)) {
            refuse("--size: a video's frame must have even sides, not " + std::to_string(view.width) + "x" +
                   std::to_string(view.height));
        }
        forGlass([&] { view_ = std::make_unique<droplet::DriversView>(parameters_.glass, view); });
        frames_ =
            std::max<std::size_t>(static_cast<std::size_t>(std::llround(duration_ * options_.frames_per_second)), 1);
        // No step is longer than a sixtieth of a second, and each frame is one.
        constexpr double kLongest = 1.0 / 60.0;
        steps_ = static_cast<std::size_t>(std::ceil(1.0 / (kLongest * options_.frames_per_second) - 1e-9));
        step_ = 1.0 / (options_.frames_per_second * static_cast<double>(steps_));
        checkFrames();
        if (options_.files) {
            fingerprint_ = fingerprintOf({options_.fingerprint, hashOfFile(options_.background),
                                          hashOfFile(options_.drive_cycle), hashOfFile(options_.surface)});
        }
        report_.preset = options_.preset;
        report_.drive_cycle = options_.drive_cycle;
        report_.surface = options_.surface;
        report_.background = options_.background;
        report_.output = options_.output;
        report_.parameters = parameters_;
        report_.view = view;
        report_.frames_per_second = options_.frames_per_second;
        report_.warm_up = options_.warm_up;
        report_.step = step_;
        report_.frames = frames_;
    }

    droplet::WindshieldReport play()
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
            // Rows are written as they come: the table is open for the whole run.
            files.front().write = [&](std::ostream& out) {
                const bool is_json = std::filesystem::path(*options_.droplets).extension() == ".json";
                table_.emplace(out, is_json ? droplet::TableFormat::Json : droplet::TableFormat::Csv,
                               report_.view.shape);
                run();
                table_->finish();
            };
        } else {
            run();
        }
        if (!options_.files) {
            files.back().write = [&](std::ostream& out) { writeShown(out); };
        }
        if (options_.model) {
            files.push_back({*options_.model, [&](std::ostream& out) { scene_->write(out); }});
        }
        if (options_.json) {
            files.push_back({*options_.json, [&](std::ostream& out) {
                                 finish();
                                 writeWindshieldReport(out, report_);
                             }});
        }
        writeTogether(files, options_.output_options);
        if (options_.files) {
            std::error_code ignored;
            std::filesystem::remove(checkpointPath(*options_.files), ignored);
        }
        finish();
        return std::move(report_);
    }

private:
    /// Runs what may find the glass unfit, and puts its file's or option's name before the complaint.
    template <typename Function>
    void forGlass(const Function& function) const
    {
        try {
            function();
        } catch (const Error& error) {
            if (options_.surface) {
                throw Error(ErrorCode::InvalidInput, *options_.surface + ": as a glass: " + error.what());
            }
            throw Error(error.code(), std::string("--glass-width, --eye-distance: ") + error.what());
        }
    }

    /// A surface may face away from the rain, above all if its triangles are the wrong way round.
    void requireRain() const
    {
        if (!options_.surface) {
            return;
        }
        const droplet::Glass& glass = parameters_.glass;
        const double speed = *std::max_element(parameters_.vehicle.speeds.begin(), parameters_.vehicle.speeds.end());
        constexpr double kFastestRaindrop = 9.65;  // [m/s], Atlas
        constexpr int kPlaces = 32;
        for (int j = 0; j < kPlaces; ++j) {
            for (int i = 0; i < kPlaces; ++i) {
                const auto place =
                    glass.place({(i + 0.5) / kPlaces * glass.width(), (j + 0.5) / kPlaces * glass.height()});
                if (place && kFastestRaindrop * place->normal.z + speed * place->normal.y > 0.0) {
                    return;
                }
            }
        }
        throw Error(ErrorCode::InvalidInput,
                    *options_.surface + ": no rain meets it: its triangles face downward, backward or inward");
    }

    /// Everything before the first frame, or where an interrupted run stood.
    void begin()
    {
        state_ = startWindshield(parameters_);
        if (options_.model) {
            droplet::DropletSceneOptions scene;
            scene.frames_per_second = options_.frames_per_second;
            scene.shape = report_.view.shape;
            scene_.emplace(parameters_.glass, scene);
        }
        if (options_.is_video) {
            const VideoWriterOptions video{options_.output, codec_, report_.view.width, report_.view.height,
                                           options_.frames_per_second};
            tryVideo(video);
            video_ = std::make_unique<VideoWriter>(video);
        }
        if (options_.files && takeUp()) {
            return;
        }
        const auto steps = static_cast<std::size_t>(std::llround(options_.warm_up / step_));
        for (std::size_t k = 0; k < steps; ++k) {
            goOn();
        }
    }

    /// Goes on where an interrupted run stood, as far as it may.
    /// @return whether it was the checkpoint's state to go on from; otherwise it begins anew
    bool takeUp()
    {
        const std::string path = checkpointPath(*options_.files);
        const auto checkpoint = options_.resume ? readCheckpoint(path) : std::optional<Checkpoint>();
        if (!checkpoint) {
            // Another run's must not be taken for this one's.
            removeCheckpoint(path, options_.output_options);
            return false;
        }
        if (checkpoint->fingerprint != fingerprint_) {
            refuse("--resume: " + path + " is of a run with other options or files");
        }
        if (checkpoint->frames > frames_) {
            refuse("--resume: " + std::to_string(checkpoint->frames) + " frames stand already, and --time asks for " +
                   std::to_string(frames_));
        }
        drawn_before_ = checkpoint->frames;
        bool is_whole = true;
        for (std::size_t number = 1; is_whole && number <= drawn_before_; ++number) {
            is_whole = isThere(number);
        }
        // What is told of every frame has to be played again, as has what is missing.
        if (options_.droplets || options_.model || !is_whole) {
            return false;
        }
        state_ = checkpoint->state;
        report_.balance = checkpoint->balance;
        played_ = checkpoint->frames;
        for (std::size_t k = 1; k < played_; ++k) {
            travel();
        }
        background_->skip(played_);
        return true;
    }

    /// Whether all files of a frame stand.
    [[nodiscard]] bool isThere(std::size_t number) const
    {
        std::error_code ignored;
        bool is_there = std::filesystem::exists(options_.files->at(number), ignored);
        for (const char* map : kMaps) {
            is_there =
                is_there && (!options_.maps || std::filesystem::exists(mapPath(*options_.maps, number, map), ignored));
        }
        return is_there;
    }

    /// Frames must not take the place of what is read or written otherwise, nor, if so asked for, of anything.
    void checkFrames() const
    {
        const auto check_pattern = [&](const char* name, const NumberedPath& pattern) {
            const auto clash = [&](const char* other, const std::optional<std::string>& path) {
                const auto number = path && !isStream(*path) ? pattern.numberOf(*path) : std::nullopt;
                if (number && *number >= 1 && *number <= frames_) {
                    refuse(std::string(name) + " and " + other + " are the same, '" + *path +
                           "'; they must be different files");
                }
            };
            clash("--background", options_.background);
            clash("--drive-cycle", options_.drive_cycle);
            clash("--surface", options_.surface);
            clash("--config", options_.config);
            clash("--droplets", options_.droplets);
            clash("--model", options_.model);
            clash("--json", options_.json);
            for (const std::size_t number : pattern.numbers()) {
                if (options_.output_options.no_clobber && number >= 1 && number <= frames_) {
                    droplet::checkWritable(pattern.at(number), options_.output_options);
                }
            }
        };
        if (options_.files) {
            check_pattern("OUTPUT", *options_.files);
        }
        if (options_.maps) {
            for (const char* map : kMaps) {
                check_pattern("--maps", *NumberedPath::of(mapPattern(*options_.maps, map), "--maps"));
            }
        }
    }

    [[nodiscard]] double speed() const { return parameters_.vehicle.speedAt(state_.time); }

    void goOn()
    {
        // Steps add up to seconds but for rounding.
        const auto second = [&] { return std::floor(state_.time + 1e-6); };
        const double before = second();
        state_ = droplet::step(std::move(state_), parameters_, step_);
        if (second() > before) {
            noteBalance();
        }
    }

    void noteBalance() { report_.balance.push_back(balanceRow(state_, speed())); }

    void travel()
    {
        ++travelled_frames_;
        const double time = options_.warm_up + static_cast<double>(travelled_frames_) / options_.frames_per_second;
        travelled_ += parameters_.vehicle.speedAt(time) / options_.frames_per_second;
    }

    /// Plays and draws all frames that are left.
    void run()
    {
        const auto second = static_cast<std::size_t>(std::max(std::llround(options_.frames_per_second), 1LL));
        for (; played_ < frames_; ++played_) {
            if (played_ > 0) {
                for (std::size_t k = 0; k < steps_; ++k) {
                    goOn();
                }
                travel();
            }
            if (table_) {
                table_->add(played_ + 1, state_);
            }
            if (scene_) {
                scene_->add(state_);
            }
            if (played_ >= drawn_before_ || !isThere(played_ + 1)) {
                draw();
            } else {
                background_->skip(1);
            }
            if (options_.files && played_ + 1 > drawn_before_ && (played_ + 1) % second == 0) {
                saving_.wait();
                writeCheckpoint(checkpointPath(*options_.files), {fingerprint_, played_ + 1, report_.balance, state_});
            }
            tellProgress();
        }
        saving_.wait();
        if (report_.balance.empty() || report_.balance.back().time != state_.time) {
            noteBalance();
        }
        report_.counts = state_.counts;
    }

    void draw()
    {
        const std::size_t number = played_ + 1;
        const bool is_shown = options_.files || options_.is_video || number == frames_;
        if (is_shown) {
            if (auto behind = background_->next(travelled_)) {
                view_->lookAt(*behind);
            }
            view_->show(state_);
        } else {
            background_->skip(1);
        }
        if (options_.is_video) {
            video_->add(view_->frame());
        } else if (is_shown) {
            layer_ = options_.layer ? view_->layer() : droplet::Layer();
            picture_ = options_.layer ? droplet::Picture() : view_->frame();
        }
        if (options_.files) {
            save([layer = std::move(layer_), picture = std::move(picture_), path = options_.files->at(number), this] {
                droplet::writeWhole(
                    path,
                    [&](std::ostream& out) {
                        if (options_.layer) {
                            writePng(layer, out, droplet::PngEffort::Fast);
                        } else {
                            writePng(picture, out, droplet::PngEffort::Fast);
                        }
                    },
                    options_.output_options);
            });
        }
        if (options_.maps) {
            const droplet::GlassMaps maps = glassMaps(parameters_.glass, state_, options_.map);
            const droplet::DeepPicture* const all[] = {&maps.normal, &maps.thickness, &maps.velocity};
            for (std::size_t k = 0; k < std::size(kMaps); ++k) {
                droplet::writeWhole(
                    mapPath(*options_.maps, number, kMaps[k]),
                    [&](std::ostream& out) { writePng(*all[k], out, droplet::PngEffort::Fast); },
                    options_.output_options);
            }
        }
    }

    /// Saves a frame while the next one is made.
    template <typename Save>
    void save(Save work)
    {
        saving_.wait();
        saving_.run(std::move(work));
    }

    /// The video, or the picture of the last frame.
    void writeShown(std::ostream& out)
    {
        if (options_.is_video) {
            video_->finish(out);
        } else if (options_.layer) {
            writePng(layer_, out);
        } else {
            writePng(picture_, out);
        }
    }

    void finish()
    {
        report_.time_total = clock_.total();
        report_.peak_memory = peakMemory();
    }

    void tellProgress() const
    {
        if (!options_.quiet && errorIsTerminal()) {
            std::cerr << "\rframe " << played_ + 1 << " of " << frames_ << (played_ + 1 == frames_ ? "\n" : "")
                      << std::flush;
        }
    }

    const WindshieldOptions& options_;
    droplet::WindshieldParameters parameters_;
    StageClock clock_;
    double duration_ = 0.0;
    std::size_t frames_ = 0;
    std::size_t steps_ = 1;  ///< for each frame
    double step_ = 0.0;      ///< [s]
    std::string codec_;
    std::string fingerprint_;
    std::unique_ptr<Background> background_;
    std::unique_ptr<droplet::DriversView> view_;
    std::unique_ptr<VideoWriter> video_;
    std::optional<droplet::DropletTable> table_;
    std::optional<droplet::DropletScene> scene_;
    droplet::WindshieldState state_;
    std::size_t played_ = 0;        ///< frames
    std::size_t drawn_before_ = 0;  ///< frames that an interrupted run left
    std::size_t travelled_frames_ = 0;
    double travelled_ = 0.0;  ///< since the first frame [m]
    droplet::Picture picture_;
    droplet::Layer layer_;
    droplet::WindshieldReport report_;
    tbb::task_group saving_;
};

std::string litres(double volume)
{
    std::ostringstream text;
    text << std::setprecision(4) << volume / 1e-6 << " mL";
    return text.str();
}

void tell(const droplet::WindshieldReport& report)
{
    const droplet::BalanceRow& last = report.balance.back();
    const droplet::WaterBalance& water = last.balance;
    std::ostringstream text;
    text << report.frames << (report.frames == 1 ? " frame" : " frames") << "; at " << std::setprecision(4) << last.time
         << " s " << last.still << " still droplets, " << last.running << " larger, of which " << last.moving
         << " move\n"
         << "water: " << litres(water.rained) << " rained = " << litres(water.on_glass_still + water.on_glass_running)
         << " on the glass + " << litres(water.left) << " left + " << litres(water.wiped) << " wiped\n"
         << report.output << "\n";
    std::cerr << text.str();
    for (const std::string& warning : report.warnings) {
        std::cerr << paint("warning: ", Colour::Yellow) << oneLine(warning) << "\n";
    }
    std::cerr << std::flush;
}

}  // namespace

int runWindshield(int argc, const char* const* argv)
{
    const auto parsed = parseWindshield(argc, argv);
    if (const auto* text = std::get_if<std::string>(&parsed)) {
        print(*text);
        return 0;
    }
    const auto& options = std::get<WindshieldOptions>(parsed);
    check(options);
    std::optional<tbb::global_control> threads;
    if (options.threads) {
        threads.emplace(tbb::global_control::max_allowed_parallelism, *options.threads);
    }
    const droplet::WindshieldReport report = Windshield(options).play();
    if (!options.quiet) {
        tell(report);
    }
    return 0;
}

}  // namespace cli
