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
#include "require.h"
#include "type/contour_union.h"
#include "type/flatten.h"
#include "type/font_face.h"
#include "type/glyph_frame.h"
#include "type/text_layout.h"

namespace droplet {
namespace {

/// Smallest turn at a corner, as in traced outlines; pieces of curves turn by about 10° at most.
constexpr double kCornerTurn = 25.0 * std::numbers::pi / 180.0;

void requirePositive(double value, const char* name)
{
    if (!(value > 0.0 && std::isfinite(value))) {
        throw Error(ErrorCode::InvalidArgument, std::string(name) + " is " + numberText(value) + ", must be > 0");
    }
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

/// Outline in metres in the frame of a box.
Outline outlineOf(const United& united, const Box& box, double em)
{
    GlyphFrame frame(box);
    Outline outline;
    outline.specks_dropped = united.specks;
    for (const Contour& loop : united.loops) {
        outline.loops.push_back(loopOf(frame.place(loop), em));
    }
    outline.extent = em * frame.extent();
    return outline;
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
    require(tracking >= -1.0 && tracking <= 10.0, "tracking", tracking, "from -1 to 10");
    if (measure) {
        requirePositive(*measure, "measure");
    }
    if (arc) {
        require(*arc != 0.0 && std::isfinite(*arc), "arc", *arc, "finite and not 0");
    }
}

Outline glyphOutline(const Font& font, GlyphId glyph, const GlyphOptions& options)
{
    options.validate();
    requireGlyph(font, glyph);
    const FontFace& face = font.face();
    const DrawnGlyph drawn = face.draw(glyph, flatnessOf(options));
    return outlineOf(unite(drawn.contours, options.speck_size), boxOf(drawn, face.lines()), options.em);
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
    PlacedText placed = placeText(face, text, options);
    Drawer drawer(face, flatnessOf(options.glyph));
    std::vector<Contour> contours;
    for (const PlacedGlyph& glyph : placed.glyphs) {
        for (const Contour& contour : drawer(glyph.glyph)) {
            contours.push_back(moved(contour, glyph.origin, glyph.along));
        }
    }
    return {outlineOf(unite(contours, options.glyph.speck_size), placed.box, options.glyph.em),
            std::move(placed.missing), placed.lines};
}

}  // namespace droplet
