// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/zip.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <limits>
#include <new>
#include <ostream>
#include <streambuf>
#include <string_view>
#include <utility>

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
    /// Bytes that came.
    [[nodiscard]] std::uint64_t whole() const { return whole_; }
    /// Bytes that were handed on.
    [[nodiscard]] std::uint64_t length() const { return length_; }

protected:
    std::streamsize xsputn(const char* bytes, std::streamsize count) override
    {
        whole_ += static_cast<std::uint64_t>(count);
        crc_ = crc32_z(crc_, reinterpret_cast<const Bytef*>(bytes), static_cast<std::size_t>(count));
        if (deflates_) {
            deflateAll(bytes, count, Z_NO_FLUSH);
        } else {
            handOn(bytes, count);
        }
        return count;
    }

    int_type overflow(int_type value) override
    {
        if (!traits_type::eq_int_type(value, traits_type::eof())) {
            const char byte = traits_type::to_char_type(value);
            xsputn(&byte, 1);
        }
        return traits_type::not_eof(value);
    }

private:
    void deflateAll(const char* bytes, std::streamsize count, int flush)
    {
        stream_.next_in = const_cast<Bytef*>(reinterpret_cast<const Bytef*>(bytes));  // zlib does not change it
        stream_.avail_in = static_cast<uInt>(count);  // all files are shorter than 4 GiB
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
    std::uint64_t whole_ = 0;
    std::uint64_t length_ = 0;
};

constexpr std::uint64_t kHeader = 30;
constexpr std::uint64_t kDirectoryEntry = 46;
constexpr std::uint64_t kDirectoryEnd = 22;
/// Extra field of a directory's entry that has the place of a file beyond 4 GiB.
constexpr std::uint64_t kFarField = 12;
/// End of a large directory, and its locator.
constexpr std::uint64_t kLargeEnd = 56 + 20;
constexpr std::uint64_t kSmallestField = 4;
constexpr std::uint64_t kMax16 = std::numeric_limits<std::uint16_t>::max();
constexpr std::uint64_t kMax32 = std::numeric_limits<std::uint32_t>::max();

/// Version of the format that a program needs to read an archive's files.
int version(bool deflates, bool large)
{
    return large ? 45 : deflates ? 20 : 10;
}

/// Bit that says that a name is UTF-8; without it, it is in a code page of DOS, which has the same ASCII.
int nameFlag(std::string_view name)
{
    constexpr int kUtf8 = 1 << 11;
    return std::all_of(name.begin(), name.end(), [](char c) { return static_cast<unsigned char>(c) < 0x80; }) ? 0
                                                                                                              : kUtf8;
}

void u64(ByteStream& bytes, std::uint64_t value)
{
    bytes.u32(value & kMax32, value >> 32U);
}

/// Writes a file through a filter.
void pass(const ZipEntry& file, Filter& filter)
{
    std::ostream stream(&filter);
    file.write(stream);
    stream.flush();
    filter.finish();
}

/// Fields that both headers of a file share: flags, method, 1980-01-01, checksum and lengths.
void writeFields(ByteStream& zip, std::string_view name, bool deflates, std::uint32_t crc, std::uint64_t length,
                 std::uint64_t whole)
{
    constexpr int kDeflated = 8;
    zip.u16(nameFlag(name), deflates ? kDeflated : 0, 0, 0x21);
    zip.u32(crc, length, whole);
    zip.u16(name.size());
}

}  // namespace

