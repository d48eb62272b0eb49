// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "droplet/footprint/mask.h"
#include "video.h"

namespace cli {

/// A frame's footprint, and how to call it.
struct FramePicture {
    std::string name;
    std::size_t number = 0;  ///< of its file, or from 1
    droplet::Mask mask;
    bool disagrees = false;  ///< by itself it would have been read otherwise than the frame that decides
};

/// The frames of a sequence, read one after another, all alike: with Channel::Auto, the first frame in which something
/// stands out decides for all which levels of which channel are dry and liquid.
class Frames {
public:
    /// @param inputs          several pictures; or one: a path with a number's place, a folder, a picture or a video
    /// @throws droplet::Error InvalidArgument, InvalidInput
    explicit Frames(const std::vector<std::string>& inputs);

    /// The next frame; nothing after the last one.
    /// @throws droplet::Error InvalidInput, naming the frame: unreadable, or of another size than the first
    std::optional<FramePicture> next(const droplet::MaskOptions& options);

    /// How many there are, where that is known beforehand.
    [[nodiscard]] std::optional<std::size_t> count() const;
    /// The frame that decided, and how, before MaskOptions::invert; empty before next(), or where the channel is given.
    struct Decision {
        std::string name;
        droplet::MaskLevels levels;
        droplet::Segmentation segment = droplet::Segmentation::Threshold;
    };
    [[nodiscard]] const std::optional<Decision>& decision() const { return decision_; }
    /// Numbers of the frames known beforehand.
    [[nodiscard]] std::vector<std::size_t> numbers() const;
    /// Of a video.
    [[nodiscard]] std::optional<double> framesPerSecond() const;
    /// Every file that is read.
    [[nodiscard]] std::vector<std::string> files() const;

private:
    /// @throws droplet::Error InvalidInput
    void decide(const droplet::MaskOptions& options);
    [[nodiscard]] std::optional<FramePicture> read(const droplet::MaskOptions& options);

    std::optional<Decision> decision_;
    std::optional<FramePicture> first_picture_;  ///< if that decided
    std::vector<std::pair<std::size_t, std::string>> pictures_;
    std::string video_path_;
    std::unique_ptr<Video> video_;
    std::size_t done_ = 0;
    int width_ = 0;
    int height_ = 0;
    std::string first_;  ///< name
};

}  // namespace cli
