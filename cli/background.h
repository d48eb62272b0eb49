// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>

#include "droplet/picture/picture.h"
#include "droplet/view/view.h"
#include "video.h"

namespace cli {

struct BackgroundOptions {
    std::optional<std::string> path;  ///< empty: the evening road, unless the surroundings are all
    bool surroundings = false;        ///< without a path, there is nothing but these
    std::optional<int> width;         ///< of the frame, if it is asked for [px]
    std::optional<int> height;
    bool fit = false;                 ///< scale and crop to it
    double frames_per_second = 30.0;  ///< at which a video is shown, at its own speed
    double field_of_view = 0.0;       ///< of the made-up road [rad]
};

/// What is behind the glass, frame by frame: a picture stays, a video goes on at its own speed and begins again when it
/// has ended, and the evening road goes by.
class Background {
public:
    /// Reads the picture, or the video's first frame.
    /// @throws droplet::Error InvalidInput: unreadable, or of another size than the frame that is asked for
    explicit Background(const BackgroundOptions& options);

    /// Of the frame [px].
    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }

    /// What is seen next.
    /// @param travelled       how far the car has come [m]
    /// @param passed          how far it comes while the shutter is open [m]; a video has its own shutter's blur
    /// @return                nothing where it is what was seen before
    /// @throws droplet::Error InvalidInput
    std::optional<droplet::Picture> next(double travelled, double passed);

    /// Passes over frames, as next() would.
    void skip(std::size_t frames);

private:
    droplet::Picture videoFrame();
    void requireSize(int width, int height) const;
    [[nodiscard]] droplet::Picture fitted(droplet::Picture picture) const;

    BackgroundOptions options_;
    int width_ = 0;
    int height_ = 0;
    std::optional<droplet::DefaultBackground> road_;
    std::optional<droplet::Picture> picture_;  ///< that stays, until it has been seen
    std::unique_ptr<Video> video_;
    std::optional<droplet::Picture> ahead_;  ///< of the video, read to know its size
    int video_width_ = 0;
    int video_height_ = 0;
};

}  // namespace cli
