// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>

namespace droplet {

/// Content of a page.
struct PageContent {
    std::string title;   ///< UTF-8; other bytes become U+FFFD. The downloaded file gets this name
    std::string glb;     ///< GLB file of at most 256 MiB
    std::string report;  ///< JSON from writeReport, writeSequenceReport or writeFlowReport, without times and memory
};

/// Whether the library was built with the page (CMake's DROPLET_PAGE).
bool hasPage() noexcept;

/// Writes one HTML file that shows a droplet in a browser. The reader can turn the droplet, look through it, choose its
/// ground, read the figures of its report, and download it. The file contains everything, three.js too; it works from
/// disk and makes no network request. If the meshes have a morph target named `volume`, the reader can change the fill:
/// weight w shows a fill of 1 + w, within `fill_range` in the mesh's extras, by default 0 to 2.
/// A model with an animation, such as from Animation, is played; its report is that of writeSequenceReport. So is one
/// of FlowAnimation, with the report of writeFlowReport: droplets run over the object, and streaks grow.
///
/// Guarantees: the same content gives the same bytes; title and report are escaped.
/// The stream is left failed if it did not take everything.
/// @param out      stream of bytes
/// @param content  title, model and report
/// @return         bytes handed to the stream
/// @throws Error   InvalidArgument if glb is not a GLB file, report is not a JSON object, or the page is not built in
std::uint64_t writePage(std::ostream& out, const PageContent& content);

}  // namespace droplet
