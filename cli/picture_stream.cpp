// SPDX-License-Identifier: GPL-3.0-or-later
// PNG: ISO/IEC 15948, section 5. PNM: the netpbm formats pgm(5) and ppm(5).
#include "picture_stream.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <istream>
#include <string>
#include <string_view>

#include "droplet/error.h"

namespace cli {
namespace {

using droplet::Error;
using droplet::ErrorCode;

constexpr std::size_t kMaxBytes = std::size_t{1} << 30;

constexpr std::string_view kPngSignature = "\x89PNG\r\n\x1a\n";

}  // namespace

void PictureStream::take(std::vector<std::byte>& picture, std::size_t count)
{
    if (count > kMaxBytes - picture.size()) {
        throw Error(ErrorCode::InvalidInput, "the picture has more than a gigabyte");
    }
    // In parts, so that a wrong length allocates no more than there is.
    constexpr std::size_t kPart = std::size_t{1} << 20;
    while (count > 0) {
        const std::size_t part = std::min(count, kPart);
        const std::size_t begin = picture.size();
        picture.resize(begin + part);
        in_.read(reinterpret_cast<char*>(picture.data() + begin), static_cast<std::streamsize>(part));
        if (in_.gcount() != static_cast<std::streamsize>(part)) {
            throw Error(ErrorCode::InvalidInput, "the picture is cut off");
        }
        count -= part;
    }
}

void PictureStream::takePng(std::vector<std::byte>& picture)
{
    take(picture, kPngSignature.size() - picture.size());
    if (std::string_view(reinterpret_cast<const char*>(picture.data()), picture.size()) != kPngSignature) {
        throw Error(ErrorCode::InvalidInput, "is neither PNG nor binary PGM or PPM");
    }
    for (;;) {
        const std::size_t chunk = picture.size();
        take(picture, 8);
        std::size_t size = 0;
        for (std::size_t k = 0; k < 4; ++k) {
            size = size * 256 + std::to_integer<std::size_t>(picture[chunk + k]);
        }
        const std::string name(reinterpret_cast<const char*>(picture.data() + chunk + 4), 4);
        take(picture, size + 4);
        if (name == "IEND") {
            return;
        }
    }
}

void PictureStream::takePnm(std::vector<std::byte>& picture)
{
    // Width, height and greatest level, between white space and comments.
    std::array<std::size_t, 3> numbers{};
    for (std::size_t& number : numbers) {
        std::string digits;
        for (;;) {
            take(picture, 1);
            const auto c = static_cast<char>(picture.back());
            if (c == '#') {
                do {
                    take(picture, 1);
                } while (static_cast<char>(picture.back()) != '\n');
            } else if (std::isdigit(static_cast<unsigned char>(c)) != 0 && digits.size() < 9) {
                digits += c;
            } else if (std::isspace(static_cast<unsigned char>(c)) == 0) {
                throw Error(ErrorCode::InvalidInput, "the picture's header is damaged");
            } else if (!digits.empty()) {
                break;
            }
        }
        number = std::stoul(digits);
    }
    const std::size_t channels = static_cast<char>(picture[1]) == '6' ? 3 : 1;
    const std::size_t bytes = channels * (numbers[2] > 255 ? 2 : 1);
    if (numbers[0] == 0 || numbers[1] == 0 || numbers[0] > kMaxBytes / bytes / numbers[1]) {
        throw Error(ErrorCode::InvalidInput, "the picture is empty, or has more than a gigabyte");
    }
    take(picture, numbers[0] * numbers[1] * bytes);
}

std::optional<std::vector<std::byte>> PictureStream::next()
{
    const int first = in_.get();
    if (first == std::istream::traits_type::eof()) {
        return std::nullopt;
    }
    std::vector<std::byte> picture{static_cast<std::byte>(first)};
    if (first != 'P') {
        takePng(picture);
        return picture;
    }
    take(picture, 1);
    const auto kind = static_cast<char>(picture[1]);
    if (kind == '7') {
        throw Error(ErrorCode::InvalidInput, "is PAM, which is not read; PNG and binary PGM and PPM are");
    }
    if (kind != '5' && kind != '6') {
        throw Error(ErrorCode::InvalidInput, "is neither PNG nor binary PGM or PPM");
    }
    takePnm(picture);
    return picture;
}

}  // namespace cli
