// SPDX-License-Identifier: GPL-3.0-or-later
#include "browser.h"

#include <cstdio>
#include <string>

#include "droplet/error.h"
#include "process.h"
#include "terminal.h"

namespace cli {

using droplet::Error;
using droplet::ErrorCode;

void openInBrowser(const std::filesystem::path& page)
{
    const std::string advice = "; open " + page.string() + " in a browser";
    // Without a display xdg-open may start a browser for text, which cannot show the page.
    if (!hasDisplay()) {
        throw Error(ErrorCode::OutputFailed, "there is no display" + advice);
    }
    const Started browser = start({"xdg-open", page.string()}, Piped::Output);
    if (browser.failure != 0) {
        throw Error(ErrorCode::OutputFailed, "xdg-open is missing" + advice);
    }
    const int status = waitFor(browser.process.id);
    const std::string log = firstLine(browser.process.log);
    std::fclose(browser.process.output);
    std::fclose(browser.process.log);
    if (status != 0) {
        throw Error(ErrorCode::OutputFailed, "xdg-open failed" + (log.empty() ? "" : ": " + log) + advice);
    }
}

}  // namespace cli
