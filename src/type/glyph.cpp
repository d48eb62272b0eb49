// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/type/glyph.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <utility>

#include "droplet/error.h"
#include "number_text.h"
#include "type/contour_union.h"
#include "type/flatten.h"
#include "type/font_face.h"
#include "type/text_layout.h"
#include "utf8.h"

namespace droplet {
namespace {

/// Default tolerance of curves [em]. With a fiftieth of it, droplets of 5000 triangles change by at most 0.1 % in
/// volume, and their normals by 0.1° rms.
constexpr double kTolerance = 1.0 / 20'000.0;

/// Largest distance between points of an outline [em]: meshing reads the detail of a loop from the spacing of its
/// points.
constexpr double kSpacing = 1.0 / 256.0;

/// Smallest turn at a corner, as in traced outlines; pieces of curves turn by about 10° at most.
constexpr double kCornerTurn = 25.0 * std::numbers::pi / 180.0;

void requirePositive(double value, const char* name)
{
    if (!(value > 0.0 && std::isfinite(value))) {
        throw Error(ErrorCode::InvalidArgument, std::string(name) + " is " + numberText(value) + ", must be > 0");
    }
}

void requireGlyph(const Font& font, GlyphId glyph)
{
    if (glyph >= font.glyphCount()) {
        throw Error(ErrorCode::InvalidArgument, "glyph " + std::to_string(glyph) + " must be less than " +
                                                    std::to_string(font.glyphCount()) +
                                                    ", the font's number of glyphs");
    }
}

Flatness flatnessOf(const GlyphOptions& options)
{
    constexpr double kFinest = 0x1p-26;  // points are rounded to this
    return {options.tolerance ? std::max(*options.tolerance / options.em, kFinest) : kTolerance, kSpacing};
}

/// Loop with its corners; straight sides are divided.
Loop loopOf(const Contour& contour, double em)
{
    Loop loop;
    const std::size_t n = contour.size();
    for (std::size_t i = 0; i < n; ++i) {
        const Vec2 here = contour[i];
        const Vec2 before = here - contour[(i + n - 1) % n];
        const Vec2 after = contour[(i + 1) % n] - here;
        const double turn = std::abs(std::atan2(cross(before, after), dot(before, after)));
        const auto count = static_cast<std::size_t>(std::ceil(length(after) / kSpacing));
        for (std::size_t k = 0; k < count; ++k) {
            loop.points.push_back(em * (here + (static_cast<double>(k) / static_cast<double>(count)) * after));
            loop.corner.push_back(k == 0 && turn > kCornerTurn ? 1 : 0);
        }
    }
    return loop;
}

/// Rectangle in ems.
struct Box {
    Vec2 low;
    Vec2 high;
};

/// Outline in metres around the middle of a box, which grows equally on opposite sides to contain the loops.
Outline outlineOf(const United& united, const Box& box, double em)
{
    const Vec2 middle = 0.5 * (box.low + box.high);
    Vec2 half = 0.5 * (box.high - box.low);
    Outline outline;
    outline.specks_dropped = united.specks;
    for (Contour loop : united.loops) {
        for (Vec2& p : loop) {
            p = p - middle;
            half = {std::max(half.x, std::abs(p.x)), std::max(half.y, std::abs(p.y))};
        }
        outline.loops.push_back(loopOf(loop, em));
    }
    outline.extent = 2.0 * em * half;
    return outline;
}

/// Splits a text into its lines.
std::vector<std::u32string> linesOf(std::string_view text)
{
    std::vector<std::u32string> lines(1);
    for (const char32_t c : decodeUtf8(text, "the text")) {
        if (c == '\n') {
            lines.emplace_back();
        } else if (c != '\r') {
            lines.back() += c == '\t' ? U' ' : c;
        }
    }
    return lines;
}

double startOf(const TextLine& line, double width, TextAlign align)
{
    const double room = width - line.advance;
    switch (align) {
        case TextAlign::Start:
            return line.leftward ? room : 0.0;
        case TextAlign::Centre:
            return 0.5 * room;
        case TextAlign::End:
            break;
    }
    return line.leftward ? 0.0 : room;
}

/// Draws glyphs and unites their contours; each glyph once.
class Drawer {
public:
    Drawer(const FontFace& face, const Flatness& flatness) : face_(face), flatness_(flatness) {}

