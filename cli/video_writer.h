// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdio>
#include <iosfwd>
#include <string>

#include "droplet/picture/picture.h"
#include "process.h"

namespace cli {

/// Looks like the frames themselves.
inline constexpr double kVideoQuality = 65.0;

struct VideoWriterOptions {
    std::string path;   ///< whose extension tells the container: isVideo(path)
    std::string codec;  ///< as ffmpeg calls its encoder
    int width = 0;      ///< [px]
    int height = 0;     ///< [px]
    double frames_per_second = 30.0;
    double quality = kVideoQuality;  ///< 1 … 100, where 100 is the best that the codec has
};

/// Whether we write videos of that name: .mp4, .mkv, .mov or .webm.
bool isVideo(const std::string& path);

/// The codec of a video's name, where none is asked for.
std::string codecFor(const std::string& path);

/// Asks ffmpeg for its encoders.
/// @throws droplet::Error InvalidArgument if this is none of them; OutputFailed if there is no ffmpeg
void checkCodec(const std::string& codec, const std::string& path);

/// Makes a video of one black frame, for not every encoder goes with every kind of file.
/// @throws droplet::Error InvalidArgument, naming --codec, with ffmpeg's words
void tryVideo(const VideoWriterOptions& options);

/// A video on its way, encoded by the program ffmpeg into a file without a name, in the colours of BT.709, and marked
/// so.
class VideoWriter {
public:
    /// @throws droplet::Error OutputFailed
    explicit VideoWriter(const VideoWriterOptions& options);
    /// Ends ffmpeg.
    ~VideoWriter();
    VideoWriter(const VideoWriter&) = delete;
    VideoWriter& operator=(const VideoWriter&) = delete;

    /// @throws droplet::Error OutputFailed, with ffmpeg's words
    void add(const droplet::Picture& frame);

    /// Ends the video and copies it.
    /// @throws droplet::Error OutputFailed, with ffmpeg's words
    void finish(std::ostream& out);

private:
    [[noreturn]] void complain();
    int end();

    std::string path_;
    std::FILE* video_ = nullptr;
    Process process_;
};

}  // namespace cli
