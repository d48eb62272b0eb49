// SPDX-License-Identifier: GPL-3.0-or-later
#include "process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <ctime>
#include <stdexcept>

extern char** environ;  // NOLINT(readability-redundant-declaration): POSIX headers do not declare it

namespace cli {
namespace {

constexpr int kInherited = 3;  // descriptor

pid_t pidOf(ProcessId id)
{
    return static_cast<pid_t>(id);
}

}  // namespace

Started start(const std::vector<std::string>& command, Piped piped, const SharedFile* shared)
{
    Started started;
    Process& process = started.process;
    std::array<int, 2> ends{};
    process.log = temporaryFile();
    if (process.log == nullptr || ::pipe2(ends.data(), O_CLOEXEC) != 0) {
        throw std::runtime_error(std::string("no pipe to ") + command[0] + ": " + std::strerror(errno));
    }
    const bool reads = piped == Piped::Input;
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    if (reads) {
        posix_spawn_file_actions_adddup2(&actions, ends[0], STDIN_FILENO);
        posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    } else {
        posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
        posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
    }
    posix_spawn_file_actions_adddup2(&actions, ::fileno(process.log), STDERR_FILENO);
    if (shared != nullptr) {
        posix_spawn_file_actions_adddup2(&actions, ::fileno(shared->get()), kInherited);
    }
    std::vector<char*> arguments;
    arguments.reserve(command.size() + 1);
    for (const std::string& argument : command) {
        arguments.push_back(const_cast<char*>(argument.c_str()));
    }
    arguments.push_back(nullptr);
    pid_t id = 0;
    started.failure = ::posix_spawnp(&id, command[0].c_str(), &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    process.id = id;
    ::close(reads ? ends[0] : ends[1]);
    std::FILE*& ours = reads ? process.input : process.output;
    ours = ::fdopen(reads ? ends[1] : ends[0], reads ? "wb" : "rb");
    if (started.failure != 0) {
        std::fclose(ours);
        std::fclose(process.log);
        process = {};
    }
    return started;
}

std::FILE* temporaryFile()
{
    return std::tmpfile();
}

SharedFile::SharedFile() : file_(temporaryFile()), name_("/dev/fd/" + std::to_string(kInherited)) {}

SharedFile::~SharedFile()
{
    if (file_ != nullptr) {
        std::fclose(file_);
    }
}

void limitMemory(ProcessId id, std::size_t bytes)
{
    const rlimit memory{bytes, bytes};
    ::prlimit(pidOf(id), RLIMIT_DATA, &memory, nullptr);
    const rlimit no_core{0, 0};
    ::prlimit(pidOf(id), RLIMIT_CORE, &no_core, nullptr);
}

void limitTime(ProcessId id, std::size_t seconds)
{
    clockid_t clock{};
    timespec used{};
    rlimit time{};
    // A program that has ended has no clock.
    if (::clock_getcpuclockid(pidOf(id), &clock) != 0 || ::clock_gettime(clock, &used) != 0 ||
        ::prlimit(pidOf(id), RLIMIT_CPU, nullptr, &time) != 0) {
        return;
    }
    time.rlim_cur = std::min(static_cast<rlim_t>(used.tv_sec) + 1 + seconds, time.rlim_max);
    ::prlimit(pidOf(id), RLIMIT_CPU, &time, nullptr);
}

ProcessEnd waitFor(ProcessId id)
{
    int status = 0;
    while (::waitpid(pidOf(id), &status, 0) == -1 && errno == EINTR) {
    }
    if (WIFSIGNALED(status)) {
        constexpr int kBySignal = 128;  // as shells count
        return {kBySignal + WTERMSIG(status), WTERMSIG(status) == SIGXCPU};
    }
    return {WEXITSTATUS(status), false};
}

void endNow(ProcessId id)
{
    ::kill(pidOf(id), SIGKILL);
    waitFor(id);
}

}  // namespace cli
