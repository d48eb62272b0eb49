// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "droplet/io/report.h"

namespace cli {

/// A report in words, for people: a few lines, with `details` also the droplets one by one, times and memory.
std::string summary(const droplet::Report& report, bool details);

}  // namespace cli
