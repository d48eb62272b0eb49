// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <iosfwd>
#include <string>
#include <variant>
#include <vector>

#include "droplet/picture/picture.h"
#include "droplet/vector.h"

namespace droplet {

using Colour = std::array<std::uint8_t, 3>;  ///< sRGB

/// A filled polygon whose sides do not cross.
struct Area {
    std::vector<Vec2> points;
    Colour colour{};
    double opacity = 1.0;
};

/// A line through points, round at its ends and bends.
struct Line {
    std::vector<Vec2> points;
    Colour colour{};
    double width = 1.0;
    double dash = 0.0;  ///< length of dashes and of the gaps between them; 0: none
};

enum class Anchor { Start, Middle, End };

/// A line of text. What it may hold is what lettering knows: printable ASCII and ° µ ² · − – Δ.
struct Text {
    std::string text;
    Vec2 at;            ///< on the line that letters stand on
    double size = 9.0;  ///< height of capitals
    Colour colour{};
    Anchor anchor = Anchor::Start;
    bool bold = false;
    bool halo = false;  ///< white around the letters, over what lies below
};

/// Marks on white, in their order, y down.
struct Drawing {
    double width = 0.0;
    double height = 0.0;
    std::vector<std::variant<Area, Line, Text>> marks;
};

/// Drawings side by side, their top edges in line.
Drawing beside(const std::vector<Drawing>& drawings);

/// Writes a drawing as SVG: letters are text, in the reader's sans-serif font.
///
/// Guarantees: the same drawing gives the same bytes; the stream is left failed if it did not take everything.
void writeSvg(const Drawing& drawing, std::ostream& out);

/// Paints a drawing with Cairo, and with letters of our own, which need no fonts.
/// @param scale   pixels per unit, > 0
/// @throws Error  InvalidArgument: no picture, one of over kMaxPicturePixels, or of a side over 32767
Picture pictureOf(const Drawing& drawing, double scale);

}  // namespace droplet
