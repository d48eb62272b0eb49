// SPDX-License-Identifier: GPL-3.0-or-later
#include "background.h"

#include <filesystem>
#include <utility>

#include "droplet/error.h"
#include "files.h"

namespace cli {
namespace {

using droplet::Error;
using droplet::ErrorCode;
using droplet::Picture;

std::string sizeOf(int width, int height)
{
    return std::to_string(width) + "x" + std::to_string(height);
}

}  // namespace

Background::Background(const BackgroundOptions& options) : options_(options)
{
    constexpr int kWidth = 1280;
    constexpr int kHeight = 720;
    width_ = options_.width.value_or(kWidth);
    height_ = options_.height.value_or(kHeight);
    if (!options_.path && options_.surroundings) {
        return;
    }
    if (!options_.path) {
        droplet::ViewOptions view;
        view.width = width_;
        view.height = height_;
        view.field_of_view = options_.field_of_view;
        road_.emplace(view);
        return;
    }
    const std::string& path = *options_.path;
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored)) {
        throw Error(ErrorCode::InvalidInput, path + ": there is no such file");
    }
    Picture first;
    if (isPicture(path)) {
        first = droplet::readPicture(path);
    } else {
        video_ = std::make_unique<Video>(path, options_.frames_per_second);
        first = videoFrame();
    }
    constexpr int kMin = 16;
    constexpr int kMax = 8192;
    if (!options_.width) {
        width_ = first.width;
        height_ = first.height;
        if (width_ < kMin || height_ < kMin || width_ > kMax || height_ > kMax) {
            throw Error(ErrorCode::InvalidInput,
                        path + ": has " + sizeOf(width_, height_) +
                            " pixels; a frame must have 16 to 8192 in each direction; give --frame-size and --fit");
        }
    }
    if (!options_.fit) {
        requireSize(first.width, first.height);
    }
    if (video_) {
        first_frame_ = std::move(first);
    } else {
        picture_ = fitted(std::move(first));
    }
}

void Background::requireSize(int width, int height) const
{
    if (width != width_ || height != height_) {
        throw Error(ErrorCode::InvalidInput, *options_.path + ": has " + sizeOf(width, height) +
                                                 " pixels, but the frame has " + sizeOf(width_, height_) +
                                                 "; both must be the same, or give --fit to scale and crop it");
    }
}

Picture Background::fitted(Picture picture) const
{
    return options_.fit ? droplet::scaledToCover(picture, width_, height_) : std::move(picture);
}

Picture Background::videoFrame()
{
    auto bytes = video_->next();
    if (!bytes) {
        const bool is_empty = video_width_ == 0;
        if (!is_empty) {
            video_ = std::make_unique<Video>(*options_.path, options_.frames_per_second);
            bytes = video_->next();
        }
        if (!bytes) {
            throw Error(ErrorCode::InvalidInput, *options_.path + ": this video has no frames");
        }
    }
    Picture picture = droplet::decodePicture(*bytes);
    if (video_width_ == 0) {
        video_width_ = picture.width;
        video_height_ = picture.height;
    } else if (picture.width != video_width_ || picture.height != video_height_) {
        throw Error(ErrorCode::InvalidInput, *options_.path + ": has frames of " + sizeOf(video_width_, video_height_) +
                                                 " and of " + sizeOf(picture.width, picture.height) +
                                                 " pixels; all must have one size");
    }
    return picture;
}

std::optional<Picture> Background::next(double travelled, double blur_distance)
{
    if (video_) {
        return fitted(first_frame_ ? *std::exchange(first_frame_, std::nullopt) : videoFrame());
    }
    if (options_.path) {
        return std::exchange(picture_, std::nullopt);
    }
    return road_ ? std::optional(road_->at(travelled, blur_distance)) : std::nullopt;
}

void Background::skip(std::size_t frames)
{
    for (std::size_t k = 0; video_ && k < frames; ++k) {
        if (first_frame_) {
            first_frame_.reset();
        } else {
            videoFrame();
        }
    }
}

}  // namespace cli
