// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/io/output.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/audit.h>
#include <linux/capability.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdio>
#include <fstream>
#include <functional>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "droplet/error.h"
#include "support/paths.h"
#include "support/surfaces.h"

namespace droplet {
namespace {

namespace fs = std::filesystem;

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

const std::string kOld = "what stood here before";

std::function<void(std::ostream&)> text(const std::string& bytes)
{
    return [bytes](std::ostream& out) { out << bytes; };
}

std::string contentOf(const fs::path& path)
{
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

void store(const fs::path& path, const std::string& bytes)
{
    std::ofstream(path, std::ios::binary) << bytes;
}

mode_t modeOf(const fs::path& path)
{
    struct stat status = {};
    EXPECT_EQ(::stat(path.c_str(), &status), 0);
    return status.st_mode & 07777;
}

// Message of the Error thrown; empty if none.
std::string complaint(const std::function<void()>& act)
{
    try {
        act();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::OutputFailed);
        EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
        return error.what();
    }
    return "";
}

// Runs a function in its own process, where limits and rights can be lowered; returns the exit status.
int inChild(const std::function<void()>& act)
{
    std::fflush(nullptr);
    const pid_t child = ::fork();
    if (child == 0) {
        try {
            act();
        } catch (const std::exception& error) {
            ::_exit(std::string(error.what()).find("child: ") == 0 ? 2 : 3);
        }
        ::_exit(0);
    }
    int status = 0;
    EXPECT_EQ(::waitpid(child, &status, 0), child);
    return status;
}

void demand(bool condition)
{
    if (!condition) {
        throw std::logic_error("child: not as demanded");
    }
}

// Drops root's privileges, so that permissions apply.
void giveUpCapabilities()
{
    __user_cap_header_struct header = {_LINUX_CAPABILITY_VERSION_3, 0};
    std::array<__user_cap_data_struct, 2> none{};
    demand(::syscall(SYS_capset, &header, none.data()) == 0);
}

// Simulates a file system without nameless files and, optionally, without RENAME_NOREPLACE.
void withoutNamelessFiles(bool without_noreplace)
{
    constexpr auto kFlags = static_cast<__u32>(offsetof(seccomp_data, args) + 2 * sizeof(__u64));
    constexpr auto kRenameFlags = static_cast<__u32>(offsetof(seccomp_data, args) + 4 * sizeof(__u64));
    constexpr __u32 kNameless = O_TMPFILE & ~O_DIRECTORY;
    std::array<sock_filter, 10> rules = {{
        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_openat, 0, 3),
        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, kFlags),
        BPF_JUMP(BPF_JMP | BPF_JSET | BPF_K, kNameless, 0, 5),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EOPNOTSUPP),
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, without_noreplace ? SYS_renameat2 : 0xffffffff, 0, 3),
        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, kRenameFlags),
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, 0, 1, 0),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EINVAL),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
    }};
    const sock_fprog program = {static_cast<unsigned short>(rules.size()), rules.data()};
    demand(::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0);
    demand(::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0);
    demand(::open("/tmp", O_TMPFILE | O_WRONLY, 0600) == -1 && errno == EOPNOTSUPP);
}

class Output : public ::testing::Test {
protected:
    void SetUp() override
    {
        fs::create_directories(testing::kScratchDir);
        std::string pattern = (fs::path(testing::kScratchDir) / "output-XXXXXX").string();
        ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
        folder = pattern;
        target = folder / "droplet.glb";
    }
    void TearDown() override
    {
        fs::permissions(folder, fs::perms::owner_all);
        fs::remove_all(folder);
    }

    [[nodiscard]] std::vector<std::string> names() const
    {
        std::vector<std::string> found;
        for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
            found.push_back(entry.path().filename().string());
        }
        std::sort(found.begin(), found.end());
        return found;
    }

    [[nodiscard]] bool knowsNamelessFiles() const
    {
        const int file = ::open(folder.c_str(), O_TMPFILE | O_WRONLY, 0600);
        if (file >= 0) {
            ::close(file);
        }
        return file >= 0;
    }

    fs::path folder;
    fs::path target;
};

