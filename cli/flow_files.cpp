// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow_files.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include "checkpoint.h"
#include "content_hash.h"
#include "flow_plan.h"

namespace cli {
namespace {

/// Path with the name of a map before its extension.
std::string withMap(std::string path, const char* map)
{
    return path.insert(path.size() - std::string(".png").size(), std::string("-") + map);
}

/// Files whose content decides what the frames show.
void addInputs(RunFiles& files, const FlowOptions& options)
{
    files.reads("OBJECT", options.object);
    files.reads("--mask", options.mask);
    files.reads("--start", options.start);
    files.reads("--motion", options.motion);
    files.reads("--roughness-map", options.roughness_map);
    files.reads("--friction-map", options.friction_map);
}

}  // namespace

std::string flowMapPath(const NumberedPath& maps, std::size_t number, const char* map)
{
    return withMap(maps.at(number), map);
}

RunFiles filesOf(const FlowOptions& options)
{
    RunFiles files;
    addInputs(files, options);
    files.reads("--config", options.config);
    const FrameNumbers numbers{1, frameCount(options)};
    if (options.files) {
        files.writesFrames("OUTPUT", *options.files, numbers);
        files.writes("OUTPUT's checkpoint", checkpointPath(*options.files));
    } else {
        files.writes("OUTPUT", options.output);
    }
    files.writes("--droplets", options.droplets);
    files.writes("--streaks", options.streaks);
    files.writes("--json", options.json);
    for (const char* map : kFlowMaps) {
        if (options.maps) {
            files.writesFrames("--maps", *NumberedPath::of(withMap(options.maps->text(), map), "--maps"), numbers);
        }
    }
    if (options.has_preview) {
        for (const std::string& path : previewPaths(options.view)) {
            files.writes("--preview", path);
        }
    }
    return files;
}

std::vector<NumberedPath> flowFrames(const FlowOptions& options)
{
    std::vector<NumberedPath> frames{*options.files};
    for (const char* map : kFlowMaps) {
        if (options.maps) {
            frames.push_back(*NumberedPath::of(withMap(options.maps->text(), map), "--maps"));
        }
    }
    return frames;
}

std::string flowFingerprint(const FlowOptions& options)
{
    std::vector<std::string> parts{options.fingerprint};
    RunFiles files;
    addInputs(files, options);
    for (const NamedFile& file : files.read) {
        parts.push_back(file.name);
        parts.push_back(hashOfFile(file.path));
    }
    return fingerprintOf(parts);
}

}  // namespace cli
