// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

namespace cli {

/// Shows a page in the user's browser.
/// @throws droplet::Error OutputFailed: there is no display or no browser
void openInBrowser(const std::filesystem::path& page);

}  // namespace cli
