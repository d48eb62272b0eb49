// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tbb/task_group.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "checkpoint.h"
#include "common_options.h"
#include "droplet/zip.h"
#include "files.h"
#include "progress_display.h"
#include "run_command.h"
#include "run_files.h"

namespace cli {

/// How the frames of a run are made.
struct FilmSteps {
    /// Simulates a frame; frames come in order, and are numbered from 1. What it returns draws and writes the frame,
    /// while the next one is simulated; none after the last frame.
    std::function<std::optional<std::function<void()>>(std::size_t number)> frame;
    /// State after a frame that was simulated and drawn, for a checkpoint.
    std::function<Blobs()> state = {};
};

/// Frames over time: what all commands do that make them.
///
/// Three frames are in work at a time: one is written while the next one is drawn, and the one after that is simulated.
/// Frames are drawn one after another, and written one after another, so the number of threads changes no byte.
class Film {
public:
    /// @param frames     number of frames that the display counts; none: they are made until there are no more
    /// @param treatment  of existing files
    /// @param resumable  set if every frame has a file; then a checkpoint is written after every second of the film
    Film(std::optional<std::size_t> frames, const droplet::OutputOptions& treatment, ProgressDisplay& progress,
         std::optional<ResumableRun> resumable = {});
    Film(const Film&) = delete;
    Film& operator=(const Film&) = delete;

    /// Begins the run.
    /// @param resume          whether to go on from a checkpoint; otherwise that of an earlier run is removed
    /// @return                the checkpoint of an interrupted run, if there is one
    /// @throws droplet::Error as CheckpointFile::begin()
    std::optional<Checkpoint> begin(bool resume);

    /// Path of the checkpoint, for messages.
    [[nodiscard]] const std::string& checkpointPath() const { return checkpoint_->path(); }
    /// Whether all files of the first frames exist.
    [[nodiscard]] bool hasFrames(std::size_t count) const { return checkpoint_->run().hasFrames(count); }
    /// Writes all frames again that an interrupted run wrote.
    void writeAgain() { written_ = 0; }
    /// Whether an interrupted run wrote all files of a frame, which need not be written again.
    [[nodiscard]] bool isWritten(std::size_t number) const;

    /// Makes frames, within write().
    /// @param done            number of frames before the first one
    /// @throws droplet::Error whatever a step throws
    void make(std::size_t done, const FilmSteps& steps);

    /// Takes a frame that was simulated, within write(); for simulations that call rather than are called.
    /// @param draw            as FilmSteps::frame returns it
    /// @param state           as FilmSteps::state
    /// @throws droplet::Error whatever the frame before throws when it is drawn
    void add(std::size_t number, std::function<void()> draw, const std::function<Blobs()>& state = {});

    /// Writes files of a frame that is drawn, all or none, while the next one is drawn; within write().
    void save(std::vector<OutputFile> files);

    /// Begins a zip archive, to which pack() adds files of frames; within write(), at whose end it is complete.
    /// @param out  the archive
    void beginArchive(std::ostream& out);
    /// Adds files of a frame that is drawn to the archive, while the next one is drawn; within write().
    /// @param files  their paths are those in the archive; each is written twice, the same bytes
    void pack(std::vector<OutputFile> files);
    /// Size of the archive, after the frames.
    [[nodiscard]] std::uint64_t archiveBytes() const { return archive_bytes_; }

    /// Makes the frames, and writes the files of the whole run after them: all or none. Then the run needs no
    /// checkpoint any more. Nothing is drawn or written any more when it returns or throws.
    /// @param table           path of a file that is open while the frames are made: a table, or an archive
    /// @param make            makes the frames; gets the stream of that file, if there is one
    /// @throws droplet::Error OutputFailed; whatever `make` and the files throw
    void write(const std::optional<std::string>& table, const std::function<void(std::ostream*)>& make,
               std::vector<OutputFile> files);

private:
    void settle();

    std::optional<std::size_t> frames_;
    droplet::OutputOptions treatment_;
    ProgressDisplay& progress_;
    std::optional<CheckpointFile> checkpoint_;
    std::size_t written_ = 0;  ///< number of frames of an interrupted run
    std::optional<droplet::ZipWriter> archive_;
    std::uint64_t archive_bytes_ = 0;
    tbb::task_group drawing_;
    tbb::task_group saving_;
};

}  // namespace cli
