// SPDX-License-Identifier: GPL-3.0-or-later
// Portable Network Graphics, through libpng: one filter and one level of compression, so that bytes do not depend on
// defaults.
#include "droplet/picture/picture.h"

#include <png.h>

#include <array>
#include <csetjmp>
#include <cstring>
#include <new>
#include <ostream>
#include <string>

#include "droplet/error.h"
#include "footprint/image.h"
#include "footprint/image_file.h"

namespace droplet {
namespace {

/// libpng's state. Its errors leave by longjmp: nothing with a destructor may live between it and its calls.
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

bool encode(PngWriter& writer, const Picture& picture)
{
    if (setjmp(png_jmpbuf(writer.png)) != 0) {
        return false;
    }
    png_set_write_fn(writer.png, &writer, onWrite, onFlush);
    png_set_filter(writer.png, PNG_FILTER_TYPE_BASE, PNG_FILTER_PAETH);
    png_set_compression_level(writer.png, 6);
    png_set_IHDR(writer.png, writer.info, static_cast<png_uint_32>(picture.width),
                 static_cast<png_uint_32>(picture.height), 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_BASE, PNG_FILTER_TYPE_BASE);
    png_set_sRGB(writer.png, writer.info, PNG_sRGB_INTENT_PERCEPTUAL);
    png_write_info(writer.png, writer.info);
    const std::size_t stride = 3 * static_cast<std::size_t>(picture.width);
    for (std::size_t y = 0; y < static_cast<std::size_t>(picture.height); ++y) {
        png_write_row(writer.png, picture.rgb.data() + y * stride);
    }
    png_write_end(writer.png, nullptr);
    return true;
}

}  // namespace

void Picture::validate() const
{
    if (width < 1 || height < 1) {
        throw Error(ErrorCode::InvalidArgument, "picture of " + std::to_string(width) + " by " +
                                                    std::to_string(height) + " pixels must have at least one");
    }
    const std::size_t bytes = 3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    if (rgb.size() != bytes) {
        throw Error(ErrorCode::InvalidArgument, "picture.rgb has " + std::to_string(rgb.size()) + " bytes; " +
                                                    std::to_string(width) + " by " + std::to_string(height) +
                                                    " pixels are " + std::to_string(bytes));
    }
}

std::uint64_t writePng(const Picture& picture, std::ostream& out)
{
    picture.validate();
    PngWriter writer(out);
    writer.png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &writer, onError, onWarning);
    writer.info = writer.png == nullptr ? nullptr : png_create_info_struct(writer.png);
    if (writer.info == nullptr) {
        throw std::bad_alloc();
    }
    if (!encode(writer, picture)) {
        throw Error(ErrorCode::InvalidArgument,
                    std::string("picture cannot be written as PNG: ") + writer.message.data());
    }
    return writer.bytes;
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

Picture readPicture(const std::filesystem::path& path, std::size_t max_pixels)
{
    return fromImageFile(path, [&](std::span<const std::byte> encoded) { return decodePicture(encoded, max_pixels); });
}

}  // namespace droplet
