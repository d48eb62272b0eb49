// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <iosfwd>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "droplet/mask/drips.h"
#include "droplet/mask/mask.h"
#include "droplet/mask/reveal.h"
#include "picture_stream.h"
#include "video.h"

namespace cli {

/// Mask of a frame, with its name.
struct FramePicture {
    std::string name;
    std::size_t number = 0;  ///< number in its file's name; otherwise counted from 1
    droplet::Mask mask;
    bool disagrees = false;  ///< whether the frame by itself would be read differently
};

/// Liquid that flows into droplets under a ceiling: the footprint stays.
struct Feed {
    double inflow = 0.0;  ///< [m³/s]
    double slow = 1.0;    ///< seconds of the film for a second
};

/// What becomes of the footprint of one picture: liquid flows into it, or drips from it.
using FootprintMotion = std::variant<droplet::RevealSource, droplet::DripOptions, Feed>;

/// Frames of a sequence, all read in the same way: with Channel::Auto, the first frame with a clear footprint decides
/// which levels of which channel are dry and liquid in all frames.
class Frames {
public:
    /// @param inputs          several pictures; or one path: a numbered pattern, a folder, a picture, a video, or -
    ///                        for pictures on standard input
    /// @throws droplet::Error InvalidArgument, InvalidInput
    explicit Frames(const std::vector<std::string>& inputs);
    /// @param pictures  as PictureStream reads them; used until the last frame
    /// @param name      of the stream, for messages
    Frames(std::istream& pictures, std::string name);
    /// Frames of one picture whose footprint moves.
    /// @param picture  path
    /// @param count    of frames, at least 1
    Frames(const std::string& picture, const FootprintMotion& motion, std::size_t count);

    /// Reads the next frame; returns nothing after the last one.
    /// @throws droplet::Error InvalidInput, naming the frame: unreadable, or not of the first frame's size
    std::optional<FramePicture> next(const droplet::MaskOptions& options);

    /// Number of frames, if it is known beforehand; not of a video or standard input.
    [[nodiscard]] std::optional<std::size_t> count() const;
    /// Frame that decided, and its decision before MaskOptions::invert.
    struct Decision {
        std::string name;
        droplet::MaskLevels levels;
        droplet::Segmentation segment = droplet::Segmentation::Threshold;
    };
    /// Decision for all frames; empty before next(), or if the channel is given.
    [[nodiscard]] const std::optional<Decision>& decision() const { return decision_; }
    /// Numbers of the frames, if they are known beforehand.
    [[nodiscard]] std::vector<std::size_t> numbers() const;
    /// Frame rate of a video.
    /// @throws droplet::Error InvalidInput
    [[nodiscard]] std::optional<double> framesPerSecond();
    /// Paths of all files that are read.
    [[nodiscard]] std::vector<std::string> files() const;

private:
    /// Video, which starts at the first call, after the files have been checked.
    /// @throws droplet::Error InvalidInput
    Video& video();
    /// @throws droplet::Error InvalidInput
    void decide(const droplet::MaskOptions& options);
    /// File of the next picture of the stream.
    std::optional<std::vector<std::byte>> nextOfStream();
    [[nodiscard]] std::optional<FramePicture> read(const droplet::MaskOptions& options);

    std::optional<Decision> decision_;
    std::optional<FramePicture> first_picture_;  ///< first frame, if it decided
    /// Frame of a footprint that moves.
    [[nodiscard]] FramePicture moved(const droplet::MaskOptions& options);

    std::vector<std::pair<std::size_t, std::string>> pictures_;
    std::optional<FootprintMotion> motion_;           ///< of the one picture, which all frames name
    std::function<droplet::Mask(double)> footprint_;  ///< at a time from 0 to 1; from the first frame on
    std::string video_path_;                          ///< empty without a video
    std::unique_ptr<Video> video_;
    std::unique_ptr<PictureStream> stream_;
    std::string stream_name_;
    std::deque<std::vector<std::byte>> kept_;  ///< pictures of the stream that were read for the decision
    bool keeps_ = false;                       ///< whether pictures that are read now are kept
    std::size_t done_ = 0;
    int width_ = 0;
    int height_ = 0;
    std::string first_;  ///< name of the first frame
};

}  // namespace cli
