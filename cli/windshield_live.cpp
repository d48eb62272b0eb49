// SPDX-License-Identifier: GPL-3.0-or-later
#include "windshield_live.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

#include "droplet/io/base64.h"
#include "files.h"
#include "option_values.h"
#include "run_files.h"
#include "this_process.h"

namespace cli {
namespace {

namespace fs = std::filesystem;

/// Options that the page begins with, and those of every run.
constexpr std::array<std::string_view, 30> kKnown{"--live",
                                                  "--preset",
                                                  "--rain",
                                                  "--mist",
                                                  "--speed",
                                                  "--noise",
                                                  "--wiper-period",
                                                  "--seed",
                                                  "--glass-width",
                                                  "--glass-height",
                                                  "--glass-radius",
                                                  "--slope",
                                                  "--hysteresis",
                                                  "--still-diameter",
                                                  "--splashes",
                                                  "--film",
                                                  "--contact-angle",
                                                  "--viscosity-factor",
                                                  "--kinetic-fraction",
                                                  "--gravity",
                                                  "--warm-up",
                                                  "--background",
                                                  "--background-blur",
                                                  "--field-of-view",
                                                  "--eye-distance",
                                                  "--no-clobber",
                                                  "--config",
                                                  "--progress",
                                                  "--threads",
                                                  "--quiet"};

/// Picture as a URL of data.
std::string urlOf(const std::string& path)
{
    const std::string bytes = textOf(path);
    const std::string_view all = bytes;
    const char* const type = all.starts_with("\x89PNG")                              ? "png"
                             : all.starts_with("\xff\xd8\xff")                       ? "jpeg"
                             : all.starts_with("RIFF") && all.substr(8, 4) == "WEBP" ? "webp"
                             : all.starts_with("GIF8")                               ? "gif"
                                                                                     : nullptr;
    if (type == nullptr) {
        refuse(Given{path, "--background"}, "a PNG, JPEG, WebP or GIF with --live; drop videos on the page");
    }
    return fmt::format("data:image/{};base64,{}", type, droplet::base64(bytes));
}

/// The page with a gap for its values.
std::string templateFrom(const fs::path& page)
{
    std::error_code unknown;
    if (!fs::exists(page, unknown)) {
        refuse("--live is not available: " + page.string() +
               " does not exist, because the program was built without DROPLET_STUDIO");
    }
    return textOf(page.string());
}

std::string valuesOf(const WindshieldOptions& options)
{
    const droplet::WindshieldParameters& p = options.parameters;
    const droplet::Wetting& wetting = p.forces.wetting;
    std::string text = fmt::format(
        R"({{"preset":"{}","parameters":{{"speed":{},"rain":{},"mist":{},"noise":{},"wiperPeriod":{},"seed":{},)"
        R"("glassWidth":{},"glassHeight":{},"glassRadius":{},"slope":{},"hysteresis":{},"stillDiameter":{},"film":{},)"
        R"("splashes":{},"contactAngle":{},"viscosityFactor":{},"kineticFraction":{},"gravity":{}}})",
        options.preset, p.vehicle.speedAt(0.0), p.rainfall, p.mist, p.fluctuation.acceleration,
        options.wiper.value_or(0.0), p.seed, options.cylinder.width, options.cylinder.height, options.cylinder.radius,
        options.cylinder.slope, wetting.hysteresis, p.still_diameter, p.streaks.film, p.splashes ? 1 : 0,
        wetting.contact_angle, wetting.viscosity_factor, wetting.kinetic_fraction, p.forces.gravity);
    const auto add = [&](const char* option, const char* name, double value) {
        if (options.live->given.contains(option)) {
            text += fmt::format(R"(,"{}":{})", name, value);
        }
    };
    add("--warm-up", "warm_up", options.warm_up);
    add("--eye-distance", "eye_distance", options.view.eye_distance);
    add("--field-of-view", "field_of_view", options.view.field_of_view);
    add("--background-blur", "background_blur", options.view.background_blur);
    if (options.background) {
        text += fmt::format(R"(,"background":"{}")", urlOf(*options.background));
    }
    return text + "}";
}

}  // namespace

void checkLive(const CommandLine& line)
{
    if (!line.values("OUTPUT").empty()) {
        refuse("--live and OUTPUT exclude each other: the page is the output");
    }
    for (const auto& [name, value] : line.given()) {
        if (std::find(kKnown.begin(), kKnown.end(), name) == kKnown.end()) {
            refuse("--live and " + name + " exclude each other: " +
                   (name == "--surface" ? "the glass of the page is always bent as a cylinder"
                                        : "the page has no use for it"));
        }
    }
}

void writeLive(const WindshieldOptions& options)
{
    // Where it was installed or built, relative to this program.
    const fs::path page = (programFile().parent_path() / DROPLET_RAIN_PAGE).lexically_normal();
    const std::string& path = options.live->path;
    RunFiles files;
    files.reads("the page of the rain", page.string());
    files.reads("--background", options.background);
    files.reads("--config", options.run.config);
    files.writes("--live", path);
    checkFiles(files, options.run.files);
    constexpr std::string_view kGap = "{{values}}";
    std::string text = templateFrom(page);
    text.replace(text.find(kGap), kGap.size(), valuesOf(options));
    writeTogether({{path, [&](std::ostream& out) { out << text; }}}, options.run.files);
}

}  // namespace cli
