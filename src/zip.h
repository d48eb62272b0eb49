// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

namespace droplet {

/// File of an archive.
struct ZipEntry {
    std::string name;
    /// Writes the file, the same bytes at every call; returns their number.
    std::function<std::uint64_t(std::ostream&)> write;
};

struct ZipOptions {
    std::uint64_t alignment = 1;  ///< of every file's first byte, from the archive's beginning
    bool deflates = false;        ///< whether files are compressed
    const char* kind = "zip";     ///< of the archive, for messages
};

/// Writes an archive: PKWARE, ".ZIP File Format Specification" (6.3). Files are written twice, so that none is in
/// memory as a whole: their lengths and checksums stand before them.
///
/// Guarantees: the same files give the same bytes; nothing is written if it throws.
/// @return       bytes handed to the stream, which is left failed if it did not take everything
/// @throws Error InvalidArgument if the archive would reach 4 GiB
std::uint64_t writeZip(const std::vector<ZipEntry>& files, std::ostream& out, const ZipOptions& options = {});

}  // namespace droplet