    const std::vector<Contour>& operator()(GlyphId glyph)
    {
        const auto [place, is_new] = drawn_.try_emplace(glyph);
        if (is_new) {
            place->second = unite(face_.draw(glyph, flatness_).contours, 0.0).loops;
        }
        return place->second;
    }

private:
    const FontFace& face_;
    Flatness flatness_;
    std::map<GlyphId, std::vector<Contour>> drawn_;
};

}  // namespace

void GlyphOptions::validate() const
{
    requirePositive(em, "em");
    if (tolerance) {
        requirePositive(*tolerance, "tolerance");
    }
    if (!(speck_size >= 0.0 && std::isfinite(speck_size))) {
        throw Error(ErrorCode::InvalidArgument, "speck_size is " + numberText(speck_size) + ", must be ≥ 0");
    }
}

void TextOptions::validate() const
{
    glyph.validate();
    requirePositive(line_spacing, "line_spacing");
}

Outline glyphOutline(const Font& font, GlyphId glyph, const GlyphOptions& options)
{
    options.validate();
    requireGlyph(font, glyph);
    const FontFace& face = font.face();
    const DrawnGlyph drawn = face.draw(glyph, flatnessOf(options));
    const Box box{{std::min(0.0, drawn.advance), face.lines().descender},
                  {std::max(0.0, drawn.advance), face.lines().ascender}};
    return outlineOf(unite(drawn.contours, options.speck_size), box, options.em);
}

bool hasInk(const Font& font, GlyphId glyph, const GlyphOptions& options)
{
    requireGlyph(font, glyph);
    constexpr Flatness kCoarse{0.1, 10.0};
    const DrawnGlyph drawn = font.face().draw(glyph, kCoarse);
    if (drawn.contours.empty()) {
        return false;
    }
    double area = 0.0;
    for (const Contour& contour : drawn.contours) {
        for (std::size_t i = 0; i < contour.size(); ++i) {
            area += 0.5 * cross(contour[i], contour[(i + 1) % contour.size()]);
        }
    }
    // A large signed area proves that there is ink; a small one needs the union.
    constexpr double kMuch = 1e-3;
    return std::abs(area) > std::max(kMuch, 1e3 * options.speck_size) ||
           !glyphOutline(font, glyph, options).loops.empty();
}

TextLayout layOutText(const Font& font, std::string_view text, const TextOptions& options)
{
    options.validate();
    const FontFace& face = font.face();
    const std::vector<std::u32string> texts = linesOf(text);
    TextLayout result;
    result.lines = texts.size();
    std::vector<TextLine> lines;
    double width = 0.0;
    for (const std::u32string& line : texts) {
        TextLine laid_out = layOutLine(face, line);
        // Glyph 0 replaces characters that the font lacks.
        for (const ShapedGlyph& glyph : laid_out.glyphs) {
            const char32_t character = line[glyph.character];
            if (glyph.glyph == 0) {
                laid_out.advance -= glyph.advance;
                if (std::find(result.missing.begin(), result.missing.end(), character) == result.missing.end()) {
                    result.missing.push_back(character);
                }
            }
        }
        std::erase_if(laid_out.glyphs, [](const ShapedGlyph& glyph) { return glyph.glyph == 0; });
        width = std::max(width, laid_out.advance);
        lines.push_back(std::move(laid_out));
    }

    Drawer drawer(face, flatnessOf(options.glyph));
    std::vector<Contour> contours;
    const double pitch = options.line_spacing * face.lines().pitch;
    Vec2 pen;
    for (const TextLine& line : lines) {
        pen.x = startOf(line, width, options.align);
        for (const ShapedGlyph& glyph : line.glyphs) {
            for (Contour contour : drawer(glyph.glyph)) {
                for (Vec2& p : contour) {
                    p = p + pen + glyph.offset;
                }
                contours.push_back(std::move(contour));
            }
            pen.x += glyph.advance;
        }
        pen.y -= pitch;
    }
    const double last = -pitch * static_cast<double>(lines.size() - 1);
    const Box box{{0.0, last + face.lines().descender}, {width, face.lines().ascender}};
    result.outline = outlineOf(unite(contours, options.glyph.speck_size), box, options.glyph.em);
    return result;
}

}  // namespace droplet
