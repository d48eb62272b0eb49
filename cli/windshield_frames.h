// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tbb/task_group.h>

#include <cstddef>
#include <iosfwd>
#include <memory>
#include <string>

#include "background.h"
#include "droplet/picture/picture.h"
#include "droplet/view/view.h"
#include "video_writer.h"
#include "windshield_options.h"

namespace cli {

/// Where the car is in a frame.
struct CarPlace {
    double travelled = 0.0;  ///< since the first frame [m]
    double speed = 0.0;      ///< [m/s]
};

/// Draws a windshield's frames and maps, and writes them.
class WindshieldFrames {
public:
    /// @param options         must outlive this
    /// @throws droplet::Error InvalidArgument, InvalidInput, OutputFailed
    WindshieldFrames(const WindshieldOptions& options, const droplet::WindshieldParameters& parameters);

    /// How the driver looks, with the frame's size.
    [[nodiscard]] const droplet::ViewOptions& view() const { return view_options_; }

    /// Opens the video, if there is one to write.
    /// @throws droplet::Error InvalidArgument, OutputFailed
    void begin();

    /// Passes over frames.
    void skip(std::size_t frames) { background_.skip(frames); }

    /// Draws a frame, and writes what has a file of its own.
    /// @param number     from 1
    /// @param car        where it is
    void draw(const droplet::WindshieldState& state, std::size_t number, bool is_last, const CarPlace& car);

    /// Returns when every frame drawn so far is written.
    void wait() { saving_.wait(); }

    /// Writes the video, or the picture of the last frame.
    void write(std::ostream& out);

private:
    void writePicture(std::ostream& out, const droplet::Layer& layer, const droplet::Picture& picture,
                      droplet::PngEffort effort) const;
    void writeMaps(const droplet::WindshieldState& state, std::size_t number) const;

    const WindshieldOptions& options_;
    droplet::Glass glass_;
    std::string codec_;
    Background background_;
    droplet::ViewOptions view_options_;
    std::unique_ptr<droplet::DriversView> view_;
    std::unique_ptr<VideoWriter> video_;
    droplet::Picture picture_;
    droplet::Layer layer_;
    tbb::task_group saving_;  ///< a frame, while the next one is made
};

}  // namespace cli
