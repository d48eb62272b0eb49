// SPDX-License-Identifier: GPL-3.0-or-later
// Linux manual: open(2) on O_TMPFILE, linkat(2), rename(2), fsync(2), sync_file_range(2); IEEE Std 1003.1-2017.
#include "droplet/io/output.h"

#include <fcntl.h>
#include <linux/magic.h>
#include <poll.h>
#include <sys/stat.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <optional>
#include <ostream>
#include <streambuf>
#include <string>
#include <system_error>
#include <utility>

#include "droplet/error.h"
#include "droplet/printable.h"

namespace droplet {
namespace {

namespace fs = std::filesystem;

constexpr int kMaxLinks = 40;          // Linux's own limit
constexpr int kMaxLeftovers = 10'000;  // maximum number of temporary names tried; killed processes leave files behind
constexpr mode_t kNewFile = 0666;      // before the umask
constexpr mode_t kPermissions = 0777;  // mode bits kept from a replaced file: no set-id bits
constexpr std::size_t kBufferBytes = std::size_t{1} << 16;

// After this many bytes the file system is asked to begin writing to the disk. For a file of 28 MB the wait at the end
// falls from 11 ms to 4 ms. It is only a hint; pipes and devices refuse it without harm.
constexpr std::uint64_t kWriteBack = std::uint64_t{1} << 22;

constexpr const char* kMustNotBeReplaced = "exists and must not be replaced";

std::string quoted(const fs::path& path)
{
    return '"' + printable(path.string()) + '"';
}

[[noreturn]] void fail(const fs::path& path, const std::string& cause)
{
    throw Error(ErrorCode::OutputFailed, "output " + quoted(path) + ": " + cause);
}

std::string textOf(int error)
{
    return std::generic_category().message(error);
}

class Descriptor {
public:
    explicit Descriptor(int number = -1) : number_(number) {}
    Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
    Descriptor& operator=(Descriptor&& other) noexcept
    {
        std::swap(number_, other.number_);
        return *this;
    }
    ~Descriptor() { close(); }

    [[nodiscard]] int number() const { return number_; }
    [[nodiscard]] bool valid() const { return number_ >= 0; }

    /// Closes the descriptor; returns the error number, or 0. On Linux an interrupted close has closed.
    int close()
    {
        const int number = std::exchange(number_, -1);
        return number < 0 || ::close(number) == 0 || errno == EINTR ? 0 : errno;
    }

private:
    int number_;
};

// Stream buffer on a descriptor that remembers the error number; std::filebuf does not.
class DescriptorBuffer : public std::streambuf {
public:
    explicit DescriptorBuffer(int descriptor) : descriptor_(descriptor) { setp(buffer_.begin(), buffer_.end()); }

    [[nodiscard]] int error() const { return error_; }
    [[nodiscard]] std::uint64_t written() const { return written_; }

protected:
    int_type overflow(int_type c) override
    {
        if (sync() != 0) {
            return traits_type::eof();
        }
        if (!traits_type::eq_int_type(c, traits_type::eof())) {
            sputc(traits_type::to_char_type(c));
        }
        return traits_type::not_eof(c);
    }

    int sync() override
    {
        const bool ok = put(pbase(), static_cast<std::size_t>(pptr() - pbase()));
        setp(buffer_.begin(), buffer_.end());
        return ok ? 0 : -1;
    }

    std::streamsize xsputn(const char* bytes, std::streamsize count) override
    {
        if (count < epptr() - pptr()) {
            return std::streambuf::xsputn(bytes, count);
        }
        return sync() == 0 && put(bytes, static_cast<std::size_t>(count)) ? count : 0;
    }

private:
    bool put(const char* bytes, std::size_t count)
    {
        while (count > 0 && error_ == 0) {
            const ssize_t done = ::write(descriptor_, bytes, count);
            if (done >= 0) {
                bytes += done;
                count -= static_cast<std::size_t>(done);
                const std::uint64_t before = std::exchange(written_, written_ + static_cast<std::uint64_t>(done));
                if (before / kWriteBack != written_ / kWriteBack) {
                    ::sync_file_range(descriptor_, 0, 0, SYNC_FILE_RANGE_WRITE);
                }
            } else if (errno == EAGAIN) {
                pollfd wait{descriptor_, POLLOUT, 0};  // another process made the pipe non-blocking
                ::poll(&wait, 1, -1);
            } else if (errno != EINTR) {
                error_ = errno;
            }
        }
        return error_ == 0;
    }

    int descriptor_;
    int error_ = 0;
    std::uint64_t written_ = 0;
    std::array<char, kBufferBytes> buffer_{};
};

std::uint64_t fill(const fs::path& path, const Descriptor& file, const std::function<void(std::ostream&)>& write)
{
    DescriptorBuffer buffer(file.number());
    std::ostream out(&buffer);
    write(out);
    out.flush();
    if (buffer.error() != 0) {
        fail(path, textOf(buffer.error()));
    }
    if (!out) {
        fail(path, "the stream failed before all data was written");
    }
    return buffer.written();
}

// File at the end of a path, with links followed.
struct Target {
    fs::path path;
    std::optional<struct stat> status;   // empty: no file yet
    std::optional<int> open_descriptor;  // the path is a name of this process's own descriptor, like /dev/stdout
    bool behind_proc = false;            // path through /proc/…/fd: an open file, which is written to, not replaced

