// SPDX-License-Identifier: GPL-3.0-or-later
// ITU-T T.81 (JPEG) through libjpeg. A baseline file needs memory for a few rows beside the Image. A progressive one
// keeps its coefficients until the last scan, up to 6 bytes a pixel.
#include <array>
#include <csetjmp>
#include <cstdio>
#include <string>

// jpeglib.h needs FILE and size_t from above.
#include <jerror.h>
#include <jpeglib.h>

#include "image/codecs.h"
#include "image/image_bytes.h"

namespace droplet {

namespace {

/// A progressive file may have a scan of a few bytes for every bit of every coefficient, each as expensive as a whole
/// image. Encoders write about ten scans; 500 is the limit of libjpeg-turbo's own fuzzers.
constexpr int kMaxScans = 500;

/// State of libjpeg. Errors leave by longjmp; see PngReader.
struct JpegReader {
    jpeg_decompress_struct info{};
    jpeg_error_mgr errors{};
    jpeg_progress_mgr progress{};
    std::jmp_buf jump{};
    std::array<char, JMSG_LENGTH_MAX> message{};
    std::vector<std::uint8_t> row;

    JpegReader() = default;
    JpegReader(const JpegReader&) = delete;
    JpegReader& operator=(const JpegReader&) = delete;
    ~JpegReader() { jpeg_destroy_decompress(&info); }
};

[[noreturn]] void onError(j_common_ptr info)
{
    auto& reader = *static_cast<JpegReader*>(info->client_data);
    info->err->format_message(info, reader.message.data());
    std::longjmp(reader.jump, 1);  // libjpeg must not continue
}

/// Handles warnings. libjpeg reports damage as a warning and invents the rest of the picture, so only warnings that
/// change no pixel are ignored.
void onMessage(j_common_ptr info, int level)
{
    if (level >= 0) {
        return;
    }
    switch (info->err->msg_code) {
        case JWRN_ADOBE_XFORM:
        case JWRN_EXTRANEOUS_DATA:
        case JWRN_JFIF_MAJOR:
            return;
        default:
            onError(info);
    }
}

boolean onEndOfData(j_decompress_ptr info)
{
    info->err->msg_code = JERR_INPUT_EOF;
    onError(reinterpret_cast<j_common_ptr>(info));
}

void onProgress(j_common_ptr info)
{
    auto& reader = *static_cast<JpegReader*>(info->client_data);
    if (reader.info.input_scan_number > kMaxScans) {
        std::snprintf(reader.message.data(), reader.message.size(), "it has more than %d scans", kMaxScans);
        std::longjmp(reader.jump, 1);
    }
}

/// Runs calls of libjpeg. Nothing with a destructor may be local to `calls`.
template <class Calls>
void guarded(JpegReader& reader, Calls calls)
{
    // libjpeg reports errors only in this way.
    if (setjmp(reader.jump) != 0) {
        throwDamaged(ImageFormat::Jpeg, reader.message.data());
    }
    calls();
}

void readHeader(JpegReader& reader, std::span<const std::byte> encoded, bool keeps_colour)
{
    jpeg_create_decompress(&reader.info);
    reader.info.progress = &reader.progress;
    jpeg_mem_src(&reader.info, reinterpret_cast<const unsigned char*>(encoded.data()), encoded.size());
    reader.info.src->fill_input_buffer = onEndOfData;
    jpeg_read_header(&reader.info, TRUE);
    // Y of YCbCr is the luma of BT.601.
    const bool is_cmyk = reader.info.jpeg_color_space == JCS_CMYK || reader.info.jpeg_color_space == JCS_YCCK;
    reader.info.out_color_space = is_cmyk ? JCS_CMYK : keeps_colour ? JCS_RGB : JCS_GRAYSCALE;
    jpeg_start_decompress(&reader.info);
}

/// Converts CMYK to RGB: the light that neither the coloured nor the black ink absorbs. Adobe's files, which are nearly
/// all, store the remaining paper instead of the ink.
void cmykToRgb(std::span<std::uint8_t> row, bool is_inverted)
{
    const unsigned flip = is_inverted ? 0U : 255U;
    for (std::size_t i = 0; i + 3 < row.size(); i += 4) {
        const unsigned black = row[i + 3] ^ flip;
        for (std::size_t c = 0; c < 3; ++c) {
            row[i / 4 * 3 + c] = static_cast<std::uint8_t>(((row[i + c] ^ flip) * black + 127U) / 255U);
        }
    }
}

}  // namespace

Image decodeJpeg(std::span<const std::byte> encoded, const ImageHeader& header)
{
    JpegReader reader;
    reader.info.err = jpeg_std_error(&reader.errors);
    reader.errors.error_exit = onError;
    reader.errors.emit_message = onMessage;
    reader.progress.progress_monitor = onProgress;
    reader.info.client_data = &reader;
    guarded(reader, [&] { readHeader(reader, encoded, header.keeps_colour); });

    jpeg_decompress_struct& info = reader.info;
    if (info.output_width != static_cast<JDIMENSION>(header.width) ||
        info.output_height != static_cast<JDIMENSION>(header.height)) {
        throwDamaged(ImageFormat::Jpeg, "it states two sizes");
    }
    const bool is_cmyk = info.out_color_space == JCS_CMYK;
    const int channels = info.out_color_space == JCS_GRAYSCALE ? 1 : 3;
    const std::size_t width = info.output_width;
    Image image = blankImage(header, false);
    reader.row.resize(width * static_cast<std::size_t>(info.output_components));
    guarded(reader, [&] {
        JSAMPROW row = reader.row.data();
        for (std::size_t y = 0; y < info.output_height; ++y) {
            jpeg_read_scanlines(&info, &row, 1);
            if (is_cmyk) {
                cmykToRgb(reader.row, info.saw_Adobe_marker != 0);
            }
            putPixels(image, {y * width, 1, channels},
                      std::span<const std::uint8_t>(reader.row.data(), static_cast<std::size_t>(channels) * width));
        }
        jpeg_finish_decompress(&info);  // reads to the end mark, so that a missing one is found
    });
    return image;
}

}  // namespace droplet
