// SPDX-License-Identifier: GPL-3.0-or-later
#include "zip.h"

#include <zlib.h>

#include <array>
#include <limits>
#include <new>
#include <ostream>
#include <streambuf>

#include "byte_stream.h"
#include "droplet/error.h"

namespace droplet {
namespace {

/// Stream that counts its bytes and their checksum, and hands them on to another one, if there is one, deflated on
/// demand.
class Filter : public std::streambuf {
public:
    Filter(std::ostream* out, bool deflates) : out_(out), deflates_(deflates)
    {
        constexpr int kNoHeader = -15;
        constexpr int kMemory = 8;
        if (deflates_ &&
            deflateInit2(&stream_, Z_BEST_SPEED, Z_DEFLATED, kNoHeader, kMemory, Z_DEFAULT_STRATEGY) != Z_OK) {
            throw std::bad_alloc();
        }
    }
    ~Filter() override
    {
        if (deflates_) {
            deflateEnd(&stream_);
        }
    }
    Filter(const Filter&) = delete;
    Filter& operator=(const Filter&) = delete;

    void finish()
    {
        if (deflates_) {
            deflateAll(nullptr, 0, Z_FINISH);
        }
    }

    [[nodiscard]] std::uint32_t crc() const { return static_cast<std::uint32_t>(crc_); }
    /// Bytes that were handed on.
    [[nodiscard]] std::uint64_t length() const { return length_; }

protected:
    std::streamsize xsputn(const char* bytes, std::streamsize count) override
    {
        crc_ = crc32_z(crc_, reinterpret_cast<const Bytef*>(bytes), static_cast<std::size_t>(count));
        if (deflates_) {
            deflateAll(bytes, count, Z_NO_FLUSH);
        } else {
            handOn(bytes, count);
        }
        return count;
    }

private:
    void deflateAll(const char* bytes, std::streamsize count, int flush)
    {
        stream_.next_in = const_cast<Bytef*>(reinterpret_cast<const Bytef*>(bytes));  // zlib does not change it
        stream_.avail_in = static_cast<uInt>(count);                                  // a ByteStream's buffer at most
        do {
            stream_.next_out = buffer_.data();
            stream_.avail_out = static_cast<uInt>(buffer_.size());
            deflate(&stream_, flush);
            handOn(reinterpret_cast<const char*>(buffer_.data()),
                   static_cast<std::streamsize>(buffer_.size() - stream_.avail_out));
        } while (stream_.avail_out == 0);
    }

    void handOn(const char* bytes, std::streamsize count)
    {
        length_ += static_cast<std::uint64_t>(count);
        if (out_ != nullptr) {
            out_->write(bytes, count);
        }
    }

    std::ostream* out_;
    bool deflates_;
    z_stream stream_ = {};
    std::array<Bytef, std::size_t{1} << 16> buffer_ = {};
    uLong crc_ = crc32_z(0, nullptr, 0);
    std::uint64_t length_ = 0;
};

/// File and where it lies.
struct Placed {
    const ZipEntry& file;
    std::uint64_t begin = 0;    ///< of its header
    std::uint64_t padding = 0;  ///< bytes of the extra field, which aligns the data
    std::uint64_t length = 0;   ///< as it is stored
    std::uint64_t whole = 0;    ///< of the file itself
    std::uint32_t crc = 0;
};

constexpr std::uint64_t kHeader = 30;
constexpr std::uint64_t kDirectoryEntry = 46;
constexpr std::uint64_t kDirectoryEnd = 22;

/// Writes a file through a filter.
Placed written(const ZipEntry& file, std::ostream* out, bool deflates)
{
    Filter filter(out, deflates);
    std::ostream stream(&filter);
    Placed placed{file};
    placed.whole = file.write(stream);
    filter.finish();
    placed.length = filter.length();
    placed.crc = filter.crc();
    return placed;
}

/// Fields that both headers of a file share: version, no flags, method, 1980-01-01, checksum and lengths.
void writeFields(ByteStream& zip, const Placed& entry, bool deflates)
{
    constexpr int kDeflated = 8;
    zip.u16(deflates ? 20 : 10, 0, deflates ? kDeflated : 0, 0, 0x21);
    zip.u32(entry.crc, entry.length, entry.whole);
    zip.u16(entry.file.name.size());
}

}  // namespace

std::uint64_t writeZip(const std::vector<ZipEntry>& files, std::ostream& out, const ZipOptions& options)
{
    constexpr std::uint64_t kSmallestField = 4;
    std::vector<Placed> entries;
    std::uint64_t end = 0;
    std::uint64_t directory_bytes = 0;
    for (const ZipEntry& file : files) {
        Placed& entry = entries.emplace_back(written(file, nullptr, options.deflates));
        entry.begin = end;
        end += kHeader + file.name.size();
        if (options.alignment > 1) {
            const std::uint64_t over = (end + kSmallestField) % options.alignment;
            entry.padding = kSmallestField + (options.alignment - over) % options.alignment;
        }
        end += entry.padding + entry.length;
        directory_bytes += kDirectoryEntry + file.name.size();
    }
    const std::uint64_t size = end + directory_bytes + kDirectoryEnd;
    if (size > std::numeric_limits<std::uint32_t>::max()) {
        throw Error(ErrorCode::InvalidArgument, std::string("the scene would make a ") + options.kind + " file of " +
                                                    std::to_string(size) + " bytes; it must stay below 4 GiB");
    }
    for (const Placed& entry : entries) {
        ByteStream header(out);
        header.text("PK\x03\x04");
        writeFields(header, entry, options.deflates);
        header.u16(entry.padding);
        header.text(entry.file.name);
        if (entry.padding > 0) {
            header.u16(0x1986, entry.padding - kSmallestField);  // the field's name in OpenUSD's own packages
            header.text(std::string(entry.padding - kSmallestField, '\0'));
        }
        header.finish();
        written(entry.file, &out, options.deflates);
    }
    ByteStream directory(out);
    for (const Placed& entry : entries) {
        directory.text("PK\x01\x02");
        directory.u16(options.deflates ? 20 : 10);
        writeFields(directory, entry, options.deflates);
        directory.u16(0, 0, 0, 0);  // no extra field, no comment, first disk, no attributes
        directory.u32(0, entry.begin);
        directory.text(entry.file.name);
    }
    directory.text("PK\x05\x06");
    directory.u16(0, 0, entries.size(), entries.size());
    directory.u32(directory_bytes, end);
    directory.u16(0);
    directory.finish();
    return size;
}

}  // namespace droplet
