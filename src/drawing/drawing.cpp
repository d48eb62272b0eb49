// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/drawing/drawing.h"

#include <algorithm>
#include <cmath>
#include <ostream>
#include <utility>

#include "drawing/canvas.h"
#include "drawing/lettering.h"
#include "droplet/error.h"
#include "number_text.h"
#include "xml_text.h"

namespace droplet {
namespace {

/// Height of capitals over font size in common sans-serif fonts.
constexpr double kCapitals = 0.72;

// --------------------------------------------------------------------------------------------------------- SVG

/// Formats a coordinate; a hundredth of a unit is finer than a screen shows.
std::string number(double value)
{
    return fmt::format("{}", std::round(100.0 * value) / 100.0 + 0.0);
}

std::string hex(const Colour& colour)
{
    return fmt::format("#{:02x}{:02x}{:02x}", colour[0], colour[1], colour[2]);
}

std::string places(const std::vector<Vec2>& points)
{
    std::string text;
    for (const Vec2& p : points) {
        text += (text.empty() ? "" : " ") + number(p.x) + "," + number(p.y);
    }
    return text;
}

std::string svgOf(const Area& area)
{
    return "<polygon points=\"" + places(area.points) + "\" fill=\"" + hex(area.colour) + "\"" +
           (area.opacity < 1.0 ? " fill-opacity=\"" + number(area.opacity) + "\"" : "") + "/>\n";
}

std::string svgOf(const Line& line)
{
    return "<path d=\"M" + places(line.points) + "\" fill=\"none\" stroke=\"" + hex(line.colour) +
           "\" stroke-width=\"" + number(line.width) +
           (line.dash > 0.0 ? "\" stroke-dasharray=\"" + number(line.dash) : "") +
           "\" stroke-linecap=\"round\" stroke-linejoin=\"round\"/>\n";
}

std::string svgOf(const Text& text)
{
    const char* const anchor = text.anchor == Anchor::Middle ? " text-anchor=\"middle\""
                               : text.anchor == Anchor::End  ? " text-anchor=\"end\""
                                                             : "";
    return "<text x=\"" + number(text.at.x) + "\" y=\"" + number(text.at.y) + "\" font-size=\"" +
           number(text.size / kCapitals) + "\" fill=\"" + hex(text.colour) + "\"" + anchor +
           (text.bold ? " font-weight=\"bold\"" : "") +
           (text.halo ? " paint-order=\"stroke\" stroke=\"#ffffff\" stroke-width=\"4\" stroke-linejoin=\"round\""
                      : "") +
           ">" + xmlText(text.text, "&<>") + "</text>\n";
}

// --------------------------------------------------------------------------------------------------------- pixels

void draw(const Canvas& canvas, const Area& area)
{
    canvas.trace(area.points);
    canvas.fill(area.colour, area.opacity);
}

void draw(const Canvas& canvas, const Line& line)
{
    cairo_set_dash(canvas.cairo(), &line.dash, line.dash > 0.0 ? 1 : 0, 0.0);
    canvas.trace(line.points);
    canvas.stroke(line.colour, line.width);
}

void draw(const Canvas& canvas, const Text& text)
{
    const double width = textWidth(text.text, text.size);
    const double shift = text.anchor == Anchor::Middle ? 0.5 : text.anchor == Anchor::End ? 1.0 : 0.0;
    const Vec2 at{text.at.x - shift * width, text.at.y};
    const double stroke = text.size * (text.bold ? 0.2 : 0.135);
    if (text.halo) {
        drawText(canvas, text.text, at, {text.size, stroke + 0.55 * text.size, {255, 255, 255}});
    }
    drawText(canvas, text.text, at, {text.size, stroke, text.colour});
}

void move(std::vector<Vec2>& points, Vec2 by)
{
    for (Vec2& p : points) {
        p = p + by;
    }
}

void move(Area& area, Vec2 by)
{
    move(area.points, by);
}

void move(Line& line, Vec2 by)
{
    move(line.points, by);
}

void move(Text& text, Vec2 by)
{
    text.at = text.at + by;
}

}  // namespace

Drawing beside(const std::vector<Drawing>& drawings)
{
    Drawing all;
    for (Drawing drawing : drawings) {
        for (auto& mark : drawing.marks) {
            std::visit([&](auto& one) { move(one, {all.width, 0.0}); }, mark);
            all.marks.push_back(std::move(mark));
        }
        all.width += drawing.width;
        all.height = std::max(all.height, drawing.height);
    }
    return all;
}

void writeSvg(const Drawing& drawing, std::ostream& out)
{
    const std::string size = number(drawing.width) + " " + number(drawing.height);
    out << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << number(drawing.width) << "\" height=\""
        << number(drawing.height) << "\" viewBox=\"0 0 " << size
        << "\" font-family=\"'DejaVu Sans', 'Helvetica Neue', Arial, sans-serif\">\n"
        << "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n";
    for (const auto& mark : drawing.marks) {
        out << std::visit([](const auto& one) { return svgOf(one); }, mark);
    }
    out << "</svg>\n";
}

Picture pictureOf(const Drawing& drawing, double scale)
{
    const double width = std::round(scale * drawing.width);
    const double height = std::round(scale * drawing.height);
    if (!(width >= 1.0 && height >= 1.0 && std::max(width, height) <= kLongestCanvas &&
          width * height <= static_cast<double>(kMaxPicturePixels))) {
        throw Error(ErrorCode::InvalidArgument,
                    fmt::format("a drawing of {} x {} pixels must have 1 to {} pixels, at most {} a side",
                                numberText(width), numberText(height), kMaxPicturePixels, kLongestCanvas));
    }
    Picture picture{static_cast<int>(width), static_cast<int>(height), {}};
    picture.rgb.assign(3 * static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height), 255);
    const Canvas canvas(picture, {}, {width, height});
    cairo_scale(canvas.cairo(), scale, scale);
    for (const auto& mark : drawing.marks) {
        std::visit([&](const auto& one) { draw(canvas, one); }, mark);
    }
    return picture;
}

}  // namespace droplet
