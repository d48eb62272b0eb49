// SPDX-License-Identifier: GPL-3.0-or-later
//
// Directions: Unicode bidirectional algorithm (Unicode Standard Annex 9) by FriBidi. Scripts: HarfBuzz; characters that
// all scripts share (UAX 24: Common, Inherited) take the script of the character before them.

#include "type/text_layout.h"

#include <fribidi.h>
#include <hb.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "droplet/error.h"
#include "number_text.h"
#include "utf8.h"

namespace droplet {
namespace {

struct LeveledRun {
    TextRun run;
    FriBidiLevel level = 0;
};

std::vector<hb_script_t> scriptsOf(const std::u32string& text)
{
    hb_unicode_funcs_t* unicode = hb_unicode_funcs_get_default();
    std::vector<hb_script_t> scripts;
    for (const char32_t c : text) {
        scripts.push_back(hb_unicode_script(unicode, c));
    }
    const auto shared = [](hb_script_t script) {
        return script == HB_SCRIPT_COMMON || script == HB_SCRIPT_INHERITED || script == HB_SCRIPT_UNKNOWN;
    };
    const auto first = std::find_if_not(scripts.begin(), scripts.end(), shared);
    hb_script_t current = first == scripts.end() ? HB_SCRIPT_COMMON : *first;
    for (hb_script_t& script : scripts) {
        current = shared(script) ? current : script;
        script = current;
    }
    return scripts;
}

/// Embedding levels. The line starts on the right if its base level is odd.
struct Levels {
    std::vector<FriBidiLevel> of;
    bool leftward = false;
};

Levels levelsOf(const std::u32string& text)
{
    const std::vector<FriBidiChar> characters(text.begin(), text.end());
    const auto count = static_cast<FriBidiStrIndex>(text.size());
    std::vector<FriBidiCharType> types(text.size());
    std::vector<FriBidiBracketType> brackets(text.size());
    fribidi_get_bidi_types(characters.data(), count, types.data());
    fribidi_get_bracket_types(characters.data(), count, types.data(), brackets.data());
    Levels levels{std::vector<FriBidiLevel>(text.size()), false};
    FriBidiParType base = FRIBIDI_PAR_ON;
    if (fribidi_get_par_embedding_levels_ex(types.data(), brackets.data(), count, &base, levels.of.data()) == 0) {
        throw Error(ErrorCode::InvalidInput, "the directions of the text cannot be found");
    }
    levels.leftward = FRIBIDI_IS_RTL(base);
    return levels;
}

/// Runs in the order of the text.
std::vector<LeveledRun> runsOf(const std::u32string& text, const std::vector<FriBidiLevel>& levels)
{
    const std::vector<hb_script_t> scripts = scriptsOf(text);
    std::vector<LeveledRun> runs;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (runs.empty() || runs.back().level != levels[i] ||
            runs.back().run.script != static_cast<unsigned>(scripts[i])) {
            runs.push_back({{i, i, static_cast<unsigned>(scripts[i]), levels[i] % 2 != 0}, levels[i]});
        }
        runs.back().run.end = i + 1;
    }
    return runs;
}

/// Rule L2: for every level from the highest down to the lowest odd one, sequences of that level or higher are
/// reversed.
void reorder(std::vector<LeveledRun>& runs)
{
    FriBidiLevel highest = 0;
    for (const LeveledRun& run : runs) {
        highest = std::max(highest, run.level);
    }
    for (FriBidiLevel level = highest; level > 0; --level) {
        for (auto begin = runs.begin(); begin != runs.end();) {
            const auto lower = [&](const LeveledRun& run) { return run.level < level; };
            begin = std::find_if_not(begin, runs.end(), lower);
            const auto end = std::find_if(begin, runs.end(), lower);
            std::reverse(begin, end);
            begin = end;
        }
    }
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

/// Whether a run has letters that join with their neighbours, as in Arabic.
bool joins(const std::u32string& text, const TextRun& run)
{
    return std::any_of(text.begin() + static_cast<std::ptrdiff_t>(run.begin),
                       text.begin() + static_cast<std::ptrdiff_t>(run.end), [](char32_t c) {
                           const FriBidiJoiningType type = fribidi_get_joining_type(c);
                           return type == FRIBIDI_JOINING_TYPE_D || type == FRIBIDI_JOINING_TYPE_R ||
                                  type == FRIBIDI_JOINING_TYPE_L;
                       });
}

/// Lines, broken at spaces where they would be wider; a space at the break is left out.
/// @param measure  width [em]
std::vector<std::u32string> broken(const FontFace& face, const std::vector<std::u32string>& lines, double measure,
                                   double tracking)
{
    std::vector<std::u32string> result;
    for (const std::u32string& line : lines) {
        std::u32string now;
        for (std::size_t begin = 0; begin <= line.size();) {
            const std::size_t space = std::min(line.find(U' ', begin), line.size());
            const std::u32string word = line.substr(begin, space - begin);
            const std::u32string longer = begin == 0 ? word : now + U' ' + word;
            if (!now.empty() && layOutLine(face, longer, tracking).advance > measure) {
                result.push_back(std::move(now));
                now = word;
            } else {
                now = longer;
            }
            begin = space + 1;
        }
        result.push_back(std::move(now));
    }
    return result;
}

/// Circle that a base line lies on. A straight line's middle lies at its top, or at its bottom if the radius is below
/// 0.
struct Circle {
    Vec2 centre;
    double radius = 0.0;  ///< [em]
    double middle = 0.0;  ///< of the straight line
};

/// @param radius  of the first base line [em]
/// @param height  of the line's base line, at most 0
/// @param width   of the text
Circle circleOf(double radius, double height, double width)
{
    const Circle circle{{0.5 * width, -radius}, radius + height, 0.5 * width};
    if (!(circle.radius * radius > 0.0 && width <= 2.0 * std::numbers::pi * std::abs(circle.radius))) {
        throw Error(ErrorCode::InvalidArgument, "the arc is too small for a line of " + numberText(width) +
                                                    " em; make it larger, or the type smaller");
    }
    return circle;
}

/// Places a glyph on a circle, and widens the box to hold its part of the line.
void placeOn(const Circle& circle, const ShapedGlyph& glyph, double pen, const LineMetrics& lines, PlacedText& result)
{
    // The middle of a letter touches the circle; a mark turns with where it stands.
    const double middle = 0.5 * glyph.advance;
    const double angle = (pen + middle - circle.middle) / circle.radius;
    const Vec2 along{std::cos(angle), -std::sin(angle)};
    const auto at = [&](Vec2 p) {
        const Vec2 off{p.x - middle, p.y + circle.radius};
        return circle.centre + Vec2{off.x * along.x - off.y * along.y, off.x * along.y + off.y * along.x};
    };
    if (result.glyphs.empty()) {
        result.box = {at({middle, 0.0}), at({middle, 0.0})};
    }
    for (const double x : {0.0, glyph.advance}) {
        for (const double y : {lines.descender, lines.ascender}) {
            const Vec2 p = at({x, y});
            result.box.low = {std::min(result.box.low.x, p.x), std::min(result.box.low.y, p.y)};
            result.box.high = {std::max(result.box.high.x, p.x), std::max(result.box.high.y, p.y)};
        }
    }
    result.glyphs.push_back({glyph.glyph, at(glyph.offset), along});
}

}  // namespace

TextLine layOutLine(const FontFace& face, const std::u32string& text, double tracking)
{
    TextLine line;
    if (text.empty()) {
        return line;
    }
    const Levels levels = levelsOf(text);
    line.leftward = levels.leftward;
    std::vector<LeveledRun> runs = runsOf(text, levels.of);
    reorder(runs);
    double after_last = 0.0;  // tracking is between letters
    for (LeveledRun& run : runs) {
        run.run.ligatures = tracking == 0.0;
        std::vector<ShapedGlyph> shaped = face.shape(text, run.run);
        const double between = joins(text, run.run) ? 0.0 : tracking;
        for (ShapedGlyph& glyph : shaped) {
            if (glyph.advance > 0.0) {  // not after marks
                glyph.advance += between;
                after_last = between;
            }
        }
        line.glyphs.insert(line.glyphs.end(), shaped.begin(), shaped.end());
    }
    const auto last = std::find_if(line.glyphs.rbegin(), line.glyphs.rend(),
                                   [](const ShapedGlyph& glyph) { return glyph.advance != 0.0; });
    if (last != line.glyphs.rend()) {
        last->advance -= after_last;
    }
    for (const ShapedGlyph& glyph : line.glyphs) {
        line.advance += glyph.advance;
    }
    return line;
}

PlacedText placeText(const FontFace& face, std::string_view text, const TextOptions& options)
{
    std::vector<std::u32string> texts = linesOf(text);
    if (options.measure) {
        texts = broken(face, texts, *options.measure / options.glyph.em, options.tracking);
    }
    PlacedText result;
    result.lines = texts.size();
    std::vector<TextLine> lines;
    double width = 0.0;
    for (const std::u32string& line : texts) {
        TextLine laid_out = layOutLine(face, line, options.tracking);
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
    const double pitch = options.line_spacing * face.lines().pitch;
    Vec2 pen;
    for (const TextLine& line : lines) {
        pen.x = startOf(line, width, options.align);
        const Circle circle = options.arc ? circleOf(*options.arc / options.glyph.em, pen.y, width) : Circle{};
        for (const ShapedGlyph& glyph : line.glyphs) {
            if (options.arc) {
                placeOn(circle, glyph, pen.x, face.lines(), result);
            } else {
                result.glyphs.push_back({glyph.glyph, pen + glyph.offset});
            }
            pen.x += glyph.advance;
        }
        pen.y -= pitch;
    }
    if (!options.arc || result.glyphs.empty()) {
        const double last = -pitch * static_cast<double>(lines.size() - 1);
        result.box = {{0.0, last + face.lines().descender}, {width, face.lines().ascender}};
    }
    return result;
}

Contour moved(Contour contour, Vec2 by, Vec2 along)
{
    for (Vec2& p : contour) {
        p = by + Vec2{p.x * along.x - p.y * along.y, p.x * along.y + p.y * along.x};
    }
    return contour;
}

}  // namespace droplet
