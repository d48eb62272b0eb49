// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstring>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "droplet/io/output.h"
#include "numbered_path.h"

namespace cli {

/// State of a run between two frames, from which it can resume exactly.
struct Checkpoint {
    std::string command;      ///< whose run it is, such as `windshield`
    std::string fingerprint;  ///< hash of options and input files
    std::size_t frames = 0;   ///< number of finished frames
    std::string rows;         ///< bytes of the report's rows: bytesOfRows()
    std::string state;        ///< bytes of the simulation's state
    // What `flow` needs besides.
    std::size_t planned_frames = 0;  ///< number of frames of the whole run
    std::string wet_picture = {};    ///< bytes of FlowPainter; empty without one
    std::string wet_maps = {};       ///< bytes of WetMapper; empty without one
};

/// Bytes of a report's rows, for the same program to read.
template <typename Row>
std::string bytesOfRows(const std::vector<Row>& rows)
{
    static_assert(std::is_trivially_copyable_v<Row>);
    return {reinterpret_cast<const char*>(rows.data()), rows.size() * sizeof(Row)};
}

/// Rows from their bytes.
template <typename Row>
std::vector<Row> rowsFromBytes(const std::string& bytes)
{
    static_assert(std::is_trivially_copyable_v<Row>);
    std::vector<Row> rows(bytes.size() / sizeof(Row));
    if (!rows.empty()) {
        std::memcpy(rows.data(), bytes.data(), rows.size() * sizeof(Row));
    }
    return rows;
}

/// Path of the checkpoint beside a run's frames.
std::string checkpointPath(const NumberedPath& frames);

/// Writes a checkpoint, completely or not at all.
/// @throws droplet::Error OutputFailed
void writeCheckpoint(const std::string& path, const Checkpoint& checkpoint);

/// Removes the checkpoint of an earlier run, if there is one.
/// @throws droplet::Error OutputFailed if the file is not a checkpoint of the command, or must not be replaced
void removeCheckpoint(const std::string& path, const std::string& command, const droplet::OutputOptions& options);

/// Reads a checkpoint of a command.
/// @return                nothing if the file does not exist
/// @throws droplet::Error InvalidInput if the file is damaged
std::optional<Checkpoint> readCheckpoint(const std::string& path, const std::string& command);

}  // namespace cli
