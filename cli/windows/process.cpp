// SPDX-License-Identifier: GPL-3.0-or-later
// Windows' CreateProcessW, job objects (limits of memory and time), and CreateFileW with FILE_FLAG_DELETE_ON_CLOSE.
#include "process.h"

#include <fcntl.h>
#include <io.h>
#include <windows.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <filesystem>
#include <memory>
#include <stdexcept>

namespace cli {
namespace {

/// What a ProcessId points to.
struct Running {
    HANDLE process = nullptr;
    HANDLE job = nullptr;
};

Running& runningOf(ProcessId id)
{
    return *reinterpret_cast<Running*>(id);
}

/// Argument in a command line, by the rules of CommandLineToArgvW.
std::wstring quoted(const std::wstring& argument)
{
    std::wstring result = L"\"";
    std::size_t backslashes = 0;
    for (const wchar_t c : argument) {
        if (c == L'"') {
            result.append(backslashes + 1, L'\\');
        }
        backslashes = c == L'\\' ? backslashes + 1 : 0;
        result += c;
    }
    return result.append(backslashes, L'\\') + L'"';
}

/// Lets a child process inherit a handle.
void letInherit(HANDLE handle)
{
    ::SetHandleInformation(handle, HANDLE_FLAG_INHERIT, HANDLE_FLAG_INHERIT);
}

HANDLE openNull(DWORD access)
{
    SECURITY_ATTRIBUTES inherited{sizeof inherited, nullptr, TRUE};
    return ::CreateFileW(L"NUL", access, FILE_SHARE_READ | FILE_SHARE_WRITE, &inherited, OPEN_EXISTING, 0, nullptr);
}

std::FILE* streamOf(HANDLE handle, const char* mode)
{
    return ::_fdopen(::_open_osfhandle(reinterpret_cast<std::intptr_t>(handle), _O_BINARY), mode);
}

HANDLE handleOf(std::FILE* file)
{
    return reinterpret_cast<HANDLE>(::_get_osfhandle(::_fileno(file)));
}

std::wstring temporaryPath()
{
    static std::atomic<unsigned> number{0};
    std::array<wchar_t, MAX_PATH + 1> folder{};
    ::GetTempPathW(static_cast<DWORD>(folder.size()), folder.data());
    return std::wstring(folder.data()) + L"droplet-shape-" + std::to_wstring(::GetCurrentProcessId()) + L"-" +
           std::to_wstring(number++) + L".tmp";
}

/// Temporary file for reading and writing; null, with errno, if it cannot be made.
std::FILE* openNew(const std::wstring& path, DWORD flags)
{
    const HANDLE file = ::CreateFileW(path.c_str(), GENERIC_READ | GENERIC_WRITE,
                                      FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, nullptr, CREATE_ALWAYS,
                                      FILE_ATTRIBUTE_TEMPORARY | flags, nullptr);
    if (file == INVALID_HANDLE_VALUE) {
        errno = EACCES;
        return nullptr;
    }
    return streamOf(file, "w+b");
}

JOBOBJECT_EXTENDED_LIMIT_INFORMATION limitsOf(HANDLE job)
{
    JOBOBJECT_EXTENDED_LIMIT_INFORMATION limits{};
    ::QueryInformationJobObject(job, JobObjectExtendedLimitInformation, &limits, sizeof limits, nullptr);
    return limits;
}

void setLimits(HANDLE job, JOBOBJECT_EXTENDED_LIMIT_INFORMATION limits, DWORD added)
{
    limits.BasicLimitInformation.LimitFlags |= added;
    ::SetInformationJobObject(job, JobObjectExtendedLimitInformation, &limits, sizeof limits);
}

}  // namespace

Started start(const std::vector<std::string>& command, Piped piped, const SharedFile* /*shared*/)
{
    Started started;
    Process& process = started.process;
    process.log = temporaryFile();
    HANDLE reader = nullptr;
    HANDLE writer = nullptr;
    if (process.log == nullptr || ::CreatePipe(&reader, &writer, nullptr, 0) == FALSE) {
        throw std::runtime_error("no pipe to " + command[0]);
    }
    const bool reads = piped == Piped::Input;
    letInherit(reads ? reader : writer);
    letInherit(handleOf(process.log));
    STARTUPINFOW startup{};
    startup.cb = sizeof startup;
    startup.dwFlags = STARTF_USESTDHANDLES;
    startup.hStdInput = reads ? reader : openNull(GENERIC_READ);
    startup.hStdOutput = reads ? openNull(GENERIC_WRITE) : writer;
    startup.hStdError = handleOf(process.log);
    std::wstring line;
    for (const std::string& argument : command) {
        line += (line.empty() ? L"" : L" ") + quoted(std::filesystem::path(argument).wstring());
    }
    auto running = std::make_unique<Running>();
    running->job = ::CreateJobObjectW(nullptr, nullptr);
    setLimits(running->job, limitsOf(running->job), JOB_OBJECT_LIMIT_KILL_ON_JOB_CLOSE);
    PROCESS_INFORMATION information{};
    const bool is_running =
        ::CreateProcessW(nullptr, line.data(), nullptr, nullptr, TRUE, CREATE_NO_WINDOW | CREATE_SUSPENDED, nullptr,
                         nullptr, &startup, &information) != FALSE;
    started.failure = is_running ? 0 : ENOENT;
    ::CloseHandle(startup.hStdInput);
    ::CloseHandle(startup.hStdOutput);
    ::SetHandleInformation(startup.hStdError, HANDLE_FLAG_INHERIT, 0);
    if (!is_running) {
        ::CloseHandle(reads ? writer : reader);
        ::CloseHandle(running->job);
        std::fclose(process.log);
        process = {};
        return started;
    }
    (reads ? process.input : process.output) = streamOf(reads ? writer : reader, reads ? "wb" : "rb");
    running->process = information.hProcess;
    ::AssignProcessToJobObject(running->job, running->process);
    ::ResumeThread(information.hThread);
    ::CloseHandle(information.hThread);
    process.id = reinterpret_cast<ProcessId>(running.release());
    return started;
}

std::FILE* temporaryFile()
{
    return openNew(temporaryPath(), FILE_FLAG_DELETE_ON_CLOSE);
}

// Without that flag: most programs open no file that its owner may delete.
SharedFile::SharedFile() : name_(std::filesystem::path(temporaryPath()).string())
{
    file_ = openNew(std::filesystem::path(name_).wstring(), 0);
}

SharedFile::~SharedFile()
{
    if (file_ != nullptr) {
        std::fclose(file_);
        ::DeleteFileW(std::filesystem::path(name_).c_str());
    }
}

void limitMemory(ProcessId id, std::size_t bytes)
{
    JOBOBJECT_EXTENDED_LIMIT_INFORMATION limits = limitsOf(runningOf(id).job);
    limits.ProcessMemoryLimit = bytes;
    setLimits(runningOf(id).job, limits, JOB_OBJECT_LIMIT_PROCESS_MEMORY);
}

void limitTime(ProcessId id, std::size_t seconds)
{
    FILETIME created{};
    FILETIME exited{};
    FILETIME kernel{};
    FILETIME user{};
    if (::GetProcessTimes(runningOf(id).process, &created, &exited, &kernel, &user) == FALSE) {
        return;
    }
    constexpr long long kTicks = 10'000'000;  // per second
    const long long used = static_cast<long long>(user.dwHighDateTime) << 32 | user.dwLowDateTime;
    JOBOBJECT_EXTENDED_LIMIT_INFORMATION limits = limitsOf(runningOf(id).job);
    limits.BasicLimitInformation.PerProcessUserTimeLimit.QuadPart = used + static_cast<long long>(seconds + 1) * kTicks;
    setLimits(runningOf(id).job, limits, JOB_OBJECT_LIMIT_PROCESS_TIME);
}

ProcessEnd waitFor(ProcessId id)
{
    const std::unique_ptr<Running> running(&runningOf(id));
    ::WaitForSingleObject(running->process, INFINITE);
    DWORD code = 0;
    ::GetExitCodeProcess(running->process, &code);
    ::CloseHandle(running->process);
    ::CloseHandle(running->job);
    return {static_cast<int>(code), code == ERROR_NOT_ENOUGH_QUOTA};
}

void endNow(ProcessId id)
{
    ::TerminateProcess(runningOf(id).process, 1);
    waitFor(id);
}

}  // namespace cli
