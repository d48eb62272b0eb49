// SPDX-License-Identifier: GPL-3.0-or-later
// Short of memory or threads: one line, exit 1, no output touched.
#include "cli/shortage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <functional>
#include <new>
#include <stdexcept>
#include <string>
#include <system_error>

namespace droplet {
namespace {

/// Calls a function whose exceptions reach nobody, as those of a destructor do.
void callAlone(const std::function<void()>& function) noexcept
{
    function();
}

/// Limits the address space to little more than is in use.
void limitMemory()
{
    const rlimit limit{std::size_t{16} << 20U, RLIM_INFINITY};
    setrlimit(RLIMIT_AS, &limit);
}

class ShortageDeathTest : public ::testing::Test {
protected:
    void SetUp() override
    {
#if defined(__SANITIZE_ADDRESS__)
        GTEST_SKIP() << "the sanitizer itself takes terabytes of address space";
#endif
    }
};

TEST_F(ShortageDeathTest, ExceptionsThatReachNobodyAreReported)
{
    const auto end_with = [](const auto& error) {
        cli::reportShortages();
        callAlone([&] { throw error; });
    };
    EXPECT_EXIT(end_with(std::bad_alloc()), ::testing::ExitedWithCode(1), "^droplet-shape: out of memory[^\n]*\n$");
    const std::system_error no_thread(std::make_error_code(std::errc::resource_unavailable_try_again));
    EXPECT_EXIT(end_with(no_thread), ::testing::ExitedWithCode(1), "^droplet-shape: out of threads[^\n]*\n$");
    EXPECT_EXIT(end_with(std::runtime_error("pthread_create has failed: Resource temporarily unavailable")),
                ::testing::ExitedWithCode(1), "^droplet-shape: out of threads[^\n]*\n$");
    EXPECT_EXIT(end_with(std::runtime_error("other")), ::testing::ExitedWithCode(1), "internal error[^\n]*\n$");
}

TEST_F(ShortageDeathTest, FaultsForLackOfMemoryAreReported)
{
    const auto end_by = [](int signal, bool is_short) {
        cli::reportShortages();
        if (is_short) {
            limitMemory();
        }
        std::raise(signal);
    };
    for (const int signal : {SIGSEGV, SIGBUS, SIGABRT}) {
        EXPECT_EXIT(end_by(signal, true), ::testing::ExitedWithCode(1), "^droplet-shape: out of memory[^\n]*\n$");
        EXPECT_EXIT(end_by(signal, false), ::testing::KilledBySignal(signal), "^$");
    }
    const auto use_null = [] {
        cli::reportShortages();
        limitMemory();
        volatile int* const nothing = nullptr;
        *nothing = 1;
    };
    EXPECT_EXIT(use_null(), ::testing::ExitedWithCode(1), "out of memory");
}

}  // namespace
}  // namespace droplet
