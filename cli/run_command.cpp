// SPDX-License-Identifier: GPL-3.0-or-later
#include "run_command.h"

#include <tbb/global_control.h>

#include <iostream>
#include <optional>

#include "exit_code.h"
#include "library_message.h"
#include "shape_command.h"

namespace cli {

int runAndTell(const RunOptions& run, const RunFiles& files, const std::function<RunEnd(ProgressDisplay&)>& make)
{
    std::optional<tbb::global_control> threads;
    if (run.threads) {
        threads.emplace(tbb::global_control::max_allowed_parallelism, *run.threads);
    }
    ProgressDisplay progress(run.shownProgress(), run.terms);
    const RunEnd end = inTermsOf(run.terms, files, [&] { return make(progress); });
    progress.finish();
    const bool is_quiet = run.verbosity == Verbosity::Quiet;
    if (!is_quiet && run.progress != ProgressMode::Json) {
        std::cerr << end.summary << std::flush;
    }
    const std::size_t printed = is_quiet ? end.severe_warnings : end.warnings.size();
    for (std::size_t i = 0; i < printed; ++i) {
        printWarning(withOptions(end.warnings[i], run.terms), run.progress);
    }
    return end.some_failed ? static_cast<int>(ExitCode::SomeFailed) : 0;
}

int checkAndRun(const RunOptions& run, const RunFiles& files, const std::function<RunEnd(ProgressDisplay&)>& make)
{
    checkFiles(files, run.files);
    return runAndTell(run, files, make);
}

}  // namespace cli
