// SPDX-License-Identifier: GPL-3.0-or-later
#include "batch_command.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "batch_runner.h"
#include "common_options.h"
#include "content_hash.h"
#include "droplet/error.h"
#include "droplet/image/picture_format.h"
#include "files.h"
#include "library_message.h"
#include "option_values.h"
#include "output_pattern.h"
#include "shape_command.h"
#include "shape_options.h"
#include "surface_files.h"
#include "surroundings.h"

namespace cli {
namespace {

namespace fs = std::filesystem;

const CommandText& commandText()
{
    static const CommandText text{
        "droplet-shape batch", "make droplets from many pictures", "[OPTIONS] INPUT... -o OUTPUT",
        std::string("Placeholders in OUTPUT, --json, --mask-out and --seeds:\n"
                    "  {stem} is the picture's name without extension, {name} the whole name,\n"
                    "  {ext} the extension, {dir} its folder below INPUT, {parent} the name of its\n"
                    "  folder, {index} its number; {{ and }} are braces\n"
                    "\n") +
            kUnitsText +
            "\n"
            "Examples:\n"
            "  droplet-shape batch masks/*.png -o 'out/{stem}.glb'\n"
            "  droplet-shape batch masks --recursive -o 'out/{dir}/{stem}.glb' --keep-going\n"
            "  droplet-shape batch masks -o '{stem}.stl' --json '{stem}.json' --shard 2/8\n"
            "\n"
            "Exit codes:\n"
            "  0 all made; 1 internal error; 2 usage; 3 no pictures; 4 manifest cannot be\n"
            "  written; 6 some failed, and the manifest says which and why"};
    return text;
}

void declare(CommandLine& line, ShapeOptions& shared)
{
    line.addArguments("INPUT", "Pictures and folders of pictures");
    line.add("Batch", "-o,--output", "OUTPUT", "Pattern of the output files, such as 'out/{stem}.glb'");
    line.addFlag("Batch", "--recursive", "Read subfolders, too");
    line.add("Batch", "--json", "FILE", "Write a report for each picture, such as 'out/{stem}.json'");
    declareBatch(line);
    declareShapes(line, shared);
    declareSeeds(line, shared.footprint);
    declareMaskOut(line);
    declareRun(line);
}

/// Input picture and its folder.
struct Picture {
    fs::path path;
    fs::path below;  ///< its folder, relative to the folder on the command line
};

/// Whether a path looks like an output: it has a placeholder or the extension of a droplet's file.
bool namesDroplets(const std::string& path)
{
    if (path.find('{') != std::string::npos) {
        return true;
    }
    try {
        (void)droplet::formatNamed(fs::path(path).extension().string());
        return true;
    } catch (const droplet::Error&) {
        return false;
    }
}

/// Pictures to read, and what lies beside them.
struct Inputs {
    std::vector<Picture> pictures;
    std::vector<BatchLeftOut> left_out;
};

/// Whether a name is that of a droplet's file, or of a file that is written beside it.
bool isOutput(const std::string& name)
{
    const std::string extension = lowerExtension(name);
    return namesDroplets(name) || extension == ".json" || extension == ".mtl" || extension == ".bin" ||
           extension == ".html";
}

constexpr const char* kEndless = "it is a pipe, socket or device, not a file";

/// Whether reading a path may wait for ever, for somebody who writes into it.
bool isEndless(const fs::path& path)
{
    std::error_code ignored;
    return fs::is_other(path, ignored);
}

/// Adds the pictures of a folder in alphabetical order, then those of its subfolders. Hidden files and outputs are
/// ignored.
void addFolder(const fs::path& folder, const fs::path& below, bool recursive, Inputs& inputs)
{
    std::vector<fs::path> files;
    std::vector<fs::path> others;
    std::vector<fs::path> folders;
    try {
        for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
            const fs::path name = entry.path().filename();
            if (name.string().front() == '.') {
                continue;
            }
            if (entry.is_directory()) {
                if (recursive && !entry.is_symlink()) {
                    folders.push_back(name);
                }
            } else if (isEndless(entry.path())) {
                inputs.left_out.push_back({entry.path().generic_string(), kEndless});
            } else if (isPicture(name.string())) {
                files.push_back(name);
            } else if (!isOutput(name.string())) {
                others.push_back(name);
            }
        }
    } catch (const fs::filesystem_error& error) {
        throw droplet::Error(droplet::ErrorCode::InvalidInput,
                             folder.string() + " cannot be read: " + error.code().message());
    }
    std::sort(files.begin(), files.end());
    std::sort(others.begin(), others.end());
    std::sort(folders.begin(), folders.end());
    for (const fs::path& name : files) {
        inputs.pictures.push_back({folder / name, below});
    }
    for (const fs::path& name : others) {
        inputs.left_out.push_back(
            {(folder / name).generic_string(),
             droplet::whyNoPicture(folder / name).value_or("its name has no extension of pictures")});
    }
    for (const fs::path& name : folders) {
        addFolder(folder / name, below / name, recursive, inputs);
    }
}

Inputs readInputs(const CommandLine& line)
{
    Inputs inputs;
    std::vector<Picture>& pictures = inputs.pictures;
    for (const Given& given : line.values("INPUT")) {
        if (given.text.empty() || isStream(given.text)) {
            refuse(given, "a picture's file or a folder");
        }
        if (isEndless(given.text)) {
            refuse(given, "a picture's file or a folder; " + std::string(kEndless));
        }
        std::error_code ignored;
        if (!fs::is_directory(given.text, ignored)) {
            pictures.push_back({given.text, {}});
            continue;
        }
        const std::size_t before = pictures.size();
        addFolder(given.text, {}, line.flag("--recursive"), inputs);
        if (pictures.size() == before) {
            throw droplet::Error(droplet::ErrorCode::InvalidInput,
                                 given.text + " holds no pictures" +
                                     (line.flag("--recursive") ? "" : "; --recursive reads subfolders, too") +
                                     (inputs.left_out.empty() ? ""
                                                              : "; left out: " + inputs.left_out.front().name + ", " +
                                                                    inputs.left_out.front().reason));
        }
    }
    if (pictures.empty()) {
        refuse("INPUT is missing; usage: droplet-shape batch [OPTIONS] INPUT... -o OUTPUT, more with --help");
    }
    return inputs;
}

PatternValues valuesOf(const Picture& picture, std::size_t index, std::size_t count)
{
    const std::string number = std::to_string(index + 1);
    const std::string extension = picture.path.extension().string();
    const std::string parent = fs::absolute(picture.path).lexically_normal().parent_path().filename().string();
    return {{"stem", picture.path.stem().string()},
            {"name", picture.path.filename().string()},
            {"ext", extension.empty() ? "" : extension.substr(1)},
            {"dir", picture.below.empty() ? "." : picture.below.generic_string()},
            {"parent", parent},
            {"index", std::string(std::to_string(count).size() - number.size(), '0') + number}};
}

constexpr const char* kPlaceholders = "{stem}, {name}, {ext}, {dir}, {parent} or {index}";

/// Hash of everything that decides an output's bytes, except the picture.
std::string settingsFingerprint(const ShapeOptions& options, const BatchOptions& batch)
{
    std::vector<std::string> parts{droplet::name(options.format)};
    for (const auto& [name, value] : batch.decisive) {
        parts.push_back(name);
        parts.push_back(value);
    }
    for (const auto& path : {options.settings.ground.path, options.settings.onto}) {
        parts.push_back(hashOfFile(path));
    }
    if (const auto& materials = options.settings.materials) {
        parts.push_back(hashOfFile(materials->path));
    }
    return fingerprintOf(parts);
}

}  // namespace

