// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_options.h"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <utility>

#include "common_options.h"
#include "droplet/io/page.h"
#include "files.h"

namespace cli {

const std::vector<std::pair<std::string, std::string>>& programCommands()
{
    static const std::vector<std::pair<std::string, std::string>> commands{
        {"animate", "Make animated droplets from frames or a video"},
        {"batch", "Make droplets from many pictures"},
        {"compare", "Measure the difference of two surfaces"},
        {"dew", "Cover an object with droplets that rest on it"},
        {"flow", "Let droplets run over a mesh"},
        {"glyphs", "Make droplets from type"},
        {"liquid2d", "Draw an animation of liquid in the plane"},
        {"morph", "Let liquid flow from one footprint to the next"},
        {"studio", "Draw footprints in a browser and see their droplets"},
        {"wind-tunnel", "Compute how droplets move in the wind"},
        {"windshield", "Show rain on the windshield of a moving car"}};
    return commands;
}

namespace {

const CommandText& commandText()
{
    static const CommandText text{
        "droplet-shape", "make 3D droplets of liquid from the picture of a footprint", "[OPTIONS] INPUT OUTPUT",
        std::string(kUnitsText) +
            "\n"
            "Examples:\n"
            "  droplet-shape logo.png logo.glb\n"
            "  droplet-shape logo.png logo.glb --width 8cm --contact-angle 50deg\n"
            "  droplet-shape logo.png wall.glb --tilt 90deg --width 1cm --contact-angle 20deg\n"
            "  droplet-shape logo.png can.glb --surface cylinder:R=33mm,axis=y\n"
            "  droplet-shape blots.png blots.obj --volume 30uL --fill total --json run.json\n"
            "  droplet-shape logo.png logo.glb --preview look.png --ground wood.jpg\n"
            "  droplet-shape logo.png logo.glb --maps maps/logo.exr --map-width 2k\n"
            "  droplet-shape flag.svg flag.glb --by-colour --nodes each\n"
            "  droplet-shape spill.jpg spill.glb --fill-holes 1mm2 --mask-out mask.png\n"
            "  droplet-shape - - --format stl < logo.png > logo.stl\n"
            "  droplet-shape logo.png logo.glb --watch\n"
            "\n"
            "Exit codes:\n"
            "  0 done; 1 internal error; 2 usage; 3 input unreadable or without liquid;\n"
            "  4 output cannot be written; 5 no such droplet exists;\n"
            "  6 some of many failed",
        programCommands()};
    return text;
}

void declareShape(CommandLine& line, ShapeOptions& options, ShapeMapOptions& maps)
{
    line.addArgument(
        "INPUT",
        "Picture of the footprint: PNG, JPEG, SVG, GIF, TIFF, WebP, BMP, TGA, ICO, PBM, PGM, PPM, JPEG 2000, "
        "OpenEXR or HDR; - is standard input");
    line.addArgument(
        "OUTPUT",
        "The droplet: .glb, .gltf, .obj, .ply, .stl, .usda, .usdz or .3mf; - is standard output and needs --format");
    declareShapes(line, options);
    declareSeeds(line, options.footprint);
    declareMaskOut(line);
    declarePreview(line);
    declareShapeMaps(line, maps);
    line.add("Run", "--json", "FILE", "Write a report; - is standard output", into(options.json));
    declareHtml(line);
    line.add("Run", "--export-evolver", "FILE", "Write the droplets as input for Surface Evolver; - is standard output",
             into(options.evolver));
    line.addFlag("Run", "--watch", "Make the droplet again whenever INPUT is saved, until Ctrl-C", options.watch);
    declareRun(line);
    line.exclude({"--watch", "--no-clobber"});
}

/// --watch makes files again and again, which streams cannot hold.
void requireFiles(const ShapeOptions& options)
{
    const auto clash = [](const std::string& name, const std::string& path) {
        if (isStream(path)) {
            refuse("--watch and " + name + " - exclude each other: only a file can be made again");
        }
    };
    clash("INPUT", options.input);
    clash("OUTPUT", options.output);
    clash("--json", options.json.value_or(""));
    clash("--mask-out", options.footprint.mask_out.value_or(""));
    clash("--export-evolver", options.evolver.value_or(""));
    clash("--html", options.html.value_or(""));
    clash("--preview", options.preview ? options.preview->path : "");
}

bool inGltf(droplet::Format format)
{
    return format == droplet::Format::Glb || format == droplet::Format::Gltf;
}

/// Whether an output is glTF; the page contains one.
bool inGltf(const ShapeOptions& options)
{
    return options.html || inGltf(options.format);
}

}  // namespace

void declareLevels(CommandLine& line, const std::string& files)
{
    line.add("Surface", "--lod", "NUMBERS",
             "Levels of detail: --triangles of the first, and the largest number of triangles of every other one, such "
             "as 40k,10k,2k. In glTF by MSFT_lod, otherwise in files of their own: " +
                 files);
    for (const char* other : {"--triangles", "--edge", "--quads"}) {
        if (line.knows(other)) {
            line.exclude({"--lod", other});
        }
    }
}

void readLevels(const CommandLine& line, const std::string& output, droplet::Format format, DropletSettings& settings)
{
    const auto given = line.value("--lod");
    if (!given) {
        return;
    }
    constexpr std::size_t kMaxLevels = 8;
    std::vector<std::size_t> levels;
    for (const Given& part : partsOf(*given)) {
        levels.push_back(count(part, {1, kMaxTriangles, "100M, such as 5000, 5k or 1M"}));
    }
    const bool descends = std::adjacent_find(levels.begin(), levels.end(), std::less_equal<>()) == levels.end();
    if (levels.size() < 2 || levels.size() > kMaxLevels || !descends) {
        refuse(*given, "2 to 8 numbers of triangles, each smaller than the one before, such as 40k,10k,2k");
    }
    if (isStream(output) && !inGltf(format)) {
        refuse("--lod and OUTPUT - exclude each other: only glb and gltf hold all levels in one file");
    }
    settings.droplet.mesh.triangles = levels.front();
    settings.levels.assign(levels.begin() + 1, levels.end());
}

namespace {

/// Reads --fill-range. A slider needs a file format that can hold it.
void readFillRange(const CommandLine& line, ShapeOptions& options)
{
    const auto given = line.value("--fill-range");
    if (!given) {
        return;
    }
    const std::string allowed = "two numbers such as 0..2, the first from 0 to 1, the second larger and at least 1";
    const auto dots = given->text.find("..");
    const auto min = finiteNumber(given->text.substr(0, dots));
    const auto max = dots == std::string::npos ? std::nullopt : finiteNumber(given->text.substr(dots + 2));
    if (!min || !max) {
        refuse(*given, allowed);
    }
    const droplet::FillRange range{*min, *max};
    constexpr double kMaxFills = 1e6;  // far beyond any droplet
    try {
        range.validate();
    } catch (const droplet::Error&) {
        refuse(*given, allowed);
    }
    if (range.max > kMaxFills) {
        refuse(*given, allowed + ", up to 1000000");
    }
    const auto clash = [&](const std::string& option, const std::string& why) {
        refuse("--fill-range and " + option + " exclude each other: " + why);
    };
    if (options.settings.droplet.solve.no_penetration) {
        clash("--no-penetration", "the dry area changes with the volume");
    }
    if (options.settings.onto) {
        clash("--onto", "droplets on an object have no slider");
    }
    if (!inGltf(options)) {
        clash(std::string("the format ") + droplet::name(options.format), "only glb and gltf hold a slider");
    }
    options.settings.droplet.fill_range = range;
}

}  // namespace

void declareDroplets(CommandLine& line, ShapeOptions& options)
{
    DropletSettings& settings = options.settings;
    declareLiquid(line, settings);
    declareGround(line, settings);
    declareSurface(line, settings);
    line.addFlag(
        "Surface", "--quads",
        "Quadrilaterals along the rim, for subdivision and sculpting, in .obj, .ply and USD; --triangles counts "
        "their halves",
        settings.droplet.mesh.quads);
    line.exclude({"--quads", "--grading"});
    using droplet::Format;
    line.add("Surface", "--format", "File format, whatever OUTPUT's extension is [by OUTPUT's extension]",
             into(options.format, {{"glb", Format::Glb},
                                   {"gltf", Format::Gltf},
                                   {"obj", Format::Obj},
                                   {"ply", Format::Ply},
                                   {"stl", Format::Stl},
                                   {"usda", Format::Usda},
                                   {"usdz", Format::Usdz},
                                   {"3mf", Format::ThreeMf}}));
    line.add("Surface", "--nodes",
             "Nodes in glTF and USD, parts in 3MF: one for all droplets, or one each, named droplet_1, droplet_2 and "
             "so on, with its "
             "figures",
             into(settings.nodes, {{"one", droplet::Nodes::One}, {"each", droplet::Nodes::Each}}));
    declareDropletsOnly(line, "Surface", "With --onto: ");
    line.add("Surface", "--materials", "FILE",
             "TOML file with a material, colour, roughness or index of refraction for single droplets");
    line.add("Surface", "--fill-range", "RANGE",
             "Add a slider to glTF that fills and drains the droplet, such as 0..2 from none to twice its liquid; "
             "takes the linear model unless --model exact is given");
    line.add(
        "Surface", "--sink", "LENGTH",
        "Lower the droplet into the ground by LENGTH in its file, so that a ground at height 0 cuts it: a base just "
        "above the ground leaves a film of air, which mirrors the sky",
        withoutDefault(into(settings.sink, kLength)));
    line.add(
        "Surface", "--base", "LENGTH",
        "Put all droplets on a plate of this thickness, for printing: 1mm. All is one closed solid; with --by-colour, "
        "--materials or --nodes each, every part and the plate is one. The plate is a rectangle with rounded "
        "corners, wider than the liquid by two thicknesses on every side",
        into(settings.base, kLength));
    for (const char* other : {"--open", "--surface", "--onto", "--fill-range", "--sink", "--no-penetration"}) {
        if (line.knows(other)) {
            line.exclude({"--base", other});
        }
    }
    declareLevels(line, "logo-lod1.obj");
    line.addFlag("Surface", "--weld",
                 "One vertex for each place in glTF, for mesh tools: the rim has the liquid's normals, not two. Other "
                 "formats are welded always",
                 settings.weld);
    declareCompression(line, "Surface");
}

void declareShapes(CommandLine& line, ShapeOptions& options)
{
    declareFootprint(line, options.footprint);
    declareByColour(line);
    declareDroplets(line, options);
    line.addFlag("Surface", "--colour-map",
                 "Lay the picture on the liquid, as a tint in glTF, USDZ, previews and the page",
                 options.settings.colour_map);
    line.exclude({"--by-colour", "--colour-map"});
}

droplet::Format formatOf(const std::string& output, const std::string& subject)
{
    const std::string known = "glb, gltf, obj, ply, stl, usda, usdz, 3mf";
    const std::string extension = std::filesystem::path(output).extension().string();
    if (output == kStandardStream) {
        refuse("--format is missing: it is needed if OUTPUT is -; allowed are " + known);
    }
    if (extension.empty()) {
        refuse(subject + " '" + output + "' has no extension that gives the format; allowed are " + known +
               ", or give --format");
    }
    return forOption(subject + " '" + output + "'", [&] { return droplet::formatNamed(extension); });
}

void declareHtml(CommandLine& line, const char* group, const std::string& what)
{
    line.add(group, "--html", "FILE", "Write one page that " + what + " in a browser; - is standard output");
}

std::optional<std::string> readHtml(const CommandLine& line)
{
    const auto html = line.value("--html");
    if (!html) {
        return std::nullopt;
    }
    if (!droplet::hasPage()) {
        refuse("--html: this build has no page; build it with -DDROPLET_PAGE=ON, or run scripts/run with --html");
    }
    return html->text;
}

void readDroplets(const CommandLine& line, ShapeOptions& options, const std::string& subject)
{
    readDroplet(line, options.settings);
    options.run = readRun(line);
    if (const auto materials = line.value("--materials")) {
        options.settings.materials = readMaterials(materials->text);
    }
    if (!line.value("--format")) {
        options.format = formatOf(options.output, subject);
    }
    if (options.settings.onto) {
        options.settings.with_object = hasObject(line, options.format, options.output);
        options.settings.page_has_object = options.html && !line.flag("--droplets-only");
    } else if (line.flag("--droplets-only")) {
        options.settings.warnings.emplace_back("--droplets-only has no effect without --onto");
    }
    warnOfFormat(line, options.format, options.html || options.preview, options.settings);
    readLevels(line, options.output, options.format, options.settings);
    if (options.settings.weld && !inGltf(options.format)) {
        options.settings.warnings.push_back(std::string("--weld has no effect: ") + droplet::name(options.format) +
                                            " files have one vertex for each place");
        options.settings.weld = false;
    }
    readFillRange(line, options);
    options.compression = readCompression(line, options.format);
}

void readShapes(const CommandLine& line, ShapeOptions& options, const std::string& subject)
{
    readDroplets(line, options, subject);
    readFootprint(line, options.footprint);
    options.footprint.by_colour = readByColour(line, options.settings.warnings);
}

std::variant<ShapeOptions, std::string> parseShape(int argc, const char* const* argv)
{
    CommandLine line(commandText());
    ShapeOptions options;
    ShapeMapOptions maps;
    declareShape(line, options, maps);
    line.parse(argc, argv);
    if (const auto text = requestedText(line)) {
        return *text;
    }
    line.read();
    options.input = line.argument("INPUT");
    options.output = line.argument("OUTPUT");
    options.html = readHtml(line);
    std::vector<std::string> warnings;
    options.preview = readPreview(line, warnings);
    options.maps = readShapeMaps(line, maps);
    readShapes(line, options, "OUTPUT");
    if (const auto mask = line.value("--mask-out")) {
        options.footprint.mask_out = mask->text;
    }
    options.settings.warnings.insert(options.settings.warnings.end(), warnings.begin(), warnings.end());
    if (options.watch) {
        requireFiles(options);
    }
    return options;
}

}  // namespace cli
