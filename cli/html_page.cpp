// SPDX-License-Identifier: GPL-3.0-or-later
#include "html_page.h"

#include <sstream>
#include <utility>

#include "droplet/io/page.h"

namespace cli {

void writeHtmlPage(std::ostream& out, const HtmlPage& page)
{
    droplet::PageContent content;
    content.title = page.title;
    std::ostringstream glb;
    page.model(glb);
    content.glb = std::move(glb).str();
    std::ostringstream json;
    page.report(json);
    content.report = std::move(json).str();
    droplet::writePage(out, content);
}

}  // namespace cli
