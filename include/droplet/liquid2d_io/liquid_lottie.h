// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <iosfwd>
#include <string>
#include <vector>

#include "droplet/liquid2d_io/liquid_drawing.h"

namespace droplet {

/// Lottie animation of the drawings of writeLiquidSvg(), in one JSON file that players on web pages and phones show,
/// and animation programs import.
///
/// Each frame is a layer that shows for this frame alone: outlines change their number from frame to frame, so that
/// they cannot be interpolated. Walls that do not move are one layer.
class LiquidLottie {
public:
    /// @param view               window; the animation has its size in pixels
    /// @param look               colours and lines
    /// @param frames_per_second  > 0
    /// @throws Error             InvalidArgument: the view is empty or larger than 32767 pixels a side
    LiquidLottie(const LiquidView& view, LiquidLook look, double frames_per_second);

    /// Adds the next frame. Only the text of its curves is kept.
    void add(const DrawnLiquid& scene);

    /// Writes the animation of all frames so far.
    /// Guarantees: the same frames give the same bytes; the stream is left failed if it did not take everything.
    void write(std::ostream& out) const;

private:
    /// Shapes that show from a frame to before another one.
    struct Span {
        std::string shapes;
        std::size_t begin = 0;
        std::size_t end = 0;
    };

    LiquidView view_;
    LiquidLook look_;
    double frames_per_second_;
    std::vector<std::string> frames_;  ///< shapes of liquid, droplets and foam
    std::vector<Span> walls_;          ///< without overlap
};

}  // namespace droplet
