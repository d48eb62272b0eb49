// SPDX-License-Identifier: GPL-3.0-or-later
// After: Truevision TGA File Format Specification, version 2.0 (1991).
#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "image/codecs.h"
#include "image/image_bytes.h"

namespace droplet {
namespace {

constexpr std::size_t kHeader = 18;
constexpr std::uint32_t kRunLengths = 8;  ///< bit of the image type
constexpr std::uint32_t kPalette = 1;
constexpr std::uint32_t kGrey = 3;

using Rgba = std::array<std::uint8_t, 4>;

/// Colour of 16, 24 or 32 bits; 15 and 16 bits have 5 for each sample.
Rgba colourOf(std::uint32_t bits, std::uint32_t value)
{
    if (bits > 16) {
        return {static_cast<std::uint8_t>(value >> 16), static_cast<std::uint8_t>(value >> 8),
                static_cast<std::uint8_t>(value), static_cast<std::uint8_t>(value >> 24)};
    }
    const auto sample = [&](unsigned shift) {
        return static_cast<std::uint8_t>(((value >> shift & 31U) * 255 + 15) / 31);
    };
    return {sample(10), sample(5), sample(0), static_cast<std::uint8_t>((value >> 15 & 1U) * 255)};
}

std::uint32_t valueAt(const ByteView& view, std::size_t at, std::size_t bytes)
{
    std::uint32_t value = 0;
    for (std::size_t k = 0; k < bytes; ++k) {
        value |= view.u8(at + k) << (8 * k);
    }
    return value;
}

/// Stored values of all pixels.
std::vector<std::uint32_t> valuesOf(const ByteView& view, std::size_t at, std::size_t bytes, std::size_t count)
{
    const bool has_runs = (view.u8(2) & kRunLengths) != 0;
    if (!has_runs && !view.has(at, bytes * count)) {
        throwDamaged(ImageFormat::Tga, "it ends before its pixels do");
    }
    std::vector<std::uint32_t> values;
    values.reserve(count);
    while (values.size() < count) {
        const std::uint32_t packet = has_runs ? view.u8(at++) : 0;
        const std::size_t length = std::min<std::size_t>(count - values.size(), (packet & 127U) + 1);
        const bool repeats = packet > 127;
        for (std::size_t k = 0; k < (repeats ? 1 : length); ++k, at += bytes) {
            values.push_back(valueAt(view, at, bytes));
        }
        values.resize(values.size() + (repeats ? length - 1 : 0), values.back());
    }
    return values;
}

}  // namespace

Image decodeTga(std::span<const std::byte> encoded, const DecodeOptions& options)
{
    const ByteView view(encoded, ImageFormat::Tga);
    const std::uint32_t kind = view.u8(2) & ~kRunLengths;
    const std::uint32_t bits = view.u8(16);
    const std::uint32_t descriptor = view.u8(17);
    const auto columns = std::size_t{view.le16(12)};
    const auto rows = std::size_t{view.le16(14)};
    checkSize(ImageFormat::Tga, columns, rows, options.max_pixels);
    std::size_t at = kHeader + view.u8(0);
    std::vector<Rgba> palette;
    const std::uint32_t first = view.le16(3);
    if (kind == kPalette) {
        const std::uint32_t entry_bits = view.u8(7);
        if (entry_bits != 15 && entry_bits != 16 && entry_bits != 24 && entry_bits != 32) {
            throwDamaged(ImageFormat::Tga, "its palette has " + std::to_string(entry_bits) + " bits per colour");
        }
        const std::size_t entry = (entry_bits + 7) / 8;
        for (std::uint32_t k = 0; k < view.le16(5); ++k, at += entry) {
            palette.push_back(colourOf(entry_bits, valueAt(view, at, entry)));
        }
    }
    const std::vector<std::uint32_t> values = valuesOf(view, at, (bits + 7) / 8, columns * rows);
    const auto colour = [&](std::uint32_t value) -> Rgba {
        if (kind == kPalette) {
            return value >= first && value - first < palette.size() ? palette[value - first] : Rgba{0, 0, 0, 255};
        }
        if (kind == kGrey) {
            const auto grey = static_cast<std::uint8_t>(value);
            return {grey, grey, grey, static_cast<std::uint8_t>(value >> 8)};
        }
        return colourOf(bits, value);
    };
    // Many files of 32 bits have a fourth sample without a meaning, which is the same everywhere.
    const std::uint32_t alpha_bits = descriptor & 15U;
    const bool has_alpha = alpha_bits > 0 && std::any_of(values.begin(), values.end(), [&](std::uint32_t value) {
                               return colour(value)[3] != colour(values.front())[3];
                           });
    Image image = blankImage(
        {ImageFormat::Tga, static_cast<int>(columns), static_cast<int>(rows), 1, options.keeps_colour}, has_alpha);
    const std::size_t channels = has_alpha ? 4 : 3;
    std::vector<std::uint8_t> row(channels * columns);
    const bool is_top_down = (descriptor & 0x20U) != 0;
    const bool is_mirrored = (descriptor & 0x10U) != 0;
    for (std::size_t y = 0; y < rows; ++y) {
        for (std::size_t x = 0; x < columns; ++x) {
            const Rgba pixel = colour(values[y * columns + x]);
            const std::size_t to = is_mirrored ? columns - 1 - x : x;
            std::copy_n(pixel.begin(), channels, row.begin() + static_cast<std::ptrdiff_t>(channels * to));
        }
        const std::size_t to = is_top_down ? y : rows - 1 - y;
        putPixels(image, {to * columns, 1, static_cast<int>(channels)}, std::span<const std::uint8_t>(row));
    }
    return image;
}

}  // namespace droplet
