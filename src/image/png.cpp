// SPDX-License-Identifier: GPL-3.0-or-later
// Portable Network Graphics through libpng's row interface. It needs memory for one row beside the Image, interlaced or
// not.
#include <png.h>

#include <algorithm>
#include <array>
#include <bit>
#include <csetjmp>
#include <cstring>
#include <string>

#include "image/codecs.h"
#include "image/image_bytes.h"

namespace droplet {

namespace {

/// State of libpng. Its errors leave by longjmp, so objects with a destructor are kept here, in a frame outside the
/// jump, and no C++ exception crosses libpng.
struct PngReader {
    std::span<const std::byte> encoded;
    std::size_t position = 0;
    png_structp png = nullptr;
    png_infop info = nullptr;
    std::array<char, 128> message{};
    std::vector<std::uint16_t> row;  // 16-bit for alignment; 8-bit rows use it, too

    explicit PngReader(std::span<const std::byte> bytes) : encoded(bytes) {}
    PngReader(const PngReader&) = delete;
    PngReader& operator=(const PngReader&) = delete;
    ~PngReader() { png_destroy_read_struct(&png, &info, nullptr); }
};

[[noreturn]] void onError(png_structp png, png_const_charp text)
{
    auto& reader = *static_cast<PngReader*>(png_get_error_ptr(png));
    std::strncpy(reader.message.data(), text, reader.message.size() - 1);
    png_longjmp(png, 1);
}

/// Ignores warnings, which change no pixel; without a handler libpng would print them.
void onWarning(png_structp /*png*/, png_const_charp /*text*/) {}

void onRead(png_structp png, png_bytep to, std::size_t count)
{
    auto& reader = *static_cast<PngReader*>(png_get_io_ptr(png));
    if (count > reader.encoded.size() - reader.position) {
        png_error(png, "it ends too early");
    }
    std::memcpy(to, reader.encoded.data() + reader.position, count);
    reader.position += count;
}

/// Runs calls of libpng. Nothing with a destructor may be local to `calls`.
template <class Calls>
void guarded(PngReader& reader, Calls calls)
{
    // libpng reports errors only in this way.
    if (setjmp(png_jmpbuf(reader.png)) != 0) {
        throwDamaged(ImageFormat::Png, reader.message.data());
    }
    calls();
}

void readHeader(PngReader& reader)
{
    // Otherwise a damaged tRNS would be dropped with a warning, and transparency would be lost.
    png_set_crc_action(reader.png, PNG_CRC_ERROR_QUIT, PNG_CRC_ERROR_QUIT);
    // The size has been checked; libpng's own limit is a million a side.
    png_set_user_limits(reader.png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
    // These chunks are never used; a compressed one can unpack to megabytes.
    static constexpr png_byte kUnwanted[] = "iCCP\0iTXt\0zTXt\0tEXt\0sPLT\0eXIf";
    png_set_keep_unknown_chunks(reader.png, PNG_HANDLE_CHUNK_NEVER, kUnwanted, static_cast<int>(sizeof kUnwanted / 5));
    png_read_info(reader.png, reader.info);
    png_set_expand(reader.png);  // palette to RGB, 1, 2 and 4 bits to 8, tRNS to alpha
    if (std::endian::native == std::endian::little) {
        png_set_swap(reader.png);
    }
    png_read_update_info(reader.png, reader.info);
}

void readRow(PngReader& reader, Image& image, const PixelRun& run, std::size_t pixels)
{
    auto* bytes = reinterpret_cast<png_bytep>(reader.row.data());
    png_read_row(reader.png, bytes, nullptr);
    const std::size_t samples = pixels * static_cast<std::size_t>(run.channels);
    if (png_get_bit_depth(reader.png, reader.info) == 16) {
        putPixels(image, run, std::span<const std::uint16_t>(reader.row.data(), samples));
    } else {
        putPixels(image, run, std::span<const std::uint8_t>(bytes, samples));
    }
}

/// Reads all rows. libpng's own de-interlacing would need the whole image seven times; without it, libpng returns the
/// passes as stored.
void readRows(PngReader& reader, Image& image, int channels)
{
    const auto width = static_cast<png_uint_32>(image.width);
    const auto height = static_cast<png_uint_32>(image.height);
    if (png_get_interlace_type(reader.png, reader.info) == PNG_INTERLACE_NONE) {
        for (std::size_t y = 0; y < height; ++y) {
            readRow(reader, image, {y * width, 1, channels}, width);
        }
        return;
    }
    for (unsigned pass = 0; pass < PNG_INTERLACE_ADAM7_PASSES; ++pass) {
        const png_uint_32 columns = PNG_PASS_COLS(width, pass);
        const png_uint_32 rows = columns == 0 ? 0 : PNG_PASS_ROWS(height, pass);
        for (png_uint_32 row = 0; row < rows; ++row) {
            const std::size_t y = PNG_ROW_FROM_PASS_ROW(row, pass);
            const std::size_t x = PNG_COL_FROM_PASS_COL(0U, pass);
            const std::size_t step = std::size_t{1} << PNG_PASS_COL_SHIFT(pass);
            readRow(reader, image, {y * width + x, step, channels}, columns);
        }
    }
}

}  // namespace

Image decodePng(std::span<const std::byte> encoded, const ImageHeader& header)
{
    PngReader reader(encoded);
    reader.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &reader, onError, onWarning);
    reader.info = reader.png == nullptr ? nullptr : png_create_info_struct(reader.png);
    if (reader.info == nullptr) {
        throw std::bad_alloc();
    }
    png_set_read_fn(reader.png, &reader, onRead);
    guarded(reader, [&] { readHeader(reader); });

    if (png_get_image_width(reader.png, reader.info) != static_cast<png_uint_32>(header.width) ||
        png_get_image_height(reader.png, reader.info) != static_cast<png_uint_32>(header.height)) {
        throwDamaged(ImageFormat::Png, "it states two sizes");
    }
    const int channels = png_get_channels(reader.png, reader.info);
    Image image = blankImage(header, channels % 2 == 0);
    reader.row.resize(png_get_rowbytes(reader.png, reader.info) / 2 + 1);
    guarded(reader, [&] {
        readRows(reader, image, channels);
        png_read_end(reader.png, nullptr);
    });
    return image;
}

}  // namespace droplet
