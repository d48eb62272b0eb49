// SPDX-License-Identifier: GPL-3.0-or-later
#include "browser.h"

// The second needs the first.
// clang-format off
#include <windows.h>
#include <shellapi.h>
// clang-format on

#include "droplet/error.h"

namespace cli {

void openInBrowser(const std::filesystem::path& page)
{
    constexpr INT_PTR kLastError = 32;
    const HINSTANCE started = ::ShellExecuteW(nullptr, L"open", page.c_str(), nullptr, nullptr, SW_SHOWNORMAL);
    if (reinterpret_cast<INT_PTR>(started) <= kLastError) {
        throw droplet::Error(droplet::ErrorCode::OutputFailed,
                             "no browser opens; open " + page.string() + " in a browser");
    }
}

}  // namespace cli
