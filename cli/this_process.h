// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>

namespace cli {

/// Peak memory of this process [bytes].
std::uint64_t peakMemory();

/// File of the running program; empty if the system does not tell.
std::filesystem::path programFile();

}  // namespace cli
