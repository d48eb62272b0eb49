// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow_files.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include "checkpoint.h"
#include "content_hash.h"
#include "droplet/error.h"
#include "flow_plan.h"

namespace cli {
namespace {

/// Files whose content decides what the frames show.
void addInputs(RunFiles& files, const FlowOptions& options)
{
    for (const std::string& path : objectFiles(options)) {
        files.reads("OBJECT", path);
    }
    files.reads("--mask", options.mask);
    files.reads("--start", options.start);
    files.reads("--motion", options.motion);
    files.reads("--roughness-map", options.roughness_map);
    files.reads("--friction-map", options.friction_map);
    files.reads("--environment", options.view.environment);
}

/// Number of frames. What is wrong with an object is told by its reader, once the files are known to be different ones;
/// until then it counts as one that keeps its shape.
std::size_t framesToWrite(FlowOptions options)
{
    try {
        return frameCount(options);
    } catch (const droplet::Error&) {
        options.keeps_animation = false;
        return frameCount(options);
    }
}

}  // namespace

RunFiles filesOf(const FlowOptions& options)
{
    RunFiles files;
    addInputs(files, options);
    files.reads("--config", options.run.config);
    const FrameNumbers numbers{1, framesToWrite(options)};
    if (options.files) {
        files.writesFrames("OUTPUT", *options.files, numbers);
        files.writes("OUTPUT's checkpoint", checkpointPath(*options.files));
    } else {
        files.writes("OUTPUT", options.output);
    }
    if (options.point_files) {
        files.writesFrames("--droplets", *options.point_files, numbers);
    } else {
        files.writes("--droplets", options.droplets);
    }
    if (options.streak_files) {
        files.writesFrames("--streaks", *options.streak_files, numbers);
    } else {
        files.writes("--streaks", options.streaks);
    }
    files.writes("--json", options.json);
    files.writes("--html", options.html);
    for (const char* map : kFlowMaps) {
        if (options.maps) {
            files.writesFrames("--maps", options.maps->beside(map), numbers);
        }
    }
    if (options.has_preview) {
        for (const std::string& path : previewPaths(options.view)) {
            files.writes("--preview", path);
        }
    }
    return files;
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
