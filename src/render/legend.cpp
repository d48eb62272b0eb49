// SPDX-License-Identifier: GPL-3.0-or-later
#include "render/legend.h"

#include <fmt/core.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "drawing/lettering.h"
#include "drawing/tone.h"

namespace droplet {
namespace {

constexpr Vec3f kPlain = {0.62F, 0.62F, 0.60F};  // linear; colour where the paint's share is 0

Vec3 colourOf(const Paint& paint, double value)
{
    const double at = std::clamp((value - paint.low) / (paint.high - paint.low), 0.0, 1.0) *
                      static_cast<double>(paint.scale.size() - 1);
    const auto k = std::min(static_cast<std::size_t>(at), paint.scale.size() - 2);
    const double share = at - static_cast<double>(k);
    return (1.0 - share) * paint.scale[k] + share * paint.scale[k + 1];
}

Vec3f linear(Vec3 colour)
{
    const Vec3f c = toFloats(colour);
    return {toLinear(c.x), toLinear(c.y), toLinear(c.z)};
}

// Formats a number with the fewest decimals that multiples of the step need.
std::string number(double value, double step)
{
    const int digits = std::clamp(static_cast<int>(-std::floor(std::log10(step) + 1e-9)), 0, 9);
    const double scale = std::pow(10.0, digits);
    return fmt::format("{:.{}f}", std::round(value * scale) / scale + 0.0, digits);
}

constexpr double kBar = 1.6;   // width of the colour bar, in letter sizes
constexpr double kTick = 0.9;  // from the bar to the numbers, in letter sizes

double letterSize(int picture_height)
{
    return std::max(7.0, 0.0135 * picture_height);
}

/// Numbers beside the colour bar.
struct Legend {
    double step = 1.0;
    std::vector<double> ticks;
    double inside = 0.0;  // total width [px]

    Legend(const Paint& paint, int picture_height)
    {
        const double low = paint.low / paint.unit;
        const double high = paint.high / paint.unit;
        step = roundStep(high - low, 5.0);
        const double size = letterSize(picture_height);
        double widest = 0.0;
        const auto first = std::llround(std::ceil(low / step - 1e-6));
        const auto last = std::llround(std::floor(high / step + 1e-6));
        for (long long k = first; k <= last; ++k) {
            ticks.push_back(static_cast<double>(k) * step);
            widest = std::max(widest, textWidth(number(ticks.back(), step), size));
        }
        inside = std::max((kBar + kTick) * size + widest, textWidth(paint.caption, size));
    }
};

void fill(Picture& picture, int x, int y, std::array<double, 3> colour, double cover)
{
    if (x < 0 || y < 0 || x >= picture.width || y >= picture.height) {
        return;
    }
    std::uint8_t* pixel =
        picture.rgb.data() +
        3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) + static_cast<std::size_t>(x));
    for (std::size_t c = 0; c < 3; ++c) {
        pixel[c] = static_cast<std::uint8_t>(std::lrint((1.0 - cover) * pixel[c] + cover * 255.0 * colour[c]));
    }
}

}  // namespace

Vec3f paintAt(const Paint& paint, const Triangle& triangle, const PaintPoint& point)
{
    const auto value = [&](const std::vector<double>& at) {
        const auto u = static_cast<double>(point.u);
        const auto v = static_cast<double>(point.v);
        return (1.0 - u - v) * at[triangle[0]] + u * at[triangle[1]] + v * at[triangle[2]];
    };
    const double here = value(paint.values);
    Vec3f colour = linear(colourOf(paint, here));
    if (paint.line_spacing && point.slope > 0.0) {
        // Lines have the same width in the picture for every slope of the values.
        const double phase = here / *paint.line_spacing;
        const double apart = std::abs(phase - std::round(phase)) * *paint.line_spacing / point.slope;
        const bool ends = here < 0.5 * *paint.line_spacing;  // value 0, at the rim, needs no line
        colour = (apart < 0.5 && !ends ? 0.45F : 1.0F) * colour;
    }
    if (paint.share.empty()) {
        return colour;
    }
    return mix(kPlain, colour, static_cast<float>(value(paint.share)));
}

int legendWidth(const Paint& paint, int width, int height)
{
    constexpr int kMinWidth = 320;
    constexpr int kMinHeight = 240;
    if (width < kMinWidth || height < kMinHeight) {
        return 0;
    }
    return static_cast<int>(std::ceil(Legend(paint, height).inside + 4.0 * letterSize(height)));
}

void drawLegend(Picture& picture, const Paint& paint)
{
    if (legendWidth(paint, picture.width, picture.height) == 0) {
        return;
    }
    const Legend legend(paint, picture.height);
    const double size = letterSize(picture.height);
    const Pen pen{size, 0.14 * size, {38, 42, 48}};
    const double left = picture.width - legend.inside - 2.0 * size;
    const double bar_height = 0.5 * picture.height;
    const double bar_top = 0.5 * (picture.height - bar_height);
    const double bar_bottom = bar_top + bar_height;
    const double bar_width = kBar * size;

    drawText(picture, paint.caption, {left, bar_top - 1.8 * size}, pen);
    for (int y = static_cast<int>(bar_top); y < static_cast<int>(bar_bottom); ++y) {
        const double share = (bar_bottom - y - 0.5) / bar_height;
        const Vec3 colour = colourOf(paint, paint.low + share * (paint.high - paint.low));
        for (int x = static_cast<int>(left); x < static_cast<int>(left + bar_width); ++x) {
            fill(picture, x, y, {colour.x, colour.y, colour.z}, 1.0);
        }
    }
    for (const double tick : legend.ticks) {
        const double y = bar_bottom - bar_height * (tick * paint.unit - paint.low) / (paint.high - paint.low);
        for (int x = static_cast<int>(left + bar_width); x < static_cast<int>(left + bar_width + 0.45 * size); ++x) {
            fill(picture, x, static_cast<int>(std::clamp(y, bar_top, bar_bottom - 1.0)), {0.15, 0.165, 0.19}, 0.9);
        }
        drawText(picture, number(tick, legend.step), {left + bar_width + kTick * size, y + 0.5 * size}, pen);
    }
}

}  // namespace droplet
