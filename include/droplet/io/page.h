// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>

namespace droplet {

/// What a page shows.
struct PageContent {
    std::string title;   ///< in any characters; bytes that are not UTF-8 become U+FFFD. The download is named after it
    std::string glb;     ///< the model, a whole GLB file of at most 256 MiB
    std::string report;  ///< JSON as of writeReport or writeSequenceReport; its times and memory are left out
};

/// Whether the library was built with the page (CMake's DROPLET_PAGE).
bool pageIsBuiltIn() noexcept;

/// Writes one HTML file that shows a droplet in a browser: to be turned and looked through, on several grounds, with
/// the figures of its report, and to be downloaded. All that it needs is inside, three.js too; it works from disk and
/// asks no network for anything. A model whose meshes have a morph target named `volume` can be filled and drained:
/// weight w shows a fill of 1 + w, from and to what `fill_range` in the mesh's extras says, 0 to 2 if it says nothing.
/// A model with an animation, as of Animation, is played, with the report of writeSequenceReport.
///
/// Guarantees: the same content gives the same bytes; no title and no report can end the element it stands in.
/// The stream is left failed if it did not take everything.
/// @return       bytes handed to the stream
/// @throws Error InvalidArgument if glb or report are not what they should be, or the page is not built in
std::uint64_t writePage(std::ostream& out, const PageContent& content);

}  // namespace droplet
