// SPDX-License-Identifier: GPL-3.0-or-later
#include "windshield_files.h"

#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include "content_hash.h"
#include "files.h"
#include "option_values.h"

namespace cli {
namespace {

std::string beforeExtension(std::string path, const char* map)
{
    return path.insert(path.size() - std::string(".png").size(), std::string("-") + map);
}

/// Pattern of a map's paths, with the placeholder for the number.
std::string mapPattern(const NumberedPath& maps, const char* map)
{
    return beforeExtension(maps.text(), map);
}

}  // namespace

std::string mapPath(const NumberedPath& maps, std::size_t number, const char* map)
{
    return beforeExtension(maps.at(number), map);
}

std::string checkpointPath(const NumberedPath& files)
{
    return std::filesystem::path(files.with("checkpoint")).replace_extension(".state").string();
}

void checkWindshieldFiles(const WindshieldOptions& options)
{
    std::vector<NamedFile> inputs;
    const auto input = [&](const char* name, const std::optional<std::string>& path) {
        if (path) {
            inputs.push_back({name, *path});
        }
    };
    input("--background", options.background);
    input("--environment", options.environment);
    input("--drive-cycle", options.drive_cycle);
    input("--surface", options.surface);
    input("--config", options.config);
    std::vector<NamedFile> outputs{
        {"OUTPUT", options.files ? options.files->at(1) : options.output, options.files.has_value()}};
    if (options.maps) {
        for (const char* map : kMapNames) {
            outputs.push_back({"--maps", mapPath(*options.maps, 1, map), true});
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

void checkFrameFiles(const WindshieldOptions& options, std::size_t frames)
{
    const auto check_pattern = [&](const char* name, const NumberedPath& pattern) {
        const auto clash = [&](const char* other, const std::optional<std::string>& path) {
            const auto number = path && !isStream(*path) ? pattern.numberOf(*path) : std::nullopt;
            if (number && *number >= 1 && *number <= frames) {
                refuse(std::string(name) + " and " + other + " are the same, '" + *path +
                       "'; they must be different files");
            }
        };
        clash("--background", options.background);
        clash("--environment", options.environment);
        clash("--drive-cycle", options.drive_cycle);
        clash("--surface", options.surface);
        clash("--config", options.config);
        clash("--droplets", options.droplets);
        clash("--model", options.model);
        clash("--json", options.json);
        for (const std::size_t number : pattern.numbers()) {
            if (options.output_options.no_clobber && number >= 1 && number <= frames) {
                droplet::checkWritable(pattern.at(number), options.output_options);
            }
        }
    };
    if (options.files) {
        check_pattern("OUTPUT", *options.files);
    }
    if (options.maps) {
        for (const char* map : kMapNames) {
            check_pattern("--maps", *NumberedPath::of(mapPattern(*options.maps, map), "--maps"));
        }
    }
}

bool hasFrame(const WindshieldOptions& options, std::size_t number)
{
    std::error_code ignored;
    bool is_there = std::filesystem::exists(options.files->at(number), ignored);
    for (const char* map : kMapNames) {
        is_there = is_there && (!options.maps || std::filesystem::exists(mapPath(*options.maps, number, map), ignored));
    }
    return is_there;
}

std::string fingerprintOf(const WindshieldOptions& options)
{
    return fingerprintOf({options.fingerprint, hashOfFile(options.background), hashOfFile(options.drive_cycle),
                          hashOfFile(options.surface), hashOfFile(options.environment)});
}

}  // namespace cli
