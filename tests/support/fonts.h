// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ft2build.h>

#include FT_FREETYPE_H
#include FT_OUTLINE_H

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include "droplet/mask/mask.h"
#include "droplet/type/font.h"
#include "droplet/vector.h"
#include "support/paths.h"

namespace droplet::testing {

inline constexpr const char* kSans = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
inline constexpr const char* kSerif = "/usr/share/fonts/truetype/dejavu/DejaVuSerif.ttf";
/// Squares and discs with colour layers, made by tests/type/make_colour_font.py.
inline std::string colourFont()
{
    return inSource("tests/type/colour.ttf");
}
inline constexpr const char* kVariable = "/usr/share/fonts/truetype/inter-vf/Inter.var.ttf";

inline std::vector<std::byte> bytesOf(const char* path)
{
    std::ifstream file(path, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    if (text.empty()) {
        throw std::runtime_error(std::string(path) + " cannot be read; scripts/setup test installs it");
    }
    const auto* first = reinterpret_cast<const std::byte*>(text.data());
    return {first, first + text.size()};
}

/// Unhinted glyphs of a font, drawn by FreeType's rasteriser.
class RenderedFont {
public:
    RenderedFont(const char* path, unsigned pixels_per_em)
    {
        if (FT_Init_FreeType(&library_) != 0 || FT_New_Face(library_, path, 0, &face_) != 0 ||
            FT_Set_Pixel_Sizes(face_, 0, pixels_per_em) != 0) {
            throw std::runtime_error(std::string(path) + " cannot be read");
        }
    }
    RenderedFont(const RenderedFont&) = delete;
    RenderedFont& operator=(const RenderedFont&) = delete;
    ~RenderedFont() { FT_Done_FreeType(library_); }

    /// The glyph with a dry margin of one pixel; coverage by the non-zero rule.
    [[nodiscard]] Mask operator()(GlyphId glyph) const
    {
        // With the flag the rasteriser samples 16 points per pixel; otherwise it adds the areas of all contours.
        bool good = FT_Load_Glyph(face_, glyph, FT_LOAD_NO_HINTING | FT_LOAD_NO_BITMAP) == 0;
        face_->glyph->outline.flags |= FT_OUTLINE_OVERLAP;
        good = good && FT_Render_Glyph(face_->glyph, FT_RENDER_MODE_NORMAL) == 0;
        if (!good) {
            throw std::runtime_error("glyph " + std::to_string(glyph) + " cannot be rendered");
        }
        const FT_Bitmap& bitmap = face_->glyph->bitmap;
        Mask mask;
        mask.width = static_cast<int>(bitmap.width) + 2;
        mask.height = static_cast<int>(bitmap.rows) + 2;
        mask.coverage.assign(static_cast<std::size_t>(mask.width) * static_cast<std::size_t>(mask.height), 0);
        for (int y = 0; y < mask.height - 2; ++y) {
            for (int x = 0; x < mask.width - 2; ++x) {
                mask.coverage[static_cast<std::size_t>((y + 1) * mask.width + x + 1)] =
                    static_cast<std::uint16_t>(257 * bitmap.buffer[y * bitmap.pitch + x]);
            }
        }
        return mask;
    }

    /// Exact area inside the glyph's curves by Green's formula, if contours do not overlap [em²].
    [[nodiscard]] double exactArea(GlyphId glyph) const
    {
        if (FT_Load_Glyph(face_, glyph, FT_LOAD_NO_HINTING | FT_LOAD_NO_BITMAP) != 0) {
            throw std::runtime_error("glyph " + std::to_string(glyph) + " cannot be read");
        }
        Green green;
        const FT_Outline_Funcs pen{
            [](const FT_Vector* to, void* user) { return static_cast<Green*>(user)->move(at(to)); },
            [](const FT_Vector* to, void* user) { return static_cast<Green*>(user)->line(at(to)); },
            [](const FT_Vector* control, const FT_Vector* to, void* user) {
                return static_cast<Green*>(user)->conic(at(control), at(to));
            },
            [](const FT_Vector* first, const FT_Vector* second, const FT_Vector* to, void* user) {
                return static_cast<Green*>(user)->cubic(at(first), at(second), at(to));
            },
            0,
            0};
        FT_Outline_Decompose(&face_->glyph->outline, &pen, &green);
        const double em = 64.0 * face_->size->metrics.y_ppem;
        return std::abs(green.area) / (em * em);
    }

private:
    static Vec2 at(const FT_Vector* p) { return {static_cast<double>(p->x), static_cast<double>(p->y)}; }

    /// The integral of x dy − y dx over 2, piece by piece.
    struct Green {
        double area = 0.0;
        Vec2 pen;

        int move(Vec2 to)
        {
            pen = to;
            return 0;
        }
        int line(Vec2 to)
        {
            area += 0.5 * cross(pen, to);
            return move(to);
        }
        int conic(Vec2 a, Vec2 to)
        {
            area += (2.0 * cross(pen, a) + 2.0 * cross(a, to) + cross(pen, to)) / 6.0;
            return move(to);
        }
        int cubic(Vec2 a, Vec2 b, Vec2 to)
        {
            area += (6.0 * cross(pen, a) + 3.0 * cross(pen, b) + cross(pen, to) + 3.0 * cross(a, b) +
                     3.0 * cross(a, to) + 6.0 * cross(b, to)) /
                    20.0;
            return move(to);
        }
    };

    FT_Library library_ = nullptr;
    FT_Face face_ = nullptr;
};

}  // namespace droplet::testing
