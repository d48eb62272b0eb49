// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "process.h"

namespace cli {

/// Frames of a video, decoded one by one by the program ffmpeg, with limits of memory and of time for each frame. Only
/// containers are read that hold their pictures themselves, so that ffmpeg opens no other file.
class Video {
public:
    /// Starts ffmpeg, and gets the frame rate and the number of frames from ffprobe.
    /// @param played_at       output frame rate: each output frame is the one that the video shows at its time;
    ///                        empty for every frame once
    /// @throws droplet::Error InvalidInput if ffmpeg or ffprobe is missing or cannot read the file
    explicit Video(const std::string& path, std::optional<double> played_at = {});
    /// Ends ffmpeg.
    ~Video();
    Video(const Video&) = delete;
    Video& operator=(const Video&) = delete;

    /// Next frame, as PPM; nothing after the last one.
    /// @throws droplet::Error InvalidInput, with ffmpeg's message, if it failed or the video is cut off
    std::optional<std::vector<std::byte>> next();

    /// Frame rate that the file states.
    [[nodiscard]] std::optional<double> framesPerSecond() const { return metadata_.rate; }

    /// Properties that the file states.
    struct Metadata {
        std::optional<double> rate;    ///< frames per second
        std::optional<double> frames;  ///< number of shown frames
    };

private:
    /// Waits for ffmpeg.
    /// @throws droplet::Error InvalidInput if ffmpeg failed, or there were fewer frames than the file states
    void finish();

    std::string path_;
    Metadata metadata_;
    std::size_t done_ = 0;  ///< number of frames read
    std::optional<ProcessId> process_;
    std::FILE* frames_ = nullptr;
    std::FILE* log_ = nullptr;
};

}  // namespace cli
