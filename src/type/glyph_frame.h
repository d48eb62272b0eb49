// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include "droplet/error.h"
#include "droplet/type/glyph.h"
#include "type/contour_union.h"
#include "type/flatten.h"
#include "type/font_face.h"

namespace droplet {

/// Largest distance between points of an outline [em]: meshing reads the detail of a loop from the spacing of its
/// points.
inline constexpr double kSpacing = 1.0 / 256.0;

/// Accuracy of glyphs' curves [em].
/// @param smallest  em of the smallest glyphs
inline Flatness flatnessOf(const GlyphOptions& options, double smallest = 1.0)
{
    // Default tolerance of curves [em]. With a fiftieth of it, droplets of 5000 triangles change by at most 0.1 % in
    // volume, and their normals by 0.1° rms.
    constexpr double kTolerance = 1.0 / 20'000.0;
    constexpr double kFinest = 0x1p-26;  // points are rounded to this
    return {options.tolerance ? std::max(*options.tolerance / options.em, kFinest) : smallest * kTolerance,
            smallest * kSpacing};
}

inline void requireGlyph(const Font& font, GlyphId glyph)
{
    if (glyph >= font.glyphCount()) {
        throw Error(ErrorCode::InvalidArgument, "glyph " + std::to_string(glyph) + " must be less than " +
                                                    std::to_string(font.glyphCount()) +
                                                    ", the font's number of glyphs");
    }
}

/// Rectangle in ems.
struct Box {
    Vec2 low;
    Vec2 high;
};

/// Box of a single glyph.
inline Box boxOf(const DrawnGlyph& drawn, const LineMetrics& lines)
{
    return {{std::min(0.0, drawn.advance), lines.descender}, {std::max(0.0, drawn.advance), lines.ascender}};
}

/// Box around its own middle, which grows equally on opposite sides to contain contours.
class GlyphFrame {
public:
    explicit GlyphFrame(const Box& box) : middle_(0.5 * (box.low + box.high)), half_(0.5 * (box.high - box.low)) {}

    /// Moves a contour into the frame.
    Contour place(Contour contour)
    {
        for (Vec2& p : contour) {
            p = p - middle_;
            half_ = {std::max(half_.x, std::abs(p.x)), std::max(half_.y, std::abs(p.y))};
        }
        return contour;
    }

    [[nodiscard]] Vec2 extent() const { return 2.0 * half_; }

private:
    Vec2 middle_;
    Vec2 half_;
};

}  // namespace droplet
