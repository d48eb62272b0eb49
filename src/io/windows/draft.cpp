// SPDX-License-Identifier: GPL-3.0-or-later
// Windows' CreateFileW, SetFileInformationByHandle (FileDispositionInfo, FileRenameInfo), GetFinalPathNameByHandleW.
//
// A file under way has a name, but is marked for deletion: Windows removes it when its handle is closed, even if the
// process was killed. The mark is taken off just before the file is moved to its path.
#include "io/draft.h"

#include <windows.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace droplet {
namespace {

namespace fs = std::filesystem;

std::string textOf(DWORD error)
{
    return std::system_category().message(static_cast<int>(error));
}

class Handle {
public:
    explicit Handle(HANDLE handle) : handle_(handle) {}
    Handle(Handle&& other) noexcept : handle_(std::exchange(other.handle_, INVALID_HANDLE_VALUE)) {}
    Handle& operator=(Handle&& other) noexcept
    {
        std::swap(handle_, other.handle_);
        return *this;
    }
    ~Handle() { close(); }

    [[nodiscard]] HANDLE get() const { return handle_; }
    [[nodiscard]] bool valid() const { return handle_ != INVALID_HANDLE_VALUE; }

    void close()
    {
        if (valid()) {
            ::CloseHandle(std::exchange(handle_, INVALID_HANDLE_VALUE));
        }
    }

private:
    HANDLE handle_;
};

/// Path for system calls: absolute, and with the prefix that lifts the limit of 260 characters.
std::wstring longPath(const fs::path& path)
{
    std::wstring absolute(path.wstring().size() + 300, L'\0');
    const DWORD size = ::GetFullPathNameW(path.c_str(), static_cast<DWORD>(absolute.size()), absolute.data(), nullptr);
    absolute.resize(size < absolute.size() ? size : 0);
    if (absolute.empty() || absolute.starts_with(L"\\\\.\\") || absolute.starts_with(L"\\\\?\\")) {
        return absolute.empty() ? path.wstring() : absolute;
    }
    return absolute.starts_with(L"\\\\") ? L"\\\\?\\UNC" + absolute.substr(1) : L"\\\\?\\" + absolute;
}

Handle open(const std::wstring& path, DWORD access, DWORD creation, DWORD flags = FILE_ATTRIBUTE_NORMAL)
{
    return Handle(::CreateFileW(path.c_str(), access, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, nullptr,
                                creation, flags, nullptr));
}

/// What is at the end of a path, with links followed.
struct Target {
    std::wstring path;
    bool exists = false;
    bool is_file = true;  ///< else a device or a pipe
};

constexpr const char* kStandardOutput = "/dev/stdout";

Target findTarget(const fs::path& path)
{
    if (path.empty()) {
        throwOutputFailed(path, "the path is empty");
    }
    if (path == kStandardOutput) {
        return {{}, true, false};
    }
    Target target{longPath(path)};
    if (target.path.starts_with(L"\\\\.\\")) {  // NUL, CON, a named pipe
        target.exists = true;
        target.is_file = false;
        return target;
    }
    // Backup semantics open folders, too.
    const Handle file = open(target.path, 0, OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS);
    if (!file.valid()) {
        const DWORD error = ::GetLastError();
        if (error != ERROR_FILE_NOT_FOUND) {
            throwOutputFailed(path, textOf(error));
        }
        return target;
    }
    target.exists = true;
    target.is_file = ::GetFileType(file.get()) == FILE_TYPE_DISK;
    std::array<wchar_t, 32768> end{};
    const DWORD length = ::GetFinalPathNameByHandleW(file.get(), end.data(), static_cast<DWORD>(end.size()), 0);
    if (target.is_file && length > 0 && length < end.size()) {
        target.path.assign(end.data(), length);
    }
    return target;
}

std::wstring folderOf(const std::wstring& path)
{
    return path.substr(0, path.find_last_of(L"\\/") + 1);
}

Target findWritable(const fs::path& path, const OutputOptions& options)
{
    Target target = findTarget(path);
    if (!target.is_file) {
        return target;
    }
    if (target.exists) {
        const DWORD attributes = ::GetFileAttributesW(target.path.c_str());
        if ((attributes & FILE_ATTRIBUTE_DIRECTORY) != 0) {
            throwOutputFailed(path, std::generic_category().message(EISDIR));
        }
        if (options.no_clobber) {
            throwMustNotBeReplaced(path);
        }
        if ((attributes & FILE_ATTRIBUTE_READONLY) != 0) {
            throwOutputFailed(path, textOf(ERROR_ACCESS_DENIED));
        }
    } else if (const DWORD folder = ::GetFileAttributesW(folderOf(target.path).c_str());
               folder == INVALID_FILE_ATTRIBUTES || (folder & FILE_ATTRIBUTE_DIRECTORY) == 0) {
        throwOutputFailed(path, textOf(ERROR_PATH_NOT_FOUND));
    }
    return target;
}

void markForDeletion(HANDLE file, bool marked)
{
    FILE_DISPOSITION_INFO disposition{};
    disposition.DeleteFile = marked ? TRUE : FALSE;
    ::SetFileInformationByHandle(file, FileDispositionInfo, &disposition, sizeof disposition);
}

Handle createUnfinished(const std::wstring& folder, const fs::path& path)
{
    constexpr int kMaxLeftovers = 10'000;  // names of other threads, and of processes that a power cut has ended
    for (int i = 0; i < kMaxLeftovers; ++i) {
        const std::wstring name = folder + L".droplet-shape-" + std::to_wstring(::GetCurrentProcessId()) + L"-" +
                                  std::to_wstring(i) + L".tmp";
        Handle file = open(name, GENERIC_WRITE | DELETE, CREATE_NEW);
        if (file.valid()) {
            markForDeletion(file.get(), true);
            return file;
        }
        // Access is denied to the name of a file that is being deleted.
        const DWORD error = ::GetLastError();
        if (error != ERROR_FILE_EXISTS && error != ERROR_ALREADY_EXISTS &&
            !(error == ERROR_ACCESS_DENIED && ::GetFileAttributesW(name.c_str()) != INVALID_FILE_ATTRIBUTES)) {
            throwOutputFailed(path, textOf(error));
        }
    }
    throwOutputFailed(path, textOf(ERROR_FILE_EXISTS));
}

/// @return 0, or the error
DWORD rename(HANDLE file, const std::wstring& to, bool replaces)
{
    const std::size_t bytes = to.size() * sizeof(wchar_t);
    std::vector<std::byte> memory(sizeof(FILE_RENAME_INFO) + bytes);
    auto& info = *new (memory.data()) FILE_RENAME_INFO{};
    info.ReplaceIfExists = replaces ? TRUE : FALSE;
    info.FileNameLength = static_cast<DWORD>(bytes);
    std::copy(to.begin(), to.end(), info.FileName);
    return ::SetFileInformationByHandle(file, FileRenameInfo, &info, static_cast<DWORD>(memory.size())) != FALSE
               ? 0
               : ::GetLastError();
}

}  // namespace

