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
#include <optional>
#include <span>
#include <utility>

#include "droplet/error.h"
#include "number_text.h"
#include "type/base_line.h"
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

/// Where a line starts.
/// @param room  width beside it
double startOf(bool is_leftward, double room, TextAlign align)
{
    switch (align) {
        case TextAlign::Start:
            return is_leftward ? room : 0.0;
        case TextAlign::Centre:
            return 0.5 * room;
        case TextAlign::End:
            break;
    }
    return is_leftward ? 0.0 : room;
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

/// Line of a text, and its em.
struct SizedLine {
    std::u32string text;
    double size = 1.0;
};

/// Lines of a text with their sizes, as TextOptions gives them.
std::vector<SizedLine> sizedLines(std::string_view text, const std::vector<double>& sizes)
{
    std::vector<SizedLine> lines;
    for (std::u32string& line : linesOf(text)) {
        lines.push_back({std::move(line), sizes.empty() ? 1.0 : sizes[std::min(lines.size(), sizes.size() - 1)]});
    }
    return lines;
}

/// Lines, broken at spaces where they would be wider; a space at the break is left out.
/// @param measure  width [em]
std::vector<SizedLine> broken(const FontFace& face, const std::vector<SizedLine>& lines, double measure,
                              double tracking)
{
    std::vector<SizedLine> result;
    for (const auto& [line, size] : lines) {
        std::u32string now;
        for (std::size_t begin = 0; begin <= line.size();) {
            const std::size_t space = std::min(line.find(U' ', begin), line.size());
            const std::u32string word = line.substr(begin, space - begin);
            std::u32string longer = now;
            if (begin > 0) {
                longer += U' ';
            }
            longer += word;
            if (!now.empty() && size * layOutLine(face, longer, tracking).advance > measure) {
                result.push_back({std::move(now), size});
                now = word;
            } else {
                now = std::move(longer);
            }
            begin = space + 1;
        }
        result.push_back({std::move(now), size});
    }
    return result;
}

/// Index of the letter that each character belongs to: its own, or for marks that of the letter before them.
std::vector<std::size_t> lettersOf(const std::u32string& text)
{
    hb_unicode_funcs_t* unicode = hb_unicode_funcs_get_default();
    const auto is_mark = [&](char32_t c) {
        const hb_unicode_general_category_t category = hb_unicode_general_category(unicode, c);
        return category == HB_UNICODE_GENERAL_CATEGORY_NON_SPACING_MARK ||
               category == HB_UNICODE_GENERAL_CATEGORY_SPACING_MARK ||
               category == HB_UNICODE_GENERAL_CATEGORY_ENCLOSING_MARK;
    };
    std::vector<std::size_t> letters(text.size(), 0);
    for (std::size_t i = 1; i < text.size(); ++i) {
        letters[i] = is_mark(text[i]) ? letters[i - 1] : i;
    }
    return letters;
}

/// Nearest place that unite() rounds to, so that a straight path sets text exactly as none does.
Vec2 onGrid(Vec2 p)
{
    constexpr double kGrid = 0x1p26;
    return {std::round(kGrid * p.x) / kGrid, std::round(kGrid * p.y) / kGrid};
}

/// Glyphs of a line that are placed along another line.
class Follower {
public:
    /// @param lines      of glyphs whose em is 1
    /// @param shift      of all glyphs along the line, as a share of its length
    /// @param is_closed  whether the line's end is its begin
    Follower(const LineMetrics& lines, double shift, bool is_closed, PlacedText& result)
        : lines_(lines), shift_(shift), is_closed_(is_closed), result_(result)
    {
    }

    /// Places the glyphs of a line.
    /// @param pen   distance along the base line at which they begin
    /// @param text  of the line
    void place(const TextLine& line, double size, const BaseLine& base, double pen, const std::u32string& text)
    {
        const std::vector<std::size_t> letters = lettersOf(text);
        for (auto begin = line.glyphs.begin(); begin != line.glyphs.end();) {
            // A letter and its marks stay together, and their middle touches the line.
            const std::size_t letter = letters[begin->character];
            const auto end = std::find_if(begin, line.glyphs.end(),
                                          [&](const ShapedGlyph& glyph) { return letters[glyph.character] != letter; });
            double advance = 0.0;
            for (auto glyph = begin; glyph != end; ++glyph) {
                advance += glyph->advance;
            }
            if (const auto distance = shifted(pen + 0.5 * size * advance, base.length())) {
                placeLetter({begin, end}, advance, size, base.at(*distance));
            } else {
                result_.beyond += text[letter] == U' ' ? 0 : 1;
            }
            pen += size * advance;
            begin = end;
        }
    }

    /// Moves all so that the line's box begins where it would without a path.
    /// @throws Error InvalidArgument: the text takes too much room
    void finish(double ascender)
    {
        constexpr double kWidest = 0x1p20;  // of what unite() takes
        const Vec2 size = result_.box.high - result_.box.low;
        if (const double room = std::max(size.x, size.y); !(room < kWidest)) {
            throw Error(ErrorCode::InvalidArgument, "the text's path is too long: lines at its ends are " +
                                                        numberText(room) + " em apart, must be less than 1048576 em");
        }
        const Vec2 by = Vec2{0.0, ascender} - Vec2{result_.box.low.x, result_.box.high.y};
        result_.box = {onGrid(result_.box.low + by), onGrid(result_.box.high + by)};
        for (PlacedGlyph& glyph : result_.glyphs) {
            glyph.origin = onGrid(glyph.origin + by);
        }
    }

private:
    /// Distance along a line after the shift; none beyond its ends. On a closed line, text may go round once.
    [[nodiscard]] std::optional<double> shifted(double distance, double length) const
    {
        const auto is_on = [&](double d) { return d >= 0.0 && d <= length && length > 0.0; };
        double moved = distance + shift_ * length;
        if (is_closed_ && is_on(distance) && !is_on(moved)) {
            moved -= std::floor(moved / length) * length;
        }
        return is_on(moved) && (!is_closed_ || is_on(distance)) ? std::optional(moved) : std::nullopt;
    }

    void placeLetter(std::span<const ShapedGlyph> letter, double advance, double size, const BaseLine::Place& place)
    {
        const Vec2 along = size * place.along;
        const auto at = [&](Vec2 p) {
            const Vec2 off{p.x - 0.5 * advance, p.y};
            return place.point + Vec2{off.x * along.x - off.y * along.y, off.x * along.y + off.y * along.x};
        };
        if (result_.glyphs.empty()) {
            result_.box = {place.point, place.point};
        }
        for (const double x : {0.0, advance}) {
            for (const double y : {lines_.descender, lines_.ascender}) {
                const Vec2 p = at({x, y});
                result_.box.low = {std::min(result_.box.low.x, p.x), std::min(result_.box.low.y, p.y)};
                result_.box.high = {std::max(result_.box.high.x, p.x), std::max(result_.box.high.y, p.y)};
            }
        }
        double pen = 0.0;
        for (const ShapedGlyph& glyph : letter) {
            result_.glyphs.push_back({glyph.glyph, at(Vec2{pen, 0.0} + glyph.offset), along, size});
            pen += glyph.advance;
        }
    }

    const LineMetrics& lines_;
    double shift_;
    bool is_closed_;
    PlacedText& result_;
};

/// Line that the first base line follows, in ems; empty if it is straight.
std::vector<LinePiece> followedLine(const TextOptions& options)
{
    const double em = options.glyph.em;
    if (options.arc) {
        return circlePieces(*options.arc / em);
    }
    std::vector<Vec2> points;
    points.reserve(options.path.size());
    for (const Vec2 p : options.path) {
        points.push_back((1.0 / em) * p);
    }
    return points.empty() ? std::vector<LinePiece>{} : piecesOf(points);
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
    std::vector<SizedLine> texts = sizedLines(text, options.line_sizes);
    if (options.measure) {
        texts = broken(face, texts, *options.measure / options.glyph.em, options.tracking);
    }
    PlacedText result;
    result.lines = texts.size();
    result.smallest = texts.front().size;
    std::vector<TextLine> lines;
    lines.reserve(texts.size());
    double width = 0.0;
    for (const auto& [line, size] : texts) {
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
        width = std::max(width, size * laid_out.advance);
        result.smallest = std::min(result.smallest, size);
        lines.push_back(std::move(laid_out));
    }
    const LineMetrics& metrics = face.lines();
    const double below = 0.5 * (metrics.pitch - metrics.ascender - metrics.descender);
    const std::vector<LinePiece> followed = followedLine(options);
    const bool is_closed = options.arc || (!options.path.empty() && options.path.front() == options.path.back());
    Follower follower(metrics, options.shift, is_closed, result);
    Vec2 pen;
    for (std::size_t k = 0; k < lines.size(); ++k) {
        const TextLine& line = lines[k];
        const double size = texts[k].size;
        if (k > 0) {
            // Each line's part of the distance reaches from the middle of the gap above it to that below it.
            pen.y -= options.line_spacing * (size * metrics.pitch + (texts[k - 1].size - size) * below);
        }
        const double advance = size * line.advance;
        if (followed.empty()) {
            pen.x = startOf(line.leftward, width - advance, options.align);
            for (const ShapedGlyph& glyph : line.glyphs) {
                result.glyphs.push_back({glyph.glyph, pen + size * glyph.offset, {size, 0.0}, size});
                pen.x += size * glyph.advance;
            }
            continue;
        }
        const BaseLine base(followed, pen.y);
        if (options.arc && width > base.length()) {
            throw Error(ErrorCode::InvalidArgument, "the arc is too small for a line of " + numberText(width) +
                                                        " em; make it larger, or the type smaller");
        }
        const double room = options.arc ? width : base.length();
        follower.place(line, size, base,
                       0.5 * (base.length() - room) + startOf(line.leftward, room - advance, options.align),
                       texts[k].text);
    }
    const double top = texts.front().size * metrics.ascender;
    if (followed.empty() || result.glyphs.empty()) {
        result.box = {{0.0, pen.y + texts.back().size * metrics.descender}, {width, top}};
    } else {
        follower.finish(top);
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