// Files that appear together, as the pictures of a turntable do: 360 inside one another, each with a stream.
TEST_F(Output, HundredsOfFilesAreWrittenInsideOneAnother)
{
    constexpr int kFiles = 360;
    const std::function<void(int)> write = [&](int k) {
        (void)writeAtomically(folder / std::to_string(k), [&](std::ostream& out) {
            out << k;
            if (k + 1 < kFiles) {
                write(k + 1);
            }
        });
    };
    write(0);
    EXPECT_EQ(contentOf(folder / "0"), "0");
    EXPECT_EQ(contentOf(folder / std::to_string(kFiles - 1)), std::to_string(kFiles - 1));
}

TEST_F(Output, WritesEveryByteAndCountsThem)
{
    for (const std::size_t size : {0U, 1U, 65535U, 65536U, 65537U, 9'500'000U}) {
        std::string bytes(size, ' ');
        for (std::size_t i = 0; i < size; ++i) {
            bytes[i] = static_cast<char>(i * 31);
        }
        EXPECT_EQ(writeAtomically(target, text(bytes)), size);
        EXPECT_EQ(contentOf(target), bytes);
        // The same data in small pieces and single characters, across the buffer's end.
        const auto in_pieces = [&](std::ostream& out) {
            for (std::size_t i = 0; i < size; i += 8) {
                out.put(bytes[i]);
                out.write(bytes.data() + i + 1, static_cast<std::streamsize>(std::min<std::size_t>(7, size - i - 1)));
            }
        };
        EXPECT_EQ(writeAtomically(target, in_pieces), size);
        EXPECT_EQ(contentOf(target), bytes);
    }
    EXPECT_THAT(names(), ElementsAre("droplet.glb"));
}

TEST_F(Output, WritesAWholeSurfaceInEveryFormat)
{
    const Surface surface = testing::roundDroplet();
    for (const Format format : {Format::Glb, Format::Gltf, Format::Obj, Format::Ply, Format::Stl}) {
        std::ostringstream expected;
        const std::uint64_t size = writeSurface(surface, expected, format);
        EXPECT_EQ(size, expected.str().size());
        const auto bytes = writeAtomically(target, [&](std::ostream& out) { writeSurface(surface, out, format); });
        EXPECT_EQ(bytes, expected.str().size());
        EXPECT_EQ(contentOf(target), expected.str());
    }
}

TEST_F(Output, AnExistingFileIsReplacedAndKeepsItsPermissions)
{
    for (const mode_t mode : {0600U, 0640U, 0664U, 0755U}) {
        store(target, kOld);
        ASSERT_EQ(::chmod(target.c_str(), mode), 0);
        writeAtomically(target, text("new"));
        EXPECT_EQ(contentOf(target), "new");
        EXPECT_EQ(modeOf(target), mode);
    }
    EXPECT_THAT(names(), ElementsAre("droplet.glb"));
}

TEST_F(Output, ANewFileHasThePermissionsOfAnyNewFile)
{
    const mode_t before = ::umask(027);
    writeAtomically(target, text("new"));
    ::umask(before);
    EXPECT_EQ(modeOf(target), 0640U);
}

