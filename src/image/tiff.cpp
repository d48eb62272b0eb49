// SPDX-License-Identifier: GPL-3.0-or-later
// TIFF 6.0, sections 3 to 8, 15, 16 and 18, and BigTIFF, through libtiff. Memory beyond the Image is one row,
// or one row of tiles.
#include <tiffio.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <limits>
#include <memory>
#include <string>

#include "image/codecs.h"
#include "image/image_bytes.h"

namespace droplet {

namespace {

/// The file as libtiff's client interface wants it, and the first error it reported.
struct TiffFile {
    std::span<const std::byte> encoded;
    std::uint64_t position = 0;
    std::array<char, 160> message{};
};

TiffFile& fileOf(thandle_t handle)
{
    return *static_cast<TiffFile*>(handle);
}

tmsize_t onRead(thandle_t handle, void* to, tmsize_t count)
{
    TiffFile& file = fileOf(handle);
    const std::uint64_t left = file.encoded.size() - std::min<std::uint64_t>(file.position, file.encoded.size());
    const std::uint64_t taken = std::min(static_cast<std::uint64_t>(count), left);
    if (taken > 0) {
        std::memcpy(to, file.encoded.data() + file.position, taken);
    }
    file.position += taken;
    return static_cast<tmsize_t>(taken);
}

tmsize_t onWrite(thandle_t /*handle*/, void* /*from*/, tmsize_t /*count*/)
{
    return 0;
}

toff_t onSeek(thandle_t handle, toff_t offset, int whence)
{
    TiffFile& file = fileOf(handle);
    const std::uint64_t base = whence == SEEK_SET ? 0 : whence == SEEK_CUR ? file.position : file.encoded.size();
    file.position = base + offset;
    return file.position;
}

int onClose(thandle_t /*handle*/)
{
    return 0;
}

toff_t onSize(thandle_t handle)
{
    return fileOf(handle).encoded.size();
}

/// Lets libtiff read strips in place. It only reads: the const_cast is its interface's, not ours.
int onMap(thandle_t handle, void** base, toff_t* size)
{
    *base = const_cast<std::byte*>(fileOf(handle).encoded.data());
    *size = fileOf(handle).encoded.size();
    return 1;
}

void onUnmap(thandle_t /*handle*/, void* /*base*/, toff_t /*size*/) {}

int onError(TIFF* /*tiff*/, void* file, const char* /*module*/, const char* format, va_list values)
{
    auto& message = static_cast<TiffFile*>(file)->message;
    if (message[0] == '\0') {
        std::vsnprintf(message.data(), message.size(), format, values);
    }
    return 1;  // nothing is left for the process-wide handler, which prints
}

int onWarning(TIFF* /*tiff*/, void* /*file*/, const char* /*module*/, const char* /*format*/, va_list /*values*/)
{
    return 1;
}

/// A handle of libtiff's on a file, with the position and errors that are the handle's own.
struct Tiff {
    std::unique_ptr<TiffFile> file;
    std::unique_ptr<TIFF, decltype(&TIFFClose)> handle{nullptr, TIFFClose};

