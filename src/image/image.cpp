// SPDX-License-Identifier: GPL-3.0-or-later
// Luma after ITU-R BT.601-7, section 2.5.1; orientation after EXIF 2.32, tag 0112.
#include "image/image.h"

#include <algorithm>
#include <cstring>
#include <string>
#include <utility>

#include "droplet/error.h"
#include "image/codecs.h"
#include "image/image_header.h"

namespace droplet {

namespace {

template <class Sample>
constexpr std::uint32_t kScale = 65535U / static_cast<Sample>(~Sample{0});

template <class Sample>
std::uint16_t level(Sample sample)
{
    return static_cast<std::uint16_t>(sample * kScale<Sample>);
}

/// The weights add up to 1000, so that grey stays grey.
template <class Sample>
std::uint16_t luma(const Sample* rgb)
{
    return static_cast<std::uint16_t>((kScale<Sample> * (299U * rgb[0] + 587U * rgb[1] + 114U * rgb[2]) + 500U) /
                                      1000U);
}

template <std::size_t kChannels, class Sample>
std::array<std::uint8_t, 3> colour(const Sample* pixel)
{
    const auto byte = [](Sample sample) { return static_cast<std::uint8_t>((level(sample) + 128U) / 257U); };
    return kChannels < 3
               ? std::array{byte(pixel[0]), byte(pixel[0]), byte(pixel[0])}
               : std::array{byte(pixel[0]), byte(pixel[kChannels > 2 ? 1 : 0]), byte(pixel[kChannels > 2 ? 2 : 0])};
}

/// Stores one level per pixel of a run. Nearly all runs have no gaps; these have a loop of their own, which compilers
/// vectorise.
template <class LevelOf>
void putLevels(std::uint16_t* to, std::size_t step, std::size_t count, LevelOf level_of)
{
    if (step == 1) {
        for (std::size_t i = 0; i < count; ++i) {
            to[i] = level_of(i);
        }
        return;
    }
    for (std::size_t i = 0; i < count; ++i) {
        to[i * step] = level_of(i);
    }
}

template <std::size_t kChannels, class Sample>
void putPixels(Image& image, const PixelRun& run, std::span<const Sample> samples)
{
    // Drawings have one colour over wide areas, which then is converted once.
    constexpr std::size_t kBlock = 64;
    const std::size_t pixels = samples.size() / kChannels;
    for (std::size_t first = 0; first < pixels; first += kBlock) {
        const std::size_t count = std::min(kBlock, pixels - first);
        const Sample* from = samples.data() + first * kChannels;
        const bool is_plain = std::memcmp(from, from + kChannels, (count - 1) * kChannels * sizeof(Sample)) == 0;
        const auto put = [&](std::uint16_t* plane, auto level_of) {
            std::uint16_t* to = plane + run.first + first * run.step;
            if (is_plain) {
                putLevels(to, run.step, count, [plain = level_of(from)](std::size_t) { return plain; });
            } else {
                putLevels(to, run.step, count, [&](std::size_t i) { return level_of(from + i * kChannels); });
            }
        };
        if constexpr (kChannels < 3) {
            put(image.luma.data(), [](const Sample* pixel) { return level(pixel[0]); });
        } else {
            put(image.luma.data(), luma<Sample>);
        }
        if (!image.colour.empty()) {
            for (std::size_t i = 0; i < count; ++i) {
                image.colour[run.first + (first + i) * run.step] = colour<kChannels>(from + i * kChannels);
            }
        }
        if constexpr (kChannels % 2 == 0) {
            put(image.alpha.data(), [](const Sample* pixel) { return level(pixel[kChannels - 1]); });
        }
    }
}

/// Mapping of a turned image: (x, y) lies at origin + x right + y down in the stored one.
struct Turn {
    bool swaps_sides = false;
    std::ptrdiff_t origin = 0;
    std::ptrdiff_t right = 0;
    std::ptrdiff_t down = 0;
};

Turn turnOf(int orientation, std::ptrdiff_t width, std::ptrdiff_t height)
{
    const std::ptrdiff_t last_column = width - 1;
    const std::ptrdiff_t last_row = (height - 1) * width;
    switch (orientation) {
        case 2:
            return {false, last_column, -1, width};
        case 3:
            return {false, last_row + last_column, -1, -width};
        case 4:
            return {false, last_row, 1, -width};
        case 5:
            return {true, 0, width, 1};
        case 6:
            return {true, last_row, -width, 1};
        case 7:
            return {true, last_row + last_column, -width, -1};
        case 8:
            return {true, last_column, width, -1};
        default:
            return {false, 0, 1, width};
    }
}

template <class Sample>
void turnPlane(std::vector<Sample>& plane, const Turn& turn, int width, int height)
{
    // A tile of both images fits into the first-level cache: 2 × 8 KiB, for floats 2 × 16.
    constexpr int kTile = 64;
    std::vector<Sample> turned(plane.size());
    for (int y0 = 0; y0 < height; y0 += kTile) {
        for (int x0 = 0; x0 < width; x0 += kTile) {
            for (int y = y0; y < std::min(y0 + kTile, height); ++y) {
                for (int x = x0; x < std::min(x0 + kTile, width); ++x) {
                    const auto to = static_cast<std::ptrdiff_t>(y) * width + x;
                    const auto from = turn.origin + x * turn.right + y * turn.down;
                    turned[static_cast<std::size_t>(to)] = plane[static_cast<std::size_t>(from)];
                }
            }
        }
    }
    plane = std::move(turned);
}

Image decodeWebp(std::span<const std::byte> encoded, const DecodeOptions& options)
{
    const auto frame = firstWebpFrame(encoded);
    if (!frame) {
        return decodeWithOpenCv(encoded, ImageFormat::Webp, options);
    }
    checkSize(ImageFormat::Webp, static_cast<std::uint64_t>(frame->canvas.width),
              static_cast<std::uint64_t>(frame->canvas.height), options.max_pixels);
    return upright(placedOn(frame->canvas, decodeWithOpenCv(frame->file, ImageFormat::Webp, options)),
                   webpOrientation(encoded));
}

}  // namespace

void requireInk(const Image& image)
{
    const bool is_drawing = image.raster_scale.has_value();
    if (is_drawing && std::all_of(image.alpha.begin(), image.alpha.end(), [](std::uint16_t a) { return a == 0; })) {
        throw Error(
            ErrorCode::InvalidInput,
            "SVG image draws nothing: " + (image.lacking.empty() ? "all is transparent, hidden or outside its page"
                                                                 : "it has " + image.lacking + ", which is not drawn"));
    }
}

Image blankImage(const ImageHeader& header, bool with_alpha)
{
    const auto pixels = static_cast<std::size_t>(header.width) * static_cast<std::size_t>(header.height);
    Image image;
    image.width = header.width;
    image.height = header.height;
    image.luma.resize(pixels);
    if (with_alpha) {
        image.alpha.resize(pixels);
    }
    if (header.keeps_colour) {
        image.colour.resize(pixels);
    }
    return image;
}

template <class Sample>
void putPixels(Image& image, const PixelRun& run, std::span<const Sample> samples)
{
    switch (run.channels) {
        case 1:
            return putPixels<1>(image, run, samples);
        case 2:
            return putPixels<2>(image, run, samples);
        case 3:
            return putPixels<3>(image, run, samples);
        default:
            return putPixels<4>(image, run, samples);
    }
}

template void putPixels<std::uint8_t>(Image&, const PixelRun&, std::span<const std::uint8_t>);
template void putPixels<std::uint16_t>(Image&, const PixelRun&, std::span<const std::uint16_t>);

Image upright(Image image, int orientation)
{
    if (orientation <= 1 || orientation > 8) {
        return image;
    }
    const Turn turn = turnOf(orientation, image.width, image.height);
    if (turn.swaps_sides) {
        std::swap(image.width, image.height);
    }
    turnPlane(image.luma, turn, image.width, image.height);
    if (!image.alpha.empty()) {
        turnPlane(image.alpha, turn, image.width, image.height);
    }
    if (!image.colour.empty()) {
        turnPlane(image.colour, turn, image.width, image.height);
    }
    return image;
}

Image placedOn(const PicturePlace& canvas, Image picture)
{
    if (canvas.x == 0 && canvas.y == 0 && canvas.width == picture.width && canvas.height == picture.height) {
        return picture;
    }
    Image placed =
        blankImage({.width = canvas.width, .height = canvas.height, .keeps_colour = !picture.colour.empty()}, true);
    placed.premultiplied = picture.premultiplied;
    const auto copy = [&](const auto& from, auto& to) {
        const int columns = std::min(picture.width, canvas.width - canvas.x);
        for (int y = 0; columns > 0 && y < picture.height && canvas.y + y < canvas.height; ++y) {
            const auto place = static_cast<std::ptrdiff_t>(canvas.y + y) * canvas.width + canvas.x;
            std::copy_n(from.begin() + static_cast<std::ptrdiff_t>(y) * picture.width, columns, to.begin() + place);
        }
    };
    if (picture.alpha.empty()) {
        picture.alpha.assign(picture.luma.size(), 65535);
    }
    copy(picture.luma, placed.luma);
    copy(picture.alpha, placed.alpha);
    if (!picture.colour.empty()) {
        copy(picture.colour, placed.colour);
    }
    return placed;
}

std::vector<std::uint16_t> lumaOverBlack(Image image)
{
    if (!image.premultiplied) {
        for (std::size_t i = 0; i < image.alpha.size(); ++i) {
            const std::uint32_t product = std::uint32_t{image.luma[i]} * image.alpha[i];
            image.luma[i] = static_cast<std::uint16_t>((product + 32767U) / 65535U);
        }
    }
    return std::move(image.luma);
}

Image decodeImage(std::span<const std::byte> encoded, const DecodeOptions& options)
{
    const ImageFormat format = knownFormat(encoded);
    switch (format) {
        case ImageFormat::Png:
        case ImageFormat::Jpeg:
            break;
        case ImageFormat::Svg:
            return decodeSvg(encoded, options);
        case ImageFormat::Bmp:
            return decodeBmp(encoded, options);
        case ImageFormat::Gif:
            return decodeGif(encoded, options);
        case ImageFormat::Ico:
            return decodeIco(encoded, options);
        case ImageFormat::Tga:
            return decodeTga(encoded, options);
        case ImageFormat::Webp:
            return decodeWebp(encoded, options);
        case ImageFormat::Tiff:
        case ImageFormat::Pnm:
        case ImageFormat::Jpeg2000:
        case ImageFormat::OpenExr:
        case ImageFormat::RadianceHdr:
            return decodeWithOpenCv(encoded, format, options);
    }
    ImageHeader header = readImageHeader(encoded, format, options.max_pixels);
    header.keeps_colour = options.keeps_colour;
    return upright(format == ImageFormat::Png ? decodePng(encoded, header) : decodeJpeg(encoded, header),
                   header.orientation);
}

std::optional<FloatImage> decodeFloatImage(std::span<const std::byte> encoded, std::size_t max_pixels,
                                           bool keeps_colour)
{
    constexpr std::uint16_t kTagSampleFormat = 339;
    constexpr std::uint64_t kUnsigned = 1;
    const ImageFormat format = knownFormat(encoded);
    const bool holds_floats =
        format == ImageFormat::OpenExr || format == ImageFormat::RadianceHdr ||
        (format == ImageFormat::Tiff && tiffField(encoded, kTagSampleFormat).value_or(kUnsigned) != kUnsigned);
    return holds_floats ? decodeFloatsWithOpenCv(encoded, format, max_pixels, keeps_colour) : std::nullopt;
}

}  // namespace droplet
