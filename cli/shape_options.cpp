// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_options.h"

#include <filesystem>

#include "droplet/version.h"
#include "files.h"

namespace cli {
namespace {

const CommandText& commandText()
{
    static const CommandText text{"droplet-shape", "from the picture of a footprint to a 3D droplet of liquid",
                                  "[OPTIONS] INPUT OUTPUT",
                                  std::string(kUnitsText) +
                                      "\n"
                                      "Examples:\n"
                                      "  droplet-shape logo.png logo.glb\n"
                                      "  droplet-shape logo.png logo.glb --width 8cm --contact-angle 60deg\n"
                                      "  droplet-shape logo.png wall.glb --model exact --tilt 90deg\n"
                                      "  droplet-shape logo.png can.glb --surface cylinder:R=33mm,axis=y\n"
                                      "  droplet-shape blots.png blots.obj --volume 30uL --fill total --json run.json\n"
                                      "  droplet-shape - - --format stl < logo.png > logo.stl\n"
                                      "\n"
                                      "Exit codes:\n"
                                      "  0 done; 1 internal error; 2 usage; 3 input unreadable or without liquid;\n"
                                      "  4 output cannot be written; 5 no such droplet exists"};
    return text;
}

void declareShape(CommandLine& line)
{
    line.addArgument("INPUT",
                     "picture of the footprint: PNG, JPEG, BMP, TIFF, WebP,\n"
                     "PBM, PGM or PPM; - is standard input");
    line.addArgument("OUTPUT",
                     "the droplet: .glb, .gltf, .obj, .ply or .stl;\n"
                     "- is standard output and needs --format");
    declareFootprint(line);
    declareLiquid(line);
    declareGround(line);
    declareSurface(line);
    line.add("Surface", "--format", "NAME",
             "glb, gltf, obj, ply, stl, whatever OUTPUT ends in\n"
             "[by OUTPUT's extension]");
    line.add("Run", "--json", "FILE", "write a report; - is standard output");
    line.add("Run", "--export-evolver", "FILE", "write the droplets for Surface Evolver");
    declareRun(line);
}

void readFormat(const CommandLine& line, ShapeOptions& options)
{
    const std::string known = "glb, gltf, obj, ply, stl";
    const std::string extension = std::filesystem::path(options.output).extension().string();
    if (const auto format = line.value("--format")) {
        options.format = choice<droplet::Format>(*format, {{"glb", droplet::Format::Glb},
                                                           {"gltf", droplet::Format::Gltf},
                                                           {"obj", droplet::Format::Obj},
                                                           {"ply", droplet::Format::Ply},
                                                           {"stl", droplet::Format::Stl}});
    } else if (options.output == kStandardStream) {
        refuse("--format is needed when OUTPUT is -; allowed are " + known);
    } else if (extension.empty()) {
        refuse("OUTPUT '" + options.output + "' has no extension to tell the format; allowed are " + known +
               ", or give --format");
    } else {
        options.format = forOption("OUTPUT '" + options.output + "'", [&] { return droplet::formatNamed(extension); });
    }

    if (const auto material = line.value("--material")) {
        if (options.format != droplet::Format::Glb && options.format != droplet::Format::Gltf) {
            options.settings.warnings.push_back("--material " + material->text + " has no effect: " +
                                                droplet::name(options.format) + " files carry no material");
        }
    }
}

}  // namespace

std::variant<ShapeOptions, std::string> parseShape(int argc, const char* const* argv)
{
    CommandLine line(commandText());
    declareShape(line);
    line.parse(argc, argv);
    if (line.flag("--help")) {
        return line.help();
    }
    if (line.flag("--version")) {
        return "droplet-shape " + std::string(droplet::kVersion) + "\n";
    }
    ShapeOptions options;
    options.footprint = readFootprint(line);
    options.settings = readDroplet(line);
    options.run = readRun(line);
    if (const auto json = line.value("--json")) {
        options.json = json->text;
    }
    if (const auto evolver = line.value("--export-evolver")) {
        options.evolver = evolver->text;
    }
    options.input = line.argument("INPUT");
    options.output = line.argument("OUTPUT");
    readFormat(line, options);
    return options;
}

}  // namespace cli
