// SPDX-License-Identifier: GPL-3.0-or-later
#include "video.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <string_view>

#include "droplet/error.h"
#include "process_log.h"

namespace cli {
namespace {

using droplet::Error;
using droplet::ErrorCode;

/// Containers that hold their pictures themselves, by ffmpeg's names. Lists of other files, such as HLS, DASH, ffconcat
/// and SDP, are not among them, so that a video makes ffmpeg read no other file.
constexpr const char* kContainers =
    "mov,matroska,avi,flv,asf,mpeg,mpegts,mpegvideo,ogg,mxf,nut,gif,apng,ivf,obu,h264,hevc,m4v,mjpeg,dv,yuv4mpegpipe";
/// A picture may be as large as one in a file; ffmpeg decodes a few at a time.
constexpr const char* kMaxPixels = "268435456";
constexpr std::size_t kMemory = std::size_t{8} << 30U;
/// Processor time that the description of a video, or a frame, may take [s]. All cores share it.
constexpr std::size_t kSeconds = 120;

/// Starts a program that reads a video, with limits: it may be damaged, or made to do harm.
/// @param program    ffmpeg or ffprobe
/// @param before     options of the program and of the input
/// @param after      options after the input
/// @throws Error     InvalidInput if the program cannot be run
Process startReading(const std::string& path, const std::string& program, const std::vector<std::string>& before,
                     const std::vector<std::string>& after)
{
    std::vector<std::string> command{program};
    command.insert(command.end(), before.begin(), before.end());
    command.insert(command.end(), {"-format_whitelist", kContainers, "-protocol_whitelist", "file,pipe", "-max_pixels",
                                   kMaxPixels, "-i", "file:" + path});
    command.insert(command.end(), after.begin(), after.end());
    const Started started = start(command, Piped::Output);
    if (started.failure != 0) {
        throw Error(ErrorCode::InvalidInput, path + ": videos are read through the program " + program +
                                                 ", which cannot be run: " + std::strerror(started.failure));
    }
    limitMemory(*started.process.id, kMemory);
    limitTime(*started.process.id, kSeconds);
    return started.process;
}

/// Refuses a video that ffmpeg gave up for lack of time.
void refuseSlow(const std::string& path, const ProcessEnd& end)
{
    // The system ends ffprobe; ffmpeg ends by itself with 255, or with 123 after the fourth signal.
    if (end.was_out_of_time || end.code == 255 || end.code == 123) {
        throw Error(ErrorCode::InvalidInput,
                    fmt::format("{}: a frame takes more than {} s of processor time", path, kSeconds));
    }
}

[[noreturn]] void throwReadError(const std::string& path, const std::string& program, std::FILE* log)
{
    if (logText(log).find("not on whitelist") != std::string::npos) {
        throw Error(
            ErrorCode::InvalidInput,
            path +
                ": is a list of other files, or of a kind that is not read; MP4, MOV, Matroska, WebM, AVI, FLV, "
                "WMV, MPEG, Ogg, MXF, NUT, GIF and APNG are");
    }
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
    const Process process = startReading(path, "ffprobe",
                                         {"-v", "error", "-select_streams", "v:0", "-show_entries",
                                          "stream=avg_frame_rate,duration,nb_frames", "-of", "default=nw=1"},
                                         {});
    std::array<char, 512> text{};
    const std::size_t count = std::fread(text.data(), 1, text.size() - 1, process.output);
    std::fclose(process.output);
    const ProcessEnd end = waitFor(*process.id);
    std::FILE* const log = process.log;
    if (end.code != 0 || count == 0) {
        try {
            refuseSlow(path, end);
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
    std::vector<std::string> output{"-map", "0:v:0", "-fps_mode", "passthrough"};
    if (played_at) {
        // round=up: each output frame is the last input frame that is not after it.
        metadata_.frames.reset();  // the number of output frames differs
        output.insert(output.end(), {"-vf", fmt::format("fps={:.12g}:round=up", *played_at)});
    }
    output.insert(output.end(), {"-f", "image2pipe", "-c:v", "ppm", "-pix_fmt", "rgb24", "-"});
    const Process process = startReading(path, "ffmpeg", {"-nostdin", "-v", "error", "-xerror"}, output);
    process_ = process.id;
    frames_ = process.output;
    log_ = process.log;
}

Video::~Video()
{
    if (frames_ != nullptr) {
        std::fclose(frames_);
    }
    if (process_) {
        endNow(*process_);
    }
    std::fclose(log_);
}

void Video::finish()
{
    std::fclose(frames_);
    frames_ = nullptr;
    const ProcessEnd end = waitFor(*process_);
    process_.reset();
    refuseSlow(path_, end);
    // ffmpeg reads a Matroska file that ends too early without an error status.
    const bool is_cut = logText(log_).find("ended prematurely") != std::string::npos;
    const bool is_short = metadata_.frames && static_cast<double>(done_) + 1.0 < *metadata_.frames;
    if (done_ > 0 && (end.code != 0 || is_cut || is_short)) {
        const std::string line = firstLine(log_);
        throw Error(ErrorCode::InvalidInput,
                    path_ + ": is cut off or damaged after frame " + std::to_string(done_) +
                        (is_short ? " of " + std::to_string(std::lround(*metadata_.frames)) : "") +
                        (line.empty() ? "" : ": " + line));
    }
    if (end.code != 0) {
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
    limitTime(*process_, kSeconds);  // of the next frame
    return frame;
}

}  // namespace cli
