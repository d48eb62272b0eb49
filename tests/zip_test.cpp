// SPDX-License-Identifier: GPL-3.0-or-later
// Archives: what is in them, and large ones, read by Python's zipfile.
#include "droplet/zip.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <ostream>
#include <sstream>
#include <streambuf>
#include <string>
#include <vector>

#include "droplet/error.h"
#include "support/command.h"
#include "support/paths.h"

namespace droplet {
namespace {

using ::testing::HasSubstr;

ZipEntry entry(const std::string& name, const std::string& text)
{
    return {name, [text](std::ostream& out) { out << text << '.'; }};
}

class ZipTest : public ::testing::Test {
protected:
    /// Writes an archive with one file after another.
    [[nodiscard]] std::uint64_t write(const std::vector<ZipEntry>& files, const ZipOptions& options) const
    {
        std::ofstream out(path(), std::ios::binary);
        ZipWriter zip(out, options);
        for (const ZipEntry& file : files) {
            zip.add(file);
        }
        return zip.finish();
    }

    /// What a line of Python prints of the archive `z`, once all its checksums are found right.
    [[nodiscard]] std::string python(const std::string& line) const
    {
        const auto run = testing::runProgram({"python3", "-c",
                                              "import zipfile, sys\n"
                                              "z = zipfile.ZipFile(sys.argv[1])\n"
                                              "assert z.testzip() is None\n" +
                                                  line,
                                              path()});
        EXPECT_EQ(run.exit_code, 0) << run.error;
        return run.output;
    }

    [[nodiscard]] std::string path() const { return (scratch_.path() / "files.zip").string(); }

private:
    testing::ScratchDirectory scratch_;
};

TEST_F(ZipTest, HoldsFilesAsTheyAre)
{
    for (const bool deflates : {false, true}) {
        const std::vector<ZipEntry> files{entry("a.txt", std::string(100'000, 'a')), entry("größe.txt", "b"),
                                          entry("folder/c", "")};
        const ZipOptions options{.deflates = deflates};
        const std::uint64_t bytes = write(files, options);
        const std::string file = testing::readFile(path());
        EXPECT_EQ(bytes, file.size());
        EXPECT_EQ(file.size() < 2000, deflates);
        EXPECT_EQ(
            python("print([(i.filename, i.file_size, i.date_time[0]) for i in z.infolist()], z.read('folder/c'))"),
            "[('a.txt', 100001, 1980), ('größe.txt', 2, 1980), ('folder/c', 1, 1980)] b'.'\n");
        std::ostringstream whole;
        EXPECT_EQ(writeZip(files, whole, options), bytes);
        EXPECT_EQ(whole.str(), file);
    }
}

TEST_F(ZipTest, MoreFilesThanACountOfSixteenBitsHolds)
{
    const std::vector<ZipEntry> files(65'535, entry("a", "b"));
    const std::uint64_t bytes = write(files, {.zip64 = true});
    EXPECT_EQ(bytes, testing::readFile(path()).size());
    EXPECT_EQ(python("print(len(z.namelist()))"), "65535\n");
    std::ostringstream out;
    try {
        writeZip(files, out, {.kind = "USDZ"});
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::InvalidArgument);
        EXPECT_THAT(error.what(), HasSubstr("USDZ file"));
        EXPECT_THAT(error.what(), HasSubstr("fewer than 65535 files"));
    }
    EXPECT_EQ(out.str(), "");
}

/// File of zeros, which cost a checksum alone.
ZipEntry zeros(std::size_t mebibytes)
{
    return {"zeros", [mebibytes](std::ostream& out) {
                const std::string part(std::size_t{1} << 20, '\0');
                for (std::size_t k = 0; k < mebibytes; ++k) {
                    out << part;
                }
            }};
}

TEST_F(ZipTest, RefusesFilesOfFourGibibytes)
{
    std::ostringstream out;
    ZipWriter zip(out, {.zip64 = true});
    try {
        zip.add(zeros(4096));
        FAIL();
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("'zeros' has 4294967296 bytes"));
    }
    EXPECT_EQ(out.str(), "");
}

/// Stream that keeps its last bytes alone.
class Tail : public std::streambuf {
public:
    [[nodiscard]] const std::string& bytes() const { return bytes_; }

protected:
    std::streamsize xsputn(const char* bytes, std::streamsize count) override
    {
        constexpr std::size_t kKept = 300;
        bytes_.append(bytes, static_cast<std::size_t>(count));
        bytes_.erase(0, bytes_.size() - std::min(bytes_.size(), kKept));
        return count;
    }

private:
    std::string bytes_;
};

TEST_F(ZipTest, PlacesFilesBeyondFourGibibytes)
{
    Tail tail;
    std::ostream out(&tail);
    ZipWriter zip(out, {.zip64 = true});
    zip.add(zeros(2048));
    zip.add(zeros(2048));
    zip.add(entry("far", "b"));
    constexpr std::uint64_t kFar = 2 * ((std::uint64_t{2048} << 20) + 30 + 5);
    constexpr std::uint64_t kDirectory = kFar + 30 + 3 + 2;
    constexpr std::uint64_t kDirectoryBytes = 2 * (46 + 5) + 46 + 3 + 12;
    EXPECT_EQ(zip.finish(), kDirectory + kDirectoryBytes + 56 + 20 + 22);

    const auto number = [&](std::size_t from_end, std::size_t size) {
        std::uint64_t value = 0;
        for (std::size_t k = size; k-- > 0;) {
            value = 256 * value + static_cast<unsigned char>(tail.bytes()[tail.bytes().size() - from_end + k]);
        }
        return value;
    };
    EXPECT_EQ(number(22, 4), 0x06054b50U);
    EXPECT_EQ(number(6, 4), 0xffffffffU);  // where the directory is: look it up in the large one
    EXPECT_EQ(number(22 + 20, 4), 0x07064b50U);
    EXPECT_EQ(number(22 + 20 - 8, 8), kDirectory + kDirectoryBytes);
    EXPECT_EQ(number(22 + 20 + 56, 4), 0x06064b50U);
    EXPECT_EQ(number(22 + 20 + 8, 8), kDirectory);
    EXPECT_EQ(number(22 + 20 + 56 + 8, 8), kFar);  // the last file's extra field
    EXPECT_EQ(number(22 + 20 + 56 + 12, 4), 0x00080001U);
}

}  // namespace
}  // namespace droplet
