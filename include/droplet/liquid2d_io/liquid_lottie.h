// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

#include "droplet/liquid2d_io/liquid_drawing.h"

namespace droplet {

struct BezierPath;

/// Lottie animation of the drawings of writeLiquidSvg(), in one JSON file that players on web pages and phones show,
/// and animation programs import.
///
/// Liquid, droplets, foam, lines and walls are a layer each. A layer has as many paths as its fullest frame; each path
/// has a keyframe wherever it changes, and holds until the next: outlines change their number from frame to frame, so
/// that they cannot be interpolated. All keyframes of a path have the same number of vertices, as players need it.
class LiquidLottie {
public:
    /// @param view               window; the animation has its size in pixels
    /// @param look               colours and lines
    /// @param frames_per_second  > 0
    /// @throws Error             InvalidArgument: the view is empty or larger than 32767 pixels a side
    LiquidLottie(const LiquidView& view, LiquidLook look, double frames_per_second);

    /// Adds the next frame. Only its curves are kept.
    void add(const DrawnLiquid& scene);

    /// Writes the animation of all frames so far.
    /// Guarantees: the same frames give the same bytes; the stream is left failed if it did not take everything.
    void write(std::ostream& out) const;

private:
    /// Place in hundredths of a pixel, the precision of the file.
    struct Place {
        std::int64_t x = 0;
        std::int64_t y = 0;

        friend bool operator==(const Place&, const Place&) = default;
    };
    /// Corner of a closed path, with control points relative to it.
    struct Vertex {
        Place arriving;
        Place leaving;
        Place at;

        friend bool operator==(const Vertex&, const Vertex&) = default;
    };
    using Path = std::vector<Vertex>;
    /// Paths of every frame.
    using Layer = std::vector<std::vector<Path>>;

    static Path pathOf(const BezierPath& path);
    static Path pathOf(const std::vector<Vec2>& polygon);
    static void add(Layer& layer, const std::vector<BezierPath>& paths);
    static std::string shapesOf(const Layer& layer, const char* name, Colour fill, int rule);

    LiquidView view_;
    LiquidLook look_;
    double frames_per_second_;
    std::size_t frames_ = 0;
    Layer liquid_, droplets_, foam_, lines_;
    std::vector<Layer> walls_;  ///< each wall by itself
};

}  // namespace droplet