    [[nodiscard]] TIFF* get() const { return handle.get(); }
    void checkErrors() const
    {
        if (file->message[0] != '\0') {
            throwDamaged(ImageFormat::Tiff, file->message.data());
        }
    }
};

std::uint64_t pixelsOf(const ImageHeader& header)
{
    return static_cast<std::uint64_t>(header.width) * static_cast<std::uint64_t>(header.height);
}

Tiff openTiff(std::span<const std::byte> encoded, std::uint64_t pixels)
{
    // No codec needs more at once than the image at its widest, 16-bit RGBA, and tables.
    constexpr std::uint64_t kTables = std::uint64_t{1} << 26;
    const std::unique_ptr<TIFFOpenOptions, decltype(&TIFFOpenOptionsFree)> options(TIFFOpenOptionsAlloc(),
                                                                                   TIFFOpenOptionsFree);
    Tiff tiff;
    tiff.file = std::make_unique<TiffFile>();
    TiffFile* file = tiff.file.get();
    file->encoded = encoded;
    TIFFOpenOptionsSetErrorHandlerExtR(options.get(), onError, file);
    TIFFOpenOptionsSetWarningHandlerExtR(options.get(), onWarning, file);
    TIFFOpenOptionsSetMaxSingleMemAlloc(options.get(), static_cast<tmsize_t>(8 * pixels + kTables));
    tiff.handle.reset(
        TIFFClientOpenExt("", "r", file, onRead, onWrite, onSeek, onClose, onSize, onMap, onUnmap, options.get()));
    tiff.checkErrors();
    if (!tiff.handle) {
        throwDamaged(ImageFormat::Tiff, "it has no directory");
    }
    return tiff;
}

template <class Value>
Value field(TIFF* tiff, std::uint32_t tag, Value otherwise)
{
    Value value = otherwise;
    return TIFFGetFieldDefaulted(tiff, tag, &value) == 1 ? value : otherwise;
}

/// What the samples of a pixel mean.
struct Layout {
    std::uint16_t bits = 1;
    std::uint16_t samples = 1;
    std::uint16_t photometric = PHOTOMETRIC_MINISBLACK;
    bool separate = false;            ///< every sample in a plane of its own
    std::vector<std::uint16_t> used;  ///< samples read, colours first, alpha last
    bool has_alpha = false;
    bool premultiplied = false;
    std::vector<std::array<std::uint16_t, 3>> palette;