    [[nodiscard]] bool replaceable() const { return !behind_proc && (!status || S_ISREG(status->st_mode)); }
    [[nodiscard]] fs::path folder() const { return path.has_parent_path() ? path.parent_path() : fs::path("."); }
};

bool onProc(const fs::path& folder)
{
    struct statfs status = {};
    return ::statfs(folder.c_str(), &status) == 0 && status.f_type == PROC_SUPER_MAGIC;
}

std::optional<int> ownDescriptor(const Target& target)
{
    std::error_code ignored;
    if (!fs::equivalent(target.folder(), "/proc/self/fd", ignored)) {
        return std::nullopt;
    }
    const std::string name = target.path.filename().string();
    int number = 0;
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
    return error == std::errc{} && end == name.data() + name.size() ? std::optional(number) : std::nullopt;
}

Target findTarget(const fs::path& path)
{
    if (path.empty()) {
        fail(path, "the path is empty");
    }
    Target target;
    target.path = path;
    for (int links = 0; links <= kMaxLinks; ++links) {
        struct stat status = {};
        if (::lstat(target.path.c_str(), &status) != 0) {
            if (errno != ENOENT) {
                fail(path, textOf(errno));
            }
            return target;
        }
        if (!S_ISLNK(status.st_mode)) {
            target.status = status;
            return target;
        }
        if (onProc(target.folder())) {
            if (::stat(target.path.c_str(), &status) != 0) {
                fail(path, textOf(errno));
            }
            target.status = status;
            target.behind_proc = true;
            target.open_descriptor = ownDescriptor(target);
            return target;
        }
        std::error_code error;
        const fs::path link = fs::read_symlink(target.path, error);
        if (error) {
            fail(path, error.message());
        }
        target.path = target.folder() / link;
    }
    fail(path, textOf(ELOOP));
}

void checkAccess(const fs::path& place, int mode, const fs::path& path, const std::string& what)
{
    if (::faccessat(AT_FDCWD, place.c_str(), mode, AT_EACCESS) != 0) {
        fail(path, what + textOf(errno));
    }
}

Target findWritable(const fs::path& path, const OutputOptions& options)
{
    Target target = findTarget(path);
    if (target.status && S_ISDIR(target.status->st_mode)) {
        fail(path, textOf(EISDIR));
    }
    if (target.replaceable()) {
        if (target.status && options.no_clobber) {
            fail(path, kMustNotBeReplaced);
        }
        checkAccess(target.folder(), W_OK | X_OK, path, "folder " + quoted(target.folder()) + ": ");
    }
    if (target.status && !target.open_descriptor) {
        checkAccess(target.path, W_OK, path, "");
    }
    return target;
}

/// Names of temporary files for the signal handler, which can use only globals.
struct UnfinishedName {
    std::atomic<bool> taken{false};
    std::atomic<bool> registered{false};
    std::array<char, 4096> path{};
};
static_assert(std::atomic<bool>::is_always_lock_free);
std::array<UnfinishedName, 256> unfinished_names;
std::atomic<bool> is_ending{false};

/// Registers the name of a temporary file for the signal handler, before the file is made.
/// @return null if the list is full
UnfinishedName* registerUnfinished(const fs::path& path)
{
    const std::string& text = path.native();
    UnfinishedName* registered = nullptr;
    for (UnfinishedName& name : unfinished_names) {
        if (text.size() < name.path.size() && !name.taken.exchange(true)) {
            *std::copy(text.begin(), text.end(), name.path.begin()) = '\0';
            name.registered = true;
            registered = &name;
            break;
        }
    }
    while (is_ending) {
        ::pause();
    }
    return registered;
}

void forget(UnfinishedName* registered)
{
    if (registered != nullptr) {
        registered->registered = false;
        registered->taken = false;
    }
}

// File that appears at its path only on commit(). Until then it has no name if the file system allows that, otherwise a
// temporary name that the destructor removes.
class Draft {
public:
    explicit Draft(fs::path folder) : folder_(std::move(folder))
    {
        file_ = Descriptor(::open(folder_.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, kNewFile));
        // commit() needs /proc to name the file; a chroot may have none.
        if (file_.valid() && ::access(procName().c_str(), F_OK) != 0) {
            file_.close();
        }
        if (!file_.valid()) {
            error_ = takeName([this](const char* name) {
                file_ = Descriptor(::open(name, O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, kNewFile));
                return file_.valid();
            });
        }
    }
    Draft(const Draft&) = delete;
    Draft& operator=(const Draft&) = delete;
    ~Draft()
    {
        if (name_) {
            ::unlink(name_->c_str());
        }
        forget(registered_);
    }

    [[nodiscard]] int error() const { return error_; }
    [[nodiscard]] const Descriptor& file() const { return file_; }

