// SPDX-License-Identifier: GPL-3.0-or-later
//
// Layers become areas that do not overlap, by Clipper. These are drawn with pixels and traced as pictures are, instead
// of being used as they are, because tracing does what layers need and vectors make hard: it gives every boundary one
// line from junction to junction, drops slivers and specks between layers that nearly coincide, separates what touches
// in a point, and keeps gaps. As the pixels know the exact areas, boundaries are right to about a fiftieth of a pixel.
#include "droplet/type/colour_glyph.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "type/contour_union.h"
#include "type/font_face.h"
#include "type/glyph_frame.h"
#include "type/text_layout.h"

namespace droplet {
namespace {

/// Area of one colour in ems, with its bounding box.
struct Patch {
    CssColour colour;
    std::vector<Contour> contours;
    Box box{};

    Patch(CssColour its_colour, std::vector<Contour> its_contours)
        : colour(its_colour), contours(std::move(its_contours))
    {
        constexpr double kFar = std::numeric_limits<double>::infinity();
        box = {{kFar, kFar}, {-kFar, -kFar}};
        for (const Contour& contour : contours) {
            for (const Vec2 p : contour) {
                box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y)};
                box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y)};
            }
        }
    }
};

bool overlap(const Box& a, const Box& b)
{
    return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y;
}

CssColour blend(CssColour below, const PaletteEntry& above)
{
    const auto mix = [&](std::uint8_t a, std::uint8_t b) {
        return static_cast<std::uint8_t>(std::lround(a + above.opacity * (b - a)));
    };
    return {mix(below.red, above.colour.red), mix(below.green, above.colour.green), mix(below.blue, above.colour.blue)};
}

/// Width up to which the rim of a lower layer beside the upper one belongs to the upper one [em]. Fonts have such
/// hairlines where two layers were meant to have the same edge. Thin lines that a layer itself draws are kept.
constexpr double kNarrow = 1.0 / 256.0;

/// Lays an area over others, which do not overlap afterwards, either.
void cover(std::vector<Patch>& patches, std::vector<Contour> area, const PaletteEntry& paint)
{
    if (paint.opacity <= 0.0) {
        return;
    }
    const Patch whole(paint.colour, area);
    std::vector<Patch> result;
    for (Patch& patch : patches) {
        Parts parts;
        if (overlap(patch.box, whole.box)) {
            parts = divide(patch.contours, whole.contours, kNarrow);
        }
        if (parts.inside.empty()) {
            result.push_back(std::move(patch));
            continue;
        }
        result.emplace_back(patch.colour, std::move(parts.outside));
        if (paint.opacity < 1.0) {
            area = divide(area, parts.inside, 0.0).outside;
            parts.inside.insert(parts.inside.end(), parts.slivers.begin(), parts.slivers.end());
            result.emplace_back(blend(patch.colour, paint), std::move(parts.inside));
        } else if (!parts.slivers.empty()) {
            area.insert(area.end(), parts.slivers.begin(), parts.slivers.end());
            area = enclosed(area);
        }
    }
    result.emplace_back(paint.colour, std::move(area));
    std::erase_if(result, [](const Patch& patch) { return patch.contours.empty(); });
    patches = std::move(result);
}

/// Patches of a glyph.
struct ColouredGlyph {
    std::vector<Patch> patches;
    bool has_layers = false;
};

ColouredGlyph coloured(const FontFace& face, GlyphId glyph, const GlyphOptions& options)
{
    const Flatness flatness = flatnessOf(options);
    ColouredGlyph result;
    const std::vector<ColourLayer> layers = face.layersOf(glyph, options.text_colour);
    result.has_layers = !layers.empty();
    if (layers.empty()) {
        cover(result.patches, enclosed(face.draw(glyph, flatness).contours), {options.text_colour, 1.0});
    }
    for (const ColourLayer& layer : layers) {
        cover(result.patches, enclosed(face.draw(layer.glyph, flatness).contours), layer.paint);
    }
    return result;
}

/// Layout of placed glyphs.
ColourLayout layOut(const FontFace& face, PlacedText placed, const GlyphOptions& options)
{
    ColourLayout result;
    result.missing = std::move(placed.missing);
    result.lines = placed.lines;
    result.beyond = placed.beyond;
    std::map<GlyphId, ColouredGlyph> drawn;
    std::vector<Patch> patches;
    for (const PlacedGlyph& at : placed.glyphs) {
        const auto [place, is_new] = drawn.try_emplace(at.glyph);
        const ColouredGlyph& glyph = is_new ? place->second = coloured(face, at.glyph, options) : place->second;
        result.has_layers = result.has_layers || glyph.has_layers;
        for (const Patch& patch : glyph.patches) {
            std::vector<Contour> contours;
            for (const Contour& contour : patch.contours) {
                contours.push_back(moved(contour, at.origin, at.along));
            }
            cover(patches, std::move(contours), {patch.colour, 1.0});
        }
    }
    GlyphFrame frame(placed.box);
    std::map<std::array<std::uint8_t, 3>, ColourArea> areas;
    for (Patch& patch : patches) {
        const CssColour& c = patch.colour;
        ColourArea& area = areas.try_emplace({c.red, c.green, c.blue}, ColourArea{c, {}}).first->second;
        for (Contour& contour : patch.contours) {
            Contour loop = frame.place(std::move(contour));
            std::transform(loop.begin(), loop.end(), loop.begin(), [&](Vec2 p) { return options.em * p; });
            area.loops.push_back(std::move(loop));
        }
    }
    result.drawing.extent = options.em * frame.extent();
    for (auto& [levels, area] : areas) {
        result.drawing.areas.push_back(std::move(area));
    }
    std::stable_sort(result.drawing.areas.begin(), result.drawing.areas.end(),
                     [](const ColourArea& a, const ColourArea& b) { return area(a) > area(b); });
    return result;
}

}  // namespace

bool hasColourLayers(const Font& font, GlyphId glyph)
{
    requireGlyph(font, glyph);
    return !font.face().layersOf(glyph, {}).empty();
}

ColourLayout glyphColours(const Font& font, GlyphId glyph, const GlyphOptions& options)
{
    options.validate();
    requireGlyph(font, glyph);
    const FontFace& face = font.face();
    PlacedText alone;
    alone.glyphs = {{glyph, {}}};
    alone.box = boxOf(face.draw(glyph, flatnessOf(options)), face.lines());
    return layOut(face, std::move(alone), options);
}

ColourLayout layOutColours(const Font& font, std::string_view text, const TextOptions& options)
{
    options.validate();
    return layOut(font.face(), placeText(font.face(), text, options), options.glyph);
}

}  // namespace droplet
