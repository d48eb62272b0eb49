// SPDX-License-Identifier: GPL-3.0-or-later
//
// Directions: Unicode bidirectional algorithm (Unicode Standard Annex 9) by FriBidi. Scripts: HarfBuzz; characters that
// all scripts share (UAX 24: Common, Inherited) take the script of the character before them.

#include "type/text_layout.h"

#include <fribidi.h>
#include <hb.h>

#include <algorithm>
#include <cstddef>
#include <utility>

#include "droplet/error.h"
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

}  // namespace

TextLine layOutLine(const FontFace& face, const std::u32string& text)
{
    TextLine line;
    if (text.empty()) {
        return line;
    }
    const Levels levels = levelsOf(text);
    line.leftward = levels.leftward;
    std::vector<LeveledRun> runs = runsOf(text, levels.of);
    reorder(runs);
    for (const LeveledRun& run : runs) {
        const std::vector<ShapedGlyph> shaped = face.shape(text, run.run);
        line.glyphs.insert(line.glyphs.end(), shaped.begin(), shaped.end());
    }
    for (const ShapedGlyph& glyph : line.glyphs) {
        line.advance += glyph.advance;
    }
    return line;
}

PlacedText placeText(const FontFace& face, std::string_view text, const TextOptions& options)
{
    const std::vector<std::u32string> texts = linesOf(text);
    PlacedText result;
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
    const double pitch = options.line_spacing * face.lines().pitch;
    Vec2 pen;
    for (const TextLine& line : lines) {
        pen.x = startOf(line, width, options.align);
        for (const ShapedGlyph& glyph : line.glyphs) {
            result.glyphs.push_back({glyph.glyph, pen + glyph.offset});
            pen.x += glyph.advance;
        }
        pen.y -= pitch;
    }
    const double last = -pitch * static_cast<double>(lines.size() - 1);
    result.box = {{0.0, last + face.lines().descender}, {width, face.lines().ascender}};
    return result;
}

Contour moved(Contour contour, Vec2 by)
{
    for (Vec2& p : contour) {
        p = p + by;
    }
    return contour;
}

}  // namespace droplet
