// SPDX-License-Identifier: GPL-3.0-or-later
#include "common_options.h"

#include "droplet/version.h"
#include "option_values.h"

namespace cli {

void declareCommon(CommandLine& line, const char* group, const std::string& example)
{
    line.add(group, "-j,--threads", "N", "Maximum number of threads [all cores]");
    line.addFlag(group, "-q,--quiet", "Print only errors");
    line.add(group, "--config", "FILE",
             "Read options from a TOML file with lines such as " + example + "; the command line takes precedence");
    line.addFlag(group, "-h,--help", "Print this help");
    line.addFlag(group, "--version", "Print the version");
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

std::optional<std::string> requestedText(const CommandLine& line)
{
    if (line.flag("--help")) {
        return line.help();
    }
    if (line.flag("--version")) {
        return "droplet-shape " + std::string(droplet::kVersion) + "\n";
    }
    return std::nullopt;
}

std::optional<std::size_t> readThreads(const CommandLine& line)
{
    constexpr std::size_t kMaxThreads = 1024;  // more than any machine this runs on
    const auto threads = line.value("--threads");
    return threads ? std::optional(count(*threads, kMaxThreads, "1024")) : std::nullopt;
}

}  // namespace cli
