// SPDX-License-Identifier: GPL-3.0-or-later
#include "glyphs_command.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "batch_runner.h"
#include "content_hash.h"
#include "droplet/droplet.h"
#include "droplet/error.h"
#include "droplet/surface/onto.h"
#include "droplet/type/colour_glyph.h"
#include "droplet/type/text_path.h"
#include "droplet/units.h"
#include "files.h"
#include "glyph_names.h"
#include "glyphs_options.h"
#include "library_message.h"
#include "output_pattern.h"
#include "shape_command.h"
#include "surface_files.h"
#include "surroundings.h"
#include "terminal.h"

namespace cli {
namespace {

using droplet::Error;
using droplet::ErrorCode;
using droplet::Font;
using droplet::GlyphId;

constexpr const char* kPlaceholders = "{name}, {gid} or {codepoint}";

std::string codePointOf(char32_t character)
{
    const std::string shown = droplet::characterText(character);
    return shown.substr(0, shown.find(' '));
}

/// Glyph to be made.
struct GlyphRequest {
    GlyphId glyph = 0;
    std::optional<char32_t> character;  ///< requested character, or the glyph's smallest code point
};

/// Glyphs of a charset, and the characters that the font lacks.
struct Selection {
    std::vector<GlyphRequest> glyphs;  ///< without duplicates
    std::vector<char32_t> missing;
};

Selection select(const Font& font, const GlyphChoice& choice)
{
    Selection selection;
    if (!choice.characters) {
        for (std::size_t glyph = 0; glyph < font.glyphCount(); ++glyph) {
            const auto id = static_cast<GlyphId>(glyph);
            selection.glyphs.push_back({id, font.characterOf(id)});
        }
        return selection;
    }
    std::vector<bool> taken(font.glyphCount(), false);
    for (const char32_t character : *choice.characters) {
        const auto glyph = font.glyphOf(character);
        if (!glyph) {
            selection.missing.push_back(character);
        } else if (!taken[*glyph]) {
            taken[*glyph] = true;
            selection.glyphs.push_back({*glyph, character});
        }
    }
    return selection;
}

std::string missingGlyphs(const std::vector<char32_t>& missing)
{
    constexpr std::size_t kMax = 10;
    std::string text = "the font has no glyph for ";
    for (std::size_t i = 0; i < std::min(kMax, missing.size()); ++i) {
        text += (i > 0 ? ", " : "") + droplet::characterText(missing[i]);
    }
    if (missing.size() > kMax) {
        text += " and " + std::to_string(missing.size() - kMax) + " more";
    }
    return text;
}

/// Letter that decides the height of all: o, or O, or 0, or the first glyph with ink.
std::optional<GlyphId> referenceLetter(const Font& font, const droplet::GlyphOptions& options,
                                       const std::vector<GlyphRequest>& others)
{
    for (const char32_t character : {U'o', U'O', U'0'}) {
        const auto glyph = font.glyphOf(character);
        if (glyph && droplet::hasInk(font, *glyph, options)) {
            return glyph;
        }
    }
    const auto first = std::find_if(others.begin(), others.end(), [&](const GlyphRequest& request) {
        return droplet::hasInk(font, request.glyph, options);
    });
    return first == others.end() ? std::nullopt : std::optional(first->glyph);
}

/// Gives all letters one height: that of the reference letter at the given contact angle on level flat ground.
void equaliseHeights(const Font& font, const std::vector<GlyphRequest>& glyphs, GlyphsOptions& options)
{
    droplet::SolveOptions& solve = options.shape.settings.droplet.solve;
    if (!options.equal_height || solve.fill.by == droplet::FillBy::Height) {
        return;
    }
    const auto letter = referenceLetter(font, options.type.glyph, glyphs);
    if (!letter) {
        return;
    }
    droplet::DropletOptions reference;
    reference.solve = solve;
    reference.solve.tilt = 0.0;
    reference.solve.no_penetration = false;
    const droplet::Outline outline = droplet::glyphOutline(font, *letter, options.type.glyph);
    solve.fill.by = droplet::FillBy::Height;
    solve.fill.amount = droplet::makeDroplet(outline, reference).total.height_max;
}

/// Checks the font for --by-colour.
/// @throws Error InvalidInput: the font's colours are not in layers
void requireColourLayers(const Font& font, GlyphsOptions& options)
{
    if (!options.shape.footprint.by_colour || font.hasColourLayers()) {
        return;
    }
    if (const std::string table = font.otherColours(); !table.empty()) {
        throw Error(ErrorCode::InvalidInput,
                    options.font + ": the font has its colours in the table " + table +
                        ", and --by-colour reads only colour layers (COLR); without it, the font's outlines are used");
    }
    options.shape.footprint.by_colour.reset();
    options.shape.settings.warnings.emplace_back("--by-colour has no effect: the font has no colour layers (COLR)");
}

droplet::TypeReport describeGlyph(const Font& font, const GlyphRequest& request, const GlyphsOptions& options)
{
    droplet::TypeReport type = describe(font, options);
    type.glyph = request.glyph;
    type.glyph_name = font.nameOf(request.glyph);
    type.character = request.character;
    return type;
}

droplet::TypeReport describeText(const Font& font, const std::vector<char32_t>& missing, const GlyphsOptions& options)
{
    droplet::TypeReport type = describe(font, options);
    type.text = options.text;
    type.missing = missing;
    return type;
}

/// Areas of colour, with what the report needs.
DrawnColours drawnColours(droplet::ColourLayout layout, droplet::TypeReport type, const GlyphsOptions& options)
{
    const droplet::GlyphOptions& glyph = options.type.glyph;
    DrawnColours drawn{std::move(layout.drawing), {}, glyph.speck_size * glyph.em * glyph.em};
    drawn.input.type = std::move(type);
    return drawn;
}

/// Files of a text.
RunFiles filesOfText(const GlyphsOptions& options)
{
    RunFiles files = filesOf(options.shape, "--font");
    files.reads("--path", options.path);
    return files;
}

int makeText(const Font& font, GlyphsOptions options)
{
    requireColourLayers(font, options);
    makeAndReport(options.shape.run, filesOfText(options), [&](const droplet::Progress& progress) {
        progress(droplet::Stage::Read, 0.0);
        const Surroundings around = readSurroundings(options.shape.settings, options.shape.preview);
        readPath(options);
        if (around.object) {
            fitToObject(options, around.object->mesh, font, *options.text);
        }
        if (options.shape.footprint.by_colour) {
            droplet::ColourLayout colours = droplet::layOutColours(font, *options.text, options.type);
            const LeftOut left_out{colours.missing, colours.beyond};
            requireInk(!colours.drawing.areas.empty(), left_out, options);
            if (colours.has_layers) {
                noteLeftOut(left_out, options);
                droplet::TypeReport type = describeText(font, colours.missing, options);
                return makeShape(options.shape, around, drawnColours(std::move(colours), std::move(type), options),
                                 progress);
            }
            options.shape.settings.warnings.emplace_back(
                "--by-colour has no effect: no glyph of the text has colour layers");
        }
        droplet::TextLayout set = droplet::layOutText(font, *options.text, options.type);
        requireInk(!set.outline.loops.empty(), {set.missing, set.beyond}, options);
        noteLeftOut({set.missing, set.beyond}, options);
        std::vector<GlyphRequest> letters;
        for (const char32_t character : droplet::charactersOf(*options.text)) {
            if (const auto glyph = font.glyphOf(character)) {
                letters.push_back({*glyph, character});
            }
        }
        equaliseHeights(font, letters, options);
        DrawnFootprint footprint{std::move(set.outline), {}};
        footprint.input.path = options.font;
        footprint.input.type = describeText(font, set.missing, options);
        return makeShape(options.shape, around, std::move(footprint), progress);
    });
    return 0;
}

PatternValues valuesOf(const GlyphRequest& request, const std::vector<std::string>& names)
{
    return {
        {"name", names[request.glyph]},
        {"gid", std::to_string(request.glyph)},
        {"codepoint", request.character ? codePointOf(*request.character) : "glyph" + std::to_string(request.glyph)}};
}

/// Hash of everything that decides the outputs' bytes, except the choice of the glyph.
std::string settingsFingerprint(const GlyphsOptions& options)
{
    std::vector<std::string> parts{hashOfFile(options.font), droplet::name(options.shape.format)};
    for (const auto& [name, value] : options.set->batch.decisive) {
        // These options choose glyphs, but do not change them.
        if (name != "all" && name != "charset" && name != "font") {
            parts.push_back(name);
            parts.push_back(value);
        }
    }
    if (options.equal_height) {
        // The reference letter may depend on the chosen glyphs.
        std::ostringstream height;
        height << std::hexfloat << options.shape.settings.droplet.solve.fill.amount;
        parts.push_back(height.str());
    }
    const auto& ground = options.shape.settings.ground.path;
    parts.push_back(hashOfFile(ground));
    if (const auto& materials = options.shape.settings.materials) {
        parts.push_back(hashOfFile(materials->path));
    }
    return fingerprintOf(parts);
}

/// Makes the droplets of one glyph.
/// @param shape  options with the glyph's outputs
droplet::Report makeGlyph(const Font& font, const GlyphRequest& request, const GlyphsOptions& options,
                          ShapeOptions shape, const Surroundings& around)
{
    const auto ignore = [](droplet::Stage, double) {};
    droplet::TypeReport type = describeGlyph(font, request, options);
    if (shape.footprint.by_colour && droplet::hasColourLayers(font, request.glyph)) {
        droplet::ColourLayout colours = droplet::glyphColours(font, request.glyph, options.type.glyph);
        if (colours.drawing.areas.empty()) {
            throw Error(ErrorCode::InvalidInput, "the colour layers have no ink");
        }
        return makeShape(shape, around, drawnColours(std::move(colours), std::move(type), options), ignore);
    }
    shape.footprint.by_colour.reset();
    DrawnFootprint footprint{droplet::glyphOutline(font, request.glyph, options.type.glyph), {}};
    footprint.input.path = options.font;
    footprint.input.type = std::move(type);
    return makeShape(shape, around, std::move(footprint), ignore);
}

int makeGlyphs(const Font& font, GlyphsOptions options)
{
    requireColourLayers(font, options);
    GlyphSetOptions& set = *options.set;
    Selection selection = select(font, set.choice);
    if (selection.glyphs.empty()) {
        throw Error(ErrorCode::InvalidInput,
                    options.font + ": " + missingGlyphs(selection.missing) + ", and nothing is left");
    }
    equaliseHeights(font, selection.glyphs, options);
    if (!selection.missing.empty() && options.shape.run.verbosity != Verbosity::Quiet) {
        printWarning(missingGlyphs(selection.missing) + "; left out", options.shape.run.progress);
    }
    for (const char32_t character : selection.missing) {
        set.batch.left_out.push_back({droplet::characterText(character), "the font has no glyph for it"});
    }
    RunFiles read;
    addSettings(read, options.shape.settings, options.shape.run);
    read.reads("--font", options.font);
    read.reads("--charset", set.charset_file);
    set.batch.read = read.read;
    Surroundings around;   // of all items; read once their files have been checked
    std::string settings;  // their fingerprint
    const std::vector<std::string> names = fileNames(font);

    std::vector<BatchItem> items;
    for (const GlyphRequest& request : selection.glyphs) {
        const std::string name = font.nameOf(request.glyph);
        // A broken glyph stays an item, which fails with a message.
        bool blank = false;
        try {
            blank = !droplet::hasInk(font, request.glyph, options.type.glyph) &&
                    !(options.shape.footprint.by_colour && droplet::hasColourLayers(font, request.glyph));
        } catch (const Error&) {
        }
        if (blank) {
            set.batch.left_out.push_back({"glyph '" + name + "'", "no ink"});
            continue;
        }
        const PatternValues values = valuesOf(request, names);
        BatchItem item;
        item.name = "glyph '" + name + "'";
        item.input = options.font;
        item.output = fillPattern(set.output, values, kPlaceholders);
        if (set.json) {
            item.others.push_back(fillPattern(*set.json, values, kPlaceholders));
        }
        if (const auto material = materialFile(item.output, options.shape.format)) {
            item.others.push_back(*material);
        }
        for (std::string& level : levelPaths(item.output, options.shape.format, options.shape.settings.levels.size())) {
            item.others.push_back(std::move(level));
        }
        item.open = [&, request, output = item.output, others = item.others] {
            BatchWork work;
            work.fingerprint = fingerprintOf({settings, std::to_string(request.glyph)});
            work.make = [&, request, output, others] {
                ShapeOptions job = options.shape;
                job.output = output;
                job.json = set.json ? std::optional(others.front()) : std::nullopt;
                return figuresOf(makeGlyph(font, request, options, std::move(job), around));
            };
            return work;
        };
        items.push_back(std::move(item));
    }
    if (items.empty()) {
        throw Error(ErrorCode::InvalidInput, options.font + ": none of the chosen glyphs has ink");
    }
    checkItems(items, set.batch);
    around = readSurroundings(options.shape.settings);
    set.batch.object = objectInFiles(options.shape.settings, around);
    settings = settingsFingerprint(options);
    return makeAll(items, set.batch);
}

/// Prints one line for each axis and glyph, in columns separated by tabs.
void list(const Font& font, const GlyphsOptions& options)
{
    std::ostringstream text;
    for (const droplet::FontAxis& axis : font.axes()) {
        text << "axis\t" << axis.tag << "\t" << axis.min << ".." << axis.max << "\t" << axis.standard << "\t"
             << axis.name << "\n";
    }
    const auto ink = [&](GlyphId glyph) {
        try {
            return droplet::hasInk(font, glyph, options.type.glyph) ? "ink" : "no ink";
        } catch (const Error&) {
            return "broken";
        }
    };
    const std::vector<std::string> names = fileNames(font);
    for (std::size_t i = 0; i < font.glyphCount(); ++i) {
        const auto glyph = static_cast<GlyphId>(i);
        const auto character = font.characterOf(glyph);
        text << "glyph\t" << i << "\t" << oneLine(font.nameOf(glyph)) << "\t" << names[i] << "\t"
             << (character ? codePointOf(*character) : "-") << "\t" << ink(glyph) << "\n";
    }
    print(text.str());
}

/// Makes what the options ask for.
/// @return  exit code
int make(GlyphsOptions options)
{
    const Font font = droplet::readFont(options.font, options.face);
    if (options.text) {
        return makeText(font, std::move(options));
    }
    if (options.set) {
        return makeGlyphs(font, std::move(options));
    }
    list(font, options);
    return 0;
}

}  // namespace

droplet::TypeReport describe(const Font& font, const GlyphsOptions& options)
{
    droplet::TypeReport type;
    type.family = font.family();
    type.style = font.style();
    type.face_index = options.face.face_index;
    for (const auto& [tag, value] : options.face.axes) {
        type.axes.emplace_back(tag, value);
    }
    type.em = options.type.glyph.em;
    return type;
}

void readPath(GlyphsOptions& options)
{
    if (!options.path) {
        return;
    }
    droplet::TextPath path =
        forOption("--path", [&] { return droplet::readTextPath(*options.path, options.path_width); });
    if (path.others > 0) {
        options.shape.settings.warnings.push_back(
            "--path: " + *options.path + " has " + std::to_string(path.others + 1) +
            " paths, and the text follows the longest; delete the others, or let a text of the drawing follow it");
    }
    options.type.path = std::move(path.points);
}

void fitToObject(GlyphsOptions& options, const droplet::TexturedMesh& object, const Font& font, const std::string& text)
{
    if (options.sized) {
        return;
    }
    const droplet::Vec2 extent = droplet::layOutText(font, text, options.type).outline.extent;
    const double per_uv =
        forOption("--onto " + *options.shape.settings.onto, [&] { return droplet::metresPerUv(object); });
    const double factor = per_uv * std::sqrt(extent.x / extent.y) / extent.x;
    options.type.glyph.em *= factor;
    for (droplet::Vec2& p : options.type.path) {
        p = factor * p;
    }
}

void requireInk(bool has_ink, const LeftOut& left_out, const GlyphsOptions& options)
{
    if (has_ink) {
        return;
    }
    if (left_out.beyond > 0) {
        throw Error(ErrorCode::InvalidInput, "--path: it is too short for any letter; make the type smaller (--em)");
    }
    throw Error(ErrorCode::InvalidInput,
                options.font + ": " +
                    (left_out.missing.empty() ? "the text has no ink"
                                              : missingGlyphs(left_out.missing) + ", and nothing is left"));
}

void noteLeftOut(const LeftOut& left_out, GlyphsOptions& options)
{
    std::vector<std::string>& warnings = options.shape.settings.warnings;
    if (!left_out.missing.empty()) {
        warnings.push_back(missingGlyphs(left_out.missing) + "; left out");
    }
    if (left_out.beyond > 0) {
        warnings.push_back("--path: the text is longer than its path, and " + std::to_string(left_out.beyond) +
                           (left_out.beyond == 1 ? " letter is" : " letters are") +
                           " left out; make the type smaller (--em), or the path longer");
    }
}

int runGlyphs(int argc, const char* const* argv)
{
    auto parsed = parseGlyphs(argc, argv);
    if (const auto* text = std::get_if<std::string>(&parsed)) {
        print(*text);
        return 0;
    }
    auto& options = std::get<GlyphsOptions>(parsed);
    if (options.text) {
        checkShape(options.shape, filesOfText(options));
    }
    RunFiles files;
    files.reads("--font", options.font);
    files.reads("--path", options.path);
    const CommandTerms terms = options.shape.run.terms;
    return inTermsOf(terms, files, [&] { return make(std::move(options)); });
}

}  // namespace cli
