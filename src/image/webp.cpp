// SPDX-License-Identifier: GPL-3.0-or-later
// After: WebP Container Specification. OpenCV 4.6 decodes no animations, so the first picture of one becomes a file of
// its own.
#include <cstdint>
#include <string_view>

#include "image/codecs.h"
#include "image/image_bytes.h"

namespace droplet {
namespace {

constexpr std::size_t kChunkHead = 8;

void append(std::vector<std::byte>& bytes, std::string_view text)
{
    for (const char c : text) {
        bytes.push_back(static_cast<std::byte>(c));
    }
}

void append(std::vector<std::byte>& bytes, std::uint32_t value, int count)
{
    for (int k = 0; k < count; ++k) {
        bytes.push_back(static_cast<std::byte>(value >> (8 * k) & 255U));
    }
}

std::uint32_t le24(const ByteView& view, std::size_t at)
{
    return view.le16(at) | view.u8(at + 2) << 16;
}

/// Calls take(offset, length) with the data of each chunk until it returns true.
template <typename Take>
bool findChunk(const ByteView& view, std::size_t at, const Take& take)
{
    while (view.has(at, kChunkHead)) {
        const std::size_t length = view.le32(at + 4);
        if (take(at, length)) {
            return true;
        }
        at += kChunkHead + length + length % 2;
    }
    return false;
}

/// File of the picture in an animation's frame.
std::vector<std::byte> fileOf(std::span<const std::byte> frame, std::uint32_t width, std::uint32_t height)
{
    const ByteView view(frame, ImageFormat::Webp);
    std::vector<std::byte> chunks;
    bool has_alpha = false;
    findChunk(view, 0, [&](std::size_t at, std::size_t length) {
        const bool is_alpha = view.startsWith("ALPH", at);
        const bool is_picture = view.startsWith("VP8 ", at) || view.startsWith("VP8L", at);
        if (is_alpha || is_picture) {
            const std::size_t size = kChunkHead + length;
            if (!view.has(at, size)) {
                throwDamaged(ImageFormat::Webp, "its first picture ends too early");
            }
            const auto chunk = frame.subspan(at, size);
            chunks.insert(chunks.end(), chunk.begin(), chunk.end());
            chunks.resize(chunks.size() + length % 2);
        }
        has_alpha = has_alpha || is_alpha;
        return is_picture;
    });
    std::vector<std::byte> file;
    constexpr std::uint32_t kExtended = 18;
    append(file, "RIFF");
    append(file, static_cast<std::uint32_t>(4 + (has_alpha ? kExtended : 0) + chunks.size()), 4);
    append(file, "WEBP");
    if (has_alpha) {
        append(file, "VP8X");
        append(file, 10, 4);
        append(file, 0x10, 4);
        append(file, width - 1, 3);
        append(file, height - 1, 3);
    }
    file.insert(file.end(), chunks.begin(), chunks.end());
    return file;
}

}  // namespace

std::optional<WebpFrame> firstWebpFrame(std::span<const std::byte> encoded)
{
    constexpr std::size_t kFirstChunk = 12;
    constexpr std::size_t kFrameHead = 16;
    constexpr std::uint32_t kAnimated = 0x02;
    const ByteView view(encoded, ImageFormat::Webp);
    if (!view.startsWith("VP8X", kFirstChunk) || (view.u8(kFirstChunk + kChunkHead) & kAnimated) == 0) {
        return std::nullopt;
    }
    WebpFrame frame;
    frame.canvas.width = static_cast<int>(le24(view, 24) + 1);
    frame.canvas.height = static_cast<int>(le24(view, 27) + 1);
    const bool is_found = findChunk(view, kFirstChunk, [&](std::size_t at, std::size_t length) {
        if (!view.startsWith("ANMF", at)) {
            return false;
        }
        const std::size_t data = at + kChunkHead;
        if (length < kFrameHead || !view.has(data, length)) {
            throwDamaged(ImageFormat::Webp, "its first picture ends too early");
        }
        frame.canvas.x = static_cast<int>(2 * le24(view, data));
        frame.canvas.y = static_cast<int>(2 * le24(view, data + 3));
        frame.file = fileOf(encoded.subspan(data + kFrameHead, length - kFrameHead), le24(view, data + 6) + 1,
                            le24(view, data + 9) + 1);
        return true;
    });
    if (!is_found) {
        throwDamaged(ImageFormat::Webp, "it has no picture");
    }
    return frame;
}

}  // namespace droplet
