// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstring>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "droplet/io/output.h"
#include "numbered_path.h"

namespace cli {

/// Parts of a run's state, by name.
using Blobs = std::map<std::string, std::string>;

/// State of a run between two frames, from which it can resume exactly.
struct Checkpoint {
    std::size_t frames = 0;  ///< number of finished frames
    Blobs state;

    /// Part of the state; empty if there is none.
    [[nodiscard]] const std::string& operator[](const std::string& name) const;
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

/// Run that can be resumed, since every frame has a file.
struct ResumableRun {
    std::string command;              ///< such as `windshield`
    std::string fingerprint;          ///< hash of options and input files that decide what the frames show
    std::size_t frames = 0;           ///< of the whole run
    double frames_per_second = 30.0;  ///< a checkpoint is due every second of them
    std::vector<NumberedPath> files;  ///< of every frame; the checkpoint lies beside the first
    std::size_t first = 1;            ///< number of the first frame in their names

    /// Whether all files of a frame exist, counted from 1.
    [[nodiscard]] bool hasFrame(std::size_t number) const;
    /// Whether all files of the first frames exist.
    [[nodiscard]] bool hasFrames(std::size_t count) const;
};

/// Checkpoint of a run, beside its frames.
class CheckpointFile {
public:
    /// @param treatment  of an existing checkpoint
    CheckpointFile(ResumableRun run, const droplet::OutputOptions& treatment);

    /// Path of the file.
    [[nodiscard]] const std::string& path() const { return path_; }
    /// The run, with the files of its frames.
    [[nodiscard]] const ResumableRun& run() const { return run_; }

    /// Begins a run.
    /// @param resume           whether to go on from the checkpoint; otherwise that of an earlier run is removed
    /// @return                 the checkpoint, if there is one
    /// @throws droplet::Error InvalidArgument if it belongs to other options or files, or to a longer run; InvalidInput
    ///                        if it is damaged; OutputFailed if the file is not a checkpoint of the command, or must
    ///                        not be replaced
    [[nodiscard]] std::optional<Checkpoint> begin(bool resume) const;

    /// Whether a checkpoint is due after a frame.
    /// @param frames  number of finished frames
    [[nodiscard]] bool isDue(std::size_t frames) const;

    /// Writes a checkpoint, completely or not at all.
    /// @throws droplet::Error OutputFailed
    void write(const Checkpoint& checkpoint) const;

    /// Removes it at the end of the run.
    void end() const;

private:
    void removeOther() const;

    ResumableRun run_;
    droplet::OutputOptions treatment_;
    std::string path_;
};

}  // namespace cli
