// SPDX-License-Identifier: GPL-3.0-or-later
//
// Linux manual: getrlimit(2), sigaltstack(2), signal-safety(7), proc(5) on /proc/self/statm.
#include "shortage.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <cstddef>
#include <cstdlib>
#include <exception>
#include <new>
#include <string_view>
#include <system_error>

#include "droplet/io/output.h"
#include "exit_code.h"

namespace cli {
namespace {

constexpr std::string_view kNoMemory =
    "droplet-shape: out of memory; use fewer triangles or droplets, smaller pictures or fewer threads\n";
constexpr std::string_view kNoThreads =
    "droplet-shape: out of threads or memory: no further thread can be started; use fewer --threads\n";
constexpr std::string_view kGaveUp = "droplet-shape: internal error: a library has given up\n";

/// Ends the process as an internal error does, by functions that a signal handler may call.
[[noreturn]] void endWith(std::string_view line)
{
    static std::atomic<bool> is_ending{false};
    while (is_ending.exchange(true)) {
        ::pause();  // another thread ends the process, with the same line
    }
    droplet::removeUnfinished();
    // A line that cannot be written changes nothing.
    [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, line.data(), line.size());
    ::_exit(static_cast<int>(ExitCode::InternalError));
}

/// Number in a text; 0 if there is none.
std::size_t numberIn(std::string_view text)
{
    std::size_t number = 0;
    for (const char c : text) {
        if (c < '0' || c > '9') {
            break;
        }
        number = 10 * number + static_cast<std::size_t>(c - '0');
    }
    return number;
}

/// Pages that /proc/self/statm states: `field` 0 is the address space, 5 the private data.
std::size_t pagesOf(std::size_t field)
{
    std::array<char, 256> line{};
    const int file = ::open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
    const ssize_t count = file < 0 ? 0 : ::read(file, line.data(), line.size());
    ::close(file);
    std::string_view text(line.data(), static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
    for (std::size_t k = 0; k < field && !text.empty(); ++k) {
        text.remove_prefix(std::min(text.find(' '), text.size() - 1) + 1);
    }
    return numberIn(text);
}

/// Whether an allocation by `new` has failed.
std::atomic<bool> was_refused{false};

[[noreturn]] void refuseMemory()
{
    was_refused = true;
    throw std::bad_alloc();
}

/// Whether an allocation has failed, or probably has, because a limit of memory is almost reached.
bool isMemoryShort()
{
    if (was_refused) {
        return true;
    }
    // The largest array of a run of a million triangles is smaller.
    constexpr std::size_t kNear = std::size_t{128} << 20U;
    const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
    const auto is_near = [&](auto resource, std::size_t field) {
        rlimit limit{};
        return ::getrlimit(resource, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY &&
               page * pagesOf(field) + kNear > limit.rlim_cur;
    };
    return is_near(RLIMIT_AS, 0) || is_near(RLIMIT_DATA, 5);
}

/// Handlers before reportShortages(), such as those of a sanitizer.
struct Earlier {
    int signal;
    struct sigaction action;
};
std::array<Earlier, 3> earlier{{{SIGSEGV, {}}, {SIGBUS, {}}, {SIGABRT, {}}}};

void endOnFault(int signal, siginfo_t* info, void* /*context*/)
{
    if (isMemoryShort()) {
        endWith(kNoMemory);
    }
    for (const Earlier& before : earlier) {
        if (before.signal == signal) {
            ::sigaction(signal, &before.action, nullptr);
        }
    }
    // A fault happens again when this returns; a signal that was sent does not.
    if (info->si_code <= 0) {
        ::raise(signal);
    }
}

/// Ends the process where an exception cannot reach main(): from a destructor, or from a worker of TBB.
[[noreturn]] void endOnException()
{
    try {
        if (const std::exception_ptr error = std::current_exception()) {
            std::rethrow_exception(error);
        }
    } catch (const std::bad_alloc&) {
        endWith(kNoMemory);
    } catch (const std::exception& error) {
        if (isThreadShortage(error)) {
            endWith(kNoThreads);
        }
    } catch (...) {
    }
    endWith(isMemoryShort() ? kNoMemory : kGaveUp);
}

/// Gives the main thread a stack for signals, on which handlers run after its own stack could not grow. Stacks of other
/// threads do not grow.
void useSignalStack()
{
    constexpr std::size_t kSize = std::size_t{1} << 16U;
    static std::array<char, kSize> place;
    stack_t stack{};
    stack.ss_sp = place.data();
    stack.ss_size = place.size();
    ::sigaltstack(&stack, nullptr);
}

/// Lets the main thread's stack take its addresses now, before other memory has them. It takes no memory.
void growStack()
{
    constexpr std::size_t kMargin = std::size_t{1} << 20U;
    constexpr std::size_t kMost = std::size_t{8} << 20U;
    rlimit limit{};
    if (::getrlimit(RLIMIT_STACK, &limit) != 0 || limit.rlim_cur <= 2 * kMargin) {
        return;
    }
    const std::size_t depth = std::min<std::size_t>(limit.rlim_cur, kMost) - kMargin;
    *static_cast<volatile char*>(__builtin_alloca(depth)) = 0;
}

}  // namespace

bool isThreadShortage(const std::exception& error)
{
    const auto* system = dynamic_cast<const std::system_error*>(&error);
    return (system != nullptr && system->code() == std::errc::resource_unavailable_try_again) ||
           std::string_view(error.what()).find("pthread_create") != std::string_view::npos;  // TBB's words
}

void reportShortages()
{
    std::set_new_handler(refuseMemory);
    std::set_terminate(endOnException);
    useSignalStack();
    struct sigaction action {};
    action.sa_sigaction = endOnFault;
    action.sa_flags = SA_SIGINFO | SA_ONSTACK;
    for (Earlier& before : earlier) {
        ::sigaction(before.signal, &action, &before.action);
    }
    growStack();
}

}  // namespace cli
