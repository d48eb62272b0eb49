// SPDX-License-Identifier: GPL-3.0-or-later
#include "browser.h"

#include <cstdio>
#include <cstdlib>
#include <string>

#include "droplet/error.h"
#include "process.h"
#include "process_log.h"

namespace cli {
namespace {

using droplet::Error;
using droplet::ErrorCode;

bool isSet(const char* variable)
{
    const char* const value = std::getenv(variable);
    return value != nullptr && *value != '\0';
}

}  // namespace

void openInBrowser(const std::filesystem::path& page)
{
    const std::string advice = "; open " + page.string() + " in a browser";
    // Without a display xdg-open may start a browser for text, which cannot show the page.
    if (!isSet("DISPLAY") && !isSet("WAYLAND_DISPLAY") && !isSet("BROWSER")) {
        throw Error(ErrorCode::OutputFailed, "there is no display" + advice);
    }
    const Started browser = start({"xdg-open", page.string()}, Piped::Output);
    if (browser.failure != 0) {
        throw Error(ErrorCode::OutputFailed, "xdg-open is missing" + advice);
    }
    const int code = waitFor(*browser.process.id).code;
    const std::string log = firstLine(browser.process.log);
    std::fclose(browser.process.output);
    std::fclose(browser.process.log);
    if (code != 0) {
        throw Error(ErrorCode::OutputFailed, "xdg-open failed" + (log.empty() ? "" : ": " + log) + advice);
    }
}

}  // namespace cli
