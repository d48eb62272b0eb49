// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "droplet/wind_io/windshield_report.h"
#include "windshield_options.h"

namespace cli {

/// Plays rain on a windshield and writes all that is asked for.
/// @throws droplet::Error
droplet::WindshieldReport playWindshield(const WindshieldOptions& options);

}  // namespace cli
