// SPDX-License-Identifier: GPL-3.0-or-later
//
// A separate program draws the page with librsvg (svg/draw.cpp). librsvg, Cairo and Pango end the process when a
// drawing overflows their stack or needs more memory than is available, and they compute for as long as the drawing
// takes. So each drawing has its own process with limits, and a crash affects only that process. Both sides use files
// in memory; the only wait on a pipe is for the end.
#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>
#include <memory>
#include <string>

#include "image/drawn_svg.h"
#include "image/image_bytes.h"
#include "image/installed.h"
#include "number_text.h"

extern char** environ;  // NOLINT(readability-redundant-declaration): POSIX leaves it to us

namespace droplet {
namespace {

[[noreturn]] void throwSystem(int failure)
{
    throwSvgRefused("cannot be drawn: " + std::string(std::strerror(failure)));
}

/// File descriptor that is not inherited by started programs, unless passed explicitly.
class Descriptor {
public:
    /// Takes ownership of a descriptor. Descriptors 0 to 2 are replaced by others, because a started program gets its
    /// own there.
    explicit Descriptor(int number) : number_(number)
    {
        if (number_ >= 0 && number_ <= STDERR_FILENO) {
            number_ = ::fcntl(number, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
            ::close(number);
        }
        if (number_ < 0) {
            throwSystem(errno);
        }
    }
    ~Descriptor() { ::close(number_); }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;

    [[nodiscard]] int number() const { return number_; }

private:
    int number_;
};

Descriptor memoryFile()
{
    return Descriptor(::memfd_create("droplet-svg", MFD_CLOEXEC));
}

void writeAtomically(const Descriptor& file, const void* bytes, std::size_t size)
{
    for (std::size_t done = 0; done < size;) {
        const ssize_t count = ::write(file.number(), static_cast<const char*>(bytes) + done, size - done);
        if (count < 0 && errno != EINTR) {
            throwSystem(errno);
        }
        done += count < 0 ? 0 : static_cast<std::size_t>(count);
    }
}

/// Starts the program that draws.
pid_t startDrawing(const Descriptor& request, const Descriptor& drawing, int messages)
{
    static const auto program = installedFile(DROPLET_SVG);
    if (!program) {
        throwSvgRefused("needs the program " DROPLET_SVG ", which is installed with droplet-shape and draws it");
    }
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_adddup2(&files, request.number(), STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&files, drawing.number(), STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&files, messages, STDERR_FILENO);
    posix_spawn_file_actions_addclosefrom_np(&files, STDERR_FILENO + 1);
    // The drawing does not inherit signals that the host has blocked or ignored. It also has its own process group, so
    // that the terminal's ^C and ^Z reach only the host; when the thread that waits for a drawing ends, the drawing
    // ends, too.
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETPGROUP);
    sigset_t signals;
    sigfillset(&signals);
    posix_spawnattr_setsigdefault(&attributes, &signals);
    sigemptyset(&signals);
    posix_spawnattr_setsigmask(&attributes, &signals);
    pid_t process = -1;
    std::array<char*, 2> arguments{const_cast<char*>(program->c_str()), nullptr};
    const int failure = ::posix_spawn(&process, program->c_str(), &files, &attributes, arguments.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&files);
    if (failure != 0) {
        throwSystem(failure);
    }
    return process;
}

/// How the drawing process ended.
struct ProcessEnd {
    bool timed_out = false;
    int status = 0;        ///< as from waitpid; 0 if the host has already collected it
    std::string messages;  ///< beginning of its messages
};

ProcessEnd awaitEnd(pid_t process, const Descriptor& messages, double seconds)
{
    using Clock = std::chrono::steady_clock;
    const auto deadline = Clock::now() + std::chrono::duration<double>(seconds);
    ProcessEnd end;
    std::array<char, 4096> chunk{};
    for (;;) {
        const double left = std::chrono::duration<double>(deadline - Clock::now()).count();
        pollfd event{messages.number(), POLLIN, 0};
        const int ready = ::poll(&event, 1, static_cast<int>(std::clamp(1e3 * left + 1.0, 0.0, 1e9)));
        if (ready == 0) {
            end.timed_out = true;
            ::kill(process, SIGKILL);
            break;
        }
        const ssize_t count = ready < 0 ? -1 : ::read(messages.number(), chunk.data(), chunk.size());
        if (count == 0 || (count < 0 && errno != EINTR)) {
            break;  // the process has closed its end
        }
        if (count > 0 && end.messages.size() < chunk.size()) {
            end.messages.append(chunk.data(), static_cast<std::size_t>(count));
        }
    }
    while (::waitpid(process, &end.status, 0) == -1) {
        if (errno != EINTR) {
            end.status = 0;
            break;
        }
    }
    return end;
}

std::string memoryProblem(const DrawingLimits& limits)
{
    return "takes more than " + numberText(static_cast<double>(limits.memory) / (1 << 20)) + " MiB of memory to draw";
}

/// Message for a drawing whose process did not end normally.
std::string problemOf(const ProcessEnd& end, const DrawingLimits& limits)
{
    const int signal = WIFSIGNALED(end.status) ? WTERMSIG(end.status) : 0;
    constexpr std::string_view kLoader = "loading shared libraries: ";
    if (const auto at = end.messages.find(kLoader); at != std::string::npos) {
        const std::string reason = end.messages.substr(at + kLoader.size());
        return "needs librsvg, which must be installed (Debian's package librsvg2-2): " +
               reason.substr(0, reason.find('\n'));
    }
    if (end.timed_out || signal == SIGPROF) {
        return "takes more than " + numberText(limits.seconds) + " s to draw";
    }
    if (signal == SIGKILL || end.messages.find("alloc") != std::string::npos) {
        return memoryProblem(limits);
    }
    if (signal == SIGSEGV || signal == SIGBUS) {
        return "is nested too deeply, or too long, for librsvg to draw";
    }
    return "cannot be drawn: librsvg has failed";
}

/// File in memory with what the program has written.
struct Result {
    Descriptor file;
    SvgDrawing drawing;

