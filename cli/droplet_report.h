// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "droplet/droplet.h"
#include "droplet/io/output.h"
#include "droplet/io/report.h"
#include "droplet_options.h"

namespace cli {

/// Report of a surface's file. Its size in bytes is added after writing.
droplet::OutputReport describeOutput(const droplet::Surface& surface, const std::string& path, droplet::Format format);

/// Report of a droplet, without input, output, times and memory.
droplet::Report describe(const droplet::Droplet& droplet, const DropletSettings& settings);

}  // namespace cli
