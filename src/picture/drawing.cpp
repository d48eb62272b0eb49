// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/picture/drawing.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <ostream>
#include <string_view>
#include <utility>

#include "droplet/error.h"
#include "picture/lettering.h"

namespace droplet {
namespace {

/// Of a font's size, what capitals of common sans-serif fonts are high.
constexpr double kCapitals = 0.72;

std::vector<std::vector<Vec2>> dashesOf(const Line& line)
{
    if (!(line.dash > 0.0)) {
        return {line.points};
    }
    std::vector<std::vector<Vec2>> dashes;
    bool drawn = true;
    double left = line.dash;
    std::vector<Vec2> dash;
    for (std::size_t i = 0; i + 1 < line.points.size(); ++i) {
        Vec2 from = line.points[i];
        const Vec2 to = line.points[i + 1];
        if (drawn && dash.empty()) {
            dash.push_back(from);
        }
        double rest = length(to - from);
        while (rest > left) {
            from = from + (left / rest) * (to - from);
            dash.push_back(from);
            if (drawn) {
                dashes.push_back(dash);
                dash.clear();
            } else {
                dash = {from};
            }
            drawn = !drawn;
            left = line.dash;
            rest = length(to - from);
        }
        left -= rest;
        if (drawn) {
            dash.push_back(to);
        }
    }
    if (dash.size() > 1) {
        dashes.push_back(dash);
    }
    return dashes;
}

// --------------------------------------------------------------------------------------------------------- SVG

/// A hundredth of a unit is finer than a screen shows.
std::string number(double value)
{
    std::array<char, 64> text{};
    const double rounded = std::round(100.0 * value) / 100.0;
    const auto end = std::to_chars(text.data(), text.data() + text.size(), rounded == 0.0 ? 0.0 : rounded).ptr;
    return {text.data(), end};
}

std::string hex(const Colour& colour)
{
    constexpr std::string_view kDigits = "0123456789abcdef";
    std::string text = "#";
    for (const std::uint8_t level : colour) {
        text += kDigits[level >> 4U];
        text += kDigits[level & 15U];
    }
    return text;
}

std::string places(const std::vector<Vec2>& points)
{
    std::string text;
    for (const Vec2& p : points) {
        text += (text.empty() ? "" : " ") + number(p.x) + "," + number(p.y);
    }
    return text;
}

std::string escaped(const std::string& text)
{
    std::string safe;
    for (const char c : text) {
        safe += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
    }
    return safe;
}

std::string svgOf(const Area& area)
{
    return "<polygon points=\"" + places(area.points) + "\" fill=\"" + hex(area.colour) + "\"" +
           (area.opacity < 1.0 ? " fill-opacity=\"" + number(area.opacity) + "\"" : "") + "/>\n";
}

std::string svgOf(const Line& line)
{
    std::string text;
    for (const auto& points : dashesOf(line)) {
        text += (text.empty() ? "M" : " M") + places(points);
    }
    return "<path d=\"" + text + "\" fill=\"none\" stroke=\"" + hex(line.colour) + "\" stroke-width=\"" +
           number(line.width) + "\" stroke-linecap=\"round\" stroke-linejoin=\"round\"/>\n";
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
           ">" + escaped(text.text) + "</text>\n";
}

// --------------------------------------------------------------------------------------------------------- pixels

/// How much of every pixel of a part of the picture something covers.
struct Cover {
    int left = 0;
    int top = 0;
    int width = 0;
    int height = 0;
    std::vector<float> share;

    /// Of all pixels that points are near to.
    Cover(const Picture& picture, const std::vector<Vec2>& points, double reach)
    {
        Vec2 low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
        Vec2 high = -1.0 * low;
        for (const Vec2& p : points) {
            low = {std::min(low.x, p.x), std::min(low.y, p.y)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y)};
        }
        const auto within = [](double value, int last) {
            return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(last)));
        };
        left = within(std::floor(low.x - reach), picture.width);
        top = within(std::floor(low.y - reach), picture.height);
        width = within(std::ceil(high.x + reach), picture.width) - left;
        height = within(std::ceil(high.y + reach), picture.height) - top;
        width = std::max(width, 0);
        height = std::max(height, 0);
        share.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0.0F);
    }

    float& at(int x, int y)
    {
        return share[static_cast<std::size_t>(y - top) * static_cast<std::size_t>(width) +
                     static_cast<std::size_t>(x - left)];
    }
};

void blend(Picture& picture, Cover& cover, const Colour& colour, double opacity)
{
    for (int y = cover.top; y < cover.top + cover.height; ++y) {
        for (int x = cover.left; x < cover.left + cover.width; ++x) {
            const double share = opacity * static_cast<double>(cover.at(x, y));
            if (share > 0.0) {
                std::uint8_t* const pixel =
                    picture.rgb.data() + 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                                              static_cast<std::size_t>(x));
                for (std::size_t c = 0; c < 3; ++c) {
                    pixel[c] = static_cast<std::uint8_t>(std::lrint((1.0 - share) * pixel[c] + share * colour[c]));
                }
            }
        }
    }
}

