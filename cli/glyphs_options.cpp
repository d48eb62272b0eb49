// SPDX-License-Identifier: GPL-3.0-or-later
#include "glyphs_options.h"

#include <filesystem>
#include <string_view>

#include "common_options.h"
#include "droplet/error.h"
#include "files.h"
#include "value_list.h"

namespace cli {
namespace {

constexpr const char* kUsage = "usage: droplet-shape glyphs --font FILE --text TEXT -o OUTPUT, more with --help";

constexpr Range kArc{droplet::Dimension::Length, -1e3, 1e3, "from -1000m to 1000m"};
const CountRange kIndex{0, 65535, "65535"};  // limit of FreeType

const CommandText& commandText()
{
    static const CommandText text{
        "droplet-shape glyphs", "make droplets from type", "[OPTIONS] --font FILE -o OUTPUT",
        std::string("Placeholders in OUTPUT and --json, for --charset and --all:\n"
                    "  {name} is the font's name of the glyph, made safe for files (see --list),\n"
                    "  {gid} its index, {codepoint} its character, such as U+0041; {{ and }} are\n"
                    "  braces\n"
                    "\n") +
            kUnitsText +
            "\n"
            "Examples:\n"
            "  droplet-shape glyphs --font Serif.ttf --text Water -o water.glb\n"
            "  droplet-shape glyphs --font Serif.ttf --charset A-Za-z -o 'out/{name}.glb'\n"
            "  droplet-shape glyphs --font Serif.ttf --text WATER --arc 60mm -o seal.glb\n"
            "  droplet-shape glyphs --font Serif.ttf --text Stream --path wave.svg \\\n"
            "    --align centre -o wave.glb\n"
            "  droplet-shape glyphs --font Colour.ttf --text Sun -o sun.glb --by-colour\n"
            "  droplet-shape glyphs --font Variable.ttf --axis wght=700 --all \\\n"
            "    -o 'out/{name}.glb' --equal-height\n"
            "\n"
            "Exit codes:\n"
            "  0 done; 1 internal error; 2 usage; 3 font unreadable or without these glyphs;\n"
            "  4 output cannot be written; 5 no such droplet exists; 6 some glyphs failed,\n"
            "  and the manifest says which and why"};
    return text;
}

void declare(CommandLine& line, GlyphsOptions& options, ShapeMapOptions& maps)
{
    constexpr const char* kGroup = "Type";
    line.add(kGroup, "--font", "FILE", "Font: TrueType, OpenType, a collection, WOFF or Type 1");
    line.add(kGroup, "--face-index", "N", "Index of the font in a collection", into(options.face.face_index, kIndex));
    line.addList(kGroup, "--axis", "AXIS", "Axis of a variable font, such as wght=700; may be given several times");
    line.add(kGroup, "--text", "TEXT", "Write this text to one file; \\n begins a new line, \\\\ is a backslash");
    line.add(kGroup, "--charset", "SET",
             "Write one file for each of these characters: A-Za-z&, U+0391-U+03A9, or @words.txt for all characters of "
             "a text file");
    line.addFlag(kGroup, "--all", "Write one file for each glyph of the font");
    line.addFlag(kGroup, "--list", "Print the font's axes and glyphs; write nothing");
    line.add(kGroup, "-o,--output", "OUTPUT",
             "Output file, such as water.glb; for many glyphs a pattern, such as 'out/{name}.glb'");
    line.add(kGroup, "--em", "LENGTH", "Type size: edge of the em square", into(options.type.glyph.em, kLength));
    line.add(kGroup, "--tolerance", "LENGTH", "Largest error of a curve drawn as lines [em/20000]",
             into(options.type.glyph.tolerance, kLength));
    line.add(kGroup, "--align", "Alignment of the lines of a text; Hebrew and Arabic start on the right",
             into(options.type.align, {{"start", droplet::TextAlign::Start},
                                       {"centre", droplet::TextAlign::Centre},
                                       {"end", droplet::TextAlign::End}}));
    line.add(
        kGroup, "--line-sizes", "NUMBERS",
        "Type sizes of the lines between \\n, in em: 2,1 makes the first line twice as large; the last number holds "
        "for all further lines [1]");
    line.add(kGroup, "--line-spacing", "F", "Leading: distance of lines, as a multiple of the font's own",
             into(options.type.line_spacing, {0.01, 100.0, "a number from 0.01 to 100"}));
    line.add(kGroup, "--tracking", "F", "Extra width between the letters of a text, as a share of the em, such as 0.05",
             into(options.type.tracking, {-1.0, 10.0, "a number from -1 to 10"}));
    line.add(kGroup, "--line-width", "LENGTH", "Width at which the lines of a text break at spaces [only at \\n]",
             into(options.type.measure, kLength));
    line.add(kGroup, "--arc", "LENGTH",
             "Set a text around a circle of this radius; below 0, such as -30mm, inside along its lower half [none]",
             into(options.type.arc, kArc));
    line.add(
        kGroup, "--path", "FILE",
        "Set a text along a path of this SVG drawing: the one that the drawing's own text follows, or the longest");
    line.add(kGroup, "--path-width", "LENGTH",
             "Width of the page of --path [its own; a px and a number without a unit are 1/96 inch]");
    line.add(kGroup, "--shift", "F",
             "Move a text along --arc or --path, by this share of its length, such as 0.25; around if it is closed",
             into(options.type.shift, {-1.0, 1.0, "a number from -1 to 1"}));
    line.addFlag(
        kGroup, "--equal-height",
        "Make all letters, and the dots on them, as high as the letter o at the contact angle, or as --height");
    line.addFlag(kGroup, "--by-colour",
                 "Make one droplet for each area of one colour, in that colour, of glyphs with colour layers (COLR); "
                 "neighbours share their boundary");
    line.add(kGroup, "--palette", "N", "Palette of the font for --by-colour", into(options.face.palette, kIndex));
    line.add(kGroup, "--text-colour", "COLOUR",
             "Colour for --by-colour of glyphs and layers that have none of their own; white is clear liquid [white]");
    declareGap(line, kGroup);
    line.add(kGroup, "--json", "FILE", "Write a report; for many glyphs a pattern such as 'out/{name}.json'");
    line.exclude({"--text", "--charset", "--all", "--list"});
    line.exclude({"--by-colour", "--equal-height"});
    line.exclude({"--arc", "--path"});
    declareBatch(line);
    declareDroplets(line, options.shape);
    declarePreview(line, PreviewOf::Text);
    declareShapeMaps(line, maps);
    declareHtml(line);
    declareRun(line);
}

void readFace(const CommandLine& line, droplet::FontOptions& face)
{
    if (!line.flag("--by-colour")) {
        face.palette = 0;
    }
    for (const Given& axis : line.values("--axis")) {
        const auto equals = axis.text.find('=');
        const auto value =
            equals == std::string::npos ? std::nullopt : finiteNumber(std::string_view(axis.text).substr(equals + 1));
        if (!value || equals != 4) {
            refuse(axis, "a tag of four characters and a value, such as wght=700");
        }
        face.axes.push_back({axis.text.substr(0, equals), *value});
    }
}

/// Replaces `\n` by line feeds and `\\` by backslashes.
std::string unescaped(const Given& given)
{
    std::string text;
    for (std::size_t i = 0; i < given.text.size(); ++i) {
        if (given.text[i] != '\\') {
            text += given.text[i];
            continue;
        }
        const char next = i + 1 < given.text.size() ? given.text[i + 1] : '\0';
        if (next != 'n' && next != '\\') {
            refuse(given, "a text in which \\n is a new line and \\\\ a backslash");
        }
        text += next == 'n' ? '\n' : '\\';
        ++i;
    }
    return text;
}

/// Path of the file that `--charset @FILE` names.
std::optional<std::string> charsetFile(const Given& given)
{
    return given.text.size() < 2 || given.text.front() != '@' ? std::nullopt : std::optional(given.text.substr(1));
}

std::vector<char32_t> readCharset(const Given& given)
{
    const auto file = charsetFile(given);
    if (!file) {
        return forOption(given.subject, [&] { return droplet::parseCharset(given.text); });
    }
    const std::string& path = *file;
    const std::string text = forOption(given.subject, [&] { return textOf(path); });
    std::vector<char32_t> characters = forOption(given.subject, [&] { return droplet::charactersOf(text); });
    if (characters.empty()) {
        throw droplet::Error(droplet::ErrorCode::InvalidInput, given.subject + ": " + path + " holds no characters");
    }
    return characters;
}

void readPath(const CommandLine& line, GlyphsOptions& options)
{
    if (const auto sizes = line.value("--line-sizes")) {
        options.type.line_sizes = numbers(*sizes, {0.05, 20.0, "numbers from 0.05 to 20"});
    }
    if (const auto path = line.value("--path")) {
        if (path->text.empty() || isStream(path->text)) {
            refuse("--path must name a file");
        }
        options.path = path->text;
    }
    if (const auto width = line.value("--path-width")) {
        if (!options.path) {
            refuse("--path-width goes with --path");
        }
        options.path_width = quantity(*width, kLength);
    }
    if (line.value("--shift") && !options.path && !options.type.arc) {
        refuse("--shift goes with --path or --arc");
    }
}

void readEqualHeight(const CommandLine& line, GlyphsOptions& options)
{
    options.equal_height = line.flag("--equal-height");
    if (!options.equal_height) {
        return;
    }
    if (line.value("--volume")) {
        refuse("--equal-height and --volume exclude each other: letters of one height have different volumes");
    }
    if (options.shape.settings.droplet.solve.fill.sharing == droplet::FillSharing::Total) {
        refuse("--equal-height and --fill total exclude each other: letters of one pressure have different heights");
    }
}

/// Refuses options that only apply to many glyphs, or only to a text.
void refuseInapplicable(const CommandLine& line, bool is_text)
{
    const auto clash = [&](const std::string& option, const std::string& with) {
        refuse(option + " goes with " + with);
    };
    if (is_text) {
        for (const char* option : {"--keep-going", "--no-resume", "--same-scale"}) {
            if (line.flag(option)) {
                clash(option, "--charset or --all, not with --text");
            }
        }
        for (const char* option : {"--shard", "--manifest", "--contact-sheet"}) {
            if (line.value(option)) {
                clash(option, "--charset or --all, not with --text");
            }
        }
        return;
    }
    for (const char* option :
         {"--align",          "--line-sizes", "--line-spacing", "--tracking", "--line-width",  "--arc",
          "--path",           "--path-width", "--shift",        "--onto",     "--preview",     "--view",
          "--preview-size",   "--ground",     "--camera",       "--look-at",  "--environment", "--preview-background",
          "--preview-colour", "--turntable",  "--codec",        "--quality",  "--maps",        "--map-width",
          "--map-thickness",  "--map-tile",   "--html"}) {
        if (line.value(option)) {
            clash(option, "--text alone");
        }
    }
}

}  // namespace

std::variant<GlyphsOptions, std::string> parseGlyphs(int argc, const char* const* argv)
{
    CommandLine line(commandText());
    GlyphsOptions options;
    ShapeMapOptions maps;
    declare(line, options, maps);
    line.parse(argc, argv);
    if (const auto text = requestedText(line)) {
        return *text;
    }
    const auto font = line.value("--font");
    if (!font || font->text.empty() || isStream(font->text)) {
        refuse(std::string("--font must name a file; ") + kUsage);
    }
    line.read();
    if (options.type.arc == 0.0) {
        refuse(*line.value("--arc"), "a radius from -1000m to 1000m that is not 0");
    }
    options.font = font->text;
    readFace(line, options.face);
    if (const auto colour = line.value("--text-colour")) {
        options.type.glyph.text_colour =
            forOption(colour->subject, [&] { return droplet::parseCssColour(colour->text); });
    }
    readPath(line, options);
    options.sized = line.value("--em").has_value();
    if (line.flag("--list")) {
        return options;
    }
    const auto text = line.value("--text");
    const auto charset = line.value("--charset");
    if (!text && !charset && !line.flag("--all")) {
        refuse(std::string("--text, --charset, --all or --list is missing; ") + kUsage);
    }
    refuseInapplicable(line, text.has_value());
    const auto output = line.value("--output");
    if (!output || output->text.empty() || (!text && isStream(output->text))) {
        refuse("--output is missing: give a path for " +
               std::string(text ? "the text, such as -o water.glb" : "each glyph, such as -o 'out/{name}.glb'"));
    }
    if (text) {
        for (const char* placeholder : {"{name}", "{gid}", "{codepoint}"}) {
            if (output->text.find(placeholder) != std::string::npos) {
                refuse("--output: '" + output->text + "' must name one file with --text; " + placeholder +
                       " goes with --charset or --all");
            }
        }
    }
    options.shape.input = options.font;
    options.shape.output = output->text;
    options.shape.html = readHtml(line);
    std::vector<std::string> warnings;
    if (text) {
        options.shape.preview = readPreview(line, warnings);
        if (options.shape.preview) {
            lookFromFront(line, *options.shape.preview);
        }
        options.shape.maps = readShapeMaps(line, maps);
    }
    readDroplets(line, options.shape, "--output");
    options.shape.footprint.by_colour = readByColour(line, warnings);
    options.shape.settings.warnings.insert(options.shape.settings.warnings.end(), warnings.begin(), warnings.end());
    const auto json = line.value("--json");
    if (text) {
        options.text = unescaped(*text);
        options.shape.json = json ? std::optional(json->text) : std::nullopt;
    } else {
        GlyphSetOptions set;
        if (charset) {
            set.choice.characters = readCharset(*charset);
            set.charset_file = charsetFile(*charset);
        }
        set.output = *output;
        set.json = json;
        set.batch = readBatch(line, options.shape.run, output->text);
        set.batch.material = options.shape.settings.material;
        options.set = std::move(set);
    }
    readEqualHeight(line, options);
    return options;
}

}  // namespace cli
