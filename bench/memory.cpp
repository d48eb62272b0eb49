// SPDX-License-Identifier: GPL-3.0-or-later
// Linux manual: proc(5) on clear_refs and status, malloc_trim(3).
#include "memory.h"

#include <malloc.h>

#include <algorithm>
#include <fstream>
#include <string>

namespace droplet::bench {
namespace {

std::optional<std::uint64_t> status(const std::string& name)
{
    std::ifstream file("/proc/self/status");
    for (std::string key; file >> key; file.ignore(1 << 10, '\n')) {
        if (std::uint64_t kibibytes = 0; key == name + ":" && file >> kibibytes) {
            return 1024 * kibibytes;
        }
    }
    return std::nullopt;
}

}  // namespace

PeakMemory::PeakMemory()
{
    ::malloc_trim(0);
    if (std::ofstream("/proc/self/clear_refs") << 5 << std::flush) {  // sets the peak to the resident memory
        before_ = status("VmHWM");
    }
}

std::optional<std::uint64_t> PeakMemory::rise() const
{
    const std::optional<std::uint64_t> peak = status("VmHWM");
    return before_ && peak ? std::optional(*peak - std::min(*peak, *before_)) : std::nullopt;
}

}  // namespace droplet::bench
