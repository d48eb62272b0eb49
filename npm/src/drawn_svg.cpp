// SPDX-License-Identifier: GPL-3.0-or-later
// Draws SVG by resvg, which the JavaScript around the module loads and stops.
#include "image/drawn_svg.h"

#include <algorithm>

#include "host.h"
#include "image/image_bytes.h"
#include "image/svg_raster.h"

namespace droplet {
namespace {

void requireNoProblem(const DropletPage& page)
{
    if (page.problem[0] != '\0') {
        page.is_damaged != 0 ? throwDamaged(ImageFormat::Svg, page.problem) : throwSvgRefused(page.problem);
    }
}

}  // namespace

DrawnSvg drawSvg(std::span<const std::byte> text, std::size_t, const DecodeOptions& options)
{
    DropletPage page{};
    droplet_host_open_svg(text.data(), text.size(), options.drawing.seconds, &page);
    requireNoProblem(page);
    const auto raster = svgRaster(page.width, page.height, options.vector_long_side, options.max_pixels);
    if (!raster) {
        throwSvgRefused(tooNarrow(page.width, page.height, options.max_pixels));
    }
    DrawnSvg drawn;
    drawn.drawing.outcome = SvgOutcome::Drawn;
    drawn.drawing.width = raster->width;
    drawn.drawing.height = raster->height;
    drawn.drawing.scale = raster->scale;
    drawn.drawing.physical_width = page.physical_width;
    std::copy(std::begin(page.lacking), std::end(page.lacking), drawn.drawing.lacking.begin());
    const std::size_t count = static_cast<std::size_t>(raster->width) * static_cast<std::size_t>(raster->height);
    const std::shared_ptr<std::uint32_t[]> pixels(new std::uint32_t[count]);
    droplet_host_draw_svg(raster->width, raster->height, reinterpret_cast<std::uint8_t*>(pixels.get()), &page);
    requireNoProblem(page);
    // Red and blue change places.
    std::for_each(pixels.get(), pixels.get() + count, [](std::uint32_t& rgba) {
        rgba = (rgba & 0xFF00FF00U) | (rgba & 0xFFU) << 16U | (rgba >> 16U & 0xFFU);
    });
    drawn.pixels = {pixels, pixels.get()};
    return drawn;
}

}  // namespace droplet
