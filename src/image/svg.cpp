// SPDX-License-Identifier: GPL-3.0-or-later
// After: RFC 1952 (gzip).
#include <zlib.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <string>

#include "droplet/printable.h"
#include "image/codecs.h"
#include "image/drawn_svg.h"
#include "image/image_bytes.h"

namespace droplet {
namespace {

constexpr std::size_t kMaxTextSize = std::size_t{1} << 26;
constexpr std::size_t kMaxTags = 250'000;

std::vector<std::byte> inflated(std::span<const std::byte> compressed)
{
    constexpr int kGzip = 16 + MAX_WBITS;
    z_stream stream{};
    if (inflateInit2(&stream, kGzip) != Z_OK) {
        throw std::bad_alloc();
    }
    const std::unique_ptr<z_stream, decltype(&inflateEnd)> end(&stream, inflateEnd);
    stream.next_in = const_cast<Bytef*>(reinterpret_cast<const Bytef*>(compressed.data()));
    stream.avail_in = static_cast<uInt>(std::min<std::size_t>(compressed.size(), std::numeric_limits<uInt>::max()));
    std::vector<std::byte> text;
    std::vector<std::byte> chunk(std::size_t{1} << 16);
    for (int status = Z_OK; status != Z_STREAM_END;) {
        stream.next_out = reinterpret_cast<Bytef*>(chunk.data());
        stream.avail_out = static_cast<uInt>(chunk.size());
        status = inflate(&stream, Z_NO_FLUSH);
        if (status != Z_OK && status != Z_STREAM_END) {
            throwDamaged(ImageFormat::Svg, status == Z_BUF_ERROR ? "its compressed data end too early"
                                                                 : "its compressed data are broken");
        }
        text.insert(text.end(), chunk.begin(),
                    chunk.begin() + static_cast<std::ptrdiff_t>(chunk.size() - stream.avail_out));
        if (text.size() > kMaxTextSize) {
            break;  // rejected by the caller, as uncompressed text would be
        }
    }
    return text;
}

Image imageOf(const DrawnSvg& drawn, const DecodeOptions& options)
{
    const SvgDrawing& drawing = drawn.drawing;
    Image image = blankImage({.format = ImageFormat::Svg,
                              .width = drawing.width,
                              .height = drawing.height,
                              .keeps_colour = options.keeps_colour},
                             true);
    image.premultiplied = true;
    image.raster_scale = drawing.scale;
    image.lacking = drawing.lacking.data();
    if (drawing.physical_width > 0.0) {
        image.physical_width = drawing.physical_width;
    }
    const auto columns = static_cast<std::size_t>(drawing.width);
    std::vector<std::uint8_t> row(4 * columns);
    for (std::size_t first = 0; first < image.luma.size(); first += columns) {
        const std::uint32_t* const from = drawn.pixels.get() + first;
        for (std::size_t x = 0; x < columns; ++x) {
            row[4 * x] = static_cast<std::uint8_t>(from[x] >> 16);
            row[4 * x + 1] = static_cast<std::uint8_t>(from[x] >> 8);
            row[4 * x + 2] = static_cast<std::uint8_t>(from[x]);
            row[4 * x + 3] = static_cast<std::uint8_t>(from[x] >> 24);
        }
        putPixels(image, {first, 1, 4}, std::span<const std::uint8_t>(row));
    }
    return image;
}

}  // namespace

void throwSvgRefused(const std::string& detail)
{
    throw Error(ErrorCode::InvalidInput, "SVG image " + printable(detail));
}

SvgText svgText(std::span<const std::byte> encoded)
{
    SvgText drawing;
    const auto is_compressed = [&] { return ByteView(encoded, ImageFormat::Svg).startsWith("\x1f\x8b"); };
    if (is_compressed()) {
        drawing.inflated = inflated(encoded);
        encoded = drawing.inflated;
        // librsvg would unpack doubly compressed data, without limits.
        if (is_compressed() || imageFormat(encoded) != ImageFormat::Svg) {
            throw Error(ErrorCode::InvalidInput, "compressed data without an SVG image in them");
        }
    }
    if (encoded.size() > kMaxTextSize) {
        throwSvgRefused("of more than " + std::to_string(kMaxTextSize >> 20) + " MiB of text");
    }
    const auto tags = static_cast<std::size_t>(std::count(encoded.begin(), encoded.end(), std::byte{'<'}));
    if (tags > kMaxTags) {
        throwSvgRefused("of " + std::to_string(tags) + " tags, more than the limit of " + std::to_string(kMaxTags));
    }
    drawing.text = encoded;
    drawing.tags = tags;
    return drawing;
}

Image decodeSvg(std::span<const std::byte> encoded, const DecodeOptions& options)
{
    const SvgText drawing = svgText(encoded);
    return imageOf(drawSvg(drawing.text, drawing.tags, options), options);
}

}  // namespace droplet
