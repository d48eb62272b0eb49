// SPDX-License-Identifier: GPL-3.0-or-later
// Linux manual: open(2) on O_TMPFILE, linkat(2), rename(2), fsync(2), sync_file_range(2); IEEE Std 1003.1-2017.
#include "io/draft.h"

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
#include <string>
#include <system_error>
#include <utility>

#include "droplet/printable.h"

namespace droplet {
namespace {

namespace fs = std::filesystem;

constexpr int kMaxLinks = 40;          // Linux's own limit
constexpr int kMaxLeftovers = 10'000;  // maximum number of temporary names tried; killed processes leave files behind
constexpr mode_t kNewFile = 0666;      // before the umask
constexpr mode_t kPermissions = 0777;  // mode bits kept from a replaced file: no set-id bits

// After this many bytes the file system is asked to begin writing to the disk. For a file of 28 MB the wait at the end
// falls from 11 ms to 4 ms. It is only a hint; pipes and devices refuse it without harm.
constexpr std::uint64_t kWriteBack = std::uint64_t{1} << 22;

std::string quoted(const fs::path& path)
{
    return '"' + printable(path.string()) + '"';
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
        throwOutputFailed(path, "the path is empty");
    }
    Target target;
    target.path = path;
    for (int links = 0; links <= kMaxLinks; ++links) {
        struct stat status = {};
        if (::lstat(target.path.c_str(), &status) != 0) {
            if (errno != ENOENT) {
                throwOutputFailed(path, textOf(errno));
            }
            return target;
        }
        if (!S_ISLNK(status.st_mode)) {
            target.status = status;
            return target;
        }
        if (onProc(target.folder())) {
            if (::stat(target.path.c_str(), &status) != 0) {
                throwOutputFailed(path, textOf(errno));
            }
            target.status = status;
            target.behind_proc = true;
            target.open_descriptor = ownDescriptor(target);
            return target;
        }
        std::error_code error;
        const fs::path link = fs::read_symlink(target.path, error);
        if (error) {
            throwOutputFailed(path, error.message());
        }
        target.path = target.folder() / link;
    }
    throwOutputFailed(path, textOf(ELOOP));
}

void checkAccess(const fs::path& place, int mode, const fs::path& path, const std::string& what)
{
    if (::faccessat(AT_FDCWD, place.c_str(), mode, AT_EACCESS) != 0) {
        throwOutputFailed(path, what + textOf(errno));
    }
}

Target findWritable(const fs::path& path, const OutputOptions& options)
{
    Target target = findTarget(path);
    if (target.status && S_ISDIR(target.status->st_mode)) {
        throwOutputFailed(path, textOf(EISDIR));
    }
    if (target.replaceable()) {
        if (target.status && options.no_clobber) {
            throwMustNotBeReplaced(path);
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

// File that appears at its path only when it is moved there. Until then it has no name if the file system allows that,
// otherwise a temporary name that the destructor removes.
class UnnamedFile {
public:
    explicit UnnamedFile(fs::path folder) : folder_(std::move(folder))
    {
        file_ = Descriptor(::open(folder_.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, kNewFile));
        // moveTo() needs /proc to name the file; a chroot may have none.
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
    UnnamedFile(const UnnamedFile&) = delete;
    UnnamedFile& operator=(const UnnamedFile&) = delete;
    ~UnnamedFile()
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

    int moveTo(const fs::path& place, bool no_clobber)
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
        throwOutputFailed(path, textOf(error));
    }
}

/// Opens a device, a pipe or an open file for writing.
Descriptor openThrough(const Target& target)
{
    return Descriptor(target.open_descriptor ? ::fcntl(*target.open_descriptor, F_DUPFD_CLOEXEC, 0)
                                             : ::open(target.path.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY));
}

}  // namespace

void checkWritable(const fs::path& path, const OutputOptions& options)
{
    findWritable(path, options);
}

struct Draft::State {
    fs::path path;
    bool no_clobber;
    Target target;
    std::optional<UnnamedFile> unnamed;  ///< of a file
    std::optional<Descriptor> through;   ///< to a device, a pipe or an open file
    int descriptor = 0;
    int error = 0;
    std::uint64_t written = 0;
};

Draft::Draft(const fs::path& path, const OutputOptions& options)
    : state_(new State{path, options.no_clobber, findWritable(path, options), {}, {}})
{
    if (state_->target.replaceable()) {
        const UnnamedFile& file = state_->unnamed.emplace(state_->target.folder());
        require(file.error(), path);
        state_->descriptor = file.file().number();
    } else {
        const Descriptor& file = state_->through.emplace(openThrough(state_->target));
        require(file.valid() ? 0 : errno, path);
        state_->descriptor = file.number();
    }
}

Draft::~Draft() = default;

bool Draft::write(const char* bytes, std::size_t count)
{
    int& error = state_->error;
    while (count > 0 && error == 0) {
        const ssize_t done = ::write(state_->descriptor, bytes, count);
        if (done >= 0) {
            bytes += done;
            count -= static_cast<std::size_t>(done);
            std::uint64_t& written = state_->written;
            const std::uint64_t before = std::exchange(written, written + static_cast<std::uint64_t>(done));
            if (before / kWriteBack != written / kWriteBack) {
                ::sync_file_range(state_->descriptor, 0, 0, SYNC_FILE_RANGE_WRITE);
            }
        } else if (errno == EAGAIN) {
            pollfd wait{state_->descriptor, POLLOUT, 0};  // another process made the pipe non-blocking
            ::poll(&wait, 1, -1);
        } else if (errno != EINTR) {
            error = errno;
        }
    }
    return error == 0;
}

std::string Draft::problem() const
{
    return state_->error == 0 ? "" : textOf(state_->error);
}

void Draft::commit()
{
    const fs::path& path = state_->path;
    if (state_->through) {
        require(state_->through->close(), path);
        return;
    }
    UnnamedFile& file = *state_->unnamed;
    if (state_->target.status) {
        file.takePermissions(*state_->target.status);
    }
    require(file.sync(), path);
    const int error = file.moveTo(state_->target.path, state_->no_clobber);
    if (state_->no_clobber && error == EEXIST) {
        throwMustNotBeReplaced(path);
    }
    require(error, path);
    require(file.close(), path);
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