    [[nodiscard]] std::size_t colours() const { return used.size() - (has_alpha ? 1 : 0); }
    [[nodiscard]] int channels() const
    {
        const bool grey = colours() == 1 && palette.empty();
        return (grey ? 1 : 3) + (has_alpha ? 1 : 0);
    }
};

/// Index of the sample that is alpha. libtiff cannot tell a file without the ExtraSamples field, whose fourth
/// sample every program takes for alpha, from one that says the sample has no meaning for the picture.
void findAlpha(Layout& layout, TIFF* tiff, std::span<const std::byte> encoded, std::uint16_t colours)
{
    std::uint16_t count = 0;
    std::uint16_t* kinds = nullptr;
    TIFFGetFieldDefaulted(tiff, TIFFTAG_EXTRASAMPLES, &count, &kinds);
    std::uint16_t alpha = 0;
    if (!tiffField(encoded, TIFFTAG_EXTRASAMPLES)) {
        layout.has_alpha = layout.samples == colours + 1;
        alpha = colours;
    }
    for (std::uint16_t i = 0; i < count && !layout.has_alpha; ++i) {
        if (kinds[i] != EXTRASAMPLE_UNSPECIFIED && colours + i < layout.samples) {
            layout.has_alpha = true;
            layout.premultiplied = kinds[i] == EXTRASAMPLE_ASSOCALPHA;
            alpha = static_cast<std::uint16_t>(colours + i);
        }
    }
    for (std::uint16_t i = 0; i < colours; ++i) {
        layout.used.push_back(i);
    }
    if (layout.has_alpha) {
        layout.used.push_back(alpha);
    }
}

/// The colours a palette names are of 16 bits; many writers leave 8-bit ones in the lower byte or the upper.
void readPalette(Layout& layout, TIFF* tiff)
{
    std::array<std::uint16_t*, 3> colours{};
    if (layout.bits > 16 || TIFFGetField(tiff, TIFFTAG_COLORMAP, &colours[0], &colours[1], &colours[2]) != 1) {
        throwDamaged(ImageFormat::Tiff, "its palette is missing");
    }
    std::uint32_t used_bits = 0;
    for (std::size_t i = 0; i < std::size_t{1} << layout.bits; ++i) {
        layout.palette.push_back({colours[0][i], colours[1][i], colours[2][i]});
        used_bits |= static_cast<std::uint32_t>(colours[0][i] | colours[1][i] | colours[2][i]);
    }
    if ((used_bits & 0xff00U) != 0 && (used_bits & 0x00ffU) != 0) {
        return;
    }
    for (auto& colour : layout.palette) {
        for (std::uint16_t& level : colour) {
            level = static_cast<std::uint16_t>((level | level >> 8 | level << 8) & 0xffff);
        }
    }
}

Layout readLayout(TIFF* tiff, std::span<const std::byte> encoded)
{
    Layout layout;
    layout.bits = field<std::uint16_t>(tiff, TIFFTAG_BITSPERSAMPLE, 1);
    layout.samples = field<std::uint16_t>(tiff, TIFFTAG_SAMPLESPERPIXEL, 1);
    layout.photometric = field<std::uint16_t>(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
    layout.separate = field<std::uint16_t>(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG) == PLANARCONFIG_SEPARATE;
    if (layout.photometric == PHOTOMETRIC_YCBCR &&
        field<std::uint16_t>(tiff, TIFFTAG_COMPRESSION, COMPRESSION_NONE) == COMPRESSION_JPEG) {
        TIFFSetField(tiff, TIFFTAG_JPEGCOLORMODE, JPEGCOLORMODE_RGB);
        layout.photometric = PHOTOMETRIC_RGB;
    }

    std::uint16_t colours = 1;
    switch (layout.photometric) {
        case PHOTOMETRIC_MINISWHITE:
        case PHOTOMETRIC_MINISBLACK:
            break;
        case PHOTOMETRIC_PALETTE:
            readPalette(layout, tiff);
            break;
        case PHOTOMETRIC_RGB:
            colours = 3;
            break;
        case PHOTOMETRIC_SEPARATED:
            colours = 4;
            break;
        default:
            throwUnsupported(ImageFormat::Tiff, "photometric interpretation " + std::to_string(layout.photometric));
    }
    constexpr std::uint16_t kMostSamples = 32;  // bounds the row; no mask has so many
    if (layout.samples < colours || layout.samples > kMostSamples) {
        throwUnsupported(ImageFormat::Tiff, std::to_string(layout.samples) + " samples per pixel");
    }
    const auto format = field<std::uint16_t>(tiff, TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_UINT);
    if (format != SAMPLEFORMAT_UINT && format != SAMPLEFORMAT_VOID) {
        throwUnsupported(ImageFormat::Tiff, "samples that are not unsigned integers");
    }
    const std::array known{1, 2, 4, 8, 16};
    if (std::find(known.begin(), known.end(), layout.bits) == known.end()) {
        throwUnsupported(ImageFormat::Tiff, std::to_string(layout.bits) + " bits per sample");
    }
    findAlpha(layout, tiff, encoded, colours);
    return layout;
}

/// Sample number `index` of a packed row, as it stands.
std::uint16_t sampleAt(const std::uint8_t* row, std::size_t index, unsigned bits)
{
    if (bits == 8) {
        return row[index];
    }
    if (bits == 16) {
        std::uint16_t value = 0;
        std::memcpy(&value, row + 2 * index, 2);  // libtiff has brought it into this machine's order
        return value;
    }
    const std::size_t bit = index * bits;
    const unsigned shift = 8 - bits - static_cast<unsigned>(bit % 8);
    return static_cast<std::uint16_t>(row[bit / 8] >> shift & ((1U << bits) - 1U));
}

/// One decoded row of a strip or tile: where its samples lie, and where its pixels go.
struct RowSource {
    std::vector<const std::uint8_t*> planes;  ///< one for each used sample if separate, else one
    std::size_t first = 0;                    ///< index in the image of its first pixel
    std::size_t count = 0;                    ///< pixels
};

class RowReader {
public:
    RowReader(Layout layout, Image& image) : layout_(std::move(layout)), image_(image) {}

    [[nodiscard]] const Layout& layout() const { return layout_; }

    void put(const RowSource& row)
    {
        const auto channels = static_cast<std::size_t>(layout_.channels());
        const std::uint32_t white = (1U << layout_.bits) - 1U;
        const std::uint32_t scale = 65535U / white;  // whole for 1, 2, 4, 8 and 16 bits
        pixels_.resize(row.count * channels);
        std::array<std::uint32_t, 5> used{};
        for (std::size_t i = 0; i < row.count; ++i) {
            for (std::size_t c = 0; c < layout_.used.size(); ++c) {
                const std::size_t index = layout_.separate ? i : i * layout_.samples + layout_.used[c];
                used[c] = sampleAt(row.planes[layout_.separate ? c : 0], index, layout_.bits);
            }
            std::uint16_t* pixel = pixels_.data() + i * channels;
            if (!layout_.palette.empty()) {
                std::copy(layout_.palette[used[0]].begin(), layout_.palette[used[0]].end(), pixel);
            } else if (layout_.photometric == PHOTOMETRIC_SEPARATED) {
                for (std::size_t c = 0; c < 3; ++c) {
                    const std::uint32_t light = (white - used[c]) * (white - used[3]);
                    pixel[c] = static_cast<std::uint16_t>((light + white / 2) / white * scale);
                }
            } else {
                const bool negative = layout_.photometric == PHOTOMETRIC_MINISWHITE;
                for (std::size_t c = 0; c < layout_.colours(); ++c) {
                    pixel[c] = static_cast<std::uint16_t>((negative ? white - used[c] : used[c]) * scale);
                }
            }
            if (layout_.has_alpha) {
                pixel[channels - 1] = static_cast<std::uint16_t>(used[layout_.used.size() - 1] * scale);
            }
        }
        putPixels(image_, {row.first, 1, layout_.channels()}, std::span<const std::uint16_t>(pixels_));
    }

private:
    Layout layout_;
    Image& image_;
    std::vector<std::uint16_t> pixels_;
};

/// A file with separate planes is opened once for each: libtiff decodes a strip from its start again whenever
/// another plane was read in between.
struct Planes {
    std::vector<Tiff> tiffs;
    std::vector<std::uint16_t> samples;              ///< which plane each reads
    std::vector<std::vector<std::uint8_t>> buffers;  ///< a row or a tile each
};

template <class Reader>
void readStrips(Planes& planes, Reader& reader, const ImageHeader& header)
{
    const auto width = static_cast<std::size_t>(header.width);
    RowSource row;
    for (std::size_t p = 0; p < planes.tiffs.size(); ++p) {
        planes.buffers[p].resize(static_cast<std::size_t>(TIFFScanlineSize64(planes.tiffs[p].get())));
        row.planes.push_back(planes.buffers[p].data());
        const std::size_t samples = reader.layout().separate ? 1 : reader.layout().samples;
        if (planes.buffers[p].size() < (width * samples * reader.layout().bits + 7) / 8) {
            throwDamaged(ImageFormat::Tiff, "its rows are shorter than its width");
        }
    }
    row.count = width;
    for (std::size_t y = 0; y < static_cast<std::size_t>(header.height); ++y) {
        for (std::size_t p = 0; p < planes.tiffs.size(); ++p) {
            const int result = TIFFReadScanline(planes.tiffs[p].get(), planes.buffers[p].data(),
                                                static_cast<std::uint32_t>(y), planes.samples[p]);
            planes.tiffs[p].checkErrors();
            if (result != 1) {
                throwDamaged(ImageFormat::Tiff, "row " + std::to_string(y) + " cannot be decoded");
            }
        }
        row.first = y * width;
        reader.put(row);
    }
}

template <class Reader>
void readTiles(Planes& planes, Reader& reader, const ImageHeader& header)
{
    const auto width = static_cast<std::size_t>(header.width);
    const auto height = static_cast<std::size_t>(header.height);
    const std::size_t tile_width = field<std::uint32_t>(planes.tiffs[0].get(), TIFFTAG_TILEWIDTH, 0);
    const std::size_t tile_height = field<std::uint32_t>(planes.tiffs[0].get(), TIFFTAG_TILELENGTH, 0);
    // Writers use up to 1024; a tile much larger than the image it belongs to is a bomb.
    constexpr std::size_t kLargeTile = std::size_t{1} << 22;
    if (tile_width == 0 || tile_height == 0 || tile_width > std::max(kLargeTile, width * height) / tile_height) {
        throwDamaged(ImageFormat::Tiff,
                     "tiles of " + std::to_string(tile_width) + " x " + std::to_string(tile_height) + " pixels");
    }
    const std::size_t samples = reader.layout().separate ? 1 : reader.layout().samples;
    const auto row_bytes = static_cast<std::size_t>(TIFFTileRowSize64(planes.tiffs[0].get()));
    for (std::size_t p = 0; p < planes.tiffs.size(); ++p) {
        planes.buffers[p].resize(static_cast<std::size_t>(TIFFTileSize64(planes.tiffs[p].get())));
        if (row_bytes < (tile_width * samples * reader.layout().bits + 7) / 8 ||
            planes.buffers[p].size() < row_bytes * tile_height) {
            throwDamaged(ImageFormat::Tiff, "its tiles are smaller than their size");
        }
    }
    RowSource row;
    row.planes.resize(planes.tiffs.size());
    for (std::size_t y0 = 0; y0 < height; y0 += tile_height) {
        for (std::size_t x0 = 0; x0 < width; x0 += tile_width) {
            for (std::size_t p = 0; p < planes.tiffs.size(); ++p) {
                const auto result =
                    TIFFReadTile(planes.tiffs[p].get(), planes.buffers[p].data(), static_cast<std::uint32_t>(x0),
                                 static_cast<std::uint32_t>(y0), 0, planes.samples[p]);
                planes.tiffs[p].checkErrors();
                if (result < 0) {
                    throwDamaged(ImageFormat::Tiff, "a tile cannot be decoded");
                }
            }
            row.count = std::min(tile_width, width - x0);
            for (std::size_t y = y0; y < std::min(y0 + tile_height, height); ++y) {
                for (std::size_t p = 0; p < planes.tiffs.size(); ++p) {
                    row.planes[p] = planes.buffers[p].data() + (y - y0) * row_bytes;
                }
                row.first = y * width + x0;
                reader.put(row);
            }
        }
    }
}

template <class Reader>
void readPixels(Planes& planes, Reader& reader, const ImageHeader& header)
{
    planes.buffers.resize(planes.tiffs.size());
    planes.tiffs[0].checkErrors();
    if (TIFFIsTiled(planes.tiffs[0].get()) != 0) {
        readTiles(planes, reader, header);
    } else {
        readStrips(planes, reader, header);
    }
}

/// A handle on a file whose size is its header's and whose compression is known.
Tiff openChecked(std::span<const std::byte> encoded, const ImageHeader& header)
{
    Tiff opened = openTiff(encoded, pixelsOf(header));
    TIFF* tiff = opened.get();
    if (field<std::uint32_t>(tiff, TIFFTAG_IMAGEWIDTH, 0) != static_cast<std::uint32_t>(header.width) ||
        field<std::uint32_t>(tiff, TIFFTAG_IMAGELENGTH, 0) != static_cast<std::uint32_t>(header.height)) {
        throwDamaged(ImageFormat::Tiff, "it names two sizes");
    }
    const auto compression = field<std::uint16_t>(tiff, TIFFTAG_COMPRESSION, COMPRESSION_NONE);
    if (TIFFIsCODECConfigured(compression) != 1) {
        throwUnsupported(ImageFormat::Tiff, "compression " + std::to_string(compression));
    }
    return opened;
}

/// A number of IEEE 754's binary16.
float halfToFloat(std::uint16_t half)
{
    const int exponent = half >> 10 & 0x1f;
    const int fraction = half & 0x3ff;
    const float sign = (half & 0x8000) != 0 ? -1.0F : 1.0F;
    if (exponent == 0x1f) {
        return fraction == 0 ? sign * std::numeric_limits<float>::infinity() : std::numeric_limits<float>::quiet_NaN();
    }
    return exponent == 0 ? sign * std::ldexp(static_cast<float>(fraction), -24)
                         : sign * std::ldexp(static_cast<float>(fraction + 0x400), exponent - 25);
}

template <class Number>
Number numberAt(const std::uint8_t* row, std::size_t index)
{
    Number number;
    std::memcpy(&number, row + sizeof number * index, sizeof number);  // libtiff has brought it into our order
    return number;
}

/// The nearest float; infinity beyond its range.
float narrowed(double number)
{
    constexpr auto kMost = static_cast<double>(std::numeric_limits<float>::max());
    return std::abs(number) > kMost ? static_cast<float>(std::copysign(std::numeric_limits<double>::infinity(), number))
                                    : static_cast<float>(number);
}

class FloatReader {
public:
    FloatReader(Layout layout, FloatImage& image) : layout_(std::move(layout)), image_(image) {}

    [[nodiscard]] const Layout& layout() const { return layout_; }

    void put(const RowSource& row)
    {
        const std::uint8_t* from = row.planes[0];
        float* to = image_.samples.data() + row.first;
        for (std::size_t i = 0; i < row.count; ++i) {
            to[i] = layout_.bits == 16   ? halfToFloat(numberAt<std::uint16_t>(from, i))
                    : layout_.bits == 32 ? numberAt<float>(from, i)
                                         : narrowed(numberAt<double>(from, i));
        }
    }

private:
    Layout layout_;
    FloatImage& image_;
};

}  // namespace

Image decodeTiff(std::span<const std::byte> encoded, const ImageHeader& header)
{
    Planes planes;
    planes.tiffs.push_back(openChecked(encoded, header));
    const Layout layout = readLayout(planes.tiffs[0].get(), encoded);
    if (layout.separate) {
        planes.samples = layout.used;
        while (planes.tiffs.size() < planes.samples.size()) {
            planes.tiffs.push_back(openTiff(encoded, pixelsOf(header)));
        }
    } else {
        planes.samples = {0};
    }
    Image image = blankImage(header, layout.has_alpha);
    image.premultiplied = layout.premultiplied;
    RowReader reader(layout, image);
    readPixels(planes, reader, header);
    return image;
}

bool isFloatTiff(std::span<const std::byte> encoded)
{
    return tiffField(encoded, TIFFTAG_SAMPLEFORMAT) == SAMPLEFORMAT_IEEEFP &&
           tiffField(encoded, TIFFTAG_SAMPLESPERPIXEL).value_or(1) == 1;
}

FloatImage decodeFloatTiff(std::span<const std::byte> encoded, const ImageHeader& header)
{
    Planes planes;
    planes.tiffs.push_back(openChecked(encoded, header));
    planes.samples = {0};
    Layout layout;
    layout.bits = field<std::uint16_t>(planes.tiffs[0].get(), TIFFTAG_BITSPERSAMPLE, 1);
    if (layout.bits != 16 && layout.bits != 32 && layout.bits != 64) {
        throwUnsupported(ImageFormat::Tiff, "floating-point samples of " + std::to_string(layout.bits) + " bits");
    }
    FloatImage image{header.width, header.height, std::vector<float>(pixelsOf(header))};
    FloatReader reader(layout, image);
    readPixels(planes, reader, header);
    return image;
}

}  // namespace droplet
