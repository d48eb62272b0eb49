// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cairo.h>

#include <memory>
#include <vector>

#include "droplet/drawing/drawing.h"
#include "droplet/drawing/picture.h"

namespace droplet {

/// Maximum width and height of Cairo's images [px].
inline constexpr int kLongestCanvas = 32767;

/// Cairo canvas on a part of a picture, in the picture's pixels, y down. The destructor copies the drawing into the
/// picture.
class Canvas {
public:
    /// @param low   corner of the part, which is clipped to the picture
    /// @param high  opposite corner
    Canvas(Picture& picture, Vec2 low, Vec2 high);
    ~Canvas();
    Canvas(const Canvas&) = delete;
    Canvas& operator=(const Canvas&) = delete;

    [[nodiscard]] cairo_t* cairo() const { return cairo_.get(); }

    /// Begins a new path through points.
    void trace(const std::vector<Vec2>& points) const;
    /// Fills the path and clears it.
    void fill(const Colour& colour, double opacity) const;
    /// Draws the path with round ends and bends and clears it. A line thinner than a pixel is drawn paler.
    /// @param width  in the units of the path
    void stroke(const Colour& colour, double width) const;

private:
    Picture* picture_;
    int left_;
    int top_;
    std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)> surface_;
    std::unique_ptr<cairo_t, void (*)(cairo_t*)> cairo_;
};

}  // namespace droplet
