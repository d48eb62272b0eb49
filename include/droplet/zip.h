// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

namespace droplet {

/// File of an archive, shorter than 4 GiB.
struct ZipEntry {
    std::string name;                          ///< path in the archive, UTF-8, shorter than 64 KiB
    std::function<void(std::ostream&)> write;  ///< writes the file, the same bytes at every call
};

/// Options of an archive.
struct ZipOptions {
    std::uint64_t alignment = 1;  ///< of every file's first byte, from the archive's beginning; below 64 KiB
    bool deflates = false;        ///< whether files are compressed
    bool zip64 = false;        ///< whether the archive may reach 4 GiB, or hold 65535 files; not all programs read it
    const char* kind = "zip";  ///< of the archive, for messages
};

/// Writer of an archive to a stream, file by file: PKWARE, ".ZIP File Format Specification" (6.3). Files are written
/// twice, so that none is in memory as a whole: their lengths and checksums stand before them.
///
/// Guarantees: the same files give the same bytes; all of them are dated 1980-01-01.
class ZipWriter {
public:
    /// @param out      used until finish()
    /// @param options  of the archive
    explicit ZipWriter(std::ostream& out, const ZipOptions& options = {}) : out_(out), options_(options) {}

    /// Writes a file; the stream is left failed if it did not take everything.
    /// @throws Error InvalidArgument if the file reaches 4 GiB, or the archive would without `zip64`
    void add(const ZipEntry& file);

    /// Writes the directory at the archive's end; nothing may follow.
    /// @return bytes handed to the stream
    std::uint64_t finish();

private:
    friend std::uint64_t writeZip(const std::vector<ZipEntry>& files, std::ostream& out, const ZipOptions& options);

    /// File and where it lies.
    struct Placed {
        std::string name;
        std::uint64_t begin = 0;    ///< of its header
        std::uint64_t padding = 0;  ///< bytes of the extra field, which aligns the data
        std::uint64_t length = 0;   ///< as it is stored
        std::uint64_t whole = 0;    ///< of the file itself
        std::uint32_t crc = 0;
    };

    void place(const ZipEntry& file);
    void write(const Placed& placed, const ZipEntry& file);

    std::ostream& out_;
    ZipOptions options_;
    std::vector<Placed> placed_;
    std::uint64_t end_ = 0;              ///< of the last file that has its place
    std::uint64_t directory_bytes_ = 0;  ///< of these files
};

/// Writes an archive as ZipWriter does.
///
/// Guarantees: nothing is written if it throws.
/// @return       bytes handed to the stream, which is left failed if it did not take everything
/// @throws Error InvalidArgument as ZipWriter::add()
std::uint64_t writeZip(const std::vector<ZipEntry>& files, std::ostream& out, const ZipOptions& options = {});

}  // namespace droplet
