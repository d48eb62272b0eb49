// SPDX-License-Identifier: GPL-3.0-or-later
// Drawings as pixels.
#include "droplet/liquid2d_io/liquid_drawing.h"

#include <cairo.h>
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "blocks.h"
#include "droplet/error.h"
#include "liquid_paths.h"
#include "pixel_coverage.h"

namespace droplet {
namespace {

constexpr std::size_t kRowsPerBlock = 128;

struct Free {
    void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
    void operator()(cairo_t* context) const { cairo_destroy(context); }
};

void setColour(cairo_t* context, Colour colour)
{
    cairo_set_source_rgb(context, colour[0] / 255.0, colour[1] / 255.0, colour[2] / 255.0);
}

void addPaths(cairo_t* context, const std::vector<BezierPath>& paths)
{
    for (const BezierPath& path : paths) {
        cairo_move_to(context, path.start.x, path.start.y);
        for (const BezierCurve& curve : path.curves) {
            cairo_curve_to(context, curve.leaving.x, curve.leaving.y, curve.arriving.x, curve.arriving.y, curve.end.x,
                           curve.end.y);
        }
        cairo_close_path(context);
    }
}

void fillPaths(cairo_t* context, const std::vector<BezierPath>& paths, Colour fill)
{
    addPaths(context, paths);
    setColour(context, fill);
    cairo_fill(context);
}

/// Turns a row of Cairo's pixels, whose colours are multiplied by their alpha, into red, green, blue and alpha.
void unmultiply(const unsigned char* pixels, std::uint8_t* rgba, std::size_t width)
{
    for (std::size_t x = 0; x < width; ++x, pixels += 4, rgba += 4) {
        std::uint32_t pixel = 0;
        std::copy_n(pixels, 4, reinterpret_cast<unsigned char*>(&pixel));
        const std::uint32_t alpha = pixel >> 24U;
        const auto level = [&](unsigned shift) { return (pixel >> shift) & 0xFFU; };
        // Most pixels are opaque.
        const auto colour = [&](unsigned shift) {
            return static_cast<std::uint8_t>(alpha == 255 ? level(shift)
                                             : alpha == 0 ? 0
                                                          : std::min((level(shift) * 255U + alpha / 2) / alpha, 255U));
        };
        rgba[0] = colour(16U);
        rgba[1] = colour(8U);
        rgba[2] = colour(0U);
        rgba[3] = static_cast<std::uint8_t>(alpha);
    }
}

}  // namespace

Layer liquidLayer(const DrawnLiquid& scene, const LiquidView& view, const LiquidLook& look)
{
    validate(view);
    const std::unique_ptr<cairo_surface_t, Free> surface(
        cairo_image_surface_create(CAIRO_FORMAT_ARGB32, view.width, view.height));
    const std::unique_ptr<cairo_t, Free> context(cairo_create(surface.get()));
    cairo_t* const c = context.get();
    if (cairo_status(c) != CAIRO_STATUS_SUCCESS) {
        throw Error(ErrorCode::InvalidArgument,
                    fmt::format("a picture of {} x {} pixels cannot be drawn", view.width, view.height));
    }
    if (look.background) {
        setColour(c, *look.background);
        cairo_paint(c);
    }
    const LiquidPaths paths = liquidPaths(scene.shape, view, look);
    fillPaths(c, paths.liquid, look.water);
    fillPaths(c, paths.droplets, look.droplet);
    fillPaths(c, paths.foam, look.foam.value_or(look.water));
    fillPaths(c, paths.lines, look.line);
    cairo_set_fill_rule(c, CAIRO_FILL_RULE_EVEN_ODD);
    for (const Region& region : scene.walls) {
        for (const std::vector<Vec2>& loop : region.loops) {
            for (const Vec2 point : toPixels(loop, view)) {
                cairo_line_to(c, point.x, point.y);
            }
            cairo_close_path(c);
        }
        setColour(c, look.wall);
        cairo_fill(c);
    }
    cairo_surface_flush(surface.get());

    Layer layer;
    layer.width = view.width;
    layer.height = view.height;
    const unsigned char* const data = cairo_image_surface_get_data(surface.get());
    const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(surface.get()));
    const auto width = static_cast<std::size_t>(view.width);
    layer.rgba.resize(4 * width * static_cast<std::size_t>(view.height));
    forBlocks(
        static_cast<std::size_t>(view.height),
        [&](std::size_t begin, std::size_t end) {
            for (std::size_t y = begin; y < end; ++y) {
                unmultiply(data + y * stride, layer.rgba.data() + 4 * width * y, width);
            }
        },
        kRowsPerBlock);
    return layer;
}

DeepPicture liquidMask(const LiquidShape& shape, const LiquidView& view)
{
    validate(view);
    PixelCoverage coverage(view.width, view.height);
    for (const auto* loops : {&shape.liquid, &shape.droplets}) {
        for (const Loop& loop : *loops) {
            const std::vector<Vec2> points = toPixels(loop.points, view);
            for (std::size_t k = 0; k < points.size(); ++k) {
                coverage.addLine(points[k], points[(k + 1) % points.size()]);
            }
        }
    }
    DeepPicture picture;
    picture.width = view.width;
    picture.height = view.height;
    picture.channels = 1;
    for (const double share : coverage.shares()) {
        picture.levels.push_back(static_cast<std::uint16_t>(std::lround(65535.0 * std::clamp(share, 0.0, 1.0))));
    }
    return picture;
}

}  // namespace droplet
