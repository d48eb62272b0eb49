// SPDX-License-Identifier: GPL-3.0-or-later
#include "this_process.h"

#include <sys/resource.h>

#include <system_error>

namespace cli {

std::uint64_t peakMemory()
{
    struct rusage usage = {};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;  // Linux returns KiB
}

std::filesystem::path programFile()
{
    std::error_code unknown;
    return std::filesystem::read_symlink("/proc/self/exe", unknown);
}

}  // namespace cli
