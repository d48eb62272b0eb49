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

/// Starts a program that reads a video.
/// @throws Error InvalidInput if the program cannot be run
Process startReading(const std::vector<std::string>& command, const std::string& path)
{
    const Started started = start(command, Piped::Output);
    if (started.failure != 0) {
        throw Error(ErrorCode::InvalidInput, path + ": videos are read through the program " + command[0] +
                                                 ", which cannot be run: " + std::strerror(started.failure));
    }
    return started.process;
}

[[noreturn]] void throwReadError(const std::string& path, const std::string& program, std::FILE* log)
{
    const std::string line = firstLine(log);
    throw Error(ErrorCode::InvalidInput, path + ": " + program + " cannot read it" + (line.empty() ? "" : ": " + line));
}

/// Parses a positive number such as 25/1 or 30000/1001.
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

/// Value of a name in lines such as `nb_frames=40`.
std::optional<double> valueOf(const std::string& name, std::string_view lines)
{
    const auto at = lines.find(name + "=");
    return at == std::string_view::npos ? std::nullopt : quotient(lines.substr(at + name.size() + 1).substr(0, 64));
}

/// Number of shown frames. A trimmed video may contain more frames than its duration shows.
std::optional<double> shownFrames(std::string_view lines)
{
    const auto held = valueOf("nb_frames", lines);
    const auto rate = valueOf("avg_frame_rate", lines);
    const auto duration = valueOf("duration", lines);
    return held && rate && duration ? std::optional(std::min(*held, *rate * *duration)) : held;
}

Video::Metadata readMetadata(const std::string& path)
{
    const Process process =
        startReading({"ffprobe", "-v", "error", "-select_streams", "v:0", "-show_entries",
                      "stream=avg_frame_rate,duration,nb_frames", "-of", "default=nw=1", "-i", plainName(path)},
                     path);
    std::array<char, 512> text{};
    const std::size_t count = std::fread(text.data(), 1, text.size() - 1, process.output);
    std::fclose(process.output);
    const int status = waitFor(process.id);
    std::FILE* const log = process.log;
    if (status != 0 || count == 0) {
        try {
            throwReadError(path, "ffprobe", log);
        } catch (...) {
            std::fclose(log);
            throw;
        }
    }
    std::fclose(log);
    const std::string_view lines(text.data(), count);
    return {valueOf("avg_frame_rate", lines), shownFrames(lines)};
}

}  // namespace

Video::Video(const std::string& path, std::optional<double> played_at) : path_(path), metadata_(readMetadata(path))
{
    std::vector<std::string> command{"ffmpeg",        "-nostdin", "-v",    "error",     "-xerror",    "-i",
                                     plainName(path), "-map",     "0:v:0", "-fps_mode", "passthrough"};
    if (played_at) {
        // round=up: each output frame is the last input frame that is not after it.
        metadata_.frames.reset();  // the number of output frames differs
        command.insert(command.end(), {"-vf", fmt::format("fps={:.12g}:round=up", *played_at)});
    }
    command.insert(command.end(), {"-f", "image2pipe", "-c:v", "ppm", "-pix_fmt", "rgb24", "-"});
    const Process process = startReading(command, path);
    process_ = process.id;
    frames_ = process.output;
    log_ = process.log;
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
    std::fclose(log_);
}

void Video::finish()
{
    std::fclose(frames_);
    frames_ = nullptr;
    const int status = waitFor(process_);
    process_ = -1;
    // ffmpeg reads a Matroska file that ends too early without an error status.
    const bool is_cut = logText(log_).find("ended prematurely") != std::string::npos;
    const bool is_short = metadata_.frames && static_cast<double>(done_) + 1.0 < *metadata_.frames;
    if (done_ > 0 && (status != 0 || is_cut || is_short)) {
        const std::string line = firstLine(log_);
        throw Error(ErrorCode::InvalidInput,
                    path_ + ": is cut off or damaged after frame " + std::to_string(done_) +
                        (is_short ? " of " + std::to_string(std::lround(*metadata_.frames)) : "") +
                        (line.empty() ? "" : ": " + line));
    }
    if (status != 0) {
        throwReadError(path_, "ffmpeg", log_);
    }
}

std::optional<std::vector<std::byte>> Video::next()
{
    if (frames_ == nullptr) {
        return std::nullopt;
    }
    // The header is P6, size and largest value, each on a line; then come three bytes per pixel.
    std::string head;
    for (int lines = 0; lines < 3;) {
        const int sign = std::fgetc(frames_);
        if (sign == EOF || head.size() > 64) {
            const bool between_frames = head.empty();
            finish();
            if (!between_frames) {
                throwReadError(path_, "ffmpeg", log_);
            }
            return std::nullopt;
        }
        head.push_back(static_cast<char>(sign));
        lines += sign == '\n' ? 1 : 0;
    }
    unsigned width = 0;
    unsigned height = 0;
    if (std::sscanf(head.c_str(), "P6\n%9u %9u\n255\n", &width, &height) != 2) {
        throwReadError(path_, "ffmpeg", log_);
    }
    const std::size_t pixels = std::size_t{3} * width * height;
    std::vector<std::byte> frame(head.size() + pixels);
    std::memcpy(frame.data(), head.data(), head.size());
    if (std::fread(frame.data() + head.size(), 1, pixels, frames_) != pixels) {
        finish();
        throwReadError(path_, "ffmpeg", log_);
    }
    ++done_;
    return frame;
}

}  // namespace cli