TEST_F(Output, TheFileAppearsOnlyWhenComplete)
{
    store(target, kOld);
    writeAtomically(target, [&](std::ostream& out) {
        out << std::string(200'000, 'x') << std::flush;
        EXPECT_EQ(contentOf(target), kOld);
    });
    EXPECT_EQ(contentOf(target), std::string(200'000, 'x'));
}

TEST_F(Output, ExceptionsOfTheWriterPassAndNothingChanges)
{
    const auto break_off = [](std::ostream& out) {
        out << std::string(200'000, 'x');
        throw std::out_of_range("mid-way");
    };
    EXPECT_THROW(writeAtomically(target, break_off), std::out_of_range);
    EXPECT_THAT(names(), IsEmpty());
    store(target, kOld);
    EXPECT_THROW(writeAtomically(target, break_off), std::out_of_range);
    EXPECT_EQ(contentOf(target), kOld);
    EXPECT_THAT(names(), ElementsAre("droplet.glb"));
}

TEST_F(Output, AFailedStreamIsAFailedFile)
{
    store(target, kOld);
    const std::string said = complaint([&] {
        writeAtomically(target, [](std::ostream& out) {
            out << "half";
            out.setstate(std::ios::badbit);
        });
    });
    EXPECT_THAT(said, HasSubstr(target.string()));
    EXPECT_EQ(contentOf(target), kOld);
    EXPECT_THAT(names(), ElementsAre("droplet.glb"));
}

TEST_F(Output, AFullDiskIsReportedAndTheOldFileStays)
{
    store(target, kOld);
    const int status = inChild([&] {
        ::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit = {100'000, 100'000};
        demand(::setrlimit(RLIMIT_FSIZE, &limit) == 0);
        const std::string said = complaint([&] { writeAtomically(target, text(std::string(100'001, 'x'))); });
        demand(said.find("File too large") != std::string::npos);
    });
    EXPECT_EQ(status, 0);
    EXPECT_EQ(contentOf(target), kOld);
    EXPECT_THAT(names(), ElementsAre("droplet.glb"));
}

TEST_F(Output, DevFullIsFullForManyBytesAndForFew)
{
    for (const std::size_t size : {1U, 1'000'000U}) {
        EXPECT_THAT(complaint([&] { writeAtomically("/dev/full", text(std::string(size, 'x'))); }),
                    HasSubstr("output \"/dev/full\": No space left on device"));
    }
    for (const Format format : {Format::Glb, Format::Gltf, Format::Obj, Format::Ply, Format::Stl}) {
        EXPECT_NE(complaint([&] {
                      writeAtomically("/dev/full",
                                      [&](std::ostream& out) { writeSurface(testing::roundDroplet(), out, format); });
                  }),
                  "");
    }
    EXPECT_NO_THROW(checkWritable("/dev/full"));
}

TEST_F(Output, DevNullTakesEverythingEvenWithNoClobber)
{
    EXPECT_EQ(writeAtomically("/dev/null", text("gone"), {.no_clobber = true}), 4U);
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

struct Hopeless {
    const char* what;
    std::function<fs::path(const fs::path& folder)> place;
    const char* cause;
};

TEST_F(Output, CheckingFindsUnwritablePaths)
{
    store(folder / "file", kOld);
    fs::create_directory(folder / "folder");
    fs::create_symlink("folder", folder / "link to folder");
    fs::create_symlink("loop", folder / "loop");
    fs::create_symlink("missing/droplet.glb", folder / "link to missing folder");
    const auto before = names();
    const std::vector<Hopeless> cases = {
        {"missing folder", [](const fs::path& f) { return f / "missing" / "droplet.glb"; },
         "No such file or directory"},
        {"missing folder behind a link", [](const fs::path& f) { return f / "link to missing folder"; },
         "No such file or directory"},
        {"a file for a folder", [](const fs::path& f) { return f / "file" / "droplet.glb"; }, "Not a directory"},
        {"a folder", [](const fs::path& f) { return f / "folder"; }, "Is a directory"},
        {"a folder by its slash", [](const fs::path& f) { return f / "folder" / ""; }, "Is a directory"},
        {"a link to a folder", [](const fs::path& f) { return f / "link to folder"; }, "Is a directory"},
        {"a missing folder by its slash", [](const fs::path& f) { return f / "missing" / ""; },
         "No such file or directory"},
        {"a link to itself", [](const fs::path& f) { return f / "loop"; }, "Too many levels of symbolic links"},
        {"a name too long", [](const fs::path& f) { return f / std::string(256, 'x'); }, "File name too long"},
        {"no name", [](const fs::path&) { return fs::path(); }, "empty"},
    };
    for (const Hopeless& hopeless : cases) {
        SCOPED_TRACE(hopeless.what);
        const fs::path place = hopeless.place(folder);
        EXPECT_THAT(complaint([&] { checkWritable(place); }), HasSubstr(hopeless.cause));
        bool called = false;
        EXPECT_THAT(complaint([&] { writeAtomically(place, [&](std::ostream&) { called = true; }); }),
                    HasSubstr(hopeless.cause));
        EXPECT_FALSE(called);
    }
    EXPECT_EQ(names(), before);
    EXPECT_EQ(contentOf(folder / "file"), kOld);
}

TEST_F(Output, ProcTakesNoNewFiles)
{
    EXPECT_THAT(complaint([] { writeAtomically("/proc/droplet.glb", text("new")); }), HasSubstr("/proc/droplet.glb"));
}

TEST_F(Output, ReadOnlyFoldersAndFilesAreRefused)
{
    store(target, kOld);
    const int folder_status = inChild([&] {
        giveUpCapabilities();
        fs::permissions(folder, fs::perms::owner_read | fs::perms::owner_exec);
        for (const fs::path& place : {target, folder / "new.glb"}) {
            demand(complaint([&] { checkWritable(place); }).find("Permission denied") != std::string::npos);
            demand(complaint([&] { writeAtomically(place, text("new")); }).find("Permission denied") !=
                   std::string::npos);
        }
    });
    EXPECT_EQ(folder_status, 0);
    fs::permissions(folder, fs::perms::owner_all);
    const int file_status = inChild([&] {
        giveUpCapabilities();
        fs::permissions(target, fs::perms::owner_read);
        demand(complaint([&] { checkWritable(target); }).find("Permission denied") != std::string::npos);
        demand(complaint([&] { writeAtomically(target, text("new")); }).find("Permission denied") != std::string::npos);
    });
    EXPECT_EQ(file_status, 0);
    EXPECT_EQ(contentOf(target), kOld);
    EXPECT_THAT(names(), ElementsAre("droplet.glb"));
}

TEST_F(Output, CheckingWritesNothing)
{
    checkWritable(target);
    checkWritable(target, {.no_clobber = true});
    EXPECT_THAT(names(), IsEmpty());
    store(target, kOld);
    checkWritable(target);
    EXPECT_EQ(contentOf(target), kOld);
    EXPECT_THAT(names(), ElementsAre("droplet.glb"));
}

TEST_F(Output, NoClobberRefusesAnExistingFile)
{
    store(target, kOld);
    const std::string cause = "output \"" + target.string() + "\": exists and must not be replaced";
    EXPECT_EQ(complaint([&] { checkWritable(target, {.no_clobber = true}); }), cause);
    EXPECT_EQ(complaint([&] { writeAtomically(target, text("new"), {.no_clobber = true}); }), cause);
    EXPECT_EQ(contentOf(target), kOld);
}

TEST_F(Output, NoClobberRefusesAFileThatAppearedMeanwhile)
{
    const std::string said = complaint([&] {
        writeAtomically(target,
                        [&](std::ostream& out) {
                            out << "new";
                            store(target, kOld);
                        },
                        {.no_clobber = true});
    });
    EXPECT_THAT(said, HasSubstr("exists and must not be replaced"));
    EXPECT_EQ(contentOf(target), kOld);
    EXPECT_THAT(names(), ElementsAre("droplet.glb"));
}

TEST_F(Output, NoClobberWritesANewFile)
{
    EXPECT_EQ(writeAtomically(target, text("new"), {.no_clobber = true}), 3U);
    EXPECT_EQ(contentOf(target), "new");
    EXPECT_THAT(names(), ElementsAre("droplet.glb"));
}

TEST_F(Output, WorksWithoutNamelessFiles)
{
    for (const bool without_noreplace : {false, true}) {
        const fs::path fresh = folder / "fresh.glb";
        fs::remove(fresh);
        store(target, kOld);
        ASSERT_EQ(::chmod(target.c_str(), 0604), 0);
        const int status = inChild([&] {
            withoutNamelessFiles(without_noreplace);
            const fs::path leftover = folder / (".droplet-shape-" + std::to_string(::getpid()) + "-0.tmp");
            store(leftover, "of another");
            bool threw = false;
            try {
                writeAtomically(target, [&](std::ostream& out) {
                    out << "half" << std::flush;
                    demand(names().size() == 3);
                    throw std::out_of_range("mid-way");
                });
            } catch (const std::out_of_range&) {
                threw = true;
            }
            demand(threw);
            demand(contentOf(leftover) == "of another" && ::unlink(leftover.c_str()) == 0);
            demand(names().size() == 1 && contentOf(target) == kOld);
            demand(writeAtomically(target, text("new")) == 3);
            demand(contentOf(target) == "new" && modeOf(target) == 0604);
            demand(writeAtomically(fresh, text("fresh"), {.no_clobber = true}) == 5);
            demand(contentOf(fresh) == "fresh");
            demand(::unlink(fresh.c_str()) == 0);
            const std::string said = complaint(
                [&] { writeAtomically(fresh, [&](std::ostream&) { store(fresh, kOld); }, {.no_clobber = true}); });
            demand(said.find("exists and must not be replaced") != std::string::npos);
            demand(contentOf(fresh) == kOld);
        });
        EXPECT_EQ(status, 0) << WEXITSTATUS(status);
        EXPECT_THAT(names(), ElementsAre("droplet.glb", "fresh.glb"));
    }
}

TEST_F(Output, AKilledProcessLeavesNothingBehind)
{
    if (!knowsNamelessFiles()) {
        GTEST_SKIP() << "the file system knows no files without a name";
    }
    store(target, kOld);
    const int status = inChild([&] {
        writeAtomically(target, [](std::ostream& out) {
            out << std::string(200'000, 'x') << std::flush;
            ::raise(SIGKILL);
        });
    });
    EXPECT_TRUE(WIFSIGNALED(status));
    EXPECT_EQ(contentOf(target), kOld);
    EXPECT_THAT(names(), ElementsAre("droplet.glb"));
}

TEST_F(Output, ASignalHandlerRemovesUnfinishedFiles)
{
    store(target, kOld);
    const int status = inChild([&] {
        withoutNamelessFiles(false);
        struct sigaction action = {};
        action.sa_handler = [](int signal) {
            removeUnfinished();
            std::signal(signal, SIG_DFL);
            ::raise(signal);
        };
        demand(::sigaction(SIGTERM, &action, nullptr) == 0);
        writeAtomically(target, [&](std::ostream& out) {
            out << std::string(200'000, 'x') << std::flush;
            demand(names().size() == 2);
            ::raise(SIGTERM);
        });
    });
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGTERM) << status;
    EXPECT_EQ(contentOf(target), kOld);
    EXPECT_THAT(names(), ElementsAre("droplet.glb"));
}

TEST_F(Output, LeftoversOfOthersStay)
{
    const std::string leftover = ".droplet-shape-" + std::to_string(::getpid()) + "-0.tmp";
    store(folder / leftover, kOld);
    writeAtomically(target, text("new"));
    EXPECT_EQ(contentOf(target), "new");
    EXPECT_EQ(contentOf(folder / leftover), kOld);
    EXPECT_THAT(names(), ElementsAre(leftover, "droplet.glb"));
}

TEST_F(Output, ALinkIsFollowedAndKept)
{
    fs::create_directory(folder / "elsewhere");
    const fs::path real = folder / "elsewhere" / "real.glb";
    fs::create_symlink("elsewhere/real.glb", folder / "near");
    fs::create_symlink(folder / "near", target);
    for (const char* content : {"into a dangling link", "into the file it points to"}) {
        writeAtomically(target, text(content));
        EXPECT_EQ(contentOf(real), content);
        EXPECT_FALSE(fs::is_symlink(real));
        EXPECT_EQ(fs::read_symlink(target), folder / "near");
        EXPECT_EQ(fs::read_symlink(folder / "near"), "elsewhere/real.glb");
    }
    EXPECT_THAT(complaint([&] { writeAtomically(target, text("new"), {.no_clobber = true}); }), HasSubstr("exists"));
    EXPECT_THAT(names(), ElementsAre("droplet.glb", "elsewhere", "near"));
}

TEST_F(Output, ARelativeNameMeansTheWorkingFolder)
{
    const int status = inChild([&] {
        fs::current_path(folder);
        writeAtomically("droplet.glb", text("new"));
    });
    EXPECT_EQ(status, 0);
    EXPECT_EQ(contentOf(target), "new");
}

TEST_F(Output, TheLongestNameIsAccepted)
{
    const fs::path longest = folder / std::string(255, 'x');
    writeAtomically(longest, text("new"));
    EXPECT_EQ(contentOf(longest), "new");
}

TEST_F(Output, ALineBreakInANameDoesNotBreakTheMessage)
{
    EXPECT_THAT(complaint([&] { checkWritable(folder / "a\nb" / "c"); }), HasSubstr("a\\nb/c"));
}

TEST_F(Output, APipeGetsEverything)
{
    const fs::path pipe = folder / "pipe";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    const std::string bytes(300'000, 'x');
    std::string received;
    std::thread reader([&] { received = contentOf(pipe); });
    EXPECT_EQ(writeAtomically(pipe, text(bytes), {.no_clobber = true}), bytes.size());
    reader.join();
    EXPECT_EQ(received, bytes);
    EXPECT_TRUE(fs::is_fifo(pipe));
}

TEST_F(Output, StandardOutputIsAppendedToNotReplaced)
{
    for (const char* place : {"/dev/stdout", "/proc/self/fd/1", "/dev/fd/1"}) {
        store(target, "before ");
        const int status = inChild([&] {
            const int file = ::open(target.c_str(), O_WRONLY | O_APPEND);
            demand(::dup2(file, STDOUT_FILENO) == STDOUT_FILENO);
            checkWritable(place, {.no_clobber = true});
            demand(writeAtomically(place, text("between "), {.no_clobber = true}) == 8);
            demand(::write(STDOUT_FILENO, "after", 5) == 5);
        });
        EXPECT_EQ(status, 0) << place;
        EXPECT_EQ(contentOf(target), "before between after") << place;
    }
    EXPECT_THAT(names(), ElementsAre("droplet.glb"));
}

TEST_F(Output, APipeWithoutReaderIsReported)
{
    const int status = inChild([] {
        ::signal(SIGPIPE, SIG_IGN);
        std::array<int, 2> ends{};
        demand(::pipe(ends.data()) == 0);
        ::close(ends[0]);
        demand(::dup2(ends[1], STDOUT_FILENO) == STDOUT_FILENO);
        const std::string said = complaint([] { writeAtomically("/dev/stdout", text("unheard")); });
        demand(said.find("Broken pipe") != std::string::npos);
    });
    EXPECT_EQ(status, 0);
}

TEST_F(Output, ANonBlockingPipeIsWaitedFor)
{
    std::array<int, 2> ends{};
    ASSERT_EQ(::pipe2(ends.data(), O_NONBLOCK), 0);
    const std::string bytes(1'000'000, 'x');
    std::string received;
    std::thread reader([&] {
        std::array<char, 4096> chunk{};
        while (received.size() < bytes.size()) {
            const ssize_t count = ::read(ends[0], chunk.data(), chunk.size());
            if (count > 0) {
                received.append(chunk.data(), static_cast<std::size_t>(count));
            }
        }
    });
    EXPECT_EQ(writeAtomically("/proc/self/fd/" + std::to_string(ends[1]), text(bytes)), bytes.size());
    reader.join();
    ::close(ends[0]);
    ::close(ends[1]);
    EXPECT_EQ(received, bytes);
}

TEST_F(Output, OfTwoConcurrentWritesOneIsComplete)
{
    const auto write_many = [&](char letter) {
        for (int i = 0; i < 50; ++i) {
            writeAtomically(target, text(std::string(100'000, letter)));
        }
    };
    std::thread other(write_many, 'a');
    write_many('b');
    other.join();
    const std::string found = contentOf(target);
    EXPECT_TRUE(found == std::string(100'000, 'a') || found == std::string(100'000, 'b'));
    EXPECT_THAT(names(), ElementsAre("droplet.glb"));
}

TEST(FormatNamed, KnowsNamesAndExtensions)
{
    for (const Format format : {Format::Glb, Format::Gltf, Format::Obj, Format::Ply, Format::Stl, Format::Usda,
                                Format::Usdz, Format::ThreeMf}) {
        EXPECT_EQ(formatNamed(name(format)), format);
        EXPECT_EQ(formatNamed(std::string(".") + name(format)), format);
    }
    EXPECT_STREQ(name(Format::Glb), "glb");
    EXPECT_STREQ(name(Format::Gltf), "gltf");
    EXPECT_STREQ(name(Format::Obj), "obj");
    EXPECT_STREQ(name(Format::Ply), "ply");
    EXPECT_STREQ(name(Format::Stl), "stl");
    EXPECT_STREQ(name(Format::Usda), "usda");
    EXPECT_STREQ(name(Format::Usdz), "usdz");
    EXPECT_EQ(formatNamed(".GLB"), Format::Glb);
    EXPECT_EQ(formatNamed("Ply"), Format::Ply);
}

TEST(FormatNamed, RefusesOtherNames)
{
    for (const char* wrong : {"", ".", "..glb", "glb ", "3ds", "gl", "glbx"}) {
        try {
            formatNamed(wrong);
            ADD_FAILURE() << wrong;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::InvalidArgument);
            const std::string shown = wrong[0] == '.' ? wrong + 1 : wrong;
            EXPECT_EQ(error.what(),
                      "format is '" + shown + "', must be one of glb, gltf, obj, ply, stl, usda, usdz, 3mf");
        }
    }
}

TEST(WriteSurface, GivesVolumeToClosedSurfacesOnly)
{
    for (const bool open : {true, false}) {
        std::ostringstream out;
        writeSurface(testing::roundDroplet({.open = open}), out, Format::Glb);
        EXPECT_EQ(out.str().find("KHR_materials_volume") == std::string::npos, open);
        EXPECT_THAT(out.str(), HasSubstr("KHR_materials_transmission"));
    }
}

TEST(WriteSurface, UsesAKnownClosedFlag)
{
    const Surface closed = testing::roundDroplet();
    for (const Format format : {Format::Glb, Format::Gltf}) {
        std::ostringstream unknown;
        std::ostringstream known;
        std::ostringstream said_open;
        writeSurface(closed, unknown, format);
        writeSurface(closed, known, format, {.closed = true});
        writeSurface(closed, said_open, format, {.closed = false});
        EXPECT_EQ(unknown.str(), known.str());
        EXPECT_THAT(known.str(), HasSubstr("KHR_materials_volume"));
        EXPECT_THAT(said_open.str(), Not(HasSubstr("KHR_materials_volume")));
    }
}

TEST(WriteSurface, PassesTheMaterialOn)
{
    std::ostringstream out;
    writeSurface(testing::roundDroplet(), out, Format::Gltf, {.material = Material::Mercury});
    EXPECT_THAT(out.str(), HasSubstr("\"name\": \"mercury\""));
}

}  // namespace
}  // namespace droplet
