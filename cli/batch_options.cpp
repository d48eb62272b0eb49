// SPDX-License-Identifier: GPL-3.0-or-later
#include "batch_options.h"

#include <charconv>
#include <filesystem>
#include <set>
#include <string_view>

#include "droplet/io/read_surface.h"
#include "option_values.h"
#include "path_separators.h"
#include "preview.h"

namespace cli {
namespace {

namespace fs = std::filesystem;

/// Parses a shard such as `2/8`.
BatchShard shardOf(const Given& given)
{
    constexpr std::size_t kMax = 1'000'000;
    const auto number = [](std::string_view digits) {
        std::size_t value = 0;
        const auto [end, failure] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
        return failure == std::errc{} && end == digits.data() + digits.size() ? value : 0;
    };
    const std::string_view text = given.text;
    const auto slash = text.find('/');
    const BatchShard shard{number(text.substr(0, slash)),
                           slash == std::string_view::npos ? 0 : number(text.substr(slash + 1))};
    if (shard.index < 1 || shard.index > shard.count || shard.count > kMax) {
        refuse(given, "a share and the number of shares, such as 2/8");
    }
    return shard;
}

/// Path with the shard in the file's name.
std::string ofShard(fs::path path, const std::optional<BatchShard>& shard)
{
    if (shard) {
        path.replace_filename(path.stem().string() + "-" + std::to_string(shard->index) + "-of-" +
                              std::to_string(shard->count) + path.extension().string());
    }
    return path.string();
}

/// Path of the manifest in the common folder of all outputs.
fs::path manifestBeside(const std::string& output_pattern)
{
    const std::string fixed = output_pattern.substr(0, output_pattern.find_first_of("{%"));
    return fs::path(fixed.substr(0, fixed.find_last_of(kPathSeparators.data()) + 1)) / "manifest.json";
}

std::vector<std::pair<std::string, std::string>> decisiveOptions(const CommandLine& line)
{
    static const std::set<std::string> others{
        "--config",    "--help",    "--json",     "--keep-going",    "--manifest",   "--no-clobber",
        "--no-resume", "--output",  "--progress", "--quiet",         "--recursive",  "--shard",
        "--threads",   "--verbose", "--version",  "--contact-sheet", "--same-scale", "--mask-out"};
    std::vector<std::pair<std::string, std::string>> decisive;
    for (const auto& [name, value] : line.given()) {
        if (others.count(name) == 0) {
            decisive.emplace_back(name.substr(2), value);
        }
    }
    return decisive;
}

}  // namespace

void declareBatch(CommandLine& line)
{
    constexpr const char* kGroup = "Batch";
    line.addFlag(kGroup, "--keep-going", "Continue after an item that failed");
    line.addFlag(kGroup, "--no-resume", "Make again what is up to date");
    line.add(kGroup, "--shard", "SHARE", "Make one share of the items: 2/8 makes every 8th, beginning with the second");
    line.add(kGroup, "--manifest", "FILE",
             "File that lists the result of every item, as JSON [manifest.json in the folder of all outputs]");
    line.add(kGroup, "--contact-sheet", "FILE", "Draw all droplets on one PNG, each with its name");
    line.addFlag(kGroup, "--same-scale,--one-scale",
                 "Draw all droplets on the contact sheet at one scale; otherwise each fills its place");
}

BatchOptions readBatch(const CommandLine& line, const RunOptions& run, const std::string& output_pattern)
{
    BatchOptions options;
    options.keep_going = line.flag("--keep-going");
    options.resume = !line.flag("--no-resume");
    if (const auto shard = line.value("--shard")) {
        options.shard = shardOf(*shard);
    }
    const auto manifest = line.value("--manifest");
    options.manifest = ofShard(manifest ? fs::path(manifest->text) : manifestBeside(output_pattern), options.shard);
    if (line.flag("--same-scale") && !line.value("--contact-sheet")) {
        refuse("--same-scale needs --contact-sheet");
    }
    if (const auto sheet = line.value("--contact-sheet")) {
        requireRenderer("--contact-sheet");
        if (fs::path(sheet->text).extension() != ".png") {
            refuse(*sheet, "a file that ends in .png");
        }
        options.contact_sheet = ofShard(sheet->text, options.shard);
        options.one_scale = line.flag("--same-scale");
        const auto format = line.value("--format");
        if (format && fs::path(output_pattern).extension() != "." + format->text) {
            refuse("--contact-sheet reads droplets by their extension: --output must end in ." + format->text);
        }
        forOption("--contact-sheet", [&] { return droplet::readableFormat(output_pattern); });
    }
    options.decisive = decisiveOptions(line);
    options.files = run.files;
    options.threads = run.threads;
    options.terms = run.terms;
    options.verbosity = run.verbosity;
    options.progress = run.progress;
    return options;
}

}  // namespace cli
