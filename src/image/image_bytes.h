// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "droplet/error.h"
#include "droplet/printable.h"
#include "image/image_header.h"

namespace droplet {

/// Throws the error for an image that breaks its format's rules or ends before its pixels do. `detail` may
/// quote the file.
[[noreturn]] inline void throwDamaged(ImageFormat format, std::string_view detail,
                                      std::string_view judgement = "truncated or damaged")
{
    throw Error(ErrorCode::InvalidInput, std::string(judgement) + " " + name(format) + " image: " + printable(detail));
}

/// Throws the error for an intact image of a kind that is not supported.
[[noreturn]] inline void throwUnsupported(ImageFormat format, const std::string& detail)
{
    throw Error(ErrorCode::InvalidInput, std::string("unsupported ") + name(format) + " image: " + detail);
}

/// Reads numbers in a file with checked bounds; reading past the end throws.
class ByteView {
public:
    ByteView(std::span<const std::byte> bytes, ImageFormat format) : bytes_(bytes), format_(format) {}

    [[nodiscard]] std::size_t size() const { return bytes_.size(); }
    [[nodiscard]] bool has(std::size_t offset, std::size_t count) const
    {
        return offset <= bytes_.size() && count <= bytes_.size() - offset;
    }
    [[nodiscard]] bool startsWith(std::string_view text, std::size_t offset = 0) const
    {
        for (std::size_t i = 0; i < text.size(); ++i) {
            if (!has(offset, i + 1) || bytes_[offset + i] != static_cast<std::byte>(text[i])) {
                return false;
            }
        }
        return true;
    }
    [[nodiscard]] std::uint32_t u8(std::size_t offset) const
    {
        if (!has(offset, 1)) {
            throwDamaged(format_, "it ends too early");
        }
        return std::to_integer<std::uint32_t>(bytes_[offset]);
    }
    [[nodiscard]] std::uint32_t le16(std::size_t offset) const { return u8(offset) | u8(offset + 1) << 8; }
    [[nodiscard]] std::uint32_t le32(std::size_t offset) const { return le16(offset) | le16(offset + 2) << 16; }
    [[nodiscard]] std::uint32_t be16(std::size_t offset) const { return u8(offset) << 8 | u8(offset + 1); }
    [[nodiscard]] std::uint32_t be32(std::size_t offset) const { return be16(offset) << 16 | be16(offset + 2); }

private:
    std::span<const std::byte> bytes_;
    ImageFormat format_;
};

}  // namespace droplet
