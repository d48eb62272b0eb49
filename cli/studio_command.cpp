// SPDX-License-Identifier: GPL-3.0-or-later
#include "studio_command.h"

#include <filesystem>
#include <string>
#include <system_error>

#include "browser.h"
#include "command_line.h"
#include "files.h"
#include "option_values.h"
#include "run_files.h"
#include "this_process.h"

namespace cli {
namespace {

namespace fs = std::filesystem;

const CommandText& commandText()
{
    static const CommandText text{"droplet-shape studio", "draw footprints in a browser and see their droplets",
                                  "[OPTIONS] [FILE]",
                                  "Studio is one page that needs no network. It draws or reads a footprint, has the\n"
                                  "physics of this command, and saves GLB, OBJ, STL and PNG.\n"
                                  "\n"
                                  "Examples:\n"
                                  "  droplet-shape studio\n"
                                  "  droplet-shape studio studio.html\n"
                                  "\n"
                                  "Exit codes:\n"
                                  "  0 done; 1 internal error; 2 usage, or built without Studio;\n"
                                  "  4 the page cannot be written, or there is no browser or display"};
    return text;
}

/// The page, where it was installed or built, relative to this program.
fs::path pageOfStudio()
{
    fs::path page = (programFile().parent_path() / DROPLET_STUDIO_PAGE).lexically_normal();
    std::error_code unknown;
    if (!fs::exists(page, unknown)) {
        refuse("studio is not available: " + page.string() +
               " does not exist, because the program was built without DROPLET_STUDIO");
    }
    return page;
}

}  // namespace

int runStudio(int argc, const char* const* argv)
{
    CommandLine line(commandText());
    line.addArguments("FILE", "Write the page here instead of opening it; - is standard output");
    line.addFlag("Run", "--no-clobber", "Do not replace an existing file");
    line.addFlag("Run", "-h,--help", "Print this help; --help=json prints it for programs");
    line.parse(argc, argv);
    if (const auto help = line.requestedHelp()) {
        print(*help);
        return 0;
    }
    const std::vector<Given> paths = line.values("FILE");
    if (paths.size() > 1) {
        refuse("'" + paths[1].text + "': one FILE is enough");
    }
    const droplet::OutputOptions options{line.flag("--no-clobber")};
    const fs::path page = pageOfStudio();
    if (paths.empty()) {
        openInBrowser(page);
        return 0;
    }
    const std::string& path = paths[0].text;
    RunFiles files;
    files.reads("the page of Studio", page.string());
    files.writes("FILE", path);
    checkFiles(files, options);
    writeTogether({{path, [&](std::ostream& out) { out << textOf(page.string()); }}}, options);
    return 0;
}

}  // namespace cli
