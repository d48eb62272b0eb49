// SPDX-License-Identifier: GPL-3.0-or-later
#include "video.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <csignal>
#include <cstring>
#include <string_view>

#include "droplet/error.h"
#include "process.h"

namespace cli {
namespace {

using droplet::Error;
using droplet::ErrorCode;

/// @throws Error InvalidInput if there is no such program
Process startReading(const std::vector<std::string>& command, const std::string& path)
{
    const Started started = start(command, Piped::Output);
    if (started.failure != 0) {
        throw Error(ErrorCode::InvalidInput, path + ": videos are read through the program " + command[0] +
                                                 ", which cannot be run: " + std::strerror(started.failure));
    }
    return started.process;
}

[[noreturn]] void complain(const std::string& path, const std::string& program, std::FILE* words)
{
    const std::string line = firstLine(words);
    throw Error(ErrorCode::InvalidInput, path + ": " + program + " cannot read it" + (line.empty() ? "" : ": " + line));
}

/// A number such as 25/1 or 30000/1001.
std::optional<double> quotient(std::string_view text)
{
    std::array<double, 2> parts{0.0, 1.0};
    const char* at = text.data();
    const char* const end = text.data() + text.size();
    for (double& part : parts) {
        const auto [stop, failure] = std::from_chars(at, end, part);
        if (failure != std::errc{}) {
            return std::nullopt;
        }
        if (stop == end || *stop != '/') {
            break;
        }
        at = stop + 1;
    }
    const double rate = parts[0] / parts[1];
    return rate > 0.0 && rate < 1e6 ? std::optional(rate) : std::nullopt;
}

/// What stands behind a name in lines such as `nb_frames=40`.
std::optional<double> valueOf(const std::string& name, std::string_view lines)
{
    const auto at = lines.find(name + "=");
    return at == std::string_view::npos ? std::nullopt : quotient(lines.substr(at + name.size() + 1).substr(0, 64));
}

/// A video that was trimmed may hold more frames than it shows: then its duration tells.
std::optional<double> shownFrames(std::string_view lines)
{
    const auto held = valueOf("nb_frames", lines);
    const auto rate = valueOf("avg_frame_rate", lines);
    const auto duration = valueOf("duration", lines);
    return held && rate && duration ? std::optional(std::min(*held, *rate * *duration)) : held;
}

Video::Announced announcedBy(const std::string& path)
{
    const Process process =
        startReading({"ffprobe", "-v", "error", "-select_streams", "v:0", "-show_entries",
                      "stream=avg_frame_rate,duration,nb_frames", "-of", "default=nw=1", "-i", plainName(path)},
                     path);
    std::array<char, 512> text{};
    const std::size_t count = std::fread(text.data(), 1, text.size() - 1, process.output);
    std::fclose(process.output);
    const int status = waitFor(process.id);
    std::FILE* const words = process.words;
    if (status != 0 || count == 0) {
        try {
            complain(path, "ffprobe", words);
        } catch (...) {
            std::fclose(words);
            throw;
        }
    }
    std::fclose(words);
    const std::string_view lines(text.data(), count);
    return {valueOf("avg_frame_rate", lines), shownFrames(lines)};
}

}  // namespace

Video::Video(const std::string& path, std::optional<double> played_at) : path_(path), announced_(announcedBy(path))
{
    std::vector<std::string> command{"ffmpeg",        "-nostdin", "-v",    "error",     "-xerror",    "-i",
                                     plainName(path), "-map",     "0:v:0", "-fps_mode", "passthrough"};
    if (played_at) {
        // A frame takes the first place that is not before it: the last of those due is shown.
        announced_.frames.reset();  // another number of frames will come
        command.insert(command.end(), {"-vf", fmt::format("fps={:.12g}:round=up", *played_at)});
    }
    command.insert(command.end(), {"-f", "image2pipe", "-c:v", "ppm", "-pix_fmt", "rgb24", "-"});
    const Process process = startReading(command, path);
    process_ = process.id;
    frames_ = process.output;
    words_ = process.words;
}

Video::~Video()
{
    if (frames_ != nullptr) {
        std::fclose(frames_);
    }
    if (process_ > 0) {
        ::kill(process_, SIGKILL);
        waitFor(process_);
    }
    std::fclose(words_);
}

void Video::finish()
{
    std::fclose(frames_);
    frames_ = nullptr;
    const int status = waitFor(process_);
    process_ = -1;
    // Of a Matroska that ends too early ffmpeg reads what there is, and ends as if all were well.
    const bool cut = wordsOf(words_).find("ended prematurely") != std::string::npos;
    const bool few = announced_.frames && static_cast<double>(done_) + 1.0 < *announced_.frames;
    if (done_ > 0 && (status != 0 || cut || few)) {
        const std::string line = firstLine(words_);
        throw Error(ErrorCode::InvalidInput, path_ + ": is cut off or damaged after frame " + std::to_string(done_) +
                                                 (few ? " of " + std::to_string(std::lround(*announced_.frames)) : "") +
                                                 (line.empty() ? "" : ": " + line));
    }
    if (status != 0) {
        complain(path_, "ffmpeg", words_);
    }
}

std::optional<std::vector<std::byte>> Video::next()
{
    if (frames_ == nullptr) {
        return std::nullopt;
    }
    // ffmpeg writes P6, a line each for size and largest value, then three bytes a pixel.
    std::string head;
    for (int lines = 0; lines < 3;) {
        const int sign = std::fgetc(frames_);
        if (sign == EOF || head.size() > 64) {
            const bool between_frames = head.empty();
            finish();
            if (!between_frames) {
                complain(path_, "ffmpeg", words_);
            }
            return std::nullopt;
        }
        head.push_back(static_cast<char>(sign));
        lines += sign == '\n' ? 1 : 0;
    }
    unsigned width = 0;
    unsigned height = 0;
    if (std::sscanf(head.c_str(), "P6\n%9u %9u\n255\n", &width, &height) != 2) {
        complain(path_, "ffmpeg", words_);
    }
    const std::size_t pixels = std::size_t{3} * width * height;
    std::vector<std::byte> frame(head.size() + pixels);
    std::memcpy(frame.data(), head.data(), head.size());
    if (std::fread(frame.data() + head.size(), 1, pixels, frames_) != pixels) {
        finish();
        complain(path_, "ffmpeg", words_);
    }
    ++done_;
    return frame;
}

}  // namespace cli
