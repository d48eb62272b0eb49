// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "command_line.h"

namespace cli {

struct VideoWriterOptions;

/// Default quality, at which no difference from the frames is visible.
inline constexpr double kVideoQuality = 65.0;

/// How a video is encoded.
struct VideoEncoding {
    std::optional<std::string> codec;  ///< ffmpeg's name of the encoder; empty: that of the container
    double quality = kVideoQuality;    ///< 1 … 100
    bool alpha = false;                ///< keeps the transparency of frames
};

/// Declares --codec and --quality.
void declareVideoEncoding(CommandLine& line, const char* group);

/// Reads the options of declareVideoEncoding.
/// @param has_video       whether a video is written; without one, the options are refused
/// @param needed          what must be a video, for the message
/// @throws droplet::Error InvalidArgument
VideoEncoding readVideoEncoding(const CommandLine& line, bool has_video, const std::string& needed);

/// Declares --alpha.
void declareVideoAlpha(CommandLine& line, const char* group);

/// Makes an encoding keep the transparency of frames.
/// @param path            of the video
/// @param option          that asks for it, for the message
/// @throws droplet::Error InvalidArgument if the codec, or every codec of the path's container, has no alpha
void keepAlpha(VideoEncoding& encoding, const std::string& path, const std::string& option);

/// Size and rate of a video.
struct VideoFrames {
    int width = 0;   ///< [px]
    int height = 0;  ///< [px]
    double per_second = 24.0;
};

/// Frames with even sides, as encoders need them, at most a pixel larger.
VideoFrames evenSides(VideoFrames frames);

/// Requires even sides of a size that was asked for.
/// @param option          that asks for it, for the message
/// @throws droplet::Error InvalidArgument
void requireEvenSides(const std::string& option, int width, int height);

/// Options of a video, after ffmpeg tried them.
/// @throws droplet::Error InvalidArgument: the encoder does not exist, or does not fit; OutputFailed: no ffmpeg
VideoWriterOptions triedVideo(const std::string& path, const VideoFrames& frames, const VideoEncoding& encoding);

}  // namespace cli
