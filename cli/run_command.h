// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "common_options.h"
#include "progress_display.h"
#include "run_files.h"

namespace cli {

/// How a run ended, for standard error.
struct RunEnd {
    std::string summary;  ///< lines
    std::vector<std::string> warnings = {};
    std::size_t severe_warnings = 0;  ///< number of the first ones, which --quiet prints, too
    bool some_failed = false;         ///< whether a part of the result is missing or replaced, which the summary tells
};

/// Makes a run with the threads and the progress that its options ask for, and prints how it ended. Messages of the
/// library get the command's options.
/// @param files           of the run
/// @return                exit code: 0, or that of ExitCode::SomeFailed
/// @throws droplet::Error whatever `make` throws
int runAndTell(const RunOptions& run, const RunFiles& files, const std::function<RunEnd(ProgressDisplay&)>& make);

/// Checks the files of a run, and makes it as runAndTell() does.
/// @return                exit code
/// @throws droplet::Error as checkFiles(); whatever `make` throws
int checkAndRun(const RunOptions& run, const RunFiles& files, const std::function<RunEnd(ProgressDisplay&)>& make);

}  // namespace cli
