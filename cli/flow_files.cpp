// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow_files.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include "content_hash.h"
#include "files.h"
#include "option_values.h"

namespace cli {
namespace {

using NamedPath = std::pair<const char*, const std::optional<std::string>*>;

std::vector<NamedPath> inputsOf(const FlowOptions& options)
{
    return {{"OBJECT", &options.object},
            {"--mask", &options.mask},
            {"--start", &options.start},
            {"--motion", &options.motion},
            {"--config", &options.config},
            {"--roughness-map", &options.roughness_map},
            {"--friction-map", &options.friction_map}};
}

std::vector<NamedPath> outputsOf(const FlowOptions& options)
{
    return {{"--droplets", &options.droplets}, {"--streaks", &options.streaks}, {"--json", &options.json}};
}

}  // namespace

std::string flowMapPath(const NumberedPath& maps, std::size_t number, const char* map)
{
    std::string path = maps.at(number);
    return path.insert(path.size() - std::string(".png").size(), std::string("-") + map);
}

std::string flowCheckpointPath(const FlowOptions& options)
{
    return std::filesystem::path(options.files->with("checkpoint")).replace_extension(".state").string();
}

void checkFlowFiles(const FlowOptions& options)
{
    std::vector<NamedFile> inputs;
    for (const auto& [name, path] : inputsOf(options)) {
        if (*path) {
            inputs.push_back({name, **path});
        }
    }
    std::vector<NamedFile> outputs{
        {"OUTPUT", options.files ? options.files->at(1) : options.output, options.files.has_value()}};
    if (options.files) {
        outputs.push_back({"OUTPUT's checkpoint", flowCheckpointPath(options)});
    }
    for (const auto& [name, path] : outputsOf(options)) {
        if (*path) {
            outputs.push_back({name, **path});
        }
    }
    for (const char* map : kFlowMaps) {
        if (options.maps) {
            outputs.push_back({"--maps", flowMapPath(*options.maps, 1, map), true});
        }
    }
    if (options.has_preview) {
        for (const NamedFile& file : previewPaths(options.view)) {
            outputs.push_back(file);
        }
    }
    checkFiles(inputs, outputs, options.output_options);
}

void checkFlowFrames(const FlowOptions& options, std::size_t frames)
{
    if (!options.files) {
        return;
    }
    std::vector<NamedPath> others = inputsOf(options);
    for (const NamedPath& output : outputsOf(options)) {
        others.push_back(output);
    }
    for (const auto& [name, path] : others) {
        const auto number = *path && !isStream(**path) ? options.files->numberOf(**path) : std::nullopt;
        if (number && *number >= 1 && *number <= frames) {
            refuse(std::string("OUTPUT and ") + name + " are the same, '" + **path + "'; they must be different files");
        }
    }
    for (const std::size_t number : options.files->numbers()) {
        if (options.output_options.no_clobber && number >= 1 && number <= frames) {
            droplet::checkWritable(options.files->at(number), options.output_options);
        }
    }
}

bool hasFlowFrame(const FlowOptions& options, std::size_t number)
{
    std::error_code ignored;
    return std::filesystem::exists(options.files->at(number), ignored) &&
           (!options.maps || std::all_of(kFlowMaps.begin(), kFlowMaps.end(), [&](const char* map) {
               return std::filesystem::exists(flowMapPath(*options.maps, number, map), ignored);
           }));
}

std::string flowFingerprint(const FlowOptions& options)
{
    std::vector<std::string> parts{options.fingerprint};
    for (const auto& [name, path] : inputsOf(options)) {
        if (path != &options.config) {
            parts.push_back(hashOfFile(*path));
        }
    }
    return fingerprintOf(parts);
}

}  // namespace cli
