// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <cstdio>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "droplet/drawing/picture.h"
#include "process.h"
#include "video_encoding.h"

namespace cli {

struct VideoWriterOptions {
    std::string path;   ///< its extension selects the container: isVideo(path)
    std::string codec;  ///< ffmpeg's name of the encoder
    int width = 0;      ///< [px]
    int height = 0;     ///< [px]
    double frames_per_second = 30.0;
    double quality = kVideoQuality;  ///< 1 … 100; 100 is the codec's best
    bool alpha = false;              ///< keeps the transparency of layers; needs hasAlpha(codec)
};

/// Whether a path ends in .mp4, .mkv, .mov or .webm.
bool isVideo(const std::string& path);

/// Default codec for a video's path.
std::string codecFor(const std::string& path);

/// Default codec with alpha for a video's path; none for .mp4.
std::optional<std::string> alphaCodecFor(const std::string& path);

/// Whether a codec is known to keep transparency.
bool hasAlpha(const std::string& codec);

/// Checks that ffmpeg has an encoder.
/// @throws droplet::Error InvalidArgument if ffmpeg does not have it; OutputFailed if ffmpeg is missing
void checkCodec(const std::string& codec, const std::string& path);

/// Encodes one empty frame as a test: not every encoder fits every container.
/// @throws droplet::Error InvalidArgument, naming --codec, with ffmpeg's message
void tryVideo(const VideoWriterOptions& options);

/// Layer on white, for videos without transparency.
droplet::Picture onWhite(const droplet::Layer& layer);

/// Encodes a video by the program ffmpeg into a temporary file, in BT.709 colours, and tagged so.
class VideoWriter {
public:
    /// @throws droplet::Error OutputFailed
    explicit VideoWriter(const VideoWriterOptions& options);
    /// Ends ffmpeg.
    ~VideoWriter();
    VideoWriter(const VideoWriter&) = delete;
    VideoWriter& operator=(const VideoWriter&) = delete;

    /// Encodes one frame.
    /// @throws droplet::Error OutputFailed, with ffmpeg's message
    void add(const droplet::Picture& frame);
    /// Encodes one frame: with straight alpha if the options say so, otherwise on white. Transparent pixels take the
    /// colour of what is drawn beside them, since codecs mix the colours of neighbours.
    /// @throws droplet::Error OutputFailed, with ffmpeg's message
    void add(const droplet::Layer& frame);

    /// Completes the video and copies it to `out`.
    /// @throws droplet::Error OutputFailed, with ffmpeg's message
    void finish(std::ostream& out);

private:
    void add(const std::vector<std::uint8_t>& bytes);
    [[noreturn]] void throwWriteError();
    int end();

    std::string path_;
    bool has_alpha_;
    SharedFile video_;
    Process process_;
};

}  // namespace cli
