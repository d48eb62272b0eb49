// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/command.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <linux/capability.h>
#include <poll.h>
#include <pty.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "support/paths.h"

namespace droplet::testing {
namespace {

class Descriptor {
public:
    explicit Descriptor(int number = -1) : number_(number) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() { close(); }

    [[nodiscard]] int number() const { return number_; }
    [[nodiscard]] bool open() const { return number_ >= 0; }
    void reset(int number)
    {
        close();
        number_ = number;
    }
    void close()
    {
        if (number_ >= 0) {
            ::close(number_);
        }
        number_ = -1;
    }

private:
    int number_;
};

struct Pipe {
    Descriptor read;
    Descriptor write;
};

void require(bool success, const char* what)
{
    if (!success) {
        throw std::runtime_error(std::string(what) + ": " + std::generic_category().message(errno));
    }
}

void openPipe(Pipe& pipe)
{
    std::array<int, 2> ends{};
    require(::pipe2(ends.data(), O_CLOEXEC) == 0, "pipe");
    pipe.read.reset(ends[0]);
    pipe.write.reset(ends[1]);
}

void openTerminal(Pipe& pipe)
{
    int controller = -1;
    int terminal = -1;
    require(::openpty(&controller, &terminal, nullptr, nullptr, nullptr) == 0, "openpty");
    ::fcntl(controller, F_SETFD, FD_CLOEXEC);
    ::fcntl(terminal, F_SETFD, FD_CLOEXEC);
    pipe.read.reset(controller);
    pipe.write.reset(terminal);
}

/// Two capabilities let root ignore file modes; a program without them in its bounding set cannot regain them.
bool dropOverride()
{
    return ::geteuid() != 0 ||
           (::prctl(PR_CAPBSET_DROP, CAP_DAC_OVERRIDE) == 0 && ::prctl(PR_CAPBSET_DROP, CAP_DAC_READ_SEARCH) == 0);
}

[[noreturn]] void becomeProgram(const std::vector<std::string>& command, const CommandOptions& options)
{
    constexpr int kNotStarted = 127;
    if (!options.directory.empty() && ::chdir(options.directory.c_str()) != 0) {
        ::_exit(kNotStarted);
    }
    if (options.respect_permissions && !dropOverride()) {
        ::_exit(kNotStarted);
    }
    ::unsetenv("NO_COLOR");
    ::setenv("TERM", "xterm", 1);
    for (const auto& [variable, value] : options.environment) {
        ::setenv(variable.c_str(), value.c_str(), 1);
    }
    std::vector<char*> arguments;
    arguments.reserve(command.size() + 1);
    for (const std::string& argument : command) {
        arguments.push_back(const_cast<char*>(argument.c_str()));
    }
    arguments.push_back(nullptr);
    ::execvp(arguments.front(), arguments.data());
    ::_exit(kNotStarted);
}

/// Reads the available bytes; returns false at the end.
bool take(const Descriptor& from, std::string& into)
{
    std::array<char, 65536> chunk{};
    const ssize_t got = ::read(from.number(), chunk.data(), chunk.size());
    if (got < 0 && errno == EINTR) {
        return true;
    }
    // A terminal without users gives an input/output error.
    if (got <= 0) {
        return false;
    }
    into.append(chunk.data(), static_cast<std::size_t>(got));
    return true;
}

/// Writes standard input and reads both outputs until all are closed.
void converse(Descriptor& input, Descriptor& output, Descriptor& error, const CommandOptions& options,
              CommandResult& result)
{
    constexpr int kPatience = 60'000;  // [ms] far longer than any test run
    std::size_t sent = 0;
    while (output.open() || error.open()) {
        const bool waiting = result.error.find(options.input_waits_for) == std::string::npos;
        if (input.open() && !waiting && sent == options.input.size()) {
            input.close();
        }
        // poll() ignores negative descriptors.
        std::array<pollfd, 3> events{
            {{waiting ? -1 : input.number(), POLLOUT, 0}, {output.number(), POLLIN, 0}, {error.number(), POLLIN, 0}}};
        const int ready = ::poll(events.data(), events.size(), kPatience);
        require(ready >= 0 || errno == EINTR, "poll");
        if (ready == 0) {
            input.close();  // the awaited text does not come: let the program end; the test fails
        }
        if (ready <= 0) {
            continue;
        }
        if (events[0].revents != 0) {
            const ssize_t done = ::write(input.number(), options.input.data() + sent, options.input.size() - sent);
            if (done >= 0) {
                sent += static_cast<std::size_t>(done);
            } else if (errno != EINTR && errno != EAGAIN) {
                input.close();  // the program does not read it
            }
        }
        if (events[1].revents != 0 && !take(output, result.output)) {
            output.close();
        }
        if (events[2].revents != 0 && !take(error, result.error)) {
            error.close();
        }
    }
}

}  // namespace

std::vector<std::string> CommandResult::errorLines() const
{
    std::istringstream stream(error);
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);) {
        lines.push_back(line);
    }
    return lines;
}

