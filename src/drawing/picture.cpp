// SPDX-License-Identifier: GPL-3.0-or-later
// Portable Network Graphics, by libpng: filter and compression level are fixed, so that bytes do not depend on
// defaults.
#include "droplet/drawing/picture.h"

#include <png.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <csetjmp>
#include <cstring>
#include <iterator>
#include <new>
#include <ostream>
#include <span>
#include <string>
#include <string_view>

#include "drawing/tone.h"
#include "droplet/drawing/grey_picture.h"
#include "droplet/error.h"
#include "image/exr.h"
#include "image/image.h"
#include "image/image_file.h"

namespace droplet {
namespace {

/// libpng's state. Errors use longjmp: no object with a destructor may live between setjmp and libpng's calls.
struct PngWriter {
    std::ostream& out;
    std::uint64_t bytes = 0;
    std::array<char, 128> message{};
    png_structp png = nullptr;
    png_infop info = nullptr;

    explicit PngWriter(std::ostream& stream) : out(stream) {}
    PngWriter(const PngWriter&) = delete;
    PngWriter& operator=(const PngWriter&) = delete;
    ~PngWriter() { png_destroy_write_struct(&png, &info); }
};

[[noreturn]] void onError(png_structp png, png_const_charp text)
{
    auto& writer = *static_cast<PngWriter*>(png_get_error_ptr(png));
    std::strncpy(writer.message.data(), text, writer.message.size() - 1);
    png_longjmp(png, 1);
}

void onWarning(png_structp /*png*/, png_const_charp /*text*/) {}

void onWrite(png_structp png, png_bytep from, std::size_t count)
{
    auto& writer = *static_cast<PngWriter*>(png_get_io_ptr(png));
    writer.out.write(reinterpret_cast<const char*>(from), static_cast<std::streamsize>(count));
    writer.bytes += count;
}

void onFlush(png_structp /*png*/) {}

/// Rows in the format of a PNG.
struct Rows {
    int width = 0;
    int height = 0;
    int depth = 8;  ///< [bits per channel]
    int colour_type = PNG_COLOR_TYPE_RGB;
    bool is_colour = true;  ///< sRGB; false: data
    const std::uint8_t* first = nullptr;
    std::size_t stride = 0;  ///< [bytes per row]
};

bool encode(PngWriter& writer, const Rows& rows, PngEffort effort)
{
    if (setjmp(png_jmpbuf(writer.png)) != 0) {
        return false;
    }
    png_set_write_fn(writer.png, &writer, onWrite, onFlush);
    png_set_filter(writer.png, PNG_FILTER_TYPE_BASE, effort == PngEffort::Fast ? PNG_FILTER_SUB : PNG_FILTER_PAETH);
    png_set_compression_level(writer.png, effort == PngEffort::Fast ? 1 : 6);
    png_set_IHDR(writer.png, writer.info, static_cast<png_uint_32>(rows.width), static_cast<png_uint_32>(rows.height),
                 rows.depth, rows.colour_type, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_BASE, PNG_FILTER_TYPE_BASE);
    if (rows.is_colour) {
        png_set_sRGB(writer.png, writer.info, PNG_sRGB_INTENT_PERCEPTUAL);
    }
    png_write_info(writer.png, writer.info);
    for (std::size_t y = 0; y < static_cast<std::size_t>(rows.height); ++y) {
        png_write_row(writer.png, rows.first + y * rows.stride);
    }
    png_write_end(writer.png, nullptr);
    return true;
}

std::uint64_t write(const Rows& rows, std::ostream& out, PngEffort effort)
{
    PngWriter writer(out);
    writer.png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &writer, onError, onWarning);
    writer.info = writer.png == nullptr ? nullptr : png_create_info_struct(writer.png);
    if (writer.info == nullptr) {
        throw std::bad_alloc();
    }
    if (!encode(writer, rows, effort)) {
        throw Error(ErrorCode::InvalidArgument,
                    std::string("picture cannot be written as PNG: ") + writer.message.data());
    }
    return writer.bytes;
}

void requireCount(const char* name, std::size_t count, int width, int height, int channels)
{
    if (width < 1 || height < 1) {
        throw Error(ErrorCode::InvalidArgument, "picture of " + std::to_string(width) + " by " +
                                                    std::to_string(height) + " pixels must have at least one");
    }
    const std::size_t needed =
        static_cast<std::size_t>(channels) * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    if (count != needed) {
        throw Error(ErrorCode::InvalidArgument, std::string("picture.") + name + " has " + std::to_string(count) +
                                                    (name == std::string_view("levels") ? " numbers; " : " bytes; ") +
                                                    std::to_string(width) + " by " + std::to_string(height) +
                                                    " pixels are " + std::to_string(needed));
    }
}

/// Scaling of one side of a picture: old pixels and weights for each new pixel.
struct Tap {
    std::size_t first = 0;
    std::vector<float> shares;
};

/// @param from   beginning of the new picture in the old one [px]
/// @param scale  old pixels per new pixel
std::vector<Tap> tapsOf(int old_side, int new_side, double from, double scale)
{
    std::vector<Tap> taps(static_cast<std::size_t>(new_side));
    const double reach = std::max(scale, 1.0);  // half-width of the tent filter
    for (std::size_t i = 0; i < taps.size(); ++i) {
        const double centre = from + (static_cast<double>(i) + 0.5) * scale - 0.5;
        const int low = static_cast<int>(std::ceil(centre - reach));
        const int high = static_cast<int>(std::floor(centre + reach));
        const int first = std::clamp(low, 0, old_side - 1);
        const int last = std::clamp(high, 0, old_side - 1);
        taps[i].first = static_cast<std::size_t>(first);
        taps[i].shares.assign(static_cast<std::size_t>(last - first) + 1, 0.0F);
        double sum = 0.0;
        for (int k = low; k <= high; ++k) {
            sum += std::max(1.0 - std::abs(k - centre) / reach, 0.0);
        }
        for (int k = low; k <= high; ++k) {  // beyond the edge the edge pixel repeats
            taps[i].shares[static_cast<std::size_t>(std::clamp(k, first, last) - first)] +=
                static_cast<float>(std::max(1.0 - std::abs(k - centre) / reach, 0.0) / sum);
        }
    }
    return taps;
}

void requireChannels(int channels)
{
    if (channels != 1 && channels != 3) {
        throw Error(ErrorCode::InvalidArgument, "channels " + std::to_string(channels) + " must be 1 or 3");
    }
}

}  // namespace

