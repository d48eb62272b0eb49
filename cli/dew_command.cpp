// SPDX-License-Identifier: GPL-3.0-or-later
#include "dew_command.h"

#include <fmt/core.h>

#include <string>
#include <variant>

#include "dew_options.h"
#include "dew_run.h"
#include "files.h"
#include "option_values.h"
#include "run_command.h"
#include "run_files.h"
#include "terminal.h"

namespace cli {
namespace {

RunEnd ended(const DewCommandOptions& options, const droplet::DewReport& report)
{
    RunEnd end;
    end.summary = fmt::format("{} droplet{}, {:.4g} mL, cover {:.3g} of {:.4g} cm2\n{}\n{}\n", report.droplets,
                              report.droplets == 1 ? "" : "s", report.volume / 1e-6, report.covered / report.area,
                              report.area / 1e-4, lostOf(report), oneLine(report.output));
    if (options.file.instancing == droplet::Instancing::Auto && report.instancing == droplet::Instancing::Gpu) {
        end.summary +=
            "so many droplets are instances (EXT_mesh_gpu_instancing), which some viewers do not show; "
            "--instancing none writes one mesh\n";
    }
    end.warnings = report.warnings;
    return end;
}

}  // namespace

int runDew(int argc, const char* const* argv)
{
    const auto parsed = parseDew(argc, argv);
    if (const auto* text = std::get_if<std::string>(&parsed)) {
        print(*text);
        return 0;
    }
    const auto& options = std::get<DewCommandOptions>(parsed);
    return checkAndRun(options.run, filesOf(options), [&](ProgressDisplay& progress) {
        return ended(options,
                     makeDew(options, [&](droplet::Stage stage, double share) { progress.begin(stage, share); }));
    });
}

}  // namespace cli
