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
#include <cstring>
#include <ctime>
#include <regex>
#include <stdexcept>

extern char** environ;  // NOLINT(readability-redundant-declaration): POSIX headers do not declare it

namespace cli {

Started start(const std::vector<std::string>& command, Piped piped, std::optional<int> inherited)
{
    Started started;
    Process& process = started.process;
    std::array<int, 2> ends{};
    process.log = std::tmpfile();
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
    if (inherited) {
        posix_spawn_file_actions_adddup2(&actions, *inherited, 3);
    }
    std::vector<char*> arguments;
    arguments.reserve(command.size() + 1);
    for (const std::string& argument : command) {
        arguments.push_back(const_cast<char*>(argument.c_str()));
    }
    arguments.push_back(nullptr);
    started.failure = ::posix_spawnp(&process.id, command[0].c_str(), &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
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

void limitMemory(pid_t id, std::size_t bytes)
{
    const rlimit memory{bytes, bytes};
    ::prlimit(id, RLIMIT_DATA, &memory, nullptr);
    const rlimit no_core{0, 0};
    ::prlimit(id, RLIMIT_CORE, &no_core, nullptr);
}

void limitTime(pid_t id, std::size_t seconds)
{
    clockid_t clock{};
    timespec used{};
    rlimit time{};
    // A program that has ended has no clock.
    if (::clock_getcpuclockid(id, &clock) != 0 || ::clock_gettime(clock, &used) != 0 ||
        ::prlimit(id, RLIMIT_CPU, nullptr, &time) != 0) {
        return;
    }
    time.rlim_cur = std::min(static_cast<rlim_t>(used.tv_sec) + 1 + seconds, time.rlim_max);
    ::prlimit(id, RLIMIT_CPU, &time, nullptr);
}

int waitFor(pid_t id)
{
    int status = 0;
    while (::waitpid(id, &status, 0) == -1 && errno == EINTR) {
    }
    return status;
}

std::string logText(std::FILE* log)
{
    std::array<char, 4096> text{};
    std::rewind(log);
    return {text.data(), std::fread(text.data(), 1, text.size(), log)};
}

std::string firstLine(std::FILE* log)
{
    const std::string text = logText(log);
    return std::regex_replace(text.substr(0, text.find_first_of("\r\n")), std::regex(" @ 0x[0-9a-f]+"), "");
}

std::string plainName(const std::string& path)
{
    return "file:" + path;
}

}  // namespace cli
