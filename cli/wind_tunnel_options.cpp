// SPDX-License-Identifier: GPL-3.0-or-later
#include "wind_tunnel_options.h"

#include <algorithm>
#include <filesystem>
#include <tuple>
#include <utility>

#include "command_line.h"
#include "common_options.h"
#include "droplet/wind_io/chart.h"
#include "files.h"
#include "force_options.h"
#include "option_values.h"
#include "value_list.h"

namespace cli {
namespace {

using droplet::Dimension;

constexpr Range kVolume{Dimension::Volume, 1e-15, 1e-3, "from 0.001nL to 1L"};
constexpr Range kWind{Dimension::Speed, 0.0, 300.0, "from 0m/s to 300m/s"};
constexpr Range kSlope{Dimension::Angle, 0.0, 90.0 * droplet::kDegree, "from 0deg to 90deg"};
constexpr Range kTime{Dimension::Duration, 1e-6, 86400.0, "from 0.001ms to 24h"};
constexpr Range kSpeed{Dimension::Speed, -100.0, 100.0, "from -100m/s to 100m/s"};
constexpr NumberRange kHysteresis{0.0, 2.0, "numbers from 0 to 2"};

const CommandText& commandText()
{
    static const CommandText text{"droplet-shape wind-tunnel", "compute how droplets move on a slope in the wind",
                                  "[OPTIONS] [OUTPUT...]",
                                  "Every volume is combined with every wind, slope and hysteresis. A LIST is\n"
                                  "10,20,30uL, or a range with a step: 10..100uL:10, 0..16m/s:0.25; a unit at the\n"
                                  "end applies to all its numbers.\n"
                                  "\n"
                                  "Quantities carry a unit:\n"
                                  "  volumes nL uL mL L mm3 cm3 m3; speeds mm/s m/s km/h mph; angles deg rad;\n"
                                  "  times ms s min h; lengths nm um mm cm m in; viscosity mPa.s Pa.s;\n"
                                  "  surface tension mN/m N/m dyn/cm; density kg/m3 g/cm3 g/mL;\n"
                                  "  acceleration m/s2 mm/s2 g\n"
                                  "\n"
                                  "Examples:\n"
                                  "  droplet-shape wind-tunnel --preset hashimoto plane.csv --chart plane.svg\n"
                                  "  droplet-shape wind-tunnel --volume 1..100uL:1 --slope 30,45deg --map map.png\n"
                                  "  droplet-shape wind-tunnel --volume 30uL --wind-speed 9m/s --gust 2m/s \\\n"
                                  "      --trace a.csv\n"
                                  "\n"
                                  "Exit codes:\n"
                                  "  0 done; 1 internal error; 2 usage; 4 output cannot be written"};
    return text;
}

void declare(CommandLine& line, WindTunnelOptions& options, droplet::ForceModel& model)
{
    line.addArguments("OUTPUT", "Table, .csv or .json, or chart, .svg or .png; - is a table on standard output");
    constexpr const char* kSweep = "Sweep";
    line.add(kSweep, "--preset", "hashimoto|thesis|thesis,hashimoto",
             "Named set of default values: hashimoto, a measured plane; thesis, fitted to it; or both side by side "
             "[hashimoto]");
    line.add(kSweep, "--volume", "VOLUMES", "Volumes of the droplets [by preset]", within(kVolume));
    line.add(kSweep, "--wind-speed,--wind", "SPEEDS", "Wind speeds, up the slope and along it [0..16m/s:0.25]",
             within(kWind));
    line.add(kSweep, "--slope", "ANGLES", "Slopes of the ground, from horizontal [35deg]", within(kSlope));
    line.add(kSweep, "--hysteresis", "NUMBERS",
             "Contact angle hysteresis: cosine of the receding minus cosine of the advancing angle [by preset]",
             within(kHysteresis.min, kHysteresis.max));
    line.add(kSweep, "--sliding-angle,--falling-angle", "ANGLE",
             "Hysteresis, by the slope at which a droplet begins to run", within(kSlope));
    line.add(kSweep, "--sliding-volume,--falling-volume", "V|every",
             "Volume of the droplet that runs at --sliding-angle; every: all of them do [30uL]", within(kVolume));
    declareForces(line, model);
    constexpr const char* kOut = "Charts and series";
    line.add(kOut, "--chart", "FILE",
             "Draw the acceleration at rest against the wind, a curve for each volume: .svg or .png");
    line.add(kOut, "--map", "FILE", "Draw what droplets do at each wind and volume: .svg or .png");
    line.add(
        kOut, "--measured", "BAND",
        "Measured range of winds in which droplets stay, drawn beside the results [7..11m/s for unchanged presets]");
    line.add(kOut, "--trace", "FILE", "Write the motion of one droplet over time: .csv or .json");
    line.add(kOut, "--time", "TIME", "Duration of the trace", into(options.trace.duration, kTime));
    line.add(kOut, "--trace-step", "TIME", "Time between two lines of the trace", into(options.trace.interval, kTime));
    line.add(kOut, "--initial-speed", "SPEED", "Speed at the start, up the slope; negative is down",
             into(options.trace.velocity, kSpeed));
    line.add(kOut, "--gust", "SPEED", "Amplitude of the wind's gusts", into(options.gust.amplitude, kWind));
    line.add(kOut, "--gust-period", "TIME", "Time from one gust to the next", into(options.gust.period, kTime));
    constexpr const char* kRun = "Run";
    line.add(kRun, "--json", "FILE", "Write all results as JSON; - is standard output");
    line.addFlag(kRun, "--no-clobber", "Do not replace existing files", options.files.no_clobber);
    declareCommon(line, kRun, "slope = \"45deg\"");
    line.exclude({"--hysteresis", "--sliding-angle"});
}

std::string extensionOf(const std::string& path)
{
    return std::filesystem::path(path).extension().string();
}

void readOutputs(const CommandLine& line, WindTunnelOptions& options)
{
    const auto add = [&](const Given& given, std::initializer_list<std::pair<const char*, TunnelFile>> kinds) {
        std::string known;
        for (const auto& [extension, kind] : kinds) {
            if (extensionOf(given.text) == extension) {
                options.outputs.push_back({given.subject, given.text, kind});
                return;
            }
            known += std::string(known.empty() ? "" : ", ") + extension;
        }
        refuse(given, "a name that ends in one of " + known);
    };
    for (const Given& given : line.values("OUTPUT")) {
        if (isStream(given.text)) {
            options.outputs.push_back({given.subject, given.text, TunnelFile::Csv});
            continue;
        }
        add(given, {{".csv", TunnelFile::Csv},
                    {".json", TunnelFile::Json},
                    {".svg", TunnelFile::ChartSvg},
                    {".png", TunnelFile::ChartPng}});
    }
    if (const auto json = line.value("--json")) {
        options.outputs.push_back({"--json", json->text, TunnelFile::Json});
    }
    if (const auto chart = line.value("--chart")) {
        add(*chart, {{".svg", TunnelFile::ChartSvg}, {".png", TunnelFile::ChartPng}});
    }
    if (const auto map = line.value("--map")) {
        add(*map, {{".svg", TunnelFile::MapSvg}, {".png", TunnelFile::MapPng}});
    }
    if (const auto trace = line.value("--trace")) {
        options.traces = true;
        if (isStream(trace->text)) {
            options.outputs.push_back({"--trace", trace->text, TunnelFile::TraceCsv});
        } else {
            add(*trace, {{".csv", TunnelFile::TraceCsv}, {".json", TunnelFile::TraceJson}});
        }
    }
}

void checkTrace(const CommandLine& line, const WindTunnelOptions& options)
{
    for (const char* option : {"--time", "--trace-step", "--initial-speed", "--gust", "--gust-period"}) {
        if (line.value(option) && !options.traces) {
            refuse(std::string(option) + " needs --trace");
        }
    }
    if (options.gust.amplitude > 0.0 && options.trace.duration / options.gust.period > droplet::kMaxGusts) {
        refuse("--gust-period: too short; --time must be at most 100000 periods");
    }
    if (options.traces &&
        options.trace.duration / options.trace.interval > static_cast<double>(droplet::kMaxMotionPoints)) {
        refuse("--trace-step: too short; --time must be at most " + std::to_string(droplet::kMaxMotionPoints) +
               " steps");
    }
}

/// Whether a sweep is of the measured plane, so that results can be compared with the measurement.
bool isAsMeasured(const droplet::TunnelSweep& swept, const droplet::ForcePreset& preset)
{
    const auto of = [](const droplet::ForceModel& model) {
        return std::tie(model.liquid, model.air, model.wetting.contact_angle, model.gravity);
    };
    return of(swept.model) == of(preset.model) && swept.slopes == std::vector{preset.slope} && swept.hystereses.empty();
}

/// Band of --measured.
droplet::WindBand measuredBand(const Given& given)
{
    const std::string allowed = "two wind speeds, such as 7..11m/s, the first over 0m/s, the second larger";
    const auto dots = given.text.find("..");
    if (dots == std::string::npos || given.text.find(',') != std::string::npos) {
        refuse(given, allowed);
    }
    const std::string list = given.text.substr(0, dots) + "," + given.text.substr(dots + 2);
    const std::vector<double> winds = quantities({list, given.subject}, kWind);
    if (winds.size() != 2 || !(winds[0] > 0.0) || !(winds[1] > winds[0])) {
        refuse(given, allowed);
    }
    return droplet::WindBand{winds[0], winds[1]};
}

void readFallingAngle(const CommandLine& line, droplet::TunnelRun& run)
{
    const auto volume = line.value("--sliding-volume");
    const auto angle = line.value("--sliding-angle");
    if (volume && !angle) {
        refuse("--sliding-volume needs --sliding-angle");
    }
    if (!angle) {
        return;
    }
    droplet::ForceModel& model = run.swept.model;
    const double slope = quantity(*angle, kSlope);
    if (volume && volume->text == "every") {
        model.wetting.sliding_angle = slope;
        run.sliding_angle.reset();
        return;
    }
    run.sliding_angle = slope;
    run.sliding_volume = 30e-9;
    if (volume) {
        run.sliding_volume =
            quantity(*volume, {kVolume.dimension, kVolume.min, kVolume.max, "from 0.001nL to 1L, or every"});
    }
    model.wetting.hysteresis = droplet::hysteresisOf(model, slope, *run.sliding_volume);
    if (model.wetting.hysteresis > 2.0) {
        refuse(*angle,
               "less steep, or --sliding-volume smaller: no contact angles can hold this droplet on this slope");
    }
}

/// @param model  the variable of the declared options
droplet::TunnelRun runOf(const CommandLine& line, const droplet::ForcePreset& preset, droplet::ForceModel& model)
{
    model = preset.model;
    line.read();
    readForces(line, model);
    droplet::TunnelRun run;
    run.preset = preset.name;
    droplet::TunnelSweep& swept = run.swept;
    swept.model = model;
    swept.volumes = preset.volumes;
    if (const auto volumes = line.value("--volume")) {
        swept.volumes = quantities(*volumes, kVolume);
    }
    swept.winds = quantities(line.value("--wind-speed").value_or(Given{"0..16m/s:0.25", "--wind-speed"}), kWind);
    swept.slopes = {preset.slope};
    if (const auto slopes = line.value("--slope")) {
        swept.slopes = quantities(*slopes, kSlope);
    }
    if (const auto hystereses = line.value("--hysteresis")) {
        swept.hystereses = numbers(*hystereses, kHysteresis);
    }
    const bool is_as_measured = isAsMeasured(swept, preset) && !line.value("--sliding-angle");
    if (preset.sliding_angle && is_as_measured) {
        run.sliding_angle = preset.sliding_angle;
        run.sliding_volume = preset.reference_volume;
    }
    readFallingAngle(line, run);
    if (const auto measured = line.value("--measured")) {
        run.measured = measuredBand(*measured);
    } else if (is_as_measured) {
        run.measured = droplet::kMeasuredStillBand;
    }
    return run;
}

std::vector<droplet::TunnelRun> readRuns(const CommandLine& line, droplet::ForceModel& model)
{
    const Given given = line.value("--preset").value_or(Given{"hashimoto", "--preset"});
    std::vector<droplet::TunnelRun> runs;
    std::string rest = given.text;
    for (bool more = true; more;) {
        const auto comma = rest.find(',');
        const std::string name = rest.substr(0, comma);
        const auto& preset =
            forOption(given.subject, [&]() -> const droplet::ForcePreset& { return droplet::forcePresetNamed(name); });
        if (std::any_of(runs.begin(), runs.end(), [&](const auto& run) { return run.preset == name; })) {
            refuse(given, "a list without repeated presets");
        }
        runs.push_back(runOf(line, preset, model));
        more = comma != std::string::npos;
        rest = more ? rest.substr(comma + 1) : "";
    }
    return runs;
}

/// Refuses what the library would refuse, with the names of the options.
void check(const WindTunnelOptions& options)
{
    for (const droplet::TunnelRun& run : options.runs) {
        const droplet::TunnelSweep& swept = run.swept;
        const std::size_t hystereses = std::max<std::size_t>(1, swept.hystereses.size());
        double rows = static_cast<double>(hystereses);
        const std::pair<const char*, std::size_t> lists[] = {{"--volume", swept.volumes.size()},
                                                             {"--wind-speed", swept.winds.size()},
                                                             {"--slope", swept.slopes.size()},
                                                             {"--hysteresis", hystereses}};
        for (const std::size_t count : {swept.volumes.size(), swept.winds.size(), swept.slopes.size()}) {
            rows *= static_cast<double>(count);
        }
        if (rows > static_cast<double>(droplet::kMaxTunnelRows)) {
            refuse("--volume, --wind-speed, --slope and --hysteresis make " +
                   std::to_string(static_cast<long long>(rows)) + " combinations, more than " +
                   std::to_string(droplet::kMaxTunnelRows));
        }
        for (const auto& [option, count] : lists) {
            if (options.traces && count > 1) {
                refuse("--trace follows one droplet: " + std::string(option) + " must be one value, not " +
                       std::to_string(count));
            }
        }
        const bool draws = std::any_of(options.outputs.begin(), options.outputs.end(), [](const TunnelOutput& output) {
            return output.kind == TunnelFile::ChartSvg || output.kind == TunnelFile::ChartPng ||
                   output.kind == TunnelFile::MapSvg || output.kind == TunnelFile::MapPng;
        });
        if (draws && swept.slopes.size() * hystereses > droplet::kMaxPanels) {
            refuse("charts have a panel for each --slope with each --hysteresis, at most " +
                   std::to_string(droplet::kMaxPanels) + ", not " + std::to_string(swept.slopes.size() * hystereses));
        }
    }
    if (options.traces && options.runs.size() > 1) {
        refuse("--trace follows one droplet: --preset must be one value");
    }
}

}  // namespace

std::variant<WindTunnelOptions, std::string> parseWindTunnel(int argc, const char* const* argv)
{
    CommandLine line(commandText());
    WindTunnelOptions options;
    droplet::ForceModel model;
    declare(line, options, model);
    line.parse(argc, argv);
    if (const auto text = requestedText(line)) {
        return *text;
    }
    readOutputs(line, options);
    options.runs = readRuns(line, model);
    checkTrace(line, options);
    options.gust.mean = options.runs.front().swept.winds.front();
    if (const auto config = line.value("--config")) {
        options.config = config->text;
    }
    options.threads = readThreads(line);
    options.quiet = line.flag("--quiet");
    options.terms = line.terms();
    check(options);
    return options;
}

}  // namespace cli