void Picture::validate() const
{
    requireCount("rgb", rgb.size(), width, height, 3);
}

void Layer::validate() const
{
    requireCount("rgba", rgba.size(), width, height, 4);
}

void DeepPicture::validate() const
{
    requireChannels(channels);
    requireCount("levels", levels.size(), width, height, channels);
}

void GreyPicture::validate() const
{
    requireCount("levels", levels.size(), width, height, 1);
}

void FloatPicture::validate() const
{
    requireChannels(channels);
    requireCount("values", values.size(), width, height, channels);
}

std::uint64_t writeExr(const FloatPicture& picture, std::ostream& out)
{
    picture.validate();
    const std::vector<std::byte> file =
        encodeExr({picture.width, picture.height, picture.channels, std::span(picture.values)});
    out.write(reinterpret_cast<const char*>(file.data()), static_cast<std::streamsize>(file.size()));
    return file.size();
}

std::uint64_t writePng(const Picture& picture, std::ostream& out, PngEffort effort)
{
    picture.validate();
    return write({picture.width, picture.height, 8, PNG_COLOR_TYPE_RGB, true, picture.rgb.data(),
                  3 * static_cast<std::size_t>(picture.width)},
                 out, effort);
}

std::uint64_t writePng(const Layer& layer, std::ostream& out, PngEffort effort)
{
    layer.validate();
    return write({layer.width, layer.height, 8, PNG_COLOR_TYPE_RGBA, true, layer.rgba.data(),
                  4 * static_cast<std::size_t>(layer.width)},
                 out, effort);
}

std::uint64_t writePng(const DeepPicture& picture, std::ostream& out, PngEffort effort)
{
    picture.validate();
    std::vector<std::uint8_t> bytes;  // big-endian
    bytes.reserve(2 * picture.levels.size());
    for (const std::uint16_t level : picture.levels) {
        bytes.push_back(static_cast<std::uint8_t>(level >> 8));
        bytes.push_back(static_cast<std::uint8_t>(level & 0xFF));
    }
    return write({picture.width, picture.height, 16, picture.channels == 3 ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_GRAY,
                  false, bytes.data(), bytes.size() / static_cast<std::size_t>(picture.height)},
                 out, effort);
}

std::uint64_t writePng(const GreyPicture& picture, std::ostream& out, PngEffort effort)
{
    picture.validate();
    return write({picture.width, picture.height, 8, PNG_COLOR_TYPE_GRAY, false, picture.levels.data(),
                  static_cast<std::size_t>(picture.width)},
                 out, effort);
}

std::uint64_t writeShortestPng(const DeepPicture& picture, std::ostream& out)
{
    constexpr std::uint16_t kStep = 257;  // a level of 8 bits in 16
    const bool is_short = std::all_of(picture.levels.begin(), picture.levels.end(),
                                      [](std::uint16_t level) { return level % kStep == 0; });
    if (!is_short || picture.channels != 1) {
        return writePng(picture, out);
    }
    GreyPicture grey{picture.width, picture.height, {}};
    grey.levels.reserve(picture.levels.size());
    std::transform(picture.levels.begin(), picture.levels.end(), std::back_inserter(grey.levels),
                   [](std::uint16_t level) { return static_cast<std::uint8_t>(level / kStep); });
    return writePng(grey, out);
}

