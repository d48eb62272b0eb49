// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

#include "background.h"
#include "droplet/drawing/picture.h"
#include "droplet/windshield_view/glass_maps.h"
#include "droplet/windshield_view/view.h"
#include "film.h"
#include "video_writer.h"
#include "windshield_options.h"

namespace cli {

/// Position and speed of the car in a frame.
struct CarState {
    double travelled = 0.0;  ///< distance since the first frame [m]
    double speed = 0.0;      ///< [m/s]
};

/// Draws and writes the frames and maps of a windshield.
class WindshieldFrames {
public:
    /// @param options         must outlive this, as film
    /// @throws droplet::Error InvalidArgument, InvalidInput, OutputFailed
    WindshieldFrames(const WindshieldOptions& options, const droplet::WindshieldParameters& parameters, Film& film);

    /// Driver's view, with the frame's size.
    [[nodiscard]] const droplet::ViewOptions& view() const { return view_options_; }

    /// Opens the video, if there is one to write.
    /// @throws droplet::Error InvalidArgument, OutputFailed
    void begin();

    /// Skips frames.
    void skip(std::size_t frames) { background_.skip(frames); }

    /// Draws a frame, and writes it if every frame has a file of its own.
    /// @param number     number of the frame, from 1
    void draw(const droplet::WindshieldState& state, std::size_t number, bool is_last, const CarState& car);

    /// Writes the video, or the picture of the last frame.
    void write(std::ostream& out);

private:
    void writePicture(std::ostream& out, const droplet::Layer& layer, const droplet::Picture& picture,
                      droplet::PngEffort effort) const;
    /// Draws maps.
    /// @return  their files
    [[nodiscard]] std::vector<OutputFile> mapsOf(const droplet::WindshieldState& state, std::size_t number);

    const WindshieldOptions& options_;
    Film& film_;
    droplet::Glass glass_;
    Background background_;
    droplet::ViewOptions view_options_;
    std::unique_ptr<droplet::DriversView> view_;
    std::unique_ptr<droplet::GlassMapFrames> maps_;
    std::unique_ptr<VideoWriter> video_;
    droplet::Picture picture_;
    droplet::Layer layer_;
};

}  // namespace cli
