// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/type/glyph.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "droplet/error.h"
#include "number_text.h"
#include "require.h"
#include "type/base_line.h"
#include "type/contour_union.h"
#include "type/flatten.h"
#include "type/font_face.h"
#include "type/glyph_frame.h"
#include "type/text_layout.h"

namespace droplet {
namespace {

constexpr double kMinLineSize = 0.05;
constexpr double kMaxLineSize = 20.0;

void requirePositive(double value, const char* name)
{
    if (!(value > 0.0 && std::isfinite(value))) {
        throw Error(ErrorCode::InvalidArgument, std::string(name) + " is " + numberText(value) + ", must be > 0");
    }
}

/// Loop with its corners; straight sides are divided.
/// @param spacing  largest distance of points [em]
Loop loopOf(const Contour& contour, double em, double spacing)
{
    Loop loop;
    const std::size_t n = contour.size();
    for (std::size_t i = 0; i < n; ++i) {
        const Vec2 here = contour[i];
        const Vec2 before = here - contour[(i + n - 1) % n];
        const Vec2 after = contour[(i + 1) % n] - here;
        const double turn = std::abs(std::atan2(cross(before, after), dot(before, after)));
        const auto count = static_cast<std::size_t>(std::ceil(length(after) / spacing));
        for (std::size_t k = 0; k < count; ++k) {
            loop.points.push_back(em * (here + (static_cast<double>(k) / static_cast<double>(count)) * after));
            loop.corner.push_back(k == 0 && turn > kCornerTurn ? 1 : 0);
        }
    }
    return loop;
}

/// Outline in metres in the frame of a box.
/// @param smallest  em of the smallest glyphs [em]
Outline outlineOf(const United& united, const Box& box, double em, double smallest = 1.0)
{
    GlyphFrame frame(box);
    Outline outline;
    outline.specks_dropped = united.specks;
    for (const Contour& loop : united.loops) {
        outline.loops.push_back(loopOf(frame.place(loop), em, smallest * kSpacing));
    }
    outline.extent = em * frame.extent();
    return outline;
}

/// Draws glyphs and unites their contours; each glyph once for every size.
class Drawer {
public:
    /// @param flatness  of glyphs whose em is 1
    Drawer(const FontFace& face, const Flatness& flatness) : face_(face), flatness_(flatness) {}

    const std::vector<Contour>& operator()(GlyphId glyph, double size)
    {
        const auto [place, is_new] = drawn_.try_emplace({glyph, size});
        if (is_new) {
            const Flatness flatness{flatness_.tolerance / size, flatness_.spacing / size};
            place->second = unite(face_.draw(glyph, flatness).contours, 0.0).loops;
        }
        return place->second;
    }

private:
    const FontFace& face_;
    Flatness flatness_;
    std::map<std::pair<GlyphId, double>, std::vector<Contour>> drawn_;
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
    for (const double size : line_sizes) {
        require(size >= kMinLineSize && size <= kMaxLineSize, "line_sizes", size, "from 0.05 to 20");
    }
    if (arc) {
        require(*arc != 0.0 && std::isfinite(*arc), "arc", *arc, "finite and not 0");
    }
    require(shift >= -1.0 && shift <= 1.0, "shift", shift, "from -1 to 1");
    if (path.empty()) {
        return;
    }
    require(!arc, "arc", arc.value_or(0.0), "empty, as there is a path");
    double path_length = 0.0;
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
        path_length += length(path[i + 1] - path[i]);
    }
    require(path_length > 0.0 && std::isfinite(path_length), "path", path_length, "a line of finite length above 0 m");
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
    Drawer drawer(face, flatnessOf(options.glyph, placed.smallest));
    std::vector<Contour> contours;
    for (const PlacedGlyph& glyph : placed.glyphs) {
        for (const Contour& contour : drawer(glyph.glyph, glyph.size)) {
            contours.push_back(moved(contour, glyph.origin, glyph.along));
        }
    }
    return {outlineOf(unite(contours, options.glyph.speck_size), placed.box, options.glyph.em, placed.smallest),
            std::move(placed.missing), placed.lines, placed.beyond};
}

}  // namespace droplet
