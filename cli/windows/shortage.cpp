// SPDX-License-Identifier: GPL-3.0-or-later
#include "shortage.h"

#include <windows.h>

#include <array>
#include <exception>
#include <new>
#include <string_view>
#include <system_error>

#include "exit_code.h"

namespace cli {
namespace {

[[noreturn]] void endWith(std::string_view line)
{
    DWORD written = 0;
    ::WriteFile(::GetStdHandle(STD_ERROR_HANDLE), line.data(), static_cast<DWORD>(line.size()), &written, nullptr);
    ::TerminateProcess(::GetCurrentProcess(), static_cast<UINT>(ExitCode::InternalError));
    ::Sleep(INFINITE);
    __builtin_unreachable();
}

/// Ends the process where an exception cannot reach main(): from a destructor, or from a worker of TBB.
[[noreturn]] void endOnException()
{
    try {
        if (const std::exception_ptr error = std::current_exception()) {
            std::rethrow_exception(error);
        }
    } catch (const std::bad_alloc&) {
        endWith("droplet-shape: out of memory; use fewer triangles or droplets, smaller pictures or fewer threads\n");
    } catch (const std::exception& error) {
        if (isThreadShortage(error)) {
            endWith("droplet-shape: out of threads or memory: no further thread can be started; use fewer --threads\n");
        }
    } catch (...) {
    }
    endWith("droplet-shape: internal error: a library has given up\n");
}

}  // namespace

bool isThreadShortage(const std::exception& error)
{
    const auto* system = dynamic_cast<const std::system_error*>(&error);
    return system != nullptr && system->code() == std::errc::resource_unavailable_try_again;
}

void reportShortages()
{
    std::set_terminate(endOnException);
    // No window asks what to do about a fault.
    ::SetErrorMode(SEM_FAILCRITICALERRORS | SEM_NOGPFAULTERRORBOX);
}

}  // namespace cli