CommandResult runProgram(const std::vector<std::string>& command, const CommandOptions& options)
{
    static const auto ignored = std::signal(SIGPIPE, SIG_IGN);
    (void)ignored;
    Pipe input;
    Pipe output;
    Pipe error;
    openPipe(input);
    openPipe(output);
    if (options.error_is_terminal) {
        openTerminal(error);
    } else {
        openPipe(error);
    }
    if (!options.output_file.empty()) {
        output.write.reset(::open(options.output_file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
        require(output.write.open(), "open");
        output.read.close();
    }
    if (options.output_closed) {
        output.read.close();
    }

    const pid_t child = ::fork();
    require(child >= 0, "fork");
    if (child == 0) {
        ::dup2(input.read.number(), STDIN_FILENO);
        ::dup2(output.write.number(), STDOUT_FILENO);
        ::dup2(error.write.number(), STDERR_FILENO);
        std::signal(SIGPIPE, SIG_DFL);
        becomeProgram(command, options);
    }
    input.read.close();
    output.write.close();
    error.write.close();
    ::fcntl(input.write.number(), F_SETFL, O_NONBLOCK);

    CommandResult result;
    converse(input.write, output.read, error.read, options, result);
    input.write.close();
    int status = 0;
    while (::waitpid(child, &status, 0) < 0) {
        require(errno == EINTR, "waitpid");
    }
    result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return result;
}

CommandResult runDroplet(const std::vector<std::string>& arguments, const CommandOptions& options)
{
    // Another build of the command, such as that for Windows, which a script starts: see tests/windows_test.
    const char* const other = std::getenv("DROPLET_SHAPE");
    std::vector<std::string> command{other != nullptr ? other : kCommand};
    command.insert(command.end(), arguments.begin(), arguments.end());
    return runProgram(command, options);
}

bool canRespectPermissions()
{
    ScratchDirectory scratch;
    const auto locked = scratch.path() / "locked";
    writeFile(locked, "x");
    std::filesystem::permissions(locked, std::filesystem::perms::none);
    CommandOptions options;
    options.respect_permissions = true;
    return runProgram({"cat", locked.string()}, options).exit_code == 1;
}

ScratchDirectory::ScratchDirectory()
{
    std::filesystem::create_directories(kScratchDir);
    std::string name = (std::filesystem::path(kScratchDir) / "XXXXXX").string();
    require(::mkdtemp(name.data()) != nullptr, "mkdtemp");
    path_ = name;
}

ScratchDirectory::~ScratchDirectory()
{
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

std::vector<std::string> ScratchDirectory::names() const
{
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(path_)) {
        names.push_back(entry.path().filename().string());
    }
    std::sort(names.begin(), names.end());
    return names;
}

void writeFile(const std::filesystem::path& path, const std::string& bytes)
{
    std::ofstream file(path, std::ios::binary);
    file << bytes;
    file.close();
    require(static_cast<bool>(file), path.c_str());
}

std::string readFile(const std::filesystem::path& path)
{
    std::ifstream file(path, std::ios::binary);
    std::ostringstream bytes;
    bytes << file.rdbuf();
    require(static_cast<bool>(file), path.c_str());
    return bytes.str();
}

std::string greymap(int width, int height, const std::function<int(int x, int y)>& brightness)
{
    std::string bytes = "P5\n" + std::to_string(width) + " " + std::to_string(height) + "\n255\n";
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            bytes += static_cast<char>(brightness(x, y));
        }
    }
    return bytes;
}

std::string discPicture(int size, double radius)
{
    const double centre = (size - 1) / 2.0;
    return greymap(size, size, [&](int x, int y) {
        const double dx = x - centre;
        const double dy = y - centre;
        return dx * dx + dy * dy < radius * radius ? 255 : 0;
    });
}

}  // namespace droplet::testing
