// SPDX-License-Identifier: GPL-3.0-or-later
#include "windshield_files.h"

#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include "checkpoint.h"
#include "content_hash.h"
#include "windshield_plan.h"

namespace cli {
RunFiles filesOf(const WindshieldOptions& options)
{
    RunFiles files;
    files.reads("--background", options.background);
    files.reads("--environment", options.environment);
    files.reads("--drive-cycle", options.drive_cycle);
    files.reads("--surface", options.surface);
    files.reads("--config", options.run.config);
    const FrameNumbers numbers{1, frameCount(options)};
    if (options.files) {
        files.writesFrames("OUTPUT", *options.files, numbers);
        files.writes("OUTPUT's checkpoint", checkpointPath(*options.files));
    } else {
        files.writes("OUTPUT", options.output);
    }
    for (const char* map : kMapNames) {
        if (options.maps) {
            files.writesFrames("--maps", options.maps->beside(map), numbers);
        }
    }
    files.writes("--droplets", options.droplets);
    files.writes("--animation", options.model);
    files.writes("--json", options.json);
    return files;
}

std::string fingerprintOf(const WindshieldOptions& options)
{
    return fingerprintOf({options.fingerprint, hashOfFile(options.background), hashOfFile(options.drive_cycle),
                          hashOfFile(options.surface), hashOfFile(options.environment)});
}

}  // namespace cli
