// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>

#include "droplet/droplet.h"
#include "droplet/io/output.h"
#include "droplet/io/report.h"
#include "droplet_options.h"

namespace cli {

/// A file of a surface, but for its bytes, which are known when it is written.
droplet::OutputReport describeOutput(const droplet::Surface& surface, const std::string& path, droplet::Format format);

/// Everything but input and output, and times and memory, which are known when all is done.
droplet::Report describe(const droplet::Droplet& droplet, const DropletSettings& settings);

/// The most memory this process has had [bytes].
std::uint64_t peakMemory();

}  // namespace cli
