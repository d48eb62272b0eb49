// SPDX-License-Identifier: GPL-3.0-or-later
#include "frames.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string_view>
#include <system_error>
#include <tuple>
#include <utility>

#include "droplet/error.h"
#include "files.h"
#include "numbered_path.h"

namespace cli {
namespace {

namespace fs = std::filesystem;
using droplet::Error;
using droplet::ErrorCode;

/// Order of names in which runs of digits count as numbers, so that frame 10 follows frame 9.
bool before(const std::string& a, const std::string& b)
{
    const auto digit = [](char c) { return c >= '0' && c <= '9'; };
    std::size_t i = 0;
    std::size_t j = 0;
    while (i < a.size() && j < b.size()) {
        if (digit(a[i]) && digit(b[j])) {
            const auto run = [&](const std::string& text, std::size_t& at) {
                const std::size_t begin = at;
                while (at < text.size() && digit(text[at])) {
                    ++at;
                }
                const std::string number = text.substr(begin, at - begin);
                const auto zeros = number.find_first_not_of('0');
                return zeros == std::string::npos ? std::string("0") : number.substr(zeros);
            };
            const std::string x = run(a, i);
            const std::string y = run(b, j);
            if (x != y) {
                return x.size() != y.size() ? x.size() < y.size() : x < y;
            }
        } else if (a[i] != b[j]) {
            return a[i] < b[j];
        } else {
            ++i;
            ++j;
        }
    }
    return a.size() - i != b.size() - j ? a.size() - i < b.size() - j : a < b;
}

std::vector<std::string> picturesIn(const std::string& folder)
{
    std::vector<std::string> names;
    std::error_code failure;
    for (fs::directory_iterator entry(folder, failure), end; !failure && entry != end; entry.increment(failure)) {
        if (isPicture(entry->path().string())) {
            names.push_back(entry->path().filename().string());
        }
    }
    if (failure) {
        throw Error(ErrorCode::InvalidInput, folder + ": " + failure.message());
    }
    if (names.empty()) {
        throw Error(ErrorCode::InvalidInput, folder + ": this folder has no pictures");
    }
    std::sort(names.begin(), names.end(), before);
    for (std::string& name : names) {
        name = (fs::path(folder) / name).generic_string();
    }
    return names;
}

std::string sizeOf(int width, int height)
{
    return std::to_string(width) + " x " + std::to_string(height) + " pixels";
}

/// Whether levels would give another mask than the decided ones: another channel, inverted, or a threshold outside the
/// middle half of the decided range.
bool disagree(const droplet::MaskLevels& levels, const droplet::MaskLevels& decided)
{
    constexpr double kMax = 0.25;
    const double step = decided.liquid - decided.dry;
    const double half = (0.5 * (levels.dry + levels.liquid) - decided.dry) / step;
    return levels.channel != decided.channel || (levels.liquid - levels.dry) * step < 0.0 ||
           std::abs(half - 0.5) > kMax;
}

droplet::MaskLevels levelsOf(const droplet::Mask& mask, bool invert)
{
    return invert ? droplet::MaskLevels{mask.channel, mask.level_liquid, mask.level_dry}
                  : droplet::MaskLevels{mask.channel, mask.level_dry, mask.level_liquid};
}

}  // namespace

Frames::Frames(const std::vector<std::string>& inputs)
{
    std::vector<std::string> names = inputs;
    if (inputs.size() == 1) {
        const std::string& input = inputs.front();
        std::error_code ignored;
        if (isStream(input)) {
            stream_ = std::make_unique<PictureStream>(std::cin);
            stream_name_ = "standard input";
            return;
        }
        if (const auto pattern = NumberedPath::of(input, "INPUT")) {
            pictures_ = pattern->existing();
            return;
        }
        if (fs::is_directory(input, ignored)) {
            names = picturesIn(input);
        } else if (!isPicture(input) || lowerExtension(input) == ".gif") {  // an animation, perhaps
            if (!fs::exists(input, ignored)) {
                throw Error(ErrorCode::InvalidInput, input + ": there is no such file");
            }
            video_path_ = input;
            return;
        }
    }
    for (std::size_t k = 0; k < names.size(); ++k) {
        pictures_.emplace_back(k + 1, names[k]);
    }
}

Frames::Frames(std::istream& pictures, std::string name)
    : stream_(std::make_unique<PictureStream>(pictures)), stream_name_(std::move(name))
{
}

Frames::Frames(const std::string& picture, const FootprintMotion& motion, std::size_t count) : motion_(motion)
{
    for (std::size_t k = 1; k <= count; ++k) {
        pictures_.emplace_back(k, picture);
    }
}

FramePicture Frames::moved(const droplet::MaskOptions& options)
{
    FramePicture frame;
    std::tie(frame.number, frame.name) = pictures_[done_];
    if (!footprint_) {
        droplet::MaskOptions wet = options;
        wet.allow_dry = false;
        droplet::Mask mask = droplet::readMask(frame.name, wet);
        const auto moving = []<class Motion>(Motion motion) {
            return
                [shared = std::make_shared<const Motion>(std::move(motion))](double time) { return shared->at(time); };
        };
        try {
            if (const auto* options_of_drips = std::get_if<droplet::DripOptions>(&*motion_)) {
                footprint_ = moving(droplet::Drips(std::move(mask), *options_of_drips));
            } else if (std::holds_alternative<Feed>(*motion_)) {
                footprint_ = [shared = std::make_shared<const droplet::Mask>(std::move(mask))](double /*time*/) {
                    return *shared;
                };
            } else {
                footprint_ = moving(droplet::Reveal(std::move(mask), std::get<droplet::RevealSource>(*motion_)));
            }
        } catch (const Error& error) {
            throw Error(error.code(), frame.name + ": " + error.what());
        }
    }
    // Liquid that drips is there before the first frame, liquid that flows in is not: neither time has a frame.
    frame.mask = footprint_(static_cast<double>(frame.number) / static_cast<double>(pictures_.size()));
    frame.name += ", frame " + std::to_string(frame.number);
    return frame;
}

Video& Frames::video()
{
    if (!video_) {
        video_ = std::make_unique<Video>(video_path_);
    }
    return *video_;
}

void Frames::decide(const droplet::MaskOptions& options)
{
    // A stream cannot be read again, so the pictures before the decision are kept.
    keeps_ = stream_ != nullptr;
    while (auto frame = read(options)) {
        const bool decides = frame->mask.found || frame->mask.segment != droplet::Segmentation::Threshold;
        if (done_ == 1 || decides) {
            decision_ = Decision{frame->name, levelsOf(frame->mask, options.invert), frame->mask.segment};
        }
        if (decides) {
            if (done_ == 1) {
                first_picture_ = std::move(frame);
                kept_.clear();
                keeps_ = false;
                return;
            }
            break;
        }
    }
    done_ = 0;
    keeps_ = false;
    video_.reset();
}

std::optional<FramePicture> Frames::next(const droplet::MaskOptions& options)
{
    const bool by_levels =
        options.segment == droplet::Segmentation::Auto || options.segment == droplet::Segmentation::Threshold;
    if (options.channel != droplet::Channel::Auto || !by_levels || options.colour || motion_) {
        return read(options);
    }
    if (!decision_) {
        decide(options);
    }
    if (first_picture_) {
        return std::exchange(first_picture_, std::nullopt);
    }
    droplet::MaskOptions alike = options;
    if (decision_->segment == droplet::Segmentation::Threshold) {
        alike.levels = decision_->levels;
    } else {
        alike.segment = decision_->segment;
    }
    std::optional<FramePicture> frame = read(alike);
    if (frame) {
        frame->disagrees = frame->mask.found && disagree(*frame->mask.found, decision_->levels);
    }
    return frame;
}

std::optional<std::vector<std::byte>> Frames::nextOfStream()
{
    if (!keeps_ && !kept_.empty()) {
        std::vector<std::byte> picture = std::move(kept_.front());
        kept_.pop_front();
        return picture;
    }
    auto picture = stream_->next();
    if (picture && keeps_) {
        kept_.push_back(*picture);
    }
    return picture;
}

std::optional<FramePicture> Frames::read(const droplet::MaskOptions& options)
{
    FramePicture frame;
    if (stream_) {
        frame.number = done_ + 1;
        frame.name = stream_name_ + ", frame " + std::to_string(frame.number);
        try {
            const auto bytes = nextOfStream();
            if (!bytes && done_ == 0) {
                throw Error(ErrorCode::InvalidInput, "there is no picture");
            }
            if (!bytes) {
                return std::nullopt;
            }
            frame.mask = droplet::decodeMask(*bytes, options);
        } catch (const Error& error) {
            throw Error(error.code(), frame.name + ": " + error.what());
        }
    } else if (!video_path_.empty()) {
        const auto bytes = video().next();
        if (!bytes) {
            if (done_ == 0) {
                throw Error(ErrorCode::InvalidInput, video_path_ + ": this video has no frames");
            }
            return std::nullopt;
        }
        frame.number = done_ + 1;
        frame.name = video_path_ + ", frame " + std::to_string(frame.number);
        try {
            frame.mask = droplet::decodeMask(*bytes, options);
        } catch (const Error& error) {
            throw Error(error.code(), frame.name + ": " + error.what());
        }
    } else {
        if (done_ == pictures_.size()) {
            return std::nullopt;
        }
        if (motion_) {
            frame = moved(options);
        } else {
            std::tie(frame.number, frame.name) = pictures_[done_];
            frame.mask = droplet::readMask(frame.name, options);
        }
    }
    if (done_ == 0) {
        width_ = frame.mask.width;
        height_ = frame.mask.height;
        first_ = frame.name;
    } else if (frame.mask.width != width_ || frame.mask.height != height_) {
        throw Error(ErrorCode::InvalidInput, frame.name + ": has " + sizeOf(frame.mask.width, frame.mask.height) +
                                                 ", " + first_ + " has " + sizeOf(width_, height_) +
                                                 "; all frames must have one size");
    }
    ++done_;
    return frame;
}

std::optional<std::size_t> Frames::count() const
{
    return !video_path_.empty() || stream_ ? std::nullopt : std::optional(pictures_.size());
}

std::vector<std::size_t> Frames::numbers() const
{
    std::vector<std::size_t> numbers;
    for (const auto& [number, name] : pictures_) {
        numbers.push_back(number);
    }
    return numbers;
}

std::optional<double> Frames::framesPerSecond()
{
    return video_path_.empty() ? std::nullopt : video().framesPerSecond();
}

std::vector<std::string> Frames::files() const
{
    std::vector<std::string> files;
    for (const auto& [number, name] : pictures_) {
        if (files.empty() || !motion_) {
            files.push_back(name);
        }
    }
    if (!video_path_.empty()) {
        files.push_back(video_path_);
    }
    if (stream_) {
        files.emplace_back(kStandardStream);
    }
    return files;
}

}  // namespace cli
