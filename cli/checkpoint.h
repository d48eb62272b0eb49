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

/// State of a windshield run between two frames, from which it can resume exactly.
struct Checkpoint {
    std::string fingerprint;  ///< hash of options and input files
    std::size_t frames = 0;   ///< number of finished frames
    std::vector<droplet::BalanceRow> balance;
    droplet::WindshieldState state;
};

/// Writes a checkpoint, completely or not at all.
/// @throws droplet::Error OutputFailed
void writeCheckpoint(const std::string& path, const Checkpoint& checkpoint);

/// Removes the checkpoint of an earlier run, if there is one.
/// @throws droplet::Error OutputFailed if the file is not a checkpoint, or must not be replaced
void removeCheckpoint(const std::string& path, const droplet::OutputOptions& options);

/// Reads a checkpoint.
/// @return                nothing if the file does not exist
/// @throws droplet::Error InvalidInput if the file is damaged
std::optional<Checkpoint> readCheckpoint(const std::string& path);

}  // namespace cli