void ZipWriter::place(const ZipEntry& file)
{
    Filter measure(nullptr, options_.deflates);
    pass(file, measure);
    if (file.name.size() > kMax16 || measure.whole() >= kMax32 || measure.length() >= kMax32) {
        throw Error(ErrorCode::InvalidArgument,
                    "'" + file.name.substr(0, kMax16) + "' has " + std::to_string(measure.whole()) +
                        " bytes; a file in a " + options_.kind + " file must stay below 4 GiB, its name below 64 KiB");
    }
    Placed placed{file.name, end_, 0, measure.length(), measure.whole(), measure.crc()};
    std::uint64_t end = end_ + kHeader + file.name.size();
    if (options_.alignment > 1) {
        const std::uint64_t over = (end + kSmallestField) % options_.alignment;
        placed.padding = kSmallestField + (options_.alignment - over) % options_.alignment;
    }
    end += placed.padding + placed.length;
    const std::uint64_t directory_bytes =
        directory_bytes_ + kDirectoryEntry + file.name.size() + (placed.begin >= kMax32 ? kFarField : 0);
    const std::uint64_t size = end + directory_bytes + kDirectoryEnd;
    if (!options_.zip64 && (size > kMax32 || placed_.size() + 1 >= kMax16)) {
        throw Error(ErrorCode::InvalidArgument, std::string("the scene would make a ") + options_.kind + " file of " +
                                                    std::to_string(size) +
                                                    " bytes; it must stay below 4 GiB and have fewer than 65535 files");
    }
    end_ = end;
    directory_bytes_ = directory_bytes;
    placed_.push_back(std::move(placed));
}

void ZipWriter::write(const Placed& placed, const ZipEntry& file)
{
    ByteStream header(out_);
    header.text("PK\x03\x04");
    header.u16(version(options_.deflates, false));
    writeFields(header, placed.name, options_.deflates, placed.crc, placed.length, placed.whole);
    header.u16(placed.padding);
    header.text(placed.name);
    if (placed.padding > 0) {
        header.u16(0x1986, placed.padding - kSmallestField);  // the field's name in OpenUSD's own packages
        header.text(std::string(placed.padding - kSmallestField, '\0'));
    }
    header.finish();
    Filter content(&out_, options_.deflates);
    pass(file, content);
}

void ZipWriter::add(const ZipEntry& file)
{
    place(file);
    write(placed_.back(), file);
}

std::uint64_t ZipWriter::finish()
{
    ByteStream directory(out_);
    for (const Placed& placed : placed_) {
        const bool far = placed.begin >= kMax32;
        directory.text("PK\x01\x02");
        directory.u16(version(options_.deflates, far), version(options_.deflates, far));
        writeFields(directory, placed.name, options_.deflates, placed.crc, placed.length, placed.whole);
        directory.u16(far ? kFarField : 0, 0, 0, 0);  // the extra field; no comment, first disk, no attributes
        directory.u32(0, far ? kMax32 : placed.begin);
        directory.text(placed.name);
        if (far) {
            directory.u16(0x0001, kFarField - kSmallestField);
            u64(directory, placed.begin);
        }
    }
    const bool large = end_ >= kMax32 || directory_bytes_ >= kMax32 || placed_.size() >= kMax16;
    if (large) {
        constexpr std::uint64_t kFollowing = 44;  // bytes of this part after its length
        directory.text("PK\x06\x06");
        u64(directory, kFollowing);
        directory.u16(version(options_.deflates, true), version(options_.deflates, true));
        directory.u32(0, 0);  // first disk
        u64(directory, placed_.size());
        u64(directory, placed_.size());
        u64(directory, directory_bytes_);
        u64(directory, end_);
        directory.text("PK\x06\x07");
        directory.u32(0);
        u64(directory, end_ + directory_bytes_);
        directory.u32(1);  // one disk
    }
    directory.text("PK\x05\x06");
    const std::uint64_t count = std::min<std::uint64_t>(placed_.size(), kMax16);
    directory.u16(0, 0, count, count);
    directory.u32(std::min(directory_bytes_, kMax32), std::min(end_, kMax32));
    directory.u16(0);
    directory.finish();
    return end_ + directory_bytes_ + (large ? kLargeEnd : 0) + kDirectoryEnd;
}

std::uint64_t writeZip(const std::vector<ZipEntry>& files, std::ostream& out, const ZipOptions& options)
{
    ZipWriter zip(out, options);
    for (const ZipEntry& file : files) {
        zip.place(file);
    }
    for (std::size_t k = 0; k < files.size(); ++k) {
        zip.write(zip.placed_[k], files[k]);
    }
    return zip.finish();
}

}  // namespace droplet
