// SPDX-License-Identifier: GPL-3.0-or-later
#include "windshield_live.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <iterator>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "droplet/io/base64.h"
#include "droplet/io/object.h"
#include "files.h"
#include "option_values.h"
#include "this_process.h"
#include "windshield_plan.h"

namespace cli {
namespace {

namespace fs = std::filesystem;

/// Options that the page begins with, and those of every run.
constexpr std::array<std::string_view, 32> kKnown{"--live",
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
                                                  "--surface",
                                                  "--hysteresis",
                                                  "--still-diameter",
                                                  "--splashes",
                                                  "--film",
                                                  "--runoff",
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

/// Numbers of 32 bits, the lowest byte first, as a JSON text in base64.
template <typename Number>
std::string packed(const std::vector<Number>& numbers)
{
    static_assert(sizeof(Number) == sizeof(std::uint32_t));
    std::string bytes;
    for (const Number number : numbers) {
        const auto word = std::bit_cast<std::uint32_t>(number);
        for (int shift = 0; shift < 32; shift += 8) {
            bytes += static_cast<char>(word >> shift);
        }
    }
    return '"' + droplet::base64(bytes) + '"';
}

/// Mesh of the glass, for the page.
std::string valuesOf(const droplet::TexturedMesh& glass)
{
    std::vector<float> positions;
    std::vector<float> normals;
    std::vector<float> uvs;
    const auto add = [](std::vector<float>& list, std::initializer_list<double> numbers) {
        std::transform(numbers.begin(), numbers.end(), std::back_inserter(list),
                       [](double number) { return static_cast<float>(number); });
    };
    for (std::size_t k = 0; k < glass.vertices.size(); ++k) {
        const auto& [x, y, z] = glass.vertices[k];
        const auto& [nx, ny, nz] = glass.normals[k];
        add(positions, {x, y, z});
        add(normals, {nx, ny, nz});
        add(uvs, {glass.uvs[k].x, glass.uvs[k].y});
    }
    std::vector<std::uint32_t> indices;
    for (const droplet::Triangle& triangle : glass.triangles) {
        indices.insert(indices.end(), triangle.begin(), triangle.end());
    }
    return fmt::format(R"({{"positions":{},"normals":{},"uvs":{},"indices":{}}})", packed(positions), packed(normals),
                       packed(uvs), packed(indices));
}

/// Where the page was installed or built, relative to this program.
fs::path pageOfRain()
{
    return (programFile().parent_path() / DROPLET_RAIN_PAGE).lexically_normal();
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
        R"("hysteresis":{},"stillDiameter":{},"film":{},"runoff":{},"splashes":{},"contactAngle":{},"viscosityFactor":{},)"
        R"("kineticFraction":{},"gravity":{})",
        options.preset, p.vehicle.speedAt(0.0), p.rainfall, p.mist, p.fluctuation.acceleration,
        options.wiper.value_or(0.0), p.seed, wetting.hysteresis, p.still_diameter, p.streaks.film, p.runoff,
        p.splashes ? 1 : 0, wetting.contact_angle, wetting.viscosity_factor, wetting.kinetic_fraction,
        p.forces.gravity);
    if (options.surface) {
        text += R"(},"surface":)" + valuesOf(droplet::readObject(*options.surface));
    } else {
        const droplet::Glass::Cylinder& glass = options.cylinder;
        text += fmt::format(R"(,"glassWidth":{},"glassHeight":{},"glassRadius":{},"slope":{}}})", glass.width,
                            glass.height, glass.radius, glass.slope);
    }
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
            refuse("--live and " + name + " exclude each other: the page has no use for it");
        }
    }
}

RunFiles filesOfLive(const WindshieldOptions& options)
{
    RunFiles files;
    files.reads("the page of the rain", pageOfRain().string());
    files.reads("--background", options.background);
    files.reads("--surface", options.surface);
    files.reads("--config", options.run.config);
    files.writes("--live", options.live->path);
    return files;
}

RunEnd writeLive(const WindshieldOptions& options)
{
    const WindshieldPlan plan = planOf(options);
    constexpr std::string_view kGap = "{{values}}";
    std::string text = templateFrom(pageOfRain());
    text.replace(text.find(kGap), kGap.size(), valuesOf(options));
    writeTogether({{options.live->path, [&](std::ostream& out) { out << text; }}}, options.run.files);
    return {{}, plan.warnings};
}

}  // namespace cli