    // Permissions are kept as far as possible: a file of another owner becomes ours; if its group cannot be kept, the
    // group's permissions are dropped.
    void takePermissions(const struct stat& replaced)
    {
        const int file = file_.number();
        mode_t mode = replaced.st_mode & kPermissions;
        if (::fchown(file, replaced.st_uid, replaced.st_gid) != 0 &&
            ::fchown(file, static_cast<uid_t>(-1), replaced.st_gid) != 0) {
            mode &= static_cast<mode_t>(~S_IRWXG);
        }
        ::fchmod(file, mode);
    }

    // The data must be on the disk before the file has its name; otherwise a power cut could leave an empty file. This
    // is also the only place where all errors of delayed writing appear.
    int sync() const { return ::fsync(file_.number()) == 0 || errno == EINVAL ? 0 : errno; }

    int commit(const fs::path& place, bool no_clobber)
    {
        if (no_clobber && name_) {
            return moveToFree(place);
        }
        if (!name_) {
            const int error = errorOf(linkTo(place.c_str()));
            if (no_clobber || error != EEXIST) {
                return error;
            }
            if (const int error = takeName([this](const char* name) { return linkTo(name); }); error != 0) {
                return error;
            }
        }
        if (::rename(name_->c_str(), place.c_str()) != 0) {
            return errno;
        }
        name_.reset();
        return 0;
    }

    int close() { return file_.close(); }

private:
    static int errorOf(bool success) { return success ? 0 : errno; }

    [[nodiscard]] std::string procName() const { return "/proc/self/fd/" + std::to_string(file_.number()); }

    [[nodiscard]] bool linkTo(const char* place) const
    {
        return ::linkat(AT_FDCWD, procName().c_str(), AT_FDCWD, place, AT_SYMLINK_FOLLOW) == 0;
    }

    // Some file systems lack RENAME_NOREPLACE, others lack links.
    int moveToFree(const fs::path& place)
    {
        if (::renameat2(AT_FDCWD, name_->c_str(), AT_FDCWD, place.c_str(), RENAME_NOREPLACE) == 0) {
            name_.reset();
            return 0;
        }
        if (errno != EINVAL && errno != ENOSYS) {
            return errno;
        }
        return errorOf(::link(name_->c_str(), place.c_str()) == 0);
    }

    // Tries names until `create` makes a file with a free name.
    template <class Create>
    int takeName(const Create& create)
    {
        for (int i = 0; i < kMaxLeftovers; ++i) {
            const fs::path name =
                folder_ / (".droplet-shape-" + std::to_string(::getpid()) + "-" + std::to_string(i) + ".tmp");
            registered_ = registerUnfinished(name);
            if (create(name.c_str())) {
                name_ = name;
                return 0;
            }
            const int error = errno;
            forget(std::exchange(registered_, nullptr));
            if (error != EEXIST) {
                return error;
            }
        }
        return EEXIST;
    }

    fs::path folder_;
    Descriptor file_;
    std::optional<fs::path> name_;
    UnfinishedName* registered_ = nullptr;
    int error_ = 0;
};

void require(int error, const fs::path& path)
{
    if (error != 0) {
        fail(path, textOf(error));
    }
}

std::uint64_t writeThrough(const fs::path& path, const Target& target, const std::function<void(std::ostream&)>& write)
{
    Descriptor file(target.open_descriptor ? ::fcntl(*target.open_descriptor, F_DUPFD_CLOEXEC, 0)
                                           : ::open(target.path.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY));
    if (!file.valid()) {
        fail(path, textOf(errno));
    }
    const std::uint64_t bytes = fill(path, file, write);
    require(file.close(), path);
    return bytes;
}

std::uint64_t replaceWhole(const fs::path& path, const Target& target, const std::function<void(std::ostream&)>& write,
                           bool no_clobber)
{
    Draft draft(target.folder());
    require(draft.error(), path);
    const std::uint64_t bytes = fill(path, draft.file(), write);
    if (target.status) {
        draft.takePermissions(*target.status);
    }
    require(draft.sync(), path);
    const int error = draft.commit(target.path, no_clobber);
    if (no_clobber && error == EEXIST) {
        fail(path, kMustNotBeReplaced);
    }
    require(error, path);
    require(draft.close(), path);
    return bytes;
}

}  // namespace

void checkWritable(const fs::path& path, const OutputOptions& options)
{
    findWritable(path, options);
}

std::uint64_t writeAtomically(const fs::path& path, const std::function<void(std::ostream&)>& write,
                              const OutputOptions& options)
{
    const Target target = findWritable(path, options);
    return target.replaceable() ? replaceWhole(path, target, write, options.no_clobber)
                                : writeThrough(path, target, write);
}

void removeUnfinished() noexcept
{
    is_ending = true;
    // The second pass catches a file that another thread was about to make when its name was registered.
    for (int k = 0; k < 2; ++k) {
        for (const UnfinishedName& name : unfinished_names) {
            if (name.registered) {
                ::unlink(name.path.data());
            }
        }
        ::poll(nullptr, 0, 1 - k);
    }
}

}  // namespace droplet