Picture over(const Layer& layer, const Picture& below)
{
    layer.validate();
    below.validate();
    if (layer.width != below.width || layer.height != below.height) {
        throw Error(ErrorCode::InvalidArgument,
                    "layer of " + std::to_string(layer.width) + " by " + std::to_string(layer.height) +
                        " pixels must have the picture's size, " + std::to_string(below.width) + " by " +
                        std::to_string(below.height));
    }
    Picture mixed = below;
    for (std::size_t i = 0; i < mixed.rgb.size() / 3; ++i) {
        const std::uint8_t alpha = layer.rgba[4 * i + 3];
        for (std::size_t c = 0; c < 3; ++c) {
            mixed.rgb[3 * i + c] = mixedLevel(layer.rgba[4 * i + c], mixed.rgb[3 * i + c], alpha);
        }
    }
    return mixed;
}

Picture scaledToCover(const Picture& picture, int width, int height)
{
    picture.validate();
    constexpr int kMaxSide = 8192;
    if (width < 1 || height < 1 || width > kMaxSide || height > kMaxSide) {
        throw Error(ErrorCode::InvalidArgument, "frame of " + std::to_string(width) + " by " + std::to_string(height) +
                                                    " pixels must be 1 to 8192 each way");
    }
    if (picture.width == width && picture.height == height) {
        return picture;
    }
    const double scale =
        std::min(static_cast<double>(picture.width) / width, static_cast<double>(picture.height) / height);
    const std::vector<Tap> across = tapsOf(picture.width, width, 0.5 * (picture.width - scale * width), scale);
    const std::vector<Tap> down = tapsOf(picture.height, height, 0.5 * (picture.height - scale * height), scale);
    Picture scaled{width, height, {}};
    const auto row_levels = 3 * static_cast<std::size_t>(width);
    scaled.rgb.resize(row_levels * static_cast<std::size_t>(height));
    const auto old_row = 3 * static_cast<std::size_t>(picture.width);
    tbb::parallel_for(std::size_t{0}, static_cast<std::size_t>(height), [&](std::size_t y) {
        std::vector<float> sum(old_row, 0.0F);
        for (std::size_t k = 0; k < down[y].shares.size(); ++k) {
            const std::uint8_t* const row = picture.rgb.data() + (down[y].first + k) * old_row;
            for (std::size_t i = 0; i < old_row; ++i) {
                sum[i] += down[y].shares[k] * displayLevels()[row[i]];
            }
        }
        for (std::size_t x = 0; x < static_cast<std::size_t>(width); ++x) {
            for (std::size_t c = 0; c < 3; ++c) {
                float light = 0.0F;
                for (std::size_t k = 0; k < across[x].shares.size(); ++k) {
                    light += across[x].shares[k] * sum[3 * (across[x].first + k) + c];
                }
                scaled.rgb[y * row_levels + 3 * x + c] = encoded(light);
            }
        }
    });
    return scaled;
}

Picture decodePicture(std::span<const std::byte> encoded, std::size_t max_pixels)
{
    try {
        const Image image = decodeImage(encoded, {.max_pixels = max_pixels, .keeps_colour = true});
        Picture picture{image.width, image.height, {}};
        picture.rgb.reserve(3 * image.colour.size());
        for (std::size_t i = 0; i < image.colour.size(); ++i) {
            const std::uint32_t alpha = image.alpha.empty() ? 65535U : image.alpha[i];
            for (const std::uint32_t level : image.colour[i]) {
                const std::uint32_t own = image.premultiplied ? level * 65535U : level * alpha;
                const std::uint32_t sum = own + 255U * (65535U - alpha);
                picture.rgb.push_back(static_cast<std::uint8_t>(std::min(255U, (sum + 32767U) / 65535U)));
            }
        }
        return picture;
    } catch (const std::bad_alloc&) {
        throwOutOfMemory();
    }
}

Layer decodeLayer(std::span<const std::byte> encoded, std::size_t max_pixels)
{
    try {
        const Image image = decodeImage(encoded, {.max_pixels = max_pixels, .keeps_colour = true});
        Layer layer{image.width, image.height, {}};
        layer.rgba.reserve(4 * image.colour.size());
        for (std::size_t i = 0; i < image.colour.size(); ++i) {
            const std::uint32_t alpha = image.alpha.empty() ? 65535U : image.alpha[i];
            for (const std::uint32_t level : image.colour[i]) {
                const std::uint32_t own =
                    image.premultiplied && alpha > 0 ? (level * 65535U + alpha / 2) / alpha : level;
                layer.rgba.push_back(static_cast<std::uint8_t>(std::min(255U, own)));
            }
            layer.rgba.push_back(static_cast<std::uint8_t>((alpha * 255U + 32767U) / 65535U));
        }
        return layer;
    } catch (const std::bad_alloc&) {
        throwOutOfMemory();
    }
}

Picture readPicture(const std::filesystem::path& path, std::size_t max_pixels)
{
    return fromImageFile(path, [&](std::span<const std::byte> encoded) { return decodePicture(encoded, max_pixels); });
}

}  // namespace droplet
