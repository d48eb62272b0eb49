// SPDX-License-Identifier: GPL-3.0-or-later
#include "common_options.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "droplet/version.h"
#include "option_values.h"

namespace cli {

void declareCommon(CommandLine& line, const char* group, const std::string& example)
{
    line.add(group, "-j,--threads", "N", "Maximum number of threads [all cores]", within(1, kMaxThreads));
    line.addFlag(group, "-q,--quiet", "Print only errors");
    line.add(group, "--config", "FILE",
             "Read options from a TOML file with lines such as " + example + "; the command line takes precedence");
    line.addFlag(group, "-h,--help", "Print this help; --help=json prints it for programs");
    line.addFlag(group, "--version", "Print the version");
}

void declareStageProgress(CommandLine& line, const char* group, const std::string& percents)
{
    line.add(group, "--progress", "auto|none|json",
             "auto shows a bar on a terminal; json writes a line of JSON for each stage, and for each percent " +
                 percents + ", instead of the summary [auto]");
}

void declareFrameProgress(CommandLine& line, const char* group)
{
    line.add(group, "--progress", "auto|none|json",
             "auto shows a bar on a terminal; json writes a line of JSON for each frame instead of the summary [auto]");
}

void declareCompression(CommandLine& line, const char* group)
{
    line.add(group, "--compress", "none|quantize|meshopt",
             "Compress a .glb: quantize, integers of 16 bits (KHR_mesh_quantization), three quarters of the size; "
             "meshopt, those encoded (EXT_meshopt_compression), a third of the size [none]");
}

droplet::Compression readCompression(const CommandLine& line, droplet::Format format)
{
    using droplet::Compression;
    const auto given = line.value("--compress");
    if (!given) {
        return Compression::None;
    }
    const auto compression = choice<Compression>(
        *given, {{"none", Compression::None}, {"quantize", Compression::Quantize}, {"meshopt", Compression::Meshopt}});
    if (compression != Compression::None && format != droplet::Format::Glb) {
        refuse(std::string("--compress and the format ") + droplet::name(format) +
               " exclude each other: only glb can be compressed");
    }
    return compression;
}

void declareDropletsOnly(CommandLine& line, const char* group, const std::string& when)
{
    line.addFlag(group, "--droplets-only", when + "Leave the object out of a .glb, .gltf, .usda or .usdz");
}

bool hasObject(const CommandLine& line, droplet::Format format, const std::string& output)
{
    const bool is_left_out = line.flag("--droplets-only");
    if (is_left_out && !droplet::isAnimated(format)) {
        refuse("--droplets-only needs a .glb, .gltf, .usda or .usdz as OUTPUT, not '" + output + "'");
    }
    return droplet::isAnimated(format) && !is_left_out;
}

std::optional<std::string> requestedText(const CommandLine& line)
{
    if (auto help = line.requestedHelp()) {
        return help;
    }
    if (line.flag("--version")) {
        return "droplet-shape " + std::string(droplet::kVersion) + "\n";
    }
    return std::nullopt;
}

std::optional<std::size_t> readThreads(const CommandLine& line)
{
    const auto threads = line.value("--threads");
    return threads ? std::optional(count(*threads, {1, kMaxThreads, "1024"})) : std::nullopt;
}

RunOptions readRun(const CommandLine& line)
{
    const auto flag = [&](const char* name) { return line.knows(name) && line.flag(name); };
    RunOptions options;
    options.terms = line.terms();
    if (const auto config = line.value("--config")) {
        options.config = config->text;
    }
    options.files.no_clobber = flag("--no-clobber");
    options.threads = readThreads(line);
    options.verbosity = line.flag("--quiet") ? Verbosity::Quiet
                        : flag("--verbose")  ? Verbosity::Verbose
                                             : Verbosity::Normal;
    const auto progress = line.knows("--progress") ? line.value("--progress") : std::nullopt;
    if (progress) {
        options.progress = choice<ProgressMode>(
            *progress, {{"auto", ProgressMode::Auto}, {"none", ProgressMode::None}, {"json", ProgressMode::Json}});
    }
    return options;
}

ProgressMode RunOptions::shownProgress() const
{
    return verbosity == Verbosity::Quiet && progress == ProgressMode::Auto ? ProgressMode::None : progress;
}

std::string optionsOfFrames(const CommandLine& line, const std::string& output, const std::vector<std::string>& neutral)
{
    constexpr std::array<std::string_view, 8> kRun{"--time",  "--resume", "--no-clobber", "--threads",
                                                   "--quiet", "--config", "--json",       "--progress"};
    std::string text = std::string("droplet-shape ") + droplet::kVersion + "\n" + output;
    for (const auto& [name, value] : line.given()) {
        const bool is_neutral = std::find(kRun.begin(), kRun.end(), name) != kRun.end() ||
                                std::find(neutral.begin(), neutral.end(), name) != neutral.end();
        if (!is_neutral) {
            text.append("\n").append(name).append(" ").append(value);
        }
    }
    return text;
}

}  // namespace cli
