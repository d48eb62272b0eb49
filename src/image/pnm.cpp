// SPDX-License-Identifier: GPL-3.0-or-later
// The Netpbm formats pbm(5), pgm(5), ppm(5), plain and raw; the first image of a file that holds several.
#include <string>

#include "image/codecs.h"
#include "image/image_bytes.h"

namespace droplet {

namespace {

/// The numbers of a plain file, one after the other.
class PlainReader {
public:
    PlainReader(ByteView view, std::size_t at) : view_(view), at_(at) {}

    /// A bit of a plain PBM; these need no space between them.
    std::uint32_t digit()
    {
        skipSpace();
        const std::uint32_t c = view_.u8(at_++);
        if (c != '0' && c != '1') {
            throwDamaged(ImageFormat::Pnm, "a pixel that is neither 0 nor 1");
        }
        return c - '0';
    }

    std::uint32_t number()
    {
        skipSpace();
        const std::size_t first = at_;
        std::uint32_t value = 0;
        for (; view_.has(at_, 1) && view_.u8(at_) >= '0' && view_.u8(at_) <= '9'; ++at_) {
            constexpr std::uint32_t kEnough = 1U << 20;  // above every maximum
            value = value < kEnough ? 10 * value + (view_.u8(at_) - '0') : value;
        }
        if (at_ == first) {
            throwDamaged(ImageFormat::Pnm, "a level that is not a number");
        }
        return value;
    }

private:
    void skipSpace()
    {
        for (std::uint32_t c = view_.u8(at_); c == ' ' || (c >= '\t' && c <= '\r') || c == '#'; c = view_.u8(at_)) {
            while (c == '#' && view_.u8(at_) != '\n') {
                ++at_;
            }
            ++at_;
        }
    }

    ByteView view_;
    std::size_t at_;
};

}  // namespace

Image decodePnm(std::span<const std::byte> encoded, const ImageHeader& header)
{
    const PnmHeader pnm = readPnmHeader(encoded);
    const ByteView view(encoded, ImageFormat::Pnm);
    const bool bits = pnm.kind == 1 || pnm.kind == 4;
    const bool plain = pnm.kind < 4;
    const int channels = pnm.kind % 3 == 0 ? 3 : 1;
    const std::size_t bytes_each = pnm.maximum > 255 ? 2 : 1;
    const auto width = static_cast<std::size_t>(header.width);
    const auto height = static_cast<std::size_t>(header.height);
    const std::size_t row_samples = width * static_cast<std::size_t>(channels);
    const std::size_t row_bytes = pnm.kind == 4 ? (width + 7) / 8 : row_samples * bytes_each;
    // The shortest plain sample is a digit.
    if (!view.has(pnm.payload, height * (plain ? row_samples : row_bytes))) {
        throwDamaged(ImageFormat::Pnm, "it ends too early");
    }

    Image image = blankImage(header, false);
    std::vector<std::uint16_t> row(row_samples);
    PlainReader reader(view, pnm.payload);
    for (std::size_t y = 0; y < height; ++y) {
        const std::size_t at = pnm.payload + y * row_bytes;
        for (std::size_t i = 0; i < row_samples; ++i) {
            if (bits) {
                const std::uint32_t black = plain ? reader.digit() : view.u8(at + i / 8) >> (7 - i % 8) & 1U;
                row[i] = black != 0 ? 0 : 65535;
                continue;
            }
            const std::uint32_t value = plain             ? reader.number()
                                        : bytes_each == 2 ? view.be16(at + 2 * i)
                                                          : view.u8(at + i);
            if (value > pnm.maximum) {
                throwDamaged(ImageFormat::Pnm, "level " + std::to_string(value) + " is above the level of white, " +
                                                   std::to_string(pnm.maximum));
            }
            row[i] = static_cast<std::uint16_t>((value * 65535U + pnm.maximum / 2) / pnm.maximum);
        }
        putPixels(image, {y * width, 1, channels}, std::span<const std::uint16_t>(row));
    }
    return image;
}

}  // namespace droplet
