// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cairo.h>

#include <memory>
#include <vector>

#include "droplet/picture/drawing.h"
#include "droplet/picture/picture.h"

namespace droplet {

/// Cairo's images have no longer side [px].
inline constexpr int kLongestCanvas = 32767;

/// Part of a picture for Cairo to draw on, in the picture's pixels, y down. What was drawn is in the picture when the
/// canvas goes.
class Canvas {
public:
    /// @param low   corner of the part; what lies beyond the picture is left out
    /// @param high  corner opposite
    Canvas(Picture& picture, Vec2 low, Vec2 high);
    ~Canvas();
    Canvas(const Canvas&) = delete;
    Canvas& operator=(const Canvas&) = delete;

    [[nodiscard]] cairo_t* cairo() const { return cairo_.get(); }

    /// Lets the path begin anew at the first point and run through the others.
    void trace(const std::vector<Vec2>& points) const;
    /// Fills the path and forgets it.
    void fill(const Colour& colour, double opacity) const;
    /// Draws the path, round at ends and bends, and forgets it. A line thinner than a pixel is a paler one.
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