struct Draft::State {
    fs::path path;
    bool no_clobber;
    Target target;
    std::optional<Handle> own;  ///< none: standard output, which stays open
    HANDLE file = INVALID_HANDLE_VALUE;
    DWORD error = 0;
};

Draft::Draft(const fs::path& path, const OutputOptions& options)
    : state_(new State{path, options.no_clobber, findWritable(path, options), {}})
{
    const Target& target = state_->target;
    if (target.is_file) {
        state_->own = createUnfinished(folderOf(target.path), path);
    } else if (!target.path.empty()) {
        state_->own = open(target.path, GENERIC_WRITE, OPEN_EXISTING);
        if (!state_->own->valid()) {
            throwOutputFailed(path, textOf(::GetLastError()));
        }
    }
    state_->file = state_->own ? state_->own->get() : ::GetStdHandle(STD_OUTPUT_HANDLE);
}

Draft::~Draft() = default;

bool Draft::write(const char* bytes, std::size_t count)
{
    constexpr std::size_t kMost = std::size_t{1} << 30;  // a DWORD counts
    while (count > 0 && state_->error == 0) {
        DWORD done = 0;
        if (::WriteFile(state_->file, bytes, static_cast<DWORD>(std::min(count, kMost)), &done, nullptr) == FALSE) {
            state_->error = ::GetLastError();
        }
        bytes += done;
        count -= done;
    }
    return state_->error == 0;
}

std::string Draft::problem() const
{
    return state_->error == 0 ? "" : textOf(state_->error);
}

void Draft::commit()
{
    if (!state_->target.is_file) {
        return;
    }
    const auto require = [&](DWORD error) {
        if (error != 0) {
            markForDeletion(state_->file, true);
            throwOutputFailed(state_->path, textOf(error));
        }
    };
    require(::FlushFileBuffers(state_->file) != FALSE ? 0 : ::GetLastError());
    markForDeletion(state_->file, false);
    const DWORD error = rename(state_->file, state_->target.path, !state_->no_clobber);
    if (state_->no_clobber && (error == ERROR_ALREADY_EXISTS || error == ERROR_FILE_EXISTS)) {
        markForDeletion(state_->file, true);
        throwMustNotBeReplaced(state_->path);
    }
    require(error);
    state_->own.reset();
}

void checkWritable(const fs::path& path, const OutputOptions& options)
{
    findWritable(path, options);
}

/// Windows does it when the process ends.
void removeUnfinished() noexcept {}

}  // namespace droplet