/// Where a polygon lies within a row of pixels' sixteenth: exact along the row.
void cross(const std::vector<Vec2>& polygon, double y, std::vector<double>& crossings)
{
    crossings.clear();
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec2 a = polygon[i];
        const Vec2 b = polygon[(i + 1) % polygon.size()];
        if ((a.y <= y) != (b.y <= y)) {
            crossings.push_back(a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x));
        }
    }
    std::sort(crossings.begin(), crossings.end());
}

void draw(Picture& picture, const Area& area)
{
    Cover cover(picture, area.points, 0.0);
    constexpr int kParts = 16;
    std::vector<double> crossings;
    for (int y = cover.top; y < cover.top + cover.height; ++y) {
        for (int part = 0; part < kParts; ++part) {
            cross(area.points, y + (part + 0.5) / kParts, crossings);
            for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
                const double from = std::max<double>(crossings[i], cover.left);
                const double to = std::min<double>(crossings[i + 1], cover.left + cover.width);
                for (int x = static_cast<int>(from); x < to; ++x) {
                    const double part_of_pixel = std::min<double>(to, x + 1) - std::max<double>(from, x);
                    cover.at(x, y) += static_cast<float>(part_of_pixel / kParts);
                }
            }
        }
    }
    blend(picture, cover, area.colour, area.opacity);
}

double away(Vec2 p, Vec2 a, Vec2 b)
{
    const Vec2 along = b - a;
    const double squared = dot(along, along);
    const double t = squared > 0.0 ? std::clamp(dot(p - a, along) / squared, 0.0, 1.0) : 0.0;
    return length(p - a - t * along);
}

void draw(Picture& picture, const Line& line)
{
    // A line thinner than a pixel is a paler one.
    const double opacity = std::min(1.0, line.width);
    const double reach = 0.5 * std::max(1.0, line.width) + 0.5;
    Cover cover(picture, line.points, reach);
    for (const auto& points : dashesOf(line)) {
        for (std::size_t i = 0; i + 1 < points.size(); ++i) {
            const Vec2 a = points[i];
            const Vec2 b = points[i + 1];
            const Cover part(picture, {a, b}, reach);
            for (int y = part.top; y < part.top + part.height; ++y) {
                for (int x = part.left; x < part.left + part.width; ++x) {
                    const double share = std::clamp(reach - away({x + 0.5, y + 0.5}, a, b), 0.0, 1.0);
                    float& most = cover.at(x, y);
                    most = std::max(most, static_cast<float>(share));
                }
            }
        }
    }
    blend(picture, cover, line.colour, opacity);
}

void draw(Picture& picture, const Text& text)
{
    const double width = textWidth(text.text, text.size);
    const double shift = text.anchor == Anchor::Middle ? 0.5 : text.anchor == Anchor::End ? 1.0 : 0.0;
    const Vec2 at{text.at.x - shift * width, text.at.y};
    const double stroke = text.size * (text.bold ? 0.2 : 0.135);
    if (text.halo) {
        drawText(picture, text.text, at, {text.size, stroke + 0.55 * text.size, {255, 255, 255}});
    }
    drawText(picture, text.text, at, {text.size, stroke, text.colour});
}

Vec2 scaled(Vec2 p, double scale)
{
    return scale * p;
}

std::vector<Vec2> scaled(std::vector<Vec2> points, double scale)
{
    for (Vec2& p : points) {
        p = scaled(p, scale);
    }
    return points;
}

Area scaled(Area area, double scale)
{
    area.points = scaled(std::move(area.points), scale);
    return area;
}

Line scaled(Line line, double scale)
{
    line.points = scaled(std::move(line.points), scale);
    line.width *= scale;
    line.dash *= scale;
    return line;
}

Text scaled(Text text, double scale)
{
    text.at = scaled(text.at, scale);
    text.size *= scale;
    return text;
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
    if (!(width >= 1.0 && height >= 1.0 && width * height <= static_cast<double>(kMostPicturePixels))) {
        throw Error(ErrorCode::InvalidArgument, "a drawing of " + number(width) + " x " + number(height) +
                                                    " pixels must have from 1 to " +
                                                    std::to_string(kMostPicturePixels));
    }
    Picture picture{static_cast<int>(width), static_cast<int>(height), {}};
    picture.rgb.assign(3 * static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height), 255);
    for (const auto& mark : drawing.marks) {
        std::visit([&](const auto& one) { draw(picture, scaled(one, scale)); }, mark);
    }
    return picture;
}

}  // namespace droplet
