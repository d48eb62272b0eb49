// SPDX-License-Identifier: GPL-3.0-or-later
#include "video_writer.h"

#include <fmt/core.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <initializer_list>
#include <ostream>
#include <sstream>
#include <vector>

#include "droplet/error.h"
#include "option_values.h"

namespace cli {
namespace {

using droplet::Error;
using droplet::ErrorCode;

struct Container {
    const char* extension;
    const char* format;  ///< ffmpeg's name
    const char* codec;
};

constexpr std::array<Container, 4> kContainers{{{".mp4", "mp4", "libx264"},
                                                {".mkv", "matroska", "libx264"},
                                                {".mov", "mov", "libx264"},
                                                {".webm", "webm", "libvpx-vp9"}}};

const Container* containerOf(const std::string& path)
{
    const std::string extension = std::filesystem::path(path).extension().string();
    for (const Container& container : kContainers) {
        if (extension == container.extension) {
            return &container;
        }
    }
    return nullptr;
}

droplet::Picture plainPicture(int width, int height, unsigned char level)
{
    droplet::Picture picture{width, height, {}};
    picture.rgb.assign(std::size_t{3} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height), level);
    return picture;
}

Process startFfmpeg(const std::vector<std::string>& command, Piped piped, const std::string& path,
                    std::optional<int> file)
{
    const Started started = start(command, piped, file);
    if (started.failure != 0) {
        throw Error(ErrorCode::OutputFailed,
                    path + ": videos are written through the program ffmpeg, which cannot be run: " +
                        std::strerror(started.failure) + "; install it, or write pictures such as out/%05d.png");
    }
    return started.process;
}

/// Options for a quality: 100 is step 0 of the codec's quantiser, 0 its last step.
std::vector<std::string> qualityOf(const std::string& codec, double quality)
{
    const auto steps = [&](double max) { return std::to_string(std::lround(max * (1.0 - quality / 100.0))); };
    if (codec == "libx264" || codec == "libx265") {
        return {"-crf", steps(51.0)};
    }
    if (codec == "libvpx-vp9" || codec == "libaom-av1" || codec == "libsvtav1") {
        return {"-crf", steps(63.0), "-b:v", "0"};
    }
    return {"-q:v", steps(31.0)};
}

std::vector<std::string> commandOf(const VideoWriterOptions& options)
{
    std::vector<std::string> command{"ffmpeg", "-nostdin", "-v", "error"};
    const auto add = [&](std::initializer_list<std::string> words) { command.insert(command.end(), words); };
    add({"-f", "rawvideo", "-pix_fmt", "rgb24"});
    add({"-s", std::to_string(options.width) + "x" + std::to_string(options.height)});
    add({"-r", fmt::format("{:.12g}", options.frames_per_second), "-i", "-", "-an"});
    add({"-vf", "scale=out_color_matrix=bt709:out_range=tv:flags=bicubic+accurate_rnd+full_chroma_int,format=yuv420p"});
    add({"-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "bt709", "-color_range", "tv"});
    add({"-c:v", options.codec});
    const std::vector<std::string> quality = qualityOf(options.codec, options.quality);
    command.insert(command.end(), quality.begin(), quality.end());
    add({"-threads", "2", "-fflags", "+bitexact", "-flags:v", "+bitexact", "-map_metadata", "-1"});
    add({"-f", containerOf(options.path)->format, "-y", "/dev/fd/3"});
    return command;
}

}  // namespace

bool isVideo(const std::string& path)
{
    return containerOf(path) != nullptr;
}

std::string codecFor(const std::string& path)
{
    return containerOf(path)->codec;
}

void checkCodec(const std::string& codec, const std::string& path)
{
    const Process process =
        startFfmpeg({"ffmpeg", "-hide_banner", "-v", "error", "-encoders"}, Piped::Output, path, {});
    std::string text;
    std::array<char, 4096> part{};
    for (std::size_t count = 0; (count = std::fread(part.data(), 1, part.size(), process.output)) > 0;) {
        text.append(part.data(), count);
    }
    std::fclose(process.output);
    std::fclose(process.log);
    waitFor(process.id);
    // Lines such as ` V....D libx264   libx264 H.264 / AVC`, after a legend that ends with dashes.
    std::istringstream lines(text.substr(std::min(text.find("------"), text.size())));
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string flags;
        std::string name;
        if (words >> flags >> name && flags.front() == 'V' && name == codec) {
            return;
        }
    }
    refuse({codec, "--codec"}, "a video encoder of ffmpeg, listed by ffmpeg -encoders");
}

droplet::Picture onWhite(const droplet::Layer& layer)
{
    return droplet::over(layer, plainPicture(layer.width, layer.height, 255));
}

void tryVideo(const VideoWriterOptions& options)
{
    const droplet::Picture black = plainPicture(options.width, options.height, 0);
    try {
        VideoWriter video(options);
        video.add(black);
        std::ostringstream nowhere;
        video.finish(nowhere);
    } catch (const Error& error) {
        refuse("--codec " + options.codec + ": " + error.what());
    }
}

VideoWriter::VideoWriter(const VideoWriterOptions& options) : path_(options.path), video_(std::tmpfile())
{
    if (video_ == nullptr) {
        throw Error(ErrorCode::OutputFailed, path_ + ": a temporary file cannot be created: " + std::strerror(errno));
    }
    try {
        process_ = startFfmpeg(commandOf(options), Piped::Input, path_, ::fileno(video_));
    } catch (...) {
        std::fclose(video_);
        throw;
    }
}

VideoWriter::~VideoWriter()
{
    if (process_.input != nullptr) {
        std::fclose(process_.input);
    }
    if (process_.id > 0) {
        ::kill(process_.id, SIGKILL);
        waitFor(process_.id);
    }
    std::fclose(process_.log);
    std::fclose(video_);
}

int VideoWriter::end()
{
    std::fclose(process_.input);
    process_.input = nullptr;
    const int status = waitFor(process_.id);
    process_.id = -1;
    return status;
}

void VideoWriter::throwWriteError()
{
    const std::string line = firstLine(process_.log);
    throw Error(ErrorCode::OutputFailed, path_ + ": ffmpeg cannot write it" + (line.empty() ? "" : ": " + line));
}

void VideoWriter::add(const droplet::Picture& frame)
{
    if (std::fwrite(frame.rgb.data(), 1, frame.rgb.size(), process_.input) != frame.rgb.size()) {
        end();
        throwWriteError();
    }
}

void VideoWriter::finish(std::ostream& out)
{
    if (end() != 0) {
        throwWriteError();
    }
    std::rewind(video_);
    std::array<char, 65536> part{};
    for (std::size_t count = 0; (count = std::fread(part.data(), 1, part.size(), video_)) > 0;) {
        out.write(part.data(), static_cast<std::streamsize>(count));
    }
    out.flush();
}

}  // namespace cli
