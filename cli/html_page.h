// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <iosfwd>
#include <string>

namespace cli {

/// What a page of --html shows.
struct HtmlPage {
    std::string title;
    std::function<void(std::ostream&)> model;   ///< writes the GLB
    std::function<void(std::ostream&)> report;  ///< writes the report as JSON
};

/// Writes a page.
/// @throws droplet::Error as droplet::writePage(), `model` and `report`
void writeHtmlPage(std::ostream& out, const HtmlPage& page);

}  // namespace cli