    /// Content after the drawing's figures.
    template <class Value>
    [[nodiscard]] std::shared_ptr<const Value> content(std::size_t count) const
    {
        const std::size_t size = kSvgContent + count * sizeof(Value);
        void* const mapped = ::mmap(nullptr, size, PROT_READ, MAP_SHARED | MAP_POPULATE, file.number(), 0);
        if (mapped == MAP_FAILED) {
            throwSystem(errno);
        }
        const auto* const values = reinterpret_cast<const Value*>(static_cast<const std::byte*>(mapped) + kSvgContent);
        return {values, [mapped, size](const Value*) { ::munmap(mapped, size); }};
    }
};

/// Lets the program answer a request.
/// @throws Error InvalidInput
std::unique_ptr<Result> answerTo(const SvgRequest& request, std::span<const std::byte> text,
                                 const DrawingLimits& limits)
{
    const Descriptor request_file = memoryFile();
    std::unique_ptr<Result> result(new Result{memoryFile(), {}});
    writeAtomically(request_file, &request, sizeof request);
    writeAtomically(request_file, text.data(), text.size());

    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
        throwSystem(errno);
    }
    const Descriptor messages(ends[0]);
    auto message_writer = std::make_unique<Descriptor>(ends[1]);
    const pid_t process = startDrawing(request_file, result->file, message_writer->number());
    message_writer.reset();
    const ProcessEnd end = awaitEnd(process, messages, limits.seconds);

    SvgDrawing& drawing = result->drawing;
    const bool whole = ::pread(result->file.number(), &drawing, sizeof drawing, 0) == sizeof drawing;
    if (end.timed_out || end.status != 0 || !whole || drawing.outcome == SvgOutcome::None) {
        throwSvgRefused(problemOf(end, limits));
    }
    if (drawing.outcome == SvgOutcome::Damaged) {
        throwDamaged(ImageFormat::Svg, drawing.problem.data());
    }
    if (drawing.outcome == SvgOutcome::Refused) {
        const std::string problem = drawing.problem.data();
        throwSvgRefused(problem.ends_with("NoMemory") ? memoryProblem(limits) : problem);
    }
    return result;
}

}  // namespace

DrawnSvg drawSvg(std::span<const std::byte> text, std::size_t tags, const DecodeOptions& options)
{
    const auto result = answerTo(
        {options.max_pixels, options.vector_long_side, options.drawing.seconds, options.drawing.memory, tags, false},
        text, options.drawing);
    const SvgDrawing& drawing = result->drawing;
    return {drawing, result->content<std::uint32_t>(static_cast<std::size_t>(drawing.width) *
                                                    static_cast<std::size_t>(drawing.height))};
}

SvgLine lineOfSvg(const SvgText& drawing, const DrawingLimits& limits)
{
    const auto result = answerTo({0, 0, limits.seconds, limits.memory, drawing.tags, true}, drawing.text, limits);
    const SvgDrawing& found = result->drawing;
    const auto points = result->content<Vec2>(found.points);
    return {{points.get(), points.get() + found.points}, found.page_width, found.others};
}

}  // namespace droplet
