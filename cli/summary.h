// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "droplet/io/report.h"

namespace cli {

/// Report as readable text: a few lines; `details` adds every droplet, times and memory.
std::string summary(const droplet::Report& report, bool details);

}  // namespace cli
