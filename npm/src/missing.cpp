// SPDX-License-Identifier: GPL-3.0-or-later
// What needs other programs, fonts or the ray tracer, and says so.
#include <string>

#include "browser.h"
#include "contact_sheet.h"
#include "dew_command.h"
#include "dew_picture.h"
#include "droplet/error.h"
#include "droplet/render/contact_sheet.h"
#include "droplet/render/render.h"
#include "glyphs_command.h"
#include "host.h"
#include "motion_program.h"
#include "option_values.h"
#include "preview.h"
#include "process.h"
#include "render/openness.h"
#include "shortage.h"

namespace droplet {

bool canRender() noexcept
{
    return false;
}

Picture render(const Surface&, const RenderOptions&)
{
    throw Error(ErrorCode::InvalidArgument, "there is no ray tracer");
}

Layer renderCutOut(const Surface&, const RenderOptions&)
{
    throw Error(ErrorCode::InvalidArgument, "there is no ray tracer");
}

Picture contactSheet(const std::vector<Tile>&, const ContactSheetOptions&)
{
    return {};
}

std::optional<ViewBox> around(const Surface&, const std::optional<ViewBox>&)
{
    return std::nullopt;
}

StandOpenness opennessOf(const TexturedMesh&, const OpennessOptions&)
{
    return {};
}

TexturedMesh groundMesh(const BaseSurface&, Vec2)
{
    return {};
}

}  // namespace droplet

namespace cli {

namespace {

const char* const kElsewhere =
    ", which the npm package does not have; the droplet-shape for Linux has it, see docs/platforms.md";

}  // namespace

int runGlyphs(int, const char* const*)
{
    refuse(std::string("glyphs needs fonts") + kElsewhere);
}

int runMotion(int argc, const char* const* argv)
{
    if (argv[1] == std::string("dew")) {
        return runDew(argc - 1, argv + 1);
    }
    refuse(std::string(argv[1]) + " is a command of what moves" + kElsewhere);
}

void writeContactSheet(const ContactSheet&, const droplet::OutputOptions&, const std::function<void(std::size_t)>&)
{
    requireRenderer("--contact-sheet");
}

std::vector<OutputFile> dewPictures(const Dew&, const PreviewOptions&, droplet::Material)
{
    requireRenderer("--preview");
    return {};
}

bool isThreadShortage(const std::exception&)
{
    return false;
}

Started start(const std::vector<std::string>& command, Piped, const SharedFile*)
{
    refuse("this needs the program " + command[0] + kElsewhere);
}

std::FILE* temporaryFile()
{
    return nullptr;
}

SharedFile::SharedFile() = default;
SharedFile::~SharedFile() = default;

void limitMemory(ProcessId, std::size_t) {}

void limitTime(ProcessId, std::size_t) {}

ProcessEnd waitFor(ProcessId)
{
    return {};
}

void endNow(ProcessId) {}

void openInBrowser(const std::filesystem::path& page)
{
    if (!droplet_host_open_page(page.c_str())) {
        throw droplet::Error(droplet::ErrorCode::OutputFailed,
                             "no browser opens; write the page into a FILE and open that");
    }
}

}  // namespace cli
