// SPDX-License-Identifier: GPL-3.0-or-later
#include "picture/legend.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <string>

#include "picture/ground.h"
#include "picture/lettering.h"

namespace droplet {
namespace {

constexpr Vec3f kPlain = {0.62F, 0.62F, 0.60F};  // linear; where paint has no share

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

// As few digits behind the point as a multiple of the step needs.
std::string number(double value, double step)
{
    const int digits = std::clamp(static_cast<int>(-std::floor(std::log10(step) + 1e-9)), 0, 9);
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), "%.*f", digits, value == 0.0 ? 0.0 : value);
    return text.data();
}

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
        // As wide as said on the picture however steep the values are.
        const double phase = here / *paint.line_spacing;
        const double apart = std::abs(phase - std::round(phase)) * *paint.line_spacing / point.slope;
        const bool ends = here < 0.5 * *paint.line_spacing;  // the rim needs no line
        colour = (apart < 0.5 && !ends ? 0.45F : 1.0F) * colour;
    }
    if (paint.share.empty()) {
        return colour;
    }
    return mix(kPlain, colour, static_cast<float>(value(paint.share)));
}

void drawLegend(Picture& picture, const Paint& paint)
{
    constexpr int kLeastWidth = 320;
    constexpr int kLeastHeight = 240;
    if (picture.width < kLeastWidth || picture.height < kLeastHeight) {
        return;
    }
    const double size = std::max(7.0, 0.0135 * picture.height);
    const Pen pen{size, 0.14 * size, {38, 42, 48}};
    const double span = (paint.high - paint.low) / paint.unit;
    const double step = roundStep(span, 5.0);
    const double first = step * std::ceil(paint.low / paint.unit / step - 1e-9);

    double widest = 0.0;
    for (double tick = first; tick <= paint.high / paint.unit + 1e-9 * span; tick += step) {
        widest = std::max(widest, textWidth(number(tick, step), size));
    }
    const double bar_width = 1.6 * size;
    const double inside = std::max(bar_width + 1.2 * size + widest, textWidth(paint.caption, size));
    const double left = picture.width - inside - 3.5 * size;
    const double top = 2.5 * size;
    const double bar_top = top + 3.2 * size;
    const double bar_height = 0.36 * picture.height;
    const double bar_bottom = bar_top + bar_height;

    const double pad = 1.4 * size;
    for (int y = static_cast<int>(top - pad); y < static_cast<int>(bar_bottom + pad); ++y) {
        for (int x = static_cast<int>(left - pad); x < static_cast<int>(left + inside + pad); ++x) {
            fill(picture, x, y, {0.98, 0.98, 0.975}, 0.85);
        }
    }
    drawText(picture, paint.caption, {left, top + 1.2 * size}, pen);
    for (int y = static_cast<int>(bar_top); y < static_cast<int>(bar_bottom); ++y) {
        const double share = (bar_bottom - y - 0.5) / bar_height;
        const Vec3 colour = colourOf(paint, paint.low + share * (paint.high - paint.low));
        for (int x = static_cast<int>(left); x < static_cast<int>(left + bar_width); ++x) {
            fill(picture, x, y, {colour.x, colour.y, colour.z}, 1.0);
        }
    }
    for (double tick = first; tick <= paint.high / paint.unit + 1e-9 * span; tick += step) {
        const double y = bar_bottom - bar_height * (tick * paint.unit - paint.low) / (paint.high - paint.low);
        for (int x = static_cast<int>(left + bar_width); x < static_cast<int>(left + bar_width + 0.45 * size); ++x) {
            fill(picture, x, static_cast<int>(std::min(y, bar_bottom - 1.0)), {0.15, 0.165, 0.19}, 0.9);
        }
        drawText(picture, number(tick, step), {left + bar_width + 0.9 * size, y + 0.5 * size}, pen);
    }
}

}  // namespace droplet
