// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>

#include "droplet/drawing/picture.h"
#include "droplet/windshield_view/view.h"
#include "video.h"

namespace cli {

struct BackgroundOptions {
    std::optional<std::string> path;  ///< picture or video; if empty, the evening road unless `surroundings` is set
    bool surroundings = false;        ///< without a path, the panorama is the whole background
    std::optional<int> width;         ///< frame width, if given [px]
    std::optional<int> height;        ///< frame height, if given [px]
    bool fit = false;                 ///< scale and crop the background to the frame
    double frames_per_second = 30.0;  ///< frame rate of the result; a video keeps its own speed
    double field_of_view = 0.0;       ///< horizontal field of view of the evening road [rad]
};

/// Background behind the glass, frame by frame: a still picture, a video that plays at its own speed and repeats, or
/// the evening road, which moves with the car.
class Background {
public:
    /// Reads the picture, or the video's first frame.
    /// @throws droplet::Error InvalidInput: unreadable, or not of the frame's size
    explicit Background(const BackgroundOptions& options);

    [[nodiscard]] int width() const { return width_; }    ///< frame width [px]
    [[nodiscard]] int height() const { return height_; }  ///< frame height [px]

    /// Returns the next frame's background.
    /// @param travelled       distance of the car since the first frame [m]
    /// @param blur_distance   distance of the car while the shutter is open [m]; a video has its own motion blur
    /// @return                nothing if the background has not changed
    /// @throws droplet::Error InvalidInput
    std::optional<droplet::Picture> next(double travelled, double blur_distance);

    /// Skips frames, as if next() had been called.
    void skip(std::size_t frames);

private:
    droplet::Picture videoFrame();
    void requireSize(int width, int height) const;
    [[nodiscard]] droplet::Picture fitted(droplet::Picture picture) const;

    BackgroundOptions options_;
    int width_ = 0;
    int height_ = 0;
    std::optional<droplet::DefaultBackground> road_;
    std::optional<droplet::Picture> picture_;  ///< still picture, until next() has returned it
    std::unique_ptr<Video> video_;
    std::optional<droplet::Picture>
        first_frame_;  ///< first frame of the video, read for its size, until it is returned
    int video_width_ = 0;
    int video_height_ = 0;
};

}  // namespace cli
