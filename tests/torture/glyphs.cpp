// SPDX-License-Identifier: GPL-3.0-or-later
// Glyphs rendered by FreeType without hinting, which preserves their outlines.
#include <ft2build.h>
#include FT_FREETYPE_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <stdexcept>

#include "torture/corpus.h"

namespace droplet::torture {
namespace {

constexpr const char* kFont = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";

/// Heights of the em [px], from strokes of one pixel to the size of a logo.
constexpr std::array<FT_UInt, 5> kSizes{16, 28, 50, 90, 160};

/// Dry pixels around the glyph; without any, liquid touches the border.
constexpr std::array<int, 3> kMargins{2, 0, 1};

class Font {
public:
    Font()
    {
        if (FT_Init_FreeType(&library_) != 0 || FT_New_Face(library_, kFont, 0, &face_) != 0) {
            throw std::runtime_error(std::string(kFont) + " cannot be read; it comes with fonts-dejavu-core");
        }
    }
    Font(const Font&) = delete;
    Font& operator=(const Font&) = delete;
    ~Font() { FT_Done_FreeType(library_); }

    [[nodiscard]] std::size_t count() const { return static_cast<std::size_t>(face_->num_glyphs); }

    /// @return the rendered glyph, valid until the next call
    [[nodiscard]] const FT_Bitmap& render(std::size_t glyph, FT_UInt size, bool hard) const
    {
        const FT_Int32 flags =
            FT_LOAD_RENDER | FT_LOAD_NO_HINTING | (hard ? FT_LOAD_TARGET_MONO : FT_LOAD_TARGET_NORMAL);
        if (FT_Set_Pixel_Sizes(face_, 0, size) != 0 || FT_Load_Glyph(face_, static_cast<FT_UInt>(glyph), flags) != 0) {
            throw std::runtime_error("glyph " + std::to_string(glyph) + " cannot be rendered");
        }
        return face_->glyph->bitmap;
    }

    /// For messages: "glyph 36 A".
    [[nodiscard]] std::string name(std::size_t glyph) const
    {
        std::array<char, 64> name{};
        FT_Get_Glyph_Name(face_, static_cast<FT_UInt>(glyph), name.data(), static_cast<FT_UInt>(name.size()));
        return std::to_string(glyph) + "_" + name.data();
    }

private:
    FT_Library library_ = nullptr;
    FT_Face face_ = nullptr;
};

std::uint16_t levelAt(const FT_Bitmap& bitmap, int x, int y)
{
    const unsigned char* row = bitmap.buffer + static_cast<std::ptrdiff_t>(y) * bitmap.pitch;
    if (bitmap.pixel_mode == FT_PIXEL_MODE_MONO) {
        return (row[x / 8] >> (7 - x % 8) & 1) != 0 ? 65535 : 0;
    }
    return static_cast<std::uint16_t>(257 * row[x]);
}

Mask maskOf(const FT_Bitmap& bitmap, int margin)
{
    const auto columns = static_cast<int>(bitmap.width);
    const auto rows = static_cast<int>(bitmap.rows);
    Mask mask;
    // A blank glyph has no pixels, but a picture must have at least one.
    mask.width = std::max(1, columns + 2 * margin);
    mask.height = std::max(1, rows + 2 * margin);
    for (int y = -margin; y < mask.height - margin; ++y) {
        for (int x = -margin; x < mask.width - margin; ++x) {
            const bool inside = x >= 0 && y >= 0 && x < columns && y < rows;
            mask.coverage.push_back(inside ? levelAt(bitmap, x, y) : std::uint16_t{0});
        }
    }
    return mask;
}

Corpus glyphs(const std::string& name, bool hard, std::size_t step)
{
    const auto font = std::make_shared<const Font>();
    return {name, (font->count() + step - 1) / step, [=](std::size_t index) {
                const std::size_t glyph = index * step;
                const FT_UInt size = kSizes[index % kSizes.size()];
                return greymapItem("glyph_" + font->name(glyph) + "_" + std::to_string(size) + "px.pgm",
                                   maskOf(font->render(glyph, size, hard), kMargins[index % kMargins.size()]));
            }};
}

}  // namespace

Corpus smoothGlyphs()
{
    return glyphs("DejaVu Sans", false, 1);
}

Corpus hardGlyphs()
{
    return glyphs("DejaVu Sans, hard", true, 4);
}

}  // namespace droplet::torture
