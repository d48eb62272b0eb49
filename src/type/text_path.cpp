// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/type/text_path.h"

#include <cmath>

#include "droplet/error.h"
#include "droplet/units.h"
#include "image/drawn_svg.h"
#include "image/image_file.h"
#include "image/image_header.h"
#include "number_text.h"
#include "require.h"
#include "type/flatten.h"

namespace droplet {
namespace {

constexpr double kPixel = 25.4 * kMillimetre / 96.0;  // of CSS

/// Polyline along a line of a drawing.
std::vector<Vec2> flattened(const std::vector<Vec2>& line, double scale)
{
    // A circle of 2000 chords turns by 0.2° at each, and letters stand on arcs through their ends.
    constexpr double kPieces = 2000.0;
    constexpr double kTolerance = 1e-6;
    const auto at = [&](std::size_t i) { return Vec2{scale * line[i].x, -scale * line[i].y}; };
    double whole = 0.0;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        whole += length(at(i + 1) - at(i));
    }
    if (!(whole > 0.0 && std::isfinite(whole))) {
        throw Error(ErrorCode::InvalidInput, "the drawing's path is " + numberText(whole) + " m long, must be finite");
    }
    const Flatness flatness{kTolerance * whole, whole / kPieces};
    std::vector<Vec2> points{at(0)};
    for (std::size_t i = 1; i + 2 < line.size(); i += 3) {
        if (line[i] == line[i - 1] && line[i + 1] == line[i + 2]) {
            points.push_back(at(i + 2));
        } else {
            addCubic(points, at(i), at(i + 1), at(i + 2), flatness);
        }
    }
    return points;
}

}  // namespace

TextPath decodeTextPath(std::span<const std::byte> encoded, std::optional<double> page_width)
{
    if (page_width) {
        require(*page_width > 0.0 && std::isfinite(*page_width), "page_width", *page_width, "> 0 m");
    }
    if (imageFormat(encoded) != ImageFormat::Svg) {
        throw Error(ErrorCode::InvalidInput, "is not an SVG drawing");
    }
    const SvgLine line = lineOfSvg(svgText(encoded), {});
    if (line.points.empty()) {
        throw Error(ErrorCode::InvalidInput, "the drawing has no path that text could follow");
    }
    const double scale = page_width && line.page_width > 0.0 ? *page_width / line.page_width : kPixel;
    return {flattened(line.points, scale), line.others};
}

TextPath readTextPath(const std::filesystem::path& path, std::optional<double> page_width)
{
    return fromImageFile(path, [&](std::span<const std::byte> encoded) { return decodeTextPath(encoded, page_width); });
}

}  // namespace droplet
