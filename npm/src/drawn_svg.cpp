// SPDX-License-Identifier: GPL-3.0-or-later
// Draws SVG by resvg, which the JavaScript around the module loads and stops.
//
// After: CSS Values and Units 3, 5.2.
#include "image/drawn_svg.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>
#include <string>
#include <string_view>

#include "droplet/units.h"
#include "host.h"
#include "image/image_bytes.h"
#include "image/svg_raster.h"
#include "number_text.h"

namespace droplet {
namespace {

/// Physical length of an attribute of the document's own tag [m].
std::optional<double> physicalLength(std::string_view text, std::string_view attribute)
{
    constexpr double kInch = 25.4 * kMillimetre;
    const auto begin = text.find("<svg");
    std::string_view tag = text.substr(std::min(begin, text.size()));
    tag = tag.substr(0, tag.find('>'));
    for (auto at = tag.find(attribute); at != std::string_view::npos; at = tag.find(attribute, at + 1)) {
        auto rest = tag.substr(at + attribute.size());
        const auto skip_space = [&] { rest.remove_prefix(std::min(rest.find_first_not_of(" \t\r\n"), rest.size())); };
        skip_space();
        if (std::isspace(static_cast<unsigned char>(tag[at - 1])) == 0 || !rest.starts_with('=')) {
            continue;
        }
        rest.remove_prefix(1);
        skip_space();
        if (rest.empty()) {
            return std::nullopt;
        }
        rest = rest.substr(1, rest.find(rest.front(), 1) - 1);
        double value = 0.0;
        const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), value);
        const std::string_view unit(end, static_cast<std::size_t>(rest.data() + rest.size() - end));
        struct Unit {
            std::string_view name;
            double length;
        };
        for (const Unit& known : {Unit{"in", kInch}, Unit{"cm", 10.0 * kMillimetre}, Unit{"mm", kMillimetre},
                                  Unit{"pt", kInch / 72.0}, Unit{"pc", kInch / 6.0}}) {
            if (error == std::errc{} && unit == known.name) {
                return value * known.length;
            }
        }
        return std::nullopt;
    }
    return std::nullopt;
}

double physicalWidth(std::string_view text, const DropletPage& page)
{
    const auto width = physicalLength(text, "width");
    const auto height = physicalLength(text, "height");
    return width                                                       ? *width
           : height && text.find(" viewBox") != std::string_view::npos ? *height * page.width / page.height
                                                                       : 0.0;
}

}  // namespace

DrawnSvg drawSvg(std::span<const std::byte> text, std::size_t, const DecodeOptions& options)
{
    DropletPage page{};
    droplet_host_open_svg(text.data(), text.size(), options.drawing.seconds, &page);
    if (page.problem[0] != '\0') {
        page.is_damaged != 0 ? throwDamaged(ImageFormat::Svg, page.problem) : throwSvgRefused(page.problem);
    }
    const auto raster = svgRaster(page.width, page.height, options.vector_long_side, options.max_pixels);
    if (!raster) {
        throwSvgRefused(tooNarrow(page.width, page.height, options.max_pixels));
    }
    DrawnSvg drawn;
    drawn.drawing.outcome = SvgOutcome::Drawn;
    drawn.drawing.width = raster->width;
    drawn.drawing.height = raster->height;
    drawn.drawing.scale = raster->scale;
    drawn.drawing.physical_width = physicalWidth({reinterpret_cast<const char*>(text.data()), text.size()}, page);
    std::copy(std::begin(page.lacking), std::end(page.lacking), drawn.drawing.lacking.begin());
    const std::size_t count = static_cast<std::size_t>(raster->width) * static_cast<std::size_t>(raster->height);
    const std::shared_ptr<std::uint32_t[]> pixels(new std::uint32_t[count]);
    if (!droplet_host_draw_svg(raster->width, raster->height, reinterpret_cast<std::uint8_t*>(pixels.get()))) {
        throwSvgRefused("takes more than " + numberText(options.drawing.seconds) + " s to draw");
    }
    // Red and blue change places.
    std::for_each(pixels.get(), pixels.get() + count, [](std::uint32_t& rgba) {
        rgba = (rgba & 0xFF00FF00U) | (rgba & 0xFFU) << 16U | (rgba >> 16U & 0xFFU);
    });
    drawn.pixels = {pixels, pixels.get()};
    return drawn;
}

}  // namespace droplet
