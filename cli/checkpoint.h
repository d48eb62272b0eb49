// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "droplet/io/output.h"
#include "droplet/wind_io/windshield_report.h"
#include "droplet/windshield/windshield.h"

namespace cli {

/// Where a windshield stands between two frames: all that is needed to go on as if nothing had happened.
struct Checkpoint {
    std::string fingerprint;  ///< of the options
    std::size_t frames = 0;   ///< that are whole
    std::vector<droplet::BalanceRow> balance;
    droplet::WindshieldState state;
};

/// Writes it whole or not at all.
/// @throws droplet::Error OutputFailed
void writeCheckpoint(const std::string& path, const Checkpoint& checkpoint);

/// Takes away what an earlier run left.
/// @throws droplet::Error OutputFailed if what stands there is no checkpoint, or must not be replaced
void removeCheckpoint(const std::string& path, const droplet::OutputOptions& options);

/// @return                nothing if there is none
/// @throws droplet::Error InvalidInput if it is damaged
std::optional<Checkpoint> readCheckpoint(const std::string& path);

}  // namespace cli
