// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

namespace cli {

/// Frames of a video, decoded one after another by the program ffmpeg.
class Video {
public:
    /// Starts ffmpeg, and asks ffprobe for the rate and the number of frames.
    /// @param played_at       frames per second to give: at each time the one that is shown then, however unevenly the
    ///                        video's own come; empty: every frame once
    /// @throws droplet::Error InvalidInput if one of them is not there or cannot read the file
    explicit Video(const std::string& path, std::optional<double> played_at = {});
    /// Ends ffmpeg.
    ~Video();
    Video(const Video&) = delete;
    Video& operator=(const Video&) = delete;

    /// The next frame, as a PPM; nothing after the last one.
    /// @throws droplet::Error InvalidInput, with ffmpeg's words, if it failed or the video is cut off
    std::optional<std::vector<std::byte>> next();

    [[nodiscard]] std::optional<double> framesPerSecond() const { return announced_.rate; }

    /// What a video says of itself.
    struct Announced {
        std::optional<double> rate;    ///< frames a second
        std::optional<double> frames;  ///< how many it shows
    };

private:
    /// Waits for ffmpeg; complains if it did, or if it had fewer frames than were announced.
    void finish();

    std::string path_;
    Announced announced_;
    std::size_t done_ = 0;  ///< frames
    pid_t process_ = -1;
    std::FILE* frames_ = nullptr;
    std::FILE* words_ = nullptr;
};

}  // namespace cli
