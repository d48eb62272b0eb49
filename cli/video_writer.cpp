// SPDX-License-Identifier: GPL-3.0-or-later
#include "video_writer.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <initializer_list>
#include <ostream>
#include <sstream>
#include <vector>

#include "droplet/error.h"
#include "option_values.h"
#include "process_log.h"

namespace cli {
namespace {

using droplet::Error;
using droplet::ErrorCode;

struct Container {
    const char* extension;
    const char* format;  ///< ffmpeg's name
    const char* codec;
    const char* alpha_codec;  ///< null: none that players of it know
};

constexpr std::array<Container, 4> kContainers{{{".mp4", "mp4", "libx264", nullptr},
                                                {".mkv", "matroska", "libx264", "libvpx-vp9"},
                                                {".mov", "mov", "libx264", "prores_ks"},
                                                {".webm", "webm", "libvpx-vp9", "libvpx-vp9"}}};

/// Codec that keeps transparency.
struct AlphaCodec {
    const char* codec;
    const char* pixels;  ///< ffmpeg's format
    bool is_rgb;
    std::array<const char*, 2> option;  ///< that it needs; or null
};

constexpr std::array<AlphaCodec, 5> kAlphaCodecs{{{"libvpx-vp9", "yuva420p", false, {"-auto-alt-ref", "0"}},
                                                  {"libvpx", "yuva420p", false, {"-auto-alt-ref", "0"}},
                                                  {"prores_ks", "yuva444p10le", false, {"-profile:v", "4444"}},
                                                  {"png", "rgba", true, {}},
                                                  {"qtrle", "argb", true, {}}}};

const AlphaCodec* alphaCodecNamed(const std::string& codec)
{
    const auto found = std::find_if(kAlphaCodecs.begin(), kAlphaCodecs.end(),
                                    [&](const AlphaCodec& known) { return codec == known.codec; });
    return found == kAlphaCodecs.end() ? nullptr : &*found;
}

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
                    const SharedFile* file = nullptr)
{
    const Started started = start(command, piped, file);
    if (started.failure != 0) {
        throw Error(ErrorCode::OutputFailed,
                    path + ": videos are written through the program ffmpeg, which cannot be run: " +
                        std::strerror(started.failure) + "; install it, or write pictures such as out/%05d.png");
    }
    return started.process;
}

/// Bytes of a layer in which transparent pixels have the colour of what is drawn in their row, or in the next row with
/// a drawing.
std::vector<std::uint8_t> withColoursBesideEdges(const droplet::Layer& layer)
{
    std::vector<std::uint8_t> rgba = layer.rgba;
    const auto width = static_cast<std::size_t>(layer.width);
    const std::size_t count = rgba.size() / 4;
    std::vector<bool> has_colour(count);
    for (std::size_t i = 0; i < count; ++i) {
        has_colour[i] = rgba[4 * i + 3] != 0;
    }
    const auto take = [&](std::size_t to, std::size_t from) {
        if (!has_colour[to] && has_colour[from]) {
            std::copy_n(&rgba[4 * from], 3, &rgba[4 * to]);
            has_colour[to] = true;
        }
    };
    for (std::size_t i = 1; i < count; ++i) {
        if (i % width != 0) {
            take(i, i - 1);
        }
    }
    for (std::size_t i = count; i-- > 1;) {
        if (i % width != 0) {
            take(i - 1, i);
        }
    }
    for (std::size_t i = width; i < count; ++i) {
        take(i, i - width);
    }
    for (std::size_t i = count; i-- > width;) {
        take(i - width, i);
    }
    return rgba;
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

std::vector<std::string> commandOf(const VideoWriterOptions& options, const std::string& file)
{
    std::vector<std::string> command{"ffmpeg", "-nostdin", "-v", "error"};
    const auto add = [&](std::initializer_list<std::string> words) { command.insert(command.end(), words); };
    // ProRes takes its tags from the frames; from version 7 on ffmpeg does so for all codecs.
    constexpr const char* kTagged = ",setparams=colorspace=bt709:color_primaries=bt709:color_trc=bt709:range=tv";
    const AlphaCodec* const alpha = options.alpha ? alphaCodecNamed(options.codec) : nullptr;
    add({"-f", "rawvideo", "-pix_fmt", alpha ? "rgba" : "rgb24"});
    add({"-s", std::to_string(options.width) + "x" + std::to_string(options.height)});
    add({"-r", fmt::format("{:.12g}", options.frames_per_second), "-i", "-", "-an"});
    if (alpha && alpha->is_rgb) {
        add({"-vf", std::string("format=") + alpha->pixels});
    } else {
        add({"-vf",
             std::string(
                 "scale=out_color_matrix=bt709:out_range=tv:flags=bicubic+accurate_rnd+full_chroma_int,format=") +
                 (alpha ? alpha->pixels : "yuv420p") + kTagged});
        add({"-colorspace", "bt709", "-color_range", "tv"});
    }
    add({"-color_primaries", "bt709", "-color_trc", "bt709"});
    add({"-c:v", options.codec});
    if (alpha && alpha->option[0]) {
        add({alpha->option[0], alpha->option[1]});
    }
    const std::vector<std::string> quality = qualityOf(options.codec, options.quality);
    command.insert(command.end(), quality.begin(), quality.end());
    add({"-threads", "2", "-fflags", "+bitexact", "-flags:v", "+bitexact", "-map_metadata", "-1"});
    add({"-f", containerOf(options.path)->format, "-y", file});
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

std::optional<std::string> alphaCodecFor(const std::string& path)
{
    const char* const codec = containerOf(path)->alpha_codec;
    return codec ? std::optional<std::string>(codec) : std::nullopt;
}

bool hasAlpha(const std::string& codec)
{
    return alphaCodecNamed(codec) != nullptr;
}

void checkCodec(const std::string& codec, const std::string& path)
{
    const Process process = startFfmpeg({"ffmpeg", "-hide_banner", "-v", "error", "-encoders"}, Piped::Output, path);
    std::string text;
    std::array<char, 4096> part{};
    for (std::size_t count = 0; (count = std::fread(part.data(), 1, part.size(), process.output)) > 0;) {
        text.append(part.data(), count);
    }
    std::fclose(process.output);
    std::fclose(process.log);
    waitFor(*process.id);
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
    const droplet::Layer empty{options.width, options.height,
                               std::vector<std::uint8_t>(std::size_t{4} * static_cast<std::size_t>(options.width) *
                                                         static_cast<std::size_t>(options.height))};
    try {
        VideoWriter video(options);
        video.add(empty);
        std::ostringstream nowhere;
        video.finish(nowhere);
    } catch (const Error& error) {
        refuse("--codec " + options.codec + ": " + error.what());
    }
}

VideoWriter::VideoWriter(const VideoWriterOptions& options) : path_(options.path), has_alpha_(options.alpha)
{
    if (video_.get() == nullptr) {
        throw Error(ErrorCode::OutputFailed, path_ + ": a temporary file cannot be created: " + std::strerror(errno));
    }
    process_ = startFfmpeg(commandOf(options, video_.name()), Piped::Input, path_, &video_);
}

VideoWriter::~VideoWriter()
{
    if (process_.input != nullptr) {
        std::fclose(process_.input);
    }
    if (process_.id) {
        endNow(*process_.id);
    }
    std::fclose(process_.log);
}

int VideoWriter::end()
{
    std::fclose(process_.input);
    process_.input = nullptr;
    const ProcessEnd ended = waitFor(*process_.id);
    process_.id.reset();
    return ended.code;
}

void VideoWriter::throwWriteError()
{
    const std::string line = firstLine(process_.log);
    throw Error(ErrorCode::OutputFailed, path_ + ": ffmpeg cannot write it" + (line.empty() ? "" : ": " + line));
}

void VideoWriter::add(const std::vector<std::uint8_t>& bytes)
{
    if (std::fwrite(bytes.data(), 1, bytes.size(), process_.input) != bytes.size()) {
        end();
        throwWriteError();
    }
}

void VideoWriter::add(const droplet::Picture& frame)
{
    add(frame.rgb);
}

void VideoWriter::add(const droplet::Layer& frame)
{
    if (has_alpha_) {
        add(withColoursBesideEdges(frame));
    } else {
        add(onWhite(frame));
    }
}

void VideoWriter::finish(std::ostream& out)
{
    if (end() != 0) {
        throwWriteError();
    }
    std::rewind(video_.get());
    std::array<char, 65536> part{};
    for (std::size_t count = 0; (count = std::fread(part.data(), 1, part.size(), video_.get())) > 0;) {
        out.write(part.data(), static_cast<std::streamsize>(count));
    }
    out.flush();
}

}  // namespace cli
