// SPDX-License-Identifier: GPL-3.0-or-later
#include "video_encoding.h"

#include <fmt/core.h>

#include "option_values.h"
#include "video_writer.h"

namespace cli {

void declareVideoEncoding(CommandLine& line, const char* group)
{
    line.add(group, "--codec", "NAME", "Encoder of ffmpeg [libx264, libvpx-vp9 for .webm]");
    line.add(group, "--quality", "NUMBER", "Quality of the video, 1 to 100 [65]", within(1.0, 100.0));
}

VideoEncoding readVideoEncoding(const CommandLine& line, bool has_video, const std::string& needed)
{
    for (const char* option : {"--codec", "--quality"}) {
        if (line.value(option) && !has_video) {
            refuse(std::string(option) + " needs a video as " + needed);
        }
    }
    VideoEncoding encoding;
    if (const auto codec = line.value("--codec")) {
        encoding.codec = codec->text;
    }
    if (const auto quality = line.value("--quality")) {
        const auto value = finiteNumber(quality->text);
        if (!value || *value < 1.0 || *value > 100.0) {
            refuse(*quality, "a number from 1 to 100");
        }
        encoding.quality = *value;
    }
    return encoding;
}

void declareVideoAlpha(CommandLine& line, const char* group)
{
    line.addFlag(
        group, "--alpha",
        "Keep the transparency of a drawing in a video: VP9 in .webm and .mkv, ProRes 4444 in .mov; also PNG or "
        "QuickTime Animation in .mov, by --codec png or qtrle");
}

void keepAlpha(VideoEncoding& encoding, const std::string& path, const std::string& option)
{
    if (!encoding.codec) {
        encoding.codec = alphaCodecFor(path);
    }
    if (!encoding.codec || !hasAlpha(*encoding.codec)) {
        refuse(option + ": " + (encoding.codec ? *encoding.codec : path) +
               " has no alpha; .webm, .mkv and .mov have it, with the codecs libvpx-vp9, prores_ks, png or qtrle");
    }
    encoding.alpha = true;
}

VideoFrames evenSides(VideoFrames frames)
{
    frames.width += frames.width % 2;
    frames.height += frames.height % 2;
    return frames;
}

void requireEvenSides(const std::string& option, int width, int height)
{
    if (width % 2 != 0 || height % 2 != 0) {
        refuse(fmt::format("{}: a video's frame must have even sides, not {}x{}", option, width, height));
    }
}

VideoWriterOptions triedVideo(const std::string& path, const VideoFrames& frames, const VideoEncoding& encoding)
{
    const std::string codec = encoding.codec.value_or(codecFor(path));
    checkCodec(codec, path);
    VideoWriterOptions video{path,          codec, frames.width, frames.height, frames.per_second, encoding.quality,
                             encoding.alpha};
    tryVideo(video);
    return video;
}

}  // namespace cli