int runBatch(int argc, const char* const* argv)
{
    CommandLine line(commandText());
    ShapeOptions shared;
    declare(line, shared);
    line.parse(argc, argv);
    if (const auto text = requestedText(line)) {
        print(*text);
        return 0;
    }
    const auto output = line.value("--output");
    if (!output || output->text.empty() || isStream(output->text)) {
        const std::vector<Given> inputs = line.values("INPUT");
        if (!output && !inputs.empty() && namesDroplets(inputs.back().text)) {
            refuse("--output is missing; did you mean -o '" + inputs.back().text + "'?");
        }
        refuse("--output is missing: give a path for each droplet, such as -o 'out/{stem}.glb'");
    }
    const auto report = line.value("--json");
    const auto mask = line.value("--mask-out");
    const auto seeds = line.value("--seeds");
    for (const auto& pattern : {mask, seeds}) {
        if (pattern && isStream(pattern->text)) {
            refuse(*pattern, "a path for each picture, such as 'strokes/{stem}.png'");
        }
    }
    line.read();
    shared.output = output->text;
    readShapes(line, shared, "--output");
    BatchOptions options = readBatch(line, shared.run, output->text);
    options.material = shared.settings.material;
    RunFiles read;
    addSettings(read, shared.settings, shared.run);
    options.read = read.read;
    Inputs inputs = readInputs(line);
    const std::vector<Picture>& pictures = inputs.pictures;
    options.left_out = std::move(inputs.left_out);
    Surroundings around;   // of all items; read once their files have been checked
    std::string settings;  // their fingerprint

    std::vector<BatchItem> items;
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        const PatternValues values = valuesOf(pictures[i], i, pictures.size());
        BatchItem item;
        item.name = pictures[i].path.generic_string();
        item.input = item.name;
        item.output = fillPattern(*output, values, kPlaceholders);
        if (report) {
            item.others.push_back(fillPattern(*report, values, kPlaceholders));
        }
        if (const auto material = materialFile(item.output, shared.format)) {
            item.others.push_back(*material);
        }
        for (std::string& level : levelPaths(item.output, shared.format, shared.settings.levels.size())) {
            item.others.push_back(std::move(level));
        }
        ShapeOptions job = shared;
        if (mask) {
            job.footprint.mask_out = fillPattern(*mask, values, kPlaceholders);
            item.others.push_back(*job.footprint.mask_out);
        }
        if (seeds) {
            job.footprint.seeds = fillPattern(*seeds, values, kPlaceholders);
            options.read.push_back({"--seeds", *job.footprint.seeds, {}, {}});
        }
        job.input = item.input;
        job.output = item.output;
        if (report) {
            job.json = item.others.front();
        }
        item.open = [job, &around, &settings] {
            auto picture = readPicture(job);
            BatchWork work;
            std::vector<std::string> parts{settings, hashOf(picture)};
            if (job.footprint.seeds) {
                parts.push_back(hashOfFile(job.footprint.seeds));
            }
            work.fingerprint = fingerprintOf(parts);
            // The picture's memory is released as soon as it is no longer needed.
            work.make = [&job, &around, picture = std::move(picture)]() mutable {
                return figuresOf(makeShape(job, around, std::move(picture)));
            };
            return work;
        };
        items.push_back(std::move(item));
    }
    checkItems(items, options);
    around = inTermsOf(shared.run.terms, read, [&] { return readSurroundings(shared.settings); });
    options.object = objectInFiles(shared.settings, around);
    settings = settingsFingerprint(shared, options);
    return makeAll(items, options);
}

}  // namespace cli
