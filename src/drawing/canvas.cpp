// SPDX-License-Identifier: GPL-3.0-or-later
#include "drawing/canvas.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace droplet {
namespace {

int within(double value, int last)
{
    return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(last)));
}

/// Calls copy(level of the picture, level of the surface) for the three channels of every pixel.
template <typename Copy>
void forEachLevel(Picture& picture, int left, int top, cairo_surface_t* surface, const Copy& copy)
{
    cairo_surface_flush(surface);
    const int width = cairo_image_surface_get_width(surface);
    for (int y = 0; y < cairo_image_surface_get_height(surface); ++y) {
        auto* row = cairo_image_surface_get_data(surface) +
                    static_cast<std::ptrdiff_t>(y) * cairo_image_surface_get_stride(surface);
        auto* pixels = reinterpret_cast<std::uint32_t*>(row);
        const auto first = static_cast<std::size_t>(top + y) * static_cast<std::size_t>(picture.width) +
                           static_cast<std::size_t>(left);
        for (int x = 0; x < width; ++x) {
            copy(picture.rgb.data() + 3 * (first + static_cast<std::size_t>(x)), pixels[x]);
        }
    }
    cairo_surface_mark_dirty(surface);
}

}  // namespace

Canvas::Canvas(Picture& picture, Vec2 low, Vec2 high)
    : picture_(&picture),
      left_(within(std::floor(low.x), picture.width)),
      top_(within(std::floor(low.y), picture.height)),
      surface_(
          cairo_image_surface_create(CAIRO_FORMAT_RGB24, std::max(0, within(std::ceil(high.x), picture.width) - left_),
                                     std::max(0, within(std::ceil(high.y), picture.height) - top_)),
          cairo_surface_destroy),
      cairo_(cairo_create(surface_.get()), cairo_destroy)
{
    forEachLevel(picture, left_, top_, surface_.get(), [](const std::uint8_t* rgb, std::uint32_t& pixel) {
        pixel = std::uint32_t{rgb[0]} << 16U | std::uint32_t{rgb[1]} << 8U | rgb[2];
    });
    cairo_translate(cairo(), -left_, -top_);
    cairo_set_line_cap(cairo(), CAIRO_LINE_CAP_ROUND);
    cairo_set_line_join(cairo(), CAIRO_LINE_JOIN_ROUND);
}

Canvas::~Canvas()
{
    forEachLevel(*picture_, left_, top_, surface_.get(), [](std::uint8_t* rgb, std::uint32_t pixel) {
        rgb[0] = static_cast<std::uint8_t>(pixel >> 16U);
        rgb[1] = static_cast<std::uint8_t>(pixel >> 8U);
        rgb[2] = static_cast<std::uint8_t>(pixel);
    });
}

void Canvas::trace(const std::vector<Vec2>& points) const
{
    cairo_new_sub_path(cairo());
    for (const Vec2& p : points) {
        cairo_line_to(cairo(), p.x, p.y);
    }
}

void Canvas::fill(const Colour& colour, double opacity) const
{
    cairo_set_source_rgba(cairo(), colour[0] / 255.0, colour[1] / 255.0, colour[2] / 255.0, opacity);
    cairo_fill(cairo());
}

void Canvas::stroke(const Colour& colour, double width) const
{
    double pixel = 1.0;
    double none = 0.0;
    cairo_device_to_user_distance(cairo(), &pixel, &none);
    cairo_set_source_rgba(cairo(), colour[0] / 255.0, colour[1] / 255.0, colour[2] / 255.0,
                          std::min(1.0, width / pixel));
    cairo_set_line_width(cairo(), std::max(width, pixel));
    cairo_stroke(cairo());
}

}  // namespace droplet
